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

/// Kang, Moon, Hong, Lee, Cho and Kim 2002: the chromaticity of a blackbody, for 1667–25 000 K; none outside.
///
/// Cubics in 1/T for x, two of them, and in x for y, three. Only in this direction: the inverse was not published as a
/// formula, and as a search for the nearest point it would cost as much as the exact locus. Measured: within 6e-4 in xy.
pub fn kang_2002(temperature: Kelvin) -> Option<Xy> {
    let kelvins = temperature.get();
    if !(1667.0..=25_000.0).contains(&kelvins) {
        return None;
    }
    let r = 1e3 / kelvins;
    let cubic = |c: [f64; 4], s: f64| ((c[0] * s + c[1]) * s + c[2]) * s + c[3];
    let x = if kelvins <= 4000.0 {
        cubic([-0.266_123_9, -0.234_358_9, 0.877_695_6, 0.179_910], r)
    } else {
        cubic([-3.025_846_9, 2.107_037_9, 0.222_634_7, 0.240_390], r)
    };
    let y = if kelvins <= 2222.0 {
        [-1.106_381_4, -1.348_110_20, 2.185_558_32, -0.202_196_83]
    } else if kelvins <= 4000.0 {
        [-0.954_947_6, -1.374_185_93, 2.091_370_15, -0.167_488_67]
    } else {
        [3.081_758_0, -5.873_386_70, 3.751_129_97, -0.370_014_83]
    };
    Some(Xy { x, y: cubic(y, x) })
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
