//! The locus as polynomials in the reciprocal temperature, made so that the nearest point is the root of another.

use super::exact::{ExactLocus, Motion};
use super::result::{Cct, MAX_DUV, SLACK, is_in_range};
use crate::colorimetry::Uv60;
use crate::math::array::array;
use crate::math::chebyshev::{coefficients, evaluate, nodes};
use crate::math::exp::ROUNDER;
use crate::units::Kelvin;
use rayon::prelude::*;

/// Coefficients per polynomial: degree 6.
pub(super) const TERMS: usize = 7;
const PIECES: usize = 256;
/// Ends of the pieces in mired: beyond 20000 K and 1000 K far enough that a search from a nearby start
/// finds what lies just outside.
pub(super) const FIRST_MIRED: f64 = 20.0;
pub(super) const LAST_MIRED: f64 = 1044.0;
/// Each piece holds this much further than to its neighbors, as a share of its width: a root just beyond its end is still
/// one.
const OVERLAP: f64 = 0.15;
/// A piece's width, in mired.
pub(super) const WIDTH: f64 = (LAST_MIRED - FIRST_MIRED) / PIECES as f64;
/// Mired per unit of a piece's own variable t, which runs over −1…1.
pub(super) const UNIT: f64 = WIDTH * (0.5 + OVERLAP);

/// The locus p(t) = (u, v) around one reciprocal temperature.
///
/// The derivative is what is fitted, and p its integral: then the direction of an isotherm, on which everything rests at some
/// distance from the locus, is as good as the sums, and not worse by the division by a short step.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    /// `p′·(p − p(0))`, where a distance from p(0) would be stationary.
    pub(super) own: [f64; TERMS],
    /// u′.
    pub(super) du: [f64; TERMS],
    /// v′.
    pub(super) dv: [f64; TERMS],
    /// p(0).
    pub(super) middle: Uv60,
    /// The reciprocal temperature at t = 0, in mired.
    pub(super) mired: f64,
}

/// A color as one piece sees it: where it lies from p(0), and half the derivative of the squared distance from it.
///
/// ```text
/// f(t) = (p(t) − q)·p′(t) = (p − p(0))·p′ − (q − p(0))·p′
/// ```
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub(super) u: f64,
    pub(super) v: f64,
    pub(super) f: [f64; TERMS],
    pub(super) du: [f64; TERMS],
    pub(super) dv: [f64; TERMS],
}

/// The end of Newton's method.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub(super) kelvins: f64,
    /// The distance from the tangent, positive above the locus.
    pub(super) duv: f64,
    /// True if the method converged, within the piece and the domain.
    pub(super) good: bool,
}

impl Found {
    #[inline]
    pub(super) fn cct(&self) -> Option<Cct> {
        Some(Cct { temperature: Kelvin::new(self.kelvins).ok()?, duv: self.duv })
    }
}

/// If the last step was longer than this, in mired, the search has not converged and the careful one decides.
const CONVERGED: f64 = 1e-6;
impl Seen {
    #[inline(always)]
    pub(super) fn new(color: Uv60, middle: Uv60, own: [f64; TERMS], du: [f64; TERMS], dv: [f64; TERMS]) -> Self {
        let (u, v) = (color.u - middle.u, color.v - middle.v);
        let f = array(|k| own[k] - u * du[k] - v * dv[k]);
        Self { u, v, f, du, dv }
    }

    /// f and its derivative at t.
    #[inline]
    pub(super) fn at(&self, t: f64) -> (f64, f64) {
        let (mut value, mut slope) = (0.0, 0.0);
        for k in (0..TERMS).rev() {
            slope = slope * t + value;
            value = value * t + self.f[k];
        }
        (value, slope)
    }

    /// Newton's method from t in the piece around a reciprocal temperature, without a branch.
    ///
    /// Three steps. Each takes as many terms as its own error is worth: one term more is about a hundred times less. The last
    /// carries the slope on by the second derivative instead of evaluating it again. Polynomials are summed in pairs, not term
    /// after term: what limits the speed is how long one operation waits for another.
    #[inline(always)]
    pub(super) fn solve(&self, t: f64, middle: f64) -> Found {
        let c = &self.f;
        let value = pair(pair(c[0], c[1], t), c[2], t * t);
        let slope = pair(c[1], 2.0 * c[2], t);
        let t = t - value / slope;
        let t2 = t * t;
        let value = pair(pair(c[0], c[1], t), pair(pair(c[2], c[3], t), c[4], t2), t2);
        let slope = pair(pair(c[1], 2.0 * c[2], t), pair(3.0 * c[3], 4.0 * c[4], t), t2);
        let step = value / slope;
        let slope = slope - 2.0 * step * pair(c[2], 3.0 * c[3], t);
        let t = t - step;
        let last = sum_in_pairs(c, t) / slope;
        let t = t - last;
        let (mired, duv) = (middle + t * UNIT, self.above(t));
        // NaN fails each.
        let converged = last.abs() < CONVERGED / UNIT && t.abs() <= 1.0;
        let good = converged && is_in_range(mired) && duv.abs() <= MAX_DUV * (1.0 + SLACK);
        Found { kelvins: 1e6 / mired, duv, good }
    }

