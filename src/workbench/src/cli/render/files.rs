//! Folder and names of pictures, and patience while they are made.

use std::fs;
use std::io::{self, IsTerminal as _};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use super::arguments::{Format, RenderArguments};
use crate::atomic::fitting;
use crate::cli::error::{CliError, Result, refused};
use crate::format::slug;
use crate::hosted;
use crate::scene::ComparedSensor;
use crate::terminal::say;

/// Runs work, with a message on a terminal every 3 s that it still runs.
pub(in crate::cli) fn patiently<T>(what: &'static str, work: impl FnOnce() -> T) -> T {
    const EVERY: Duration = Duration::from_secs(3);
    let (done, end) = channel::<()>();
    if io::stderr().is_terminal() {
        let start = Instant::now();
        let wait = move || {
            while end.recv_timeout(EVERY) == Err(RecvTimeoutError::Timeout) {
                say(&format!("chromascope: still {what} after {} s\n", start.elapsed().as_secs()));
            }
        };
        // Without a thread there are no messages.
        let _silent = thread::Builder::new().name("patience".to_owned()).spawn(wait);
    }
    let result = work();
    drop(done);
    result
}

pub(in crate::cli) fn make_folder(folder: &Path) -> Result<()> {
    if folder.as_os_str().is_empty() || hosted::is_in_memory(folder) {
        return Ok(());
    }
    if folder.exists() && !folder.is_dir() {
        let reason = format!("{} is a file; name a folder (files are named automatically)", folder.display());
        return refused("--out", reason);
    }
    fs::create_dir_all(folder).map_err(|error| CliError::Output { path: folder.to_owned(), error })
}

/// A file for each sensor, no two alike.
pub(super) fn file_names(arguments: &RenderArguments, mesh: &str, sources: &[ComparedSensor]) -> Vec<PathBuf> {
    // A picture that shows differences multiplied says so; OpenEXR holds numbers, which never are.
    let note = arguments.exaggerate.note().filter(|_| arguments.format == Format::Png);
    let note = note.map_or_else(String::new, |note| format!("_{}", slug(&note.replace('×', "x"))));
    let here = arguments.out == Path::new(".");
    let mut taken: Vec<String> = Vec::new();
    for source in sources {
        let note = if source.is_reference { "" } else { &note };
        let stem = format!("{}_{}{note}", slug(mesh), slug(&source.label));
        let numbered = |number: &str| fitting(&stem, &format!("{number}.{}", arguments.format.ending()));
        let numbers = std::iter::once(String::new()).chain((2_u32..).map(|number| format!("-{number}")));
        taken.extend(numbers.map(|number| numbered(&number)).find(|name| !taken.contains(name)));
    }
    taken.into_iter().map(|name| if here { PathBuf::from(name) } else { arguments.out.join(name) }).collect()
}
