//! The user's files, and the text of one with its interpretation.

mod files;
mod text;

use egui::{ProgressBar, Rect, RichText, Sense, Ui, Vec2};
use files::Entry;
use spectral_file::{Certainty, Role, SpectralFile, Values};

use super::context::{Pane, PaneContext};
use crate::command::Command;
use crate::figures::curves::ImportSelection;
use crate::format::sentence;
use crate::jobs::PATIENCE;
use crate::panes::widgets::{self, lines};
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

const FILES: f32 = 184.0;
/// In a narrower pane the files are a list that drops down.
const NARROW: f32 = 480.0;

pub const PANE: Pane = Pane::new(PaneKind::IMPORT, "Import", show).tab("Text").table();

/// True if files are listed one below the other in a pane of this rectangle.
pub fn lists_files(pane: Rect) -> bool {
    pane.width() - 4.0 * UNIT >= NARROW
}

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, switches);
    let entries = files::all(context);
    if entries.is_empty() {
        nothing(ui, body, context);
        return;
    }
    if widgets::numbers(ui, &PANE, body, context, |_| Some(files::table(&entries))) {
        return;
    }
    keep_selected(ui, &entries, context);
    let is_narrow = !lists_files(rect);
    let below = if is_narrow { files::drop_down(ui, body, &entries, context) } else { body };
    let text = if is_narrow {
        below
    } else {
        let cut = body.left() + FILES;
        let column = body.with_max_x(cut);
        files::column(ui, column, &entries, context);
        body.with_min_x(cut + 2.0 * UNIT)
    };
    match context.import_selection() {
        Some(shown) => {
            let text = ask(ui, text, &shown, context);
            text::show(ui, text, &shown, context);
        }
        // The selected item is gone since the list was made; the next frame shows another.
        None => ui.ctx().request_repaint(),
    }
}

/// Some file is always selected: the first until the user chooses another.
fn keep_selected(ui: &Ui, entries: &[Entry], context: &mut PaneContext<'_>) {
    let selected = context.view.import.selected.as_ref();
    if selected.is_none_or(|item| !entries.iter().any(|entry| entry.item == *item))
        && let Some(first) = entries.first()
    {
        context.view.import.select(first.item.clone());
        ui.ctx().request_repaint();
    }
}

fn switches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let Some(progress) = context.opened.progress() else { return };
    // A worker says only when it is done.
    ui.ctx().request_repaint_after(PATIENCE);
    if progress.time < PATIENCE {
        return;
    }
    ui.add_space(UNIT);
    context.button(ui, "Stop", "Stop reading (Esc). Nothing is changed.", Command::StopReading);
    let [file, count] = progress.file;
    let percent = (progress.share * 100.0).floor();
    let bar = ProgressBar::new(progress.share).desired_width(64.0).desired_height(6.0).fill(context.theme.weak);
    let response = ui.add(bar);
    let words = if count > 1 {
        format!("reading {}, {file} of {count}… {percent:.0} %", progress.name)
    } else {
        format!("reading {}… {percent:.0} %", progress.name)
    };
    widgets::labeled(&response, egui::Role::ProgressIndicator, &words);
    ui.add(egui::Label::new(RichText::new(words).small().color(context.theme.weak)).truncate());
}

fn nothing(ui: &mut Ui, body: Rect, context: &mut PaneContext<'_>) {
    let size = Vec2::new(280.0_f32.min(body.width()), 96.0);
    let ui = &mut widgets::middle(ui, "no file", body, size);
    if let Some(progress) = context.opened.progress() {
        ui.label(format!("Reading {}…", progress.name));
        return;
    }
    ui.label("Drop files here.");
    ui.add_space(UNIT);
    open_buttons(ui, size.x, context);
    ui.add_space(UNIT);
    let hint = "Or paste data with Ctrl+V. Check and correct here how a file was read.";
    widgets::note(ui, hint);
}

