//! The κ and β that a table holds, as a square.

use super::domain::ln_last;
use chromascope_math::chebyshev::{coefficients, nodes};
use chromascope_math::ln::short_ln;

/// Terms of the polynomial that stands for `1/ln(1 + β_last)`.
const TERMS: usize = 7;

/// κ from one end to the other, and β from 0 to where it is dark.
///
/// ```text
/// t = (2 ln κ − ln κ₀κ₁) / ln(κ₁/κ₀),   v = ln(1 + β) q(t),   q(t) ≈ 1 / ln(1 + β_last(κ))
/// ```
/// t runs from −1 to 1, v from 0 to 1. The polynomial q is within a few parts in a thousand of what it stands for, never above
/// it: nothing depends on it but what v = 1 is, and it takes neither root nor logarithm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    pub(super) kappa: [f64; 2],
    middle: f64,
    half: f64,
    /// `t = slope · ln κ + shift`.
    slope: f64,
    shift: f64,
    bend: [f64; TERMS],
}

impl Extent {
    pub(super) fn new(kappa: [f64; 2]) -> Self {
        let [from, to] = kappa.map(f64::ln);
        let (middle, half) = (f64::midpoint(from, to), 0.5 * (to - from));
        let last = |t: f64| ln_last((middle + half * t).exp());
        let bend = coefficients(nodes::<TERMS>().map(|t| last(t).recip()));
        let mut extent = Self { kappa, middle, half, slope: 1.0 / half, shift: -middle / half, bend };
        let over = (-32..=32).map(|i| f64::from(i) / 32.0).map(|t| extent.stretch(t) * last(t)).fold(0.0, f64::max);
        extent.bend = bend.map(|c| c / over);
        extent
    }

    /// The lengths of its sides: in ln κ, and in ln(1 + β) where that is longest.
    pub(super) fn lengths(&self) -> [f64; 2] {
        [2.0 * self.half, ln_last(self.kappa[0])]
    }

    /// κ and β at t and v.
    pub(super) fn at(&self, t: f64, v: f64) -> [f64; 2] {
        [(self.middle + self.half * t).exp(), (v / self.stretch(t)).exp_m1()]
    }

    /// t and v of κ and β; without branches or calls, so that a loop over it vectorizes.
    #[inline(always)]
    pub(super) fn place(&self, kappa: f64, beta: f64) -> [f64; 2] {
        let t = self.slope * short_ln(kappa) + self.shift;
        [t, short_ln(1.0 + beta) * self.stretch(t)]
    }

    #[inline(always)]
    fn stretch(&self, t: f64) -> f64 {
        let c = &self.bend;
        let (t2, t4) = (t * t, (t * t) * (t * t));
        (c[0] + c[1] * t) + (c[2] + c[3] * t) * t2 + ((c[4] + c[5] * t) + c[6] * t2) * t4
    }
}
