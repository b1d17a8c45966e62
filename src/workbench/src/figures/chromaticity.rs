//! The diagram: loci with temperature ticks, patches with tails to the reference's points, and what surrounds them.

mod drawing;
mod fit;
mod ground;
mod loci;
mod pixel;
mod points;
pub mod shown;
mod whites;

use std::collections::BTreeSet;

use chromascope_core::colorimetry::{UvPrime, Xy, Xyz};
use chromascope_core::light::Cct;
use chromascope_figure::{
    Axis, AxisRanges, Cell, Field, Figure, FigureRoom, Ink, InkRole, LegendEntry, LegendPlace, Mark, Numbers, Panel,
    Projection, Rect, Shape, Stroke, Table, Tag, Ticks, auto_ticks,
};

use chromascope_core::spectral::sensor::TAIL_BELOW_K;

use super::kind::FigureKind;
use super::look::FigureLook;
use crate::document::{Diagram, SetKind, TransformChoice};
use crate::plot_item::PickIndex;
use crate::scene::{ComparedSensor, Scene};
pub use drawing::id;
use drawing::{Drawing, Frame};
use shown::{DiagramFit, Ranges};

pub use fit::{fit_key, fitted};
pub use points::{blackbody_distance, brief, describe, distance_symbol, label};

/// The diagram with the items of its marks.
#[derive(Clone, Debug)]
pub struct Built {
    pub panel: Panel,
    pub things: PickIndex,
    /// Sensors that could not be drawn, with why.
    pub refused: Vec<String>,
    /// Places among the marks of the lines of Planckian loci: their points are the locus's points, in its order.
    pub loci: BTreeSet<usize>,
    /// The data enlarged, in the free half beside the whole diagram.
    pub lens: Option<Box<Built>>,
}

pub const fn coordinates(diagram: Diagram) -> [&'static str; 2] {
    match diagram {
        Diagram::Xy => ["x", "y"],
        Diagram::UvPrime => ["u′", "v′"],
    }
}

/// Builds the diagram for an area of the given size. Shows what the look holds, else a fit.
pub fn build(scene: &Scene<'_>, look: &FigureLook, size: [f64; 2]) -> Built {
    let fit = look.fit;
    let held = look.diagram.fit().unwrap_or_else(|| fit::fitted(scene, &fit::fit_key(scene, fit)));
    let area = Rect::from_min_size([0.0, 0.0], size);
    let frame = Frame::around(held.shown, size);
    let has_lens = fit == DiagramFit::Whole && look.diagram.zoomed.is_none();
    let place = lens_area(scene.document.diagram, &frame, held.data).filter(|_| has_lens);
    let drawn = look.diagram.zoomed.map_or(frame, |ranges| Frame { ranges, ..frame });
    let mut drawing = draw(scene, look, drawn, place.is_some());
    if look.diagram.zoomed.is_none() {
        points::add_arrows(&mut drawing);
    }
    let lens = place.map(|area| {
        let frame = Frame::around(held.data, [area.width(), area.height()]);
        let [x, y] = frame.ranges;
        let part = Shape::Rect { min: [x[0], y[0]], max: [x[1], y[1]] };
        drawing.marks.push(Mark::new(PickIndex::NONE, "part in the lens", part).with_stroke(InkRole::Weak, 1.0));
        Box::new(finish(draw(scene, look, frame, false), "Data, enlarged", area, frame))
    });
    let mut built = Built { lens, ..finish(drawing, "Chromaticity", area, frame) };
    built.panel.note =
        scene.document.exaggeration.note().filter(|_| scene.document.overlays.patches).unwrap_or_default();
    if let Some(lens) = &built.lens {
        clear_for_lens(&mut built.panel, lens.panel.area, &frame);
    }
    built
}

fn draw<'a>(scene: &'a Scene<'a>, look: &'a FigureLook, frame: Frame, sketch: bool) -> Drawing<'a> {
    let mut drawing = Drawing::new(scene, look, frame, sketch);
    ground::add(&mut drawing);
    if !sketch {
        whites::add(&mut drawing);
    }
    let sources = scene.visible_sources();
    if scene.document.overlays.camera_spectral_loci {
        loci::add_monochromatic(&mut drawing, &sources);
    }
    if scene.document.overlays.loci {
        loci::add(&mut drawing, &sources);
        loci::add_ghost(&mut drawing);
    }
    if scene.document.overlays.patches {
        points::add(&mut drawing, &sources);
    }
    if let Some(pictures) = look.pictures.as_deref().filter(|_| !sketch) {
        pixel::add(&mut drawing, pictures, &sources);
    }
    drawing
}

