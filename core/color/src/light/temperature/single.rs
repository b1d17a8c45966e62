//! The nearest blackbody of one color, without tabulating the locus.

use super::exact::ExactLocus;
use super::result::{COLDEST_MIRED, Cct, CctError, HOTTEST_MIRED, MAX_DUV, SLACK};
use crate::colorimetry::Uv60;
use crate::light::planckian::RadiationConstants;
use crate::spectral::{Primaries, Sensor};
use crate::units::Kelvin;

/// Spacing of the first search in mired.
const STEP: f64 = 25.0;

/// Correlated color temperature and Duv of one color: some 60 sums over the observer's curves, where
/// [`super::PlanckianLocus`] takes 2100 before its first answer. The two agree within 1e-6 mired and 1e-12 in Duv.
///
/// # Errors
/// [`CctError`] as for [`super::PlanckianLocus::cct`]; [`CctError::NoChromaticity`] unless the observer counts in XYZ.
pub fn nearest_blackbody(observer: &Sensor, constants: RadiationConstants, color: Uv60) -> Result<Cct, CctError> {
    if observer.primaries() != Primaries::Xyz || !(color.u.is_finite() && color.v.is_finite()) {
        return Err(CctError::NoChromaticity);
    }
    if color.u.abs().max(color.v.abs()) > 10.0 {
        return Err(CctError::TooFar);
    }
    let locus = ExactLocus::new(observer, constants);
    let motion = |mired: f64| locus.motion(mired).ok_or(CctError::NoChromaticity);
    let count = ((COLDEST_MIRED - HOTTEST_MIRED) / STEP).ceil() as usize;
    let mut best = (HOTTEST_MIRED, f64::INFINITY);
    for mired in (0..=count).map(|index| (HOTTEST_MIRED + STEP * index as f64).min(COLDEST_MIRED)) {
        let at = motion(mired)?.at;
        let distance = (at.u - color.u).hypot(at.v - color.v);
        if distance < best.1 {
            best = (mired, distance);
        }
    }
    // Half the derivative of the squared distance: rises through zero at the nearest point.
    let slope = |mired: f64| {
        let motion = motion(mired)?;
        let [du, dv] = motion.per_mired;
        Ok::<f64, CctError>((motion.at.u - color.u) * du + (motion.at.v - color.v) * dv)
    };
    let mired = root(best.0 - STEP, best.0 + STEP, slope)?;
    let nearest = motion(mired.clamp(HOTTEST_MIRED, COLDEST_MIRED))?;
    let (u, v) = (color.u - nearest.at.u, color.v - nearest.at.v);
    if u.hypot(v) > MAX_DUV * (1.0 + SLACK) {
        return Err(CctError::TooFar);
    }
    if mired < HOTTEST_MIRED * (1.0 - 1e-9) {
        return Err(CctError::TooHot);
    }
    if mired > COLDEST_MIRED * (1.0 + 1e-9) {
        return Err(CctError::TooCold);
    }
    let [du, dv] = nearest.per_mired;
    let duv = (v * du - u * dv) / du.hypot(dv);
    Ok(Cct { temperature: Kelvin::from_mired(mired).map_err(|_| CctError::TooHot)?, duv })
}

/// Zero of a function between two ends, by the Illinois variant of regula falsi; an end where there is none.
fn root(low: f64, high: f64, f: impl Fn(f64) -> Result<f64, CctError>) -> Result<f64, CctError> {
    let (mut a, mut b) = (low, high);
    let (mut fa, mut fb) = (f(a)?, f(b)?);
    if fa >= 0.0 {
        return Ok(a);
    }
    if fb <= 0.0 {
        return Ok(b);
    }
    for _ in 0..60 {
        let middle = b - fb * (b - a) / (fb - fa);
        let at = f(middle)?;
        if at == 0.0 || (b - a).abs() < 1e-9 {
            return Ok(middle);
        }
        if at.signum() == fb.signum() {
            fa *= 0.5;
        } else {
            (a, fa) = (b, fb);
        }
        (b, fb) = (middle, at);
    }
    Ok(b)
}
