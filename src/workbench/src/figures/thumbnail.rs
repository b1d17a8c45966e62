//! Figures in small, without words.

use chromascope_figure::{Axis, Panel, Shape};

use super::chromaticity::build;
use super::look::FigureLook;
use crate::scene::Scene;

/// Factor on lines and markers.
const SMALLER: f64 = 0.5;

/// The diagram of a scene, fitted to its data, in small: tint, loci and patches.
pub fn diagram(scene: &Scene<'_>, size: [f64; 2]) -> Panel {
    let mut panel = build(scene, &FigureLook::default(), size).panel;
    (panel.x, panel.y) = (Axis::hidden(panel.x.range), Axis::hidden(panel.y.range));
    panel.marks.retain(|mark| !matches!(mark.shape, Shape::Text { .. }));
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
