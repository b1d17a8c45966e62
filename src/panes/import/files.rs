//! The list of files: the document's own sets, then opened files that no set is made of; its column, and the drop-down list that
//! replaces it in narrow windows.

use std::path::PathBuf;

use chromascope_figure::{Cell, Table};
use egui::{
    Color32, Event, Id, Key, Painter, Pos2, Rect, Response, ScrollArea, Sense, Shape, Stroke, TextStyle, Ui, UiBuilder,
    Vec2,
};

use crate::action::{Action, ImportedAction};
use crate::catalog::opened::OpenFile;
use crate::command::Command;
use crate::document::imported::{ImportedSet, Role};
use crate::panes::context::PaneContext;
use crate::panes::widgets::pick_list::{self, Line};
use crate::panes::widgets::{self, focus_rim, lines};
use crate::theme::{ROW, Theme, UNIT};
use crate::view::import::{ImportItem, Stop};
use crate::workspaces::PaneKind;

const HEIGHT: f32 = 38.0;
const REASON: f32 = 14.0;
const MARK: f32 = 16.0;
const SCROLL_BAR: f32 = 8.0;

pub(super) fn column(ui: &mut Ui, rect: Rect, entries: &[Entry], context: &mut PaneContext<'_>) {
    let caption = Rect::from_min_size(rect.min, Vec2::new(rect.width(), ROW));
    let count = if entries.len() == 1 { "1 file".to_owned() } else { format!("{} files", entries.len()) };
    lines::elided(ui, caption, &count, TextStyle::Small, context.theme.weak);
    let response = widgets::named(ui, caption, Id::unique("legend of files"), egui::Role::Label, &count);
    let theme = context.theme;
    response.on_hover_ui(|ui| legend(ui, &theme));
    let list = rect.with_min_y(caption.bottom());
    let mut moved = keys(ui, entries, context).or_else(|| led_to(ui, list, entries, context));
    if context.view.import.takes_keyboard(Stop::Files)
        && let Some(index) = entries.iter().position(|entry| Some(&entry.item) == context.view.import.selected.as_ref())
    {
        ui.memory_mut(|memory| memory.request_focus(id(index)));
        moved = Some(index);
    }
    let mut child = widgets::clipped(ui, "files", list);
    child.spacing_mut().item_spacing.y = 0.0;
    let mut area = ScrollArea::vertical().id_salt("files scroll").auto_shrink(false);
    let tops = tops(entries);
    if let Some(index) = moved {
        // The previous and the next one stay visible, too.
        area = area.vertical_scroll_offset((tops[index] - (list.height() - HEIGHT) / 2.0).max(0.0));
    }
    area.show_viewport(&mut child, |ui, viewport| {
        ui.set_height(tops[entries.len()]);
        let origin = ui.max_rect().min;
        let is_seen = |index: &usize| tops[index + 1] > viewport.top() && tops[*index] < viewport.bottom();
        for index in (0..entries.len()).filter(is_seen) {
            let [top, bottom] = [tops[index], tops[index + 1]].map(|y| origin.y + y);
            row(ui, Rect::from_x_y_ranges(ui.max_rect().x_range(), top..=bottom), index, entries, context);
        }
    });
}

fn tops(entries: &[Entry]) -> Vec<f32> {
    let mut tops = vec![0.0];
    for entry in entries {
        let line = if entry.state == State::Failed { REASON } else { 0.0 };
        tops.push(tops[tops.len() - 1] + HEIGHT + line);
    }
    tops
}

fn legend(ui: &mut Ui, theme: &Theme) {
    for state in State::ALL {
        ui.horizontal(|ui| {
            let (place, _) = ui.allocate_exact_size(Vec2::splat(MARK), Sense::hover());
            draw_mark(ui.painter(), place.center(), state, false, theme);
            ui.label(state.words());
        });
    }
}

