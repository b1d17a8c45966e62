//! The diffuse sum, uniformly accurate: for all roughnesses and angles by one method.
//!
//! ```text
//! S(g, b) = e^-g Σ_{n≥1} gⁿ/(n! n) e^(-b/n)
//! ```
//! The terms have one maximum, near `n = m` with
//! ```text
//! m = g e^δ,  δ e^(2δ) = b/g²
//! ```
//! For large m the sum is an expansion about that maximum in powers of 1/m, uniformly in b (`saddle`); for small m the
//! significant terms are added (`direct`). The criterion is m, not g: with b ≫ g² a sum of many terms belongs to a small g.
//! With b ≫ g² the terms can also fall off within one step of n, at any m (`narrow`).
//!
//! For nearly all arguments that occur, ln S is read from polynomials fitted to the same sums at first use (`pieces`).

mod coefficients;
mod direct;
mod narrow;
mod pieces;
mod saddle;

use chromascope_color::accuracy::{RelTolerance, Unmet};
use chromascope_math::exp::exp;
use direct::Choice;
use multiversion::multiversion;
use pieces::RUN;
use saddle::Peak;

/// Error allowed of a diffuse sum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Precision {
    /// Relative error of 1e-6.
    Coarse,
    /// Relative error of 1e-10.
    Fine,
    /// Relative error of 1e-13, to which rounding b adds |ln S| ε: for S < 1e-200 as much again.
    #[default]
    Full,
}

impl Precision {
    /// From the cheapest to the most exact.
    pub const ALL: [Self; 3] = [Self::Coarse, Self::Fine, Self::Full];

    /// The cheapest that keeps the relative error of S within an accuracy.
    ///
    /// Beside it stands what rounding b costs, |ln S| ε, which no precision is without: 7e-15 where S is e^-30, 2e-13 where S is
    /// 1e-300. Relative to S(g, 0) instead of S it is below 1e-16.
    ///
    /// # Errors
    /// Below 1e-13 none does.
    pub fn within(accuracy: RelTolerance) -> Result<Self, Unmet> {
        let found = Self::ALL.into_iter().find(|precision| accuracy.allows(precision.max_relative_error()));
        found.map_or_else(|| accuracy.met_by(Self::Full.max_relative_error()).map(|()| Self::Full), Ok)
    }

    /// The relative error of S that it keeps, beside |ln S| ε.
    pub const fn max_relative_error(self) -> f64 {
        match self {
            Self::Coarse => 1e-6,
            Self::Fine => 1e-10,
            Self::Full => 1e-13,
        }
    }

    /// The m from which the expansion is within the error.
    const fn switch(self) -> f64 {
        match self {
            Self::Coarse => 22.0,
            Self::Fine => 60.0,
            Self::Full => 136.0,
        }
    }

    /// The m from which four corrections do.
    const fn four(self) -> f64 {
        match self {
            Self::Coarse => 50.0,
            Self::Fine => 350.0,
            Self::Full => 1500.0,
        }
    }

    /// The variance of the terms' bell from which the expansion is within the error: from it to the sum there is
    /// 2 e^(−2π² variance).
    const fn variance(self) -> f64 {
        match self {
            Self::Coarse => 0.85,
            Self::Fine => 1.35,
            Self::Full => 1.8,
        }
    }

    /// Terms below e^−this of the largest are omitted.
    const fn depth(self) -> f64 {
        match self {
            Self::Coarse => 16.0,
            Self::Fine => 25.0,
            Self::Full => 33.0,
        }
    }
}

/// Sums below this are 0: their products would be subnormal, which is slow.
pub(super) const SMALLEST: f64 = 1e-300;

/// S(g, b), the diffuse sum of Eq 2, for `g = σ² v_z²` and `b = τ² v_xy²/4`.
///
/// Below 1e-300 it is 0. Relative error within `precision`, beside |ln S| ε, which is what rounding b costs.
/// S(0, b) = 0. A negative or non-finite g counts as 0, a negative b as 0; a b that is NaN as infinite.
///
/// ```
/// use chromascope_core::reflectance::{Precision, diffuse_sum};
/// // A very rough surface: Eq 4.
/// let s = diffuse_sum(1e12, 2e12, Precision::Full);
/// assert!((s * 1e12 / (-2.0_f64).exp() - 1.0).abs() < 1e-11);
/// ```
pub fn diffuse_sum(g: f64, b: f64, precision: Precision) -> f64 {
    value(g, b, precision)
}

