//! Raw RGB recorded by a real camera, read from tables, with the spectra of its patches.
//!
//! ```text
//! patch,R,G,B                    patch,R,G,B,400,410,…
//! dark skin,812,655,410          dark skin,812,655,410,0.055,0.058,…
//! ```
//! One row per patch. Columns R, G and B (or red, green and blue) hold linear raw values, separated by commas, semicolons or tabs. An
//! empty cell, `-` or NaN is a missing value. Lines that begin with `#` are comments. Without a header, three numbers per row are R, G
//! and B. Further columns with wavelengths as headers form a spectral table, read as any other.

use chromascope_core::camera::recorded::{RecordedPatch, Signal};
use chromascope_core::spectral::GridSpectrum;

use super::names::folded;

const MAX_ROWS: usize = 100_000;

#[derive(Clone, Debug, PartialEq)]
pub struct RawRow {
    /// Line of the file, from 1; patch of a picture, from 1.
    pub line: usize,
    pub name: Option<String>,
    /// Red, green and blue; NaN where missing.
    pub rgb: [f64; 3],
}

#[derive(Clone, Debug, PartialEq)]
pub struct RawTable {
    pub rows: Vec<RawRow>,
    /// The table's text without the columns R, G and B, if it contains spectra.
    pub spectra: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Levels {
    /// Value of no light, subtracted.
    pub black: f64,
    /// Value from which on a channel is clipped, before black is subtracted.
    pub clip: f64,
}

impl Default for Levels {
    fn default() -> Self {
        Self { black: 0.0, clip: f64::INFINITY }
    }
}

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RawTableError {
    #[error("no rows; expected columns patch,R,G,B")]
    Empty,
    #[error("line {line}: no columns R, G and B; head the columns of raw values so")]
    Heads { line: usize },
    #[error("line {line}: {found} cells for {expected} heads")]
    Cells { line: usize, found: usize, expected: usize },
    #[error("line {line}, column {column}: \"{text}\" is not a number; leave a missing value empty")]
    Number { line: usize, column: usize, text: String },
    #[error("more than {MAX_ROWS} rows")]
    Long,
}

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum JoinError {
    #[error("line {line}: no spectrum is named \"{name}\"; there are {known}")]
    Unknown { line: usize, name: String, known: String },
    #[error("line {line}: \"{name}\" was named before; name each patch once")]
    Twice { line: usize, name: String },
    #[error(
        "{rows} rows of raw values for {spectra} spectra; name the patches in a first column, or give one row for each spectrum"
    )]
    Count { rows: usize, spectra: usize },
}

/// `S L`.
pub fn lit(reflectance: &GridSpectrum, light: &GridSpectrum) -> GridSpectrum {
    let first = chromascope_core::spectral::grid::FIRST_NM;
    GridSpectrum::from_fn(|nm| {
        let index = (nm - first).round() as usize;
        reflectance.values()[index] * light.values()[index]
    })
}

pub(super) fn delimiter(line: &str) -> char {
    [',', ';', '\t'].into_iter().max_by_key(|c| line.matches(*c).count()).unwrap_or(',')
}

pub(super) fn cells(line: &str, delimiter: char) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    let mut signs = line.trim_end_matches('\r').chars().peekable();
    while let Some(sign) = signs.next() {
        let cell = cells.last_mut();
        match (sign, cell) {
            ('"', Some(cell)) if quoted && signs.peek() == Some(&'"') => {
                cell.push('"');
                signs.next();
            }
            ('"', _) => quoted = !quoted,
            (sign, _) if sign == delimiter && !quoted => cells.push(String::new()),
            (sign, Some(cell)) => cell.push(sign),
            (_, None) => {}
        }
    }
    cells.into_iter().map(|cell| cell.trim().to_owned()).collect()
}

/// A number of a cell, NaN for a missing one; none for text. A comma is a decimal mark where it does not separate.
pub(super) fn number(cell: &str, delimiter: char) -> Option<f64> {
    if cell.is_empty() || cell == "-" || cell.eq_ignore_ascii_case("nan") {
        return Some(f64::NAN);
    }
    let cell = if delimiter == ',' { cell.to_owned() } else { cell.replacen(',', ".", 1) };
    cell.parse::<f64>().ok().filter(|value| value.is_finite())
}

fn channels(heads: &[String]) -> Option<[usize; 3]> {
    let at = |names: [&str; 3]| heads.iter().position(|head| names.contains(&folded(head).as_str()));
    Some([at(["r", "red", "rawr"])?, at(["g", "green", "rawg"])?, at(["b", "blue", "rawb"])?])
}

/// Column that names the patches: one headed so, or the first that is neither a channel nor a wavelength.
fn name_column(heads: &[String], channels: [usize; 3], delimiter: char) -> Option<usize> {
    let headed =
        heads.iter().position(|head| ["patch", "name", "sample", "label", "id"].contains(&folded(head).as_str()));
    let other = |at: &usize| !channels.contains(at) && number(&heads[*at], delimiter).is_none_or(f64::is_nan);
    headed.or_else(|| (0..heads.len()).find(other))
}

