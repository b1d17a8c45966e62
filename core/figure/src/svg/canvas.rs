//! SVG elements, one function each.

use std::fmt::Write as _;

use super::SvgStyle;
use crate::ink::{Ink, Palette};
use crate::mark::{Anchor, Mark, Marker, MarkerOutline, Stroke, TextSize};
use crate::rect::Rect;

/// A document being written.
pub(super) struct Canvas<'a> {
    pub(super) style: &'a SvgStyle<'a>,
    palette: &'a dyn Palette,
    out: String,
}

impl<'a> Canvas<'a> {
    pub(super) fn new(palette: &'a dyn Palette, style: &'a SvgStyle<'a>) -> Self {
        Self { style, palette, out: String::new() }
    }

    pub(super) fn push(&mut self, text: &str) {
        self.out.push_str(text);
    }

    pub(super) fn open(&mut self, page: Rect, title: &str) {
        let size = [page.width(), page.height()];
        let [left, top] = page.min.map(coordinate);
        let [width, height] = size.map(coordinate);
        let (on_paper, unit) = match self.style.width_mm {
            Some(mm) => ([mm, mm * size[1] / size[0].max(1.0)].map(coordinate), "mm"),
            None => ([width.clone(), height.clone()], "pt"),
        };
        let [paper_width, paper_height] = on_paper;
        self.push(&format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{paper_width}{unit}\" \
             height=\"{paper_height}{unit}\" viewBox=\"{left} {top} {width} {height}\" role=\"img\" \
             font-family=\"{}\">\n<title>{}</title>\n",
            escaped(self.style.font_family),
            escaped(title)
        ));
    }

    pub(super) fn close(mut self) -> String {
        self.push("</svg>\n");
        self.out
    }

    /// Opens a group whose contents show inside the rectangle only.
    pub(super) fn group_clipped(&mut self, index: usize, clip: Rect, name: &str) {
        let [x, y] = clip.min.map(coordinate);
        let (width, height) = (coordinate(clip.width()), coordinate(clip.height()));
        self.push(&format!(
            "<clipPath id=\"panel{index}\"><rect x=\"{x}\" y=\"{y}\" width=\"{width}\" \
             height=\"{height}\"/></clipPath>\n<g clip-path=\"url(#panel{index})\">"
        ));
        self.title(name);
        self.push("\n");
    }

    pub(super) fn group(&mut self, name: &str) {
        self.push("<g>");
        self.title(name);
        self.push("\n");
    }

    pub(super) fn end_group(&mut self) {
        self.push("</g>\n");
    }

    fn title(&mut self, name: &str) {
        if !name.is_empty() {
            self.push(&format!("<title>{}</title>", escaped(name)));
        }
    }

    pub(super) fn rect(&mut self, rect: Rect, stroke: Option<Stroke>, fill: Option<Ink>) {
        let [x, y] = rect.min.map(coordinate);
        let (width, height) = (coordinate(rect.width()), coordinate(rect.height()));
        let paint = self.paint(stroke, fill);
        self.push(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"{paint}/>\n"));
    }

    pub(super) fn polyline(&mut self, points: &[[f64; 2]], closed: bool, stroke: Stroke) {
        let paint = self.paint(Some(stroke), None);
        self.path(&path(points, closed), &paint);
    }

    pub(super) fn area(&mut self, points: &[[f64; 2]], stroke: Option<Stroke>, fill: Option<Ink>) {
        let paint = self.paint(stroke, fill);
        self.path(&path(points, true), &paint);
    }

    fn path(&mut self, data: &str, paint: &str) {
        if !data.is_empty() {
            self.push(&format!("<path d=\"{data}\"{paint}/>\n"));
        }
    }

    /// Draws a marker; its halo lies below rim and inside.
    pub(super) fn marker(
        &mut self,
        at: [f64; 2],
        marker: Marker,
        radius: f64,
        rim: Option<Stroke>,
        fill: Option<Ink>,
        halo: Option<Ink>,
    ) {
        let radius = radius * self.style.line_scale;
        let outline = marker.outline();
        let line = match &outline {
            MarkerOutline::Strokes(_) => rim.or(fill.map(|ink| Stroke::solid(ink, 2.0))),
            _ => rim,
        };
        if let Some(ink) = halo {
            let width = line.map_or(0.0, |rim| rim.width) + 2.0 * Mark::HALO;
            self.outline(&outline, at, radius, Some(Stroke::solid(ink, width)), Some(ink));
        }
        self.outline(&outline, at, radius, line, fill);
    }

    fn outline(
        &mut self,
        outline: &MarkerOutline,
        at: [f64; 2],
        radius: f64,
        stroke: Option<Stroke>,
        fill: Option<Ink>,
    ) {
        let place = |p: &[f64; 2]| [at[0] + radius * p[0], at[1] + radius * p[1]];
        match outline {
            MarkerOutline::Disk(size) => {
                let [x, y] = at.map(coordinate);
                let (r, paint) = (coordinate(radius * size), self.paint(stroke, fill));
                self.push(&format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"{paint}/>\n"));
            }
            MarkerOutline::Area(corners) => {
                let corners: Vec<[f64; 2]> = corners.iter().map(place).collect();
                self.area(&corners, stroke, fill);
            }
            MarkerOutline::Strokes(lines) => {
                let data: String = lines.iter().map(|line| path(&[place(&line[0]), place(&line[1])], false)).collect();
                let paint = self.paint(stroke, None);
                self.path(&data, &paint);
            }
        }
    }

    pub(super) fn text(&mut self, at: [f64; 2], text: &str, anchor: Anchor, size: TextSize, ink: Ink) {
        self.text_with_halo(at, text, anchor, size, ink, None);
    }

    pub(super) fn text_with_halo(
        &mut self,
        at: [f64; 2],
        text: &str,
        anchor: Anchor,
        size: TextSize,
        ink: Ink,
        halo: Option<Ink>,
    ) {
        if text.is_empty() {
            return;
        }
        let points = f64::from(size.points()) * self.style.text_scale;
        let x = coordinate(at[0]);
        let y = coordinate(at[1] + points * baseline(anchor.1));
        let align = match anchor.0 {
            h if h < 0.25 => "start",
            h if h > 0.75 => "end",
            _ => "middle",
        };
        let family = match size {
            TextSize::Mono => format!(" font-family=\"{}\"", escaped(self.style.mono_family)),
            _ => String::new(),
        };
        let points = coordinate(points);
        let text = escaped(text);
        let mut write = |paint: &str| {
            let _ = writeln!(
                self.out,
                "<text x=\"{x}\" y=\"{y}\" font-size=\"{points}\" text-anchor=\"{align}\"{family}{paint}>{text}</text>"
            );
        };
        if let Some(halo) = halo {
            let under = paint(self.palette, self.style.text_scale, Some(Stroke::solid(halo, 4.0)), Some(halo));
            write(&under);
        }
        write(&paint(self.palette, 1.0, None, Some(ink)));
    }

    pub(super) fn image(&mut self, rect: Rect, uri: &str) {
        let [x, y] = rect.min.map(coordinate);
        let (width, height) = (coordinate(rect.width()), coordinate(rect.height()));
        let uri = escaped(uri);
        self.push(&format!(
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             preserveAspectRatio=\"none\" href=\"{uri}\"/>\n"
        ));
    }

    fn paint(&self, stroke: Option<Stroke>, fill: Option<Ink>) -> String {
        paint(self.palette, self.style.line_scale, stroke, fill)
    }
}

