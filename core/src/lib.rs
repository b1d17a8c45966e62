//! Chromascope's computation: how digital cameras render color, from spectra.
//!
//! Light × surface × sensor, wavelength by wavelength. A camera's three spectral sensitivities are not the eye's, so its
//! colors differ from what an observer sees, in ways that can be computed. This crate does that and nothing else: same input,
//! same output. It opens no file, reads no clock, environment or locale, and knows nothing of windows.
//!
//! It is the face of three crates, which can be had alone:
//!
//! ```text
//! chromascope-color     spectra, lights, cameras, corrections, metrics: no mesh
//! chromascope-render    reflectance of rough surfaces; mesh × viewpoint × light → pictures through each camera
//! chromascope-query     each of these as a value that holds all it depends on
//! ```
//!
//! # Conventions
//!
//! - Wavelengths in nanometers, temperatures in kelvins, reflectances as fractions, Y = 1 for a perfect white.
//! - Integrals over 380–780 nm at 1 nm by the trapezoid rule ([`spectral::grid`]).
//! - Sensitivities per unit energy. Negative values are kept until a color is encoded for a screen.
//! - "No chromaticity" is a value, never NaN. Past its constructors the crate is total.
//! - One number type, `f64`; matrices are `glam`'s, named result-from-argument.
//!
//! # Out of scope
//!
//! Fluorescence, polarization, lenses. Bytes of camera profiles (DCP, ICC) are written by `chromascope-profile`.
//!
#![doc = include_str!("../color/src/sources.md")]

pub use chromascope_color::*;
pub use chromascope_mesh as mesh;
pub use chromascope_query as query;
pub use chromascope_render::{reflectance, render, scene};

pub mod prelude;
