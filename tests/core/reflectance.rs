//! The tests of reflectance.
