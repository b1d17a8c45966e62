//! A list: groups, one highlighted line, arrow keys, Enter. A long one is filtered by what is typed, a short one goes to it.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{
    Align2, ComboBox, Event, EventFilter, Id, Key, Modifiers, PopupCloseBehavior, Rect, Response, Role, ScrollArea,
    Sense, Stroke, TextEdit, TextStyle, Ui, Vec2, WidgetInfo, WidgetText,
};

use super::lines;
use crate::catalog::Entry;
use crate::catalog::names::{no_match, ranked};
use crate::document::SetKind;
use crate::theme::{ROW, Theme, UNIT};
use crate::view::PickState;

const GUTTER: f32 = 18.0;
/// Largest share of a line that its note takes.
const NOTE: f32 = 0.45;
const PAGE: usize = 10;
/// Up to this many alternatives have no field to filter them.
const SHORT: usize = 10;
/// Seconds within which letters belong to one word.
const ONE_WORD: f64 = 1.0;
/// Height of the list below a control before it scrolls.
const DROPPED: f32 = 14.0 * ROW;
const LEAST: f32 = 280.0;
/// Greatest width of that list; longer names are told on hover.
const MOST: f32 = 440.0;

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Line {
    pub words: String,
    pub note: String,
    /// What is known of it, told when it is pointed at.
    pub facts: String,
    pub also: String,
    /// True if it is what is set now.
    pub on: bool,
    /// True for the head of a group, which cannot be chosen.
    pub is_heading: bool,
}

impl Line {
    pub fn new(words: impl Into<String>, on: bool) -> Self {
        Self { words: words.into(), on, ..Self::default() }
    }

    pub fn heading(words: impl Into<String>) -> Self {
        Self { words: words.into(), is_heading: true, ..Self::default() }
    }

    pub fn of_set(entry: &Entry, on: bool) -> Self {
        let words = if entry.kind == SetKind::Illuminant { entry.glossed_name() } else { entry.name.clone() };
        Self { also: entry.gloss(), ..Self::new(words, on) }
    }
}

/// The lines that fit a text below their headings, as indices: the best group first, and the best line first in it.
pub fn found(all: &[Line], text: &str) -> Vec<usize> {
    let mut heading = None;
    let lines = all.iter().enumerate().filter_map(|(index, line)| {
        if line.is_heading {
            heading = Some(index);
        }
        (!line.is_heading).then_some((heading, index))
    });
    let groups = ranked(text, lines, |&(heading, index)| (heading, all[index].words.clone(), all[index].also.clone()));
    groups
        .into_iter()
        .flat_map(|(heading, lines)| heading.into_iter().chain(lines.into_iter().map(|(_, index)| index)))
        .collect()
}

pub struct PickList<'a> {
    pub id: Id,
    pub name: &'a str,
    pub hint: &'a str,
    pub height: f32,
    /// The line that is set is highlighted first, not the uppermost.
    pub from_set: bool,
    /// True if all lines are seen at once: no field, and letters highlight the next line that begins with them, else one with
    /// such a word.
    pub is_short: bool,
}

