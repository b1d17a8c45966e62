//! Names beside points: none over another, a point, a label of the plot or, if it can be helped, the line; further off and with a
//! leader where points crowd, and where even that has no room a number, with the names in a list.

use std::f64::consts::TAU;

use chromascope_figure::{
    Anchor, Annotation, InkRole, Mark, Panel, Projection, Shape, TextSize, annotations, text_width,
};

use super::Place;

/// Half the height of a name, and half the side of a marker with some air, in points.
const HALF: f64 = 7.0;
const MARKER: f64 = 6.0;
/// Distances of a name in points, and number of directions.
const RINGS: [f64; 6] = [20.0, 32.0, 46.0, 64.0, 86.0, 112.0];
const DIRECTIONS: u32 = 32;
/// Cost of crossing the line, in points of distance.
const CROSSING: f64 = 40.0;
/// The height of a line of the list, and how far apart places are where it is tried.
const LINE: f64 = 13.0;
const STEP: f64 = 4.0;
/// Maximum number of columns.
const COLUMNS: usize = 3;

/// Left, top, right, bottom in points.
type Area = [f64; 4];
type Line = [[f64; 2]; 2];

struct Choice {
    anchor: Anchor,
    /// The anchored point of the text, in points from the marker.
    offset: [f64; 2],
    /// End of the leader at the text; none where the name stands beside its point.
    leader: Option<[f64; 2]>,
    cost: f64,
}

struct Taken {
    markers: Vec<Area>,
    texts: Vec<Area>,
    leaders: Vec<Line>,
    front: Vec<Line>,
    plot: Area,
}

/// Labels of points, in this order; one without room is omitted, and shown under the pointer. Each name is written once.
/// `front` is the Pareto line.
pub(super) fn names(panel: &Panel, places: &[&Place], front: &[[f64; 2]]) -> Vec<Mark> {
    let projection = Projection::new(panel, 1.0);
    let line: Vec<[f64; 2]> = front.iter().map(|point| projection.at(*point)).collect();
    let mut drawn =
        Drawn { panel, taken: Taken::new(panel, &projection, places, &line), projection, marks: Vec::new() };
    let mut named: Vec<&str> = Vec::new();
    let mut crowded: Vec<&Place> = Vec::new();
    for place in places {
        if !named.contains(&place.name.as_str()) {
            named.push(&place.name);
            if !drawn.name(place, &place.name) {
                crowded.push(place);
            }
        }
    }
    // Numbers first: each line of the list is of a point that has one.
    let (mut listed, before) = (Vec::new(), drawn.marks.len());
    for place in crowded {
        let number = (listed.len() + 1).to_string();
        if drawn.name(place, &number) {
            listed.push((place, format!("{number}: {}", place.name)));
        }
    }
    if !(1..=COLUMNS).any(|columns| drawn.list(&listed, columns)) {
        drawn.marks.truncate(before);
    }
    // Leaders below all names.
    drawn.marks.sort_by_key(|mark| matches!(mark.shape, Shape::Text { .. }));
    drawn.marks
}

/// Marks drawn so far.
struct Drawn<'a> {
    panel: &'a Panel,
    projection: Projection,
    taken: Taken,
    marks: Vec<Mark>,
}

