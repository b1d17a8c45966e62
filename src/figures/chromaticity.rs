//! The diagram: loci with temperature ticks, patches with tails to the reference's points, and what surrounds them.

mod drawing;
mod ground;
mod loci;
mod pixel;
mod points;
mod whites;

use std::collections::BTreeSet;

use chromascope_core::colorimetry::{UvPrime, Xy, Xyz};
use chromascope_core::light::Cct;
use chromascope_figure::{
    Axis, Cell, Figure, InkRole, LegendEntry, LegendPlace, Mark, Panel, Rect, Shape, Stroke, Table, Ticks,
};

use chromascope_core::spectral::sensor::TAIL_BELOW_K;

use crate::document::{Diagram, TransformChoice};
use crate::plot_item::PickIndex;
use crate::render_service::RenderedFrame;
use crate::scene::{ComparedSensor, Scene};
use crate::view::{DiagramFit, View};
use drawing::Drawing;
pub(crate) use drawing::id;

pub use points::{blackbody_distance, describe, distance_symbol, patch_xy};

/// The diagram with what its marks stand for.
#[derive(Clone, Debug)]
pub struct Built {
    /// The panel.
    pub panel: Panel,
    /// What its marks stand for.
    pub things: PickIndex,
    /// Sensors that could not be drawn, with why.
    pub refused: Vec<String>,
    /// Places among the marks of the lines of Planckian loci: their points are the locus's points, in its order.
    pub loci: BTreeSet<usize>,
}

/// Coordinates that the data's fit takes in; real colors lie between 0 and 0.85.
const NEAR: std::ops::RangeInclusive<f64> = -0.25..=1.1;

/// The names of the coordinates.
pub const fn coordinates(diagram: Diagram) -> [&'static str; 2] {
    match diagram {
        Diagram::Xy => ["x", "y"],
        Diagram::UvPrime => ["u′", "v′"],
    }
}

/// Builds the diagram for an area of the given size, with the pinned pixel of these pictures.
pub fn build(scene: &Scene<'_>, view: &View, pictures: Option<&RenderedFrame>, size: [f64; 2]) -> Built {
    let diagram = scene.document.diagram;
    let mut drawing = Drawing {
        scene,
        view,
        diagram,
        marks: Vec::new(),
        things: PickIndex::default(),
        refused: Vec::new(),
        loci: BTreeSet::new(),
        data: Vec::new(),
    };
    ground::add(&mut drawing);
    whites::add(&mut drawing);
    let sources: Vec<ComparedSensor> = scene.sources().into_iter().filter(|source| source.visible).collect();
    if scene.document.overlays.camera_spectral_loci {
        loci::add_monochromatic(&mut drawing, &sources);
    }
    if scene.document.overlays.loci {
        loci::add(&mut drawing, &sources);
    }
    if scene.document.overlays.patches {
        points::add(&mut drawing, &sources);
    }
    if let Some(pictures) = pictures {
        pixel::add(&mut drawing, pictures, &sources);
    }
    let [x_range, y_range] = ranges(&drawing, view.saved.diagram_fit);
    let [x, y] = coordinates(diagram).map(|name| Axis::new(name, [0.0, 1.0]).with_ticks(Ticks::Auto).with_grid(true));
    let mut panel = Panel::new("Chromaticity", Rect::from_min_size([0.0, 0.0], size), x, y);
    panel.x.range = x_range;
    panel.y.range = y_range;
    panel.equal_aspect = true;
    panel.marks = drawing.marks;
    Built { panel, things: drawing.things, refused: drawing.refused, loci: drawing.loci }
}

/// What the diagram shows: the data, or all of the spectral locus.
fn ranges(drawing: &Drawing<'_>, fit: DiagramFit) -> [[f64; 2]; 2] {
    let whole = match drawing.diagram {
        Diagram::Xy => [[-0.03, 0.78], [-0.03, 0.87]],
        Diagram::UvPrime => [[-0.02, 0.65], [-0.02, 0.62]],
    };
    // A matrix fitted under an extreme light can throw a camera's points far out; they do not shrink all others to a dot.
    let near: Vec<[f64; 2]> = drawing.data.iter().copied().filter(|p| p.iter().all(|v| NEAR.contains(v))).collect();
    if fit == DiagramFit::Whole || near.is_empty() {
        return whole;
    }
    [0, 1].map(|axis| {
        let values = near.iter().map(|point| point[axis]);
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        let pad = 0.08 * (high - low).max(0.05);
        [low - pad, high + pad]
    })
}

