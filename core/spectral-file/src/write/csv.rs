//! Comma-separated values, with what is known about them in comments above or in metadata beside, and samples at the wavelengths
//! they are written at: a part at a time, so that memory does not grow with what is written.

use chromascope_text::guarded;
use std::borrow::Cow;

use crate::beside::METADATA;
use crate::error::{MAX_CURVES, MAX_SAMPLES};
use crate::report::Covariance;
use crate::write::base::{self, Changes, SAME_NM, multiples};
use crate::write::format::{Format, Grid, Note, WriteError};
use crate::write::json::{push_list_of, push_member, quoted};
use crate::write::sheet::{Content, Piece, Sheet, Stated, expanded, one_line, push_comment, push_number, push_quoted};

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
        let columns = pieces.len() + pieces.iter().filter(|piece| piece.uncertainty.is_some()).count();
        if columns > MAX_CURVES || rows.len().saturating_mul(columns) > MAX_SAMPLES {
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

    /// Writes wavelengths, values and standard uncertainties of one curve after the other, as long as `put` continues.
    pub fn each(&mut self, mut put: impl FnMut(&[f64], &[f64], Option<&[f64]>) -> bool) {
        for piece in &self.pieces {
            let piece = part(piece, &self.rows, self.sheet.content, &mut self.changes);
            let standard = piece.uncertainty.as_ref().map(|stated| &*stated.standard);
            if !put(&piece.wavelengths, &piece.values, standard) {
                return;
            }
        }
    }

    /// Writes the table with its header, some lines at a time, as long as `put` continues.
    pub fn table(&mut self, put: &mut dyn FnMut(&str) -> bool) {
        self.write(String::new(), put);
    }

    /// Writes the table below comments `# key: value` with what is known about the curves.
    pub fn with_comments(&mut self, put: &mut dyn FnMut(&str) -> bool) {
        let mut out = String::new();
        for (key, value) in self.known() {
            // The first colon ends the key.
            push_comment(&mut out, &key.replace(':', " "), &value);
        }
        self.write(out, put);
    }

    /// What stands in files beside the table; without metadata, if what is known stands in comments.
    pub fn beside(&mut self, has_metadata: bool) -> Beside {
        let metadata = has_metadata.then(|| Metadata(self.known()));
        Beside { metadata, covariance: self.covariance().map(covariance_text) }
    }

    /// The covariance of the samples, if they are written as they are.
    fn covariance(&self) -> Option<&'a Covariance> {
        self.sheet.covariance.filter(|_| self.changes.grid == Grid::Native)
    }

    /// All that is known about the curves, as keys and values on a line each.
    fn known(&mut self) -> Vec<(String, String)> {
        let step = self.changes.grid.step_nm();
        if step.is_some() {
            // How values were obtained is known only once all curves were.
            self.each(|_, _, _| true);
        }
        known(&self.sheet, self.changes.description(step).as_deref())
    }

    fn write(&mut self, mut out: String, put: &mut dyn FnMut(&str) -> bool) {
        out.push_str("wavelength_nm");
        let head = self.sheet.head();
        for piece in &self.pieces {
            out.push(',');
            push_name(&mut out, &format!("{}{head}", piece.name));
            if let Some(Stated { coverage, .. }) = piece.uncertainty {
                out.push(',');
                push_name(&mut out, &format!("{}{}", piece.name, self.sheet.head_of_uncertainty(coverage)));
            }
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
        notes.extend(self.changes.alike.then_some(Note::Alike));
        notes.extend((self.sheet.covariance.is_some() && self.covariance().is_none()).then_some(Note::NoCovariance));
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
    let stated = piece.uncertainty.as_ref();
    let with = |wavelengths: Cow<'p, [f64]>, values: Cow<'p, [f64]>, standard: Option<Cow<'p, [f64]>>| {
        let uncertainty = stated.zip(standard).map(|(of, standard)| Stated { standard, ..*of });
        Piece { name: Cow::Borrowed(""), wavelengths, values, uncertainty }
    };
    if changes.grid != Grid::Native {
        let wavelengths = within(rows, changes.grid.within(piece.range()));
        let values = changes.take(piece, content, wavelengths).into();
        let standard = stated.map(|of| changes.take_alike(piece, &of.standard, wavelengths).into());
        return with(wavelengths.to_vec().into(), values, standard);
    }
    let [Some(first), Some(last)] = [rows.first(), rows.last()] else {
        return with(Cow::default(), Cow::default(), Some(Cow::default()));
    };
    let from = piece.wavelengths.partition_point(|own| own < first);
    let own = from..piece.wavelengths.partition_point(|own| own <= last);
    let standard = stated.map(|of| of.standard[own.clone()].into());
    with(piece.wavelengths[own.clone()].into(), piece.values[own].into(), standard)
}

