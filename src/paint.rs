//! Figures on screen: panels drawn with egui, plots that zoom and pan, hit tests, legend keys.
//!
//! [`plot`] leaves zoom, pan and their memory to `egui_plot` and draws everything inside and around it itself, from the
//! same geometry as the SVG. [`board`] draws a panel whose units are points.

mod dense;
mod marks;
mod pictures;

use chromascope_figure::{
    Anchor, Annotation, Ink, InkRole, Mark, Panel, Projection, Rect as Area, Shape, Tag, TextSize, Tick, annotations,
    fit_equal,
};
use egui::{Id, Painter, Pos2, Rect, Response, Sense, Stroke, StrokeKind, Ui, Vec2};
use egui_plot::{Plot, PlotUi};

use crate::theme::Theme;

pub use marks::key;
pub use pictures::{PictureQuery, draw as picture};

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Emphasis {
    #[default]
    Normal,
    /// Under the pointer, in this pane or another: thicker rim, thin ring.
    Hovered,
    /// Part or whole of what is under the pointer: wider line.
    Pointed,
    /// Chosen: wider line, ring around points.
    Selected,
    /// Part or whole of what is chosen: wider line.
    Related,
    Faded,
}

pub type EmphasisOf<'a> = &'a dyn Fn(Tag) -> Emphasis;

#[derive(Clone, Copy)]
pub struct PlotOptions<'a> {
    /// True if the user can zoom (wheel, pinch) and pan (drag). A double click shows the panel's ranges again.
    pub zoomable: bool,
    pub reset: bool,
    pub emphasis: EmphasisOf<'a>,
}

impl Default for PlotOptions<'_> {
    fn default() -> Self {
        Self { zoomable: true, reset: false, emphasis: &|_| Emphasis::Normal }
    }
}

#[derive(Debug, Clone)]
pub struct PlotOutput {
    pub response: Response,
    pub view: View,
    pub hovered: Option<[f64; 2]>,
}

impl PlotOutput {
    /// Ranges of x and y that the user zoomed or panned to; `None` while the panel's own are shown.
    pub fn zoomed(&self, panel: &Panel) -> Option<[[f64; 2]; 2]> {
        let pairs = [(self.view.x, panel.x.proper_range()), (self.view.y, panel.y.proper_range())];
        let near = |(a, b): ([f64; 2], [f64; 2])| {
            let slack = 1e-3 * (b[1] - b[0]).abs();
            (a[0] - b[0]).abs() < slack && (a[1] - b[1]).abs() < slack
        };
        (!pairs.into_iter().all(near)).then_some([self.view.x, self.view.y])
    }
}

/// A rectangle of the screen with the data it shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    pub rect: Rect,
    /// Values at the left and right ends.
    pub x: [f64; 2],
    /// Values at the bottom and top ends.
    pub y: [f64; 2],
}

impl View {
    /// Position of a data point on screen. Points far outside are held near the screen: egui's numbers are `f32`.
    pub fn at(&self, point: [f64; 2]) -> Pos2 {
        let far = 1e5;
        let u = (point[0] - self.x[0]) / (self.x[1] - self.x[0]) * f64::from(self.rect.width());
        let v = (point[1] - self.y[0]) / (self.y[1] - self.y[0]) * f64::from(self.rect.height());
        let offset = Vec2::new(u.clamp(-far, far) as f32, -v.clamp(-far, far) as f32);
        self.rect.left_bottom() + offset
    }

    pub fn value(&self, at: Pos2) -> [f64; 2] {
        let u = f64::from((at.x - self.rect.left()) / self.rect.width().max(1.0));
        let v = f64::from((self.rect.bottom() - at.y) / self.rect.height().max(1.0));
        [self.x[0] + u * (self.x[1] - self.x[0]), self.y[0] + v * (self.y[1] - self.y[0])]
    }
}

