//! Sentences about a pane's numbers: at its head a condition under which they have an unusual meaning, at its foot what they mean.

use egui::{Align, Layout, Rect, TextStyle, Ui, UiBuilder, Vec2};

use super::lines;
use crate::action::{Action, SceneAction};
use crate::document::TransformChoice;
use crate::panes::context::PaneContext;
use crate::theme::{ROW, UNIT};

/// Shows the scene's caution, if there is one, with its remedy as a button. Returns the rectangle that remains below.
pub fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) -> Rect {
    let Some(caution) = context.scene.caution() else { return rect };
    let line = Rect::from_min_size(rect.min, Vec2::new(rect.width(), ROW));
    let layout = Layout::right_to_left(Align::Center);
    let mut row = ui.new_child(UiBuilder::new().id_salt("caution").max_rect(line).layout(layout));
    row.set_clip_rect(line.intersect(ui.clip_rect()));
    if let Some(observer) = caution.fit_to() {
        let words = format!("Fit 3×3 to {observer}");
        let hint = "Color transform: a 3×3 matrix for each camera, fitted to this observer";
        let transform = TransformChoice::Observer(observer.to_owned());
        context.button(&mut row, &words, hint, Action::Scene(SceneAction::SetTransform(transform)));
    }
    let sentence = caution.sentence();
    let mut rest = Rect::from_min_max(line.min, egui::pos2(row.min_rect().left() - 2.0 * UNIT, line.bottom()));
    if caution.fit_to().is_none() {
        rest.max.x = line.right();
    }
    lines::warning_mark(ui.painter(), egui::pos2(rest.left() + 7.0, rest.center().y), context.theme.warning);
    rest.min.x += 5.0 * UNIT;
    lines::elided(ui, rest, &sentence, TextStyle::Small, context.theme.warning);
    let response =
        super::named(ui, rest, ui.scope_id().with(("caution", rect.min.x as i32)), egui::Role::Alert, &sentence);
    response.on_hover_text(sentence);
    Rect::from_min_max(egui::pos2(rect.left(), line.bottom() + 0.5 * UNIT), rect.max)
}

/// Largest share of a pane's height that sentences at its foot take; longer ones are cut and stand under the pointer.
const FOOT: f32 = 0.3;

/// Writes sentences at the foot of a pane. Returns the rectangle that remains above.
pub fn foot(ui: &Ui, rect: Rect, words: &str, context: &PaneContext<'_>) -> Rect {
    let font = TextStyle::Small.resolve(ui.style());
    let galley = ui.painter().layout(words.to_owned(), font, context.theme.weak, rect.width());
    let line = galley.rows.first().map_or(0.0, |row| row.height());
    let fits = galley.size().y <= FOOT * rect.height();
    let height = if fits { galley.size().y } else { line };
    let place = Rect::from_min_max(egui::pos2(rect.left(), rect.bottom() - height), rect.max);
    if fits {
        ui.painter().galley(place.min, galley, context.theme.weak);
    } else {
        lines::elided(ui, place, words, TextStyle::Small, context.theme.weak);
    }
    let response = super::named(ui, place, ui.scope_id().with(("foot", rect.min.x as i32)), egui::Role::Label, words);
    response.on_hover_text(words);
    Rect::from_min_max(rect.min, egui::pos2(rect.right(), place.top() - UNIT))
}
