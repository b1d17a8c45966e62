//! The tests of mesh_reading.
