//! Texts of a plot, each where it covers nothing.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use super::clip;
use super::ink::{Ink, InkRole};
use super::mark::{Anchor, Mark, MarkerOutline, Shape, Tag, TextSize, finite_runs};
use super::panel::{Panel, annotations};
use super::projection::Projection;
use super::rect::Rect;
use super::text::text_area;

/// Space left and right of a text and at the ends of its leader, in points: its halo erases nothing.
const AIR: f64 = 2.0;
/// Side of the squares by which marks are found, in points.
const SQUARE: f64 = 24.0;
/// Lengths of leaders in points: the first, the step, the last.
const LEADER: [f64; 3] = [24.0, 6.0, 240.0];
/// Number of directions that a leader may take.
const DIRECTIONS: u32 = 72;
/// Distance of a leader from the point where it starts, in points: outside of its marker.
const START: f64 = 6.0;
/// Points by which a leader may be longer if that saves crossing a marker or bar, or a line.
const CROSSED: [f64; 2] = [100.0, 20.0];
/// Radius up to which a marker is a dot along a line.
const DOT: f64 = 3.0;
/// Opacity below which an area is a ground, on which texts may stand.
const GROUND: f32 = 0.2;

/// A position of a text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// The point that it belongs to, in data units.
    pub at: [f64; 2],
    /// Point of the text that lies there.
    pub anchor: Anchor,
    /// Shift in points, y downward.
    pub offset: [f64; 2],
}

impl Place {
    /// The position beside a point, so many points away in a direction (y downward).
    pub fn beside(at: [f64; 2], [x, y]: [f64; 2], distance: f64) -> Self {
        Self { at, anchor: Anchor(0.5 - 0.5 * x, 0.5 - 0.5 * y), offset: [distance * x, distance * y] }
    }

    /// Positions all around a point, that in the direction of `first` first.
    pub fn around(at: [f64; 2], first: [f64; 2], distance: f64) -> Vec<Self> {
        const D: f64 = FRAC_1_SQRT_2;
        let mut directions = [[D, -D], [-D, -D], [D, D], [-D, D], [1.0, 0.0], [-1.0, 0.0], [0.0, -1.0], [0.0, 1.0]];
        let along = |d: &[f64; 2]| d[0] * first[0] + d[1] * first[1];
        directions.sort_by(|a, b| along(b).total_cmp(&along(a)));
        let place = |[x, y]: [f64; 2]| {
            // A diagonal's text begins at the corner nearest to the point.
            let side = |v: f64| 0.5 - if v.abs() < 0.1 { 0.0 } else { 0.5 * v.signum() };
            Self { at, anchor: Anchor(side(x), side(y)), offset: [distance * x, distance * y] }
        };
        directions.map(place).to_vec()
    }
}

/// A text with the positions it may take.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// Item that it stands for.
    pub tag: Tag,
    /// The text.
    pub text: String,
    /// Its size.
    pub size: TextSize,
    /// Its color.
    pub ink: Ink,
    /// Positions, the best one first.
    pub places: Vec<Place>,
    /// Points in data units from which a leader may start; empty for a text that is left out where no position is free.
    pub starts: Vec<[f64; 2]>,
    /// Shorter texts that say the same, tried in turn.
    pub shorter: Vec<String>,
    /// Space kept from markers and texts in points, beside which it would seem to be theirs.
    pub clearance: f64,
    /// True if a leader tells better than a position beside its point what it names.
    pub prefers_leader: bool,
    /// True if it takes its first position rather than being left out.
    pub always: bool,
}

impl Label {
    /// Small text without a leader.
    pub fn new(text: impl Into<String>, ink: impl Into<Ink>, places: Vec<Place>) -> Self {
        Self {
            tag: Tag::default(),
            text: text.into(),
            size: TextSize::Small,
            ink: ink.into(),
            places,
            starts: Vec::new(),
            shorter: Vec::new(),
            clearance: 0.0,
            prefers_leader: false,
            always: false,
        }
    }
}

/// What a text may not cover.
#[derive(Debug, Clone, Copy)]
enum Obstacle {
    /// A piece of a line with half its width.
    Line([[f64; 2]; 2], f64),
    Bar(Rect),
    Marker(Rect),
}

