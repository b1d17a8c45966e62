//! Reading of files and folders from disk, each with the user's settings for its kind.

use std::fs;
use std::io::{self, Read as _};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use spectral_file::{MAX_BYTES, ReadError, Watch};

use super::{Failing, Job, Monitor, OpenFile, OpenedEvent, Why};
use crate::catalog::file_store;
use crate::catalog::folders::{FolderFiles, NO_SPECTRA, leave_companions_out};
use crate::catalog::import::{Imported, Origin, import_as};
use crate::catalog::meshes::is_mesh;
use crate::catalog::narrow_bands::{is_pass, read_pass};
use crate::catalog::spectral_images::{is_same_image, is_spectral_image};
use crate::document::imported::{Fingerprint, ImportOverrides, ImportedSet};
use crate::document::measurement::MeasuredPass;
use crate::document::session::{self, is_session};
use crate::format::{Tally, file_name, io_failure, io_reason};

/// Number of bytes examined to distinguish a mesh from spectra.
const LOOK: usize = 1 << 16;
const MAX_FILES: usize = 1000;

#[derive(Clone, Debug)]
pub enum Request {
    /// A file or a folder on disk.
    Path(PathBuf),
    /// Bytes from elsewhere, the clipboard or a drop without a file, with the name of the files together.
    Bytes { name: String, bytes: Arc<[u8]> },
    /// A file whose contents are known, with the user's settings.
    Known(Fingerprint, Box<ImportOverrides>),
}

#[derive(Default)]
struct Harvest {
    sets: Vec<Imported>,
    passes: Vec<MeasuredPass>,
    failures: Vec<String>,
    failed: Vec<Fingerprint>,
    paths: Vec<PathBuf>,
    /// Meshes, spectral images and documents, which are only named.
    named: Vec<OpenedEvent>,
    notes: Vec<String>,
    skipped: Tally,
    count: usize,
    /// True if there is a folder among them, of which only spectra are opened if it has any.
    has_folder: bool,
    /// True if they were known before, such as the parts of one.
    from_memory: bool,
}

/// Reads one after the other; what cannot be read changes nothing. A mesh is only named: what shows it reads it.
pub(super) fn open(
    requests: Vec<Request>,
    remembered: &dyn Fn(&[u8]) -> ImportOverrides,
    monitor: &Monitor,
    job: &Job,
) -> Vec<OpenedEvent> {
    let mut harvest = Harvest::default();
    let requests = expand(requests, &|| job.go_on(0.0), &mut harvest);
    let count = requests.len();
    harvest.count = count;
    for (index, request) in requests.into_iter().enumerate() {
        if !job.go_on(0.0) {
            break;
        }
        let (origin, bytes, overrides) = match contents(request, monitor, job, (index + 1, count)) {
            Ok(Some(contents)) => contents,
            Ok(None) => continue,
            Err(Unread::Named(event)) => {
                // Header and data are one image.
                let same = |known: &OpenedEvent| match (known, &event) {
                    (OpenedEvent::Image(known), OpenedEvent::Image(path)) => is_same_image(known, path),
                    _ => false,
                };
                if !harvest.named.iter().any(same) {
                    harvest.named.push(event);
                }
                continue;
            }
            Err(Unread::Because(sentence)) => {
                harvest.failures.push(sentence);
                continue;
            }
        };
        if overrides.is_none() && is_pass(&bytes) {
            let folder = origin.path.as_deref().and_then(Path::parent);
            match read_pass(&bytes, folder, None, &|| job.go_on(0.0)) {
                Ok((bands, pictures)) => {
                    let contents = origin.fingerprint;
                    harvest.passes.push(MeasuredPass { file: origin.name, contents, bands, pictures });
                }
                Err(error) => harvest.failures.push(format!("{}: {error}", origin.name)),
            }
            continue;
        }
        harvest.from_memory |= overrides.is_some();
        let from_memory = overrides.is_none();
        let overrides = overrides.unwrap_or_else(|| remembered(&bytes));
        take(origin, bytes, (&overrides, from_memory), monitor, job, &mut harvest);
    }
    // The canceled request needs no result.
    if job.go_on(0.0) { harvest.into_events() } else { Vec::new() }
}

