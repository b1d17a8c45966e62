//! Distance to the reference over temperature.

use chromascope_core::colorimetry::Xy;
use chromascope_core::query::Locus;
use chromascope_core::query::displacement::JUST_VISIBLE_UV_PRIME as JUST_VISIBLE;
use chromascope_figure::{
    Anchor, Axis, Cell, Dash, Figure, FigureRoom, InkRole, Label, Labels, LegendPlace, Mark, Marker, Panel, Place,
    Projection, Rect, Shape, TextSize, Ticks, text_width,
};

use super::chromaticity::{self, distance_symbol, id, sign};
use super::kind::{FigureKind, kelvins};
use super::look::FigureLook;
use crate::document::{Diagram, LOCUS_RANGE_K, SetKind};
use crate::format::number;
use crate::plot_item::{PickIndex, PlotItem};
use crate::scene::locus::{distance, split};
use crate::scene::{ComparedSensor, Scene};

/// The strip with the items of its lines.
#[derive(Clone, Debug)]
pub struct Strip {
    /// The panel; its axes are in logarithms of temperatures and in square roots of distances.
    pub panel: Panel,
    pub things: PickIndex,
}

/// Temperatures that are written below, in thousands of kelvins.
const TICKS: [f64; 10] = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0, 15.0, 20.0];
/// Largest distance drawn: a locus that goes to infinity leaves the strip, the others stay readable.
const LARGEST: f64 = 0.6;

/// Marks of the strip, from back to front.
#[derive(Default)]
struct Content {
    lines: Vec<Mark>,
    signs: Vec<Mark>,
    minima: Vec<(ComparedSensor, [f64; 2])>,
    /// Largest finite distance.
    top: f64,
}

/// Builds the strip; none where no sensor can be compared with the reference.
pub fn build(scene: &Scene<'_>, size: [f64; 2]) -> Option<Strip> {
    let reference = scene.locus(SetKind::Observer, &scene.document.reference).ok()?;
    let diagram = scene.document.diagram;
    let mut things = PickIndex::default();
    let content = content(scene, &reference, &mut things)?;
    let symbol = distance_symbol(diagram);
    let long = format!(
        "distance to reference ({symbol}, square-root scale), normalized to {} (ring: minimum)",
        scene.locus_balance()
    );
    // In a narrow strip the caption tells the rest: the note takes a line, not the curves' height.
    let fits = text_width(&long, TextSize::Small) < size[0] - Projection::LEFT - 12.0;
    let note = if fits { long } else { format!("{symbol} to reference (square-root scale)") };
    let highest = content.top.clamp(1e-6, LARGEST).sqrt();
    let x = temperature_axis();
    let [cold, hot] = x.range;
    // Rings of minima at zero lie within the frame.
    let y = Axis::new("", [-0.05 * highest, highest]).with_ticks(Ticks::At(height_ticks(highest * highest)));
    let mut panel =
        Panel::new("Distance to the reference over temperature", Rect::from_min_size([0.0, 0.0], size), x, y);
    panel.note = note;
    // Lines up to the highest pass below the note.
    let ceiling = Shape::Line { points: vec![[cold, highest], [hot, highest]], closed: false };
    panel.marks.push(Mark::new(PickIndex::NONE, "", ceiling));
    panel = panel.with_headroom(2.0);
    panel.marks.clear();
    let top = panel.y.range[1];
    let (line, just_visible) = just_visible_line(&reference, diagram);
    panel.marks.push(line);
    panel.marks.extend(content.lines);
    panel.marks.push(cursor(scene.document.temperature_k, highest));
    panel.marks.extend(content.signs);
    panel.marks.extend(cut(&panel.marks, top, Projection::new(&panel, 1.0).plot.height()));
    let cursor = cursor_text(scene.document.temperature_k, top);
    let minima: Vec<Label> = content.minima.iter().map(|(source, at)| minimum_text(source, *at)).collect();
    let placed = |order: Vec<&Label>| {
        let mut labels = Labels::new(&panel);
        let count = order.into_iter().filter(|label| labels.place(label)).count();
        (count, labels)
    };
    // The temperature is written nowhere else, so it stands first unless more numbers fit where it stands last.
    let first = placed(std::iter::once(&cursor).chain(&minima).collect());
    let last = placed(minima.iter().chain([&cursor]).collect());
    let mut labels = if last.0 > first.0 { last.1 } else { first.1 };
    labels.place(&just_visible);
    panel.marks.extend(labels.into_marks());
    Some(Strip { panel, things })
}

