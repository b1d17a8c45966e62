//! A figure laid out on a page, and the order in which its parts are drawn.

mod ground;
mod legend;
mod marks;
mod panels;

use chromascope_text::choices;

use super::ink::{Ink, InkRole, Palette};
use super::mark::{Anchor, Image, Mark, Marker, MarkerOutline, Stroke, TextSize};
use super::panel::{Figure, LegendPlace};
use super::projection::Projection;
use super::rect::Rect;
use super::text::wrapped;

choices! {
    /// Position of the titles of the axes.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    pub enum AxisTitles {
        /// In the corners of the plot.
        #[default]
        Inside = "inside", "Inside", "In the corners of the plot";
        /// Centered along the axes, beyond the tick labels; the page grows by them.
        Outside = "outside", "Outside", "Along the axes";
        /// Nowhere.
        None = "none", "None", "No titles";
    }
}

/// Layout of a figure on a page, apart from its colors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PageStyle {
    /// Width on paper in millimeters, the whole page being scaled to it; `None` takes the page's points.
    pub width_mm: Option<f64>,
    /// Factor on the widths of lines and on markers.
    pub line_scale: f64,
    /// Titles of the axes.
    pub axis_titles: AxisTitles,
}

impl Default for PageStyle {
    fn default() -> Self {
        Self { width_mm: None, line_scale: 1.0, axis_titles: AxisTitles::default() }
    }
}

/// Places of everything on a page: the rectangles of page and legend, the lines of the caption.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// The page, around the figure's origin.
    pub area: Rect,
    legend: (LegendPlace, Option<Rect>),
    caption: Vec<String>,
    /// Height of the figure without legend and caption.
    height: f64,
}

impl Page {
    /// Empty space around everything.
    const MARGIN: f64 = 8.0;
    const CAPTION_LINE: f64 = 15.0;
    const CAPTION_GAP: f64 = 12.0;

    /// Lays out a figure.
    pub fn new(figure: &Figure, style: &PageStyle) -> Self {
        let titles = panels::room_of_titles(&figure.panels, style.axis_titles);
        let [width, height] = [0, 1].map(|side| figure.size[side] + titles[side]);
        let mut size = [width, height];
        let place = legend::place(figure);
        let legend = legend::outside(figure, place, size);
        if let Some(legend) = legend {
            size = [size[0].max(legend.max[0]), size[1].max(legend.max[1])];
        }
        let caption = wrapped(&figure.caption, TextSize::Small, size[0]);
        let top = size[1];
        if !caption.is_empty() {
            size[1] += Self::CAPTION_GAP + Self::CAPTION_LINE * caption.len() as f64;
        }
        let area = Rect::from_min_size([-Self::MARGIN; 2], size.map(|side| side + 2.0 * Self::MARGIN));
        Self { area, legend: (place, legend), caption, height: top }
    }

    /// Width and height that the page has beyond the figure's own size.
    pub fn surplus(&self, figure: &Figure) -> [f64; 2] {
        [self.area.width() - figure.size[0], self.area.height() - figure.size[1]]
    }

    /// Points on paper for each point of the figure.
    pub fn scale(&self, style: &PageStyle) -> f64 {
        style.width_mm.map_or(1.0, |mm| mm / 25.4 * 72.0 / self.area.width().max(1.0))
    }
}

pub(super) fn draw(figure: &Figure, page: &Page, style: &PageStyle, palette: &dyn Palette, canvas: &mut dyn Canvas) {
    let mut brush = Brush { canvas, palette, line_scale: style.line_scale };
    brush.rect(page.area, None, Some(InkRole::Plot.into()));
    let panels = panels::spread(&figure.panels, style.axis_titles);
    let projections: Vec<Projection> = panels.iter().map(|titled| Projection::new(&titled.panel, 1.0)).collect();
    for (titled, projection) in panels.iter().zip(&projections) {
        panels::draw(&mut brush, titled, projection);
    }
    if !figure.legend.is_empty() && figure.legend_place != LegendPlace::None {
        let drawn: Vec<_> = panels.iter().map(|titled| &titled.panel).zip(&projections).collect();
        legend::draw(&mut brush, figure, page.legend, &drawn);
    }
    for (i, line) in page.caption.iter().enumerate() {
        let y = page.height + 8.0 + Page::CAPTION_LINE * i as f64;
        brush.text(&TextLine::new([0.0, y], line, Anchor::LEFT_TOP, TextSize::Small, InkRole::Text.into()));
    }
}

