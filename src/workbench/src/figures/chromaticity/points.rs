//! Patches as points, with tails from each camera's to the reference's, and the text under the pointer; arrows to
//! patches outside the plot.

use chromascope_core::colorimetry::{Metric, UvPrime, Xy};
use chromascope_core::query::{LocusPoint, PatchColor, Temperatures, compare};
use chromascope_core::units::Kelvin;
use chromascope_figure::{Ink, InkRole, Label, Mark, Marker, Place, Shape};

use super::drawing::{Drawing, Frame, Rank, id, label as ranked};
use crate::document::{Diagram, SetKind};
use crate::format::{fixed, number};
use crate::palette::LINE_TAIL;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::{ComparedSensor, Scene};

/// Up to this many patches points are markers with names, of more they are dots.
const FEW: usize = 12;
/// Number of points up to which markers are largest, and from which they are smallest: 5 patches through 5 sensors, 24 through 8.
const COUNTS: [f64; 2] = [25.0, 192.0];
/// Their diameters in points there, rim included.
const DIAMETERS: [f64; 2] = [15.0, 6.0];
/// Number of sensors up to which markers are no larger: few sensors have errors as small as many have.
const USUAL: usize = 4;
/// Share by which the first camera's markers are smaller than the last one's below them.
const STEPPED: f64 = 0.25;

/// Diameter of markers, rim included: smaller the more there are.
fn diameter(count: usize) -> f64 {
    let share = (count.max(1) as f64 / COUNTS[0]).ln() / (COUNTS[1] / COUNTS[0]).ln();
    DIAMETERS[0] + (DIAMETERS[1] - DIAMETERS[0]) * share.clamp(0.0, 1.0)
}

/// Adds the patches of all sensors, smaller markers over larger ones, the reference's on top.
pub(super) fn add(drawing: &mut Drawing<'_>, sources: &[ComparedSensor]) {
    let patches = match drawing.scene.patches() {
        Ok(patches) => patches,
        Err(error) => return drawing.refused.push(error.to_string()),
    };
    let names: Vec<&str> = patches.patches().iter().map(|patch| patch.name.as_str()).collect();
    let reference =
        drawing.scene.patch_colors(SetKind::Observer, &drawing.scene.document.reference).unwrap_or_default();
    let few = names.len() <= FEW;
    let count = names.len() * drawing.scene.document.compared.len().max(USUAL);
    let diameter = if drawing.sketch { DIAMETERS[1] } else { diameter(count) };
    let cameras = sources.iter().filter(|source| !source.is_reference).count();
    let mut below = 0.0;
    for source in sources.iter().rev() {
        let step = if source.is_reference { 0.0 } else { below / cameras.saturating_sub(1).max(1) as f64 };
        below += 1.0;
        if drawing.look.blink && !source.is_reference {
            continue;
        }
        let Ok(colors) = drawing.scene.drawn_patch_colors(source.kind, &source.name) else { continue };
        let comparable = drawing.scene.is_comparable(source.kind, &source.name);
        if !drawing.sketch && !source.is_reference && comparable {
            add_tails(drawing, source, &names, &colors, &reference);
        }
        add_points(drawing, source, &names, &colors, diameter * (1.0 - STEPPED * step), few && !drawing.sketch);
    }
    if !drawing.sketch {
        add_names(drawing, &names, &reference, few, 0.5 * diameter);
    }
}

fn add_tails(
    drawing: &mut Drawing<'_>,
    source: &ComparedSensor,
    names: &[&str],
    colors: &[PatchColor],
    reference: &[PatchColor],
) {
    for ((name, color), reference) in names.iter().zip(colors).zip(reference) {
        let (from, to) = (drawing.place_of(color.xy, color.uv), drawing.place_of(reference.xy, reference.uv));
        let Some((from, to)) = from.zip(to) else { continue };
        let tag = drawing.things.tag(PlotItem::Patch { source: Some(id(source)), patch: (*name).to_owned() });
        let tail = Mark::new(tag, "tail", Shape::Segments { segments: vec![[from, to]] });
        drawing.marks.push(tail.with_stroke(Ink::new(source.role).faded(0.6), LINE_TAIL));
    }
}

