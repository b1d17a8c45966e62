//! The answers that figures need as values: pictures, corrections, rankings, measurements.

use std::ffi::OsStr;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use chromascope_core::camera::recorded::Freedom;
use chromascope_core::query::{Ask as _, RecordedSet, Shared};
use chromascope_figure::FigureRoom;
use spectral_file::SpectralFile;

use crate::catalog::import::{Origin, imported};
use crate::catalog::spectral_images;
use crate::cli::error::{CliError, Result, refused};
use crate::cli::reading::in_file;
use crate::cli::render::arguments::ViewpointArguments;
use crate::cli::render::files::patiently;
use crate::cli::render::setup::{mesh_choice, own_mesh, viewpoint};
use crate::cli::request::Request;
use crate::document::Document;
use crate::document::imported::ImportOverrides;
use crate::document::render::{MeshChoice, RenderSettings};
use crate::export::Paper;
use crate::export::profile::{CorrectionFileQuery, CorrectionRequest};
use crate::figures::curves::{ImportItem, ImportSelection};
use crate::figures::kind::{FigureKind, Need};
use crate::figures::look::{FigureLook, RenderMode};
use crate::figures::render::picture_width;
use crate::figures::report_card;
use crate::format::display_path;
use crate::jobs::Job as _;
use crate::profiler::SceneRunJob;
use crate::render_service::RenderedFrame;
use crate::render_service::made::{PicturesAnswer, PicturesOf};
use crate::scene::Scene;
use crate::scene::orbit::Orbit;

/// Longest side of a picture in pixels.
const MOST_PIXELS: f64 = 2048.0;

/// What a figure takes without a window: the answer that its kind needs.
pub(super) fn look(
    (kind, wanted): (&FigureKind, ViewpointArguments),
    scene: &Scene<'_>,
    (paper, recorded): (&Paper, Option<RecordedSet>),
) -> Result<FigureLook> {
    let is_picture = matches!(kind.needs, Need::Pictures(_));
    let is_of_mesh = is_picture && !matches!(scene.document.render.mesh, MeshChoice::Image(_));
    if !is_of_mesh && (wanted.orbit.is_some() || wanted.fov.is_some()) {
        let argument = if wanted.orbit.is_some() { "--orbit" } else { "--fov" };
        return refused(argument, "only pictures of a mesh have a viewpoint");
    }
    let mut look = FigureLook::default();
    match kind.needs {
        Need::Nothing => {}
        Need::Pictures(mode) => {
            let made = patiently("rendering", || pictures(scene, mode, paper, wanted))?;
            (look.mode, look.pictures) = (mode, Some(Arc::new(made)));
        }
        Need::Correction => {
            if let Some(camera) = report_card::camera(scene, look.selected.as_ref()) {
                let request = CorrectionRequest { camera: &camera.name, ..CorrectionRequest::default() };
                let query = CorrectionFileQuery::new(scene, request)?;
                look.correction = Some((*scene.results.ask(&query)).clone()?);
            }
        }
        Need::Recorded => {
            let Some(set) = recorded else { return refused("FILE", "name the file with the raw values") };
            let ranking = scene.recorded_ranking(&set, Freedom::default(), &[])?;
            let ranked = patiently("fitting", || (*scene.results.ask(&ranking)).clone())?;
            look.recorded = Some((set, ranked));
        }
        Need::Curves => {
            let Some(set) = scene.document.own.last() else { return refused("FILE", "name the file") };
            look.curves = ImportSelection::of(scene, ImportItem::Set(set.name.clone()), None, None);
        }
        Need::Measured => {
            let own = own_mesh(&scene.document.render.mesh)?;
            let job = SceneRunJob::of(scene, own.as_ref(), None);
            look.measured.run = Some(patiently("measuring", || job.run(scene.results)));
            look.measured.is_current = true;
        }
    }
    Ok(look)
}

/// Pictures with as many pixels as the paper has where they stand.
fn pictures(scene: &Scene<'_>, mode: RenderMode, paper: &Paper, wanted: ViewpointArguments) -> Result<RenderedFrame> {
    let start = Instant::now();
    let sources = scene.rendered_sources();
    let count = sources.len() - usize::from(mode == RenderMode::Difference && sources.len() > 1);
    let width = paper.width_mm.map(|mm| mm / 25.4 * 72.0 / paper.scale());
    let points = picture_width(FigureRoom { width, ..FigureRoom::default() }, count) * paper.scale();
    let side = (points / 72.0 * paper.dpi).round().clamp(16.0, MOST_PIXELS) as u32;
    let frame = if let MeshChoice::Image(path) = &scene.document.render.mesh {
        let source = spectral_images::load(path).map_err(|error| CliError::File(error.to_string()))?.source;
        let query = scene.image_pictures(&source, &sources, scene.image_use(1))?;
        let answer = Arc::new(PicturesAnswer::Image(scene.results.ask(&query)));
        let (query, sources) = (PicturesOf::Image(query), sources.into());
        RenderedFrame { query, sources, answer, time: start.elapsed(), is_last: true, serial: 0 }
    } else {
        let own = own_mesh(&scene.document.render.mesh)?;
        let mesh = scene.mesh_of(own.as_ref()).ok_or_else(|| CliError::File("no mesh".to_owned()))?;
        let viewpoint = viewpoint(wanted, Orbit::of(&scene.document.render), scene.document.render.aspect())?;
        let frame = RenderedFrame::of_mesh(scene, mesh, viewpoint, side)?;
        RenderedFrame { time: start.elapsed(), ..frame }
    };
    let failed = frame.pictures().err().map(|why| CliError::File(format!("no picture: {why}")));
    failed.map_or(Ok(frame), Err)
}

/// Sets the mesh that is rendered, with the paper's surface for the fern.
pub(super) fn set_mesh(document: &mut Document, mesh: &OsStr) -> Result<()> {
    let mesh = mesh_choice(mesh)?;
    let usual = if mesh == MeshChoice::Fern { RenderSettings::fern() } else { document.render.clone() };
    document.render = RenderSettings { mesh, ..usual };
    Ok(())
}

/// Adds the curves of a file to the document's sets.
pub(super) fn open_curves(request: &mut Request, path: &Path) -> Result<()> {
    let bytes = request.bytes(path)?;
    let mut overrides = ImportOverrides::default();
    let origin = Origin::on_disk(&display_path(path), path, &bytes);
    let table = spectral_file::read(origin.source(&bytes), &overrides.options).and_then(SpectralFile::usable);
    let table = table.map_err(|error| in_file(path, error))?;
    overrides.taken = Some((0..table.curves.len()).collect());
    request.document.own.push(Shared::new(imported(&origin, &table, &overrides).set));
    Ok(())
}
