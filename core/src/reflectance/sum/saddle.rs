//! The expansion about the largest term.
//!
//! ```text
//! S = e^E/m √r (1 + Σ_k c_k(r)/m^k)
//! E = −m (2δ + e^-δ − 1),  r = 1/(1 + 2δ)
//! ```
//! From the saddle point of `Σ → ∫`, with Stirling's series for n!; the c_k are polynomials in r. With eight of them the error
//! at b = 0, its worst, is 1.4e-6 for m = 20, 2e-9 for 40, 4e-13 for 100 and 1e-14 for 150.

use super::coefficients::CORRECTIONS;

/// Where the terms of S(g, b) are largest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Peak {
    pub(super) g: f64,
    pub(super) b: f64,
    /// δ = W(2b/g²)/2 with Lambert's W.
    pub(super) delta: f64,
    /// m = g e^δ.
    pub(super) m: f64,
}

impl Peak {
    /// For g > 0 and b ≥ 0, both finite.
    #[inline(always)]
    pub(super) fn of(g: f64, b: f64) -> Self {
        let z = 2.0 * (b / g) / g;
        if z < 1e-8 {
            let delta = 0.5 * z * (1.0 - z);
            return Self { g, b, delta, m: g + g * delta };
        }
        let delta = 0.5 * if z < 1e150 { lambert(z.ln_1p(), z) } else { lambert_of_ln(g, b) };
        // e^(2δ) = z/(2δ), so that the square root stands for an exponential.
        Self { g, b, delta, m: (b / delta).sqrt() }
    }
}

/// Lambert's W for z ≥ 1e-8, from ln(1 + z): two steps of fourth order (Fritsch 1973) bring the first guess to rounding.
#[inline(always)]
fn lambert(l: f64, z: f64) -> f64 {
    let mut w = l * (1.0 - l.ln_1p() / (2.0 + l));
    for _ in 0..2 {
        w = fritsch(w, (z / w).ln() - w);
    }
    w
}

/// Lambert's W of 2b/g² where that overflows.
#[cold]
fn lambert_of_ln(g: f64, b: f64) -> f64 {
    let l = std::f64::consts::LN_2 + b.ln() - 2.0 * g.ln();
    let mut w = l * (1.0 - l.ln_1p() / (2.0 + l));
    for _ in 0..2 {
        w = fritsch(w, l - w.ln() - w);
    }
    w
}

#[inline(always)]
fn fritsch(w: f64, residual: f64) -> f64 {
    let q = 2.0 * (1.0 + w) * (1.0 + w + residual * (2.0 / 3.0));
    w * (1.0 + residual / (1.0 + w) * (q - residual) / (q - 2.0 * residual))
}

/// From here on four corrections do.
const FOUR: f64 = 1500.0;

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

/// S as e to the first times the second.
#[inline(always)]
pub(super) fn sum(peak: &Peak) -> (f64, f64) {
    let Peak { delta, m, .. } = *peak;
    let r = 1.0 / (1.0 + 2.0 * delta);
    let ln_scale = -m * (2.0 * delta + (-delta).exp_m1());
    let corrections = if m < FOUR { series(&EIGHT_BY_POWER, r, 1.0 / m) } else { series(&FOUR_BY_POWER, r, 1.0 / m) };
    (ln_scale, r.sqrt() / m * (1.0 + corrections))
}

/// Σ_k c_k(r) xᵏ.
#[inline(always)]
fn series<const K: usize, const POWERS: usize>(table: &[[f64; K]; POWERS], r: f64, x: f64) -> f64 {
    // Even and odd powers apart: two chains of half the length.
    let r2 = r * r;
    let (mut even, mut odd) = ([0.0; K], [0.0; K]);
    let mut power = POWERS - 1;
    for k in 0..K {
        even[k] = table[power][k];
    }
    while power >= 2 {
        power -= 2;
        for k in 0..K {
            odd[k] = odd[k] * r2 + table[power + 1][k];
            even[k] = even[k] * r2 + table[power][k];
        }
    }
    let mut total = 0.0;
    for k in (0..K).rev() {
        total = (total + even[k] + odd[k] * r) * x;
    }
    total
}
