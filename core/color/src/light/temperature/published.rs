//! Published methods, each within the range it was published for: to compare with, not to compute with.
//!
//! Closed formulas, and interpolation between a few points of the locus. Those tables are not copied but computed, from the
//! observer's own locus at the published temperatures.

use super::exact::{ExactLocus, Motion};
use super::result::{Cct, CctError, LocusError, MAX_DUV};
use crate::colorimetry::{Uv60, Xy, Xyz};
use crate::light::planckian::RadiationConstants;
use crate::math::interpolation::linear;
use crate::spectral::{Primaries, Sensor};
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

/// Robertson's 31 reciprocal temperatures in mired: every 10 up to 100, then every 25 up to 600.
fn robertson_mired(index: usize) -> f64 {
    if index <= 10 { 10.0 * index as f64 } else { 100.0 + 25.0 * (index - 10) as f64 }
}

/// Robertson 1968: between two of 31 isotherms, in proportion to the distances from them; from 1667 K to any heat.
///
/// His printed table (u, v and slope to five decimals, and c₂ = 1.4388e-2 m K) is replaced by exact values at the same
/// temperatures. Measured within 1.4e-3 of the temperature, 1.5e-4 in Duv. The slope of an isotherm is minus the inverse of the locus's, from the exact derivative.
#[derive(Clone, Debug, PartialEq)]
pub struct Robertson {
    isotherms: Vec<Isotherm>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Isotherm {
    mired: f64,
    at: Uv60,
    /// The unit tangent of the locus, towards colder bodies.
    along: [f64; 2],
}

impl Isotherm {
    /// Signed distance of a color on the cold side.
    fn beyond(&self, color: Uv60) -> f64 {
        (color.u - self.at.u) * self.along[0] + (color.v - self.at.v) * self.along[1]
    }

    /// Signed distance of a color above the tangent.
    fn above(&self, color: Uv60) -> f64 {
        (color.v - self.at.v) * self.along[0] - (color.u - self.at.u) * self.along[1]
    }
}

impl Robertson {
    /// The isotherms of an observer: 31 sums.
    ///
    /// # Errors
    /// [`LocusError`] if the observer's Planckian locus has no chromaticity or no direction at an isotherm.
    pub fn new(observer: &Sensor, constants: RadiationConstants) -> Result<Self, LocusError> {
        let locus = locus(observer, constants)?;
        let isotherm = |index| {
            let mired = robertson_mired(index);
            let Motion { at, per_mired: [du, dv] } = locus.motion(mired).ok_or(LocusError::NoChromaticity)?;
            let length = du.hypot(dv);
            (length > 0.0)
                .then_some(Isotherm { mired, at, along: [du / length, dv / length] })
                .ok_or(LocusError::Crooked)
        };
        Ok(Self { isotherms: (0..31).map(isotherm).collect::<Result<_, _>>()? })
    }

    /// The isotherms as Robertson printed them: sums from 360 to 830 nm, u and v rounded to five decimals, slopes to five digits.
    ///
    /// For the CIE 1931 observer all 31 rows are those of his table. Indices that are defined by it need its errors too.
    ///
    /// # Errors
    /// [`LocusError`] unless the observer counts in XYZ and sees blackbodies.
    pub fn as_printed(observer: &Sensor) -> Result<Self, LocusError> {
        if observer.primaries() != Primaries::Xyz {
            return Err(LocusError::NotXyz);
        }
        let isotherm = |index| {
            let mired = robertson_mired(index);
            let [at, before, after] = [0.0, -1e-3, 1e-3].map(|step| full_table(observer, mired + step));
            let ((at, before), after) = at.zip(before).zip(after).ok_or(LocusError::NoChromaticity)?;
            let slope = (before.u - after.u) / (after.v - before.v);
            let unit = 10_f64.powi(4 - slope.abs().log10().floor() as i32);
            let slope = (slope * unit).round() / unit;
            let at = Uv60 { u: (at.u * 1e5).round() / 1e5, v: (at.v * 1e5).round() / 1e5 };
            let length = slope.hypot(1.0);
            let along = [-slope / length, 1.0 / length];
            length.is_finite().then_some(Isotherm { mired, at, along }).ok_or(LocusError::Crooked)
        };
        Ok(Self { isotherms: (0..31).map(isotherm).collect::<Result<_, _>>()? })
    }

