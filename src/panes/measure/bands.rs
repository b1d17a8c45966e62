//! Passes over narrow bands: their files, the end of the scale, curves, and what was looked for in them.

use std::sync::Arc;

use chromascope_core::recovery::NarrowBandRecovery;
use egui::{DragValue, Label, RichText, Ui};

use super::{camera, change, heading, results, wrong};
use crate::document::measurement::Measurement;
use crate::export::measured;
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::panes::widgets::table::DataTable;
use crate::workspaces::PaneKind;

const CURVES: &str = "Band: two standard deviations. Dotted: share of the data, below 100 % where a cell was saturated or dark and is filled \
    from the library's tables. Dashed: the nearest table.";

pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    heading(ui, "Narrow bands");
    camera(ui, context);
    let measurement = &context.scene.document.measurement;
    for (index, pass) in measurement.passes.iter().enumerate() {
        ui.push_id(index, |ui| {
            ui.horizontal_wrapped(|ui| {
                let means = pass.pictures.map_or_else(String::new, |pictures| format!(": {pictures}"));
                ui.label(format!("Pass {}: {}, {} bands{means}", index + 1, pass.file, pass.bands.len()));
                if ui.button("Remove").on_hover_text("Remove this pass from the measurement").clicked() {
                    change(context, "Remove a pass", |measurement| {
                        measurement.passes.remove(index);
                    });
                }
            })
        });
    }
    clip(ui, measurement, context);
    if measurement.passes.iter().any(|pass| pass.pictures.is_some()) {
        widgets::note(
            ui,
            "Another part of the pictures counts by a line # region: LEFT,TOP,WIDTH,HEIGHT in the table; then open it again.",
        );
    }
    widgets::note(ui, "The session keeps the values of the bands.");
    if measurement.clip.is_none() {
        return heading(ui, "Name the raw value from which on a mean is saturated: the end of the camera's scale.");
    }
    let found = match answer(context) {
        Err(why) => return wrong(ui, &why, context),
        Ok(None) => return drop(ui.weak("Computing…")),
        Ok(Some(found)) => found,
    };
    results::added(ui, &found.curves, context);
    results::plot(ui, &found.curves, found.shift_nm.as_ref().map(|(_, table)| table.as_str()), context);
    ui.add(Label::new(RichText::new(CURVES).small().color(context.theme.weak)).wrap());
    for line in measured::band_conditions(&found) {
        ui.add(Label::new(RichText::new(line).small()).wrap());
    }
    heading(ui, "Bands");
    let table = measured::bands(&found);
    DataTable::new(PaneKind::MEASURE, "Measured bands", &table).with_scrolling().show_compact(ui, context);
}

/// The end of the scale, with the largest mean on offer where several have it.
fn clip(ui: &mut Ui, measurement: &Measurement, context: &mut PaneContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        ui.label("Saturated from");
        let mut level = measurement.clip.unwrap_or_default();
        let field = ui.add(DragValue::new(&mut level).range(0.0..=1e12).speed(10.0).update_while_editing(false));
        widgets::labeled(&field, egui::Role::SpinButton, "Raw value from which on a mean is saturated");
        let lit = || measurement.passes.iter().flat_map(|pass| &pass.bands).flat_map(|band| band.lit);
        let most = lit().fold(0.0, f64::max);
        let count = lit().filter(|mean| *mean == most).count();
        let is_offered = measurement.clip.is_none() && count > 1;
        if is_offered && ui.button(format!("{most}, the largest, of {count} means")).clicked() {
            level = most;
        }
        let clip = Some(level).filter(|level| *level > 0.0);
        if clip != measurement.clip {
            change(context, "Saturation of the bands", |measurement| measurement.clip = clip);
        }
    });
}

/// The curves of the bands as they are, once they are computed.
pub(super) fn answer(context: &PaneContext<'_>) -> Result<Option<Arc<NarrowBandRecovery>>, String> {
    let Some(query) = context.scene.measured_passes() else { return Ok(None) };
    let made = context.later.ask("Measure: bands", vec![query]).current()?;
    made.map(|made| (*made).clone().map_err(|error| error.to_string())).transpose()
}