impl PickList<'_> {
    /// Shows field and lines. `lines` are those that match the text. Returns the line that was chosen, as an index.
    pub fn show(
        &self,
        ui: &mut Ui,
        state: &mut PickState,
        lines: impl FnOnce(&str) -> Vec<Line>,
        theme: &Theme,
    ) -> Option<usize> {
        let moved = self.moved(ui);
        // Before it is drawn: in a slow frame the first letters come with the key that opened the list.
        if !ui.memory(|memory| memory.has_focus(self.id)) {
            ui.memory_mut(|memory| memory.request_focus(self.id));
        }
        let field = self.field(ui, state);
        lines::labeled(&field, if self.is_short { Role::ListBox } else { Role::TextInput }, self.name);
        if field.changed() {
            state.picked = None;
        }
        let lines = lines(&state.text);
        let choices: Vec<usize> = (0..lines.len()).filter(|&index| !lines[index].is_heading).collect();
        let is_blank = state.text.trim().is_empty();
        let set = choices.iter().position(|&index| lines[index].on).filter(|_| is_blank && self.from_set);
        let first = state.picked.is_none();
        let last = choices.len().saturating_sub(1);
        let now = state.picked.or(set).unwrap_or(0).min(last);
        let typed = self.is_short.then(|| self.typed(ui)).flatten().and_then(|text| {
            let begins = |&at: &usize| lines[choices[at]].words.to_lowercase().starts_with(&text);
            // Symbols cannot be typed: else a word of the line, or of what else it is found by, begins with the letters.
            let has_word = |words: &str| {
                let words = words.to_lowercase();
                words.match_indices(text.as_str()).any(|(at, _)| !words[..at].ends_with(char::is_alphanumeric))
            };
            let within = |&at: &usize| has_word(&lines[choices[at]].words) || has_word(&lines[choices[at]].also);
            // One letter again goes on to the next line.
            let from = (now + usize::from(text.chars().count() == 1)).min(choices.len());
            let order = || (from..choices.len()).chain(0..from);
            order().find(begins).or_else(|| order().find(within))
        });
        let picked = typed.unwrap_or(now.saturating_add_signed(moved).min(last));
        state.picked = Some(picked);
        if choices.is_empty() {
            ui.label(no_match(&state.text));
            return None;
        }
        // The Enter that opens a short list is no choice from it.
        let ends = field.lost_focus() || (self.is_short && !first);
        let entered = ends && ui.input(|input| input.key_pressed(Key::Enter));
        let clicked =
            self.lines(ui, &lines, choices[picked], (moved != 0 || first || typed.is_some()).then_some(picked), theme);
        clicked.or(entered.then(|| choices[picked]))
    }

    /// The field of the text, or the place that has the keyboard in a short list.
    fn field(&self, ui: &mut Ui, state: &mut PickState) -> Response {
        if !self.is_short {
            // In a menu the field is higher than its text.
            let field = TextEdit::singleline(&mut state.text).id(self.id).align(Align2::LEFT_CENTER);
            return ui.add(field.hint_text(self.hint).desired_width(f32::INFINITY));
        }
        let keys = EventFilter { vertical_arrows: true, horizontal_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(self.id, keys));
        ui.interact(Rect::from_min_size(ui.cursor().min, Vec2::ZERO), self.id, Sense::focusable_noninteractive())
    }

    /// Letters typed within a short time, once another one came.
    fn typed(&self, ui: &Ui) -> Option<String> {
        let (now, new) = ui.input(|input| {
            let text = |event: &Event| if let Event::Text(text) = event { Some(text.to_lowercase()) } else { None };
            (input.time, input.events.iter().filter_map(text).collect::<String>())
        });
        let key = self.id.with("typed");
        let (before, at): (String, f64) = ui.data(|data| data.get_temp(key)).unwrap_or_default();
        let typed = if now - at < ONE_WORD && before != new { before + &new } else { new.clone() };
        // A space may have opened the list.
        let typed = typed.trim_start().to_owned();
        (!new.is_empty() && !typed.is_empty()).then(|| {
            ui.data_mut(|data| data.insert_temp(key, (typed.clone(), now)));
            typed
        })
    }

    /// Lines that the keys move the highlight by while the field has the keyboard.
    fn moved(&self, ui: &Ui) -> isize {
        if !ui.memory(|memory| memory.has_focus(self.id)) {
            return 0;
        }
        let pressed = |key| ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key)).cast_signed();
        let page = PAGE.cast_signed();
        pressed(Key::ArrowDown) - pressed(Key::ArrowUp) + page * (pressed(Key::PageDown) - pressed(Key::PageUp))
    }

    fn lines(&self, ui: &mut Ui, all: &[Line], picked: usize, follow: Option<usize>, theme: &Theme) -> Option<usize> {
        let mut clicked = None;
        ui.spacing_mut().item_spacing.y = 0.0;
        let mut area = ScrollArea::vertical().id_salt(self.id).max_height(self.height).auto_shrink([false, true]);
        let key = self.id.with("offset");
        let [offset, height] = ui.data(|data| data.get_temp::<[f32; 2]>(key)).unwrap_or([0.0, self.height]);
        if follow.is_some() {
            let top = ROW * picked as f32;
            // The heading above a group's first line stays in sight.
            let above = if picked > 0 && all[picked - 1].is_heading { top - ROW } else { top };
            area = area.vertical_scroll_offset(offset.min(above).max(top + ROW - height));
        }
        let shown = area.show_rows(ui, ROW, all.len(), |ui, rows| {
            for index in rows {
                if row(ui, &all[index], index == picked, theme) {
                    clicked = Some(index);
                }
            }
        });
        ui.data_mut(|data| data.insert_temp(key, [shown.state.clamped_offset().y, shown.inner_rect.height()]));
        clicked
    }
}

