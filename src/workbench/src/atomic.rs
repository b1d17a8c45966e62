//! Files written whole or not at all.

use std::ffi::OsStr;
use std::fs;
use std::io::{self, Seek as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use spectral_file::COVARIANCE;
use spectral_file::write::{Beside, Metadata};
use tempfile::NamedTempFile;

use crate::format::file_name;
use crate::hosted;

/// The beginning of names of files that are being written.
pub const TEMPORARY: &str = ".chromascope-";
/// Number of random letters and digits that follow it.
const RANDOM: usize = 6;

/// Writes a file atomically: to a temporary file in the same folder, which is then renamed. The file is flushed to disk before
/// the renaming, and its folder after it.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_atomically_with(path, |file| file.write_all(bytes))
}

/// Writes a file below a folder atomically; the folder that its name begins with, if any, is made.
pub fn write_below(folder: &Path, name: &str, bytes: &[u8]) -> io::Result<()> {
    let path = folder.join(name);
    let made = path.parent().filter(|own| *own != folder).map_or(Ok(()), fs::create_dir);
    made.or_else(|error| if error.kind() == io::ErrorKind::AlreadyExists { Ok(()) } else { Err(error) })?;
    write_atomically(&path, bytes)
}

/// Writes a file whole or not at all, as its contents are made.
pub fn write_atomically_with(path: &Path, write: impl FnOnce(&mut dyn io::Write) -> io::Result<()>) -> io::Result<()> {
    if hosted::is_in_memory(path) {
        let mut bytes = Vec::new();
        write(&mut bytes)?;
        hosted::put(path, bytes);
        return Ok(());
    }
    // The target of a link is written, and the link stays.
    let target = match fs::canonicalize(path) {
        Ok(target) => target,
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        Err(_) if fs::symlink_metadata(path).is_ok() => {
            return Err(io::Error::new(io::ErrorKind::NotFound, "it is a link to a file that is not there"));
        }
        Err(_) => path.to_owned(),
    };
    if fs::metadata(&target).is_ok_and(|known| !known.is_file() && !known.is_dir()) {
        // A device or a pipe has no contents to keep, and stays what it is.
        return write(&mut fs::OpenOptions::new().write(true).open(&target)?);
    }
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = temporary(folder)?;
    write(file.as_file_mut())?;
    finish(&file, &target)?;
    file.persist(&target).map(drop).or_else(|error| again(error, folder, &target))?;
    // The file is in its place; some systems cannot flush a folder.
    #[cfg(unix)]
    if let Err(error) = fs::File::open(folder).and_then(|folder| folder.sync_all()) {
        log::debug!("{} is not flushed: {error}", folder.display());
    }
    Ok(())
}

/// Paths of the files beside a table, with its metadata and its covariance.
pub fn paths_beside(table: &Path) -> [PathBuf; 2] {
    let mut metadata = table.as_os_str().to_owned();
    metadata.push(Metadata::ENDING);
    [metadata.into(), table.with_extension(COVARIANCE)]
}

/// Files beside a table, each with its text; none for one that would describe the table before it.
pub fn files_beside(table: &Path, beside: &Beside) -> [(PathBuf, Option<String>); 2] {
    let [metadata, covariance] = paths_beside(table);
    let text = beside.metadata.as_ref().map(|known| known.text(&file_name(table)));
    [(metadata, text), (covariance, beside.covariance.clone())]
}

/// Writes a file and before it those beside it, or removes these: all or none.
pub fn write_with<E>(
    beside: &[(PathBuf, Option<String>)],
    failed: impl Fn(&Path, io::Error) -> E,
    write: impl FnOnce() -> Result<(), E>,
) -> Result<(), E> {
    let mut undo = Vec::with_capacity(beside.len());
    let mut put_beside = || {
        for (path, text) in beside {
            let put = fs::read(path).map(Some).or_else(if_absent).and_then(|before| {
                undo.push((path, before));
                put_or_remove(path, text.as_deref().map(str::as_bytes))
            });
            put.map_err(|error| failed(path, error))?;
        }
        Ok(())
    };
    put_beside().and_then(|()| write()).inspect_err(|_| {
        for (path, before) in undo {
            // The first failure is the one to report.
            let _undone = put_or_remove(path, before.as_deref());
        }
    })
}

fn if_absent<T: Default>(error: io::Error) -> io::Result<T> {
    if error.kind() == io::ErrorKind::NotFound { Ok(T::default()) } else { Err(error) }
}

fn put_or_remove(path: &Path, bytes: Option<&[u8]>) -> io::Result<()> {
    bytes.map_or_else(|| fs::remove_file(path).or_else(if_absent), |bytes| write_atomically(path, bytes))
}

/// Makes a file that is to take the place of another, and locks it: it is being written.
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY).rand_bytes(RANDOM);
    // A temporary file is private by default; a saved one is as readable as any new file, so that the umask applies.
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

/// Writes a file again whose name another program removed before it was in its place.
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

/// Removes temporary files of killed processes from a folder of the program. Files being written are locked, or about to be.
pub fn sweep(folder: &Path) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries.filter(|entry| is_temporary(&entry.file_name())) {
        let path = entry.path();
        // Network folders lock only files opened for writing.
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

/// True if a file was last written longer ago than this.
pub fn is_older(path: &Path, age: Duration, now: SystemTime) -> bool {
    let modified = fs::symlink_metadata(path).and_then(|facts| facts.modified()).ok();
    modified.and_then(|modified| now.duration_since(modified).ok()).is_some_and(|past| past > age)
}

/// True if a name is one of those that [`temporary`] makes.
fn is_temporary(name: &OsStr) -> bool {
    let random = name.to_str().and_then(|name| name.strip_prefix(TEMPORARY));
    random.is_some_and(|random| random.len() == RANDOM && random.bytes().all(|byte| byte.is_ascii_alphanumeric()))
}

/// A file's name of a stem and an ending, the stem cut where both together are longer than file systems take: 255 bytes, with those of a
/// file beside it.
pub fn fitting(stem: &str, ending: &str) -> String {
    const LONGEST: usize = 255 - Metadata::ENDING.len();
    let room = LONGEST.saturating_sub(ending.len());
    format!("{}{ending}", &stem[..stem.floor_char_boundary(room)])
}
