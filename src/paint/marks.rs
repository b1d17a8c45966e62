//! Marks as egui shapes. Polygons are filled here: egui itself fills convex ones only.

use chromascope_figure::{
    Anchor, Ink, InkRole, LegendEntry, Mark, Marker, MarkerOutline, Rgb, Shape as Form, Stroke as Pen, TextSize,
    clip_segment, color_runs, finite_runs,
};
use earcut::Earcut;
use egui::epaint::PathStroke;
use egui::{Color32, Mesh, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2};

use super::{Emphasis, View, dense, pictures};
use crate::theme::{self, Theme};

/// Distance of the ring around a chosen point from its marker.
const RING: f32 = 5.0;

struct Brush<'a> {
    painter: &'a Painter,
    view: &'a View,
    theme: &'a Theme,
    emphasis: Emphasis,
}

pub(super) fn mark(painter: &Painter, mark: &Mark, view: &View, theme: &Theme, emphasis: Emphasis) {
    let brush = Brush { painter, view, theme, emphasis };
    match &mark.shape {
        Form::Line { points, closed } => brush.line(mark, points, *closed),
        Form::Gradient { points } => brush.gradient(mark, points),
        Form::Points { points, marker, radius } => {
            for point in finite_runs(points).flatten() {
                brush.point(mark, view.at(*point), *marker, *radius as f32);
            }
        }
        Form::Text { at, text: words, anchor, offset, size, ink } => {
            if at.iter().all(|v| v.is_finite()) {
                let at = view.at(*at) + Vec2::new(offset[0] as f32, offset[1] as f32);
                let (ink, halo) = (brush.faded(*ink), mark.halo.filter(|_| emphasis != Emphasis::Faded));
                let style = TextStyle { anchor: *anchor, size: *size, ink, halo };
                text(painter, at, words, style, theme);
            }
        }
        Form::Rect { min, max } => brush.rect(mark, *min, *max),
        Form::Polygon { points } => brush.polygon(mark, points),
        Form::Image { min, max, image } => {
            if [min, max].iter().all(|p| p.iter().all(|v| v.is_finite())) {
                pictures::draw(painter, brush.box_of(*min, *max), image);
            }
        }
        Form::Segments { segments } => {
            for pen in brush.pens(mark) {
                for ends in segments.iter().filter(|s| s.as_flattened().iter().all(|v| v.is_finite())) {
                    brush.path(&ends.map(|p| view.at(p)), false, pen);
                }
            }
        }
    }
}

