//! Statistics of the visible pictures: samples, integration methods, computed and reused stages.

use chromascope_figure::{Cell, Column, Table};
use egui::{Rect, RichText, Ui};

use super::context::{Pane, PaneContext};
use crate::command::Command;
use crate::panes::widgets;
use crate::panes::widgets::table::{DataTable, show_pairs};
use crate::render_service::made::MadePictures;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

/// Stages in the order they follow each other, as counted and as shown.
const STAGES: [(&str, &str); 14] = [
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
    ("locus", "loci"),
    ("radiator signals", "blackbodies"),
    ("patch colors", "patches"),
];

pub const PANE: Pane = Pane::new(PaneKind::STATISTICS, "Statistics", show);

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    widgets::scrolling_pane(ui, &PANE, rect, context, |ui, context| {
        ui.spacing_mut().item_spacing.y = 0.5 * UNIT;
        pictures(ui, context);
        stages(ui, context);
    });
}

/// Samples and methods of the pictures on show.
fn pictures(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let Some(shot) = context.render_service.frame().cloned() else {
        ui.label("No picture was rendered yet.");
        context.button(ui, "Show pictures", "", Command::GoTo(PaneKind::RENDER));
        return;
    };
    if let Some(image) = shot.made().and_then(MadePictures::image) {
        ui.label(RichText::new(crate::figures::render::image_words(&shot, image)).small());
        return;
    }
    let Some(made) = shot.made().and_then(MadePictures::mesh) else { return };
    let (geometry, shading) = (made.geometry, made.shading);
    let samples = [
        ("Lit", geometry.lit.to_string()),
        ("Lit from behind", geometry.through.to_string()),
        ("Facing away", geometry.facing_away.to_string()),
        ("In shadow", format!("{}, {} rays", geometry.shadowed, geometry.rays)),
        ("Below threshold", shading.dark.to_string()),
        ("Spectral integrals", shading.spectral.to_string()),
        ("Specular terms", format!("{}, {} skipped", shading.coherent_samples, shading.coherent_skipped)),
    ];
    widgets::note(ui, "Samples");
    show_pairs(ui, PANE.kind, "samples", &samples, context);
    widgets::note(ui, "Integration methods");
    for (source, image) in shot.sources.iter().zip(&made.images) {
        if let Some(image) = image {
            ui.label(RichText::new(format!("{}: {}", source.label, image.plan().explanation())).small());
        }
    }
}

fn stages(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let counts = context.scene.results.counts();
    let each = Column { decimals: Some(1), ..Column::in_unit("each", "ms") };
    let mut table = Table::new(["since the start".into(), "computed".into(), "reused".into(), each]);
    for (name, words) in STAGES {
        if let Some(count) = counts.get(name) {
            let each = count.own_time.as_secs_f64() * 1e3 / count.misses.max(1) as f64;
            let each = if context.view.fixed_clock { Cell::Empty } else { each.into() };
            table.push([words.into(), Cell::Number(count.misses as f64), Cell::Number(count.hits as f64), each]);
        }
    }
    if table.rows.is_empty() {
        return;
    }
    ui.add_space(UNIT);
    DataTable::new(PANE.kind, "stages", &table).show_compact(ui, context);
}
