//! Computed and skipped work of the visible pictures.

use egui::{RichText, Ui};

use crate::format::fixed;
use crate::panes::context::PaneContext;
use crate::panes::widgets::table::show_pairs;
use crate::render_service::made::MadePictures;
use crate::workspaces::PaneKind;

/// Stages in the order they follow each other, as counted and as shown.
const STAGES: [(&str, &str); 8] = [
    ("mesh", "mesh"),
    ("shadow tree", "shadow tree"),
    ("visibility", "visibility"),
    ("geometry", "angles, shadows"),
    ("shading", "surface"),
    ("plan", "integration methods"),
    ("camera image", "signals"),
    ("picture", "pixels"),
];

/// Shows the group.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    ui.spacing_mut().interact_size.y = 14.0;
    let Some(shot) = context.studio.frame().cloned() else { return };
    if let Some(image) = shot.made().and_then(MadePictures::image) {
        let words = crate::figures::render::image_words(&shot, image);
        ui.label(RichText::new(words).small());
        return;
    }
    let Some(made) = shot.made().and_then(MadePictures::mesh) else { return };
    let (geometry, shading) = (made.geometry, made.shading);
    show_pairs(
        ui,
        PaneKind::RENDER_SETTINGS,
        "samples",
        &[
            ("Lit", geometry.lit.to_string()),
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
