//! A figure as SVG.
//!
//! Plain shapes with presentation attributes, no style sheet, no script, no `dominant-baseline`, no `paint-order`: what
//! browsers, Inkscape, office programs and resvg all draw alike.

mod canvas;
mod marks;

use super::annotation::annotations;
use super::figure::Figure;
use super::ink::{Ink, InkRole, Palette};
use super::mark::{Anchor, Image, Stroke, TextSize};
use super::panel::{LegendEntry, LegendPlace, Panel};
use super::projection::Projection;
use super::rect::Rect;
use super::text::{text_width, wrapped};
use canvas::{Canvas, escaped};

/// Fonts and images of a written figure, apart from its colors.
pub struct SvgStyle<'a> {
    /// Font family of text.
    pub font_family: &'a str,
    /// Font family of [`TextSize::Mono`].
    pub mono_family: &'a str,
    /// Factor on all text.
    pub text_scale: f64,
    /// Factor on the widths of lines and on markers.
    pub line_scale: f64,
    /// Width on paper in millimeters; `None` takes the figure's points.
    pub width_mm: Option<f64>,
    /// Encodes a picture as a data URI (`data:image/png;base64,…`). Pictures it cannot encode are omitted.
    pub encode: &'a dyn Fn(&Image) -> Option<String>,
}

impl<'a> SvgStyle<'a> {
    /// The size of the screen, in the given fonts.
    pub fn new(font_family: &'a str, mono_family: &'a str, encode: &'a dyn Fn(&Image) -> Option<String>) -> Self {
        Self { font_family, mono_family, text_scale: 1.0, line_scale: 1.0, width_mm: None, encode }
    }
}

/// Writes a figure as an SVG document.
pub fn write(figure: &Figure, palette: &dyn Palette, style: &SvgStyle<'_>) -> String {
    let Page { area: page, caption } = Page::new(figure, style.text_scale);
    let mut canvas = Canvas::new(palette, style);
    canvas.open(page, &figure.title);
    canvas.rect(page, None, Some(InkRole::Plot.into()));
    let projections: Vec<Projection> =
        figure.panels.iter().map(|panel| Projection::new(panel, style.text_scale)).collect();
    for (index, (panel, projection)) in figure.panels.iter().zip(&projections).enumerate() {
        write_panel(&mut canvas, index, panel, projection);
    }
    if !figure.legend.is_empty() {
        let first = figure.panels.first().zip(projections.first());
        write_legend(&mut canvas, figure, first);
    }
    for (i, line) in caption.iter().enumerate() {
        let y = figure.size[1] + (8.0 + Page::CAPTION_LINE * i as f64) * style.text_scale;
        canvas.text([0.0, y], line, Anchor::LEFT_TOP, TextSize::Small, InkRole::Text.into());
    }
    canvas.close()
}

/// The document's rectangle, around the figure's, and the lines of the caption.
struct Page {
    area: Rect,
    caption: Vec<String>,
}

impl Page {
    const CAPTION_LINE: f64 = 15.0;
    /// Empty space around everything.
    const MARGIN: f64 = 8.0;

    fn new(figure: &Figure, text_scale: f64) -> Self {
        let beside = if figure.legend_place == LegendPlace::Outside && !figure.legend.is_empty() {
            12.0 + legend_size(&figure.legend, text_scale)[0]
        } else {
            0.0
        };
        let width = figure.size[0] + beside;
        let caption = wrapped(&figure.caption, TextSize::Small, width / text_scale);
        let below = match caption.len() {
            0 => 0.0,
            lines => (12.0 + Self::CAPTION_LINE * lines as f64) * text_scale,
        };
        let size = [width, figure.size[1] + below].map(|side| side + 2.0 * Self::MARGIN);
        Self { area: Rect::from_min_size([-Self::MARGIN; 2], size), caption }
    }
}

fn write_panel(canvas: &mut Canvas<'_>, index: usize, panel: &Panel, projection: &Projection) {
    let plot = projection.plot;
    canvas.group_clipped(index, plot, &panel.name);
    canvas.rect(plot, None, Some(panel.background));
    write_grid(canvas, panel, projection);
    for mark in &panel.marks {
        marks::write(canvas, mark, projection);
    }
    canvas.end_group();
    if panel.framed {
        canvas.rect(plot, Some(Stroke::solid(InkRole::Line, 1.0)), None);
    }
    write_tick_labels(canvas, panel, projection);
    for note in annotations(panel, plot, canvas.style.text_scale) {
        let halo = Some(panel.background);
        canvas.text_with_halo(note.at, &note.text, note.anchor, TextSize::Small, InkRole::Weak.into(), halo);
    }
}

fn write_grid(canvas: &mut Canvas<'_>, panel: &Panel, projection: &Projection) {
    let (plot, stroke) = (projection.plot, Stroke::solid(InkRole::Grid, 1.0));
    if panel.x.grid {
        for tick in &projection.x_ticks {
            let x = projection.at([tick.value, projection.y[0]])[0];
            canvas.polyline(&[[x, plot.min[1]], [x, plot.max[1]]], false, stroke);
        }
    }
    if panel.y.grid {
        for tick in &projection.y_ticks {
            let y = projection.at([projection.x[0], tick.value])[1];
            canvas.polyline(&[[plot.min[0], y], [plot.max[0], y]], false, stroke);
        }
    }
}

