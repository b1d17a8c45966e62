//! Pinned pixel of the rendered pictures, through every sensor.

use egui::{RichText, Ui};

use super::note;
use crate::figures::chromaticity::id;
use crate::figures::render::headline::{Detail, Measure};
use crate::figures::render::{NO_VALUE, facts, index_of, pixel_of};
use crate::panes::context::PaneContext;
use crate::panes::widgets::lines::key_and_label;
use crate::panes::widgets::pixel_spectrum;
use crate::panes::widgets::table::show_pairs;
use crate::render_service::pixel::PixelShows;
use crate::theme::UNIT;
use crate::view::render::PixelPlace;
use crate::workspaces::PaneKind;

pub(super) fn pinned_pixel<'a>(context: &'a PaneContext<'_>) -> Option<&'a PixelPlace> {
    let (saved, render) = (&context.view.saved, &context.view.render);
    render.pinned.as_ref().filter(|_| saved.layout.shows(saved.workspace, PaneKind::RENDER))
}

pub(super) fn show(ui: &mut Ui, context: &PaneContext<'_>) {
    let Some((pinned, shot)) = pinned_pixel(context).zip(context.render_service.frame()) else { return };
    ui.add_space(UNIT);
    ui.label(RichText::new("Pinned pixel").strong());
    let measure = Measure::of_frame(shot);
    if let Some(reading) = pixel_of(&context.scene, shot, pinned) {
        pixel_spectrum::show(ui, "spectrum in inspector", shot, reading.at, context);
    }
    for source in shot.sources.iter() {
        let place = PixelPlace { source: id(source), ..pinned.clone() };
        let Some(reading) = pixel_of(&context.scene, shot, &place) else { continue };
        key_and_label(ui, source, &context.theme);
        let made = shot.made().zip(index_of(shot, &place.source));
        if let Some(difference) = made.and_then(|(made, at)| made.differences.get(at)?.as_ref()) {
            note(ui, &context.theme, measure.words(difference, Detail::Quantiles));
        }
        match reading.shows {
            PixelShows::Nothing => note(ui, &context.theme, "Beside the mesh."),
            PixelShows::NoValue => note(ui, &context.theme, NO_VALUE),
            PixelShows::Unlit => note(ui, &context.theme, "No light reaches it."),
            PixelShows::Lit(lit) => {
                let id = format!("pinned pixel {}", source.name);
                show_pairs(ui, PaneKind::INSPECTOR, &id, &facts(&lit, measure), context);
            }
        }
    }
}