/// A value at its square root, on its side of 0.
pub(super) fn root(value: f64) -> f64 {
    value.abs().sqrt().copysign(value)
}

/// The place of a temperature in kelvins on the axis of loci, its decadic logarithm. Evenly in mired, half of the axis would be
/// below 2000 K, where hardly a light is, and 5000 to 20000 K a sixth.
pub fn along(kelvin: f64) -> f64 {
    kelvin.log10()
}

/// The temperature in kelvins at a place on the axis of loci.
pub fn kelvin(along: f64) -> f64 {
    10_f64.powf(along)
}

/// Places on the axes of temperatures of loci and of differences.
pub(super) const SCALES: [fn(f64) -> f64; 2] = [|number| along(kelvins(number)), root];

/// The temperatures of loci, cold at the left.
pub(super) fn temperature_axis() -> Axis {
    let ticks = TICKS.iter().map(|thousands| (along(1e3 * thousands), thousands.to_string())).collect();
    let range = LOCUS_RANGE_K.map(along);
    Axis::new("blackbody temperature (1000 K)", range).with_ticks(Ticks::At(ticks)).with_grid(true)
}

/// The point of a curve at which the marker of the sensor at a place in the list stands: each at a temperature of its own, by
/// which lines are told apart where they cross or are printed in gray.
pub(super) fn marked(points: &[[f64; 2]], place: usize) -> Option<[f64; 2]> {
    let [cold, hot] = LOCUS_RANGE_K.map(along);
    let from = cold + (0.1 + 0.07 * (place % 6) as f64) * (hot - cold);
    points.iter().copied().find(|at| at[0] >= from)
}

const SIZE: [f64; 2] = [640.0, 170.0];

pub static KIND: FigureKind =
    FigureKind::new("strip", "Distance of each locus to the reference's over temperature", figure).with_scales(SCALES);

/// The strip as a figure of its own, with its numbers; none where no sensor can be compared with the reference.
fn figure(scene: &Scene<'_>, _: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let size = room.size(SIZE, 0.0);
    let mut figure = Figure::new("Distance to the reference over temperature", size);
    figure.panels.push(build(scene, size)?.panel);
    let drawn = compared(scene).collect::<Vec<_>>();
    figure.legend = drawn.iter().map(|source| chromaticity::key(source, source.label.clone())).collect();
    let is_locus = |row: &Vec<Cell>| row.get(1) == Some(&Cell::from("locus"));
    figure.table = chromaticity::table(scene);
    figure.table.rows.retain(is_locus);
    figure.caption = caption(scene);
    figure.legend_place = LegendPlace::Outside;
    Some(figure)
}

/// What the strip depends on, and its minima, in sentences.
fn caption(scene: &Scene<'_>) -> String {
    let minima = minima(scene);
    let words = minima.iter().map(|(source, at)| format!("{} {:.0} K", source.label, kelvin(at[0])));
    let words = words.collect::<Vec<_>>().join(", ");
    let minima = if minima.is_empty() { String::new() } else { format!(" Rings: minima ({words}).") };
    let (before, loci) = (chromaticity::viewing_conditions(scene), chromaticity::loci_words(scene));
    format!("{before} {} {loci}{minima}", chromaticity::transform_words(scene))
}

/// Sensors that are compared, with their minima.
fn minima(scene: &Scene<'_>) -> Vec<(ComparedSensor, [f64; 2])> {
    compared(scene).filter_map(|source| minimum(scene, &source).map(|at| (source, at))).collect()
}

