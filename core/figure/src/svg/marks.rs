//! Marks as SVG elements.

use super::canvas::Canvas;
use crate::ink::{Ink, InkRole};
use crate::mark::{Image, Mark, Rgb, Shape, Stroke, finite_runs};
use crate::projection::Projection;
use crate::rect::Rect;

/// Writes one mark, its halo first.
pub(super) fn write(canvas: &mut Canvas<'_>, mark: &Mark, projection: &Projection) {
    canvas.group(&mark.name);
    match &mark.shape {
        Shape::Line { points, closed } => line(canvas, mark, projection, points, *closed),
        Shape::Gradient { points } => gradient(canvas, mark, projection, points),
        Shape::Points { points, marker, radius } => {
            for point in finite_runs(points).flatten() {
                let at = projection.at(*point);
                canvas.marker(at, *marker, *radius, mark.stroke, mark.fill, mark.halo);
            }
        }
        Shape::Text { at, text, anchor, offset, size, ink } => {
            if at.iter().all(|v| v.is_finite()) {
                let scale = canvas.style.text_scale;
                let [x, y] = projection.at(*at);
                let at = [x + offset[0] * scale, y + offset[1] * scale];
                canvas.text_with_halo(at, text, *anchor, *size, *ink, mark.halo);
            }
        }
        Shape::Rect { min, max } => {
            if let Some(rect) = placed(projection, *min, *max) {
                if let Some(halo) = halo_stroke(mark) {
                    canvas.rect(rect, Some(halo), None);
                }
                canvas.rect(rect, mark.stroke, mark.fill);
            }
        }
        Shape::Polygon { points } => {
            let points: Vec<[f64; 2]> = finite_runs(points).flatten().map(|p| projection.at(*p)).collect();
            if let Some(halo) = halo_stroke(mark) {
                canvas.polyline(&points, true, halo);
            }
            canvas.area(&points, mark.stroke, mark.fill);
        }
        Shape::Image { min, max, image } => picture(canvas, projection, [*min, *max], image),
        Shape::Segments { segments } => {
            for stroke in halo_stroke(mark).into_iter().chain(mark.stroke) {
                for segment in segments.iter().filter(|s| s.as_flattened().iter().all(|v| v.is_finite())) {
                    canvas.polyline(&segment.map(|p| projection.at(p)), false, stroke);
                }
            }
        }
    }
    canvas.end_group();
}

fn halo_stroke(mark: &Mark) -> Option<Stroke> {
    let width = mark.stroke.map_or(0.0, |stroke| stroke.width);
    mark.halo.map(|ink| Stroke::solid(ink, width + 2.0 * Mark::HALO))
}

fn line(canvas: &mut Canvas<'_>, mark: &Mark, projection: &Projection, points: &[[f64; 2]], closed: bool) {
    for stroke in halo_stroke(mark).into_iter().chain(mark.stroke) {
        for run in finite_runs(points) {
            let whole = closed && run.len() == points.len();
            let placed: Vec<[f64; 2]> = run.iter().map(|p| projection.at(*p)).collect();
            canvas.polyline(&placed, whole, stroke);
        }
    }
}

/// Neighbors of one color are written as one line. Each line takes the color of its start.
fn gradient(canvas: &mut Canvas<'_>, mark: &Mark, projection: &Projection, points: &[([f64; 2], Rgb)]) {
    let style = mark.stroke.unwrap_or(Stroke::solid(InkRole::Text, 2.0));
    let finite = |p: &([f64; 2], Rgb)| p.0.iter().all(|v| v.is_finite());
    for run in points.split(|p| !finite(p)) {
        let mut start = 0;
        while start + 1 < run.len() {
            let color = run[start].1;
            let same = run[start + 1..].iter().take_while(|p| p.1 == color).count();
            let end = (start + same.max(1) + 1).min(run.len());
            let placed: Vec<[f64; 2]> = run[start..end].iter().map(|p| projection.at(p.0)).collect();
            let ink = Ink { role: InkRole::Rgb(color), alpha: style.ink.alpha };
            canvas.polyline(&placed, false, Stroke { ink, ..style });
            start = end - 1;
        }
    }
}

fn placed(projection: &Projection, a: [f64; 2], b: [f64; 2]) -> Option<Rect> {
    let (p, q) = (projection.at(a), projection.at(b));
    let rect = Rect { min: [p[0].min(q[0]), p[1].min(q[1])], max: [p[0].max(q[0]), p[1].max(q[1])] };
    [p, q].as_flattened().iter().all(|v| v.is_finite()).then_some(rect)
}

fn picture(canvas: &mut Canvas<'_>, projection: &Projection, corners: [[f64; 2]; 2], image: &Image) {
    let place = placed(projection, corners[0], corners[1]).filter(|_| image.is_drawable());
    if let Some((rect, uri)) = place.and_then(|rect| Some((rect, (canvas.style.encode)(image)?))) {
        canvas.image(rect, &uri);
    }
}