/// Folders become the files in them, at any depth.
fn expand(requests: Vec<Request>, go_on: &dyn Fn() -> bool, harvest: &mut Harvest) -> Vec<Request> {
    let mut all = Vec::new();
    for request in requests {
        let Request::Path(path) = request else {
            all.push(request);
            continue;
        };
        // A relative path would mean another file after a start from elsewhere.
        let path = std::path::absolute(&path).unwrap_or(path);
        if !path.is_dir() {
            all.push(Request::Path(path));
            continue;
        }
        harvest.has_folder = true;
        match FolderFiles::new(&path, go_on) {
            Ok(mut found) => {
                if found.files.len() > MAX_FILES {
                    let note = format!("Of {} files the first {MAX_FILES} were read.", found.files.len());
                    harvest.notes.push(note);
                }
                harvest.skipped.0.append(&mut found.skipped.0);
                all.extend(found.files.into_iter().take(MAX_FILES).map(Request::Path));
            }
            Err(error) => harvest.failures.push(io_failure(&path, &error)),
        }
    }
    let path = |request: &Request| if let Request::Path(path) = request { Some(path.clone()) } else { None };
    leave_companions_out(&mut all, path, &mut harvest.skipped);
    all
}

enum Unread {
    /// What is to be opened by others.
    Named(OpenedEvent),
    Because(String),
}

type Contents = (Origin, Arc<[u8]>, Option<ImportOverrides>);

fn contents(
    request: Request,
    monitor: &Monitor,
    job: &Job,
    (file, count): (usize, usize),
) -> Result<Option<Contents>, Unread> {
    match request {
        Request::Known(fingerprint, overrides) => {
            let known = monitor.lock().file(fingerprint).cloned();
            Ok(known.map(|file| (file.origin, file.bytes, Some(*overrides))))
        }
        Request::Bytes { name, bytes } => {
            job.at(Path::new(&name), file, count);
            if is_mesh(Path::new(&name), &bytes[..bytes.len().min(LOOK)]) {
                let sentence =
                    format!("{name}: a session stores the path of a mesh, so the mesh must be on disk; save it first");
                return Err(Unread::Because(sentence));
            }
            Ok(Some((Origin::named(&name, &bytes), bytes, None)))
        }
        Request::Path(path) => {
            let path = known_path(path, monitor);
            job.at(&path, file, count);
            let beginning = beginning(&path);
            let is_named = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(session::ENDING));
            if is_named && path.is_file() || is_session(&beginning) {
                return Err(Unread::Named(OpenedEvent::Document(path)));
            }
            if is_mesh(&path, &beginning) {
                return Err(Unread::Named(OpenedEvent::Mesh(path)));
            }
            if is_spectral_image(&path) {
                return Err(Unread::Named(OpenedEvent::Image(path)));
            }
            let bytes = read_bytes(&path).map_err(Unread::Because)?;
            Ok(Some((origin(&path, &bytes), bytes, None)))
        }
    }
}

/// The path under which a file is already known, if this one leads to it through links.
fn known_path(path: PathBuf, monitor: &Monitor) -> PathBuf {
    let Ok(whole) = fs::canonicalize(&path) else { return path };
    let state = monitor.lock();
    let is_known = state.files.iter().any(|file| file.origin.path.as_ref() == Some(&whole));
    if is_known { whole } else { path }
}

fn origin(path: &Path, bytes: &[u8]) -> Origin {
    Origin::on_disk(&file_name(path), path, bytes)
}