/// The selected file, if it was selected since the last frame other than by its row, so that the list may not show it.
fn led_to(ui: &Ui, list: Rect, entries: &[Entry], context: &PaneContext<'_>) -> Option<usize> {
    let key = Id::unique("file in sight");
    let selected = context.view.import.selected.clone();
    let before: Option<ImportItem> = ui.data(|data| data.get_temp(key));
    ui.data_mut(|data| selected.clone().map(|item| data.insert_temp(key, item)));
    let inside = ui.input(|input| input.pointer.interact_pos()).is_some_and(|at| list.contains(at));
    let index = entries.iter().position(|entry| Some(&entry.item) == selected.as_ref())?;
    (before != selected && !inside).then_some(index)
}

/// Shows the selected file; the others drop down. Returns the remaining area below.
pub(super) fn drop_down(ui: &mut Ui, rect: Rect, entries: &[Entry], context: &mut PaneContext<'_>) -> Rect {
    keys(ui, entries, context);
    let head = Rect::from_min_size(rect.min, Vec2::new(rect.width(), ROW));
    let below = rect.with_min_y(head.bottom() + UNIT);
    let selected = context.view.import.selected.clone();
    let Some(index) = entries.iter().position(|entry| Some(&entry.item) == selected.as_ref()) else { return below };
    let entry = &entries[index];
    draw_mark(ui.painter(), egui::pos2(head.left() + 6.0, head.center().y), entry.state, false, &context.theme);
    let list = Rect::from_min_max(head.min + Vec2::new(MARK, 0.0), head.max - Vec2::new(lines::DOTS + UNIT, 0.0));
    let mut child = ui.new_child(UiBuilder::new().id_salt("files list").max_rect(list));
    let shown = format!("{}  ({})", entry.name, entry.note);
    let words = ("Visible file", entry.state.words());
    let (response, chosen) = pick_list::combo(&mut child, words, shown, list.width(), &context.theme, || {
        let line = |entry: &Entry| {
            // A reason is too long for a list.
            let note = if entry.state == State::Failed { entry.state.words() } else { &entry.note };
            Line::new(format!("{}  ({note})", entry.name), Some(&entry.item) == selected.as_ref())
        };
        entries.iter().map(line).collect()
    });
    widgets::labeled(&response, egui::Role::ComboBox, format!("Visible file: {}, {}", entry.name, entry.state.words()));
    if context.view.import.takes_keyboard(Stop::Files) {
        response.request_focus();
    }
    if let Some(index) = chosen {
        select(ui, entries, index, context);
    }
    let dots = head.with_min_x(head.right() - lines::DOTS);
    menu(ui, dots, index, entries, context);
    below
}

fn id(index: usize) -> Id {
    Id::unique(("file of import", index))
}

fn select(ui: &Ui, entries: &[Entry], index: usize, context: &mut PaneContext<'_>) {
    if let Some(entry) = entries.get(index) {
        context.view.import.unseen.remove(&entry.item);
        context.view.select_file(entry.item.clone(), &context.scene.document.own);
        ui.ctx().request_repaint();
    }
}

/// Makes a set of the selected file, if it is none and can be read with the settings.
fn take(context: &mut PaneContext<'_>) {
    let Some(shown) = context.view.import.selection(&context.scene, context.opened) else { return };
    match shown.item {
        ImportItem::File(file) if shown.is_fresh() && !shown.taken().is_empty() => {
            context.push(Command::UseFile(file, Box::new(shown.overrides)));
        }
        ImportItem::File(_) => context.view.say("It cannot be read with these settings; see Interpretation (F6)."),
        ImportItem::Set(name) => context.view.say(format!("{name} is already imported.")),
    }
}

