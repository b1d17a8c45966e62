//! Grid that every reader fills: wavelengths as written, and the values of each curve beside them.

use chromascope_text::on_one_line;

use crate::decision::{Decided, Dropped, Part, Quantity, Role, WavelengthUnit};
use crate::error::ReadError;
use crate::header::Header;
use crate::report::{Curve, DroppedRow, Uncertainty};
use crate::warning::{Sentinel, Warning};
use crate::watch::Log;

/// Numbers as they stand in the file, before units, order and scale are settled.
#[derive(Debug, Default)]
pub(super) struct Grid {
    pub(super) wavelengths: Vec<f64>,
    /// The line of each wavelength; a single one if all stand in the same line.
    pub(super) lines: Vec<usize>,
    /// The curves; each has one value (NaN for a gap) for each wavelength.
    pub(super) curves: Vec<RawCurve>,
    pub(super) header: Header,
    /// The unit, if it stands beside each wavelength.
    pub(super) label_unit: Option<WavelengthUnit>,
    /// The unit, if the format prescribes it.
    pub(super) unit: Option<Decided<WavelengthUnit>>,
    pub(super) role: Option<Decided<Role>>,
    /// Role that the metadata beside the file state, or that the names of file and folders suggest.
    pub(super) beside: Option<Decided<Role>>,
    pub(super) quantity: Option<Decided<Quantity>>,
    /// The parts of the file, if it can have several, and which one this is.
    pub(super) parts: Vec<Part>,
    pub(super) part: Option<Decided<usize>>,
    pub(super) rows: usize,
    /// The column of the wavelengths, from 1, where they run down one.
    pub(super) wavelength_column: Option<usize>,
    /// True if each curve has wavelengths of its own, so that one it lacks is no gap.
    pub(super) own_wavelengths: bool,
    /// A number that represents missing values, to be reported with the gaps.
    pub(super) sentinel: Option<Sentinel>,
    /// More columns of wavelengths, from 0, with units of their own.
    pub(super) axes: Vec<(usize, Option<WavelengthUnit>)>,
    /// The lines of a table whose curves have wavelengths of their own.
    pub(super) row_lines: Vec<usize>,
    pub(super) dropped: Vec<DroppedRow>,
}

#[derive(Debug, Default)]
pub(super) struct RawCurve {
    pub(super) name: String,
    pub(super) named: bool,
    /// The column it stands in, from 1, where wavelengths run down one.
    pub(super) column: Option<usize>,
    /// Its column from 0, its line, or its number among the curves of the file: the name of its places.
    pub(super) origin: usize,
    /// The header's information about this curve: its name and its unit.
    pub(super) label: String,
    pub(super) unit: Option<String>,
    pub(super) values: Vec<f64>,
    pub(super) uncertainty: Option<Stated>,
    /// Derivatives of the values by those that the file has, where a covariance has to follow them; else empty.
    pub(super) slopes: Vec<f64>,
}

/// Uncertainties of a curve as a column states them: k u for each value.
#[derive(Debug)]
pub(super) struct Stated {
    pub(super) numbers: Vec<f64>,
    /// The column, for messages.
    pub(super) named: String,
    /// Its place, as in [`RawCurve::origin`].
    pub(super) origin: usize,
    pub(super) coverage: Decided<f64>,
    pub(super) scale: StatedScale,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum StatedScale {
    /// The unit of the values.
    Unit,
    /// Percent, of the value or as the values are.
    Percent,
    /// Percent as the values are, if they are percent.
    SamePercent,
    /// Percent of the value.
    Relative,
    /// A part of the value, in one or in percent.
    Part,
}

impl RawCurve {
    /// Converts small differences of the values, by a function of a difference, the value before its conversion, and its index.
    pub(super) fn convert_differences(&mut self, by: impl Fn(f64, f64, usize) -> f64) {
        let stated = self.uncertainty.as_mut().map(|stated| &mut stated.numbers);
        for differences in stated.into_iter().chain(Some(&mut self.slopes)) {
            for (index, (difference, value)) in differences.iter_mut().zip(&self.values).enumerate() {
                *difference = by(*difference, *value, index);
            }
        }
    }