impl Drawn<'_> {
    /// Writes a text beside a point if there is room.
    fn name(&mut self, place: &Place, text: &str) -> bool {
        let point = self.projection.at(place.logarithms());
        let width = text_width(text, TextSize::Small);
        let Some(choice) = self.taken.cheapest(point, width) else { return false };
        self.taken.texts.push(choice.area(point, width));
        let (mut at, mut offset) = (place.logarithms(), choice.offset);
        if let Some([start, end]) = choice.leader_from(point) {
            self.taken.leaders.push([start, end]);
            let segments = Shape::Segments { segments: vec![[self.data(start), self.data(end)]] };
            self.marks.push(Mark::new(place.tag, place.name.clone(), segments).with_stroke(InkRole::Weak, 0.8));
            // With its leader, also when the axes are moved.
            (at, offset) = (self.data([point[0] + offset[0], point[1] + offset[1]]), [0.0; 2]);
        }
        self.text(place, text, at, choice.anchor, offset);
        true
    }

    /// Writes lines of text in columns where nothing else is, the lower left corner first. Whether there was room.
    fn list(&mut self, lines: &[(&Place, String)], columns: usize) -> bool {
        let widest = lines.iter().map(|(_, line)| text_width(line, TextSize::Small)).fold(0.0, f64::max);
        let (down, across) = (lines.len().div_ceil(columns), widest + 2.0 * STEP);
        let (width, height) = (across * columns as f64, LINE * down as f64);
        let [left, top, right, bottom] = self.taken.plot;
        let [along, up] = [right - left - width, bottom - top - height].map(|room| (room / STEP).floor() as i32);
        let mut corners = (1..up).flat_map(|up| {
            let y = bottom - height - STEP * f64::from(up);
            (1..along).map(move |along| [left + STEP * f64::from(along), y])
        });
        let area = |[x, y]: [f64; 2]| [x - 1.0, y - 1.0, x + width + 1.0, y + height + 1.0];
        let Some([x, y]) = corners.find(|corner| self.taken.is_free(&area(*corner))) else { return false };
        for (index, (place, line)) in lines.iter().enumerate() {
            let at = [x + across * (index / down) as f64, y + LINE * (index % down) as f64];
            self.text(place, line, self.data(at), Anchor::LEFT_TOP, [0.0; 2]);
        }
        true
    }

    fn text(&mut self, place: &Place, text: &str, at: [f64; 2], anchor: Anchor, offset: [f64; 2]) {
        let text = Mark::text(text, at, anchor, TextSize::Small, InkRole::Text).with_offset(offset);
        let text = text.with_halo(self.panel.background);
        self.marks.push(Mark { tag: place.tag, name: place.name.clone(), ..text });
    }

    /// The data at a point of the figure.
    fn data(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let Projection { plot, x: [left, right], y: [bottom, top], .. } = &self.projection;
        let u = (x - plot.min[0]) / plot.width();
        let v = (plot.max[1] - y) / plot.height();
        [left + u * (right - left), bottom + v * (top - bottom)]
    }
}

/// All places for a name, from the cheapest, where one looks first.
fn choices() -> impl Iterator<Item = Choice> {
    // Above to the right first: the line falls to the right, and passes below.
    let beside = [
        (Anchor::LEFT, [7.0, -9.0]),
        (Anchor::RIGHT, [-9.0, 0.0]),
        (Anchor::RIGHT, [-7.0, 10.0]),
        (Anchor::LEFT, [9.0, 0.0]),
        (Anchor::LEFT, [7.0, 11.0]),
        (Anchor::RIGHT, [-7.0, -9.0]),
        (Anchor::CENTER, [0.0, -14.0]),
        (Anchor::CENTER, [0.0, 15.0]),
    ];
    let beside = beside.into_iter().enumerate().map(|(order, (anchor, offset))| Choice {
        anchor,
        offset,
        leader: None,
        cost: 0.5 * order as f64,
    });
    let off = RINGS.into_iter().flat_map(move |radius| {
        (0..DIRECTIONS).map(move |direction| {
            let (sin, cos) = (TAU * f64::from(direction) / f64::from(DIRECTIONS)).sin_cos();
            let end = [radius * cos, radius * sin];
            // The leader ends at the nearer end of the text, or in the middle where it comes from above or below.
            let anchor = match cos {
                c if c > 0.3 => Anchor::LEFT,
                c if c < -0.3 => Anchor::RIGHT,
                _ if sin < 0.0 => Anchor::BOTTOM,
                _ => Anchor::TOP,
            };
            let gap = if anchor.1 == 0.5 { [3.0 * cos.signum(), 0.0] } else { [0.0; 2] };
            let offset = [end[0] + gap[0], end[1] + gap[1]];
            Choice { anchor, offset, leader: Some(end), cost: 12.0 + radius }
        })
    });
    beside.chain(off)
}

