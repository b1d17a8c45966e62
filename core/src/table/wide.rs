//! Reads tables whose wavelengths run across a header row: every row is a curve.

use super::bands;
use super::dialect::{Cell, Dialect};
use super::grid::{Grid, RawCurve};
use super::header;
use super::reading::MAX_PARTS;
use super::sniff::Layout;
use super::text::{Lines, Section, comment, excerpt};
use super::trial::Across;
use super::warning::{LineList, Warning};
use super::watch::Log;
use super::{Decided, MAX_CURVES, MAX_SAMPLES, Orientation, Part, ReadError, Role, WavelengthUnit, quantity, words};

/// Reads the header row and the rows of a layout.
pub(super) fn read(section: Section<'_>, layout: &Layout, log: &mut Log<'_>) -> Result<Grid, ReadError> {
    debug_assert_eq!(layout.orientation.value, Orientation::Across);
    let Some(across) = &layout.across else { return Err(ReadError::NoNumbers) };
    let mut lines = Lines::of(section).skip_while(|(number, _)| *number < across.line);
    let Some((_, header_line)) = lines.next() else { return Err(ReadError::NoNumbers) };
    let dialect = layout.dialect();
    let (wavelengths, label_unit) = wavelengths(dialect, header_line, across)?;
    let leading: Vec<&str> = dialect.cells(header_line).take(across.start).collect();
    let mut header = header::read(section, layout);
    let named_unit = leading.iter().filter(|cell| words::names_wavelengths(cell)).find_map(|cell| words::x_unit(cell));
    header.x_unit = named_unit.map(|unit| (across.line, unit)).or(header.x_unit);
    header.line = Some(across.line);
    let mut rows = Rows::new(dialect, across, name_column(&leading));
    let mut read = section.byte;
    for (number, line) in lines {
        read += line.len() + 1;
        log.at(read)?;
        // Names of samples may begin with `#` too.
        let is_row = || comment(line).is_none() || rows.parse(number, line).is_ok_and(|row| row.is_some());
        if !line.trim_ascii().is_empty() && line != header_line && is_row() {
            rows.take(number, line)?;
        }
    }
    if let Some((line, error, is_row)) = rows.broken {
        if is_row {
            return Err(error);
        }
        log.push(Warning::TextBelow { line });
    }
    if rows.gaps > 0 {
        log.push(Warning::Gaps { cells: rows.gaps, lines: rows.gap_lines, sentinel: None });
    }
    header.mentioned = rows.mentioned.or(header.mentioned);
    let count = rows.curves.len();
    let group = across.groups.iter().position(|group| group.start == across.start);
    let named = group.map(|group| &across.groups[group]);
    let suffix = named.map_or("", |group| &*group.suffix);
    for curve in &mut rows.curves {
        suffix.clone_into(&mut curve.label);
        curve.unit = quantity::unit_cell(suffix).or_else(|| header.unit.clone());
    }
    let specular = named.map(|group| &*group.prefix).filter(|prefix| words::says_specular(prefix));
    let role = specular.map(|prefix| Decided::guess(Role::Reflectance, format!("The bands are named {prefix}")));
    let parts = across.groups.iter().filter(|_| across.groups.len() > 1).map(|group| Part {
        line: across.first_row,
        name: group.prefix.clone(),
        curves: count,
        rows: count,
    });
    let parts: Vec<Part> = parts.take(MAX_PARTS).collect();
    let lines = vec![across.line];
    Ok(Grid {
        wavelengths,
        lines,
        curves: rows.curves,
        header,
        label_unit,
        rows: count,
        role,
        parts,
        ..Grid::default()
    })
}

fn wavelengths(dialect: Dialect, line: &str, across: &Across) -> Result<(Vec<f64>, Option<WavelengthUnit>), ReadError> {
    let mut unit = None;
    let mut wavelengths = Vec::with_capacity(across.count);
    for (index, cell) in dialect.cells(line).enumerate().skip(across.start).take(across.count) {
        let broken = || ReadError::NotANumber { line: across.line, column: index + 1, text: excerpt(cell) };
        if let Cell::Number(value) = dialect.parse(cell) {
            wavelengths.push(value);
            continue;
        }
        let band = Some(across).filter(|across| !across.groups.is_empty()).and_then(|_| bands::band(dialect, cell));
        if let Some(band) = band {
            unit = band.unit;
            wavelengths.push(band.wavelength);
            continue;
        }
        let (value, label) = dialect.parse_label(cell).ok_or_else(broken)?;
        if *unit.get_or_insert(label) != label {
            return Err(broken());
        }
        wavelengths.push(value);
    }
    Ok((wavelengths, unit))
}

