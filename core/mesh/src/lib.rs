//! Triangle meshes with vertex normals: a head and a fern, meshes from OBJ, PLY and STL files, and a tree for shadow rays.
//!
//! Lengths in meters. A mesh names no spectrum, roughness or camera.

pub mod fern;
mod hair;
#[cfg(feature = "data")]
pub mod head;
pub mod mesh;
pub mod reading;
pub mod shadow;
pub mod shapes;
pub mod stage;
#[cfg(feature = "data")]
mod subdivision;

pub use mesh::{Bounds, Mesh, MeshError, Part};
pub use shadow::ShadowTree;
