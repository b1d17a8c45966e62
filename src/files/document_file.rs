//! Files of a saved document: a small one, rewritten with every change, and the curves of imported sets in files of their own,
//! each written once. So a change costs a few kilobytes, however large the sets are, and is made safe by replacing one small
//! file: there is no journal to replay, and no torn record. A file is flushed to the disk before it is renamed, and the folder
//! after it, so that neither a kill nor a power failure leaves half of one.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::ptr::from_ref;

use chromascope_core::query::Shared;

use super::folder::{CURVES, Lock, free_copy, texts_of_documents};
use crate::atomic::write_atomically;
use crate::document::imported::{Fingerprint, ImportedCurve, ImportedSet};
use crate::document::session::{self, LoadedDocument, Place};
use crate::document::{Document, VERSION};
use crate::format::{io_failure, io_reason};

/// Files of curves kept that the document of this run named before.
const SUPERSEDED: usize = 16;

pub(super) struct Unwritten {
    pub(super) why: String,
    /// True if only imported sets are missing in the file.
    pub(super) is_rest_written: bool,
}

impl From<String> for Unwritten {
    fn from(why: String) -> Self {
        Self { why, is_rest_written: false }
    }
}

#[derive(Debug)]
pub(super) enum Unread {
    Missing,
    Because(String),
}

/// Writes one document, again and again.
#[derive(Debug, Default)]
pub(super) struct DocumentFile {
    pub(super) path: PathBuf,
    /// Contents of that file as this window read or wrote them. Others are another program's.
    seen: Option<Fingerprint>,
    /// Contents that this window tried to write, which may be there although that failed.
    tried: Option<Fingerprint>,
    /// Sets of the document as it was written, by address.
    known: HashMap<usize, (Shared<ImportedSet>, Place)>,
    /// Curves that this window wrote, by their text.
    written: HashMap<u128, Place>,
    /// Files of those curves, the oldest first.
    order: Vec<String>,
    /// True if the file on disk holds curves itself, which are lost with it.
    pub(super) by_value: bool,
    /// True if the file on disk is known to be in the present format, or backed up.
    is_present: bool,
    /// The file in which the document is saved because another program wrote to the one before.
    pub(super) moved: Option<PathBuf>,
    lock: Option<Lock>,
}

impl DocumentFile {
    pub(super) fn new(path: PathBuf) -> Self {
        Self { path, ..Self::default() }
    }

    /// Continues in another file, which is this window's.
    pub(super) fn move_to(&mut self, path: PathBuf) {
        self.lock = Some(Lock::of_copy(&path));
        (self.path, self.seen, self.tried) = (path, None, None);
    }

    /// Reads a document, this one's or another window's.
    pub(super) fn read(&mut self, file: &Path) -> Result<LoadedDocument, Unread> {
        let (loaded, fingerprint) = read(file)?;
        for (set, place) in loaded.document.own.iter().zip(&loaded.places) {
            if let Some(place) = place {
                self.known.insert(address(set), (set.clone(), place.clone()));
            }
        }
        if file == self.path {
            self.seen = Some(fingerprint);
            self.by_value = loaded.places.iter().any(Option::is_none);
        }
        Ok(loaded)
    }

