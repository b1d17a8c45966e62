//! Blocks of JCAMP-DX: records and data, their values beside what the header announces, and those of what a detector counted with a
//! sample, with a reference, and in the dark.

use crate::decimal::{clean, extent, median};
use crate::decision::{Decided, Decision, Part, Quantity, Role, Values};
use crate::error::ReadError;
use crate::formats::jcamp::ordinates::{self, Axis, Data, Row, Written};
use crate::formats::spectra::{Sample, Spectrum};
use crate::header::Header;
use crate::header_terms::{self, XUnit};
use crate::options::ReadOptions;
use crate::text::{excerpt, has_part};
use crate::warning::Warning;
use crate::watch::{Log, PlaceId};

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) enum Form {
    /// `x, y` pairs.
    #[default]
    Pairs,
    /// `x y y y`, the steps of x being equal.
    Ordinates,
}

impl Form {
    pub(super) fn description(self) -> &'static str {
        match self {
            Self::Pairs => "pairs of wavelength and value",
            Self::Ordinates => "a wavelength and the values that follow it in equal steps, in each line",
        }
    }
}

#[derive(Debug, Default)]
pub(super) struct Block {
    pub(super) title: String,
    pub(super) records: Vec<(usize, String, String)>,
    pub(super) x_units: (usize, String),
    pub(super) y_units: (usize, String),
    /// The line that says that this is no spectrum of light, and how it calls it. The data are passed over.
    pub(super) foreign: Option<(usize, String)>,
    pub(super) points: (usize, Option<usize>),
    /// Numbers that the header announces, by label, with their lines.
    pub(super) announced: Vec<(&'static str, usize, Written)>,
    /// Scale of the values, where the units do not decide it.
    pub(super) values: Option<(usize, Values)>,
    pub(super) form: Option<Form>,
    /// Form of the block's data, and the label that gives it.
    pub(super) written: Form,
    pub(super) form_label: String,
    pub(super) data_line: usize,
    pub(super) rows: Vec<Row>,
    pub(super) ordinates: Vec<f64>,
    /// True if the last line ended with a difference.
    pub(super) difference: bool,
    pub(super) samples: Vec<Sample>,
    pub(super) found: usize,
    pub(super) warnings: Vec<Warning>,
    pub(super) comma: bool,
}

const NUMBERS: [&str; 8] = ["FIRSTX", "LASTX", "DELTAX", "XFACTOR", "YFACTOR", "FIRSTY", "MINY", "MAXY"];

/// A label as labels are compared: capitals and digits only.
pub(super) fn label(written: &str) -> String {
    written.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_uppercase()).take(64).collect()
}

/// Returns whether a data type, as a label, is of no light. Raman shifts are differences of wave numbers.
fn is_foreign(kind: &str) -> bool {
    const KINDS: &str = "NMR|MASS|MOBILITY|RAMAN|XRAY|XPS|EPR|NEUTRON|TGA|ISOTHERM|VOLTAMM|TITRATION|CHROMATOGRAM";
    has_part(kind, KINDS)
}

/// Returns whether units are stated, but none of wavelengths or what can be converted to them.
fn is_foreign_unit(units: &str) -> bool {
    let light = matches!(header_terms::x_unit(units), Some(XUnit::Wavelength(_)));
    !units.is_empty() && !light && !header_terms::names_wavelengths(units)
}

