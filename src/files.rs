//! Files in and out: dialogs, reading, atomic writing, the document kept between runs.
//!
//! Dialogs, reads and writes run on threads of their own and come back through [`Files::poll`]; the window never waits.

mod keep;

use std::fs;
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use crate::catalog::import::{Imported, import};
use crate::catalog::meshes::{ENDINGS as MESH_ENDINGS, is_mesh};
use crate::document::Document;
use crate::document::own::OwnSet;
use chromascope_core::table::MAX_BYTES;

pub use keep::{install_panic_hook, panic_saves};

/// A dialog that answers nothing within this time was never there: a missing portal looks like Cancel.
const NO_DIALOG: Duration = Duration::from_millis(150);
/// Endings offered first when opening.
const ENDINGS: [&str; 9] = ["csv", "txt", "tsv", "dat", "asc", "prn", "trm", "ssm", "spectrum"];
/// How much of a file is looked at to tell a mesh from spectra.
const LOOK: usize = 1 << 16;

/// What came of a dialog, a read or a write.
#[derive(Debug)]
pub enum FileEvent {
    /// Sets were read.
    Read {
        /// The sets.
        sets: Vec<OwnSet>,
        /// What was read, and what was decided, in one sentence.
        message: String,
        /// Whether something was guessed that a person should look at.
        guessed: bool,
        /// The files they came from.
        paths: Vec<PathBuf>,
    },
    /// A mesh is to be opened, which is not read yet.
    Mesh(PathBuf),
    /// Something to know: a file was written.
    Said(String),
    /// Something failed; nothing was changed.
    Failed(String),
}

/// Something to save where the user says.
#[derive(Clone, Debug)]
pub struct SaveRequest {
    /// The name offered.
    pub name: String,
    /// The ending of such files.
    pub extension: &'static str,
    /// The contents.
    pub bytes: Vec<u8>,
}

/// A path to be typed, where there is no dialog.
#[derive(Clone, Debug)]
pub struct PathPrompt {
    /// What is typed.
    pub text: String,
    /// What is to be saved there; none for opening.
    pub save: Option<SaveRequest>,
}

/// What a thread says.
enum Note {
    Event(FileEvent),
    ToOpen(Vec<PathBuf>),
    NoDialog(Option<SaveRequest>),
}

/// The only part of the window that touches the disk.
pub struct Files {
    sender: Sender<Note>,
    receiver: Receiver<Note>,
    keeper: keep::Keeper,
    prompt: Option<PathPrompt>,
    wake: Option<egui::Context>,
}

impl Files {
    /// With the folder that the document is kept in between runs, if any.
    pub fn new(folder: Option<PathBuf>) -> Self {
        let (sender, receiver) = channel();
        Self { sender, receiver, keeper: keep::Keeper::new(folder), prompt: None, wake: None }
    }

    /// Has the window drawn when something comes back.
    pub fn wake(&mut self, ctx: &egui::Context) {
        self.wake = Some(ctx.clone());
    }

    /// The document as it was kept, else the first screen.
    pub fn kept_document(&mut self) -> Document {
        let (document, message) = self.keeper.load();
        if let Some(message) = message {
            self.note(Note::Event(FileEvent::Failed(message)));
        }
        document
    }

    /// Asks for files to open.
    pub fn ask_to_open(&mut self) {
        let dialog = rfd::FileDialog::new()
            .set_title("Open spectra, camera sensitivities or a mesh")
            .add_filter("Spectra and meshes", &[&ENDINGS[..], &MESH_ENDINGS].concat())
            .add_filter("Text and CSV", &ENDINGS)
            .add_filter("Meshes", &MESH_ENDINGS)
            .add_filter("All files", &["*"]);
        self.in_dialog(move || dialog.pick_files().map(Note::ToOpen), None);
    }

    /// Asks where to save.
    pub fn ask_to_save(&mut self, request: SaveRequest) {
        let dialog = rfd::FileDialog::new()
            .set_title(format!("Save {}", request.name))
            .set_file_name(&request.name)
            .add_filter(request.extension, &[request.extension]);
        let kept = request.clone();
        self.in_dialog(move || dialog.save_file().map(|path| Note::Event(save(&path, &request.bytes))), Some(kept));
    }