fn open_buttons(ui: &mut Ui, width: f32, context: &mut PaneContext<'_>) {
    const TOGETHER: f32 = 172.0;
    ui.horizontal(|ui| {
        ui.add_space(((width - TOGETHER) / 2.0).max(0.0));
        context.button(ui, "Open…", "Spectral files of any kind (Ctrl+O)", Command::Open);
        context.button(ui, "Open folder…", "All spectral files in a folder", Command::OpenFolder);
    });
}

type Answer = (&'static str, &'static str, Option<Role>, Option<Values>);

const KINDS: [Answer; 5] = [
    ("Reflectances", "Use the numbers as reflectances, fractions of one", Some(Role::Reflectance), None),
    ("Filter", "Use the numbers as transmittances, fractions of one", Some(Role::Transmittance), None),
    LIGHT,
    CAMERA,
    AS_WRITTEN,
];

/// Answers where nothing indicates the quantity, and fractions of one are out of the question.
const LARGE_KINDS: [Answer; 5] = [
    (
        "Reflectances in percent",
        "Divide the numbers by 100 and use them as reflectances",
        Some(Role::Reflectance),
        Some(Values::Percent),
    ),
    (
        "Filter in percent",
        "Divide the numbers by 100 and use them as transmittances",
        Some(Role::Transmittance),
        Some(Values::Percent),
    ),
    LIGHT,
    CAMERA,
    AS_WRITTEN,
];

const LIGHT: Answer = ("Light", "Use the numbers as spectral power of a light", Some(Role::Illuminant), None);
const CAMERA: Answer = ("Camera", "Use the numbers as sensitivities of a camera", Some(Role::Camera), None);
const AS_WRITTEN: Answer = (
    "As written",
    "Import as spectra of an unknown kind; change it any time under “This is a”",
    Some(Role::Unknown),
    None,
);

const SCALES: [Answer; 2] = [
    ("In percent", "Divide the numbers by 100", None, Some(Values::Percent)),
    ("As written", "Use the numbers as fractions of one", None, Some(Values::Plain)),
];

/// Reflectances pass one by noise and fluorescence.
const LARGEST_FRACTION: f64 = 1.2;

fn question(table: &SpectralFile) -> Option<(&str, &'static [Answer])> {
    let open = |certainty| certainty == Certainty::Open;
    match (&table.role, &table.reading.values) {
        (role, _) if open(role.certainty) => {
            let large = table.curves.iter().flat_map(|curve| &curve.values).any(|value| *value > LARGEST_FRACTION);
            Some((&role.why, if large { &LARGE_KINDS } else { &KINDS }))
        }
        (_, values) if open(values.certainty) => Some((&values.why, &SCALES)),
        _ => None,
    }
}

/// Shows the question, if there is one, at the top of a rectangle. Returns what is left below.
fn ask(ui: &mut Ui, rect: Rect, shown: &ImportSelection, context: &mut PaneContext<'_>) -> Rect {
    let Some((why, answers)) = shown.table().filter(|_| shown.is_fresh()).and_then(question) else { return rect };
    let color = context.theme.warning;
    let mut child = widgets::clipped(ui, "question", rect);
    child.spacing_mut().item_spacing = Vec2::splat(UNIT);
    child.horizontal_wrapped(|ui| {
        let (mark, _) = ui.allocate_exact_size(Vec2::splat(16.0), Sense::hover());
        lines::warning_mark(ui.painter(), mark.center(), color);
        ui.label(RichText::new(sentence(why)).color(color));
    });
    child.horizontal_wrapped(|ui| {
        for (words, hint, role, values) in answers {
            if ui.button(*words).on_hover_text(*hint).clicked() {
                let mut overrides = shown.overrides.clone();
                overrides.options.role = role.or(overrides.options.role);
                overrides.options.values = values.or(overrides.options.values);
                context.push(Command::SetOverrides(shown.item.clone(), Box::new(overrides)));
            }
        }
    });
    let bottom = child.min_rect().bottom() + UNIT;
    ui.painter().hline(rect.x_range(), bottom, egui::Stroke::new(1.0, context.theme.line));
    rect.with_min_y((bottom + UNIT).min(rect.bottom()))
}