    /// The name between quotes, and the column if the name does not say it.
    pub(super) fn description(&self) -> String {
        match self.column.filter(|_| self.named) {
            Some(column) => format!("“{}” (column {column})", self.name),
            None => format!("“{}”", self.name),
        }
    }
}

impl Grid {
    pub(super) fn range_nm(&self) -> [f64; 2] {
        [self.wavelengths[0], self.wavelengths[self.wavelengths.len() - 1]]
    }

    pub(super) fn line(&self, index: usize) -> usize {
        self.lines.get(index).or(self.lines.last()).copied().unwrap_or(1)
    }

    /// Puts the samples in the given order, a permutation of their indices.
    pub(super) fn reorder(&mut self, order: &[usize]) {
        if self.lines.len() == order.len() {
            self.lines = order.iter().map(|&i| self.lines[i]).collect();
        }
        self.wavelengths = order.iter().map(|&i| self.wavelengths[i]).collect();
        for curve in &mut self.curves {
            curve.values = order.iter().map(|&i| curve.values[i]).collect();
        }
    }

    /// Returns whether two samples hold the same values in every curve, gaps counting as equal.
    pub(super) fn same_values(&self, a: usize, b: usize) -> bool {
        self.curves.iter().all(|curve| {
            let (a, b) = (curve.values[a], curve.values[b]);
            a == b || (a.is_nan() && b.is_nan())
        })
    }

    /// Settles which part of a file this is; a file without a list of parts is a single one.
    pub(super) fn settle_parts(
        &mut self,
        chosen: Option<usize>,
        first_line: usize,
    ) -> Result<(Vec<Part>, Decided<usize>), ReadError> {
        let mut parts = std::mem::take(&mut self.parts);
        if parts.is_empty() {
            let name = self.header.comment("title").unwrap_or_default().to_owned();
            parts.push(Part { line: first_line, name, curves: self.curves.len(), rows: self.rows });
        }
        if let Some(part) = chosen.filter(|part| !(1..=parts.len()).contains(part)) {
            return Err(ReadError::NoSuchPart { part, parts: parts.len() });
        }
        let only = || Decided::certain(1, "The file has one part");
        let part = chosen.map_or_else(|| self.part.take().unwrap_or_else(only), Decided::chosen);
        Ok((parts, part))
    }

    /// Puts the means of some rows into the first of them; gaps are in no mean.
    pub(super) fn average(&mut self, start: usize, count: usize) {
        for curve in &mut self.curves {
            let rows = &mut curve.values[start..start + count];
            let (mut mean, mut seen) = (f64::NAN, 0.0);
            for &value in rows.iter().filter(|value| !value.is_nan()) {
                seen += 1.0;
                mean = if seen == 1.0 { value } else { mean + (value / seen - mean / seen) };
            }
            rows[0] = mean;
        }
    }

    pub(super) fn drop_row(&mut self, line: usize, why: Dropped) {
        self.dropped.push(DroppedRow { line, why });
    }

    pub(super) fn remove(&mut self, marked: &[bool]) {
        if self.lines.len() == marked.len() {
            retain(&mut self.lines, marked);
        }
        retain(&mut self.wavelengths, marked);
        for curve in &mut self.curves {
            retain(&mut curve.values, marked);
        }
    }

