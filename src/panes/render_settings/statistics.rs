//! Computed and skipped work of the visible pictures.

use egui::{RichText, Ui};

use crate::format::fixed;
use crate::panes::context::PaneContext;
use crate::panes::widgets::table::show_pairs;
use crate::workspaces::PaneKind;

/// Stages in the order they follow each other, as counted and as shown.
const STAGES: [(&str, &str); 11] = [
    ("mesh", "mesh"),
    ("shadow tree", "shadow tree"),
    ("visibility", "visibility"),
    ("geometry", "angles, shadows"),
    ("sky visibility", "sky from vertices"),
    ("sky", "sky from samples"),
    ("sky reflectance", "reflectance of sky"),
    ("shading", "surface"),
    ("plan", "integration methods"),
    ("camera image", "signals"),
    ("picture", "pixels"),
];

/// Shows the group.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    ui.spacing_mut().interact_size.y = 14.0;
    let Some(shot) = context.studio.frame().cloned() else { return };
    let Some(made) = shot.made() else { return };
    let (geometry, shading) = (made.geometry, made.shading);
    show_pairs(
        ui,
        PaneKind::RENDER_SETTINGS,
        "samples",
        &[
            ("Lit", geometry.lit.to_string()),
            ("Lit from behind", geometry.through.to_string()),
            ("Facing away", geometry.facing_away.to_string()),
            ("In shadow", format!("{}, {} rays", geometry.shadowed, geometry.rays)),
            ("Below threshold", shading.dark.to_string()),
            ("Spectral integrals", shading.spectral.to_string()),
            ("Specular terms", format!("{}, {} skipped", shading.mirrors, shading.mirrors_skipped)),
        ],
        context,
    );
    ui.label(RichText::new("Integration methods").small().color(context.theme.weak));
    for (source, image) in shot.sources.iter().zip(&made.images) {
        if let Some(image) = image {
            ui.label(RichText::new(format!("{}: {}", source.label, image.plan().explanation())).small());
        }
    }
    let counts = context.counts();
    let mut stages = Vec::new();
    for (name, words) in STAGES {
        if let Some((_, count)) = counts.iter().find(|(counted, _)| *counted == name) {
            let each = count.own_time.as_secs_f64() * 1e3 / count.misses.max(1) as f64;
            let time = if context.view.fixed_clock { String::new() } else { format!(", {} ms each", fixed(each, 1)) };
            stages.push((words, format!("computed {}×, reused {}×{time}", count.misses, count.hits)));
        }
    }
    ui.label(RichText::new("Since the start").small().color(context.theme.weak));
    show_pairs(ui, PaneKind::RENDER_SETTINGS, "stages", &stages, context);
}