fn add_points(
    drawing: &mut Drawing<'_>,
    source: &ComparedSensor,
    names: &[&str],
    colors: &[PatchColor],
    diameter: f64,
    filled: bool,
) {
    for (name, color) in names.iter().zip(colors) {
        let Some(at) = drawing.place_of(color.xy, color.uv) else { continue };
        let tag = drawing.things.tag(PlotItem::Patch { source: Some(id(source)), patch: (*name).to_owned() });
        let rim = if !source.marker.has_inside() || filled { (diameter / 6.0).clamp(1.2, 2.0) } else { 0.0 };
        let shape = Shape::Points { points: vec![at], marker: source.marker, radius: 0.5 * (diameter - rim) };
        let mark = Mark::new(tag, format!("{} {name}", source.label), shape);
        drawing.points.push(match (source.marker.has_inside(), filled) {
            (false, true) => mark.with_stroke(source.role, rim).with_halo(InkRole::Plot),
            (false, false) => mark.with_stroke(source.role, rim),
            (true, true) => {
                let mark = mark.with_stroke(source.role, rim).with_fill(Ink::rgb(color.srgb.bytes));
                mark.with_halo(InkRole::Plot)
            }
            (true, false) => mark.with_fill(source.role),
        });
    }
}

/// Names of the reference's points: all if there are few, else the hovered or selected ones.
fn add_names(drawing: &mut Drawing<'_>, names: &[&str], reference: &[PatchColor], few: bool, radius: f64) {
    let places: Vec<Option<[f64; 2]>> = reference.iter().map(|color| drawing.place_of(color.xy, color.uv)).collect();
    let known: Vec<[f64; 2]> = places.iter().flatten().copied().collect();
    let count = known.len().max(1) as f64;
    let center = known.iter().fold([0.0, 0.0], |sum, p| [sum[0] + p[0] / count, sum[1] + p[1] / count]);
    let pointed = |name: &str| {
        [&drawing.look.hovered, &drawing.look.selected].into_iter().flatten().any(|thing| thing.patch() == Some(name))
    };
    let mut labels = Vec::new();
    for (name, at) in names.iter().zip(places) {
        let rank = if pointed(name) { Rank::Pointed } else { Rank::Patch };
        let Some(at) = at.filter(|_| few || rank == Rank::Pointed) else { continue };
        let is_fitted = drawing.look.diagram.zoomed.is_none();
        let at = if is_fitted { held_inside(at, &drawing.frame) } else { at };
        // Away from the middle, where the others are.
        let up = if at[1] >= center[1] { -1.0 } else { 1.0 };
        let right = if at[0] >= center[0] - 0.02 { 1.0 } else { -1.0 };
        let places = Place::around(at, [right, up], radius + 3.0);
        let (rank, label) = ranked(rank, *name, InkRole::Text, places);
        labels.push((rank, Label { starts: vec![at], ..label }));
    }
    drawing.labels.extend(labels);
}

/// Name of an item and its difference from the reference, in one or two lines.
pub fn brief(scene: &Scene<'_>, thing: &PlotItem) -> Vec<String> {
    match thing {
        PlotItem::Sensor(source) => vec![label(scene, source)],
        PlotItem::Radiator { source, kelvin } => {
            let name = format!("{}, blackbody {kelvin:.0} K", label(scene, source));
            [name].into_iter().chain(blackbody_distance(scene, source, *kelvin)).collect()
        }
        PlotItem::Patch { source: Some(source), patch } => {
            let name = format!("{}, {patch}", label(scene, source));
            let index = scene.patches().ok().and_then(|set| set.patches().iter().position(|p| p.name == *patch));
            let difference =
                index.and_then(|i| scene.differences(source.kind, &source.name).ok()?.get(i).copied()?.ok());
            let is_reference = source.kind == SetKind::Observer && source.name == scene.document.reference;
            let decimals = scene.document.difference.decimals;
            let words = difference
                .map(|value| format!("{} {}", scene.difference_name(), crate::format::fixed(value, decimals)));
            [name].into_iter().chain(words.filter(|_| !is_reference)).collect()
        }
        _ => describe(scene, thing),
    }
}

/// Lines of text that describe an item under the pointer.
pub fn describe(scene: &Scene<'_>, thing: &PlotItem) -> Vec<String> {
    match thing {
        PlotItem::Sensor(source) => describe_source(scene, source),
        PlotItem::Radiator { source, kelvin } => describe_radiator(scene, source, *kelvin),
        PlotItem::Patch { source: Some(source), patch } => describe_patch(scene, source, patch),
        PlotItem::Patch { source: None, patch } => vec![patch.clone()],
        PlotItem::Light => vec![format!("light {}", scene.light_name())],
        PlotItem::DataSet { name, .. } => vec![name.clone()],
    }
}

