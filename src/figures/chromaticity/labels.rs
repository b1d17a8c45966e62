//! Texts of the diagram: each where there is room, none over another.

use chromascope_figure::{Anchor, InkRole, Mark, Shape, Tag, TextSize, text_width};

use super::frame::Frame;
use crate::catalog::names::model_of;
use crate::plot_item::PickIndex;

/// Space around a text in points.
const ROOM: f64 = 2.0;
/// Side of the corners that hold the names of the axes, in points.
const CORNER: f64 = 22.0;
/// Distance of the points that stand for a line, in points.
const STEP: f64 = 5.0;

/// Distance that sensors' names keep from markers of patches, in points.
const CLEARANCE: f64 = 8.0;
/// Least radius of such a marker in points: dots along lines are smaller.
const MARKER: f64 = 3.5;
/// Distance of two lines' ends below which a name beside one could be the other's.
const CROWDED: f64 = 16.0;
/// Lengths of leaders in points: from the first, in steps, to the last.
const LEADER: [f64; 3] = [20.0, 8.0, 220.0];
/// Directions that a leader may take.
const DIRECTIONS: usize = 24;

/// Rank of a label: the lower one is placed first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    /// A patch that is pointed at or chosen: never left out.
    Pointed,
    Patch,
    Light,
    White,
    Temperature,
    Sensor,
    Ground,
}

/// A text with the positions it may take, the best one first.
pub(super) struct Label {
    /// Its sensor, with which it fades.
    pub(super) tag: Tag,
    pub(super) text: String,
    pub(super) rank: Rank,
    pub(super) ink: InkRole,
    pub(super) places: Vec<Place>,
    /// Points of a sensor's line from which a leader may start: its marker, its end.
    pub(super) starts: Vec<[f64; 2]>,
}

impl Label {
    /// Small text of the diagram's ground.
    pub(super) fn ground(text: &str, places: Vec<Place>) -> Self {
        Self::new(text, Rank::Ground, InkRole::Weak, places)
    }

    pub(super) fn new(text: impl Into<String>, rank: Rank, ink: InkRole, places: Vec<Place>) -> Self {
        Self { tag: PickIndex::NONE, text: text.into(), rank, ink, places, starts: Vec::new() }
    }
}

/// A position of a text: the point it belongs to, the side of the text there, and a shift in points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) at: [f64; 2],
    pub(super) anchor: Anchor,
    pub(super) offset: [f64; 2],
}

impl Place {
    /// Position beside a point, `distance` points away in a direction (y downward).
    pub(super) fn beside(at: [f64; 2], [x, y]: [f64; 2], distance: f64) -> Self {
        Self { at, anchor: Anchor(0.5 - 0.5 * x, 0.5 - 0.5 * y), offset: [distance * x, distance * y] }
    }

    /// Positions all around a point, that in the direction of `first` first.
    pub(super) fn around(at: [f64; 2], first: [f64; 2], distance: f64) -> Vec<Self> {
        const D: f64 = std::f64::consts::FRAC_1_SQRT_2;
        let mut directions = [[D, -D], [-D, -D], [D, D], [-D, D], [1.0, 0.0], [-1.0, 0.0], [0.0, -1.0], [0.0, 1.0]];
        let along = |d: &[f64; 2]| d[0] * first[0] + d[1] * first[1];
        directions.sort_by(|a, b| along(b).total_cmp(&along(a)));
        directions
            .map(|[x, y]| {
                // A diagonal's text begins at the corner nearest to the point.
                let anchor = Anchor(0.5 - 0.5 * near_sign(x), 0.5 - 0.5 * near_sign(y));
                Self { at, anchor, offset: [distance * x, distance * y] }
            })
            .to_vec()
    }
}

fn near_sign(value: f64) -> f64 {
    if value.abs() < 0.1 { 0.0 } else { value.signum() }
}

/// A disk that no text may cover.
#[derive(Clone, Copy)]
struct Disk {
    center: [f64; 2],
    radius: f64,
    is_line: bool,
    /// Part of the spectral locus, which only sensors' names keep off.
    is_ground: bool,
}

/// A rectangle in points of the plot.
#[derive(Clone, Copy)]
struct Bounds {
    min: [f64; 2],
    max: [f64; 2],
}

impl Bounds {
    fn overlaps(&self, other: &Self) -> bool {
        [0, 1].iter().all(|&axis| self.min[axis] < other.max[axis] && other.min[axis] < self.max[axis])
    }

