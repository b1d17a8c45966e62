//! A figure as PDF: vectors, and text in embedded subsets of its fonts.
//!
//! The same figure gives the same bytes: there is no date in the file.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use krilla::color::rgb;
use krilla::geom::{Path, PathBuilder, Point, Size, Transform};
use krilla::image::{BitsPerComponent, CustomImage, ImageColorspace};
use krilla::metadata::Metadata;
use krilla::num::NormalizedF32;
use krilla::page::PageSettings;
use krilla::paint::{self, Fill, FillRule, LineCap, LineJoin, StrokeDash};
use krilla::surface::Surface;
use krilla::text::{Font, GlyphId, KrillaGlyph};
use krilla::{Data, Document};
use rustybuzz::{Direction, Face, UnicodeBuffer};

use super::ink::{Ink, Palette};
use super::mark::{Image, Stroke, TextSize};
use super::page::{Canvas, Page, PageStyle, TextLine, draw};
use super::panel::Figure;
use super::rect::Rect;

/// Reason that there is no PDF.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum PdfError {
    #[error("a font cannot be read")]
    Font,
    #[error("the page has no area, or is larger than 5 m")]
    Size,
    #[error("the PDF cannot be written: {0}")]
    Write(String),
}

/// `OpenType` fonts of a written figure.
#[derive(Debug, Clone, Copy)]
pub struct PdfFonts {
    /// Font of text.
    pub text: &'static [u8],
    /// Font of [`TextSize::Mono`].
    pub mono: &'static [u8],
    /// Font of lines with a character that theirs lacks.
    pub fallback: &'static [u8],
}

/// The longest side of a page in points.
const MAX_SIDE: f64 = 14_400.0;

/// Writes a figure as a PDF document of one page.
///
/// # Errors
/// If a font cannot be read, or the page is too small or too large.
pub fn write(figure: &Figure, palette: &dyn Palette, fonts: PdfFonts, layout: &PageStyle) -> Result<Vec<u8>, PdfError> {
    let fonts = [fonts.text, fonts.mono, fonts.fallback].map(Typeface::new);
    let [text, mono, fallback] = fonts;
    let fonts = [text?, mono?, fallback?];
    let page = Page::new(figure, layout);
    let scale = page.scale(layout);
    let size = [page.area.width(), page.area.height()].map(|side| side * scale);
    if !size.iter().all(|side| (1.0..=MAX_SIDE).contains(side)) {
        return Err(PdfError::Size);
    }
    let mut document = Document::new();
    document.set_metadata(Metadata::new().title(figure.title.clone()).creator("Chromascope".to_owned()));
    let settings = PageSettings::from_wh(size[0] as f32, size[1] as f32).ok_or(PdfError::Size)?;
    let mut sheet = document.start_page_with(settings);
    let mut surface = sheet.surface();
    let [left, top] = page.area.min;
    let moved = [-left * scale, -top * scale].map(|v| v as f32);
    surface.push_transform(&Transform::from_row(scale as f32, 0.0, 0.0, scale as f32, moved[0], moved[1]));
    draw(figure, &page, layout, palette, &mut Pdf { surface: &mut surface, palette, fonts, clipped: Vec::new() });
    surface.pop();
    surface.finish();
    sheet.finish();
    document.finish().map_err(|error| PdfError::Write(format!("{error:?}")))
}

struct Typeface {
    face: Face<'static>,
    font: Font,
}

impl Typeface {
    fn new(bytes: &'static [u8]) -> Result<Self, PdfError> {
        let font = Font::new(Data::from(bytes), 0).ok_or(PdfError::Font)?;
        Ok(Self { face: Face::from_slice(bytes, 0).ok_or(PdfError::Font)?, font })
    }

    fn has(&self, text: &str) -> bool {
        text.chars().all(|c| self.face.glyph_index(c).is_some())
    }

