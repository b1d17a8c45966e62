//! `identify`: raw RGB that a camera recorded of known patches, against tables of sensitivities.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use chromascope_core::camera::chart_grid::ChartGrid;
use chromascope_core::camera::chart_search::CHART_SIZE;
use chromascope_core::camera::recorded::{Freedom, Link, LinkKind, RESAMPLES, RankRange, RecordedFit, RecordedPatch};
use chromascope_core::query::{Ask as _, RecordedSet, Shared};
use chromascope_core::spectral::{GridSpectrum, Quantity};
use chromascope_figure::number::significant;
use chromascope_figure::{Cell, Column, Field, Table};
use clap::{ArgMatches, Args, ValueEnum};
use serde_json::{Value, json};
use spectral_file::Values;

use super::arguments::{Form, form, values};
use super::error::{CliError, Result, refused};
use super::outputs::{self, put};
use super::reading::Per;
use super::reading::in_file;
use super::request::Request;
use crate::catalog::chart_picture::{ChartPicture, is_picture};
use crate::catalog::recorded::{self, Levels, RawRow, RawTable, lit};
use crate::document::PHOTOGRAPHED_CHART;
use crate::document::imported::Role;
use crate::document::start::Start;
use crate::format::{display_path, fixed, rank_in_words};
use crate::results::Results;
use crate::scene::Scene;
use crate::scene::recorded::{CHANNELS, RANK_CAUTION, RankedCamera, cause_in_words, in_grid, range_in_words};
use crate::terminal::shown_json;

const EXAMPLES: &str = "Examples:
  chromascope identify raw.csv --chart \"ColorChecker 24 (Ohta 1997)\" --illuminant D50
  chromascope identify measured.csv --illuminant lamp.csv --residuals residuals.csv
  chromascope identify radiances.csv --radiance --raw raw.csv --clip 4095 --format json
  chromascope identify chart.dng --illuminant D65
  chromascope identify --image chart.tif --corners 212,180 1840,195 1826,1290 220,1275 --chart colorchecker.csv --illuminant D50

FILE is a picture of a chart of 24 patches, which is searched in it; or a spectral table, one row a patch, with three more columns R, G, B of linear raw values; or the spectra alone with --raw; or,
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
    /// A picture of a chart (DNG, linear 16-bit TIFF or PNG, OpenEXR), spectra with raw RGB, spectra alone (with --raw or --image), or raw RGB alone (with --chart)
    #[arg(value_name = "FILE", required_unless_present = "image")]
    file: Option<PathBuf>,
    /// A table of raw RGB: columns patch, R, G, B
    #[arg(long, value_name = "FILE", conflicts_with = "image")]
    raw: Option<PathBuf>,
    /// A picture of the chart: DNG, linear 16-bit TIFF or PNG, OpenEXR
    #[arg(long, value_name = "FILE")]
    image: Option<PathBuf>,
    /// Outer corners of the grid of patches in pixels, around the chart from the first patch: top left, top right, bottom right, bottom left
    /// [default: a chart of 24 patches is searched]
    #[arg(long, value_name = "x,y", num_args = 4, value_parser = corner)]
    corners: Vec<[f64; 2]>,
    /// Patches across and down the chart in the picture; they belong to spectra by names such as A1 or N10 where the chart has them, else
    /// row by row
    #[arg(long, value_name = "CxR", default_value = "6x4", value_parser = grid)]
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
    /// A camera, a file with three sensitivities, or a folder of such files; may be repeated [default: all of the library]
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

pub(super) fn corner(text: &str) -> Result<[f64; 2], String> {
    let wrong = || format!("\"{text}\" is not a corner; write x,y in pixels, such as 212,180.5");
    let (x, y) = text.split_once(',').ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(wrong);
    Ok([number(x)?, number(y)?])
}

pub(super) fn grid(text: &str) -> Result<[usize; 2], String> {
    let wrong = || format!("\"{text}\" is not a grid; write patches across and down, such as 6x4");
    let (columns, rows) = text.split_once(['x', 'X', '×']).ok_or_else(wrong)?;
    let count = |text: &str| text.trim().parse::<usize>().ok().filter(|n| (1..=100).contains(n)).ok_or_else(wrong);
    Ok([count(columns)?, count(rows)?])
}

