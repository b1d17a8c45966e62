//! Distance to the reference over temperature.

use chromascope_figure::{
    Anchor, Axis, Dash, Ink, InkRole, MIN_LABEL_SPACING, Mark, Marker, Panel, Rect, Shape, TextSize, Ticks,
};

use super::chromaticity::id;
use crate::document::{LOCUS_RANGE_K, SetKind};
use crate::plot_item::{PickIndex, PlotItem};
use crate::scene::locus::{distance, split};
use crate::scene::{ComparedSensor, Scene};

/// The strip with the items of its lines.
#[derive(Clone, Debug)]
pub struct Strip {
    /// The panel; its horizontal axis is in mired.
    pub panel: Panel,
    /// Items of the lines.
    pub things: PickIndex,
}

/// Temperatures that are written below, in kelvins.
const TICKS: [f64; 7] = [1000.0, 1200.0, 1500.0, 2000.0, 3000.0, 5000.0, 20_000.0];

/// Builds the strip; none where no sensor can be compared with the reference.
pub fn build(scene: &Scene<'_>, size: [f64; 2]) -> Option<Strip> {
    let reference = scene.locus(SetKind::Observer, &scene.document.reference).ok()?;
    let diagram = scene.document.diagram;
    let mut things = PickIndex::default();
    let (mut marks, mut minima) = (Vec::new(), Vec::new());
    let mut top = 0.0_f64;
    let sources = scene.sources();
    for source in sources.iter().filter(|source| source.visible && !source.is_reference) {
        if !matches!(scene.comparable(source.kind, &source.name), Ok(Ok(()))) {
            continue;
        }
        let Ok(locus) = scene.locus(source.kind, &source.name) else { continue };
        let pairs = locus.points.iter().zip(&reference.points);
        let points: Vec<[f64; 2]> =
            pairs.map(|(a, b)| [a.temperature.mired(), distance(a, b, diagram).unwrap_or(f64::NAN)]).collect();
        top = points.iter().map(|p| p[1]).filter(|d| d.is_finite()).fold(top, f64::max);
        let tag = things.tag(PlotItem::Sensor(id(source)));
        let below = scene.extrapolated_below(source.kind, &source.name).map(|(below, _)| below);
        let [measured, beyond] = split(&points, |index| 1e6 / points[index][0], below);
        let line = |points| {
            let line = Mark::new(tag, &source.label, Shape::Line { points, closed: false });
            line.with_stroke(source.role, source.width)
        };
        marks.push(line(measured).with_halo(InkRole::Plot));
        if !beyond.is_empty() {
            marks.push(line(beyond).with_dash(Dash::Dotted));
        }
        minima.extend(minimum(scene, source, &mut things));
    }
    if marks.is_empty() {
        return None;
    }
    marks.append(&mut minima);
    // A locus that goes to infinity leaves the strip; the others stay readable.
    let top = (top * 1.15).clamp(1e-6, 0.6);
    let kelvin = scene.document.temperature_k;
    add_cursor(&mut marks, kelvin, top);
    let ticks = TICKS.iter().map(|kelvin| (1e6 / kelvin, format!("{kelvin:.0} K"))).collect();
    let [cold, hot] = LOCUS_RANGE_K.map(|kelvin| 1e6 / kelvin);
    let x = Axis::new("", [cold, hot]).with_ticks(Ticks::At(ticks)).with_grid(true);
    let y = Axis::new("", [0.0, top]).with_ticks(Ticks::At(height_ticks(top, size[1] - 28.0))).with_grid(true);
    let mut panel =
        Panel::new("Distance to the reference over temperature", Rect::from_min_size([0.0, 0.0], size), x, y);
    panel.note = format!(
        "distance to reference ({}), normalized to {} (ring: minimum)",
        super::chromaticity::distance_symbol(diagram),
        scene.locus_balance()
    );
    panel.marks = marks;
    Some(Strip { panel, things })
}

/// The ring at a distance's minimum: it follows the balance, not the camera.
fn minimum(scene: &Scene<'_>, source: &ComparedSensor, things: &mut PickIndex) -> Option<Mark> {
    let nearest = scene.nearest_to_reference(source.kind, &source.name, scene.document.diagram)?;
    if nearest.at_end {
        return None;
    }
    let tag = things.tag(PlotItem::Radiator { source: id(source), kelvin: nearest.kelvin.round() });
    let ring =
        Shape::Points { points: vec![[1e6 / nearest.kelvin, nearest.distance]], marker: Marker::Circle, radius: 3.5 };
    let mark = Mark::new(tag, format!("{}: minimum at {:.0} K", source.label, nearest.kelvin), ring);
    Some(mark.with_stroke(source.role, 1.5).with_fill(InkRole::Plot))
}

/// One round number, and zero where there is room for both: the strip is low.
fn height_ticks(top: f64, height: f64) -> Vec<(f64, String)> {
    let decade = 10_f64.powf(top.log10().floor());
    let step = [5.0, 2.0, 1.0].iter().map(|k| k * decade).find(|step| *step <= top).unwrap_or(decade);
    let decimals = usize::try_from((-step.log10().floor()).max(0.0) as i64).unwrap_or(0);
    let apart = step / top * height >= MIN_LABEL_SPACING;
    let zero = apart.then_some(0.0);
    zero.into_iter().chain([step]).map(|value| (value, format!("{value:.decimals$}"))).collect()
}

/// The line at the document's temperature, with its number on the side that has room.
fn add_cursor(marks: &mut Vec<Mark>, kelvin: f64, top: f64) {
    let mired = 1e6 / kelvin;
    let line = Shape::Line { points: vec![[mired, 0.0], [mired, top]], closed: false };
    marks.push(Mark::new(PickIndex::NONE, "temperature", line).with_stroke(InkRole::Text, 1.5));
    let left = mired < 200.0;
    let (anchor, offset) = if left { (Anchor::RIGHT, -5.0) } else { (Anchor::LEFT, 5.0) };
    let shape = Shape::Text {
        at: [mired, top * 0.5],
        text: format!("{kelvin:.0} K"),
        anchor,
        offset: [offset, 0.0],
        size: TextSize::Body,
        ink: Ink::new(InkRole::Text),
    };
    marks.push(Mark::new(PickIndex::NONE, "temperature", shape).with_halo(InkRole::Plot));
}
