//! The κ and β that a table holds, as a square.

use super::domain::ln_last;
use chromascope_math::chebyshev::{coefficients, nodes};
use chromascope_math::ln::{INTEGERS, MANTISSA, ONE, ROOT_HALF};
use std::f64::consts::LN_2;

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
        let t = self.slope * ln(kappa) + self.shift;
        [t, ln(1.0 + beta) * self.stretch(t)]
    }

    #[inline(always)]
    fn stretch(&self, t: f64) -> f64 {
        let c = &self.bend;
        let (t2, t4) = (t * t, (t * t) * (t * t));
        (c[0] + c[1] * t) + (c[2] + c[3] * t) * t2 + ((c[4] + c[5] * t) + c[6] * t2) * t4
    }
}

/// Twice the coefficients of `(artanh s / s − 1) / s²` in s².
const ARTANH: [f64; 7] = [2.0 / 3.0, 2.0 / 5.0, 2.0 / 7.0, 2.0 / 9.0, 2.0 / 11.0, 2.0 / 13.0, 2.0 / 15.0];

/// ln x within 2e-14 for what is positive, normal and finite; beyond that some number.
///
/// Less exact than [`chromascope_math::ln::ln`], which a place need not be, and shorter; its operations wait less for each other.
#[inline(always)]
fn ln(x: f64) -> f64 {
    let raised = x.to_bits().wrapping_add(ONE - ROOT_HALF);
    let n = f64::from_bits(raised >> 52 | INTEGERS) - (4_503_599_627_370_496.0 + 1023.0);
    let f = f64::from_bits((raised & MANTISSA).wrapping_add(ROOT_HALF)) - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    let (c, z2) = (&ARTANH, z * z);
    let series = (c[0] + c[1] * z) + (c[2] + c[3] * z) * z2 + ((c[4] + c[5] * z) + c[6] * z2) * (z2 * z2);
    n * LN_2 + s * (2.0 + z * series)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithms_are_near_enough() {
        let off = |i: i32| {
            let x = 1.003_f64.powi(i);
            (ln(x) - x.ln()).abs() / x.ln().abs().max(1.0)
        };
        assert!((-60_000..=60_000).map(off).fold(0.0, f64::max) < 2e-14);
        // Where there is nothing to be seen v is above 1.
        for kappa in [1e-3, 1.0, 1000.0] {
            let extent = Extent::new([1e-3, 1000.0]);
            for beta in [f64::INFINITY, f64::NAN, f64::MAX] {
                assert!(extent.place(kappa, beta)[1] > 1.0, "{beta}");
            }
        }
    }

    #[test]
    fn places_and_what_lies_there_belong_together() {
        for kappa in [[1e-3, 300.0], [0.5, 1.0], [1e-15, 1e-9]] {
            let extent = Extent::new(kappa);
            for (t, v) in [(-1.0, 0.0), (-0.3, 0.2), (0.4, 0.77), (1.0, 1.0)] {
                let [kappa, beta] = extent.at(t, v);
                let place = extent.place(kappa, beta);
                assert!((place[0] - t).abs() < 1e-12 && (place[1] - v).abs() < 1e-12, "{t} {v}: {place:?}");
                let last = ln_last(kappa);
                let edge = extent.place(kappa, last.exp_m1())[1];
                assert!(edge <= 1.0 + 1e-4 && edge > 0.97, "{kappa}: {edge}");
            }
        }
    }
}
