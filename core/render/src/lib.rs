//! Rough surfaces and meshes through cameras, wavelength by wavelength.
//!
//! ```text
//! reflectance        Fresnel, geometric attenuation, mean scattered power      Eq 1-4
//! scene              where the eye and the lights are
//! render             mesh × viewpoint × light → pictures through each camera
//! ```
#![allow(
    clippy::inline_always,
    clippy::needless_range_loop,
    reason = "only inside the caller is a kernel compiled for the caller's instruction set, and iterators call functions outside"
)]

pub mod reflectance;
pub mod render;
pub mod scene;
