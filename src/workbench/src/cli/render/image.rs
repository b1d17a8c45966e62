//! `render --image`: a spectral image through cameras and observers.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use chromascope_core::camera::RenderingError;
use chromascope_core::colorimetry::Metric;
use chromascope_core::query::render::difference::Difference;
use chromascope_core::query::{Ask as _, RenderingQuery};
use clap::ArgMatches;

use super::arguments::{Format, RenderArguments};
use super::files::{file_names, make_folder, patiently};
use super::no_difference;
use super::setup::compared_request;
use crate::catalog::spectral_images::{self, OpenImageError, ReadSignalsError};
use crate::cli::error::{CliError, Result};
use crate::cli::outputs::{self, show, write_to};
use crate::cli::reading::in_file;
use crate::document::TransformChoice;
use crate::document::render::RenderSettings;
use crate::export::render::{exr_bytes, image_header, png_bytes};
use crate::format::{display_path, fixed};
use crate::results::Results;
use crate::scene::spectral_image::{ImagePictures, ImagePicturesError, ImageUse};
use crate::scene::{ComparedSensor, Scene, SceneError};
use crate::terminal::say;

pub(super) fn run(arguments: &RenderArguments, path: &Path, matches: &ArgMatches) -> Result<()> {
    let start = Instant::now();
    let settings = arguments.settings.applied_to(RenderSettings::default());
    let wanted = settings.image_quantity;
    let opened = |error: OpenImageError| CliError::File(error.to_string());
    let info = spectral_images::open(path, wanted).map_err(opened)?.info().clone();
    for note in &info.notes {
        say(&format!("chromascope: {}: {note}\n", display_path(path)));
    }
    if let [Some(first), Some(last)] = [info.wavelengths_nm.first(), info.wavelengths_nm.last()]
        && (*first > 400.0 || *last < 700.0)
    {
        let held = "beyond them the first and last band were held";
        say(&format!("chromascope: {}: bands from {first} to {last} nm; {held}\n", display_path(path)));
    }
    let request = compared_request(arguments, matches)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let sources = scene.sources();
    let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let files = file_names(arguments, &name, &sources);
    let inputs: Vec<PathBuf> = request.inputs().into_iter().chain([path.to_owned()]).collect();
    outputs::check(files.iter().map(PathBuf::as_path), &inputs, arguments.force)?;
    make_folder(&arguments.out)?;
    let (scale, exposure_ev) = (settings.image_scale, settings.exposure_ev);
    let wanted = ImageUse { quantity: wanted, scale, exposure_ev, step: 1 };
    let source = spectral_images::load(path).map_err(opened)?.source;
    let query = scene.image_pictures(&source, &sources, wanted)?;
    let made = patiently("rendering", || results.ask(&query));
    let made = (*made).as_ref().map_err(|error| failure(path, error))?;
    let mut lines = String::new();
    for (index, file) in files.iter().enumerate() {
        let bytes = bytes(&scene, (&sources[index], &query.sources[index].0), made, index, arguments, &name)?;
        write_to(file, &bytes)?;
        let words = difference(&scene, &sources[index], made.differences[index].as_deref());
        let _ = writeln!(lines, "{}: {words}", file.display());
    }
    let (count, pixels) = (files.len(), made.placed().samples().len());
    let plural = if count == 1 { "" } else { "s" };
    let time = start.elapsed().as_secs_f64() * 1e3;
    let white =
        if made.white == 1.0 { String::new() } else { format!("; white at Y = {:.6e} of the image", made.white) };
    let _ = writeln!(
        lines,
        "{count} picture{plural} of {}x{}, {} bands, {pixels} of {} pixels with values{white}: {time:.0} ms, {:.1} MB of samples at once",
        info.width,
        info.height,
        info.wavelengths_nm.len(),
        info.width * info.height,
        made.image.read.tile_bytes as f64 / 1e6,
    );
    show(&lines)
}

fn failure(path: &Path, error: &ImagePicturesError) -> CliError {
    match error {
        ImagePicturesError::Read(ReadSignalsError::Open(error)) => CliError::File(error.to_string()),
        ImagePicturesError::Quantity => {
            CliError::File(format!("{}: {error}; add --image-quantity reflectance or radiance", display_path(path)))
        }
        other => in_file(path, other),
    }
}

fn bytes(
    scene: &Scene<'_>,
    (source, rendering): (&ComparedSensor, &RenderingQuery),
    made: &ImagePictures,
    index: usize,
    arguments: &RenderArguments,
    image: &str,
) -> Result<Vec<u8>> {
    let refused = |error: &RenderingError| SceneError::Rendering { name: source.name.clone(), error: *error };
    let picture = made.pictures[index].as_ref().map_err(refused)?;
    let rendering = scene.results.ask(rendering);
    let rendering = (*rendering).as_ref().map_err(refused)?;
    let written = if arguments.format == Format::Png {
        png_bytes(picture)
    } else {
        let header = image_header(rendering, &source.name, &[scene.light_name(), scene.document.white.name()], image);
        exr_bytes(made.placed(), made.signals(index).unwrap_or_default(), rendering, header)
    };
    written.map_err(|error| CliError::Picture { path: PathBuf::from(image), error })
}

fn difference(scene: &Scene<'_>, source: &ComparedSensor, difference: Option<&Difference>) -> String {
    let by_eq_13 = scene.document.transform == TransformChoice::Paper;
    let metric: Metric = scene.document.difference;
    match difference {
        _ if source.is_reference => "the reference".to_owned(),
        Some(difference) => {
            let number = |value: f64| fixed(value, metric.decimals);
            let [median, p95] = difference.bright.map_or([f64::NAN; 2], |all| [all.median, all.p95]);
            format!(
                "{} mean {}, median {}, 95 % {}, max {}",
                metric.name(by_eq_13),
                number(difference.mean),
                number(median),
                number(p95),
                number(difference.max)
            )
        }
        None => no_difference(scene.comparable(source.kind, &source.name).ok().and_then(Result::err)),
    }
}