/// Label of a sensor where it is compared, else its name.
pub fn label(scene: &Scene<'_>, id: &SensorId) -> String {
    let found = scene.sources().into_iter().find(|source| super::drawing::id(source) == *id);
    found.map_or_else(|| id.name.clone(), |source| source.label)
}

fn describe_source(scene: &Scene<'_>, source: &SensorId) -> Vec<String> {
    let mut lines = vec![label(scene, source)];
    if let Ok(locus) = scene.locus(source.kind, &source.name) {
        lines.push(format!("locus 1000–20000 K, length {} in xy", number(round4(locus.length_xy()))));
    }
    lines.extend(why_apart(scene, source));
    lines
}

/// Reason that a sensor has no distance to the reference, if so.
fn why_apart(scene: &Scene<'_>, source: &SensorId) -> Option<String> {
    let reason = scene.comparable(source.kind, &source.name).ok()?.err()?;
    Some(format!(
        "No distance to the reference: {reason}. Equal energy falls on (1/3, 1/3) for CIE observers, on D65 (0.3127, 0.3290) by Eq 13."
    ))
}

fn describe_radiator(scene: &Scene<'_>, source: &SensorId, kelvin: f64) -> Vec<String> {
    let mut lines = vec![format!("{}, blackbody {kelvin:.0} K", label(scene, source))];
    let Some(point) = blackbody(scene, source.kind, &source.name, kelvin) else { return lines };
    if let Some((below, end)) = scene.extrapolated_below(source.kind, &source.name).filter(|(below, _)| kelvin < *below)
    {
        lines.push(format!("extrapolated: below {below:.0} K, the missing data beyond {} nm matter", number(end)));
    }
    lines.extend(coordinates(point.xy, point.uv));
    if let Some(why) = why_apart(scene, source) {
        lines.push(why);
    } else {
        lines.extend(blackbody_distance(scene, source, kelvin).map(|words| format!("to the reference: {words}")));
    }
    lines
}

/// The blackbody of a temperature through a sensor.
fn blackbody(scene: &Scene<'_>, kind: SetKind, name: &str, kelvin: f64) -> Option<LocusPoint> {
    let list = Temperatures::List(vec![Kelvin::new(kelvin).ok()?]);
    scene.locus_at(kind, name, list).ok()?.points.first().copied()
}

/// Distance of a blackbody through a sensor to that of the same temperature through the reference, in words; none where the two
/// cannot be compared.
pub fn blackbody_distance(scene: &Scene<'_>, source: &SensorId, kelvin: f64) -> Option<String> {
    scene.comparable(source.kind, &source.name).ok()?.ok()?;
    let point = blackbody(scene, source.kind, &source.name, kelvin)?;
    let reference = blackbody(scene, SetKind::Observer, &scene.document.reference, kelvin)?;
    let xy = compare::difference(Metric::XY, &reference, &point);
    let uv = compare::difference(Metric::UV_PRIME, &reference, &point);
    Some(match (xy, uv) {
        (Ok(xy), Ok(uv)) => format!("Δxy {}   Δu′v′ {}", fixed(xy, 4), fixed(uv, 4)),
        (Err(why), _) | (_, Err(why)) => why.to_string(),
    })
}

fn describe_patch(scene: &Scene<'_>, source: &SensorId, patch: &str) -> Vec<String> {
    let mut lines = vec![format!("{}, {patch}", label(scene, source))];
    let index = scene.patches().ok().and_then(|set| set.patches().iter().position(|p| p.name == patch));
    let color = index.and_then(|i| scene.patch_colors(source.kind, &source.name).ok()?.get(i).copied());
    let Some((index, color)) = index.zip(color) else { return lines };
    if let Some([r, g, b]) = color.rgb {
        lines.push(format!("RGB {r:.4}  {g:.4}  {b:.4}").replace('-', "−"));
    }
    lines.extend(coordinates(color.xy, color.uv));
    if let Some(lab) = color.lab {
        lines.push(format!("L*a*b* {:.2}  {:.2}  {:.2}", lab.l, lab.a, lab.b).replace('-', "−"));
    }
    match scene.differences(source.kind, &source.name).ok().and_then(|all| all.get(index).copied()) {
        Some(Ok(difference)) => {
            let number = fixed(difference, scene.document.difference.decimals);
            lines.push(format!("{} to the reference: {number}", scene.difference_name()));
        }
        Some(Err(why)) => lines.push(why.to_string()),
        None => {}
    }
    if color.srgb.clipped {
        lines.push("Outside the screen's range: the color shown is clipped.".to_owned());
    }
    lines
}