fn finish(drawing: Drawing<'_>, name: &str, area: Rect, frame: Frame) -> Built {
    let Drawing { diagram, frame: drawn, mut marks, points, small, labels, things, refused, loci, .. } = drawing;
    marks.extend(points.into_iter().chain(small));
    let ([x, y], [x_range, y_range]) = (coordinates(diagram), drawn.ranges);
    let mut panel = Panel::new(name, area, Axis::new(x, x_range), Axis::new(y, y_range));
    panel.equal_aspect = true;
    panel.marks = marks;
    let texts = drawing::placed(labels, &panel);
    panel.marks.extend(texts);
    [panel.x.range, panel.y.range] = frame.ranges;
    Built { panel, things, refused, loci, lens: None }
}

/// Area of the lens in the panel: free space right of the whole diagram, as high as the data need, if it is large enough.
fn lens_area(diagram: Diagram, frame: &Frame, [x, y]: Ranges) -> Option<Rect> {
    const LEAST: [f64; 2] = [200.0, 170.0];
    const GAP: f64 = 8.0;
    // Room for a wavelength.
    const BESIDE: f64 = 32.0;
    // Room for the label of the axis.
    const BELOW: f64 = 22.0;
    let [end, _] = frame.at(fit::full_extent(diagram));
    let min = [Projection::LEFT + end + BESIDE, GAP];
    let width = Projection::LEFT + frame.size[0] - GAP - min[0];
    let needed = (width - Projection::LEFT) * (y[1] - y[0]) / (x[1] - x[0]) + Projection::BOTTOM;
    let height = needed.max(LEAST[1]).min(frame.size[1] - GAP - BELOW);
    (width >= LEAST[0] && height >= LEAST[1]).then(|| Rect::from_min_size(min, [width, height]))
}

/// Clears the ground of the lens and ends the horizontal axis with the diagram.
fn clear_for_lens(panel: &mut Panel, area: Rect, frame: &Frame) {
    let corner = |at: [f64; 2]| frame.value([at[0] - Projection::LEFT, at[1]]);
    let ground = Shape::Rect { min: corner([area.min[0], area.max[1]]), max: corner([area.max[0], area.min[1]]) };
    panel.marks.push(Mark::new(PickIndex::NONE, "ground of the lens", ground).with_fill(InkRole::Plot));
    let ticks = auto_ticks(panel.x.range, frame.size[0]).into_iter();
    let ticks = ticks.filter(|tick| tick.value < corner(area.min)[0]).map(|tick| (tick.value, tick.label));
    panel.x.ticks = Ticks::At(ticks.collect());
}

/// Overview of the whole diagram with the visible range: `[x, y]` ranges.
pub fn overview(scene: &Scene<'_>, shown: [[f64; 2]; 2], size: [f64; 2]) -> Panel {
    let diagram = scene.document.diagram;
    let look = FigureLook::default();
    let ranges = fit::full_extent(diagram).map(|end| [0.0, end]);
    let mut drawing = Drawing::new(scene, &look, Frame { ranges, size }, true);
    ground::add_area(&mut drawing);
    let [x, y] = shown;
    let frame = Shape::Rect { min: [x[0], y[0]], max: [x[1], y[1]] };
    drawing.marks.push(Mark::new(PickIndex::NONE, "shown", frame).with_stroke(InkRole::Weak, 1.0));
    let [x, y] = ranges.map(Axis::hidden);
    let mut panel = Panel::new("Overview", Rect::from_min_size([0.0, 0.0], size), x, y);
    panel.equal_aspect = true;
    panel.marks = drawing.marks;
    panel
}

/// Factor on lines and markers.
const SMALLER: f64 = 0.5;

