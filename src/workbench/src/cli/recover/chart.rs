//! `recover chart`.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::PathBuf;

use chromascope_core::query::{Ask as _, ChartMeasurement, ChartShot, ErrorSummary};
use chromascope_core::recovery::FitSource;
use chromascope_figure::{Cell, Column, Table};
use chromascope_profile::icc::IccVersion;
use clap::Args;
use spectral_file::Values;

use super::{Written, put};
use crate::catalog::recorded::Levels;
use crate::cli::arguments::values;
use crate::cli::error::{CliError, Result, refused};
use crate::cli::identify::recorded_table;
use crate::cli::outputs::{check, show, stream};
use crate::cli::request::Request;
use crate::document::Light;
use crate::document::start::Start;
use crate::export::profile::{CorrectionForm, ShotCorrection};
use crate::format::{display_path, fixed};
use crate::results::Results;
use crate::scene::{Scene, SceneError};

const NEAREST: usize = 5;
/// Light that daylight of unknown temperature is looked for from.
const STAND_IN_K: f64 = 6500.0;

#[derive(Debug, Args)]
pub(super) struct ChartArguments {
    /// Tables of raw values as for `identify`, one for each light or exposure
    #[arg(value_name = "PATCHES", required = true)]
    files: Vec<PathBuf>,
    /// The patches' reflectances: a chart, or a file; not for tables that have their own
    #[arg(long, value_name = "NAME|FILE")]
    chart: Option<OsString>,
    /// The light of each table, or of all: a name, a file with one curve, `daylight:K`, `blackbody:K`, or `daylight` of unknown temperature
    #[arg(long, value_name = "NAME|FILE", required = true)]
    illuminant: Vec<OsString>,
    /// Scale of the values in a file of reflectances that does not state it
    #[arg(long, value_name = "VALUES", value_parser = values())]
    values: Option<Values>,
    /// Raw value of no light, subtracted
    #[arg(long, value_name = "LEVEL", default_value_t = 0.0, allow_hyphen_values = true)]
    black: f64,
    /// Raw value from which on a channel is clipped [default: none]
    #[arg(long, value_name = "LEVEL")]
    clip: Option<f64>,
    /// Standard deviation of a raw value in percent of it: noise, and what charts of one edition differ by; estimated from 0.4 to 2 times this
    #[arg(long, value_name = "PERCENT", default_value_t = 1.5, value_parser = percent)]
    noise: f64,
    /// Profile by the matrix that is fitted to the recorded patches, .dcp (of one light or two), .icc or .clf
    #[arg(long, value_name = "FILE")]
    profile: Option<PathBuf>,
    /// For dcp: the camera model as its raw files state it [default: by the table of names from --title]
    #[arg(long, value_name = "MODEL", requires = "profile")]
    model: Option<String>,
    #[command(flatten)]
    written: Written,
}

fn percent(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value| (0.01..=50.0).contains(value));
    value.ok_or_else(|| format!("\"{text}\" is not a percentage from 0.01 to 50"))
}

