//! A blackbody through a sensor.

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::{LocusPoint, compare};
use egui::Ui;

use super::numbers::Point;
use super::points::{blackbody_of, points_table};
use super::{assumptions, failure, head, label_of, no_difference, reference_id, show_assumptions};
use crate::document::Light;
use crate::format::fixed;
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::plot_item::{PlotItem, SensorId};

pub(super) fn show(ui: &mut Ui, id: &SensorId, kelvin: f64, context: &mut PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    head(ui, id, context);
    widgets::note(ui, format!("blackbody, {} K = {} mired", fixed(kelvin, 0), fixed(1e6 / kelvin, 1)));
    let reference = reference_id(&scene);
    let is_reference = reference == *id;
    let points = blackbody_of(&scene, id, kelvin).and_then(|own| Ok((own, blackbody_of(&scene, &reference, kelvin)?)));
    let (own, seen) = match points {
        Ok((Some(own), Some(seen))) => (own, seen),
        Ok(_) => return,
        Err(error) => return failure(ui, &theme, &error.to_string()),
    };
    if own.xy.is_none() {
        widgets::note(ui, "Chromaticity undefined (X + Y + Z = 0).");
    }
    let mut points = vec![Point::of_blackbody("reference", Some(seen))];
    if !is_reference {
        distance(ui, id, &own, &seen, context);
        points.push(Point::of_blackbody(id.kind.label(), Some(own)));
    }
    match scene.document.light {
        Light::BlackBody => widgets::note(ui, "The light on the scene is a blackbody of the marked temperature."),
        Light::Daylight => {
            widgets::note(
                ui,
                "The light on the scene is daylight of the marked temperature; the locus is that of blackbodies.",
            );
        }
        Light::Set(_) => {}
    }
    points_table(ui, points, &PlotItem::Radiator { source: id.clone(), kelvin }, context);
    let label = label_of(&scene, id);
    show_assumptions(ui, assumptions(&scene, id, &label));
}

fn distance(ui: &mut Ui, id: &SensorId, own: &LocusPoint, seen: &LocusPoint, context: &PaneContext<'_>) {
    let comparable = context.scene.comparable(id.kind, &id.name).unwrap_or(Ok(()));
    let xy = comparable.and_then(|()| compare::difference(Metric::XY, seen, own));
    let uv = comparable.and_then(|()| compare::difference(Metric::UV_PRIME, seen, own));
    match (xy, uv) {
        (Ok(xy), Ok(uv)) => {
            ui.label(format!("Δxy {}   Δu′v′ {}", fixed(xy, 4), fixed(uv, 4)))
                .on_hover_text("Distance from the reference at the same temperature");
        }
        (Err(reason), _) | (_, Err(reason)) => widgets::note(ui, no_difference(reason)),
    }
}
