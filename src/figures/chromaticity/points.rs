//! Patches as points, with tails from each camera's to the reference's, and the text under the pointer.

use chromascope_core::colorimetry::{Metric, UvPrime, Xy};
use chromascope_core::query::{LocusPoint, PatchColor, Temperatures, compare};
use chromascope_core::units::Kelvin;
use chromascope_figure::{Anchor, Ink, InkRole, Mark, Shape, TextSize};

use super::drawing::{Drawing, id};
use crate::document::{Diagram, SetKind};
use crate::format::number;
use crate::plot_item::{PickIndex, PlotItem, SensorId};
use crate::scene::{ComparedSensor, Scene};
use crate::theme::{LINE_TAIL, MARKER, MARKER_SMALL};

/// Up to this many patches markers are large and all patches named.
const FEW: usize = 8;

/// Adds the patches of all sensors, the reference's on top.
pub(super) fn add(drawing: &mut Drawing<'_>, sources: &[ComparedSensor]) {
    let patches = match drawing.scene.patches() {
        Ok(patches) => patches,
        Err(error) => return drawing.refused.push(error.to_string()),
    };
    let names: Vec<&str> = patches.patches().iter().map(|patch| patch.name.as_str()).collect();
    let reference =
        drawing.scene.patch_colors(SetKind::Observer, &drawing.scene.document.reference).unwrap_or_default();
    let few = names.len() <= FEW;
    for source in sources.iter().rev() {
        if drawing.view.blink && !source.is_reference {
            continue;
        }
        let Ok(colors) = drawing.scene.patch_colors(source.kind, &source.name) else { continue };
        let comparable = matches!(drawing.scene.comparable(source.kind, &source.name), Ok(Ok(())));
        let tails = if source.is_reference || !comparable { &[] } else { reference.as_slice() };
        add_tails(drawing, source, &names, &colors, tails);
        add_points(drawing, source, &names, &colors, if few { MARKER } else { MARKER_SMALL });
    }
    add_names(drawing, &names, &reference, few);
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

fn add_points(drawing: &mut Drawing<'_>, source: &ComparedSensor, names: &[&str], colors: &[PatchColor], radius: f64) {
    for (name, color) in names.iter().zip(colors) {
        let Some(at) = drawing.place_of(color.xy, color.uv) else { continue };
        drawing.data.push(at);
        let tag = drawing.things.tag(PlotItem::Patch { source: Some(id(source)), patch: (*name).to_owned() });
        let shape = Shape::Points { points: vec![at], marker: source.marker, radius };
        let mark = Mark::new(tag, format!("{} {name}", source.label), shape).with_stroke(source.role, 2.0);
        let mark = if source.marker.has_inside() { mark.with_fill(Ink::rgb(color.srgb.bytes)) } else { mark };
        drawing.marks.push(mark.with_halo(InkRole::Plot));
    }
}

/// Names of the reference's points: all if there are few, else the hovered or selected ones.
fn add_names(drawing: &mut Drawing<'_>, names: &[&str], reference: &[PatchColor], few: bool) {
    let places: Vec<Option<[f64; 2]>> = reference.iter().map(|color| drawing.place_of(color.xy, color.uv)).collect();
    let known: Vec<[f64; 2]> = places.iter().flatten().copied().collect();
    let count = known.len().max(1) as f64;
    let center = known.iter().fold([0.0, 0.0], |sum, p| [sum[0] + p[0] / count, sum[1] + p[1] / count]);
    let pointed = |name: &str| {
        [&drawing.view.hovered, &drawing.view.selected].into_iter().flatten().any(|thing| thing.patch() == Some(name))
    };
    let mut labels = Vec::new();
    for (name, at) in names.iter().zip(places) {
        let Some(at) = at.filter(|_| few || pointed(name)) else { continue };
        // Away from the middle, where the others are.
        let up = at[1] >= center[1];
        let right = at[0] >= center[0] - 0.02;
        let anchor = Anchor(if right { 0.0 } else { 1.0 }, if up { 1.0 } else { 0.0 });
        let offset = [if right { 8.0 } else { -8.0 }, if up { -6.0 } else { 6.0 }];
        let ink = Ink::new(InkRole::Text);
        let shape = Shape::Text { at, text: (*name).to_owned(), anchor, offset, size: TextSize::Body, ink };
        labels.push(Mark::new(PickIndex::NONE, *name, shape).with_halo(InkRole::Plot));
    }
    drawing.marks.extend(labels);
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

/// Chromaticity of a patch through a sensor.
pub fn patch_xy(scene: &Scene<'_>, source: &SensorId, patch: &str) -> Option<Xy> {
    let index = scene.patches().ok()?.patches().iter().position(|p| p.name == patch)?;
    scene.patch_colors(source.kind, &source.name).ok()?.get(index)?.xy
}

fn label(scene: &Scene<'_>, id: &SensorId) -> String {
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
        (Ok(xy), Ok(uv)) => format!("Δxy {}   Δu′v′ {}", number(round4(xy)), number(round4(uv))),
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
            lines.push(format!("{} to the reference: {}", scene.difference_name(), number(round4(difference))));
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
