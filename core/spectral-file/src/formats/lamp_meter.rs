//! One sample a line, its wavelength at the end of a label in any language: `Spectral Data 380[nm],0.001`.

use crate::decision::{Decided, DecimalMark, Decision, Delimiter, Part, Reader, Role, WavelengthUnit};
use crate::dialect::{Cell, Dialect};
use crate::error::{MAX_PARTS, ReadError};
use crate::formats::Format;
use crate::formats::spectra::{self, Found, Sample, Spectrum};
use crate::header::Header;
use crate::options::ReadOptions;
use crate::text::{Lines, excerpt};
use crate::watch::Log;

/// The fewest lines of one label that make a spectrum.
const FEWEST: usize = 5;

/// Bytes of the text that are looked at.
const LOOK: usize = 1 << 20;

impl Reader {
    /// One sample a line, its wavelength at the end of a label, as Sekonic meters write.
    pub const LABELS: Self = Self::new("labels", "one labeled sample a line", "Labeled lines");
}

pub(super) const FORMAT: Format =
    Format { reader: Reader::LABELS, fits: |head| head.is_plain() && recognize(head.text), read };

struct Labeled<'a> {
    label: &'a str,
    wavelength: f64,
    written: &'a str,
    delimiter: Delimiter,
    value: &'a str,
}

fn recognize(text: &str) -> bool {
    let start = &text[..text.floor_char_boundary(LOOK)];
    // Most files have no `nm` in their rows; counting letters is many times faster than splitting lines.
    if start.bytes().filter(|byte| matches!(byte, b'n' | b'N')).count() < FEWEST {
        return false;
    }
    Lines::new(start).filter_map(|(_, line)| sample(line)).take(FEWEST).count() == FEWEST
}

/// Reads the finest block of samples.
fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let mut header = Header::default();
    let (blocks, delimiter, mark) = blocks(text, &mut header, log)?;
    let finest = blocks.iter().enumerate().max_by_key(|(at, block)| (block.len(), std::cmp::Reverse(*at)));
    let finest = finest.map(|(at, _)| at + 1).ok_or(ReadError::NoNumbers)?;
    let part = options.part.unwrap_or(finest);
    let parts: Vec<Part> = blocks.iter().take(MAX_PARTS).map(|block| self::part(block)).collect();
    let at = part.checked_sub(1).filter(|at| *at < blocks.len());
    let at = at.ok_or(ReadError::NoSuchPart { part, parts: parts.len() })?;
    let mut notes = Vec::new();
    let count = blocks.len();
    let Some(samples) = blocks.into_iter().nth(at) else { return Err(ReadError::NoNumbers) };
    let first_line = samples.first().map_or(1, |sample| sample.line);
    if count > 1 {
        let why = format!("{count} blocks of samples, this one with the most");
        let taken = format!("the {} samples from line {first_line} on", samples.len());
        let decided = Decided::or_chosen(options.part, || Decided::certain(part, why));
        notes.push(Decision::new("Block", &decided.described(&taken)));
    }
    let mut grid = spectra::grid(vec![Spectrum { samples, ..Spectrum::default() }], header, log)?;
    grid.part = Some(Decided::certain(part, format!("{count} blocks of samples, this one with the most")));
    grid.parts = parts;
    grid.unit = Some(Decided::certain(WavelengthUnit::Nanometer, "The unit stands in the labels"));
    grid.role = Some(Decided::guess(Role::Illuminant, "Meters that write such files measure light"));
    let why = format!("Labels such as the one in line {first_line} end with a wavelength");
    let reader = Decided::certain(Reader::LABELS, &*why);
    Ok(Found::fixed(grid, reader, ((delimiter, mark), first_line, &why), notes))
}

fn part(block: &[Sample]) -> Part {
    Part { line: block.first().map_or(1, |sample| sample.line), name: String::new(), curves: 1, rows: block.len() }
}

type Blocks = (Vec<Vec<Sample>>, Delimiter, DecimalMark);

/// Blocks of samples of one label and rising wavelengths; other lines are stored as comments.
fn blocks(text: &str, header: &mut Header, log: &mut Log<'_>) -> Result<Blocks, ReadError> {
    let mut all: Vec<Vec<Sample>> = vec![Vec::new()];
    let mut label = None;
    let (mut delimiter, mut mark) = (Delimiter::Comma, DecimalMark::Point);
    for (number, line) in Lines::new(text) {
        log.at(line.as_ptr() as usize - text.as_ptr() as usize)?;
        let Some(found) = sample(line) else {
            if let Some((key, value)) = line.split_once([',', ';', '\t']) {
                let key = if key.eq_ignore_ascii_case("title") { "title" } else { key };
                header.note(number, key.trim(), value.trim());
            }
            continue;
        };
        let last = all.last().and_then(|block| block.last());
        let goes_on = label == Some(found.label) && last.is_some_and(|last| found.wavelength > last.wavelength);
        if !goes_on {
            label = Some(found.label);
            all.push(Vec::new());
        }
        delimiter = found.delimiter;
        if found.value.contains(',') {
            mark = DecimalMark::Comma;
        }
        let value = match Dialect::new(delimiter, mark).parse(found.value) {
            Cell::Number(value) => value,
            Cell::Gap => continue,
            Cell::Text => return Err(ReadError::NotANumber { line: number, column: 2, text: excerpt(found.value) }),
        };
        if let Some(block) = all.last_mut() {
            let place = log.places.as_mut().map(|places| places.pair(found.written, found.value)).unwrap_or_default();
            block.push(Sample { wavelength: found.wavelength, value, line: number, place });
        }
    }
    all.retain(|block| block.len() >= FEWEST);
    Ok((all, delimiter, mark))
}

fn sample(line: &str) -> Option<Labeled<'_>> {
    const LONGEST: usize = 200;
    if line.len() > LONGEST {
        return None;
    }
    let at = line.find([',', ';', '\t'])?;
    let delimiter = match line.as_bytes()[at] {
        b',' => Delimiter::Comma,
        b';' => Delimiter::Semicolon,
        _ => Delimiter::Tab,
    };
    let (cell, value) = (line[..at].trim().trim_matches('"').trim_end(), line[at + 1..].trim().trim_matches('"'));
    let bare = cell.trim_end_matches([']', ')']).trim_end();
    let number = bare.strip_suffix("nm").or_else(|| bare.strip_suffix("NM"))?.trim_end_matches(['[', '(']).trim_end();
    let start = number.rfind(|c: char| !(c.is_ascii_digit() || c == '.')).map_or(0, |at| at + 1);
    let start = (start..=number.len()).find(|&at| number.is_char_boundary(at))?;
    let label = number[..start].trim();
    let wavelength = number[start..].parse().ok().filter(|w: &f64| (100.0..=20_000.0).contains(w))?;
    // A range such as `PPFD 400-700nm` is no wavelength.
    let usable = !label.is_empty() && !label.ends_with(['-', '~', '\u{2013}']) && !value.is_empty();
    usable.then_some(Labeled { label, wavelength, written: &number[start..], delimiter, value })
}
