//! The reader of DNG files.
