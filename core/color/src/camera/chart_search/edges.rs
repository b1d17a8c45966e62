//! Edges of the patches, which place the grid.

use chromascope_math::dense::Cholesky;
use chromascope_math::ln::ln_1p;
use chromascope_math::quantile::quantile;
use glam::{DMat3, DVec2, DVec3};

use super::found::{CHART_SIZE, FoundChart, PATCHES, corners, pixel_at, project};
use super::lattice::add_row;
use crate::camera::chart_grid::homography;

/// Rounds of finding edges and moving the grid; in the first [`WIDE`] edges are looked for in [`RANGE`], after the first [`COMPRESSED`] in
/// linear values, in which blur leaves the steepest place of an edge where it is.
const ROUNDS: usize = 6;
const WIDE: usize = 2;
const COMPRESSED: usize = 3;
/// Places along an edge, within its middle ±[`ALONG`] of a cell.
const LINES: usize = 24;
const ALONG: f64 = 0.3;
/// From a patch's center, in cells: where edges are looked for.
const RANGE: [f64; 2] = [0.26, 0.62];
/// Most bins of a profile across an edge.
const BINS: usize = 96;
/// Means of this width, in cells, and of at least one bin, are compared on both sides of an edge.
const STEP: f64 = 0.03;
/// Smallest step of the compressed values at an edge.
const FAINT: f64 = 0.06;
/// Smallest share of a profile's steepest edge that a nearer edge has.
const NEARER: f64 = 0.25;
/// Share of the brightest patch from which on a compressed value is logarithmic.
const KNEE: f64 = 0.1;
/// Distance in cells within which an edge agrees with the grid.
const AGREEING: f64 = 0.03;
/// Smallest share of the patches' edges that must agree.
const FEWEST: f64 = 0.5;
/// Unknowns: a homography and half the fill each way.
const UNKNOWNS: usize = 10;

/// Side of a patch.
#[derive(Clone, Copy)]
struct Side {
    /// Middle of the patch, in cells.
    center: DVec2,
    /// Direction away from it: 0 across, 1 down.
    axis: usize,
    sign: f64,
}

/// All sides of all patches.
fn sides() -> impl Iterator<Item = Side> {
    (0..4 * PATCHES).map(|index| {
        let patch = index / 4;
        let center = DVec2::new((patch % CHART_SIZE[0]) as f64 + 0.5, (patch / CHART_SIZE[0]) as f64 + 0.5);
        Side { center, axis: index % 2, sign: if index % 4 < 2 { 1.0 } else { -1.0 } }
    })
}

/// Grid moved onto the patches' edges in a picture, whose missing values are NaN (such as the two channels that a pixel of a mosaic
/// lacks). The chart is in that picture's pixels and within a fifth of a cell. None where too few edges agree.
pub fn refine_chart(
    chart: &FoundChart,
    size: [usize; 2],
    pixel: impl Fn(usize, usize) -> [f64; 3],
) -> Option<FoundChart> {
    let square_from_cells = DMat3::from_scale(DVec2::from_array(CHART_SIZE.map(|n| n as f64)).recip());
    let mut picture_from_cells = homography(chart.corners.map(DVec2::from_array)) * square_from_cells;
    let mut fill = chart.fill;
    let mut agreeing = 0.0;
    let inner = sides().filter_map(|side| profile(side, picture_from_cells, [0.1, 0.3], size, &pixel));
    let white = inner.flat_map(|profile| profile.means).fold(DVec3::ZERO, DVec3::max);
    if white.min_element() <= 0.0 {
        return None;
    }
    for round in 0..ROUNDS {
        let distance = |side: Side| {
            let window = if round < WIDE { RANGE } else { near(fill[side.axis]) };
            Some((side, profile(side, picture_from_cells, window, size, &pixel)?.edge(white, round < COMPRESSED)?))
        };
        let edges: Vec<(Side, f64)> = sides().filter_map(distance).collect();
        let (warp, count) = moved(&edges, &mut fill)?;
        picture_from_cells *= warp;
        agreeing = count as f64 / (4 * PATCHES) as f64;
    }
    let found = FoundChart { corners: corners(picture_from_cells), fill, edges: agreeing, ..*chart };
    let sound = agreeing >= FEWEST && fill.iter().all(|fill| (0.5..1.1).contains(fill));
    (sound && found.corners.iter().flatten().all(|x| x.is_finite())).then_some(found)
}

/// Where an edge is looked for that lies half a fill from its patch's middle: not as far as the neighbor's.
fn near(fill: f64) -> [f64; 2] {
    let width = (0.6 * (1.0 - fill)).clamp(0.06, 0.1) + STEP;
    [fill / 2.0 - width, fill / 2.0 + width]
}

/// Means along lines at growing distance from a patch's middle.
struct Profile {
    start: f64,
    bin: f64,
    means: Vec<DVec3>,
}

