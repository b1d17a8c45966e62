//! The curves that a file gives.

use egui::{Align2, Id, Rect, Ui};

use super::context::{Pane, PaneContext};
use crate::figures::curves::{self, CurveCache, Curves};
use crate::paint::{self, PlotOptions};
use crate::panes::widgets;
use crate::theme::UNIT;
use crate::view::import::ImportItem;
use crate::workspaces::PaneKind;

const REACH: f32 = 8.0;

pub const PANE: Pane = Pane::new(PaneKind::CURVES, "Curves", show).figure(&curves::KIND).table();

#[derive(Default)]
struct LastDrawn(Option<CurveCache>);

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, |_, _| {});
    let Some(shown) = context.import_selection() else {
        sentence(ui, body, "No curves.", context.theme.weak);
        return;
    };
    if shown.file.is_some() && !shown.is_fresh() {
        widgets::busy_line(ui, body, context.opened.looking(), context.theme.text);
    }
    let kept = CurveCache::of(&shown, context.states.of::<LastDrawn>().0.take());
    match kept.all() {
        Err(words) => {
            let is_reported = shown.error().is_some() && context.view.is_shown(PaneKind::IMPORT);
            let color = if shown.error().is_some() { context.theme.error } else { context.theme.weak };
            // The list of files and the marked text say why.
            let (words, color) = if is_reported { ("No curves.", context.theme.weak) } else { (words, color) };
            sentence(ui, body, words, color);
        }
        Ok(curves) if context.view.saved.tables.contains(&PaneKind::CURVES) => {
            widgets::table::show_numbers(ui, body, PaneKind::CURVES, &curves::numbers(curves), context);
        }
        Ok(curves) => plot(ui, body, &shown.item, [curves, kept.seen().unwrap_or(curves)], context),
    }
    context.states.of::<LastDrawn>().0 = Some(kept);
}

fn plot(ui: &mut Ui, body: Rect, item: &ImportItem, [curves, seen]: [&Curves; 2], context: &mut PaneContext<'_>) {
    let size = [f64::from(body.width()), f64::from(body.height())];
    let panel = curves::panel(seen, size, context.view.import.hovered_curve);
    let options = PlotOptions { zoomable: true, reset: context.view.reset_plots, ..PlotOptions::default() };
    let id = Id::unique(("curves", format!("{item:?}")));
    let shown = paint::plot(ui, id, &panel, &context.theme, body, options);
    context.view.note_zoom(PaneKind::CURVES, curves::title(seen), shown.zoomed(&panel));
    let hit = shown.response.hover_pos().and_then(|at| paint::nearest(&panel, &shown.view, at, REACH));
    let place = hit.and_then(|hit| curves::place(hit.tag));
    widgets::hover_curve(ui, "pointer over result", shown.response.hovered(), place, context);
    let Some([nm, value]) = shown.hovered else { return };
    if let Some(place) = place {
        let lines = curves::describe(curves, place, nm);
        context.view.point = Some(lines.join("  "));
        widgets::read_at_pointer(&shown.response, &lines);
    } else {
        context.view.point = Some(format!("{nm:.0} nm  {}", crate::format::number(value)));
    }
}

fn sentence(ui: &Ui, body: Rect, words: &str, color: egui::Color32) {
    let font = egui::FontId::proportional(crate::theme::TEXT);
    let width = (body.width() - 8.0 * UNIT).max(40.0);
    let galley = ui.painter().layout(words.to_owned(), font, color, width);
    let rect = Align2::CENTER_CENTER.align_size_within_rect(galley.size(), body);
    ui.painter().with_clip_rect(body).galley(rect.min, galley, color);
    widgets::named(ui, rect, ui.scope_id().with("no curves"), egui::Role::Label, words);
}
