//! Parts of shapes inside a rectangle, so that nothing is written that lies off the page.

use crate::rect::Rect;

/// The part of a rectangle inside.
pub(crate) fn rect(within: Rect, area: Rect) -> Option<Rect> {
    let min = [0, 1].map(|axis| area.min[axis].max(within.min[axis]));
    let max = [0, 1].map(|axis| area.max[axis].min(within.max[axis]));
    (min[0] <= max[0] && min[1] <= max[1]).then_some(Rect { min, max })
}

/// The part of a straight line inside a rectangle, its edges included (Liang and Barsky 1984).
pub fn segment(rect: Rect, [a, b]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let mut share = [0.0_f64, 1.0];
    for axis in 0..2 {
        let step = b[axis] - a[axis];
        for (distance, towards) in [(rect.min[axis] - a[axis], step), (a[axis] - rect.max[axis], -step)] {
            if towards == 0.0 && distance > 0.0 {
                return None;
            }
            if towards > 0.0 {
                share[0] = share[0].max(distance / towards);
            } else if towards < 0.0 {
                share[1] = share[1].min(distance / towards);
            }
        }
    }
    let at = |t: f64| if t == 1.0 { b } else { [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])] };
    (share[0] <= share[1]).then(|| share.map(at))
}

/// The stretches of a line inside.
pub(crate) fn line(rect: Rect, points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let mut runs: Vec<Vec<[f64; 2]>> = Vec::new();
    for pair in points.windows(2) {
        let Some([from, to]) = segment(rect, [pair[0], pair[1]]) else { continue };
        match runs.last_mut() {
            Some(run) if run.last() == Some(&from) => run.push(to),
            _ => runs.push(vec![from, to]),
        }
    }
    runs
}

/// The part of an area inside (Sutherland and Hodgman 1974).
pub(crate) fn area(rect: Rect, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut corners = points.to_vec();
    for (axis, sign, limit) in
        [(0, 1.0, rect.min[0]), (0, -1.0, -rect.max[0]), (1, 1.0, rect.min[1]), (1, -1.0, -rect.max[1])]
    {
        let depth = |p: [f64; 2]| sign * p[axis] - limit;
        let mut kept = Vec::with_capacity(corners.len() + 4);
        let mut previous = corners.last().copied();
        for &corner in &corners {
            if let Some(before) = previous.filter(|before| (depth(*before) < 0.0) != (depth(corner) < 0.0)) {
                let t = depth(before) / (depth(before) - depth(corner));
                kept.push([before[0] + t * (corner[0] - before[0]), before[1] + t * (corner[1] - before[1])]);
            }
            if depth(corner) >= 0.0 {
                kept.push(corner);
            }
            previous = Some(corner);
        }
        corners = kept;
    }
    corners
}
