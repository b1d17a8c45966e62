//! Cancelling of a computation.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Stop flag of a computation; polled once per tile.
#[derive(Clone, Debug, Default)]
pub struct Stop(Option<Arc<AtomicBool>>);

impl Stop {
    /// Never stops.
    pub const NEVER: Self = Self(None);

    /// Stops once the flag is set.
    pub fn at(flag: Arc<AtomicBool>) -> Self {
        Self(Some(flag))
    }

    /// True if the computation is to stop.
    pub fn is_set(&self) -> bool {
        self.0.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed))
    }
}
