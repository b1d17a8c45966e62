//! Comma-separated values, with or without comments above them, and samples at the wavelengths they are written at: a part at a
//! time, so that memory does not grow with what is written.

use chromascope_text::guarded;
use std::borrow::Cow;

use crate::error::MAX_SAMPLES;
use crate::write::base::{self, Changes, SAME_NM, multiples};
use crate::write::format::{Format, Grid, Note, WriteError};
use crate::write::sheet::{Content, Piece, Sheet, one_line, push_comment, push_number, push_quoted};

/// Block size of text; a longer row is written alone.
const CHUNK: usize = 1 << 16;
const CELLS: usize = 1 << 20;

/// Curves on their way out, at their own wavelengths or at multiples of a step. What can be refused was refused.
#[derive(Debug)]
pub struct Prepared<'a> {
    sheet: Sheet<'a>,
    pieces: Vec<Piece<'a>>,
    rows: Vec<f64>,
    changes: Changes,
    renamed: Vec<Note>,
    /// Curves without a value at any multiple of the step.
    blank: usize,
}

impl<'a> Prepared<'a> {
    /// Checks the curves and finds the wavelengths they are written at.
    ///
    /// # Errors
    /// [`WriteError`] for curves that are none, or over the limits on such a grid.
    pub fn new(sheet: &Sheet<'a>, grid: Grid) -> Result<Self, WriteError> {
        Format::Csv.fits(sheet)?;
        base::check(grid)?;
        let mut renamed = Vec::new();
        let pieces = sheet.pieces(&mut renamed);
        let rows = rows(&pieces, grid)?;
        if rows.len().saturating_mul(pieces.len()) > MAX_SAMPLES {
            return Err(WriteError::TooLarge);
        }
        let is_blank =
            |piece: &&Piece<'_>| grid != Grid::Native && within(&rows, grid.within(piece.range())).is_empty();
        let blank = pieces.iter().filter(is_blank).count();
        if blank == pieces.len() {
            return Err(WriteError::NoOverlap);
        }
        Ok(Self { sheet: *sheet, pieces, rows, changes: Changes::new(grid), renamed, blank })
    }

    /// Writes wavelengths and values of one curve after the other, as long as `put` continues.
    pub fn each(&mut self, mut put: impl FnMut(&[f64], &[f64]) -> bool) {
        for piece in &self.pieces {
            let piece = part(piece, &self.rows, self.sheet.content, &mut self.changes);
            if !put(&piece.wavelengths, &piece.values) {
                return;
            }
        }
    }

    /// Writes the table with its header, some lines at a time, as long as `put` continues.
    pub fn table(&mut self, put: &mut dyn FnMut(&str) -> bool) {
        self.write(String::new(), put);
    }

    /// Passes on the table with what is known about the curves above it.
    pub(super) fn with_comments(&mut self, put: &mut dyn FnMut(&str) -> bool) {
        let mut out = String::new();
        let step = self.changes.grid.step_nm();
        if step.is_some() {
            // The header describes how values were obtained, which is known only once all curves were.
            self.each(|_, _| true);
        }
        push_comments(&mut out, &self.sheet, self.changes.description(step).as_deref());
        self.write(out, put);
    }

    fn write(&mut self, mut out: String, put: &mut dyn FnMut(&str) -> bool) {
        out.push_str("wavelength_nm");
        let head = self.sheet.head();
        for piece in &self.pieces {
            out.push(',');
            push_name(&mut out, &format!("{}{head}", piece.name));
        }
        out.push('\n');
        for rows in self.rows.chunks((CELLS / self.pieces.len()).max(1)) {
            let (content, changes) = (self.sheet.content, &mut self.changes);
            let parts = self.pieces.iter().map(|piece| part(piece, rows, content, changes));
            if !push_rows(&mut out, rows, &parts.collect::<Vec<_>>(), put) {
                return;
            }
        }
        put(&out);
    }

    /// All that is not as it was in the curves, known once they were passed on.
    pub fn notes(&self) -> Vec<Note> {
        let mut notes = self.renamed.clone();
        let step = self.changes.grid.step_nm();
        if let (Some(step), Some(first), Some(last)) = (step, self.rows.first(), self.rows.last()) {
            self.changes.note(Some(step), [*first, *last], &mut notes);
        }
        notes.extend((self.blank > 0).then_some(Note::Blank(self.blank)));
        notes
    }
}

