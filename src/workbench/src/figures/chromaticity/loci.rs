//! Planckian loci with temperature ticks, and cameras' spectral loci.

use chromascope_core::query::{LocusPoint, Temperatures};
use chromascope_core::units::Kelvin;
use chromascope_figure::{Dash, Ink, InkRole, Label, Mark, Marker, Place, Shape, TextSize};

use super::drawing::{Drawing, Rank, id, label};
use super::sign;
use crate::plot_item::{PickIndex, PlotItem, SensorId};
use crate::scene::locus::split;
use crate::scene::{ComparedSensor, Scene};

/// Temperatures that are marked along a locus, in kelvins.
const TICKS: [f64; 6] = [1000.0, 2000.0, 3000.0, 5000.0, 10_000.0, 20_000.0];

/// Length of the reference's ticks in points.
const TICK: f64 = 7.0;

/// Radius of the marker halfway along a line in points.
const HALFWAY: f64 = 4.0;

/// Coordinates beyond this are not drawn.
const FAR: f64 = 3.0;
/// Coordinates of spectral loci beyond this, twice the diagram's, are not drawn, nor lines that long: they come back from infinity.
const AXES: f64 = 1.6;

/// Largest number of sensors beside the reference that are named at their loci: of more, the legend tells.
const NAMED: usize = 6;

/// Adds the loci of all sensors, the reference's thick one below the others.
pub(super) fn add(drawing: &mut Drawing<'_>, sources: &[ComparedSensor]) {
    let is_few = sources.iter().filter(|source| !source.is_reference).count() <= NAMED;
    let are_named = is_few && !drawing.look.has_legend;
    let (reference, others): (Vec<_>, Vec<_>) = sources.iter().rev().partition(|source| source.is_reference);
    for source in reference.into_iter().chain(others) {
        // While B is held, the reference replaces every camera.
        if drawing.look.blink && !source.is_reference {
            continue;
        }
        match drawing.scene.locus(source.kind, &source.name) {
            Ok(locus) => add_one(drawing, source, &locus.points, are_named),
            Err(error) => drawing.refused.push(error.to_string()),
        }
    }
}

fn add_one(drawing: &mut Drawing<'_>, source: &ComparedSensor, locus: &[LocusPoint], is_named: bool) {
    const GAP: [f64; 2] = [f64::NAN; 2];
    // Where the sum of signals passes through zero, the locus goes to infinity and returns from the other side: no line
    // connects them.
    let shown = |at: &[f64; 2]| at.iter().all(|v| v.abs() < FAR);
    let points: Vec<[f64; 2]> =
        locus.iter().map(|p| drawing.place_of(p.xy, p.uv).filter(shown).unwrap_or(GAP)).collect();
    let tag = drawing.things.tag(PlotItem::Sensor(id(source)));
    if points.iter().all(|p| !p[0].is_finite()) {
        drawing.refused.push(format!("{}: chromaticity undefined (X + Y + Z = 0)", source.label));
    }
    let below = drawing.scene.extrapolated_below(source.kind, &source.name).map(|(below, _)| below);
    let drawn = drawing.look.locus_share.map_or(points.len(), |share| (share * points.len() as f64) as usize);
    let points: Vec<[f64; 2]> =
        points.into_iter().enumerate().map(|(index, point)| if index < drawn { point } else { GAP }).collect();
    let [measured, beyond] = split(&points, |index| locus[index].temperature.get(), below);
    let line = |points| {
        let line = Mark::new(tag, &source.label, Shape::Line { points, closed: false });
        line.with_stroke(source.role, source.width)
    };
    drawing.loci.insert(drawing.marks.len());
    // Halos would erase the reference's line below.
    drawing.marks.push(line(measured));
    if !beyond.is_empty() {
        drawing.loci.insert(drawing.marks.len());
        drawing.marks.push(line(beyond).with_dash(Dash::Dotted));
    }
    if drawing.sketch || drawing.look.locus_share.is_some() {
        return;
    }
    let marker = if source.is_reference {
        add_ticks(drawing, source, &points, locus);
        None
    } else {
        add_dots(drawing, source);
        add_marker(drawing, source, &points)
    };
    add_mark(drawing, source);
    if is_named || (source.is_reference && !drawing.look.has_legend) {
        add_end(drawing, source, &points, marker);
    }
}

