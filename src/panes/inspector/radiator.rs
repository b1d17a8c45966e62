//! A blackbody through a sensor.

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::{LocusPoint, Temperatures, compare};
use chromascope_core::units::Kelvin;
use egui::Ui;

use super::numbers::Row;
use super::{
    assumptions, buttons, copy_text, failure, head, label_of, no_difference, note, numbers, reference_id,
    show_assumptions,
};
use crate::document::Light;
use crate::format::fixed;
use crate::panes::context::PaneContext;
use crate::plot_item::SensorId;
use crate::scene::{Scene, SceneError};

/// One point of a sensor's locus.
pub(super) fn point_of(scene: &Scene<'_>, id: &SensorId, kelvin: f64) -> Result<Option<LocusPoint>, SceneError> {
    let temperatures = Temperatures::List(vec![Kelvin::new(kelvin)?]);
    Ok(scene.locus_at(id.kind, &id.name, temperatures)?.points.first().copied())
}

/// The rows that points of loci have.
pub(super) fn rows_of(scene: &Scene<'_>, points: &[Option<LocusPoint>]) -> Vec<Row> {
    let row = |name, take: &dyn Fn(&LocusPoint) -> Option<f64>| Row {
        name,
        decimals: 4,
        cells: points.iter().map(|point| point.as_ref().and_then(take)).collect(),
    };
    let mut rows = vec![
        row("x", &|p| p.xy.map(|xy| xy.x)),
        row("y", &|p| p.xy.map(|xy| xy.y)),
        row("u′", &|p| p.uv.map(|uv| uv.u)),
        row("v′", &|p| p.uv.map(|uv| uv.v)),
    ];
    rows.extend(numbers::temperatures(scene, points.iter().map(|point| point.map(|point| point.xyz))));
    rows
}

pub(super) fn show(ui: &mut Ui, id: &SensorId, kelvin: f64, context: &mut PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    head(ui, id, context);
    note(ui, &theme, format!("blackbody, {} K = {} mired", fixed(kelvin, 0), fixed(1e6 / kelvin, 1)));
    let reference = reference_id(&scene);
    let is_reference = reference == *id;
    let points = point_of(&scene, id, kelvin).and_then(|own| Ok((own, point_of(&scene, &reference, kelvin)?)));
    let (own, seen) = match points {
        Ok((Some(own), Some(seen))) => (own, seen),
        Ok(_) => return,
        Err(error) => return failure(ui, &theme, &error.to_string()),
    };
    if own.xy.is_none() {
        note(ui, &theme, "Chromaticity undefined (X + Y + Z = 0).");
    }
    let (heads, points) = if is_reference {
        (vec!["reference".to_owned()], vec![Some(own)])
    } else {
        (vec!["reference".to_owned(), id.kind.singular().to_owned()], vec![Some(seen), Some(own)])
    };
    if !is_reference {
        distance(ui, id, &own, &seen, context);
    }
    let rows = rows_of(&scene, &points);
    numbers::show(ui, "blackbody", &heads, &rows, context);
    match scene.document.light {
        Light::BlackBody => note(ui, &theme, "The light on the scene is a blackbody of the marked temperature."),
        Light::Daylight => {
            note(
                ui,
                &theme,
                "The light on the scene is daylight of the marked temperature; the locus is that of blackbodies.",
            );
        }
        Light::Set(_) => {}
    }
    if buttons(ui, context) {
        copy_text(ui, numbers::to_tsv(&heads, &rows), context);
    }
    let label = label_of(&scene, id);
    show_assumptions(ui, &theme, assumptions(&scene, id, &label));
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
        (Err(reason), _) | (_, Err(reason)) => note(ui, &context.theme, no_difference(reason)),
    }
}