/// Place, rectangle and leader of a text.
type Found = (Place, Rect, Option<[[f64; 2]; 2]>);

/// The texts of a plot among its marks, placed in the order of the calls.
///
/// Each takes the first of its positions that is free of marks, texts, leaders and the plot's edge, with room for its halo;
/// else it stands at the end of a leader, a gray hairline, the shortest that crosses no text, no leader and few marks; else
/// its shorter texts are tried in the same way; else it is left out. Grid lines, pictures and pale areas are grounds, on
/// which texts may stand.
#[derive(Debug, Clone)]
pub struct Labels {
    projection: Projection,
    halo: Ink,
    columns: usize,
    squares: Vec<Vec<Obstacle>>,
    texts: Vec<Rect>,
    leaders: Vec<[[f64; 2]; 2]>,
    /// Leaders, then texts.
    placed: [Vec<Mark>; 2],
}

impl Labels {
    /// The room of a panel of its final ranges and size, around its marks, the titles of its axes and its note.
    pub fn new(panel: &Panel) -> Self {
        let projection = Projection::new(panel, 1.0);
        let [columns, rows] =
            [projection.plot.width(), projection.plot.height()].map(|side| (side / SQUARE) as usize + 1);
        let notes = annotations(panel, projection.plot, 1.0);
        let texts = notes.iter().map(|note| text_area(&note.text, TextSize::Small, note.at, note.anchor)).collect();
        let squares = vec![Vec::new(); columns * rows];
        let mut labels = Self {
            projection,
            halo: panel.background,
            columns,
            squares,
            texts,
            leaders: Vec::new(),
            placed: Default::default(),
        };
        for mark in &panel.marks {
            if let Shape::Text { at, text, anchor, offset, size, .. } = &mark.shape {
                let [x, y] = labels.projection.at(*at);
                labels.texts.push(text_area(text, *size, [x + offset[0], y + offset[1]], *anchor));
            }
            for obstacle in obstacles(mark, &labels.projection) {
                for square in labels.touched(&obstacle.extent()) {
                    labels.squares[square].push(obstacle);
                }
            }
        }
        labels
    }

    /// Places a text; false where it is left out.
    pub fn place(&mut self, label: &Label) -> bool {
        let texts = || std::iter::once(&label.text).chain(&label.shorter);
        let found = texts().find_map(|text| Some((text, self.find(label, text)?))).or_else(|| {
            let place = *label.places.first().filter(|_| label.always)?;
            Some((&label.text, (place, self.area(label, &label.text, &place), None)))
        });
        let Some((text, (mut place, area, leader))) = found else { return false };
        self.texts.push(area);
        if let Some(ends) = leader {
            self.leaders.push(ends);
            let shape = Shape::Segments { segments: vec![ends.map(|end| self.projection.value(end))] };
            let line = Mark::new(label.tag, format!("{text}, leader"), shape);
            self.placed[0].push(line.with_stroke(InkRole::Weak, 0.8));
            // The text stays at its leader, also where the axes are moved.
            let [x, y] = self.projection.at(place.at);
            place.at = self.projection.value([x + place.offset[0], y + place.offset[1]]);
            place.offset = [0.0; 2];
        }
        let mark = Mark::text(text, place.at, place.anchor, label.size, label.ink).with_offset(place.offset);
        self.placed[1].push(Mark { tag: label.tag, ..mark.with_halo(self.halo) });
        true
    }

    /// Leaders and texts placed so far, in this order.
    pub fn into_marks(self) -> Vec<Mark> {
        self.placed.into_iter().flatten().collect()
    }

    /// The lowest of the leftmost free rectangles of a size in points: its upper left corner.
    pub fn corner(&self, size: [f64; 2]) -> Option<[f64; 2]> {
        const STEP: f64 = 4.0;
        let plot = self.projection.plot;
        let [across, up] = [plot.width() - size[0], plot.height() - size[1]].map(|room| (room / STEP).floor() as i32);
        let mut corners = (1..up).flat_map(|row| {
            let y = plot.max[1] - size[1] - STEP * f64::from(row);
            (1..across).map(move |column| [plot.min[0] + STEP * f64::from(column), y])
        });
        corners.find(|corner| self.is_free(&Rect::from_min_size(*corner, size), 0.0))
    }

