//! Means of a chart's patches in a linear picture, from the four corners of its grid.
//!
//! ```text
//! (x, y, 1)ᵀ ∝ H (u, v, 1)ᵀ        H = homography of the unit square onto the four corners
//! ```
//! A pixel belongs to a patch if its center lies in the central part of the patch's cell; a patch's value is the trimmed mean of its pixels.
//! Of large patches, pixels an odd number of rows and columns apart are taken, so that a mosaic's colors keep their shares.

use chromascope_math::quantile::quantile;
use glam::{DMat3, DVec2, DVec3};

/// Share of a cell's width and height that counts.
pub const CENTRAL: f64 = 0.5;
/// Fewest pixels that a mean is taken over.
pub const FEWEST_PIXELS: usize = 4;
/// Largest share of a patch's pixels that may be clipped: far less than what is trimmed.
pub const CLIPPED_SHARE: f64 = 0.005;
/// Share of the pixels that the trimmed mean leaves out at either end: dust, scratches, defective pixels.
pub const TRIMMED: f64 = 0.1;
/// Pixels of a patch from which on not all are taken.
const MANY_PIXELS: f64 = 40_000.0;
/// Standard deviation of a Gaussian's 10 % trimmed mean, in that of its mean (Huber and Ronchetti 2009, table 1.1).
const TRIMMED_SPREAD: f64 = 1.03;
/// Standard deviation of a Gaussian by the median of differences of two: 1 / (0.6745 √2).
const SPREAD_BY_DIFFERENCE: f64 = 1.0484;

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
    #[error(
        "the region of {} x {} pixels at {}, {} does not lie within the picture of {width} x {height} pixels, or has fewer than {FEWEST_PIXELS}",
        region[2], region[3], region[0], region[1]
    )]
    Region { region: [usize; 4], width: usize, height: usize },
}

/// Grid of patches in perspective.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChartGrid {
    corners: [DVec2; 4],
    columns: usize,
    rows: usize,
    square_from_picture: DMat3,
}

/// Measurement of one patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchMean {
    /// Mean of each channel without the lowest and the highest [`TRIMMED`] of its pixels; NaN where fewer than [`FEWEST_PIXELS`] have a value.
    pub mean: [f64; 3],
    /// Standard deviation of that mean, from the differences of pixels next to each other: without the light's slope.
    pub noise: [f64; 3],
    /// Share of pixels at or above the clipping level.
    pub clipped_share: [f64; 3],
    /// True for a channel with more than [`CLIPPED_SHARE`] clipped.
    pub clipped: [bool; 3],
    /// Number of pixels.
    pub pixels: usize,
}

impl PatchMean {
    /// Measurement of the pixels' values in the order of their places.
    fn new(channels: [Vec<f64>; 3], pixels: usize, clip: f64) -> Self {
        let mut patch =
            Self { mean: [f64::NAN; 3], noise: [f64::NAN; 3], clipped_share: [0.0; 3], clipped: [false; 3], pixels };
        for (c, mut values) in channels.into_iter().enumerate() {
            let count = values.len();
            if count < FEWEST_PIXELS {
                continue;
            }
            patch.clipped_share[c] = values.iter().filter(|value| **value >= clip).count() as f64 / count as f64;
            patch.clipped[c] = patch.clipped_share[c] > CLIPPED_SHARE;
            let mut differences: Vec<f64> = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
            let square = differences.iter().map(|difference| difference * difference).sum::<f64>();
            // Values in few steps, of which most are equal, have a median of zero.
            let spread = quantile(&mut differences, 0.5)
                .map(|median| SPREAD_BY_DIFFERENCE * median)
                .filter(|spread| *spread > 0.0)
                .unwrap_or((square / (2 * count) as f64).sqrt());
            patch.noise[c] = TRIMMED_SPREAD * spread / (count as f64).sqrt();
            let cut = (TRIMMED * count as f64) as usize;
            values.select_nth_unstable_by(cut, f64::total_cmp);
            let upper = &mut values[cut..];
            upper.select_nth_unstable_by(count - 1 - 2 * cut, f64::total_cmp);
            let kept = &upper[..count - 2 * cut];
            patch.mean[c] = kept.iter().sum::<f64>() / kept.len() as f64;
        }
        patch
    }
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

