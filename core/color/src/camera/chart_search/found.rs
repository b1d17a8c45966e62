//! A found chart, and places of its cells in the picture.

use glam::{DMat3, DVec2, DVec3};

/// Columns and rows of the chart.
pub const CHART_SIZE: [usize; 2] = [COLUMNS as usize, ROWS as usize];
pub(super) const COLUMNS: i32 = 6;
pub(super) const ROWS: i32 = 4;
pub(super) const PATCHES: usize = CHART_SIZE[0] * CHART_SIZE[1];

/// A chart of 6 × 4 patches found in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundChart {
    /// Outer corners of the grid's 6 × 4 equal cells, half a gap outside the outer patches: top left (dark skin), top right, bottom right,
    /// bottom left; in pixels, with (0, 0) at the picture's top left, as [`crate::camera::chart_grid::ChartGrid::new`] takes them.
    pub corners: [[f64; 2]; 4],
    /// Width and height of a patch as shares of its cell's.
    pub fill: [f64; 2],
    /// RMS of ln(measured / expected) after one gain a channel and a linear slope of the light.
    pub color_residual: f64,
    /// Share of the patches' 96 edges that were found where the grid has them.
    pub edges: f64,
}

/// Corners of the chart's cells [0, 6] × [0, 4] in the picture.
pub(super) fn corners(picture_from_cells: DMat3) -> [[f64; 2]; 4] {
    let [columns, rows] = CHART_SIZE.map(|n| n as f64);
    [[0.0, 0.0], [columns, 0.0], [columns, rows], [0.0, rows]]
        .map(|corner| project(picture_from_cells, DVec2::from_array(corner)).to_array())
}

pub(super) fn project(homography: DMat3, point: DVec2) -> DVec2 {
    let point = homography * DVec3::new(point.x, point.y, 1.0);
    point.truncate() / point.z
}

/// Pixel in which a place of the picture lies.
pub(super) fn pixel_at(place: DVec2, [width, height]: [usize; 2]) -> Option<[usize; 2]> {
    let inside = place.x >= 0.0 && place.y >= 0.0 && place.x < width as f64 && place.y < height as f64;
    inside.then_some([place.x as usize, place.y as usize])
}
