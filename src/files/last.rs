//! Saving the document as the program ends: after a panic, at a signal, without a display.

use std::io;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError, Weak};
use std::thread;
use std::time::{Duration, Instant};

use super::shared_state::SharedState;

/// Maximum time to wait for a disk at exit.
const WAIT: Duration = Duration::from_secs(3);

/// The window's document.
static LAST: Mutex<Weak<SharedState>> = Mutex::new(Weak::new());

/// Remembers the state of the window that was opened last.
pub(super) fn remember(shared: &Arc<SharedState>) {
    *LAST.lock().unwrap_or_else(PoisonError::into_inner) = Arc::downgrade(shared);
}

/// Locks what another thread may hold for good.
pub(super) fn within_moments<T>(mutex: &Mutex<T>) -> Option<MutexGuard<'_, T>> {
    let start = Instant::now();
    loop {
        match mutex.try_lock() {
            Ok(guard) => return Some(guard),
            Err(TryLockError::Poisoned(poisoned)) => return Some(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) if start.elapsed() > WAIT => return None,
            Err(TryLockError::WouldBlock) => thread::sleep(Duration::from_millis(1)),
        }
    }
}

/// Saves the last document seen, for a program that is about to end. Returns its file, if it is saved.
pub fn save_last() -> Option<PathBuf> {
    within_moments(&LAST)?.upgrade()?.save_last()
}

/// Before a panic is reported, the document is saved.
pub fn install_panic_hook() {
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        // What writes cannot save from within.
        if thread::current().name() != Some("keep")
            && let Some(file) = save_last()
        {
            log::error!("the document was saved to {}", file.display());
        }
        report(info);
    }));
}

/// Saves the document when the main thread ends, for instance because the display is gone: Xlib then ends the process from
/// within. To be called on the main thread.
pub fn save_on_exit() {
    struct Last;
    impl Drop for Last {
        fn drop(&mut self) {
            // On a separate thread: its thread-local values may already be destroyed on this one.
            let saving = thread::Builder::new().name("last".to_owned()).spawn(save_last);
            let _ended = saving.map(thread::JoinHandle::join);
        }
    }
    thread_local!(static LAST: Last = const { Last });
    LAST.with(|_| ());
}

/// Saves the document before a signal ends the program.
#[cfg(unix)]
pub fn save_on_signals() -> io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::low_level::emulate_default_handler;
    let taken = [SIGTERM, SIGINT, SIGHUP].into_iter().filter(|signal| !is_ignored(*signal));
    let mut signals = signal_hook::iterator::Signals::new(taken)?;
    let work = move || {
        for signal in signals.forever() {
            // Whatever the disk does, the program ends.
            save_last();
            let _ended = emulate_default_handler(signal);
        }
    };
    thread::Builder::new().name("signals".to_owned()).spawn(work).map(drop)
}

/// Elsewhere the system closes the window, or ends the process without a word.
#[cfg(not(unix))]
pub fn save_on_signals() -> io::Result<()> {
    Ok(())
}

/// True if the parent process had the program ignore a signal, as `nohup` does.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}
