//! The sum, term by term, for few terms.
//!
//! Relative to the term at n = m all terms obey
//! ```text
//! ln(t_n/t_m) ≈ −m [ x ln x − x + 1 + δ (x − 1)²/x ],  x = n/m
//! ```
//! from which bounds follow on where they stop to matter. Where the first term does not matter either, the terms rise and fall
//! so smoothly that every second to eighth of them gives the sum (Poisson's summation formula): two dozen exponentials
//! do for any m.

use super::factorials::LN_FACTORIALS;
use super::saddle::Peak;
use crate::math::exp::exp;

/// More terms than any span has; a multiple of [`LANES`].
const MOST: usize = 128;
/// Partial sums.
const LANES: usize = 8;

/// S as e to the first times the second, without the terms below e^−`depth` of the largest.
#[inline(always)]
pub(super) fn sum(peak: &Peak, depth: f64) -> (f64, f64) {
    let Peak { g, b, m, .. } = *peak;
    let [first, last, stride] = span(peak, depth);
    let top = (m as usize).clamp(1, LN_FACTORIALS.len());
    let ln_ratio = (g / 64.0).ln();
    let (n0, h0) = (top as f64, LN_FACTORIALS[top - 1]);
    let b0 = b / n0;
    let mut buffer = [0.0; MOST];
    let count = ((last - first) / stride + 1).next_multiple_of(LANES).min(MOST);
    let terms = &mut buffer[..count];
    for (term, h) in terms.iter_mut().zip(LN_FACTORIALS[first - 1..].iter().step_by(stride)) {
        *term = h0 - h;
    }
    // A slice of unknown length, because loops of fixed length are unrolled before they could be vectorized.
    for (i, term) in terms.iter_mut().enumerate() {
        let n = first as f64 + (i as u32 * stride as u32) as f64;
        // Differences from the largest term, so that the exponents of the terms that weigh are small and exact.
        *term = exp((n - n0) * (ln_ratio + b0 / n) + *term);
    }
    let mut lanes = [0.0; LANES];
    for chunk in terms.as_chunks::<LANES>().0 {
        for lane in 0..LANES {
            lanes[lane] += chunk[lane];
        }
    }
    let pairs = [lanes[0] + lanes[4], lanes[1] + lanes[5], lanes[2] + lanes[6], lanes[3] + lanes[7]];
    let rest = (pairs[0] + pairs[2]) + (pairs[1] + pairs[3]);
    (n0 * ln_ratio - h0 - g - b0, rest * stride as f64)
}

/// The first and last term that matter, and the distance between those that are taken.
#[inline(always)]
fn span(peak: &Peak, depth: f64) -> [usize; 3] {
    let Peak { m, delta, .. } = *peak;
    // x ln x − x + 1 ≥ (x − 1)²/2 / (1 + (x − 1)/3) above the maximum, ≥ (x − 1)²/2 below it.
    let wide = 2.0 * depth / (1.0 + delta * (2.0 / 3.0));
    let steep = 2.0 * depth / (1.0 + 2.0 * delta);
    let above = (wide / 6.0 + (wide * wide / 36.0 + wide * m).sqrt())
        .min(steep / 2.0 + (steep * steep / 4.0 + steep * m).sqrt());
    let below = (steep * m).sqrt();
    let first = (m - below).max(1.0) as usize;
    let last = (m + above) as usize + 1;
    [first, last, stride(peak, depth)]
}

/// How many terms one may stand for.
#[inline(always)]
fn stride(peak: &Peak, depth: f64) -> usize {
    let Peak { m, delta, .. } = *peak;
    // How far below the largest the first term is: a cut there would show.
    let edge = m - 1.0 - m.max(1.0).ln() + delta * (m - 1.0) * (m - 1.0);
    // Every h-th term of a Poisson law of mean m gives its sum but for 2 exp(−2 m sin²(π/h)). With b, m is divided by 1 + 2δ and
    // another 4 to 15 % are lost; for h = 2 nearly half is, next to δ = 0.
    let spread = m / (1.0 + 2.0 * delta);
    if edge < depth + 4.0 || spread < 0.95 * depth {
        1
    } else if spread < 1.17 * depth {
        2
    } else if spread < 2.12 * depth {
        4
    } else if spread < 3.55 * depth {
        6
    } else {
        8
    }
}