struct Brush<'a> {
    canvas: &'a mut dyn Canvas,
    palette: &'a dyn Palette,
    line_scale: f64,
}

impl Brush<'_> {
    fn scaled(&self, stroke: Stroke) -> Stroke {
        Stroke { width: stroke.width * self.line_scale, ..stroke }
    }

    fn path(&mut self, points: &[[f64; 2]], closed: bool, stroke: Option<Stroke>, fill: Option<Ink>) {
        if points.len() > 1 {
            let stroke = stroke.map(|stroke| self.scaled(stroke));
            self.canvas.path(points, closed, stroke, fill);
        }
    }

    fn rect(&mut self, area: Rect, stroke: Option<Stroke>, fill: Option<Ink>) {
        let stroke = stroke.map(|stroke| self.scaled(stroke));
        self.canvas.rect(area, stroke, fill);
    }

    fn text(&mut self, label: &TextLine<'_>) {
        if !label.text.is_empty() {
            self.canvas.text(label);
        }
    }

    /// Draws a marker; its halo lies below rim and inside.
    fn marker(
        &mut self,
        at: [f64; 2],
        (marker, radius): (Marker, f64),
        rim: Option<Stroke>,
        fill: Option<Ink>,
        halo: Option<Ink>,
    ) {
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
        let radius = radius * self.line_scale;
        let place = |p: &[f64; 2]| [at[0] + radius * p[0], at[1] + radius * p[1]];
        match outline {
            MarkerOutline::Disk(size) => {
                let stroke = stroke.map(|stroke| self.scaled(stroke));
                self.canvas.disk(at, radius * size, stroke, fill);
            }
            MarkerOutline::Area(corners) => {
                let corners: Vec<[f64; 2]> = corners.iter().map(place).collect();
                self.path(&corners, true, stroke, fill);
            }
            MarkerOutline::Strokes(lines) => {
                for line in lines {
                    self.path(&[place(&line[0]), place(&line[1])], false, stroke, None);
                }
            }
        }
    }
}

/// A document being written. Lengths are the figure's points, y downward.
pub(crate) trait Canvas {
    /// Begins a named group; with a rectangle, its contents show inside that only.
    fn begin(&mut self, name: &str, clip: Option<Rect>);
    fn end(&mut self);
    fn path(&mut self, points: &[[f64; 2]], closed: bool, stroke: Option<Stroke>, fill: Option<Ink>);
    fn rect(&mut self, area: Rect, stroke: Option<Stroke>, fill: Option<Ink>);
    fn disk(&mut self, center: [f64; 2], radius: f64, stroke: Option<Stroke>, fill: Option<Ink>);
    fn text(&mut self, label: &TextLine<'_>);
    fn image(&mut self, area: Rect, image: &Image);
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct TextLine<'a> {
    pub(crate) at: [f64; 2],
    pub(crate) text: &'a str,
    pub(crate) anchor: Anchor,
    pub(crate) size: TextSize,
    pub(crate) ink: Ink,
    pub(crate) halo: Option<Ink>,
    pub(crate) upward: bool,
}

impl<'a> TextLine<'a> {
    /// Width of a halo's stroke, half of which shows on each side.
    pub(crate) const HALO: f64 = 4.0;

    /// Text without a halo, running to the right.
    pub(crate) fn new(at: [f64; 2], text: &'a str, anchor: Anchor, size: TextSize, ink: Ink) -> Self {
        Self { at, text, anchor, size, ink, halo: None, upward: false }
    }

    /// Distance from the place down to the baseline. The center is that of capital letters and digits.
    pub(crate) fn baseline(&self) -> f64 {
        let (top, middle, bottom) = (0.80, 0.36, -0.22);
        let vertical = self.anchor.1;
        let share = if vertical < 0.5 {
            top + (middle - top) * 2.0 * vertical
        } else {
            middle + (bottom - middle) * (2.0 * vertical - 1.0)
        };
        share * f64::from(self.size.points())
    }
}