/// A dot at each marked temperature of a camera's locus.
fn add_dots(drawing: &mut Drawing<'_>, source: &ComparedSensor) {
    for kelvin in TICKS {
        let Some(at) = at_temperature(drawing, source, kelvin) else { continue };
        let tag = drawing.things.tag(PlotItem::Radiator { source: id(source), kelvin });
        let dot = Shape::Points { points: vec![at], marker: Marker::Circle, radius: 1.5 + source.width * 0.5 };
        drawing.small.push(Mark::new(tag, format!("{} {kelvin:.0} K", source.label), dot).with_fill(source.role));
    }
}

/// A tick on the outer side of the reference's locus at each marked temperature, with its label.
fn add_ticks(drawing: &mut Drawing<'_>, source: &ComparedSensor, points: &[[f64; 2]], locus: &[LocusPoint]) {
    let Some(outer) = outer_side(points) else { return };
    for kelvin in TICKS {
        let Some(at) = at_temperature(drawing, source, kelvin) else { continue };
        let nearest = |i: &usize| (locus[*i].temperature.mired() - 1e6 / kelvin).abs();
        let Some(index) = (0..locus.len()).min_by(|a, b| nearest(a).total_cmp(&nearest(b))) else { continue };
        let [from, to] = [points[index.saturating_sub(1)], points[(index + 1).min(points.len() - 1)]];
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0].hypot(along[1]);
        // Not so where the locus is broken.
        if length.is_nan() || length <= 0.0 {
            continue;
        }
        let normal = [-outer * along[1] / length, outer * along[0] / length];
        let reach = TICK / drawing.frame.scale();
        let end = [at[0] + reach * normal[0], at[1] + reach * normal[1]];
        let tag = drawing.things.tag(PlotItem::Radiator { source: id(source), kelvin });
        let name = format!("{} {kelvin:.0} K", source.label);
        let tick = Mark::new(tag, name, Shape::Segments { segments: vec![[at, end]] });
        drawing.marks.push(tick.with_stroke(source.role, 1.5));
        // Isotherms have their own labels.
        if drawing.scene.document.overlays.isotherms {
            continue;
        }
        let beside = |distance| Place::beside(at, [normal[0], -normal[1]], distance);
        let places = [0.0, 3.0, 6.0, 12.0].map(|more| beside(TICK + 4.0 + more)).to_vec();
        let text = format!("{kelvin:.0} K");
        drawing.labels.push(label(Rank::Temperature, text, InkRole::Weak, places));
    }
}

/// Sign of the normal, counterclockwise from the line's direction, that points to the side to which the line bulges.
fn outer_side(points: &[[f64; 2]]) -> Option<f64> {
    let known: Vec<&[f64; 2]> = points.iter().filter(|p| p[0].is_finite()).collect();
    let (first, last) = (known.first()?, known.last()?);
    let beside = |p: &[f64; 2]| (last[0] - first[0]) * (p[1] - first[1]) - (last[1] - first[1]) * (p[0] - first[0]);
    known.iter().map(|p| beside(p)).max_by(|a, b| a.abs().total_cmp(&b.abs())).map(f64::signum)
}

