//! Run time against error of the scene on show.

use std::time::Duration;

use egui::{Id, Rect, RichText, Ui, UiBuilder, Vec2};

use super::PaneContext;
use crate::command::Command;
use crate::figures::accuracy;
use crate::laboratory::Subject;
use crate::paint::{self, PlotOptions};
use crate::theme::UNIT;
use crate::widgets;
use crate::workspaces::PaneKind;

/// How near the pointer must be, in points.
const REACH: f32 = 10.0;

/// Shows the pane in its rectangle.
pub fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    context.refresh_run();
    let body = widgets::pane(ui, PaneKind::Accuracy, rect, context, switches);
    let body = Rect::from_min_max(body.min + Vec2::new(2.0 * UNIT, 0.0), body.max - Vec2::new(2.0 * UNIT, UNIT));
    if let Some(why) = context.laboratory.failure() {
        ui.painter().text(
            body.center(),
            egui::Align2::CENTER_CENTER,
            format!("Nothing measured: {why}."),
            egui::FontId::proportional(crate::theme::TEXT),
            context.theme.error,
        );
        return;
    }
    let subject = context.view.accuracy.subject;
    let Some(run) = context.view.accuracy.run.clone() else {
        nothing(ui, body, "Nothing measured yet.", context);
        return;
    };
    let Some(trial) = accuracy::trial(&run, subject) else {
        let words = match subject {
            Subject::Integral => "No sample takes a spectral integral: nothing is rendered, or all is flat.",
            Subject::Loci => "No source is on show. Tick a camera in the Library.",
        };
        nothing(ui, body, words, context);
        return;
    };
    if context.view.saved.tables.contains(&PaneKind::Accuracy) {
        widgets::data_table(ui, body, "accuracy", &accuracy::table(trial));
        return;
    }
    let size = [f64::from(body.width()), f64::from(body.height())];
    let panel = accuracy::panel(trial, context.view.accuracy.is_current, size);
    let options = PlotOptions { zoomable: true, reset: context.view.reset_plots, ..PlotOptions::default() };
    let id = Id::unique(("run time against error", subject.title()));
    let shown = paint::plot(ui, id, &panel, &context.theme, body, options);
    shown.response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Canvas, true, format!("Run time against error: {}", subject.title()))
    });
    let hit = shown.response.hover_pos().and_then(|at| paint::nearest(&panel, &shown.view, at, REACH));
    if let Some(point) = hit.and_then(|hit| accuracy::point(trial, hit.tag)) {
        let lines = accuracy::describe(trial, point);
        context.view.point = Some(lines.join("  "));
        widgets::read_at_pointer(&shown.response, &lines);
    }
}

/// What is on show, and a way to measure it.
fn switches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let choices = Subject::ALL.map(|subject| (subject, subject.title(), subject.per()));
    if let Some(subject) = widgets::segmented(ui, &choices, context.view.accuracy.subject) {
        context.view.accuracy.subject = subject;
        ui.ctx().request_repaint();
    }
    ui.add_space(UNIT);
    if let Some(busy) = context.laboratory.busy() {
        if ui.button("Stop").on_hover_text("Stop measuring (Esc). What was measured before stays.").clicked() {
            context.push(Command::StopMeasuring);
        }
        let words = format!("measuring, {:.0} s…", busy.as_secs_f64());
        ui.label(RichText::new(words).small().color(context.theme.weak));
        ui.ctx().request_repaint_after(Duration::from_millis(100));
        return;
    }
    let again = context.view.accuracy.run.is_some();
    let hint = "Measures the methods on this scene, and what was left out of it. Takes some seconds.";
    if ui.button(if again { "Run again" } else { "Run" }).on_hover_text(hint).clicked() {
        context.push(Command::Measure);
    }
}

/// A sentence, and the way to have something in its place.
fn nothing(ui: &mut Ui, body: Rect, words: &str, context: &mut PaneContext<'_>) {
    let place = Rect::from_center_size(body.center(), Vec2::new(body.width().min(420.0), 72.0)).intersect(body);
    let layout = egui::Layout::top_down(egui::Align::Center);
    let mut child = ui.new_child(UiBuilder::new().id_salt("nothing measured").max_rect(place).layout(layout));
    child.label(words);
    child.add_space(UNIT);
    if context.laboratory.busy().is_some() {
        child.label("Measuring…");
    } else if child.button("Run").clicked() {
        context.push(Command::Measure);
    }
}
