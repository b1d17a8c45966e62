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
mod lattice;
mod quads;

use glam::{DMat3, DVec2, DVec3};

use super::chart_grid::homography;
pub use edges::refine_chart;

/// Columns and rows of the chart.
pub const CHART_SIZE: [usize; 2] = [6, 4];
const PATCHES: usize = CHART_SIZE[0] * CHART_SIZE[1];
/// Largest RMS of the logarithms' residuals.
const WORST_COLOR: f64 = 0.35;
/// Largest share of the second best position's residual that the best may have.
const DISTINCT: f64 = 0.75;
/// Level, as a share of the chart's brightest patch, that is added before logarithms: noise and glare of dark patches.
const FLOOR: f64 = 0.02;
/// Largest residual that counts in full.
const OUTLIER: f64 = 0.7;

/// A chart of 6 × 4 patches found in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundChart {
    /// Outer corners of the grid's 6 × 4 equal cells, half a gap outside the outer patches: top left (dark skin), top right, bottom right,
    /// bottom left; in pixels, with (0, 0) at the picture's top left, as [`super::chart_grid::ChartGrid::new`] takes them.
    pub corners: [[f64; 2]; 4],
    /// Width and height of a patch as shares of its cell's.
    pub fill: [f64; 2],
    /// RMS of ln(measured / expected) after one gain a channel and a linear slope of the light.
    pub color_residual: f64,
    /// Share of the patches' 96 edges that were found where the grid has them.
    pub edges: f64,
}