/// The leading column that best names a row: one headed so, else the first.
fn name_column(leading: &[&str]) -> usize {
    const NAMES: [&str; 7] = ["name", "sample", "label", "patch", "color", "tag", "id"];
    let headed = |wanted: &&str| leading.iter().position(|cell| cell.to_lowercase().contains(*wanted));
    NAMES.iter().find_map(headed).unwrap_or(0)
}

/// The curves so far.
struct Rows<'a> {
    dialect: Dialect,
    across: &'a Across,
    name_column: usize,
    curves: Vec<RawCurve>,
    gaps: usize,
    gap_lines: LineList,
    mentioned: Option<(usize, super::Role)>,
    /// A line that is no row: its number, the error it makes if rows follow, and whether it is an error by itself.
    broken: Option<(usize, ReadError, bool)>,
}

impl<'a> Rows<'a> {
    fn new(dialect: Dialect, across: &'a Across, name_column: usize) -> Self {
        Self {
            dialect,
            across,
            name_column,
            curves: Vec::new(),
            gaps: 0,
            gap_lines: LineList::default(),
            mentioned: None,
            broken: None,
        }
    }

    fn take(&mut self, number: usize, line: &str) -> Result<(), ReadError> {
        match self.parse(number, line) {
            Err((error, is_row)) => {
                self.broken.get_or_insert((number, error, is_row));
                Ok(())
            }
            Ok(None) => Ok(()),
            Ok(Some(curve)) => {
                if let Some((_, error, _)) = self.broken.take() {
                    return Err(error);
                }
                let mut leading = self.dialect.cells(line).take(self.across.start);
                let role = leading.find_map(words::role).map(|role| (number, role));
                self.mentioned = self.mentioned.or(role);
                self.push(number, curve)
            }
        }
    }

    /// A row as a curve; `None` for a row of empty cells; an error, and whether the line looks like a row at all.
    fn parse(&self, number: usize, line: &str) -> Result<Option<RawCurve>, (ReadError, bool)> {
        let (start, width) = (self.across.start, self.across.width());
        let mut values = Vec::with_capacity(self.across.count);
        let (mut cells, mut filled) = (0, 0);
        let mut names: (&str, &str) = ("", "");
        for cell in self.dialect.cells(line) {
            if cells < start {
                names.0 = if cells == self.name_column { cell } else { names.0 };
                names.1 = if names.1.is_empty() { cell } else { names.1 };
            } else if cells < width {
                values.push(match self.dialect.parse(cell) {
                    Cell::Number(value) => value,
                    Cell::Gap => f64::NAN,
                    Cell::Text => {
                        let error = ReadError::NotANumber { line: number, column: cells + 1, text: excerpt(cell) };
                        let is_row =
                            values.iter().any(|value: &f64| !value.is_nan()) || cells == start && self.is_long(line);
                        return Err((error, is_row));
                    }
                });
            }
            cells += 1;
            filled = if cell.is_empty() { filled } else { cells };
        }
        if filled == 0 {
            return Ok(None);
        }
        if cells < width || filled > self.across.cells {
            let found = if cells < width { cells } else { filled };
            let error = ReadError::UnevenRow { line: number, found, expected: width };
            return Err((error, values.iter().any(|value| !value.is_nan())));
        }
        let name = if names.0.is_empty() { names.1 } else { names.0 };
        let named = !name.is_empty();
        let name = if named { name.replace("\"\"", "\"") } else { format!("Row {}", self.curves.len() + 1) };
        Ok(Some(RawCurve { name, named, values, ..RawCurve::default() }))
    }

    /// Whether a line has as many cells as a row.
    fn is_long(&self, line: &str) -> bool {
        self.dialect.cells(line).take(self.across.width()).count() == self.across.width()
    }

    fn push(&mut self, number: usize, curve: RawCurve) -> Result<(), ReadError> {
        let missing = curve.values.iter().filter(|value| value.is_nan()).count();
        if missing > 0 {
            self.gaps += missing;
            self.gap_lines.add(number);
        }
        if self.curves.len() >= MAX_CURVES {
            return Err(ReadError::TooManyCurves { line: number });
        }
        if (self.curves.len() + 1) * self.across.count > MAX_SAMPLES {
            return Err(ReadError::TooManySamples { line: number });
        }
        self.curves.push(curve);
        Ok(())
    }
}