fn known(sheet: &Sheet<'_>, resampling: Option<&str>) -> Vec<(String, String)> {
    let (mut response, mut maker, mut camera) = (None, None, None);
    if let Content::Camera { per_photon, manufacturer, model, .. } = sheet.content {
        response = per_photon.map(|per_photon| if per_photon { "per photon" } else { "per energy" });
        (maker, camera) = (manufacturer, model);
    }
    let title = sheet.title();
    let own = [("title", Some(&*title)), ("manufacturer", maker), ("model", camera)];
    let own = own.into_iter().filter_map(|(key, value)| Some((key.to_owned(), one_line(value?).into_owned())));
    own.filter(|(_, value)| !value.is_empty()).chain(sheet.known(response, resampling)).collect()
}

fn covariance_text(of: &Covariance) -> String {
    let mut out = String::new();
    for row in of.values.chunks(of.size) {
        for (index, value) in row.iter().enumerate() {
            out.push_str(if index > 0 { "," } else { "" });
            push_number(&mut out, *value);
        }
        out.push('\n');
    }
    out
}

/// What stands in files beside a table.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Beside {
    /// What is known about the curves, unless it stands in the table.
    pub metadata: Option<Metadata>,
    /// Covariance of the samples, for the file whose name ends in [`crate::COVARIANCE`] in place of the table's ending.
    pub covariance: Option<String>,
}

/// What is known about the curves of a CSV file, for the file beside it whose name ends in [`Metadata::ENDING`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Metadata(Vec<(String, String)>);

impl From<Vec<(String, String)>> for Metadata {
    /// Keys, such as `title`, `source` and `license`, with their values.
    fn from(known: Vec<(String, String)>) -> Self {
        Self(known)
    }
}

impl Metadata {
    /// Ending of the file's name, after the whole name of the table.
    pub const ENDING: &'static str = METADATA[1];

    /// JSON in the vocabulary of CSV on the Web (W3C 2015), for the table in the file of this name: title and license, and the rest as
    /// its notes.
    pub fn text(&self, table: &str) -> String {
        const TERMS: [&str; 2] = ["title", "license"];
        let mut out = String::from("{\n");
        push_member(&mut out, 4, "@context", Some("http://www.w3.org/ns/csvw"));
        let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~".contains(&byte);
        let encode = |byte| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") };
        push_member(&mut out, 4, "url", Some(&table.bytes().map(encode).collect::<String>()));
        let (mut terms, mut rest) = ([Vec::new(), Vec::new()], Vec::new());
        for (key, value) in &self.0 {
            match TERMS.iter().position(|term| key.eq_ignore_ascii_case(term)) {
                Some(term) => terms[term].push(value.as_str()),
                None => rest.push((key, value)),
            }
        }
        for (term, values) in TERMS.iter().zip(terms).filter(|(_, values)| !values.is_empty()) {
            push_member(&mut out, 4, &format!("dc:{term}"), Some(&values.join("; ")));
        }
        let rest = rest.into_iter();
        push_list_of(
            &mut out,
            4,
            "notes",
            rest.map(|(key, value)| format!("{{ {}: {} }}", quoted(key), quoted(value))),
        );
        out.push_str("\n}\n");
        out
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
            let has_sample = piece.wavelengths.get(*next) == Some(&wavelength);
            if has_sample {
                push_number(out, piece.values[*next]);
            }
            if let Some(stated) = &piece.uncertainty {
                out.push(',');
                if has_sample {
                    push_number(out, expanded(stated.standard[*next], stated.coverage));
                }
            }
            *next += usize::from(has_sample);
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
