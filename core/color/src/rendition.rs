//! Rendition of colors by a light: CIE 13.3 rendering indices, TM-30 fidelity and gamut, and the spectral similarity of SMPTE ST 2122.
//!
//! Each index follows the convention of its own standard, not the 380–780 nm grid of the rest, so that published numbers are met:
//!
//! | index | range | step | light is interpolated | beyond its table |
//! |---|---|---|---|---|
//! | Ra, R1–R14 | 360–780 nm | 1 nm | linearly | end value held |
//! | Rf, Rg | 380–780 nm | 5 nm for a table at 5 nm, else 1 nm | linearly | zero |
//! | SSI | 375–675 nm | 1 nm | linearly | zero |
//!
//! Test samples at 5 nm are brought to 1 nm by Sprague's interpolation.

pub mod cri;
pub mod fidelity;
pub mod reference;
pub mod similarity;
mod standards;

pub use cri::RenderingIndices;
pub use fidelity::{ColorFidelity, HueBin};
pub use similarity::spectral_similarity;
pub use standards::{RenditionError, Standards};
