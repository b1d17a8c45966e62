//! All that lies on disk: dialogs, reading, atomic writing, sessions, the document saved between runs.
//!
//! Dialogs, reads and writes run on their own threads and return through [`Files::poll`]; the window never waits.

mod asking;
mod autosave;
mod between_runs;
mod dialogs;
mod document_file;
mod event;
mod folder;
mod motion;
mod request;
mod session_file;
mod watch;

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use crate::atomic::fitting;
use crate::jobs::Executor;
use event::Note;

pub use autosave::{install_panic_hook, save_on_exit, save_on_signals};
pub use between_runs::{PersistentMessage, PersistentMessageKind};
pub use dialogs::{Answer, DialogLog, Dialogs, Question};
pub use event::{DocumentSource, FileEvent, OpenedDocument, SavedFile};
pub use motion::reduces_motion;
pub use request::{FileForm, MakeBytes, PathPrompt, SaveRequest};

/// The only part of the window that touches the disk.
pub struct Files {
    sender: Sender<Note>,
    receiver: Receiver<Note>,
    autosave: autosave::Autosave,
    prompt: Option<PathPrompt>,
    /// The system's dialogs; none where paths are requested in the window alone.
    dialogs: Option<Arc<dyn Dialogs>>,
    waiting: Option<asking::Waiting>,
    /// True while something to be saved is being computed.
    making: bool,
    /// Number of canceled computations of files that are still running.
    unwanted: usize,
    ticket: u64,
    home: Option<PathBuf>,
    wake: Option<egui::Context>,
    watch: watch::Watch,
    standing: between_runs::Notices,
    layout: Option<String>,
}

impl Files {
    /// Creates it with the folder in which the document is saved between runs, if any. The folder is locked by this
    /// window until it closes.
    pub fn new(folder: Option<PathBuf>) -> Self {
        Self::on(&Executor::default(), folder)
    }

    pub fn on(executor: &Executor, folder: Option<PathBuf>) -> Self {
        let (sender, receiver) = channel();
        Self {
            sender,
            receiver,
            autosave: autosave::Autosave::new(executor, folder),
            prompt: None,
            dialogs: Some(Arc::new(dialogs::System)),
            waiting: None,
            making: false,
            unwanted: 0,
            ticket: 0,
            home: std::env::home_dir(),
            wake: None,
            watch: watch::Watch::new(None),
            standing: between_runs::Notices::default(),
            layout: None,
        }
    }

    #[must_use]
    pub fn without_dialogs(self) -> Self {
        Self { dialogs: None, ..self }
    }

    #[must_use]
    pub fn with_dialogs(self, dialogs: Arc<dyn Dialogs>) -> Self {
        Self { dialogs: Some(dialogs), ..self }
    }

    #[must_use]
    pub fn with_home(self, home: Option<PathBuf>) -> Self {
        Self { home, ..self }
    }

    /// Has the window drawn when something comes back.
    pub fn wake(&mut self, ctx: &egui::Context) {
        self.wake = Some(ctx.clone());
        self.watch = watch::Watch::new(Some(ctx.clone()));
    }

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
                // What was requested meanwhile goes first.
                Note::NotSaved(prompt) => self.prompt = self.prompt.take().or(Some(prompt)),
                Note::Completed(done) => self.completed(done),
            }
        }
        events
    }

    pub fn watch(&mut self, files: std::collections::BTreeSet<PathBuf>) {
        self.watch.files(files);
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
        // It is processed in the next frame.
        if let Some(ctx) = &self.wake {
            ctx.request_repaint();
        }
    }
}

/// Makes a folder of a name in another one; where there is one, a number is added.
pub fn new_folder(parent: &std::path::Path, name: &str) -> std::io::Result<PathBuf> {
    let numbered = (2..).map(|number| format!("{name} {number}"));
    for name in std::iter::once(name.to_owned()).chain(numbered) {
        let folder = parent.join(name);
        match std::fs::create_dir(&folder) {
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
            made => return made.map(|()| folder),
        }
    }
    unreachable!("numbers do not end")
}

/// Name of a template as its file has it, for a name that was typed.
pub fn template_name(typed: &str) -> String {
    let fits = |c: char| if c.is_control() || "/\\:*?\"<>|".contains(c) { '-' } else { c };
    let name: String = typed.trim().chars().map(fits).collect();
    let ending = format!(".{}", crate::document::session::ENDING);
    let file = fitting(name.trim_start_matches('.'), &ending);
    file.strip_suffix(&ending).unwrap_or(&file).to_owned()
}
