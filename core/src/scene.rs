//! What is looked at: meshes, where they are seen from, what lights them.
//!
//! Lengths in meters. A mesh says nothing of spectra, roughness or cameras.

pub mod fern;
pub mod head;
pub mod implicit;
pub mod lighting;
pub mod mesh;
pub mod reading;
pub mod roughness;
pub mod shapes;
pub mod viewpoint;

pub use lighting::{Lighting, PlacedLight, SUN_RADIUS};
pub use mesh::{Bounds, Mesh, MeshError};
pub use viewpoint::{Eye, Viewpoint};
