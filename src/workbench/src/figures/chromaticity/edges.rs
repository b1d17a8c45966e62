//! Arrows at the edge of the plot, to patches outside it.

use chromascope_figure::{InkRole, Mark, Marker, Shape};

use super::drawing::Drawing;
use super::frame::Frame;

/// Radius of an arrow in points.
const RADIUS: f64 = 5.0;
/// Arrows of one sensor are at least this far apart.
const APART: f64 = 8.0;

/// The position of a point's arrow, or its own where it lies in the plot.
fn inward(at: [f64; 2], frame: &Frame) -> [f64; 2] {
    const INSET: f64 = RADIUS + 3.0;
    if frame.contains(at, 0.0) { at } else { [0, 1].map(|axis| at[axis].min(frame.size[axis] - INSET).max(INSET)) }
}

/// A point, or that of its arrow.
pub(super) fn held_inside(point: [f64; 2], frame: &Frame) -> [f64; 2] {
    frame.value(inward(frame.at(point), frame))
}

/// Adds an arrow for each patch that lies outside the plot; those close together share one.
pub(super) fn add(drawing: &mut Drawing<'_>) {
    let frame = drawing.frame;
    let mut arrows: Vec<Mark> = Vec::new();
    let mut taken: Vec<([f64; 2], InkRole)> = Vec::new();
    for mark in &drawing.points {
        let Shape::Points { points, .. } = &mark.shape else { continue };
        let Some(ink) = mark.stroke.map(|stroke| stroke.ink).or(mark.fill) else { continue };
        for at in points.iter().map(|point| frame.at(*point)).filter(|at| !frame.contains(*at, 0.0)) {
            let beyond = [0, 1].map(|axis| (-at[axis]).max(at[axis] - frame.size[axis]));
            let axis = usize::from(beyond[1] > beyond[0]);
            let marker = match (axis, at[axis] < 0.0) {
                (0, true) => Marker::TriangleLeft,
                (0, false) => Marker::TriangleRight,
                (_, true) => Marker::TriangleUp,
                (_, false) => Marker::TriangleDown,
            };
            let edge = inward(at, &frame);
            let near = |(other, role): &([f64; 2], InkRole)| {
                *role == ink.role && (other[0] - edge[0]).hypot(other[1] - edge[1]) < APART
            };
            if !edge.iter().all(|v| v.is_finite()) || taken.iter().any(near) {
                continue;
            }
            taken.push((edge, ink.role));
            let shape = Shape::Points { points: vec![frame.value(edge)], marker, radius: RADIUS };
            let arrow = Mark::new(mark.tag, format!("{}, outside", mark.name), shape);
            arrows.push(arrow.with_fill(ink).with_halo(InkRole::Plot));
        }
    }
    drawing.small.append(&mut arrows);
}