    /// Means of all patches, row by row from the first corner. `pixel(x, y)` is the linear RGB of a pixel, NaN where it lacks a channel.
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
        let [a, b, c, d] = self.corners;
        let patch_area = ((c - a).perp_dot(d - b) / 2.0).abs() * CENTRAL * CENTRAL / self.patches() as f64;
        let step = step(patch_area);
        let mut pixels = vec![(0, [const { Vec::new() }; 3]); self.patches()];
        for y in (low.y as usize..(high.y as usize).min(height)).step_by(step) {
            for x in (low.x as usize..(high.x as usize).min(width)).step_by(step) {
                let Some(patch) = self.patch_at(x as f64 + 0.5, y as f64 + 0.5) else { continue };
                let (count, channels) = &mut pixels[patch];
                *count += 1;
                for (channel, value) in channels.iter_mut().zip(pixel(x, y)) {
                    channel.extend(Some(value).filter(|value| !value.is_nan()));
                }
            }
        }
        if let Some((index, (pixels, _))) = pixels.iter().enumerate().find(|(_, (count, _))| *count < FEWEST_PIXELS) {
            return Err(ChartGridError::TooSmall { patch: index + 1, pixels: *pixels });
        }
        Ok(pixels.into_iter().map(|(count, channels)| PatchMean::new(channels, count, clip)).collect())
    }

    /// Corners of the part of a patch that counts, in pixels, around it from the top left.
    pub fn outline(&self, patch: usize) -> [[f64; 2]; 4] {
        let cells = DVec2::new(self.columns as f64, self.rows as f64);
        let middle = DVec2::new((patch % self.columns) as f64 + 0.5, (patch / self.columns) as f64 + 0.5);
        let picture_from_square = homography(self.corners);
        let at = |[x, y]: [f64; 2]| {
            let place = picture_from_square * ((middle + CENTRAL / 2.0 * DVec2::new(x, y)) / cells).extend(1.0);
            (place.truncate() / place.z).to_array()
        };
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(at)
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

/// Mean of a region of a picture: left, top, width and height in pixels. `pixel(x, y)` is as for [`ChartGrid::means`].
///
/// # Errors
/// [`ChartGridError::Region`] where it is not within the picture or too small.
pub fn region_mean(
    region: [usize; 4],
    [width, height]: [usize; 2],
    clip: f64,
    pixel: impl Fn(usize, usize) -> [f64; 3],
) -> Result<PatchMean, ChartGridError> {
    let [left, top, across, down] = region;
    let area = across.saturating_mul(down);
    let is_within = left.saturating_add(across) <= width && top.saturating_add(down) <= height;
    if !is_within || area < FEWEST_PIXELS {
        return Err(ChartGridError::Region { region, width, height });
    }
    let step = step(area as f64);
    let mut channels = [const { Vec::new() }; 3];
    let mut count = 0;
    for y in (top..top + down).step_by(step) {
        for x in (left..left + across).step_by(step) {
            count += 1;
            for (channel, value) in channels.iter_mut().zip(pixel(x, y)) {
                channel.extend(Some(value).filter(|value| !value.is_nan()));
            }
        }
    }
    Ok(PatchMean::new(channels, count, clip))
}

/// Odd number of pixels apart that those of an area are taken.
fn step(area: f64) -> usize {
    2 * ((area / MANY_PIXELS).sqrt() / 2.0).round() as usize + 1
}

/// Places of patches in a grid, row by row from its first corner, by names of a letter and a number such as A1 or N10: the letters are
/// columns, as of the `ColorChecker` SG of 14 × 10, or rows, as A1 to D6 of 6 × 4, whichever there are as many of. None where the names do
/// not state each place once.
pub fn named_places<'a>(names: impl IntoIterator<Item = &'a str>, grid: [usize; 2]) -> Option<Vec<usize>> {
    places(&cells(names)?, grid)
}

/// Letters and numbers of names, both from 0.
fn cells<'a>(names: impl IntoIterator<Item = &'a str>) -> Option<Vec<[usize; 2]>> {
    let parsed = |name: &str| {
        let letter = name.chars().next().filter(char::is_ascii_alphabetic)?.to_ascii_uppercase();
        let number = name[1..].parse::<usize>().ok()?.checked_sub(1)?;
        Some([usize::from(letter as u8 - b'A'), number])
    };
    names.into_iter().map(|name| parsed(name.trim())).collect()
}

fn places(cells: &[[usize; 2]], [columns, rows]: [usize; 2]) -> Option<Vec<usize>> {
    let most = [0, 1].map(|axis: usize| cells.iter().map(|cell| cell[axis] + 1).max().unwrap_or(0));
    let letters_are_columns = most == [columns, rows];
    if most != [rows, columns] && !letters_are_columns || columns.checked_mul(rows) != Some(cells.len()) {
        return None;
    }
    let place = |&[letter, number]: &[usize; 2]| {
        if letters_are_columns { number * columns + letter } else { letter * columns + number }
    };
    let places: Vec<usize> = cells.iter().map(place).collect();
    let mut seen = vec![false; places.len()];
    places.iter().all(|place| !std::mem::replace(&mut seen[*place], true)).then_some(places)
}

/// Grids that a number of patches fills, each of at most 100 columns and rows: those of their [`named_places`] first, then by how near
/// they are to the shape of 3 : 2.
pub fn grids(names: &[&str]) -> Vec<[usize; 2]> {
    let count = names.len();
    let sides = (1..=100).filter(|columns| count.is_multiple_of(*columns) && (1..=100).contains(&(count / columns)));
    let mut all: Vec<[usize; 2]> = sides.map(|columns| [columns, count / columns]).collect();
    let off = |[columns, rows]: [usize; 2]| (columns as f64 / rows as f64 / 1.5).ln().abs();
    let named = cells(names.iter().copied());
    let is_named = |grid: [usize; 2]| named.as_ref().is_some_and(|cells| places(cells, grid).is_some());
    // The bits of positive numbers are in the numbers' order.
    all.sort_by_cached_key(|grid| (!is_named(*grid), off(*grid).to_bits()));
    all
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