impl Brush<'_> {
    fn faded(&self, ink: Ink) -> Ink {
        if self.emphasis == Emphasis::Faded { ink.faded(theme::FADED) } else { ink }
    }

    fn color(&self, ink: Ink) -> Color32 {
        self.theme.ink(self.faded(ink))
    }

    fn box_of(&self, a: [f64; 2], b: [f64; 2]) -> Rect {
        Rect::from_two_pos(self.view.at(a), self.view.at(b))
    }

    /// A line's pen, wider for what is pointed at or chosen.
    fn pen(&self, mark: &Mark) -> Option<Pen> {
        let wider = match self.emphasis {
            Emphasis::Hovered | Emphasis::Pointed => 1.0,
            Emphasis::Selected | Emphasis::Related => 1.5,
            Emphasis::Normal | Emphasis::Faded => 0.0,
        };
        mark.stroke.map(|pen| Pen { width: pen.width + wider, ..pen })
    }

    /// The lines to draw over each other: halo, line.
    fn pens(&self, mark: &Mark) -> impl Iterator<Item = Pen> {
        let line = self.pen(mark);
        // A halo would cut holes into others while its own line is hardly seen.
        let halo = mark.halo.filter(|_| self.emphasis != Emphasis::Faded);
        let width = line.map_or(0.0, |pen| pen.width) + 2.0 * Mark::HALO;
        halo.map(|ink| Pen::solid(ink, width)).into_iter().chain(line)
    }

    fn line(&self, mark: &Mark, points: &[[f64; 2]], closed: bool) {
        for pen in self.pens(mark) {
            for run in finite_runs(points) {
                let placed: Vec<Pos2> = run.iter().map(|p| self.view.at(*p)).collect();
                let closes = closed && run.len() == points.len();
                if closes || pen.dash.pattern(pen.width).is_some() {
                    self.path(&placed, closes, pen);
                    continue;
                }
                let (rect, pixel) = (self.view.rect, 1.0 / self.painter.ctx().pixels_per_point());
                match dense::shortened(placed, rect, pixel) {
                    dense::Drawn::Line(points) => self.path(&points, false, pen),
                    dense::Drawn::Filled(columns) => {
                        let bars = dense::bars(&columns, rect, pixel, pen.width as f32, self.color(pen.ink));
                        self.painter.add(Shape::mesh(bars));
                    }
                }
            }
        }
    }

    fn path(&self, points: &[Pos2], closed: bool, pen: Pen) {
        let stroke = Stroke::new(pen.width as f32, self.color(pen.ink));
        if let Some(dashes) = pen.dash.pattern(pen.width) {
            let mut path = points.to_vec();
            path.extend(points.first().filter(|_| closed));
            self.dashes(&path, stroke, dashes.map(|length| length as f32));
        } else if closed {
            self.painter.add(Shape::closed_line(points.to_vec(), PathStroke::from(stroke)));
        } else {
            self.painter.add(Shape::line(points.to_vec(), PathStroke::from(stroke)));
        }
    }

    /// Only the part near the plot is dashed: a magnified line may be very long.
    fn dashes(&self, path: &[Pos2], stroke: Stroke, [dash, gap]: [f32; 2]) {
        let near = self.view.rect.expand(20.0);
        for run in
            path.windows(2).map(|ends| clipped(ends[0], ends[1], near)).collect::<Vec<_>>().split(Option::is_none)
        {
            let mut points: Vec<Pos2> = run.iter().flatten().map(|ends| ends[0]).collect();
            points.extend(run.iter().flatten().last().map(|ends| ends[1]));
            if points.len() > 1 {
                self.painter.extend(Shape::dashed_line(&points, stroke, dash, gap));
            }
        }
    }

    fn gradient(&self, mark: &Mark, points: &[([f64; 2], Rgb)]) {
        let pen = mark.stroke.unwrap_or(Pen::solid(InkRole::Text, 2.0));
        for run in color_runs(points) {
            let placed: Vec<Pos2> = run.iter().map(|p| self.view.at(p.0)).collect();
            let ink = Ink { role: InkRole::Rgb(run[0].1), alpha: pen.ink.alpha };
            self.path(&placed, false, Pen { ink, ..pen });
        }
    }

    fn point(&self, mark: &Mark, at: Pos2, marker: Marker, radius: f32) {
        let rim =
            if matches!(self.emphasis, Emphasis::Related | Emphasis::Pointed) { mark.stroke } else { self.pen(mark) };
        let fill = mark.fill.map_or(Color32::TRANSPARENT, |ink| self.color(ink));
        let rim_stroke = rim.map_or(Stroke::NONE, |pen| Stroke::new(pen.width as f32, self.color(pen.ink)));
        if let Some(halo) = mark.halo.filter(|_| self.emphasis != Emphasis::Faded) {
            let color = self.theme.ink(halo);
            let width = rim_stroke.width + 2.0 * Mark::HALO as f32;
            outline(self.painter, at, marker, radius, color, Stroke::new(width, color));
        }
        outline(self.painter, at, marker, radius, fill, rim_stroke);
        let width = match self.emphasis {
            Emphasis::Hovered => 1.0,
            Emphasis::Selected => 2.0,
            Emphasis::Normal | Emphasis::Pointed | Emphasis::Related | Emphasis::Faded => return,
        };
        let ink = mark.stroke.map(|pen| pen.ink).or(mark.fill).unwrap_or(InkRole::Text.into());
        let ring = |width, ink| self.painter.circle_stroke(at, radius + RING, Stroke::new(width, self.theme.ink(ink)));
        if let Some(halo) = mark.halo {
            ring(width + 2.0, halo);
        }
        ring(width, ink);
    }

    /// Rectangles are swatches: they never fade, and are framed in black and white when chosen.
    fn rect(&self, mark: &Mark, min: [f64; 2], max: [f64; 2]) {
        if ![min, max].as_flattened().iter().all(|v| v.is_finite()) {
            return;
        }
        let rect = self.box_of(min, max);
        let fill = mark.fill.map_or(Color32::TRANSPARENT, |ink| self.theme.ink(ink));
        let stroke = mark.stroke.map_or(Stroke::NONE, |pen| Stroke::new(pen.width as f32, self.theme.ink(pen.ink)));
        self.painter.rect(rect, 0.0, fill, stroke, StrokeKind::Middle);
        match self.emphasis {
            Emphasis::Selected | Emphasis::Related => {
                let frame = |by: f32, color| {
                    let stroke = Stroke::new(1.5, color);
                    self.painter.rect_stroke(rect.shrink(by), 0.0, stroke, StrokeKind::Inside);
                };
                frame(0.0, Color32::BLACK);
                frame(1.5, Color32::WHITE);
            }
            Emphasis::Hovered => {
                let stroke = Stroke::new(1.0, self.theme.on_surround);
                self.painter.rect_stroke(rect, 0.0, stroke, StrokeKind::Outside);
            }
            Emphasis::Normal | Emphasis::Pointed | Emphasis::Faded => {}
        }
    }

    fn polygon(&self, mark: &Mark, points: &[[f64; 2]]) {
        let placed: Vec<Pos2> = finite_runs(points).flatten().map(|p| self.view.at(*p)).collect();
        if let Some(ink) = mark.fill {
            fill_polygon(self.painter, &placed, self.color(ink));
        }
        for pen in self.pens(mark) {
            self.path(&placed, true, pen);
        }
    }
}

