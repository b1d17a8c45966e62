//! Layout of pictures in the pane; drawing of them with captions, pinned pixel and divider.

use chromascope_figure::{Ink, InkRole, Panel, Rect as Area};
use egui::{Align2, CursorIcon, FontId, Key, Painter, Pos2, Rect, Sense, Stroke, TextStyle, Ui, UiBuilder, Vec2};

use crate::figures::chromaticity::{id, sign};
use crate::figures::filled;
use crate::figures::render::headline::{Detail, Measure};
use crate::figures::render::{difference as maps, has_reference_beside, index_of};
use crate::paint::{self, PictureQuery};
use crate::panes::context::PaneContext;
use crate::panes::widgets::pick_list::{self, Line};
use crate::panes::widgets::{self, lines};
use crate::plot_item::{PickIndex, SensorId};
use crate::render_service::RenderedFrame;
use crate::scene::ComparedSensor;
use crate::theme::TEXT;
use crate::view::RenderMode;

const WITH_NOTE: f32 = 150.0;
const WITH_MEASURE: f32 = 270.0;
const WITH_QUANTILES: f32 = 470.0;
const WITH_LARGEST: f32 = 540.0;
const HANDLE: f32 = 8.0;
const RING: f32 = 7.0;
const CHOOSER: Vec2 = Vec2::new(190.0, CAPTION - 2.0);

pub(super) fn pictures(ui: &mut Ui, painter: &Painter, layout: &PictureLayout, context: &mut PaneContext<'_>) {
    let shot = context.render_service.frame().cloned();
    let scale = shot.as_deref().filter(|_| layout.scale.is_some()).map(maps::Scale::of);
    for (index, cell) in layout.cells.iter().enumerate() {
        let Some(source) = layout.sources.get(cell.source) else { continue };
        let index_in =
            |source: &ComparedSensor| shot.as_deref().and_then(|shot| Some((shot, index_of(shot, &id(source))?)));
        let found = index_in(source);
        // While B is held, the reference replaces every camera; a map of differences has none.
        let blinking = context.view.blink && scale.is_none();
        let drawn = if blinking { layout.sources.first().and_then(index_in) } else { found };
        if let Some((shot, at)) = drawn {
            picture(ui, painter, layout, index, (shot, at), scale.filter(|_| !source.is_reference), context);
        }
        if layout.mode == RenderMode::Grid || layout.mode == RenderMode::Difference {
            let note = found.and_then(|(shot, at)| note(shot, at, cell.caption.width()));
            caption(ui, painter, cell, source, note.as_ref(), context);
        }
        ring(painter, layout, index, context);
    }
    if let (Some(rect), Some(scale), Some(shot)) = (layout.scale, scale, shot.as_deref()) {
        scale_of_differences(ui, painter, rect, scale, Measure::of_frame(shot).name(), context);
    }
}

fn picture(
    ui: &Ui,
    painter: &Painter,
    layout: &PictureLayout,
    cell: usize,
    (shot, at): (&RenderedFrame, usize),
    scale: Option<maps::Scale>,
    context: &mut PaneContext<'_>,
) {
    let rect = layout.cells[cell].picture;
    let clip = layout.visible(cell);
    let why = match shot.pictures().map(|pictures| pictures.pictures.get(at)) {
        Err(error) => error.to_string(),
        Ok(Some(Err(error))) => error.to_string(),
        Ok(None) => return,
        Ok(Some(Ok(made))) => {
            let source = &shot.sources[at];
            // Pixels of a small image stay squares.
            let sharp = [made.width, made.height] == layout.pixels.map(|side| side as usize)
                || (shot.query.image().is_some() && made.width < layout.pixels[0] as usize / 2);
            let name = format!("{} {}", source.kind.label(), source.name);
            match scale {
                None => {
                    let of = PictureQuery { name: &name, version: shot.serial, rect, clip, sharp };
                    of.draw(painter, || ([made.width, made.height], &made.rgba));
                    if let Some(note) = shot.query.exaggeration().note().filter(|_| !source.is_reference) {
                        let font = FontId::proportional(crate::theme::SMALL);
                        let at = rect.intersect(clip).right_top() + Vec2::new(-6.0, 4.0);
                        painter.text(at, egui::Align2::RIGHT_TOP, note, font, context.theme.on_surround);
                    }
                }
                Some(maps::Scale { end, .. }) => {
                    let name = format!("{name}, difference");
                    // The same map in another scale is another picture.
                    let version = (shot.serial << 16) ^ u64::from(end.to_bits() >> 8);
                    let of = PictureQuery { name: &name, version, rect, clip, sharp };
                    of.draw(painter, || maps::map(shot, at, end));
                }
            }
            return;
        }
    };
    let area = rect.shrink(8.0);
    let galley = ui.painter().layout(why, FontId::proportional(TEXT), context.theme.on_surround, area.width());
    painter.galley(area.min, galley, context.theme.on_surround);
}

