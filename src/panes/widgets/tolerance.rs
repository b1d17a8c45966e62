//! Tolerance field: a slider over powers of ten, and a text field that explains errors.

use egui::{Id, Key, RichText, Role, Slider, TextEdit, Ui, WidgetInfo};

use crate::document::render::{TOLERANCES, decade};
use crate::panes::context::PaneContext;

const TAKES: &str = "From 1e−13 to 0.1, such as 5e-10; the slider moves in powers of ten";
const TEXT: f32 = 72.0;

/// Typed text that was rejected: it stays in the field until the tolerance changes or other text is typed.
#[derive(Clone)]
struct Typed {
    /// The tolerance that it did not replace.
    of: f64,
    text: String,
    wrong: Option<String>,
}

/// Shows the slider, the text field with `words`, and an error below. Returns the chosen tolerance.
pub fn field(ui: &mut Ui, id: Id, now: f64, words: &str, hint: &str, context: &mut PaneContext<'_>) -> Option<f64> {
    let theme = context.theme;
    let kept = ui.data(|data| data.get_temp::<Typed>(id)).filter(|typed| typed.of == now);
    let mut typed = kept.unwrap_or_else(|| Typed { of: now, text: shown(now), wrong: None });
    let mut chosen = None;
    ui.horizontal(|ui| {
        let mut power = now.log10().round();
        let range = TOLERANCES.start().log10()..=TOLERANCES.end().log10();
        let slider = ui.add(Slider::new(&mut power, range).step_by(1.0).show_value(false)).on_hover_text(hint);
        slider.widget_info(|| WidgetInfo::slider(true, power, "Tolerance, power of ten"));
        if slider.changed() {
            chosen = Some(decade(10_f64.powf(power)));
        }
        let mut edit = TextEdit::singleline(&mut typed.text).id(id.with("text")).desired_width(TEXT);
        if typed.wrong.is_some() {
            edit = edit.text_color(theme.error);
        }
        let text = ui.add(edit).on_hover_text(format!("{TAKES}.\n{hint}"));
        super::lines::labeled(&text, Role::TextInput, "Tolerance");
        if text.changed() {
            typed.wrong = None;
        }
        // Escape discards the typed text, and nothing else.
        context.view.keeps_escape = text.has_focus() || context.view.keeps_escape && !text.lost_focus();
        if text.lost_focus() && ui.input(|input| input.key_down(Key::Escape)) {
            typed = Typed { of: now, text: shown(now), wrong: None };
        } else if text.lost_focus() && typed.text != shown(now) {
            match tolerance(&typed.text) {
                Ok(tolerance) => chosen = Some(tolerance),
                Err(wrong) => typed.wrong = Some(wrong),
            }
        }
        if !words.is_empty() {
            ui.label(words).on_hover_text(hint);
        }
    });
    if let Some(wrong) = &typed.wrong {
        ui.label(RichText::new(wrong).small().color(theme.error));
    }
    // A chosen value is shown in canonical form, even if it is unchanged.
    if chosen.is_some() {
        typed = Typed { of: now, text: shown(now), wrong: None };
    }
    ui.data_mut(|data| data.insert_temp(id, typed));
    chosen.filter(|chosen| *chosen != now)
}

fn shown(tolerance: f64) -> String {
    format!("{tolerance:e}").replace('-', "−")
}

fn tolerance(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let (least, largest) = (shown(*TOLERANCES.start()), TOLERANCES.end());
    let give = format!("range {least} to {largest}");
    match text.replace('−', "-").parse::<f64>() {
        Ok(number) if TOLERANCES.contains(&number) => Ok(number),
        Ok(number) if number > *TOLERANCES.end() => Err(format!("{text} is too large: {give}.")),
        Ok(number) if number > 0.0 => Err(format!("{text} is too small: {give}; S itself is accurate to {least}.")),
        Ok(number) if number <= 0.0 => Err(format!("The tolerance must be above 0; {give}.")),
        _ if text.is_empty() => Err(format!("Enter a number; {give}.")),
        _ => Err(format!("“{text}” is not a number; write one like 1e-6, {least} to {largest}.")),
    }
}
