//! Targets: a plot for each camera with the reference in its middle and an arrow for each patch.

use std::f64::consts::TAU;

use chromascope_core::colorimetry::{Lab, Metric, UvPrime, Xy};
use chromascope_core::query::displacement::{JUST_VISIBLE_UV_PRIME, unit_contour};
use chromascope_core::query::{Displacements, PatchColor};
use chromascope_figure::{
    Anchor, Dash, Field, Ink, InkRole, Label, Labels, Mark, Marker, Panel, Place, Rect, Shape, Table, Tag, TextSize,
    clip_segment, text_area, text_width, wrapped,
};

use super::{Built, Compared, axes, compared, hue, id, place};
use crate::document::{SetKind, TransformChoice};
use crate::figures::chromaticity::sign;
use crate::figures::look::{DifferencePlane, FigureLook};
use crate::format::{cut_in_middle, fixed, number};
use crate::plot_item::{PickIndex, PlotItem, SensorId};
use crate::scene::Scene;

/// Height of a camera's head, and of the line of its statistics.
const HEAD: f64 = 19.0;
const LINE: f64 = 15.0;
/// Space between cells and around what is fitted into them.
const GAP: f64 = 6.0;
/// Width of an arrow's shaft and of its casing, length and half width of its head.
const SHAFT: [f64; 2] = [2.0, 3.6];
const TIP: [f64; 2] = [7.0, 3.6];
/// Least distance of the rings of round lengths.
const RINGS: f64 = 20.0;
/// Points of a closed line.
const CORNERS: u32 = 96;

/// Height of a cell from which on statistics stand below the name.
const TALL: f64 = 120.0;
/// Width of a cell in which numbers and hue have no room beside a short name.
const NARROW: f64 = 215.0;
/// Least mean length of arrows that the rings of all cameras may take by their room, in points.
const LEAST_MEAN: f64 = 12.0;

/// Cells of all cameras, and the scale that they share.
pub(super) struct Frame {
    /// Each with its words above.
    cells: Vec<Rect>,
    /// Height of the words above a plot.
    head: f64,
    /// The reference's place in a plot, from its middle.
    origin: [f64; 2],
    /// Points for each unit of the plane.
    pub(super) scale: f64,
}

impl Frame {
    /// The arrangement of cells with the largest scale. What fits: all but the largest twentieth of each camera's arrows, the
    /// just visible limit, and the rings unless arrows become too short for them. Exaggerated, the scale grows about the
    /// reference.
    pub(super) fn of(scene: &Scene<'_>, all: &[Compared], plane: DifferencePlane, size: [f64; 2]) -> Self {
        let shifts = || all.iter().flat_map(|one| &one.shift);
        let arrows = shifts().flat_map(|shift| {
            let is_usual = |v: &&[f64; 2]| v[0].hypot(v[1]) <= 1.1 * shift.p95;
            shift.vectors.iter().flatten().filter(is_usual).copied()
        });
        let inner: Vec<[f64; 2]> = limit(scene, plane).into_iter().chain(arrows).collect();
        let ring = shifts().map(|shift| shift.p95).fold(0.0, f64::max);
        let shortest = shifts().map(|shift| shift.mean_length).fold(f64::INFINITY, f64::min);
        let names = all.iter().map(|one| text_width(&one.source.short, TextSize::Small));
        let named = Heads::KEY + names.fold(0.0, f64::max);
        let holding = |points: &[[f64; 2]]| Self::holding(points, (all.len(), named), size);
        let whole = holding(&[inner.as_slice(), &circle(ring)].concat());
        let best = if whole.scale * shortest < LEAST_MEAN { holding(&inner) } else { whole };
        Self { scale: best.scale * scene.document.exaggeration.factor(), ..best }
    }

