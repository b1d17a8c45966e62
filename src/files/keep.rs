//! Keeping the document between runs, and when the program breaks.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::profile::{OtherWindow, Profile};
use super::write_atomically;
use crate::document::{Document, session};

/// A document is written this long after its last change.
const REST: Duration = Duration::from_secs(2);

/// What the panic hook saves: the last document seen, and where.
static LAST: Mutex<Option<(PathBuf, Document)>> = Mutex::new(None);

/// Writes the document to the program's folder.
#[derive(Debug)]
pub(super) struct Keeper {
    profile: Profile,
    seen: Option<Document>,
    saved: Option<Document>,
    changed: Instant,
    /// Writes beside the window: a document may hold many curves.
    writer: Option<JoinHandle<Result<(), String>>>,
}

impl Keeper {
    pub(super) fn new(folder: Option<PathBuf>) -> Self {
        Self { profile: Profile::claim(folder), seen: None, saved: None, changed: Instant::now(), writer: None }
    }

    /// The window that has the profile, where it is not this one, and the file of this one's copy.
    pub(super) fn other(&self) -> Option<(OtherWindow, &Path)> {
        self.profile.other.zip(self.profile.file.as_deref())
    }

    /// Documents that other windows kept beside this one's.
    pub(super) fn copies(&self) -> Vec<PathBuf> {
        self.profile.copies()
    }

    /// Whether no document was kept before, by this window or another.
    pub(super) fn is_first_run(&self) -> bool {
        self.profile.first.as_ref().is_some_and(|file| !file.exists())
    }

    /// The document kept, or the first screen; with a sentence where one was there and could not be read.
    pub(super) fn load(&mut self) -> (Document, Option<String>) {
        let text = self.profile.first.as_ref().and_then(|file| fs::read_to_string(file).ok());
        let (document, complaint) = match text.map(|text| session::from_json(&text)) {
            None => (Document::default(), None),
            Some(Ok(document)) => (document, None),
            // What is another window's is left to it.
            Some(Err(error)) if self.profile.other.is_some() => {
                (Document::default(), Some(format!("The other window's document cannot be read ({error}).")))
            }
            Some(Err(error)) => (Document::default(), Some(self.set_aside(&error.to_string()))),
        };
        // What is opened before the first frame is a change already.
        self.saved = Some(document.clone());
        (document, complaint)
    }

    /// A kept document that cannot be read is not overwritten.
    fn set_aside(&self, why: &str) -> String {
        let file = self.profile.file.clone().unwrap_or_default();
        let aside = file.with_extension("unreadable.json");
        match fs::rename(&file, &aside) {
            Ok(()) => format!("What was kept of the last run cannot be read ({why}). It is now {}.", aside.display()),
            Err(error) => format!("What was kept of the last run cannot be read ({why}; {error})."),
        }
    }

    /// Notes a change, and writes it when the document has come to rest.
    pub(super) fn watch(&mut self, document: &Document, ctx: &egui::Context) -> Result<(), String> {
        let Some(file) = self.profile.file.clone() else { return Ok(()) };
        if self.seen.as_ref() != Some(document) {
            self.seen = Some(document.clone());
            self.changed = Instant::now();
            *LAST.lock().unwrap_or_else(PoisonError::into_inner) = Some((file.clone(), document.clone()));
        }
        if self.writer.as_ref().is_some_and(JoinHandle::is_finished) {
            self.written()?;
        }
        if self.saved.as_ref() == Some(document) {
            return Ok(());
        }
        let rested = self.changed.elapsed();
        if rested < REST {
            ctx.request_repaint_after(REST.saturating_sub(rested));
            return Ok(());
        }
        if self.writer.is_some() {
            ctx.request_repaint_after(REST);
            return Ok(());
        }
        // Failing again and again would only fill the log.
        self.saved = Some(document.clone());
        let (document, ctx) = (document.clone(), ctx.clone());
        let work = move || {
            let result = write(&file, &document);
            ctx.request_repaint();
            result
        };
        match thread::Builder::new().name("keep".to_owned()).spawn(work) {
            Ok(writer) => self.writer = Some(writer),
            Err(error) => return Err(format!("no thread for writing: {error}")),
        }
        Ok(())
    }

    /// Waits for what is being written, and says what came of it.
    fn written(&mut self) -> Result<(), String> {
        self.writer.take().map_or(Ok(()), |writer| writer.join().unwrap_or_else(|_| Err("writing failed".to_owned())))
    }

    /// Writes the document now, unless it is as it was written.
    pub(super) fn save(&mut self, document: &Document) -> Result<(), String> {
        let before = self.written();
        let Some(file) = self.profile.file.clone() else { return Ok(()) };
        if self.saved.as_ref() == Some(document) && before.is_ok() {
            return Ok(());
        }
        // Failing again and again would only fill the log.
        self.saved = Some(document.clone());
        write(&file, document)
    }
}

fn write(file: &Path, document: &Document) -> Result<(), String> {
    let json = session::to_json(document).map_err(|error| error.to_string())?;
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    write_atomically(file, json.as_bytes()).map_err(|error| format!("{}: {error}", file.display()))
}

/// Saves the last document seen, for a program that is about to end. Returns where, if it could.
pub fn panic_saves() -> Option<PathBuf> {
    // Never waits: the thread that holds the lock may be the one that broke.
    let last = LAST.try_lock().ok()?.clone();
    let (file, document) = last?;
    write(&file, &document).ok()?;
    Some(file)
}

/// Before a panic is reported, the document is saved.
pub fn install_panic_hook() {
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if let Some(file) = panic_saves() {
            log::error!("the document was saved to {}", file.display());
        }
        report(info);
    }));
}
