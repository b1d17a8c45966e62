//! Contents of a chromaticity diagram besides data: the spectral locus, the daylight locus, the colors of its area.

use super::rgb::{srgb_from_xyz, srgb_transfer};
use super::tristimulus::{Xy, Xyz};
use crate::spectral::Sensor;
use crate::spectral::grid::{COUNT, wavelength_nm};

/// One point of a spectral locus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralPoint {
    /// The wavelength in nanometers.
    pub wavelength_nm: f64,
    /// Its chromaticity.
    pub xy: Xy,
}

/// The chromaticities of monochromatic light for an observer that counts in XYZ; wavelengths without response are omitted.
pub fn spectral_locus(observer: &Sensor) -> Vec<SpectralPoint> {
    (0..COUNT)
        .filter_map(|index| {
            let [x, y, z] = observer.at_index(index);
            let xy = Xyz::new(x, y, z).chromaticity()?;
            Some(SpectralPoint { wavelength_nm: wavelength_nm(index), xy })
        })
        .collect()
}

/// The screen color that stands for a chromaticity: smooth over the plane, bright, colors beyond the screen's range moved in.
///
/// For orientation only: no screen shows most of the diagram. Channels are linear sRGB divided by their root sum of squares, softened
/// toward positive values, and divided by their 6-norm, so that no edge of the screen's range is seen.
pub fn area_color(xy: Xy) -> [u8; 3] {
    const SOFTNESS: f64 = 0.3;
    const NORM: i32 = 6;
    let Some(xyz) = xy.with_unit_luminance() else {
        return [0; 3];
    };
    let rgb = srgb_from_xyz() * xyz.to_vector();
    let length = rgb.length();
    if length == 0.0 || !length.is_finite() {
        return [0; 3];
    }
    let soft = (rgb / length).to_array().map(|v| 0.5 * (v + v.hypot(SOFTNESS)));
    let norm = soft.iter().map(|v| v.powi(NORM)).sum::<f64>().powf(1.0 / f64::from(NORM));
    soft.map(|v| (255.0 * srgb_transfer(v / norm)).round() as u8)
}

/// The screen color of a wavelength, fading towards the ends of the visible range.
pub fn wavelength_color(observer: &Sensor, nanometers: f64) -> [u8; 3] {
    let index = ((nanometers - wavelength_nm(0)).round().max(0.0) as usize).min(COUNT - 1);
    let [x, y, z] = observer.at_index(index);
    let peak = 1.06;
    let strength = ((x + y + z) / peak).clamp(0.0, 1.0).powf(0.35);
    bright_color(Xyz::new(x, y, z)).map(|v| (f64::from(v) * strength).round() as u8)
}

/// Moved into the screen's range by adding white, then as bright as possible.
fn bright_color(xyz: Xyz) -> [u8; 3] {
    let rgb = srgb_from_xyz() * xyz.to_vector();
    let lifted = rgb - rgb.min_element().min(0.0);
    let top = lifted.max_element();
    if top <= 0.0 || !top.is_finite() {
        return [0; 3];
    }
    (lifted / top).to_array().map(|v| (255.0 * srgb_transfer(v)).round() as u8)
}
