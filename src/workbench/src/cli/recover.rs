//! `recover`: spectral sensitivities of a camera from what it recorded of a chart, or of narrow bands.

mod chart;
mod narrow_band;

use std::path::{Path, PathBuf};

use chromascope_core::query::Ask as _;
use chromascope_core::recovery::{Library, RecoveredCurves};
use clap::{ArgMatches, Args, Subcommand};
use spectral_file::write::{Content, Format, Grid, Prepared, Sheet, Trace, write};
use spectral_file::{Covariance, Uncertainty};

use super::error::{CliError, Result, refused};
use super::inspect::written;
use super::request::Request;
use crate::catalog::load::SensorQuery;
use crate::document::SetKind;
use crate::export::spectra::maker_and_model;
use crate::results::Results;

const EXAMPLES: &str = "Examples:
  chromascope recover chart day.csv --chart \"ColorChecker 24 (BabelColor average)\" --illuminant D65 --out camera.csv
  chromascope recover chart day.csv lamp.csv --chart mine.csv --illuminant daylight --illuminant A --clip 16000
  chromascope recover narrowband pass1.csv pass2.csv --clip 16384 --out camera.json

--out writes the curves with their expanded uncertainties (k = 2) and NAME.cov.csv, or with the ending .json rawtoaces JSON without
uncertainties. The table opens as any other camera: every metric's ± is then its own.";

/// Spectral sensitivities of a camera, with uncertainties, from raw values of a chart or of narrow bands
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct RecoverArguments {
    #[command(subcommand)]
    from: From,
}

#[derive(Debug, Subcommand)]
enum From {
    /// From raw values of a chart's patches: good for color, a guess in detail
    Chart(chart::ChartArguments),
    /// From raw means of narrow bands of known power
    Narrowband(narrow_band::NarrowBandArguments),
}

#[derive(Debug, Args)]
struct Written {
    /// Name of the camera in the file
    #[arg(long, value_name = "NAME", default_value = "Recovered camera")]
    title: String,
    /// Output file of the curves, .csv or .json
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrites existing files
    #[arg(long)]
    force: bool,
}

pub(super) fn run(arguments: &RecoverArguments, _: &ArgMatches) -> Result<()> {
    match &arguments.from {
        From::Chart(arguments) => chart::run(arguments),
        From::Narrowband(arguments) => narrow_band::run(arguments),
    }
}

/// Cameras that are built in, at some wavelengths.
fn library(request: &Request, wavelengths_nm: &[f64]) -> Result<Library> {
    let results = Results::default();
    let mut tables = Vec::new();
    for entry in request.catalog.of_kind(SetKind::Camera) {
        let sensor = (*results.ask(&SensorQuery(entry.place.clone()))).clone();
        let sensor = sensor.map_err(|error| CliError::File(format!("{}: {error}", entry.name)))?;
        tables.push((entry.name.clone(), (*sensor).clone()));
    }
    Ok(Library::new(tables, wavelengths_nm))
}

fn format(path: &Path) -> Result<Format> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("json") => Ok(Format::RawtoacesJson),
        Some("csv") => Ok(Format::Csv),
        _ => refused("--out", "name a file that ends in .csv or .json"),
    }
}

/// Writes the curves where they are wanted.
fn put(curves: &RecoveredCurves, wanted: &Written, comments: &[(String, String)]) -> Result<()> {
    let Some(path) = &wanted.out else { return Ok(()) };
    let format = format(path)?;
    let standard = curves.standard().map(|standard| Uncertainty { standard, coverage: 2.0 });
    let covariance = Covariance { size: 3 * curves.wavelengths_nm.len(), values: curves.covariance.clone() };
    let trace = |(name, c): (&'static str, usize)| Trace {
        name,
        wavelengths_nm: &curves.wavelengths_nm,
        values: &curves.values[c],
        uncertainty: Some(&standard[c]),
    };
    let traces: Vec<Trace<'_>> = ["red", "green", "blue"].into_iter().zip(0..3).map(trace).collect();
    let (manufacturer, model) = maker_and_model(&wanted.title);
    let content = Content::Camera { channels: [0, 1, 2], per_photon: Some(false), manufacturer, model };
    let sheet = Sheet {
        title: &wanted.title,
        content,
        curves: &traces,
        covariance: Some(&covariance),
        comments,
        ..Sheet::default()
    };
    let refuse = |error: spectral_file::write::WriteError| CliError::File(format!("{}: {error}", path.display()));
    if format.is_csv() {
        let mut prepared = Prepared::new(&sheet, Grid::Native).map_err(refuse)?;
        return written::put(&wanted.title, path, (format, true), Some(&mut prepared), None);
    }
    let text = write(&sheet, format, Grid::Native).map_err(refuse)?;
    written::put(&wanted.title, path, (format, true), None, Some(&text))
}

fn comment(key: &str, value: impl Into<String>) -> (String, String) {
    (key.to_owned(), value.into())
}
