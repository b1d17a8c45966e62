//! Comma-separated values, with or without comments above them.

use super::super::MAX_SAMPLES;
use super::resample::{Changes, Sampling, multiples};
use super::sheet::Piece;
use super::text::{push_number, push_quoted};
use super::{Content, Grid, Note, Sheet, WriteError};

/// Whether what is known about the curves stands above the table.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Comments {
    Yes,
    No,
}

/// Writes the table.
pub(super) fn write(
    sheet: &Sheet<'_>,
    grid: Grid,
    comments: Comments,
    notes: &mut Vec<Note>,
) -> Result<String, WriteError> {
    let mut pieces = sheet.pieces(notes);
    let resampling = match grid.step_nm() {
        Some(step) => resample(&mut pieces, sheet.content, (grid, step), notes)?,
        None => None,
    };
    let wavelengths = union(&pieces);
    if wavelengths.len().saturating_mul(pieces.len()) > MAX_SAMPLES {
        return Err(WriteError::TooLarge);
    }
    let mut out = String::new();
    if comments == Comments::Yes {
        push_comments(&mut out, sheet, resampling.as_deref());
    }
    out.push_str("wavelength_nm");
    for piece in &pieces {
        out.push(',');
        push_name(&mut out, &piece.name);
    }
    out.push('\n');
    push_rows(&mut out, &wavelengths, &pieces);
    Ok(out)
}

/// Brings each curve to the multiples of a step within its own range; says how.
fn resample(
    pieces: &mut [Piece<'_>],
    content: Content<'_>,
    (grid, step): (Grid, f64),
    notes: &mut Vec<Note>,
) -> Result<Option<String>, WriteError> {
    let sampling = Sampling::of(grid);
    let mut changes = Changes::new(sampling);
    let (mut blank, mut cells) = (0, 0_usize);
    let mut written = [f64::INFINITY, f64::NEG_INFINITY];
    for piece in pieces.iter_mut() {
        let wavelengths = multiples(step, sampling.within(piece.range()))?;
        cells += wavelengths.len();
        if cells > MAX_SAMPLES {
            return Err(WriteError::TooLarge);
        }
        if let (Some(first), Some(last)) = (wavelengths.first(), wavelengths.last()) {
            written = [written[0].min(*first), written[1].max(*last)];
        } else {
            blank += 1;
        }
        piece.values = changes.take(piece, content, &wavelengths).into();
        piece.wavelengths = wavelengths.into();
    }
    if blank == pieces.len() {
        return Err(WriteError::NoOverlap);
    }
    changes.note(Some(step), written, notes);
    if blank > 0 {
        notes.push(Note::Blank { count: blank });
    }
    Ok(changes.told(Some(step)))
}

/// Every wavelength of any curve, ascending.
fn union(pieces: &[Piece<'_>]) -> Vec<f64> {
    let mut all = Vec::new();
    let mut before: &[f64] = &[];
    for piece in pieces {
        // Most tables have one grid for many curves in a row.
        if piece.wavelengths != before {
            all.extend_from_slice(&piece.wavelengths);
        }
        before = &piece.wavelengths;
    }
    all.sort_unstable_by(f64::total_cmp);
    all.dedup();
    all
}

fn push_comments(out: &mut String, sheet: &Sheet<'_>, resampling: Option<&str>) {
    let mut push = |key: &str, value: &str| {
        for part in ["# ", key, ": ", value, "\n"] {
            out.push_str(part);
        }
    };
    let title = sheet.title();
    if !title.is_empty() {
        push("title", &title);
    }
    if let Some(quantity) = sheet.quantity() {
        push("quantity", quantity);
    }
    if let Some(unit) = sheet.unit() {
        push("unit", &super::text::one_line(unit));
    }
    if let Content::Camera { per_photon: Some(per_photon), .. } = sheet.content {
        push("response", if per_photon { "per photon" } else { "per energy" });
    }
    if let Content::Camera { manufacturer, model, .. } = sheet.content {
        for (key, value) in [("manufacturer", manufacturer), ("model", model)] {
            if let Some(value) = value.map(super::text::one_line).filter(|value| !value.is_empty()) {
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

/// A name, quoted only where it has to be.
fn push_name(out: &mut String, name: &str) {
    if name.contains([',', '"', ';', '\t']) {
        push_quoted(out, name);
    } else {
        out.push_str(name);
    }
}

fn push_rows(out: &mut String, wavelengths: &[f64], pieces: &[Piece<'_>]) {
    let mut next = vec![0_usize; pieces.len()];
    for &wavelength in wavelengths {
        push_number(out, wavelength);
        for (piece, next) in pieces.iter().zip(&mut next) {
            out.push(',');
            if piece.wavelengths.get(*next) == Some(&wavelength) {
                push_number(out, piece.values[*next]);
                *next += 1;
            }
        }
        out.push('\n');
    }
}