    /// The arrangement of so many cells, wide enough for their names, with the largest scale that holds these points.
    fn holding(points: &[[f64; 2]], (count, named): (usize, f64), size: [f64; 2]) -> Self {
        let (mut low, mut high) = ([-1e-9; 2], [1e-9; 2]);
        for point in points {
            for axis in 0..2 {
                low[axis] = f64::min(low[axis], point[axis]);
                high[axis] = f64::max(high[axis], point[axis]);
            }
        }
        let frame = |columns: usize| {
            let rows = count.max(1).div_ceil(columns);
            let [width, height] = [size[0] - GAP, (size[1] - GAP) / rows as f64];
            let head = if height - GAP > TALL { HEAD + LINE } else { HEAD };
            let cell = |index: usize| {
                let (row, column) = (index / columns, index % columns);
                // Fewer in the last row fill it.
                let width = width / columns.min(count - row * columns) as f64;
                let corner = [GAP + column as f64 * width, GAP + row as f64 * height];
                Rect::from_min_size(corner, [width - GAP, height - GAP])
            };
            let room = [width / columns as f64 - GAP, height - GAP - head].map(|side| (side - 2.0 * TIP[0]).max(4.0));
            let scale = (room[0] / (high[0] - low[0])).min(room[1] / (high[1] - low[1]));
            let origin = [-0.5 * scale * (high[0] + low[0]), 0.5 * scale * (high[1] + low[1])];
            Self { cells: (0..count).map(cell).collect(), head, origin, scale }
        };
        // A narrow cell has no room for what its head says.
        let merit = |frame: &Self| match frame.width() {
            width if width < named => 0.3 * frame.scale,
            width if width < NARROW => 0.7 * frame.scale,
            _ => frame.scale,
        };
        (2..=count).map(frame).fold(frame(1), |best, other| if merit(&other) > merit(&best) { other } else { best })
    }

    /// Width of the narrowest cell: those of the first row.
    fn width(&self) -> f64 {
        self.cells.first().map_or(0.0, Rect::width)
    }

    /// A camera's plot.
    fn plot(&self, index: usize) -> Rect {
        let Rect { min, max } = self.cells[index];
        Rect { min: [min[0], min[1] + self.head], max }
    }

    /// Distance of the reference's place from the farthest corner of a plot, in points.
    fn reach(&self, plot: Rect) -> f64 {
        let [x, y] = self.origin.map(f64::abs);
        (0.5 * plot.width() + x).hypot(0.5 * plot.height() + y)
    }

    /// A round length whose rings are far enough from each other, and few.
    fn step(&self) -> f64 {
        let reach = if self.cells.is_empty() { 0.0 } else { self.reach(self.plot(0)) };
        let least = RINGS.max(reach / 5.0) / self.scale;
        let decade = 10_f64.powf(least.log10().floor());
        [1.0, 2.0, 5.0].map(|step| step * decade).into_iter().find(|step| *step >= least).unwrap_or(10.0 * decade)
    }
}

/// A camera's plot while it is drawn.
struct Target<'a> {
    frame: &'a Frame,
    area: Rect,
    marks: Vec<Mark>,
}