/// The difference at the right of a caption, as far as there is room, and in full.
struct Note {
    short: Option<String>,
    full: String,
    meaning: &'static str,
}

fn note(shot: &RenderedFrame, at: usize, width: f32) -> Option<Note> {
    let difference = shot.made()?.differences.get(at)?.as_ref()?;
    let measure = Measure::of_frame(shot);
    let words = |detail| measure.words(difference, detail);
    let steps = [
        (WITH_LARGEST, Detail::Largest),
        (WITH_QUANTILES, Detail::Quantiles),
        (WITH_MEASURE, Detail::Metric),
        (WITH_NOTE, Detail::Number),
    ];
    let short = steps.into_iter().find(|(least, _)| width >= *least).map(|(_, detail)| words(detail));
    Some(Note { short, full: words(Detail::Largest), meaning: measure.meaning() })
}

fn title(source: &ComparedSensor) -> String {
    if source.is_reference { format!("Reference, {}", source.label) } else { source.label.clone() }
}

fn caption(
    ui: &mut Ui,
    painter: &Painter,
    cell: &PictureSlot,
    source: &ComparedSensor,
    note: Option<&Note>,
    context: &PaneContext<'_>,
) {
    let color = context.theme.on_surround;
    let rect = cell.caption.shrink2(Vec2::new(8.0, 0.0));
    marker(painter, Rect::from_min_size(rect.min, Vec2::new(16.0, CAPTION)), source, context);
    let right = note
        .and_then(|note| note.short.as_deref())
        .map_or(0.0, |note| lines::right_aligned(ui, rect, note, TextStyle::Small, color) + 8.0);
    let words = title(source);
    let left = Rect::from_min_max(rect.min + Vec2::new(20.0, 0.0), rect.max - Vec2::new(right, 0.0));
    let fits = |words: &str| lines::width(ui, words, TextStyle::Body) <= left.width();
    let shown = match source.is_reference {
        true if fits(&words) => words.clone(),
        true => "Reference".to_owned(),
        false => source.fitted(&context.scene.visible_sources(), fits),
    };
    let cut = shown != words || !fits(&shown);
    lines::elided(ui, left, &shown, TextStyle::Body, color);
    let said = note.map_or_else(|| words.clone(), |note| format!("{words}, {}", note.full));
    let (id, name) = (ui.scope_id().with(("caption", &words)), format!("Picture: {said}"));
    let response = widgets::named(ui, cell.caption, id, egui::Role::Label, &name);
    if let Some(note) = note {
        response.on_hover_text(format!("{said}. {}", note.meaning));
    } else if cut {
        response.on_hover_text(said);
    }
}

fn marker(painter: &Painter, rect: Rect, source: &ComparedSensor, context: &PaneContext<'_>) {
    let size = [f64::from(rect.width()), f64::from(rect.height())];
    let area = Area::from_min_size([0.0, 0.0], size);
    let mut panel = Panel::board("marker", area, Ink::new(InkRole::Surround));
    panel.marks.push(sign(PickIndex::NONE, source, size.map(|side| side / 2.0), 5.0, InkRole::OnSurround));
    paint::still(painter, &panel, &context.theme, rect);
}

fn ring(painter: &Painter, layout: &PictureLayout, cell: usize, context: &PaneContext<'_>) {
    let Some(pinned) = &context.view.render.pinned else { return };
    let picture = layout.cells[cell].picture;
    let at = picture.min + Vec2::new(pinned.at[0] as f32, pinned.at[1] as f32) * picture.size();
    let painter = painter.with_clip_rect(layout.visible(cell).intersect(painter.clip_rect()));
    let [outer, inner] = paint::RING_COLORS;
    painter.circle_stroke(at, RING, Stroke::new(3.0, outer));
    painter.circle_stroke(at, RING, Stroke::new(1.5, inner));
}

