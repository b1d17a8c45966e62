//! The tests of render.
