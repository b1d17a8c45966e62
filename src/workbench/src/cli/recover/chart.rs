//! `recover chart`.

use std::ffi::{OsStr, OsString};
use std::fmt::Write as _;
use std::path::PathBuf;

use chromascope_core::query::{Ask as _, ChartMeasurement, ChartShot};
use clap::Args;
use spectral_file::Values;

use super::{UNNAMED, Written, put};
use crate::catalog::chart_picture::is_picture;
use crate::catalog::import::UNIQUE_CAMERA_MODEL;
use crate::catalog::recorded::Levels;
use crate::cli::arguments::values;
use crate::cli::error::{CliError, Result, refused};
use crate::cli::identify::{corner, grid, picture, recorded_table};
use crate::cli::outputs::{check, show, stream};
use crate::cli::reading::in_file;
use crate::cli::request::Request;
use crate::document::measurement::mixed_models;
use crate::document::start::Start;
use crate::document::{Light, PHOTOGRAPHED_CHART};
use crate::export::measured;
use crate::export::profile::CorrectionForm;
use crate::export::profile::shot::ShotCorrection;
use crate::format::display_path;
use crate::results::Results;
use crate::scene::measurement::{RELATIVE, STAND_IN_K};
use crate::scene::{Scene, SceneError};
use crate::terminal::say;

#[derive(Debug, Args)]
pub(super) struct ChartArguments {
    /// Pictures of the chart (DNG, linear 16-bit TIFF or PNG, OpenEXR) or tables of raw values, as for `identify`, one for each light or exposure
    #[arg(value_name = "PATCHES", required = true)]
    files: Vec<PathBuf>,
    /// The patches' reflectances: a chart, or a file; not for tables that have their own
    #[arg(long, value_name = "NAME|FILE")]
    chart: Option<OsString>,
    /// Outer corners of the grid of patches in the pictures, as for `identify` [default: a chart of 24 patches is searched]
    #[arg(long, value_name = "x,y", num_args = 4, value_parser = corner)]
    corners: Vec<[f64; 2]>,
    /// Patches across and down the chart in the pictures, as for `identify`: 14x10 for a ColorChecker SG, with your own --chart
    #[arg(long, visible_alias = "layout", value_name = "CxR", default_value = "6x4", value_parser = grid)]
    grid: [usize; 2],
    /// The light of each file, or of all: a name, a file with one curve, `daylight:K`, `blackbody:K`, or `daylight` of unknown temperature
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
    #[arg(long, value_name = "PERCENT", default_value_t = 100.0 * RELATIVE, value_parser = percent)]
    noise: f64,
    /// Profile by the matrix that is fitted to the recorded patches, .dcp (of one light or two), .icc or .clf (of one light)
    #[arg(long, value_name = "FILE")]
    profile: Option<PathBuf>,
    /// The light of an ICC or CLF, as the tables of color corrections name it [default: the first]
    #[arg(long, value_name = "NAME", requires = "profile")]
    profile_light: Option<String>,
    /// Writes --out and --profile though a warning says that light or chart are likely others
    #[arg(long)]
    accept_warnings: bool,
    /// The camera model as its raw files state it, for dcp, and where the files state several of one camera [default: that of a DNG, else by
    /// the table of names from --title]
    #[arg(long, value_name = "MODEL")]
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
    let photographed = arguments.files.iter().any(|file| is_picture(file)).then_some(OsStr::new(PHOTOGRAPHED_CHART));
    request.set_chart(arguments.chart.as_deref().or(photographed))?;
    if arguments.illuminant.len() != 1 && arguments.illuminant.len() != arguments.files.len() {
        return refused("--illuminant", "name one light, or one for each table");
    }
    let (written, form) = (&arguments.written, profile_form(arguments)?);
    written.format()?;
    let (shots, [of_file, stated]) = shots(&mut request, arguments)?;
    let camera = written.title.clone().or(of_file).unwrap_or_else(|| UNNAMED.to_owned());
    let outputs = written.out.as_deref().into_iter().chain(arguments.profile.as_deref());
    check(outputs, &request.inputs(), written.force)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let files: Vec<String> = arguments.files.iter().map(|file| display_path(file)).collect();
    let found = (*results.ask(&scene.measured_camera(shots)?)).clone();
    let found = found.map_err(|error| match error {
        SceneError::Recovery(error) => CliError::File(format!("{}: {error}", files.join(", "))),
        other => other.into(),
    })?;
    show(&text(&found, &files[0]))?;
    let is_refused = !arguments.accept_warnings && (written.out.is_some() || form.is_some());
    if let Some(doubt) = measured::doubts(&found).first().filter(|_| is_refused) {
        let why = format!("{doubt}. Nothing was written; with --accept-warnings it is");
        return Err(CliError::File(format!("{}: {why}", files.join(", "))));
    }
    let lights: Vec<&str> = found.profiles.iter().map(|(light, _)| light.as_str()).collect();
    let number = arguments.profile_light.as_ref().map_or(Some(0), |name| lights.iter().position(|light| light == name));
    let Some(number) = number else {
        return refused("--profile-light", format!("name one of {}", lights.join(", ")));
    };
    let (count, charts) = (found.shots[0].patches.len(), found.charts.join(", "));
    let method = format!("raw values of {count} patches of {charts} under {}", lights.join(", "));
    let model = arguments.model.as_ref().or(stated.as_ref());
    let mut comments = written.provenance(&files.join(", "), &method, measured::REDUCTION);
    comments.extend(model.map(|model| (UNIQUE_CAMERA_MODEL.to_owned(), model.clone())));
    put(&camera, &found.recovery.curves, written, &comments)?;
    let (Some(path), Some(form)) = (&arguments.profile, form) else { return Ok(()) };
    let license = written.license.as_deref().unwrap_or("the user's own");
    let author = written.author.as_ref().map_or_else(String::new, |author| format!(" by {author}"));
    let terms = format!("Fitted to a photograph of a chart{author}; license: {license}");
    let (model, profiles) = (model.map(String::as_str), found.profiles.as_slice());
    let correction = ShotCorrection { camera: &camera, model, terms: &terms, profiles };
    let bytes = correction.written((form, number))?;
    if form == CorrectionForm::Dcp && model.is_none() {
        say(&format!("chromascope: {} Name it with --model.\n", correction.model_in_words()));
    }
    stream(Some(path), |out| Ok(out.write_all(&bytes)?))
}

