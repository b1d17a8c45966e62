//! Limits of what is read.

/// Most parts of a file that are listed and can be chosen.
pub(super) const MAX_PARTS: usize = 1000;

/// The most bytes a file may have: 64 MiB. Spectra of a whole session of measurements are far below.
pub const MAX_BYTES: usize = 64 << 20;

/// The most curves one table may hold.
pub const MAX_CURVES: usize = 100_000;

/// Maximum number of dropped rows that are listed.
pub(super) const MAX_DROPPED: usize = 1000;

/// The most samples (curves times wavelengths) one table may hold.
pub const MAX_SAMPLES: usize = 20_000_000;
