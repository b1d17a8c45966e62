//! The pixel that is kept, in numbers.

use egui::{Grid, RichText, Ui};

use crate::figures::render::headline::Measure;
use crate::figures::render::{facts, index_of, pixel_of};
use crate::panes::context::PaneContext;
use crate::plot_item::SensorId;
use crate::render_service::pixel::PixelShows;
use crate::theme::UNIT;
use crate::view::render::{PixelPlace, RenderView};

/// Shows the group.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    ui.spacing_mut().item_spacing.y = 0.5 * UNIT;
    ui.spacing_mut().interact_size.y = 14.0;
    let render = &context.view.render;
    let weak = context.theme.weak;
    let Some(place) = render.pinned.clone().map(|place| shown(place, render)) else {
        ui.label(
            RichText::new("Point at a picture to read it; click to pin the pixel, Esc to unpin it.")
                .small()
                .color(weak),
        );
        return;
    };
    let Some(reading) = pixel_of(&context.scene, render, &place) else {
        ui.label(RichText::new("No picture of this sensor yet.").small().color(weak));
        return;
    };
    let Some(shot) = render.shot.as_deref() else { return };
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
            others(ui, &place, context);
            if let Some((_, transform)) = lit.roughness {
                ui.label(RichText::new(format!("g at 550 nm, {transform}")).small().color(weak));
            }
        }
    }
}

/// The place in the picture it was kept in or, where that sensor has none now, in the last one that has.
fn shown(place: PixelPlace, render: &RenderView) -> PixelPlace {
    let Some(shot) = render.shot.as_deref() else { return place };
    match shot.sources.last() {
        Some(last) if index_of(shot, &place.source).is_none() => {
            PixelPlace { source: SensorId { kind: last.kind, name: last.name.clone() }, ..place }
        }
        _ => place,
    }
}

/// The pixel through each sensor, one line each.
fn others(ui: &mut Ui, place: &PixelPlace, context: &PaneContext<'_>) {
    let render = &context.view.render;
    let Some(shot) = render.shot.as_deref() else { return };
    let measure = Measure::of(&shot.query);
    Grid::new("pixel in all pictures").num_columns(3).spacing([2.0 * UNIT, 0.5 * UNIT]).show(ui, |ui| {
        for source in shot.sources.iter() {
            let place = PixelPlace { at: place.at, source: SensorId { kind: source.kind, name: source.name.clone() } };
            let Some(PixelShows::Lit(lit)) = pixel_of(&context.scene, render, &place).map(|reading| reading.shows)
            else {
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
