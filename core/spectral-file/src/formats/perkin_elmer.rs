//! ASCII of `PerkinElmer` (PEDS), of Lambda spectrophotometers and LS fluorimeters: a header of lines without labels, units behind
//! `#GR`, and pairs behind `#DATA`.

use crate::decision::{Decided, DecimalMark, Delimiter, Reader, Role, Values};
use crate::error::ReadError;
use crate::formats::Format;
use crate::formats::spectra::{self, Found, Spectrum};
use crate::header::Header;
use crate::header_terms;
use crate::options::ReadOptions;
use crate::text::Lines;
use crate::warning::Warning;
use crate::watch::Log;

impl Reader {
    /// ASCII of `PerkinElmer` (PEDS).
    pub const PERKIN_ELMER: Self = Self::new("perkinelmer", "PerkinElmer ASCII (PEDS)", "PerkinElmer ASCII");
}

pub(super) const FORMAT: Format = Format { reader: Reader::PERKIN_ELMER, fits: |head| recognize(head.text), read };

fn recognize(text: &str) -> bool {
    let first = text.trim_start().strip_prefix("PE ").and_then(|rest| rest.lines().next());
    first.is_some_and(|line| line.contains("ASCII") && line.contains("PEDS"))
}

/// Lines of the section `#GR` behind its name: units of both axes, and the number of points.
const UNITS: [usize; 2] = [1, 2];
const POINTS: usize = 7;

fn read(text: &str, _: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let mut header = Header::default();
    let mut points = None;
    let (mut section, mut at) = ("", 0);
    let mut lines = Lines::new(text);
    for (line, text) in lines.by_ref() {
        let cell = text.trim();
        if cell.starts_with('#') {
            (section, at) = (cell, line);
        }
        match (section, line - at) {
            ("#DATA", _) => break,
            ("", 2) => header.note(line, "file", cell),
            ("", 3) if cell.contains(char::is_alphabetic) => {
                header.note(line, "title", cell.rsplit_once('.').map_or(cell, |(stem, _)| stem));
            }
            ("#GR", below) if below == UNITS[0] => {
                header.x_unit = header_terms::x_unit(cell).map(|unit| (line, unit));
                header.note(line, "x units", cell);
            }
            ("#GR", below) if below == UNITS[1] => take_ordinate(line, cell, &mut header),
            ("#GR", POINTS) => points = cell.parse().ok().map(|count: usize| (line, count)),
            _ => {}
        }
    }
    let rows = lines.filter(|(_, line)| !line.trim().is_empty()).take_while(|(_, line)| !line.starts_with('#'));
    let samples = spectra::rows(rows, &[1], log)?.pop().unwrap_or_default();
    let first_line = samples.first().map(|sample| sample.line).ok_or(ReadError::NoNumbers)?;
    let found = samples.len();
    if let Some((line, expected)) = points.filter(|(_, expected)| *expected != found) {
        log.push(Warning::CountDiffers { line, expected, found });
    }
    let mut grid = spectra::grid(vec![Spectrum { samples, ..Spectrum::default() }], header, log)?;
    if text.trim_start().starts_with("PE FL") {
        grid.role = Some(Decided::certain(Role::Unknown, "Line 1 is of a fluorimeter"));
    } else if grid.header.values.is_some_and(|(_, values)| values == Values::Absorbance) {
        grid.role = Some(Decided::guess(Role::Transmittance, "The values are absorbances"));
    }
    let why = "The first line names it";
    let dialect = (Delimiter::Spaces, DecimalMark::Point);
    Ok(Found::fixed(grid, Decided::certain(Reader::PERKIN_ELMER, why), (dialect, first_line, why), Vec::new()))
}

/// Takes the unit of the values: `%T`, `%R`, `A`, `T` or `R`.
fn take_ordinate(line: usize, unit: &str, header: &mut Header) {
    header.note(line, "y units", unit);
    let (role, values) = match unit.to_ascii_uppercase().as_str() {
        "A" => (None, Some(Values::Absorbance)),
        "T" => (Some(Role::Transmittance), Some(Values::Plain)),
        "R" => (Some(Role::Reflectance), Some(Values::Plain)),
        _ => (header_terms::role(unit), header_terms::values(unit)),
    };
    header.role = role.map(|role| (line, role));
    header.values = values.map(|values| (line, values));
    header.quantity = header_terms::quantity(unit).map(|quantity| (line, quantity));
}
