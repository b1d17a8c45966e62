//! Maps of differences from the reference.

use chromascope_core::colorimetry::Metric;
use chromascope_figure::{Anchor, Image, Ink, Mark, Shape};

use super::text;
use crate::format::number;
use crate::plot_item::PickIndex;
use crate::render_service::RenderedFrame;
use crate::theme::difference_ramp;

/// Scale of the maps: from 0 to a round end, with ticks at round values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// End, in the metric's units.
    pub end: f32,
    steps: u8,
    unit: f32,
}

impl Scale {
    /// Possible upper limits of the scale for a metric of two decimals, with the number of equal steps.
    const ENDS: [(f32, u8); 10] =
        [(0.5, 5), (1.0, 4), (2.0, 4), (5.0, 5), (10.0, 5), (15.0, 3), (20.0, 4), (30.0, 3), (50.0, 5), (100.0, 4)];

    /// Least scale that holds all maps.
    pub fn of(shot: &RenderedFrame) -> Self {
        let differences = shot.made().map(|made| made.differences).unwrap_or_default();
        let largest = differences.iter().flatten().map(|difference| difference.max as f32).fold(0.0, f32::max);
        Self::holding(largest, shot.query.metric())
    }

    fn holding(largest: f32, metric: Metric) -> Self {
        let unit = 0.1_f32.powi(i32::try_from(metric.decimals).unwrap_or(2) - 2);
        let fits = |end: &&(f32, u8)| end.0 * unit >= largest;
        let &(end, steps) = Self::ENDS.iter().find(fits).unwrap_or(&Self::ENDS[9]);
        Self { end: end * unit, steps, unit }
    }

    /// Ticks: share of the scale, and value in words.
    pub fn ticks(self) -> impl Iterator<Item = (f32, String)> {
        (0..=self.steps).map(move |step| {
            let share = f32::from(step) / f32::from(self.steps);
            let hundredths = (share * self.end / self.unit * 100.0).round();
            (share, number(f64::from(hundredths) / 100.0 * f64::from(self.unit)))
        })
    }
}

/// The height of a scale in a figure.
pub(super) const SCALE_HEIGHT: f64 = 38.0;

/// The scale in a figure: the ramp with its values, from an upper left corner on.
pub(super) fn scale(scale: Scale, name: &str, [x, y]: [f64; 2], width: f64, ink: Ink) -> Vec<Mark> {
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
    for (share, value) in scale.ticks() {
        let words = if share < 1.0 { value } else { format!("{name} {value}") };
        marks.push(text(&words, [left + f64::from(share) * (right - left), y + 26.0], Anchor::CENTER, ink));
    }
    marks
}

/// A map as width, height and RGBA: the color scale where light falls, black where none does, transparent outside the
/// mesh.
pub fn map(shot: &RenderedFrame, at: usize, end: f32) -> ([usize; 2], Vec<u8>) {
    let nothing = ([0, 0], Vec::new());
    let Some(made) = shot.made() else { return nothing };
    let (Some(Some(difference)), Some((geometry, _))) = (made.differences.get(at), made.signals(at)) else {
        return nothing;
    };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_in_the_metrics_units() {
        let ticks =
            |largest, metric| Scale::holding(largest, metric).ticks().map(|(_, words)| words).collect::<Vec<_>>();
        assert_eq!(ticks(12.0, Metric::DELTA_E_2000), ["0", "5", "10", "15"]);
        assert_eq!(ticks(0.9, Metric::DELTA_E_2000), ["0", "0.25", "0.5", "0.75", "1"]);
        assert_eq!(ticks(0.14, Metric::XY), ["0", "0.05", "0.1", "0.15"]);
        assert_eq!(ticks(7e9, Metric::UV_PRIME).last().map(String::as_str), Some("1"));
    }
}