/// The sensor's marker halfway along its line, by which lines are told apart without color; moved along where another one stands.
/// Returns its place.
fn add_marker(drawing: &mut Drawing<'_>, source: &ComparedSensor, points: &[[f64; 2]]) -> Option<[f64; 2]> {
    const SHARES: [f64; 7] = [0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74];
    let frame = drawing.frame;
    let placed: Vec<[f64; 2]> = points.iter().filter(|p| p[0].is_finite()).map(|p| frame.at(*p)).collect();
    let step = |ends: &[[f64; 2]]| (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]);
    let length: f64 = placed.windows(2).map(step).sum();
    let at_share = |share: f64| {
        let mut rest = share * length;
        placed.windows(2).find_map(|ends| {
            rest -= step(ends);
            (rest <= 0.0).then_some(ends[1])
        })
    };
    let taken: Vec<[f64; 2]> = drawing.halfway.clone();
    let is_free = |at: &[f64; 2]| taken.iter().all(|other| (other[0] - at[0]).hypot(other[1] - at[1]) > 4.0 * HALFWAY);
    let mut places = SHARES.iter().filter_map(|share| at_share(*share));
    let at = places.find(is_free).or_else(|| at_share(0.5))?;
    drawing.halfway.push(at);
    let tag = drawing.things.tag(PlotItem::Sensor(id(source)));
    let mark = sign(tag, source, frame.value(at), HALFWAY, source.role);
    drawing.small.push(Mark { name: format!("{}, line", source.label), ..mark }.with_halo(InkRole::Plot));
    Some(frame.value(at))
}

/// The sensor's name at the end of its locus, the red one first, else led there from its marker or that end.
fn add_end(drawing: &mut Drawing<'_>, source: &ComparedSensor, points: &[[f64; 2]], marker: Option<[f64; 2]>) {
    let known: Vec<[f64; 2]> = points.iter().copied().filter(|p| p[0].is_finite()).collect();
    let beyond = |from: Option<&[f64; 2]>, to: Option<&[f64; 2]>| {
        let (from, to) = (drawing.frame.at(*from?), drawing.frame.at(*to?));
        let away = [to[0] - from[0], to[1] - from[1]];
        let length = away[0].hypot(away[1]).max(1e-9);
        Some(away.map(|v| v / length))
    };
    let [start, end] = [known.first(), known.last()];
    // Far from the blue ends, which lie close together, a name would seem to be another line's.
    let red: &[f64] = &[7.0, 16.0, 24.0];
    let blue = if source.is_reference { &red[..2] } else { &red[..1] };
    let inner = [known.get(3), known.len().checked_sub(4).and_then(|i| known.get(i))];
    let mut places = Vec::new();
    for ((at, inner), distances) in [start, end].into_iter().zip(inner).zip([red, blue]) {
        if let Some((at, away)) = at.zip(beyond(inner, at)) {
            places.extend(distances.iter().flat_map(|distance| Place::around(*at, away, *distance)));
        }
    }
    // The outermost line has its name along it, if need be.
    if source.is_reference {
        let shares = (1..24).map(|i| i * known.len() / 24);
        places.extend(shares.filter_map(|i| known.get(i)).flat_map(|at| Place::around(*at, [0.5, -1.0], 9.0)));
    }
    let tag = drawing.things.tag(PlotItem::Sensor(id(source)));
    let starts = marker.into_iter().chain(start.copied()).collect();
    // In the window, as in its list; on paper without a legend in full, where there is room.
    let in_window = drawing.look.diagram.fit().is_some();
    let text = if in_window { &source.short } else { &source.label };
    let (rank, label) = label(Rank::Sensor, text, source.role, places);
    drawing.labels.push((rank, Label { tag, starts, shorter: vec![source.short.clone()], ..label }));
}

/// The ring at the document's temperature.
fn add_mark(drawing: &mut Drawing<'_>, source: &ComparedSensor) {
    let kelvin = drawing.scene.document.temperature_k;
    let Some(at) = at_temperature(drawing, source, kelvin) else { return };
    let tag = drawing.things.tag(PlotItem::Radiator { source: id(source), kelvin });
    // The reference's ring is seen around the others.
    let radius = if source.is_reference { 7.0 } else { 4.5 };
    let ring = Shape::Points { points: vec![at], marker: Marker::Circle, radius };
    let mark = Mark::new(tag, format!("{} {kelvin:.0} K", source.label), ring);
    drawing.small.push(mark.with_stroke(source.role, 1.5).with_fill(InkRole::Plot).with_halo(InkRole::Plot));
}

fn at_temperature(drawing: &Drawing<'_>, source: &ComparedSensor, kelvin: f64) -> Option<[f64; 2]> {
    let point = radiator(drawing.scene, source, kelvin)?;
    drawing.place_of(point.xy, point.uv)
}