impl Choice {
    fn area(&self, [x, y]: [f64; 2], width: f64) -> Area {
        let left = x + self.offset[0] - self.anchor.0 * width;
        let top = y + self.offset[1] - self.anchor.1 * 2.0 * HALF;
        [left, top, left + width, top + 2.0 * HALF]
    }

    fn leader_from(&self, [x, y]: [f64; 2]) -> Option<Line> {
        let [dx, dy] = self.leader?;
        let start = MARKER / dx.hypot(dy);
        Some([[x + start * dx, y + start * dy], [x + dx, y + dy]])
    }
}

impl Taken {
    /// Markers, the line, and the labels of the plot.
    fn new(panel: &Panel, projection: &Projection, places: &[&Place], line: &[[f64; 2]]) -> Self {
        let around = |place: &&Place| {
            let [x, y] = projection.at(place.logarithms());
            [x - MARKER, y - MARKER, x + MARKER, y + MARKER]
        };
        let note = |note: Annotation| {
            let width = text_width(&note.text, TextSize::Small);
            let [left, top] = [note.at[0] - note.anchor.0 * width, note.at[1] - note.anchor.1 * 2.0 * HALF];
            [left - 2.0, top - 1.0, left + width + 2.0, top + 2.0 * HALF + 1.0]
        };
        let plot = projection.plot;
        Self {
            markers: places.iter().map(around).collect(),
            texts: annotations(panel, plot, 1.0).into_iter().map(note).collect(),
            leaders: Vec::new(),
            front: line.windows(2).map(|ends| [ends[0], ends[1]]).collect(),
            plot: [plot.min[0] + 2.0, plot.min[1] + 2.0, plot.max[0] - 2.0, plot.max[1] - 2.0],
        }
    }

    /// The cheapest choice that can be.
    fn cheapest(&self, point: [f64; 2], width: f64) -> Option<Choice> {
        let mut best: Option<(f64, Choice)> = None;
        for choice in choices() {
            let least = best.as_ref().map_or(f64::INFINITY, |(cost, _)| *cost);
            // All that follow cost as much by themselves.
            if choice.cost >= least {
                break;
            }
            if let Some(cost) = self.cost(&choice, point, width).filter(|cost| *cost < least) {
                best = Some((cost, choice));
            }
        }
        best.map(|(_, choice)| choice)
    }

    /// Cost of a choice; none where it is impossible.
    fn cost(&self, choice: &Choice, point: [f64; 2], width: f64) -> Option<f64> {
        let area = choice.area(point, width);
        let plot = &self.plot;
        let inside = area[0] >= plot[0] && area[1] >= plot[1] && area[2] <= plot[2] && area[3] <= plot[3];
        let leader = choice.leader_from(point);
        // Its own marker, and those on the same spot, are where the leader begins.
        let begins =
            |other: &Area| other[0] <= point[0] && point[0] <= other[2] && other[1] <= point[1] && point[1] <= other[3];
        let blocked =
            self.markers.iter().chain(&self.texts).any(|other| {
                overlap(&area, other) || leader.is_some_and(|leader| !begins(other) && passes(leader, other))
            });
        let crosses = |other: &Line| leader.is_some_and(|leader| cross(leader, *other));
        if !inside || blocked || self.leaders.iter().any(|other| passes(*other, &area) || crosses(other)) {
            return None;
        }
        let crossed = self.front.iter().filter(|line| passes(**line, &area) || crosses(line));
        Some(choice.cost + CROSSING * crossed.count() as f64)
    }

    /// True if nothing is there.
    fn is_free(&self, area: &Area) -> bool {
        let lines = || self.leaders.iter().chain(&self.front);
        !self.markers.iter().chain(&self.texts).any(|other| overlap(area, other))
            && !lines().any(|line| passes(*line, area))
    }
}