/// Spectra by the names of their patches.
type Spectra = Vec<(String, GridSpectrum)>;

pub(super) fn run(arguments: &IdentifyArguments, _: &ArgMatches) -> Result<()> {
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
        Form::Table => table(&recorded, &ranked),
        Form::Csv => csv(&recorded, &ranked),
        Form::Json => shown_json(&json(&recorded, &ranked, freedom)).into_owned(),
    };
    if let Some(path) = &arguments.residuals {
        put(&residuals(&recorded, &ranked), Some(path))?;
    }
    put(&text, arguments.out.as_deref())
}

/// File that recorded values came from, for people.
fn file_of(arguments: &IdentifyArguments) -> String {
    let file = arguments.image.as_ref().or(arguments.raw.as_ref()).or(arguments.file.as_ref());
    file.map_or_else(String::new, |path| display_path(path))
}

fn levels(arguments: &IdentifyArguments) -> Result<Levels> {
    let levels = Levels { black: arguments.black, clip: arguments.clip.unwrap_or(f64::INFINITY) };
    if levels.black.is_finite() && levels.clip > levels.black {
        return Ok(levels);
    }
    refused("--clip", format!("{} is not above the black level {}", levels.clip, levels.black))
}

fn recorded_set(request: &mut Request, arguments: &IdentifyArguments, levels: Levels) -> Result<RecordedSet> {
    if let Some(light) = &arguments.illuminant {
        request.set_light(light)?;
    }
    request.set_filters(&arguments.filter)?;
    let own = arguments.image.is_some() || arguments.raw.is_some();
    let (spectra, rows) = match (&arguments.chart, &arguments.file) {
        (Some(_), Some(file)) if own => {
            let reason =
                format!("spectra come from --chart and raw values from elsewhere; leave out {}", display_path(file));
            return refused("FILE", reason);
        }
        (chart, Some(file)) if is_picture(file) && !own => {
            request.set_chart(Some(chart.as_deref().unwrap_or(PHOTOGRAPHED_CHART.as_ref())))?;
            let rows = picture_rows(request, arguments, file, levels)?;
            (chart_spectra(request)?, Some(rows))
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
                return Err(in_file(file, why));
            };
            (file_spectra(request, file, Some(text), arguments.radiance)?, Some(table.rows))
        }
        (None, None) => {
            return refused("--chart", "name the patches' reflectances, a chart or a file");
        }
    };
    let rows = match (rows, &arguments.raw, &arguments.image) {
        (Some(rows), ..) => rows,
        (None, Some(raw), _) => raw_rows(request, raw)?,
        (None, None, Some(image)) => picture_rows(request, arguments, image, levels)?,
        (None, None, None) => {
            return refused("--raw", "name a table of raw values, or a picture with --image");
        }
    };
    let is_of_picture = arguments.image.is_some() || !own && arguments.file.as_deref().is_some_and(is_picture);
    let spectra = if is_of_picture { in_grid(spectra, arguments.grid) } else { spectra };
    let joined = recorded::join(&spectra, &rows, levels);
    joined.map(Shared::new).map_err(|error| CliError::File(format!("{}: {error}", file_of(arguments))))
}

/// Patches of one table with their raw values: its own spectra, else those of the chart, under the light.
pub(super) fn recorded_table(request: &mut Request, path: &Path, levels: Levels) -> Result<RecordedSet> {
    let RawTable { spectra, rows, .. } = raw_table(request, path)?;
    let spectra = match spectra {
        Some(text) => file_spectra(request, path, Some(&text), false)?,
        None => chart_spectra(request)?,
    };
    let joined = recorded::join(&spectra, &rows, levels);
    joined.map(Shared::new).map_err(|error| in_file(path, error))
}

fn raw_table(request: &mut Request, path: &Path) -> Result<RawTable> {
    let bytes = request.bytes(path)?;
    recorded::read_table(&bytes).map_err(|error| in_file(path, error))
}

