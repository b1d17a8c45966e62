//! Spectral tables from text: bytes in, curves with units and provenance out.
//!
//! [`read`] takes the bytes of a file and returns [`Table`]: curves over wavelength in nanometers, the [`Role`] they
//! seem to play, and a [`Reading`] that tells what was decided on the way and how sure each decision is. Anything
//! decided can be overruled through [`ReadOptions`] by reading again.
//!
//! What is read: numbers in columns (wavelengths down the first column, or across a header row), separated by commas,
//! semicolons, tabs or spaces; points or commas as decimal marks; UTF-8, UTF-16, Shift-JIS or Windows-1252; any line ends;
//! comments (`# key: value`), headers, units in headers, gaps (`NaN`, `---`, empty, −999 and its kin where they stand out), any
//! order of wavelengths.
//!
//! Lights counted in photons (µmol m⁻² s⁻¹ nm⁻¹), per frequency or per wave number become energies per nanometer, as the decision
//! "Spectral unit" says with the factor.
//!
//! Families with a grammar of their own are recognized by content and read too: CGATS (Argyll, X-Rite), JCAMP-DX, XML
//! (TM-27, `CxF`), JSON (rawtoaces, dcamprof with comments, Wasatch ENLIGHTEN), lamp meters that write wavelengths into labels, and files
//! that put wavelengths and values on alternate lines.
//!
//! What is not read: binary files, and XML or JSON of other layouts. They are named in the error, with what helps.
//!
//! Reading is total: it does not panic, takes time proportional to the input, and needs a few times its memory, most of it
//! the samples themselves (16 bytes each). The limits are [`MAX_BYTES`], [`MAX_CURVES`] and [`MAX_SAMPLES`].
//!
//! ```
//! use spectral_file::{read, ReadOptions, Role};
//!
//! let leaf = read("nm;Reflectance (%)\n400;5,5\n410;6,0\n".as_bytes(), &ReadOptions::default())?;
//! assert_eq!(leaf.role.value, Role::Reflectance);
//! assert_eq!(leaf.curves[0].wavelengths_nm, [400.0, 410.0]);
//! assert_eq!(leaf.curves[0].values, [0.055, 0.06]);
//! # Ok::<(), spectral_file::ReadError>(())
//! ```
//!
//! The way of a file: `text` (bytes to text), `families` (who takes it), for numbers in columns `sniff` (which
//! separators, where the numbers begin), `header` (names, units, comments), `columns` or `wide` (text to numbers), then
//! `wavelengths` (unit, order, repeats), `gaps`, `scale` (role, percent), `quantity`, `photons`, and here the curves. A reader for another family of
//! files is a small file in `families`: it fills the same `Grid`, and all after it is shared.

mod bands;
mod clues;
mod columns;
mod companions;
mod decimal;
mod dialect;
mod error;
mod families;
mod family;
mod gaps;
mod grid;
mod header;
mod instrument;
mod nearly;
mod photons;
mod places;
mod preview;
mod quantity;
mod raw;
mod reading;
mod scale;
mod sniff;
mod switch;
mod text;
mod thousands;
mod trial;
mod units;
mod warning;
mod watch;
mod wavelengths;
mod wide;
mod words;
pub mod write;

use serde::{Deserialize, Serialize};

pub use chromascope_text::{guarded, on_one_line, turns_text};
pub use dialect::{DecimalMark, Delimiter};
pub use error::ReadError;
pub use family::Family;
pub use nearly::Nearly;
use places::Places;
pub use preview::{LONGEST_LINE, LeftOut, Mark, Marker, Preview, Shown, What};
pub use quantity::Quantity;
pub use reading::{
    Certainty, Decided, Decision, Dropped, DroppedRow, Encoding, Medium, Orientation, Part, Reader, Reading, Steps,
};
pub use scale::{Role, Values};
pub use switch::Switch;
pub use text::{BinaryKind, MAX_BYTES};
pub use warning::{LineList, Sentinel, Warning};
use watch::Log;
pub use watch::Watch;
pub use wavelengths::WavelengthUnit;

/// The most curves one table may hold.
pub const MAX_CURVES: usize = 100_000;

/// Dropped rows that are listed; nobody reads more.
const MAX_DROPPED: usize = 1000;