    /// Writes the document. A set that cannot be written does not stop the rest.
    pub(super) fn write(&mut self, document: &Document) -> Result<(), Unwritten> {
        let folder = self.path.parent().map(Path::to_owned).unwrap_or_default();
        fs::create_dir_all(&folder).map_err(|error| io_failure(&folder, &error))?;
        if self.is_foreign()? {
            let copy = free_copy(&folder);
            self.moved = Some(copy.clone());
            self.move_to(copy);
        }
        self.forget_missing(&folder.join(CURVES));
        let unwritten = self.write_new(&folder, &document.own).err();
        if let Some(why) = unwritten.as_ref().filter(|_| self.by_value) {
            return Err(why.clone().into());
        }
        // A set that cannot be written is replaced by its earlier version on disk.
        let place = |set: &Shared<ImportedSet>| {
            let before = || self.known.values().find(|(before, _)| before.name == set.name && before.role == set.role);
            self.known.get(&address(set)).or_else(before)
        };
        let missing = document.own.iter().filter(|set| !self.known.contains_key(&address(set)));
        let missing: Vec<&str> = missing.map(|set| set.name.as_str()).collect();
        let sets: Vec<(&ImportedSet, &Place)> =
            document.own.iter().filter_map(place).map(|(set, place)| (&**set, place)).collect();
        let json = session::to_json_with_places(document, &sets).map_err(|error| error.to_string())?;
        let skipped = unwritten.map(|why| match missing.as_slice() {
            [one] => format!("{one} could not be saved ({why}); the rest is"),
            many => format!("{} imported sets could not be saved ({why}); the rest is", many.len()),
        });
        self.tried = Some(Fingerprint::of(json.as_bytes()));
        write_atomically(&self.path, json.as_bytes()).map_err(|error| io_failure(&self.path, &error))?;
        (self.seen, self.by_value) = (self.tried, false);
        if let Some(why) = skipped {
            return Err(Unwritten { why, is_rest_written: true });
        }
        let present: HashSet<usize> = document.own.iter().map(address).collect();
        self.known.retain(|address, _| present.contains(address));
        self.remove_superseded(&folder);
        Ok(())
    }

    /// True if the file holds data that this window neither read nor wrote. A file of an earlier format that it read is
    /// backed up before it is overwritten.
    fn is_foreign(&mut self) -> Result<bool, String> {
        let bytes = match fs::read(&self.path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(false),
            Err(error) => return Err(io_failure(&self.path, &error)),
        };
        let there = Some(Fingerprint::of(&bytes));
        if there == self.tried {
            self.seen = there;
        }
        let is_foreign = there != self.seen;
        if !is_foreign && !self.is_present {
            keep_earlier(&self.path, &bytes)?;
            self.is_present = true;
        }
        Ok(is_foreign)
    }

    /// Forgets places in files that are no more, so that their curves are written again from memory.
    fn forget_missing(&mut self, folder: &Path) {
        let places = self.known.values().map(|(_, place)| place).chain(self.written.values());
        let names: HashSet<&String> = places.map(|Place(name, _)| name).collect();
        let is_missing = |name: &&String| {
            use io::ErrorKind::{NotADirectory, NotFound};
            fs::metadata(folder.join(name)).is_err_and(|error| matches!(error.kind(), NotFound | NotADirectory))
        };
        let missing: HashSet<String> = names.into_iter().filter(is_missing).cloned().collect();
        if !missing.is_empty() {
            self.known.retain(|_, (_, Place(name, _))| !missing.contains(name));
            self.written.retain(|_, Place(name, _)| !missing.contains(name));
        }
    }

    /// Removes the oldest files of curves that this window wrote and its document names no longer, such as earlier contents of a file
    /// that changes each second, unless another document names them. Steps of undo hold their curves in memory.
    fn remove_superseded(&mut self, folder: &Path) {
        let named: HashSet<&String> = self.known.values().map(|(_, Place(name, _))| name).collect();
        let spare: Vec<String> = self.order.iter().filter(|name| !named.contains(name)).cloned().collect();
        let Some(count) = spare.len().checked_sub(SUPERSEDED).filter(|count| *count > 0) else { return };
        let Some(texts) = texts_of_documents(folder) else { return };
        for name in spare.into_iter().take(count) {
            self.order.retain(|known| *known != name);
            if !texts.iter().any(|text| text.contains(&name)) {
                let _gone = fs::remove_file(folder.join(CURVES).join(&name));
                self.written.retain(|_, Place(known, _)| *known != name);
            }
        }
    }

