//! Metamers: pairs of reflectances that a camera confuses and an observer separates, and the reverse.

mod search;
mod synthetic;

pub use search::{Confusion, MetamerLimits, MetamerLimitsError, MetamerPair, Seen, search};
pub use synthetic::{metameric_black, synthetic_metamer};