/// Presentation attributes.
fn paint(palette: &dyn Palette, scale: f64, stroke: Option<Stroke>, fill: Option<Ink>) -> String {
    let hex = |ink: Ink| {
        let [r, g, b] = palette.rgb(ink.role);
        format!("#{r:02x}{g:02x}{b:02x}")
    };
    let opacity = |name: &str, ink: Ink| match ink.alpha {
        alpha if alpha < 1.0 => format!(" {name}-opacity=\"{}\"", coordinate(f64::from(alpha))),
        _ => String::new(),
    };
    let mut out = match fill {
        Some(ink) => format!(" fill=\"{}\"{}", hex(ink), opacity("fill", ink)),
        None => " fill=\"none\"".to_owned(),
    };
    if let Some(stroke) = stroke {
        let width = stroke.width * scale;
        let (color, opacity) = (hex(stroke.ink), opacity("stroke", stroke.ink));
        let _ = write!(
            out,
            " stroke=\"{color}\"{opacity} stroke-width=\"{}\" stroke-linejoin=\"round\"",
            coordinate(width)
        );
        match stroke.dash.pattern(width) {
            Some([dash, gap]) => {
                let _ = write!(out, " stroke-dasharray=\"{} {}\"", coordinate(dash), coordinate(gap));
            }
            None => out.push_str(" stroke-linecap=\"round\""),
        }
    }
    out
}

/// Distance from a place down to the baseline of text anchored there, relative to the font size. The center is that of
/// capital letters and digits.
fn baseline(vertical: f64) -> f64 {
    let (top, middle, bottom) = (0.80, 0.36, -0.22);
    if vertical < 0.5 {
        top + (middle - top) * 2.0 * vertical
    } else {
        middle + (bottom - middle) * (2.0 * vertical - 1.0)
    }
}

fn path(points: &[[f64; 2]], closed: bool) -> String {
    let mut data = String::new();
    for (i, point) in points.iter().enumerate() {
        let [x, y] = point.map(coordinate);
        let _ = write!(data, "{}{x} {y}", if i == 0 { 'M' } else { 'L' });
    }
    if closed && !data.is_empty() {
        data.push('Z');
    }
    data
}

/// A length to a hundredth of a point. Far outside the page it is held, as renderers count in `f32`.
fn coordinate(value: f64) -> String {
    let rounded = (value.clamp(-1e6, 1e6) * 100.0).round() / 100.0;
    let sign_free = if rounded == 0.0 { 0.0 } else { rounded };
    format!("{sign_free}")
}

pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push(' '),
            '\u{0}'..='\u{1F}' | '\u{FFFE}' | '\u{FFFF}' => {}
            _ => out.push(c),
        }
    }
    out
}