/// Arrows choose another file, Enter takes it, Delete takes one off. Returns the one chosen.
fn keys(ui: &Ui, entries: &[Entry], context: &mut PaneContext<'_>) -> Option<usize> {
    let focus = ui.memory(egui::Memory::focused);
    let on_row = focus.is_some_and(|focus| (0..entries.len()).any(|index| id(index) == focus));
    let mine = on_row || (focus.is_none() && context.view.focused == Some(PaneKind::IMPORT));
    if !mine || egui::Popup::is_any_open(ui.ctx()) {
        return None;
    }
    let pressed = |wanted: Key| {
        ui.input(|input| {
            let press = |event: &Event| matches!(event, Event::Key { key, pressed: true, modifiers, .. } if *key == wanted && modifiers.is_none());
            input.events.iter().any(press)
        })
    };
    let selected = context.view.import.selected.clone()?;
    let now = entries.iter().position(|entry| entry.item == selected)?;
    if pressed(Key::Delete) {
        remove(ui, now, entries, context);
        return None;
    }
    if on_row && pressed(Key::Enter) {
        take(context);
        return None;
    }
    let next = match (pressed(Key::ArrowUp), pressed(Key::ArrowDown)) {
        (true, false) => now.checked_sub(1)?,
        (false, true) => now + 1,
        _ => return None,
    };
    if next >= entries.len() {
        return None;
    }
    select(ui, entries, next, context);
    if on_row {
        ui.memory_mut(|memory| memory.request_focus(id(next)));
    }
    Some(next)
}

fn row(ui: &mut Ui, rect: Rect, index: usize, entries: &[Entry], context: &mut PaneContext<'_>) {
    let entry = &entries[index];
    let theme = context.theme;
    let rect = Rect::from_min_max(rect.min, rect.max - Vec2::new(SCROLL_BAR, 1.0));
    let response = ui.interact(rect, id(index), Sense::click());
    let on = context.view.import.selected.as_ref() == Some(&entry.item);
    let name = format!("{}: {} ({})", entry.name, entry.note, entry.state.words());
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::ListItem, true, on, &name));
    if response.has_focus() {
        let filter = egui::EventFilter { vertical_arrows: true, ..egui::EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(id(index), filter));
    }
    ground(ui, rect, &response, on, &theme);
    let middle = rect.top() + 0.5 * HEIGHT;
    draw_mark(ui.painter(), egui::pos2(rect.left() + 9.0, rect.top() + 10.0), entry.state, on, &theme);
    let left = rect.left() + MARK + 2.0;
    let upper = Rect::from_min_max(egui::pos2(left, rect.top() + 1.0), egui::pos2(rect.right() - lines::DOTS, middle));
    let lower = Rect::from_min_max(egui::pos2(left, middle), egui::pos2(rect.right() - UNIT, rect.bottom() - 2.0));
    lines::name(ui, upper, &entry.name, TextStyle::Body, theme.text);
    let color = match (on, entry.state) {
        // Neither gray nor red would be readable on the selection background.
        (true, _) => theme.text,
        (false, State::Failed) => theme.error,
        (false, _) => theme.weak,
    };
    if entry.state == State::Failed {
        lines::wrapped(ui, lower, &entry.note, 2, color);
    } else {
        lines::elided(ui, lower, &entry.note, TextStyle::Small, color);
    }
    let dots = Rect::from_min_max(egui::pos2(rect.right() - lines::DOTS, rect.top()), egui::pos2(rect.right(), middle));
    menu(ui, dots, index, entries, context);
    if response.clicked() {
        select(ui, entries, index, context);
    }
    response.on_hover_ui(|ui| {
        ui.label(&entry.name);
        widgets::note(ui, format!("{}; {}", entry.note, entry.state.words()));
        if let Some(path) = &entry.path {
            widgets::note(ui, path.display().to_string());
        }
    });
}

fn ground(ui: &Ui, rect: Rect, response: &Response, on: bool, theme: &Theme) {
    let fill = match (on, response.hovered()) {
        (true, _) => theme.chosen,
        (false, true) => theme.control,
        (false, false) => theme.panel,
    };
    if on || response.hovered() || response.has_focus() {
        ui.painter().rect(rect, 3.0, fill, focus_rim(response, theme), egui::StrokeKind::Inside);
    }
}