/// Visible sensors that can be compared with the reference.
fn compared<'a>(scene: &'a Scene<'_>) -> impl Iterator<Item = ComparedSensor> + 'a {
    let sources = scene.visible_sources().into_iter();
    sources.filter(|source| !source.is_reference && scene.is_comparable(source.kind, &source.name))
}

/// Lines and signs of the sensors; none where there are none.
fn content(scene: &Scene<'_>, reference: &Locus, things: &mut PickIndex) -> Option<Content> {
    let diagram = scene.document.diagram;
    let mut content = Content::default();
    for source in &compared(scene).collect::<Vec<_>>() {
        let Ok(locus) = scene.locus(source.kind, &source.name) else { continue };
        let pairs = locus.points.iter().zip(&reference.points);
        let height = |a, b| distance(a, b, diagram).map_or(f64::NAN, f64::sqrt);
        let points: Vec<[f64; 2]> = pairs.map(|(a, b)| [along(a.temperature.get()), height(a, b)]).collect();
        let finite = points.iter().map(|p| p[1] * p[1]).filter(|d| d.is_finite());
        content.top = finite.fold(content.top, f64::max);
        let tag = things.tag(PlotItem::Sensor(id(source)));
        let below = scene.extrapolated_below(source.kind, &source.name).map(|(below, _)| below);
        let at = marked(&points, content.signs.len());
        content.signs.extend(at.map(|at| sign(tag, source, at, 4.0, source.role)));
        let [measured, beyond] = split(&points, |index| locus.points[index].temperature.get(), below);
        let line = |points| {
            let line = Mark::new(tag, &source.label, Shape::Line { points, closed: false });
            line.with_stroke(source.role, source.width)
        };
        content.lines.push(line(measured));
        if !beyond.is_empty() {
            content.lines.push(line(beyond).with_dash(Dash::Dotted));
        }
    }
    content.minima = minima(scene);
    for (source, at) in &content.minima {
        let kelvin = kelvin(at[0]);
        let tag = things.tag(PlotItem::Radiator { source: id(source), kelvin: kelvin.round() });
        let ring = Shape::Points { points: vec![*at], marker: Marker::Circle, radius: 3.5 };
        let ring = Mark::new(tag, format!("{}: minimum at {kelvin:.0} K", source.label), ring);
        content.signs.push(ring.with_stroke(source.role, 1.5).with_fill(InkRole::Plot));
    }
    (!content.lines.is_empty()).then_some(content)
}

/// A distance's minimum: it follows the balance, not the camera.
fn minimum(scene: &Scene<'_>, source: &ComparedSensor) -> Option<[f64; 2]> {
    let nearest = scene.nearest_to_reference(source.kind, &source.name, scene.document.diagram)?;
    (!nearest.at_end).then(|| [along(nearest.kelvin), nearest.distance.sqrt()])
}

/// The temperature of a minimum, in the sensor's ink.
fn minimum_text(source: &ComparedSensor, at: [f64; 2]) -> Label {
    let places = [7.0, 11.0].into_iter().flat_map(|far| Place::around(at, [1.0, -0.1], far)).collect();
    Label::new(format!("{:.0} K", kelvin(at[0])), source.role, places)
}

/// Zero and two round distances with equal decimals, at the square roots where they lie.
pub(super) fn height_ticks(top: f64) -> Vec<(f64, String)> {
    let decade = 10_f64.powf(top.log10().floor());
    let rounds = [(5.0, 1.0), (2.0, 0.5), (1.0, 0.2)].map(|(high, low)| [0.0, low * decade, high * decade]);
    let rounds = rounds.into_iter().find(|rounds| rounds[2] <= top).unwrap_or([0.0, 0.2 * decade, decade]);
    let decimals = usize::try_from((-rounds[1].log10().floor()).max(0.0) as i64).unwrap_or(0);
    rounds.map(|value| (value.sqrt(), format!("{value:.decimals$}"))).to_vec()
}

