//! `identify`: raw RGB that a camera recorded of known patches, against tables of sensitivities.

pub(super) mod arguments;
mod report;

use std::path::Path;

use chromascope_core::camera::chart_grid::ChartGrid;
use chromascope_core::camera::recorded::Freedom;
use chromascope_core::query::{Ask as _, RecordedSet, Shared};
use chromascope_core::spectral::{GridSpectrum, Quantity};

use self::arguments::{Format, Held, IdentifyArguments};
use super::error::CliError;
use super::outputs::{self, put};
use super::request::{Request, display_path};
use crate::catalog::chart_picture::ChartPicture;
use crate::catalog::recorded::{self, Levels, RawRow, RawTable, lit};
use crate::document::imported::Role;
use crate::document::start::Start;
use crate::results::Results;
use crate::scene::Scene;
use crate::terminal::shown_json;

/// Spectra by the names of their patches.
type Spectra = Vec<(String, GridSpectrum)>;

/// Ranks the cameras and writes the result.
pub(super) fn run(arguments: &IdentifyArguments) -> Result<(), CliError> {
    let mut request = Request::of_cameras(Start::Colorimetry, "--camera", &arguments.camera, arguments.per)?;
    request.values = arguments.values;
    let levels = levels(arguments)?;
    let recorded = recorded_set(&mut request, arguments, levels)?;
    let freedom = Freedom {
        gains: !arguments.hold.contains(&Held::Gains),
        brightness: !arguments.hold.contains(&Held::Brightness),
    };
    let files = arguments.out.as_deref().into_iter().chain(arguments.residuals.as_deref());
    outputs::check(files, &request.inputs(), arguments.force)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let names: Vec<String> = request.sources.iter().map(|(_, name)| name.clone()).collect();
    let ranked = (*results.ask(&scene.recorded_ranking(&recorded, freedom, &names)?)).clone()?;
    if let Some(Err(why)) = ranked.first().map(|camera| &camera.fit) {
        return Err(CliError::File(format!("{}: {why}", file_of(arguments))));
    }
    let text = match arguments.format {
        Format::Table => report::table(&recorded, &ranked),
        Format::Csv => report::csv(&recorded, &ranked),
        Format::Json => shown_json(&report::json(&recorded, &ranked, freedom)).into_owned(),
    };
    if let Some(path) = &arguments.residuals {
        put(&report::residuals(&recorded, &ranked), Some(path))?;
    }
    put(&text, arguments.out.as_deref())
}

/// File that recorded values came from, for people.
fn file_of(arguments: &IdentifyArguments) -> String {
    let file = arguments.image.as_ref().or(arguments.raw.as_ref()).or(arguments.file.as_ref());
    file.map_or_else(String::new, |path| display_path(path))
}

fn levels(arguments: &IdentifyArguments) -> Result<Levels, CliError> {
    let levels = Levels { black: arguments.black, clip: arguments.clip.unwrap_or(f64::INFINITY) };
    if levels.black.is_finite() && levels.clip > levels.black {
        return Ok(levels);
    }
    let reason = format!("{} is not above the black level {}", levels.clip, levels.black);
    Err(CliError::Argument { argument: "--clip", reason })
}

/// The patches with their spectra and raw values.
fn recorded_set(request: &mut Request, arguments: &IdentifyArguments, levels: Levels) -> Result<RecordedSet, CliError> {
    if let Some(light) = &arguments.illuminant {
        request.set_light(light)?;
    }
    request.set_filters(&arguments.filter)?;
    let own = arguments.image.is_some() || arguments.raw.is_some();
    let (spectra, rows) = match (&arguments.chart, &arguments.file) {
        (Some(_), Some(file)) if own => {
            let reason =
                format!("spectra come from --chart and raw values from elsewhere; leave out {}", display_path(file));
            return Err(CliError::Argument { argument: "FILE", reason });
        }
        (Some(chart), file) => {
            request.set_chart(Some(chart))?;
            let rows = file.as_deref().map(|file| raw_rows(request, file)).transpose()?;
            (chart_spectra(request)?, rows)
        }
        (None, Some(file)) if own => (file_spectra(request, file, None, arguments.radiance)?, None),
        (None, Some(file)) => {
            let table = raw_table(request, file)?;
            let Some(text) = &table.spectra else {
                let why = "raw values without spectra; add --chart NAME|FILE, or columns headed by wavelengths";
                return Err(CliError::File(format!("{}: {why}", display_path(file))));
            };
            (file_spectra(request, file, Some(text), arguments.radiance)?, Some(table.rows))
        }
        (None, None) => {
            let reason = "name the patches' reflectances, a chart or a file".to_owned();
            return Err(CliError::Argument { argument: "--chart", reason });
        }
    };
    let rows = match (rows, &arguments.raw, &arguments.image) {
        (Some(rows), ..) => rows,
        (None, Some(raw), _) => raw_rows(request, raw)?,
        (None, None, Some(image)) => picture_rows(request, arguments, image, levels)?,
        (None, None, None) => {
            let reason = "name a table of raw values, or a picture with --image".to_owned();
            return Err(CliError::Argument { argument: "--raw", reason });
        }
    };
    let joined = recorded::join(&spectra, &rows, levels);
    joined.map(Shared::new).map_err(|error| CliError::File(format!("{}: {error}", file_of(arguments))))
}

