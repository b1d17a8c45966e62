//! The locus as polynomials in the reciprocal temperature, made so that the nearest point is the root of another.

use super::exact::{ExactLocus, Motion};
use crate::colorimetry::Uv60;
use crate::math::chebyshev::{coefficients, evaluate, nodes};

/// Coefficients per polynomial: degree 7.
pub(super) const TERMS: usize = 8;
/// How many pieces.
const PIECES: usize = 128;
/// Where the pieces begin and end, in mired: beyond 20000 K and 1000 K far enough that a search from a nearby start
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
    own: [f64; TERMS],
    /// u′.
    du: [f64; TERMS],
    /// v′.
    dv: [f64; TERMS],
    /// p(0).
    middle: Uv60,
    /// The reciprocal temperature at t = 0, in mired.
    pub(super) mired: f64,
}

/// Half the derivative of the squared distance from one color, along one piece: a polynomial.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stationary([f64; TERMS]);

impl Stationary {
    /// The value and the derivative at t.
    #[inline]
    pub(super) fn at(&self, t: f64) -> (f64, f64) {
        let c = &self.0;
        let (mut value, mut slope) = (c[TERMS - 1], 0.0);
        for k in (0..TERMS - 1).rev() {
            slope = slope * t + value;
            value = value * t + c[k];
        }
        (value, slope)
    }
}

impl Piece {
    fn new(locus: &ExactLocus, mired: f64) -> Option<Self> {
        let middle = locus.motion(mired)?.at;
        let mut motions = [[0.0; 2]; TERMS];
        for (motion, t) in motions.iter_mut().zip(nodes::<TERMS>()) {
            *motion = locus.motion(mired + t * UNIT)?.per_mired.map(|d| d * UNIT);
        }
        let [du, dv] = [0, 1].map(|c: usize| coefficients(motions.map(|motion| motion[c])));
        let own = nodes::<TERMS>()
            .map(|t| evaluate(&du, t) * integral(&du, t) + evaluate(&dv, t) * integral(&dv, t));
        Some(Self { own: coefficients(own), du, dv, middle, mired })
    }

    /// The condition for the point nearest to a color.
    ///
    /// ```text
    /// f(t) = (p(t) − q)·p′(t) = (p − p(0))·p′ − (q − p(0))·p′
    /// ```
    #[inline]
    pub(super) fn stationary(&self, color: Uv60) -> Stationary {
        let (u, v) = (color.u - self.middle.u, color.v - self.middle.v);
        let mut f = [0.0; TERMS];
        for (k, f) in f.iter_mut().enumerate() {
            *f = self.own[k] - u * self.du[k] - v * self.dv[k];
        }
        Stationary(f)
    }

    /// The distance of a color from the tangent at t, positive above the locus.
    #[inline]
    pub(super) fn above(&self, color: Uv60, t: f64) -> f64 {
        let (du, dv) = (evaluate(&self.du, t), evaluate(&self.dv, t));
        let u = color.u - self.middle.u - integral(&self.du, t);
        let v = color.v - self.middle.v - integral(&self.dv, t);
        (v * du - u * dv) / (du * du + dv * dv).sqrt()
    }

    /// The locus at t.
    pub(super) fn motion(&self, t: f64) -> Motion {
        let at = Uv60 { u: self.middle.u + integral(&self.du, t), v: self.middle.v + integral(&self.dv, t) };
        Motion { at, per_mired: [&self.du, &self.dv].map(|d| evaluate(d, t) / UNIT) }
    }

    /// This piece's variable at a reciprocal temperature.
    #[inline]
    pub(super) fn t(&self, mired: f64) -> f64 {
        (mired - self.mired) * (1.0 / UNIT)
    }

    /// The reciprocal temperature at t, in mired.
    #[inline]
    pub(super) fn mired(&self, t: f64) -> f64 {
        self.mired + t * UNIT
    }
}

/// `∫₀ᵗ` of a polynomial.
#[inline]
fn integral(derivative: &[f64; TERMS], t: f64) -> f64 {
    let mut sum = 0.0;
    for k in (0..TERMS).rev() {
        sum = sum * t + derivative[k] * (1.0 / (k + 1) as f64);
    }
    sum * t
}

/// All pieces, from the hottest to the coldest.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pieces(Box<[Piece; PIECES]>);

impl Pieces {
    pub(super) fn new(locus: &ExactLocus) -> Option<Self> {
        let middle = |index: usize| FIRST_MIRED + (index as f64 + 0.5) * WIDTH;
        let pieces: Option<Vec<Piece>> = (0..PIECES).map(|index| Piece::new(locus, middle(index))).collect();
        Some(Self(pieces?.into_boxed_slice().try_into().ok()?))
    }

    /// The piece of a reciprocal temperature; those beyond the ends get the first or the last.
    #[inline]
    pub(super) fn at(&self, mired: f64) -> &Piece {
        let index = (mired - FIRST_MIRED) * (1.0 / WIDTH);
        &self.0[(index as usize).min(PIECES - 1)]
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Piece> {
        self.0.iter()
    }
}