pub fn read_table(bytes: &[u8]) -> Result<RawTable, RawTableError> {
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let is_row = |line: &&str| !line.trim().is_empty() && !line.starts_with('#');
    let (first, head) = text.lines().enumerate().find(|(_, line)| is_row(line)).ok_or(RawTableError::Empty)?;
    let delimiter = delimiter(head);
    let heads = cells(head, delimiter);
    let headless = heads.len() == 3 && heads.iter().all(|cell| number(cell, delimiter).is_some_and(|v| !v.is_nan()));
    let columns =
        if headless { [0, 1, 2] } else { channels(&heads).ok_or(RawTableError::Heads { line: first + 1 })? };
    let named = if headless { None } else { name_column(&heads, columns, delimiter) };
    let has_spectra = (0..heads.len())
        .filter(|at| !columns.contains(at) && Some(*at) != named)
        .filter(|at| heads[*at].trim_end_matches("nm").trim().parse::<f64>().is_ok())
        .count()
        >= 2;
    let mut rows = Vec::new();
    let mut spectra = String::new();
    for (index, line) in text.lines().enumerate() {
        if index < first || !is_row(&line) {
            spectra += line;
            spectra.push('\n');
            continue;
        }
        let cells = if index == first { heads.clone() } else { cells(line, delimiter) };
        if has_spectra {
            let kept = cells.iter().enumerate().filter(|(at, _)| !columns.contains(at));
            let kept = kept.map(|(_, cell)| spectral_file::quoted(cell, delimiter));
            spectra += &kept.collect::<Vec<_>>().join(&delimiter.to_string());
            spectra.push('\n');
        }
        if index == first && !headless {
            continue;
        }
        if rows.len() == MAX_ROWS {
            return Err(RawTableError::Long);
        }
        rows.push(row(&cells, index + 1, heads.len(), columns, named, delimiter)?);
    }
    Ok(RawTable { rows, spectra: has_spectra.then_some(spectra) })
}

fn row(
    cells: &[String],
    line: usize,
    expected: usize,
    columns: [usize; 3],
    named: Option<usize>,
    delimiter: char,
) -> Result<RawRow, RawTableError> {
    if cells.len() != expected {
        return Err(RawTableError::Cells { line, found: cells.len(), expected });
    }
    let mut rgb = [f64::NAN; 3];
    for (value, column) in rgb.iter_mut().zip(columns) {
        let cell = &cells[column];
        *value = number(cell, delimiter).ok_or_else(|| {
            let text = cell.chars().filter(|c| !c.is_control()).take(30).collect();
            RawTableError::Number { line, column: column + 1, text }
        })?;
    }
    let name = named.map(|at| cells[at].clone()).filter(|name| !name.is_empty());
    Ok(RawRow { line, name, rgb })
}

/// Place of a `ColorChecker`'s patch by its number, `1` to `24`, or by row and column, `A1` or `A01` to `D06`.
fn place_of_24(name: &str) -> Option<usize> {
    let name = name.trim();
    let row = "ABCD".find(name.chars().next()?.to_ascii_uppercase());
    let number: usize = row.map_or(name, |_| &name[1..]).parse().ok()?;
    let columns = if row.is_some() { 6 } else { 24 };
    (1..=columns).contains(&number).then(|| row.unwrap_or(0) * 6 + number - 1)
}

/// Patches with spectrum and raw values: by name where every row has one, else in order. Spectra without a row are omitted.
pub fn join(
    spectra: &[(String, GridSpectrum)],
    rows: &[RawRow],
    levels: Levels,
) -> Result<Vec<RecordedPatch>, JoinError> {
    let patch = |(name, radiance): &(String, GridSpectrum), row: &RawRow| RecordedPatch {
        name: name.clone(),
        radiance: radiance.clone(),
        rgb: row.rgb.map(|value| Signal::new(value - levels.black, levels.clip - levels.black)),
    };
    let same = |a: &str, b: &str| folded(a) == folded(b);
    let in_order = rows.len() == spectra.len()
        && spectra.iter().zip(rows).all(|((name, _), row)| row.name.as_deref().is_none_or(|own| same(own, name)));
    if in_order || rows.iter().all(|row| row.name.is_none()) {
        if rows.len() != spectra.len() {
            return Err(JoinError::Count { rows: rows.len(), spectra: spectra.len() });
        }
        return Ok(spectra.iter().zip(rows).map(|(spectrum, row)| patch(spectrum, row)).collect());
    }
    let mut taken = vec![false; spectra.len()];
    let mut patches = Vec::with_capacity(rows.len());
    for row in rows {
        let name = row.name.clone().unwrap_or_default();
        let by_name = spectra.iter().position(|(known, _)| same(known, &name));
        let Some(at) = by_name.or_else(|| place_of_24(&name).filter(|_| spectra.len() == 24)) else {
            let known: Vec<&str> = spectra.iter().take(5).map(|(name, _)| name.as_str()).collect();
            let more = if spectra.len() > known.len() { ", …" } else { "" };
            return Err(JoinError::Unknown { line: row.line, name, known: known.join(", ") + more });
        };
        if std::mem::replace(&mut taken[at], true) {
            return Err(JoinError::Twice { line: row.line, name });
        }
        patches.push(patch(&spectra[at], row));
    }
    Ok(patches)
}