/// Limit of m δ, which is at most −E of the largest term, beyond which S is below the smallest number.
const NOTHING: f64 = 760.0;

/// Compiled for several instruction sets, the best chosen at run time; no operation is fused, so all of them give the same
/// bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn value(g: f64, b: f64, precision: Precision) -> f64 {
    pieces::ln(g, b, precision).map_or_else(|| remote(g, b, precision), |ln| raised(ln, 1.0))
}

/// Diffuse sum outside the range of the polynomials.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn remote(g: f64, b: f64, precision: Precision) -> f64 {
    parts(g, b, precision, NOTHING).map_or(0.0, |(ln_scale, rest)| raised(ln_scale, rest))
}

#[inline(always)]
fn raised(ln_scale: f64, rest: f64) -> f64 {
    // The exponential ends at e^−700: no rest lifts that above the smallest.
    let value = exp(ln_scale) * rest;
    if value < SMALLEST { 0.0 } else { value }
}

/// ln S(g, b), also where S is far below the smallest number; −∞ where S is 0 (g = 0).
///
/// The error of S relative to itself is the absolute error here, below the larger of `precision` and a few |ln S| ε.
/// Arguments outside the domain are treated as by [`diffuse_sum`].
pub fn ln_diffuse_sum(g: f64, b: f64, precision: Precision) -> f64 {
    logarithm(g, b, precision)
}

/// Compiled as [`value`] is.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn logarithm(g: f64, b: f64, precision: Precision) -> f64 {
    pieces::ln(g, b, precision).unwrap_or_else(|| ln_remote(g, b, precision))
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn ln_remote(g: f64, b: f64, precision: Precision) -> f64 {
    let parts = parts(g, b, precision, f64::INFINITY);
    parts.map_or(f64::NEG_INFINITY, |(ln_scale, rest)| ln_scale + rest.ln())
}

/// S(g, b) of many arguments, each to the last bit what [`diffuse_sum`] gives, in about two thirds of its time. What of a
/// longer slice is beyond the shortest is left alone.
///
/// ```
/// use chromascope_core::reflectance::{Precision, diffuse_sum, diffuse_sums_into};
/// let mut sums = [0.0; 2];
/// diffuse_sums_into(&[0.5, 20.0], &[1.0, 10.0], Precision::Fine, &mut sums);
/// assert_eq!(sums[1], diffuse_sum(20.0, 10.0, Precision::Fine));
/// ```
pub fn diffuse_sums_into(g: &[f64], b: &[f64], precision: Precision, sums: &mut [f64]) {
    for ((g, b), sums) in g.chunks(RUN).zip(b.chunks(RUN)).zip(sums.chunks_mut(RUN)) {
        let count = g.len().min(b.len()).min(sums.len());
        let (mut some_g, mut some_b) = ([0.0; RUN], [0.0; RUN]);
        some_g[..count].copy_from_slice(&g[..count]);
        some_b[..count].copy_from_slice(&b[..count]);
        // What a run leaves open is done one by one.
        let found = values(&some_g, &some_b, precision);
        for i in 0..count {
            sums[i] = if found[i].is_nan() { remote(g[i], b[i], precision) } else { found[i] };
        }
    }
}

/// Compiled as [`value`] is.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn values(g: &[f64; RUN], b: &[f64; RUN], precision: Precision) -> [f64; RUN] {
    let mut values = pieces::ln_run(g, b, precision);
    for value in &mut values {
        // NaN stays NaN.
        *value = if value.is_nan() { f64::NAN } else { raised(*value, 1.0) };
    }
    values
}

/// S as e to the first times the second, the second positive; none where S is 0 or m δ beyond what is requested.
#[inline(always)]
fn parts(g: f64, b: f64, precision: Precision, nothing: f64) -> Option<(f64, f64)> {
    // Written so that NaN falls out too.
    if !(g > 0.0 && g.is_finite() && b < f64::INFINITY) {
        return None;
    }
    let b = b.max(0.0);
    if let Some(choice) = Choice::few(g, b) {
        return Some(direct::sum(g, b, choice));
    }
    let near = Peak::near(g, b);
    if near.m * near.delta > nothing {
        return None;
    }
    if near.m >= precision.switch() {
        let peak = near.refined();
        let narrow = peak.m < precision.variance() * (1.0 + 2.0 * peak.delta);
        return Some(if narrow { narrow::sum(&peak) } else { saddle::sum(&peak, precision.four()) });
    }
    Some(direct::sum(g, b, Choice::around(&near, precision.depth())))
}