    /// Reciprocal temperature in mired, u, v and slope of each isotherm, from hot to cold.
    pub fn rows(&self) -> Vec<[f64; 4]> {
        self.isotherms.iter().map(|i| [i.mired, i.at.u, i.at.v, -i.along[0] / i.along[1]]).collect()
    }

    /// The temperature by his interpolation; the distance, which he did not give, by the same from the tangents of both.
    ///
    /// # Errors
    /// [`CctError`] if the color is not finite, too far from the locus, or beyond its ends.
    pub fn cct(&self, color: Uv60) -> Result<Cct, CctError> {
        finite(color)?;
        let side = |isotherm: &Isotherm| isotherm.beyond(color);
        let Some(first) = self.isotherms.first().filter(|&hottest| side(hottest) >= 0.0) else {
            return Err(CctError::TooHot);
        };
        let mut hot = *first;
        for cold in self.isotherms.iter().skip(1) {
            let (past, short) = (side(&hot), -side(cold));
            if short >= 0.0 {
                let share = if past + short > 0.0 { past / (past + short) } else { 0.0 };
                let duv = hot.above(color) + share * (cold.above(color) - hot.above(color));
                if duv.abs() > MAX_DUV {
                    return Err(CctError::TooFar);
                }
                let mired = hot.mired + share * (cold.mired - hot.mired);
                let temperature = Kelvin::from_mired(mired).map_err(|_| CctError::TooHot)?;
                return Ok(Cct { temperature, duv });
            }
            hot = *cold;
        }
        Err(CctError::TooCold)
    }
}

/// Chromaticity of a blackbody over the whole table of the CIE at 1 nm; below 0 mired the law of Rayleigh and Jeans goes on.
fn full_table(observer: &Sensor, mired: f64) -> Option<Uv60> {
    let second = RadiationConstants::Paper.second() * 1e3;
    let law = |nm: f64| {
        let exponent = second * mired / nm;
        // x / (exp(x) − 1), which is 1 at 0: the factor λ/x is common to all temperatures' chromaticities but for λ.
        let bend = if exponent == 0.0 { 1.0 } else { exponent / exponent.exp_m1() };
        (nm, bend * (560.0 / nm).powi(4))
    };
    let laws: Vec<(f64, f64)> = (360..=830).map(f64::from).map(law).collect();
    let [x, y, z] = observer.curves().each_ref().map(|curve| {
        let at = |nm| linear(curve.wavelengths_nm(), curve.values(), nm);
        laws.iter().map(|&(nm, law)| at(nm) * law).sum::<f64>()
    });
    Some(Xyz { x, y, z }.uv_prime()?.uv60())
}

/// Ohno 2013: the nearest of 305 blackbodies, a hundredth apart, and its two neighbors; from 1000 to 20 000 K.
///
/// Close to the locus (|Duv| < 0.002) the foot of a triangle over the two neighbors, further off the lowest point of a parabola
/// through the three distances; both times his factor for a table in steps of 1 %. Measured within 4e-4 of the temperature, worst
/// where the two solutions meet, and within 1e-4 in Duv.
#[derive(Clone, Debug, PartialEq)]
pub struct Ohno {
    points: Vec<(f64, Uv60)>,
}

/// The step of the table, as a factor.
const STEP: f64 = 1.01;
/// His correction of temperatures that were interpolated over such steps.
const CORRECTION: f64 = 0.999_91;
/// Relative amount by which temperatures at the ends of the domain may exceed it.
const ENDS: f64 = 5e-4;
/// Duv at which the triangle gives way to the parabola.
const TRIANGLE_TO: f64 = 0.002;

impl Ohno {
    /// The table of an observer: 305 sums.
    ///
    /// # Errors
    /// [`LocusError`] if the observer's Planckian locus has no chromaticity at an entry.
    pub fn new(observer: &Sensor, constants: RadiationConstants) -> Result<Self, LocusError> {
        let locus = locus(observer, constants)?;
        let point = |index| {
            // One before 1000 K and one past 20000 K, so that those have two neighbors.
            let kelvins = 1000.0 * STEP.powi(index - 1);
            Ok((kelvins, locus.motion(1e6 / kelvins).ok_or(LocusError::NoChromaticity)?.at))
        };
        Ok(Self { points: (0..305).map(point).collect::<Result<_, _>>()? })
    }