impl FoundChart {
    /// Outer corners of the outer patches, in the order of the grid's.
    pub fn patch_corners(&self) -> [[f64; 2]; 4] {
        let cells = DVec2::new(CHART_SIZE[0] as f64, CHART_SIZE[1] as f64);
        let inset = (DVec2::ONE - DVec2::from_array(self.fill)) / 2.0 / cells;
        let picture_from_square = homography(self.corners.map(DVec2::from_array));
        let at = |corner: DVec2| project(picture_from_square, inset + corner * (DVec2::ONE - 2.0 * inset)).to_array();
        [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(at)
    }
}

/// Searches a linear picture (rows of pixels, at most some 1000 along a side) for a chart of 24 patches. `expected` has the RGB of the
/// patches row by row from the first, of any camera under any daylight, with any gain a channel. None where no chart is found for certain.
pub fn find_chart(size: [usize; 2], rgb: &[[f32; 3]], expected: &[[f64; 3]]) -> Option<FoundChart> {
    let [width, height] = size;
    if width < 16 || height < 16 || rgb.len() != width.checked_mul(height)? || expected.len() != PATCHES {
        return None;
    }
    let pixel = |x: usize, y: usize| rgb[y * width + x].map(f64::from);
    let quads = quads::flat_quads(size, rgb);
    let mut best: Option<(f64, DMat3)> = None;
    for cells in lattice::lattices(&quads) {
        if let Some(found) = colored_window(&cells, size, pixel, expected)
            && best.is_none_or(|(residual, _)| found.0 < residual)
        {
            best = Some(found);
        }
    }
    let (color_residual, picture_from_cells) = best?;
    let rough = FoundChart { corners: corners(picture_from_cells), fill: [0.85; 2], color_residual, edges: 0.0 };
    refine_chart(&rough, size, pixel)
}

/// Corners of the chart's cells [0, 6] × [0, 4] in the picture.
fn corners(picture_from_cells: DMat3) -> [[f64; 2]; 4] {
    let [columns, rows] = CHART_SIZE.map(|n| n as f64);
    [[0.0, 0.0], [columns, 0.0], [columns, rows], [0.0, rows]]
        .map(|corner| project(picture_from_cells, DVec2::from_array(corner)).to_array())
}

fn project(homography: DMat3, point: DVec2) -> DVec2 {
    let point = homography * DVec3::new(point.x, point.y, 1.0);
    point.truncate() / point.z
}

/// Pixel in which a place of the picture lies.
fn pixel_at(place: DVec2, [width, height]: [usize; 2]) -> Option<[usize; 2]> {
    let inside = place.x >= 0.0 && place.y >= 0.0 && place.x < width as f64 && place.y < height as f64;
    inside.then(|| [place.x as usize, place.y as usize])
}

/// The window of 6 × 4 cells, either way round, whose colors fit best: their residual and the homography from the chart's cells.
fn colored_window(
    cells: &lattice::Lattice,
    size: [usize; 2],
    pixel: impl Fn(usize, usize) -> [f64; 3],
    expected: &[[f64; 3]],
) -> Option<(f64, DMat3)> {
    let longest = CHART_SIZE[0] as i32;
    let low = cells.low.map(|low| low - longest);
    let extent = [0, 1].map(|axis: usize| (cells.high[axis] + longest - low[axis]) as usize + 1);
    let color = |index: usize| {
        let center = DVec2::new(f64::from(low[0]), f64::from(low[1]))
            + DVec2::new((index % extent[0]) as f64, (index / extent[0]) as f64);
        cell_color(cells.picture_from_cells, center, size, &pixel)
    };
    let colors: Vec<Option<DVec3>> = (0..extent[0] * extent[1]).map(color).collect();
    let expected: Vec<DVec3> = expected.iter().map(|rgb| DVec3::from_array(*rgb)).collect();
    let mut fits: Vec<(f64, DMat3)> = Vec::new();
    for turn in 0..4 {
        // Directions of the chart's columns and rows in the lattice, after quarter turns.
        let [right, down] = [[[1, 0], [0, 1]], [[0, 1], [-1, 0]], [[-1, 0], [0, -1]], [[0, -1], [1, 0]]][turn];
        for start in 0..colors.len() {
            let (x, y) = ((start % extent[0]) as i32, (start / extent[0]) as i32);
            let at = |k: usize| {
                let (column, row) = ((k % CHART_SIZE[0]) as i32, (k / CHART_SIZE[0]) as i32);
                [0, 1].map(|axis: usize| [x, y][axis] + column * right[axis] + row * down[axis])
            };
            let last = at(PATCHES - 1);
            if (0..2).any(|axis| last[axis] < 0 || last[axis] >= extent[axis] as i32) {
                continue;
            }
            let in_lattice = |k: usize| {
                let cell = at(k);
                cells.cells.contains_key(&[cell[0] + low[0], cell[1] + low[1]])
            };
            let known = (0..PATCHES).filter(|k| in_lattice(*k)).count();
            if known < lattice::FEWEST.max(cells.cells.len() / 2) {
                continue;
            }
            let sampled: Option<Vec<DVec3>> = (0..PATCHES)
                .map(|k| {
                    let cell = at(k);
                    colors[cell[1] as usize * extent[0] + cell[0] as usize]
                })
                .collect();
            let Some(residual) = sampled.and_then(|sampled| color_residual(&sampled, &expected)) else { continue };
            let axis = |direction: [i32; 2]| DVec2::new(f64::from(direction[0]), f64::from(direction[1]));
            let origin = DVec2::new(f64::from(x + low[0]), f64::from(y + low[1])) - (axis(right) + axis(down)) / 2.0;
            let lattice_from_chart =
                DMat3::from_cols(axis(right).extend(0.0), axis(down).extend(0.0), origin.extend(1.0));
            fits.push((residual, cells.picture_from_cells * lattice_from_chart));
        }
    }
    fits.sort_by(|a, b| a.0.total_cmp(&b.0));
    let best = *fits.first()?;
    let distinct = fits.get(1).is_none_or(|second| best.0 < DISTINCT * second.0);
    (best.0 < WORST_COLOR && distinct).then_some(best)
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
    let mut residuals: Vec<DVec3> = logarithms(measured)?.iter().zip(logarithms(expected)?).map(|(m, e)| m - e).collect();
    let mean = residuals.iter().sum::<DVec3>() / PATCHES as f64;
    let place = |k: usize| {
        DVec2::new((k % CHART_SIZE[0]) as f64 - 2.5, (k / CHART_SIZE[0]) as f64 - 1.5)
    };
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