/// The diagram of a scene, fitted to its data, in small: tint, loci and patches.
pub fn thumbnail(scene: &Scene<'_>, size: [f64; 2]) -> Panel {
    let mut panel = build(scene, &FigureLook::default(), size).panel;
    (panel.x, panel.y) = (Axis::hidden(panel.x.range), Axis::hidden(panel.y.range));
    panel.marks.retain(|mark| !matches!(mark.shape, Shape::Text { .. }) && !mark.name.ends_with(", leader"));
    for mark in &mut panel.marks {
        mark.halo = None;
        if let Some(stroke) = &mut mark.stroke {
            stroke.width *= SMALLER;
        }
        if let Shape::Points { radius, .. } = &mut mark.shape {
            *radius *= SMALLER;
        }
    }
    panel
}

/// The size of a saved figure in points, with the strip below the diagram.
const SIZE: [f64; 2] = [640.0, 480.0];
/// Height in points of the strip below it.
pub const STRIP: f64 = 136.0;

pub static KIND: FigureKind =
    FigureKind::new("chromaticity", "The chromaticity diagram with loci and patches", figure).in_report();

/// The figure as it is saved: diagram, strip, legend, caption, and the numbers of all points.
#[allow(clippy::unnecessary_wraps, reason = "other kinds of figures can have nothing to draw")]
fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let strip = room.strip && super::strip::build(scene, [SIZE[0], STRIP]).is_some();
    Some(figure_sized(scene, look, room, room.size(SIZE, if strip { STRIP } else { 0.0 })))
}

/// The figure with a diagram of a size in points.
pub fn figure_sized(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom, size: [f64; 2]) -> Figure {
    let mut document = scene.document.clone();
    document.overlays.patches &= room.patches;
    document.overlays.loci &= room.loci;
    let scene = &Scene { document: &document, ..*scene };
    // Neither hovering nor a pinned pixel is shown on paper.
    let mut paper = FigureLook { fit: look.fit, has_legend: !room.names, ..FigureLook::default() };
    match room.ranges {
        AxisRanges::Full => paper.fit = DiagramFit::Whole,
        AxisRanges::Screen => {
            paper.diagram = look.diagram.for_paper(&fit_key(scene, look.fit));
            paper.diagram.zoomed = paper.diagram.zoomed.map(|part| Frame::centered(part, size).ranges);
        }
    }
    let mut built = build(scene, &paper, size);
    if let Some([x, y]) = paper.diagram.zoomed {
        (built.panel.x.range, built.panel.y.range) = (x, y);
    }
    let mut figure = Figure::new("Chromaticity", size);
    let shown = Projection::new(&built.panel, 1.0);
    figure.panels.push(built.panel);
    figure.panels.extend(built.lens.map(|lens| lens.panel));
    if let Some(mut strip) = super::strip::build(scene, [size[0], STRIP]).filter(|_| room.strip) {
        strip.panel.area = Rect::from_min_size([0.0, size[1]], [size[0], STRIP]);
        figure.size[1] += STRIP;
        figure.panels.push(strip.panel);
    }
    figure.legend = scene.visible_sources().iter().map(legend_entry).collect();
    figure.legend_place = LegendPlace::Outside;
    let has = |end: &str| figure.panels.iter().flat_map(|panel| &panel.marks).any(|mark| mark.name.ends_with(end));
    let lines =
        if has(", line") { " Large markers on loci tell them apart, at no particular temperature." } else { "" };
    let tails = if has("tail") { " Thin lines: to the reference." } else { "" };
    let has_minima = figure.panels.iter().flat_map(|panel| &panel.marks).any(|mark| mark.name.contains(": minimum at"));
    let minima = if has_minima { " Rings in the strip: minima." } else { "" };
    let beyond = if has(", outside") { " Hollow triangles: points beyond the axes, or at their ends." } else { "" };
    figure.caption =
        format!("{}{lines}{tails}{minima}{beyond}{}", caption(scene), scene.document.exaggeration.sentence());
    figure.table = table(scene);
    if room.numbers == Numbers::Visible {
        keep_inside(&mut figure.table, scene.document.diagram, [shown.x, shown.y]);
    }
    figure
}

