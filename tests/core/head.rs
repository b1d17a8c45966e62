//! The tests of head.
