//! The field of a number: drag it, or click and type. A number out of range is refused, with the range, not clamped.

use egui::{
    Align2, Area, CursorIcon, Event, Frame, Id, Key, Order, Rect, Response, Role, Sense, TextEdit, Ui, WidgetInfo,
};

use super::mark_all;
use crate::panes::context::PaneContext;
use crate::theme::UNIT;

pub struct NumberField<'a> {
    pub id: Id,
    pub now: f64,
    pub range: [f64; 2],
    pub speed: f64,
    pub unit: &'a str,
    pub name: &'a str,
    pub hint: &'a str,
}

/// The text being typed. Rejected text stays until it is corrected or discarded, or the number changes.
#[derive(Clone)]
struct Typed {
    of: f64,
    text: String,
    wrong: Option<String>,
}

impl NumberField<'_> {
    /// Shows the field in a rectangle; `focus` gives it the keyboard with all text selected. Returns a number that was chosen.
    pub fn show(&self, ui: &mut Ui, rect: Rect, focus: bool, context: &mut PaneContext<'_>) -> Option<f64> {
        if focus {
            ui.memory_mut(|memory| memory.request_focus(self.id));
            ui.data_mut(|data| data.remove::<Typed>(self.id));
        }
        let typed: Option<Typed> = ui.data(|data| data.get_temp(self.id));
        let typed = typed.filter(|typed| typed.of == self.now || ui.memory(|memory| memory.has_focus(self.id)));
        match typed {
            Some(typed) => self.edit(ui, rect, typed, context),
            None if ui.memory(|memory| memory.has_focus(self.id)) => {
                let text = self.digits();
                mark_all(ui, self.id, &text);
                self.edit(ui, rect, Typed { of: self.now, text, wrong: None }, context)
            }
            None => self.drag(ui, rect, context),
        }
    }

    /// The number as a button: dragging changes it, a click lets it be typed.
    fn drag(&self, ui: &mut Ui, rect: Rect, context: &PaneContext<'_>) -> Option<f64> {
        let response = ui.interact(rect, self.id, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::slider(true, self.now, self.name));
        let theme = &context.theme;
        let fill = if response.hovered() || response.dragged() { theme.hover } else { theme.control };
        ui.painter().rect_filled(rect, 3.0, fill);
        let words = format!("{} {}", self.digits(), self.unit);
        let font = egui::TextStyle::Button.resolve(ui.style());
        ui.painter().text(rect.center(), Align2::CENTER_CENTER, words, font, theme.text);
        if response.clicked() {
            response.request_focus();
            // In a slow frame the first letters may come with the click.
            let typed = |event: &Event| if let Event::Text(text) = event { Some(text.clone()) } else { None };
            let text: String = ui.input(|input| input.events.iter().filter_map(typed).collect());
            if !text.is_empty() {
                ui.data_mut(|data| data.insert_temp(self.id, Typed { of: self.now, text, wrong: None }));
            }
        }
        let moved = f64::from(response.drag_delta().x) * self.speed;
        response.on_hover_cursor(CursorIcon::ResizeHorizontal).on_hover_text(self.hint);
        let [least, largest] = self.range;
        (moved != 0.0).then(|| (self.now + moved).round().clamp(least, largest)).filter(|chosen| *chosen != self.now)
    }

    fn edit(&self, ui: &mut Ui, rect: Rect, mut typed: Typed, context: &mut PaneContext<'_>) -> Option<f64> {
        let mut edit = TextEdit::singleline(&mut typed.text).id(self.id).margin(egui::Margin::symmetric(4, 4));
        if typed.wrong.is_some() {
            edit = edit.text_color(context.theme.error);
        }
        let response = ui.put(rect, edit.desired_width(rect.width()));
        super::lines::labeled(&response, Role::TextInput, self.name);
        if response.changed() {
            typed.wrong = None;
        }
        // Escape discards the typed text, and nothing else; refused text also from elsewhere.
        let given_up = ui.input(|input| input.key_down(Key::Escape));
        context.view.keeps_escape |= response.has_focus() || typed.wrong.is_some();
        let arrows =
            ui.input(|input| input.num_presses(Key::ArrowUp) as f64 - input.num_presses(Key::ArrowDown) as f64);
        if response.has_focus() && arrows != 0.0 {
            let [least, largest] = self.range;
            let chosen = (self.now + arrows * self.speed).clamp(least, largest);
            typed = Typed { of: chosen, text: format!("{chosen:.0}"), wrong: None };
            mark_all(ui, self.id, &typed.text);
            ui.data_mut(|data| data.insert_temp(self.id, typed));
            return (chosen != self.now).then_some(chosen);
        }
        if !response.lost_focus() && (response.has_focus() || typed.wrong.is_some() && !given_up) {
            self.explain(ui, &response, &typed, context);
            ui.data_mut(|data| data.insert_temp(self.id, typed));
            return None;
        }
        let taken = if given_up || typed.text == self.digits() { Ok(None) } else { self.read(&typed.text).map(Some) };
        match taken {
            Ok(chosen) => {
                ui.data_mut(|data| data.remove::<Typed>(self.id));
                chosen.filter(|chosen| *chosen != self.now)
            }
            Err(wrong) => {
                // Enter keeps the focus on a field whose text was rejected.
                if ui.input(|input| input.key_pressed(Key::Enter)) {
                    response.request_focus();
                }
                typed = Typed { of: self.now, wrong: Some(wrong), ..typed };
                self.explain(ui, &response, &typed, context);
                ui.data_mut(|data| data.insert_temp(self.id, typed));
                None
            }
        }
    }

    /// The reason below the field for rejecting the typed text.
    fn explain(&self, ui: &Ui, response: &Response, typed: &Typed, context: &PaneContext<'_>) {
        let Some(wrong) = &typed.wrong else { return };
        let at = response.rect.left_bottom() + egui::vec2(0.0, UNIT);
        let area = Area::new(self.id.with("reason")).order(Order::Foreground).fixed_pos(at).interactable(false);
        area.show(ui.ctx(), |ui| {
            Frame::popup(ui.style()).show(ui, |ui| ui.colored_label(context.theme.error, wrong));
        });
    }

    fn digits(&self) -> String {
        format!("{:.0}", self.now)
    }

    /// The number of a text, or the range that it is not in.
    fn read(&self, text: &str) -> Result<f64, String> {
        let text = text.trim();
        let text = text.strip_suffix(self.unit).unwrap_or(text).trim_end();
        let [least, largest] = self.range;
        match text.parse::<f64>() {
            Ok(number) if (least..=largest).contains(&number) => Ok(number),
            _ => Err(format!("{least:.0} to {largest:.0} {}", self.unit)),
        }
    }
}
