//! Maps of differences from the reference.

use chromascope_core::colorimetry::Metric;
use chromascope_figure::{Anchor, Image, Ink, Mark, Shape, TextSize};

use crate::format::number;
use crate::palette::difference_ramp;
use crate::plot_item::PickIndex;
use crate::render_service::RenderedFrame;

/// Scale of the maps: from 0 to a round end, with ticks at round values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// End, in the metric's units.
    pub end: f32,
    /// True if a few differences are larger.
    exceeded: bool,
    steps: u8,
    unit: f32,
}

impl Scale {
    /// Numbers of equal steps, with the possible upper limits that have so many, for a metric of two decimals: close to each other, so
    /// that the data reach near the end.
    const ENDS: [(u8, &[f32]); 3] = [
        (3, &[0.3, 0.6, 1.5, 3.0, 6.0, 15.0, 30.0]),
        (4, &[0.2, 0.4, 0.8, 2.0, 4.0, 8.0, 12.0, 20.0]),
        (5, &[0.5, 1.0, 5.0, 10.0, 50.0]),
    ];

    /// Scale of all maps: the least that holds 95 % of the samples bright enough to be judged, with a fifth to spare, so
    /// that the few largest of a rim do not flatten the others.
    pub fn of(shot: &RenderedFrame) -> Self {
        let differences = shot.made().map(|made| made.differences).unwrap_or_default();
        let (mut most, mut largest) = (0.0_f64, 0.0_f64);
        for difference in differences.iter().flatten() {
            let usual = difference.bright.map_or(difference.max, |bright| (1.2 * bright.p95).min(difference.max));
            (most, largest) = (most.max(usual), largest.max(difference.max));
        }
        Self::holding(most as f32, largest as f32, shot.query.metric())
    }

    /// Scale of differences of which 95 % are below `most`, the largest being `largest`.
    pub fn holding(most: f32, largest: f32, metric: Metric) -> Self {
        let unit = 0.1_f32.powi(i32::try_from(metric.decimals).unwrap_or(2) - 2);
        let ends = Self::ENDS.iter().flat_map(|(steps, ends)| ends.iter().map(|end| (*end, *steps)));
        let least = ends.filter(|(end, _)| end * unit >= most).min_by(|a, b| a.0.total_cmp(&b.0));
        let (end, steps) = least.unwrap_or((100.0, 5));
        Self { end: end * unit, exceeded: largest > end * unit, steps, unit }
    }

    /// Ticks: share of the scale, and value in words.
    pub fn ticks(self) -> impl Iterator<Item = (f32, String)> {
        (0..=self.steps).map(move |step| {
            let share = f32::from(step) / f32::from(self.steps);
            let hundredths = (share * self.end / self.unit * 100.0).round();
            let or_more = if share == 1.0 && self.exceeded { "≥ " } else { "" };
            (share, format!("{or_more}{}", number(f64::from(hundredths) / 100.0 * f64::from(self.unit))))
        })
    }
}

/// The height of a scale in a figure.
pub(super) const SCALE_HEIGHT: f64 = 54.0;

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
        let at = [left + f64::from(share) * (right - left), y + 26.0];
        marks.push(Mark::text(value, at, Anchor::CENTER, TextSize::Small, ink));
    }
    marks.push(Mark::text(name, [0.5 * (left + right), y + 42.0], Anchor::CENTER, TextSize::Small, ink));
    marks
}

/// The ground of maps and of the hatch: darker than any color of the scale, whatever the surround.
pub const GROUND: [u8; 4] = [0x12, 0x12, 0x12, 255];
/// Diagonal lines where no light falls.
const HATCH: [u8; 4] = [0x6A, 0x6A, 0x6A, 255];
/// Distance of these lines in pixels.
const HATCH_PITCH: usize = 6;

/// A map as width, height and RGBA: the color scale where light falls, hatched where none does, dark outside the mesh.
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
    let mut rgba = GROUND.repeat(width * height);
    let (pixels, _) = rgba.as_chunks_mut::<4>();
    for at in geometry.seen().iter().map(|sample| pixel(*sample)) {
        let is_line = (at / width + at % width) % HATCH_PITCH < 2;
        pixels[at] = if is_line { HATCH } else { GROUND };
    }
    for (&sample, value) in geometry.samples().iter().step_by(difference.stride).zip(&difference.map) {
        let [r, g, b] = difference_ramp(value / end);
        pixels[pixel(sample)] = [r, g, b, 255];
    }
    ([width, height], rgba)
}
