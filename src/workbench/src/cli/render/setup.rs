//! From arguments to a document with a rendered scene, a place to look from, and the size of the pictures.

use std::ffi::OsStr;
use std::path::Path;
use std::time::{Duration, Instant};

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::Shared;
use chromascope_core::reflectance::SurfaceError;
use chromascope_core::scene::Viewpoint;
use chromascope_core::scene::viewpoint::ViewpointError;
use chromascope_mesh::Mesh;
use clap::ArgMatches;

use super::arguments::{RenderArguments, ViewpointArguments};
use crate::catalog::meshes;
use crate::cli::error::{CliError, Result, refused};
use crate::cli::request::Request;
use crate::document::render::{BALANCE, MeshChoice, RenderSettings, SUN};
use crate::document::{Compared, Light, SetKind, WhiteBalanceChoice};
use crate::scene::orbit::Orbit;
use crate::scene::render::Finish;
use crate::terminal::say;
use chromascope_core::render::{QualityLevel, RasterSize};

pub(super) struct Setup {
    pub(super) request: Request,
    pub(super) viewpoint: Viewpoint,
    pub(super) finish: Finish,
    pub(super) own_mesh: Option<Shared<Mesh>>,
    /// Name of the mesh in file names.
    pub(super) mesh_name: String,
    /// Time taken to read the mesh.
    pub(super) reading: Duration,
}

impl Setup {
    pub(super) fn new(arguments: &RenderArguments, matches: &ArgMatches) -> Result<Self> {
        let choice = mesh_choice(&arguments.mesh)?;
        // What only arguments decide comes before files are read.
        let [width, height] = arguments.size.map(f64::from);
        let viewpoint = |settings: &RenderSettings| viewpoint(arguments.viewpoint, Orbit::of(settings), width / height);
        viewpoint(&RenderSettings::default())?;
        let size = raster(arguments)?;
        let mut request = compared_request(arguments, matches)?;
        let start = request.document.render.clone();
        request.document.render = settings(arguments, choice, start)?;
        request.values = arguments.values;
        if let Some(material) = &arguments.material {
            request.document.render.material = request.material("--material", material)?;
        }
        if let Some(garment) = &arguments.garment {
            let is_bare = garment.eq_ignore_ascii_case("none");
            let garment = if is_bare { None } else { Some(request.material("--garment", garment)?) };
            request.document.render.garment = garment;
        }
        let start = Instant::now();
        let own_mesh = own_mesh(&request.document.render.mesh)?;
        let finish = Finish::whole(size, request.document.render.quality());
        let mesh_name = mesh_name(&request.document.render.mesh);
        let viewpoint = viewpoint(&request.document.render)?;
        Ok(Self { request, viewpoint, finish, own_mesh, mesh_name, reading: start.elapsed() })
    }
}

/// Sensors, reference, light, white balance and metric: all but the scene.
pub(super) fn compared_request(arguments: &RenderArguments, matches: &ArgMatches) -> Result<Request> {
    let mut request = Request::of_sources(&arguments.sources, matches)?;
    if arguments.sources.names_no_sensor() {
        let Request { document, sources, .. } = &mut request;
        sources.retain(|(kind, name)| *kind == SetKind::Camera || *name == document.reference);
    }
    match &arguments.illuminant {
        Some(illuminant) => request.set_light(illuminant)?,
        None => request.document.light = Light::Set(SUN.to_owned()),
    }
    request.set_filters(&arguments.filter)?;
    match &arguments.white {
        Some(white) => request.set_white(white)?,
        None => request.document.white = WhiteBalanceChoice::Light(BALANCE.to_owned()),
    }
    if let Some(metric) = arguments.difference.as_deref().and_then(Metric::by_id) {
        if !request.document.transform.metrics().contains(&metric) {
            let reason = format!("{} has no meaning with the paper's matrix; add --transform fitted", metric.symbol);
            return refused("--difference", reason);
        }
        request.document.difference = metric;
    }
    request.document.exaggeration = arguments.exaggerate;
    for (slot, (kind, name)) in request.sources.iter().enumerate() {
        let known = |other: &Compared| other.kind == *kind && other.name == *name;
        if !request.document.compared.iter().any(known) {
            let slot = slot.min(usize::from(u8::MAX)) as u8;
            let compared = Compared { name: name.clone(), kind: *kind, slot, visible: true, label: None };
            request.document.compared.push(compared);
        }
    }
    Ok(request)
}

const MESHES: [MeshChoice; 4] = [MeshChoice::Head, MeshChoice::Fern, MeshChoice::Sphere, MeshChoice::Plane];

pub(in crate::cli) fn mesh_choice(given: &OsStr) -> Result<MeshChoice> {
    let typed = &*given.to_string_lossy();
    if let Some(known) = MESHES.into_iter().find(|mesh| typed.trim().eq_ignore_ascii_case(&mesh.name())) {
        return Ok(known);
    }
    let path = Path::new(given);
    if path.is_file() || path.extension().is_some() || typed.contains(['/', '\\']) {
        return Ok(MeshChoice::File(path.to_owned()));
    }
    let alike = MESHES.map(|mesh| (strsim::jaro_winkler(&typed.to_lowercase(), &mesh.name()), mesh.name()));
    let nearest = alike.into_iter().filter(|(score, _)| *score > 0.7).max_by(|a, b| a.0.total_cmp(&b.0));
    let hint = nearest.map_or_else(String::new, |(_, name)| format!("did you mean {name}? "));
    let reason = format!(
        "no mesh is named \"{typed}\"; {hint}use head, fern, sphere, plane, or the path of an OBJ, PLY or STL file"
    );
    refused("--mesh", reason)
}