fn take(
    origin: Origin,
    bytes: Arc<[u8]>,
    (overrides, from_memory): (&ImportOverrides, bool),
    monitor: &Monitor,
    job: &Job,
    harvest: &mut Harvest,
) {
    let fingerprint = origin.fingerprint;
    let mut read = try_once(&origin, &bytes, overrides, job);
    if !job.go_on(0.0) {
        return;
    }
    if from_memory && *overrides != ImportOverrides::default() {
        match &mut read {
            Ok(imported) => {
                imported.message.push_str(" Read with your settings for files of this kind.");
                imported.guessed = true;
            }
            // What fitted another file does not fit this one.
            Err(_) => read = try_once(&origin, &bytes, &ImportOverrides::default(), job),
        }
    }
    let failure = read.as_ref().err().map(|(sentence, _)| sentence.clone());
    match read {
        Ok(imported) => {
            log::info!("opened {}", imported.message);
            harvest.sets.push(imported);
            harvest.paths.extend(origin.path.clone());
        }
        // Of several files, the text beside them is no failure.
        Err((_, true)) if harvest.count > 1 => {
            harvest.skipped.add(NO_SPECTRA, origin.name);
            return;
        }
        Err((sentence, _)) => {
            log::warn!("{sentence}");
            harvest.failures.push(sentence);
            harvest.failed.push(fingerprint);
        }
    }
    monitor.lock().know(OpenFile { origin, bytes, failure });
}

fn read_once(origin: &Origin, bytes: &[u8], overrides: &ImportOverrides, job: &Job) -> Result<Imported, String> {
    try_once(origin, bytes, overrides, job).map_err(|(sentence, _)| sentence)
}

/// Reads; a panic comes out as a failure of this file alone. A failure is a sentence, and whether the file is of another kind than
/// spectra.
fn try_once(origin: &Origin, bytes: &[u8], with: &ImportOverrides, job: &Job) -> Result<Imported, (String, bool)> {
    let go_on = |share: f32| job.go_on(share);
    let read = catch_unwind(AssertUnwindSafe(|| import_as(origin, bytes, with, Watch::new(&go_on))));
    let broken = |_| Err((file_store::Unread::Broken(origin.name.clone()).to_string(), false));
    let failure = |error: ReadError| (unread(&origin.name, &error), error.is_of_no_spectra());
    read.map_or_else(broken, |read| read.map_err(failure))
}

impl Harvest {
    fn into_events(mut self) -> Vec<OpenedEvent> {
        let failure = self.failure();
        let mut events = self.named;
        if self.has_folder && !self.sets.is_empty() && !events.is_empty() {
            self.notes.push(format!("Not opened: {} meshes, images or sessions.", events.len()));
            events.clear();
        }
        if !self.passes.is_empty() {
            events.push(OpenedEvent::Bands(self.passes));
        }
        if !self.skipped.is_empty() || self.has_folder && self.sets.is_empty() {
            self.notes.push(format!("Skipped: {}.", self.skipped));
        }
        events.sort_by_key(|event| match event {
            OpenedEvent::Mesh(_) => 0,
            OpenedEvent::Image(_) => 1,
            _ => 2,
        });
        if self.sets.is_empty() {
            let notes = self.notes.join(" ");
            let none = Some("No spectra were found".to_owned()).filter(|_| events.is_empty() && !notes.is_empty());
            let told = |told| format!("{told}. {notes}").trim_end().to_owned() + " Nothing was changed.";
            let failed = |sentence| OpenedEvent::Failed(told(sentence), self.failed);
            events.extend(failure.or(none).map(failed));
            return events;
        }
        let mut message = match self.sets.as_slice() {
            [one] => one.message.clone(),
            many if !self.from_memory => format!("{} files read.", many.len()),
            many => format!("{} sets read.", many.len()),
        };
        for note in self.notes {
            message = format!("{message} {note}");
        }
        let failure = failure.map_or_else(String::new, |told| format!("{told}."));
        events.push(OpenedEvent::Read { sets: self.sets, message, failure, paths: self.paths, failed: self.failed });
        events
    }

    /// Number of files that could not be read, and the reason for the first.
    fn failure(&self) -> Option<String> {
        let first = self.failures.first()?;
        // A folder that cannot be read is one of those requested.
        let count = self.failures.len() + self.sets.len() + self.passes.len();
        if count == 1 {
            return Some(first.clone());
        }
        Some(format!("{} of {count} files could not be read: {first}", self.failures.len()))
    }
}