fn row(ui: &mut Ui, line: &Line, picked: bool, theme: &Theme) -> bool {
    let size = Vec2::new(ui.available_width(), ROW);
    if line.is_heading {
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        let place = rect.shrink2(Vec2::new(UNIT, 0.0));
        lines::elided(ui, place, &line.words, TextStyle::Small, theme.weak);
        lines::labeled(&response, Role::Label, &line.words);
        return false;
    }
    let (rect, response) = ui.allocate_exact_size(size, Sense::click() - Sense::FOCUSABLE);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, picked, &line.words));
    if picked || response.hovered() {
        let fill = if picked { theme.chosen } else { theme.control };
        ui.painter().rect_filled(rect, 3.0, fill);
    }
    if line.on {
        tick(ui.painter(), rect.left_center() + Vec2::new(0.5 * GUTTER, 0.0), theme.text);
    }
    let words = Rect::from_min_max(rect.min + Vec2::new(GUTTER, 0.0), rect.max - Vec2::new(2.0 * UNIT, 0.0));
    let color = if picked { theme.text } else { theme.weak };
    let room = words.with_min_x(words.right() - NOTE * words.width());
    let note =
        if line.note.is_empty() { 0.0 } else { lines::right_aligned(ui, room, &line.note, TextStyle::Small, color) };
    let place = words.with_max_x(words.right() - note - 2.0 * UNIT);
    let cut = lines::elided(ui, place, &line.words, TextStyle::Body, theme.text);
    let told = [line.words.as_str(), &line.facts];
    let told = &told[usize::from(!cut)..2 - usize::from(line.facts.is_empty())];
    if !told.is_empty() {
        response.clone().on_hover_text(told.join("\n"));
    }
    response.clicked()
}

pub fn tick(painter: &egui::Painter, at: egui::Pos2, color: egui::Color32) {
    let points = [Vec2::new(-4.0, 0.5), Vec2::new(-1.0, 3.5), Vec2::new(4.5, -3.5)].map(|step| at + step);
    painter.line(points.to_vec(), Stroke::new(1.5, color));
}

/// A control that drops down a list filtered as one types. `lines` are all lines. Returns the line that was chosen.
pub fn drop_down(
    ui: &mut Ui,
    words: (&str, &str),
    shown: impl Into<WidgetText>,
    width: f32,
    theme: &Theme,
    lines: impl FnOnce() -> Vec<Line>,
) -> Option<usize> {
    combo(ui, words, shown, width, theme, lines).1
}

/// The same, with the control itself.
pub fn combo(
    ui: &mut Ui,
    (name, hint): (&str, &str),
    shown: impl Into<WidgetText>,
    width: f32,
    theme: &Theme,
    lines: impl FnOnce() -> Vec<Line>,
) -> (Response, Option<usize>) {
    let shown = shown.into();
    let words = shown.text().to_owned();
    let key = ui.make_persistent_id((name, "filter"));
    let combo = ComboBox::from_id_salt(name)
        .width(width)
        .height(DROPPED + 2.0 * ROW)
        .truncate()
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .selected_text(shown);
    let opened = combo.show_ui(ui, |ui| within(ui, key, name, theme, &lines()));
    if opened.inner.is_none() {
        ui.data_mut(|data| data.remove::<PickState>(key));
    }
    let response = opened.response;
    lines::labeled(&response, Role::ComboBox, format!("{name}: {words}"));
    let told = if hint.is_empty() { format!("Now: {words}") } else { format!("{hint}\nNow: {words}") };
    (response.on_hover_text(told), opened.inner.flatten())
}

/// A button that opens a list filtered as one types, with a heading of what it chooses. Returns the line that was chosen.
pub fn menu(
    ui: &mut Ui,
    (words, name, hint): (&str, &str, &str),
    theme: &Theme,
    lines: impl FnOnce() -> Vec<Line>,
) -> (Response, Option<usize>) {
    let key = ui.make_persistent_id((name, words));
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (response, opened) = MenuButton::new(words).config(config).ui(ui, |ui| within(ui, key, name, theme, &lines()));
    if opened.is_none() {
        ui.data_mut(|data| data.remove::<PickState>(key));
    }
    (response.on_hover_text(hint), opened.and_then(|opened| opened.inner))
}

fn within(ui: &mut Ui, key: Id, name: &str, theme: &Theme, all: &[Line]) -> Option<usize> {
    let widest = |words: fn(&Line) -> &str, style| {
        let longest = all.iter().map(words).max_by_key(|words| words.chars().count()).unwrap_or("");
        lines::width(ui, longest, style)
    };
    let wide = widest(|line| &line.words, TextStyle::Body) + widest(|line| &line.note, TextStyle::Small);
    ui.set_min_width((wide + GUTTER + 6.0 * UNIT).clamp(LEAST, MOST));
    let mut state: PickState = ui.data(|data| data.get_temp(key)).unwrap_or_default();
    let mut places = Vec::new();
    let is_short = all.iter().filter(|line| !line.is_heading).count() <= SHORT;
    let field = if is_short { name.to_owned() } else { format!("Filter {name}") };
    let lines = |text: &str| {
        places = found(all, text);
        places.iter().map(|&index| all[index].clone()).collect()
    };
    let list = PickList { id: key, name: &field, hint: "Type to filter", height: DROPPED, from_set: true, is_short };
    let chosen = list.show(ui, &mut state, lines, theme);
    ui.data_mut(|data| data.insert_temp(key, state));
    if chosen.is_some() {
        ui.close();
    }
    chosen.and_then(|index| places.get(index).copied())
}
