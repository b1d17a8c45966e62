//! Reading of a file, from its bytes to its curves.

use crate::beside::{self, Source};
use crate::decision::{Certainty, Decided, Decision, Encoding, Part, WavelengthUnit};
use crate::error::{MAX_DROPPED, ReadError};
use crate::formats::spectra::Found;
use crate::grid::Grid;
use crate::options::ReadOptions;
use crate::preview::Marker;
use crate::report::{ReadReport, SpectralFile, Steps};
use crate::warning::Warning;
use crate::watch::{Log, Places, Watch};
use crate::{covariance, formats, no_curve, quantity, scale, text, uncertainty, wavelengths};

/// Files up to this size are read again to find what an error is due to.
const LONGEST: usize = 1 << 20;

/// The error, with the chosen setting without which there would be none, if there is one.
fn blame(source: Source<'_>, options: &ReadOptions, error: ReadError, watch: Watch<'_>) -> ReadError {
    let own = matches!(
        error,
        ReadError::Stopped
            | ReadError::TooLarge { .. }
            | ReadError::Binary(..)
            | ReadError::Empty
            | ReadError::NoSuchPart { .. }
            | ReadError::OtherLayout(..)
            | ReadError::NotWavelengthColumn { .. }
    );
    if own || source.bytes.len() > LONGEST {
        return error;
    }
    for (switch, without) in options.switches() {
        match read_text(source, &without, watch, false) {
            Ok(_) => return ReadError::AsChosen { switch, error: Box::new(error) },
            Err(ReadError::Stopped) => return ReadError::Stopped,
            Err(_) => {}
        }
    }
    error
}

/// Reads the bytes of a file as spectral curves. What stands beside them is looked at where they do not say what the curves are.
///
/// Deterministic: equal sources and options give equal results.
///
/// # Errors
/// The reason why the file could not be read, with line, column and remedy.
pub fn read<'a>(source: impl Into<Source<'a>>, options: &ReadOptions) -> Result<SpectralFile, ReadError> {
    read_watched(source, options, Watch::none())
}

/// [`read`] with progress reports, which can stop it.
///
/// A reading that was stopped ends in [`ReadError::Stopped`], within some milliseconds.
///
/// # Errors
/// Those of [`read`], and [`ReadError::Stopped`].
pub fn read_watched<'a>(
    source: impl Into<Source<'a>>,
    options: &ReadOptions,
    watch: Watch<'_>,
) -> Result<SpectralFile, ReadError> {
    let source = source.into();
    let found = read_by_order(source, options, watch, false).map(|(file, _)| file);
    found.map_err(|error| blame(source, options, error, watch))
}

/// [`read_watched`], with a record of where in the text each sample stands, for a [`crate::Preview`].
///
/// Takes somewhat longer, and up to 24 bytes for each sample of formats other than tables.
///
/// # Errors
/// Those of [`read_watched`].
pub fn read_marked<'a>(
    source: impl Into<Source<'a>>,
    options: &ReadOptions,
    watch: Watch<'_>,
) -> Result<(SpectralFile, Marker), ReadError> {
    let source = source.into();
    let found = read_by_order(source, options, watch, true)
        .and_then(|(file, marker)| Ok((file, marker.ok_or(ReadError::Empty)?)));
    found.map_err(|error| blame(source, options, error, watch))
}

/// Reads with the wavelengths in the column whose numbers are in order where those of the first cannot be wavelengths.
fn read_by_order(
    source: Source<'_>,
    options: &ReadOptions,
    watch: Watch<'_>,
    marked: bool,
) -> Result<(SpectralFile, Option<Marker>), ReadError> {
    let found = read_text(source, options, watch, marked);
    let Err(ReadError::OtherWavelengthColumn { column, .. }) = found else { return found };
    let other = ReadOptions { wavelength_column: Some(column), ..options.clone() };
    let Ok((mut file, marker)) = read_text(source, &other, watch, marked) else { return found };
    // Names would say which are wavelengths.
    if file.reading.header_line.is_some() {
        return found;
    }
    file.warnings.insert(0, Warning::UnnamedWavelengths(column));
    Ok((file, marker))
}

/// Reads without a second look at what an error is due to.
fn read_text(
    source: Source<'_>,
    options: &ReadOptions,
    watch: Watch<'_>,
    marked: bool,
) -> Result<(SpectralFile, Option<Marker>), ReadError> {
    let (text, encoding) = text::decode(source.bytes)?;
    let mut log = Log::new(watch, text.len());
    log.places = marked.then(|| Places::new(&text));
    log.look(0)?;
    let mut found = formats::read(&text, options, &mut log)?;
    log.look(text.len())?;
    beside::take(source, &mut found.grid);
    scale::doubt_absorbances(&mut found.grid);
    finish(found, encoding, options, source.covariance, log)
}

/// Refuses fewer than two samples, and numbers beyond all that 64 bits hold.
fn check(grid: &Grid, first_line: usize) -> Result<(), ReadError> {
    if grid.wavelengths.len() < 2 {
        return Err(ReadError::TooFewSamples(grid.line(0).max(first_line)));
    }
    let infinite = |values: &[f64]| values.iter().position(|value| value.is_infinite());
    let at = grid.curves.iter().find_map(|curve| infinite(&curve.values));
    at.map_or(Ok(()), |at| Err(ReadError::TooGreat(grid.line(at))))
}