impl Target<'_> {
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let Frame { origin, scale, .. } = self.frame;
        let [left, top] = [0, 1].map(|axis| 0.5 * (self.area.min[axis] + self.area.max[axis]) + origin[axis]);
        [left + x * scale, top - y * scale]
    }

    /// A closed line around the reference, where it lies in the plot.
    fn outline(
        &mut self,
        (tag, name): (Tag, &str),
        points: &[[f64; 2]],
        ink: impl Into<Ink>,
        (width, dash): (f64, Dash),
    ) {
        let placed: Vec<[f64; 2]> = points.iter().chain(points.first()).map(|point| self.at(*point)).collect();
        let segments = placed.windows(2).filter_map(|ends| clip_segment(self.area, [ends[0], ends[1]]));
        let mut line: Vec<[f64; 2]> = Vec::new();
        for [a, b] in segments {
            if line.last() != Some(&a) {
                line.extend([[f64::NAN; 2], a]);
            }
            line.push(b);
        }
        let mark = Mark::new(tag, name, Shape::Line { points: line, closed: false });
        self.marks.push(mark.with_stroke(ink, width).with_dash(dash));
    }

    /// True if a small text at a position lies in the plot.
    fn holds(&self, words: &str, place: &Place) -> bool {
        let at = [place.at[0] + place.offset[0], place.at[1] + place.offset[1]];
        self.area.holds(&text_area(words, TextSize::Small, at, place.anchor))
    }

    fn segment(&mut self, name: &str, ends: [[f64; 2]; 2], ink: InkRole, width: f64) {
        let Some(ends) = clip_segment(self.area, ends) else { return };
        let mark = Mark::new(PickIndex::NONE, name, Shape::Segments { segments: vec![ends] });
        self.marks.push(mark.with_stroke(ink, width));
    }

    /// An arrow in the patch's color, cased; cut at the frame it has two tips. Returns the point of its tip and whether it is cut.
    fn arrow(
        &mut self,
        (tag, name): (chromascope_figure::Tag, &str),
        vector: [f64; 2],
        color: Ink,
    ) -> ([f64; 2], bool) {
        let (from, to) = (self.at([0.0; 2]), self.at(vector));
        let inner = Rect { min: self.area.min.map(|v| v + 2.0), max: self.area.max.map(|v| v - 2.0) };
        let end = clip_segment(inner, [from, to]).map_or(from, |ends| ends[1]);
        let is_cut = (end[0] - to[0]).hypot(end[1] - to[1]) > 0.5;
        let along = [end[0] - from[0], end[1] - from[1]];
        let length = along[0].hypot(along[1]);
        let casing = Ink::new(InkRole::Text).faded(0.75);
        if length < 1.5 {
            let dot = Shape::Points { points: vec![end], marker: Marker::Circle, radius: 1.5 };
            self.marks.push(Mark::new(tag, name, dot).with_fill(color).with_stroke(casing, 0.8));
            return (end, is_cut);
        }
        let along = along.map(|v| v / length);
        let tip = TIP[0].min(0.7 * length);
        let half = TIP[1] * tip / TIP[0];
        let back = |distance: f64, aside: f64| {
            [end[0] - distance * along[0] - aside * along[1], end[1] - distance * along[1] + aside * along[0]]
        };
        let mut tips = vec![vec![end, back(tip, half), back(tip, -half)]];
        if is_cut {
            tips.push(vec![back(0.8 * tip, 0.0), back(1.8 * tip, half), back(1.8 * tip, -half)]);
        }
        let shaft = |width: f64, ink: Ink, tag| {
            let shape = Shape::Segments { segments: vec![[from, back(0.7 * tip, 0.0)]] };
            Mark::new(tag, name, shape).with_stroke(ink, width)
        };
        let polygon = |points: &Vec<[f64; 2]>| Mark::new(tag, name, Shape::Polygon { points: points.clone() });
        self.marks.push(shaft(SHAFT[1], casing, PickIndex::NONE));
        self.marks.extend(tips.iter().map(|tip| polygon(tip).with_stroke(casing, 2.0 * 0.8)));
        self.marks.push(shaft(SHAFT[0], color, tag));
        self.marks.extend(tips.iter().map(|tip| polygon(tip).with_fill(color)));
        // Its end is what the pointer finds, and where the ring of a chosen one stands.
        let point = Shape::Points { points: vec![back(0.5 * tip, 0.0)], marker: Marker::Dot, radius: 1.0 };
        self.marks.push(Mark::new(tag, name, point).with_fill(color));
        (end, is_cut)
    }
}

fn circle(radius: f64) -> Vec<[f64; 2]> {
    let point = |index| {
        let (sin, cos) = (TAU * f64::from(index) / f64::from(CORNERS)).sin_cos();
        [radius * cos, radius * sin]
    };
    (0..CORNERS).map(point).collect()
}

/// Mean of the reference's patches, of which those with a chromaticity count, with the mean of their L*.
fn middle(scene: &Scene<'_>, plane: DifferencePlane) -> [f64; 3] {
    let colors = scene.patch_colors(SetKind::Observer, &scene.document.reference).unwrap_or_default();
    let known = colors.iter().filter_map(|color| Some((place(plane, color)?, color.lab.map_or(0.0, |lab| lab.l))));
    let known: Vec<[f64; 3]> = known.map(|([a, b], l)| [a, b, l]).collect();
    [0, 1, 2].map(|axis| known.iter().map(|color| color[axis]).sum::<f64>() / known.len().max(1) as f64)
}