    /// The glyphs of a line of text, and its width for a font size of 1.
    fn shaped(&self, text: &str) -> (Vec<KrillaGlyph>, f32) {
        let mut buffer = UnicodeBuffer::new();
        buffer.push_str(text);
        buffer.guess_segment_properties();
        buffer.set_direction(Direction::LeftToRight);
        let shaped = rustybuzz::shape(&self.face, &[], buffer);
        let em = self.font.units_per_em();
        let starts: Vec<usize> = shaped.glyph_infos().iter().map(|info| info.cluster as usize).collect();
        let glyphs =
            starts.iter().zip(shaped.glyph_infos()).zip(shaped.glyph_positions()).map(|((&start, info), at)| {
                let end = starts.iter().copied().filter(|other| *other > start).min().unwrap_or(text.len());
                let [advance, x, y, up] = [at.x_advance, at.x_offset, at.y_offset, at.y_advance].map(|v| v as f32 / em);
                KrillaGlyph::new(GlyphId::new(info.glyph_id), advance, x, y, up, start..end, None)
            });
        let glyphs: Vec<KrillaGlyph> = glyphs.collect();
        let width = glyphs.iter().map(|glyph| glyph.x_advance).sum();
        (glyphs, width)
    }
}

struct Pdf<'a, 'b> {
    surface: &'a mut Surface<'b>,
    palette: &'a dyn Palette,
    fonts: [Typeface; 3],
    /// True for each open group that is clipped.
    clipped: Vec<bool>,
}

impl Pdf<'_, '_> {
    fn color(&self, ink: Ink) -> (paint::Paint, NormalizedF32) {
        let [r, g, b] = self.palette.rgb(ink.role);
        let opacity = NormalizedF32::new(ink.alpha.clamp(0.0, 1.0)).unwrap_or(NormalizedF32::ONE);
        (rgb::Color::new(r, g, b).into(), opacity)
    }

    fn fill(&self, ink: Ink) -> Fill {
        let (paint, opacity) = self.color(ink);
        Fill { paint, opacity, rule: FillRule::NonZero }
    }

    fn stroke(&self, stroke: Stroke) -> paint::Stroke {
        let (paint, opacity) = self.color(stroke.ink);
        let dash = stroke.dash.pattern(stroke.width);
        paint::Stroke {
            paint,
            width: stroke.width as f32,
            miter_limit: 10.0,
            line_cap: if dash.is_some() { LineCap::Butt } else { LineCap::Round },
            line_join: LineJoin::Round,
            opacity,
            dash: dash.map(|dash| StrokeDash { array: dash.map(|v| v as f32).to_vec(), offset: 0.0 }),
        }
    }

    fn draw(&mut self, path: Option<Path>, stroke: Option<Stroke>, fill: Option<Ink>) {
        let (fill, stroke) = (fill.map(|ink| self.fill(ink)), stroke.map(|stroke| self.stroke(stroke)));
        // Without either, krilla fills in black.
        if let Some(path) = path.filter(|_| fill.is_some() || stroke.is_some()) {
            self.surface.set_fill(fill);
            self.surface.set_stroke(stroke);
            self.surface.draw_path(&path);
        }
    }
}

impl Canvas for Pdf<'_, '_> {
    fn begin(&mut self, _: &str, clip: Option<Rect>) {
        let path = clip.and_then(|clip| outline(&corners(clip), true));
        if let Some(path) = &path {
            self.surface.push_clip_path(path, &FillRule::NonZero);
        }
        self.clipped.push(path.is_some());
    }

    fn end(&mut self) {
        if self.clipped.pop() == Some(true) {
            self.surface.pop();
        }
    }

    fn path(&mut self, points: &[[f64; 2]], closed: bool, stroke: Option<Stroke>, fill: Option<Ink>) {
        self.draw(outline(points, closed), stroke, fill);
    }

    fn rect(&mut self, area: Rect, stroke: Option<Stroke>, fill: Option<Ink>) {
        self.draw(outline(&corners(area), true), stroke, fill);
    }

    fn disk(&mut self, [x, y]: [f64; 2], radius: f64, stroke: Option<Stroke>, fill: Option<Ink>) {
        // Four Bézier curves, 0.03 % of the radius off.
        let (r, k) = (radius, 0.552_284_75 * radius);
        let mut path = PathBuilder::new();
        let [at, right] = [[x, y], [x + r, y]].map(|p| p.map(|v| v as f32));
        path.move_to(right[0], at[1]);
        for [a, b, end] in [
            [[r, k], [k, r], [0.0, r]],
            [[-k, r], [-r, k], [-r, 0.0]],
            [[-r, -k], [-k, -r], [0.0, -r]],
            [[k, -r], [r, -k], [r, 0.0]],
        ] {
            let [a, b, end] = [a, b, end].map(|p| [(x + p[0]) as f32, (y + p[1]) as f32]);
            path.cubic_to(a[0], a[1], b[0], b[1], end[0], end[1]);
        }
        path.close();
        self.draw(path.finish(), stroke, fill);
    }

