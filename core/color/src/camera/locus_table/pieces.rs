//! The pieces of a table of the locus: how they are made, and how a temperature finds its own.

use super::{COLDEST_K, HOTTEST_K, LocusTable, LocusTableError};
use crate::colorimetry::Xy;
use crate::math::chebyshev::{coefficients, nodes};
use crate::units::Kelvin;
use multiversion::multiversion;
use multiversion::target::match_target;
use rayon::prelude::*;

/// Coefficients per polynomial: degree 7.
pub(super) const TERMS: usize = 8;

/// Offset of the reciprocal temperature in mired: a power of two. Below it the pieces are of one width.
const SHIFT: f64 = 256.0;
/// The exponent of [`SHIFT`], as the bits of a double have it.
const FIRST_EXPONENT: u64 = 1023 + 8;
/// Doublings from [`SHIFT`] to beyond the coldest body's 10⁶ mired.
const DOUBLINGS: usize = 12;
/// The most pieces of a doubling, as a power of two.
const MOST_BITS: u32 = 7;

/// Bits of a double's mantissa, and its exponent when it lies in 1…2.
const MANTISSA: u32 = 52;
const ONE: u64 = 1023 << MANTISSA;

/// Represents an infinite temperature at the end of the pieces, 0 mired: as far from it as doubles resolve.
const ENDLESS_K: f64 = 1e21;

/// Temperatures that are worked on side by side.
const LANES: usize = 64;

/// One piece: coefficients of 1, t, …, t⁷ as rows of (x, y) of an even power and (x, y) of the odd one above it. What lies
/// together is multiplied together.
type Piece = [[f64; 4]; TERMS / 2];

/// Index of the coefficients of the omitted pieces.
const NOTHING: Piece = [[f64::NAN; 4]; TERMS / 2];

/// All pieces, from the hottest to the coldest.
#[derive(Clone, Debug)]
pub(super) struct Pieces {
    /// Number of low bits of m + [`SHIFT`] that give the place within a piece.
    within_bits: u32,
    pieces: Vec<Piece>,
}

impl PartialEq for Pieces {
    fn eq(&self, other: &Self) -> bool {
        let bits =
            |pieces: &Self| -> Vec<u64> { pieces.pieces.iter().flatten().flatten().map(|c| c.to_bits()).collect() };
        self.within_bits == other.within_bits && bits(self) == bits(other)
    }
}

impl Pieces {
    /// As few pieces as meet the target, with the largest error of those not omitted.
    pub(super) fn new(exact: &(impl Fn(Kelvin) -> Option<Xy> + Sync), target: f64) -> (Self, f64) {
        let limit = target * (LocusTable::LIMIT / LocusTable::TARGET);
        let mut bits = fewest_bits(target);
        loop {
            let is_good = |error: f64| bits == MOST_BITS || error <= target;
            // The first piece that is too wide ends the attempt.
            let made: Option<Vec<(Piece, f64)>> = (0..DOUBLINGS << bits)
                .into_par_iter()
                .map(|index| Some(piece(exact, index, bits)).filter(|&(_, error)| is_good(error)))
                .collect();
            if let Some(made) = made {
                let kept = |error: f64| error <= limit;
                let max_error = made.iter().map(|m| m.1).filter(|&e| kept(e)).fold(0.0, f64::max);
                let pieces = made.into_iter().map(|(piece, error)| if kept(error) { piece } else { NOTHING }).collect();
                return (Self { within_bits: MANTISSA - bits, pieces }, max_error);
            }
            bits += 1;
        }
    }

    pub(super) fn len(&self) -> usize {
        self.pieces.len()
    }

    /// The chromaticity of one blackbody.
    #[inline]
    pub(super) fn xy(&self, temperature: Kelvin) -> Result<Xy, LocusTableError> {
        let (index, t) = place(temperature, self.within_bits);
        answer(&self.pieces, index, temperature, |piece| evaluate(piece, t))
    }

    /// The chromaticities of as many as fit both slices.
    pub(super) fn fill(&self, temperatures: &[Kelvin], answers: &mut [Result<Xy, LocusTableError>]) {
        fill(&self.pieces, self.within_bits, temperatures, answers);
    }
}

/// Compiled for several instruction sets, the best chosen at run time; no operation is fused, so all of them give the same
/// bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn fill(pieces: &[Piece], within_bits: u32, temperatures: &[Kelvin], answers: &mut [Result<Xy, LocusTableError>]) {
    macro_rules! runs {
        ($evaluate:path) => {{
            let (mut indices, mut ts) = ([0; LANES], [0.0; LANES]);
            for (answers, temperatures) in answers.chunks_mut(LANES).zip(temperatures.chunks(LANES)) {
                let count = answers.len().min(temperatures.len()).min(LANES);
                let (answers, temperatures) = (&mut answers[..count], &temperatures[..count]);
                for i in 0..count {
                    (indices[i], ts[i]) = place(temperatures[i], within_bits);
                }
                for i in 0..count {
                    answers[i] = answer(pieces, indices[i], temperatures[i], |piece| $evaluate(piece, ts[i]));
                }
            }
        }};
    }
    match_target! {
        "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd" => runs!(avx2::evaluate),
        "x86_64+avx2" => runs!(avx2::evaluate),
        _ => runs!(evaluate),
    }
}

