//! Metamers made of a reflectance and a metameric black.

use crate::camera::quality::space::{basis, remove};
use crate::camera::rendering::under_light;
use crate::math::dot::dot;
use crate::spectral::grid::COUNT;
use crate::spectral::{GridSpectrum, Sensor};

/// Part of a difference of reflectances that a sensor does not see under a light: its metameric black.
///
/// ```text
/// ΔS = (1 − R) D,   R = A (AᵀA)⁻¹ Aᵀ,   A = C L with the weights of the quadrature
/// ```
/// R is the matrix R of Cohen and Kappauf (1982, Am. J. Psychol. 95, 537). `∫ C_c ΔS L dλ = 0` to rounding: below 1e-14 of
/// `∫ |C_c ΔS L| dλ`. None where the sensor's channels under the light are linearly dependent.
pub fn metameric_black(sensor: &Sensor, light: &GridSpectrum, difference: &[f64; COUNT]) -> Option<Vec<f64>> {
    let seen = basis(&under_light(sensor, light).map(|product| product.to_vec()))?;
    Some(remove(&remove(difference, &seen), &seen))
}

/// Metamer of a reflectance for a sensor under a light, with a large difference for an observer; within 0 to 1.
///
/// To the reflectance is added the metameric black of the observer's own curves under the light, each of the three in turn, as far up or
/// down as 0 and 1 allow; the one of the six is returned for which the observer's signals differ most, in parts of its signals of a
/// perfect diffuser. None where nothing can be added: for an observer whose curves the sensor's span, or a reflectance at 0 or 1 where
/// it would have to change.
pub fn synthetic_metamer(
    sensor: &Sensor,
    observer: &Sensor,
    light: &GridSpectrum,
    reflectance: &GridSpectrum,
) -> Option<GridSpectrum> {
    let matching = under_light(observer, light);
    let whites = matching.each_ref().map(|product| product.iter().sum::<f64>());
    let mut best: Option<(f64, Vec<f64>)> = None;
    for product in &matching {
        let length = dot(product.as_slice(), product.as_slice()).sqrt();
        let black = metameric_black(sensor, light, product)?;
        // What is left of a curve that the sensor sees whole is rounding.
        if dot(&black, &black).sqrt() <= 1e-9 * length {
            continue;
        }
        for sign in [1.0, -1.0] {
            let room = |(value, step): (&f64, &f64)| match sign * step {
                step if step > 0.0 => (1.0 - value) / step,
                step if step < 0.0 => -value / step,
                _ => f64::INFINITY,
            };
            let most = reflectance.values().iter().zip(&black).map(room).fold(f64::INFINITY, f64::min);
            let room = most > 0.0 && most.is_finite();
            if !room {
                continue;
            }
            let step: Vec<f64> = black.iter().map(|v| v * sign * most).collect();
            let seen = (0..3).map(|c| (dot(matching[c].as_slice(), &step) / whites[c]).powi(2)).sum::<f64>().sqrt();
            if seen.is_finite() && best.as_ref().is_none_or(|(least, _)| seen > *least) {
                best = Some((seen, step));
            }
        }
    }
    let (_, step) = best?;
    let mut values = reflectance.values().iter().zip(step).map(|(value, step)| (value + step).clamp(0.0, 1.0));
    Some(GridSpectrum::from_fn(|_| values.next().unwrap_or(0.0)))
}
