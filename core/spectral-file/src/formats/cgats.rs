//! CGATS and its relatives (Argyll `.sp`, `.cmf`, `.ti3`, `.ccss`, X-Rite, `BabelColor`): keywords, named fields, sets.

mod tokens;

use crate::decimal::clean;
use crate::decision::{
    Decided, DecimalMark, Decision, Delimiter, Family, Orientation, Part, Reader, Role, Values, WavelengthUnit,
};
use crate::dialect::Dialect;
use crate::dialect_trial::Layout;
use crate::error::{MAX_PARTS, ReadError, check_curves, check_samples};
use crate::formats::Format;
use crate::formats::cgats::tokens::Token;
use crate::formats::spectra::Found;
use crate::grid::{Grid, RawCurve};
use crate::header::Header;
use crate::options::ReadOptions;
use crate::text::{Lines, comment, excerpt};
use crate::warning::Warning;
use crate::watch::{Log, PlaceId, PlaceKind};
use crate::{decimal, header_terms};

impl Reader {
    /// CGATS and its relatives, as Argyll and X-Rite write them.
    pub const CGATS: Self = Self::new("cgats", "CGATS", "CGATS");
}

pub(super) const FORMAT: Format = Format {
    reader: Reader::CGATS,
    fits: |head| head.is(Family::Cgats) || head.is_chosen_for("BEGIN_DATA_FORMAT"),
    read,
};

fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let mut file = File { wanted: options.part.unwrap_or(1), ..File::default() };
    let mut place = Place::Keywords;
    for (number, line) in Lines::new(text) {
        if let Some((key, value)) = comment(line).and_then(|comment| comment.split_once(':'))
            && !file.done
        {
            file.header.take_comment(number, key.trim(), value.trim());
        }
        let tokens = match place {
            Place::Format => tokens::fields(line),
            Place::Data if file.at == 0 => tokens::set(line, file.fields.len()),
            Place::Keywords | Place::Data => tokens::of(line).collect(),
        };
        for token in tokens {
            log.at(token.written.as_ptr() as usize - text.as_ptr() as usize)?;
            place = match (place, token.bare().unwrap_or_default()) {
                (_, "BEGIN_DATA_FORMAT") => {
                    file.begin_format(number);
                    Place::Format
                }
                (_, "BEGIN_DATA") => {
                    file.begin_data(number);
                    Place::Data
                }
                (Place::Format, "END_DATA_FORMAT") => Place::Keywords,
                (Place::Data, "END_DATA") => {
                    file.end_data();
                    Place::Keywords
                }
                (Place::Keywords, _) => {
                    file.keyword(number, &token, tokens::value(line, &token));
                    break;
                }
                (Place::Format, _) => file.field(number, &token, log)?,
                (Place::Data, _) => file.value(number, &token, log)?,
            };
        }
    }
    file.finish(options, log)
}

#[derive(Clone, Copy)]
enum Place {
    Keywords,
    Format,
    Data,
}

