//! Picture requests: coarse while something moves, then fine.

use std::path::Path;
use std::sync::Arc;

use chromascope_core::colorimetry::rgb::srgb_inverse_transfer;
use chromascope_core::query::Shared;
use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::query::render::{MeshQuery, SkyVisibilityQuery};
use chromascope_core::render::{Quality, RasterSize, Shadows};
use chromascope_mesh::Mesh;
use egui::Ui;

use super::draw::PictureLayout;
use crate::catalog::meshes::MeshState;
use crate::catalog::spectral_images::{ImageState, LoadedImage};
use crate::document::render::{MeshChoice, RenderSettings};
use crate::panes::context::PaneContext;
use crate::render_service::made::{NoPictures, PicturesOf};
use crate::scene::orbit::Orbit;
use crate::scene::render::Finish;
use crate::scene::spectral_image::{ImagePicturesError, screen_steps};
use crate::view::RenderMode;
use chromascope_core::render::QualityLevel;

/// Total number of pixels above which pictures of a moving scene have half the resolution.
const MANY_PIXELS: u64 = 1_500_000;
/// Maximum number of samples compared with the reference, while something moves and at rest.
const COMPARED: [usize; 2] = [2048, 16384];
/// Samples along the side of a pixel in the finest pictures, and the most in all: beyond, there are fewer to a pixel.
const SAMPLES: u32 = 3;
const MOST_SAMPLES: u64 = 6_000_000;
/// Below this tolerance a sample takes sums over wavelengths.
const TABLES_REACH: f64 = 1e-9;

/// Requests the visible pictures. Returns the reason if there are none.
pub(super) fn ask(ui: &Ui, layout: &PictureLayout, context: &mut PaneContext<'_>) -> Result<(), String> {
    let none = || "Add a camera at the left.".to_owned();
    let stages = if let MeshChoice::Image(path) = &context.scene.document.render.mesh {
        let image = image(path, context)?;
        if layout.cells.is_empty() {
            return Err(none());
        }
        let query = |step| {
            let pictures = context.scene.image_pictures(&image.source, &layout.sources, context.scene.image_use(step));
            pictures.map(PicturesOf::Image).map_err(|error| error.to_string())
        };
        screen_steps(&image.info).into_iter().map(query).collect::<Result<Vec<_>, _>>()?
    } else {
        let mesh = mesh(context)?;
        if layout.cells.is_empty() {
            return Err(none());
        }
        let wish = Wish { layout, mesh, context };
        let stages = [wish.first(), wish.middle(), wish.last()];
        stages.into_iter().map(|finish| wish.query(finish).map(PicturesOf::Mesh)).collect::<Result<Vec<_>, _>>()?
    };
    let (Some(first), Some(last)) = (stages.first().cloned(), stages.last().cloned()) else { return Err(none()) };
    let render_service = &mut *context.render_service;
    let known = render_service.has_made();
    let rest = render_service.want(&last, ui.input(|input| input.time));
    let moving = rest.is_some() && known;
    if let Some(rest) = rest {
        ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(rest));
        context.view.render.cancelled = false;
    }
    if context.view.render.cancelled {
        render_service.stay();
    } else if render_service.only_develops(&last) {
        render_service.ask(vec![last], &layout.sources, moving);
    } else if moving {
        render_service.ask(vec![first], &layout.sources, true);
    } else {
        // In some qualities the last two are the same.
        let mut stages = stages;
        stages.dedup();
        render_service.ask(stages, &layout.sources, false);
    }
    render_service.refresh();
    if let Some(Err(NoPictures::Image(why))) = render_service.frame().map(|frame| frame.pictures()) {
        let name = context.scene.document.render.mesh.name();
        let remedy = match &*why {
            ImagePicturesError::Quantity => "; choose Reflectance or Radiance in the settings of Pictures",
            _ => "",
        };
        return Err(format!("{name}: {why}{remedy}."));
    }
    render_service.failure().map_or(Ok(()), |why| Err(format!("No picture: {why}.")))
}

fn image(path: &Path, context: &PaneContext<'_>) -> Result<Arc<LoadedImage>, String> {
    match context.images.get(path) {
        ImageState::Ready(image) => Ok(image),
        ImageState::Loading => Err(format!("Reading {}…", crate::format::file_name(path))),
        ImageState::Failed(why) => Err(why),
    }
}

