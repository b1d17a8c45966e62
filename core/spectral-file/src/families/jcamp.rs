//! JCAMP-DX: labeled records, blocks of blocks, points or compressed ordinates.

mod checks;
mod counts;
mod ordinates;

use counts::Source;
pub(super) use ordinates::last_digit;
use ordinates::{Axis, Data, Row, Written};

use super::super::header::Header;
use super::super::quantity;
use super::super::reading::{MAX_PARTS, clean};
use super::super::sniff::Layout;
use super::super::text::{Lines, excerpt};
use super::super::watch::Log;
use super::super::words::{self, XUnit};
use super::super::{
    Decided, DecimalMark, Decision, Delimiter, MAX_CURVES, MAX_SAMPLES, Orientation, Part, ReadError, ReadOptions,
    Reader, Values, Warning,
};
use super::spectra::{self, Sample, Spectrum};
use super::{Found, asdf};

/// Reads the processed spectrum, or all spectra if none is a raw one beside it.
pub(super) fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let mut blocks = blocks(text, log)?;
    blocks.retain(|block| !block.samples.is_empty());
    let parts: Vec<Part> = blocks.iter().take(MAX_PARTS).map(Block::part).collect();
    let mut notes = Vec::new();
    let ratio = counts::settle(&mut blocks, options, log);
    let part = choose(&mut blocks, options, &mut notes)?;
    let part = leave_other_units(&mut blocks, part, &parts, log);
    let first_line = blocks.first().map(|block| block.data_line + 1).ok_or(ReadError::NoNumbers)?;
    for block in &blocks {
        block.warn(log);
    }
    let comma = blocks.iter().any(|block| block.comma);
    let form =
        (blocks[0].written, format!("Line {} gives the form {}", blocks[0].data_line, excerpt(&blocks[0].form_label)));
    let header = blocks[0].header();
    let units: Vec<Option<String>> = blocks.iter().map(|block| quantity::unit(&block.y_units.1)).collect();
    let spectra = blocks.into_iter().map(Block::spectrum).collect();
    let mut grid = spectra::grid(spectra, header, log)?;
    grid.curves.iter_mut().zip(units).for_each(|(curve, unit)| curve.unit = unit);
    (grid.parts, grid.part) = (parts, Some(part));
    if let Some(ratio) = ratio {
        (grid.role, grid.quantity) = (Some(ratio.role), Some(ratio.quantity));
        notes.retain(|note: &Decision| note.what != ratio.note.what);
        notes.push(ratio.note);
    }
    let dialect =
        if comma { (Delimiter::CommaSpace, DecimalMark::Comma) } else { (Delimiter::Comma, DecimalMark::Point) };
    let layout = Layout::fixed(dialect, Orientation::Down, first_line, &form.1);
    notes.insert(0, Decision::new("Form", &Decided::certain(form.0.told(), form.1)));
    let reader = Decided::certain(Reader::Jcamp, "The file begins with ## labels");
    Ok(Found { grid, layout, reader, notes })
}

/// Leaves the block that was chosen, else those that are not raw; 0 stands for several.
fn choose(
    blocks: &mut Vec<Block>,
    options: &ReadOptions,
    notes: &mut Vec<Decision>,
) -> Result<Decided<usize>, ReadError> {
    let count = blocks.len();
    if let Some(part) = options.part {
        if !(1..=count.min(MAX_PARTS)).contains(&part) && count > 0 {
            return Err(ReadError::NoSuchPart { part, parts: count.min(MAX_PARTS) });
        }
        *blocks = blocks.drain(..).skip(part.saturating_sub(1)).take(1).collect();
        return Ok(Decided::chosen(part));
    }
    let raw = blocks.iter().filter(|block| block.is_raw()).count();
    let all = usize::from(count == 1);
    if raw == 0 || raw == count || options.raw == Some(true) {
        return Ok(Decided::certain(all, format!("{count} blocks hold spectra")));
    }
    let first = blocks.iter().position(|block| !block.is_raw()).map_or(0, |index| index + 1);
    let why = format!("{count} blocks, of which {raw} are dark or reference spectra");
    blocks.retain(|block| !block.is_raw());
    let taken = format!("“{}” alone", blocks[0].title);
    notes.push(Decision::new(
        "Blocks",
        &Decided::or_chosen(options.raw, || Decided::certain(false, why.clone())).told(&taken),
    ));
    Ok(Decided::certain(if count - raw == 1 { first } else { 0 }, why))
}