fn mesh_name(choice: &MeshChoice) -> String {
    match choice {
        MeshChoice::File(path) => path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()),
        own => own.name(),
    }
}

/// The mesh of the user's file, if one is chosen.
pub(in crate::cli) fn own_mesh(choice: &MeshChoice) -> Result<Option<Shared<Mesh>>> {
    let MeshChoice::File(path) = choice else { return Ok(None) };
    // Whole, so that a complaint can say in which folder the file is not.
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.clone());
    let read = meshes::read(&whole, &|| false).map_err(|failure| CliError::File(failure.to_string()))?;
    for note in &read.notes {
        say(&format!("chromascope: {}: {note}\n", path.display()));
    }
    Ok(Some(read.mesh))
}

const NO_DIRECTION: &str =
    "a direction of zero length; use one such as -0.4,0.5,1: 0.4 to the left, 0.5 up, 1 toward the viewer";

/// Render settings: those of the paper's head or fern with the arguments applied.
fn settings(arguments: &RenderArguments, mesh: MeshChoice, start: RenderSettings) -> Result<RenderSettings> {
    let usual = if mesh == MeshChoice::Fern { RenderSettings::fern() } else { RenderSettings::default() };
    let RenderSettings { material, index, thin, .. } = usual;
    let usual = RenderSettings { mesh, material, index, thin, sunlight: false, ..start };
    let mut settings = arguments.settings.applied_to(usual);
    if arguments.settings.has("tolerance") {
        settings.quality = QualityLevel::Tolerance;
    }
    if let Some([x, y, z]) = arguments.light {
        let length = x.hypot(y).hypot(z);
        if !(length > 0.0 && length.is_finite()) {
            return refused("--light", NO_DIRECTION);
        }
        settings.light_up_deg = y.atan2(x.hypot(z)).to_degrees();
        settings.light_right_deg = x.atan2(z).to_degrees();
    }
    settings.surface().map_err(surface_error)?;
    Ok(settings)
}

/// The argument that a surface was refused for, with what would do.
fn surface_error(error: SurfaceError) -> CliError {
    let (argument, remedy) = match error {
        SurfaceError::Sigma => ("--sigma", "write meters, such as 5e-6 for 5 µm"),
        SurfaceError::Tau => ("--tau", "write meters, such as 10e-6 for 10 µm"),
        SurfaceError::Patch => ("--half-widths", "write meters, such as 50e-6,50e-6 for 50 µm each"),
        SurfaceError::Index => ("--ior", "skin has 1.4, a leaf 1.45"),
    };
    CliError::Argument { argument, reason: format!("{error}; {remedy}") }
}

/// Viewpoint for a picture of some width over height, where not stated the usual one.
pub(in crate::cli) fn viewpoint(arguments: ViewpointArguments, usual: Orbit, aspect: f64) -> Result<Viewpoint> {
    let Some([yaw, pitch, distance]) = arguments.orbit else {
        let field = arguments.fov.unwrap_or(usual.field_of_view_deg);
        Viewpoint::new(0.0, 0.0, 1.0, field.to_radians()).map_err(viewpoint_error)?;
        let framed = usual.with_field_of_view(field);
        return framed.viewpoint(aspect).ok_or_else(|| viewpoint_error(ViewpointError::Distance));
    };
    if pitch.abs() > 90.0 {
        return refused("--orbit", format!("{pitch}° is beyond the poles; use a pitch from -90 to 90"));
    }
    let as_shown = || usual.viewpoint(aspect).map_or(usual.field_of_view_deg.to_radians(), |v| v.field_of_view());
    let field = arguments.fov.map_or_else(as_shown, f64::to_radians);
    Viewpoint::new(yaw.to_radians(), pitch.to_radians(), distance, field).map_err(viewpoint_error)
}

fn viewpoint_error(error: ViewpointError) -> CliError {
    let (argument, example) = match error {
        ViewpointError::FieldOfView => ("--fov", "such as 30"),
        ViewpointError::Distance | ViewpointError::NotFinite => ("--orbit", "such as 20,5,3.6"),
    };
    CliError::Argument { argument, reason: format!("{error}, {example}") }
}

/// Beyond this many samples memory runs out on small machines.
const MOST_SAMPLES: u64 = 40_000_000;

fn raster(arguments: &RenderArguments) -> Result<RasterSize> {
    let [width, height] = arguments.size;
    let samples = arguments.samples;
    let size = RasterSize { width, height, samples };
    let count = u64::from(width) * u64::from(height) * u64::from(samples * samples);
    if count > MOST_SAMPLES || size.clamped() != size {
        let millions = count.div_ceil(1_000_000);
        let reason = format!(
            "{width}x{height} with {samples} x {samples} samples a pixel are {millions} million samples; the limits \
             are {} million, and {} along a side",
            MOST_SAMPLES / 1_000_000,
            chromascope_core::render::visibility::MAX_SIDE
        );
        return refused("--size", reason);
    }
    Ok(size)
}