/// The most samples (curves times wavelengths) one table may hold.
pub const MAX_SAMPLES: usize = 20_000_000;

/// What the caller fixes before reading; `None` leaves the decision to the content.
///
/// The default decides everything from the content.
#[derive(Debug, Clone, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(default)]
pub struct ReadOptions {
    /// What stands between two cells.
    pub delimiter: Option<Delimiter>,
    /// What stands before the fraction of a number.
    pub decimal_mark: Option<DecimalMark>,
    /// Whether wavelengths run down a column or across a row.
    pub orientation: Option<Orientation>,
    /// The unit of the wavelengths as written.
    pub wavelength_unit: Option<WavelengthUnit>,
    /// The column of the wavelengths, from 1, where they run down one.
    pub wavelength_column: Option<usize>,
    /// What the values stand for. Left open, only reflectances and transmittances are scaled. [`Values::Plain`] keeps lights in
    /// photons or per frequency as they are written, too.
    pub values: Option<Values>,
    /// Which of several tables, blocks or groups in one file is taken, from 1 in the order of the file.
    pub part: Option<usize>,
    /// What the curves are.
    pub role: Option<Role>,
    /// Which reader takes the file; [`Reader::Table`] reads numbers in columns whatever stands around them.
    pub reader: Option<Reader>,
    /// Whether raw curves (dark, reference and sample counts) and what is recorded beside spectra (temperatures, times) are
    /// kept; together with a chosen wavelength column, every other column.
    pub raw: Option<bool>,
}

/// One curve: values over wavelength, in the order of wavelength.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The name from the header, the title of the file, or `Column 2` and `Row 1`.
    pub name: String,
    /// Whether the name is from the file; where it is not, the name of the file may say more.
    pub named: bool,
    /// Wavelengths in nanometers: finite, strictly ascending, at least two.
    pub wavelengths_nm: Vec<f64>,
    /// Values, one for each wavelength: finite; percent are already divided by 100.
    pub values: Vec<f64>,
    /// How many wavelengths of the table have no value in this curve. They are left out, not filled.
    pub missing: usize,
    /// The unit of the values as the file names it, such as `W/m²/nm` or `counts`.
    pub unit: Option<String>,
}

/// What a file was understood to hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// The curves, in the order of the file; at least one.
    pub curves: Vec<Curve>,
    /// What the curves are.
    pub role: Decided<Role>,
    /// How the bytes were understood.
    pub reading: Reading,
    /// What should be looked at before the curves are trusted.
    pub warnings: Vec<Warning>,
}

impl Table {
    /// Every decision made on reading, the role first, ready to be listed for a person.
    pub fn decisions(&self) -> Vec<Decision> {
        let mut all = vec![Decision::new("Role", &self.role)];
        all.extend(self.reading.decisions());
        all
    }
}

/// Reads the bytes of a file as spectral curves.
///
/// The same bytes and options always give the same table. Nothing is decided by a file name.
pub fn read(bytes: &[u8], options: &ReadOptions) -> Result<Table, ReadError> {
    read_watched(bytes, options, Watch::none())
}

/// [`read`], with somebody who sees how far it is and can stop it.
///
/// A reading that was stopped ends in [`ReadError::Stopped`], within some milliseconds.
pub fn read_watched(bytes: &[u8], options: &ReadOptions, watch: Watch<'_>) -> Result<Table, ReadError> {
    read_once(bytes, options, watch).map_err(|error| switch::blame(bytes, options, error, watch))
}

/// [`read_watched`], with a record of where in the text each sample stands, for a [`Preview`].
///
/// Takes somewhat longer, and up to 24 bytes for each sample of formats other than tables.
///
/// # Errors
/// Those of [`read_watched`].
pub fn read_marked(bytes: &[u8], options: &ReadOptions, watch: Watch<'_>) -> Result<(Table, Marker), ReadError> {
    let found =
        read_text(bytes, options, watch, true).and_then(|(file, marker)| Ok((file, marker.ok_or(ReadError::Empty)?)));
    found.map_err(|error| switch::blame(bytes, options, error, watch))
}

/// [`read_watched`], without a second look at what an error is due to.
fn read_once(bytes: &[u8], options: &ReadOptions, watch: Watch<'_>) -> Result<Table, ReadError> {
    read_text(bytes, options, watch, false).map(|(file, _)| file)
}