/// Patches of one table with their raw values: its own spectra, else those of the chart, under the light.
pub(super) fn recorded_table(request: &mut Request, path: &Path) -> Result<RecordedSet, CliError> {
    let RawTable { spectra, rows, .. } = raw_table(request, path)?;
    let spectra = match spectra {
        Some(text) => file_spectra(request, path, Some(&text), false)?,
        None => chart_spectra(request)?,
    };
    let joined = recorded::join(&spectra, &rows, Levels { black: 0.0, clip: f64::INFINITY });
    joined.map(Shared::new).map_err(|error| CliError::File(format!("{}: {error}", display_path(path))))
}

fn raw_table(request: &mut Request, path: &Path) -> Result<RawTable, CliError> {
    let bytes = request.bytes(path)?;
    recorded::read_table(&bytes).map_err(|error| CliError::File(format!("{}: {error}", display_path(path))))
}

/// Raw values of a table that has nothing else.
fn raw_rows(request: &mut Request, path: &Path) -> Result<Vec<RawRow>, CliError> {
    let table = raw_table(request, path)?;
    if table.spectra.is_none() {
        return Ok(table.rows);
    }
    let why = "spectra beside the raw values, but they are taken from elsewhere; leave out --chart or --raw";
    Err(CliError::File(format!("{}: {why}", display_path(path))))
}

/// Means of the patches in a picture.
fn picture_rows(
    request: &mut Request,
    arguments: &IdentifyArguments,
    path: &Path,
    levels: Levels,
) -> Result<Vec<RawRow>, CliError> {
    let bytes = request.bytes(path)?;
    let said = |error: &dyn std::fmt::Display| CliError::File(format!("{}: {error}", display_path(path)));
    let corners = <[[f64; 2]; 4]>::try_from(arguments.corners.as_slice())
        .map_err(|_| CliError::Argument { argument: "--corners", reason: "expected four corners".to_owned() })?;
    let [columns, rows] = arguments.grid;
    let grid = ChartGrid::new(corners, columns, rows).map_err(|error| said(&error))?;
    let picture = ChartPicture::decode(&bytes).map_err(|error| said(&error))?;
    picture.rows(&grid, levels).map_err(|error| said(&error))
}

/// Radiances of the chart under the light.
fn chart_spectra(request: &Request) -> Result<Spectra, CliError> {
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    Ok(scene.patch_radiances()?)
}

/// Radiances of a file's spectra: as they are, or reflectances under the light.
fn file_spectra(request: &mut Request, path: &Path, text: Option<&str>, radiance: bool) -> Result<Spectra, CliError> {
    let role = if radiance { Role::Illuminant } else { Role::Reflectance };
    let set = match text {
        Some(text) => request.read_bytes(path, text.as_bytes(), role)?,
        None => request.read(path, role)?,
    };
    let curves = set.curves_in_nm().map_err(|error| CliError::File(format!("{}: {error}", display_path(path))))?;
    if radiance {
        let on_grid = |(name, curve)| (name, GridSpectrum::resample(&curve, Quantity::Light));
        return Ok(curves.into_iter().map(on_grid).collect());
    }
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let light = scene.light()?;
    let on_grid = |(name, curve)| (name, lit(&GridSpectrum::resample(&curve, Quantity::Reflectance), &light.grid));
    Ok(curves.into_iter().map(on_grid).collect())
}
