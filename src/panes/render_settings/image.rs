//! Spectral image in place of a mesh: facts, quantity and scale of its samples.

use egui::{DragValue, RichText, Ui};

use super::set;
use crate::catalog::spectral_images::ImageState;
use crate::document::render::{MeshChoice, QuantityChoice};
use crate::panes::context::PaneContext;
use crate::panes::widgets::pick_list::{self, Line};

/// Quantities with their names and hints.
const QUANTITIES: [(QuantityChoice, &str, &str); 3] = [
    (QuantityChoice::File, "As in the file", "The quantity that the file states"),
    (QuantityChoice::Reflectance, "Reflectance", "Lit by the scene's light"),
    (QuantityChoice::Radiance, "Radiance", "Taken as it is: the scene's light does nothing to it"),
];

/// Shows the controls, if an image is chosen.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let settings = context.scene.document.render.clone();
    let MeshChoice::Image(path) = &settings.mesh else { return };
    if let ImageState::Ready(image) = context.images.get(path) {
        let words = RichText::new(&image.summary).small().color(context.theme.weak);
        ui.label(words).on_hover_text(image.message());
    }
    ui.horizontal(|ui| {
        let now = settings.image_quantity;
        let name = QUANTITIES.iter().find(|(quantity, ..)| *quantity == now).map_or("", |(_, name, _)| name);
        let chosen = pick_list::drop_down(
            ui,
            ("Quantity", "Quantity of the image's samples"),
            name,
            150.0,
            &context.theme,
            || {
                let line = |(quantity, name, hint): (QuantityChoice, &str, &str)| Line {
                    facts: hint.to_owned(),
                    ..Line::new(name, quantity == now)
                };
                QUANTITIES.map(line).to_vec()
            },
        );
        if let Some(index) = chosen {
            set(context, "Quantity of the image", |settings| settings.image_quantity = QUANTITIES[index].0);
        }
        ui.label("Quantity");
    });
    ui.horizontal(|ui| {
        let mut scale = settings.image_scale;
        let field = DragValue::new(&mut scale).range(1e-12..=1e12).update_while_editing(false);
        let hint = "Sample that stands for 1, such as 10000, where the file does not state it";
        if ui.add(field).on_hover_text(hint).changed() && scale != settings.image_scale {
            set(context, "Scale of the image", |settings| settings.image_scale = scale);
        }
        ui.label("Sample for 1");
    });
}
