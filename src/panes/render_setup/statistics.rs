//! What was computed for the pictures on show, and what was left out.

use chromascope_core::render::Quality;
use egui::{Grid, RichText, Ui};

use crate::panes::PaneContext;
use crate::theme::UNIT;
use crate::widgets::lines::fixed;

/// Stages in the order they follow each other, as counted and as shown.
const STAGES: [(&str, &str); 8] = [
    ("mesh", "mesh"),
    ("shadow tree", "shadow tree"),
    ("visibility", "visibility"),
    ("geometry", "angles, shadows"),
    ("shading", "surface"),
    ("diffuse table", "tables"),
    ("camera image", "signals"),
    ("picture", "pixels"),
];

/// Shows the group.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    ui.spacing_mut().interact_size.y = 14.0;
    let Some(shot) = context.view.render.shot.clone() else { return };
    let Some(made) = shot.made() else { return };
    let (geometry, shading) = (made.geometry, made.shading);
    let quality = shot.query.shading.quality;
    let wavelengths = match quality {
        Quality::Within(_) => "by each camera's plan",
        Quality::Preview | Quality::Full if shading.table == 0 && shading.sums == 0 => "closed form, none of 401",
        Quality::Preview | Quality::Full => "9 of 401 for the table",
        Quality::Fine => "15 of 401",
        Quality::Exact | Quality::Regimes => "401 of 401",
    };
    rows(
        ui,
        "samples",
        &[
            ("Lit", geometry.lit.to_string()),
            ("Facing away", geometry.facing_away.to_string()),
            ("In shadow", format!("{}, {} rays", geometry.shadowed, geometry.rays)),
            ("Below threshold", shading.dark.to_string()),
            ("Closed form", shading.moments.to_string()),
            ("Table", shading.table.to_string()),
            ("Sums", shading.sums.to_string()),
            ("Plan", shading.planned.to_string()),
            ("Specular terms", format!("{}, {} skipped", shading.mirrors, shading.mirrors_skipped)),
            ("Wavelengths", wavelengths.to_owned()),
        ],
    );
    let counts = context.studio.counts();
    let mut stages = Vec::new();
    for (name, words) in STAGES {
        if let Some((_, count)) = counts.iter().find(|(counted, _)| *counted == name) {
            let each = count.own_time.as_secs_f64() * 1e3 / count.misses.max(1) as f64;
            let time = if context.view.fixed_clock { String::new() } else { format!(", {} ms each", fixed(each, 1)) };
            stages.push((words, format!("computed {}×, reused {}×{time}", count.misses, count.hits)));
        }
    }
    ui.label(RichText::new("Since the start").small().color(context.theme.weak));
    rows(ui, "stages", &stages);
}

fn rows(ui: &mut Ui, id: &str, rows: &[(&str, String)]) {
    Grid::new(id).num_columns(2).spacing([3.0 * UNIT, 0.5 * UNIT]).show(ui, |ui| {
        for (name, value) in rows {
            ui.label(RichText::new(*name).small());
            ui.label(RichText::new(value).small());
            ui.end_row();
        }
    });
}