fn profile(
    side: Side,
    picture_from_cells: DMat3,
    [start, end]: [f64; 2],
    size: [usize; 2],
    pixel: impl Fn(usize, usize) -> [f64; 3],
) -> Option<Profile> {
    let across = DVec2::AXES[side.axis] * side.sign;
    let along = DVec2::AXES[1 - side.axis];
    let ends = [0.5, -0.5].map(|half| project(picture_from_cells, side.center + across * half));
    let bin = ((end - start) / BINS as f64).max(1.0 / ends[0].distance(ends[1]));
    let bins = ((end - start) / bin) as usize;
    let cells_from_picture = picture_from_cells.inverse();
    let mut sums = vec![(DVec3::ZERO, DVec3::ZERO); bins.min(BINS)];
    for line in 0..LINES {
        let offset = along * ALONG * ((2 * line + 1) as f64 / LINES as f64 - 1.0);
        for step in 0..sums.len() {
            let place = side.center + offset + across * (start + (step as f64 + 0.5) * bin);
            let Some([x, y]) = pixel_at(project(picture_from_cells, place), size) else { continue };
            // The pixel counts where its center lies.
            let center = project(cells_from_picture, DVec2::new(x as f64 + 0.5, y as f64 + 0.5));
            let index = ((center - side.center).dot(across) - start) / bin;
            let Some((sum, count)) = (index >= 0.0).then(|| sums.get_mut(index as usize)).flatten() else { continue };
            for (c, value) in pixel(x, y).into_iter().enumerate() {
                if value.is_finite() {
                    sum[c] += value;
                    count[c] += 1.0;
                }
            }
        }
    }
    // A bin without a value of a channel repeats the one before it.
    let mut means: Vec<DVec3> = sums.iter().map(|(sum, count)| sum / count).collect();
    for c in 0..3 {
        let mut last = means.iter().map(|mean| mean[c]).find(|mean| mean.is_finite())?;
        for mean in &mut means {
            last = if mean[c].is_finite() { mean[c] } else { last };
            mean[c] = last;
        }
    }
    Some(Profile { start, bin, means })
}

impl Profile {
    /// Distance of the nearest distinct edge from the patch's middle.
    fn edge(&self, white: DVec3, compressed: bool) -> Option<f64> {
        let compress = |mean: &DVec3| {
            let value = mean.max(DVec3::ZERO) / (KNEE * white);
            if compressed { value.map(ln_1p) } else { value }
        };
        let values: Vec<DVec3> = self.means.iter().map(compress).collect();
        let width = ((STEP / self.bin).round() as usize).max(1);
        let mean = |values: &[DVec3]| values.iter().sum::<DVec3>() / width as f64;
        let step = |at: usize| (mean(&values[at..at + width]) - mean(&values[at - width..at])).length();
        let last = values.len().checked_sub(width)?;
        let steps: Vec<f64> = (width..=last).map(step).collect();
        let steepest = steps.iter().copied().fold(FAINT, f64::max);
        let is_peak = |k: &usize| {
            steps[*k] >= NEARER * steepest.max(FAINT / NEARER) && steps[*k] >= steps[k - 1] && steps[*k] > steps[k + 1]
        };
        let peak = (1..steps.len().saturating_sub(1)).find(is_peak)?;
        let [a, b, c] = [steps[peak - 1], steps[peak], steps[peak + 1]];
        let offset = 0.5 * (a - c) / (a - 2.0 * b + c).min(-1e-12);
        Some(self.start + ((peak + width) as f64 + offset.clamp(-0.5, 0.5)) * self.bin)
    }
}

/// Homography of the cells that moves the grid onto edges, fill and number of agreeing edges: weighted least squares, first by the
/// residuals' sum, then without those far out.
///
/// ```text
/// ±(a₀ + a₁x + a₂y + a₆x² + a₇xy) + h = s − f/2      and so down, with a₃ + a₄x + a₅y + a₆xy + a₇y²
/// ```
fn moved(edges: &[(Side, f64)], fill: &mut [f64; 2]) -> Option<(DMat3, usize)> {
    let middle = DVec2::from_array(CHART_SIZE.map(|n| n as f64 / 2.0));
    let scale = middle.x;
    let equation = |(side, distance): &(Side, f64)| {
        let half = fill[side.axis] / 2.0;
        let place = (side.center + DVec2::AXES[side.axis] * side.sign * half - middle) / scale;
        let linear = [1.0, place.x, place.y].map(|value| value * side.sign);
        let mut row = [0.0; UNKNOWNS];
        row[3 * side.axis..][..3].copy_from_slice(&linear);
        row[6] = linear[1] * place[side.axis];
        row[7] = linear[2] * place[side.axis];
        row[8 + side.axis] = 1.0;
        (row, (distance - half) / scale)
    };
    let equations: Vec<([f64; UNKNOWNS], f64)> = edges.iter().map(equation).collect();
    let mut weights = vec![1.0; equations.len()];
    let mut solution = Vec::new();
    let mut residuals = Vec::new();
    for pass in 0..10 {
        let (mut matrix, mut right) = (vec![0.0; UNKNOWNS * UNKNOWNS], vec![0.0; UNKNOWNS]);
        for ((row, target), weight) in equations.iter().zip(&weights) {
            add_row(&mut matrix, &mut right, row, *target, *weight);
        }
        solution = Cholesky::new(matrix, UNKNOWNS)?.solve(right);
        let residual = |(row, target): &([f64; UNKNOWNS], f64)| {
            (target - row.iter().zip(&solution).map(|(a, x)| a * x).sum::<f64>()).abs() * scale
        };
        residuals = equations.iter().map(residual).collect::<Vec<f64>>();
        let spread = 6.0 * quantile(&mut residuals.clone(), 0.5)?.max(5e-4);
        let weight = |residual: &f64| match pass {
            0..5 => 1.0 / residual.max(1e-3),
            _ => (1.0 - (residual / spread).powi(2)).max(0.0).powi(2),
        };
        weights = residuals.iter().map(weight).collect();
    }
    let a = &solution;
    let warp = DMat3::from_cols_array(&[1.0 + a[1], a[4], -a[6], a[2], 1.0 + a[5], -a[7], a[0], a[3], 1.0]);
    let to_cells = DMat3::from_translation(middle) * DMat3::from_scale(DVec2::splat(scale));
    let agreeing = residuals.iter().filter(|residual| **residual < AGREEING).count();
    for (fill, half) in fill.iter_mut().zip(&solution[8..]) {
        *fill += 2.0 * half * scale;
    }
    Some((to_cells * warp * to_cells.inverse(), agreeing))
}
