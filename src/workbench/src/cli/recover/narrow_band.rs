//! `recover narrowband`.

use std::path::PathBuf;

use chromascope_core::query::Ask as _;
use chromascope_core::recovery::{NarrowBandRecovery, NarrowBands};
use clap::Args;

use super::{UNNAMED, Written, put};
use crate::catalog::narrow_bands::{parse_region, read_pass};
use crate::cli::error::{Result, refused};
use crate::cli::outputs::{check, show};
use crate::cli::reading::in_file;
use crate::cli::request::Request;
use crate::document::start::Start;
use crate::export::measured;
use crate::format::display_path;
use crate::results::Results;
use crate::scene::{Scene, SceneError};

#[derive(Debug, Args)]
pub(super) struct NarrowBandArguments {
    /// Tables with the columns `wavelength_nm`, `power`, `exposure_s`, `red`, `green`, `blue`, `dark_red`, `dark_green`, `dark_blue` and,
    /// where it is known, `width_nm`: one for each pass over the same bands. In place of the means, `picture` and `dark_picture` name
    /// linear pictures, as seen from the table's folder
    #[arg(value_name = "PASS", required = true)]
    files: Vec<PathBuf>,
    /// Raw value from which on a lit mean is saturated [default: the end of the pictures' scale]
    #[arg(long, value_name = "LEVEL")]
    clip: Option<f64>,
    /// Part of the pictures that counts, in pixels [default: the table's line `# region: LEFT,TOP,WIDTH,HEIGHT`, else the middle quarter of
    /// width and height]
    #[arg(long, value_name = "LEFT,TOP,WIDTH,HEIGHT", value_parser = region)]
    region: Option<[usize; 4]>,
    #[command(flatten)]
    written: Written,
}

pub(super) fn run(arguments: &NarrowBandArguments) -> Result<()> {
    if arguments.clip.is_some_and(|clip| clip.is_nan() || clip <= 0.0) {
        return refused("--clip", "the end of the scale is a positive number");
    }
    let mut request = Request::of_cameras(Start::Colorimetry, "--camera", &[], None)?;
    let (mut passes, mut pictures) = (Vec::new(), Vec::new());
    for file in &arguments.files {
        let bytes = request.bytes(file)?;
        let read = read_pass(&bytes, file.parent(), arguments.region, &|| true);
        let (pass, taken) = read.map_err(|error| in_file(file, error))?;
        passes.push(pass);
        pictures.extend(taken.map(|taken| (display_path(file), taken)));
    }
    let stated = pictures.iter().map(|(_, taken)| taken.clip).filter(|clip| clip.is_finite()).reduce(f64::min);
    let Some(clip) = arguments.clip.or(stated) else {
        return refused(
            "--clip",
            "name the raw value from which on a mean is saturated: the end of the camera's scale",
        );
    };
    check(arguments.written.out.as_deref(), &request.inputs(), arguments.written.force)?;
    arguments.written.format()?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let query = scene.measured_bands(NarrowBands { passes, clip });
    let found = (*results.ask(&query)).clone().map_err(|error| match error {
        SceneError::NarrowBands(error) => in_file(&arguments.files[0], error),
        other => other.into(),
    })?;
    let taken: Vec<String> = pictures.iter().map(|(file, taken)| format!("{file}: {taken}\n")).collect();
    show(&(text(&found) + &taken.concat()))?;
    let files: Vec<String> = arguments.files.iter().map(|file| display_path(file)).collect();
    let (count, passes) = (found.curves.wavelengths_nm.len(), files.len());
    let method = format!("raw means of {count} narrow bands, {passes} passes");
    let (written, files) = (&arguments.written, files.join(", "));
    let title = written.title.as_deref().unwrap_or(UNNAMED);
    put(title, &found.curves, written, &written.provenance(&files, &method, measured::BAND_REDUCTION))
}

fn region(text: &str) -> std::result::Result<[usize; 4], String> {
    parse_region(text).ok_or_else(|| "expected LEFT,TOP,WIDTH,HEIGHT in pixels".to_owned())
}

fn text(found: &NarrowBandRecovery) -> String {
    measured::bands(found).to_text() + &measured::band_conditions(found).join("\n") + "\n"
}