    /// Writes the curves that are in no file yet, all into one: a folder of files that is opened costs one flush.
    fn write_new(&mut self, folder: &Path, sets: &[Shared<ImportedSet>]) -> Result<(), String> {
        let mut fresh = Vec::new();
        for set in sets {
            if self.known.contains_key(&address(set)) {
                continue;
            }
            let text = serde_json::to_vec(&set.curves).map_err(|error| error.to_string())?;
            let key = fingerprint(&text);
            match self.written.get(&key) {
                Some(place) => {
                    self.known.insert(address(set), (set.clone(), place.clone()));
                }
                None => fresh.push((set, key, text)),
            }
        }
        if fresh.is_empty() {
            return Ok(());
        }
        let lists: Vec<&[u8]> = fresh.iter().map(|(_, _, text)| text.as_slice()).collect();
        let text = [b"[".as_slice(), &lists.join(b",\n".as_slice()), b"]\n"].concat();
        let keys: Vec<u8> = fresh.iter().flat_map(|(_, key, _)| key.to_le_bytes()).collect();
        let name = format!("{:032x}.json", fingerprint(&keys));
        let folder = folder.join(CURVES);
        let failed = |error: io::Error| io_failure(&folder, &error);
        fs::create_dir_all(&folder).map_err(failed)?;
        write_atomically(&folder.join(&name), &text).map_err(failed)?;
        self.order.retain(|known| *known != name);
        self.order.push(name.clone());
        for (index, (set, key, _)) in fresh.into_iter().enumerate() {
            let place = Place(name.clone(), index);
            self.written.insert(key, place.clone());
            self.known.insert(address(set), (set.clone(), place));
        }
        Ok(())
    }
}

/// Backs up a document of an earlier format once, for the version of the program that wrote it.
fn keep_earlier(file: &Path, bytes: &[u8]) -> Result<(), String> {
    #[derive(serde::Deserialize)]
    struct Form {
        version: u32,
    }
    let Ok(Form { version: version @ ..VERSION }) = serde_json::from_slice(bytes) else { return Ok(()) };
    let beside = file.with_file_name(format!("document-version-{version}.json"));
    if fs::symlink_metadata(&beside).is_ok() {
        return Ok(());
    }
    write_atomically(&beside, bytes).map_err(|error| io_failure(&beside, &error))
}

pub(super) fn read(file: &Path) -> Result<(LoadedDocument, Fingerprint), Unread> {
    let because = Unread::Because;
    let bytes = fs::read(file).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound if fs::symlink_metadata(file).is_ok() => {
            because("it is a link to a file that is not there".to_owned())
        }
        io::ErrorKind::NotFound => Unread::Missing,
        _ => because(io_reason(&error)),
    })?;
    let text = std::str::from_utf8(&bytes).map_err(|error| because(format!("not text: {error}")))?;
    let folder = file.parent().map(|folder| folder.join(CURVES)).unwrap_or_default();
    let mut files: HashMap<String, Result<Vec<Vec<ImportedCurve>>, String>> = HashMap::new();
    let mut curves = |Place(name, index): &Place| {
        let lists = files.entry(name.clone()).or_insert_with(|| read_curves(&folder, name)).as_ref();
        let list = lists.map_err(Clone::clone)?.get(*index);
        list.cloned().ok_or_else(|| format!("{name} has no list {index}"))
    };
    let loaded = session::from_json_with_places(text, &mut curves).map_err(|error| because(error.to_string()))?;
    Ok((loaded, Fingerprint::of(&bytes)))
}

fn read_curves(folder: &Path, name: &str) -> Result<Vec<Vec<ImportedCurve>>, String> {
    // A plain file name leads into no other folder.
    if Path::new(name).file_name().is_none_or(|own| own != name) {
        return Err(format!("{name} is not a file name"));
    }
    let path = folder.join(name);
    let bytes = fs::read(&path).map_err(|error| io_failure(&path, &error))?;
    serde_json::from_slice(&bytes).map_err(|error| format!("{}: {error}", path.display()))
}

/// The address of a set's contents, unique for as long as the set is held.
fn address(set: &Shared<ImportedSet>) -> usize {
    from_ref::<ImportedSet>(set).addr()
}

/// FNV-1a, 128 bits: names contents, of which no two differ within the life of the universe.
fn fingerprint(bytes: &[u8]) -> u128 {
    const OFFSET: u128 = 0x6C62_272E_07BB_0142_62B8_2175_6295_C58D;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013B;
    bytes.iter().fold(OFFSET, |hash, &byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME))
}
