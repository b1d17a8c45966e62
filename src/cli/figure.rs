//! Figures for paper as PDF, SVG, PNG, or the numbers behind them.

pub(super) mod arguments;

use std::path::Path;

use chromascope_figure::{Figure, FigureRoom};
use clap::ArgMatches;

use self::arguments::{FigureArguments, FigureKind, RangeName};
use super::error::CliError;
use super::outputs::{self, Stop};
use super::request::Request;
use crate::document::{Document, session};
use crate::export::FigureForm;
use crate::figures::{FigureInput, chromaticity, light, metrics, report_card, spectra, swatches};
use crate::results::Results;
use crate::scene::Scene;
use crate::scene::conditions::CONDITIONS;
use crate::view::{DiagramFit, View};

/// Draws a figure and writes it.
pub(super) fn run(arguments: &FigureArguments, matches: &ArgMatches) -> Result<(), CliError> {
    let out = arguments.common.out.as_deref();
    let form = out.and_then(FigureForm::of).ok_or_else(|| {
        let reason = "a file that ends in .pdf, .svg, .png or .csv is needed".to_owned();
        CliError::Argument { argument: "--out", reason }
    })?;
    let mut request = Request::new(&arguments.common, matches)?;
    request.set_chart(arguments.chart.as_deref())?;
    let mut inputs = request.inputs();
    let document = match &arguments.session {
        None => {
            let Request { document, sources, .. } = &mut request;
            for (kind, name) in sources.iter() {
                document.compare(name, *kind);
            }
            document.clone()
        }
        Some(path) => {
            inputs.push(path.clone());
            opened(&mut request, path)?
        }
    };
    outputs::check(out, &inputs, arguments.common.force)?;
    let results = Results::default();
    let scene = Scene { document: &document, catalog: &request.catalog, results: &results };
    let paper = arguments.paper.paper();
    let full = arguments.paper.range == RangeName::Full;
    let make = |room| figure(arguments.kind, &scene, room, full);
    let figure = paper.laid_out(make).ok_or_else(|| {
        let reason = "there is nothing to draw: no camera is compared, or it cannot be computed".to_owned();
        CliError::Argument { argument: "KIND", reason }
    })?;
    let cells: Vec<_> = CONDITIONS.into_iter().zip(scene.conditions()).collect();
    let bytes = form.bytes(&figure, &figure.table.clone().with_constants(&cells), &paper)?;
    outputs::stream(out, |out| out.write_all(&bytes).map_err(Stop::Output))
}

fn opened(request: &mut Request, path: &Path) -> Result<Document, CliError> {
    let failed = |reason: String| CliError::File(format!("{}: {reason}", super::request::told(path)));
    let text = String::from_utf8(request.bytes(path)?).map_err(|_| failed("it is not text".to_owned()))?;
    session::from_json(&text).map_err(|error| failed(error.to_string()))
}

fn figure(kind: FigureKind, scene: &Scene<'_>, room: FigureRoom, full: bool) -> Option<Figure> {
    let mut view = View { room, ..View::default() };
    if full {
        view.saved.diagram_fit = DiagramFit::Whole;
    }
    let input = FigureInput::new(scene, &view);
    match kind {
        FigureKind::Chromaticity => Some(chromaticity::figure(scene, &view)),
        FigureKind::Spectra => Some(spectra::figure(scene, &view)),
        FigureKind::Swatches => Some(swatches::figure(scene, &view)),
        FigureKind::Light => light::figure(scene, &view),
        FigureKind::Metrics => metrics::figure(&input),
        FigureKind::ReportCard => report_card::figure(&input),
    }
}
