//! A figure as SVG.
//!
//! Plain shapes with presentation attributes, no style sheet, no script, no `dominant-baseline`. A text's halo is its own
//! stroke, painted first (`paint-order`), so that each text is there once.

use std::fmt::Write as _;

use super::ink::{Ink, Palette};
use super::mark::{Image, Stroke, TextSize};
use super::page::{Canvas, Page, PageStyle, TextLine, draw};
use super::panel::Figure;
use super::rect::Rect;
use super::text::text_width;

/// Fonts and images of a written figure.
pub struct SvgStyle<'a> {
    /// Font family of text.
    pub font_family: &'a str,
    /// Font family of [`TextSize::Mono`].
    pub mono_family: &'a str,
    /// Encodes a picture as a data URI (`data:image/png;base64,…`). Pictures it cannot encode are omitted.
    pub encode: &'a dyn Fn(&Image) -> Option<String>,
}

/// Writes a figure as an SVG document.
pub fn write(figure: &Figure, palette: &dyn Palette, style: &SvgStyle<'_>, layout: &PageStyle) -> String {
    let page = Page::new(figure, layout);
    let mut canvas = Svg { style, palette, out: String::new(), clips: 0 };
    canvas.open(page.area, &figure.title, layout.width_mm);
    draw(figure, &page, layout, palette, &mut canvas);
    canvas.out.push_str("</svg>\n");
    canvas.out
}

struct Svg<'a> {
    style: &'a SvgStyle<'a>,
    palette: &'a dyn Palette,
    out: String,
    clips: usize,
}

impl Svg<'_> {
    fn open(&mut self, page: Rect, title: &str, width_mm: Option<f64>) {
        let size = [page.width(), page.height()];
        let [left, top] = page.min.map(coordinate);
        let [width, height] = size.map(coordinate);
        let (on_paper, unit) = match width_mm {
            Some(mm) => ([mm, mm * size[1] / size[0].max(1.0)].map(coordinate), "mm"),
            None => ([width.clone(), height.clone()], "pt"),
        };
        let [paper_width, paper_height] = on_paper;
        let _ = write!(
            self.out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{paper_width}{unit}\" \
             height=\"{paper_height}{unit}\" viewBox=\"{left} {top} {width} {height}\" role=\"img\" \
             font-family=\"{}\">\n<title>{}</title>\n",
            escape(self.style.font_family),
            escape(title)
        );
    }

    fn hex(&self, ink: Ink) -> String {
        let [r, g, b] = self.palette.rgb(ink.role);
        format!("#{r:02x}{g:02x}{b:02x}")
    }

    fn paint(&self, stroke: Option<Stroke>, fill: Option<Ink>) -> String {
        let opacity = |name: &str, ink: Ink| match ink.alpha {
            alpha if alpha < 1.0 => format!(" {name}-opacity=\"{}\"", coordinate(f64::from(alpha))),
            _ => String::new(),
        };
        let mut out = match fill {
            Some(ink) => format!(" fill=\"{}\"{}", self.hex(ink), opacity("fill", ink)),
            None => " fill=\"none\"".to_owned(),
        };
        if let Some(stroke) = stroke {
            let (color, opacity) = (self.hex(stroke.ink), opacity("stroke", stroke.ink));
            let width = coordinate(stroke.width);
            let _ = write!(out, " stroke=\"{color}\"{opacity} stroke-width=\"{width}\" stroke-linejoin=\"round\"");
            match stroke.dash.pattern(stroke.width) {
                Some([dash, gap]) => {
                    let _ = write!(out, " stroke-dasharray=\"{} {}\"", coordinate(dash), coordinate(gap));
                }
                None => out.push_str(" stroke-linecap=\"round\""),
            }
        }
        out
    }
}

