//! Columns that are no curves: wavelengths again, in another unit, at the other edges of intervals, or counts and times of rows;
//! and columns in groups, each with wavelengths of its own before its values.

use crate::columns::raw_curve;
use crate::decimal::{ends, extent};
use crate::decision::{Decided, Decision, WavelengthUnit};
use crate::error::ReadError;
use crate::formats::spectra::{self, Sample, Spectrum};
use crate::grid::Grid;
use crate::header::Header;
use crate::header_terms::{self, XUnit};
use crate::no_curve::{
    FEWEST_ROWS, are_upper_ends, counts, counts_from_start, is_empty, is_other_scale, runs_one_way, tells_rows_apart,
};
use crate::text::listed;
use crate::units;
use crate::warning::Warning;
use crate::watch::{Log, PlaceId};

/// The fewest rows that a column counts whose name says nothing of it.
const FEWEST_COUNTED: usize = 8;

#[derive(Debug, Default)]
pub(super) struct Axes {
    /// Columns, counted from the one right of the wavelengths, that hold the wavelengths of those behind them.
    pub(super) more: Vec<usize>,
    pub(super) left: Vec<usize>,
    /// True if only the numbers suggest that there are several columns of wavelengths.
    pub(super) guessed: bool,
}

impl Axes {
    /// Warns of the columns that are left out: upper ends of intervals, and other scales.
    pub(super) fn warn(
        &self,
        header: &Header,
        at: usize,
        wavelengths: &[f64],
        columns: &[Vec<f64>],
        log: &mut Log<'_>,
    ) {
        let is_end = |column: &&usize| {
            let values = column.checked_sub(at + 1).and_then(|index| columns.get(index));
            values.is_some_and(|values| are_upper_ends(wavelengths, values))
        };
        let (ends, others): (Vec<usize>, Vec<usize>) = self.left.iter().partition(is_end);
        if let Some(end) = ends.first() {
            log.push(Warning::UpperEnds([end + 1, at + 1]));
        }
        if !others.is_empty() {
            let named = column_list(header, &others);
            log.push(Warning::OtherAxes { named, wavelength_column: Some(at + 1) });
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Empty,
    Value,
    Wavelengths,
    /// Another scale of the same rows.
    Scale,
}

/// Finds the columns that are no curves. `columns` are those right of the wavelengths in column `at`.
pub(super) fn find(header: &Header, at: usize, wavelengths: &[f64], before: &[Vec<f64>], columns: &[Vec<f64>]) -> Axes {
    let mut axes = Axes::default();
    for (column, values) in before.iter().enumerate() {
        let name = header.name(column).unwrap_or_default();
        let named = header_terms::names_axis(name) && runs_like_axis(header, [at, column], wavelengths, values);
        let scale = named
            || header_terms::is_label(name)
            || header_terms::names_time(name)
            || counts_from_start(values, FEWEST_COUNTED)
            || is_other_scale(wavelengths, values);
        axes.left.extend((scale && !is_empty(values)).then_some(column));
    }
    let kind = |(index, column): (usize, &Vec<f64>)| match kind(header, at, index, wavelengths, column) {
        Kind::Value if columns.len() > 1 && counts_from_start(column, FEWEST_COUNTED) => Kind::Scale,
        kind => kind,
    };
    let mut kinds: Vec<Kind> = columns.iter().enumerate().map(kind).collect();
    axes.guessed = guess_pairs(header, at, wavelengths, columns, &mut kinds);
    // Tables side by side repeat the name of their first column.
    for index in (0..columns.len()).filter(|index| header.name(at + 1 + index).is_some()) {
        let alike = header.name(at).is_some() && header.name(at + 1 + index) == header.name(at);
        let again = header.name(at + 1 + index) == header.name(at)
            || shares_stem(header.name(at), header.name(at + 1 + index)) && runs_one_way(&columns[index])
            || has_ends_of(wavelengths, &columns[index]);
        // Points read off a plot may go back a little.
        let (low, high) = extent(columns[index].iter().copied().filter(|value| !value.is_nan()));
        if kinds[index] == Kind::Value && again && units::plausible(low, high, alike) {
            (kinds[index], axes.guessed) = (Kind::Wavelengths, true);
        }
    }
    let mut values = 0;
    for (index, kind) in kinds.iter().enumerate() {
        let followed = || kinds[index + 1..].iter().find(|kind| matches!(kind, Kind::Value | Kind::Wavelengths));
        match kind {
            Kind::Empty => {}
            Kind::Value => values += 1,
            Kind::Wavelengths if values > 0 && followed() == Some(&Kind::Value) => {
                axes.more.push(index);
                values = 0;
            }
            Kind::Wavelengths | Kind::Scale => axes.left.push(at + 1 + index),
        }
    }
    axes
}

/// Returns whether two names differ in the word behind the last underscore: `wl_a`, `wl_b`.
fn shares_stem(first: Option<&str>, name: Option<&str>) -> bool {
    let stems = first.zip(name).and_then(|(first, name)| Some((first.rsplit_once('_')?.0, name.rsplit_once('_')?.0)));
    stems.is_some_and(|(first, name)| first == name)
}

/// True for numbers that run from where the wavelengths begin to where they end, as no values do. Points read off a plot may go back
/// a little.
fn has_ends_of(wavelengths: &[f64], column: &[f64]) -> bool {
    const CLOSE: f64 = 0.03;
    const MOST_BACK: usize = 10;
    let edges = |values: &[f64]| {
        let mut present = values.iter().copied().filter(|value| !value.is_nan());
        let first = present.next()?;
        let last = present.next_back()?;
        Some((first.min(last), first.max(last)))
    };
    let (Some((low, high)), Some((from, to))) = (edges(wavelengths), edges(column)) else { return false };
    let near = |a: f64, b: f64| (a - b).abs() < CLOSE * (high - low);
    if !near(low, from) || !near(high, to) || ends(wavelengths).is_none() {
        return false;
    }
    let column: Vec<f64> = column.iter().copied().filter(|value| !value.is_nan()).collect();
    let steps = || column.windows(2).map(|pair| pair[1] - pair[0]);
    let back = steps().filter(|step| *step < 0.0).count().min(steps().filter(|step| *step > 0.0).count());
    column.len() >= FEWEST_COUNTED && MOST_BACK * back < column.len()
}

fn column_list(header: &Header, columns: &[usize]) -> String {
    let name = |column: &usize| match header.name(*column) {
        Some(name) => format!("column {} (“{name}”)", column + 1),
        None => format!("column {}", column + 1),
    };
    listed(&columns.iter().map(name).collect::<Vec<_>>())
}

fn kind(header: &Header, at: usize, index: usize, wavelengths: &[f64], column: &[f64]) -> Kind {
    let name = header.name(at + 1 + index);
    let scale = || {
        let codes = |name| header_terms::lists_codes(name) && column.iter().all(|value| value.fract() == 0.0);
        let label = |name| header_terms::is_label(name) && tells_rows_apart(column) || codes(name);
        name.is_some_and(|name| {
            header_terms::names_time(name) || (header_terms::is_count(name) && counts(column)) || label(name)
        }) || is_other_scale(wavelengths, column)
    };
    match () {
        () if is_empty(column) => Kind::Empty,
        () if scale() => Kind::Scale,
        () if name.is_some_and(header_terms::names_axis)
            && runs_like_axis(header, [at, at + 1 + index], wavelengths, column) =>
        {
            Kind::Wavelengths
        }
        // Whatever it is called.
        () if wavelengths.len() > 1 && column == wavelengths => Kind::Wavelengths,
        // Beyond the range of light, too, as Raman shifts are.
        () if name.is_some_and(header_terms::ends_with_wavelengths) && runs_one_way(column) => Kind::Scale,
        () => Kind::Value,
    }
}

pub(super) fn unit(header: &Header, column: usize) -> Option<XUnit> {
    let unit = header.units.get(column).and_then(|unit| header_terms::x_unit(unit));
    unit.or_else(|| header_terms::x_unit(header.name(column)?))
}

/// Returns whether the numbers of a column whose name mentions wavelengths run as those in the first of two columns do: names such as
/// `LED, wavelength shifted` do so too.
fn runs_like_axis(header: &Header, [first, column]: [usize; 2], wavelengths: &[f64], values: &[f64]) -> bool {
    let name = header.name(column);
    if name.is_some() && name == header.name(first) {
        return true;
    }
    let (shared, own) = (unit(header, first), unit(header, column));
    // Raman shifts begin below zero.
    if own == Some(XUnit::Other) {
        return true;
    }
    let mut distinct = values.to_vec();
    distinct.dedup();
    let Some((low, high)) = ends(&distinct).filter(|(low, _)| *low > 0.0) else { return false };
    let (from, to) = match (own.or(shared), shared) {
        (Some(XUnit::Other), _) => return true,
        (Some(XUnit::Wavelength(unit)), _) => (unit.nanometers(low), unit.nanometers(high)),
        (None, _) => (low, high),
    };
    let (from, to) = (from.min(to), from.max(to));
    let known = own.or(shared).is_some();
    let plausible = units::plausible(from, to, !known);
    let overlaps = || match (ends(wavelengths), shared) {
        (Some((a, b)), Some(XUnit::Wavelength(unit))) => {
            let (a, b) = (unit.nanometers(a), unit.nanometers(b));
            from < a.max(b) && to > a.min(b)
        }
        (Some((a, b)), None) if own.is_none() => from < b && to > a,
        _ => true,
    };
    plausible && (name.is_some_and(header_terms::begins_with_wavelengths) || overlaps())
}

/// Returns whether a column is unnamed, or its name is that of the first wavelengths, or only x, with a number or not.
fn is_open(header: &Header, at: usize, column: usize) -> bool {
    let unit = |column: usize| header.units.get(column).map(String::as_str).filter(|unit| !unit.is_empty());
    let name = header.name(column);
    let open = name.is_none_or(|name| header.name(at) == Some(name) || header_terms::is_x(name));
    open && unit(column).is_none_or(|own| unit(at) == Some(own))
}

/// Marks every second column as wavelengths where nothing names those columns, all of them are in order over much the same
/// range, and no other is, unless it has a name of its own.
fn guess_pairs(header: &Header, at: usize, first: &[f64], columns: &[Vec<f64>], kinds: &mut [Kind]) -> bool {
    let filled: Vec<usize> = (0..columns.len()).filter(|&index| kinds[index] != Kind::Empty).collect();
    let named = !header.names.is_empty();
    let sound = |values: &[f64]| -> Option<(f64, f64)> {
        let (low, high) = ends(values)?;
        let enough = values.iter().filter(|value| !value.is_nan()).nth(FEWEST_ROWS).is_some();
        (enough && units::plausible(low, high, named)).then_some((low, high))
    };
    let Some((low, high)) = sound(first).filter(|_| filled.len() >= FEWEST_ROWS && filled.len() % 2 == 1) else {
        return false;
    };
    let is_like = |index: usize| {
        sound(&columns[index]).is_some_and(|(a, b)| 2.0 * (b.min(high) - a.max(low)) > (b - a).max(high - low))
    };
    let fits = |place: usize, index: usize| {
        let open = is_open(header, at, at + 1 + index);
        if place % 2 == 1 { open && is_like(index) } else { (named && !open) || !is_like(index) }
    };
    let pairs = filled.iter().enumerate().all(|(place, &index)| fits(place, index));
    // What the names say of the columns is no guess.
    let said = || filled.iter().skip(1).step_by(2).all(|&index| kinds[index] == Kind::Wavelengths);
    if !pairs || said() {
        return false;
    }
    filled.iter().skip(1).step_by(2).for_each(|&index| kinds[index] = Kind::Wavelengths);
    true
}

/// The column of wavelengths in a table without names whose first column counts its rows.
pub(super) fn after_count(cells: &[Vec<f64>]) -> Option<usize> {
    let [count, wavelengths, _, ..] = cells else { return None };
    let (low, high) = ends(wavelengths).filter(|_| counts_from_start(count, FEWEST_ROWS + 1))?;
    units::plausible(low, high, false).then_some(1)
}

/// True for wavelengths that may count the rows instead, beside numbers that may be wavelengths.
pub(super) fn may_count(wavelengths: &[f64], column: &[f64]) -> bool {
    const MOST: f64 = 100.0;
    // Refractive indices are in order too.
    const LEAST_RATIO: f64 = 2.0;
    let is_axis = |low: f64, high: f64| {
        (units::plausible(low, high, true) || low >= 0.1 && high <= MOST) && high >= LEAST_RATIO * low
    };
    let are_edges = column.iter().zip(wavelengths).all(|(edge, nm)| (edge - nm).abs() <= 1.0);
    let in_order = || ends(column).is_some_and(|(low, high)| is_axis(low, high));
    wavelengths.len() >= FEWEST_COUNTED && counts(wavelengths) && !are_edges && in_order()
}

/// The unit of a column of wavelengths and that of the first, where they differ.
fn units(header: &Header, first: usize, column: usize) -> Option<(WavelengthUnit, WavelengthUnit)> {
    match (unit(header, column), unit(header, first)) {
        (Some(XUnit::Wavelength(own)), Some(XUnit::Wavelength(shared))) if own != shared => Some((own, shared)),
        _ => None,
    }
}

/// Reads each column with the wavelengths that stand before it. Where all wavelengths are the same, the curves share them.
pub(super) fn read_pairs(
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
