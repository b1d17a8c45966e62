//! Columns in groups, each with wavelengths of its own before its values.

use crate::columns::axes::{self, Axes};
use crate::columns::raw_curve;
use crate::decision::{Decided, Decision, WavelengthUnit};
use crate::error::ReadError;
use crate::formats::spectra::{self, Sample, Spectrum};
use crate::grid::Grid;
use crate::header::Header;
use crate::header_terms::XUnit;
use crate::no_curve::is_empty;
use crate::places::PlaceId;
use crate::watch::Log;

/// The unit of a column of wavelengths and that of the first, where they differ.
fn units(header: &Header, first: usize, column: usize) -> Option<(WavelengthUnit, WavelengthUnit)> {
    match (axes::unit(header, column), axes::unit(header, first)) {
        (Some(XUnit::Wavelength(own)), Some(XUnit::Wavelength(shared))) if own != shared => Some((own, shared)),
        _ => None,
    }
}

/// Reads each column with the wavelengths that stand before it. Where all wavelengths are the same, the curves share them.
pub(super) fn read(
    header: Header,
    at: usize,
    first: Vec<f64>,
    mut columns: Vec<Vec<f64>>,
    found: &Axes,
    lines: &[usize],
    log: &mut Log<'_>,
) -> Result<(Grid, Option<Decision>), ReadError> {
    let more = &found.more;
    let is_curve = |index: usize, values: &[f64]| {
        let column = at + 1 + index;
        !more.contains(&index) && !found.left.contains(&column) && (header.name(column).is_some() || !is_empty(values))
    };
    let count = columns.iter().enumerate().filter(|(index, values)| is_curve(*index, values)).count();
    let decided = |value: String| {
        let why = format!("Column {} holds wavelengths too", at + 2 + more[0]);
        let decided = if found.guessed { Decided::guess(value, why) } else { Decided::certain(value, why) };
        Some(Decision::new("Columns", &decided))
    };
    if more.iter().all(|&index| columns[index] == first) {
        let values = columns.into_iter().enumerate().filter(|(index, values)| is_curve(*index, values));
        let curves = values.map(|(index, values)| raw_curve(&header, at + 1 + index, count == 1, values)).collect();
        let axes = more.iter().map(|index| (at + 1 + index, None)).collect();
        let grid = Grid { wavelengths: first, lines: lines.to_vec(), curves, header, axes, ..Grid::default() };
        return Ok((grid, decided(format!("{count} curves over the same wavelengths"))));
    }
    let mut axes = Vec::with_capacity(more.len());
    for &index in more {
        axes.push((at + 1 + index, units(&header, at, at + 1 + index).map(|(own, _)| own)));
        if let Some((own, shared)) = units(&header, at, at + 1 + index) {
            columns[index].iter_mut().for_each(|value| *value = shared.from_nanometers(own.nanometers(*value)));
        }
    }
    let mut own = &first;
    let (mut all, mut units) = (Vec::with_capacity(count), Vec::with_capacity(count));
    for (index, values) in columns.iter().enumerate() {
        log.look(usize::MAX)?;
        if more.contains(&index) {
            own = values;
        }
        if !is_curve(index, values) {
            continue;
        }
        let curve = raw_curve(&header, at + 1 + index, count == 1, Vec::new());
        let rows = own
            .iter()
            .zip(values)
            .zip(lines)
            .filter(|((wavelength, value), _)| !(wavelength.is_nan() || value.is_nan()));
        let samples = rows
            .map(|((&wavelength, &value), &line)| Sample { wavelength, value, line, place: PlaceId::default() })
            .collect();
        all.push(Spectrum { name: Some(curve.name), label: curve.label, samples });
        units.push((curve.unit, curve.named, curve.origin));
    }
    let mut grid = spectra::grid(all, header, log)?;
    for (curve, (unit, named, origin)) in grid.curves.iter_mut().zip(units) {
        (curve.unit, curve.named, curve.origin) = (unit, named, origin);
    }
    (grid.axes, grid.row_lines) = (axes, lines.to_vec());
    Ok((grid, decided(format!("{count} curves with wavelengths of their own"))))
}