fn mesh(context: &PaneContext<'_>) -> Result<MeshQuery, String> {
    let own: Option<Shared<Mesh>> = match &context.scene.document.render.mesh {
        MeshChoice::File(path) => match context.meshes.get(path) {
            MeshState::Ready(mesh) => Some(mesh.mesh.clone()),
            MeshState::Loading => return Err(format!("Reading {}…", crate::format::file_name(path))),
            MeshState::Failed(why) => return Err(why),
        },
        _ => None,
    };
    context.scene.mesh_of(own.as_ref()).ok_or_else(|| "Choose a mesh, or open one.".to_owned())
}

/// The pictures as they are to be in the end, with the stages before.
struct Wish<'a, 'b> {
    layout: &'a PictureLayout,
    mesh: MeshQuery,
    context: &'a PaneContext<'b>,
}

impl Wish<'_, '_> {
    fn size(&self, samples: u32) -> RasterSize {
        let [width, height] = self.layout.pixels;
        RasterSize { width, height, samples }.clamped()
    }

    fn compared(&self, at_rest: usize) -> usize {
        match self.layout.mode {
            RenderMode::Difference => usize::MAX,
            _ => COMPARED[at_rest],
        }
    }

    /// While something moves.
    fn first(&self) -> Finish {
        let [width, height] = self.layout.pixels;
        let all = u64::from(width) * u64::from(height) * self.layout.sources.len() as u64;
        let size = if all > MANY_PIXELS {
            RasterSize::new(width.div_ceil(2), height.div_ceil(2)).clamped()
        } else {
            self.size(1)
        };
        let compared_samples = Some(self.compared(0));
        let open_sky = !self.sky_is_known();
        Finish { size, quality: Quality::Preview, shadows: Shadows::Coarse, compared_samples, open_sky }
    }

    /// True if it is known where the mesh hides the sky: only pictures at rest wait for that.
    fn sky_is_known(&self) -> bool {
        let through = self.context.scene.document.render.thin;
        let query = SkyVisibilityQuery { mesh: self.mesh.clone(), shadows: true, through };
        self.context.scene.results.known(&query).is_some()
    }

    /// At rest, before the slow part.
    fn middle(&self) -> Finish {
        let chosen = &self.context.scene.document.render;
        let quality = if is_slow(chosen) { Quality::Full } else { chosen.quality() };
        let compared_samples = Some(self.compared(1));
        Finish { size: self.size(1), quality, shadows: Shadows::Full, compared_samples, open_sky: false }
    }

    fn last(&self) -> Finish {
        let chosen = &self.context.scene.document.render;
        // Maps compare every sample, which costs more than all else: one a pixel is enough for them.
        let one = is_slow(chosen) || self.layout.mode == RenderMode::Difference;
        let [width, height] = self.layout.pixels.map(u64::from);
        let fits = |samples: &u32| width * height * u64::from(samples * samples) <= MOST_SAMPLES;
        let samples = if one { 1 } else { (2..=SAMPLES).rev().find(fits).unwrap_or(1) };
        Finish { size: self.size(samples), quality: chosen.quality(), ..self.middle() }
    }

    fn query(&self, finish: Finish) -> Result<PicturesQuery, String> {
        let look = &self.context.view.saved.render;
        let orbit = look.orbit.unwrap_or_else(|| Orbit::of(&self.context.scene.document.render));
        let [width, height] = self.layout.pixels;
        let viewpoint = orbit.viewpoint(f64::from(width) / f64::from(height.max(1))).ok_or("No such view.")?;
        let surround = self.context.theme.colors.surround.color();
        let linear = |channel: u8| srgb_inverse_transfer(f64::from(channel) / 255.0) as f32;
        let background = Some(surround.map(linear));
        let scene = &self.context.scene;
        let pictures = scene.pictures_of(&self.layout.sources, self.mesh.clone(), viewpoint, finish, background);
        pictures.map_err(|error| error.to_string())
    }
}

/// Returns true for a quality that sums over wavelengths at every sample.
fn is_slow(settings: &RenderSettings) -> bool {
    match settings.quality {
        QualityLevel::Preview | QualityLevel::Full | QualityLevel::Fine => false,
        QualityLevel::Reference | QualityLevel::Regimes => true,
        // Tables reach that far.
        QualityLevel::Tolerance => settings.tolerance < TABLES_REACH,
    }
}