/// Raw values of a table that has nothing else.
fn raw_rows(request: &mut Request, path: &Path) -> Result<Vec<RawRow>> {
    let table = raw_table(request, path)?;
    if table.spectra.is_none() {
        return Ok(table.rows);
    }
    let why = "spectra beside the raw values, but they are taken from elsewhere; leave out --chart or --raw";
    Err(in_file(path, why))
}

fn picture_rows(
    request: &mut Request,
    arguments: &IdentifyArguments,
    path: &Path,
    levels: Levels,
) -> Result<Vec<RawRow>> {
    let (picture, corners) = picture(request, path, (&arguments.corners, arguments.grid))?;
    let [columns, rows] = arguments.grid;
    let grid = ChartGrid::new(corners, columns, rows).map_err(|error| in_file(path, error))?;
    picture.rows(&grid, levels).map_err(|error| in_file(path, error))
}

/// Picture of a chart with the corners of its grid: those that are named, else those that are found.
pub(super) fn picture(
    request: &mut Request,
    path: &Path,
    (corners, grid): (&[[f64; 2]], [usize; 2]),
) -> Result<(ChartPicture, [[f64; 2]; 4])> {
    let bytes = request.bytes(path)?;
    let picture = ChartPicture::read(path, &bytes).map_err(|error| in_file(path, error))?;
    let named = <[[f64; 2]; 4]>::try_from(corners).ok();
    let found = || picture.find_chart().filter(|_| grid == CHART_SIZE);
    let why =
        "no chart of 24 patches was found for certain, and of others none is searched; name the corners with --corners";
    let corners = named.or_else(found).ok_or_else(|| in_file(path, why))?;
    Ok((picture, corners))
}

fn chart_spectra(request: &Request) -> Result<Spectra> {
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    Ok(scene.patch_radiances()?)
}

/// Radiances of a file's spectra: as they are, or reflectances under the light.
pub(super) fn file_spectra(request: &mut Request, path: &Path, text: Option<&str>, radiance: bool) -> Result<Spectra> {
    let role = if radiance { Role::Illuminant } else { Role::Reflectance };
    let set = match text {
        Some(text) => request.read_bytes(path, text.as_bytes(), role)?,
        None => request.read(path, role)?,
    };
    let curves = set.curves_in_nm().map_err(|error| in_file(path, error))?;
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

/// Cameras that the table shows; CSV and JSON have all.
const SHOWN: usize = 15;
/// Share of the squares below which a cause is not named in the table.
const NOTABLE: f64 = 0.25;

fn names(patches: &[RecordedPatch]) -> Vec<String> {
    patches.iter().map(|patch| patch.name.clone()).collect()
}

fn cameras<'a>(ranked: &'a [RankedCamera], patches: &'a [String]) -> impl Iterator<Item = Ranked<'a>> {
    let fitted =
        ranked.iter().filter_map(|camera| Some((camera.rank?, camera.name.as_str(), camera.fit.as_ref().ok()?)));
    fitted.enumerate().map(move |(place, (rank, name, fit))| Ranked { place, rank, name, fit, patches })
}

/// Percent of a logarithm; a dash for none.
fn percent(log: Option<f64>) -> String {
    log.map_or_else(|| "–".to_owned(), |log| fixed(log * 100.0, 2))
}

struct Ranked<'a> {
    place: usize,
    rank: RankRange,
    name: &'a str,
    fit: &'a RecordedFit,
    patches: &'a [String],
}

impl Ranked<'_> {
    fn worst(&self) -> Option<(&str, f64)> {
        self.fit.worst_patches().first().map(|(patch, rms)| (self.patches[*patch].as_str(), *rms))
    }
}

fn column(name: &str, width: usize, decimals: usize) -> Column {
    Column { width, decimals: Some(decimals), ..Column::from(name) }
}

fn in_percent(log: Option<f64>) -> Cell {
    log.map(|log| log * 100.0).into()
}