fn clipped(a: Pos2, b: Pos2, rect: Rect) -> Option<[Pos2; 2]> {
    let [a, b, min, max] = [a, b, rect.min, rect.max].map(|at| [f64::from(at.x), f64::from(at.y)]);
    let ends = clip_segment(chromascope_figure::Rect { min, max }, [a, b])?;
    Some(ends.map(|[x, y]| Pos2::new(x as f32, y as f32)))
}

fn outline(painter: &Painter, at: Pos2, marker: Marker, radius: f32, fill: Color32, rim: Stroke) {
    let place = |p: &[f64; 2]| at + radius * Vec2::new(p[0] as f32, p[1] as f32);
    match marker.outline() {
        MarkerOutline::Disk(size) => {
            painter.circle(at, radius * size as f32, fill, rim);
        }
        MarkerOutline::Area(corners) => {
            let corners = corners.iter().map(place).collect();
            painter.add(Shape::convex_polygon(corners, fill, PathStroke::from(rim)));
        }
        MarkerOutline::Strokes(lines) => {
            let rim = if rim.width > 0.0 { rim } else { Stroke::new(2.0, fill) };
            for line in lines {
                painter.line_segment([place(&line[0]), place(&line[1])], rim);
            }
        }
    }
}

/// Draws the key of a source, line and marker, across the middle of `rect`.
pub fn key(painter: &Painter, rect: Rect, entry: &LegendEntry, theme: &Theme) {
    let middle = rect.center();
    let view = View { rect, x: [0.0, 1.0], y: [0.0, 1.0] };
    let brush = Brush { painter, view: &view, theme, emphasis: Emphasis::Normal };
    if let Some(pen) = entry.stroke {
        brush.path(&[rect.left_center(), rect.right_center()], false, pen);
    }
    if let Some(marker) = entry.marker {
        let ink = entry.stroke.map(|pen| pen.ink).or(entry.fill).unwrap_or(InkRole::Text.into());
        let ground = painter.ctx().global_style().visuals.panel_fill;
        let fill = entry.fill.map_or(ground, |ink| theme.ink(ink));
        let rim = Stroke::new(2.0, theme.ink(ink));
        let radius = 5.0;
        outline(painter, middle, marker, radius, ground, Stroke::new(2.0 + 3.0, ground));
        outline(painter, middle, marker, radius, fill, rim);
    }
}

