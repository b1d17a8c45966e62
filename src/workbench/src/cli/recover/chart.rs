//! `recover chart`.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::PathBuf;

use chromascope_core::camera::recorded::RecordedPatch;
use chromascope_core::recovery::{ChartRecovery, LeftOut, Library, RecoveryError, Shot, left_out};
use chromascope_core::spectral::GridSpectrum;
use chromascope_figure::{Cell, Column, Table};
use clap::Args;
use spectral_file::Values;

use super::{Written, comment, library, put};
use crate::catalog::recorded::{Levels, lit};
use crate::cli::arguments::values;
use crate::cli::error::{CliError, Result, refused};
use crate::cli::identify::recorded_table;
use crate::cli::outputs::{check, show};
use crate::cli::request::Request;
use crate::document::start::Start;
use crate::document::{CIE_1931, Light, SetKind};
use crate::format::{display_path, fixed};
use crate::results::Results;
use crate::scene::Scene;

/// Lights that the recording is compared with, where another than the one named would explain it.
const OTHERS: [&str; 7] = ["A", "D50", "D55", "D65", "D75", "FL2", "FL11"];
/// Standard deviation of daylight's reciprocal temperature about the best of steps of 20, in mireds.
const MIREDS: f64 = 15.0;
const NEAREST: usize = 5;

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
    /// Standard deviation of a raw value in percent of it: noise, and what charts of one edition differ by
    #[arg(long, value_name = "PERCENT", default_value_t = 1.0, value_parser = percent)]
    noise: f64,
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
    let sites: Vec<f64> = (0..41).map(|i| 380.0 + 10.0 * f64::from(i)).collect();
    let library = library(&request, &sites)?;
    let file = display_path(&arguments.files[0]);
    let refuse = |error: RecoveryError| CliError::File(format!("{file}: {error}"));
    let mut shots = shots(&mut request, arguments, 182.0)?;
    check(arguments.written.out.as_deref(), &request.inputs(), arguments.written.force)?;
    let mut mired = None;
    if arguments.illuminant.iter().any(|light| light == "daylight") {
        let at = [90.0, 110.0, 130.0, 150.0, 170.0, 190.0, 210.0, 230.0];
        let all: Vec<Vec<Shot>> =
            at.iter().map(|mired| self::shots(&mut request, arguments, *mired)).collect::<Result<_>>()?;
        let nearest = |mired: f64| at.iter().position(|own| (own - mired).abs() < 10.0).unwrap_or(0);
        let (_, best) = ChartRecovery::under_daylight(&library, |mired| all[nearest(mired)].clone()).map_err(refuse)?;
        (shots, mired) = (all[nearest(best)].clone(), Some(best));
    }
    let others = others(&request, &shots, mired.is_some())?;
    let named = others.iter().map(|(what, shots)| (what.clone(), shots.as_slice()));
    let recovery = ChartRecovery::against(&library, &shots, named).map_err(refuse)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let omitted = left_out(&library, &shots, &*scene.sensor(SetKind::Observer, CIE_1931)?).map_err(refuse)?;
    show(&text(&recovery, &library, &shots, &omitted, mired))?;
    let lights: Vec<_> = arguments.illuminant.iter().map(|light| light.to_string_lossy()).collect();
    let method = format!(
        "recovered from the raw values of {} patches under {} with the library's tables as prior (chromascope recover chart); good for color, a guess where the uncertainty is large",
        shots[0].patches.len(),
        lights.join(", ")
    );
    put(&recovery.curves, &arguments.written, &[comment("source", file.clone()), comment("note", method)])
}

/// The recording of each table under its light; under daylight of a reciprocal temperature where that is unknown.
fn shots(request: &mut Request, arguments: &ChartArguments, mired: f64) -> Result<Vec<Shot>> {
    let levels = Levels { black: arguments.black, clip: arguments.clip.unwrap_or(f64::INFINITY) };
    let mut shots = Vec::new();
    for (at, file) in arguments.files.iter().enumerate() {
        let light = &arguments.illuminant[at.min(arguments.illuminant.len() - 1)];
        let mut drifts = Vec::new();
        if light == "daylight" {
            drifts.push(drift(request, mired)?);
            request.document.temperature_k = 1e6 / mired;
        } else {
            request.set_light(light)?;
        }
        let patches: Vec<RecordedPatch> = (*recorded_table(request, file, levels)?).clone();
        let noise =
            |patch: &RecordedPatch| patch.rgb.map(|signal| signal.value().unwrap_or(0.0) * arguments.noise / 100.0);
        let noise = patches.iter().map(noise).collect();
        shots.push(Shot { patches, noise, drifts });
    }
    Ok(shots)
}

