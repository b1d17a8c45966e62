//! The sum where the largest term is far out and yet nearly alone.
//!
//! The terms fall off from n = m like a bell of variance `m/(1 + 2δ)`. With b ≫ g² that can be less than the distance between
//! two of them, however large m is: no integral stands for the sum then, and a few neighbors of the largest term are all of it.

use super::saddle::Peak;

/// Number of neighbors added on each side. The first term is never among them: m is at least 22 here.
const REACH: u32 = 13;

/// S as e to the first times the second, for m ≥ 22 with a variance below 2.
#[cold]
pub(super) fn sum(peak: &Peak) -> (f64, f64) {
    let Peak { g, b, m, .. } = *peak;
    let (top, ln_g) = (m.floor(), g.ln());
    // The next term over the n-th.
    let ratio = |n: f64| n / ((n + 1.0) * (n + 1.0)) * (ln_g + b / n / (n + 1.0)).exp();
    let (mut above, mut below, mut rest) = (1.0, 1.0, 1.0);
    for i in (0..REACH).map(f64::from) {
        above *= ratio(top + i);
        below /= ratio(top - 1.0 - i);
        rest += above + below;
    }
    (top * ln_g - g - b / top - ln_factorial(top) - top.ln(), rest)
}

/// ln n! by Stirling's series, for n ≥ 22 within 1e-15 beside its rounding.
fn ln_factorial(n: f64) -> f64 {
    let x = 1.0 / (n * n);
    let series = (1.0 / 12.0 - x * (1.0 / 360.0 - x * (1.0 / 1260.0 - x / 1680.0))) / n;
    (n + 0.5) * n.ln() - n + 0.5 * std::f64::consts::TAU.ln() + series
}
