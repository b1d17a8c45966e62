//! The pixel that is kept, in numbers.

use egui::{Grid, RichText, Ui};

use crate::figures::render::headline::Measure;
use crate::figures::render::{facts, index_of, pixel_of};
use crate::panes::context::PaneContext;
use crate::plot_item::SensorId;
use crate::render_service::RenderedFrame;
use crate::render_service::pixel::PixelShows;
use crate::theme::UNIT;
use crate::view::render::PixelPlace;

/// Shows the group.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    ui.spacing_mut().item_spacing.y = 0.5 * UNIT;
    ui.spacing_mut().interact_size.y = 14.0;
    let weak = context.theme.weak;
    let Some(pinned) = context.view.render.pinned.clone() else {
        ui.label(
            RichText::new("Point at a picture to read it; click to pin the pixel, Esc to unpin it.")
                .small()
                .color(weak),
        );
        return;
    };
    let found = context.studio.frame().and_then(|shot| {
        let place = shown(pinned, shot);
        Some((shot, pixel_of(&context.scene, shot, &place)?, place))
    });
    let Some((shot, reading, place)) = found else {
        ui.label(RichText::new("No picture of this sensor yet.").small().color(weak));
        return;
    };
    let label = index_of(shot, &place.source).map_or(&place.source.name, |index| &shot.sources[index].label);
    let measure = Measure::of(&shot.query);
    let [x, y] = reading.at;
    ui.label(format!("Pixel {x}, {y}   {label}"));
    match reading.shows {
        PixelShows::Nothing => {
            ui.label("Beside the mesh.");
        }
        PixelShows::Unlit => {
            ui.label("No light reaches it: facing away, or in shadow.");
        }
        PixelShows::Lit(lit) => {
            let numbers = Grid::new("pixel").num_columns(2).spacing([3.0 * UNIT, 0.5 * UNIT]).show(ui, |ui| {
                for (name, value) in facts(&lit, measure) {
                    ui.monospace(name);
                    ui.monospace(value);
                    ui.end_row();
                }
            });
            numbers.response.on_hover_text(
                "RGB: linear sRGB at this exposure, before clipping. xy, Lab and the difference from the reference: a \
                 white of the same roughness that faces the light has Y = 1. g: at 550 nm.",
            );
            others(ui, &place, shot, context);
            if let Some((_, transform)) = lit.roughness {
                ui.label(RichText::new(format!("g at 550 nm, {transform}")).small().color(weak));
            }
        }
    }
}

/// The place in the picture it was kept in or, where that sensor has none now, in the last one that has.
fn shown(place: PixelPlace, shot: &RenderedFrame) -> PixelPlace {
    match shot.sources.last() {
        Some(last) if index_of(shot, &place.source).is_none() => {
            PixelPlace { source: SensorId { kind: last.kind, name: last.name.clone() }, ..place }
        }
        _ => place,
    }
}

/// The pixel through each sensor, one line each.
fn others(ui: &mut Ui, place: &PixelPlace, shot: &RenderedFrame, context: &PaneContext<'_>) {
    let measure = Measure::of(&shot.query);
    Grid::new("pixel in all pictures").num_columns(3).spacing([2.0 * UNIT, 0.5 * UNIT]).show(ui, |ui| {
        for source in shot.sources.iter() {
            let place = PixelPlace { at: place.at, source: SensorId { kind: source.kind, name: source.name.clone() } };
            let Some(PixelShows::Lit(lit)) = pixel_of(&context.scene, shot, &place).map(|reading| reading.shows) else {
                continue;
            };
            let xy = lit.xy.map_or_else(|| "no xy".to_owned(), |xy| format!("{:.4} {:.4}", xy.x, xy.y));
            let difference = lit.difference.map_or_else(String::new, |difference| {
                format!("{} {}", measure.short_name(), measure.number(difference))
            });
            ui.label(RichText::new(&source.label).small());
            ui.label(RichText::new(xy).small().monospace());
            ui.label(RichText::new(difference).small().monospace());
            ui.end_row();
        }
    });
}
