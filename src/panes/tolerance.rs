//! Tolerance, and the method that satisfies it for each camera.

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::render::plan::{Candidate, Verdict};
use chromascope_core::render::{Quality, QualityLevel, Shadows};
use chromascope_measure::pareto::duration;
use egui::{CollapsingHeader, Rect, RichText, Ui};

use super::context::{Pane, PaneContext, set_render as set};
use crate::format::capitalized;
use crate::panes::widgets;
use crate::profiler::SceneRunJob;
use crate::profiler::plans::{PlanAnswer, Planned, PlansQuery};
use crate::scene::ComparedSensor;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

pub const PANE: Pane = Pane::new(PaneKind::TOLERANCE, "Tolerance", show);

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    widgets::scrolling_pane(ui, &PANE, rect, context, |ui, context| {
        choice(ui, context);
        ui.add_space(2.0 * UNIT);
        sources(ui, context);
    });
}

fn choice(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let settings = context.scene.document.render.clone();
    let on = settings.quality == QualityLevel::Tolerance;
    ui.label("Largest error of a picture, relative to its brightest sample").on_hover_text(TOLERANCE);
    ui.spacing_mut().slider_width = (ui.available_width() - 100.0).max(60.0);
    let id = ui.make_persistent_id("tolerance field");
    let hint = "The tolerance for the methods listed below. It applies to renders once the box below is ticked.";
    if let Some(to) = widgets::tolerance::field(ui, id, settings.tolerance, "", hint, context) {
        set(context, "Tolerance", |settings| settings.tolerance = to);
    }
    ui.add_space(UNIT);
    let mut keep = on;
    let hint = "On: pictures are rendered within the tolerance. Off: at quality Full; the settings of pictures have \
                more qualities.";
    if ui.checkbox(&mut keep, "Apply to renders").on_hover_text(hint).changed() {
        let quality = if keep { QualityLevel::Tolerance } else { QualityLevel::Full };
        set(context, "Quality", |settings| settings.quality = quality);
    }
    let words = if on {
        "Each camera uses the fastest method whose estimated error, checked for this light and material, stays \
         within the tolerance."
            .to_owned()
    } else {
        format!("Current quality: {}. Below: the methods that the tolerance would use.", settings.quality.label())
    };
    widgets::note(ui, words);
}

struct NothingRendered;

/// The plan of each rendered sensor, as pictures within the document's tolerance would take it; `Ok(None)` until one is
/// made. An error where nothing is rendered.
fn plans(context: &PaneContext<'_>) -> Result<Option<Vec<PlanAnswer>>, NothingRendered> {
    let own = context.meshes.chosen(&context.scene.document.render.mesh);
    let quality = RelTolerance::new(context.scene.document.render.tolerance).ok().map(Quality::Within);
    let orbit = context.view.saved.render.orbit;
    let pictures = quality.and_then(|quality| SceneRunJob::pictures_of(&context.scene, own.as_ref(), orbit, quality));
    let mut pictures = pictures.ok_or(NothingRendered)?;
    let geometry = &mut pictures.shading.geometry;
    let frame = context.render_service.frame();
    let visible = frame.and_then(|frame| Some(&frame.query.mesh()?.shading.geometry)).filter(|visible| {
        visible.visibility.mesh == geometry.visibility.mesh
            && visible.lighting == geometry.lighting
            && (visible.shadows == Shadows::Off) == (geometry.shadows == Shadows::Off)
    });
    // All angles of the current pictures are cached; those of the next pictures soon will be.
    let soon = context.render_service.is_looked_at()
        && context.render_service.failure().is_none()
        && !context.view.render.cancelled;
    if let Some(visible) = visible {
        geometry.clone_from(visible);
    }
    Ok(PlansQuery::ask(context.later, &pictures, visible.is_some() || !soon))
}

fn sources(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let weak = context.theme.weak;
    let plans = match plans(context) {
        Ok(Some(plans)) => plans,
        Ok(None) => {
            ui.label(RichText::new("Choosing methods…").color(weak));
            ui.ctx().request_repaint_after(std::time::Duration::from_millis(100));
            return;
        }
        Err(NothingRendered) => {
            ui.label("Nothing is rendered: tick a camera, and choose a mesh in Pictures.");
            return;
        }
    };
    for (source, plan) in context.scene.rendered_sources().iter().zip(plans.iter()) {
        ui.horizontal(|ui| {
            widgets::source_key(ui, source, &context.theme);
            ui.strong(&source.label);
        });
        match plan {
            Ok(Some(planned)) => explained(ui, &source.name, planned, context),
            Ok(None) => {}
            Err(error) => {
                ui.label(RichText::new(format!("{error}.")).small().color(context.theme.error));
            }
        }
        ui.add_space(UNIT);
    }
    not_rendered(ui, context);
}