/// The piece of a temperature and the place in it, −1…1: read off the bits of the shifted reciprocal temperature, exactly.
#[inline(always)]
fn place(temperature: Kelvin, within_bits: u32) -> (u64, f64) {
    let bits = (1e6 / temperature.get() + SHIFT).to_bits();
    let index = (bits >> within_bits) - (FIRST_EXPONENT << (MANTISSA - within_bits));
    let within = (bits << (MANTISSA - within_bits)) & ((1 << MANTISSA) - 1);
    (index, 2.0 * f64::from_bits(ONE | within) - 3.0)
}

/// The reciprocal temperature in mired at a place of a piece: the inverse of [`place`].
fn mired(index: usize, bits: u32, t: f64) -> f64 {
    let parts = f64::from(1_u32 << bits);
    let (doubling, part) = (index >> bits, (index & ((1 << bits) - 1)) as f64);
    let start = SHIFT * (doubling as f64).exp2();
    // The shift is taken off before the place is added: near zero nothing is lost.
    (start - SHIFT) + start * (part / parts) + start * ((1.0 + t) / (2.0 * parts))
}

#[inline(always)]
fn answer(
    pieces: &[Piece],
    index: u64,
    temperature: Kelvin,
    evaluate: impl Fn(&Piece) -> Xy,
) -> Result<Xy, LocusTableError> {
    match pieces.get(index as usize) {
        Some(piece) if (COLDEST_K..=HOTTEST_K).contains(&temperature.get()) => {
            let xy = evaluate(piece);
            if xy.x.is_nan() { Err(LocusTableError::Rough) } else { Ok(xy) }
        }
        _ => Err(LocusTableError::Outside),
    }
}

/// The polynomials at t: even and odd powers side by side, by Horner's rule in t².
#[inline(always)]
fn evaluate(piece: &Piece, t: f64) -> Xy {
    let square = t * t;
    let mut sum = piece[TERMS / 2 - 1];
    for row in piece[..TERMS / 2 - 1].iter().rev() {
        for k in 0..4 {
            sum[k] = sum[k] * square + row[k];
        }
    }
    Xy { x: sum[0] + t * sum[2], y: sum[1] + t * sum[3] }
}

/// The same in the instructions of AVX2, which no optimizer has to find.
#[cfg(target_arch = "x86_64")]
mod avx2 {
    use super::{Piece, TERMS, Xy};
    use std::arch::x86_64::{
        __m256d, _mm_add_pd, _mm_cvtsd_f64, _mm_mul_pd, _mm_set1_pd, _mm_unpackhi_pd, _mm256_add_pd,
        _mm256_castpd256_pd128, _mm256_extractf128_pd, _mm256_mul_pd, _mm256_set1_pd, _mm256_setr_pd,
    };

    #[inline]
    #[target_feature(enable = "avx2")]
    pub(super) fn evaluate(piece: &Piece, t: f64) -> Xy {
        let square = _mm256_set1_pd(t * t);
        let mut sum = load(&piece[TERMS / 2 - 1]);
        for row in (0..TERMS / 2 - 1).rev() {
            sum = _mm256_add_pd(_mm256_mul_pd(sum, square), load(&piece[row]));
        }
        let (even, odd) = (_mm256_castpd256_pd128(sum), _mm256_extractf128_pd::<1>(sum));
        let xy = _mm_add_pd(even, _mm_mul_pd(_mm_set1_pd(t), odd));
        Xy { x: _mm_cvtsd_f64(xy), y: _mm_cvtsd_f64(_mm_unpackhi_pd(xy, xy)) }
    }

    #[inline]
    #[target_feature(enable = "avx2")]
    fn load(&[a, b, c, d]: &[f64; 4]) -> __m256d {
        _mm256_setr_pd(a, b, c, d)
    }
}

/// Number of pieces of a doubling tried first, as a power of two: no sensor's locus is so smooth that fewer would do.
fn fewest_bits(target: f64) -> u32 {
    match target {
        ..5e-13 => 4,
        ..1e-10 => 3,
        _ => 0,
    }
}

/// One piece and its error, infinite where the locus has no chromaticity.
fn piece(exact: &impl Fn(Kelvin) -> Option<Xy>, index: usize, bits: u32) -> (Piece, f64) {
    let at = |t: f64| exact(Kelvin::new((1e6 / mired(index, bits, t)).min(ENDLESS_K)).ok()?);
    let points = nodes::<TERMS>().map(at);
    if points.contains(&None) {
        return (NOTHING, f64::INFINITY);
    }
    let [xs, ys] = [|p: Xy| p.x, |p: Xy| p.y].map(|part| coefficients(points.map(|p| p.map_or(f64::NAN, part))));
    let piece = std::array::from_fn(|row| [xs[2 * row], ys[2 * row], xs[2 * row + 1], ys[2 * row + 1]]);
    let error = checks().fold(0.0_f64, |worst, t| {
        let off = at(t).map_or(f64::INFINITY, |exact| {
            let near = evaluate(&piece, t);
            (near.x - exact.x).abs().max((near.y - exact.y).abs())
        });
        // NaN is as bad as infinity.
        if off <= worst {
            worst
        } else if off.is_nan() {
            f64::INFINITY
        } else {
            off
        }
    });
    (piece, error)
}

/// Points at which the error is looked up: both ends, and between every two nodes where Tₙ has its extremes.
fn checks() -> impl Iterator<Item = f64> {
    (0..=TERMS).map(|j| (std::f64::consts::PI * j as f64 / TERMS as f64).cos())
}