/// Hue that a mean vector points to.
fn hue_of(scene: &Scene<'_>, plane: DifferencePlane, shift: &Displacements) -> &'static str {
    let [.., l] = middle(scene, plane);
    scene.adopted_white().map_or("", |white| hue::of(plane, shift, l, white))
}

/// Mean and 95 % quantile of the lengths, and the length of the mean vector.
fn lengths(shift: &Displacements, decimals: usize) -> [String; 3] {
    [shift.mean_length, shift.p95, shift.mean[0].hypot(shift.mean[1])].map(|length| fixed(length, decimals))
}

/// Statistics of a sensor's arrows in lines, each with what shows it; none without arrows.
pub fn explained(scene: &Scene<'_>, plane: DifferencePlane, sensor: &SensorId) -> Vec<String> {
    let Ok((_, all)) = compared(scene, plane) else { return Vec::new() };
    let shift = all.iter().find(|one| id(&one.source) == *sensor).map(|one| &one.shift);
    let Some(Ok(shift)) = shift else { return Vec::new() };
    let ([.., delta], decimals) = axes(plane);
    let [mean, p95, vector] = lengths(shift, decimals);
    let limit = limit_words(scene, plane);
    let lines = [
        format!("Arrows: mean length {delta} {mean}"),
        format!("Dashed ring: 95 % quantile of the lengths, {p95}"),
        format!("Cross: mean vector, {vector}, {}", hue_of(scene, plane, shift)),
        limit.trim().trim_end_matches('.').to_owned(),
    ];
    lines.into_iter().filter(|line| !line.is_empty()).collect()
}

/// Outline of differences that are just visible, at the mean of the reference's patches; none where nothing says so.
fn limit(scene: &Scene<'_>, plane: DifferencePlane) -> Vec<[f64; 2]> {
    let [a, b, l] = middle(scene, plane);
    match plane {
        DifferencePlane::UvPrime => circle(JUST_VISIBLE_UV_PRIME),
        DifferencePlane::Xy => {
            let Some(mean) = (Xy { x: a, y: b }).uv_prime() else { return Vec::new() };
            let point = |[u, v]: [f64; 2]| UvPrime { u: mean.u + u, v: mean.v + v }.xy().map(|xy| [xy.x - a, xy.y - b]);
            circle(JUST_VISIBLE_UV_PRIME).into_iter().filter_map(point).collect()
        }
        // By Eq 13 there is no CIE L*a*b*.
        DifferencePlane::Lab if scene.document.transform != TransformChoice::Paper => {
            unit_contour(Metric::DELTA_E_2000, Lab { l, a, b }, CORNERS)
        }
        DifferencePlane::Lab | DifferencePlane::Loci => Vec::new(),
    }
}

/// The limit in words.
fn limit_words(scene: &Scene<'_>, plane: DifferencePlane) -> String {
    match plane {
        _ if limit(scene, plane).is_empty() => String::new(),
        DifferencePlane::Lab => " Thin line: ΔE*00 = 1 at the patches' mean.".to_owned(),
        DifferencePlane::Xy => {
            format!(" Thin line: just visible at the patches' mean (Δu′v′ {JUST_VISIBLE_UV_PRIME}, CIE TN 001).")
        }
        _ => format!(" Thin circle: just visible (Δu′v′ {JUST_VISIBLE_UV_PRIME}, CIE TN 001)."),
    }
}

pub(super) fn build(
    scene: &Scene<'_>,
    look: &FigureLook,
    plane: DifferencePlane,
    size: [f64; 2],
) -> Result<Built, String> {
    let (reference, all) = compared(scene, plane)?;
    let names: Vec<String> =
        scene.patches().map_err(|error| error.to_string())?.patches().iter().map(|p| p.name.clone()).collect();
    let frame = Frame::of(scene, &all, plane, size);
    let mut things = PickIndex::default();
    let mut panel = Panel::board("Differences", Rect::from_min_size([0.0; 2], size), Ink::new(InkRole::Plot));
    let mut texts = Vec::new();
    let limit = limit(scene, plane);
    let heads = Heads::new(scene, &frame, &all, plane);
    for (index, one) in all.iter().enumerate() {
        heads.add(&mut panel, index, one, &mut things);
        let area = frame.plot(index);
        let mut target = Target { frame: &frame, area, marks: Vec::new() };
        target.ground(plane, index == 0, &mut texts);
        match &one.shift {
            Err(why) => {
                for (line, words) in wrapped(why, TextSize::Small, area.width() - 12.0).iter().enumerate() {
                    let at = [area.min[0] + 6.0, area.min[1] + 12.0 + LINE * line as f64];
                    target.marks.push(Mark::text(words.as_str(), at, Anchor::LEFT, TextSize::Small, InkRole::Text));
                }
            }
            Ok(shift) => {
                let ink = one.source.role;
                target.outline((PickIndex::NONE, "just visible"), &limit, InkRole::Weak, (0.8, Dash::Solid));
                if index == 0 && heads.is_below() && !limit.is_empty() {
                    let words = if plane == DifferencePlane::Lab { "ΔE*00 = 1" } else { "just visible" };
                    let starts = limit.iter().step_by(12).map(|point| target.at(*point)).collect();
                    texts.push(Label { starts, ..Label::new(words, InkRole::Weak, Vec::new()) });
                }
                let tag = things.tag(PlotItem::Sensor(id(&one.source)));
                target.ring((tag, shift.p95), ink, axes(plane).1, &mut texts);
                let patches = Patches { one, names: &names, reference: &reference, look, decimals: axes(plane).1 };
                patches.add(&mut target, shift, &mut things, &mut texts);
                let cross = Shape::Points { points: vec![target.at(shift.mean)], marker: Marker::Cross, radius: 4.5 };
                let cross = Mark::new(tag, format!("{}, mean", one.source.label), cross);
                if area.contains(target.at(shift.mean)) {
                    target.marks.push(cross.with_stroke(ink, 2.0).with_halo(InkRole::Plot));
                }
            }
        }
        panel.marks.append(&mut target.marks);
    }
    let mut labels = Labels::new(&panel);
    for label in &texts {
        labels.place(label);
    }
    panel.marks.extend(labels.into_marks());
    Ok(Built { panels: vec![panel], things })
}

/// Heads of all cameras, their statistics in one form: the longest that fits beside the short names.
struct Heads<'a> {
    frame: &'a Frame,
    plane: DifferencePlane,
    /// Hue that each mean vector points to.
    hues: Vec<&'static str>,
    note: Option<String>,
    form: usize,
    /// Names are shortened.
    is_short: bool,
}

