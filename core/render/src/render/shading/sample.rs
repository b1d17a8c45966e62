//! Samples of a shaded picture.

use crate::reflectance::{Geometry, Surface};

/// Spectral dependence of a sample's diffuse component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiffuseKind {
    /// No light, or below e^-30 of its peak.
    Dark,
    /// All wavelengths are scattered alike.
    Flat,
    /// An integral over wavelengths, by the method that each camera's [`Plan`](crate::render::Plan) has for it.
    Spectral,
}

/// One lit sample of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shade {
    /// Factor beside J: `cos θi cos⁴α` and the normalization's factor.
    pub front: f64,
    /// g at 550 nm.
    pub kappa: f64,
    /// b / g.
    pub beta: f64,
    /// Spectral dependence.
    pub kind: DiffuseKind,
}

impl Shade {
    pub(super) const DARK: Self = Self { front: 0.0, kappa: 0.0, beta: 0.0, kind: DiffuseKind::Dark };
}

/// A sample with a coherent component worth having.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoherentSample {
    /// The sample's place among the lit ones.
    pub index: u32,
    /// The factor beside `ρ0² e^-g`.
    pub front: f64,
    /// g at 550 nm.
    pub kappa: f64,
    /// `v_x / k` and `v_y / k`.
    pub v: [f64; 2],
}

/// A lit sample, or a vertex in its place.
pub(super) struct Place {
    pub(super) geometry: Geometry,
    /// Factor beside the reflectance.
    pub(super) light: f64,
    pub(super) surface: Surface,
    /// True if it scatters light evenly instead ([`chromascope_mesh::Part::is_matte`]).
    pub(super) is_matte: bool,
}
