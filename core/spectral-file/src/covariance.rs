//! Covariance beside a file: a square matrix of the samples of all its curves, curve after curve.

use crate::decision::Decision;
use crate::grid::Grid;
use crate::report::{Covariance, Curve, Uncertainty};
use crate::warning::Warning;
use crate::watch::Log;

/// Ending of the file with the covariance, in place of that of the table's own name: `leaf.cov.csv` of `leaf.csv`.
pub const COVARIANCE: &str = "cov.csv";

/// Most samples of a covariance.
const MOST: usize = 1500;

/// Makes the curves record how their conversions change small differences, where a covariance has to follow.
pub(super) fn prepare(bytes: &[u8], grid: &mut Grid) {
    if !bytes.is_empty() {
        grid.curves.iter_mut().for_each(|curve| curve.slopes = vec![1.0; curve.values.len()]);
    }
}

/// Takes the covariance of curves, and from it the uncertainties of those without; a wrong one is left out with a warning.
pub(super) fn take(
    bytes: &[u8],
    curves: &mut [Curve],
    slopes: &[f64],
    [reordered, descending]: [bool; 2],
    notes: &mut Vec<Decision>,
    log: &mut Log<'_>,
) -> Option<Covariance> {
    let order = "rows of the file are left out or in another order: sort them, each wavelength once";
    let found = match bytes {
        [] => return None,
        _ if reordered => Err(order.to_owned()),
        bytes => read(bytes, curves, slopes, descending),
    };
    let covariance = found.map_err(|why| log.push(Warning::NoCovariance(why))).ok()?;
    give_variances(curves, &covariance);
    let known = format!("covariance of {} samples", covariance.size);
    notes.push(Decision::certain("Covariance", known, "A file beside states it"));
    Some(covariance)
}

/// Reads the covariance of curves whose samples have the given derivatives by the numbers in the file, and, where rows descend, stand
/// in the opposite order there. The error is the reason why it is none, with the remedy.
fn read(bytes: &[u8], curves: &[Curve], slopes: &[f64], descending: bool) -> Result<Covariance, String> {
    let size = slopes.len();
    if size > MOST {
        return Err(format!("the curves have {size} samples, and it can be of {MOST} at most"));
    }
    let text = std::str::from_utf8(bytes).map_err(|_| "it is no text in UTF-8: save it as CSV".to_owned())?;
    let stated = matrix(text.trim_start_matches('\u{FEFF}'), size)?;
    // Index in the matrix of each sample.
    let mut places = Vec::with_capacity(size);
    for curve in curves {
        let own = places.len()..places.len() + curve.values.len();
        if descending { places.extend(own.rev()) } else { places.extend(own) }
    }
    let at = |row: usize, column: usize| stated[places[row] * size + places[column]];
    let mut values = Vec::with_capacity(size * size);
    for row in 0..size {
        for column in 0..size {
            let (value, other, scale) = (at(row, column), at(column, row), (at(row, row) * at(column, column)).sqrt());
            if row == column && value < 0.0 {
                return Err(format!("row {} has a variance below zero, {value}", places[row] + 1));
            }
            if (value - other).abs() > 1e-9 * value.abs().max(other.abs()).max(scale) {
                let [row, column] = [row, column].map(|at| places[at] + 1);
                return Err(format!("it is not symmetric: {value} in row {row}, column {column}, and {other} across"));
            }
            // The mean, so that it is symmetric to the last bit.
            values.push((value * 0.5 + other * 0.5) * (slopes[row] * slopes[column]));
        }
    }
    if values.iter().any(|value| !value.is_finite()) {
        return Err("it has numbers beyond all that can be computed with".to_owned());
    }
    Ok(Covariance { size, values })
}

/// The last cells of the last rows of a table, which may have labels before and above them.
fn matrix(text: &str, size: usize) -> Result<Vec<f64>, String> {
    let lines = || text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let rows = lines().count();
    let wrong = |what: &str, count: usize| {
        format!("{count} {what} do not fit the {size} samples of the curves, which it has to list one after the other")
    };
    let labels = rows.checked_sub(size).filter(|labels| *labels <= 1).ok_or_else(|| wrong("rows", rows))?;
    let mut values = Vec::with_capacity(size * size);
    for (index, line) in lines().skip(labels) {
        let comma = line.contains([';', '\t']);
        let cells = || {
            let by = |c: char| if comma { matches!(c, ';' | '\t') } else { matches!(c, ',' | ' ') };
            line.split(by).map(str::trim).filter(move |cell| comma || !cell.is_empty() || line.contains(','))
        };
        let count = cells().count();
        let left = count.checked_sub(size).filter(|left| *left <= 1).ok_or_else(|| wrong("columns", count))?;
        for cell in cells().skip(left) {
            let number = if comma { cell.replace(',', ".") } else { cell.to_owned() };
            let number = number.parse::<f64>().ok().filter(|number| number.is_finite());
            values.push(
                number
                    .ok_or_else(|| format!("line {} has “{}” for a number", index + 1, crate::text::excerpt(cell)))?,
            );
        }
    }
    Ok(values)
}

/// Gives curves whose file states no uncertainties those on the diagonal of their covariance.
fn give_variances(curves: &mut [Curve], covariance: &Covariance) {
    let mut first = 0;
    for curve in curves {
        let own = first..first + curve.values.len();
        first = own.end;
        curve.uncertainty.get_or_insert_with(|| {
            let standard = own.map(|at| covariance.values[at * (covariance.size + 1)].sqrt()).collect();
            Uncertainty { standard, coverage: 1.0 }
        });
    }
}
