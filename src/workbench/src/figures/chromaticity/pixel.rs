//! Pinned pixel of the rendered pictures, through each sensor.

use chromascope_figure::{InkRole, Mark, Marker, Shape};

use super::drawing::{Drawing, id};
use crate::figures::look::PixelPlace;
use crate::figures::render::pixel_of;
use crate::plot_item::PlotItem;
use crate::render_service::RenderedFrame;
use crate::render_service::pixel::PixelShows;
use crate::scene::ComparedSensor;

/// Radius of its mark in points.
const RADIUS: f64 = 4.5;

/// Adds a diamond for each sensor that has a picture, in whatever workspace that is.
pub(super) fn add(drawing: &mut Drawing<'_>, pictures: &RenderedFrame, sources: &[ComparedSensor]) {
    let Some(pinned) = drawing.look.pinned_pixel.clone() else { return };
    for source in sources.iter().rev() {
        let place = PixelPlace { source: id(source), ..pinned.clone() };
        let Some(PixelShows::Lit(lit)) = pixel_of(drawing.scene, pictures, &place).map(|reading| reading.shows) else {
            continue;
        };
        let Some(at) = lit.xy.and_then(|xy| drawing.place(xy)) else { continue };
        let tag = drawing.things.tag(PlotItem::Sensor(id(source)));
        let shape = Shape::Points { points: vec![at], marker: Marker::Diamond, radius: RADIUS };
        let mark = Mark::new(tag, format!("{}, pixel", source.label), shape).with_stroke(source.role, 1.5);
        drawing.small.push(mark.with_fill(source.role).with_halo(InkRole::Plot));
    }
}