impl Block {
    pub(super) fn record(&mut self, line: usize, key: &str, value: &str) {
        const MAX_RECORDS: usize = 1000;
        self.form = None;
        let foreign = key == "DATATYPE" && is_foreign(&label(value)) || key == "XUNITS" && is_foreign_unit(value);
        self.foreign = self.foreign.take().or_else(|| foreign.then(|| (line, value.to_owned())));
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

    pub(super) fn data(&mut self, line: usize, text: &str, log: &mut Log<'_>) -> Result<(), ReadError> {
        let broken = |text: &str| ReadError::NotANumber { line, column: 1, text: excerpt(text) };
        if self.form == Some(Form::Ordinates) {
            let Some(found) = ordinates::decode(text).map_err(broken)? else { return Ok(()) };
            let places =
                log.places.as_mut().map(|places| ordinates::record(text, found.values.len(), self.difference, places));
            let (place, block) = places.unwrap_or_default();
            self.rows.push(Row {
                line,
                head: found.head,
                from: self.ordinates.len(),
                repeats: self.difference,
                place,
                block,
            });
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

    pub(super) fn number(&self, label: &str) -> Option<(usize, Written)> {
        self.announced.iter().find(|(other, ..)| *other == label).map(|&(_, line, number)| (line, number))
    }

    pub(super) fn factor(&self, label: &str) -> f64 {
        self.number(label).map(|(_, factor)| factor.value).filter(|factor| *factor != 0.0).unwrap_or(1.0)
    }

    /// Gives the samples their wavelengths and factors.
    pub(super) fn close(&mut self) -> Result<(), ReadError> {
        let (x_factor, y_factor) = (self.factor("XFACTOR"), self.factor("YFACTOR"));
        for sample in &mut self.samples {
            sample.wavelength = clean(sample.wavelength * x_factor);
        }
        if !self.rows.is_empty() {
            let value = |label| self.number(label).map(|(_, number)| number);
            let first = value("FIRSTX").ok_or(ReadError::NoWavelengths(self.data_line))?;
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

    pub(super) fn is_raw(&self) -> bool {
        Source::of(&self.title) != Source::Other
    }

    /// The units of both axes, such that blocks in the same units have the same.
    pub(super) fn units(&self) -> (Result<XUnit, String>, String) {
        let plain = |units: &str| units.trim().to_lowercase();
        let x = &self.x_units.1;
        (header_terms::x_unit(x).ok_or_else(|| plain(x)), plain(&self.y_units.1))
    }

    pub(super) fn warn(&self, log: &mut Log<'_>) {
        log.extend(self.warnings.iter().cloned());
        let found = self.found;
        if let (line, Some(expected)) = self.points
            && expected != found
        {
            log.push(Warning::CountDiffers { line, expected, found });
        }
    }

    pub(super) fn part(&self) -> Part {
        Part { line: self.data_line + 1, name: self.title.clone(), curves: 1, rows: self.samples.len() }
    }

    pub(super) fn header(&self) -> Header {
        let (line, units) = &self.y_units;
        let mut header = Header {
            x_unit: header_terms::x_unit(&self.x_units.1).map(|unit| (self.x_units.0, unit)),
            role: header_terms::role(units).map(|role| (*line, role)),
            values: self
                .values
                .or_else(|| Some((*line, header_terms::values(units).filter(|values| *values != Values::Plain)?))),
            quantity: header_terms::quantity(units).map(|quantity| (*line, quantity)),
            medium: header_terms::medium(&self.x_units.1).map(|medium| (self.x_units.0, medium)),
            ..Header::default()
        };
        for (line, key, value) in &self.records {
            header.note(*line, &key.to_ascii_lowercase(), value);
        }
        header
    }

    pub(super) fn spectrum(self) -> Spectrum {
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

impl Block {
    /// Compares the announced ends, the first, the smallest and the largest value with the data.
    fn check(&mut self) -> Result<(), ReadError> {
        self.found = self.samples.len();
        let (Some(first), Some(last)) = (self.samples.first(), self.samples.last()) else { return Ok(()) };
        let (first_x, last_x, first_y) = (first.wavelength, last.wavelength, first.value);
        let whole = self.points.1.is_none_or(|points| points == self.found);
        let (min, max) = extent(self.samples.iter().map(|sample| sample.value));
        let mut differing = Vec::new();
        // Missing lines at an end are detected by the number of values.
        let ends = [("FIRSTX", first_x), ("LASTX", last_x)];
        let reversed = self.written == Form::Pairs && self.is_near("FIRSTX", last_x) && self.is_near("LASTX", first_x);
        for (label, found) in ends.into_iter().filter(|_| whole && !reversed) {
            differing.extend(self.differs(label, found).filter(|_| !self.is_near(label, found)));
        }
        let factor = self.factor("YFACTOR");
        let mut scales = Vec::new();
        let first_y = if reversed { self.samples.last().map_or(first_y, |last| last.value) } else { first_y };
        for (label, found) in [("FIRSTY", first_y), ("MINY", min), ("MAXY", max)] {
            let Some((line, announced)) = self.number(label) else { continue };
            // Ordinates that are whole numbers were rounded to such.
            let whole = self.written == Form::Ordinates && (found / factor).fract().abs() < 1e-9;
            let slack = announced.digit + if whole { factor.abs() / 2.0 } else { 0.0 } + 1e-6 * found.abs();
            let near = (announced.value - found).abs() <= slack;
            let raw = (announced.value - found / factor).abs() <= announced.digit + 1e-6 * (found / factor).abs();
            if !near {
                differing.extend(self.differs(label, found));
            }
            let power = (announced.value / found).log10();
            let is_power = power.is_finite() && (power - power.round()).abs() < 1e-3 && power.round() != 0.0;
            scales.push((
                near || raw || !is_power,
                ReadError::ScaleContradicts { line, label, announced: announced.value, found },
            ));
        }
        // Where all that is announced is another power of ten, the factor is wrong.
        if scales.iter().all(|(fits, _)| !fits)
            && let Some((_, error)) = scales.into_iter().next()
        {
            return Err(error);
        }
        self.warnings.append(&mut differing);
        Ok(())
    }

    fn is_near(&self, label: &str, found: f64) -> bool {
        let Some((_, announced)) = self.number(label) else { return true };
        let step = self.samples.windows(2).map(|pair| (pair[1].wavelength - pair[0].wavelength).abs());
        let step = step.fold(f64::INFINITY, f64::min);
        (announced.value - found).abs() <= announced.digit.min(step) + 1e-6 * found.abs()
    }

    fn differs(&self, label: &'static str, found: f64) -> Option<Warning> {
        let (line, announced) = self.number(label)?;
        Some(Warning::HeaderDiffers { line, label, announced: announced.value, found })
    }
}

/// A median that no percentage has.
const MOST_PERCENT: f64 = 200.0;

/// A reference this much above the sample is not in the same unit.
const MOST_TIMES: f64 = 4.0;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Source {
    Dark,
    Reference,
    /// Counts, but neither of these.
    Raw,
    Other,
}

impl Source {
    pub(super) fn of(title: &str) -> Self {
        let title = title.to_ascii_lowercase();
        let last = title.rsplit(':').next().unwrap_or_default();
        match () {
            () if last.contains("dark") => Self::Dark,
            () if last.contains("reference") => Self::Reference,
            () if last.contains("raw") => Self::Raw,
            () => Self::Other,
        }
    }
}

pub(super) struct Ratio {
    pub(super) role: Decided<Role>,
    pub(super) quantity: Decided<Quantity>,
    pub(super) note: Decision,
}

/// Finds out whether the only block beside raw ones holds counts too, whatever unit it announces, and forms
/// (sample − dark) / (reference − dark) where nothing else was chosen. What is missing leaves counts.
pub(super) fn settle(blocks: &mut [Block], options: &ReadOptions, log: &mut Log<'_>) -> Option<Ratio> {
    let one = |wanted: Source| {
        let mut found = blocks.iter().enumerate().filter(|(_, block)| Source::of(&block.title) == wanted);
        found.next().map(|(at, _)| at).filter(|_| found.next().is_none())
    };
    let (sample, dark, reference) = (one(Source::Other)?, one(Source::Dark), one(Source::Reference));
    let announced = blocks[sample].y_units.1.clone();
    let fraction = header_terms::role(&announced).filter(|role| role.is_fraction());
    if fraction.is_none() && !header_terms::says_counts(&announced) || !is_counts(blocks, sample, dark, reference) {
        return None;
    }
    for block in blocks.iter_mut() {
        "counts".clone_into(&mut block.y_units.1);
    }
    let (dark, reference) = (dark?, reference?);
    let alike = |other: usize| {
        let pairs = blocks[sample].samples.iter().zip(&blocks[other].samples);
        blocks[other].samples.len() == blocks[sample].samples.len()
            && pairs.into_iter().all(|(a, b)| a.wavelength == b.wavelength)
    };
    if options.part.is_some() || options.raw == Some(true) || !alike(dark) || !alike(reference) {
        return None;
    }
    let values: Vec<f64> = (0..blocks[sample].samples.len())
        .map(|at| {
            let [sample, dark, reference] = [sample, dark, reference].map(|block| blocks[block].samples[at].value);
            (sample - dark) / (reference - dark)
        })
        .collect();
    let block = &mut blocks[sample];
    for (sample, value) in block.samples.iter_mut().zip(values) {
        (sample.value, sample.place) = (value, PlaceId::default());
    }
    // Where reference and dark are equal, such as at a saturated pixel, there is no ratio.
    let undefined = || block.samples.iter().filter(|sample| !sample.value.is_finite()).map(|sample| sample.line);
    if let cells @ 1.. = undefined().count() {
        log.push(Warning::Gaps { cells, lines: undefined().collect(), sentinel: None });
    }
    block.samples.retain(|sample| sample.value.is_finite());
    block.y_units.1.clear();
    block.values = Some((block.y_units.0, Values::Plain));
    let why = format!("The blocks are counts of sample, reference and dark, whatever line {} says", block.y_units.0);
    let role = fraction.unwrap_or(Role::Transmittance);
    let quantity = if role == Role::Reflectance { Quantity::Reflectance } else { Quantity::Transmittance };
    let told = Decided::guess("(sample − dark) / (reference − dark)", why.clone());
    Some(Ratio {
        role: Decided::guess(role, &*why),
        quantity: Decided::guess(quantity, &*why),
        note: Decision::new("Blocks", &told),
    })
}

/// Returns whether the values of a block are counts: too large for percentages, or of the size of the raw ones.
fn is_counts(blocks: &[Block], sample: usize, dark: Option<usize>, reference: Option<usize>) -> bool {
    let median = |block: usize| median(blocks[block].samples.iter().map(|sample| sample.value));
    let own = median(sample);
    let like_raw = || reference.is_some_and(|reference| median(reference) <= MOST_TIMES * own);
    let any = dark.is_some() || reference.is_some();
    any && (own > MOST_PERCENT || like_raw() && dark.is_none_or(|dark| own >= median(dark)))
}
