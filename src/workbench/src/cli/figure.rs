//! Figures for paper as PDF, SVG, PNG, TIFF, or the numbers behind them.

pub(super) mod arguments;
mod made;

use std::path::Path;

use chromascope_core::query::RecordedSet;
use chromascope_figure::{Figure, Page};
use clap::ArgMatches;

use self::arguments::{FigureArguments, Range};
use super::arguments::LOCUS_K;
use super::error::{Result, refused};
use super::identify::recorded_table;
use super::outputs::{self, Stop};
use super::reading::in_file;
use super::request::Request;
use crate::catalog::recorded::Levels;
use crate::document::{Document, LOCUS_RANGE_K, SetKind, session};
use crate::export::{FigureForm, Paper};
use crate::figures::kind::Need;
use crate::results::Results;
use crate::scene::Scene;

pub(super) fn run(arguments: &FigureArguments, matches: &ArgMatches) -> Result<()> {
    let out = arguments.common.out.path.as_deref();
    let Some(form) = out.and_then(FigureForm::of) else {
        return refused("--out", "a file that ends in .pdf, .svg, .png, .tif, .csv, .json or .tex is needed");
    };
    let mut request = Request::new(&arguments.common, matches)?;
    let recorded = prepare(&mut request, arguments)?;
    arguments.common.out.check(&request)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let paper = arguments.paper.paper();
    let Some(kind) = arguments.kind.0 else {
        return refused(
            "KIND",
            "skipped work is a table: `chromascope render --stats -`, or Statistics under Help > Numerics",
        );
    };
    let mut look = made::look((kind, arguments.viewpoint), &scene, (&paper, recorded))?;
    look.difference_plane = arguments.plane;
    if let Range::Of(ranges) = arguments.paper.range {
        look.diagram.zoomed = Some(ranges);
    }
    let Some(figure) = kind.on_paper(&paper, &scene, &look) else {
        return refused("KIND", "there is nothing to draw: no camera is compared, or it cannot be computed");
    };
    check_height(&figure, &paper, form)?;
    check_limits(&figure, &paper)?;
    let bytes = form.bytes(&figure, &figure.table.clone().with_constants(scene.conditions()), &paper)?;
    outputs::stream(out, |out| out.write_all(&bytes).map_err(Stop::Output))
}

/// Completes the document: the session or the sensors compared, a file's content, the mesh. Returns recorded raw values.
fn prepare(request: &mut Request, arguments: &FigureArguments) -> Result<Option<RecordedSet>> {
    request.set_chart(arguments.chart.as_deref())?;
    if let Some(light) = &arguments.second_light {
        request.set_second_light(light)?;
    }
    if let Some(path) = &arguments.session {
        request.document = opened(request, path)?;
    } else {
        check_cameras(request, arguments)?;
        let Request { document, sources, .. } = request;
        for (kind, name) in sources.iter() {
            document.compare(name, *kind);
        }
    }
    set_temperature(&mut request.document, arguments)?;
    if let Some(pixel) = arguments.pixel.pixel()? {
        request.document.pixel = Some(pixel);
    }
    request.document.exaggeration = arguments.exaggerate.unwrap_or(request.document.exaggeration);
    if let Some(mesh) = &arguments.mesh {
        made::set_mesh(&mut request.document, mesh)?;
    }
    match (&arguments.file, arguments.kind.0.map(|kind| kind.needs)) {
        (None, _) => Ok(None),
        (Some(path), Some(Need::Recorded)) => recorded_table(request, path, Levels::default()).map(Some),
        (Some(path), Some(Need::Curves)) => made::open_curves(request, path).map(|()| None),
        (Some(_), _) => refused("FILE", "only `curves` and `recorded` are of a file"),
    }
}

/// Refuses more cameras than the figure shows, rather than to leave some out.
fn check_cameras(request: &Request, arguments: &FigureArguments) -> Result<()> {
    let Some(kind) = arguments.kind.0.filter(|_| !arguments.common.sources.camera.is_empty()) else { return Ok(()) };
    let named = request.sources.iter().filter(|(kind, _)| *kind == SetKind::Camera).count();
    if named <= kind.cameras {
        return Ok(());
    }
    let shown = if kind.cameras == 1 { "one camera" } else { "two cameras" };
    refused("--camera", format!("`{}` shows {shown}, and {named} are named", kind.key))
}

/// Chooses the temperature that marks the loci and that locus metrics are of.
fn set_temperature(document: &mut Document, arguments: &FigureArguments) -> Result<()> {
    let refused = |reason: String| refused("--temperature", reason);
    let [low, high] = LOCUS_RANGE_K;
    match (arguments.temperature, document.radiator_k()) {
        (Some(wanted), _) if !(low..=high).contains(&wanted) => {
            refused(format!("{wanted} is out of range; use kelvins from {low} to {high}"))
        }
        (Some(wanted), Some(of_light)) if wanted != of_light => {
            refused(format!("the light's own temperature, {of_light} K, marks the loci; leave --temperature out"))
        }
        (Some(wanted), _) => {
            document.temperature_k = wanted;
            Ok(())
        }
        (None, None) if arguments.session.is_none() && arguments.kind.0.is_some_and(|kind| kind.is_of_metrics) => {
            document.temperature_k = LOCUS_K;
            Ok(())
        }
        (None, _) => Ok(()),
    }
}

/// Refuses a height that a figure cannot take, because its rows or pictures have theirs.
fn check_height(figure: &Figure, paper: &Paper, form: FigureForm) -> Result<()> {
    let Some(wanted) = paper.height_mm.filter(|_| !form.is_numbers()) else { return Ok(()) };
    let height = Page::new(figure, &paper.page_style()).area.height() * paper.scale() / 72.0 * 25.4;
    if (height - wanted).abs() < 1.0 {
        return Ok(());
    }
    let reason = format!("at this width and size of text the figure is {height:.0} mm high; leave --height out");
    refused("--height", reason)
}

/// Refuses ends of axes for a figure without any.
fn check_limits(figure: &Figure, paper: &Paper) -> Result<()> {
    let limits = [("--x-range", paper.x_range), ("--y-range", paper.y_range)];
    match limits.into_iter().find(|(_, [from, to])| from != to) {
        Some((flag, _)) if figure.panels.iter().all(|panel| !panel.framed) => {
            refused(flag, "this figure has no axis to set: its plots share one scale, or it shows pictures or swatches")
        }
        _ => Ok(()),
    }
}

pub(super) fn opened(request: &mut Request, path: &Path) -> Result<Document> {
    let text = String::from_utf8(request.bytes(path)?).map_err(|_| in_file(path, "it is not text"))?;
    let mut document = session::from_json(&text).map_err(|error| in_file(path, error))?;
    // A session names a mesh without its folder: it is beside it.
    if let (Some(mesh), Some(folder)) = (document.render.mesh.file_mut(), path.parent()) {
        *mesh = folder.join(&*mesh);
    }
    Ok(document)
}