/// Adds files that could not be read in an earlier run. One that has changed is not used until the user confirms it.
pub(super) fn recall(failing: Vec<Failing>, monitor: &Monitor, job: &Job) {
    let count = failing.len();
    for (index, Failing { path, fingerprint, why }) in failing.into_iter().enumerate() {
        job.at(&path, index + 1, count);
        let Ok(bytes) = read_bytes(&path) else { continue };
        let origin = origin(&path, &bytes);
        let mut failure = Some(why);
        if origin.fingerprint != fingerprint {
            failure = read_once(&origin, &bytes, &ImportOverrides::default(), job).err();
            let new = origin.fingerprint;
            monitor.lock().events.push(OpenedEvent::Replaced { old: fingerprint, new, path });
        }
        if !job.go_on(0.0) {
            return;
        }
        monitor.lock().know(OpenFile { origin, bytes, failure });
    }
}

/// Reads a set's file again, from disk if that changed, else from memory.
pub(super) fn reread(
    set: &ImportedSet,
    why: Why,
    monitor: &Monitor,
    job: &Job,
) -> Option<(String, Result<Imported, String>)> {
    let name = set.name.clone();
    let known = set.fingerprint.and_then(|fingerprint| monitor.lock().file(fingerprint).cloned());
    let result = match (why, known, &set.path) {
        (Why::Alike, Some(file), _) => read_once(&file.origin, &file.bytes, &set.overrides, job),
        (_, _, Some(path)) => {
            job.at(path, 1, 1);
            read_bytes(path)
                .and_then(|bytes| {
                    let origin = origin(path, &bytes);
                    let same = why == Why::Changed && Some(origin.fingerprint) == set.fingerprint;
                    let read = (!same).then(|| read_once(&origin, &bytes, &set.overrides, job)).transpose();
                    let failure = read.as_ref().err().cloned();
                    monitor.lock().know(OpenFile { origin, bytes, failure });
                    read
                })
                .transpose()?
        }
        _ => return None,
    };
    Some((name, result))
}

/// Reloads a file, if its contents are unchanged.
pub(super) fn fetch(path: &Path, fingerprint: Fingerprint, monitor: &Monitor, job: &Job) {
    job.at(path, 1, 1);
    if let Ok(bytes) = read_bytes(path)
        && Fingerprint::of(&bytes) == fingerprint
    {
        let file = OpenFile { origin: origin(path, &bytes), bytes, failure: None };
        monitor.lock().know(file);
    }
}

/// A file's bytes; the error is a message with its name.
fn read_bytes(path: &Path) -> Result<Arc<[u8]>, String> {
    let name = file_name(path);
    let failed = |error: io::Error| format!("{name}: {}", io_reason(&error));
    let known = fs::metadata(path).map_err(failed)?;
    if !known.is_file() {
        return Err(format!("{name} is not a file"));
    }
    let size = known.len();
    if size > MAX_BYTES as u64 {
        let error = ReadError::TooLarge { megabytes: size.div_ceil(1 << 20) as usize, limit: MAX_BYTES >> 20 };
        return Err(unread(&name, &error));
    }
    Ok(fs::read(path).map_err(failed)?.into())
}

/// The first bytes of a file; `None` if it cannot be read, which the reader reports.
fn beginning(path: &Path) -> Vec<u8> {
    let mut bytes = Vec::new();
    // Opening a pipe would block until another process writes into it.
    if path.is_file()
        && let Ok(file) = fs::File::open(path)
        && file.take(LOOK as u64).read_to_end(&mut bytes).is_err()
    {
        bytes.clear();
    }
    bytes
}

fn unread(name: &str, error: &ReadError) -> String {
    // A message about a line begins with it, which belongs to the name before it.
    let joint = if error.line().is_some() { ", " } else { ": " };
    format!("{name}{joint}{error}")
}
