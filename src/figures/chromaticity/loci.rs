//! Planckian loci with temperature ticks, and cameras' spectral loci.

use chromascope_core::query::{LocusPoint, Temperatures};
use chromascope_core::units::Kelvin;
use chromascope_figure::{Anchor, Dash, InkRole, Mark, Marker, Shape};

use super::drawing::{Drawing, id};
use super::ground::text;
use crate::plot_item::PlotItem;
use crate::scene::locus::split;
use crate::scene::{ComparedSensor, Scene};

/// Temperatures that are marked along a locus, in kelvins.
const TICKS: [f64; 6] = [1000.0, 2000.0, 3000.0, 5000.0, 10_000.0, 20_000.0];

/// Coordinates beyond this are not drawn.
const FAR: f64 = 3.0;

/// Adds the loci of all sensors, the reference's on top.
pub(super) fn add(drawing: &mut Drawing<'_>, sources: &[ComparedSensor]) {
    for source in sources.iter().rev() {
        // While B is held, the reference replaces every camera.
        if drawing.view.blink && !source.is_reference {
            continue;
        }
        match drawing.scene.locus(source.kind, &source.name) {
            Ok(locus) => add_one(drawing, source, &locus.points),
            Err(error) => drawing.refused.push(error.to_string()),
        }
    }
}

fn add_one(drawing: &mut Drawing<'_>, source: &ComparedSensor, locus: &[LocusPoint]) {
    const GAP: [f64; 2] = [f64::NAN; 2];
    // Where the sum of signals passes through zero, the locus goes to infinity and returns from the other side: no line
    // connects them.
    let shown = |at: &[f64; 2]| at.iter().all(|v| v.abs() < FAR);
    let points: Vec<[f64; 2]> =
        locus.iter().map(|p| drawing.place_of(p.xy, p.uv).filter(shown).unwrap_or(GAP)).collect();
    drawing.data.extend(points.iter().filter(|p| p[0].is_finite()));
    let tag = drawing.things.tag(PlotItem::Sensor(id(source)));
    if points.iter().all(|p| !p[0].is_finite()) {
        drawing.refused.push(format!("{}: chromaticity undefined (X + Y + Z = 0)", source.label));
    }
    let below = drawing.scene.extrapolated_below(source.kind, &source.name).map(|(below, _)| below);
    let drawn = drawing.view.locus_share.map_or(points.len(), |share| (share * points.len() as f64) as usize);
    let points: Vec<[f64; 2]> =
        points.into_iter().enumerate().map(|(index, point)| if index < drawn { point } else { GAP }).collect();
    let [measured, beyond] = split(&points, |index| locus[index].temperature.get(), below);
    let line = |points| {
        let line = Mark::new(tag, &source.label, Shape::Line { points, closed: false });
        line.with_stroke(source.role, source.width)
    };
    drawing.loci.insert(drawing.marks.len());
    drawing.marks.push(line(measured).with_halo(InkRole::Plot));
    if !beyond.is_empty() {
        drawing.loci.insert(drawing.marks.len());
        drawing.marks.push(line(beyond).with_dash(Dash::Dotted));
    }
    if drawing.view.locus_share.is_some() {
        return;
    }
    for kelvin in TICKS {
        let Some(at) = at_temperature(drawing, source, kelvin) else { continue };
        let thing = PlotItem::Radiator { source: id(source), kelvin };
        let tag = drawing.things.tag(thing);
        let dot = Shape::Points { points: vec![at], marker: Marker::Circle, radius: 2.0 + source.width * 0.5 };
        drawing.marks.push(Mark::new(tag, format!("{} {kelvin:.0} K", source.label), dot).with_fill(source.role));
        if source.is_reference && (kelvin == 1000.0 || kelvin == 2000.0 || kelvin == 3000.0 || kelvin == 20_000.0) {
            drawing.marks.push(text(&format!("{kelvin:.0} K"), at, Anchor::LEFT_TOP, [6.0, 4.0], InkRole::Weak));
        }
    }
    add_mark(drawing, source);
}

/// The ring at the document's temperature.
fn add_mark(drawing: &mut Drawing<'_>, source: &ComparedSensor) {
    let kelvin = drawing.scene.document.temperature_k;
    let Some(at) = at_temperature(drawing, source, kelvin) else { return };
    let tag = drawing.things.tag(PlotItem::Radiator { source: id(source), kelvin });
    let ring = Shape::Points { points: vec![at], marker: Marker::Circle, radius: 4.5 };
    let mark = Mark::new(tag, format!("{} {kelvin:.0} K", source.label), ring);
    drawing.marks.push(mark.with_stroke(source.role, 1.5).with_fill(InkRole::Plot).with_halo(InkRole::Plot));
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
        let points: Vec<[f64; 2]> = points.iter().filter_map(|p| drawing.place(p.xy)).collect();
        let tag = drawing.things.tag(PlotItem::Sensor(id(source)));
        let name = format!("{}: monochromatic light", source.label);
        let line = Mark::new(tag, name, Shape::Line { points, closed: false });
        drawing.marks.push(line.with_stroke(source.role, 1.2).with_dash(Dash::Solid));
    }
}
