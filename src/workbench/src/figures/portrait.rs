//! A head half as the reference sees it, half as a camera does.

use std::sync::Arc;

use chromascope_core::query::render::picture::{Pictures, PicturesQuery};
use chromascope_core::render::{RasterSize, Shadows};
use chromascope_figure::{Axis, Image, InkRole, Mark, Panel, Rect, Shape};

use crate::action::{Action, RenderAction};
use crate::catalog::Catalog;
use crate::document::SetKind;
use crate::document::start::Start;
use crate::plot_item::PickIndex;
use crate::results::Results;
use crate::scene::Scene;
use crate::scene::orbit::Orbit;
use crate::scene::render::Finish;

/// Size of the picture in pixels.
const SIZE: [u32; 2] = [440, 480];
/// Camera of the right half.
pub const CAMERA: &str = "Kodak DCS200";

/// The two pictures as a question: the reference first.
pub fn query(catalog: &Catalog, results: &Results) -> Option<PicturesQuery> {
    let mut document = Start::Paper.document();
    Action::Render(RenderAction::Figure8).apply(&mut document);
    document.compared.retain(|c| c.kind == SetKind::Observer || c.name == CAMERA);
    let scene = Scene { document: &document, catalog, results };
    let sources = scene.rendered_sources();
    let viewpoint = Orbit::of(&document.render).viewpoint(f64::from(SIZE[0]) / f64::from(SIZE[1]))?;
    let size = RasterSize { width: SIZE[0], height: SIZE[1], samples: 2 }.clamped();
    let (quality, shadows) = (document.render.quality(), Shadows::Full);
    let finish = Finish { size, quality, shadows, compared_samples: None, open_sky: false };
    scene.pictures_of(&sources, scene.mesh_of(None)?, viewpoint, finish, None).ok()
}

/// The two halves in a panel, on the surround; none where a picture is missing.
pub fn panel(pictures: &Pictures, size: [f64; 2]) -> Option<Panel> {
    let [left, right] = pictures.pictures.get(..2)? else { return None };
    let (left, right) = (left.as_ref().ok()?, right.as_ref().ok()?);
    let (width, height) = (left.width, left.height);
    if (right.width, right.height) != (width, height) {
        return None;
    }
    let cut = 4 * (width / 2);
    let lines = left.rgba.chunks_exact(4 * width).zip(right.rgba.chunks_exact(4 * width));
    let rgba: Vec<u8> = lines.flat_map(|(left, right)| left[..cut].iter().chain(&right[cut..]).copied()).collect();
    let image = Image { width, height, rgba: Arc::from(rgba) };
    let [x, y] = [width, height].map(|side| Axis::hidden([0.0, side as f64]));
    let mut panel = Panel::new("Head", Rect::from_min_size([0.0; 2], size), x, y);
    panel.background = InkRole::Surround.into();
    panel.framed = false;
    let shape = Shape::Image { min: [0.0; 2], max: [width as f64, height as f64], image };
    panel.marks.push(Mark::new(PickIndex::NONE, "Head", shape));
    Some(panel)
}
