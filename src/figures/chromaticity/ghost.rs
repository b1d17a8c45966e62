//! The Planckian locus of a sensor of the library that is looked at but not compared.

use chromascope_figure::{Dash, Ink, InkRole, Label, Mark, Place, Shape, TextSize};

use super::drawing::Drawing;
use super::labels::{Rank, label};
use crate::plot_item::{PickIndex, PlotItem, SensorId};

/// Coordinates beyond this are not drawn.
const FAR: f64 = 3.0;

/// Adds the locus with its name, dashed. The diagram's ranges do not take it in: nothing moves while the pointer is on a list.
pub(super) fn add(drawing: &mut Drawing<'_>) {
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
    let items = [&drawing.view.hovered, &drawing.view.selected].into_iter().flatten();
    let mut sensors = items.filter_map(|item| if let PlotItem::Sensor(id) = item { Some(id) } else { None });
    let document = drawing.scene.document;
    sensors.find(|id| document.compared(id.kind, &id.name).is_none()).cloned()
}
