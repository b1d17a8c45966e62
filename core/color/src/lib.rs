//! Color from spectra: light × surface × sensor, wavelength by wavelength.
//!
//! ```text
//! spectral::dataset          bytes → curves with units
//! spectral                   curves → the 1 nm grid, with what was assumed
//! light · patch_set · camera    L, S, C
//! correction                 fits of XYZ to RGB: 3×3, root polynomial; DNG and ACES matrices
//! camera::rendering          ∫ C S L dλ → balanced RGB → XYZ           Eq 11, 13, 16
//! camera::locus              ∫ C E(T) dλ                                Eq 14, 15
//! colorimetry                XYZ → xy, u′v′, L*a*b*, ΔE, sRGB
//! light::temperature         XYZ → nearest blackbody, Duv
//! rendition                  light → Ra, Rf and Rg, SSI
//! camera::locus_table        blackbodies → xy, for very many temperatures
//! camera::quality            Vora, Luther, metamerism index, noise      feature `fits`
//! metamers                   pairs that a camera confuses
//! recovery                   recorded values → sensitivities with their covariance
//! camera::batch              ∫ C S L dλ for very many S and C
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
#![doc = include_str!("sources.md")]
#![allow(
    clippy::inline_always,
    clippy::needless_range_loop,
    reason = "only inside the caller is a kernel compiled for the caller's instruction set, and iterators call functions outside"
)]

pub use chromascope_math as math;
pub use glam;

pub mod accuracy;
pub mod camera;
pub mod colorimetry;
pub mod correction;
#[cfg(feature = "data")]
pub mod data;
pub mod light;
pub mod metamers;
pub mod patch_set;
pub mod recovery;
pub mod rendition;
pub mod spectral;
pub mod units;