fn read_text(
    bytes: &[u8],
    options: &ReadOptions,
    watch: Watch<'_>,
    marked: bool,
) -> Result<(Table, Option<Marker>), ReadError> {
    let (text, encoding) = text::decode(bytes)?;
    let mut log = Log::new(watch, text.len());
    log.places = marked.then(|| Places::new(&text));
    log.look(0)?;
    let found = families::read(&text, options, &mut log)?;
    log.look(text.len())?;
    finish(found, encoding, options, log)
}

/// What all readers share: units, order, role, scale, curves.
fn finish(
    found: families::Found,
    encoding: Encoding,
    options: &ReadOptions,
    mut warnings: Log<'_>,
) -> Result<(Table, Option<Marker>), ReadError> {
    let families::Found { mut grid, layout, reader, mut notes } = found;
    if grid.wavelengths.len() < 2 {
        return Err(ReadError::TooFewSamples { line: grid.line(0).max(layout.first_line) });
    }
    let (parts, part) = grid.settle_parts(options.part, layout.first_line)?;
    let wavelength_unit = wavelengths::unit(&grid, options)?;
    wavelengths::to_nanometers(&mut grid, wavelength_unit.value)?;
    if (wavelength_unit.value, wavelength_unit.certainty) == (WavelengthUnit::Wavenumber, Certainty::Guess) {
        warnings.push(Warning::MaybeWavelengths);
    }
    warnings.look(usize::MAX)?;
    let descending = wavelengths::sort(&mut grid, &mut warnings);
    let range_nm = [grid.wavelengths[0], grid.wavelengths[grid.wavelengths.len() - 1]];
    let step_nm = Steps::of(&grid.wavelengths);
    wavelengths::warn(&grid, step_nm, &mut warnings);
    warnings.look(usize::MAX)?;
    gaps::take(&mut grid, &mut warnings);
    photons::suggest_role(&mut grid);
    if options.raw != Some(true) {
        companions::leave_out(&mut grid, &mut warnings);
    }
    let scale = scale::decide(&grid, options, &mut warnings);
    let quantity = quantity::decide(&grid, &scale.role, &mut warnings);
    let per_photon = quantity::per_photon(&grid, scale.role.value, &quantity);
    scale::convert(&mut grid, &scale);
    notes.extend(photons::to_energy(&mut grid, scale.role.value, &wavelength_unit, options));
    scale::warn(&scale, &grid, &mut warnings);
    let places = warnings.places.take();
    let mut marker = places.map(|places| Marker::new(places, &grid, &layout, reader.value, wavelength_unit.value));
    let mut decimal_mark = layout.decimal_mark;
    if scale.denies_thousands() && warnings.warnings.contains(&Warning::MaybeThousands) {
        warnings.warnings.retain(|warning| *warning != Warning::MaybeThousands);
        decimal_mark.certainty = Certainty::Certain;
    }
    warnings.look(usize::MAX)?;
    if let Some((line, medium)) = grid.header.medium {
        notes.push(Decision::new("Medium", &Decided::certain(medium, format!("Line {line} says so"))));
    }
    let (rows, grid_column) = (grid.rows, grid.wavelength_column);
    let header = std::mem::take(&mut grid.header);
    let mut dropped_rows = std::mem::take(&mut grid.dropped);
    dropped_rows.truncate(MAX_DROPPED);
    let (curves, origins) = grid.into_curves(&mut warnings);
    if curves.is_empty() {
        return Err(ReadError::TooFewSamples { line: layout.first_line });
    }
    if let Some(marker) = &mut marker {
        marker.take_curves(&origins);
    }
    let camera_columns = scale::camera_columns(scale.role.value, &curves);
    let reading = Reading {
        reader,
        encoding,
        delimiter: layout.delimiter,
        decimal_mark,
        thousands: layout.thousands,
        orientation: layout.orientation,
        wavelength_unit,
        values: scale.values,
        wavelength_column: grid_column,
        quantity,
        per_photon,
        parts,
        part,
        notes,
        header: header.comments,
        header_line: header.line,
        first_data_line: layout.first_line,
        rows,
        dropped_rows,
        descending,
        range_nm,
        step_nm,
        camera_columns,
    };
    Ok((Table { curves, role: scale.role, reading, warnings: warnings.warnings }, marker))
}
