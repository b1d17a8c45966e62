//! Small pictures of raw images.

use rayon::prelude::*;

use crate::RawImage;

/// Means of square cells of a raw image, from its top left on; pixels that fill no cell are left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Preview {
    /// Cells across and down.
    pub size: [usize; 2],
    /// Side of a cell in pixels, even for a mosaic.
    pub step: usize,
    /// Mean camera RGB of each cell, row by row, as in [`RawImage::pixel`].
    pub rgb: Vec<[f32; 3]>,
}

impl RawImage {
    /// Means of cells of as few pixels as keep the longer side at `longest` cells or fewer, each with all three channels.
    pub fn preview(&self, longest: usize) -> Preview {
        let [width, height] = self.size();
        let unit = if self.mosaic.is_some() { 2 } else { 1 };
        let step =
            width.max(height).div_ceil(longest.max(1)).next_multiple_of(unit).min(width.min(height) / unit * unit);
        let size = [width / step, height / step];
        let rgb = (0..size[1]).into_par_iter().flat_map_iter(|y| self.cells(y, step, size[0])).collect();
        Preview { size, step, rgb }
    }

    fn cells(&self, y: usize, step: usize, count: usize) -> impl Iterator<Item = [f32; 3]> + use<> {
        let mut sums = vec![[0.0; 3]; count];
        for y in y * step..(y + 1) * step {
            let (black, added) = self.levels.row(y);
            // Channels and scales of the samples that repeat along a row.
            let (channels, scale): (&[usize], _) = match &self.mosaic {
                Some(mosaic) => (&mosaic[y % 2], [self.levels.scale[0]; 3]),
                None => (&[0, 1, 2], [0, 1, 2].map(|plane| self.levels.scale[plane])),
            };
            let cell = step * self.planes;
            let cells = self.row_samples(y).chunks_exact(cell).zip(black.chunks_exact(cell));
            for (sum, (samples, black)) in sums.iter_mut().zip(cells) {
                let period = channels.len();
                for (samples, black) in samples.chunks_exact(period).zip(black.chunks_exact(period)) {
                    for ((&channel, &sample), &black) in channels.iter().zip(samples).zip(black) {
                        sum[channel] += (f64::from(sample) - black - added) * scale[channel];
                    }
                }
            }
        }
        let of_channel = |channel| match &self.mosaic {
            Some(mosaic) => mosaic.as_flattened().iter().filter(|&&own| own == channel).count() * step * step / 4,
            None => step * step,
        };
        let counts = [0, 1, 2].map(|channel| of_channel(channel) as f64);
        sums.into_iter().map(move |sum| [0, 1, 2].map(|channel| (sum[channel] / counts[channel]) as f32))
    }
}
