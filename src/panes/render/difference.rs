//! The scale below maps of differences.

use egui::{Align2, FontId, Painter, Pos2, Rect, Sense, Ui, Vec2};

use crate::figures::render::difference::Scale;
use crate::palette::difference_ramp;
use crate::panes::context::PaneContext;
use crate::theme::SMALL;

/// The color scale of differences.
pub(super) fn scale(ui: &mut Ui, painter: &Painter, rect: Rect, scale: Scale, name: &str, context: &PaneContext<'_>) {
    let color = context.theme.on_surround;
    let font = FontId::proportional(SMALL);
    let words = format!("{name} from the reference");
    let title = painter.text(rect.left_center() + Vec2::new(8.0, 0.0), Align2::LEFT_CENTER, words, font.clone(), color);
    let left = title.right() + 16.0;
    let bar = Rect::from_min_max(
        Pos2::new(left, rect.top() + 6.0),
        Pos2::new(left.max(rect.right() - 120.0), rect.top() + 18.0),
    );
    crate::paint::ramp(painter, bar, &difference_ramp);
    for (share, value) in scale.ticks() {
        let at = Pos2::new(bar.left() + share * bar.width(), bar.bottom() + 2.0);
        painter.text(at, Align2::CENTER_TOP, value, font.clone(), color);
    }
    let dark = Pos2::new(rect.right() - 8.0, bar.center().y);
    let is_image = context.scene.document.render.mesh.is_image();
    let words = if is_image { "dark: no value" } else { "hatched: no light" };
    painter.text(dark, Align2::RIGHT_CENTER, words, font, color);
    let response = ui.interact(rect, ui.scope_id().with("difference scale"), Sense::hover());
    let said = format!("Scale of {name} from the reference, from 0 to {}", scale.end);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &said));
    response.on_hover_text(if is_image {
        "Of each pixel; a reflectance of 1, or the white of radiances, has Y = 1."
    } else {
        "Of each lit sample; a white of the same roughness that faces the light has Y = 1."
    });
}
