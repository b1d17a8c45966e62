//! Files that are watched: what another program writes is read again.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use notify::event::ModifyKind;
use notify::{Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher as _};

use crate::jobs::Clock;

/// Time without writes after which a file is stable.
const REST: Duration = Duration::from_millis(300);
/// Time after which a file is read even if it is still being written.
const RESTLESS: Duration = Duration::from_secs(1);
/// Time between two readings of a file.
const APART: Duration = Duration::from_millis(500);
/// Interval at which a missing folder is looked for.
const LOOK: Duration = Duration::from_secs(1);

/// Watches files through their folders, because editors and instruments often put a new file in the old one's place.
pub(super) struct Watch {
    watcher: Option<RecommendedWatcher>,
    heard: Arc<Mutex<Heard>>,
    clock: Clock,
    files: BTreeSet<PathBuf>,
    folders: BTreeSet<PathBuf>,
    /// Folders that cannot be watched now, most often because they are gone.
    lost: BTreeSet<PathBuf>,
    looked: Option<Duration>,
}

/// Events since the last query, on the thread that receives them.
#[derive(Default)]
struct Heard {
    files: BTreeSet<PathBuf>,
    folders: BTreeSet<PathBuf>,
    changes: BTreeMap<PathBuf, Change>,
    gone: BTreeSet<PathBuf>,
    /// Time at which changed files were last reported.
    reported: BTreeMap<PathBuf, Duration>,
}

/// Times of the first and last write of a file that has not been reported since.
#[derive(Clone, Copy, Debug)]
struct Change {
    first: Duration,
    last: Duration,
}

impl Heard {
    /// Records that a file was written. Returns whether that is new: a file that is written repeatedly is polled.
    fn written(&mut self, path: PathBuf, now: Duration) -> bool {
        if !self.files.contains(&path) {
            return false;
        }
        let is_news = !self.changes.contains_key(&path);
        self.changes.entry(path).or_insert(Change { first: now, last: now }).last = now;
        is_news
    }

    /// Records that a folder was removed. Returns whether that is new.
    fn gone(&mut self, path: PathBuf) -> bool {
        self.folders.contains(&path) && self.gone.insert(path)
    }

    /// The files to read now, and the time after which to poll for others.
    fn due(&mut self, now: Duration) -> (Vec<PathBuf>, Option<Duration>) {
        let due = |path: &PathBuf, change: &Change| {
            let apart = self.reported.get(path).map_or(Duration::ZERO, |reported| *reported + APART);
            (change.last + REST).min(change.first + RESTLESS).max(apart)
        };
        let when: Vec<(PathBuf, Duration)> =
            self.changes.iter().map(|(path, change)| (path.clone(), due(path, change))).collect();
        let again = when.iter().filter(|(_, due)| *due > now).map(|(_, due)| due.saturating_sub(now)).min();
        let files: Vec<PathBuf> = when.into_iter().filter(|(_, due)| *due <= now).map(|(path, _)| path).collect();
        for path in &files {
            self.changes.remove(path);
            self.reported.insert(path.clone(), now);
        }
        (files, again)
    }
}

impl Watch {
    pub(super) fn new(wake: Option<egui::Context>) -> Self {
        let (heard, clock) = (Arc::<Mutex<Heard>>::default(), Clock::default());
        let (listener, times) = (Arc::clone(&heard), clock.clone());
        let watcher = notify::recommended_watcher(move |event| {
            let is_news = hear(event, &mut lock(&listener), times.now());
            if let Some(ctx) = wake.as_ref().filter(|_| is_news) {
                ctx.request_repaint();
            }
        });
        let watcher = watcher.map_err(|error| log::warn!("files cannot be watched: {error}")).ok();
        let (files, folders, lost) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
        Self { watcher, heard, clock, files, folders, lost, looked: None }
    }

