//! Maps of differences from the reference.

use chromascope_figure::{Anchor, Image, Ink, Mark, Shape};

use super::text;
use crate::format::number;
use crate::plot_item::PickIndex;
use crate::render_service::RenderedFrame;
use crate::theme::difference_ramp;

/// Ends that a scale may have.
const ENDS: [f32; 9] = [0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 50.0];

/// The end of the scale that holds all maps.
pub fn scale_end(shot: &RenderedFrame) -> f32 {
    let differences = shot.made().map(|made| made.differences.as_slice()).unwrap_or_default();
    let largest = differences.iter().flatten().map(|difference| difference.max as f32).fold(0.0, f32::max);
    ENDS.into_iter().find(|end| *end >= largest).unwrap_or(100.0)
}

/// Values between the ends of a scale are marked at so many even steps that they are round.
pub fn steps(end: f32) -> u8 {
    if [15.0, 30.0].contains(&end) {
        3
    } else if [0.5, 5.0, 10.0, 50.0].contains(&end) {
        5
    } else {
        4
    }
}

/// The height of a scale in a figure.
pub(super) const SCALE: f64 = 38.0;

/// The scale in a figure: the ramp with its values, from an upper left corner on.
pub(super) fn scale(end: f32, measure: &str, [x, y]: [f64; 2], width: f64, ink: Ink) -> Vec<Mark> {
    let pixels: u16 = 256;
    let ramp = (0..pixels).flat_map(|i| {
        let [r, g, b] = difference_ramp(f32::from(i) / f32::from(pixels - 1));
        [r, g, b, 255]
    });
    let image = Image { width: usize::from(pixels), height: 1, rgba: ramp.collect() };
    let inset = 24.0;
    let (left, right) = (x + inset, x + width - inset);
    let shape = Shape::Image { min: [left, y + 16.0], max: [right, y + 4.0], image };
    let mut marks = vec![Mark::new(PickIndex::NONE, "scale", shape)];
    let steps = steps(end);
    for step in 0..=steps {
        let share = f64::from(step) / f64::from(steps);
        let words = number((share * f64::from(end) * 100.0).round() / 100.0);
        let words = if step == steps { format!("{measure} {words}") } else { words };
        marks.push(text(&words, [left + share * (right - left), y + 26.0], Anchor::CENTER, ink));
    }
    marks
}

/// A map as width, height and RGBA: the ramp where light falls, black where none does, nothing beside the mesh.
pub fn map(shot: &RenderedFrame, at: usize, end: f32) -> ([usize; 2], Vec<u8>) {
    let nothing = ([0, 0], Vec::new());
    let Some(made) = shot.made() else { return nothing };
    let (Some(Some(difference)), Some(Some(image))) = (made.differences.get(at), made.images.get(at)) else {
        return nothing;
    };
    let geometry = image.placed();
    let size = geometry.size();
    let (width, height, each) = (size.width as usize, size.height as usize, size.samples as usize);
    let pixel = |sample: u32| {
        let (row, column) = (sample as usize / size.columns(), sample as usize % size.columns());
        row / each * width + column / each
    };
    let mut rgba = vec![0; 4 * width * height];
    let (pixels, _) = rgba.as_chunks_mut::<4>();
    for &sample in geometry.seen() {
        pixels[pixel(sample)] = [0, 0, 0, 255];
    }
    for (&sample, value) in geometry.samples().iter().step_by(difference.stride).zip(&difference.map) {
        let [r, g, b] = difference_ramp(value / end);
        pixels[pixel(sample)] = [r, g, b, 255];
    }
    ([width, height], rgba)
}