    /// The curves without their gaps, their origins and those of their uncertainties, and their slopes, curve after curve. A curve of fewer than two values is left
    /// out; it is worth a warning only if it has a name or a value.
    pub(super) fn into_curves(mut self, log: &mut Log<'_>) -> (Vec<Curve>, Origins, Vec<f64>) {
        let mut gaps = vec![0_u32; self.wavelengths.len()];
        let (mut curves, mut origins, mut slopes) = (Vec::new(), Origins::default(), Vec::new());
        let (mut empty, mut first_empty) = (0, None);
        for mut raw in std::mem::take(&mut self.curves) {
            let missing = raw.values.iter().filter(|value| value.is_nan()).count();
            let left = raw.values.len() - missing;
            if left < 2 {
                if left > 0 || !raw.label.is_empty() {
                    empty += 1;
                    first_empty.get_or_insert(raw.description());
                }
                continue;
            }
            for (count, value) in gaps.iter_mut().zip(&raw.values) {
                *count += u32::from(value.is_nan());
            }
            if let Some(stated) = &mut raw.uncertainty {
                stated.fill(&raw.values, log);
                origins.uncertain.push((stated.origin, origins.curves.len()));
            }
            origins.curves.push(raw.origin);
            slopes.extend(
                raw.slopes.iter().zip(&raw.values).filter(|(_, value)| !value.is_nan()).map(|(slope, _)| *slope),
            );
            curves.push(curve(raw, &self.wavelengths, missing));
        }
        if self.own_wavelengths {
            for curve in &mut curves {
                curve.missing = 0;
            }
        } else {
            warn_gaps(&gaps, &self.lines, self.sentinel.take(), log);
        }
        if let Some(first) = first_empty {
            log.push(Warning::EmptyCurves { count: empty, first });
        }
        (curves, origins, slopes)
    }
}

/// Places of curves in a file, in their order, and of the columns of uncertainties, with the index of their curve.
#[derive(Debug, Default)]
pub(super) struct Origins {
    pub(super) curves: Vec<usize>,
    pub(super) uncertain: Vec<(usize, usize)>,
}

impl Stated {
    /// Puts the larger of the neighbors' uncertainties where a value has none.
    fn fill(&mut self, values: &[f64], log: &mut Log<'_>) {
        let lacks = |(number, value): (&f64, &f64)| !number.is_finite() && !value.is_nan();
        let count = self.numbers.iter().zip(values).filter(|pair| lacks(*pair)).count();
        if count == 0 {
            return;
        }
        log.push(Warning::UncertaintyGaps { named: self.named.clone(), count });
        let known = |number: &f64| if number.is_finite() { number.abs() } else { 0.0 };
        let mut after = vec![0.0; self.numbers.len()];
        let mut next = 0.0;
        for (after, number) in after.iter_mut().zip(&self.numbers).rev() {
            next = if number.is_finite() { known(number) } else { next };
            *after = next;
        }
        let mut before: f64 = 0.0;
        for (number, after) in self.numbers.iter_mut().zip(after) {
            if number.is_finite() { before = known(number) } else { *number = before.max(after) }
        }
    }
}

fn curve(raw: RawCurve, wavelengths: &[f64], missing: usize) -> Curve {
    let RawCurve { name, named, unit, mut values, uncertainty, .. } = raw;
    let uncertainty = uncertainty.map(|Stated { numbers, coverage, .. }| {
        let present = numbers.iter().zip(&values).filter(|(_, value)| !value.is_nan());
        let standard = present.map(|(number, _)| number.abs() / coverage.value).collect();
        Uncertainty { standard, coverage: coverage.value }
    });
    let name = on_one_line(&name).into_owned();
    if missing == 0 {
        values.shrink_to_fit();
        return Curve { name, named, wavelengths_nm: wavelengths.to_vec(), values, missing, unit, uncertainty };
    }
    let present = wavelengths.iter().zip(&values).filter(|(_, value)| !value.is_nan());
    let wavelengths_nm = present.map(|(wavelength, _)| *wavelength).collect();
    values.retain(|value| !value.is_nan());
    Curve { name, named, wavelengths_nm, values, missing, unit, uncertainty }
}

fn warn_gaps(gaps: &[u32], lines: &[usize], sentinel: Option<Sentinel>, log: &mut Log<'_>) {
    let cells: usize = gaps.iter().map(|&count| count as usize).sum();
    if cells == 0 {
        return;
    }
    // Curves in rows: their reader alone knows the lines of the gaps, and has reported them.
    if lines.len() != gaps.len() {
        return;
    }
    let with_gaps = gaps.iter().zip(lines).filter(|(count, _)| **count > 0);
    let mut gap_lines: Vec<usize> = with_gaps.map(|(_, line)| *line).collect();
    gap_lines.sort_unstable();
    log.push(Warning::Gaps { cells, lines: gap_lines.into_iter().collect(), sentinel });
}

pub(super) fn retain<T>(items: &mut Vec<T>, marked: &[bool]) {
    let mut marks = marked.iter();
    items.retain(|_| !marks.next().copied().unwrap_or(false));
}
