//! CGATS and its relatives (Argyll `.sp`, `.cmf`, `.ti3`, `.ccss`, X-Rite, `BabelColor`): keywords, named fields, sets.

mod bands;
mod tokens;

use bands::{Bands, Declared};
use tokens::Token;

use super::super::dialect::{Cell, Dialect};
use super::super::grid::{Grid, RawCurve};
use super::super::header::Header;
use super::super::sniff::Layout;
use super::super::text::{Lines, excerpt};
use super::super::words;
use super::super::{
    Decided, DecimalMark, Decision, Delimiter, MAX_CURVES, MAX_SAMPLES, Orientation, ReadError, Reader, Role, Warning,
    WavelengthUnit,
};
use super::Found;

/// Reads the first table that has spectral fields.
pub(super) fn read(text: &str, warnings: &mut Vec<Warning>) -> Result<Found, ReadError> {
    let mut file = File::default();
    let mut place = Place::Keywords;
    for (number, line) in Lines::new(text) {
        let mut tokens = tokens::of(line).peekable();
        while let Some(token) = tokens.next() {
            place = match (place, token.bare().unwrap_or_default()) {
                (_, "BEGIN_DATA_FORMAT") => {
                    file.begin_format(number);
                    Place::Format
                }
                (_, "BEGIN_DATA") => {
                    file.begin_data(number, warnings);
                    Place::Data
                }
                (Place::Format, "END_DATA_FORMAT") | (Place::Data, "END_DATA") => Place::Keywords,
                (Place::Keywords, _) => {
                    file.keyword(number, &token, tokens.next());
                    break;
                }
                (Place::Format, _) => file.field(number, &token)?,
                (Place::Data, _) => file.value(number, &token)?,
            };
        }
    }
    file.finish(warnings)
}

/// Which part of a file a token stands in.
#[derive(Clone, Copy)]
enum Place {
    Keywords,
    Format,
    Data,
}

/// What has been read so far.
#[derive(Default)]
struct File {
    header: Header,
    declared: Declared,
    scale: Option<(usize, f64)>,
    fields: Vec<String>,
    format_line: usize,
    bands: Option<Bands>,
    data_line: usize,
    /// The sets of the first table with spectral fields, value by value.
    names: Vec<String>,
    values: Vec<f64>,
    /// The field that the next value belongs to.
    at: usize,
    name_fields: Vec<usize>,
    row_name: String,
    row_wavelengths: Vec<f64>,
    last_line: usize,
    /// Whether the table that is kept has begun, and whether it has ended.
    done: bool,
    closed: bool,
    /// The fields of a table after it.
    later: Vec<String>,
}

impl File {
    fn keyword(&mut self, line: usize, key: &Token, value: Option<Token>) {
        let (key, value) = (key.text(), value.map_or_else(String::new, |value| value.text()));
        if self.done || key == "KEYWORD" {
            return;
        }
        let number = value.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        match key.as_str() {
            "SPECTRAL_BANDS" => self.declared.bands = number,
            "SPECTRAL_START_NM" => self.declared.start = number,
            "SPECTRAL_END_NM" => self.declared.end = number,
            "SPECTRAL_NORM" | "SPEC_SCALE" => self.scale = number.filter(|n| *n > 0.0).map(|n| (line, n)),
            "DEVICE_CLASS" => {
                let role = if value == "DISPLAY" { Role::Illuminant } else { Role::Reflectance };
                self.header.mentioned = self.header.mentioned.or(Some((line, role)));
            }
            "CCSS" => self.header.role = Some((line, Role::Illuminant)),
            "DESCRIPTOR" => {
                self.header.mentioned = words::role(&value).map(|role| (line, role)).or(self.header.mentioned);
                self.header.note("title", &value);
            }
            _ => {}
        }
        self.header.note(&key, &value);
    }

    fn begin_format(&mut self, line: usize) {
        if self.done {
            self.closed = true;
            self.later.clear();
        } else {
            self.format_line = line;
            self.fields.clear();
        }
    }

    fn field(&mut self, line: usize, token: &Token) -> Result<Place, ReadError> {
        let fields = if self.done { &mut self.later } else { &mut self.fields };
        fields.push(token.text());
        if fields.len() > MAX_CURVES {
            return Err(ReadError::TooManyCurves { line });
        }
        Ok(Place::Format)
    }

    fn begin_data(&mut self, line: usize, warnings: &mut Vec<Warning>) {
        let fields = if self.done { &self.later } else { &self.fields };
        let bands = Bands::of(fields, self.declared);
        if self.done {
            self.closed = true;
            if bands.is_some() && !warnings.iter().any(|warning| matches!(warning, Warning::MoreTables { .. })) {
                warnings.push(Warning::MoreTables { line });
            }
            return;
        }
        self.done = bands.is_some();
        self.bands = bands;
        self.data_line = line;
        let named = |wanted: &&str| self.fields.iter().position(|field| field.eq_ignore_ascii_case(wanted));
        self.name_fields = ["SAMPLE_NAME", "SAMPLE_LOC", "SAMPLE_ID", "SampleID"].iter().filter_map(named).collect();
    }