/// Leaves the blocks that are in the units of the first: those of others are parts that must be chosen.
fn leave_other_units(
    blocks: &mut Vec<Block>,
    part: Decided<usize>,
    parts: &[Part],
    log: &mut Log<'_>,
) -> Decided<usize> {
    let Some(units) = blocks.first().map(Block::units) else { return part };
    let Some(other) = blocks.iter().find(|block| block.units() != units) else { return part };
    log.push(Warning::MoreTables { line: other.data_line + 1 });
    blocks.retain(|block| block.units() == units);
    let why = format!("{}, not all in the same units", part.why);
    let alone = parts.iter().position(|listed| listed.line == blocks[0].data_line + 1).map_or(0, |at| at + 1);
    Decided { value: if blocks.len() == 1 { alone } else { 0 }, why, ..part }
}

/// How the data of a block is written.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
enum Form {
    /// `x, y` pairs.
    #[default]
    Pairs,
    /// `x y y y`, the steps of x being equal.
    Ordinates,
}

impl Form {
    fn told(self) -> &'static str {
        match self {
            Self::Pairs => "pairs of wavelength and value",
            Self::Ordinates => "a wavelength and the values that follow it in equal steps, in each line",
        }
    }
}

/// A block with, or without, data.
#[derive(Debug, Default)]
struct Block {
    title: String,
    /// Each with its line.
    records: Vec<(usize, String, String)>,
    x_units: (usize, String),
    y_units: (usize, String),
    points: (usize, Option<usize>),
    /// Numbers that the header announces, by label, with their lines.
    announced: Vec<(&'static str, usize, Written)>,
    /// What the values are, if that is not for the units to say.
    values: Option<(usize, Values)>,
    /// How the data that the reader is in is written.
    form: Option<Form>,
    /// How the data of the block is written, and what its label says of that.
    written: Form,
    form_label: String,
    data_line: usize,
    rows: Vec<Row>,
    ordinates: Vec<f64>,
    /// Whether the last line ended with a difference.
    difference: bool,
    samples: Vec<Sample>,
    /// How many values there were.
    found: usize,
    warnings: Vec<Warning>,
    comma: bool,
}

/// Labels of numbers.
const NUMBERS: [&str; 8] = ["FIRSTX", "LASTX", "DELTAX", "XFACTOR", "YFACTOR", "FIRSTY", "MINY", "MAXY"];

/// All blocks that have a title of their own, in the order of the file.
fn blocks(text: &str, log: &mut Log<'_>) -> Result<Vec<Block>, ReadError> {
    let mut all: Vec<Block> = Vec::new();
    let mut total = 0;
    // Repetitions make more of a file than it is long, but no sound file makes this much of little.
    let most = MAX_SAMPLES.min(1_000_000 + 10 * text.len());
    for (number, line) in Lines::new(text) {
        log.at(line.as_ptr() as usize - text.as_ptr() as usize)?;
        let line = line.split_once("$$").map_or(line, |(before, _)| before);
        if let Some((key, value)) = line.trim_start().strip_prefix("##").and_then(|record| record.split_once('=')) {
            let key = label(key);
            if key == "TITLE" || all.is_empty() {
                close(&mut all)?;
                if all.len() >= MAX_CURVES {
                    return Err(ReadError::TooManyCurves { line: number });
                }
                all.push(Block::default());
            }
            if let Some(block) = all.last_mut() {
                block.record(number, &key, value.trim());
            }
            continue;
        }
        if let Some(block) = all.last_mut().filter(|block| block.form.is_some()) {
            let before = block.samples.len() + block.ordinates.len();
            block.data(number, line, log)?;
            total += block.samples.len() + block.ordinates.len() - before;
            if total > most {
                return Err(ReadError::TooManySamples { line: number });
            }
        }
    }
    close(&mut all)?;
    Ok(all)
}

fn close(all: &mut [Block]) -> Result<(), ReadError> {
    all.last_mut().map_or(Ok(()), Block::close)
}

/// A label as labels are compared: capitals and digits only.
fn label(written: &str) -> String {
    written.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_uppercase()).take(64).collect()
}

