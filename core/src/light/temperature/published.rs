//! Published closed formulas, each within the range it was published for: to compare with, not to compute with.

use super::result::CctError;
use crate::colorimetry::Xy;
use crate::units::Kelvin;

/// `McCamy` 1992: a cubic, for 2856–6504 K.
///
/// ```text
/// T = −449 n³ + 3525 n² − 6823.3 n + 5520.33,   n = (x − 0.3320) / (y − 0.1858)
/// ```
/// Claimed to be off by less than 2 K from illuminant A to D65, and refused where the result lies further beyond those than
/// 2 K. Measured against the locus of today's constants it is off by up to 10 K (0.28 %, at 3475 K), and it gives no Duv.
///
/// # Errors
/// [`CctError`] if the slope is undefined or the temperature outside the range.
pub fn mccamy_1992(color: Xy) -> Result<Kelvin, CctError> {
    let n = slope(color, 0.3320, 0.1858)?;
    within(((-449.0 * n + 3525.0) * n - 6823.3) * n + 5520.33, 2854.0, 6506.0)
}

/// Hernández-Andrés, Lee and Romero 1999: sums of exponentials, for 3000–800 000 K, in two parts that meet at 50 000 K.
///
/// ```text
/// T = A₀ + Σ A_i exp(−n / t_i),   n = (x − x_e) / (y − y_e)
/// ```
/// Made for daylight and skylight; measured on the Planckian locus up to 20 000 K it is within 1.4 %. It gives no Duv.
///
/// # Errors
/// [`CctError`] if the slope is undefined or the temperature outside the range.
pub fn hernandez_andres_1999(color: Xy) -> Result<Kelvin, CctError> {
    let n = slope(color, 0.3366, 0.1735)?;
    let terms = [(6_253.803_38, 0.921_59), (28.705_99, 0.200_39), (0.000_04, 0.071_25)];
    let kelvins = terms.iter().fold(-949.863_15, |sum, (a, t)| sum + a * (-n / t).exp());
    if kelvins <= 50_000.0 {
        return within(kelvins, 3000.0, 50_000.0);
    }
    let n = slope(color, 0.3356, 0.1691)?;
    let terms = [(0.002_28, 0.078_61), (5.453_5e-36, 0.015_43)];
    let kelvins = terms.iter().fold(36_284.489_53, |sum, (a, t)| sum + a * (-n / t).exp());
    // The parts do not meet exactly: what one gives to the other must be on the other's side.
    within(kelvins, 50_000.0, 800_000.0)
}

/// The inverse slope of the line from a point where isotherms roughly meet. Below that point no temperature is defined.
fn slope(color: Xy, x: f64, y: f64) -> Result<f64, CctError> {
    if !(color.x.is_finite() && color.y.is_finite()) {
        return Err(CctError::NoChromaticity);
    }
    if color.y <= y { Err(CctError::TooFar) } else { Ok((color.x - x) / (color.y - y)) }
}

/// A result, if it is in the published range.
fn within(kelvins: f64, coldest: f64, hottest: f64) -> Result<Kelvin, CctError> {
    if kelvins < coldest {
        return Err(CctError::TooCold);
    }
    if kelvins > hottest {
        return Err(CctError::TooHot);
    }
    Kelvin::new(kelvins).map_err(|_| CctError::TooFar)
}
