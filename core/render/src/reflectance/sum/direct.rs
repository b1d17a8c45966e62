//! The sum, term by term, for few terms.
//!
//! Relative to the term at n = m all terms obey
//! ```text
//! ln(t_n/t_m) ≈ −m [ x ln x − x + 1 + δ (x − 1)²/x ],  x = n/m
//! ```
//! from which bounds follow on where they stop to matter. Where the first term does not matter either, the terms rise and fall
//! so smoothly that every second to eighth of them gives the sum (Poisson's summation formula): two dozen exponentials
//! do for any m.

use super::saddle::{Peak, roughly_ln};
use chromascope_math::double::Double;
use chromascope_math::exp::ROUNDER;
use std::f64::consts::{LN_2, LOG2_E};
use std::sync::LazyLock;

/// `ln(n! n) − n ln 64` for n = 1, 2, …, rounded from 106 bits.
///
/// With 64ⁿ taken out, the numbers of the terms that weigh stay below 60, so that their rounding costs less than 1e-14.
static LN_FACTORIALS: LazyLock<[f64; LISTED]> = LazyLock::new(|| {
    let (mut listed, mut ln_factorial, ln_64) = ([0.0; LISTED], Double::default(), Double::LN_2 * Double::new(6.0));
    for (i, value) in listed.iter_mut().enumerate() {
        let n = Double::new((i + 1) as f64);
        ln_factorial = ln_factorial + n.ln();
        *value = (ln_factorial + n.ln() - n * ln_64).value();
    }
    listed
});
const LISTED: usize = 352;

/// More terms than any span has; a multiple of [`LANES`].
const MOST: usize = 128;
const LANES: usize = 8;

/// For ln g + b/2 below this the first term is the largest, and all beyond the sixteenth are together below 1e-14 of it: the n-th
/// is at most `(g e^(b/2))^(n-1)/(n! n)` of the first.
const LN_FEW: f64 = 0.18;
/// Below this the same holds for all beyond the eighth.
const LN_FEWER: f64 = -2.16;

/// The terms that are added: from the first to the last in steps, and the largest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Choice {
    first: usize,
    last: usize,
    stride: usize,
    top: usize,
}

impl Choice {
    /// The first eight or sixteen, if they are all of the sum; found without looking for the largest.
    #[inline(always)]
    pub(super) fn few(g: f64, b: f64) -> Option<Self> {
        let size = roughly_ln(g) + 0.5 * b;
        let last = if size < LN_FEWER { 8 } else { 16 };
        (size < LN_FEW).then_some(Self { first: 1, last, stride: 1, top: 1 })
    }

    /// Those above e^−`depth` of the largest.
    #[inline(always)]
    pub(super) fn around(peak: &Peak, depth: f64) -> Self {
        let [first, last, stride] = span(peak, depth);
        // Between two numbers the larger term, where b decides: t_{n+1} against t_n goes as m² against n (n + 1).
        let (m, floor) = (peak.m, peak.m as usize);
        let top = floor + usize::from(m * m > (floor * (floor + 1)) as f64);
        Self { first, last, stride, top: top.clamp(1, LISTED) }
    }
}

/// S as e to the first times the second.
#[inline(always)]
pub(super) fn sum(g: f64, b: f64, choice: Choice) -> (f64, f64) {
    // The 64th part of a subnormal number may be 0.
    let ln_ratio = if g >= f64::MIN_POSITIVE * 64.0 { (g / 64.0).ln() } else { g.ln() - 6.0 * LN_2 };
    let rest = terms(choice, b, ln_ratio);
    if choice.top == 1 {
        return (-g - b, g * rest);
    }
    let n0 = choice.top as f64;
    (n0 * ln_ratio - LN_FACTORIALS[choice.top - 1] - g - b / n0, rest)
}

/// The sum of the terms, relative to the one at `top`.
#[inline(always)]
fn terms(choice: Choice, b: f64, ln_ratio: f64) -> f64 {
    let Choice { first, last, stride, top } = choice;
    let listed: &[f64; LISTED] = &LN_FACTORIALS;
    let (n0, h0) = (top as f64, listed[top - 1]);
    let b0 = b / n0;
    let count = ((last - first) / stride + 1).next_multiple_of(LANES).min(MOST);
    let mut buffer = [0.0; MOST];
    let terms = &mut buffer[..count];
    let (from, step) = (first as f64, stride as f64);
    // Differences from the largest term, so that the exponents of the terms that weigh are small and exact.
    let exponent = |i: usize, h: f64| {
        let n = from + f64::from(i as u32) * step;
        (n - n0) * (ln_ratio + b0 / n) + (h0 - h)
    };
    // Slices of unknown length, because loops of fixed length are unrolled before they could be vectorized.
    let heights = &listed[first - 1..];
    if stride == 1 {
        for (i, (term, h)) in terms.iter_mut().zip(heights).enumerate() {
            *term = exp(exponent(i, *h));
        }
    } else {
        for (term, h) in terms.iter_mut().zip(heights.iter().step_by(stride)) {
            *term = *h;
        }
        for (i, term) in terms.iter_mut().enumerate() {
            *term = exp(exponent(i, *term));
        }
    }
    let mut lanes = [0.0; LANES];
    for chunk in terms.as_chunks::<LANES>().0 {
        for lane in 0..LANES {
            lanes[lane] += chunk[lane];
        }
    }
    let pairs = [lanes[0] + lanes[4], lanes[1] + lanes[5], lanes[2] + lanes[6], lanes[3] + lanes[7]];
    ((pairs[0] + pairs[2]) + (pairs[1] + pairs[3])) * stride as f64
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

/// Number of terms that one term may stand for.
#[inline(always)]
fn stride(peak: &Peak, depth: f64) -> usize {
    let Peak { m, delta, .. } = *peak;
    // How far below the largest the first term is: a cut there would show.
    let edge = m - 1.0 - roughly_ln(m.max(1.0)) + delta * (m - 1.0) * (m - 1.0);
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

/// `(e^r − 1 − r)/r²` for |r| ≤ ln 2 / 2, by powers of r: fitted at Chebyshev's points.
const EXPONENTIAL: [f64; 9] = [
    0.5,
    0.166_666_666_666_483_03,
    0.041_666_666_666_651_364,
    0.008_333_333_353_717_156,
    0.001_388_888_890_587_134_7,
    0.000_198_412_087_569_920_77,
    2.480_153_640_906_388_4e-5,
    2.762_510_200_552_382_8e-6,
    2.761_379_555_463_292_4e-7,
];

/// e^x from −700 to 700, below taken as −700: within 2e-15.
///
/// Shorter than [`chromascope_math::exp::exp`], and its operations wait less for each other; the sum takes little else.
#[inline(always)]
fn exp(x: f64) -> f64 {
    // Rounds to an integer, which is left in the low bits.
    let x = x.max(-700.0);
    let shifted = x * LOG2_E + ROUNDER;
    // The terms that weigh have small exponents, where ln 2 in one piece loses nothing that shows.
    let r = x - (shifted - ROUNDER) * LN_2;
    let c = &EXPONENTIAL;
    let (r2, r4) = (r * r, (r * r) * (r * r));
    let low = (c[0] + c[1] * r) + (c[2] + c[3] * r) * r2;
    let high = (c[4] + c[5] * r) + (c[6] + c[7] * r) * r2;
    let value = 1.0 + (r + r2 * (low + (high + c[8] * r4) * r4));
    value * f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52)
}
