//! Full-well capacity and read noise of a pixel, in a menu; spectrum of a pixel of a spectral image.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{DragValue, Id, PopupCloseBehavior, RichText, Sense, Ui, Vec2};

use super::take_sought;
use crate::action::{Action, SceneAction};
use crate::document::Pixel;
use crate::figures::render::spectrum_panel;
use crate::paint::{self, PlotOptions};
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::render_service::RenderedFrame;
use crate::render_service::made::MadePictures;
use crate::scene::spectral_image::PixelSpectrumQuery;

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

pub const SPECTRUM_HEIGHT: f32 = 110.0;

/// Shows the samples of a pixel, right and down in the file, if an image is on show.
pub fn spectrum(ui: &mut Ui, id: &'static str, shot: &RenderedFrame, at: [usize; 2], context: &PaneContext<'_>) {
    let Some((query, image)) = shot.query.image().zip(shot.made().and_then(MadePictures::image)) else { return };
    let signals = &query.signals;
    let of = PixelSpectrumQuery { source: signals.source.clone(), wanted: signals.wanted, scale: signals.scale, at };
    let found = context.later.ask(id, vec![of]).current().ok().flatten();
    let points = match found.as_deref() {
        Some(Ok(points)) => points.as_slice(),
        Some(Err(why)) => {
            ui.label(RichText::new(why.to_string()).small().color(context.theme.error));
            return;
        }
        None => &[],
    };
    let (area, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), SPECTRUM_HEIGHT), Sense::hover());
    let panel = spectrum_panel(points, image.image.quantity, [area.width(), area.height()].map(f64::from));
    let options = PlotOptions { zoomable: false, ..PlotOptions::default() };
    let shown = paint::plot(ui, Id::unique(id), &panel, &context.theme, area, options);
    let near =
        shown.hovered.and_then(|[nm, _]| points.iter().min_by(|a, b| (a[0] - nm).abs().total_cmp(&(b[0] - nm).abs())));
    if let Some([nm, value]) = near {
        let words = [format!("{} nm", crate::format::number(*nm)), crate::format::number(*value)];
        widgets::read_at_pointer(&shown.response, &words);
    }
}