impl<'a> Heads<'a> {
    /// Room of the marker before the name, and between name and statistics.
    const KEY: f64 = 17.0;
    const AIR: f64 = 5.0;
    const FORMS: usize = 6;

    fn new(scene: &Scene<'_>, frame: &'a Frame, all: &[Compared], plane: DifferencePlane) -> Self {
        let hues = all.iter().map(|one| one.shift.as_ref().map_or("", |shift| hue_of(scene, plane, shift))).collect();
        let note = scene.document.exaggeration.note();
        let heads = Self { frame, plane, hues, note, form: Self::FORMS, is_short: true };
        // A name that is alone in its line may be cut.
        let fit = |name: fn(&Compared) -> &str, form: usize| {
            all.iter().enumerate().all(|(index, one)| {
                let words = text_width(&heads.statistics(index, one, form), TextSize::Small);
                let air = if words > 0.0 { Self::AIR } else { 0.0 };
                let name = Self::KEY + text_width(name(one), TextSize::Body);
                let wide = if heads.is_below() { name.max(words) } else { name + air + words };
                wide <= frame.width()
            })
        };
        let least: fn(&Compared) -> &str = if heads.is_below() { |_| "" } else { |one| &one.source.short };
        let form = (0..Self::FORMS).find(|form| fit(least, *form)).unwrap_or(Self::FORMS);
        let is_short = !fit(|one| &one.source.label, form);
        Self { form, is_short, ..heads }
    }

    fn name(one: &Compared, is_short: bool) -> &str {
        if is_short { &one.source.short } else { &one.source.label }
    }

    fn is_below(&self) -> bool {
        self.frame.head > HEAD
    }