impl Block {
    fn record(&mut self, line: usize, key: &str, value: &str) {
        const MAX_RECORDS: usize = 1000;
        self.form = None;
        match key {
            "TITLE" => value.clone_into(&mut self.title),
            "XUNITS" => self.x_units = (line, value.to_owned()),
            "YUNITS" => self.y_units = (line, value.to_owned()),
            "NPOINTS" => self.points = (line, value.parse().ok()),
            "XYDATA" | "XYPOINTS" | "PEAKTABLE" if self.samples.is_empty() && self.rows.is_empty() => {
                let ordinates = value.contains("++") || label(value).starts_with("XYY");
                self.written = if ordinates { Form::Ordinates } else { Form::Pairs };
                self.form = Some(self.written);
                value.clone_into(&mut self.form_label);
                self.data_line = line;
            }
            _ => {
                let known = NUMBERS.iter().find(|label| **label == key);
                if let Some((label, number)) = known.and_then(|label| Some((*label, Written::parse(value)?))) {
                    self.announced.retain(|(other, ..)| *other != label);
                    self.announced.push((label, line, number));
                }
            }
        }
        if self.records.len() < MAX_RECORDS {
            self.records.push((line, key.to_owned(), value.to_owned()));
        }
    }

    fn data(&mut self, line: usize, text: &str, log: &mut Log<'_>) -> Result<(), ReadError> {
        let broken = |text: &str| ReadError::NotANumber { line, column: 1, text: excerpt(text) };
        if self.form == Some(Form::Ordinates) {
            let Some(found) = asdf::decode(text).map_err(broken)? else { return Ok(()) };
            let head = Written { value: found.head.0, digit: found.head.1 };
            let places =
                log.places.as_mut().map(|places| ordinates::record(text, found.values.len(), self.difference, places));
            let (place, block) = places.unwrap_or_default();
            self.rows.push(Row { line, head, from: self.ordinates.len(), repeats: self.difference, place, block });
            self.difference = found.ends_in_difference;
            self.ordinates.extend(found.values);
            return Ok(());
        }
        for pair in text.split(';').filter(|pair| !pair.trim().is_empty()) {
            let (numbers, comma) = numbers(pair).ok_or_else(|| broken(pair.trim()))?;
            self.comma |= comma;
            if numbers.len() % 2 != 0 {
                return Err(broken(pair.trim()));
            }
            for xy in numbers.chunks_exact(2).filter(|xy| xy.iter().all(|(number, _)| !number.is_nan())) {
                let [(wavelength, x), (value, y)] = [xy[0], xy[1]];
                let place = log.places.as_mut().map(|places| places.pair(x, y)).unwrap_or_default();
                self.samples.push(Sample { wavelength, value, line, place });
            }
        }
        Ok(())
    }

    /// A number that the header announces, with its line.
    fn number(&self, label: &str) -> Option<(usize, Written)> {
        self.announced.iter().find(|(other, ..)| *other == label).map(|&(_, line, number)| (line, number))
    }

    fn factor(&self, label: &str) -> f64 {
        self.number(label).map(|(_, factor)| factor.value).filter(|factor| *factor != 0.0).unwrap_or(1.0)
    }

