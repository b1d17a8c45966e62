//! Full-well capacity and read noise of a pixel, in a menu.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{DragValue, PopupCloseBehavior, Ui};

use super::take_sought;
use crate::action::{Action, SceneAction};
use crate::document::Pixel;
use crate::panes::context::PaneContext;

pub const PIXEL: &str = "Pixel";
const HINT: &str =
    "Full-well capacity and read noise of a pixel: with them SNR, the signal-to-noise ratio of a gray, has values";

pub fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (response, _) = MenuButton::new(PIXEL).config(config).ui(ui, |ui| fields(ui, context));
    take_sought(&response, PIXEL);
    response.on_hover_text(HINT);
}

fn fields(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let before = context.scene.document.pixel.unwrap_or(Pixel { full_well: 0.0, read_noise: 0.0 });
    let mut pixel = before;
    let mut field = |name: &str, value: &mut f64, most: f64, hint: &str| {
        let speed = (*value * 0.01).max(0.1);
        let field = DragValue::new(value).range(0.0..=most).speed(speed).max_decimals(2).suffix(" electrons");
        ui.horizontal(|ui| {
            let label = ui.label(name);
            ui.add(field.update_while_editing(false)).labelled_by(label.id).on_hover_text(hint);
        });
    };
    field("Full-well capacity", &mut pixel.full_well, Pixel::LARGEST, "Up to 1e9 electrons; 0: not given");
    let full_well = pixel.full_well;
    field("Read noise (RMS)", &mut pixel.read_noise, full_well, "Up to the full-well capacity");
    pixel.read_noise = pixel.read_noise.min(full_well);
    if pixel != before {
        let pixel = (pixel.full_well > 0.0).then_some(pixel);
        context.push(Action::Scene(SceneAction::SetPixel(pixel)));
    }
}