/// The wavelengths of all curves, or the multiples of a step in their ranges, ascending.
fn rows(pieces: &[Piece<'_>], grid: Grid) -> Result<Vec<f64>, WriteError> {
    let mut rows = Vec::new();
    let mut before: Option<&Piece<'_>> = None;
    for piece in pieces {
        // Most tables have one grid for many curves in a row.
        match grid.step_nm() {
            Some(step) if before.is_none_or(|before| before.range() != piece.range()) => {
                rows.extend(multiples(step, grid.within(piece.range()))?);
            }
            None if before.is_none_or(|before| before.wavelengths != piece.wavelengths) => {
                rows.extend_from_slice(&piece.wavelengths);
            }
            _ => {}
        }
        if grid != Grid::Native && rows.len() > MAX_SAMPLES {
            return Err(WriteError::TooLarge);
        }
        before = Some(piece);
    }
    rows.sort_unstable_by(f64::total_cmp);
    rows.dedup();
    Ok(rows)
}

fn within(rows: &[f64], [first, last]: [f64; 2]) -> &[f64] {
    let from = rows.partition_point(|&row| row < first - SAME_NM);
    let to = rows.partition_point(|&row| row <= last + SAME_NM);
    rows.get(from..to).unwrap_or_default()
}

fn part<'p>(piece: &'p Piece<'_>, rows: &[f64], content: Content<'_>, changes: &mut Changes) -> Piece<'p> {
    let name = Cow::Borrowed("");
    if changes.grid != Grid::Native {
        let wavelengths = within(rows, changes.grid.within(piece.range()));
        let values = changes.take(piece, content, wavelengths).into();
        return Piece { name, wavelengths: wavelengths.to_vec().into(), values };
    }
    let [Some(first), Some(last)] = [rows.first(), rows.last()] else {
        return Piece { name, wavelengths: Cow::default(), values: Cow::default() };
    };
    let from = piece.wavelengths.partition_point(|own| own < first);
    let own = from..piece.wavelengths.partition_point(|own| own <= last);
    let (wavelengths, values) = (&piece.wavelengths[own.clone()], &piece.values[own]);
    Piece { name, wavelengths: wavelengths.into(), values: values.into() }
}

fn push_comments(out: &mut String, sheet: &Sheet<'_>, resampling: Option<&str>) {
    let mut push = |key: &str, value: &str| push_comment(out, key, value);
    let title = sheet.title();
    if !title.is_empty() {
        push("title", &title);
    }
    push("quantity", sheet.quantity());
    if let Some(unit) = sheet.unit() {
        push("unit", &one_line(unit));
    }
    if let Content::Camera { per_photon: Some(per_photon), .. } = sheet.content {
        push("response", if per_photon { "per photon" } else { "per energy" });
    }
    if let Content::Camera { manufacturer, model, .. } = sheet.content {
        for (key, value) in [("manufacturer", manufacturer), ("model", model)] {
            if let Some(value) = value.map(one_line).filter(|value| !value.is_empty()) {
                push(key, &value);
            }
        }
    }
    if let Some(resampling) = resampling {
        push("resampling", resampling);
    }
    for (key, value) in sheet.comments() {
        // The first colon ends the key.
        push(&key.replace(':', " "), &value);
    }
}

fn push_name(out: &mut String, name: &str) {
    let name = guarded(name);
    if name.contains([',', '"', ';', '\t']) {
        push_quoted(out, &name);
    } else {
        out.push_str(&name);
    }
}

/// Appends rows and writes full blocks; returns whether to continue.
fn push_rows(out: &mut String, rows: &[f64], parts: &[Piece<'_>], put: &mut dyn FnMut(&str) -> bool) -> bool {
    let mut next = vec![0_usize; parts.len()];
    for &wavelength in rows {
        push_number(out, wavelength);
        for (piece, next) in parts.iter().zip(&mut next) {
            out.push(',');
            if piece.wavelengths.get(*next) == Some(&wavelength) {
                push_number(out, piece.values[*next]);
                *next += 1;
            }
        }
        out.push('\n');
        if out.len() >= CHUNK {
            if !put(out) {
                return false;
            }
            out.clear();
        }
    }
    true
}