#[derive(Default)]
struct File {
    header: Header,
    declared: Declared,
    scale: Option<(usize, f64)>,
    /// Keywords that the data are held against, with their lines and numbers.
    announced: Vec<(&'static str, usize, f64)>,
    fields: Vec<String>,
    format_line: usize,
    bands: Option<Bands>,
    data_line: usize,
    /// The sets of the first table with spectral fields, value by value.
    names: Vec<String>,
    values: Vec<f64>,
    /// The places of the fields and of the values, if they are recorded.
    field_places: Vec<PlaceId>,
    places: Vec<PlaceId>,
    /// The field that the next value belongs to.
    at: usize,
    name_fields: Vec<usize>,
    row_name: String,
    row_wavelengths: Vec<f64>,
    last_line: usize,
    /// Fields in a set of the selected table.
    width: usize,
    /// Number of the table with spectral fields that is read, from 1.
    wanted: usize,
    /// True if the selected table has begun, and whether it is the one being read.
    done: bool,
    open: bool,
    parts: Vec<Part>,
    title: String,
    /// The values of a table that is not selected, which are only counted.
    counted: Option<usize>,
}

impl File {
    fn keyword(&mut self, line: usize, key: &Token, value: Option<Token>) {
        if key.bare() == Some("DESCRIPTOR") {
            self.title = value.as_ref().map_or_else(String::new, |value| value.text().into_owned());
        }
        let (key, value) = (key.text(), value.map_or_else(String::new, |value| value.text().into_owned()));
        if self.done || key == "KEYWORD" {
            return;
        }
        let number = value.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let held = ["NUMBER_OF_SETS", "SPECTRAL_START_NM", "SPECTRAL_END_NM"].into_iter().find(|held| key == *held);
        if let Some((held, number)) = held.zip(number) {
            self.announced.retain(|(other, ..)| *other != held);
            self.announced.push((held, line, number));
        }
        match &*key {
            "SPECTRAL_BANDS" => self.declared.bands = number,
            "SPECTRAL_START_NM" => self.declared.start = number,
            "SPECTRAL_END_NM" => self.declared.end = number,
            "SPECTRAL_NORM" | "SPEC_SCALE" => self.scale = number.filter(|n| *n > 0.0).map(|n| (line, n)),
            "IT8.7/1" => self.header.role = Some((line, Role::Transmittance)),
            "DEVICE_CLASS" => {
                let role = if value == "DISPLAY" { Role::Illuminant } else { Role::Reflectance };
                self.header.mentioned = self.header.mentioned.or(Some((line, role)));
            }
            "CCSS" => self.header.role = Some((line, Role::Illuminant)),
            "MEAS_TYPE" | "SPECTRUM_TYPE" => {
                self.header.role = measured(&value).map(|role| (line, role)).or(self.header.role);
            }
            "DESCRIPTOR" | "FILE_DESCRIPTOR" => {
                self.header.mentioned = header_terms::role(&value).map(|role| (line, role)).or(self.header.mentioned);
                self.header.note(line, "title", &value);
            }
            _ => {}
        }
        self.header.note(line, &key, &value);
    }

    fn begin_format(&mut self, line: usize) {
        self.end_data();
        self.fields.clear();
        if !self.done {
            self.field_places.clear();
            self.format_line = line;
        }
    }

    fn field(&mut self, line: usize, token: &Token, log: &mut Log<'_>) -> Result<Place, ReadError> {
        self.fields.push(token.text().into_owned());
        if let Some(places) = log.places.as_mut().filter(|_| !self.done) {
            let digits = digits(token.written);
            let place = (!digits.is_empty()).then(|| places.add(PlaceKind::Wavelength, digits));
            self.field_places.push(place.unwrap_or_default());
        }
        check_curves(self.fields.len(), line)?;
        Ok(Place::Format)
    }

    fn begin_data(&mut self, line: usize) {
        self.end_data();
        let Some(bands) = Bands::of(&self.fields, self.declared).filter(|_| self.parts.len() < MAX_PARTS) else {
            if !self.done {
                self.announced.clear();
            }
            return;
        };
        let name = std::mem::take(&mut self.title);
        self.parts.push(Part { line: line + 1, name, curves: 0, rows: bands.count() });
        if self.parts.len() != self.wanted {
            self.counted = Some(0);
            return;
        }
        (self.done, self.open, self.width, self.data_line) = (true, true, self.fields.len(), line);
        self.bands = Some(bands);
        let named = |wanted: &&str| self.fields.iter().position(|field| field.eq_ignore_ascii_case(wanted));
        let one = ["SAMPLE_NAME", "SAMPLE_LOC", "SAMPLE_ID", "SampleID"].iter().find_map(named);
        // SpectraShop tells samples apart by up to three names.
        let parts = || ["SAMPLE_ID1", "SAMPLE_ID2", "SAMPLE_ID3"].iter().filter_map(named).collect();
        self.name_fields = one.map_or_else(parts, |field| vec![field]);
    }

    /// Ends a table, whether or not the file marks its end.
    fn end_data(&mut self) {
        self.open = false;
        if let (Some(values), Some(part)) = (self.counted.take(), self.parts.last_mut()) {
            part.curves = values / self.fields.len().max(1);
            // The keywords of one table do not apply to the next.
            if !self.done {
                (self.declared, self.scale, self.header) = Default::default();
                self.announced.clear();
            }
        }
    }

