//! Curves of a camera that was measured, with their bands.

use chromascope_core::recovery::RecoveredCurves;
use chromascope_core::spectral::Sensor;
use chromascope_figure::{Axis, Dash, Ink, InkRole, Mark, Panel, Rect, Shape, Tag};

use super::data_set::channel_symbol;
use crate::format::fixed;
use crate::scene::recorded::CHANNELS;

/// Red, green and blue.
const INKS: [[u8; 3]; 3] = [[208, 64, 52], [44, 148, 72], [58, 108, 214]];
/// Opacity of a band.
const BAND: f32 = 0.22;

/// Plot of the curves with two standard deviations; behind them the nearest table of the library, dashed, and the share of the data,
/// dotted.
pub fn panel(curves: &RecoveredCurves, nearest: Option<&Sensor>, size: [f64; 2]) -> Panel {
    let nm = &curves.wavelengths_nm;
    let x = Axis::new("wavelength (nm)", [nm.first().copied().unwrap_or(380.0), nm.last().copied().unwrap_or(780.0)]);
    let y = Axis::new("relative sensitivity", [0.0, 1.12]);
    let mut panel = Panel::new("recovered curves", Rect::from_min_size([0.0, 0.0], size), x, y);
    let pairs = |values: &[f64]| nm.iter().copied().zip(values.iter().copied()).map(|(nm, v)| [nm, v]).collect();
    let standard = curves.standard();
    for (c, (name, ink)) in CHANNELS.into_iter().zip(INKS.map(Ink::rgb)).enumerate() {
        let edge = |sign: f64| {
            let values = curves.values[c].iter().zip(&standard[c]);
            nm.iter().zip(values).map(move |(nm, (v, sd))| [*nm, (v + sign * 2.0 * sd).clamp(0.0, 1.12)])
        };
        let points = edge(1.0).chain(edge(-1.0).rev()).collect();
        let band = Mark::new(Tag::default(), format!("{name} ± 2 sd"), Shape::Polygon { points });
        panel.marks.push(band.with_fill(ink.faded(BAND)));
        let line = |points, closed| Shape::Line { points, closed };
        if let Some(sensor) = nearest {
            let peak = nm.iter().map(|nm| sensor_at(sensor, *nm)[c]).fold(f64::MIN_POSITIVE, f64::max);
            let own = curves.values[c].iter().copied().fold(0.0, f64::max);
            let values: Vec<f64> = nm.iter().map(|nm| sensor_at(sensor, *nm)[c] * own / peak).collect();
            let mark = Mark::new(Tag::default(), format!("nearest table, {name}"), line(pairs(&values), false));
            panel.marks.push(mark.with_stroke(InkRole::Weak, 1.0).with_dash(Dash::Dashed));
        }
        let share = Mark::new(Tag::default(), format!("{name}, data"), line(pairs(&curves.data_share[c]), false));
        panel.marks.push(share.with_stroke(ink.faded(0.6), 1.0).with_dash(Dash::Dotted));
        let mark = Mark::new(Tag(c as u32 + 1), channel_symbol(name), line(pairs(&curves.values[c]), false));
        panel.marks.push(mark.with_stroke(ink, 2.0));
    }
    panel
}

fn sensor_at(sensor: &Sensor, nm: f64) -> [f64; 3] {
    sensor.at_index((nm - chromascope_core::spectral::grid::FIRST_NM).round().max(0.0) as usize)
}

/// Values with their bands and shares of data at the wavelength nearest to one, in lines.
pub fn at(curves: &RecoveredCurves, nm: f64) -> Vec<String> {
    let away = |k: &usize| (curves.wavelengths_nm[*k] - nm).abs();
    let Some(k) = (0..curves.wavelengths_nm.len()).min_by(|a, b| away(a).total_cmp(&away(b))) else {
        return Vec::new();
    };
    let standard = curves.standard();
    let one = |(c, name): (usize, &str)| {
        let (value, band) = (fixed(curves.values[c][k], 3), fixed(2.0 * standard[c][k], 3));
        format!("{name} {value} ± {band}, {} % from the data", fixed(100.0 * curves.data_share[c][k], 0))
    };
    let head = format!("{} nm", fixed(curves.wavelengths_nm[k], 0));
    std::iter::once(head).chain(CHANNELS.into_iter().enumerate().map(one)).collect()
}
