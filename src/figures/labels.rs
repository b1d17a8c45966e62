//! Small texts among curves: each where there is room, none over another or over a curve.

use chromascope_figure::{
    Anchor, Ink, Mark, Panel, Projection, Rect, Shape, TextSize, annotations, finite_runs, text_width,
};

/// Height of a line of small text, in points.
const HEIGHT: f64 = 13.0;
/// Space left and right of a text, in points.
const MARGIN: f64 = 2.0;
/// Distance of the points that stand for a curve, in points.
const STEP: f64 = 4.0;

/// A position of a text: its place in the panel's units, the point of the text that lies there, and a shift in points.
pub(super) type Place = ([f64; 2], Anchor, [f64; 2]);

/// The parts of a panel that are taken.
pub(super) struct Room {
    projection: Projection,
    texts: Vec<Rect>,
    curves: Vec<[f64; 2]>,
}

impl Room {
    /// The room of a panel of its final ranges, without its axis titles and its note.
    pub(super) fn of(panel: &Panel) -> Self {
        let projection = Projection::new(panel, 1.0);
        let texts = annotations(panel, projection.plot, 1.0);
        let texts = texts.iter().map(|note| extent(&note.text, note.at, note.anchor)).collect();
        Self { projection, texts, curves: Vec::new() }
    }

    /// Takes the room of lines and markers.
    pub(super) fn take(&mut self, marks: &[Mark]) {
        for mark in marks {
            match &mark.shape {
                Shape::Line { points, .. } => {
                    for run in finite_runs(points) {
                        let placed: Vec<[f64; 2]> = run.iter().map(|point| self.projection.at(*point)).collect();
                        self.curves.extend(placed.windows(2).flat_map(|ends| between(ends[0], ends[1])));
                    }
                }
                Shape::Points { points, radius, .. } => {
                    for [x, y] in finite_runs(points).flatten().map(|point| self.projection.at(*point)) {
                        let (min, max) = ([x - radius, y - radius], [x + radius, y + radius]);
                        self.texts.push(Rect { min, max });
                    }
                }
                _ => {}
            }
        }
    }

    /// Takes the room of a line that no text may cross.
    pub(super) fn keep_clear_of(&mut self, mark: &Mark) {
        let first = self.curves.len();
        self.take(std::slice::from_ref(mark));
        let dots = self.curves.split_off(first);
        self.texts.extend(dots.into_iter().map(|at| Rect { min: at, max: at.map(|v| v + 0.1) }));
    }

    /// The text at the first position that is free; none if none is. Free of curves too unless it `crosses` them.
    pub(super) fn place(&mut self, text: &str, ink: Ink, crosses: bool, places: &[Place]) -> Option<Mark> {
        let plot = self.projection.plot;
        let (area, (at, anchor, offset)) = places.iter().find_map(|place| {
            let [x, y] = self.projection.at(place.0);
            let area = extent(text, [x + place.2[0], y + place.2[1]], place.1);
            let inside =
                [0, 1].iter().all(|&axis| area.min[axis] >= plot.min[axis] && area.max[axis] <= plot.max[axis]);
            let apart = !self.texts.iter().any(|other| overlap(&area, other));
            let clear = crosses || !self.curves.iter().any(|point| contains(&area, *point));
            (inside && apart && clear).then_some((area, *place))
        })?;
        self.texts.push(area);
        Some(Mark::text(text, at, anchor, TextSize::Small, ink).with_offset(offset))
    }

    /// Height of the plot in points.
    pub(super) fn height(&self) -> f64 {
        self.projection.plot.height()
    }
}

fn extent(text: &str, [x, y]: [f64; 2], anchor: Anchor) -> Rect {
    let width = text_width(text, TextSize::Small);
    let left = x - anchor.0 * width - MARGIN;
    Rect::from_min_size([left, y - anchor.1 * HEIGHT], [width + 2.0 * MARGIN, HEIGHT])
}

fn overlap(a: &Rect, b: &Rect) -> bool {
    [0, 1].iter().all(|&axis| a.min[axis] < b.max[axis] && b.min[axis] < a.max[axis])
}

fn contains(area: &Rect, point: [f64; 2]) -> bool {
    [0, 1].iter().all(|&axis| area.min[axis] - 1.0 < point[axis] && point[axis] < area.max[axis] + 1.0)
}

/// Points along a straight line.
fn between(a: [f64; 2], b: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    let count = (length / STEP).ceil().clamp(1.0, 500.0);
    (0..=count as usize).map(move |i| [0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * i as f64 / count))
}
