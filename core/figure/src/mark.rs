//! Marks inside a panel.

use std::sync::Arc;

use super::ink::Ink;

/// An 8-bit sRGB color of data.
pub type Rgb = [u8; 3];

/// Identity of what a mark stands for, opaque to the figure: returned by hit tests, used for emphasis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Tag(pub u32);

/// One drawn thing: a shape, how it is drawn, and what it stands for.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Item that the mark stands for.
    pub tag: Tag,
    /// Name for screen readers and the SVG; may repeat.
    pub name: String,
    /// Its geometry in data units.
    pub shape: Shape,
    /// Line, or rim of an area or marker.
    pub stroke: Option<Stroke>,
    /// Inside of an area or marker.
    pub fill: Option<Ink>,
    /// Drawn underneath, wider by [`Mark::HALO`] points on each side, so that the mark stands out from others.
    pub halo: Option<Ink>,
}

impl Mark {
    /// Width of a halo on each side of its mark, in points.
    pub const HALO: f64 = 1.5;

    /// A mark with neither stroke nor fill; texts, images and gradients need none.
    pub fn new(tag: Tag, name: impl Into<String>, shape: Shape) -> Self {
        Self { tag, name: name.into(), shape, stroke: None, fill: None, halo: None }
    }

    /// A line of text that is its own name.
    pub fn text(text: impl Into<String>, at: [f64; 2], anchor: Anchor, size: TextSize, ink: impl Into<Ink>) -> Self {
        let text = text.into();
        let shape = Shape::Text { at, text: text.clone(), anchor, offset: [0.0; 2], size, ink: ink.into() };
        Self::new(Tag::default(), text, shape)
    }

    /// Text shifted by points, y downward; no other mark has an offset.
    #[must_use]
    pub fn with_offset(mut self, by: [f64; 2]) -> Self {
        if let Shape::Text { offset, .. } = &mut self.shape {
            *offset = by;
        }
        self
    }

    /// Mark with a solid line of the given width in points.
    #[must_use]
    pub fn with_stroke(self, ink: impl Into<Ink>, width: f64) -> Self {
        Self { stroke: Some(Stroke::solid(ink, width)), ..self }
    }

    /// Mark with its line dashed; without a line nothing changes.
    #[must_use]
    pub fn with_dash(self, dash: Dash) -> Self {
        Self { stroke: self.stroke.map(|stroke| Stroke { dash, ..stroke }), ..self }
    }

    /// Mark with a fill.
    #[must_use]
    pub fn with_fill(self, ink: impl Into<Ink>) -> Self {
        Self { fill: Some(ink.into()), ..self }
    }

    /// Mark with a halo.
    #[must_use]
    pub fn with_halo(self, ink: impl Into<Ink>) -> Self {
        Self { halo: Some(ink.into()), ..self }
    }
}

/// Ink, width and pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Its ink.
    pub ink: Ink,
    /// Its width in points.
    pub width: f64,
    /// Its dashes.
    pub dash: Dash,
}

impl Stroke {
    /// An unbroken line.
    pub fn solid(ink: impl Into<Ink>, width: f64) -> Self {
        Self { ink: ink.into(), width, dash: Dash::Solid }
    }
}

/// The dashes of a line: measured data are solid, estimated ones dashed, those assumed beyond the data dotted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Dash {
    /// Unbroken.
    #[default]
    Solid,
    /// Dashed.
    Dashed,
    /// Dotted.
    Dotted,
}

impl Dash {
    /// Lengths of dash and gap in points for a line of the given width; `None` for an unbroken line.
    pub fn pattern(self, width: f64) -> Option<[f64; 2]> {
        match self {
            Self::Solid => None,
            Self::Dashed => Some([3.0 + 2.0 * width, 2.0 + 1.5 * width]),
            Self::Dotted => Some([width.max(1.0), 1.5 + 1.5 * width]),
        }
    }
}

/// The geometry of a mark. Coordinates are in the panel's data units, radii and offsets in points.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A line through points.
    Line {
        /// Its points; one that is not finite breaks it.
        points: Vec<[f64; 2]>,
        /// True if the last point is joined to the first.
        closed: bool,
    },
    /// A line with a color at each point, such as the spectral locus. Takes width and opacity from the stroke (2 and 1 without).
    Gradient {
        /// Points with their colors.
        points: Vec<([f64; 2], Rgb)>,
    },
    /// Markers.
    Points {
        /// Their centers.
        points: Vec<[f64; 2]>,
        /// Their shape.
        marker: Marker,
        /// Their radius in points.
        radius: f64,
    },
    /// A line of text.
    Text {
        /// The place it belongs to.
        at: [f64; 2],
        /// The text.
        text: String,
        /// Point of the text that lies on the place.
        anchor: Anchor,
        /// Shift in points, y downward.
        offset: [f64; 2],
        /// Size and face.
        size: TextSize,
        /// Color.
        ink: Ink,
    },
    /// A rectangle between two corners.
    Rect {
        /// One corner.
        min: [f64; 2],
        /// The opposite corner.
        max: [f64; 2],
    },
    /// An area within a simple, closed outline, convex or not.
    Polygon {
        /// Its corners.
        points: Vec<[f64; 2]>,
    },
    /// A picture.
    Image {
        /// Lower left corner.
        min: [f64; 2],
        /// Upper right corner.
        max: [f64; 2],
        /// The picture, its first row at the top.
        image: Image,
    },
    /// Independent straight lines, such as the tails from points to the reference.
    Segments {
        /// Start and end of each.
        segments: Vec<[[f64; 2]; 2]>,
    },
}

