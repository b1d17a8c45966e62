//! Light, patches and sensitivities over one axis.

use egui::{Align2, Id, Rect, ScrollArea, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::figures::spectra::{self, Built};
use crate::paint::{self, PlotOptions};
use crate::panes::widgets;
use crate::theme::UNIT;
use crate::view::SpectraLayout;
use crate::workspaces::PaneKind;

const LEAST: f32 = 64.0;
const REACH: f32 = 8.0;

pub const PANE: Pane = Pane::new(PaneKind::SPECTRA, "Spectra", show).figure(&spectra::KIND).table();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::pane(ui, &PANE, rect, context, |ui, context| {
        widgets::switch(ui, &mut context.view.saved.spectra_layout);
    });
    let body = body.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    if widgets::figure_numbers(ui, &PANE, body, context) {
        return;
    }
    if context.scene.sources().iter().all(|source| !source.visible) {
        return widgets::say(ui, body, "Nothing to draw. Add a camera at the left.", context.theme.weak);
    }
    let each = 2 + context.scene.sources().iter().filter(|source| source.visible).count();
    let wanted = context.view.saved.spectra_layout;
    // A small view would show a cut list of plots without their axis.
    let is_small = context.view.maximized != Some(PANE.kind) && body.height() < each as f32 * LEAST;
    if is_small {
        context.view.saved.spectra_layout = SpectraLayout::Overlay;
    }
    // In the lowest the sensitivities stand alone.
    let panels = if context.view.saved.spectra_layout == SpectraLayout::Each { each } else { 1 };
    let height = body.height().max(panels as f32 * LEAST);
    let mut child = widgets::clipped(ui, "spectra", body);
    ScrollArea::vertical().id_salt("spectra scroll").auto_shrink(false).show(&mut child, |ui| {
        let (area, _) = ui.allocate_exact_size(Vec2::new(body.width(), height), egui::Sense::hover());
        panels_in(ui, area, context);
    });
    context.view.saved.spectra_layout = wanted;
}

fn panels_in(ui: &mut Ui, area: Rect, context: &mut PaneContext<'_>) {
    let size = [f64::from(area.width()), f64::from(area.height())];
    let built = spectra::build(&context.scene, &context.view.look(PANE.kind), size);
    widgets::walk::along(ui, PaneKind::SPECTRA, context, widgets::walk::curves);
    let mut cursor = None;
    let mut plots = Vec::new();
    for panel in &built.panels {
        let place = Rect::from_min_max(
            area.min + Vec2::new(panel.area.min[0] as f32, panel.area.min[1] as f32),
            area.min + Vec2::new(panel.area.max[0] as f32, panel.area.max[1] as f32),
        );
        let shown = one_panel(ui, panel, place, &built, context);
        if let Some([nm, _]) = shown.hovered {
            cursor = Some(nm);
        }
        plots.push(shown.view);
    }
    // A hairline at the pointer's wavelength through all panels.
    if let Some(nm) = cursor {
        let stroke = egui::Stroke::new(1.0, context.theme.weak);
        for view in plots {
            let x = view.at([nm, view.y[0]]).x;
            ui.painter().with_clip_rect(view.rect).vline(x, view.rect.y_range(), stroke);
        }
    }
    let font = egui::FontId::proportional(crate::theme::SMALL);
    for (index, line) in built.refused.iter().enumerate() {
        let at = area.left_top() + Vec2::new(8.0, 20.0 + 16.0 * index as f32);
        ui.painter().text(at, Align2::LEFT_TOP, line, font.clone(), context.theme.warning);
    }
}

fn one_panel(
    ui: &mut Ui,
    panel: &chromascope_figure::Panel,
    place: Rect,
    built: &Built,
    context: &mut PaneContext<'_>,
) -> paint::PlotOutput {
    let reference = context.scene.document.reference.clone();
    let shown = {
        let view = &*context.view;
        let emphasis = |tag| view.emphasis_of(&built.things, tag, &reference);
        let options = PlotOptions { zoomable: false, reset: view.reset_plots, emphasis: &emphasis };
        paint::plot(ui, Id::unique(("spectra", &panel.name)), panel, &context.theme, place, options)
    };
    let hit = shown.response.hover_pos().and_then(|at| paint::nearest(panel, &shown.view, at, REACH));
    let thing = hit.and_then(|hit| built.things.get(hit.tag)).cloned();
    context.view.hover(thing.as_ref());
    if shown.response.clicked() {
        context.view.click(thing.as_ref());
    }
    if let Some([nm, value]) = shown.hovered {
        match &thing {
            Some(thing) => {
                let lines = spectra::describe(&context.scene, thing, nm);
                widgets::read_at_pointer(&shown.response, &lines);
            }
            None => context.view.point = Some(format!("{nm:.0} nm  {value:.3}").replace('-', "−")),
        }
    }
    shown
}