/// Aligned columns: the ranking, then residuals and causes of the first.
fn table(patches: &[RecordedPatch], ranked: &[RankedCamera]) -> String {
    let names = names(patches);
    let heads = [("RMS %", 5), ("R %", 5), ("G %", 5), ("B %", 5)].map(|(name, width)| column(name, width, 2));
    let mut best =
        Table::new([column("rank", 5, 0), "camera".into()].into_iter().chain(heads).chain(["worst patch".into()]));
    for camera in cameras(ranked, &names).take(SHOWN) {
        let [first, _] = camera.rank.range;
        let rank = Cell::from(first as f64).with(|note| note.words = Some(rank_in_words(Some(camera.rank.range))));
        let worst = camera.worst().map(|(name, rms)| format!("{name}, {} %", percent(Some(rms))));
        let [r, g, b] = camera.fit.channel_rms();
        let percents = [Some(camera.fit.rms()), r, g, b].map(in_percent).into_iter();
        best.push([rank, camera.name.into()].into_iter().chain(percents).chain([worst.unwrap_or_default().into()]));
    }
    let mut text = best.to_text();
    let left = cameras(ranked, &names).count().saturating_sub(SHOWN);
    if left > 0 {
        let _ = writeln!(text, "       {left} more cameras: --format csv");
    }
    let Some(Ranked { rank, name, fit, .. }) = cameras(ranked, &names).next() else { return text };
    let _ = write!(text, "\n{name}: {}.\n{RANK_CAUTION}\n", range_in_words(rank));
    let _ = write!(text, "\nResiduals of {name} in percent (recorded over modeled)\n\n");
    let heads = ["R", "G", "B"].map(|name| column(name, 6, 2)).into_iter();
    let mut residuals = Table::new(heads.chain([column("brightness", 10, 3)]));
    for (row, brightness) in fit.residuals.iter().zip(&fit.brightness) {
        residuals.push(row.map(|log| in_percent(log.ok())).into_iter().chain([Cell::from(*brightness)]));
    }
    residuals.insert(0, column("patch", 5, 0), names.iter().map(|name| name.as_str().into()));
    text += &residuals.to_text();
    let gains = fit.gains.map(|gain| gain.map_or_else(|| "–".to_owned(), |gain| format!("{gain:.5e}")));
    let _ = write!(text, "\nGains {}; {} values, {} fitted parameters, ", gains.join(", "), fit.values, fit.parameters);
    let _ = writeln!(text, "standard deviation {} % by the degrees of freedom", percent(Some(fit.deviation())));
    for (reason, places) in excluded(patches, fit) {
        let _ = writeln!(text, "Excluded, {reason}: {}", places.join(", "));
    }
    for link in fit.links.iter().filter(|link| link.share >= NOTABLE) {
        let cause = cause_in_words(link.kind, link.amount, &names);
        let _ = writeln!(text, "{} % of the squares would be explained by: {cause}", fixed(link.share * 100.0, 0));
    }
    text
}

fn excluded(patches: &[RecordedPatch], fit: &RecordedFit) -> Vec<(String, Vec<String>)> {
    let mut reasons: Vec<(String, Vec<String>)> = Vec::new();
    for (patch, row) in patches.iter().zip(&fit.residuals) {
        for (why, channel) in row.iter().zip(CHANNELS).filter_map(|(value, channel)| Some((value.err()?, channel))) {
            let (why, place) = (why.to_string(), format!("{} {channel}", patch.name));
            match reasons.iter_mut().find(|(reason, _)| *reason == why) {
                Some((_, places)) => places.push(place),
                None => reasons.push((why, vec![place])),
            }
        }
    }
    reasons
}