/// Each state has a shape of its own: a dot, a ring, a diamond, an open diamond, a dash, a triangle.
fn draw_mark(painter: &Painter, at: Pos2, state: State, on: bool, theme: &Theme) {
    let line = |color: Color32| Stroke::new(1.3, color);
    let gray = if on { theme.text } else { theme.weak };
    match state {
        State::Certain => {
            painter.circle_filled(at, 3.0, gray);
        }
        State::Seen => {
            painter.circle_stroke(at, 3.2, line(gray));
        }
        State::Unseen | State::Open => {
            let corners = [(0.0, -5.0), (5.0, 0.0), (0.0, 5.0), (-5.0, 0.0)];
            let corners = corners.map(|(x, y)| at + Vec2::new(x, y)).to_vec();
            let (fill, edge) = match state {
                State::Open => (Color32::TRANSPARENT, Stroke::new(1.5, if on { theme.text } else { theme.warning })),
                _ => (theme.warning, Stroke::NONE),
            };
            painter.add(Shape::convex_polygon(corners, fill, edge));
        }
        State::Unused => {
            painter.line_segment([at - Vec2::new(4.0, 0.0), at + Vec2::new(4.0, 0.0)], line(gray));
        }
        State::Failed => lines::warning_mark(painter, at, if on { theme.text } else { theme.error }),
    }
}

fn menu(ui: &Ui, rect: Rect, index: usize, entries: &[Entry], context: &mut PaneContext<'_>) {
    let entry = &entries[index];
    let button = lines::dots(ui, rect, id(index).with("dots"), &format!("Menu of {}", entry.name));
    egui::Popup::menu(&button).show(|ui| {
        if ui.button("Remove").on_hover_text("Remove from the list (Delete)").clicked() {
            remove(ui, index, entries, context);
            ui.close();
        }
        let again = ui.add_enabled(entry.path.is_some(), egui::Button::new("Reload"));
        if again.on_disabled_hover_text("Not from a file on disk").clicked() {
            context.push(match (&entry.item, &entry.path) {
                (ImportItem::File(_), Some(path)) => Command::OpenPath(path.clone()),
                _ => Command::ReadAgain(entry.name.clone()),
            });
            ui.close();
        }
        let alike =
            ui.add_enabled(entry.at_hand && entry.state != State::Failed, egui::Button::new("Use for all like it"));
        let hint = "Use these settings for all files of this kind, now and later";
        if alike
            .on_hover_text(hint)
            .on_disabled_hover_text("Not available, or not readable with these settings")
            .clicked()
        {
            context.push(Command::UseForAlike(entry.item.clone()));
            ui.close();
        }
    });
}

fn remove(ui: &Ui, index: usize, entries: &[Entry], context: &mut PaneContext<'_>) {
    let entry = &entries[index];
    let was_shown = context.view.import.selected.as_ref() == Some(&entry.item);
    context.view.import.unseen.remove(&entry.item);
    match &entry.item {
        ImportItem::Set(name) => context.push(Action::Imported(ImportedAction::Remove(name.clone()))),
        ImportItem::File(fingerprint) => context.push(Command::ForgetFile(*fingerprint)),
    }
    if was_shown && entries.len() > 1 {
        let next = if index + 1 < entries.len() { index + 1 } else { index - 1 };
        select(ui, entries, next, context);
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    /// Read without a doubt.
    Certain,
    /// Read with a guess that the user has seen.
    Seen,
    /// Read with a guess that the user has not reviewed.
    Unseen,
    /// Read as written: the role has to be chosen.
    Open,
    /// Not used, though it could be read.
    Unused,
    Failed,
}

impl State {
    pub(super) const ALL: [Self; 6] = [Self::Certain, Self::Seen, Self::Unseen, Self::Open, Self::Unused, Self::Failed];

    /// Description for tooltips and screen readers.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Certain => "read",
            Self::Seen => "read, with guesses",
            Self::Unseen => "read, with guesses that nobody has looked at",
            Self::Open => "not decided: choose what it is",
            Self::Unused => "not used",
            Self::Failed => "not read",
        }
    }
}