fn overlap(a: &Area, b: &Area) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// True if a line has a part within an area (Liang and Barsky 1984).
fn passes([from, to]: Line, area: &Area) -> bool {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (low, high) = (area[axis], area[axis + 2]);
        let transform = to[axis] - from[axis];
        if transform == 0.0 {
            if from[axis] <= low || from[axis] >= high {
                return false;
            }
            continue;
        }
        let [a, b] = [(low - from[axis]) / transform, (high - from[axis]) / transform];
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    enter < leave
}

fn cross([a, b]: Line, [c, d]: Line) -> bool {
    let side = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

#[cfg(test)]
mod tests {
    use chromascope_figure::{Marker, Rect, Tag};

    use super::*;

    fn places(count: u32) -> Vec<Place> {
        let place = |index: u32| Place {
            // Four clusters, and some at one place.
            name: format!("method number {index}"),
            tag: Tag(index + 1),
            error: 10_f64.powi(-3 * (index.cast_signed() % 4) - 2) * (1.0 + 0.1 * f64::from(index / 4)),
            seconds: 10_f64.powi(index.cast_signed() % 4 - 8) * (1.0 + 0.2 * f64::from(index / 8)),
            marker: Marker::Circle,
            role: InkRole::Text,
        };
        (0..count).map(place).collect()
    }

    /// Positions of the texts of a panel, with their words.
    fn texts(panel: &Panel) -> Vec<(String, Area)> {
        let projection = Projection::new(panel, 1.0);
        let text = |mark: &Mark| {
            let Shape::Text { at, text, anchor, offset, .. } = &mark.shape else { return None };
            let (point, width) = (projection.at(*at), text_width(text, TextSize::Small));
            let choice = Choice { anchor: *anchor, offset: *offset, leader: None, cost: 0.0 };
            Some((text.clone(), choice.area(point, width)))
        };
        panel.marks.iter().filter_map(text).collect()
    }

    #[test]
    fn every_method_is_named_and_no_name_covers_another() {
        for count in [1, 4, 9, 17, 24] {
            let places = places(count);
            let area = Rect::from_min_size([0.0, 0.0], [420.0, 320.0]);
            let panel = super::super::panel("p", ["error", "time"], "note".to_owned(), &places, area);
            let texts = texts(&panel);
            for place in &places {
                let named =
                    texts.iter().any(|(text, _)| *text == place.name || text.ends_with(&format!(": {}", place.name)));
                assert!(named || count > 20, "{} of {count} is not named", place.name);
            }
            for (index, (text, area)) in texts.iter().enumerate() {
                let other = texts[..index].iter().find(|(_, other)| {
                    // Lines of the list touch.
                    let inside = [other[0] + 0.5, other[1] + 0.5, other[2] - 0.5, other[3] - 1.5];
                    overlap(area, &inside)
                });
                assert!(other.is_none(), "{text} covers {other:?}");
            }
        }
    }

    #[test]
    fn what_has_no_room_is_left_out_whole() {
        let area = Rect::from_min_size([0.0, 0.0], [110.0, 70.0]);
        let panel = super::super::panel("p", ["error", "time"], String::new(), &places(24), area);
        let numbers = texts(&panel).into_iter().filter(|(text, _)| text.parse::<u32>().is_ok()).count();
        let lines = texts(&panel).into_iter().filter(|(text, _)| text.contains(": ")).count();
        assert_eq!(numbers, lines, "a number without its name says nothing");
    }

    #[test]
    fn lines_and_areas_meet_where_they_do() {
        let area = [0.0, 0.0, 10.0, 10.0];
        assert!(passes([[-5.0, 5.0], [15.0, 6.0]], &area) && passes([[5.0, 5.0], [5.0, 50.0]], &area));
        assert!(!passes([[-5.0, 5.0], [-1.0, 5.0]], &area) && !passes([[0.0, 11.0], [10.0, 11.0]], &area));
        assert!(cross([[0.0, 0.0], [2.0, 2.0]], [[0.0, 2.0], [2.0, 0.0]]));
        assert!(!cross([[0.0, 0.0], [2.0, 2.0]], [[3.0, 0.0], [3.0, 9.0]]));
    }
}
