//! A scene beside its mesh: the viewpoint, the light's place, and roughness from the mesh's own vertices.
//!
//! Lengths in meters. Nothing here names a spectrum or a camera.

pub mod lighting;
pub mod roughness;
pub mod viewpoint;

pub use lighting::{Lighting, PlacedLight, SUN_RADIUS};
pub use viewpoint::{Eye, Viewpoint};