    /// Runs a dialog on a thread (on a Mac they must stay on this one). One that closed at once without an answer was not there.
    fn in_dialog(&self, ask: impl FnOnce() -> Option<Note> + Send + 'static, request: Option<SaveRequest>) {
        let (sender, wake) = (self.sender.clone(), self.wake.clone());
        let run = move || {
            let start = Instant::now();
            let note = ask().or_else(|| (start.elapsed() < NO_DIALOG).then_some(Note::NoDialog(request)));
            if let Some(note) = note {
                // The receiver is gone only when the window is.
                let _closed = sender.send(note);
            }
            if let Some(ctx) = wake {
                ctx.request_repaint();
            }
        };
        if cfg!(target_os = "macos") {
            run();
        } else {
            self.spawn("file dialog", run);
        }
    }

    /// The path that is being asked for in the window, where there is no dialog.
    pub fn prompt_mut(&mut self) -> &mut Option<PathPrompt> {
        &mut self.prompt
    }

    /// Takes the path typed.
    pub fn take_prompt(&mut self) {
        let Some(prompt) = self.prompt.take() else { return };
        let path = PathBuf::from(prompt.text.trim());
        if path.as_os_str().is_empty() {
            return;
        }
        match prompt.save {
            None => self.open(path),
            Some(request) => self.in_background(move || [save(&path, &request.bytes)]),
        }
    }

    /// Opens a file.
    pub fn open(&mut self, path: PathBuf) {
        self.in_background(move || read_files(vec![path]));
    }

    /// Opens a file that was dropped on the window.
    pub fn open_dropped(&mut self, file: &Arc<dyn egui::DroppedFile + Send + Sync>) {
        let file = Arc::clone(file);
        self.in_background(move || {
            let path = file.path().to_path_buf();
            if path.is_file() {
                return read_files(vec![path]);
            }
            let name = path.file_name().map_or_else(|| "dropped file".to_owned(), |n| n.to_string_lossy().into_owned());
            vec![match file.bytes() {
                Ok(bytes) if is_mesh(&path, &bytes[..bytes.len().min(LOOK)]) => FileEvent::Failed(format!(
                    "{name}: a session remembers where a mesh is, so it must be on disk; save it first. Nothing was changed."
                )),
                Ok(bytes) => read_event(import(&name, &bytes, None).map_err(|e| unread(&name, &e)), Vec::new()),
                Err(error) => FileEvent::Failed(format!("{name}: {error}. Nothing was changed.")),
            }]
        });
    }

    /// Reads text from the clipboard as if it were a file.
    pub fn open_pasted(&mut self, text: String) {
        self.in_background(move || {
            [read_event(import("clipboard", text.as_bytes(), None).map_err(|e| unread("Clipboard", &e)), Vec::new())]
        });
    }

    /// What happened since.
    pub fn poll(&mut self) -> Vec<FileEvent> {
        let notes: Vec<Note> = self.receiver.try_iter().collect();
        let mut events = Vec::new();
        for note in notes {
            match note {
                Note::Event(event) => events.push(event),
                Note::ToOpen(paths) => self.in_background(move || read_files(paths)),
                Note::NoDialog(save) => {
                    let text = save.as_ref().map_or_else(String::new, |request| request.name.clone());
                    self.prompt = Some(PathPrompt { text, save });
                }
            }
        }
        events
    }

    /// Keeps a changed document, a moment after it stopped changing.
    pub fn autosave(&mut self, document: &Document, ctx: &egui::Context) {
        if let Err(error) = self.keeper.watch(document, ctx) {
            self.note(Note::Event(FileEvent::Failed(error)));
        }
    }

    /// Keeps the document now.
    pub fn save_document(&mut self, document: &Document) {
        if let Err(error) = self.keeper.save(document) {
            log::warn!("{error}");
        }
    }

    fn in_background<E: IntoIterator<Item = FileEvent>>(&self, work: impl FnOnce() -> E + Send + 'static) {
        let (sender, wake) = (self.sender.clone(), self.wake.clone());
        self.spawn("files", move || {
            for event in work() {
                let _closed = sender.send(Note::Event(event));
            }
            if let Some(ctx) = wake {
                ctx.request_repaint();
            }
        });
    }

    fn spawn(&self, name: &str, work: impl FnOnce() + Send + 'static) {
        if let Err(error) = thread::Builder::new().name(name.to_owned()).spawn(work) {
            self.note(Note::Event(FileEvent::Failed(format!("no thread for {name}: {error}"))));
        }
    }