fn write_tick_labels(canvas: &mut Canvas<'_>, panel: &Panel, projection: &Projection) {
    let (plot, scale) = (projection.plot, canvas.style.text_scale);
    let ink = Ink::new(InkRole::Weak);
    for tick in &projection.x_ticks {
        let half = 0.5 * scale * text_width(&tick.label, TextSize::Body);
        let x = projection.at([tick.value, projection.y[0]])[0];
        let x = x.min(panel.area.max[0] - half).max(panel.area.min[0] + half);
        let at = [x, plot.max[1] + 6.0 * scale];
        canvas.text(at, &tick.label, Anchor::TOP, TextSize::Body, ink);
    }
    for tick in &projection.y_ticks {
        let half = 0.5 * scale * f64::from(TextSize::Body.points());
        let y = projection.at([projection.x[0], tick.value])[1];
        let y = y.min(panel.area.max[1] - half).max(panel.area.min[1] + half);
        let at = [plot.min[0] - 7.0 * scale, y];
        canvas.text(at, &tick.label, Anchor::RIGHT, TextSize::Body, ink);
    }
}

const KEY_ROW: f64 = 20.0;
const KEY_WIDTH: f64 = 28.0;
const KEY_PAD: f64 = 8.0;

fn legend_size(entries: &[LegendEntry], text_scale: f64) -> [f64; 2] {
    let widest = entries.iter().map(|entry| text_width(&entry.name, TextSize::Body)).fold(0.0, f64::max);
    let width = 3.0 * KEY_PAD + KEY_WIDTH + widest;
    [width * text_scale, (KEY_ROW * entries.len() as f64 + KEY_PAD) * text_scale]
}

fn write_legend(canvas: &mut Canvas<'_>, figure: &Figure, first: Option<(&Panel, &Projection)>) {
    let scale = canvas.style.text_scale;
    let size = legend_size(&figure.legend, scale);
    let area = legend_area(figure, first, size, scale);
    if figure.legend_place != LegendPlace::Outside {
        let ground = Ink { role: InkRole::Plot, alpha: 0.9 };
        canvas.rect(area, Some(Stroke::solid(InkRole::Line, 1.0)), Some(ground));
    }
    for (i, entry) in figure.legend.iter().enumerate() {
        let y = area.min[1] + (0.5 * KEY_PAD + KEY_ROW * (i as f64 + 0.5)) * scale;
        let x = area.min[0] + KEY_PAD * scale;
        write_key(canvas, entry, [x, y], KEY_WIDTH * scale);
        let at = [x + (KEY_WIDTH + KEY_PAD) * scale, y];
        canvas.text(at, &entry.name, Anchor::LEFT, TextSize::Body, InkRole::Text.into());
    }
}

fn legend_area(figure: &Figure, first: Option<(&Panel, &Projection)>, size: [f64; 2], scale: f64) -> Rect {
    let whole = Rect::from_min_size([0.0, 0.0], figure.size);
    let plot = first.map_or(whole, |(_, projection)| projection.plot);
    let note = if first.is_some_and(|(panel, _)| !panel.note.is_empty()) { 18.0 } else { 0.0 };
    let pad = 8.0 * scale;
    let (left, right) = (plot.min[0] + pad, plot.max[0] - pad - size[0]);
    let (top, bottom) = (plot.min[1] + pad, plot.max[1] - pad - 16.0 * scale - size[1]);
    let min = match figure.legend_place {
        LegendPlace::UpperRight => [right, top + note * scale],
        LegendPlace::UpperLeft => [left, top + 16.0 * scale],
        LegendPlace::LowerRight => [right, bottom],
        LegendPlace::LowerLeft => [left, bottom + 16.0 * scale],
        LegendPlace::Outside => [figure.size[0] + 12.0, 0.0],
    };
    Rect::from_min_size(min, size)
}

fn write_key(canvas: &mut Canvas<'_>, entry: &LegendEntry, left: [f64; 2], width: f64) {
    if let Some(stroke) = entry.stroke {
        canvas.polyline(&[left, [left[0] + width, left[1]]], false, stroke);
    }
    if let Some(marker) = entry.marker {
        let ink = entry.stroke.map(|stroke| stroke.ink).or(entry.fill);
        let rim = ink.map(|ink| Stroke::solid(ink, 2.0));
        let at = [left[0] + 0.5 * width, left[1]];
        let inside = if marker.has_inside() { entry.fill.or(Some(InkRole::Plot.into())) } else { None };
        let ground = Some(Ink::new(InkRole::Plot));
        canvas.marker(at, marker, 5.0, rim, inside, ground);
    }
}

/// The text with XML's special characters escaped, and characters that XML forbids removed.
pub fn escape(text: &str) -> String {
    escaped(text)
}
