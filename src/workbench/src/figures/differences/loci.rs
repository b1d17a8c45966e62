//! Offsets of the cameras' Planckian loci from the reference's, across and along it, over the temperature.

use chromascope_core::camera::locus_deviation::LocusDeviation;
use chromascope_core::light::RadiationConstants;
use chromascope_core::query::{Ask as _, LocusDeviationsQuery, LocusQuery, Temperatures};
use chromascope_core::units::Kelvin;
use chromascope_figure::{
    Axis, Dash, Field, Label, Labels, Mark, Marker, Panel, Place, Projection, Rect, Shape, Table, Ticks,
};

use super::{Built, id, sources};
use crate::document::{Diagram, SetKind};
use crate::figures::chromaticity::sign;
use crate::figures::strip;
use crate::plot_item::{PickIndex, PlotItem};
use crate::scene::locus::split;
use crate::scene::{ComparedSensor, Scene};

pub(super) const WORDS: &str = "Offset of each Planckian locus from the reference's at the same temperature: across it (Duv, \
     positive above) and along it (temperature of the nearest point of the reference's locus minus the blackbody's). \
     Square-root scales. Ring: least distance in u′v′.";

type Part = fn(&LocusDeviation) -> Option<f64>;

/// The two parts of an offset: name, and value.
const PARTS: [(&str, Part); 2] = [("across: Duv", |offset| offset.duv), ("along: K", |offset| offset.cct_error_k)];

type Offsets = Vec<(Kelvin, Option<LocusDeviation>)>;

/// Offsets of a sensor's locus at temperatures.
fn offsets(scene: &Scene<'_>, source: &ComparedSensor, temperatures: Temperatures) -> Option<Offsets> {
    let reference = scene.rendering_of(SetKind::Observer, &scene.document.reference).ok()?;
    let rendering = scene.rendering_of(source.kind, &source.name).ok()?;
    let locus = LocusQuery { rendering, temperatures, constants: RadiationConstants::Paper };
    (*scene.results.ask(&LocusDeviationsQuery { locus, reference })).clone().ok()
}

/// The temperature and offset where the distance is least.
fn minimum(scene: &Scene<'_>, source: &ComparedSensor) -> Option<(f64, LocusDeviation)> {
    let nearest = scene.nearest_to_reference(source.kind, &source.name, Diagram::UvPrime).filter(|at| !at.at_end)?;
    let at = Temperatures::List(vec![Kelvin::new(nearest.kelvin).ok()?]);
    Some((nearest.kelvin, offsets(scene, source, at)?.first()?.1?))
}