/// Removes rows whose point lies outside of these ranges, or nowhere.
fn keep_inside(table: &mut Table, diagram: Diagram, ranges: Ranges) {
    let axes = match diagram {
        Diagram::Xy => ["x", "y"],
        Diagram::UvPrime => ["u_prime", "v_prime"],
    };
    let places = axes.map(|axis| table.place(axis));
    let is_inside = |row: &[Cell], place: Option<usize>, [low, high]: [f64; 2]| {
        place.and_then(|place| row.get(place)?.number()).is_some_and(|value| (low..=high).contains(&value))
    };
    table.rows.retain(|row| places.iter().zip(ranges).all(|(place, range)| is_inside(row, *place, range)));
}

fn legend_entry(source: &ComparedSensor) -> LegendEntry {
    key(source, if source.is_reference { format!("{} (reference)", source.label) } else { source.label.clone() })
}

/// A sensor's marker at a place.
pub fn sign(tag: Tag, source: &ComparedSensor, at: [f64; 2], radius: f64, ink: impl Into<Ink> + Copy) -> Mark {
    let shape = Shape::Points { points: vec![at], marker: source.marker, radius };
    let mark = Mark::new(tag, &source.label, shape).with_stroke(ink, 1.5);
    if source.marker.has_inside() { mark.with_fill(ink) } else { mark }
}

/// A sensor's line and marker with a name.
pub fn key(source: &ComparedSensor, name: String) -> LegendEntry {
    LegendEntry {
        name,
        stroke: Some(Stroke::solid(source.role, source.width)),
        marker: Some(source.marker),
        fill: source.marker.has_inside().then(|| source.role.into()),
    }
}

/// The conditions of a diagram in sentences.
pub fn caption(scene: &Scene<'_>) -> String {
    let overlays = scene.document.overlays;
    let temperature = scene.document.temperature_k;
    let parts = [
        Some(viewing_conditions(scene)),
        overlays.patches.then(|| patches_words(scene)),
        Some(transform_words(scene)),
        overlays.loci.then(|| {
            format!("{} Dots: 1000, 2000, 3000, 5000, 10000, 20000 K. Rings: {temperature:.0} K.", loci_words(scene))
        }),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" ")
}

/// Range and normalization of the loci in sentences, and where they are extrapolated.
pub fn loci_words(scene: &Scene<'_>) -> String {
    let cut =
        |source: &&ComparedSensor| source.visible && scene.extrapolated_below(source.kind, &source.name).is_some();
    let cut: Vec<String> = scene.sources().iter().filter(cut).map(|source| source.label.clone()).collect();
    let dotted = if cut.is_empty() {
        String::new()
    } else {
        format!(" Dotted below {TAIL_BELOW_K:.0} K, where the sensitivity table ends too early: {}.", cut.join(", "))
    };
    format!("Loci from 1000 to 20000 K, normalized to {}.{dotted}", scene.locus_balance())
}

/// The conditions in sentences.
pub fn conditions(scene: &Scene<'_>) -> String {
    [viewing_conditions(scene), patches_words(scene), transform_words(scene)].join(" ")
}

/// The patches in a sentence.
pub fn patches_words(scene: &Scene<'_>) -> String {
    let part = if scene.subset().is_some() { "five of " } else { "" };
    format!("Patches: {part}{}.", scene.document.chart)
}

/// The color transform in a sentence.
pub fn transform_words(scene: &Scene<'_>) -> String {
    let transform = match &scene.document.transform {
        TransformChoice::Paper => "Paper matrix (Eq 13), CIE observers drawn directly".to_owned(),
        TransformChoice::Observer(name) if scene.document.correction.is_default_fit() => {
            format!("3×3 matrices fitted to {name} over 190 training reflectances")
        }
        TransformChoice::Observer(name) => scene.document.correction.describe(name),
    };
    format!("Color transform: {transform}.")
}

/// The conditions that have nothing to do with patches and diagram, in sentences.
pub fn viewing_conditions(scene: &Scene<'_>) -> String {
    let white = scene.document.white.name();
    format!("Reference: {}. Light: {}. White balance: {white}.", scene.document.reference, scene.light_name())
}

/// A blackbody or a patch through a sensor.
struct Point {
    sensor: String,
    /// Temperature in kelvins of a blackbody.
    kelvin: Option<f64>,
    patch: Option<String>,
    xy: Option<Xy>,
    uv: Option<UvPrime>,
    /// The same point through the reference, where the two can be compared.
    reference: (Option<Xy>, Option<UvPrime>),
    extrapolated: Option<bool>,
    cct: Option<Cct>,
}

