//! Files in and out: dialogs, reading, atomic writing, the document kept between runs.
//!
//! Dialogs, reads and writes run on threads of their own and come back through [`Files::poll`]; the window never waits.

mod keep;
mod watch;

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use crate::catalog::meshes::ENDINGS as MESH_ENDINGS;
use crate::document::Document;

pub use keep::{install_panic_hook, panic_saves};

/// A dialog that answers nothing within this time was never there: a missing portal looks like Cancel.
const NO_DIALOG: Duration = Duration::from_millis(150);
/// Endings offered first when opening.
const ENDINGS: [&str; 30] = [
    "csv", "txt", "tsv", "dat", "asc", "prn", "trm", "ssm", "abs", "irr", "spectrum", "ttt", "trt", "tat", "jaz",
    "dta", "dpt", "sp", "cmf", "ccss", "ti3", "cgats", "jdx", "dx", "jcm", "spdx", "cxf", "xml", "json", "xls",
];

/// What came of a dialog, a read or a write.
#[derive(Debug)]
pub enum FileEvent {
    /// Files or folders are to be opened.
    Open(Vec<PathBuf>),
    /// Files changed on disk.
    Changed(Vec<PathBuf>),
    /// Something to know: a file was written.
    Said(String),
    /// Something failed; nothing was changed.
    Failed(String),
}

/// Something to save where the user says.
#[derive(Clone, Debug)]
pub struct SaveRequest {
    /// What it is, for the question where to: `Nikon D70 as CSV, as measured`.
    pub what: String,
    /// The name offered.
    pub name: String,
    /// The ending of such files.
    pub extension: &'static str,
    /// The contents.
    pub bytes: Vec<u8>,
    /// What to say besides once it is saved: how the contents differ from what is in the program. May be empty.
    pub note: String,
}

/// A path to be typed, where there is no dialog.
#[derive(Clone, Debug)]
pub struct PathPrompt {
    /// What is typed.
    pub text: String,
    /// What is to be saved there; none for opening.
    pub save: Option<SaveRequest>,
    /// A file that is there already, which a person was told of.
    pub replaces: Option<PathBuf>,
    /// Why writing to the path typed failed.
    pub failure: Option<String>,
    /// Whether the field takes the keyboard in this frame.
    pub focus: bool,
}

impl PathPrompt {
    fn new(save: Option<SaveRequest>) -> Self {
        let text = save.as_ref().map_or_else(String::new, |request| request.name.clone());
        Self { text, save, replaces: None, failure: None, focus: true }
    }
}

/// What a thread says.
enum Note {
    Event(FileEvent),
    ToOpen(Vec<PathBuf>),
    ToSave(SaveRequest),
    NoDialog(Option<SaveRequest>),
    NotSaved(PathPrompt),
}

/// The only part of the window that touches the disk.
pub struct Files {
    sender: Sender<Note>,
    receiver: Receiver<Note>,
    keeper: keep::Keeper,
    prompt: Option<PathPrompt>,
    dialogs: bool,
    wake: Option<egui::Context>,
    watch: watch::Watch,
}

impl Files {
    /// With the folder that the document is kept in between runs, if any.
    pub fn new(folder: Option<PathBuf>) -> Self {
        let (sender, receiver) = channel();
        Self {
            sender,
            receiver,
            keeper: keep::Keeper::new(folder),
            prompt: None,
            dialogs: true,
            wake: None,
            watch: watch::Watch::new(None),
        }
    }

    /// Asks for paths in the window alone, as where the system has no dialogs.
    #[must_use]
    pub fn without_dialogs(self) -> Self {
        Self { dialogs: false, ..self }
    }