    /// The map from data units to points.
    pub fn projection(&self) -> &Projection {
        &self.projection
    }

    /// True if a rectangle of the plot covers nothing.
    pub(super) fn is_free(&self, area: &Rect, clearance: f64) -> bool {
        let wide = area.enlarged(clearance);
        let meets = |obstacle: &Obstacle| match obstacle {
            Obstacle::Line(ends, half) => clip::segment(area.enlarged(*half), *ends).is_some(),
            Obstacle::Bar(other) => area.overlaps(other),
            Obstacle::Marker(other) => wide.overlaps(other),
        };
        self.projection.plot.holds(area)
            && !self.texts.iter().any(|other| wide.overlaps(other))
            && !self.leaders.iter().any(|ends| clip::segment(*area, *ends).is_some())
            && !self.touched(&wide).any(|square| self.squares[square].iter().any(meets))
    }

    fn find(&self, label: &Label, text: &str) -> Option<Found> {
        let beside = || {
            let places = label.places.iter().map(|place| (*place, self.area(label, text, place), None));
            places.into_iter().find(|(_, area, _)| self.is_free(area, label.clearance))
        };
        if label.prefers_leader {
            return self.led(label, text).or_else(beside);
        }
        beside().or_else(|| self.led(label, text))
    }

    /// The rectangle of a text at a position, with the space beside it.
    fn area(&self, label: &Label, text: &str, place: &Place) -> Rect {
        let [x, y] = self.projection.at(place.at);
        let Rect { min, max } = text_area(text, label.size, [x + place.offset[0], y + place.offset[1]], place.anchor);
        Rect { min: [min[0] - AIR, min[1]], max: [max[0] + AIR, max[1]] }
    }

    /// The position at the end of the shortest leader; one that crosses marks counts as longer.
    fn led(&self, label: &Label, text: &str) -> Option<Found> {
        let mut best: Option<(f64, Found)> = None;
        let [mut length, step, last] = LEADER;
        while length <= last && best.as_ref().is_none_or(|(cost, _)| length < *cost) {
            for (start, index) in label.starts.iter().flat_map(|start| (0..DIRECTIONS).map(move |index| (start, index)))
            {
                let (y, x) = (TAU * f64::from(index) / f64::from(DIRECTIONS)).sin_cos();
                // The point of the text's edge that faces the start.
                let most = x.abs().max(y.abs());
                let anchor = Anchor(0.5 - 0.5 * x / most, 0.5 - 0.5 * y / most);
                let place = Place { at: *start, anchor, offset: [length * x, length * y] };
                let area = self.area(label, text, &place);
                let from = self.projection.at(*start);
                let ends = [START, length - AIR].map(|reach| [from[0] + reach * x, from[1] + reach * y]);
                if self.is_free(&area, label.clearance)
                    && let Some(crossed) = self.crossed(from, ends)
                    && best.as_ref().is_none_or(|(cost, _)| length + crossed < *cost)
                {
                    best = Some((length + crossed, (place, area, Some(ends))));
                }
            }
            length += step;
        }
        best.map(|(_, found)| found)
    }

    /// Length that the marks add which a leader from a point crosses; none if it crosses a text or another leader.
    fn crossed(&self, from: [f64; 2], ends: [[f64; 2]; 2]) -> Option<f64> {
        let is_barred = self.leaders.iter().any(|other| intersect(ends, *other))
            || self.texts.iter().any(|text| clip::segment(*text, ends).is_some());
        let extent = Obstacle::Line(ends, 0.0).extent();
        let cost = |obstacle: &Obstacle| match obstacle {
            Obstacle::Line(other, _) if intersect(ends, *other) => CROSSED[1],
            Obstacle::Bar(area) | Obstacle::Marker(area) if !area.contains(from) => {
                clip::segment(*area, ends).map_or(0.0, |_| CROSSED[0])
            }
            _ => 0.0,
        };
        (!is_barred).then(|| self.touched(&extent).flat_map(|square| &self.squares[square]).map(cost).sum())
    }