    pub(super) fn files(&mut self, files: BTreeSet<PathBuf>) {
        if files == self.files {
            return;
        }
        let folders: BTreeSet<PathBuf> = files.iter().filter_map(|file| file.parent()).map(Path::to_owned).collect();
        {
            let mut heard = lock(&self.heard);
            heard.changes.retain(|path, _| files.contains(path));
            heard.reported.retain(|path, _| files.contains(path));
            heard.files.clone_from(&files);
            heard.folders.clone_from(&folders);
        }
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

    /// The files that changed and are stable or never become so; and the time to poll again, if others changed or a folder is
    /// missing.
    pub(super) fn poll(&mut self) -> (Vec<PathBuf>, Option<Duration>) {
        let now = self.clock.now();
        let gone = std::mem::take(&mut lock(&self.heard).gone);
        for folder in gone {
            self.lose(folder);
        }
        self.look_for_lost(now);
        let (files, again) = lock(&self.heard).due(now);
        (files, again.or((!self.lost.is_empty()).then_some(LOOK)))
    }

    /// A folder of this name may soon exist again, but it is another one.
    fn lose(&mut self, folder: PathBuf) {
        if self.folders.remove(&folder) {
            if let Some(watcher) = &mut self.watcher {
                let _gone = watcher.unwatch(&folder);
            }
            self.looked = None;
            self.lost.insert(folder);
        }
    }

    fn look_for_lost(&mut self, now: Duration) {
        if self.lost.is_empty() || self.looked.is_some_and(|at| now.saturating_sub(at) < LOOK) {
            return;
        }
        self.looked = Some(now);
        let Some(watcher) = &mut self.watcher else { return };
        let found = self.lost.iter().filter(|folder| watcher.watch(folder, RecursiveMode::NonRecursive).is_ok());
        for folder in found.cloned().collect::<Vec<_>>() {
            // Files that existed before the watch began count as just written.
            let mut heard = lock(&self.heard);
            for file in self.files.iter().filter(|file| file.parent() == Some(&folder) && file.is_file()) {
                heard.written(file.clone(), now);
            }
            self.lost.remove(&folder);
            self.folders.insert(folder);
        }
    }
}

/// A panic elsewhere leaves no partial state: it is only read and replaced under the lock.
fn lock(heard: &Mutex<Heard>) -> MutexGuard<'_, Heard> {
    heard.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Records files that were written, created or removed. Returns whether any of it is new.
fn hear(event: notify::Result<Event>, heard: &mut Heard, now: Duration) -> bool {
    let Ok(event) = event else { return false };
    let is_removal = match event.kind {
        EventKind::Create(_) | EventKind::Modify(_) | EventKind::Any => false,
        EventKind::Remove(_) => true,
        _ => return false,
    };
    let mut is_news = false;
    for path in event.paths {
        // Where a folder was moved away, only its name identifies it.
        let is_moved = matches!(event.kind, EventKind::Modify(ModifyKind::Name(_))) && !path.exists();
        is_news |= if is_removal || is_moved { heard.gone(path) } else { heard.written(path, now) };
    }
    is_news
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::Executor;

    /// Writes a file periodically for ten seconds, to a window that is drawn on events and when it requested a repaint.
    /// Returns how often the file was to be read, and how often the window was drawn.
    fn readings(every: Duration) -> (usize, usize) {
        let executor = Executor::driven();
        let clock = executor.clock();
        let path = PathBuf::from("/measured.csv");
        let mut heard = Heard { files: BTreeSet::from([path.clone()]), ..Heard::default() };
        let (mut read, mut drawn) = (0, 0);
        let mut draw_at: Option<Duration> = None;
        while clock.now() < Duration::from_secs(10) {
            executor.advance(every);
            let is_news = heard.written(path.clone(), clock.now());
            if is_news || draw_at.is_some_and(|at| at <= clock.now()) {
                let (files, again) = heard.due(clock.now());
                draw_at = again.map(|after| clock.now() + after);
                (read, drawn) = (read + files.len(), drawn + 1);
            }
        }
        (read, drawn)
    }

    #[test]
    fn a_file_that_never_rests_is_read_now_and_then_and_the_window_rests() {
        for milliseconds in [1, 10, 100, 250] {
            let (read, drawn) = readings(Duration::from_millis(milliseconds));
            assert!((5..=20).contains(&read), "read {read} times in ten seconds, written every {milliseconds} ms");
            assert!(drawn <= 80, "drawn {drawn} times in ten seconds, written every {milliseconds} ms");
        }
    }

    #[test]
    fn a_file_that_was_written_once_is_read_as_soon_as_it_rests() {
        let path = PathBuf::from("/measured.csv");
        let mut heard = Heard { files: BTreeSet::from([path.clone()]), ..Heard::default() };
        let at = Duration::from_secs(5);
        assert!(heard.written(path.clone(), at));
        assert_eq!(heard.due(at), (Vec::new(), Some(REST)));
        assert_eq!(heard.due(at + REST), (vec![path.clone()], None));
        assert_eq!(heard.due(at + RESTLESS), (Vec::new(), None), "it is read once");
        // Written again immediately: at most two reads per second.
        let at = at + REST;
        assert!(heard.written(path.clone(), at));
        assert_eq!(heard.due(at + REST), (Vec::new(), Some(APART.saturating_sub(REST))));
        assert_eq!(heard.due(at + APART), (vec![path], None));
    }

    #[test]
    fn what_is_written_beside_the_files_is_no_news() {
        let mut heard = Heard { files: BTreeSet::from([PathBuf::from("/a.csv")]), ..Heard::default() };
        assert!(!heard.written(PathBuf::from("/b.csv"), Duration::ZERO) && !heard.gone(PathBuf::from("/b.csv")));
        assert_eq!(heard.due(Duration::from_secs(9)), (Vec::new(), None));
    }
}
