//! Decisions made in reading a file, with switches to correct them.

mod curves;
mod notes;
mod stored;
mod switches;

use egui::text::LayoutJob;
use egui::{
    ComboBox, EventFilter, FontId, Id, Key, Rect, Response, RichText, ScrollArea, TextFormat, Ui, UiBuilder, Vec2,
};

use super::context::{Pane, PaneContext};
use crate::action::{Action, ImportedAction};
use crate::command::Command;
use crate::document::imported::ImportOverrides;
use crate::figures::curves::ImportSelection;
use crate::format::sentence;
use crate::panes::widgets;
use crate::panes::widgets::pick_list::{self, Line};
use crate::theme::{ROW, SMALL, TEXT, Theme, UNIT};
use crate::view::import::{ImportItem, Stop};
use crate::workspaces::PaneKind;

const CONTENT: &str = "Decided by content";
/// First entry where room is short.
const CONTENT_SHORT: &str = "By content";

pub const PANE: Pane = Pane::new(PaneKind::INTERPRETATION, "Interpretation", show);

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::pane(ui, &PANE, rect, context, notes::button);
    let inner = body.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let Some(shown) = context.import_selection() else {
        let mut child = ui.new_child(UiBuilder::new().id_salt("nothing recognized").max_rect(inner));
        widgets::note(&mut child, "No file is open: drop one on the window, or select a set of the library.");
        return;
    };
    context.view.import.unseen.remove(&shown.item);
    if context.view.import.takes_keyboard(Stop::Switches) {
        to_first(ui);
    }
    let below = foot_height(&shown, inner.width());
    let upper = inner.with_max_y(inner.bottom() - below);
    let mut child = ui.new_child(UiBuilder::new().id_salt("understood").max_rect(upper));
    child.set_clip_rect(upper.expand2(Vec2::new(2.0 * UNIT, 0.0)).intersect(ui.clip_rect()));
    let salt = format!("understood {:?}", shown.item);
    ScrollArea::vertical().id_salt(salt).auto_shrink(false).show(&mut child, |ui| {
        ui.set_max_width(upper.width());
        ui.spacing_mut().item_spacing.y = 0.75 * UNIT;
        content(ui, &shown, context);
        ui.add_space(2.0 * UNIT);
    });
    ui.painter().hline(inner.x_range(), upper.bottom() + 0.5, egui::Stroke::new(1.0, context.theme.line));
    let lower = inner.with_min_y(upper.bottom() + UNIT);
    let mut child = ui.new_child(UiBuilder::new().id_salt("understood foot").max_rect(lower));
    foot(&mut child, &shown, context);
}

fn content(ui: &mut Ui, shown: &ImportSelection, context: &mut PaneContext<'_>) {
    if let (Some(set), None) = (&shown.set, &shown.file) {
        stored::show(ui, set, context);
        return;
    }
    if let Some(set) = &shown.set {
        stored::name(ui, set, context);
    }
    let mut overrides = shown.overrides.clone();
    switches::show(ui, shown, &mut overrides, &context.theme);
    switches::parts(ui, shown, context);
    // Below the switches, so that they stay where they are.
    if let Some(error) = shown.error() {
        trouble(ui, &error.to_string(), error.line(), shown, context);
    }
    stored::channels(ui, shown, &mut overrides, &context.theme);
    curves::show(ui, shown, &mut overrides, context);
    if overrides != shown.overrides {
        context.push(Command::SetOverrides(shown.item.clone(), Box::new(overrides)));
    }
    notes::show(ui, shown, context);
}

/// Reason that the file cannot be read with the settings, with a way to reset them.
fn trouble(ui: &mut Ui, words: &str, line: Option<usize>, shown: &ImportSelection, context: &mut PaneContext<'_>) {
    let color = context.theme.error;
    // The list of files and the marked text say why, where they are in sight.
    let is_reported = !shown.pending && context.view.is_shown(PaneKind::IMPORT);
    if !is_reported {
        ui.horizontal_wrapped(|ui| {
            let (rect, _) = ui.allocate_exact_size(Vec2::new(16.0, 16.0), egui::Sense::hover());
            widgets::lines::warning_mark(ui.painter(), rect.center(), color);
            ui.label(RichText::new(sentence(words)).color(color));
        });
    }
    ui.horizontal_wrapped(|ui| {
        if shown.pending && ui.button("Back").on_hover_text("Discard the attempted settings").clicked() {
            context.push(Command::DiscardOverrides);
        }
        if let Some(line) = line
            && ui.button("Show line").on_hover_text("Show where in the text").clicked()
        {
            context.view.import.line = Some(line);
            ui.ctx().request_repaint();
        }
    });
    if shown.set.is_some() && shown.pending {
        widgets::note(ui, "The data set is unchanged until the file can be read with these settings.");
    }
}

/// Label above a control; a dot marks a guess.
fn caption(ui: &mut Ui, theme: &Theme, words: &str, guess: bool) {
    let response = ui.label(RichText::new(words).small().weak());
    if guess {
        let at = response.rect.right_center() + Vec2::new(8.0, 0.5);
        ui.painter().circle_filled(at, 3.0, theme.warning);
    }
}

#[derive(Default)]
struct Closed {
    value: String,
    how: String,
    guess: bool,
    why: String,
}

impl Closed {
    fn job(&self, theme: &Theme) -> LayoutJob {
        let format = |size: f32, color| TextFormat {
            font_id: FontId::proportional(size),
            color,
            valign: egui::Align::Center,
            ..TextFormat::default()
        };
        let mut job = LayoutJob::default();
        job.append(&self.value, 0.0, format(TEXT, theme.text));
        if !self.how.is_empty() {
            let color = if self.guess { theme.warning } else { theme.weak };
            job.append(&format!(" ({})", self.how), 0.0, format(SMALL, color));
        }
        job
    }
}

