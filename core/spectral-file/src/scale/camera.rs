//! The channels of a camera: by their names, and by the shapes of their curves.

use crate::decision::Role;
use crate::grid::Grid;
use crate::header_terms::{self, Channel};
use crate::report::Curve;

/// Channels that a camera may have.
pub(super) const MOST_CHANNELS: usize = 4;

/// Indices of red, green and blue among three or four names, and true if all are letters. A fourth curve may be beside
/// them, such as an infrared or a clear channel; of the two greens of a Bayer pattern the first is taken.
pub(super) fn channels(names: &[&str]) -> Option<([usize; 3], bool)> {
    if !(3..=MOST_CHANNELS).contains(&names.len()) {
        return None;
    }
    let mut found: [Option<usize>; 3] = [None; 3];
    let mut letters = true;
    let green = |wanted: [&str; 2]| names.iter().position(|name| wanted.iter().any(|w| name.eq_ignore_ascii_case(w)));
    let greens = green(["g1", "gr"]).zip(green(["g2", "gb"]));
    for (index, name) in names.iter().enumerate() {
        if let Some((first, second)) = greens.filter(|(first, second)| index == *first || index == *second) {
            found[1] = Some(first.min(second));
            continue;
        }
        let channel = match header_terms::channel(name) {
            Some(Channel::Letter(channel)) => channel,
            Some(Channel::Word(channel)) => {
                letters = false;
                channel
            }
            None => continue,
        };
        if found[channel].replace(index).is_some() {
            return None;
        }
    }
    Some(([found[0]?, found[1]?, found[2]?], letters))
}

/// Indices of a camera's red, green and blue curves: by name, or by the peaks of three curves.
pub(crate) fn camera_columns(role: Role, curves: &[Curve]) -> Option<[usize; 3]> {
    if role != Role::Camera {
        return None;
    }
    let names: Vec<&str> = curves.iter().map(|curve| curve.name.as_str()).take(MOST_CHANNELS + 1).collect();
    channels(&names).map(|(columns, _)| columns).or_else(|| by_peak(curves))
}

fn by_peak(curves: &[Curve]) -> Option<[usize; 3]> {
    if curves.len() != 3 {
        return None;
    }
    let mut order: Vec<(f64, usize)> =
        curves.iter().enumerate().map(|(i, curve)| (peak(&curve.wavelengths_nm, &curve.values).0, i)).collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0));
    Some([order[0].1, order[1].1, order[2].1])
}

/// Wavelength and height of a curve's maximum.
fn peak(wavelengths: &[f64], values: &[f64]) -> (f64, f64) {
    let start = (f64::NAN, f64::NEG_INFINITY);
    wavelengths.iter().zip(values).fold(start, |best, (&w, &value)| if value > best.1 { (w, value) } else { best })
}

/// Returns whether exactly three curves look like the channels of a camera: small at both ends, with peaks in order.
pub(super) fn bells(grid: &Grid) -> Option<()> {
    const ENDS: f64 = 0.3;
    const PEAKS_NM: [std::ops::RangeInclusive<f64>; 3] = [410.0..=500.0, 500.0..=580.0, 570.0..=680.0];
    if grid.curves.len() != 3 || grid.wavelengths.len() < 8 {
        return None;
    }
    let mut peaks = Vec::with_capacity(3);
    for curve in &grid.curves {
        let (at, max) = peak(&grid.wavelengths, &curve.values);
        let ends = [curve.values.first()?, curve.values.last()?];
        if max <= 0.0 || ends.iter().any(|&&end| end.is_nan() || end > ENDS * max) {
            return None;
        }
        peaks.push(at);
    }
    peaks.sort_by(f64::total_cmp);
    let in_place = peaks.iter().zip(&PEAKS_NM).all(|(peak, range)| range.contains(peak));
    (in_place && peaks[1] - peaks[0] > 20.0 && peaks[2] - peaks[1] > 20.0).then_some(())
}