    fn note(&self, note: Note) {
        let _closed = self.sender.send(note);
    }
}

/// Reads files one after the other; those that cannot be read change nothing. A mesh is only named: what shows it reads it.
fn read_files(paths: Vec<PathBuf>) -> Vec<FileEvent> {
    // A relative path would mean another file after a start from elsewhere.
    let paths = paths.into_iter().map(|path| std::path::absolute(&path).unwrap_or(path));
    let (meshes, spectra): (Vec<PathBuf>, Vec<PathBuf>) = paths.partition(|path| is_mesh(path, &beginning(path)));
    let mut events = Vec::new();
    if !spectra.is_empty() {
        events.push(read_spectra(spectra));
    }
    events.extend(meshes.into_iter().map(FileEvent::Mesh));
    events
}

/// The first bytes of a file; none where it cannot be read, which reading it will tell.
fn beginning(path: &Path) -> Vec<u8> {
    let mut bytes = Vec::new();
    // Opening a pipe would wait for somebody to write into it.
    if path.is_file()
        && let Ok(file) = fs::File::open(path)
        && file.take(LOOK as u64).read_to_end(&mut bytes).is_err()
    {
        bytes.clear();
    }
    bytes
}

fn read_spectra(paths: Vec<PathBuf>) -> FileEvent {
    let (mut sets, mut messages, mut failures, mut good) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut guessed = false;
    for path in paths {
        match read_file(&path) {
            Ok(imported) => {
                log::info!("opened {}", imported.message);
                guessed |= imported.guessed;
                sets.push(imported.set);
                messages.push(imported.message);
                good.push(path);
            }
            Err(message) => failures.push(message),
        }
    }
    for failure in &failures {
        log::warn!("{failure}");
    }
    if sets.is_empty() {
        return FileEvent::Failed(failures.join("  "));
    }
    let mut message = match messages.as_slice() {
        [one] => one.clone(),
        many => format!("{} files read.", many.len()),
    };
    if !failures.is_empty() {
        message = format!("{message} Not read: {}", failures.join("  "));
    }
    FileEvent::Read { sets, message, guessed, paths: good }
}

/// Reads one file; the error is a sentence with its name.
pub fn read_file(path: &Path) -> Result<Imported, String> {
    let name = path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned());
    let failed = |error: io::Error| format!("{name}: {}. Nothing was changed.", reason(&error));
    let size = fs::metadata(path).map_err(failed)?.len();
    if size > MAX_BYTES as u64 {
        let limit = MAX_BYTES / 1_000_000;
        return Err(format!(
            "{name}: {} MB, but the limit is {limit} MB; split it. Nothing was changed.",
            size / 1_000_000
        ));
    }
    let bytes = fs::read(path).map_err(failed)?;
    import(&name, &bytes, None).map_err(|error| unread(&name, &error))
}

fn unread(name: &str, error: &chromascope_core::table::ReadError) -> String {
    let text = error.to_string();
    let joint = if text.starts_with("line ") { ", " } else { ": " };
    format!("{name}{joint}{text}. Nothing was changed.")
}

fn read_event(read: Result<Imported, String>, paths: Vec<PathBuf>) -> FileEvent {
    match read {
        Ok(Imported { set, message, guessed }) => FileEvent::Read { sets: vec![set], message, guessed, paths },
        Err(message) => FileEvent::Failed(message),
    }
}

fn save(path: &Path, bytes: &[u8]) -> FileEvent {
    match write_atomically(path, bytes) {
        Ok(()) => FileEvent::Said(format!("Saved {}.", path.display())),
        Err(error) => {
            FileEvent::Failed(format!("Cannot write {}: {}. Your work is safe.", path.display(), reason(&error)))
        }
    }
}

/// The system's reason without its error number.
pub fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    let end = text.find(" (os error").unwrap_or(text.len());
    text[..end].to_lowercase()
}

/// Writes a file whole or not at all: beside it first, then moved into its place.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = tempfile::Builder::new().prefix(".chromascope-").tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    // A temporary file is private; what is saved is as readable as any new file.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        let mode = fs::metadata(path).map_or(0o644, |known| known.permissions().mode());
        file.as_file().set_permissions(fs::Permissions::from_mode(mode))?;
    }
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}