/// Shows a panel with axes in exactly `rect`, tick labels included.
pub fn plot(ui: &mut Ui, id: Id, panel: &Panel, theme: &Theme, rect: Rect, options: PlotOptions<'_>) -> PlotOutput {
    let inner = plot_rect(panel, rect);
    let (x, y) = shown_ranges(panel, inner);
    let mut child = ui.new_child(egui::UiBuilder::new().max_rect(inner));
    let mut plot = Plot::new(id)
        .id(id)
        .width(inner.width())
        .height(inner.height())
        .show_axes(false)
        .show_grid(false)
        .show_background(false)
        .show_x(false)
        .show_y(false)
        .allow_zoom(options.zoomable)
        .allow_drag(options.zoomable)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_double_click_reset(options.zoomable)
        .default_x_bounds(x[0].min(x[1]), x[0].max(x[1]))
        .default_y_bounds(y[0].min(y[1]), y[0].max(y[1]))
        // Until the user zooms, these bounds are updated in each frame: they follow panel and window.
        .auto_bounds(true)
        .set_margin_fraction(Vec2::ZERO)
        .invert_x(x[0] > x[1])
        .invert_y(y[0] > y[1]);
    if panel.equal_aspect {
        plot = plot.data_aspect(1.0);
    }
    if options.reset {
        plot = plot.reset();
    }
    let span = [(x[1] - x[0]).abs(), (y[1] - y[0]).abs()];
    let shown = plot.show(&mut child, |plot| {
        if options.zoomable {
            zoom_by_wheel(plot, span);
        }
    });
    let bounds = shown.transform.bounds();
    let directed = |axis: usize, range: [f64; 2]| {
        let ends = [bounds.min()[axis], bounds.max()[axis]];
        if range[0] > range[1] { [ends[1], ends[0]] } else { ends }
    };
    let view = View { rect: inner, x: directed(0, x), y: directed(1, y) };
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    draw_panel(&painter, panel, &view, rect, theme, options.emphasis);
    let response = named(shown.response, panel);
    let hovered = response.hover_pos().filter(|at| inner.contains(*at)).map(|at| view.value(at));
    PlotOutput { response, view, hovered }
}

fn named(response: Response, panel: &Panel) -> Response {
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, panel.name.clone()));
    response
}

/// The plot inside the box that also holds the tick labels.
fn plot_rect(panel: &Panel, rect: Rect) -> Rect {
    let bottom = Projection::bottom(&panel.x) as f32;
    let left = Projection::left(panel, panel.y.proper_range(), f64::from(rect.height() - bottom), 1.0) as f32;
    let max = Pos2::new(rect.right() - 1.0, rect.bottom() - bottom.max(1.0));
    Rect::from_min_max(rect.min + Vec2::new(left.max(1.0), 1.0), max.max(rect.min + Vec2::splat(2.0)))
}

/// The axis ranges that fill the plot and contain the panel's ranges.
fn shown_ranges(panel: &Panel, inner: Rect) -> ([f64; 2], [f64; 2]) {
    if panel.equal_aspect {
        let size = [f64::from(inner.width()), f64::from(inner.height())];
        fit_equal(panel.x.range, panel.y.range, size)
    } else {
        (panel.x.proper_range(), panel.y.proper_range())
    }
}

/// The wheel zooms around the pointer, from 1/100000 to 20 times the panel's own ranges.
fn zoom_by_wheel(plot: &mut PlotUi<'_>, span: [f64; 2]) {
    let scroll = plot.ctx().input(|input| input.smooth_scroll_delta().y);
    if scroll == 0.0 || !plot.response().contains_pointer() {
        return;
    }
    let factor = (0.005 * scroll).exp();
    let shown = plot.plot_bounds();
    let relative = (shown.width() / span[0]).max(shown.height() / span[1]) / f64::from(factor);
    if (1e-5..20.0).contains(&relative) {
        plot.zoom_bounds_around_hovered(Vec2::splat(factor));
    }
}

/// Shows a panel without axes: its units are points from the upper left corner of `rect`, where its ranges begin.
/// Senses clicks and the pointer.
pub fn board(ui: &mut Ui, id: Id, panel: &Panel, theme: &Theme, rect: Rect, emphasis: EmphasisOf<'_>) -> PlotOutput {
    let size = [f64::from(rect.width()), f64::from(rect.height())];
    let view = View { rect, x: [0.0, size[0]], y: [size[1], 0.0] };
    let response = named(ui.interact(rect, id, Sense::click()), panel);
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    draw_panel(&painter, panel, &view, rect, theme, emphasis);
    let hovered = response.hover_pos().map(|at| view.value(at));
    PlotOutput { response, view, hovered }
}