pub(super) struct Entry {
    pub(super) item: ImportItem,
    pub(super) name: String,
    pub(super) state: State,
    /// Contents, or the reason why it was not read.
    pub(super) note: String,
    pub(super) path: Option<PathBuf>,
    pub(super) at_hand: bool,
}

pub(super) fn all(context: &PaneContext<'_>) -> Vec<Entry> {
    let files = context.opened.files();
    let own = &context.scene.document.own;
    let sets = own.iter().map(|set| of_set(set, &files, context));
    // The contents that a file had before a change are retained for undo; in the list it is the same file.
    let is_of = |set: &ImportedSet, file: &OpenFile| {
        set.fingerprint == Some(file.origin.fingerprint)
            || (file.failure.is_none() && set.path.is_some() && set.path == file.origin.path)
    };
    let unused = files.iter().filter(|file| !own.iter().any(|set| is_of(set, file)));
    sets.chain(unused.map(of_file)).collect()
}

fn of_set(set: &ImportedSet, files: &[OpenFile], context: &PaneContext<'_>) -> Entry {
    let item = ImportItem::Set(set.name.clone());
    // A decision is a sentence that ends with its confidence; the role's comes first.
    let open = |decision: &String| decision.ends_with("(open)");
    let guessed = |decision: &String| decision.ends_with("(a guess)") || open(decision);
    let state = match (set.decisions.iter().any(guessed), context.view.import.unseen.contains(&item)) {
        _ if set.decisions.iter().any(open) => State::Open,
        (_, true) => State::Unseen,
        (true, false) => State::Seen,
        (false, false) => State::Certain,
    };
    let curves = if set.curves.len() == 1 { "1 curve".to_owned() } else { format!("{} curves", set.curves.len()) };
    let doubt = if set.decisions.first().is_some_and(guessed) { "?" } else { "" };
    let role = role(set.role, set.curves.len() == 1);
    let at_hand = files.iter().any(|file| Some(file.origin.fingerprint) == set.fingerprint);
    let note = format!("{curves}, {role}{doubt}");
    Entry { name: set.name.clone(), state, note, path: set.path.clone(), at_hand, item }
}

const fn role(role: Role, one: bool) -> &'static str {
    match (role, one) {
        (Role::Camera, _) => "a camera",
        (Role::Reflectance, true) => "reflectance",
        (Role::Reflectance, false) => "reflectances",
        (Role::Transmittance, true) => "transmittance",
        (Role::Transmittance, false) => "transmittances",
        (Role::Illuminant, true) => "a light",
        (Role::Illuminant, false) => "lights",
        (Role::Unknown, _) => "of unknown kind",
    }
}

fn of_file(file: &OpenFile) -> Entry {
    let name = file.origin.name.clone();
    let (state, note) = match &file.failure {
        Some(failure) => (State::Failed, reason(failure, &name).to_owned()),
        None => (State::Unused, "not used".to_owned()),
    };
    let item = ImportItem::File(file.origin.fingerprint);
    Entry { item, name, state, note, path: file.origin.path.clone(), at_hand: true }
}

fn reason<'a>(failure: &'a str, name: &str) -> &'a str {
    failure.strip_prefix(name).map_or(failure, |rest| rest.trim_start_matches([',', ':', ' ']))
}

pub(super) fn table(entries: &[Entry]) -> Table {
    let mut table = Table::new(["file", "state", "holds", "path"].map(str::to_owned));
    for entry in entries {
        let path = entry.path.as_ref().map_or(Cell::Empty, |path| Cell::Text(path.display().to_string()));
        let words = [entry.name.clone(), entry.state.words().to_owned(), entry.note.clone()].map(Cell::Text);
        table.push(words.into_iter().chain([path]).collect::<Vec<_>>());
    }
    table
}
