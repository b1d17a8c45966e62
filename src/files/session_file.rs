//! Sessions as files: opened in place of the document, saved unless another program wrote to the file; templates.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chromascope_core::query::Shared;

use super::document_file::{DocumentFile, Unread, Unwritten, read};
use super::event::{DocumentSource, FileEvent, Note, OpenedDocument};
use super::folder::free_copy;
use super::request::MakeBytes;
use super::{Files, template_name};
use crate::atomic::{sweep, write_atomically};
use crate::document::imported::{Fingerprint, ImportedSet};
use crate::document::{Document, SessionFile, session};
use crate::format::{io_failure, io_reason};

/// The folder of the user's templates, in that of the program.
const TEMPLATES: &str = "templates";

impl Files {
    /// Reads a document to replace this one, which is saved in a file of its own before unless it `is_safe`. `recent` are the files opened lately, among which those that it names are looked for.
    pub fn open_document(&self, source: DocumentSource, before: Document, is_safe: bool, recent: Vec<PathBuf>) {
        let folder = self.autosave.folder().map(Path::to_owned);
        self.in_background(move || [Note::Event(opened(source, before, is_safe, folder.as_deref(), &recent))]);
    }

    /// Reads the file of the session that the program begins with, to know whether it holds the same.
    pub fn look_at_session(&self, document: Document) {
        self.in_background(move || {
            let file = document.session.clone()?;
            file.path.parent().into_iter().for_each(sweep);
            let (kept, fingerprint) = read(&file.path).ok()?;
            let there = Document { session: Some(file.clone()), unknown: document.unknown.clone(), ..kept.document };
            // A program that was killed just after it wrote the file did not note that it had.
            let is_known = fingerprint == file.fingerprint || there.is_same_session(&document);
            let file = SessionFile { fingerprint, ..file };
            is_known.then(|| Note::Event(FileEvent::SessionKnown(file, Arc::new(there))))
        });
    }

    /// Writes a session to its file, unless the file is not as this window knows it; `replaces` writes in any case.
    pub fn save_session(&self, file: SessionFile, document: Arc<Document>, make: MakeBytes, replaces: bool) {
        self.in_background(move || {
            let event = match make() {
                Ok(bytes) => saved(file, document, &bytes, replaces),
                Err(why) => FileEvent::SessionFailed(why),
            };
            [Note::Event(event)]
        });
    }

    pub fn templates(&self) -> Vec<(String, PathBuf)> {
        let entries =
            self.template_folder().and_then(|folder| fs::read_dir(folder).ok()).into_iter().flatten().flatten();
        let paths = entries.map(|entry| entry.path()).filter(|path| is_session_name(path));
        let mut named: Vec<_> = paths.map(|path| (DocumentSource::Template(path.clone()).name(), path)).collect();
        named.sort();
        named
    }

    pub fn save_template(&self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let folder = self.template_folder().ok_or("there is no folder for templates")?;
        let path = folder.join(format!("{}.{}", template_name(name), session::ENDING));
        fs::create_dir_all(&folder).map_err(|error| io_failure(&folder, &error))?;
        write_atomically(&path, bytes).map_err(|error| io_failure(&path, &error))
    }

    pub fn remove_template(&self, path: &Path) {
        let removed = fs::remove_file(path).map_err(|error| format!("{}.", io_failure(path, &error)));
        self.note(Note::Event(
            removed.map_or_else(FileEvent::Failed, |()| FileEvent::Said(format!("{} was deleted.", path.display()))),
        ));
    }

    fn template_folder(&self) -> Option<PathBuf> {
        Some(self.autosave.folder()?.join(TEMPLATES))
    }
}

pub(super) fn is_session_name(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(session::ENDING))
}

