//! Files that commands write: checked before anything is written, then written whole or not at all.
//!
//! No command overwrites a file that it reads, nor any other file without `--force`. Streams (standard output, pipes, devices
//! such as `/dev/null`) are written into.

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use super::error::{CliError, Result};
use crate::atomic::write_atomically_with;
use crate::hosted;
use crate::scene::SceneError;
use crate::terminal;

const BUFFER: usize = 1 << 16;

/// A file as the file system knows it, by whatever name or link it is reached.
#[derive(Debug, PartialEq, Eq)]
enum Identity {
    #[cfg(unix)]
    Inode(u64, u64),
    Path(PathBuf),
}

impl Identity {
    #[cfg(unix)]
    fn existing(path: &Path) -> Option<Self> {
        use std::os::unix::fs::MetadataExt as _;
        fs::metadata(path).ok().map(|known| Self::Inode(known.dev(), known.ino()))
    }

    #[cfg(not(unix))]
    fn existing(path: &Path) -> Option<Self> {
        fs::canonicalize(path).ok().map(Self::Path)
    }

    fn new(path: &Path) -> Self {
        Self::existing(path).unwrap_or_else(|| {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
            let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
            Self::Path(path.file_name().map_or_else(|| path.to_owned(), |name| folder.join(name)))
        })
    }
}

/// Refuses all outputs if one is an input, is named twice, or exists and is not to be replaced.
pub(super) fn check<'a>(outputs: impl IntoIterator<Item = &'a Path>, inputs: &[PathBuf], force: bool) -> Result<()> {
    let inputs: Vec<Identity> = inputs.iter().filter_map(|path| Identity::existing(path)).collect();
    let mut taken = Vec::new();
    for path in outputs.into_iter().filter(|path| !is_stream(path)) {
        let identity = Identity::new(path);
        if inputs.contains(&identity) {
            return Err(CliError::Input(path.to_owned()));
        }
        // A dangling link exists, too.
        if !force && fs::symlink_metadata(path).is_ok() && !path.is_dir() {
            return Err(CliError::Exists(path.to_owned()));
        }
        if taken.contains(&identity) {
            return Err(CliError::Twice(path.to_owned()));
        }
        taken.push(identity);
    }
    Ok(())
}

pub(super) fn is_standard_output(path: &Path) -> bool {
    ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"].iter().any(|name| path == Path::new(name))
}

/// True if a path is a file descriptor opened by the shell, which decides where it leads.
pub(super) fn is_descriptor(path: &Path) -> bool {
    let number = |rest: &Path| rest.to_str().is_some_and(|text| text.parse::<u32>().is_ok());
    let in_folder = |folder: &&str| path.strip_prefix(folder).is_ok_and(number);
    path == Path::new("/dev/stderr") || ["/dev/fd", "/proc/self/fd"].iter().any(in_folder)
}

/// True if bytes that are written to a path replace nothing.
pub(super) fn is_stream(path: &Path) -> bool {
    let no_file = || fs::metadata(path).is_ok_and(|known| !known.is_file() && !known.is_dir());
    is_standard_output(path) || is_descriptor(path) || no_file()
}

pub(super) fn show(text: &str) -> Result<()> {
    put(&terminal::shown(text), None)
}

/// Writes a text to a file, whole or not at all, or to standard output.
pub(super) fn put(text: &str, out: Option<&Path>) -> Result<()> {
    stream(out, |out| Ok(out.write_all(text.as_bytes())?))
}

pub(super) enum Stop {
    Output(io::Error),
    Because(Box<CliError>),
}

impl From<io::Error> for Stop {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}

impl From<CliError> for Stop {
    fn from(error: CliError) -> Self {
        Self::Because(Box::new(error))
    }
}

impl From<SceneError> for Stop {
    fn from(error: SceneError) -> Self {
        CliError::from(error).into()
    }
}

/// Writes to a file, whole or not at all, or to standard output, as it is made: nothing is held until the end.
pub(super) fn stream(out: Option<&Path>, write: impl FnOnce(&mut dyn io::Write) -> Result<(), Stop>) -> Result<()> {
    let path = out.filter(|path| !is_standard_output(path));
    let mut because = None;
    let written = |out: &mut dyn io::Write| {
        let mut out = io::BufWriter::with_capacity(BUFFER, out);
        match write(&mut out) {
            Ok(()) => out.flush(),
            Err(Stop::Output(error)) => Err(error),
            Err(Stop::Because(error)) => {
                because = Some(*error);
                Err(io::ErrorKind::Other.into())
            }
        }
    };
    let done = match path {
        None if hosted::holds_streams() => {
            let mut bytes = Vec::new();
            let done = written(&mut bytes);
            hosted::hold(|streams| streams.output.append(&mut bytes));
            done
        }
        None => written(&mut io::stdout().lock()),
        Some(path) => write_with(path, written),
    };
    match (done, because) {
        (_, Some(because)) => Err(because),
        // The reader has closed the pipe, as `head` does.
        (Err(error), None) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        (Err(error), None) => {
            Err(CliError::Output { path: path.unwrap_or(Path::new("standard output")).to_owned(), error })
        }
        (Ok(()), None) => Ok(()),
    }
}

pub(super) fn write_to(path: &Path, bytes: &[u8]) -> Result<()> {
    let written = write_with(path, |out| out.write_all(bytes));
    written.map_err(|error| CliError::Output { path: path.to_owned(), error })
}

/// A file is replaced whole, behind a link if it is one; a stream is written into.
fn write_with(path: &Path, write: impl FnOnce(&mut dyn io::Write) -> io::Result<()>) -> io::Result<()> {
    match fs::metadata(path) {
        Ok(_) if is_descriptor(path) => write(&mut fs::OpenOptions::new().append(true).open(path)?),
        Ok(known) if known.is_file() => write_atomically_with(&fs::canonicalize(path)?, write),
        Ok(known) if !known.is_dir() => write(&mut fs::OpenOptions::new().write(true).open(path)?),
        _ => write_atomically_with(path, write),
    }
}
