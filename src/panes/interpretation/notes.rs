//! Warnings, decisions, and the origin of the numbers.

use egui::{Align, CollapsingHeader, Id, RichText, Ui};
use spectral_file::{Decision, SpectralFile};

use crate::figures::curves::ImportSelection;
use crate::format;
use crate::format::{number, sentence};
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::panes::widgets::facts::range_words;
use crate::theme::{Theme, UNIT};

const MAX_DROPPED_ROWS: usize = 5;

fn led_to() -> Id {
    Id::unique("notes are led to")
}

/// Number of notes with a link to them, in the pane's header, which does not scroll.
pub(super) fn button(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let Some(shown) = context.view.import.selection(&context.scene, context.opened) else { return };
    let Some(count) = shown.table().map(|table| table.warnings.len()).filter(|count| *count > 0) else { return };
    ui.add_space(UNIT);
    let words = RichText::new(counted(count)).color(context.theme.warning);
    if ui.button(words).on_hover_text("Points to check before the curves are used").clicked() {
        ui.data_mut(|data| data.insert_temp(led_to(), true));
        ui.ctx().request_repaint();
    }
}

fn counted(count: usize) -> String {
    match count {
        0 => "No warnings".to_owned(),
        1 => "1 note".to_owned(),
        count => format!("{count} notes"),
    }
}

pub(super) fn show(ui: &mut Ui, shown: &ImportSelection, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    let Some(table) = shown.table() else { return };
    ui.add_space(UNIT);
    let count = table.warnings.len();
    let head = ui.horizontal(|ui| {
        ui.label(counted(count));
        if ui.small_button("Copy").on_hover_text("Warnings, decisions and origin, as text").clicked() {
            ui.ctx().copy_text(text(shown, table));
            context.view.say("Interpretation: notes copied.");
        }
    });
    if ui.data_mut(|data| data.remove_temp::<bool>(led_to())).unwrap_or(false) {
        head.response.scroll_to_me(Some(Align::TOP));
    }
    for warning in &table.warnings {
        match warning.line() {
            Some(line) => {
                let link = ui.link(RichText::new(sentence(&warning.to_string())).small().color(theme.warning));
                if link.on_hover_text(format!("Show line {line}")).clicked() {
                    context.view.import.line = Some(line);
                    ui.ctx().request_repaint();
                }
            }
            None => {
                ui.label(RichText::new(sentence(&warning.to_string())).small().color(theme.warning));
            }
        }
    }
    ui.add_space(UNIT);
    let (guesses, rest): (Vec<_>, Vec<_>) =
        table.decisions().into_iter().partition(|decision| decision.certainty.is_doubtful());
    if !guesses.is_empty() {
        ui.label("Guesses");
    }
    for guess in &guesses {
        decision(ui, guess, &theme);
    }
    folded(ui, &format!("{} other decisions", rest.len()), |ui| {
        for certain in &rest {
            decision(ui, certain, &theme);
        }
    });
    folded(ui, "Origin", |ui| {
        for fact in facts(shown, table) {
            widgets::note(ui, fact);
        }
    });
}

/// A decision in a line, a guess marked; the reason under the pointer.
fn decision(ui: &mut Ui, decision: &Decision, theme: &Theme) {
    let color = if decision.certainty.is_doubtful() { theme.warning } else { theme.text };
    let mark = if decision.certainty.is_doubtful() { "● " } else { "" };
    let words = format!("{mark}{}: {} ({}).", decision.what, decision.value, decision.certainty);
    ui.label(RichText::new(words).small().color(color)).on_hover_text(format!("{}.", decision.why));
}

fn folded(ui: &mut Ui, words: &str, content: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(RichText::new(words).small()).id_salt(words).show(ui, content);
}

/// Origin of the numbers, a line each.
fn facts(shown: &ImportSelection, table: &SpectralFile) -> Vec<String> {
    let reading = &table.reading;
    let step = reading.step_nm;
    let mut facts = vec![
        format!("Reader: {}; {}", reading.reader.value, reading.encoding),
        format!("{} rows from line {}", reading.rows, reading.first_data_line),
    ];
    facts.extend(format::dropped_rows(&reading.dropped_rows, MAX_DROPPED_ROWS));
    let order = if reading.descending { ", written in descending order" } else { "" };
    facts.push(format!("Range {}{order}", range_words(reading.range_nm)));
    let [min, median, max] = [step.min, step.median, step.max].map(number);
    facts.push(format!("Step {min} nm least, {median} nm median, {max} nm largest"));
    if let Some(file) = &shown.file {
        let path = file.origin.path.as_ref().map(|path| path.display().to_string());
        facts.push(path.unwrap_or_else(|| format!("{} (not a file on disk)", file.origin.name)));
    }
    facts
}

fn text(shown: &ImportSelection, table: &SpectralFile) -> String {
    let mut lines: Vec<String> = table.warnings.iter().map(ToString::to_string).collect();
    let decisions = table.decisions();
    lines.extend(decisions.iter().map(|d| format!("{}: {} ({}). {}.", d.what, d.value, d.certainty, d.why)));
    lines.extend(facts(shown, table));
    lines.join("\n") + "\n"
}
