//! Marks under the pointer.

use chromascope_figure::{Mark, Panel, Shape, Tag};
use egui::Pos2;

use super::View;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    pub tag: Tag,
    /// Its place among the panel's marks.
    pub mark: usize,
    /// The nearest of its points.
    pub index: usize,
    /// Its distance from the pointer in points; 0 inside an area.
    pub distance: f32,
}

/// The nearest mark within `radius` points of the pointer: points before lines, lines before areas; among equals the
/// one drawn last.
pub fn nearest(panel: &Panel, view: &View, pointer: Pos2, radius: f32) -> Option<Hit> {
    if !view.rect.contains(pointer) {
        return None;
    }
    [points, lines, areas].into_iter().find_map(|distance_to| {
        let hits = panel.marks.iter().enumerate().filter_map(|(mark, drawn)| {
            let (index, distance) = distance_to(drawn, view, pointer)?;
            Some(Hit { tag: drawn.tag, mark, index, distance })
        });
        hits.filter(|hit| hit.distance <= radius)
            .reduce(|best, hit| if hit.distance <= best.distance { hit } else { best })
    })
}

fn least(distances: impl Iterator<Item = (usize, f32)>) -> Option<(usize, f32)> {
    distances.filter(|(_, d)| d.is_finite()).min_by(|a, b| a.1.total_cmp(&b.1))
}

fn is_finite(point: [f64; 2]) -> bool {
    point.iter().all(|v| v.is_finite())
}

fn points(mark: &Mark, view: &View, pointer: Pos2) -> Option<(usize, f32)> {
    let Shape::Points { points, .. } = &mark.shape else {
        return None;
    };
    let finite = points.iter().enumerate().filter(|(_, p)| is_finite(**p));
    least(finite.map(|(i, p)| (i, view.at(*p).distance(pointer))))
}

fn lines(mark: &Mark, view: &View, pointer: Pos2) -> Option<(usize, f32)> {
    let segment = |i: usize, a: [f64; 2], b: [f64; 2]| {
        let known = is_finite(a) && is_finite(b);
        known.then(|| to_segment(i, view.at(a), view.at(b), pointer))
    };
    match &mark.shape {
        Shape::Line { points, closed } => {
            let last = points.len().checked_sub(1)?;
            let back = segment(last, points[last], points[0]).filter(|_| *closed);
            let there = points.windows(2).enumerate().filter_map(|(i, p)| segment(i, p[0], p[1]));
            least(there.chain(back))
        }
        Shape::Gradient { points } => {
            least(points.windows(2).enumerate().filter_map(|(i, p)| segment(i, p[0].0, p[1].0)))
        }
        Shape::Segments { segments } => least(
            segments.iter().enumerate().filter_map(|(i, s)| segment(i, s[0], s[1]).map(|(_, distance)| (i, distance))),
        ),
        _ => None,
    }
}

fn areas(mark: &Mark, view: &View, pointer: Pos2) -> Option<(usize, f32)> {
    let Shape::Rect { min, max } = &mark.shape else {
        return None;
    };
    let known = is_finite(*min) && is_finite(*max);
    let area = egui::Rect::from_two_pos(view.at(*min), view.at(*max));
    (known && area.contains(pointer)).then_some((0, 0.0))
}

/// Distance from a straight line, and which of its ends (`i` or the next) is nearer.
fn to_segment(i: usize, a: Pos2, b: Pos2, pointer: Pos2) -> (usize, f32) {
    let along = b - a;
    let length = along.length_sq();
    let t = if length > 0.0 { ((pointer - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (i + usize::from(t > 0.5), (a + t * along).distance(pointer))
}