/// Relative change of daylight by one standard deviation of its reciprocal temperature.
fn drift(request: &mut Request, mired: f64) -> Result<GridSpectrum> {
    let mut light = |mired: f64| -> Result<GridSpectrum> {
        request.document.light = Light::Daylight;
        request.document.temperature_k = 1e6 / mired;
        let results = Results::default();
        let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
        Ok((*scene.light()?.grid).clone())
    };
    let [low, high] = [light(mired - 2.0)?, light(mired + 2.0)?];
    let mut pairs = low.values().iter().zip(high.values());
    Ok(GridSpectrum::from_fn(|_| pairs.next().map_or(0.0, |(low, high)| MIREDS / 4.0 * (high / low).ln())))
}

/// What else the recording may be of: the chart turned, or other lights.
fn others(request: &Request, shots: &[Shot], is_unknown: bool) -> Result<Vec<(String, Vec<Shot>)>> {
    let turned = |shot: &Shot| {
        let mut shot = shot.clone();
        let values: Vec<_> = shot.patches.iter().rev().map(|patch| patch.rgb).collect();
        shot.patches.iter_mut().zip(values).for_each(|(patch, rgb)| patch.rgb = rgb);
        shot
    };
    let mut all = vec![("the chart turned by 180°".to_owned(), shots.iter().map(turned).collect::<Vec<_>>())];
    let ([shot], false, Light::Set(_)) = (shots, is_unknown, &request.document.light) else { return Ok(all) };
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let own = scene.light()?.grid;
    for name in OTHERS {
        let other = scene.illuminant(name)?.grid;
        let mut pairs = own.values().iter().zip(other.values());
        let ratio = GridSpectrum::from_fn(|_| pairs.next().map_or(0.0, |(own, other)| other / own));
        let mut shot = shot.clone();
        shot.patches.iter_mut().for_each(|patch| patch.radiance = lit(&patch.radiance, &ratio));
        all.push((format!("the light {name}"), vec![shot]));
    }
    Ok(all)
}

fn column(name: &str, width: usize, decimals: usize) -> Column {
    Column { width, decimals: Some(decimals), ..Column::from(name) }
}

fn percents(values: [Option<f64>; 3]) -> impl Iterator<Item = Cell> {
    values.into_iter().map(|value| value.map(|value| 100.0 * value).into())
}

fn text(
    recovery: &ChartRecovery,
    library: &Library,
    shots: &[Shot],
    omitted: &[LeftOut],
    mired: Option<f64>,
) -> String {
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
        let mut table = Table::new(["R %", "G %", "B %"].map(|name| column(name, 6, 2)).into_iter().chain([column(
            "brightness",
            10,
            3,
        )]));
        for (row, bright) in residuals.iter().zip(brightness) {
            table.push(percents(*row).chain([Cell::from(*bright)]));
        }
        table.insert(0, column("patch", 5, 0), shot.patches.iter().map(|patch| patch.name.as_str().into()));
        let _ = write!(text, "\nResiduals, recorded over modeled\n\n{}", table.to_text());
    }
    let glare = recovery.glare.map(|glare| fixed(100.0 * glare, 2)).join(", ");
    let _ = writeln!(
        text,
        "\nResiduals are {} times the noise; glare {glare} % of the brightest patch; brightness varies by {} %",
        fixed(recovery.noise_ratio, 2),
        fixed(100.0 * recovery.unevenness, 1)
    );
    if let (Some(mired), Some([t, deviation])) = (mired, recovery.light.first()) {
        let (found, deviation) = (mired + t * MIREDS, deviation * MIREDS);
        let kelvin = 1e6 / found;
        let _ = writeln!(
            text,
            "Daylight of {} K ± {} K (k = 2)",
            fixed(kelvin, 0),
            fixed(2.0 * deviation * kelvin / found, 0)
        );
    }
    text += "Nearest tables of the library, root mean square of the difference relative to the curves:\n";
    for (name, distance) in library.nearest(&own.values).iter().take(NEAREST) {
        let _ = writeln!(text, "  {} %  {name}", fixed(100.0 * distance, 1));
    }
    text + &differences(omitted)
}

type Difference = fn(&LeftOut) -> Option<f64>;

/// Summary of the color differences of patches, each predicted from all others.
fn differences(omitted: &[LeftOut]) -> String {
    let mut text = "Patches excluded one at a time, ΔE*00 (mean, largest):\n".to_owned();
    let kinds: [(&str, Difference); 3] = [
        ("recorded against predicted by the curves", |patch| patch.table),
        ("matrix from the curves", |patch| patch.from_curves),
        ("matrix from the recorded patches", |patch| patch.from_patches),
    ];
    for (what, of) in kinds {
        let all: Vec<f64> = omitted.iter().filter_map(of).collect();
        let mean = all.iter().sum::<f64>() / all.len().max(1) as f64;
        let worst =
            omitted.iter().filter_map(|patch| Some((of(patch)?, &patch.patch))).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((largest, patch)) = worst {
            let _ = writeln!(text, "  {}, {} ({patch})  {what}", fixed(mean, 2), fixed(largest, 2));
        }
    }
    text
}
