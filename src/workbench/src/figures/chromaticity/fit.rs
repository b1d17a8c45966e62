//! The part of the diagram that is fitted into its pane.

use super::drawing::{LEAST, id, place};
use super::shown::{DiagramFit, Fit, FitKey};
use crate::document::{Diagram, SetKind};
use crate::scene::{ComparedSensor, Scene};

/// Coordinates that the data's fit takes in; real colors lie between 0 and 0.85.
const NEAR: std::ops::RangeInclusive<f64> = LEAST..=1.1;
/// Half of a mark as a share of a fitted range.
const MARK: f64 = 0.035;
const FULL_EXTENT: [[f64; 2]; 2] = [[0.76, 0.86], [0.65, 0.60]];

/// Right and upper ends of the whole diagram in its coordinates.
pub(super) fn full_extent(diagram: Diagram) -> [f64; 2] {
    FULL_EXTENT[usize::from(diagram == Diagram::UvPrime)]
}

/// Choices that the fit belongs to: the reference and the sensors that can be compared with it, all if none can.
pub fn fit_key(scene: &Scene<'_>, fit: DiagramFit) -> FitKey {
    let sources = scene.sources();
    let compared = |source: &ComparedSensor| scene.is_comparable(source.kind, &source.name);
    let (fitted, other): (Vec<_>, Vec<_>) = sources.iter().partition(|source| source.is_reference || compared(source));
    let all = fitted.iter().all(|source| source.is_reference);
    let mut sensors: Vec<_> = fitted.into_iter().chain(other.into_iter().filter(|_| all)).map(id).collect();
    sensors.sort_by(|a, b| a.name.cmp(&b.name));
    let document = scene.document;
    let own = document.own.iter().find(|set| SetKind::of_own(set) == SetKind::Chart && set.name == document.chart);
    let patches = (document.chart.clone(), own.and_then(|set| set.fingerprint), document.subset);
    FitKey { diagram: document.diagram, fit, sensors, patches }
}

/// Ranges that hold the visible loci and patches of the fitted sensors.
pub fn fitted(scene: &Scene<'_>, key: &FitKey) -> Fit {
    let whole = full_extent(key.diagram).map(|end| [0.0, end]);
    // A matrix fitted under an extreme light can throw a camera's points far out; they do not shrink all others to a dot.
    let (sources, mut near) = (scene.visible_sources(), Vec::new());
    let (fitted, others): (Vec<_>, Vec<_>) = sources.iter().partition(|source| key.sensors.contains(&id(source)));
    for source in fitted {
        near.extend(loci(scene, source, key.diagram).into_iter().chain(patches(scene, source, key.diagram)));
    }
    near.retain(|p| p.iter().all(|v| NEAR.contains(v)));
    if near.is_empty() {
        return Fit { shown: whole, data: whole };
    }
    let mut data = [0, 1].map(|axis| {
        let values = near.iter().map(|point| point[axis]);
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        let pad = 0.08 * (high - low).max(0.05);
        [(low - pad).max(LEAST), high + pad]
    });
    // Marks of the others at an edge are not cut.
    let inner = data;
    for at in others.into_iter().flat_map(|source| patches(scene, source, key.diagram)) {
        let edges = [0, 1].map(|axis: usize| {
            let reach = MARK * (inner[axis][1] - inner[axis][0]);
            [at[axis] - reach, at[axis] + reach]
        });
        if (0..2).all(|axis| edges[axis][1] >= inner[axis][0] && edges[axis][0] <= inner[axis][1]) {
            data = [0, 1].map(|axis| [data[axis][0].min(edges[axis][0]).max(LEAST), data[axis][1].max(edges[axis][1])]);
        }
    }
    Fit { shown: if key.fit == DiagramFit::Whole { whole } else { data }, data }
}

fn loci(scene: &Scene<'_>, source: &ComparedSensor, diagram: Diagram) -> Vec<[f64; 2]> {
    let locus = scene.locus(source.kind, &source.name).ok().filter(|_| scene.document.overlays.loci);
    locus.iter().flat_map(|locus| &locus.points).filter_map(|p| place(diagram, p.xy, p.uv)).collect()
}

fn patches(scene: &Scene<'_>, source: &ComparedSensor, diagram: Diagram) -> Vec<[f64; 2]> {
    let colors = scene.patch_colors(source.kind, &source.name).ok().filter(|_| scene.document.overlays.patches);
    colors.iter().flatten().filter_map(|color| place(diagram, color.xy, color.uv)).collect()
}
