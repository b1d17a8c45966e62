//! Reference illuminants: blackbodies and daylight at the temperature of the test light.

use super::standards::{RenditionError, Standards, Sums, wavelengths, within};
use crate::colorimetry::{Uv60, Xyz};
use crate::light::planckian::{RadiationConstants, relative_exitance};
use crate::light::temperature::MAX_DUV;
use crate::light::{Cct, CctError, DaylightBasis};
use crate::math::minimum::minimum;
use crate::spectral::{GridSpectrum, Quantity, SpectralDistribution};
use crate::units::Kelvin;

/// Reciprocal temperatures in mired from 25 000 K to 1000 K, the range of TM-30.
const MIRED: [f64; 2] = [40.0, 1000.0];
/// Spacing of the search in mired: less than half a radius of the locus's curvature.
const STEP: f64 = 10.0;

/// Blackbody at some wavelengths, relative to 560 nm.
pub(super) fn blackbody(temperature: Kelvin, nm: &[f64]) -> Vec<f64> {
    nm.iter().map(|&x| relative_exitance(x, 560.0, temperature, RadiationConstants::Paper)).collect()
}

/// CIE daylight at some wavelengths, linear between those of its basis, with M₁ and M₂ rounded to three decimals.
pub(super) fn daylight(basis: &DaylightBasis, temperature: Kelvin, nm: &[f64]) -> Result<Vec<f64>, RenditionError> {
    Ok(within(&basis.rounded(temperature)?, nm))
}

/// Correlated color temperature and Duv by the nearest point of the Planckian locus over 360–780 nm, as TM-30 takes them.
///
/// Within 1e-5 mired. The program's other temperatures are over 380–780 nm ([`crate::light::temperature`]), up to 2 K higher at
/// 6500 K.
pub(super) fn nearest(standards: &Standards, color: Xyz) -> Result<Cct, RenditionError> {
    let locus = Sums::new(&standards.cie_1931, wavelengths(360, 780, 1))?;
    let color = color.uv_prime().ok_or(CctError::NoChromaticity)?.uv60();
    let at = |mired: f64| -> Result<Uv60, RenditionError> {
        let temperature = Kelvin::from_mired(mired).map_err(|_| CctError::TooHot)?;
        let seen = locus.xyz(&blackbody(temperature, &locus.nm)).uv_prime();
        Ok(seen.ok_or(CctError::NoChromaticity)?.uv60())
    };
    let distance = |mired: f64| at(mired).map(|at| (at.u - color.u).hypot(at.v - color.v));
    let count = ((MIRED[1] - MIRED[0]) / STEP) as usize;
    let mut best = (MIRED[0], f64::INFINITY);
    for index in 0..=count {
        let mired = MIRED[0] + STEP * index as f64;
        let distance = distance(mired)?;
        if distance < best.1 {
            best = (mired, distance);
        }
    }
    let mired = minimum(best.0 - STEP, best.0 + STEP, 1e-7, |mired| distance(mired).unwrap_or(f64::INFINITY));
    if !(MIRED[0]..=MIRED[1]).contains(&mired) {
        let colder = mired > MIRED[1];
        return Err(if colder { CctError::TooCold } else { CctError::TooHot }.into());
    }
    let (here, colder) = (at(mired)?, at(mired + 0.01)?);
    let side = (color.v - here.v) * (colder.u - here.u) - (color.u - here.u) * (colder.v - here.v);
    let duv = distance(mired)?.copysign(side);
    if duv.abs() > MAX_DUV {
        return Err(CctError::TooFar.into());
    }
    Ok(Cct { temperature: Kelvin::from_mired(mired).map_err(|_| CctError::TooHot)?, duv })
}

/// Reference illuminant of TM-30 and CIE 224, with Y = 1 for the CIE 1931 observer: a blackbody up to 4000 K, daylight from 5000 K,
/// and between them a mixture in proportion to the temperature.
pub(super) fn mixed(standards: &Standards, temperature: Kelvin, sums: &Sums) -> Result<Vec<f64>, RenditionError> {
    let share = ((temperature.get() - 4000.0) / 1000.0).clamp(0.0, 1.0);
    let unit = |spectrum: Vec<f64>| sums.unit(&spectrum).map(|(unit, _)| unit);
    if share <= 0.0 {
        return unit(blackbody(temperature, &sums.nm));
    }
    let day = unit(daylight(&standards.daylight, temperature, &sums.nm)?)?;
    if share >= 1.0 {
        return Ok(day);
    }
    let body = unit(blackbody(temperature, &sums.nm))?;
    Ok(body.iter().zip(&day).map(|(b, d)| (1.0 - share) * b + share * d).collect())
}

/// The reference illuminant of a light (TM-30-20, CIE 224:2017) on the standard grid, with its temperature and the light's Duv.
///
/// # Errors
/// [`RenditionError`] where the light has no correlated color temperature from 1000 K to 25 000 K.
pub fn reference_illuminant(
    light: &SpectralDistribution,
    standards: &Standards,
) -> Result<(GridSpectrum, Cct), RenditionError> {
    let sums = Sums::new(&standards.cie_1931, wavelengths(380, 780, 1))?;
    let (_, seen) = sums.unit(&within(light, &sums.nm))?;
    let cct = nearest(standards, seen)?;
    let values = mixed(standards, cct.temperature, &sums)?;
    let spectrum = SpectralDistribution::new(sums.nm.clone(), values);
    let no_power = RenditionError::NoPower { first_nm: 380, last_nm: 780 };
    Ok((GridSpectrum::resample(&spectrum.map_err(|_| no_power)?, Quantity::Light), cct))
}
