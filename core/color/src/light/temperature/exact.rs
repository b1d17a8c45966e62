//! The locus itself: 1 nm sums of Planck's law over matching functions, with their derivative.

use crate::colorimetry::{Uv60, Xyz};
use crate::light::planckian::RadiationConstants;
use crate::spectral::Sensor;
use crate::spectral::grid::{COUNT, LAST_NM, wavelength_nm};

/// The wavelength whose logarithmic derivative is taken off all others, in nanometers: what is common to all wavelengths
/// changes no chromaticity, and without it less cancels.
const MIDDLE_NM: f64 = 560.0;

/// A point of the Planckian locus and how fast it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    pub(super) at: Uv60,
    /// The derivative of u and v by the reciprocal temperature, per mired.
    pub(super) per_mired: [f64; 2],
}

/// Planck's law over one observer's matching functions, at any reciprocal temperature from 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExactLocus<'a> {
    observer: &'a Sensor,
    /// c₂ in nm / mired: the exponent at λ nm and m mired is `c₂ m / λ`.
    second: f64,
}

impl<'a> ExactLocus<'a> {
    pub(super) fn new(observer: &'a Sensor, constants: RadiationConstants) -> Self {
        Self { observer, second: constants.second() * 1e3 }
    }

    /// The locus at a reciprocal temperature in mired, or none where the observer sees nothing there.
    ///
    /// ```text
    /// E ∝ λ⁻⁵ / (exp(x) − 1),   dE/dm = −E · (c₂/λ) / (1 − exp(−x)),   x = c₂ m / λ
    /// ```
    /// At m = 0, infinitely hot, E ∝ λ⁻⁴ and the derivative is half as large, both up to what all wavelengths share.
    pub(super) fn motion(&self, mired: f64) -> Option<Motion> {
        let (mut law, mut slope) = ([0.0; COUNT], [0.0; COUNT]);
        let middle = self.fall(MIDDLE_NM, mired);
        for index in 0..COUNT {
            let nm = wavelength_nm(index);
            law[index] = self.relative(nm, mired);
            slope[index] = law[index] * (middle - self.fall(nm, mired));
        }
        let [x, y, z] = self.observer.integrate(&law);
        let [dx, dy, dz] = self.observer.integrate(&slope);
        let at = Xyz::new(x, y, z).uv_prime()?.uv60();
        let (sum, change) = (x + 15.0 * y + 3.0 * z, dx + 15.0 * dy + 3.0 * dz);
        let per_mired = [(4.0 * dx - at.u * change) / sum, (6.0 * dy - at.v * change) / sum];
        per_mired.iter().all(|d| d.is_finite()).then_some(Motion { at, per_mired })
    }

    /// The exitance relative to that at the grid's last wavelength.
    fn relative(&self, nm: f64, mired: f64) -> f64 {
        let fifth = (LAST_NM / nm).powi(5);
        let scale = self.second * mired;
        if scale == 0.0 {
            return fifth * nm / LAST_NM;
        }
        let difference = scale * (LAST_NM - nm) / (nm * LAST_NM);
        (-difference).exp() * ((-scale / LAST_NM).exp_m1() / (-scale / nm).exp_m1()) * fifth
    }

    /// Minus the logarithmic derivative by m, less 1/m, which all wavelengths share, at m = 0.
    fn fall(&self, nm: f64, mired: f64) -> f64 {
        let rate = self.second / nm;
        if mired == 0.0 { rate / 2.0 } else { rate / -(-rate * mired).exp_m1() }
    }
}
