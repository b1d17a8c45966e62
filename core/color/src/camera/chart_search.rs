//! Search for a chart of 6 × 4 patches in a linear picture.
//!
//! ```text
//! flat regions → quadrilaterals → lattice → homography of its cells → position and rotation by color → edges
//! ln m_kc = ln e_kc + g_c + p·x_k + r_kc       m = patch in the picture, e = expected, g = gain, p = slope of the light
//! ```
//! Regions are those whose logarithm hardly changes from pixel to pixel, at several thresholds. Neighbors of like size form a lattice
//! (`lattice`); of its windows of 6 × 4 cells and their rotations the one is taken whose colors have the smallest RMS of r; the edges
//! of all patches then place the grid to a fraction of a pixel (`edges`).

mod edges;
mod found;
mod lattice;
mod quads;

use std::collections::BTreeMap;

use glam::{DMat3, DVec2, DVec3};

pub use edges::refine_chart;
pub use found::{CHART_SIZE, FoundChart};
use found::{COLUMNS, PATCHES, ROWS, corners, pixel_at, project};

/// Largest RMS of the logarithms' residuals.
const WORST_COLOR: f64 = 0.4;
/// Largest share of the second best position's residual that the best may have.
const DISTINCT: f64 = 0.75;
/// Level, as a share of the chart's brightest patch, that is added before logarithms: noise and glare of dark patches.
const FLOOR: f64 = 0.02;
/// Largest residual that counts in full.
const OUTLIER: f64 = 0.7;

/// Searches a linear picture (rows of pixels, at most some 1000 along a side) for a chart of 24 patches. `expected` has the RGB of the
/// patches row by row from the first, of any camera under any daylight, with any gain a channel. None where no chart is found for certain.
pub fn find_chart(size: [usize; 2], rgb: &[[f32; 3]], expected: &[[f64; 3]]) -> Option<FoundChart> {
    let [width, height] = size;
    if width < 16 || height < 16 || rgb.len() != width.checked_mul(height)? || expected.len() != PATCHES {
        return None;
    }
    let pixel = |x: usize, y: usize| rgb[y * width + x].map(f64::from);
    let expected: Vec<DVec3> = expected.iter().map(|rgb| DVec3::from_array(*rgb)).collect();
    let lattices = lattice::lattices(&quads::flat_quads(size, rgb));
    let windows = lattices.iter().filter_map(|lattice| colored_window(lattice, size, pixel, &expected));
    let (color_residual, picture_from_cells) = windows.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let rough = FoundChart { corners: corners(picture_from_cells), fill: [0.85; 2], color_residual, edges: 0.0 };
    refine_chart(&rough, size, pixel)
}

/// Part of a lattice of the chart's size, one way round.
#[derive(Clone, Copy)]
struct Window {
    /// The chart's first cell.
    first: [i32; 2],
    /// Directions of its columns and rows.
    right: [i32; 2],
    down: [i32; 2],
}

impl Window {
    /// All windows whose first cell lies between two others, after each quarter turn.
    fn all(low: [i32; 2], high: [i32; 2]) -> impl Iterator<Item = Self> {
        let turns = [([1, 0], [0, 1]), ([0, 1], [-1, 0]), ([-1, 0], [0, -1]), ([0, -1], [1, 0])];
        let places = (low[1]..=high[1]).flat_map(move |y| (low[0]..=high[0]).map(move |x| [x, y]));
        places.flat_map(move |first| turns.map(|(right, down)| Self { first, right, down }))
    }

    /// Cells of the patches in order.
    fn cells(self) -> impl Iterator<Item = [i32; 2]> {
        let cell = move |column: i32, row: i32| {
            [0, 1].map(|axis: usize| self.first[axis] + column * self.right[axis] + row * self.down[axis])
        };
        (0..ROWS).flat_map(move |row| (0..COLUMNS).map(move |column| cell(column, row)))
    }

    /// Affine map from the chart, whose first cell is [0, 1]², to the lattice, whose cells have their middles at whole numbers.
    fn lattice_from_chart(self) -> DMat3 {
        let [first, right, down] = [self.first, self.right, self.down].map(lattice::point);
        DMat3::from_cols(right.extend(0.0), down.extend(0.0), (first - (right + down) / 2.0).extend(1.0))
    }
}