/// The whole diagram in small, with what is shown of it: `[x, y]` ranges.
pub fn overview(scene: &Scene<'_>, shown: [[f64; 2]; 2], size: [f64; 2]) -> Panel {
    let diagram = scene.document.diagram;
    let view = View::default();
    let mut drawing = Drawing {
        scene,
        view: &view,
        diagram,
        marks: Vec::new(),
        things: PickIndex::default(),
        refused: Vec::new(),
        loci: BTreeSet::new(),
        data: Vec::new(),
    };
    ground::add_area(&mut drawing, 1.0);
    let [x, y] = shown;
    let frame = Shape::Rect { min: [x[0], y[0]], max: [x[1], y[1]] };
    drawing.marks.push(Mark::new(PickIndex::NONE, "shown", frame).with_stroke(InkRole::Text, 1.5));
    let [x, y] = ranges(&drawing, DiagramFit::Whole);
    let mut panel = Panel::new("Overview", Rect::from_min_size([0.0, 0.0], size), Axis::hidden(x), Axis::hidden(y));
    panel.equal_aspect = true;
    panel.marks = drawing.marks;
    panel
}

/// The size of a saved figure in points, with the strip below the diagram.
const SIZE: [f64; 2] = [640.0, 480.0];
const STRIP: f64 = 120.0;

/// The figure as it is saved: diagram, strip, legend, caption, and the numbers of all points.
pub fn figure(scene: &Scene<'_>, view: &View) -> Figure {
    // What the pointer is on has no place on paper.
    let paper = View { saved: view.saved.clone(), ..View::default() };
    let built = build(scene, &paper, None, SIZE);
    let mut figure = Figure::new("Chromaticity", SIZE);
    figure.panels.push(built.panel);
    if let Some(mut strip) = super::strip::build(scene, [SIZE[0], STRIP]) {
        strip.panel.area = Rect::from_min_size([0.0, SIZE[1]], [SIZE[0], STRIP]);
        figure.size[1] += STRIP;
        figure.panels.push(strip.panel);
    }
    figure.legend = scene.sources().iter().filter(|source| source.visible).map(legend_entry).collect();
    figure.legend_place = LegendPlace::Outside;
    figure.caption = caption(scene);
    figure.table = table(scene);
    figure
}

fn legend_entry(source: &ComparedSensor) -> LegendEntry {
    LegendEntry {
        name: if source.is_reference { format!("{} (reference)", source.label) } else { source.label.clone() },
        stroke: Some(Stroke::solid(source.role, source.width)),
        marker: Some(source.marker),
        fill: source.marker.has_inside().then(|| source.role.into()),
    }
}

/// The conditions of a diagram in sentences.
pub fn caption(scene: &Scene<'_>) -> String {
    let cut =
        |source: &&ComparedSensor| source.visible && scene.extrapolated_below(source.kind, &source.name).is_some();
    let cut: Vec<String> = scene.sources().iter().filter(cut).map(|source| source.label.clone()).collect();
    let dotted = if cut.is_empty() {
        String::new()
    } else {
        format!(" Dotted below {TAIL_BELOW_K:.0} K, where the sensitivity table ends too early: {}.", cut.join(", "))
    };
    format!("{} Loci from 1000 to 20000 K, normalized to {}.{dotted}", conditions(scene), scene.locus_balance())
}

/// The conditions in sentences.
pub fn conditions(scene: &Scene<'_>) -> String {
    let transform = match &scene.document.transform {
        TransformChoice::Paper => "Paper matrix (Eq 13), CIE observers drawn directly".to_owned(),
        TransformChoice::Observer(name) if scene.document.correction.is_default_fit() => {
            format!("3×3 matrices fitted to {name} over 190 training reflectances")
        }
        TransformChoice::Observer(name) => scene.document.correction.describe(name),
    };
    format!("{} Patches: {}. Color transform: {transform}.", viewing_conditions(scene), scene.document.chart)
}

/// The conditions that have nothing to do with patches and diagram, in sentences.
fn viewing_conditions(scene: &Scene<'_>) -> String {
    let white = scene.document.white.name();
    format!("Reference: {}. Light: {}. White balance: {white}.", scene.document.reference, scene.light_name())
}

