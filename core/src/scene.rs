//! What is looked at: meshes, where they are seen from, what lights them, what they are made of.
//!
//! Lengths in meters. A mesh says nothing of spectra; a [`Surface`] says nothing of shape.

pub mod fern;
pub mod head;
pub mod mesh;
pub mod reading;

pub use mesh::{Bounds, Mesh, MeshError};
