//! Columns that are no curves: wavelengths again, in another unit, at the other edges of intervals, or counts and times of rows.

use crate::header::Header;
use crate::header_terms::{self, XUnit};
use crate::no_curve::{FEWEST_ROWS, counts, is_empty, is_other_scale, tells_rows_apart};
use crate::text::listed;
use crate::units;

/// Roles of the columns beside the first wavelengths.
#[derive(Debug, Default)]
pub(super) struct Axes {
    /// Columns, counted from the one right of the wavelengths, that hold the wavelengths of those behind them.
    pub(super) more: Vec<usize>,
    /// Omitted columns of the table.
    pub(super) left: Vec<usize>,
    /// True if only the numbers suggest that there are several columns of wavelengths.
    pub(super) guessed: bool,
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
            || is_other_scale(wavelengths, values);
        axes.left.extend((scale && !is_empty(values)).then_some(column));
    }
    let kind = |(index, column): (usize, &Vec<f64>)| kind(header, at, index, wavelengths, column);
    let mut kinds: Vec<Kind> = columns.iter().enumerate().map(kind).collect();
    axes.guessed = guess_pairs(header, at, wavelengths, columns, &mut kinds);
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

/// Columns in words, the first few.
pub(super) fn column_list(header: &Header, columns: &[usize]) -> String {
    let name = |column: &usize| match header.name(*column) {
        Some(name) => format!("column {} (“{name}”)", column + 1),
        None => format!("column {}", column + 1),
    };
    listed(&columns.iter().map(name).collect::<Vec<_>>())
}

fn kind(header: &Header, at: usize, index: usize, wavelengths: &[f64], column: &[f64]) -> Kind {
    let name = header.name(at + 1 + index);
    // A column with a name of its own is a curve, even if it happens to hold the same numbers.
    let alike = name.is_none_or(|name| header.name(at) == Some(name));
    let scale = || {
        let label = |name| header_terms::is_label(name) && tells_rows_apart(column);
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
        () if wavelengths.len() > 1 && column == wavelengths && alike => Kind::Wavelengths,
        () => Kind::Value,
    }
}

/// The unit that the header gives for a column of wavelengths.
pub(super) fn unit(header: &Header, column: usize) -> Option<XUnit> {
    let unit = header.units.get(column).and_then(|unit| header_terms::x_unit(unit));
    unit.or_else(|| header_terms::x_unit(header.name(column)?))
}

/// The ends of numbers that rise or fall all the way, up to the last one.
fn ends(values: &[f64]) -> Option<(f64, f64)> {
    let end = values.iter().rposition(|value| !value.is_nan()).map_or(0, |at| at + 1);
    let values = &values[..end];
    let ordered = |sign: f64| values.windows(2).all(|pair| sign * (pair[1] - pair[0]) > 0.0);
    let (a, b) = (*values.first()?, *values.last()?);
    (a.is_finite() && b.is_finite() && (ordered(1.0) || ordered(-1.0))).then_some((a.min(b), a.max(b)))
}

/// Returns whether the numbers of a column whose name mentions wavelengths run as those in the first of two columns do: names such as
/// `LED, wavelength shifted` do so too.
fn runs_like_axis(header: &Header, [first, column]: [usize; 2], wavelengths: &[f64], values: &[f64]) -> bool {
    let name = header.name(column);
    if name.is_some() && name == header.name(first) {
        return true;
    }
    let Some((low, high)) = ends(values).filter(|(low, _)| *low > 0.0) else { return false };
    let (shared, own) = (unit(header, first), unit(header, column));
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

/// Returns whether a column is unnamed, or its name is that of the first wavelengths, or only x.
fn is_open(header: &Header, at: usize, column: usize) -> bool {
    let unit = |column: usize| header.units.get(column).map(String::as_str).filter(|unit| !unit.is_empty());
    let name = header.name(column);
    let open = name.is_none_or(|name| header.name(at) == Some(name) || name.eq_ignore_ascii_case("x"));
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
    let from_start = count.len() > FEWEST_ROWS && counts(count) && matches!(count[0], 0.0 | 1.0);
    let (low, high) = ends(wavelengths).filter(|_| from_start)?;
    units::plausible(low, high, false).then_some(1)
}
