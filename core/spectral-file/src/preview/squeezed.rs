//! JCAMP-DX: blocks of points, of ordinates, or of ordinates that are squeezed.

use super::super::Table;
use super::Preview;
use super::cells;
use super::lists;
use super::pairs::{Run, Spot, lines};
use super::stream::{self, Kind, Numbers, Placed};

/// What the lines of a block hold.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Form {
    Records,
    Points,
    Ordinates,
}

/// The blocks of a text, each of which may be one curve.
struct Blocks<'a> {
    table: &'a Table,
    run: Run<'a>,
    form: Form,
    title: String,
    /// Ordinates, the abscissas of their lines, and lines in which they are squeezed.
    ordinates: Vec<Spot>,
    abscissas: Vec<Spot>,
    squeezed: Vec<(usize, std::ops::Range<usize>)>,
}

/// Finds the curves of a table among the blocks of its text.
pub(super) fn jcamp(preview: &Preview, table: &Table) -> Vec<Placed> {
    let mut blocks = Blocks {
        table,
        run: Run::new(table),
        form: Form::Records,
        title: String::new(),
        ordinates: Vec::new(),
        abscissas: Vec::new(),
        squeezed: Vec::new(),
    };
    for (start, line) in lines(preview, 1) {
        let line = line.split_once("$$").map_or(line, |(before, _)| before);
        match line.trim_start().strip_prefix("##").and_then(|record| record.split_once('=')) {
            Some((key, value)) => blocks.record(key, value.trim()),
            None => blocks.data(start, line),
        }
    }
    blocks.close();
    let mut all = blocks.run.done;
    all.sort_unstable_by_key(|piece| piece.start);
    all
}

impl Blocks<'_> {
    fn record(&mut self, key: &str, value: &str) {
        const LONGEST: usize = 64;
        let label = |text: &str| -> String {
            let kept = text.chars().filter(char::is_ascii_alphanumeric).take(LONGEST);
            kept.map(|c| c.to_ascii_uppercase()).collect()
        };
        let factor = || stream::value(value).filter(|factor| *factor != 0.0).unwrap_or(1.0);
        self.form = Form::Records;
        match label(key).as_str() {
            "TITLE" => {
                self.close();
                value.clone_into(&mut self.title);
            }
            "XFACTOR" => self.run.x_factor = factor(),
            "YFACTOR" => self.run.conversion.factor = factor(),
            "XYDATA" | "XYPOINTS" | "PEAKTABLE" => {
                self.form = if label(value).starts_with("XYY") { Form::Ordinates } else { Form::Points };
            }
            _ => {}
        }
    }

    fn data(&mut self, start: usize, line: &str) {
        let comma = self.table.reading.decimal_mark.value == super::super::DecimalMark::Comma;
        let spot = |number| Spot { line: start, number };
        match self.form {
            Form::Records => {}
            Form::Points => {
                let mut numbers = Numbers::new(line, comma).map(spot);
                while let (Some(wavelength), Some(value)) = (numbers.next(), numbers.next()) {
                    self.run.take(&wavelength, &value);
                }
            }
            Form::Ordinates if is_squeezed(line) => self.squeezed.push((start, cells::trimmed(line))),
            Form::Ordinates => {
                let mut numbers = Numbers::new(line, comma).map(spot);
                self.abscissas.extend(numbers.next());
                self.ordinates.extend(numbers);
            }
        }
    }

    /// Ends a block: its ordinates are kept if they are all of the curve that is expected.
    fn close(&mut self) {
        let (ordinates, abscissas) = (std::mem::take(&mut self.ordinates), std::mem::take(&mut self.abscissas));
        let squeezed = std::mem::take(&mut self.squeezed);
        self.run.restart();
        let index = self.run.curve;
        if let Some(curve) = self.table.curves.get(index) {
            let is_next = if squeezed.is_empty() {
                self.ordinates(&ordinates, &abscissas)
            } else {
                !curve.named || curve.name == self.title || self.table.curves.len() == 1
            };
            if is_next {
                let lines = squeezed.iter().filter(|(_, range)| !range.is_empty());
                self.run.done.extend(lines.map(|(start, range)| Placed::new(*start, range, Kind::Block, index, 0)));
                self.run.skip();
            }
        }
        self.run.x_factor = 1.0;
        self.run.conversion.factor = 1.0;
    }

    fn ordinates(&mut self, ordinates: &[Spot], abscissas: &[Spot]) -> bool {
        let index = self.run.curve;
        let curve = &self.table.curves[index];
        let mut placed = Vec::new();
        let mut looks = ordinates.len();
        let whole = ordinates.len() == curve.values.len()
            && lists::place_curve(
                ordinates,
                0,
                &mut looks,
                (index, curve),
                self.run.conversion,
                self.table,
                &mut placed,
            )
            .is_some();
        if whole {
            let unit = self.table.reading.wavelength_unit.value;
            for spot in abscissas {
                let nm = unit.nanometers(spot.number.value * self.run.x_factor);
                if let Some(sample) = stream::sample(curve, nm) {
                    placed.push(Placed::new(spot.line, &spot.number.range, Kind::Wavelength, index, sample));
                }
            }
            self.run.done.append(&mut placed);
        }
        whole
    }
}

/// Whether a line holds letters that stand for digits, differences or repetitions, or numbers that only their signs
/// separate.
fn is_squeezed(line: &str) -> bool {
    let bytes = line.as_bytes();
    bytes.iter().enumerate().any(|(at, byte)| {
        let after_digit = at > 0 && (bytes[at - 1].is_ascii_digit() || bytes[at - 1] == b'.');
        let sign_follows = matches!(bytes.get(at + 1), Some(b'+' | b'-'));
        match byte {
            b'E' | b'e' => !(after_digit && sign_follows),
            b'@' | b'%' | b'A'..=b'Z' | b'a'..=b'z' => true,
            b'+' | b'-' => after_digit,
            _ => false,
        }
    })
}