/// Form of the profile by its file's ending.
fn profile_form(arguments: &ChartArguments) -> Result<Option<CorrectionForm>> {
    let Some(path) = &arguments.profile else { return Ok(None) };
    let ending = path.extension().and_then(|ending| ending.to_str());
    match ShotCorrection::FORMS.into_iter().find(|form| Some(form.ending()) == ending) {
        Some(form) => Ok(Some(form)),
        None => refused("--profile", "name a file that ends in .dcp, .icc or .clf"),
    }
}

/// The recording of each table under its light, and camera and model that pictures state.
fn shots(request: &mut Request, arguments: &ChartArguments) -> Result<(Vec<ChartShot>, [Option<String>; 2])> {
    let levels = Levels { black: arguments.black, clip: arguments.clip.unwrap_or(f64::INFINITY) };
    let (mut shots, mut camera, mut models) = (Vec::new(), None, Vec::new());
    for (at, file) in arguments.files.iter().enumerate() {
        let light = &arguments.illuminant[at.min(arguments.illuminant.len() - 1)];
        let is_daylight = light == "daylight";
        if is_daylight {
            (request.document.light, request.document.temperature_k) = (Light::Daylight, STAND_IN_K);
        } else {
            request.set_light(light)?;
        }
        let photo =
            if is_picture(file) { Some(picture(request, file, (&arguments.corners, arguments.grid))?) } else { None };
        let table = if photo.is_some() { None } else { Some((*recorded_table(request, file, levels)?).clone()) };
        let results = Results::default();
        let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
        let own_spectra = table.is_some() && arguments.chart.is_none();
        let columns = photo.as_ref().map(|_| arguments.grid[0]);
        let recorded = match photo {
            Some((photo, corners)) => {
                camera = camera.or_else(|| photo.camera());
                models.extend(photo.model().map(|model| (display_path(file), model)));
                let patches = photo.patches(corners, arguments.grid).map_err(|error| in_file(file, error))?;
                scene.recorded_patches(&patches, arguments.grid).map_err(|error| in_file(file, error))?
            }
            None => (table.unwrap_or_default(), Vec::new()),
        };
        let mut shot = scene.chart_shot(recorded, columns, arguments.noise / 100.0, is_daylight)?;
        shot.picture = display_path(file);
        if own_spectra {
            shot.chart = format!("reflectances in {}", shot.picture);
        }
        shots.push(shot);
    }
    let stated = models.iter().map(|(file, model)| (file.as_str(), model.as_str()));
    if let Some(mixed) = mixed_models(stated).filter(|_| arguments.model.is_none()) {
        let remedy = "recover each camera by itself, or, if it is one camera, name its model with --model";
        return Err(CliError::File(format!("{mixed}; {remedy}")));
    }
    Ok((shots, [camera, models.into_iter().next().map(|(_, model)| model)]))
}

fn text(of: &ChartMeasurement, picture: &str) -> String {
    let mut text = measured::curves(&of.recovery).to_text();
    text += measured::UNCERTAINTY;
    text +=
        " The share of the data is one less the ratio of the variances after and before; the rest is the library's.\n";
    for (at, shot) in of.shots.iter().enumerate() {
        let patches = measured::patches(shot, &of.recovery, at).to_text();
        let _ = write!(text, "\nPatches, with residuals of recorded over modeled\n\n{patches}");
    }
    text += "\n";
    let doubts = measured::doubts(of).into_iter().map(|doubt| format!("Warning: {doubt}"));
    text.extend(measured::conditions(of).into_iter().chain(doubts).map(|line| line + "\n"));
    text.extend(measured::headline(of, picture).map(|line| line + "\n"));
    for (light, profile) in &of.profiles {
        let table = measured::corrections(profile).to_text();
        let matrix = measured::matrix(profile).unwrap_or_default();
        let _ = write!(text, "\nColor corrections under {light}\n\n{table}\nMatrix {}:\n{matrix}\n", measured::MATRIX);
    }
    text + "\n" + measured::COLUMNS + "\n"
}