/// The divider of a split picture: drag it, or move it with arrows.
pub(super) fn divider(ui: &mut Ui, layout: &PictureLayout, context: &mut PaneContext<'_>) {
    let (Some(x), Some(cell)) = (layout.divider, layout.cells.first()) else { return };
    let picture = cell.picture;
    let line = Rect::from_x_y_ranges(x - 6.0..=x + 6.0, picture.y_range());
    let response = ui.interact(line, ui.scope_id().with("divider"), Sense::click_and_drag());
    let share = f64::from(context.view.saved.render.split);
    response.widget_info(|| egui::WidgetInfo::slider(true, 100.0 * share, "Divider between reference and sensor"));
    let color = context.theme.on_surround;
    let held = response.hovered() || response.dragged() || response.has_focus();
    let width = if held { 2.0 } else { 1.0 };
    // No rule at rest across the edge that the eye compares: the seam itself runs through the mesh.
    let handle = Pos2::new(x, picture.bottom() - 2.0 * HANDLE);
    if held {
        ui.painter().vline(x, picture.y_range(), Stroke::new(1.0, color));
    } else {
        for end in [picture.top()..=picture.top() + HANDLE, handle.y..=picture.bottom()] {
            ui.painter().vline(x, end, Stroke::new(1.0, color));
        }
    }
    ui.painter().circle(handle, HANDLE, context.theme.control, Stroke::new(width, color));
    for side in [-1.0, 1.0] {
        let tip = handle + Vec2::new(5.0 * side, 0.0);
        for up in [-3.0, 3.0] {
            ui.painter().line_segment([tip, tip + Vec2::new(-3.0 * side, up)], Stroke::new(1.2, context.theme.text));
        }
    }
    let mut split = context.view.saved.render.split;
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        split = (at.x - picture.left()) / picture.width().max(1.0);
    }
    if response.has_focus() {
        let arrows = egui::EventFilter { horizontal_arrows: true, ..egui::EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
        let presses = |key: Key| ui.input(|input| input.num_presses(key) as f32);
        split += 0.02 * (presses(Key::ArrowRight) - presses(Key::ArrowLeft));
    }
    if split != context.view.saved.render.split {
        context.view.saved.render.split = split.clamp(0.02, 0.98);
        ui.ctx().request_repaint();
    }
    response.on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
}

pub(super) fn choosers(ui: &mut Ui, layout: &PictureLayout, sources: &[ComparedSensor], context: &mut PaneContext<'_>) {
    let Some(cell) = layout.cells.first() else { return };
    if !matches!(layout.mode, RenderMode::One | RenderMode::Split) {
        return;
    }
    let shot = context.render_service.frame().cloned();
    let painter = ui.painter().clone();
    let row = cell.caption.shrink2(Vec2::new(8.0, 0.0));
    let mut left = row.left();
    if let Some(seam) = layout.divider {
        // Right of the seam, as the sensor is, as far as there is room.
        left = (seam + 8.0).min(row.right() - CHOOSER.x - 20.0).max(row.left() + 0.3 * row.width());
        if let Some(reference) = layout.sources.first() {
            let before = Rect::from_min_max(cell.caption.min, Pos2::new(left, row.bottom()));
            let reference_cell = PictureSlot { caption: before, ..*cell };
            caption(ui, &painter, &reference_cell, reference, None, context);
        }
    }
    let Some(now) = chosen(sources, context.view.render.chosen.as_ref()).cloned() else { return };
    marker(&painter, Rect::from_min_size(Pos2::new(left, row.top()), Vec2::new(16.0, CAPTION)), &now, context);
    let place = Rect::from_min_size(Pos2::new(left + 20.0, row.top() + 1.0), CHOOSER);
    let place = place.intersect(row);
    let mut child = ui.new_child(UiBuilder::new().id_salt("visible sensor").max_rect(place));
    child.spacing_mut().interact_size.y = place.height();
    child.spacing_mut().button_padding.y = 1.0;
    let offered = || sources.iter().filter(|source| layout.mode == RenderMode::One || !source.is_reference);
    let words = ("Visible sensor", "The sensor whose picture is shown");
    let chosen = pick_list::drop_down(&mut child, words, title(&now), place.width(), &context.theme, || {
        offered().map(|source| Line::new(title(source), source.kind == now.kind && source.name == now.name)).collect()
    });
    if let Some(source) = chosen.and_then(|index| offered().nth(index)) {
        context.view.render.chosen = Some(id(source));
    }
    let made = shot.as_deref().and_then(|shot| index_of(shot, &id(&now)));
    let rest = row.with_min_x(place.right() + 8.0);
    let made = shot.as_deref().zip(made).and_then(|(shot, at)| note(shot, at, rest.width() + 90.0));
    if let Some(note) = made.and_then(|note| note.short)
        && rest.width() > 90.0
    {
        painter.text(
            rest.right_center(),
            Align2::RIGHT_CENTER,
            note,
            FontId::proportional(crate::theme::SMALL),
            context.theme.on_surround,
        );
    }
}