/// The window whose colors fit best, if it does so by far: residual and homography from the chart's cells.
fn colored_window(
    lattice: &lattice::Lattice,
    size: [usize; 2],
    pixel: impl Fn(usize, usize) -> [f64; 3],
    expected: &[DVec3],
) -> Option<(f64, DMat3)> {
    let [low, high] = [lattice.low.map(|low| low - COLUMNS), lattice.high.map(|high| high + COLUMNS)];
    let mut colors = BTreeMap::new();
    let mut fits: Vec<(f64, Window)> = Vec::new();
    for window in Window::all(low, high) {
        let known = window.cells().filter(|cell| lattice.cells.contains_key(cell)).count();
        if known < lattice::FEWEST.max(lattice.cells.len() / 2) {
            continue;
        }
        let mut color = |cell: [i32; 2]| {
            let sampled = || cell_color(lattice.picture_from_cells, lattice::point(cell), size, &pixel);
            *colors.entry(cell).or_insert_with(sampled)
        };
        let sampled: Option<Vec<DVec3>> = window.cells().map(&mut color).collect();
        fits.extend(sampled.and_then(|sampled| Some((color_residual(&sampled, expected)?, window))));
    }
    fits.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (residual, window) = *fits.first()?;
    let distinct = fits.get(1).is_none_or(|second| residual < DISTINCT * second.0);
    (residual < WORST_COLOR && distinct).then(|| (residual, lattice.picture_from_cells * window.lattice_from_chart()))
}

/// Median of 25 places in the middle of a cell.
fn cell_color(
    picture_from_cells: DMat3,
    center: DVec2,
    size: [usize; 2],
    pixel: impl Fn(usize, usize) -> [f64; 3],
) -> Option<DVec3> {
    let mut channels = [[0.0; 25]; 3];
    for index in 0..25 {
        let offset = DVec2::new(f64::from(index % 5 - 2), f64::from(index / 5 - 2)) * 0.1;
        let [x, y] = pixel_at(project(picture_from_cells, center + offset), size)?;
        for (channel, value) in channels.iter_mut().zip(pixel(x, y)) {
            channel[index as usize] = value;
        }
    }
    let median = |mut values: [f64; 25]| {
        values.sort_by(f64::total_cmp);
        values[12]
    };
    let color = DVec3::from_array(channels.map(median));
    color.is_finite().then_some(color)
}

/// RMS of the logarithms' residuals after one gain a channel and a slope of the light; residuals beyond [`OUTLIER`] count as that.
fn color_residual(measured: &[DVec3], expected: &[DVec3]) -> Option<f64> {
    let logarithms = |colors: &[DVec3]| -> Option<Vec<DVec3>> {
        let most = colors.iter().fold(DVec3::ZERO, |most, color| most.max(*color));
        let ln = |color: &DVec3| (color.max(DVec3::ZERO) / most + FLOOR).map(chromascope_math::ln::ln);
        (most.min_element() > 0.0).then(|| colors.iter().map(ln).collect())
    };
    let mut residuals: Vec<DVec3> =
        logarithms(measured)?.iter().zip(logarithms(expected)?).map(|(m, e)| m - e).collect();
    let mean = residuals.iter().sum::<DVec3>() / PATCHES as f64;
    let place = |k: usize| DVec2::new((k % CHART_SIZE[0]) as f64 - 2.5, (k / CHART_SIZE[0]) as f64 - 1.5);
    // On the whole grid the slopes are orthogonal to each other and to the gains.
    let sums = (0..PATCHES).fold((DVec2::ZERO, DVec2::ZERO), |(up, square), k| {
        (up + place(k) * (residuals[k] - mean).element_sum(), square + 3.0 * place(k) * place(k))
    });
    let slope = sums.0 / sums.1;
    for (k, residual) in residuals.iter_mut().enumerate() {
        *residual = *residual - mean - slope.dot(place(k));
    }
    let square = residuals.iter().map(|r| r.abs().min(DVec3::splat(OUTLIER)).length_squared()).sum::<f64>();
    Some((square / (3.0 * PATCHES as f64)).sqrt())
}
