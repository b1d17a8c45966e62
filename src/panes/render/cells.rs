//! Layout of pictures in the pane.

use egui::{Pos2, Rect, Vec2};

use crate::panes::context::PaneContext;
use crate::plot_item::SensorId;
use crate::scene::ComparedSensor;
use crate::view::RenderMode;

pub(super) const CAPTION: f32 = 24.0;
const GAP: f32 = 8.0;
const SCALE: f32 = 40.0;

#[derive(Clone, Copy, Debug)]
pub(super) struct PictureSlot {
    pub(super) source: usize,
    pub(super) caption: Rect,
    pub(super) picture: Rect,
}

pub(super) struct PictureLayout {
    pub(super) mode: RenderMode,
    /// The sensors that are requested, the reference first.
    pub(super) sources: Vec<ComparedSensor>,
    /// The pictures; the two halves of a split one share their place.
    pub(super) cells: Vec<PictureSlot>,
    pub(super) divider: Option<f32>,
    pub(super) scale: Option<Rect>,
    pub(super) pixels: [u32; 2],
}

impl PictureLayout {
    /// Places pictures in an area, as large as they can be.
    pub(super) fn new(all: &[ComparedSensor], body: Rect, pixels_per_point: f32, context: &PaneContext<'_>) -> Self {
        let mode = context.view.saved.render.mode;
        let (sources, shown) = match mode {
            RenderMode::Grid => (all.to_vec(), (0..all.len()).collect::<Vec<_>>()),
            RenderMode::Difference => (all.to_vec(), (1..all.len()).collect()),
            RenderMode::Split | RenderMode::One => {
                let chosen = chosen(all, context.view.render.chosen.as_ref());
                let mut sources = all.first().cloned().into_iter().collect::<Vec<_>>();
                sources.extend(chosen.filter(|source| !source.is_reference).cloned());
                let last = sources.len().saturating_sub(1);
                let shown = if mode == RenderMode::One { last..sources.len() } else { 0..sources.len() };
                (sources, shown.collect())
            }
        };
        let scale = (mode == RenderMode::Difference && !shown.is_empty())
            .then(|| Rect::from_min_max(Pos2::new(body.left(), body.bottom() - SCALE), body.max));
        let area = Rect::from_min_max(body.min, body.max - Vec2::new(0.0, scale.map_or(0.0, |s| s.height())));
        let overlaid = mode == RenderMode::Split;
        let image = context.images.chosen(&context.scene.document.render.mesh);
        let aspect = image.map(|image| image.info.width as f32 / image.info.height as f32);
        let (columns, size) = grid(area.size(), if overlaid { 1 } else { shown.len() });
        let pixels = [size.x, size.y].map(|side| (side * pixels_per_point).floor().max(1.0));
        let whole = Vec2::new(pixels[0], pixels[1]) / pixels_per_point;
        let snapped = |at: Pos2| {
            Pos2::new((at.x * pixels_per_point).round(), (at.y * pixels_per_point).round()) / pixels_per_point
        };
        let cell = |(index, &source): (usize, &usize)| {
            let index = if overlaid { 0 } else { index };
            let step = Vec2::new(size.x + GAP, size.y + CAPTION);
            let offset = Vec2::new((index % columns) as f32 * step.x, (index / columns) as f32 * step.y);
            let caption = Rect::from_min_size(area.min + offset, Vec2::new(size.x, CAPTION));
            let picture = Rect::from_min_size(snapped(caption.left_bottom()), whole);
            PictureSlot { source, caption, picture: fitted(picture, aspect) }
        };
        let cells: Vec<PictureSlot> = shown.iter().enumerate().map(cell).collect();
        let share = context.view.saved.render.split.clamp(0.0, 1.0);
        let divider = cells.first().filter(|_| overlaid).map(|cell| {
            let x = cell.picture.left() + share * cell.picture.width();
            (x * pixels_per_point).round() / pixels_per_point
        });
        Self { mode, sources, cells, divider, scale, pixels: pixels.map(|side| side as u32) }
    }

    pub(super) fn visible(&self, cell: usize) -> Rect {
        let mut visible = self.cells[cell].picture;
        if let Some(x) = self.divider {
            if cell == 0 {
                visible.max.x = x;
            } else {
                visible.min.x = x;
            }
        }
        visible
    }

    /// The source and the place in its picture that the pointer is on.
    pub(super) fn place_at(&self, pointer: Pos2) -> Option<(usize, [f64; 2])> {
        let cell = (0..self.cells.len()).find(|&cell| self.visible(cell).contains(pointer))?;
        let picture = self.cells[cell].picture;
        let at = (pointer - picture.min) / picture.size();
        Some((self.cells[cell].source, [at.x, at.y].map(|v| f64::from(v.clamp(0.0, 1.0)))))
    }
}

/// The sensor shown alone or with the reference: the chosen one, else the first camera, else the reference.
pub(super) fn chosen<'a>(all: &'a [ComparedSensor], chosen: Option<&SensorId>) -> Option<&'a ComparedSensor> {
    let is_chosen =
        |source: &&ComparedSensor| chosen.is_some_and(|id| source.kind == id.kind && source.name == id.name);
    all.iter().find(is_chosen).or_else(|| all.iter().find(|source| !source.is_reference)).or_else(|| all.first())
}

/// The largest rectangle of an aspect at the top of another; the other without an aspect.
fn fitted(place: Rect, aspect: Option<f32>) -> Rect {
    let Some(aspect) = aspect else { return place };
    let width = place.width().min(place.height() * aspect);
    let left = place.center().x - 0.5 * width;
    Rect::from_min_size(Pos2::new(left.round(), place.top()), Vec2::new(width, width / aspect))
}

/// Number of pictures side by side, and their size: such that the smaller side is as large as it can be.
fn grid(area: Vec2, count: usize) -> (usize, Vec2) {
    let mut best = (1, Vec2::splat(1.0));
    for columns in 1..=count.max(1) {
        let rows = count.div_ceil(columns).max(1);
        let width = (area.x - GAP * (columns - 1) as f32) / columns as f32;
        let height = area.y / rows as f32 - CAPTION;
        let size = Vec2::new(width.max(1.0), height.max(1.0));
        let better = size.min_elem() > best.1.min_elem() + 0.5;
        if better || columns == 1 {
            best = (columns, size);
        }
    }
    best
}