    /// Statistics in words, shorter from form to form; the exaggeration is never left out.
    fn statistics(&self, index: usize, one: &Compared, form: usize) -> String {
        let Ok(shift) = &one.shift else { return String::new() };
        let ([.., delta], decimals) = axes(self.plane);
        let [mean, p95, vector] = lengths(shift, decimals);
        let hue = self.hues[index];
        let to = if hue == hue::NONE { hue.to_owned() } else { format!("shift {hue}") };
        let words = match form {
            0 => format!("mean length {delta} {mean}, 95 % {p95}; mean vector {vector}, {hue}"),
            1 => format!("mean length {delta} {mean}; {to}"),
            2 => format!("mean length {mean}; {to}"),
            3 => format!("mean {mean}; {to}"),
            4 => hue.to_owned(),
            5 => mean,
            _ => String::new(),
        };
        let note = self.note.as_deref().unwrap_or_default();
        // In little room only its factor.
        let note = if form >= Self::FORMS { note.rsplit(' ').next().unwrap_or(note) } else { note };
        [words.as_str(), note].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ")
    }

    fn add(&self, panel: &mut Panel, index: usize, one: &Compared, things: &mut PickIndex) {
        let (source, corner, width) = (&one.source, self.frame.cells[index].min, self.frame.cells[index].width());
        let tag = things.tag(PlotItem::Sensor(id(source)));
        let middle = corner[1] + 0.5 * HEAD;
        // All of it is found by the pointer.
        let head = Shape::Rect { min: corner, max: [corner[0] + width, corner[1] + self.frame.head] };
        panel.marks.push(Mark::new(tag, &source.label, head));
        panel.marks.push(sign(tag, source, [corner[0] + 6.0, middle], 4.5, source.role));
        let words = self.statistics(index, one, self.form);
        let beside = text_width(&words, TextSize::Small) + Self::AIR;
        let room = if self.is_below() || words.is_empty() { width } else { width - beside };
        let in_size = |name: &str, size| Self::KEY + text_width(name, size) <= room;
        let name = Self::name(one, self.is_short);
        let size = if in_size(name, TextSize::Body) { TextSize::Body } else { TextSize::Small };
        let name = cut_in_middle(name, |name| in_size(name, size));
        let name = Mark::text(name, [corner[0] + Self::KEY, middle], Anchor::LEFT, size, InkRole::Text);
        panel.marks.push(Mark { tag, ..name });
        let (at, anchor) = if self.is_below() {
            ([corner[0], corner[1] + HEAD + 0.4 * LINE], Anchor::LEFT)
        } else {
            ([corner[0] + width, middle], Anchor::RIGHT)
        };
        panel.marks.push(Mark::text(words, at, anchor, TextSize::Small, InkRole::Weak));
    }
}

