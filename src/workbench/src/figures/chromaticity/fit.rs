//! The part of the diagram that is fitted into its pane.

use super::drawing::{LEAST, id, place};
use super::shown::{DiagramFit, Fit, FitKey};
use crate::document::{Diagram, SetKind};
use crate::scene::{ComparedSensor, Scene};

/// Coordinates that the data's fit takes in; real colors lie between 0 and 0.85.
const NEAR: std::ops::RangeInclusive<f64> = LEAST..=1.1;
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
    let near: Vec<[f64; 2]> = points(scene, key).into_iter().filter(|p| p.iter().all(|v| NEAR.contains(v))).collect();
    if near.is_empty() {
        return Fit { shown: whole, data: whole };
    }
    let data = [0, 1].map(|axis| {
        let values = near.iter().map(|point| point[axis]);
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        let pad = 0.08 * (high - low).max(0.05);
        [(low - pad).max(LEAST), high + pad]
    });
    Fit { shown: if key.fit == DiagramFit::Whole { whole } else { data }, data }
}

fn points(scene: &Scene<'_>, key: &FitKey) -> Vec<[f64; 2]> {
    let overlays = scene.document.overlays;
    let mut points = Vec::new();
    for source in scene.visible_sources().iter().filter(|source| key.sensors.contains(&id(source))) {
        if let Some(locus) = scene.locus(source.kind, &source.name).ok().filter(|_| overlays.loci) {
            points.extend(locus.points.iter().filter_map(|p| place(key.diagram, p.xy, p.uv)));
        }
        if let Some(colors) = scene.patch_colors(source.kind, &source.name).ok().filter(|_| overlays.patches) {
            points.extend(colors.iter().filter_map(|c| place(key.diagram, c.xy, c.uv)));
        }
    }
    points
}
