//! Means of a chart's patches in a linear picture, from the four corners of its grid.
//!
//! ```text
//! (x, y, 1)ᵀ ∝ H (u, v, 1)ᵀ        H = homography of the unit square onto the four corners
//! ```
//! A pixel belongs to a patch if its center lies in the central part of the patch's cell; a patch's value is the mean of its pixels.

use glam::{DMat3, DVec2, DVec3};

/// Share of a cell's width and height that counts.
pub const CENTRAL: f64 = 0.5;
/// Fewest pixels that a mean is taken over.
pub const FEWEST_PIXELS: usize = 4;

/// Reason that corners and grid mark no patches.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum ChartGridError {
    #[error(
        "the four corners are not those of a convex quadrilateral; name them around the chart: top left, top right, bottom right, bottom left"
    )]
    NotConvex,
    #[error("corner {corner} lies outside the picture of {width} x {height} pixels")]
    Outside {
        /// The corner, from 1.
        corner: usize,
        width: usize,
        height: usize,
    },
    #[error("a grid of {columns} x {rows} patches; expected 1 to 100 each way")]
    Grid { columns: usize, rows: usize },
    #[error(
        "patch {patch} has {pixels} pixels; at least {FEWEST_PIXELS} are needed, so use a larger picture or check the corners"
    )]
    TooSmall {
        /// The patch, from 1.
        patch: usize,
        pixels: usize,
    },
}

/// Grid of patches in perspective.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChartGrid {
    corners: [DVec2; 4],
    columns: usize,
    rows: usize,
    square_from_picture: DMat3,
}

/// Mean of one patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchMean {
    /// Mean of each channel.
    pub mean: [f64; 3],
    /// True for a channel with a pixel at or above the clipping level.
    pub clipped: [bool; 3],
    /// Number of pixels.
    pub pixels: usize,
}

impl ChartGrid {
    /// Grid whose outer corners are, around the chart from the first patch: top left, top right, bottom right, bottom left; in pixels,
    /// with (0, 0) at the picture's top left.
    ///
    /// # Errors
    /// [`ChartGridError`] where the corners do not mark such a grid.
    pub fn new(corners: [[f64; 2]; 4], columns: usize, rows: usize) -> Result<Self, ChartGridError> {
        if !(1..=100).contains(&columns) || !(1..=100).contains(&rows) {
            return Err(ChartGridError::Grid { columns, rows });
        }
        let corners = corners.map(DVec2::from_array);
        let turn = |i: usize| {
            let [a, b, c] = [corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4]];
            (b - a).perp_dot(c - b)
        };
        let turns = [0, 1, 2, 3].map(turn);
        let convex = turns.iter().all(|t| *t > 1e-6) || turns.iter().all(|t| *t < -1e-6);
        if !convex || turns.iter().any(|t| !t.is_finite()) {
            return Err(ChartGridError::NotConvex);
        }
        Ok(Self { corners, columns, rows, square_from_picture: homography(corners).inverse() })
    }

    /// Number of patches.
    pub fn patches(&self) -> usize {
        self.columns * self.rows
    }

    /// Means of all patches, row by row from the first corner. `pixel(x, y)` is the linear RGB of a pixel.
    ///
    /// # Errors
    /// [`ChartGridError`] where a corner lies outside the picture, or a patch has too few pixels.
    pub fn means(
        &self,
        [width, height]: [usize; 2],
        clip: f64,
        pixel: impl Fn(usize, usize) -> [f64; 3],
    ) -> Result<Vec<PatchMean>, ChartGridError> {
        let inside = |p: &DVec2| p.min_element() >= 0.0 && p.x <= width as f64 && p.y <= height as f64;
        if let Some(corner) = self.corners.iter().position(|corner| !inside(corner)) {
            return Err(ChartGridError::Outside { corner: corner + 1, width, height });
        }
        let low = self.corners.iter().fold(DVec2::MAX, |low, p| low.min(*p)).floor();
        let high = self.corners.iter().fold(DVec2::MIN, |high, p| high.max(*p)).ceil();
        let none = PatchMean { mean: [0.0; 3], clipped: [false; 3], pixels: 0 };
        let mut patches = vec![none; self.patches()];
        for y in low.y as usize..(high.y as usize).min(height) {
            for x in low.x as usize..(high.x as usize).min(width) {
                let Some(patch) = self.patch_at(x as f64 + 0.5, y as f64 + 0.5) else { continue };
                let patch = &mut patches[patch];
                patch.pixels += 1;
                for (c, value) in pixel(x, y).into_iter().enumerate() {
                    patch.mean[c] += value;
                    patch.clipped[c] |= value >= clip;
                }
            }
        }
        for (index, patch) in patches.iter_mut().enumerate() {
            if patch.pixels < FEWEST_PIXELS {
                return Err(ChartGridError::TooSmall { patch: index + 1, pixels: patch.pixels });
            }
            patch.mean = patch.mean.map(|sum| sum / patch.pixels as f64);
        }
        Ok(patches)
    }

    /// Patch in whose central part a place of the picture lies.
    fn patch_at(&self, x: f64, y: f64) -> Option<usize> {
        let square = self.square_from_picture * DVec3::new(x, y, 1.0);
        let cell = square.truncate() / square.z * DVec2::new(self.columns as f64, self.rows as f64);
        let (column, row) = (cell.x.floor(), cell.y.floor());
        let within = (0.0..self.columns as f64).contains(&column) && (0.0..self.rows as f64).contains(&row);
        let off = (cell - cell.floor() - 0.5).abs().max_element();
        (within && off <= CENTRAL / 2.0).then(|| row as usize * self.columns + column as usize)
    }
}

/// Homography of the unit square's corners, in the same order, onto four points (Heckbert 1989, section 2.2.3).
pub(super) fn homography([p0, p1, p2, p3]: [DVec2; 4]) -> DMat3 {
    let sum = p0 - p1 + p2 - p3;
    let (d1, d2) = (p1 - p2, p3 - p2);
    let area = d1.perp_dot(d2);
    let g = sum.perp_dot(d2) / area;
    let h = d1.perp_dot(sum) / area;
    let x_axis = p1 - p0 + p1 * g;
    let y_axis = p3 - p0 + p3 * h;
    DMat3::from_cols(x_axis.extend(g), y_axis.extend(h), p0.extend(1.0))
}
