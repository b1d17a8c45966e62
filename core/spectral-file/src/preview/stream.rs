//! The numbers of a text one after the other, and the pieces of it that were recognized.

use std::ops::Range;

use super::super::dialect::{Cell, Dialect};
use super::super::{Curve, DecimalMark, Delimiter, Table};
use super::mark::{Mark, What};

/// A number in a line.
#[derive(Debug, Clone)]
pub(super) struct Number {
    pub(super) range: Range<usize>,
    pub(super) value: f64,
    /// Whether a letter or another digit stands just before it.
    pub(super) glued: bool,
}

/// The value of a written number, either mark before its fraction if there is only one.
pub(super) fn value(text: &str) -> Option<f64> {
    let mark = if text.contains(',') { DecimalMark::Comma } else { DecimalMark::Point };
    match Dialect::new(Delimiter::Spaces, mark).parse(text) {
        Cell::Number(value) => Some(value),
        Cell::Gap | Cell::Text => None,
    }
}

/// Iterator over the numbers of a line.
#[derive(Debug, Clone)]
pub(super) struct Numbers<'a> {
    line: &'a str,
    at: usize,
    /// Whether commas mark fractions.
    comma: bool,
}

impl<'a> Numbers<'a> {
    pub(super) fn new(line: &'a str, comma: bool) -> Self {
        Self { line, at: 0, comma }
    }

    fn digits(&self, mut at: usize) -> usize {
        let bytes = self.line.as_bytes();
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    }

    fn is_mark(&self, at: usize) -> bool {
        match self.line.as_bytes().get(at) {
            Some(b'.') => true,
            Some(b',') => self.comma,
            _ => false,
        }
    }

    /// Where the number ends whose first digit or mark stands at a byte.
    fn end(&self, start: usize) -> usize {
        let bytes = self.line.as_bytes();
        let mut at = self.digits(start);
        if self.is_mark(at) && (at > start || bytes.get(at + 1).is_some_and(u8::is_ascii_digit)) {
            let after = self.digits(at + 1);
            // A comma at the end separates, a point may end a number.
            at = if after == at + 1 && bytes[at] == b',' { at } else { after };
        }
        if matches!(bytes.get(at), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(at + 1), Some(b'+' | b'-')));
            let end = self.digits(at + 1 + sign);
            at = if end > at + 1 + sign { end } else { at };
        }
        at
    }
}

impl Iterator for Numbers<'_> {
    type Item = Number;

    fn next(&mut self) -> Option<Number> {
        let bytes = self.line.as_bytes();
        loop {
            let digit = self.at + bytes.get(self.at..)?.iter().position(u8::is_ascii_digit)?;
            let marked = digit > self.at && self.is_mark(digit - 1);
            let body = if marked { digit - 1 } else { digit };
            let signed = body > self.at && matches!(bytes[body - 1], b'+' | b'-');
            let start = if signed { body - 1 } else { body };
            let end = self.end(body).max(digit + 1);
            let glued = start > 0 && (bytes[start - 1].is_ascii_alphanumeric() || bytes[start - 1] >= 0x80);
            self.at = end;
            if let Some(value) = value(&self.line[start..end]) {
                return Some(Number { range: start..end, value, glued });
            }
        }
    }
}

/// A recognized piece of the text; compact, because there may be one for every sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed {
    /// Its bytes in the text.
    pub(super) start: u32,
    pub(super) end: u32,
    curve: u32,
    sample: u32,
    kind: Kind,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum Kind {
    Wavelength,
    Value,
    Block,
}

impl Placed {
    pub(super) fn new(line_start: usize, range: &Range<usize>, kind: Kind, curve: usize, sample: usize) -> Self {
        let at = |byte: usize| (line_start + byte) as u32;
        Self { start: at(range.start), end: at(range.end), curve: curve as u32, sample: sample as u32, kind }
    }

    /// As a mark in the line that begins at a byte.
    pub(super) fn mark(&self, line_start: usize, line: &str, table: &Table) -> Option<Mark> {
        let range = (self.start as usize).checked_sub(line_start)?..(self.end as usize).checked_sub(line_start)?;
        let (curve, sample) = (self.curve as usize, self.sample as usize);
        let found = table.curves.get(curve)?;
        let nm = found.wavelengths_nm.get(sample).copied();
        let what = match self.kind {
            Kind::Block => What::Block { curve },
            Kind::Wavelength => What::Wavelength { nm: nm? },
            Kind::Value => {
                let written = value(line.get(range.clone())?)?;
                What::Value { curve, nm: nm?, value: *found.values.get(sample)?, written }
            }
        };
        Some(Mark::new(range, what))
    }
}

/// The sample of a curve at a wavelength, as closely as wavelengths are told apart.
pub(super) fn sample(curve: &Curve, nm: f64) -> Option<usize> {
    const NEAR_NM: f64 = 1e-6;
    let at = curve.wavelengths_nm.partition_point(|wavelength| *wavelength < nm - NEAR_NM);
    let near = (curve.wavelengths_nm.get(at)? - nm).abs() <= NEAR_NM;
    (near && at < curve.values.len()).then_some(at)
}