fn not_rendered(ui: &mut Ui, context: &PaneContext<'_>) {
    let rendered = context.scene.rendered_sources();
    let is_rendered =
        |source: &ComparedSensor| rendered.iter().any(|r| (r.kind, &r.name) == (source.kind, &source.name));
    for source in context.scene.sources().iter().filter(|source| source.visible && !is_rendered(source)) {
        let why = match context.scene.comparable(source.kind, &source.name) {
            Ok(Err(reason)) => format!("No picture beside this reference: {reason}."),
            Err(error) => format!("No picture: {error}."),
            Ok(Ok(())) => continue,
        };
        ui.horizontal(|ui| {
            widgets::source_key(ui, source, &context.theme);
            ui.strong(&source.label);
        });
        widgets::note(ui, why);
        ui.add_space(UNIT);
    }
}

fn explained(ui: &mut Ui, name: &str, planned: &Planned, context: &PaneContext<'_>) {
    let small = |words: String| RichText::new(words).small();
    let bounds = format!("{}.", capitalized(&planned.bounds.words().replace('-', "−")));
    let Some(explanation) = &planned.explanation else {
        ui.label(small(bounds).color(context.theme.weak));
        return;
    };
    ui.label(small(format!("{}.", capitalized(&explanation.to_string())))).on_hover_text(METHODS);
    ui.label(small(bounds)).on_hover_text(BOUNDS);
    let parts: Vec<String> = explanation.parts().map(cost).collect();
    let costs = if parts.is_empty() { "nothing".to_owned() } else { parts.join("; below that, ") };
    ui.label(small(format!("Estimated: {costs}.")).color(context.theme.weak)).on_hover_text(ESTIMATED);
    if explanation.rejected.is_empty() {
        return;
    }
    let id = ui.make_persistent_id(("rejected", name));
    let count = explanation.rejected.len();
    let plural = if count == 1 { "method" } else { "methods" };
    let title = format!("{count} other {plural}");
    CollapsingHeader::new(small(title)).id_salt(id).show(ui, |ui| {
        for candidate in &explanation.rejected {
            ui.label(small(rejected(candidate)).color(context.theme.weak)).on_hover_text(ESTIMATED);
        }
    });
}

const TOLERANCE: &str = "Allowed error of a sample, relative to the sum over all wavelengths. The diffuse integral \
                         J(κ, β) is largest at β = 0, in the specular direction: error bounds are estimated relative \
                         to that peak, J(κ, 0), at the sample's κ, and are tighter where no sample is that bright. S \
                         itself is accurate to 1e−13.";
const METHODS: &str = "κ is the roughness g at 550 nm and the angles of a sample; S(g, b) is the diffuse sum of Eq 2, \
                    evaluated to the stated error.";
const BOUNDS: &str = "Diffuse component: the largest error found against the sum over all wavelengths, times a \
                         margin, relative to J(κ, 0) at the sample's κ. Where no sample is near the specular \
                         direction, a tighter bound is used so that the error relative to the brightest pixel stays \
                         within tolerance. Specular lobes are within the tolerance of the brightest sample of the \
                         picture. Signals are stored in single precision (24 bits).";
const ESTIMATED: &str = "Times are from a cost model, not measured here; Methods measures them. The method with the \
                         least total time, preparation included, is used.";

fn cost(candidate: &Candidate) -> String {
    let [sample, making] = [candidate.sample_ns, candidate.making_ns].map(|ns| duration(ns * 1e-9));
    if candidate.making_ns > 0.0 {
        format!("{sample} a sample, {making} preparation")
    } else {
        format!("{sample} a sample, no preparation")
    }
}

fn rejected(candidate: &Candidate) -> String {
    let error = candidate.error_bound.map_or_else(|| "not checked".to_owned(), |e| format!("error {e:.0e}"));
    let why = match candidate.verdict {
        Verdict::Chosen => "chosen",
        Verdict::TooInexact => "not accurate enough",
        Verdict::TooSlow => "slower in total",
    };
    let method = candidate.method.to_string();
    format!("{method}: {}, {}, {why}", error.replace('-', "−"), cost(candidate))
}
