//! How large an error may be, and how each camera keeps it.

use chromascope_core::render::plan::{Explanation, Verdict};
use egui::{CollapsingHeader, Rect, RichText, ScrollArea, Ui, UiBuilder, Vec2};

use super::PaneContext;
use crate::action::{Action, RenderAction};
use crate::document::render::{QualityChoice, RenderSettings};
use crate::figures::pareto::duration;
use crate::laboratory::plans;
use crate::theme::UNIT;
use crate::widgets;
use crate::workspaces::PaneKind;

/// Shows the pane in its rectangle.
pub fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::pane(ui, PaneKind::Tolerance, rect, context, |_, _| {});
    let inner = body.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let mut child = ui.new_child(UiBuilder::new().id_salt("tolerance").max_rect(inner));
    child.set_clip_rect(body.intersect(ui.clip_rect()));
    ScrollArea::vertical().id_salt("tolerance").auto_shrink(false).show(&mut child, |ui| {
        ui.set_max_width(inner.width() - 2.0 * UNIT);
        choice(ui, context);
        ui.add_space(2.0 * UNIT);
        sources(ui, context);
    });
}

/// The tolerance, and whether pictures keep it.
fn choice(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let settings = context.scene.document.render.clone();
    let on = settings.quality == QualityChoice::Tolerance;
    ui.label("Largest error of the spectral integral, relative to its peak");
    ui.spacing_mut().slider_width = (ui.available_width() - 84.0).max(60.0);
    let id = ui.make_persistent_id("tolerance field");
    if let Some(to) = widgets::tolerance::field(ui, id, settings.tolerance, "", "", context) {
        set(context, "Tolerance", |settings| {
            settings.tolerance = to;
            settings.quality = QualityChoice::Tolerance;
        });
    }
    ui.add_space(UNIT);
    let mut keep = on;
    let hint = "Off, pictures are made as Quality in Render's Scene pane says.";
    if ui.checkbox(&mut keep, "Pictures keep it").on_hover_text(hint).changed() {
        let quality = if keep { QualityChoice::Tolerance } else { QualityChoice::Full };
        set(context, "Quality", |settings| settings.quality = quality);
    }
    let words = if on {
        "The core takes the cheapest way whose error, checked for each camera under this light with this material, is within it."
            .to_owned()
    } else {
        format!("Now: {}. Below is what the tolerance would take.", settings.quality.label())
    };
    ui.label(RichText::new(words).small().color(context.theme.weak));
}

fn set(context: &mut PaneContext<'_>, what: &'static str, change: impl FnOnce(&mut RenderSettings)) {
    let mut to = context.scene.document.render.clone();
    change(&mut to);
    context.push(Action::Render(RenderAction::Set { what, to: Box::new(to) }));
}

/// Each source with its plan.
fn sources(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let weak = context.theme.weak;
    let Some(pictures) = context.planned_pictures() else {
        ui.label("Nothing is rendered: tick a camera, and choose a mesh in Render.");
        return;
    };
    let Some(plans) = context.laboratory.plans(&pictures) else {
        ui.label(RichText::new("Looking for the cheapest ways…").color(weak));
        ui.ctx().request_repaint_after(std::time::Duration::from_millis(100));
        return;
    };
    for (source, plan) in context.scene.rendered_sources().iter().zip(plans.iter()) {
        ui.horizontal(|ui| {
            widgets::source_key(ui, source, &context.theme);
            ui.strong(&source.label);
        });
        match plan {
            Ok(Some(explanation)) => explained(ui, &source.name, explanation, context),
            Ok(None) => {
                ui.label(RichText::new("No sample takes a spectral integral.").small().color(weak));
            }
            Err(error) => {
                ui.label(RichText::new(format!("{error}.")).small().color(context.theme.error));
            }
        }
        ui.add_space(UNIT);
    }
}

fn explained(ui: &mut Ui, name: &str, explanation: &Explanation, context: &PaneContext<'_>) {
    let small = |words: String| RichText::new(words).small();
    ui.label(small(format!("{}.", capital(&plans::sentence(explanation)))));
    let certified = format!("{:.1e}", explanation.certified()).replace('-', "−");
    ui.label(small(format!("Certified: error below {certified} of the peak.")))
        .on_hover_text("The largest error seen in the check against the sum over all wavelengths, times a margin.");
    let id = ui.make_persistent_id(("rejected", name));
    CollapsingHeader::new(small(format!("{} other ways", explanation.rejected.len()))).id_salt(id).show(ui, |ui| {
        for candidate in &explanation.rejected {
            let error = candidate.certified.map_or_else(|| "not checked".to_owned(), |e| format!("error {e:.0e}"));
            let why = match candidate.verdict {
                Verdict::Chosen => "chosen",
                Verdict::TooInexact => "not exact enough",
                Verdict::TooSlow => "slower",
            };
            let cost = duration(candidate.sample_ns * 1e-9);
            let words =
                format!("{}: {}, {cost} a sample, {why}", plans::words(&candidate.method), error.replace('-', "−"));
            ui.label(small(words).color(context.theme.weak));
        }
    });
}

fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
