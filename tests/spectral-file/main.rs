//! The spectral file readers and writers against files with known contents, the program's own data, laws and hostile input.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should say so by failing")]
#![allow(clippy::disallowed_methods, reason = "the tests read files")]

mod corpus;
mod features;
mod table;
mod table_families;
mod table_preview;
mod table_write;