    /// Has the window drawn when something comes back.
    pub fn wake(&mut self, ctx: &egui::Context) {
        self.wake = Some(ctx.clone());
        self.watch = watch::Watch::new(Some(ctx.clone()));
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

    /// Asks for a folder whose files are to be opened.
    pub fn ask_for_folder(&mut self) {
        let dialog = rfd::FileDialog::new().set_title("Open all spectra of a folder");
        self.in_dialog(move || dialog.pick_folder().map(|folder| Note::ToOpen(vec![folder])), None);
    }

    /// Makes something to save beside the window, then asks where to; the error is a sentence.
    pub fn make_to_save(&self, make: impl FnOnce() -> Result<SaveRequest, String> + Send + 'static) {
        self.in_background(move || match make() {
            Ok(request) => [Note::ToSave(request)],
            Err(sentence) => [Note::Event(FileEvent::Failed(sentence))],
        });
    }

    /// Asks where to save. A question that is open already is about this from now on; a path that was typed stays, with the
    /// ending of what is saved now where it had that of what was to be saved before.
    pub fn ask_to_save(&mut self, request: SaveRequest) {
        if let Some(PathPrompt { text, save: Some(before), replaces, failure, focus }) = &mut self.prompt {
            if *text == before.name {
                text.clone_from(&request.name);
            } else if let Some(stem) = without_ending(text, before.extension) {
                *text = format!("{stem}.{}", request.extension);
            }
            (*before, *replaces, *failure, *focus) = (request, None, None, true);
            return;
        }
        let dialog = rfd::FileDialog::new()
            .set_title(format!("Save {}", request.what))
            .set_file_name(&request.name)
            .add_filter(request.extension, &[request.extension]);
        let kept = request.clone();
        self.in_dialog(move || dialog.save_file().map(|path| Note::Event(save(&path, &request))), Some(kept));
    }

    /// Runs a dialog on a thread (on a Mac they must stay on this one). One that closed at once without an answer was not there.
    fn in_dialog(&self, ask: impl FnOnce() -> Option<Note> + Send + 'static, request: Option<SaveRequest>) {
        if !self.dialogs {
            self.note(Note::NoDialog(request));
            return;
        }
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
        if prompt.save.is_some() && path.is_dir() {
            let failure = Some(format!("{} is a folder: add a name.", path.display()));
            self.prompt = Some(PathPrompt { failure, focus: true, ..prompt });
            return;
        }
        if prompt.save.is_some() && path.exists() && prompt.replaces.as_ref() != Some(&path) {
            self.prompt = Some(PathPrompt { replaces: Some(path), failure: None, focus: true, ..prompt });
            return;
        }
        if path.as_os_str().is_empty() {
            return;
        }
        let Some(request) = prompt.save.clone() else {
            self.note(Note::ToOpen(vec![path]));
            return;
        };
        self.in_background(move || {
            let event = save(&path, &request);
            let again = match &event {
                FileEvent::Failed(why) => {
                    Some(Note::NotSaved(PathPrompt { failure: Some(why.clone()), focus: true, ..prompt }))
                }
                _ => None,
            };
            [Note::Event(event)].into_iter().chain(again)
        });
    }

    /// What happened since.
    pub fn poll(&mut self) -> Vec<FileEvent> {
        let notes: Vec<Note> = self.receiver.try_iter().collect();
        let mut events = Vec::new();
        let (changed, again) = self.watch.poll();
        if !changed.is_empty() {
            events.push(FileEvent::Changed(changed));
        }
        if let Some((after, ctx)) = again.zip(self.wake.as_ref()) {
            ctx.request_repaint_after(after);
        }
        for note in notes {
            match note {
                Note::Event(event) => events.push(event),
                Note::ToOpen(paths) => events.push(FileEvent::Open(paths)),
                Note::ToSave(request) => self.ask_to_save(request),
                Note::NoDialog(save) => self.ask_for_path(save),
                // What was asked for meanwhile goes first.
                Note::NotSaved(prompt) => self.prompt = self.prompt.take().or(Some(prompt)),
            }
        }
        events
    }

    /// Asks for a path in the window. What is typed into a question that is open is not lost.
    fn ask_for_path(&mut self, save: Option<SaveRequest>) {
        match (&mut self.prompt, save) {
            (Some(PathPrompt { save: Some(_), .. }), Some(request)) => self.ask_to_save(request),
            (Some(prompt), None) => prompt.focus = true,
            (prompt, save) => *prompt = Some(PathPrompt::new(save)),
        }
    }

    /// Watches these files on disk and no others.
    pub fn watch(&mut self, files: std::collections::BTreeSet<PathBuf>) {
        self.watch.files(files);
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

    fn in_background<N: IntoIterator<Item = Note>>(&self, work: impl FnOnce() -> N + Send + 'static) {
        let (sender, wake) = (self.sender.clone(), self.wake.clone());
        self.spawn("files", move || {
            for note in work() {
                let _closed = sender.send(note);
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

/// A typed path without an ending, if it has it, in small letters or large.
fn without_ending<'a>(path: &'a str, ending: &str) -> Option<&'a str> {
    let (stem, own) = path.trim_end().rsplit_once('.')?;
    own.eq_ignore_ascii_case(ending).then_some(stem)
}

fn save(path: &Path, request: &SaveRequest) -> FileEvent {
    match write_atomically(path, &request.bytes) {
        Ok(()) if request.note.is_empty() => FileEvent::Said(format!("Saved {}.", path.display())),
        Ok(()) => FileEvent::Said(format!("Saved {}: {}.", path.display(), request.note)),
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

/// The processor's name, where the system keeps it in a file.
pub fn processor() -> Option<String> {
    let facts = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = facts.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(": ")?.1.trim().to_owned())
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