fn coordinates(xy: Option<Xy>, uv: Option<UvPrime>) -> Vec<String> {
    let (Some(xy), Some(uv)) = (xy, uv) else {
        return vec!["Chromaticity undefined (X + Y + Z = 0).".to_owned()];
    };
    vec![format!("x {:.4}  y {:.4}   u′ {:.4}  v′ {:.4}", xy.x, xy.y, uv.u, uv.v).replace('-', "−")]
}

/// Four decimals: the useful precision.
fn round4(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

/// The symbol of a distance in the diagram.
pub const fn distance_symbol(diagram: Diagram) -> &'static str {
    match diagram {
        Diagram::Xy => "Δxy",
        Diagram::UvPrime => "Δu′v′",
    }
}

/// Radius of an arrow in points.
const ARROW: f64 = 5.0;
/// Arrows of one sensor are at least this far apart.
const APART: f64 = 8.0;

/// The position of a point's arrow, or its own where it lies in the plot.
fn inward(at: [f64; 2], frame: &Frame) -> [f64; 2] {
    const INSET: f64 = ARROW + 3.0;
    [0, 1].map(|axis| at[axis].min(frame.size[axis] - INSET).max(INSET))
}

/// A point, or that of its arrow.
fn held_inside(point: [f64; 2], frame: &Frame) -> [f64; 2] {
    let at = frame.at(point);
    if frame.contains(at, 0.0) { point } else { frame.value(inward(at, frame)) }
}

/// Share of the plot beside its frame in which marks may be cut.
const EDGE: f64 = 0.03;

/// Adds an arrow for each patch that lies outside the plot, and in place of each that the frame cuts; those close together share
/// one.
pub(super) fn add_arrows(drawing: &mut Drawing<'_>) {
    let frame = drawing.frame;
    let whole = |at: [f64; 2], radius: f64| frame.contains(at, radius.min(EDGE * frame.size[0].min(frame.size[1])));
    let mut arrows: Vec<Mark> = Vec::new();
    let mut taken: Vec<([f64; 2], InkRole)> = Vec::new();
    for mark in &drawing.points {
        let Shape::Points { points, radius, .. } = &mark.shape else { continue };
        let Some(ink) = mark.stroke.map(|stroke| stroke.ink).or(mark.fill) else { continue };
        for at in points.iter().map(|point| frame.at(*point)).filter(|at| !whole(*at, *radius)) {
            let beyond = [0, 1].map(|axis| (-at[axis]).max(at[axis] - frame.size[axis]));
            let axis = usize::from(beyond[1] > beyond[0]);
            let marker = match (axis, 2.0 * at[axis] < frame.size[axis]) {
                (0, true) => Marker::TriangleLeft,
                (0, false) => Marker::TriangleRight,
                (_, true) => Marker::TriangleUp,
                (_, false) => Marker::TriangleDown,
            };
            let edge = inward(at, &frame);
            let near = |(other, role): &([f64; 2], InkRole)| {
                *role == ink.role && (other[0] - edge[0]).hypot(other[1] - edge[1]) < APART
            };
            if !edge.iter().all(|v| v.is_finite()) || taken.iter().any(near) {
                continue;
            }
            taken.push((edge, ink.role));
            let shape = Shape::Points { points: vec![frame.value(edge)], marker, radius: ARROW };
            let arrow = Mark::new(mark.tag, format!("{}, outside", mark.name), shape);
            // Hollow, or it would be a marker of the sensor that has triangles.
            arrows.push(arrow.with_stroke(ink, 1.2).with_fill(InkRole::Plot).with_halo(InkRole::Plot));
        }
    }
    let is_cut = |mark: &Mark| {
        matches!(&mark.shape, Shape::Points { points, radius, .. }
            if points.iter().map(|point| frame.at(*point)).all(|at| frame.contains(at, 0.0) && !whole(at, *radius)))
    };
    drawing.points.retain(|mark| !is_cut(mark));
    drawing.small.append(&mut arrows);
}