/// Draws a whole panel that neither moves nor senses, such as an overview, in exactly `rect`.
pub fn still(painter: &Painter, panel: &Panel, theme: &Theme, rect: Rect) -> View {
    let inner = plot_rect(panel, rect);
    let (x, y) = shown_ranges(panel, inner);
    let view = View { rect: inner, x, y };
    let painter = painter.with_clip_rect(rect.intersect(painter.clip_rect()));
    draw_panel(&painter, panel, &view, rect, theme, &|_| Emphasis::Normal);
    view
}

/// The two colors of a ring that is seen on any picture: the wider one below, the narrower one above.
pub const RING_COLORS: [egui::Color32; 2] = [egui::Color32::WHITE, egui::Color32::BLACK];

/// Fills a rectangle with a ramp, from 0 at the left to 1 at the right.
pub fn ramp(painter: &Painter, rect: Rect, color: &dyn Fn(f32) -> [u8; 3]) {
    let columns = (rect.width().ceil() as usize).max(1);
    for column in 0..columns {
        let share = (column as f32 + 0.5) / columns as f32;
        let [r, g, b] = color(share);
        let left = rect.left() + column as f32;
        let strip =
            Rect::from_min_max(Pos2::new(left, rect.top()), Pos2::new((left + 1.0).min(rect.right()), rect.bottom()));
        painter.rect_filled(strip, 0.0, egui::Color32::from_rgb(r, g, b));
    }
}

/// Draws a panel whose plot is `view` and whose outer box is `rect`.
fn draw_panel(painter: &Painter, panel: &Panel, view: &View, rect: Rect, theme: &Theme, emphasis: EmphasisOf<'_>) {
    let inside = painter.with_clip_rect(view.rect.intersect(painter.clip_rect()));
    inside.rect_filled(view.rect, 0.0, theme.ink(panel.background));
    let x_ticks = panel.x.ticks_over(view.x, f64::from(view.rect.width()));
    let y_ticks = panel.y.vertical_ticks_over(view.y, f64::from(view.rect.height()));
    let thin = Stroke::new(crate::theme::LINE_GRID as f32, theme.grid);
    if panel.x.grid {
        for tick in &x_ticks {
            let x = painter.round_to_pixel_center(view.at([tick.value, view.y[0]]).x);
            inside.vline(x, view.rect.y_range(), thin);
        }
    }
    if panel.y.grid {
        for tick in &y_ticks {
            let y = painter.round_to_pixel_center(view.at([view.x[0], tick.value]).y);
            inside.hline(view.rect.x_range(), y, thin);
        }
    }
    for mark in &panel.marks {
        marks::mark(&inside, mark, view, theme, emphasis(mark.tag));
    }
    if panel.framed {
        let stroke = Stroke::new(1.0, theme.line);
        painter.rect_stroke(view.rect, 0.0, stroke, StrokeKind::Outside);
    }
    tick_labels(painter, view, rect, theme, &x_ticks, &y_ticks);
    let plot = Area {
        min: [f64::from(view.rect.left()), f64::from(view.rect.top())],
        max: [f64::from(view.rect.right()), f64::from(view.rect.bottom())],
    };
    for Annotation { at, text, anchor } in annotations(panel, plot, 1.0) {
        let at = Pos2::new(at[0] as f32, at[1] as f32);
        let style =
            marks::TextStyle { anchor, size: TextSize::Small, ink: InkRole::Weak.into(), halo: Some(panel.background) };
        marks::text(painter, at, &text, style, theme);
    }
}