pub(super) fn run(arguments: &ChartArguments) -> Result<()> {
    let mut request = Request::of_cameras(Start::Colorimetry, "--camera", &[], None)?;
    request.values = arguments.values;
    request.set_chart(arguments.chart.as_deref())?;
    if arguments.illuminant.len() != 1 && arguments.illuminant.len() != arguments.files.len() {
        return refused("--illuminant", "name one light, or one for each table");
    }
    let (written, form) = (&arguments.written, profile_form(arguments)?);
    written.format()?;
    let shots = shots(&mut request, arguments)?;
    let outputs = written.out.as_deref().into_iter().chain(arguments.profile.as_deref());
    check(outputs, &request.inputs(), written.force)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let files: Vec<String> = arguments.files.iter().map(|file| display_path(file)).collect();
    let measured = (*results.ask(&scene.measured_camera(shots)?)).clone();
    let measured = measured.map_err(|error| match error {
        SceneError::Recovery(error) => CliError::File(format!("{}: {error}", files.join(", "))),
        other => other.into(),
    })?;
    show(&text(&measured))?;
    let lights: Vec<&str> = measured.profiles.iter().map(|(light, _)| light.as_str()).collect();
    let method = format!("raw values of {} patches under {}", measured.shots[0].patches.len(), lights.join(", "));
    let reduction = "joint Gaussian estimate with the library's tables as prior (chromascope recover chart); good for color, a guess where the uncertainty is large";
    put(&measured.recovery.curves, written, &written.provenance(&files.join(", "), &method, reduction))?;
    let (Some(path), Some(form)) = (&arguments.profile, form) else { return Ok(()) };
    let license = written.license.as_deref().unwrap_or("the user's own");
    let author = written.author.as_ref().map_or_else(String::new, |author| format!(" by {author}"));
    let terms = format!("Fitted to a photograph of a chart{author}; license: {license}");
    let (camera, model) = (written.title.as_str(), arguments.model.as_deref());
    let correction = ShotCorrection { camera, model, terms: &terms, profiles: &measured.profiles };
    let bytes = correction.written(form)?;
    stream(Some(path), |out| Ok(out.write_all(&bytes)?))
}

/// Form of the profile by its file's ending.
fn profile_form(arguments: &ChartArguments) -> Result<Option<CorrectionForm>> {
    let Some(path) = &arguments.profile else { return Ok(None) };
    let forms = [CorrectionForm::Dcp, CorrectionForm::Icc(IccVersion::V4), CorrectionForm::Clf];
    let ending = path.extension().and_then(|ending| ending.to_str());
    match forms.into_iter().find(|form| Some(form.ending()) == ending) {
        Some(form) => Ok(Some(form)),
        None => refused("--profile", "name a file that ends in .dcp, .icc or .clf"),
    }
}

/// The recording of each table under its light.
fn shots(request: &mut Request, arguments: &ChartArguments) -> Result<Vec<ChartShot>> {
    let levels = Levels { black: arguments.black, clip: arguments.clip.unwrap_or(f64::INFINITY) };
    let mut shots = Vec::new();
    for (at, file) in arguments.files.iter().enumerate() {
        let light = &arguments.illuminant[at.min(arguments.illuminant.len() - 1)];
        let is_daylight = light == "daylight";
        if is_daylight {
            (request.document.light, request.document.temperature_k) = (Light::Daylight, STAND_IN_K);
        } else {
            request.set_light(light)?;
        }
        let patches = (*recorded_table(request, file, levels)?).clone();
        let results = Results::default();
        let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
        shots.push(scene.chart_shot(patches, &[], arguments.noise / 100.0, is_daylight)?);
    }
    Ok(shots)
}

fn column(name: &str, width: usize, decimals: usize) -> Column {
    Column { width, decimals: Some(decimals), ..Column::from(name) }
}

fn percents(values: [Option<f64>; 3]) -> impl Iterator<Item = Cell> {
    values.into_iter().map(|value| value.map(|value| 100.0 * value).into())
}