    fn grown(&self, by: f64) -> Self {
        Self { min: self.min.map(|v| v - by), max: self.max.map(|v| v + by) }
    }

    fn contains(&self, at: [f64; 2]) -> bool {
        [0, 1].iter().all(|&axis| self.min[axis] < at[axis] && at[axis] < self.max[axis])
    }

    fn covers(&self, disk: &Disk) -> bool {
        let beyond = [0, 1].map(|axis| {
            let center = disk.center[axis];
            (self.min[axis] - center).max(center - self.max[axis]).max(0.0)
        });
        beyond[0].hypot(beyond[1]) < disk.radius
    }
}

/// Disks by the squares of the plot that they touch.
struct Disks {
    columns: usize,
    squares: Vec<Vec<Disk>>,
}

impl Disks {
    /// Side of a square in points.
    const SIDE: f64 = 24.0;

    fn new(size: [f64; 2]) -> Self {
        let [columns, rows] = size.map(|side| (side / Self::SIDE) as usize + 1);
        Self { columns, squares: vec![Vec::new(); columns * rows] }
    }

    fn add(&mut self, disk: Disk) {
        let [min, max] = [-1.0, 1.0].map(|side| disk.center.map(|v| v + side * disk.radius));
        for square in self.touched(&Bounds { min, max }) {
            self.squares[square].push(disk);
        }
    }

    fn near(&self, bounds: &Bounds) -> impl Iterator<Item = &Disk> {
        self.touched(bounds).flat_map(|square| &self.squares[square])
    }

    /// Indices of the squares that a rectangle touches.
    fn touched(&self, bounds: &Bounds) -> impl Iterator<Item = usize> + use<> {
        let (columns, rows) = (self.columns, self.squares.len() / self.columns);
        let span = |axis: usize, count: usize| {
            let index = |v: f64| (v / Self::SIDE).clamp(0.0, (count - 1) as f64) as usize;
            index(bounds.min[axis])..=index(bounds.max[axis])
        };
        let across = span(0, columns);
        span(1, rows).flat_map(move |row| across.clone().map(move |column| row * columns + column))
    }
}

/// Places labels among marks: in order of rank, each at its first position that is free, else not at all. Names of patches and lights
/// may cross lines; those of patches pointed at may cross anything. A sensor's name that finds no position, or none that is its line's
/// alone, stands at the end of a leader; where that is too long, it is shortened.
pub(super) fn placed(mut labels: Vec<Label>, marks: &[&[Mark]], frame: &Frame) -> Vec<Mark> {
    let mut disks = Disks::new(frame.size);
    for disk in marks.iter().copied().flatten().flat_map(|mark| disks_of(mark, frame)) {
        disks.add(disk);
    }
    labels.sort_by_key(|label| (label.rank, label.ink != InkRole::Reference));
    let shortened: Vec<Vec<String>> = labels.iter().map(|label| shortened(label, &labels)).collect();
    let ends: Vec<[f64; 2]> = labels.iter().filter_map(|label| Some(frame.at(*label.starts.last()?))).collect();
    // The names of the axes.
    let [width, height] = frame.size;
    let corners = [
        Bounds { min: [0.0; 2], max: [CORNER; 2] },
        Bounds { min: [width - CORNER, height - CORNER], max: frame.size },
    ];
    let mut board = Board { frame, disks, taken: corners.into(), leaders: Vec::new() };
    let mut texts = Vec::new();
    for (mut label, shortened) in labels.into_iter().zip(shortened) {
        let near = |end: &&[f64; 2]| label.starts.last().is_some_and(|own| distance(frame.at(*own), **end) < CROWDED);
        // The reference's line is thick enough to be told by itself.
        let is_crowded = label.ink != InkRole::Reference && ends.iter().filter(near).count() > 1;
        let mut found = board.find(&label, is_crowded);
        for short in shortened {
            if found.is_none() {
                label.text = short;
                found = board.find(&label, is_crowded);
            }
        }
        let Some((Place { at, anchor, offset }, bounds, leader)) = found else { continue };
        board.taken.push(bounds);
        if let Some(ends) = leader {
            let shape = Shape::Segments { segments: vec![ends.map(|end| frame.value(end))] };
            texts.push(Mark::new(label.tag, format!("{}, leader", label.text), shape).with_stroke(label.ink, 1.0));
            board.leaders.push(ends);
        }
        let text = Mark::text(label.text, at, anchor, size(label.rank), label.ink);
        texts.push(Mark { tag: label.tag, ..text.with_offset(offset).with_halo(InkRole::Plot) });
    }
    texts
}