fn tick_labels(painter: &Painter, view: &View, rect: Rect, theme: &Theme, x_ticks: &[Tick], y_ticks: &[Tick]) {
    let style =
        |anchor: Anchor| marks::TextStyle { anchor, size: TextSize::Body, ink: Ink::new(InkRole::Weak), halo: None };
    for tick in x_ticks.iter().filter(|tick| !tick.label.is_empty()) {
        let at = Pos2::new(view.at([tick.value, view.y[0]]).x, view.rect.bottom() + 4.0);
        marks::text_inside(painter, at, &tick.label, style(Anchor::TOP), theme, rect);
    }
    for tick in y_ticks.iter().filter(|tick| !tick.label.is_empty()) {
        let at = Pos2::new(view.rect.left() - 6.0, view.at([view.x[0], tick.value]).y);
        marks::text_inside(painter, at, &tick.label, style(Anchor::RIGHT), theme, rect);
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    pub tag: Tag,
    /// Its place among the panel's marks.
    pub mark: usize,
    /// The nearest of its points.
    pub index: usize,
    /// Its distance from the pointer in points; 0 inside an area.
    pub distance: f32,
}

/// The nearest mark within `radius` points of the pointer: points before lines, lines before areas; among equals the
/// one drawn last.
pub fn nearest(panel: &Panel, view: &View, pointer: Pos2, radius: f32) -> Option<Hit> {
    if !view.rect.contains(pointer) {
        return None;
    }
    [points, lines, areas].into_iter().find_map(|distance_to| {
        let hits = panel.marks.iter().enumerate().filter_map(|(mark, drawn)| {
            let (index, distance) = distance_to(drawn, view, pointer)?;
            Some(Hit { tag: drawn.tag, mark, index, distance })
        });
        hits.filter(|hit| hit.distance <= radius)
            .reduce(|best, hit| if hit.distance <= best.distance { hit } else { best })
    })
}

fn least(distances: impl Iterator<Item = (usize, f32)>) -> Option<(usize, f32)> {
    distances.filter(|(_, d)| d.is_finite()).min_by(|a, b| a.1.total_cmp(&b.1))
}

fn is_finite(point: [f64; 2]) -> bool {
    point.iter().all(|v| v.is_finite())
}

fn points(mark: &Mark, view: &View, pointer: Pos2) -> Option<(usize, f32)> {
    let Shape::Points { points, .. } = &mark.shape else {
        return None;
    };
    let finite = points.iter().enumerate().filter(|(_, p)| is_finite(**p));
    least(finite.map(|(i, p)| (i, view.at(*p).distance(pointer))))
}

fn lines(mark: &Mark, view: &View, pointer: Pos2) -> Option<(usize, f32)> {
    let segment = |i: usize, a: [f64; 2], b: [f64; 2]| {
        let known = is_finite(a) && is_finite(b);
        known.then(|| to_segment(i, view.at(a), view.at(b), pointer))
    };
    match &mark.shape {
        Shape::Line { points, closed } => {
            let last = points.len().checked_sub(1)?;
            let back = segment(last, points[last], points[0]).filter(|_| *closed);
            let there = points.windows(2).enumerate().filter_map(|(i, p)| segment(i, p[0], p[1]));
            least(there.chain(back))
        }
        Shape::Gradient { points } => {
            least(points.windows(2).enumerate().filter_map(|(i, p)| segment(i, p[0].0, p[1].0)))
        }
        Shape::Segments { segments } => least(
            segments.iter().enumerate().filter_map(|(i, s)| segment(i, s[0], s[1]).map(|(_, distance)| (i, distance))),
        ),
        _ => None,
    }
}

fn areas(mark: &Mark, view: &View, pointer: Pos2) -> Option<(usize, f32)> {
    let Shape::Rect { min, max } = &mark.shape else {
        return None;
    };
    let known = is_finite(*min) && is_finite(*max);
    let area = egui::Rect::from_two_pos(view.at(*min), view.at(*max));
    (known && area.contains(pointer)).then_some((0, 0.0))
}

/// Distance from a straight line, and which of its ends (`i` or the next) is nearer.
fn to_segment(i: usize, a: Pos2, b: Pos2, pointer: Pos2) -> (usize, f32) {
    let along = b - a;
    let length = along.length_sq();
    let t = if length > 0.0 { ((pointer - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (i + usize::from(t > 0.5), (a + t * along).distance(pointer))
}
