//! The expansion about the largest term.
//!
//! ```text
//! S = e^E/m √r (1 + Σ_k c_k(r)/m^k)
//! E = −m (2δ + e^-δ − 1),  r = 1/(1 + 2δ)
//! ```
//! From the saddle point of `Σ → ∫`, with Stirling's series for n!; the `c_k` are polynomials in r. With eight of them the error
//! at b = 0, its worst, is 1.4e-6 for m = 20, 2e-9 for 40, 4e-13 for 100 and 1e-14 for 150.

use super::coefficients::CORRECTIONS;
use chromascope_math::array::array;
use chromascope_math::chebyshev::evaluate;
use chromascope_math::exp::{exp, exp_m1_near};

/// Index of the largest term of S(g, b).
#[derive(Clone, Copy, Debug)]
pub(super) struct Peak {
    pub(super) g: f64,
    pub(super) b: f64,
    /// δ = W(z)/2, with Lambert's W of z = 2b/g².
    pub(super) delta: f64,
    /// m = g e^δ.
    pub(super) m: f64,
}

impl Peak {
    /// δ and m within 1 % of themselves, for g > 0 and b ≥ 0, both finite.
    #[inline(always)]
    pub(super) fn near(g: f64, b: f64) -> Self {
        let z = 2.0 * (b / g) / g;
        if z < SMALL {
            let w_by_z = evaluate(&LAMBERT, z);
            return Self { g, b, delta: 0.5 * z * w_by_z, m: g / w_by_z.sqrt() };
        }
        let l = if z < LARGE { roughly_ln(1.0 + z) } else { ln_z(g, b) };
        Self::with(g, b, l * (1.0 - roughly_ln(1.0 + l) / (2.0 + l)))
    }

    /// Index of the largest term with all digits: two steps of fourth order (Fritsch 1973) from a six-digit start.
    #[inline(always)]
    pub(super) fn refined(self) -> Self {
        let Self { g, b, delta, .. } = self;
        let z = 2.0 * (b / g) / g;
        if z < SMALL {
            return self;
        }
        let w = 2.0 * delta;
        if z < LARGE {
            // The quotient is e^w but for what w is off.
            let w = fritsch(w, roughly_ln((z / w).max(1.0)) - w);
            return Self::with(g, b, fritsch(w, (z / w).ln() - w));
        }
        let w = fritsch(w, ln_z(g, b) - w.ln() - w);
        Self::with(g, b, fritsch(w, ln_z(g, b) - w.ln() - w))
    }

    /// From Lambert's w.
    #[inline(always)]
    fn with(g: f64, b: f64, w: f64) -> Self {
        let delta = 0.5 * w;
        // e^(2δ) = z/(2δ), so that the square root stands for an exponential.
        Self { g, b, delta, m: (b / delta).sqrt() }
    }
}

/// `ln (1 + x)/x` for x in 0…1 by powers of x: through Chebyshev's points.
const LOGARITHM: [f64; 7] =
    [0.999_998_574, -0.499_858_994, 0.330_975_258, -0.234_545_201, 0.148_294_134, -0.065_590_306_4, 0.013_874_484_5];

/// ln x to 1.5e-6 of itself, from 1 to the largest number.
#[inline(always)]
pub(super) fn roughly_ln(x: f64) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    let bits = x.to_bits();
    let exponent = f64::from((bits >> 52) as u32) - 1023.0;
    let x = f64::from_bits(bits & MANTISSA | 1.0_f64.to_bits()) - 1.0;
    let c = &LOGARITHM;
    let x2 = x * x;
    let value = (c[0] + c[1] * x) + ((c[2] + c[3] * x) + ((c[4] + c[5] * x) + c[6] * x2) * x2) * x2;
    exponent * std::f64::consts::LN_2 + x * value
}

/// W(z)/z by powers of z.
const LAMBERT: [f64; 7] = [1.0, -1.0, 3.0 / 2.0, -8.0 / 3.0, 125.0 / 24.0, -54.0 / 5.0, 16_807.0 / 720.0];
/// Below this z, W(z) is its power series to all digits.
const SMALL: f64 = 3e-3;
/// From here on only the logarithm of z is used.
const LARGE: f64 = 1e150;

/// ln(2b/g²) where 2b/g² overflows.
#[cold]
fn ln_z(g: f64, b: f64) -> f64 {
    std::f64::consts::LN_2 + b.ln() - 2.0 * g.ln()
}

#[inline(always)]
fn fritsch(w: f64, residual: f64) -> f64 {
    let q = 2.0 * (1.0 + w) * (1.0 + w + residual * (2.0 / 3.0));
    w * (1.0 + residual / (1.0 + w) * (q - residual) / (q - 2.0 * residual))
}

/// Below this the exponential needs no other range.
const NEAR: f64 = 0.34;

static FOUR_BY_POWER: [[f64; 4]; 13] = by_power();
static EIGHT_BY_POWER: [[f64; 8]; 25] = by_power();

/// The coefficients of the first K corrections side by side for each power of r, so that all K advance at once.
const fn by_power<const K: usize, const POWERS: usize>() -> [[f64; K]; POWERS] {
    let mut table = [[0.0; K]; POWERS];
    let mut k = 0;
    while k < K {
        let mut power = 0;
        while power < CORRECTIONS[k].len() {
            table[power][k] = CORRECTIONS[k][power];
            power += 1;
        }
        k += 1;
    }
    table
}

/// S as e to the first times the second; with four corrections in place of eight from m = `four` on.
#[inline(always)]
pub(super) fn sum(peak: &Peak, four: f64) -> (f64, f64) {
    let Peak { delta, m, .. } = *peak;
    let r = 1.0 / (1.0 + 2.0 * delta);
    let fall = if delta < NEAR { exp_m1_near(-delta) } else { exp(-delta) - 1.0 };
    let ln_scale = -m * (2.0 * delta + fall);
    let corrections = if m < four { series(&EIGHT_BY_POWER, r, 1.0 / m) } else { series(&FOUR_BY_POWER, r, 1.0 / m) };
    (ln_scale, r.sqrt() / m * (1.0 + corrections))
}

/// `Σ_k c_k(r) xᵏ`.
#[inline(always)]
fn series<const K: usize, const POWERS: usize>(table: &[[f64; K]; POWERS], r: f64, x: f64) -> f64 {
    // Powers apart by what four leaves of them: chains of a quarter of the length.
    let (r2, r4) = (r * r, (r * r) * (r * r));
    let mut power = POWERS - 1;
    let mut sums = [table[power], [0.0; K], [0.0; K], [0.0; K]];
    while power >= 4 {
        power -= 4;
        for part in 0..4 {
            for k in 0..K {
                sums[part][k] = sums[part][k] * r4 + table[power + part][k];
            }
        }
    }
    let c: [f64; K] = array(|k| (sums[0][k] + sums[1][k] * r) + (sums[2][k] + sums[3][k] * r) * r2);
    let x4 = (x * x) * (x * x);
    let mut total = 0.0;
    for first in (0..K).step_by(4).rev() {
        total = total * x4 + ((c[first] + c[first + 1] * x) + (c[first + 2] + c[first + 3] * x) * (x * x));
    }
    total * x
}
