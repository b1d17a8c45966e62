//! Color differences.

use super::Lab;

/// Coordinates beyond this have no color to differ in; they are taken as this, so that squares and products stay finite.
const LIMIT: f64 = 1e60;

/// The CIE 1976 difference ΔE*ab: the straight distance in L*a*b*.
pub fn delta_e_1976(a: Lab, b: Lab) -> f64 {
    let (a, b) = (bounded(a), bounded(b));
    (a.l - b.l).hypot(a.a - b.a).hypot(a.b - b.b)
}

/// The CIEDE2000 difference ΔE*00 with unit parametric factors (CIE 142-2001; Sharma, Wu and Dalal 2005).
///
/// Implements the hue rules of Sharma et al., whose 34 pairs hold it to 4 decimals: hue differences of exactly 180° stay on
/// their side, and achromatic colors have hue 0. Symmetric; zero only for equal colors.
pub fn delta_e_2000(first: Lab, second: Lab) -> f64 {
    let (first, second) = (bounded(first), bounded(second));
    let chroma = f64::midpoint(first.a.hypot(first.b), second.a.hypot(second.b));
    let g = 0.5 * (1.0 - seventh_power_share(chroma).sqrt());
    let [(c1, h1), (c2, h2)] = [first, second].map(|lab| {
        let a = (1.0 + g) * lab.a;
        (a.hypot(lab.b), hue_degrees(a, lab.b))
    });
    let dl = second.l - first.l;
    let dc = c2 - c1;
    let dh_degrees = hue_difference(c1, h1, c2, h2);
    let dh = 2.0 * (c1 * c2).sqrt() * (dh_degrees / 2.0).to_radians().sin();

    let l = f64::midpoint(first.l, second.l);
    let c = f64::midpoint(c1, c2);
    let h = mean_hue(c1, h1, c2, h2);
    let t = 1.0 - 0.17 * cos_degrees(h - 30.0) + 0.24 * cos_degrees(2.0 * h) + 0.32 * cos_degrees(3.0 * h + 6.0)
        - 0.20 * cos_degrees(4.0 * h - 63.0);
    let lift = (l - 50.0) * (l - 50.0);
    let sl = 1.0 + 0.015 * lift / (20.0 + lift).sqrt();
    let sc = 1.0 + 0.045 * c;
    let sh = 1.0 + 0.015 * c * t;
    let turn = 30.0 * (-((h - 275.0) / 25.0).powi(2)).exp();
    let rt = -2.0 * seventh_power_share(c).sqrt() * (2.0 * turn).to_radians().sin();
    let [l, c, h] = [dl / sl, dc / sc, dh / sh];
    (l * l + c * c + h * h + rt * c * h).max(0.0).sqrt()
}

/// The same color with each coordinate within the limit.
fn bounded(lab: Lab) -> Lab {
    let [l, a, b] = [lab.l, lab.a, lab.b].map(|v| v.clamp(-LIMIT, LIMIT));
    Lab { l, a, b }
}

/// c⁷ / (c⁷ + 25⁷), without overflow.
fn seventh_power_share(c: f64) -> f64 {
    let r = (c / 25.0).powi(7);
    if r.is_finite() { r / (r + 1.0) } else { 1.0 }
}

/// The hue angle in degrees, 0 to 360; 0 for an achromatic color.
fn hue_degrees(a: f64, b: f64) -> f64 {
    if a == 0.0 && b == 0.0 { 0.0 } else { b.atan2(a).to_degrees().rem_euclid(360.0) }
}

/// From the first hue to the second, −180° to 180°; 0 if either color is achromatic.
fn hue_difference(c1: f64, h1: f64, c2: f64, h2: f64) -> f64 {
    let d = h2 - h1;
    if c1 * c2 == 0.0 {
        0.0
    } else if d.abs() <= 180.0 {
        d
    } else if d > 180.0 {
        d - 360.0
    } else {
        d + 360.0
    }
}

/// The mean hue, by the published case rule.
fn mean_hue(c1: f64, h1: f64, c2: f64, h2: f64) -> f64 {
    let sum = h1 + h2;
    if c1 * c2 == 0.0 {
        sum
    } else if (h1 - h2).abs() <= 180.0 {
        sum / 2.0
    } else if sum < 360.0 {
        f64::midpoint(sum, 360.0)
    } else {
        (sum - 360.0) / 2.0
    }
}

fn cos_degrees(angle: f64) -> f64 {
    angle.to_radians().cos()
}