    /// The distance from the tangent at t, positive above the locus.
    ///
    /// At the root t this is the full distance, and the tangent's direction has a second-order effect only, so that four
    /// terms of it suffice.
    #[inline(always)]
    pub(super) fn above(&self, t: f64) -> f64 {
        let (du, dv) = (direction(&self.du, t), direction(&self.dv, t));
        let (u, v) = (self.u - integral(&self.du, t), self.v - integral(&self.dv, t));
        (v * du - u * dv) / (du * du + dv * dv).sqrt()
    }
}

/// `a + b t`.
#[inline(always)]
fn pair(a: f64, b: f64, t: f64) -> f64 {
    a + b * t
}

/// The value at t, summed in pairs of pairs of pairs (Estrin 1960).
#[inline(always)]
fn sum_in_pairs(c: &[f64; TERMS], t: f64) -> f64 {
    let t2 = t * t;
    let low = pair(pair(c[0], c[1], t), pair(c[2], c[3], t), t2);
    pair(low, pair(pair(c[4], c[5], t), c[6], t2), t2 * t2)
}

/// The first four terms.
#[inline(always)]
fn direction(c: &[f64; TERMS], t: f64) -> f64 {
    let t2 = t * t;
    pair(pair(c[0], c[1], t), pair(c[2], c[3], t), t2)
}

impl Piece {
    fn new(locus: &ExactLocus, mired: f64) -> Option<Self> {
        let middle = locus.motion(mired)?.at;
        let mut motions = [[0.0; 2]; TERMS];
        for (motion, t) in motions.iter_mut().zip(nodes::<TERMS>()) {
            *motion = locus.motion(mired + t * UNIT)?.per_mired.map(|d| d * UNIT);
        }
        let [du, dv] = [0, 1].map(|c: usize| coefficients(motions.map(|motion| motion[c])));
        let own = nodes::<TERMS>().map(|t| evaluate(&du, t) * integral(&du, t) + evaluate(&dv, t) * integral(&dv, t));
        Some(Self { own: coefficients(own), du, dv, middle, mired })
    }

    /// A color from here.
    #[inline(always)]
    pub(super) fn seen(&self, color: Uv60) -> Seen {
        Seen::new(color, self.middle, self.own, self.du, self.dv)
    }

    /// The locus at t.
    #[inline]
    pub(super) fn motion(&self, t: f64) -> Motion {
        let at = Uv60 { u: self.middle.u + integral(&self.du, t), v: self.middle.v + integral(&self.dv, t) };
        Motion { at, per_mired: [&self.du, &self.dv].map(|d| evaluate(d, t) / UNIT) }
    }

    /// This piece's variable at a reciprocal temperature.
    #[inline]
    pub(super) fn t(&self, mired: f64) -> f64 {
        (mired - self.mired) * (1.0 / UNIT)
    }
}

#[inline(always)]
fn integral(derivative: &[f64; TERMS], t: f64) -> f64 {
    t * sum_in_pairs(&array(|k| derivative[k] * (1.0 / (k + 1) as f64)), t)
}

/// The number of the piece of a reciprocal temperature; NaN gets the first.
#[allow(clippy::manual_clamp, reason = "clamp keeps what is not a number")]
#[inline(always)]
pub(super) fn index(mired: f64) -> u32 {
    let pieces = (mired - FIRST_MIRED) * (1.0 / WIDTH);
    ((pieces - 0.5).max(0.0).min((PIECES - 1) as f64) + ROUNDER).to_bits() as u32 & 0xff
}

/// All pieces, from the hottest to the coldest.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pieces(Box<[Piece; PIECES]>);

impl Pieces {
    pub(super) fn new(locus: &ExactLocus) -> Option<Self> {
        let middle = |index: usize| FIRST_MIRED + (index as f64 + 0.5) * WIDTH;
        let pieces: Option<Vec<Piece>> =
            (0..PIECES).into_par_iter().map(|index| Piece::new(locus, middle(index))).collect();
        Some(Self(pieces?.into_boxed_slice().try_into().ok()?))
    }

    /// The piece of a reciprocal temperature; those beyond the ends get the first or the last.
    #[inline]
    pub(super) fn at(&self, mired: f64) -> &Piece {
        self.get(index(mired))
    }

    /// A piece by number.
    #[inline]
    pub(super) fn get(&self, index: u32) -> &Piece {
        &self.0[(index as usize).min(PIECES - 1)]
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Piece> {
        self.0.iter()
    }
}
