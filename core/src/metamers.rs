//! Metamers: pairs of reflectances that a camera confuses and an observer separates, and the reverse.

mod search;

pub use search::{Confusion, MetamerLimits, MetamerLimitsError, MetamerPair, Seen, search};
