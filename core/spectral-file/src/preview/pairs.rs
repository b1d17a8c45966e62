//! Files in which each value stands beside its wavelength.

use super::super::{Reader, Table};
use super::Preview;
use super::cells::Conversion;
use super::stream::{self, Kind, Number, Numbers, Placed};

/// A number and the byte at which its line begins.
#[derive(Debug, Clone)]
pub(super) struct Spot {
    pub(super) line: usize,
    pub(super) number: Number,
}

/// Pairs that make up one curve after the other, in the order of the text. Only whole curves are kept, so that a block
/// that begins like a curve, or another spectrum over the same wavelengths, leaves nothing behind.
#[derive(Debug)]
pub(super) struct Run<'a> {
    table: &'a Table,
    pub(super) conversion: Conversion,
    pub(super) x_factor: f64,
    /// The curve that is expected.
    pub(super) curve: usize,
    used: Vec<bool>,
    found: Vec<usize>,
    buffer: Vec<Placed>,
    pub(super) done: Vec<Placed>,
}

impl<'a> Run<'a> {
    pub(super) fn new(table: &'a Table) -> Self {
        let mut run = Self {
            table,
            conversion: Conversion::of(table),
            x_factor: 1.0,
            curve: 0,
            used: Vec::new(),
            found: Vec::new(),
            buffer: Vec::new(),
            done: Vec::new(),
        };
        run.expect(0);
        run
    }

    fn expect(&mut self, curve: usize) {
        self.curve = curve;
        self.found.clear();
        self.used.clear();
        self.used.resize(self.table.curves.get(curve).map_or(0, |curve| curve.values.len()), false);
    }

    /// Begins the expected curve anew.
    pub(super) fn restart(&mut self) {
        for sample in self.found.drain(..) {
            self.used[sample] = false;
        }
        self.buffer.clear();
    }

    /// Goes on to the next curve.
    pub(super) fn skip(&mut self) {
        self.buffer.clear();
        self.expect(self.curve + 1);
    }

    /// Takes a pair; one that does not go on with the curve begins it anew.
    pub(super) fn take(&mut self, wavelength: &Spot, value: &Spot) {
        if !self.goes_on(wavelength, value) && !self.found.is_empty() {
            self.restart();
            self.goes_on(wavelength, value);
        }
    }

    fn goes_on(&mut self, wavelength: &Spot, value: &Spot) -> bool {
        let Some(curve) = self.table.curves.get(self.curve) else { return false };
        let nm = self.table.reading.wavelength_unit.value.nanometers(wavelength.number.value * self.x_factor);
        let same = |at: &usize| self.conversion.gives(value.number.value, curve.values[*at]);
        let Some(sample) = stream::sample(curve, nm).filter(same) else { return false };
        // A pair that repeats an earlier one is in the table once.
        if std::mem::replace(&mut self.used[sample], true) {
            return true;
        }
        self.found.push(sample);
        for (spot, kind) in [(wavelength, Kind::Wavelength), (value, Kind::Value)] {
            self.buffer.push(Placed::new(spot.line, &spot.number.range, kind, self.curve, sample));
        }
        if self.found.len() == self.used.len() {
            self.done.append(&mut self.buffer);
            self.expect(self.curve + 1);
        }
        true
    }
}

/// The pairs of a text, by what its format puts around them.
pub(super) fn place(preview: &Preview, table: &Table) -> Vec<Placed> {
    let mut run = Run::new(table);
    match table.reading.reader.value {
        Reader::Labels => labels(preview, &mut run),
        Reader::Alternate => alternate(preview, &mut run),
        Reader::Rawtoaces => return keys(preview, table),
        Reader::Cxf => attributes(preview, "WL", &mut run),
        _ => attributes(preview, "wavelength", &mut run),
    }
    run.done
}

/// `label 380[nm],0.1`
fn labels(preview: &Preview, run: &mut Run) {
    for (start, line) in lines(preview, run.table.reading.first_data_line) {
        let Some(at) = line.find([',', ';', '\t']) else { continue };
        let Some(wavelength) = Numbers::new(&line[..at], false).last() else { continue };
        let unit = line[wavelength.range.end..at].trim_start().trim_start_matches(['[', '(']).trim_start();
        if !unit.get(..2).is_some_and(|unit| unit.eq_ignore_ascii_case("nm")) {
            continue;
        }
        let Some(mut value) = Numbers::new(&line[at + 1..], true).next() else { continue };
        value.range = value.range.start + at + 1..value.range.end + at + 1;
        run.take(&Spot { line: start, number: wavelength }, &Spot { line: start, number: value });
    }
}

