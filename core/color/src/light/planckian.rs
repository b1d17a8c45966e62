//! Planck's law (Eq 14), stable from 1 K to 10¹⁵ K.

use crate::spectral::GridSpectrum;
use crate::spectral::grid::LAST_NM;
use crate::units::Kelvin;

/// The two constants of Planck's law, by edition.
///
/// c₁ cancels in every chromaticity; the two editions' c₂ differ by 1.6e-5, which is 0.09 K at 5500 K and at most 3.6e-6 in xy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum RadiationConstants {
    /// Those printed in the paper: c₁ = 3.74183e-16 W m² (CODATA 1973), c₂ = 1.4388e-2 m K (ITS-90).
    #[default]
    Paper,
    /// From the exact SI values of h, c and k (2019): c₁ = 2πhc², c₂ = hc/k.
    Si2019,
}

impl RadiationConstants {
    /// The first radiation constant c₁ = 2πhc², in W m².
    pub fn first(self) -> f64 {
        match self {
            Self::Paper => 3.741_83e-16,
            Self::Si2019 => 2.0 * std::f64::consts::PI * PLANCK * LIGHT_SPEED * LIGHT_SPEED,
        }
    }

    /// The second radiation constant c₂ = hc/k, in m K.
    pub fn second(self) -> f64 {
        match self {
            Self::Paper => 1.438_8e-2,
            Self::Si2019 => PLANCK * LIGHT_SPEED / BOLTZMANN,
        }
    }
}

/// h in J s, exact (SI 2019).
const PLANCK: f64 = 6.626_070_15e-34;
/// c in m/s, exact.
const LIGHT_SPEED: f64 = 299_792_458.0;
/// k in J/K, exact (SI 2019).
const BOLTZMANN: f64 = 1.380_649e-23;

/// The spectral exitance of a blackbody, in W m⁻³ (Eq 14); 0 unless the wavelength is positive.
///
/// ```text
/// E(λ, T) = c₁ / (λ⁵ (exp(c₂ / (λ T)) − 1))
/// ```
/// Exitance, since c₁ = 2πhc²; divide by π for radiance per steradian. Relative error below 1e-14 and, in the
/// conditioning of the exponent, `c₂/(λT) ε`. Where the exponent overflows, E is zero, which is right to within 1e-300; what is
/// beyond all doubles is the largest of them.
///
/// ```
/// use chromascope_core::light::{RadiationConstants, planckian::exitance};
/// use chromascope_core::units::Kelvin;
/// let e = exitance(555.0, Kelvin::new(5500.0)?, RadiationConstants::Paper);
/// assert!((e / 6.433_997e13 - 1.0).abs() < 1e-6);
/// # Ok::<(), chromascope_core::units::NotPositive>(())
/// ```
pub fn exitance(wavelength_nm: f64, temperature: Kelvin, constants: RadiationConstants) -> f64 {
    let meters = wavelength_nm * 1e-9;
    let exponent = constants.second() / (meters * temperature.get());
    let value = constants.first() / (meters.powi(5) * exponent.exp_m1());
    // Where λ⁵ underflows the exponent decides: NaN is 0 times infinity.
    if value.is_nan() || wavelength_nm <= 0.0 { 0.0 } else { value.min(f64::MAX) }
}

/// Exitance relative to that at `anchor_nm`, which no temperature can overflow or blank.
///
/// ```text
/// E(λ,T) / E(λ₀,T) = exp(−(x − x₀)) · expm1(−x₀) / expm1(−x) · (λ₀/λ)⁵,   x = c₂/(λT)
/// ```
/// For wavelengths up to the anchor the exponential is at most 1. Checked from 1 K to 10¹⁵ K. Never subnormal: 0 in place of it.
pub fn relative_exitance(
    wavelength_nm: f64,
    anchor_nm: f64,
    temperature: Kelvin,
    constants: RadiationConstants,
) -> f64 {
    // Capped so that temperatures far below any body's stay finite too.
    let scale = (constants.second() * 1e9 / temperature.get()).min(1e300);
    let (x, x0) = (scale / wavelength_nm, scale / anchor_nm);
    // (x - x0) without cancellation: both are large at low temperatures.
    let difference = scale * (anchor_nm - wavelength_nm) / (wavelength_nm * anchor_nm);
    let value = (-difference).exp() * ((-x0).exp_m1() / (-x).exp_m1()) * (anchor_nm / wavelength_nm).powi(5);
    // A light of subnormal numbers would be slow to compute with.
    if value < f64::MIN_POSITIVE { 0.0 } else { value }
}

/// A blackbody as a light on the grid, relative to its power at 780 nm below 3715 K and at its peak above that.
pub fn black_body(temperature: Kelvin, constants: RadiationConstants) -> GridSpectrum {
    // Wien: the peak is at c₂ / (4.965114 T); anchored there, nothing overflows.
    let peak_nm = constants.second() * 1e9 / 4.965_114_231_744_276 / temperature.get();
    let anchor = peak_nm.clamp(crate::spectral::grid::FIRST_NM, LAST_NM);
    GridSpectrum::from_fn(|nm| relative_exitance(nm, anchor, temperature, constants))
}