fn text(measured: &ChartMeasurement) -> String {
    let ChartMeasurement { recovery, shots, .. } = measured;
    let mut text = String::new();
    let mut curves = Table::new(
        ["nm", "red", "±", "green", "±", "blue", "±", "data R %", "data G %", "data B %"]
            .map(|name| column(name, 6, if name == "nm" || name.starts_with("data") { 0 } else { 3 })),
    );
    let (own, standard) = (&recovery.curves, recovery.curves.standard());
    for (k, nm) in own.wavelengths_nm.iter().enumerate().filter(|(_, nm)| (400.0..=700.0).contains(*nm)) {
        let pair = |c: usize| [own.values[c][k], 2.0 * standard[c][k]];
        let shares = [0, 1, 2].map(|c: usize| 100.0 * own.data_share[c][k]);
        let cells = [*nm].into_iter().chain([0, 1, 2].into_iter().flat_map(pair)).chain(shares);
        curves.push(cells.map(Cell::from));
    }
    text += &curves.to_text();
    text += "± is expanded (k = 2). The share of the data is one less the ratio of the variances after and before; the rest is the library's.\n";
    for (shot, (residuals, brightness)) in shots.iter().zip(recovery.residuals.iter().zip(&recovery.brightness)) {
        let channels = ["R %", "G %", "B %"].map(|name| column(name, 6, 2));
        let mut table = Table::new(channels.into_iter().chain([column("brightness", 10, 3)]));
        for (row, bright) in residuals.iter().zip(brightness) {
            table.push(percents(*row).chain([Cell::from(*bright)]));
        }
        table.insert(0, column("patch", 5, 0), shot.patches.iter().map(|patch| patch.name.as_str().into()));
        let _ = write!(text, "\nResiduals, recorded over modeled\n\n{}", table.to_text());
    }
    text += &conditions(measured);
    text += "Nearest tables of the library, root mean square of the difference relative to the curves:\n";
    for (name, distance) in measured.nearest.iter().take(NEAREST) {
        let _ = writeln!(text, "  {} %  {name}", fixed(100.0 * distance, 1));
    }
    text + &differences(measured)
}

/// Noise, glare, brightness, unlikeness and daylight in sentences.
fn conditions(measured: &ChartMeasurement) -> String {
    let recovery = &measured.recovery;
    let glare = recovery.glare.map(|glare| fixed(100.0 * glare, 2)).join(", ");
    let mut text = format!(
        "\nResiduals are {} times the noise; glare {glare} % of the brightest patch; brightness varies by {} %\n",
        fixed(recovery.noise_ratio, 2),
        fixed(100.0 * recovery.unevenness, 1)
    );
    let unlikeness = fixed(recovery.unlikeness, 2);
    text += &if recovery.unlikeness > 1.0 {
        format!(
            "This camera is unlike those of the library (distance {unlikeness}, where 1 is expected at most): its bands are widened by that factor, and may still be too narrow\n"
        )
    } else {
        format!("The camera is like those of the library: distance {unlikeness}, where 1 is expected at most\n")
    };
    if let Some([kelvin, deviation]) = measured.daylight {
        let _ = writeln!(text, "Daylight of {} K ± {} K (k = 2)", fixed(kelvin, 0), fixed(2.0 * deviation, 0));
    }
    text
}

/// Color differences: of patches predicted from all others, and of the corrections under each light.
fn differences(measured: &ChartMeasurement) -> String {
    let summary = |of: &[Option<f64>]| ErrorSummary::new(of);
    let mut text = String::new();
    let excluded: Vec<Option<f64>> = measured.left_out.iter().map(|(_, error)| *error).collect();
    if let Some(found) = summary(&excluded) {
        let (mean, most) = (fixed(found.mean, 2), fixed(found.max, 2));
        let worst = &measured.left_out[found.worst].0;
        let _ = writeln!(
            text,
            "Patches recovered without, recorded against predicted: ΔE*00 mean {mean}, largest {most} ({worst})"
        );
    }
    for (light, profile) in &measured.profiles {
        let heads = ["predicted", "largest", "measured", "largest", "excluded", "largest"];
        let mut table = Table::new(heads.map(|head| column(head, 9, 2)));
        let mut names = Vec::new();
        for fit in profile.fits.iter().flatten() {
            let source = if fit.source == FitSource::Patches { "recorded patches" } else { "recovered curves" };
            names.push(Cell::from(format!("{}, {source}", fit.correction.method.label())));
            let pair = |of: &[Option<f64>]| summary(of).map_or([None; 2], |found| [Some(found.mean), Some(found.max)]);
            let cells = [&fit.predicted, &fit.measured, &fit.left_out].map(|of| pair(of)).concat();
            table.push(cells.into_iter().map(Cell::from));
        }
        table.insert(0, column("fit, by", 6, 0), names);
        let _ = write!(text, "\nColor corrections under {light}, ΔE*00 (mean, largest)\n\n{}", table.to_text());
    }
    text + "predicted: the curves' values; measured: the recorded values; excluded: recorded values through a fit without that patch\n"
}
