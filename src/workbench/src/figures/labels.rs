//! Small texts among curves: each where there is room, none over another or over a curve.

use chromascope_figure::{
    Anchor, Ink, InkRole, Mark, Panel, Projection, Rect, Shape, Tag, TextSize, annotations, finite_runs, text_width,
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
    markers: Vec<Rect>,
    curves: Vec<[f64; 2]>,
}

impl Room {
    /// The room of a panel of its final ranges, without its axis titles and its note.
    pub(super) fn of(panel: &Panel) -> Self {
        let projection = Projection::new(panel, 1.0);
        let texts = annotations(panel, projection.plot, 1.0);
        let texts = texts.iter().map(|note| extent(&note.text, note.at, note.anchor)).collect();
        Self { projection, texts, markers: Vec::new(), curves: Vec::new() }
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
                        self.markers.push(Rect { min, max });
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
        self.texts.extend(dots.into_iter().map(dot));
    }

    /// The text at the first position that is free; none if none is. Free of curves too unless it `crosses` them.
    pub(super) fn place(&mut self, text: &str, ink: Ink, crosses: bool, places: &[Place]) -> Option<Mark> {
        let (area, (at, anchor, offset)) =
            places.iter().find_map(|place| Some((self.free(text, crosses, place)?, *place)))?;
        self.texts.push(area);
        Some(Mark::text(text, at, anchor, TextSize::Small, ink).with_offset(offset))
    }

    /// The text at the first position that is free, with a line from its point to it where they lie apart.
    pub(super) fn lead(&mut self, text: &str, ink: Ink, places: &[Place]) -> Vec<Mark> {
        const APART: f64 = 12.0;
        let leader = |room: &Self, (at, anchor, [x, y]): &Place| {
            let text = [x - (anchor.0 - 0.5) * MARGIN, y - (anchor.1 - 0.5) * 0.5 * HEIGHT];
            let Projection { plot, x, y, .. } = &room.projection;
            let units = [(x[1] - x[0]) / plot.width(), -(y[1] - y[0]) / plot.height()];
            let share = 4.0 / text[0].hypot(text[1]);
            [share, 1.0].map(|share| [0, 1].map(|axis| at[axis] + share * text[axis] * units[axis]))
        };
        let is_apart = |(_, _, [x, y]): &Place| x.hypot(*y) > APART;
        let found = places.iter().find_map(|place| {
            let area = self.free(text, false, place)?;
            let ends = leader(self, place);
            let [from, to] = ends.map(|end| self.projection.at(end));
            let mut dots = between(from, to).skip(1);
            let crosses = is_apart(place) && dots.any(|dot| self.texts.iter().any(|text| contains(text, dot)));
            (!crosses).then_some((area, ends, *place))
        });
        let Some((area, ends, place)) = found else { return Vec::new() };
        let line = Mark::new(Tag::default(), format!("{text}, leader"), Shape::Segments { segments: vec![ends] });
        if is_apart(&place) {
            self.texts.extend(between(self.projection.at(ends[0]), self.projection.at(ends[1])).map(dot));
        }
        self.texts.push(area);
        let words = Mark::text(text, place.0, place.1, TextSize::Small, ink).with_offset(place.2);
        let line = is_apart(&place).then(|| line.with_stroke(ink, 1.0));
        line.into_iter().chain([words]).collect()
    }

    /// The rectangle of a text at a position, where it is free.
    fn free(&self, text: &str, crosses: bool, place: &Place) -> Option<Rect> {
        let plot = self.projection.plot;
        let [x, y] = self.projection.at(place.0);
        let area = extent(text, [x + place.2[0], y + place.2[1]], place.1);
        let inside = [0, 1].iter().all(|&axis| area.min[axis] >= plot.min[axis] && area.max[axis] <= plot.max[axis]);
        let apart = !self.texts.iter().chain(&self.markers).any(|other| overlap(&area, other));
        let clear = crosses || !self.curves.iter().any(|point| contains(&area, *point));
        (inside && apart && clear).then_some(area)
    }

    /// Height of the plot in points.
    pub(super) fn height(&self) -> f64 {
        self.projection.plot.height()
    }
}

/// A text that names a curve.
#[derive(Clone)]
pub(super) struct Name {
    pub(super) text: String,
    pub(super) ink: Ink,
    /// Points of the curve beside which it may stand, the best first.
    pub(super) points: Vec<[f64; 2]>,
}

impl Name {
    /// The text beside the first point with room, else above one and to its side.
    pub(super) fn mark(&self, room: &mut Room) -> Option<Mark> {
        let sides = [
            (Anchor::BOTTOM, [0.0, -3.0]),
            (Anchor::TOP, [0.0, 6.0]),
            (Anchor::RIGHT_BOTTOM, [-4.0, -2.0]),
            (Anchor::LEFT_BOTTOM, [4.0, -2.0]),
            (Anchor::LEFT_BOTTOM, [9.0, -2.0]),
        ];
        let above = [8.0, -8.0, 16.0, -16.0, 24.0, -24.0, 32.0, -32.0].map(|x| (Anchor::BOTTOM, [x, -3.0]));
        let at = |sides: &[(Anchor, [f64; 2])]| -> Vec<Place> {
            self.points.iter().flat_map(|at| sides.iter().map(|(anchor, offset)| (*at, *anchor, *offset))).collect()
        };
        let mark = room.place(&self.text, self.ink, false, &[at(&sides), at(&above)].concat())?;
        Some(mark.with_halo(InkRole::Plot))
    }
}

/// Symbol of a channel: the letter of a color, or the color-matching function's own.
pub(super) fn channel_symbol(channel: &str) -> String {
    match channel {
        "red" | "green" | "blue" => channel[..1].to_uppercase(),
        symbol => symbol.to_owned(),
    }
}

/// The rectangle of a point that no text may cover.
fn dot(at: [f64; 2]) -> Rect {
    Rect { min: at, max: at.map(|v| v + 0.1) }
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