/// The hairline of distances that are just visible, with its name.
fn just_visible_line(reference: &Locus, diagram: Diagram) -> (Mark, Label) {
    let height = |at: Xy| just_visible(at, diagram).sqrt();
    let points = reference.points.iter().filter_map(|p| Some([along(p.temperature.get()), height(p.xy?)]));
    let points: Vec<[f64; 2]> = points.collect();
    let sides = [(Anchor::BOTTOM, -2.0), (Anchor::TOP, 2.0)];
    let spread = || points.iter().step_by(8).copied();
    let places =
        sides.into_iter().flat_map(|(anchor, y)| spread().map(move |at| Place { at, anchor, offset: [0.0, y] }));
    let starts = spread().step_by(4).collect();
    let label = Label { starts, ..Label::new("just visible", InkRole::Weak, places.collect()) };
    let name = format!("just visible to half of observers: Δu′v′ {JUST_VISIBLE}");
    let line = Mark::new(PickIndex::NONE, name, Shape::Line { points, closed: false });
    (line.with_stroke(InkRole::Weak, 0.8), label)
}

/// Distance in a diagram that is just visible near a chromaticity; in xy, that of a circle as large as the ellipse there.
fn just_visible(at: Xy, diagram: Diagram) -> f64 {
    match diagram {
        Diagram::UvPrime => JUST_VISIBLE,
        // The Jacobian of u′v′ over xy is 108 / (−2x + 12y + 3)³.
        Diagram::Xy => JUST_VISIBLE / (108.0 / (-2.0 * at.x + 12.0 * at.y + 3.0).powi(3)).sqrt(),
    }
}

/// Arrowheads at the upper edge where lines leave the strip, named after how far.
fn cut(marks: &[Mark], top: f64, height: f64) -> Vec<Mark> {
    let y = top * (1.0 - 6.0 / height.max(12.0));
    let head = |mark: &Mark| {
        let Shape::Line { points, .. } = &mark.shape else { return None };
        let (stroke, farthest) =
            (mark.stroke?, points.iter().filter(|p| p[1] > top).max_by(|a, b| a[1].total_cmp(&b[1]))?);
        let inside = points.windows(2).find(|ends| (ends[0][1] > top) != (ends[1][1] > top));
        let x = inside.map_or(farthest[0], |ends| 0.5 * (ends[0][0] + ends[1][0]));
        let shape = Shape::Points { points: vec![[x, y]], marker: Marker::TriangleUp, radius: 4.0 };
        let name = format!("{}: beyond the strip, up to {}", mark.name, number(farthest[1] * farthest[1]));
        Some(Mark::new(mark.tag, name, shape).with_fill(stroke.ink))
    };
    marks.iter().filter_map(head).collect()
}

/// The line at the document's temperature.
pub(super) fn cursor(kelvin: f64, top: f64) -> Mark {
    let line = Shape::Line { points: vec![[along(kelvin), 0.0], [along(kelvin), top]], closed: false };
    Mark::new(PickIndex::NONE, "temperature", line).with_stroke(InkRole::Text, 1.5)
}

/// Its number, on the side that has room.
fn cursor_text(kelvin: f64, top: f64) -> Label {
    let at = |share: f64, (anchor, x)| Place { at: [along(kelvin), share * top], anchor, offset: [x, 0.0] };
    let sides = [(Anchor::RIGHT, -5.0), (Anchor::LEFT, 5.0)];
    let shares = [0.5, 0.62, 0.38, 0.74, 0.68, 0.56, 0.44, 0.32, 0.26];
    let places = shares.into_iter().flat_map(|share| sides.map(|side| at(share, side))).collect();
    let starts = [0.3, 0.5, 0.7].map(|share| [along(kelvin), share * top]).to_vec();
    Label { starts, ..Label::new(format!("{kelvin:.0} K"), InkRole::Text, places) }
}