fn scale_of_differences(
    ui: &mut Ui,
    painter: &Painter,
    rect: Rect,
    scale: maps::Scale,
    name: &str,
    context: &PaneContext<'_>,
) {
    let color = context.theme.on_surround;
    let font = FontId::proportional(crate::theme::SMALL);
    let words = format!("{name} from the reference");
    let title = painter.text(rect.left_center() + Vec2::new(8.0, 0.0), Align2::LEFT_CENTER, words, font.clone(), color);
    let left = title.right() + 16.0;
    let bar = Rect::from_min_max(
        Pos2::new(left, rect.top() + 6.0),
        Pos2::new(left.max(rect.right() - 120.0), rect.top() + 18.0),
    );
    crate::paint::ramp(painter, bar, &crate::palette::difference_ramp);
    for (share, value) in scale.ticks() {
        let at = Pos2::new(bar.left() + share * bar.width(), bar.bottom() + 2.0);
        painter.text(at, Align2::CENTER_TOP, value, font.clone(), color);
    }
    let dark = Pos2::new(rect.right() - 8.0, bar.center().y);
    let is_image = context.scene.document.render.mesh.is_image();
    let words = if is_image { "dark: no value" } else { "hatched: no light" };
    painter.text(dark, Align2::RIGHT_CENTER, words, font, color);
    let said = format!("Scale of {name} from the reference, from 0 to {}", scale.end);
    let response = widgets::named(ui, rect, ui.scope_id().with("difference scale"), egui::Role::Label, &said);
    response.on_hover_text(if is_image {
        "Of each pixel; a reflectance of 1, or the white of radiances, has Y = 1."
    } else {
        "Of each lit sample; a white of the same roughness that faces the light has Y = 1."
    });
}

pub(super) const CAPTION: f32 = 24.0;
const GAP: f32 = 8.0;
const SCALE: f32 = 40.0;
/// Least width over height of a picture with a chart beside the head: a higher one were empty above.
const COMPOSED: f32 = 1.1;

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
        let image = context.images.chosen(&context.scene.document.render.mesh);
        let composed = context.scene.document.render.composed && image.is_none();
        let (sources, shown) = match mode {
            RenderMode::Grid => (all.to_vec(), (0..all.len()).collect::<Vec<_>>()),
            RenderMode::Difference => {
                let with_reference = composed && has_reference_beside(all.len().saturating_sub(1));
                (all.to_vec(), (usize::from(!with_reference)..all.len()).collect())
            }
            RenderMode::Split | RenderMode::One => {
                let chosen = chosen(all, context.view.render.chosen.as_ref());
                let mut sources = all.first().cloned().into_iter().collect::<Vec<_>>();
                sources.extend(chosen.filter(|source| !source.is_reference).cloned());
                let last = sources.len().saturating_sub(1);
                let shown = if mode == RenderMode::One { last..sources.len() } else { 0..sources.len() };
                (sources, shown.collect())
            }
        };
        let scale =
            (mode == RenderMode::Difference && !shown.is_empty()).then(|| body.with_min_y(body.bottom() - SCALE));
        let area = Rect::from_min_max(body.min, body.max - Vec2::new(0.0, scale.map_or(0.0, |s| s.height())));
        let overlaid = mode == RenderMode::Split;
        let aspect = image.as_ref().map(|image| image.info.width as f32 / image.info.height as f32);
        let least = if composed { COMPOSED } else { 0.0 };
        let (columns, size) = grid(area.size(), if overlaid { 1 } else { shown.len() }, least);
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

/// Number of pictures side by side, and their size: the largest of at most twice as much width as height or the reverse, and of at
/// least so much width for their height; a place that were empty counts as what it takes from the others.
fn grid(area: Vec2, count: usize, least: f32) -> (usize, Vec2) {
    let mut best = (1, Vec2::splat(1.0));
    let merit = |columns, size: Vec2| {
        let side = size.min_elem();
        side * size.max_elem().min(2.0 * side) * filled(count, columns) as f32
    };
    for columns in 1..=count.max(1) {
        let rows = count.div_ceil(columns).max(1);
        let width = (area.x - GAP * (columns - 1) as f32) / columns as f32;
        let height = area.y / rows as f32 - CAPTION;
        let size = Vec2::new(width.max(1.0), height.clamp(1.0, (width / least).max(1.0)));
        let better = merit(columns, size) > merit(best.0, best.1);
        if better || columns == 1 {
            best = (columns, size);
        }
    }
    best
}
