//! Share of light that a surface returns: where the reflectance model loses or makes energy.

use crate::ask::{Ask, Query};
use chromascope_render::reflectance::power::{LAMBDA_0_NM, factor};
use chromascope_render::reflectance::{Geometry, Normalization, Surface, directional_hemispherical};

/// The grazing angle of incidence that is stated beside normal incidence, in degrees.
pub const GRAZING_DEG: f64 = 85.0;
/// Angles of incidence that are looked at, in degrees.
const ANGLES_DEG: [f64; 7] = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, GRAZING_DEG];
/// More than the quadrature is off by.
const SLACK: f64 = 4e-3;

/// Share of light that a surface returns, by angle of incidence.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ReturnedLightQuery {
    /// The surface.
    pub surface: Surface,
    /// The normalization of P.
    pub reading: Normalization,
}

/// Directional-hemispherical reflectance of a white of this surface at 550 nm ([`directional_hemispherical`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReturnedLight {
    /// At normal incidence.
    pub normal: f64,
    /// At [`GRAZING_DEG`].
    pub grazing: f64,
    /// Brightness of a white of this surface seen from the light at normal incidence, over that of a white that scatters evenly.
    pub facing: f64,
    /// Smallest angle of incidence, in degrees, from which on it exceeds 1; none where it does at no angle looked at.
    pub exceeds_one_from_deg: Option<f64>,
}

impl Query for ReturnedLightQuery {
    type Answer = ReturnedLight;
    const NAME: &'static str = "returned light";

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        let at = |degrees: f64| directional_hemispherical(&self.surface, self.reading, degrees.to_radians()).total();
        let shares = ANGLES_DEG.map(at);
        let first = shares.iter().position(|&share| share > 1.0 + SLACK);
        let exceeds_one_from_deg = first.map(|first| {
            let (mut below, mut above) = (ANGLES_DEG[first.saturating_sub(1)], ANGLES_DEG[first]);
            while above - below > 0.5 {
                let middle = f64::midpoint(below, above);
                *(if at(middle) > 1.0 + SLACK { &mut above } else { &mut below }) = middle;
            }
            above
        });
        let facing = factor(&self.surface, &Geometry::from_angles(0.0, 0.0, 0.0), LAMBDA_0_NM, self.reading, 0.0);
        ReturnedLight { normal: shares[0], grazing: shares[ANGLES_DEG.len() - 1], facing, exceeds_one_from_deg }
    }
}
