//! Bands of uncertainty around curves.

use chromascope_figure::{Ink, Mark, Shape};

use crate::plot_item::PickIndex;

/// Largest number of points of one edge.
const MOST: usize = 1024;
const OPACITY: f32 = 0.22;

/// The coverage factor that a band is drawn with: that of the file; 2 for standard uncertainties.
pub fn coverage(of_file: f64) -> f64 {
    if of_file > 1.0 { of_file } else { 2.0 }
}

/// Words for a legend or caption.
pub fn words(coverage: f64) -> String {
    format!("band: ±U, k = {}", crate::format::number(coverage))
}

/// Points of a curve with the half-width of its band at each, as a translucent area; none of a curve without width.
pub fn mark(name: &str, points: &[([f64; 2], f64)], ink: Ink) -> Option<Mark> {
    let stride = points.len().div_ceil(MOST).max(1);
    let kept = || points.iter().step_by(stride).filter(|(at, half)| at[1].is_finite() && half.is_finite());
    kept().any(|(_, half)| *half > 0.0).then_some(())?;
    let edge = |sign: f64| kept().map(move |([x, y], half)| [*x, y + sign * half]);
    let lower: Vec<[f64; 2]> = edge(-1.0).collect();
    let points = edge(1.0).chain(lower.into_iter().rev()).collect();
    let area = Mark::new(PickIndex::NONE, format!("{name} ±U"), Shape::Polygon { points });
    Some(area.with_fill(ink.faded(OPACITY)))
}
