//! Values of the pinned pixel.

use chromascope_figure::{Cell, Column, Table};
use egui::Ui;

use crate::figures::render::headline::Measure;
use crate::figures::render::{NO_VALUE, facts, index_of, pixel_of};
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::panes::widgets::table::{DataTable, show_pairs};
use crate::plot_item::SensorId;
use crate::render_service::RenderedFrame;
use crate::render_service::pixel::PixelShows;
use crate::theme::UNIT;
use crate::view::PixelPlace;
use crate::workspaces::PaneKind;

pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    if !context.view.is_shown(PaneKind::RENDER) {
        return;
    }
    ui.add_space(UNIT);
    let Some(pinned) = context.view.render.pinned.clone() else {
        return widgets::note(ui, "Point at a picture to read it; click to pin the pixel, Esc to unpin it.");
    };
    let found = context.render_service.frame().and_then(|shot| {
        let place = shown(pinned, shot);
        Some((shot, pixel_of(&context.scene, shot, &place)?, place))
    });
    let Some((shot, reading, place)) = found else {
        return widgets::note(ui, "No picture of this sensor yet.");
    };
    let label = index_of(shot, &place.source).map_or(&place.source.name, |index| &shot.sources[index].label);
    let measure = Measure::of_frame(shot);
    let [x, y] = reading.at;
    ui.label(format!("Pixel {x}, {y}   {label}"));
    match reading.shows {
        PixelShows::Nothing => drop(ui.label("Beside the mesh.")),
        PixelShows::NoValue => drop(ui.label(NO_VALUE)),
        PixelShows::Unlit => drop(ui.label("No light reaches it: facing away, or in shadow.")),
        PixelShows::Lit(lit) => {
            let numbers = ui.scope(|ui| show_pairs(ui, PaneKind::INSPECTOR, "pixel", &facts(&lit, measure), context));
            numbers.response.on_hover_text(if shot.query.image().is_some() {
                "RGB: linear sRGB at this exposure, before clipping. xy, Lab and the difference from the reference: a \
                 reflectance of 1, or the white of radiances, has Y = 1."
            } else {
                "RGB: linear sRGB at this exposure, before clipping. xy, Lab and the difference from the reference: a \
                 white of the same roughness that faces the light has Y = 1. g: at 550 nm."
            });
            others(ui, &place, shot, context);
            widgets::pixel::spectrum(ui, "spectrum in inspector", shot, reading.at, context);
            if let Some((_, transform)) = lit.roughness {
                widgets::note(ui, format!("g at 550 nm, {transform}"));
            }
        }
    }
}

/// The location in the picture it was pinned in or, if that sensor has none now, in the last one that has.
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
    let measure = Measure::of_frame(shot);
    let heads = ["", "x", "y", measure.short_name()];
    let mut table = Table::new(heads.map(|head| Column { decimals: Some(4), ..Column::from(head) }));
    for source in shot.sources.iter() {
        let place = PixelPlace { at: place.at, source: SensorId { kind: source.kind, name: source.name.clone() } };
        let Some(PixelShows::Lit(lit)) = pixel_of(&context.scene, shot, &place).map(|reading| reading.shows) else {
            continue;
        };
        let [x, y] = [lit.xy.map(|xy| xy.x), lit.xy.map(|xy| xy.y)].map(Cell::from);
        let difference = lit.difference.map_or_else(String::new, |difference| measure.number(difference));
        table.push([Cell::from(source.label.as_str()), x, y, Cell::from(difference)]);
    }
    DataTable::new(PaneKind::INSPECTOR, "pixel in all pictures", &table).show_compact(ui, context);
}
