//! Files that are watched: what another program writes is read again.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use notify::event::ModifyKind;
use notify::{Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher as _};

/// A file has come to rest when nothing was written for so long.
const REST: Duration = Duration::from_millis(300);

/// So often a folder that is gone is looked for.
const LOOK: Duration = Duration::from_secs(1);

/// Watches files through their folders, because editors and instruments often put a new file in the old one's place.
pub(super) struct Watch {
    watcher: Option<RecommendedWatcher>,
    heard: Receiver<Heard>,
    files: BTreeSet<PathBuf>,
    folders: BTreeSet<PathBuf>,
    /// Folders that cannot be watched now, most often because they are gone.
    lost: BTreeSet<PathBuf>,
    looked: Option<Instant>,
    restless: Vec<(PathBuf, Instant)>,
}

/// What happened to a path.
enum Heard {
    Written(PathBuf),
    Gone(PathBuf),
}

impl Watch {
    /// Watches nothing yet.
    pub(super) fn new(wake: Option<egui::Context>) -> Self {
        let (sender, heard) = channel();
        let watcher = notify::recommended_watcher(move |event| hear(event, &sender, wake.as_ref()));
        let watcher = watcher.map_err(|error| log::warn!("files cannot be watched: {error}")).ok();
        let (files, folders, lost) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
        Self { watcher, heard, files, folders, lost, looked: None, restless: Vec::new() }
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
            self.lost.retain(|known| folders.contains(known));
            for new in folders {
                if self.folders.contains(&new) || self.lost.contains(&new) {
                    continue;
                }
                match watcher.watch(&new, RecursiveMode::NonRecursive) {
                    Ok(()) => {
                        self.folders.insert(new);
                    }
                    Err(error) => {
                        log::warn!("{} cannot be watched: {error}", new.display());
                        self.lost.insert(new);
                    }
                }
            }
        }
        self.files = files;
    }

    /// The files that changed and have come to rest; and when to ask again, if some have not or a folder is gone.
    pub(super) fn poll(&mut self) -> (Vec<PathBuf>, Option<Duration>) {
        let now = Instant::now();
        let heard: Vec<Heard> = self.heard.try_iter().collect();
        for heard in heard {
            match heard {
                Heard::Written(path) => self.wait_for(path, now),
                Heard::Gone(path) => self.lose(path),
            }
        }
        self.look_for_lost(now);
        let (rested, restless): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.restless).into_iter().partition(|(_, at)| now.duration_since(*at) >= REST);
        self.restless = restless;
        let again = match (self.restless.is_empty(), self.lost.is_empty()) {
            (false, _) => Some(REST),
            (true, false) => Some(LOOK),
            (true, true) => None,
        };
        (rested.into_iter().map(|(path, _)| path).collect(), again)
    }

    fn wait_for(&mut self, path: PathBuf, now: Instant) {
        if self.files.contains(&path) {
            self.restless.retain(|(known, _)| *known != path);
            self.restless.push((path, now));
        }
    }

    /// A folder of this name may be there again at once, but it is another one.
    fn lose(&mut self, folder: PathBuf) {
        if self.folders.remove(&folder) {
            if let Some(watcher) = &mut self.watcher {
                let _gone = watcher.unwatch(&folder);
            }
            self.looked = None;
            self.lost.insert(folder);
        }
    }

    fn look_for_lost(&mut self, now: Instant) {
        if self.lost.is_empty() || self.looked.is_some_and(|at| now.duration_since(at) < LOOK) {
            return;
        }
        self.looked = Some(now);
        let Some(watcher) = &mut self.watcher else { return };
        let found = self.lost.iter().filter(|folder| watcher.watch(folder, RecursiveMode::NonRecursive).is_ok());
        for folder in found.cloned().collect::<Vec<_>>() {
            // What was put there before it was watched counts as written just now.
            let within: Vec<PathBuf> =
                self.files.iter().filter(|file| file.parent() == Some(&folder) && file.is_file()).cloned().collect();
            for file in within {
                self.wait_for(file, now);
            }
            self.lost.remove(&folder);
            self.folders.insert(folder);
        }
    }
}

/// Passes on what was written or put in place, and what is gone.
fn hear(event: notify::Result<Event>, sender: &Sender<Heard>, wake: Option<&egui::Context>) {
    let Ok(event) = event else { return };
    let heard = match event.kind {
        EventKind::Create(_) | EventKind::Modify(_) | EventKind::Any => Heard::Written,
        EventKind::Remove(_) => Heard::Gone,
        _ => return,
    };
    for path in event.paths {
        // Where a folder was moved away, its name is all that tells.
        if matches!(event.kind, EventKind::Modify(ModifyKind::Name(_))) && !path.exists() {
            let _closed = sender.send(Heard::Gone(path));
            continue;
        }
        // The receiver is gone only when the window is.
        let _closed = sender.send(heard(path));
    }
    if let Some(ctx) = wake {
        ctx.request_repaint();
    }
}
