//! The tests of fern.