impl Canvas for Svg<'_> {
    fn begin(&mut self, name: &str, clip: Option<Rect>) {
        if let Some(clip) = clip {
            let index = self.clips;
            self.clips += 1;
            let place = place(clip);
            let _ = write!(
                self.out,
                "<clipPath id=\"panel{index}\"><rect{place}/></clipPath>\n<g clip-path=\"url(#panel{index})\">"
            );
        } else {
            self.out.push_str("<g>");
        }
        if !name.is_empty() {
            let _ = write!(self.out, "<title>{}</title>", escape(name));
        }
        self.out.push('\n');
    }

    fn end(&mut self) {
        self.out.push_str("</g>\n");
    }

    fn path(&mut self, points: &[[f64; 2]], closed: bool, stroke: Option<Stroke>, fill: Option<Ink>) {
        let paint = self.paint(stroke, fill);
        self.out.push_str("<path d=\"");
        for (i, point) in points.iter().enumerate() {
            let [x, y] = point.map(coordinate);
            let _ = write!(self.out, "{}{x} {y}", if i == 0 { 'M' } else { 'L' });
        }
        let end = if closed { "Z" } else { "" };
        let _ = writeln!(self.out, "{end}\"{paint}/>");
    }

    fn rect(&mut self, area: Rect, stroke: Option<Stroke>, fill: Option<Ink>) {
        let paint = self.paint(stroke, fill);
        let _ = writeln!(self.out, "<rect{}{paint}/>", place(area));
    }

    fn disk(&mut self, center: [f64; 2], radius: f64, stroke: Option<Stroke>, fill: Option<Ink>) {
        let [x, y] = center.map(coordinate);
        let (r, paint) = (coordinate(radius), self.paint(stroke, fill));
        let _ = writeln!(self.out, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"{paint}/>");
    }

    fn text(&mut self, label: &TextLine<'_>) {
        let down = label.baseline();
        // SVG has three anchors; between them the text is moved along its line.
        let (align, anchor) = match label.anchor.0 {
            h if h < 0.25 => ("start", 0.0),
            h if h > 0.75 => ("end", 1.0),
            _ => ("middle", 0.5),
        };
        let along = (anchor - label.anchor.0) * text_width(label.text, label.size);
        let shift = if label.upward { [down, -along] } else { [along, down] };
        let [x, y] = [0, 1].map(|axis| coordinate(label.at[axis] + shift[axis]));
        let family = match label.size {
            TextSize::Mono => format!(" font-family=\"{}\"", escape(self.style.mono_family)),
            _ => String::new(),
        };
        let turned = if label.upward { format!(" transform=\"rotate(-90 {x} {y})\"") } else { String::new() };
        let halo = label.halo.map(|ink| Stroke::solid(ink, TextLine::HALO));
        let order = if halo.is_some() { " paint-order=\"stroke\"" } else { "" };
        let (paint, points) = (self.paint(halo, Some(label.ink)), coordinate(f64::from(label.size.points())));
        let _ = writeln!(
            self.out,
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{points}\" text-anchor=\"{align}\"{family}{turned}{paint}{order}>{}</text>",
            escape(label.text)
        );
    }

    fn image(&mut self, area: Rect, image: &Image) {
        let Some(uri) = (self.style.encode)(image) else { return };
        let (place, uri) = (place(area), escape(&uri));
        let _ = writeln!(self.out, "<image{place} preserveAspectRatio=\"none\" href=\"{uri}\"/>");
    }
}

fn place(area: Rect) -> String {
    let [x, y, width, height] = [area.min[0], area.min[1], area.width(), area.height()].map(coordinate);
    format!(" x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"")
}

/// A length to a hundredth of a point. Far outside the page it is held, as renderers count in `f32`.
fn coordinate(value: f64) -> String {
    let rounded = (value.clamp(-1e6, 1e6) * 100.0).round() / 100.0;
    let sign_free = if rounded == 0.0 { 0.0 } else { rounded };
    format!("{sign_free}")
}

/// The text with XML's special characters escaped, and characters that XML forbids removed.
pub fn escape(text: &str) -> String {
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