/// A wavelength in one line, its value in the next.
fn alternate(preview: &Preview, run: &mut Run) {
    let mut wavelength: Option<Option<Spot>> = None;
    for (start, line) in lines(preview, run.table.reading.first_data_line) {
        let cell = line.trim();
        if cell.is_empty() || cell.starts_with(['@', '#']) {
            continue;
        }
        let whole = |number: &Number| line[number.range.clone()] == *cell;
        let spot = Numbers::new(line, true).next().filter(whole).map(|number| Spot { line: start, number });
        match wavelength.take() {
            None => wavelength = Some(spot),
            Some(before) => {
                if let (Some(wavelength), Some(value)) = (before, spot) {
                    run.take(&wavelength, &value);
                }
            }
        }
    }
}

/// `<point wavelength="380">0.1</point>`
fn attributes(preview: &Preview, name: &str, run: &mut Run) {
    let mut wavelength: Option<Spot> = None;
    let mut after = ' ';
    for (start, line) in lines(preview, 1) {
        let mut done = 0;
        for number in Numbers::new(line, false) {
            let before = &line[..number.range.start];
            let between = line[done..number.range.start].trim_end();
            after = between.chars().next_back().unwrap_or(after);
            done = number.range.end;
            let spot = Spot { line: start, number };
            if is_attribute(before, name) {
                wavelength = Some(spot);
            } else if after == '>'
                && let Some(wavelength) = wavelength.take()
            {
                run.take(&wavelength, &spot);
            }
            after = '0';
        }
        after = line[done..].trim_end().chars().next_back().unwrap_or(after);
    }
}

/// Whether a text ends with the name of an attribute and the quote that opens its value.
fn is_attribute(before: &str, name: &str) -> bool {
    let quoted = before.trim_end().strip_suffix(['"', '\'']).map(str::trim_end);
    let named = quoted.and_then(|before| before.strip_suffix('=')).map(str::trim_end);
    let rest = named.and_then(|before| before.strip_suffix(name));
    rest.is_some_and(|rest| rest.is_empty() || rest.ends_with([' ', '\t', ':']))
}

/// `"380": [0.1, 0.2, 0.3]`: a number for each curve.
fn keys(preview: &Preview, table: &Table) -> Vec<Placed> {
    let conversion = Conversion::of(table);
    let unit = table.reading.wavelength_unit.value;
    let mut seen = std::collections::BTreeSet::new();
    let mut done = Vec::new();
    let mut key: Option<(f64, usize)> = None;
    for (start, line) in lines(preview, 1) {
        for number in Numbers::new(line, false) {
            let (before, after) = (&line[..number.range.start], &line[number.range.end..]);
            if before.ends_with('"') {
                key = None;
                if after.strip_prefix('"').is_some_and(|rest| rest.trim_start().starts_with(':')) {
                    let nm = unit.nanometers(number.value);
                    let first =
                        table.curves.iter().enumerate().find_map(|(i, curve)| Some((i, stream::sample(curve, nm)?)));
                    if let Some((curve, sample)) = first.filter(|_| seen.insert(nm.to_bits())) {
                        key = Some((nm, 0));
                        done.push(Placed::new(start, &number.range, Kind::Wavelength, curve, sample));
                    }
                }
            } else if let Some((nm, curve)) = key.as_mut() {
                if let Some(found) = table.curves.get(*curve)
                    && let Some(sample) = stream::sample(found, *nm)
                    && conversion.gives(number.value, found.values[sample])
                {
                    done.push(Placed::new(start, &number.range, Kind::Value, *curve, sample));
                }
                *curve += 1;
            }
        }
    }
    done
}

/// The lines from one on, with the byte at which each begins.
pub(super) fn lines(preview: &Preview, from: usize) -> impl Iterator<Item = (usize, &str)> {
    preview.lines_from(from).map(|(_, line)| (super::cells::offset(&preview.text, line), line))
}