/// Takes the columns that are no curves from them, unless they are requested. A file's only part counts its curves alone.
fn take_columns_beside(grid: &mut Grid, parts: &mut [Part], options: &ReadOptions, log: &mut Log<'_>) {
    if options.raw == Some(true) {
        return;
    }
    no_curve::leave_out(grid, log);
    uncertainty::take(grid, log);
    if let [only] = parts {
        let uncertain = grid.curves.iter().filter(|curve| curve.uncertainty.is_some()).count();
        only.curves = only.curves.saturating_sub(uncertain);
    }
}

/// Warns of a guessed unit whose numbers may be nanometers.
fn warn_of_unit(unit: &Decided<WavelengthUnit>, warnings: &mut Log<'_>) {
    match (unit.value, unit.certainty) {
        (WavelengthUnit::Wavenumber, Certainty::Guess) => warnings.push(Warning::MaybeWavelengths),
        (WavelengthUnit::Angstrom, Certainty::Guess) => warnings.push(Warning::MaybeNanometers),
        _ => {}
    }
}

/// Stages that all readers share: units, order, role, scale, curves.
fn finish(
    found: Found,
    encoding: Encoding,
    options: &ReadOptions,
    covariance: &[u8],
    mut warnings: Log<'_>,
) -> Result<(SpectralFile, Option<Marker>), ReadError> {
    let Found { mut grid, layout, reader, mut notes } = found;
    check(&grid, layout.first_line)?;
    let (mut parts, part) = grid.settle_parts(options.part, layout.first_line)?;
    let wavelength_unit = wavelengths::unit(&grid, options)?;
    wavelengths::to_nanometers(&mut grid, &wavelength_unit, &mut warnings)?;
    warn_of_unit(&wavelength_unit, &mut warnings);
    warnings.look(usize::MAX)?;
    no_curve::take_sentinels(&mut grid, &mut warnings);
    let descending = wavelengths::sort(&mut grid, &wavelength_unit, &mut warnings)?;
    let (range_nm, step_nm) = (grid.range_nm(), Steps::of(&grid.wavelengths));
    wavelengths::warn(&grid, step_nm, wavelength_unit.value, &mut warnings);
    warnings.look(usize::MAX)?;
    quantity::suggest_role(&mut grid);
    take_columns_beside(&mut grid, &mut parts, options, &mut warnings);
    no_curve::leave_out_blank(&mut grid, &mut warnings);
    no_curve::warn_of_strangers(&grid, &mut warnings);
    covariance::prepare(covariance, &mut grid);
    let scale = scale::decide(&grid, options, &mut warnings);
    let quantity = quantity::decide(&grid, &scale.role, &mut warnings);
    let per_photon = quantity::per_photon(&grid, scale.role.value, &quantity);
    notes.extend(uncertainty::settle(&mut grid, scale.role.value, &scale.columns, &mut warnings));
    scale::convert(&mut grid, &scale);
    notes.extend(quantity::to_energy(&mut grid, scale.role.value, &wavelength_unit, options));
    scale::warn(&scale, &grid, &mut warnings);
    let marker = |places| Marker::new(places, &grid, &layout, reader.value, wavelength_unit.value);
    let mut marker = warnings.places.take().map(marker);
    let mut decimal_mark = layout.decimal_mark;
    if scale.denies_thousands() && warnings.drop_doubt_of_thousands() {
        decimal_mark.certainty = Certainty::Certain;
    }
    warnings.look(usize::MAX)?;
    let medium = |(line, medium)| Decision::certain("Medium", medium, format!("Line {line} says so"));
    notes.extend(grid.header.medium.map(medium));
    let (rows, wavelength_column) = (grid.rows, grid.wavelength_column);
    let order = [grid.own_wavelengths || !grid.dropped.is_empty() || warnings.has_sorted(), descending];
    let (header, mut dropped_rows) = (std::mem::take(&mut grid.header), std::mem::take(&mut grid.dropped));
    dropped_rows.truncate(MAX_DROPPED);
    let (mut curves, origins, slopes) = grid.into_curves(&mut warnings);
    if curves.is_empty() {
        return Err(ReadError::TooFewSamples(layout.first_line));
    }
    let covariance = covariance::take(covariance, &mut curves, &slopes, order, &mut notes, &mut warnings);
    if let Some(marker) = &mut marker {
        marker.take_curves(&origins);
    }
    let reading = ReadReport {
        reader,
        encoding,
        delimiter: layout.delimiter,
        decimal_mark,
        thousands: layout.thousands,
        orientation: layout.orientation,
        wavelength_unit,
        values: scale.values,
        wavelength_column,
        content_role: scale.content,
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
        camera_columns: scale::camera_columns(scale.role.value, &curves),
    };
    Ok((SpectralFile { curves, covariance, role: scale.role, reading, warnings: warnings.warnings }, marker))
}