impl PartialEq for Shape {
    /// Gaps in a line equal each other, so that a figure equals its clone.
    fn eq(&self, other: &Self) -> bool {
        let is_same = |a: &f64, b: &f64| a == b || (!a.is_finite() && !b.is_finite());
        let all_same = |a: &[[f64; 2]], b: &[[f64; 2]]| {
            a.len() == b.len() && a.as_flattened().iter().zip(b.as_flattened()).all(|(a, b)| is_same(a, b))
        };
        match (self, other) {
            (Self::Line { points: a, closed: c }, Self::Line { points: b, closed: d }) => c == d && all_same(a, b),
            (Self::Gradient { points: a }, Self::Gradient { points: b }) => a == b,
            (
                Self::Points { points: a, marker, radius },
                Self::Points { points: b, marker: other_marker, radius: other_radius },
            ) => (marker, radius) == (other_marker, other_radius) && all_same(a, b),
            (
                Self::Text { at: a, text: b, anchor: c, offset: d, size: e, ink: f },
                Self::Text { at: u, text: v, anchor: w, offset: x, size: y, ink: z },
            ) => (a, b, c, d, e, f) == (u, v, w, x, y, z),
            (Self::Rect { min: a, max: b }, Self::Rect { min: c, max: d }) => (a, b) == (c, d),
            (Self::Polygon { points: a }, Self::Polygon { points: b }) => all_same(a, b),
            (Self::Image { min: a, max: b, image: c }, Self::Image { min: d, max: e, image: f }) => {
                (a, b, c) == (d, e, f)
            }
            (Self::Segments { segments: a }, Self::Segments { segments: b }) => {
                all_same(a.as_flattened(), b.as_flattened())
            }
            _ => false,
        }
    }
}

/// A picture with straight alpha, sRGB, rows from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// Four bytes per pixel. Pictures whose length is not 4 · width · height are not drawn.
    pub rgba: Arc<[u8]>,
}

impl Image {
    /// True if there is a pixel, and as many bytes as the size says.
    pub fn is_drawable(&self) -> bool {
        self.width > 0 && self.height > 0 && self.rgba.len() == 4 * self.width * self.height
    }
}

/// Point of a text that lies on its place: horizontal, then vertical, each 0 (left, top), 0.5 or 1 (right, bottom).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchor(pub f64, pub f64);

impl Anchor {
    /// Center of the text.
    pub const CENTER: Self = Self(0.5, 0.5);
    /// Middle of the left side: the text stands right of its place.
    pub const LEFT: Self = Self(0.0, 0.5);
    /// Middle of the right side: the text stands left of its place.
    pub const RIGHT: Self = Self(1.0, 0.5);
    /// Middle of the upper side: the text stands below its place.
    pub const TOP: Self = Self(0.5, 0.0);
    /// Middle of the lower side: the text stands above its place.
    pub const BOTTOM: Self = Self(0.5, 1.0);
    /// Upper left corner.
    pub const LEFT_TOP: Self = Self(0.0, 0.0);
    /// Upper right corner.
    pub const RIGHT_TOP: Self = Self(1.0, 0.0);
    /// Lower left corner.
    pub const LEFT_BOTTOM: Self = Self(0.0, 1.0);
    /// Lower right corner.
    pub const RIGHT_BOTTOM: Self = Self(1.0, 1.0);
}

/// The sizes of text there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum TextSize {
    /// Notes and captions.
    Small,
    /// Labels.
    #[default]
    Body,
    /// Headings.
    Heading,
    /// Numbers, in the monospace face.
    Mono,
}

impl TextSize {
    /// Font size in points.
    pub const fn points(self) -> f32 {
        match self {
            Self::Small => 11.5,
            Self::Body => 13.0,
            Self::Heading => 16.0,
            Self::Mono => 12.5,
        }
    }
}