impl Target<'_> {
    /// The ring around most arrows; its radius beside it where the frame cuts it.
    fn ring(&mut self, (tag, radius): (Tag, f64), ink: InkRole, decimals: usize, texts: &mut Vec<Label>) {
        let points = circle(radius);
        self.outline((tag, "95 % quantile of the lengths"), &points, ink, (1.2, Dash::Dashed));
        if !points.iter().all(|point| self.area.contains(self.at(*point))) {
            let mut label = self.radius(format!("95 %: {}", fixed(radius, decimals)), radius);
            // Within and beyond the ring wherever its frame leaves room.
            let along = points.iter().step_by(3).flat_map(|at| {
                let [x, y] = at.map(|v| v / radius);
                [1.0, -1.0].map(|out| Place::beside(self.at(*at), [out * x, -out * y], 5.0))
            });
            label.places.extend(along.filter(|place| self.holds(&label.text, place)));
            label.shorter = vec![fixed(radius, decimals)];
            texts.insert(0, Label { ink: ink.into(), ..label });
        }
    }

    /// Words beside a ring, off the lines through the reference, where there is room for them.
    fn radius(&self, words: String, radius: f64) -> Label {
        let place = |[u, v]: [f64; 2], anchor, offset| Place { at: self.at([u * radius, v * radius]), anchor, offset };
        let beside = [[1.0, 0.0], [-1.0, 0.0]].map(|to| place(to, Anchor::TOP, [0.0, 2.0]));
        let above = [[0.0, -1.0], [0.0, 1.0]].map(|to| place(to, Anchor::LEFT, [3.0, 0.0]));
        // Else on the ring, which it interrupts; last within a wide ring's sides.
        let on = [0.5, 0.7, 0.87].into_iter().flat_map(|across: f64| {
            let up = (1.0 - across * across).sqrt();
            [[across, -up], [-across, -up], [across, up], [-across, up]].map(|to| place(to, Anchor::CENTER, [0.0; 2]))
        });
        let sides = [[-0.94, -0.34], [0.94, -0.34], [-0.94, 0.34], [0.94, 0.34]].map(|to| {
            let (anchor, inward) = if to[0] < 0.0 { (Anchor::LEFT, 9.0) } else { (Anchor::RIGHT, -9.0) };
            place(to, anchor, [inward, 0.0])
        });
        let places = beside.into_iter().chain(above).chain(on).chain(sides);
        let inside = places.filter(|place| self.holds(&words, place)).collect();
        Label::new(words, InkRole::Weak, inside)
    }

    /// Frame, lines through the reference, and rings of round lengths; names of axes and lengths where they are free.
    fn ground(&mut self, plane: DifferencePlane, named: bool, texts: &mut Vec<Label>) {
        let Rect { min, max } = self.area;
        let frame = Mark::new(PickIndex::NONE, "frame", Shape::Rect { min, max });
        // A line, not a ground: no text crosses it.
        self.marks.push(frame.with_stroke(InkRole::Line, 1.0));
        let [x, y] = self.at([0.0; 2]);
        self.segment("reference", [[min[0], y], [max[0], y]], InkRole::Grid, 1.0);
        self.segment("reference", [[x, min[1]], [x, max[1]]], InkRole::Grid, 1.0);
        let step = self.frame.step();
        let small = |text: String, places: Vec<Place>| Label::new(text, InkRole::Weak, places);
        for count in 1..=(self.frame.reach(self.area) / (step * self.frame.scale)) as u32 {
            let radius = f64::from(count) * step;
            let name = format!("length {}", number(radius));
            self.outline((PickIndex::NONE, &name), &circle(radius), InkRole::Grid, (1.0, Dash::Solid));
            if named || self.area.width() > 180.0 {
                texts.push(self.radius(number(radius), radius));
            }
        }
        let [across, up, _] = axes(plane).0;
        texts.push(small(
            across.to_owned(),
            vec![Place { at: [max[0], y], anchor: Anchor::RIGHT_BOTTOM, offset: [-4.0, -2.0] }],
        ));
        texts.push(small(up.to_owned(), vec![Place { at: [x, min[1]], anchor: Anchor::LEFT_TOP, offset: [4.0, 3.0] }]));
    }
}

/// The patches of a camera.
struct Patches<'a> {
    one: &'a Compared,
    names: &'a [String],
    reference: &'a [PatchColor],
    look: &'a FigureLook,
    decimals: usize,
}

impl Patches<'_> {
    /// Adds the arrows, the longest first; names those that the frame cuts and the one that is pointed at or chosen.
    fn add(&self, target: &mut Target<'_>, shift: &Displacements, things: &mut PickIndex, texts: &mut Vec<Label>) {
        let named = self.names.iter().zip(self.reference).zip(&shift.vectors);
        let mut arrows: Vec<_> = named.filter_map(|((name, color), vector)| Some((name, color, (*vector)?))).collect();
        arrows.sort_by(|a, b| b.2[0].hypot(b.2[1]).total_cmp(&a.2[0].hypot(a.2[1])));
        let mut cut = 0;
        for (patch, color, vector) in arrows {
            let item = PlotItem::Patch { source: Some(id(&self.one.source)), patch: patch.clone() };
            let pointed = [&self.look.hovered, &self.look.selected].into_iter().flatten();
            let is_pointed = pointed.filter(|other| **other == item).count() > 0;
            let tag = things.tag(item);
            let vector = if self.look.blink { [0.0; 2] } else { vector };
            let (end, is_cut) =
                target.arrow((tag, &format!("{} {patch}", self.one.source.label)), vector, Ink::rgb(color.srgb.bytes));
            cut += usize::from(is_cut);
            let is_named = is_pointed || (is_cut && cut <= 3);
            if !is_named {
                continue;
            }
            let words = format!("{patch} {}", fixed(vector[0].hypot(vector[1]), self.decimals));
            let [x, y] = target.at([0.0; 2]);
            let toward = [(x - end[0]).signum(), (y - end[1]).signum()];
            let places = [7.0, 12.0].into_iter().flat_map(|far| Place::around(end, toward, far));
            let places: Vec<Place> = places.filter(|place| target.holds(&words, place)).collect();
            let label = Label::new(words, if is_pointed { InkRole::Text } else { InkRole::Weak }, places);
            texts.push(Label { tag, always: is_pointed, ..label });
        }
    }
}

