//! `identify`: raw RGB that a camera recorded of known patches, against tables of sensitivities.

mod report;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use chromascope_core::camera::chart_grid::ChartGrid;
use chromascope_core::camera::recorded::Freedom;
use chromascope_core::query::{Ask as _, RecordedSet, Shared};
use chromascope_core::spectral::{GridSpectrum, Quantity};
use clap::{ArgMatches, Args, ValueEnum};
use spectral_file::Values;

use super::arguments::{Form, Per, form, values};
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

const EXAMPLES: &str = "Examples:
  chromascope identify raw.csv --chart \"ColorChecker 24 (Ohta 1997)\" --illuminant D50
  chromascope identify measured.csv --illuminant lamp.csv --residuals residuals.csv
  chromascope identify radiances.csv --radiance --raw raw.csv --clip 4095 --format json
  chromascope identify --image chart.tif --corners 212,180 1840,195 1826,1290 220,1275 --chart colorchecker.csv --illuminant D50

FILE is a spectral table, one row a patch, with three more columns R, G, B of linear raw values; or the spectra alone with --raw; or,
with --chart, a table of R, G, B alone. Rows belong to spectra by the patches' names, or in order. Model: recorded = gain of the
channel × brightness of the patch × the integral of sensitivity, reflectance and light; fitted by least squares of the logarithm.
RMS is that of the remaining log error in percent; missing, zero, negative and clipped values are excluded and listed.
A rank is given as its 95 % range by a bootstrap over the patches. It is of tables: sensors of one maker or family often fit equally
well, so it does not prove a model.

Columns of --format csv: rank, rank_first, rank_last (95 % range), first_share (of the resamples with the smallest RMS), camera, rms_percent, deviation_percent (RMS over the degrees of freedom), rms_r_percent, rms_g_percent,
rms_b_percent, gain_r, gain_g, gain_b, values, parameters, worst_patch, worst_patch_percent, cause, cause_share (of the squares, to
first order). Columns of --residuals: camera, patch, channel, residual_percent (100 ln recorded / modeled), excluded.";

/// Cameras ranked by how well their sensitivities explain the raw RGB of known patches, by log error
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct IdentifyArguments {
    /// Spectra with raw RGB, spectra alone (with --raw or --image), or raw RGB alone (with --chart)
    #[arg(value_name = "FILE", required_unless_present = "image")]
    file: Option<PathBuf>,
    /// A table of raw RGB: columns patch, R, G, B
    #[arg(long, value_name = "FILE", conflicts_with = "image")]
    raw: Option<PathBuf>,
    /// A linear 16-bit TIFF or PNG of the chart
    #[arg(long, value_name = "FILE", requires = "corners")]
    image: Option<PathBuf>,
    /// Corners of the grid of patches in pixels, around the chart from the first patch: top left, top right, bottom right, bottom left
    #[arg(long, value_name = "x,y", num_args = 4, value_parser = corner, requires = "image")]
    corners: Vec<[f64; 2]>,
    /// Patches across and down the chart in the picture
    #[arg(long, value_name = "CxR", default_value = "6x4", value_parser = grid, requires = "image")]
    grid: [usize; 2],
    /// The patches' reflectances: a chart, or a file
    #[arg(long, value_name = "NAME|FILE")]
    chart: Option<OsString>,
    /// The light that the patches were recorded under: a name, a file with one curve, `daylight:K` or `blackbody:K`
    #[arg(long, value_name = "NAME|FILE", required_unless_present = "radiance", conflicts_with = "radiance")]
    illuminant: Option<OsString>,
    /// A filter in front of the light: a name, or a file with a transmittance; may be repeated
    #[arg(long, value_name = "NAME|FILE", conflicts_with = "radiance")]
    filter: Vec<OsString>,
    /// The file's spectra are radiances, not reflectances: there is no light to name
    #[arg(long, conflicts_with = "chart", requires = "file")]
    radiance: bool,
    /// Scale of the values in a file of reflectances that does not state it
    #[arg(long, value_name = "VALUES", value_parser = values())]
    values: Option<Values>,
    /// A camera, or a file with three sensitivities; may be repeated [default: all of the library]
    #[arg(long, value_name = "NAME|FILE")]
    camera: Vec<OsString>,
    /// Unit of the sensitivities in camera files, overriding the files: response per energy or per photon
    #[arg(long, value_enum, value_name = "UNIT", requires = "camera")]
    per: Option<Per>,
    /// Raw value of no light, subtracted
    #[arg(long, value_name = "LEVEL", default_value_t = 0.0, allow_hyphen_values = true)]
    black: f64,
    /// Raw value from which on a channel is clipped [default: none; 65535 in pictures]
    #[arg(long, value_name = "LEVEL")]
    clip: Option<f64>,
    /// Holds parameters of the model: one gain for all channels, brightness 1 for all patches
    #[arg(long, value_enum, value_delimiter = ',', value_name = "WHAT")]
    hold: Vec<Held>,
    /// Format of the ranking
    #[arg(long, value_parser = form(FORMS), default_value = "table")]
    format: Form,
    /// Output file of the ranking [default: standard output, also `-`]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Writes all residuals as CSV
    #[arg(long, value_name = "FILE")]
    residuals: Option<PathBuf>,
    /// Overwrites existing files
    #[arg(long)]
    force: bool,
}

/// A parameter that is not fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Held {
    /// One gain for all channels
    Gains,
    /// Brightness 1 for all patches
    Brightness,
}

const FORMS: [&str; 3] = [
    "Aligned columns, then the best camera's residuals",
    "Comma-separated values",
    "JSON with gains, brightnesses and residuals",
];

fn corner(text: &str) -> Result<[f64; 2], String> {
    let wrong = || format!("\"{text}\" is not a corner; write x,y in pixels, such as 212,180.5");
    let (x, y) = text.split_once(',').ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(wrong);
    Ok([number(x)?, number(y)?])
}

fn grid(text: &str) -> Result<[usize; 2], String> {
    let wrong = || format!("\"{text}\" is not a grid; write patches across and down, such as 6x4");
    let (columns, rows) = text.split_once(['x', 'X', '×']).ok_or_else(wrong)?;
    let count = |text: &str| text.trim().parse::<usize>().ok().filter(|n| (1..=100).contains(n)).ok_or_else(wrong);
    Ok([count(columns)?, count(rows)?])
}

/// Spectra by the names of their patches.
type Spectra = Vec<(String, GridSpectrum)>;

pub(super) fn run(arguments: &IdentifyArguments, _: &ArgMatches) -> Result<(), CliError> {
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
        Form::Table => report::table(&recorded, &ranked),
        Form::Csv => report::csv(&recorded, &ranked),
        Form::Json => shown_json(&report::json(&recorded, &ranked, freedom)).into_owned(),
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