const COLUMNS: [Field<Point>; 13] = [
    Field::new("sensor", |point| point.sensor.as_str().into()),
    Field::new("kind", |point| if point.patch.is_some() { "patch" } else { "locus" }.into()),
    Field::quantity(["temperature_k", "temperature", "K"], |point| point.kelvin.into()),
    Field::new("patch", |point| point.patch.as_deref().map_or(Cell::Empty, Cell::from)),
    Field::new("x", |point| point.xy.map(|xy| xy.x).into()),
    Field::new("y", |point| point.xy.map(|xy| xy.y).into()),
    Field::quantity(["u_prime", "u′", ""], |point| point.uv.map(|uv| uv.u).into()),
    Field::quantity(["v_prime", "v′", ""], |point| point.uv.map(|uv| uv.v).into()),
    Field::quantity(["distance_xy", "Δxy", ""], |point| {
        point.xy.zip(point.reference.0).map(|(a, b)| a.distance(b)).into()
    }),
    Field::quantity(["distance_uv_prime", "Δu′v′", ""], |point| {
        point.uv.zip(point.reference.1).map(|(a, b)| a.distance(b)).into()
    }),
    Field::new("extrapolated", |point| {
        point.extrapolated.map_or(Cell::Empty, |extrapolated| extrapolated.to_string().into())
    }),
    Field::quantity(["cct_k", "CCT", "K"], |point| point.cct.map(|cct| cct.temperature.get()).into()),
    // Of a blackbody it is 0 but for rounding.
    Field { decimals: Some(6), ..Field::quantity(["duv", "Duv", ""], |point| point.cct.map(|cct| cct.duv).into()) },
];

pub(super) fn table(scene: &Scene<'_>) -> Table {
    let mut points = Vec::new();
    let reference_locus = scene.locus(SetKind::Observer, &scene.document.reference).ok();
    let reference_patches = scene.patch_colors(SetKind::Observer, &scene.document.reference).unwrap_or_default();
    for source in &scene.visible_sources() {
        let comparable = scene.is_comparable(source.kind, &source.name);
        let below = scene.extrapolated_below(source.kind, &source.name).map_or(0.0, |(below, _)| below);
        let sensor = || source.label.clone();
        if let Ok(locus) = scene.locus(source.kind, &source.name) {
            let ccts = temperatures(scene, locus.points.iter().map(|point| point.xyz));
            let reference = |place: usize| reference_locus.as_ref()?.points.get(place).filter(|_| comparable);
            points.extend(locus.points.iter().zip(ccts).enumerate().map(|(place, (point, cct))| Point {
                sensor: sensor(),
                kelvin: Some(point.temperature.get()),
                patch: None,
                xy: point.xy,
                uv: point.uv,
                reference: reference(place).map_or((None, None), |point| (point.xy, point.uv)),
                extrapolated: Some(point.temperature.get() < below),
                cct,
            }));
        }
        let (Ok(colors), Ok(patches)) = (scene.patch_colors(source.kind, &source.name), scene.patches()) else {
            continue;
        };
        let ccts = temperatures(scene, colors.iter().map(|color| color.xyz));
        let reference = |place: usize| reference_patches.get(place).filter(|_| comparable);
        let colors = colors.iter().zip(patches.patches()).zip(ccts).enumerate();
        points.extend(colors.map(|(place, ((color, patch), cct))| Point {
            sensor: sensor(),
            kelvin: None,
            patch: Some(patch.name.clone()),
            xy: color.xy,
            uv: color.uv,
            reference: reference(place).map_or((None, None), |color| (color.xy, color.uv)),
            extrapolated: None,
            cct,
        }));
    }
    Table::of(&COLUMNS, points)
}

/// CCT and Duv of each color, for the CIE 1931 observer.
fn temperatures(scene: &Scene<'_>, colors: impl Iterator<Item = Xyz>) -> Vec<Option<Cct>> {
    let colors: Vec<Option<Xyz>> = colors.map(Some).collect();
    match scene.temperatures_of(&colors) {
        Ok(found) => found.into_iter().map(Result::ok).collect(),
        Err(_) => vec![None; colors.len()],
    }
}