#[derive(Clone, Copy)]
pub(super) struct TextStyle {
    pub(super) anchor: Anchor,
    pub(super) size: TextSize,
    pub(super) ink: Ink,
    pub(super) halo: Option<Ink>,
}

pub(super) fn text(painter: &Painter, at: Pos2, words: &str, style: TextStyle, theme: &Theme) {
    text_inside(painter, at, words, style, theme, Rect::EVERYTHING);
}

/// Draws a line of text, moved as far as needed to stay inside `bounds`.
pub(super) fn text_inside(painter: &Painter, at: Pos2, words: &str, style: TextStyle, theme: &Theme, bounds: Rect) {
    let color = theme.ink(style.ink);
    let galley = painter.layout_no_wrap(words.to_owned(), theme::font(style.size), color);
    let size = galley.size();
    let min = at - size * Vec2::new(style.anchor.0 as f32, style.anchor.1 as f32);
    let min = min.min(bounds.max - size).max(bounds.min);
    if let Some(halo) = style.halo {
        let ground = theme.ink(halo);
        for (x, y) in [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)] {
            let shift = 1.25 * Vec2::new(x as f32, y as f32);
            painter.galley_with_override_text_color(min + shift, galley.clone(), ground);
        }
    }
    painter.galley(min, galley, color);
}

fn fill_polygon(painter: &Painter, corners: &[Pos2], color: Color32) {
    let mut corners = corners.to_vec();
    if is_band(&corners) {
        let count = corners.len() as u32;
        let mut mesh = Mesh::default();
        for corner in &corners {
            mesh.colored_vertex(*corner, color);
        }
        for i in 1..count / 2 {
            mesh.add_triangle(i - 1, i, count - i);
            mesh.add_triangle(i, count - i, count - 1 - i);
        }
        painter.add(mesh);
        return;
    }
    corners.dedup();
    if corners.len() < 3 {
        return;
    }
    if is_convex(&corners) {
        painter.add(Shape::convex_polygon(corners, color, Stroke::NONE));
        return;
    }
    let mut triangles: Vec<u32> = Vec::new();
    Earcut::new().earcut(corners.iter().map(|corner| [corner.x, corner.y]), &[], &mut triangles);
    let mut mesh = Mesh { indices: triangles, ..Mesh::default() };
    for corner in &corners {
        mesh.colored_vertex(*corner, color);
    }
    painter.add(mesh);
}

/// True for an outline that runs along an upper edge to the right and back along a lower edge at the same places: a strip of triangles.
fn is_band(corners: &[Pos2]) -> bool {
    let n = corners.len();
    n > 8 && n.is_multiple_of(2) && (0..n / 2).all(|i| corners[i].x == corners[n - 1 - i].x)
}

fn cross(a: Pos2, b: Pos2, c: Pos2) -> f32 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

fn is_convex(corners: &[Pos2]) -> bool {
    let n = corners.len();
    let turn = |i: usize| cross(corners[i], corners[(i + 1) % n], corners[(i + 2) % n]);
    let (left, right) =
        (0..n).map(turn).fold((true, true), |(left, right), turn| (left && turn >= 0.0, right && turn <= 0.0));
    // A star that winds twice also turns one way only; figures draw no such outlines.
    left || right
}
