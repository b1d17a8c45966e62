//! `recover narrowband`.

use std::path::PathBuf;

use chromascope_core::query::Ask as _;
use chromascope_core::recovery::{NarrowBandRecovery, NarrowBands};
use clap::Args;

use super::{UNNAMED, Written, put};
use crate::catalog::narrow_bands::read_pass;
use crate::cli::error::{Result, refused};
use crate::cli::outputs::{check, show};
use crate::cli::request::{Request, in_file};
use crate::document::start::Start;
use crate::export::measured;
use crate::format::display_path;
use crate::results::Results;
use crate::scene::{Scene, SceneError};

#[derive(Debug, Args)]
pub(super) struct NarrowBandArguments {
    /// Tables with the columns `wavelength_nm`, `power`, `exposure_s`, `red`, `green`, `blue`, `dark_red`, `dark_green`, `dark_blue` and,
    /// where it is known, `width_nm`: one for each pass over the same bands
    #[arg(value_name = "PASS", required = true)]
    files: Vec<PathBuf>,
    /// Raw value from which on a lit mean is saturated
    #[arg(long, value_name = "LEVEL")]
    clip: f64,
    #[command(flatten)]
    written: Written,
}

pub(super) fn run(arguments: &NarrowBandArguments) -> Result<()> {
    if arguments.clip.is_nan() || arguments.clip <= 0.0 {
        return refused("--clip", "the end of the scale is a positive number");
    }
    let mut request = Request::of_cameras(Start::Colorimetry, "--camera", &[], None)?;
    let mut passes = Vec::new();
    for file in &arguments.files {
        let bytes = request.bytes(file)?;
        passes.push(read_pass(&bytes).map_err(|error| in_file(file, error))?);
    }
    check(arguments.written.out.as_deref(), &request.inputs(), arguments.written.force)?;
    arguments.written.format()?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let query = scene.measured_bands(NarrowBands { passes, clip: arguments.clip });
    let found = (*results.ask(&query)).clone().map_err(|error| match error {
        SceneError::NarrowBands(error) => in_file(&arguments.files[0], error),
        other => other.into(),
    })?;
    show(&text(&found))?;
    let files: Vec<String> = arguments.files.iter().map(|file| display_path(file)).collect();
    let (count, passes) = (found.curves.wavelengths_nm.len(), files.len());
    let method = format!("raw means of {count} narrow bands, {passes} passes");
    let (written, files) = (&arguments.written, files.join(", "));
    let title = written.title.as_deref().unwrap_or(UNNAMED);
    put(title, &found.curves, written, &written.provenance(&files, &method, measured::BAND_REDUCTION))
}

fn text(found: &NarrowBandRecovery) -> String {
    measured::bands(found).to_text() + &measured::band_conditions(found).join("\n") + "\n"
}
