//! Files in and out: dialogs, reading, atomic writing, the document kept between runs.
//!
//! Dialogs, reads and writes run on threads of their own and come back through [`Files::poll`]; the window never waits.

mod asking;
mod dialogs;
mod keep;
mod kept;
mod last;
mod profile;
mod prompt;
mod save;
mod standing;
mod store;
mod watch;

use std::ffi::OsStr;
use std::fs;
use std::io::{self, Seek as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, SystemTime};

use tempfile::NamedTempFile;

use crate::jobs::Executor;

pub use dialogs::{Answer, DialogLog, Dialogs, Question};
pub use kept::Opened as OpenedDocument;
pub use last::{install_panic_hook, save_last, save_on_exit, save_on_signals};
pub use profile::Copy;
pub use prompt::PathPrompt;
pub use save::{FileForm, SaveRequest};
pub use standing::{Standing, StandingKind};

/// The beginning of names of files that are being written.
const TEMPORARY: &str = ".chromascope-";
/// So many letters and digits follow it.
const RANDOM: usize = 6;

/// Result of a dialog, a read or a write.
#[derive(Debug)]
pub enum FileEvent {
    /// Files or folders are to be opened.
    Open(Vec<PathBuf>),
    /// Files changed on disk.
    Changed(Vec<PathBuf>),
    /// Something to know.
    Said(String),
    /// A file was written: a sentence, and the description of what is in it.
    Saved(String, String),
    /// A document was read, and the one before it kept.
    Document(Box<kept::Opened>),
    /// Something failed; nothing was changed.
    Failed(String),
}

/// Message of a thread.
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
    /// True while something to be saved is being computed.
    making: bool,
    /// Number of files being computed that are no longer wanted.
    unwanted: usize,
    /// The number of the last dialog.
    ticket: u64,
    home: Option<PathBuf>,
    wake: Option<egui::Context>,
    watch: watch::Watch,
    standing: standing::Notices,
    /// The layout as it was written last.
    layout: Option<String>,
}

impl Files {
    /// With the folder that the document is kept in between runs, if any. It is this window's until it closes.
    pub fn new(folder: Option<PathBuf>) -> Self {
        Self::on(&Executor::default(), folder)
    }

    /// Has an executor keep the document.
    pub fn on(executor: &Executor, folder: Option<PathBuf>) -> Self {
        let (sender, receiver) = channel();
        Self {
            sender,
            receiver,
            keeper: keep::Keeper::new(executor, folder),
            prompt: None,
            dialogs: Some(Arc::new(dialogs::System)),
            waiting: None,
            making: false,
            unwanted: 0,
            ticket: 0,
            home: std::env::home_dir(),
            wake: None,
            watch: watch::Watch::new(None),
            standing: standing::Notices::default(),
            layout: None,
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

    /// Events since the last query.
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

/// Writes a file whole or not at all: beside it first, then moved into its place. It is flushed to the disk before it takes its
/// name, and its folder after it.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_atomically_with(path, |file| file.write_all(bytes))
}

/// Writes a file whole or not at all, as its contents are made.
pub fn write_atomically_with(path: &Path, write: impl FnOnce(&mut dyn io::Write) -> io::Result<()>) -> io::Result<()> {
    // What a link leads to is written, and the link stays.
    let target = match fs::canonicalize(path) {
        Ok(target) => target,
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        Err(_) if fs::symlink_metadata(path).is_ok() => {
            return Err(io::Error::new(io::ErrorKind::NotFound, "it is a link to a file that is not there"));
        }
        Err(_) => path.to_owned(),
    };
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = temporary(folder)?;
    write(file.as_file_mut())?;
    finish(&file, &target)?;
    file.persist(&target).map(drop).or_else(|error| again(error, folder, &target))?;
    // The file is in its place; some systems cannot flush a folder.
    #[cfg(unix)]
    if let Err(error) = fs::File::open(folder).and_then(|folder| folder.sync_all()) {
        log::debug!("{} could not be flushed: {error}", folder.display());
    }
    Ok(())
}

/// Makes a file that is to take the place of another, and locks it: it is being written.
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY).rand_bytes(RANDOM);
    // A temporary file is private else; what is saved is as readable as any new file, so the system's mask applies.
    #[cfg(unix)]
    let builder = {
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(fs::Permissions::from_mode(0o666))
    };
    let file = builder.tempfile_in(folder)?;
    // Where there are no locks, nothing is swept either.
    let _unlocked = file.as_file().try_lock();
    Ok(file)
}

/// Makes a file as readable as the one that it takes the place of, and flushes it.
fn finish(file: &NamedTempFile, target: &Path) -> io::Result<()> {
    if cfg!(unix)
        && let Ok(known) = fs::metadata(target)
    {
        file.as_file().set_permissions(known.permissions())?;
    }
    file.as_file().sync_all()
}

/// Writes a file once more whose name another program removed before it was in its place.
fn again(error: tempfile::PersistError, folder: &Path, target: &Path) -> io::Result<()> {
    if error.error.kind() != io::ErrorKind::NotFound {
        return Err(error.error);
    }
    let mut gone = error.file;
    gone.as_file_mut().rewind()?;
    let mut file = temporary(folder)?;
    io::copy(gone.as_file_mut(), file.as_file_mut())?;
    finish(&file, target)?;
    file.persist(target).map(drop).map_err(|error| error.error)
}

/// Removes what a process that was killed was writing in a folder of the program's. What is being written is locked, or about
/// to be.
fn sweep(folder: &Path) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries.filter(|entry| is_temporary(&entry.file_name())) {
        let path = entry.path();
        // Network folders lock only what is open for writing.
        let is_free = || {
            let file = fs::OpenOptions::new().read(true).write(true).open(&path);
            file.is_ok_and(|file| file.try_lock().is_ok())
        };
        // One that another window has made but not locked yet is made again by that window.
        if entry.file_type().is_ok_and(|kind| kind.is_file()) && is_free() {
            let _gone = fs::remove_file(&path);
        }
    }
}

/// True if a file was last written more than some time ago.
fn is_older(path: &Path, age: Duration, now: SystemTime) -> bool {
    let modified = fs::symlink_metadata(path).and_then(|facts| facts.modified()).ok();
    modified.and_then(|modified| now.duration_since(modified).ok()).is_some_and(|past| past > age)
}

/// True if a name is one of those that [`temporary`] makes.
fn is_temporary(name: &OsStr) -> bool {
    let random = name.to_str().and_then(|name| name.strip_prefix(TEMPORARY));
    random.is_some_and(|random| random.len() == RANDOM && random.bytes().all(|byte| byte.is_ascii_alphanumeric()))
}