pub(super) fn build(scene: &Scene<'_>, size: [f64; 2]) -> Result<Built, String> {
    let factor = scene.document.exaggeration.factor();
    let all: Vec<_> = sources(scene)?
        .into_iter()
        .filter_map(|source| Some((offsets(scene, &source, Scene::locus_temperatures().ok()?)?, source)))
        .collect();
    if all.is_empty() {
        return Err("No locus can be computed.".to_owned());
    }
    let mut things = PickIndex::default();
    let lower = 0.5 * (size[1] - 40.0) + 40.0;
    let areas = [
        Rect::from_min_size([0.0; 2], [size[0], size[1] - lower - 4.0]),
        Rect::from_min_size([0.0, size[1] - lower], [size[0], lower]),
    ];
    let mut panels = Vec::new();
    for ((part, value), area) in PARTS.into_iter().zip(areas) {
        let values = || all.iter().flat_map(|(offsets, _)| offsets).filter_map(|(_, offset)| value(offset.as_ref()?));
        let top = values().map(f64::abs).fold(1e-4, f64::max);
        let marked = scene.document.temperature_k;
        let ticks = strip::height_ticks(top / factor).into_iter().flat_map(|(at, words)| {
            let at = at * factor.sqrt();
            let words = if words.contains('.') { words.trim_end_matches('0').trim_end_matches('.') } else { &words };
            let below = (at > 0.0).then(|| (-at, format!("−{words}")));
            below.into_iter().chain([(at, words.to_owned())])
        });
        let y = Axis::new(part, [-strip::root(top), strip::root(top)])
            .with_ticks(Ticks::At(ticks.collect()))
            .with_grid(true);
        let mut x = strip::temperature_axis();
        if panels.is_empty() {
            x.label.clear();
        }
        let mut panel = Panel::new(format!("Offset {part}"), area, x, y);
        if panels.is_empty() {
            panel.note = scene.document.exaggeration.note().unwrap_or_default();
        }
        let mut signs = Vec::new();
        let mut labels = Vec::new();
        for (index, (offsets, source)) in all.iter().enumerate() {
            let tag = things.tag(PlotItem::Sensor(id(source)));
            let height = |offset: &LocusDeviation| value(offset).map_or(f64::NAN, |value| strip::root(factor * value));
            let point = |(kelvin, offset): &(Kelvin, Option<LocusDeviation>)| match offset {
                Some(offset) => [strip::along(kelvin.get()), height(offset)],
                None => [f64::NAN; 2],
            };
            let points: Vec<[f64; 2]> = offsets.iter().map(point).collect();
            let below = scene.extrapolated_below(source.kind, &source.name).map(|(below, _)| below);
            let [measured, beyond] = split(&points, |index| offsets[index].0.get(), below);
            let line = |points| {
                let line = Mark::new(tag, &source.label, Shape::Line { points, closed: false });
                line.with_stroke(source.role, source.width)
            };
            panel.marks.push(line(measured));
            if !beyond.is_empty() {
                panel.marks.push(line(beyond).with_dash(Dash::Dotted));
            }
            signs.extend(strip::marked(&points, index).map(|at| sign(tag, source, at, 4.0, source.role)));
            if let Some((kelvin, offset)) = minimum(scene, source) {
                let at = [strip::along(kelvin), height(&offset)];
                let tag = things.tag(PlotItem::Radiator { source: id(source), kelvin: kelvin.round() });
                let ring = Shape::Points { points: vec![at], marker: Marker::Circle, radius: 3.5 };
                let ring = Mark::new(tag, format!("{}: minimum at {kelvin:.0} K", source.label), ring);
                signs.push(ring.with_stroke(source.role, 1.5).with_fill(chromascope_figure::InkRole::Plot));
                let places = Place::around(at, [-1.0, -1.0], 7.0);
                labels.push(Label::new(format!("{kelvin:.0} K"), source.role, places));
            }
        }
        let mut panel = panel.with_headroom(2.0);
        let [low, high] = panel.y.range;
        for top in [low, high] {
            panel.marks.push(strip::cursor(marked, top));
        }
        panel.marks.extend(signs);
        let mut placed = Labels::new(&panel);
        for label in labels.iter().filter(|_| panels.is_empty()) {
            placed.place(label);
        }
        panel.marks.extend(placed.into_marks());
        panels.push(panel);
    }
    // Both plots begin at one place.
    let begin = |panel: &Panel| Projection::new(panel, 1.0).plot.min[0];
    let left = panels.iter().map(begin).fold(0.0, f64::max);
    for panel in &mut panels {
        panel.area.min[0] += left - begin(panel);
    }
    Ok(Built { panels, things })
}

/// The offset of a sensor's locus at a temperature.
type Row = (String, Kelvin, Option<LocusDeviation>, bool);

const COLUMNS: [Field<Row>; 5] = [
    Field::new("sensor", |(sensor, ..)| sensor.as_str().into()),
    Field::quantity(["temperature_k", "temperature", "K"], |(_, kelvin, ..)| kelvin.get().into()),
    Field {
        decimals: Some(6),
        ..Field::quantity(["duv", "Duv", ""], |(.., offset, _)| offset.and_then(|at| at.duv).into())
    },
    Field::quantity(["cct_error_k", "along", "K"], |(.., offset, _)| offset.and_then(|at| at.cct_error_k).into()),
    Field::new("extrapolated", |(.., extrapolated)| extrapolated.to_string().into()),
];

pub(super) fn table(scene: &Scene<'_>) -> Table {
    let rows = sources(scene).unwrap_or_default().into_iter().flat_map(|source| {
        let below = scene.extrapolated_below(source.kind, &source.name).map_or(0.0, |(below, _)| below);
        let row = |(kelvin, offset): (Kelvin, _)| (source.label.clone(), kelvin, offset, kelvin.get() < below);
        let all = Scene::locus_temperatures().ok().and_then(|temperatures| offsets(scene, &source, temperatures));
        all.unwrap_or_default().into_iter().map(row).collect::<Vec<Row>>()
    });
    Table::of(&COLUMNS, rows)
}
