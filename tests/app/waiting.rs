//! Waiting for what must come: the one place in the tests that reads a clock or sleeps.
//!
//! A test that needs something to be slow, or to have not happened yet, drives an [`Executor`](chromascope::jobs::Executor)
//! in place of waiting.

use std::time::{Duration, Instant};

/// Far longer than anything takes on the slowest machine: only a test that fails waits for so long.
const LIMIT: Duration = Duration::from_mins(1);

/// Polls until a result is available, with a short pause between. On failure, the message describes the last state.
#[track_caller]
pub(crate) fn until<T>(what: &str, mut found: impl FnMut() -> Result<T, String>) -> T {
    let start = Instant::now();
    loop {
        match found() {
            Ok(found) => return found,
            Err(instead) => assert!(start.elapsed() < LIMIT, "{what} did not come: {instead}"),
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}