/// All points as numbers.
fn table(scene: &Scene<'_>) -> Table {
    let mut table = Table::new([
        "sensor",
        "kind",
        "temperature_k",
        "patch",
        "x",
        "y",
        "u_prime",
        "v_prime",
        "distance_xy",
        "distance_uv",
        "extrapolated",
        "cct_k",
        "duv",
    ]);
    let reference_locus = scene.locus(crate::document::SetKind::Observer, &scene.document.reference).ok();
    for source in scene.sources().iter().filter(|source| source.visible) {
        let comparable = matches!(scene.comparable(source.kind, &source.name), Ok(Ok(())));
        let near = |xy: Option<Xy>, uv: Option<UvPrime>, txy: Option<Xy>, tuv: Option<UvPrime>| {
            let xy = xy.zip(txy).filter(|_| comparable).map(|(a, b)| a.distance(b));
            let uv = uv.zip(tuv).filter(|_| comparable).map(|(a, b)| a.distance(b));
            [Cell::from(xy), Cell::from(uv)]
        };
        let below = scene.extrapolated_below(source.kind, &source.name).map_or(0.0, |(below, _)| below);
        if let Ok(locus) = scene.locus(source.kind, &source.name) {
            let ccts = temperatures(scene, locus.points.iter().map(|point| point.xyz));
            for ((index, point), cct) in locus.points.iter().enumerate().zip(ccts) {
                let reference = reference_locus.as_ref().and_then(|reference| reference.points.get(index));
                let [dxy, duv] = near(point.xy, point.uv, reference.and_then(|t| t.xy), reference.and_then(|t| t.uv));
                let temperature = Cell::from(point.temperature.get());
                let extrapolated = if point.temperature.get() < below { "true" } else { "false" };
                let places = row(&source.label, "locus", temperature, Cell::Empty, point.xy, point.uv, dxy, duv);
                table.push(places.into_iter().chain([Cell::from(extrapolated)]).chain(cct));
            }
        }
        let reference =
            scene.patch_colors(crate::document::SetKind::Observer, &scene.document.reference).unwrap_or_default();
        let (Ok(colors), Ok(patches)) = (scene.patch_colors(source.kind, &source.name), scene.patches()) else {
            continue;
        };
        let ccts = temperatures(scene, colors.iter().map(|color| color.xyz));
        for ((index, (color, patch)), cct) in colors.iter().zip(patches.patches()).enumerate().zip(ccts) {
            let reference = reference.get(index);
            let [dxy, duv] = near(color.xy, color.uv, reference.and_then(|t| t.xy), reference.and_then(|t| t.uv));
            let places =
                row(&source.label, "patch", Cell::Empty, Cell::from(patch.name.as_str()), color.xy, color.uv, dxy, duv);
            table.push(places.into_iter().chain([Cell::Empty]).chain(cct));
        }
    }
    table
}

/// CCT and Duv of each color, for the CIE 1931 observer.
fn temperatures(scene: &Scene<'_>, colors: impl Iterator<Item = Xyz>) -> Vec<[Cell; 2]> {
    let colors: Vec<Option<Xyz>> = colors.map(Some).collect();
    let cells = |cct: Option<Cct>| [cct.map(|cct| cct.temperature.get()), cct.map(|cct| cct.duv)].map(Cell::from);
    match scene.temperatures_of(&colors) {
        Ok(found) => found.into_iter().map(|cct| cells(cct.ok())).collect(),
        Err(_) => colors.iter().map(|_| cells(None)).collect(),
    }
}

#[expect(clippy::too_many_arguments, reason = "a row has these columns")]
fn row(
    source: &str,
    kind: &str,
    temperature: Cell,
    patch: Cell,
    xy: Option<Xy>,
    uv: Option<UvPrime>,
    dxy: Cell,
    duv: Cell,
) -> [Cell; 10] {
    [
        Cell::from(source),
        Cell::from(kind),
        temperature,
        patch,
        Cell::from(xy.map(|p| p.x)),
        Cell::from(xy.map(|p| p.y)),
        Cell::from(uv.map(|p| p.u)),
        Cell::from(uv.map(|p| p.v)),
        dxy,
        duv,
    ]
}