/// What the plots of a size show, in sentences.
pub(super) fn words(scene: &Scene<'_>, plane: DifferencePlane, size: [f64; 2]) -> String {
    let all = compared(scene, plane).map_or_else(|_| Vec::new(), |(_, all)| all);
    let frame = Frame::of(scene, &all, plane, size);
    let heads = Heads::new(scene, &frame, &all, plane);
    let numbers = if matches!(heads.form, 2 | 3 | 5) { " Numbers: mean length of the arrows." } else { "" };
    let hue = if heads.form < 5 { ", its hue in words" } else { "" };
    let step = number(frame.step());
    let [x, y, _] = axes(plane).0;
    let by_eq_13 = plane == DifferencePlane::Lab && scene.document.transform == TransformChoice::Paper;
    let eq_13 = if by_eq_13 { " L*a*b* of Eq 13 colors, which is not that of the CIE." } else { "" };
    format!(
        "Arrows: {x}, {y} from the reference, in the patch's color; all on one scale, double tip: beyond the frame. Cross: mean \
         vector{hue}. Dashed ring: 95 % quantile of the lengths. Gray rings: every {step}.{}{numbers}{eq_13}",
        limit_words(scene, plane)
    )
}

/// A patch through a sensor and through the reference, with the names of both.
type Shift = ([String; 2], PatchColor, PatchColor);

const COLUMNS: [Field<Shift>; 9] = [
    Field::new("sensor", |([sensor, _], ..)| sensor.as_str().into()),
    Field::new("patch", |([_, patch], ..)| patch.as_str().into()),
    Field::quantity(["d_u_prime", "Δu′", ""], |(_, a, b)| a.uv.zip(b.uv).map(|(a, b)| b.u - a.u).into()),
    Field::quantity(["d_v_prime", "Δv′", ""], |(_, a, b)| a.uv.zip(b.uv).map(|(a, b)| b.v - a.v).into()),
    Field::quantity(["d_x", "Δx", ""], |(_, a, b)| a.xy.zip(b.xy).map(|(a, b)| b.x - a.x).into()),
    Field::quantity(["d_y", "Δy", ""], |(_, a, b)| a.xy.zip(b.xy).map(|(a, b)| b.y - a.y).into()),
    Field::quantity(["d_l", "ΔL*", ""], |(_, a, b)| a.lab.zip(b.lab).map(|(a, b)| b.l - a.l).into()),
    Field::quantity(["d_a", "Δa*", ""], |(_, a, b)| a.lab.zip(b.lab).map(|(a, b)| b.a - a.a).into()),
    Field::quantity(["d_b", "Δb*", ""], |(_, a, b)| a.lab.zip(b.lab).map(|(a, b)| b.b - a.b).into()),
];

pub(super) fn table(scene: &Scene<'_>) -> Table {
    let patches = scene.patches();
    let names = patches.iter().flat_map(|set| set.patches()).map(|patch| &patch.name);
    let reference = scene.patch_colors(SetKind::Observer, &scene.document.reference).unwrap_or_default();
    let rows = super::sources(scene).unwrap_or_default().into_iter().flat_map(|source| {
        let colors = scene.patch_colors(source.kind, &source.name).unwrap_or_default();
        let row = |((name, a), b): ((&String, &PatchColor), PatchColor)| ([source.label.clone(), name.clone()], *a, b);
        names.clone().zip(&reference).zip(colors).map(row).collect::<Vec<Shift>>()
    });
    Table::of(&COLUMNS, rows)
}
