//! Quadrilaterals among the flat regions of a picture.

use glam::DVec2;

/// Differences of logarithms, from pixel to pixel but one, below which a region is flat.
const THRESHOLDS: [f32; 5] = [0.04, 0.08, 0.16, 0.3, 0.6];
/// Fewest pixels of a region, and reciprocals of its smallest and largest share of the picture.
const FEWEST_PIXELS: usize = 24;
const SMALLEST: usize = 4000;
const LARGEST: usize = 16;
/// Most quadrilaterals, of which the largest are kept.
const MOST: usize = 400;
/// Smallest share of its quadrilateral that a region's hull fills, and of the hull that its pixels fill.
const FULL: f64 = 0.85;
const SOLID: f64 = 0.6;
/// Smallest ratio of two sides.
const SLENDER: f64 = 0.35;

/// A convex quadrilateral.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quad {
    /// Where the diagonals meet.
    pub center: DVec2,
    /// Mean of two opposite sides, and of the others; the turn from the first to the second is positive.
    pub sides: [DVec2; 2],
    pub area: f64,
    /// Share of it that the region fills.
    full: f64,
}

/// Quadrilaterals that flat regions fill, each place once.
pub(super) fn flat_quads(size: [usize; 2], rgb: &[[f32; 3]]) -> Vec<Quad> {
    let steepness = steepness(size, rgb);
    let mut quads: Vec<Quad> = Vec::new();
    for threshold in THRESHOLDS {
        regions(size, &steepness, threshold, |pixels| quads.extend(quad(pixels, size[0])));
    }
    quads.sort_by(|a, b| b.full.total_cmp(&a.full));
    let mut kept: Vec<Quad> = Vec::new();
    for quad in quads {
        let same = |other: &Quad| {
            other.center.distance_squared(quad.center) < 0.1 * other.area.min(quad.area)
                && (0.4..2.5).contains(&(other.area / quad.area))
        };
        if !kept.iter().any(same) {
            kept.push(quad);
        }
    }
    kept.sort_by(|a, b| b.area.total_cmp(&a.area));
    kept.truncate(MOST);
    kept
}

/// Largest change of a channel's logarithm across each pixel.
fn steepness([width, height]: [usize; 2], rgb: &[[f32; 3]]) -> Vec<f32> {
    let mut samples: Vec<[f32; 3]> = rgb.iter().step_by(rgb.len().div_ceil(20_000)).copied().collect();
    let middle = samples.len() / 2;
    let floor = [0, 1, 2].map(|c: usize| {
        let median = samples.select_nth_unstable_by(middle, |a, b| a[c].total_cmp(&b[c])).1[c];
        let mean = samples.iter().map(|sample| sample[c]).sum::<f32>() / samples.len() as f32;
        (0.05 * median).max(0.005 * mean).max(f32::MIN_POSITIVE)
    });
    let logarithm = |pixel: &[f32; 3]| [0, 1, 2].map(|c: usize| (pixel[c].max(0.0) + floor[c]).ln());
    let logarithms: Vec<[f32; 3]> = rgb.iter().map(logarithm).collect();
    let logarithms = blurred(&blurred(&logarithms, 1), width);
    let mut steepness = vec![f32::INFINITY; rgb.len()];
    for y in 1..height - 1 {
        for x in 1..width - 1 {
            let at = y * width + x;
            let change = |c: usize| {
                let difference = |step: usize| (logarithms[at + step][c] - logarithms[at - step][c]).abs();
                difference(1) + difference(width)
            };
            steepness[at] = change(0).max(change(1)).max(change(2));
        }
    }
    steepness
}

/// Binomial means of three pixels, `step` apart.
fn blurred(pixels: &[[f32; 3]], step: usize) -> Vec<[f32; 3]> {
    let mut blurred = pixels.to_vec();
    for (to, at) in blurred.iter_mut().skip(step).zip(step..pixels.len() - step) {
        let [before, own, after] = [pixels[at - step], pixels[at], pixels[at + step]];
        *to = [0, 1, 2].map(|c: usize| 0.25 * (before[c] + after[c]) + 0.5 * own[c]);
    }
    blurred
}