fn list(
    ui: &mut Ui,
    theme: &Theme,
    words: &str,
    closed: &Closed,
    entries: &[(String, bool)],
    width: f32,
) -> Option<usize> {
    let column = ui.allocate_ui(Vec2::new(width, 2.0 * ROW), |ui| {
        ui.set_width(width);
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            caption(ui, theme, words, closed.guess);
            let lines = || entries.iter().map(|(entry, on)| Line::new(entry, *on)).collect();
            let hint = if closed.why.is_empty() { String::new() } else { format!("{}.", closed.why) };
            let (response, chosen) = pick_list::combo(ui, (words, &hint), closed.job(theme), width, theme, lines);
            if is_left(ui, response.id) || first(ui) {
                response.request_focus();
            }
            chosen
        })
        .inner
    });
    column.inner
}

fn first_switch() -> Id {
    Id::unique("keyboard to the first switch")
}

fn to_first(ui: &Ui) {
    ui.data_mut(|data| data.insert_temp(first_switch(), true));
}

/// True if this is the first switch and takes the keyboard.
fn first(ui: &Ui) -> bool {
    ui.data_mut(|data| data.remove_temp::<bool>(first_switch())).unwrap_or(false)
}

/// True if a list closed since the last frame, but not by a click on another control.
fn is_left(ui: &Ui, list: Id) -> bool {
    let (key, open) = (list.with("was open"), ComboBox::is_open(ui.ctx(), list));
    let was = ui.data_mut(|data| std::mem::replace(data.get_temp_mut_or_default::<bool>(key), open));
    was && !open && !ui.input(|input| input.pointer.any_click())
}

fn step(ui: &Ui) -> isize {
    ui.input(|input| isize::from(input.key_pressed(Key::ArrowDown)) - isize::from(input.key_pressed(Key::ArrowUp)))
}

/// Prevents arrow keys from moving the focus to a neighboring control.
fn hold(ui: &Ui, entry: &Response) {
    let filter = EventFilter { vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(entry.id, filter));
}

/// Below this width the three buttons of a set take one more row.
const SET: f32 = 290.0;
/// Below these widths the four buttons of a file that is no set take one and two more.
const FILE: [f32; 2] = [380.0, 270.0];

fn foot_height(shown: &ImportSelection, width: f32) -> f32 {
    let more = match shown.item {
        ImportItem::Set(_) => usize::from(width < SET),
        ImportItem::File(_) => FILE.into_iter().filter(|least| width < *least).count(),
    };
    let rows = 2 + usize::from(on_disk(shown)) + more;
    rows as f32 * (ROW + UNIT) + 2.0 * UNIT
}

/// True if there is a file to look after.
fn on_disk(shown: &ImportSelection) -> bool {
    match (&shown.set, &shown.file) {
        (Some(set), _) => set.path.is_some(),
        (None, file) => file.as_ref().is_some_and(|file| file.origin.path.is_some()),
    }
}

fn foot(ui: &mut Ui, shown: &ImportSelection, context: &mut PaneContext<'_>) {
    ui.spacing_mut().item_spacing.x = UNIT;
    ui.horizontal_wrapped(|ui| match &shown.item {
        ImportItem::File(fingerprint) => {
            let reads = shown.is_fresh() && shown.table().is_some();
            let none = shown.taken().is_empty();
            let button = ui.add_enabled(reads && !none, egui::Button::new("Use"));
            let hint = "Import it and use it; can be undone";
            let why = if reads { "No curve is selected" } else { "Not readable with these settings" };
            if button.on_hover_text(hint).on_disabled_hover_text(why).clicked() {
                context.push(Command::UseFile(*fingerprint, Box::new(shown.overrides.clone())));
            }
            alike(ui, shown, context);
            if let Some(path) = shown.file.as_ref().and_then(|file| file.origin.path.clone())
                && ui.button("Reload").on_hover_text("Reload the file from disk").clicked()
            {
                context.push(Command::OpenPath(path));
            }
            if ui.button("Do not import").on_hover_text("Remove from the list").clicked() {
                context.push(Command::ForgetFile(*fingerprint));
                context.view.import.selected = None;
            }
        }
        ImportItem::Set(name) => {
            if shown.file.is_some() {
                alike(ui, shown, context);
            }
            if on_disk(shown) && ui.button("Reload").on_hover_text("Reload the file from disk").clicked() {
                context.push(Command::ReadAgain(name.clone()));
            }
            let remove = Action::Imported(ImportedAction::Remove(name.clone()));
            context.button(ui, "Remove", "Remove the data set; can be undone", remove);
        }
    });
    ui.horizontal(|ui| {
        let chosen = shown.overrides != ImportOverrides::default();
        let hint = "Decide by content again, for this file and others like it; can be undone";
        let button = ui.add_enabled(chosen, egui::Button::new("Forget choices")).on_hover_text(hint);
        if button.on_disabled_hover_text("Nothing was chosen for it").clicked() {
            context.push(Command::ForgetChoices(shown.item.clone()));
        }
    });
    if on_disk(shown) {
        ui.checkbox(&mut context.view.saved.import.watch, "Reload when the file changes").on_hover_text(
            "Files are reloaded when they change on disk, including files that failed to load; can be \
                            undone",
        );
    }
}

fn alike(ui: &mut Ui, shown: &ImportSelection, context: &mut PaneContext<'_>) {
    let hint = "Use these settings for all open files of this kind, and for files like it from now on";
    let reads = shown.is_fresh() && shown.table().is_some();
    if ui.add_enabled(reads, egui::Button::new("Use for all like it")).on_hover_text(hint).clicked() {
        context.push(Command::UseForAlike(shown.item.clone()));
    }
}