/// A blackbody of one temperature through a sensor.
fn radiator(scene: &Scene<'_>, source: &ComparedSensor, kelvin: f64) -> Option<LocusPoint> {
    if kelvin == scene.document.temperature_k {
        return scene.locus_mark(source.kind, &source.name).ok()?.points.first().copied();
    }
    // All ticks in one query.
    let list = TICKS.iter().filter_map(|&kelvin| Kelvin::new(kelvin).ok()).collect();
    let locus = scene.locus_at(source.kind, &source.name, Temperatures::List(list)).ok()?;
    locus.points.iter().find(|point| point.temperature.get() == kelvin).copied()
}

/// Adds each camera's response to monochromatic light.
pub(super) fn add_monochromatic(drawing: &mut Drawing<'_>, sources: &[ComparedSensor]) {
    for source in sources {
        let Ok(points) = drawing.scene.monochromatic(source.kind, &source.name) else { continue };
        let near = |at: &[f64; 2]| at.iter().all(|value| value.abs() < AXES);
        let placed: Vec<[f64; 2]> =
            points.iter().map(|p| drawing.place(p.xy).filter(near).unwrap_or([f64::NAN; 2])).collect();
        let mut points: Vec<[f64; 2]> = Vec::new();
        for at in placed {
            let leaps = points.last().is_some_and(|from| (from[0] - at[0]).hypot(from[1] - at[1]) > 0.5 * AXES);
            points.extend(leaps.then_some([f64::NAN; 2]));
            points.push(at);
        }
        let tag = drawing.things.tag(PlotItem::Sensor(id(source)));
        let inside = points.iter().filter(|at| drawing.frame.contains(drawing.frame.at(**at), 40.0));
        if let Some(top) = inside.max_by(|a, b| a[1].total_cmp(&b[1])) {
            let places = [6.0, 14.0, 24.0].into_iter().flat_map(|by| Place::around(*top, [0.0, -1.0], by)).collect();
            let (rank, label) = label(Rank::Ground, format!("{}, spectral", source.label), source.role, places);
            drawing.labels.push((rank, Label { tag, ..label }));
        }
        let name = format!("{}: monochromatic light", source.label);
        let line = Mark::new(tag, name, Shape::Line { points, closed: false });
        drawing.marks.push(line.with_stroke(source.role, 1.2).with_dash(Dash::Solid));
    }
}

/// Adds the locus with its name, dashed. The diagram's ranges do not take it in: nothing moves while the pointer is on a list.
pub(super) fn add_ghost(drawing: &mut Drawing<'_>) {
    let Some(id) = looked_at(drawing) else { return };
    let Ok(locus) = drawing.scene.locus(id.kind, &id.name) else { return };
    let near = |at: &[f64; 2]| at.iter().all(|value| value.abs() < FAR);
    let points: Vec<[f64; 2]> =
        locus.points.iter().map(|p| drawing.place_of(p.xy, p.uv).filter(near).unwrap_or([f64::NAN; 2])).collect();
    let Some(at) = points.iter().copied().find(|point| point[0].is_finite()) else { return };
    let ink = Ink::new(InkRole::Text).faded(0.7);
    let line = Mark::new(PickIndex::NONE, format!("{} (not compared)", id.name), Shape::Line { points, closed: false });
    drawing.marks.push(line.with_stroke(ink, 2.0).with_dash(Dash::Dashed).with_halo(InkRole::Plot));
    let (rank, label) = label(Rank::Patch, id.name, InkRole::Text, Place::around(at, [0.0, 1.0], 6.0));
    drawing.labels.push((rank, Label { size: TextSize::Small, starts: vec![at], ..label }));
}

/// The sensor under the pointer, else the selected one, if it is not compared.
fn looked_at(drawing: &Drawing<'_>) -> Option<SensorId> {
    let items = [&drawing.look.hovered, &drawing.look.selected].into_iter().flatten();
    let mut sensors = items.filter_map(|item| if let PlotItem::Sensor(id) = item { Some(id) } else { None });
    let document = drawing.scene.document;
    sensors.find(|id| document.compared(id.kind, &id.name).is_none()).cloned()
}