    fn value(&mut self, line: usize, token: &Token) -> Result<Place, ReadError> {
        let Some(bands) = self.bands.as_ref().filter(|_| self.is_open()) else { return Ok(Place::Data) };
        self.last_line = line;
        if self.name_fields.first() == Some(&self.at) {
            self.row_name = token.text();
        }
        if bands.is_value(self.at) {
            self.values.push(number(token, line, self.at)?);
        } else if bands.is_wavelength(self.at) {
            self.row_wavelengths.push(number(token, line, self.at)?);
        }
        self.at += 1;
        if self.at == self.fields.len() {
            self.end_row(line)?;
        }
        Ok(Place::Data)
    }

    /// Whether the table that is kept is the one being read.
    fn is_open(&self) -> bool {
        self.done && !self.closed && self.fields.len() > self.at
    }

    fn end_row(&mut self, line: usize) -> Result<(), ReadError> {
        self.at = 0;
        self.names.push(std::mem::take(&mut self.row_name));
        if self.values.len() > MAX_SAMPLES {
            return Err(ReadError::TooManySamples { line });
        }
        if self.names.len() > MAX_CURVES {
            return Err(ReadError::TooManyCurves { line });
        }
        let row = std::mem::take(&mut self.row_wavelengths);
        let agrees = self.bands.as_mut().is_none_or(|bands| bands.agrees(row));
        if agrees { Ok(()) } else { Err(ReadError::SecondTable { line }) }
    }

    fn finish(self, warnings: &mut Vec<Warning>) -> Result<Found, ReadError> {
        let bands = self.bands.ok_or(ReadError::NoWavelengths { line: self.format_line.max(1) })?;
        if self.at > 0 {
            let (found, expected) = (self.at, self.fields.len());
            return Err(ReadError::UnevenRow { line: self.last_line, found, expected });
        }
        let mut header = self.header;
        header.line = Some(self.format_line);
        if bands.percent {
            header.percent = Some((self.format_line, true));
        }
        let mut notes = vec![bands.decision()];
        let mut scale = 1.0;
        if let Some((line, norm)) = self.scale {
            scale = norm;
            header.percent = Some((line, false));
            let divided = Decided::certain(format!("divided by {norm}"), format!("Line {line} gives the scale"));
            notes.push(Decision::new("Scale", &divided));
        }
        let title = header.comment("title").filter(|_| self.names.len() == 1).map(str::to_owned);
        let width = bands.wavelengths.len().max(1);
        let rows = self.names.len();
        let curves = self.names.into_iter().zip(self.values.chunks(width)).enumerate().map(|(i, (name, values))| {
            let given = Some(name).filter(|name| !name.is_empty()).or_else(|| title.clone());
            let named = given.is_some();
            let name = given.unwrap_or_else(|| format!("Set {}", i + 1));
            RawCurve { name, named, label: String::new(), values: values.iter().map(|value| value / scale).collect() }
        });
        let curves: Vec<RawCurve> = curves.collect();
        warn_gaps(&curves, self.data_line, warnings);
        let lines = vec![self.format_line];
        let unit = Some(Decided::certain(WavelengthUnit::Nanometer, "CGATS prescribes it"));
        let grid = Grid { unit, wavelengths: bands.wavelengths, lines, curves, header, rows, ..Grid::default() };
        let dialect = (Delimiter::Spaces, DecimalMark::Point);
        let layout = Layout::fixed(dialect, Orientation::Across, self.data_line + 1, "CGATS prescribes it");
        let why = format!("Line {} begins a data format", self.format_line);
        Ok(Found { grid, layout, reader: Decided::certain(Reader::Cgats, why), notes })
    }
}

fn warn_gaps(curves: &[RawCurve], line: usize, warnings: &mut Vec<Warning>) {
    let cells = curves.iter().flat_map(|curve| &curve.values).filter(|value| value.is_nan()).count();
    if cells > 0 {
        let mut lines = super::super::warning::LineList::default();
        lines.add(line);
        warnings.push(Warning::Gaps { cells, lines });
    }
}

/// A value; NaN for a gap. A comma can only be a decimal mark here.
fn number(token: &Token, line: usize, field: usize) -> Result<f64, ReadError> {
    let text = token.text();
    let mark = if text.contains(',') { DecimalMark::Comma } else { DecimalMark::Point };
    match (Dialect { delimiter: Delimiter::Spaces, mark }).parse(&text) {
        Cell::Number(value) => Ok(value),
        Cell::Gap => Ok(f64::NAN),
        Cell::Text => Err(ReadError::NotANumber { line, column: field + 1, text: excerpt(&text) }),
    }
}