/// A camera's name without what stands in brackets, and without its maker too, where no other name holds the same.
fn shortened(label: &Label, labels: &[Label]) -> Vec<String> {
    if !matches!(label.ink, InkRole::Sensor(_)) || label.rank != Rank::Sensor {
        return Vec::new();
    }
    let model = model_of(&label.text);
    let is_alone = |short: &&str| labels.iter().filter(|other| other.text.contains(*short)).count() == 1;
    let without_maker = model.split_once(' ').map(|(_, rest)| rest);
    [Some(model), without_maker].into_iter().flatten().filter(is_alone).map(str::to_owned).collect()
}

/// What is drawn and written in the plot.
struct Board<'a> {
    frame: &'a Frame,
    disks: Disks,
    taken: Vec<Bounds>,
    leaders: Vec<[[f64; 2]; 2]>,
}

/// Position of a label, its rectangle, and the ends of its leader.
type Found = (Place, Bounds, Option<[[f64; 2]; 2]>);

impl Board<'_> {
    fn find(&self, label: &Label, is_crowded: bool) -> Option<Found> {
        let boxes: Vec<(Place, Bounds)> =
            label.places.iter().map(|place| (*place, extent(label, place, self.frame))).collect();
        let first = |lines| {
            let (place, bounds) = boxes.iter().find(|(_, bounds)| self.is_free(label, bounds, lines, CLEARANCE))?;
            Some((*place, *bounds, None))
        };
        // Leaders from ends that lie close together could be each other's.
        let own = if is_crowded { &label.starts[..1] } else { &label.starts[..] };
        let alone = first(true).filter(|_| !is_crowded).or_else(|| self.led(label, own)).or_else(|| first(true));
        let alone = alone.or_else(|| self.led(label, &label.starts));
        let found = alone.or_else(|| first(false).filter(|_| label.rank <= Rank::White));
        found.or_else(|| {
            boxes.first().filter(|_| label.rank == Rank::Pointed).map(|(place, bounds)| (*place, *bounds, None))
        })
    }

    /// True if a label's rectangle covers no text and no data, or lines at most; sensors' names stay clear of patches' markers.
    fn is_free(&self, label: &Label, bounds: &Bounds, lines: bool, clearance: f64) -> bool {
        let is_sensor = label.rank == Rank::Sensor;
        let hidden = |d: &Disk| (lines || !d.is_line) && (is_sensor || !d.is_ground) && bounds.covers(d);
        // Close to a patch's marker, a sensor's name would seem to be that marker's.
        let wide = if is_sensor { bounds.grown(clearance) } else { *bounds };
        let is_name_of = |d: &Disk| is_sensor && d.radius >= MARKER && !d.is_line && wide.covers(d);
        let crosses = |leader: &[[f64; 2]; 2]| points_along(*leader, 2.0).any(|at| bounds.contains(at));
        self.frame.contains(bounds.min, 0.0)
            && self.frame.contains(bounds.max, 0.0)
            && !self.taken.iter().any(|other| bounds.overlaps(other))
            && !self.leaders.iter().any(crosses)
            && !self.disks.near(&wide).any(|d| hidden(d) || is_name_of(d))
    }

    /// The position at the end of the shortest leader; one that crosses data counts as longer.
    fn led(&self, label: &Label, starts: &[[f64; 2]]) -> Option<Found> {
        let mut best: Option<(f64, Found)> = None;
        let [first, step, last] = LEADER;
        for start in starts {
            for index in 0..DIRECTIONS {
                let (y, x) = (std::f64::consts::TAU * index as f64 / DIRECTIONS as f64).sin_cos();
                // The point of the text's edge that faces the start.
                let most = x.abs().max(y.abs());
                let anchor = Anchor(0.5 - 0.5 * x / most, 0.5 - 0.5 * y / most);
                let mut length = first;
                while length <= last && best.as_ref().is_none_or(|(cost, _)| length < *cost) {
                    let place = Place { at: *start, anchor, offset: [length * x, length * y] };
                    let bounds = extent(label, &place, self.frame);
                    let from = self.frame.at(*start);
                    let ends = [5.0, length - ROOM].map(|reach| [from[0] + reach * x, from[1] + reach * y]);
                    length += step;
                    if !self.is_free(label, &bounds, true, ROOM) {
                        continue;
                    }
                    if let Some(crossed) = self.crossed(ends)
                        && best.as_ref().is_none_or(|(cost, _)| length + crossed < *cost)
                    {
                        best = Some((length + crossed, (place, bounds, Some(ends))));
                    }
                }
            }
        }
        best.map(|(_, found)| found)
    }

    /// Length that the data add which a leader crosses; none if it crosses a text or another leader.
    fn crossed(&self, ends: [[f64; 2]; 2]) -> Option<f64> {
        let is_barred = self.leaders.iter().any(|other| intersect(ends, *other))
            || points_along(ends, 2.0).any(|at| self.taken.iter().any(|text| text.contains(at)));
        let cost = |at: [f64; 2]| {
            let point = Bounds { min: at, max: at };
            let near = self.disks.near(&point).filter(|d| distance(d.center, at) < d.radius);
            near.map(|d| if d.radius >= MARKER && !d.is_line { 12.0 } else { 2.0 }).fold(0.0, f64::max)
        };
        (!is_barred).then(|| points_along(ends, 4.0).map(cost).sum())
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// True if two straight lines cross.
fn intersect([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let side = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}

fn size(rank: Rank) -> TextSize {
    if rank <= Rank::Patch { TextSize::Body } else { TextSize::Small }
}

/// The rectangle of a label, with room around it.
fn extent(label: &Label, place: &Place, frame: &Frame) -> Bounds {
    let size = size(label.rank);
    let [width, height] = [text_width(&label.text, size), 1.2 * f64::from(size.points())];
    let [x, y] = frame.at(place.at);
    let left = x + place.offset[0] - place.anchor.0 * width;
    let top = y + place.offset[1] - place.anchor.1 * height;
    Bounds { min: [left - ROOM, top - ROOM + 1.0], max: [left + width + ROOM, top + height + ROOM - 1.0] }
}

/// Disks along what a mark draws of the data; lines that stand for nothing are ground, but for the
/// spectral locus.
fn disks_of(mark: &Mark, frame: &Frame) -> Vec<Disk> {
    if mark.tag == PickIndex::NONE && !matches!(mark.shape, Shape::Points { .. } | Shape::Gradient { .. }) {
        return Vec::new();
    }
    let width = mark.stroke.map_or(0.0, |stroke| stroke.width);
    let is_ground = matches!(mark.shape, Shape::Gradient { .. });
    let line = |center| Disk { center, radius: 0.5 * width + 1.0, is_line: true, is_ground };
    let disks: Vec<Disk> = match &mark.shape {
        Shape::Points { points, radius, .. } => points
            .iter()
            .map(|point| Disk { center: frame.at(*point), radius: radius + 0.5 * width, is_line: false, is_ground })
            .collect(),
        Shape::Line { points, .. } => {
            let placed: Vec<[f64; 2]> = points.iter().map(|point| frame.at(*point)).collect();
            placed.windows(2).flat_map(|ends| along([ends[0], ends[1]], frame)).map(line).collect()
        }
        Shape::Gradient { points } => {
            let placed: Vec<[f64; 2]> = points.iter().map(|(point, _)| frame.at(*point)).collect();
            placed.windows(2).flat_map(|ends| along([ends[0], ends[1]], frame)).map(line).collect()
        }
        Shape::Segments { segments } => {
            segments.iter().flat_map(|ends| along(ends.map(|p| frame.at(p)), frame)).map(line).collect()
        }
        _ => Vec::new(),
    };
    disks.into_iter().filter(|disk| frame.contains(disk.center, -20.0)).collect()
}

/// Points along a straight line, none where all of it lies to one side of the plot.
fn along([a, b]: [[f64; 2]; 2], frame: &Frame) -> Vec<[f64; 2]> {
    let is_beside = |axis: usize| a[axis].max(b[axis]) < 0.0 || a[axis].min(b[axis]) > frame.size[axis];
    if is_beside(0) || is_beside(1) {
        return Vec::new();
    }
    points_along([a, b], STEP).collect()
}

/// Points of a straight line at most `step` apart, its first end among them.
fn points_along([a, b]: [[f64; 2]; 2], step: f64) -> impl Iterator<Item = [f64; 2]> {
    let length = distance(a, b);
    let count = if length.is_finite() { (length / step).ceil().min(400.0) } else { 0.0 };
    let at = move |i: usize| [0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * i as f64 / count);
    (0..count as usize).map(at)
}