/// The shape of a marker: the second sign, beside color, by which a source is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Marker {
    /// Upright cross: the reference.
    Plus,
    /// Circle.
    Circle,
    /// Square.
    Square,
    /// Triangle pointing up.
    TriangleUp,
    /// Diamond.
    Diamond,
    /// Triangle pointing down.
    TriangleDown,
    /// Hexagon.
    Hexagon,
    /// Triangle pointing right.
    TriangleRight,
    /// Triangle pointing left.
    TriangleLeft,
    /// Diagonal cross: the first observer other than the reference.
    Cross,
    /// Asterisk: the second observer.
    Asterisk,
    /// Small disk, half the radius: ticks along a line.
    Dot,
}

/// A marker of radius 1 around the origin, y downward.
#[derive(Debug, Clone, PartialEq)]
pub enum MarkerOutline {
    /// A disk with its radius.
    Disk(f64),
    /// A convex area with its corners.
    Area(Vec<[f64; 2]>),
    /// Strokes without an inside.
    Strokes(Vec<[[f64; 2]; 2]>),
}

impl Marker {
    const SOURCES: [Self; 8] = [
        Self::Circle,
        Self::Square,
        Self::TriangleUp,
        Self::Diamond,
        Self::TriangleDown,
        Self::Hexagon,
        Self::TriangleRight,
        Self::TriangleLeft,
    ];

    /// The marker of a compared source. Each round of eight is shifted by four, so that color and marker together
    /// stay distinct for 16 sources: the ninth takes the first color with the fifth marker.
    pub fn source(slot: usize) -> Self {
        Self::SOURCES[(slot % 8 + 4 * (slot / 8 % 2)) % 8]
    }

    /// The marker of an observer other than the reference: diagonal cross and asterisk in turn.
    pub fn observer(slot: usize) -> Self {
        if slot.is_multiple_of(2) { Self::Cross } else { Self::Asterisk }
    }

    /// True if the marker has an inside that can be filled.
    pub fn has_inside(self) -> bool {
        !matches!(self, Self::Plus | Self::Cross | Self::Asterisk)
    }

    /// The geometry of the marker. Areas are made about equally large to the eye.
    pub fn outline(self) -> MarkerOutline {
        match self {
            Self::Circle => MarkerOutline::Disk(1.0),
            Self::Dot => MarkerOutline::Disk(0.5),
            Self::Square => MarkerOutline::Area(regular(4, 45.0, 1.25)),
            Self::Diamond => MarkerOutline::Area(regular(4, 0.0, 1.25)),
            Self::Hexagon => MarkerOutline::Area(regular(6, 0.0, 1.12)),
            Self::TriangleUp => MarkerOutline::Area(triangle(-90.0)),
            Self::TriangleDown => MarkerOutline::Area(triangle(90.0)),
            Self::TriangleRight => MarkerOutline::Area(triangle(0.0)),
            Self::TriangleLeft => MarkerOutline::Area(triangle(180.0)),
            Self::Plus => MarkerOutline::Strokes(star(2, 0.0, 1.1)),
            Self::Cross => MarkerOutline::Strokes(star(2, 45.0, 1.1)),
            Self::Asterisk => MarkerOutline::Strokes(star(3, 90.0, 1.1)),
        }
    }
}

/// A point at the given angle from the x axis, clockwise as y runs downward.
fn polar(degrees: f64, radius: f64) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [radius * cos, radius * sin]
}

fn regular(corners: u32, first: f64, radius: f64) -> Vec<[f64; 2]> {
    let step = 360.0 / f64::from(corners);
    (0..corners).map(|i| polar(first + step * f64::from(i), radius)).collect()
}

/// A triangle whose center of mass lies a little behind the marker's, so that it looks centered.
fn triangle(direction: f64) -> Vec<[f64; 2]> {
    let shift = polar(direction, -0.08);
    regular(3, direction, 1.35).into_iter().map(|p| [p[0] + shift[0], p[1] + shift[1]]).collect()
}

fn star(lines: u32, first: f64, radius: f64) -> Vec<[[f64; 2]; 2]> {
    let step = 180.0 / f64::from(lines);
    (0..lines)
        .map(|i| {
            let end = polar(first + step * f64::from(i), radius);
            [[-end[0], -end[1]], end]
        })
        .collect()
}

/// The stretches of a line between points that are not finite.
pub fn finite_runs(points: &[[f64; 2]]) -> impl Iterator<Item = &[[f64; 2]]> {
    points.split(|p| !p.iter().all(|v| v.is_finite())).filter(|run| !run.is_empty())
}

/// The stretches of a line between points that are not finite, cut where the color changes. Each takes the color of its start.
pub fn color_runs(points: &[([f64; 2], Rgb)]) -> Vec<&[([f64; 2], Rgb)]> {
    let mut runs = Vec::new();
    for run in points.split(|p| !p.0.iter().all(|v| v.is_finite())) {
        let mut start = 0;
        while start + 1 < run.len() {
            let same = run[start + 1..].iter().take_while(|p| p.1 == run[start].1).count();
            let end = start + same.max(1);
            runs.push(&run[start..=end]);
            start = end;
        }
    }
    runs
}