    /// The temperature and Duv of a color.
    ///
    /// # Errors
    /// [`CctError`] if the color is not finite, too far from the locus, or beyond its ends.
    pub fn cct(&self, color: Uv60) -> Result<Cct, CctError> {
        finite(color)?;
        let distance = |at: Uv60| (at.u - color.u).hypot(at.v - color.v);
        let distances: Vec<f64> = self.points.iter().map(|&(_, at)| distance(at)).collect();
        let nearest = (0..distances.len()).min_by(|&a, &b| distances[a].total_cmp(&distances[b])).unwrap_or(0);
        if distances.get(nearest).is_none_or(|&d| d > MAX_DUV * 1.01) {
            return Err(CctError::TooFar);
        }
        if nearest == 0 {
            return Err(CctError::TooCold);
        }
        let (Some(points), Some(&[a, b, c])) = (
            self.points.get(nearest - 1..nearest + 2),
            distances.get(nearest - 1..nearest + 2).and_then(|three| three.first_chunk::<3>()),
        ) else {
            return Err(CctError::TooHot);
        };
        let ((ta, pa), (tb, _), (tc, pc)) = (points[0], points[1], points[2]);
        let width = (pc.u - pa.u).hypot(pc.v - pa.v);
        let foot = (a * a - c * c + width * width) / (2.0 * width);
        let share = foot / width;
        let sign = if color.v >= pa.v + (pc.v - pa.v) * share { 1.0 } else { -1.0 };
        let height = (a * a - foot * foot).max(0.0).sqrt();
        let (kelvins, duv) = if height < TRIANGLE_TO {
            (ta + (tc - ta) * share, sign * height)
        } else {
            let (t, d) = parabola([(ta, a), (tb, b), (tc, c)]);
            (t, sign * d)
        };
        if duv.abs() > MAX_DUV {
            return Err(CctError::TooFar);
        }
        let temperature = within(kelvins * CORRECTION, 1000.0 * (1.0 - ENDS), 20_000.0 * (1.0 + ENDS))?;
        Ok(Cct { temperature, duv })
    }
}

/// The lowest point of the parabola through three.
fn parabola([(x0, y0), (x1, y1), (x2, y2)]: [(f64, f64); 3]) -> (f64, f64) {
    let (first, second) = ((y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1));
    let bend = (second - first) / (x2 - x0);
    let x = 0.5 * (x0 + x1 - first / bend);
    (x, y0 + (x - x0) * (first + bend * (x - x1)))
}

fn locus(observer: &Sensor, constants: RadiationConstants) -> Result<ExactLocus<'_>, LocusError> {
    (observer.primaries() == Primaries::Xyz).then(|| ExactLocus::new(observer, constants)).ok_or(LocusError::NotXyz)
}

/// True if there is a color, and one whose squares are finite.
fn finite(color: Uv60) -> Result<(), CctError> {
    if !(color.u.is_finite() && color.v.is_finite()) {
        return Err(CctError::NoChromaticity);
    }
    if color.u.abs().max(color.v.abs()) > 10.0 { Err(CctError::TooFar) } else { Ok(()) }
}