fn opened(
    source: DocumentSource,
    before: Document,
    is_safe: bool,
    folder: Option<&Path>,
    recent: &[PathBuf],
) -> FileEvent {
    let name = source.name();
    let mut other = Vec::new();
    let (mut document, lost, newer) = match &source {
        DocumentSource::New(_, document) => ((**document).clone(), Vec::new(), None),
        DocumentSource::File(path) | DocumentSource::Template(path) => match read(path) {
            Ok((mut kept, fingerprint)) => {
                // A document of this program's folder belongs to the session that it names itself.
                if folder.is_none_or(|own| path.parent() != Some(own)) {
                    let path = std::path::absolute(path).unwrap_or_else(|_| path.clone());
                    other = connect(&mut kept.document, path.parent().unwrap_or(&path), recent);
                    // A file of a newer version is not written over.
                    let is_file = matches!(source, DocumentSource::File(_)) && is_session_name(&path);
                    kept.document.session =
                        (is_file && kept.newer.is_none()).then_some(SessionFile { path, fingerprint });
                }
                (kept.document, kept.lost, kept.newer)
            }
            Err(Unread::Missing) => return FileEvent::Failed(format!("{} no longer exists.", path.display())),
            Err(Unread::Because(why)) => return FileEvent::Failed(format!("{name} could not be opened: {why}.")),
        },
    };
    let is_same = document.session == before.session && document.is_same_session(&before);
    if matches!(source, DocumentSource::File(_)) && is_same {
        return FileEvent::Said(format!("{name} is the current document."));
    }
    if !lost.is_empty() {
        // What could not be read is not written over.
        document.session = None;
    }
    let is_untouched = before == before.start.document();
    let aside = !is_safe && !is_untouched;
    let copy = folder.filter(|_| aside).map(|folder| DocumentFile::new(free_copy(folder)).write(&before));
    match copy.unwrap_or(Ok(())) {
        Ok(()) => FileEvent::Document(Box::new(OpenedDocument { source, document, newer, aside, lost, other, before })),
        Err(Unwritten { why, .. }) => {
            FileEvent::Failed(format!("{name} was not opened because the current document could not be saved: {why}."))
        }
    }
}

/// Finds the files that a session names: where it says, beside it, or among those opened lately. A set follows a file that has the
/// contents it was made of. Returns the files that have others.
fn connect(document: &mut Document, folder: &Path, recent: &[PathBuf]) -> Vec<PathBuf> {
    let places = |path: Option<&PathBuf>, name: &std::ffi::OsStr| -> Vec<PathBuf> {
        let lately = recent.iter().filter(|recent| recent.file_name() == Some(name)).cloned();
        let places = path.cloned().into_iter().chain([folder.join(name)]).chain(lately);
        places.filter(|place| place.is_absolute() && place.is_file()).collect()
    };
    let mut other: Vec<PathBuf> = Vec::new();
    for set in &mut document.own {
        let Some(fingerprint) = set.fingerprint else { continue };
        let there = places(set.path.as_ref(), std::ffi::OsStr::new(&set.file));
        let is_it = |path: &&PathBuf| {
            let is_small = fs::metadata(path).is_ok_and(|facts| facts.len() <= spectral_file::MAX_BYTES as u64);
            is_small && fs::read(path).is_ok_and(|bytes| Fingerprint::of(&bytes) == fingerprint)
        };
        let path = there.iter().find(is_it).cloned();
        if path.is_none() {
            let differs = there.into_iter().next().filter(|place| !other.contains(place));
            other.extend(differs);
        }
        if path != set.path {
            *set = Shared::new(ImportedSet { path, ..(**set).clone() });
        }
    }
    if let Some(path) = document.render.mesh.file_mut()
        && let Some(there) = path.file_name().and_then(|name| places(Some(path), name).into_iter().next())
    {
        *path = there;
    }
    other
}

fn saved(file: SessionFile, document: Arc<Document>, bytes: &[u8], replaces: bool) -> FileEvent {
    match write_unless_changed(&file, bytes, replaces) {
        Ok(true) => {
            let file = SessionFile { fingerprint: Fingerprint::of(bytes), ..file };
            FileEvent::SessionSaved(file, document)
        }
        Ok(false) => FileEvent::SessionChanged(file.path),
        Err(error) => FileEvent::SessionFailed(format!(
            "Cannot write {}: {}. Your work is safe in this window; File, Save as saves it elsewhere.",
            file.path.display(),
            io_reason(&error)
        )),
    }
}

/// Writes a file and returns true, unless its contents are other than known. Two windows that save at the same time come one
/// after the other: the file is locked from the comparison to the end.
fn write_unless_changed(file: &SessionFile, bytes: &[u8], replaces: bool) -> io::Result<bool> {
    let there = match fs::OpenOptions::new().read(true).write(true).open(&file.path) {
        Ok(there) => Some(there),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    file.path.parent().into_iter().for_each(sweep);
    if let Some(there) = &there {
        // Where there are no locks, the comparison alone must do.
        let _unlocked = there.lock();
        let now = fs::read(&file.path)?;
        if !replaces && Fingerprint::of(&now) != file.fingerprint && now != bytes {
            return Ok(false);
        }
    }
    write_atomically(&file.path, bytes)?;
    Ok(true)
}
