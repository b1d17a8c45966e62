//! Columns in groups, each with wavelengths of its own before its values.

use super::super::families::spectra::{self, Sample, Spectrum};
use super::super::grid::Grid;
use super::super::header::Header;
use super::super::watch::Log;
use super::super::{Decided, Decision, ReadError, words};
use super::raw_curve;

/// Which of the columns right of the wavelengths, from 0, hold wavelengths too.
pub(super) fn more_wavelengths(header: &Header, at: usize, wavelengths: &[f64], values: &[Vec<f64>]) -> Vec<usize> {
    let is_one = |(index, column): (usize, &Vec<f64>)| {
        let name = header.name(at + 1 + index);
        let named = name.is_some_and(is_name);
        // A column with a name of its own is a curve, even if it happens to hold the same numbers.
        let alike = name.is_none_or(|name| header.name(at) == Some(name));
        let same = wavelengths.len() > 1 && column == wavelengths && alike;
        (named || same).then_some(index)
    };
    values.iter().enumerate().filter_map(is_one).collect()
}

/// Names of curves may hold the word, but do not begin with it.
fn is_name(name: &str) -> bool {
    let lower = name.trim().to_lowercase();
    lower.starts_with("wavelength")
        || lower.starts_with("wavenumber")
        || words::x_unit(name).is_some() && lower.len() <= 4
}

/// Reads each column with the wavelengths that stand before it. Where all wavelengths are the same, the curves share them.
pub(super) fn read(
    header: Header,
    at: usize,
    first: Vec<f64>,
    columns: Vec<Vec<f64>>,
    more: &[usize],
    lines: &[usize],
    log: &mut Log<'_>,
) -> Result<(Grid, Option<Decision>), ReadError> {
    let count = columns.len() - more.len();
    let decided = |value: String| {
        let why = format!("Column {} holds wavelengths too", at + 2 + more[0]);
        Some(Decision::new("Columns", &Decided::certain(value, why)))
    };
    if more.iter().all(|&index| columns[index] == first) {
        let values = columns.into_iter().enumerate().filter(|(index, _)| !more.contains(index));
        let curves = values.map(|(index, values)| raw_curve(&header, at + 1 + index, count == 1, values)).collect();
        let grid = Grid { wavelengths: first, lines: lines.to_vec(), curves, header, ..Grid::default() };
        return Ok((grid, decided(format!("{count} curves over the same wavelengths"))));
    }
    let mut own = &first;
    let (mut all, mut units) = (Vec::with_capacity(count), Vec::with_capacity(count));
    for (index, values) in columns.iter().enumerate() {
        log.look(usize::MAX)?;
        if more.contains(&index) {
            own = values;
            continue;
        }
        let curve = raw_curve(&header, at + 1 + index, count == 1, Vec::new());
        let rows = own
            .iter()
            .zip(values)
            .zip(lines)
            .filter(|((wavelength, value), _)| !(wavelength.is_nan() || value.is_nan()));
        let samples = rows.map(|((&wavelength, &value), &line)| Sample { wavelength, value, line }).collect();
        all.push(Spectrum { name: Some(curve.name), label: curve.label, samples });
        units.push((curve.unit, curve.named));
    }
    let mut grid = spectra::grid(all, header, log)?;
    for (curve, (unit, named)) in grid.curves.iter_mut().zip(units) {
        curve.unit = unit;
        curve.named = named;
    }
    Ok((grid, decided(format!("{count} curves with wavelengths of their own"))))
}
