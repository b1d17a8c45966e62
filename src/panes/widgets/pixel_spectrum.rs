//! Spectrum of a pixel of a spectral image.

use egui::{Id, RichText, Sense, Ui, Vec2};

use crate::figures::render::spectrum_panel;
use crate::paint::{self, PlotOptions};
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::render_service::RenderedFrame;
use crate::render_service::made::MadePictures;
use crate::scene::spectral_image::PixelSpectrumQuery;

pub const HEIGHT: f32 = 110.0;

/// Shows the samples of a pixel, right and down in the file, if an image is on show.
pub fn show(ui: &mut Ui, id: &'static str, shot: &RenderedFrame, at: [usize; 2], context: &PaneContext<'_>) {
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
    let (area, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), HEIGHT), Sense::hover());
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