    /// Gives the samples their wavelengths and factors.
    fn close(&mut self) -> Result<(), ReadError> {
        let (x_factor, y_factor) = (self.factor("XFACTOR"), self.factor("YFACTOR"));
        for sample in &mut self.samples {
            sample.wavelength = clean(sample.wavelength * x_factor);
        }
        if !self.rows.is_empty() {
            let value = |label| self.number(label).map(|(_, number)| number);
            let first = value("FIRSTX").ok_or(ReadError::NoWavelengths { line: self.data_line })?;
            let (last, delta, points) = (value("LASTX"), self.number("DELTAX"), self.points.1);
            let axis = Axis { first, last, delta, points, factor: x_factor };
            let data = Data { rows: &self.rows, ordinates: &self.ordinates };
            let placed = data.place(&axis)?;
            (self.samples, self.warnings) = (placed.samples, placed.warnings);
            (self.rows, self.ordinates) = (Vec::new(), Vec::new());
        }
        for sample in &mut self.samples {
            sample.value *= y_factor;
        }
        self.check()
    }

    /// Whether this is a dark or a reference spectrum.
    fn is_raw(&self) -> bool {
        Source::of(&self.title) != Source::Other
    }

    /// The units of both axes, such that blocks in the same units have the same.
    fn units(&self) -> (Result<XUnit, String>, String) {
        let plain = |units: &str| units.trim().to_lowercase();
        let x = &self.x_units.1;
        (words::x_unit(x).ok_or_else(|| plain(x)), plain(&self.y_units.1))
    }

    fn warn(&self, log: &mut Log<'_>) {
        log.extend(self.warnings.iter().cloned());
        let found = self.found;
        if let (line, Some(expected)) = self.points
            && expected != found
        {
            log.push(Warning::CountDiffers { line, expected, found });
        }
    }

    fn part(&self) -> Part {
        Part { line: self.data_line + 1, name: self.title.clone(), curves: 1, rows: self.samples.len() }
    }

    fn header(&self) -> Header {
        let (line, units) = &self.y_units;
        let mut header = Header {
            x_unit: words::x_unit(&self.x_units.1).map(|unit| (self.x_units.0, unit)),
            role: words::role(units).map(|role| (*line, role)),
            values: self
                .values
                .or_else(|| Some((*line, words::values(units).filter(|values| *values != Values::Plain)?))),
            quantity: words::quantity(units).map(|quantity| (*line, quantity)),
            medium: words::medium(&self.x_units.1).map(|medium| (self.x_units.0, medium)),
            ..Header::default()
        };
        for (line, key, value) in &self.records {
            header.note(*line, &key.to_ascii_lowercase(), value);
        }
        header
    }

    fn spectrum(self) -> Spectrum {
        let name = Some(self.title).filter(|title| !title.is_empty());
        Spectrum { name, label: String::new(), samples: self.samples }
    }
}

/// The numbers of a piece of a line, NaN for a gap, with their texts, and whether commas mark their fractions.
fn numbers(text: &str) -> Option<(Vec<(f64, &str)>, bool)> {
    let text = text.trim();
    let parse = |cell: &str| match cell {
        "?" => Some(f64::NAN),
        _ => cell.parse::<f64>().ok().filter(|number| number.is_finite()),
    };
    // Where a comma has a space after it in one place and none in another, the latter marks a fraction.
    let spaced = text.contains(", ") && !text.contains('.');
    if spaced && text.replace(", ", " ").contains(',') {
        let cells = text.split(", ").map(str::trim).map(|cell| Some((parse(&cell.replace(',', "."))?, cell)));
        return Some((cells.collect::<Option<_>>()?, true));
    }
    let cells = text.split([',', ' ', '\t']).filter(|cell| !cell.is_empty()).map(|cell| Some((parse(cell)?, cell)));
    Some((cells.collect::<Option<_>>()?, false))
}
