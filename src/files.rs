//! Files in and out: dialogs, reading, atomic writing, the document kept between runs.
//!
//! Dialogs, reads and writes run on threads of their own and come back through [`Files::poll`]; the window never waits.

mod asking;
mod dialogs;
mod keep;
mod profile;
mod prompt;
mod save;
mod watch;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use crate::document::Document;
use crate::document::start::Start;

pub use dialogs::{Answer, DialogLog, Dialogs, Question};
pub use keep::{install_panic_hook, panic_saves};
pub use prompt::PathPrompt;
pub use save::{FileForm, SaveRequest};

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

/// What a thread says.
enum Note {
    Event(FileEvent),
    Answered(u64, Answer, Option<SaveRequest>),
    ToSave(SaveRequest),
    NotMade(String),
    NotSaved(PathPrompt),
    Completed(prompt::Completed),
}

/// The only part of the window that touches the disk.
pub struct Files {
    sender: Sender<Note>,
    receiver: Receiver<Note>,
    keeper: keep::Keeper,
    prompt: Option<PathPrompt>,
    /// The system's dialogs; none where paths are asked for in the window alone.
    dialogs: Option<Arc<dyn Dialogs>>,
    waiting: Option<asking::Waiting>,
    /// Whether something that is to be saved is being made.
    making: bool,
    /// How many files that are being made are no longer wanted.
    unwanted: usize,
    /// The number of the last dialog.
    ticket: u64,
    home: Option<PathBuf>,
    wake: Option<egui::Context>,
    watch: watch::Watch,
}

impl Files {
    /// With the folder that the document is kept in between runs, if any. It is this window's until it closes.
    pub fn new(folder: Option<PathBuf>) -> Self {
        let (sender, receiver) = channel();
        Self {
            sender,
            receiver,
            keeper: keep::Keeper::new(folder),
            prompt: None,
            dialogs: Some(Arc::new(dialogs::System)),
            waiting: None,
            making: false,
            unwanted: 0,
            ticket: 0,
            home: std::env::home_dir(),
            wake: None,
            watch: watch::Watch::new(None),
        }
    }

    /// Asks for paths in the window alone, as where the system has no dialogs.
    #[must_use]
    pub fn without_dialogs(self) -> Self {
        Self { dialogs: None, ..self }
    }

    /// Asks for paths with other dialogs than the system's.
    #[must_use]
    pub fn with_dialogs(self, dialogs: Arc<dyn Dialogs>) -> Self {
        Self { dialogs: Some(dialogs), ..self }
    }

    /// Takes another folder for `~`.
    #[must_use]
    pub fn with_home(self, home: PathBuf) -> Self {
        Self { home: Some(home), ..self }
    }

    /// Has the window drawn when something comes back.
    pub fn wake(&mut self, ctx: &egui::Context) {
        self.wake = Some(ctx.clone());
        self.watch = watch::Watch::new(Some(ctx.clone()));
    }

    /// The document as it was kept, else the first screen.
    pub fn kept_document(&mut self) -> Document {
        if self.keeper.is_first_run() {
            let words = format!(
                "Start: {}. The other start is one click away, in the Inspector or under Edit.",
                Start::default().name()
            );
            self.note(Note::Event(FileEvent::Said(words)));
        }
        let (document, message) = self.keeper.load();
        if let Some(message) = message {
            self.note(Note::Event(FileEvent::Failed(message)));
        }
        let copies: Vec<String> = self.keeper.copies().iter().map(|path| path.display().to_string()).collect();
        if !copies.is_empty() {
            let words = format!(
                "The document of another window is kept in {}. To use it, close Chromascope and rename it to document.json; \
                 delete it if it is not needed.",
                copies.join(" and ")
            );
            self.note(Note::Event(FileEvent::Said(words)));
        }
        document
    }

    /// Where this window keeps its document while another one has the profile: a sentence that stays on screen, and the file.
    pub fn copy(&self) -> Option<(String, &Path)> {
        let (other, file) = self.keeper.other()?;
        let process = other.process.map_or_else(String::new, |process| format!(" (process {process})"));
        let words = format!(
            "Another Chromascope window{process} is open: changes here are kept in a copy, not in its document."
        );
        Some((words, file))
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
            if self.unwanted > 0 && matches!(note, Note::ToSave(_) | Note::NotMade(_)) {
                self.unwanted -= 1;
                continue;
            }
            match note {
                Note::Event(event) => events.push(event),
                Note::Answered(ticket, answer, request) => self.answered(ticket, answer, request),
                Note::ToSave(request) => {
                    self.making = false;
                    self.ask_to_save(request);
                }
                Note::NotMade(sentence) => {
                    self.making = false;
                    events.push(FileEvent::Failed(sentence));
                }
                // What was asked for meanwhile goes first.
                Note::NotSaved(prompt) => self.prompt = self.prompt.take().or(Some(prompt)),
                Note::Completed(done) => self.completed(done),
            }
        }
        events
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
        // It is taken in with the next frame.
        if let Some(ctx) = &self.wake {
            ctx.request_repaint();
        }
    }
}

/// The system's reason without its error number.
pub fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    let end = text.find(" (os error").unwrap_or(text.len());
    text[..end].to_lowercase()
}

/// A file's name of a stem and an ending, the stem cut where both together are longer than file systems take: 255 bytes.
pub fn fitting(stem: &str, ending: &str) -> String {
    const LONGEST: usize = 255;
    let room = LONGEST.saturating_sub(ending.len());
    format!("{}{ending}", &stem[..stem.floor_char_boundary(room)])
}

/// The processor's name, where the system keeps it in a file.
pub fn processor() -> Option<String> {
    let facts = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = facts.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(": ")?.1.trim().to_owned())
}

/// Writes a file whole or not at all: beside it first, then moved into its place.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_atomically_with(path, |file| file.write_all(bytes))
}

/// Writes a file whole or not at all, as its contents are made.
pub fn write_atomically_with(path: &Path, write: impl FnOnce(&mut dyn io::Write) -> io::Result<()>) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".chromascope-");
    // A temporary file is private else; what is saved is as readable as any new file, so the system's mask applies.
    #[cfg(unix)]
    let builder = {
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(fs::Permissions::from_mode(0o666))
    };
    let mut file = builder.tempfile_in(folder)?;
    write(file.as_file_mut())?;
    file.as_file().sync_all()?;
    // What takes the place of a file is as readable as that was.
    if cfg!(unix)
        && let Ok(known) = fs::metadata(path)
    {
        file.as_file().set_permissions(known.permissions())?;
    }
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}