    /// Indices of the squares that a rectangle touches.
    fn touched(&self, area: &Rect) -> impl Iterator<Item = usize> + use<> {
        let (columns, rows, plot) = (self.columns, self.squares.len() / self.columns, self.projection.plot);
        let span = |axis: usize, count: usize| {
            let index = |v: f64| ((v - plot.min[axis]) / SQUARE).clamp(0.0, (count - 1) as f64) as usize;
            index(area.min[axis])..=index(area.max[axis])
        };
        let across = span(0, columns);
        span(1, rows).flat_map(move |row| across.clone().map(move |column| row * columns + column))
    }
}

impl Obstacle {
    /// The rectangle around it.
    fn extent(&self) -> Rect {
        match self {
            Self::Line(ends, half) => Rect::around(*ends).enlarged(*half),
            Self::Bar(area) | Self::Marker(area) => *area,
        }
    }
}

/// What a mark draws, in points.
fn obstacles(mark: &Mark, projection: &Projection) -> Vec<Obstacle> {
    let half = 0.5 * mark.stroke.map_or(0.0, |stroke| stroke.width);
    let lines = |points: &[[f64; 2]]| -> Vec<Obstacle> {
        let placed: Vec<[f64; 2]> = points.iter().map(|point| projection.at(*point)).collect();
        let pieces = placed.windows(2).flat_map(|ends| pieces([ends[0], ends[1]], projection.plot));
        pieces.map(|ends| Obstacle::Line(ends, half)).collect()
    };
    match &mark.shape {
        _ if mark.stroke.is_some_and(|stroke| stroke.ink.role == InkRole::Grid) => Vec::new(),
        Shape::Line { points, closed: true } | Shape::Polygon { points } => {
            lines(&[&points[..], &points[..points.len().min(1)]].concat())
        }
        Shape::Line { points, .. } => lines(points),
        Shape::Gradient { points } => lines(&points.iter().map(|(point, _)| *point).collect::<Vec<_>>()),
        Shape::Segments { segments } => segments.iter().flat_map(|ends| lines(ends)).collect(),
        Shape::Rect { min, max } if mark.fill.is_some_and(|ink| ink.alpha >= GROUND) => {
            vec![Obstacle::Bar(Rect::around([*min, *max].map(|corner| projection.at(corner))).enlarged(half))]
        }
        Shape::Rect { min, max } if mark.stroke.is_some() => {
            lines(&[*min, [max[0], min[1]], *max, [min[0], max[1]], *min])
        }
        Shape::Points { points, marker, radius } => {
            let outline = match marker.outline() {
                MarkerOutline::Disk(size) => vec![[-size; 2], [size; 2]],
                MarkerOutline::Area(corners) => corners,
                MarkerOutline::Strokes(lines) => lines.concat(),
            };
            let shape = Rect::around(outline.into_iter().map(|corner| corner.map(|v| v * radius))).enlarged(half);
            let kind = if *radius > DOT { Obstacle::Marker } else { Obstacle::Bar };
            let places = finite_runs(points).flatten().map(|point| projection.at(*point));
            places.map(|at| kind(shape.moved(at))).collect()
        }
        _ => Vec::new(),
    }
}

/// The part of a straight line near a plot in pieces no longer than a square.
fn pieces(ends: [[f64; 2]; 2], plot: Rect) -> impl Iterator<Item = [[f64; 2]; 2]> {
    let is_finite = ends.as_flattened().iter().all(|v| v.is_finite());
    let near = if is_finite { clip::segment(plot.enlarged(SQUARE), ends) } else { None };
    near.into_iter().flat_map(|[a, b]| {
        let count = ((b[0] - a[0]).hypot(b[1] - a[1]) / SQUARE).ceil().max(1.0);
        let at = move |i: usize| [0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * i as f64 / count);
        (0..count as usize).map(move |i| [at(i), at(i + 1)])
    })
}

/// True if two straight lines cross.
fn intersect([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let side = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}