/// Calls with the pixels of each connected flat region that may be a patch.
fn regions([width, height]: [usize; 2], steepness: &[f32], threshold: f32, mut found: impl FnMut(&[usize])) {
    let few = (width * height / SMALLEST).max(FEWEST_PIXELS);
    let mut seen: Vec<bool> = steepness.iter().map(|value| value.is_nan() || *value >= threshold).collect();
    let mut region = Vec::new();
    for start in 0..seen.len() {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        region.clear();
        region.push(start);
        let mut next = 0;
        while let Some(&at) = region.get(next) {
            next += 1;
            // The picture's outermost pixels are never flat.
            for neighbor in [at - 1, at + 1, at - width, at + width] {
                if !std::mem::replace(&mut seen[neighbor], true) {
                    region.push(neighbor);
                }
            }
        }
        if (few..=width * height / LARGEST).contains(&region.len()) {
            found(&region);
        }
    }
}

/// Quadrilateral of a region, if the region fills it.
fn quad(region: &[usize], width: usize) -> Option<Quad> {
    let hull = hull(region, width);
    let hull_area = (0..hull.len()).map(|k| hull[k].perp_dot(hull[(k + 1) % hull.len()])).sum::<f64>() / 2.0;
    let [a, b, c, d] = circumscribed(hull)?;
    let area = (c - a).perp_dot(d - b) / 2.0;
    let full = hull_area / area;
    let solid = region.len() as f64 >= SOLID * hull_area;
    let sides = [(b - a + c - d) / 2.0, (c - b + d - a) / 2.0];
    let lengths = [a.distance(b), b.distance(c), c.distance(d), d.distance(a)];
    let (least, most) = lengths.iter().fold((f64::MAX, 0.0_f64), |(least, most), l| (least.min(*l), most.max(*l)));
    let along = (c - a) * ((b - a).perp_dot(d - b) / (c - a).perp_dot(d - b));
    (solid && full >= FULL && least >= SLENDER * most).then_some(Quad { center: a + along, sides, area, full })
}

/// Convex hull of a region's pixels, with a positive turn at each corner (Andrew 1979).
fn hull(region: &[usize], width: usize) -> Vec<DVec2> {
    let (top, bottom) = region.iter().fold((usize::MAX, 0), |(top, bottom), at| (top.min(*at), bottom.max(*at)));
    let top = top / width;
    let mut rows = vec![[usize::MAX, 0]; bottom / width - top + 1];
    for at in region {
        let [first, last] = &mut rows[at / width - top];
        (*first, *last) = ((*first).min(at % width), (*last).max(at % width));
    }
    let corner = |x: usize, y: usize| DVec2::new(x as f64, y as f64);
    let bounds = |(row, [first, last]): (usize, &[usize; 2])| {
        let y = row + top;
        [corner(*first, y), corner(last + 1, y), corner(*first, y + 1), corner(last + 1, y + 1)]
    };
    let corners: Vec<DVec2> = rows.iter().enumerate().flat_map(bounds).collect();
    let mut hull: Vec<DVec2> = Vec::new();
    let mut chain = |points: &mut dyn Iterator<Item = &DVec2>| {
        let start = hull.len();
        for point in points {
            while let [.., a, b] = hull[start..]
                && (b - a).perp_dot(*point - b) <= 0.0
            {
                hull.pop();
            }
            hull.push(*point);
        }
        hull.pop();
    };
    chain(&mut corners.iter());
    chain(&mut corners.iter().rev());
    hull
}

/// Quadrilateral around a convex polygon: sides are given up, the cheapest in area first, until four remain.
fn circumscribed(mut polygon: Vec<DVec2>) -> Option<[DVec2; 4]> {
    while polygon.len() > 4 {
        let n = polygon.len();
        let without = |k: usize| {
            let [a, b, c, d] = [n - 1, 0, 1, 2].map(|step| polygon[(k + step) % n]);
            let turn = (b - a).perp_dot(d - c);
            let tip = b + (b - a) * ((c - b).perp_dot(d - c) / turn);
            let cost = (tip - b).perp_dot(c - tip) / 2.0;
            (turn > 0.0 && cost.is_finite()).then_some((cost.abs(), k, tip))
        };
        let (_, k, tip) = (0..n).filter_map(without).min_by(|a, b| a.0.total_cmp(&b.0))?;
        polygon[k] = tip;
        polygon.remove((k + 1) % n);
    }
    <[DVec2; 4]>::try_from(polygon).ok()
}
