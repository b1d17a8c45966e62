//! Work that the visible scene skipped, and the time it saved.

use chromascope_figure::{TextSize, text_width};
use chromascope_measure::pareto::duration;
use egui::{Align, Label, Layout, Rect, RichText, ScrollArea, TextStyle, Ui, UiBuilder, Vec2};

use super::context::{Pane, PaneContext};
use crate::command::Command;
use crate::figures::skipped_work::{self, OVERLAP, Section};
use crate::format::capitalized;
use crate::panes::widgets;
use crate::profiler::SkippedWork;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

/// The pane.
pub const PANE: Pane = Pane {
    kind: PaneKind::WORK_SAVED,
    title: "Work saved",
    show,
    figure: Some(|input| skipped_work::figure(input.measured)),
    under_conditions: false,
    table: true,
};

/// Shows the pane in its rectangle.
fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    context.refresh_run();
    let body = widgets::pane(ui, &PANE, rect, context, |_, _| {});
    if !context.view.fixed_clock {
        let run = context.laboratory.measured.run.as_ref().map_or(&[][..], |run| &run.skipped_work);
        context.laboratory.measured.remembered = skipped_work::remembered(&context.counts(), run);
    }
    let sections = skipped_work::sections(&context.laboratory.measured);
    if context.view.saved.tables.contains(&PaneKind::WORK_SAVED) {
        widgets::table::show_numbers(ui, body, PaneKind::WORK_SAVED, &skipped_work::table(&sections), context);
        return;
    }
    let inner = body.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let mut child = ui.new_child(UiBuilder::new().id_salt("skipped").max_rect(inner));
    child.set_clip_rect(body.intersect(ui.clip_rect()));
    ScrollArea::vertical().id_salt("skipped").auto_shrink(false).show(&mut child, |ui| {
        if context.laboratory.measured.run.is_none() {
            ui.horizontal(|ui| {
                if context.laboratory.busy().is_none() && ui.button("Run").clicked() {
                    context.push(Command::SpectralWeights);
                }
                ui.label("estimates the time saved by timing the skipped work.");
            });
        }
        table(ui, &sections, context);
    });
}

/// Minimum width for the method of measurement beside a row; in a narrower pane it is below.
const WIDE: f32 = 900.0;
/// Widths of the columns of times and counts.
const TIME: f32 = 72.0;
const COUNT: f32 = 210.0;

fn table(ui: &mut Ui, sections: &[Section], context: &PaneContext<'_>) {
    let theme = context.theme;
    let small = |words: &str| RichText::new(words).small().color(theme.weak);
    let width = ui.available_width() - 2.0 * UNIT;
    let name = |what: &str| text_width(what, TextSize::Body) as f32 + 2.0 * UNIT;
    let rows = sections.iter().flat_map(|section| &section.rows);
    let wide = width >= WIDE;
    let first = if wide { "Work saved" } else { "Skipped work, and how it was measured" };
    let what = rows.map(|row| name(&row.what)).fold(name(first), f32::max).min(width - TIME - COUNT);
    ui.spacing_mut().item_spacing = Vec2::new(2.0 * UNIT, 0.25 * UNIT);
    let line = |ui: &mut Ui, cells: [RichText; 3], how: RichText| {
        ui.horizontal_top(|ui| {
            for (cell, width) in cells.into_iter().zip([what, TIME, COUNT]) {
                column(ui, width, |ui| ui.add(Label::new(cell).truncate()));
            }
            if wide {
                ui.add(Label::new(how).wrap());
            }
        });
    };
    line(ui, [first, "Time saved", "How many"].map(small), small(if wide { "Measured by" } else { "" }));
    for (index, section) in sections.iter().enumerate() {
        ui.add_space(if index == 0 { UNIT } else { 3.0 * UNIT });
        ui.horizontal_wrapped(|ui| {
            let color = if section.is_old { theme.warning } else { theme.text };
            ui.label(RichText::new(capitalized(section.when)).strong().color(color));
            if index == 0 {
                ui.label(small(OVERLAP));
            }
        });
        for row in &section.rows {
            ui.add_space(UNIT);
            let saved = if row.saved > 0.0 { duration(row.saved) } else { "–".to_owned() };
            let cells = [
                RichText::new(row.what.as_ref()),
                RichText::new(saved).monospace(),
                RichText::new(count(row)).monospace(),
            ];
            line(ui, cells, small(&row.how));
            if !wide {
                ui.add(Label::new(small(&row.how)).wrap());
            }
        }
    }
    if context.laboratory.measured.run.is_some() {
        ui.add_space(2.0 * UNIT);
        ui.label(small(super::NOT_KEPT));
    }
}

/// A cell of a fixed width.
fn column<R>(ui: &mut Ui, width: f32, content: impl FnOnce(&mut Ui) -> R) {
    let height = ui.text_style_height(&TextStyle::Body);
    ui.allocate_ui_with_layout(Vec2::new(width, height), Layout::left_to_right(Align::Min), |ui| {
        ui.set_width(width);
        content(ui);
    });
}

/// A count, with its share where there is a whole.
fn count(row: &SkippedWork) -> String {
    match row.of {
        Some(of) if of > 0 => {
            let share = 100.0 * row.count as f64 / of as f64;
            format!("{} of {} ({share:.0} %)", short(row.count), short(of))
        }
        _ => short(row.count),
    }
}

/// All digits of what can be counted at a glance, three of more.
fn short(count: u64) -> String {
    if count < 1_000_000 { count.to_string() } else { format!("{:.2e}", count as f64) }
}
