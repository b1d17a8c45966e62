//! Files that are watched: what another program writes is read again.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use notify::{Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher as _};

/// A file has come to rest when nothing was written for so long.
const REST: Duration = Duration::from_millis(300);

/// Watches files through their folders, because editors and instruments often put a new file in the old one's place.
pub(super) struct Watch {
    watcher: Option<RecommendedWatcher>,
    heard: Receiver<PathBuf>,
    files: BTreeSet<PathBuf>,
    folders: BTreeSet<PathBuf>,
    restless: Vec<(PathBuf, Instant)>,
}

impl Watch {
    /// Watches nothing yet.
    pub(super) fn new(wake: Option<egui::Context>) -> Self {
        let (sender, heard) = channel();
        let watcher = notify::recommended_watcher(move |event| hear(event, &sender, wake.as_ref()));
        let watcher = watcher.map_err(|error| log::warn!("files cannot be watched: {error}")).ok();
        Self { watcher, heard, files: BTreeSet::new(), folders: BTreeSet::new(), restless: Vec::new() }
    }

    /// Watches these files and no others.
    pub(super) fn files(&mut self, files: BTreeSet<PathBuf>) {
        if files == self.files {
            return;
        }
        let folders: BTreeSet<PathBuf> = files.iter().filter_map(|file| file.parent()).map(Path::to_owned).collect();
        if let Some(watcher) = &mut self.watcher {
            for gone in self.folders.difference(&folders) {
                // A folder that is gone needs no more watching.
                let _gone = watcher.unwatch(gone);
            }
            self.folders.retain(|known| folders.contains(known));
            for new in folders {
                if self.folders.contains(&new) {
                    continue;
                }
                match watcher.watch(&new, RecursiveMode::NonRecursive) {
                    Ok(()) => {
                        self.folders.insert(new);
                    }
                    // Tried again with the next change of the list.
                    Err(error) => log::warn!("{} cannot be watched: {error}", new.display()),
                }
            }
        }
        self.files = files;
    }

    /// The files that changed and have come to rest; and when to ask again, if some have not.
    pub(super) fn poll(&mut self) -> (Vec<PathBuf>, Option<Duration>) {
        let now = Instant::now();
        for path in self.heard.try_iter().filter(|path| self.files.contains(path)) {
            self.restless.retain(|(known, _)| *known != path);
            self.restless.push((path, now));
        }
        let (rested, restless): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.restless).into_iter().partition(|(_, at)| now.duration_since(*at) >= REST);
        self.restless = restless;
        (rested.into_iter().map(|(path, _)| path).collect(), (!self.restless.is_empty()).then_some(REST))
    }
}

/// Passes on what was written or put in place.
fn hear(event: notify::Result<Event>, sender: &Sender<PathBuf>, wake: Option<&egui::Context>) {
    let Ok(event) = event else { return };
    if !matches!(event.kind, EventKind::Create(_) | EventKind::Modify(_) | EventKind::Any) {
        return;
    }
    for path in event.paths {
        // The receiver is gone only when the window is.
        let _closed = sender.send(path);
    }
    if let Some(ctx) = wake {
        ctx.request_repaint();
    }
}
