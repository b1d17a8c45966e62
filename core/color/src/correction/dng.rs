//! Matrices of DNG files and DCP profiles, and their interpolation between two lights.

use crate::colorimetry::adaptation::bradford;
use crate::colorimetry::{Xy, Xyz};
use crate::units::Kelvin;
use glam::{DMat3, DVec3};

/// White of DNG's profile connection space: D50 (DNG 1.6, chapter 6).
pub const D50: Xy = Xy { x: 0.3457, y: 0.3585 };

/// Matrices of one calibration light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DngMatrices {
    /// `ColorMatrix`: camera RGB before balance, from XYZ under the light; the largest component for D50 is 1.
    pub color: DMat3,
    /// `ForwardMatrix`: XYZ relative to D50, from camera RGB that is balanced to unity; white goes to D50 exactly.
    pub forward: DMat3,
    /// White-balance multipliers, the least 1.
    pub balance: [f64; 3],
}

impl DngMatrices {
    /// Matrices of a transform M from balanced RGB to XYZ under a light.
    ///
    /// ```text
    /// ColorMatrix   = k diag(w) M⁻¹              w = raw signals of white, k so that the largest component for D50 is 1
    /// ForwardMatrix = diag(D50 / F 1) F,         F = Bradford(white → D50) M
    /// ```
    /// None where M has no inverse, or the white cannot be adapted.
    pub fn new(xyz_from_balanced: DMat3, raw_white: DVec3, white: Xyz) -> Option<Self> {
        let d50 = D50.with_unit_luminance()?;
        let forward = ProfileMatrix::new(xyz_from_balanced, white, d50)?.xyz_from_rgb;
        let inverse = xyz_from_balanced.inverse();
        let color = DMat3::from_diagonal(raw_white) * inverse;
        let color = color * (color * d50.to_vector()).max_element().recip();
        let balance = (raw_white.max_element() / raw_white).to_array();
        let finite = color.is_finite() && balance.iter().all(|v| v.is_finite() && *v > 0.0);
        finite.then_some(Self { color, forward, balance })
    }

    /// Camera RGB of white, the largest 1: `AsShotNeutral` under the light.
    pub fn neutral(&self) -> DVec3 {
        DVec3::from_array(self.balance).recip()
    }

    /// Matrices of the same camera with each channel multiplied by a gain. `ForwardMatrix`, from balanced RGB, stays.
    ///
    /// ```text
    /// ColorMatrix = k diag(gain) ColorMatrix,   k so that the largest component for D50 is 1
    /// ```
    /// None where a gain is not positive or a result not finite.
    #[must_use]
    pub fn with_gains(&self, gains: DVec3) -> Option<Self> {
        let (d50, neutral) = (D50.with_unit_luminance()?, self.neutral() * gains);
        let color = DMat3::from_diagonal(gains) * self.color;
        let color = color * (color * d50.to_vector()).max_element().recip();
        let balance = neutral.max_element() / neutral;
        let finite = color.is_finite() && balance.is_finite() && balance.min_element() > 0.0;
        finite.then_some(Self { color, forward: self.forward, balance: balance.to_array() })
    }
}

/// Matrix from balanced RGB to a profile connection space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileMatrix {
    /// XYZ relative to the connection space's white, from camera RGB balanced to unity; (1, 1, 1) goes to that white.
    pub xyz_from_rgb: DMat3,
    /// Bradford adaptation from the light's white.
    pub adaptation: DMat3,
}

impl ProfileMatrix {
    /// Adapts a transform from the light's white to another; none where that cannot be done.
    ///
    /// A transform that does not keep white is scaled row by row until it does, as readers of DNG do.
    pub fn new(xyz_from_balanced: DMat3, white: Xyz, to: Xyz) -> Option<Self> {
        let adaptation = bradford(white, to)?;
        let adapted = adaptation * xyz_from_balanced;
        let scale = to.to_vector() / (adapted * DVec3::ONE);
        let xyz_from_rgb = DMat3::from_diagonal(scale) * adapted;
        xyz_from_rgb.is_finite().then_some(Self { xyz_from_rgb, adaptation })
    }
}

/// Weight of the first of two lights at a temperature: linear in 1/T between them, 0 or 1 beyond (DNG 1.6, chapter 6).
pub fn first_weight(temperature: Kelvin, first: Kelvin, second: Kelvin) -> f64 {
    let span = first.mired() - second.mired();
    if span == 0.0 {
        return 1.0;
    }
    ((temperature.mired() - second.mired()) / span).clamp(0.0, 1.0)
}

/// Mixture of two matrices.
pub fn mixed(first: DMat3, second: DMat3, first_weight: f64) -> DMat3 {
    first * first_weight + second * (1.0 - first_weight)
}
