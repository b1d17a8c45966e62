//! Parts of a line: their meaning in words, and as they are drawn.

use std::ops::Range;

use crate::decimal::short;
use crate::decision::Values;
use crate::report::{Curve, SpectralFile};

/// A part of a line with its meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Its bytes in the line, on the borders of characters. Empty where an empty cell stands for a gap.
    pub range: Range<usize>,
    /// Its meaning.
    pub what: What,
}

/// Meaning of a piece of a line. Curves are indices in the table, from 0; wavelengths are in nanometers.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum What {
    /// A wavelength of the table.
    Wavelength(f64),
    /// A value of a curve.
    Value {
        /// Index of the table's curve, from 0.
        curve: usize,
        /// Wavelength in nanometers.
        nm: f64,
        /// The value as the table has it.
        value: f64,
        /// The number as the file has it; differs from the value in percent, for instance.
        written: f64,
    },
    /// The name of a curve.
    Name(usize),
    /// A unit, of a curve or of the wavelengths. `None` for the wavelengths.
    Unit(Option<usize>),
    /// A setting or a remark that was stored with the reading.
    Setting,
    /// A place where a curve has no value.
    Gap(usize),
    /// A line of values so compressed that single numbers have no place in it.
    Block(usize),
    /// An uncertainty of a curve.
    Uncertainty(usize),
    /// Something that is in no curve.
    LeftOut(LeftOut),
}

/// Reason that something is in no curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each variant says in its message what it stands for")]
pub enum LeftOut {
    #[error("a column that is in no curve")]
    Column,
    #[error("the same as an earlier row")]
    Repeated,
    #[error("one of several values at this wavelength, of which the mean is taken")]
    Averaged,
    #[error("no wavelength")]
    NoWavelength,
    #[error("beyond the wavelengths that are read")]
    OutOfRange,
    /// Text below the table, another table, or a curve of fewer than two values.
    #[error("no row of this table")]
    Line,
}

impl What {
    /// The curve it belongs to, from 0, if it belongs to one.
    pub fn curve(self) -> Option<usize> {
        match self {
            Self::Value { curve, .. }
            | Self::Name(curve)
            | Self::Gap(curve)
            | Self::Block(curve)
            | Self::Uncertainty(curve) => Some(curve),
            Self::Unit(curve) => curve,
            Self::Wavelength(..) | Self::Setting | Self::LeftOut(..) => None,
        }
    }

    /// A short text for hovering: "Canon EOS 10D: 0.431 at 500 nm (written 43.1, percent)".
    pub fn describe(&self, table: &SpectralFile) -> String {
        let curve = |index: usize| table.curves.get(index);
        let name = |index: usize| curve(index).map_or("a curve", |curve: &Curve| curve.name.as_str());
        match *self {
            Self::Wavelength(nm) => format!("{} nm", short(nm, 6)),
            Self::Value { curve, nm, value, written } => {
                let place = format!("{}: {} at {} nm", name(curve), short(value, 6), short(nm, 6));
                if written == value { place } else { format!("{place} (written {}{})", short(written, 6), how(table)) }
            }
            Self::Name(curve) => format!("name of curve {}", curve + 1),
            Self::Unit(None) => format!("unit of the wavelengths: {}", table.reading.wavelength_unit.value),
            Self::Unit(Some(index)) => match curve(index).and_then(|curve| curve.unit.as_deref()) {
                Some(unit) => format!("unit of {}: {unit}", name(index)),
                None => format!("unit of {}", name(index)),
            },
            Self::Setting => "kept as a setting".to_owned(),
            Self::Gap(curve) => format!("{}: no value here", name(curve)),
            Self::Block(curve) => format!("{}: compressed values", name(curve)),
            Self::Uncertainty(curve) => format!("{}: uncertainty", name(curve)),
            Self::LeftOut(why) => format!("left out: {why}"),
        }
    }
}

fn how(table: &SpectralFile) -> &'static str {
    match table.reading.values.value {
        Values::Plain => "",
        Values::Percent => ", percent",
        Values::Absorbance => ", absorbance",
        Values::Decibels => ", decibels",
    }
}

/// A part of a line as it is drawn: one visible character for each character, whatever it was.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shown {
    /// Text as drawn. Tabs are arrows, other control characters are dots.
    pub text: String,
    /// True if the line has more before.
    pub more_before: bool,
    /// True if the line has more after.
    pub more_after: bool,
    /// The bytes of the line that are drawn.
    pub window: Range<usize>,
    /// For each character and for the end: its byte in the line, and in the text.
    places: Vec<(usize, usize)>,
}

impl Shown {
    pub(super) fn new(line: &str, from: usize, count: usize) -> Self {
        let start = line.char_indices().nth(from).map_or(line.len(), |(at, _)| at);
        let mut text = String::new();
        let mut places = Vec::new();
        let mut end = start;
        for (at, c) in line[start..].char_indices().take(count) {
            places.push((start + at, text.len()));
            text.push(visible(c));
            end = start + at + c.len_utf8();
        }
        places.push((end, text.len()));
        Self { more_before: start > 0, more_after: end < line.len(), text, window: start..end, places }
    }

    /// The bytes of [`text`](Self::text) that a range of bytes of the line takes; `None` if it is not drawn.
    pub fn map(&self, range: &Range<usize>) -> Option<Range<usize>> {
        if range.start > self.window.end || range.end < self.window.start || range.end < range.start {
            return None;
        }
        let place = |byte: usize| {
            let index = self.places.partition_point(|(at, _)| *at < byte);
            self.places.get(index).map_or(self.text.len(), |(_, shown)| *shown)
        };
        let mapped = place(range.start)..place(range.end);
        (range.is_empty() || !mapped.is_empty()).then_some(mapped)
    }
}

fn visible(c: char) -> char {
    match c {
        '\t' => '\u{2192}',
        c if c.is_control() => '\u{00B7}',
        // Marks that turn the direction of text, join what stands around them, or have no width at all.
        '\u{200B}'..='\u{200F}' | '\u{202A}'..='\u{202E}' | '\u{2060}'..='\u{2069}' | '\u{FEFF}' => '\u{00B7}',
        c => c,
    }
}
