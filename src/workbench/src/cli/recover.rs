//! `recover`: spectral sensitivities of a camera from what it recorded of a chart, or of narrow bands.

mod chart;
mod narrow_band;

use std::path::PathBuf;

use chromascope_core::recovery::RecoveredCurves;
use chromascope_measure::harness::now;
use clap::{ArgMatches, Args, Subcommand};
use spectral_file::write::{Content, Format, Grid, Prepared, Sheet, Trace, write};
use spectral_file::{Covariance, Uncertainty};

use super::error::{CliError, Result, refused};
use super::inspect::written;
use crate::export::spectra::maker_and_model;

const EXAMPLES: &str = "Examples:
  chromascope recover chart day.csv --chart \"ColorChecker 24 (BabelColor average)\" --illuminant D65 --out camera.csv
  chromascope recover chart day.csv lamp.csv --chart mine.csv --illuminant daylight --illuminant A --clip 16000
  chromascope recover narrowband pass1.csv pass2.csv --clip 16384 --out camera.json

--out writes the curves with their expanded uncertainties (k = 2) and NAME.cov.csv, with the ending .json rawtoaces JSON, or as --format
says; only CSV has uncertainties. The table opens as any other camera: every metric's ± is then its own. --profile writes the matrix
that is fitted to the recorded patches; `chromascope matrix` makes profiles from the curves.";

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

/// Name of a camera that has none.
const UNNAMED: &str = "Recovered camera";

#[derive(Debug, Args)]
struct Written {
    /// Name of the camera in the file [default: that of a DNG, else "Recovered camera"]
    #[arg(long, value_name = "NAME")]
    title: Option<String>,
    /// Output file of the curves, .csv or .json
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Format of the curves' file [default: by its ending, csv or rawtoaces]
    #[arg(long, value_name = "FORMAT", value_parser = written::format(), requires = "out")]
    format: Option<Format>,
    /// Who measured, for the file
    #[arg(long, value_name = "NAME")]
    author: Option<String>,
    /// When it was measured, for the file
    #[arg(long, value_name = "DATE")]
    date: Option<String>,
    /// Light source, chart, spectroradiometer and lens, for the file
    #[arg(long, value_name = "TEXT")]
    instrument: Option<String>,
    /// License of the file
    #[arg(long, value_name = "LICENSE")]
    license: Option<String>,
    /// Overwrites existing files
    #[arg(long)]
    force: bool,
}

impl Written {
    /// Format of the curves' file.
    fn format(&self) -> Result<Format> {
        let ending = self.out.as_ref().and_then(|path| path.extension()?.to_str());
        match (self.format, ending) {
            (Some(format), _) => Ok(format),
            (None, Some("json")) => Ok(Format::RawtoacesJson),
            (None, Some("csv") | None) => Ok(Format::Csv),
            _ => refused("--out", "name a file that ends in .csv or .json, or a --format"),
        }
    }

    /// Who, when, with what and by what method.
    fn provenance(&self, source: &str, method: &str, reduction: &str) -> Vec<(String, String)> {
        let given = [
            ("author", &self.author),
            ("date", &self.date),
            ("instrument", &self.instrument),
            ("license", &self.license),
        ];
        let given = given.into_iter().filter_map(|(key, value)| Some((key, value.as_deref()?)));
        let known = [("source", source), ("method", method), ("reduction", reduction)];
        given.chain(known).map(|(key, value)| (key.to_owned(), value.to_owned())).collect()
    }
}

pub(super) fn run(arguments: &RecoverArguments, _: &ArgMatches) -> Result<()> {
    match &arguments.from {
        From::Chart(arguments) => chart::run(arguments),
        From::Narrowband(arguments) => narrow_band::run(arguments),
    }
}

/// Writes the curves where they are wanted.
fn put(title: &str, curves: &RecoveredCurves, wanted: &Written, comments: &[(String, String)]) -> Result<()> {
    let Some(path) = &wanted.out else { return Ok(()) };
    let format = wanted.format()?;
    let standard = curves.standard().map(|standard| Uncertainty { standard, coverage: 2.0 });
    let covariance = Covariance { size: 3 * curves.wavelengths_nm.len(), values: curves.covariance.clone() };
    let trace = |(name, c): (&'static str, usize)| Trace {
        name,
        wavelengths_nm: &curves.wavelengths_nm,
        values: &curves.values[c],
        uncertainty: Some(&standard[c]),
    };
    let traces: Vec<Trace<'_>> = ["red", "green", "blue"].into_iter().zip(0..3).map(trace).collect();
    let created = now();
    let (manufacturer, model) = maker_and_model(title);
    let content = Content::Camera { channels: [0, 1, 2], per_photon: Some(false), manufacturer, model };
    let sheet = Sheet {
        title,
        content,
        curves: &traces,
        covariance: Some(&covariance),
        created: Some(&created),
        comments,
        ..Sheet::default()
    };
    let refuse = |error: spectral_file::write::WriteError| CliError::File(format!("{}: {error}", path.display()));
    if format.is_csv() {
        let mut prepared = Prepared::new(&sheet, Grid::Native).map_err(refuse)?;
        return written::put(title, path, (format, true), Some(&mut prepared), None);
    }
    let text = write(&sheet, format, Grid::Native).map_err(refuse)?;
    written::put(title, path, (format, true), None, Some(&text))
}