    fn value(&mut self, line: usize, token: &Token, log: &mut Log<'_>) -> Result<Place, ReadError> {
        if let Some(values) = &mut self.counted {
            *values += 1;
        }
        let Some(bands) = self.bands.as_ref().filter(|_| self.open && self.width > self.at) else {
            return Ok(Place::Data);
        };
        self.last_line = line;
        if self.name_fields.contains(&self.at) {
            let text = token.text();
            let apart = if self.row_name.is_empty() || text.is_empty() { "" } else { " " };
            self.row_name.extend([apart, &*text]);
        }
        if bands.is_value(self.at) {
            self.values.push(number(token, line, self.at)?);
            self.places.extend(log.places.as_mut().map(|places| places.add(PlaceKind::Value, token.written)));
        } else if bands.kinds.get(self.at) == Some(&Kind::Wavelength) {
            self.row_wavelengths.push(number(token, line, self.at)?);
            if let Some(places) = &mut log.places {
                places.add(PlaceKind::Wavelength, token.written);
            }
        }
        self.at += 1;
        if self.at == self.width {
            self.end_row(line)?;
        }
        Ok(Place::Data)
    }

    fn end_row(&mut self, line: usize) -> Result<(), ReadError> {
        self.at = 0;
        self.names.push(std::mem::take(&mut self.row_name));
        check_samples(self.values.len(), line)?;
        check_curves(self.names.len(), line)?;
        let row = std::mem::take(&mut self.row_wavelengths);
        let agrees = self.bands.as_mut().is_none_or(|bands| bands.agrees(row));
        if agrees { Ok(()) } else { Err(ReadError::SecondTable(line)) }
    }

    fn finish(mut self, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
        self.end_data();
        let parts = self.settle_parts(options, log)?;
        let bands = self.bands.ok_or(ReadError::NoWavelengths(self.format_line.max(1)))?;
        if self.at > 0 {
            let (found, expected) = (self.at, self.width);
            return Err(ReadError::UnevenRow { line: self.last_line, found, expected });
        }
        warn_announced(&self.announced, &bands.wavelengths, self.names.len(), log);
        if let Some(places) = &mut log.places {
            let fields = self.field_places.iter().enumerate().filter(|(field, _)| bands.is_value(*field));
            let named = fields.zip(&bands.wavelengths).filter(|_| !bands.in_rows);
            named.for_each(|((_, place), nm)| places.assign(*place, 0, *nm));
            let width = bands.wavelengths.len().max(1);
            for (index, place) in self.places.iter().enumerate() {
                let nm = bands.wavelengths.get(index % width).copied().unwrap_or(f64::NAN);
                places.assign(*place, index / width, nm);
            }
        }
        let mut header = self.header;
        header.line = Some(self.format_line);
        if bands.percent {
            header.values = Some((self.format_line, Values::Percent));
        }
        let mut notes = vec![bands.decision()];
        let mut scale = 1.0;
        if let Some((line, norm)) = self.scale {
            scale = norm;
            header.values = Some((line, Values::Plain));
            // Older versions of Argyll call every file “Spectral power/reflectance information”: other scales are of lights.
            if header.comment("SPECTRAL_NORM").is_some() && norm != 1.0 && norm != 100.0 {
                header.mentioned = Some((line, Role::Illuminant));
            }
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
            let values = values.iter().map(|value| decimal::divided(*value, scale)).collect();
            RawCurve { name, named, values, origin: i, unit: header.unit.clone(), ..RawCurve::default() }
        });
        let curves: Vec<RawCurve> = curves.collect();
        let cells = curves.iter().flat_map(|curve| &curve.values).filter(|value| value.is_nan()).count();
        if cells > 0 {
            log.push(Warning::Gaps { cells, lines: [self.data_line].into_iter().collect(), sentinel: None });
        }
        let lines = vec![self.format_line];
        let unit = Some(Decided::certain(WavelengthUnit::Nanometer, "CGATS prescribes it"));
        let part = Some(Decided::guess(self.wanted, format!("{} tables have spectral fields", parts.len())));
        let wavelengths = bands.wavelengths;
        let fraction = |value: &f64| value.is_nan() || (-0.2..=1.2).contains(value);
        let fractions = curves.iter().flat_map(|curve: &RawCurve| &curve.values).all(fraction);
        let samples = self.fields.iter().any(|field| matches!(field.as_str(), "SAMPLE_ID" | "SAMPLE_NAME"));
        let role = (samples && (fractions || header.values.is_some()))
            .then(|| Decided::guess(Role::Reflectance, "CGATS lists samples, mostly those of a chart"));
        let grid = Grid { wavelengths, lines, curves, header, unit, role, parts, part, rows, ..Grid::default() };
        let dialect = (Delimiter::Spaces, DecimalMark::Point);
        let layout = Layout::fixed(dialect, Orientation::Across, self.data_line + 1, "CGATS prescribes it");
        let why = format!("Line {} begins a data format", self.format_line);
        Ok(Found { grid, layout, reader: Decided::certain(Reader::CGATS, why), notes })
    }
}

