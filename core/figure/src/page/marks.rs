//! Marks of a panel.

use super::{Brush, TextLine, ground};
use crate::clip;
use crate::ink::{Ink, InkRole};
use crate::mark::{Image, Mark, Rgb, Shape, Stroke, color_runs, finite_runs};
use crate::projection::Projection;
use crate::rect::Rect;
use crate::text::text_width;

/// Distance beyond the plot at which shapes are cut: further than half the width of a line, nearer than the page's edge.
const REACH: f64 = 6.0;

/// Draws a picture that is the ground of its panel, made opaque over the background.
pub(super) fn draw_ground(brush: &mut Brush<'_>, mark: &Mark, projection: &Projection, background: Ink) {
    let Shape::Image { min, max, image } = &mark.shape else { return };
    let Some((area, image)) = picture(projection, [*min, *max], image) else { return };
    let page = brush.palette.rgb(InkRole::Plot);
    let over = |i: usize| {
        let [under, over] = [page, brush.palette.rgb(background.role)].map(|rgb| f32::from(rgb[i]));
        (under + background.alpha * (over - under)).round() as u8
    };
    let image = ground::flattened(image, [over(0), over(1), over(2)], area);
    brush.canvas.begin(&mark.name, None);
    brush.canvas.image(area, &image);
    brush.canvas.end();
}

/// Draws one mark, its halo first.
pub(super) fn draw(brush: &mut Brush<'_>, mark: &Mark, projection: &Projection) {
    let reach = projection.plot.enlarged(REACH);
    brush.canvas.begin(&mark.name, None);
    match &mark.shape {
        Shape::Line { points, closed } => line(brush, mark, projection, points, *closed),
        Shape::Gradient { points } => gradient(brush, mark, projection, points),
        Shape::Points { points, marker, radius } => {
            for point in finite_runs(points).flatten() {
                let center = at(projection, *point);
                if reach.contains(center) {
                    brush.marker(center, (*marker, *radius), mark.stroke, mark.fill, mark.halo);
                }
            }
        }
        Shape::Text { .. } => text(brush, mark, projection),
        Shape::Rect { min, max } => {
            if let Some(inside) = placed(projection, *min, *max).and_then(|area| clip::rect(reach, area)) {
                if let Some(halo) = halo_stroke(mark) {
                    brush.rect(inside, Some(halo), None);
                }
                brush.rect(inside, mark.stroke, mark.fill);
            }
        }
        Shape::Polygon { points } => {
            let points: Vec<[f64; 2]> = finite_runs(points).flatten().map(|p| at(projection, *p)).collect();
            area(brush, mark, projection, &points);
        }
        Shape::Image { min, max, image } => {
            if let Some((area, image)) = picture(projection, [*min, *max], image) {
                brush.canvas.image(area, &image);
            }
        }
        Shape::Segments { segments } => {
            for stroke in halo_stroke(mark).into_iter().chain(mark.stroke) {
                for segment in segments.iter().filter(|s| s.as_flattened().iter().all(|v| v.is_finite())) {
                    if let Some(inside) = clip::segment(reach, segment.map(|p| at(projection, p))) {
                        brush.path(&inside, false, Some(stroke), None);
                    }
                }
            }
        }
    }
    brush.canvas.end();
}

/// The place of a point. Far off the page it is held, so that sums and differences are finite.
fn at(projection: &Projection, point: [f64; 2]) -> [f64; 2] {
    projection.at(point).map(|v| v.clamp(-1e6, 1e6))
}

fn halo_stroke(mark: &Mark) -> Option<Stroke> {
    let width = mark.stroke.map_or(0.0, |stroke| stroke.width);
    mark.halo.map(|ink| Stroke::solid(ink, width + 2.0 * Mark::HALO))
}

fn line(brush: &mut Brush<'_>, mark: &Mark, projection: &Projection, points: &[[f64; 2]], closed: bool) {
    let reach = projection.plot.enlarged(REACH);
    for stroke in halo_stroke(mark).into_iter().chain(mark.stroke) {
        for run in finite_runs(points) {
            let whole = closed && run.len() == points.len();
            let mut placed: Vec<[f64; 2]> = run.iter().map(|p| at(projection, *p)).collect();
            if whole && placed.iter().all(|p| reach.contains(*p)) {
                brush.path(&placed, true, Some(stroke), None);
                continue;
            }
            if whole {
                placed.extend(placed.first().copied());
            }
            for part in clip::line(reach, &placed) {
                brush.path(&part, false, Some(stroke), None);
            }
        }
    }
}

fn gradient(brush: &mut Brush<'_>, mark: &Mark, projection: &Projection, points: &[([f64; 2], Rgb)]) {
    let reach = projection.plot.enlarged(REACH);
    let style = mark.stroke.unwrap_or(Stroke::solid(InkRole::Text, 2.0));
    for run in color_runs(points) {
        let placed: Vec<[f64; 2]> = run.iter().map(|p| at(projection, p.0)).collect();
        let ink = Ink { role: InkRole::Rgb(run[0].1), alpha: style.ink.alpha };
        for part in clip::line(reach, &placed) {
            brush.path(&part, false, Some(Stroke { ink, ..style }), None);
        }
    }
}

fn area(brush: &mut Brush<'_>, mark: &Mark, projection: &Projection, corners: &[[f64; 2]]) {
    let inside = clip::area(projection.plot.enlarged(REACH), corners);
    if let Some(halo) = halo_stroke(mark) {
        brush.path(&inside, true, Some(halo), None);
    }
    brush.path(&inside, true, mark.stroke, mark.fill);
}

/// Text at a place in the plot, moved inward where it would be cut at a side.
fn text(brush: &mut Brush<'_>, mark: &Mark, projection: &Projection) {
    let Shape::Text { at: point, text, anchor, offset, size, ink } = &mark.shape else { return };
    if !point.iter().all(|v| v.is_finite()) {
        return;
    }
    let (plot, reach) = (projection.plot, projection.plot.enlarged(REACH));
    let place = at(projection, *point);
    let [x, y] = [place[0] + offset[0], place[1] + offset[1]];
    if !reach.contains(place) || !reach.contains([x, y]) {
        return;
    }
    let width = text_width(text, *size);
    let left = x - anchor.0 * width;
    let inside = if width < plot.width() { left.min(plot.max[0] - width).max(plot.min[0]) } else { left };
    let label = TextLine::new([x + inside - left, y], text, *anchor, *size, *ink);
    brush.text(&TextLine { halo: mark.halo, ..label });
}

fn placed(projection: &Projection, a: [f64; 2], b: [f64; 2]) -> Option<Rect> {
    let (p, q) = (at(projection, a), at(projection, b));
    let rect = Rect { min: [p[0].min(q[0]), p[1].min(q[1])], max: [p[0].max(q[0]), p[1].max(q[1])] };
    [p, q].as_flattened().iter().all(|v| v.is_finite()).then_some(rect)
}

/// The visible part of a picture with its rectangle.
fn picture(projection: &Projection, corners: [[f64; 2]; 2], image: &Image) -> Option<(Rect, Image)> {
    let area = placed(projection, corners[0], corners[1]).filter(|_| image.is_drawable())?;
    ground::cropped(image, area, projection.plot)
}
