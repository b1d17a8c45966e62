//! `report`: the paper's figures and claims with public data, or a comparison of one's own, as files in a folder.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{ArgMatches, Args};

use super::error::{CliError, Result};
use super::figure::opened;
use super::outputs::{self, show, write_to};
use super::reading::Per;
use super::render::make_folder;
use super::render::setup::own_mesh;
use super::request::Request;
use crate::document::start::Start;
use crate::document::{Document, SetKind};
use crate::report::{PAGE, PIXELS, Report};
use crate::results::Results;
use crate::terminal::draw_progress;

const EXAMPLES: &str = "Examples:
  chromascope report --out report
  chromascope report --out sent --session work.chromascope
  chromascope report --out mine --camera \"Canon EOS 5D Mark II\" --camera mine.csv --chart \"ColorChecker 24\"

The folder gets Figures 1 to 9 of the paper as PDF, SVG, PNG and CSV (the numbers behind them), claims.csv with each claim, what is
found and its rounding (half of the last digit, not how well it is known), and report.html: one page with all of that, without links
to the network. Claims about cameras that are not in the report are not judged; checks beyond the paper stand apart.

With --session, report.html is about that session's comparison in its place: conditions, ranking with uncertainties, worst patches,
figures and the sources of its data, on one page to send; what the session names and is not there is said. ranking.csv has all metrics.";

/// Figures and claims of the 2007 paper with public data, or a session's comparison, on one page
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct ReportArguments {
    /// A folder, made if it is not there
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
    /// A session of the window, whose comparison is reported in place of the paper
    #[arg(long, value_name = "FILE", conflicts_with_all = ["camera", "chart", "illuminant"])]
    session: Option<PathBuf>,
    /// A camera in place of the paper's, a file with three sensitivities, or a folder of such files; may be repeated
    #[arg(long, value_name = "NAME|FILE")]
    camera: Vec<OsString>,
    /// Unit of the sensitivities in camera files, overriding the files: response per energy or per photon
    #[arg(long, value_enum, value_name = "UNIT", requires = "camera")]
    per: Option<Per>,
    /// A chart, a material, or a file with reflectances in place of the five patches
    #[arg(long, value_name = "NAME|FILE")]
    chart: Option<OsString>,
    /// A light in place of equal energy and of sunlight: a name, a file with one curve, `daylight:K` or `blackbody:K`
    #[arg(long, value_name = "NAME|FILE")]
    illuminant: Option<OsString>,
    /// Width and height of a rendered picture in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = PIXELS, value_parser = clap::value_parser!(u32).range(16..=2048))]
    picture_size: u32,
    /// Overwrites the files of an earlier report
    #[arg(long)]
    force: bool,
}

pub(super) fn run(arguments: &ReportArguments, _: &ArgMatches) -> Result<()> {
    let mut request = Request::of_cameras(Start::Paper, "--camera", &arguments.camera, arguments.per)?;
    request.set_chart(arguments.chart.as_deref())?;
    if let Some(illuminant) = &arguments.illuminant {
        request.set_light(illuminant)?;
    }
    let (folder, pixels) = (&arguments.out, arguments.picture_size);
    let report = if let Some(path) = &arguments.session {
        request.document = opened(&mut request, path)?;
        let mesh = own_mesh(&request.document.render.mesh).map_err(|error| error.to_string());
        Report::on_comparison(&request.document, mesh, pixels)
    } else {
        Report::new(document(&request), arguments.illuminant.is_some(), pixels)
    };
    let paths: Vec<PathBuf> = report.names().iter().map(|name| folder.join(name)).collect();
    outputs::check(paths.iter().map(PathBuf::as_path), &request.inputs(), arguments.force)?;
    make_folder(folder)?;
    let results = Results::default();
    for step in 0..report.steps() {
        draw_progress(step, report.steps(), &report.name(step));
        let files = report.make(step, &results).map_err(CliError::File)?;
        for file in files {
            write_to(&folder.join(&file.name), &file.bytes)?;
        }
    }
    draw_progress(report.steps(), report.steps(), "");
    show(&format!("{}\n", folder.join(PAGE).display()))
}

/// The paper's start with the cameras that were named.
fn document(request: &Request) -> Document {
    let mut document = request.document.clone();
    if request.sources.is_empty() {
        document.compared = Start::Paper.document().compared;
        return document;
    }
    document.compare(&document.reference.clone(), SetKind::Observer);
    for (kind, name) in &request.sources {
        document.compare(name, *kind);
    }
    document
}
