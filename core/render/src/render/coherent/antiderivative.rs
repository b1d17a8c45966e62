//! `H(u) = Si(2u) − sin²u/u`, the antiderivative of sinc², from a table: faster than the sine integrals of
//! [`crate::reflectance::coherent`].

use crate::reflectance::coherent::{sinc, sine_integral};
use std::sync::LazyLock;

/// End of the table, in radians.
pub(super) const LAST: f64 = 256.0;
/// Steps to a radian.
const STEPS: f64 = 16.0;

/// Coefficients of the polynomials of degree five that have H's values, slopes and curvatures at both ends of each step.
static CELLS: LazyLock<Vec<[f64; 6]>> = LazyLock::new(|| {
    let ends: Vec<[f64; 3]> = (0..=(LAST * STEPS) as usize + 1).map(|i| derivatives(i as f64 / STEPS)).collect();
    ends.windows(2).map(|pair| hermite(pair[0], pair[1])).collect()
});

/// H, and its slope and half its curvature for a variable that counts steps.
fn derivatives(u: f64) -> [f64; 3] {
    let sinc_u = sinc(u);
    let curvature = if u == 0.0 { 0.0 } else { 2.0 * sinc_u * (u.cos() - sinc_u) / u };
    [sine_integral(2.0 * u) - u * sinc_u * sinc_u, sinc_u * sinc_u / STEPS, curvature / (2.0 * STEPS * STEPS)]
}

fn hermite([a, b, c]: [f64; 3], [a1, b1, c1]: [f64; 3]) -> [f64; 6] {
    // What value, slope and curvature at the far end leave to the three highest powers.
    let (rise, slope, curve) = (a1 - a - b - c, b1 - b - 2.0 * c, c1 - c);
    [
        a,
        b,
        c,
        10.0 * rise - 4.0 * slope + curve,
        -15.0 * rise + 7.0 * slope - 2.0 * curve,
        6.0 * rise - 3.0 * slope + curve,
    ]
}

/// H(u) for |u| up to [`LAST`]: error below 1e-11.
#[inline]
pub(super) fn at(u: f64) -> f64 {
    let position = u.abs() * STEPS;
    let index = (position as usize).min(CELLS.len() - 1);
    let t = position - index as f64;
    let [a, b, c, d, e, f] = CELLS[index];
    (a + t * (b + t * (c + t * (d + t * (e + t * f))))).copysign(u)
}
