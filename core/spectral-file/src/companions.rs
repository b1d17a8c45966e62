//! Columns beside spectra that are none: temperatures, times, humidities, numbers of rows.

use super::grid::{Grid, RawCurve};
use super::quantity;
use super::warning::Warning;
use super::watch::Log;
use super::words;

/// Names of what is recorded beside spectra, without their units.
const NAMES: [&str; 36] = [
    "temperature",
    "temp",
    "temp.",
    "t_amb",
    "ambient temperature",
    "detector temperature",
    "ccd temperature",
    "temperatur",
    "température",
    "temperatura",
    "time",
    "elapsed time",
    "elapsed",
    "timestamp",
    "time stamp",
    "date",
    "day",
    "hour",
    "zeit",
    "temps",
    "tiempo",
    "integration time",
    "exposure",
    "exposure time",
    "humidity",
    "relative humidity",
    "rel. humidity",
    "rh",
    "pressure",
    "air pressure",
    "voltage",
    "battery",
    "battery voltage",
    "altitude",
    "latitude",
    "longitude",
];

/// Units that no spectrum has.
const UNITS: [&str; 17] = [
    "°c", "℃", "deg c", "degc", "°f", "℉", "° c", "celsius", "kelvin", "seconds", "ms", "hpa", "mbar", "kpa", "%rh",
    "% rh", "rh",
];

/// Leaves out curves that are no spectra, unless nothing else is there.
pub(super) fn leave_out(grid: &mut Grid, log: &mut Log<'_>) {
    let marks: Vec<bool> = grid.curves.iter().map(is_companion).collect();
    let count = marks.iter().filter(|mark| **mark).count();
    if count == grid.curves.len() {
        return;
    }
    let Some(first) = marks.iter().position(|mark| *mark) else { return };
    log.push(Warning::NotSpectra { count, first: grid.curves[first].told() });
    let mut marks = marks.into_iter();
    grid.curves.retain(|_| !marks.next().unwrap_or(false));
}

fn is_companion(curve: &RawCurve) -> bool {
    const LONGEST: usize = 60;
    if !curve.named || curve.name.len() > LONGEST || curve.label.len() > 2 * LONGEST {
        return false;
    }
    let name = quantity::without_unit(&curve.name).trim().to_lowercase();
    let label = curve.label.to_lowercase();
    let bracketed = UNITS.iter().any(|unit| {
        let inside = |open: char, close: char| label.ends_with(&format!("{open}{unit}{close}"));
        inside('(', ')') || inside('[', ']')
    });
    let bare = name.split(['(', '[']).next().unwrap_or_default().trim().replace('_', " ");
    let named = NAMES.contains(&&*bare) || NAMES.contains(&&*name);
    let counts = words::is_count(&bare) && !bare.contains(' ') && are_consecutive(&curve.values);
    // What names a quantity of light is a spectrum, whatever stands in brackets.
    (named || bracketed || counts) && words::role(&curve.label).is_none()
}

/// Whether values go up by one from each to the next.
fn are_consecutive(values: &[f64]) -> bool {
    values.len() > 2 && values.windows(2).all(|pair| (pair[1] - pair[0]).abs() == 1.0 && pair[0].fract() == 0.0)
}
