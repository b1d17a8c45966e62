//! White balance (Eq 11): the color that a perfect white under the light is to take.

use crate::colorimetry::rgb::SRGB_FROM_XYZ_PUBLISHED;
use crate::colorimetry::{Xyz, tristimulus::Xy};
use crate::math::interpolation::linear;
use crate::spectral::{Sensor, SpectralDistribution};
use crate::units::{bits, hash_by};

/// The color s that a perfect white takes, in balanced camera RGB: `I_c = s_c ∫C_c S L dλ / ∫C_c L dλ`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhiteBalanceTarget(pub [f64; 3]);

hash_by!(WhiteBalanceTarget, |of| of.0.map(bits));

impl WhiteBalanceTarget {
    /// Unity: the paper's first two experiments.
    pub const UNITY: Self = Self([1.0, 1.0, 1.0]);

    /// The white of given tristimulus values with Y = 1, in linear sRGB.
    ///
    /// By the published four-decimal inverse of M: for D55 that gives the paper's 1.1040 : 0.9870 : 0.8233 to all digits
    /// (the exact inverse: 1.1040 : 0.9869 : 0.8233).
    pub fn from_xyz(xyz: Xyz) -> Self {
        Self((SRGB_FROM_XYZ_PUBLISHED * xyz.to_vector()).to_array())
    }

    /// The white of a chromaticity, or none where it has no luminance.
    pub fn from_chromaticity(xy: Xy) -> Option<Self> {
        xy.with_unit_luminance().map(Self::from_xyz)
    }

    /// The color of a light as an XYZ observer sees it, or none where it sees nothing.
    ///
    /// The trapezoid sum over the light's own samples, as published whites are made of 5 nm tables: between 360 and 380 nm, off
    /// the grid, lie 3e-4 of D55's Z, which the paper's four digits show.
    pub fn from_light(light: &SpectralDistribution, observer: &Sensor) -> Option<Self> {
        let nm = light.wavelengths_nm();
        let width = |i: usize| nm[(i + 1).min(nm.len() - 1)] - nm[i.saturating_sub(1)];
        let [x, y, z] = observer.curves().each_ref().map(|curve| {
            let [first, last] = curve.range_nm();
            let within = (0..nm.len()).filter(|&i| (first..=last).contains(&nm[i]));
            let matched = |i: usize| linear(curve.wavelengths_nm(), curve.values(), nm[i]);
            within.map(|i| light.values()[i] * matched(i) * width(i)).sum::<f64>()
        });
        (y > 0.0).then(|| Self::from_xyz(Xyz::new(x / y, 1.0, z / y)))
    }
}