impl File {
    fn settle_parts(&mut self, options: &ReadOptions, log: &mut Log<'_>) -> Result<Vec<Part>, ReadError> {
        let mut parts = std::mem::take(&mut self.parts);
        if let Some(part) = options.part.filter(|part| !parts.is_empty() && !(1..=parts.len()).contains(part)) {
            return Err(ReadError::NoSuchPart { part, parts: parts.len() });
        }
        if let Some(kept) = self.wanted.checked_sub(1).and_then(|index| parts.get_mut(index)) {
            kept.curves = self.names.len();
        }
        if let Some(second) = parts.get(1).filter(|_| options.part.is_none()) {
            log.push(Warning::MoreTables(second.line));
        }
        Ok(parts)
    }
}

fn measured(kind: &str) -> Option<Role> {
    match kind.to_ascii_uppercase().split(['_', '-']).next() {
        Some("EMISSION" | "AMBIENT" | "EMISSIVE") => Some(Role::Illuminant),
        Some("REFLECTIVE") => Some(Role::Reflectance),
        Some("TRANSMISSIVE") => Some(Role::Transmittance),
        Some("SENSITIVITY") => Some(Role::Camera),
        _ => None,
    }
}

/// Warns where keywords announce another number of sets, or other ends of the spectrum, than the data have.
fn warn_announced(announced: &[(&'static str, usize, f64)], wavelengths: &[f64], sets: usize, log: &mut Log<'_>) {
    const ROUNDING_NM: f64 = 1.0;
    for &(label, line, announced) in announced {
        let (found, slack) = match label {
            "NUMBER_OF_SETS" => (Some(sets as f64), 0.0),
            "SPECTRAL_START_NM" => (wavelengths.first().copied(), ROUNDING_NM),
            _ => (wavelengths.last().copied(), ROUNDING_NM),
        };
        if let Some(found) = found.filter(|found| (found - announced).abs() > slack) {
            log.push(Warning::HeaderDiffers { line, label, announced, found });
        }
    }
}

/// A value; NaN for a gap. A comma can only be a decimal mark here.
fn number(token: &Token, line: usize, field: usize) -> Result<f64, ReadError> {
    let text = token.text();
    let value = Dialect::of_number(&text).value(&text);
    value.ok_or_else(|| ReadError::NotANumber { line, column: field + 1, text: excerpt(&text) })
}

/// Bands that keywords declare, in nanometers.
#[derive(Debug, Clone, Copy, Default)]
struct Declared {
    bands: Option<f64>,
    start: Option<f64>,
    end: Option<f64>,
}

#[derive(Debug)]
struct Bands {
    wavelengths: Vec<f64>,
    /// True if the name of the fields states percent.
    percent: bool,
    kinds: Vec<Kind>,
    why: String,
    in_rows: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Other,
    Wavelength,
    Value,
}

/// Prefixes of the wavelength in the name of a spectral field, in capitals.
const PREFIXES: [&str; 6] = ["SPECTRAL_NM", "SPECTRAL_", "SPEC_", "NM", "R_", "S_"];

impl Bands {
    /// The spectral fields among the fields of a table, if there are any.
    fn of(fields: &[String], declared: Declared) -> Option<Self> {
        let named: Vec<Option<f64>> = fields.iter().map(|field| wavelength(field)).collect();
        let names: Vec<f64> = named.iter().flatten().copied().collect();
        if names.len() < 2 {
            return Self::pairs(fields);
        }
        let kinds = named.iter().map(|named| if named.is_some() { Kind::Value } else { Kind::Other }).collect();
        let (wavelengths, why) = match from_keywords(&names, declared) {
            Some(exact) => (exact, "Keywords give first, last and number of bands".to_owned()),
            None => (names, "The names of the fields give them".to_owned()),
        };
        Some(Self { wavelengths, percent: false, kinds, why, in_rows: false })
    }

    fn pairs(fields: &[String]) -> Option<Self> {
        let mut kinds = vec![Kind::Other; fields.len()];
        let mut percent = false;
        for at in 1..fields.len() {
            let value = fields[at].to_ascii_uppercase();
            if fields[at - 1].eq_ignore_ascii_case("SPECTRAL_NM")
                && matches!(value.as_str(), "SPECTRAL_PCT" | "SPECTRAL_DEC" | "SPECTRAL_VAL")
            {
                kinds[at - 1] = Kind::Wavelength;
                kinds[at] = Kind::Value;
                percent = value == "SPECTRAL_PCT";
            }
        }
        let why = "Each value has its wavelength beside it".to_owned();
        kinds.contains(&Kind::Value).then_some(Self { wavelengths: Vec::new(), percent, kinds, why, in_rows: true })
    }

    fn count(&self) -> usize {
        self.kinds.iter().filter(|kind| **kind == Kind::Value).count()
    }

    fn is_value(&self, field: usize) -> bool {
        self.kinds.get(field) == Some(&Kind::Value)
    }

    /// Processes the wavelengths in a row; all rows must have the same.
    fn agrees(&mut self, row: Vec<f64>) -> bool {
        if !self.in_rows {
            return true;
        }
        if self.wavelengths.is_empty() && row.iter().all(|wavelength| wavelength.is_finite()) {
            self.wavelengths = row;
            return true;
        }
        self.wavelengths == row
    }

    fn decision(&self) -> Decision {
        let value = match (self.wavelengths.first(), self.wavelengths.last()) {
            (Some(first), Some(last)) => format!("{} from {first} to {last} nm", self.wavelengths.len()),
            _ => "none".to_owned(),
        };
        Decision::certain("Bands", value, self.why.clone())
    }
}

fn digits(field: &str) -> &str {
    let number = |c: char| c.is_ascii_digit() || c == '.';
    &field[field.len() - field.chars().rev().take_while(|c| number(*c)).count()..]
}

fn wavelength(field: &str) -> Option<f64> {
    const PLAUSIBLE: std::ops::RangeInclusive<f64> = 100.0..=20_000.0;
    if field.len() > 32 || !field.is_ascii() {
        return None;
    }
    let upper = field.to_ascii_uppercase();
    let number = PREFIXES.iter().find_map(|prefix| upper.strip_prefix(prefix))?.trim_start_matches('_');
    if !number.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    number.parse().ok().filter(|number| PLAUSIBLE.contains(number))
}

/// The wavelengths that keywords give. The names of the fields are rounded where the step is no whole number, so they
/// only have to agree with them.
fn from_keywords(names: &[f64], declared: Declared) -> Option<Vec<f64>> {
    const ROUNDING: f64 = 1.0;
    let Declared { bands: Some(bands), start: Some(start), end: Some(end) } = declared else { return None };
    if bands != names.len() as f64 {
        return None;
    }
    let step = (end - start) / (bands - 1.0);
    let exact: Vec<f64> = (0..names.len()).map(|i| clean(start + step * i as f64)).collect();
    exact.iter().zip(names).all(|(exact, name)| (exact - name).abs() <= ROUNDING).then_some(exact)
}