    fn text(&mut self, label: &TextLine<'_>) {
        let [text, mono, fallback] = &self.fonts;
        let wanted = if label.size == TextSize::Mono { mono } else { text };
        let typeface = if wanted.has(label.text) { wanted } else { fallback };
        let (glyphs, width) = typeface.shaped(label.text);
        let (font, points) = (typeface.font.clone(), label.size.points());
        let start = Point::from_xy(-label.anchor.0 as f32 * width * points, label.baseline() as f32);
        let [x, y] = label.at.map(|v| v as f32);
        let turn = if label.upward { [0.0, -1.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0, 1.0] };
        self.surface.push_transform(&Transform::from_row(turn[0], turn[1], turn[2], turn[3], x, y));
        if let Some(halo) = label.halo {
            // Outlines: the words are in the file once.
            let stroke = self.stroke(Stroke::solid(halo, TextLine::HALO));
            self.surface.set_fill(None);
            self.surface.set_stroke(Some(stroke));
            self.surface.draw_glyphs(start, &glyphs, font.clone(), label.text, points, true);
        }
        let fill = self.fill(label.ink);
        self.surface.set_fill(Some(fill));
        self.surface.set_stroke(None);
        self.surface.draw_glyphs(start, &glyphs, font, label.text, points, false);
        self.surface.pop();
    }

    fn image(&mut self, area: Rect, image: &Image) {
        let size = [image.width, image.height].map(u32::try_from);
        let size_on_page = Size::from_wh(area.width() as f32, area.height() as f32);
        let ([Ok(width), Ok(height)], Some(on_page)) = (size, size_on_page) else { return };
        if let Ok(picture) = krilla::image::Image::from_custom(Pixels::new(image, (width, height)), true) {
            let [x, y] = area.min.map(|v| v as f32);
            self.surface.push_transform(&Transform::from_translate(x, y));
            self.surface.draw_image(picture, on_page);
            self.surface.pop();
        }
    }
}

fn corners(Rect { min, max }: Rect) -> [[f64; 2]; 4] {
    [min, [max[0], min[1]], max, [min[0], max[1]]]
}

fn outline(points: &[[f64; 2]], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (i, point) in points.iter().enumerate() {
        let [x, y] = point.map(|v| v as f32);
        if i == 0 {
            path.move_to(x, y);
        } else {
            path.line_to(x, y);
        }
    }
    if closed {
        path.close();
    }
    path.finish()
}

/// Colors and opacities of a picture, apart; an opaque one has colors only.
#[derive(Clone)]
struct Pixels {
    rgb: Arc<[u8]>,
    alpha: Option<Arc<[u8]>>,
    size: (u32, u32),
}

impl Pixels {
    fn new(image: &Image, size: (u32, u32)) -> Self {
        let pixels = || image.rgba.chunks_exact(4);
        let translucent = pixels().any(|pixel| pixel[3] < 255);
        Self {
            rgb: pixels().flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect(),
            alpha: translucent.then(|| pixels().map(|pixel| pixel[3]).collect()),
            size,
        }
    }
}

impl Hash for Pixels {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.rgb.hash(state);
        self.alpha.hash(state);
        self.size.hash(state);
    }
}

impl CustomImage for Pixels {
    fn color_channel(&self) -> &[u8] {
        &self.rgb
    }

    fn alpha_channel(&self) -> Option<&[u8]> {
        self.alpha.as_deref()
    }

    fn bits_per_component(&self) -> BitsPerComponent {
        BitsPerComponent::Eight
    }

    fn size(&self) -> (u32, u32) {
        self.size
    }

    fn icc_profile(&self) -> Option<&[u8]> {
        None
    }

    fn color_space(&self) -> ImageColorspace {
        ImageColorspace::Rgb
    }
}