fn columns<'a>() -> [Field<Ranked<'a>>; 19] {
    [
        Field::new("rank", |camera| (camera.place + 1).to_string().into()),
        Field::new("rank_first", |camera| camera.rank.range[0].to_string().into()),
        Field::new("rank_last", |camera| camera.rank.range[1].to_string().into()),
        Field::new("first_share", |camera| camera.rank.first.into()),
        Field::new("camera", |camera| camera.name.into()),
        Field::new("rms_percent", |camera| (camera.fit.rms() * 100.0).into()),
        Field::new("deviation_percent", |camera| (camera.fit.deviation() * 100.0).into()),
        Field::new("rms_r_percent", |camera| in_percent(camera.fit.channel_rms()[0])),
        Field::new("rms_g_percent", |camera| in_percent(camera.fit.channel_rms()[1])),
        Field::new("rms_b_percent", |camera| in_percent(camera.fit.channel_rms()[2])),
        Field::new("gain_r", |camera| camera.fit.gains[0].into()),
        Field::new("gain_g", |camera| camera.fit.gains[1].into()),
        Field::new("gain_b", |camera| camera.fit.gains[2].into()),
        Field::new("values", |camera| camera.fit.values.to_string().into()),
        Field::new("parameters", |camera| camera.fit.parameters.to_string().into()),
        Field::new("worst_patch", |camera| camera.worst().map_or("", |(name, _)| name).into()),
        Field::new("worst_patch_percent", |camera| in_percent(camera.worst().map(|(_, rms)| rms))),
        Field::new("cause", |camera| {
            camera
                .fit
                .links
                .first()
                .map_or_else(String::new, |link| cause_in_words(link.kind, link.amount, camera.patches))
                .into()
        }),
        Field::new("cause_share", |camera| camera.fit.links.first().map(|link| link.share).into()),
    ]
}

fn csv(patches: &[RecordedPatch], ranked: &[RankedCamera]) -> String {
    Table::of(&columns(), cameras(ranked, &names(patches))).csv(significant)
}

fn residuals(patches: &[RecordedPatch], ranked: &[RankedCamera]) -> String {
    let mut table = Table::new(["camera", "patch", "channel", "residual_percent", "excluded"]);
    for Ranked { name, fit, .. } in cameras(ranked, &[]) {
        for (patch, row) in patches.iter().zip(&fit.residuals) {
            for (value, channel) in row.iter().zip(CHANNELS) {
                let why = value.err().map_or_else(String::new, |why| why.to_string());
                let residual = in_percent(value.ok());
                table.push([name.into(), patch.name.as_str().into(), channel.into(), residual, why.into()]);
            }
        }
    }
    table.csv(significant)
}

fn json(patches: &[RecordedPatch], ranked: &[RankedCamera], freedom: Freedom) -> String {
    let names = names(patches);
    let cameras: Vec<Value> = cameras(ranked, &names).map(camera).collect();
    let recorded = |patch: &RecordedPatch| {
        let rgb = patch.rgb.map(|signal| signal.value().ok());
        let excluded = patch.rgb.map(|signal| signal.value().err().map(|why| why.to_string()));
        json!({ "name": patch.name, "rgb": rgb, "excluded": excluded })
    };
    let value = json!({
        "free": { "gains": freedom.gains, "brightness": freedom.brightness },
        "resamples": RESAMPLES,
        "patches": patches.iter().map(recorded).collect::<Vec<_>>(),
        "cameras": cameras,
    });
    format!("{value:#}\n")
}

fn camera(Ranked { place, rank, name, fit, patches }: Ranked<'_>) -> Value {
    let percent = |log: Option<f64>| log.map(|log| log * 100.0);
    let link = |link: &Link| {
        let kind = match link.kind {
            LinkKind::Light => "light",
            LinkKind::Channel(_) => "sensitivity",
            LinkKind::Patch(_) => "patch",
        };
        let words = cause_in_words(link.kind, link.amount, patches);
        json!({ "link": kind, "cause": words, "amount": link.amount, "share_of_squares": link.share })
    };
    json!({
        "rank": place + 1,
        "rank_range": rank.range,
        "first_share": rank.first,
        "camera": name,
        "rms_percent": fit.rms() * 100.0,
        "deviation_percent": fit.deviation() * 100.0,
        "channel_rms_percent": fit.channel_rms().map(percent),
        "gains": fit.gains,
        "brightness": fit.brightness,
        "values": fit.values,
        "parameters": fit.parameters,
        "residuals_percent": fit.residuals.iter().map(|row| row.map(|r| percent(r.ok()))).collect::<Vec<_>>(),
        "causes": fit.links.iter().map(link).collect::<Vec<_>>(),
    })
}
