//! Making a piece: ln S at Chebyshev's points, and from there the coefficients.

use super::{BIAS, FIRST, GRID, LANES, Piece, ROOTS, SHAPE, TO_X, TO_Y};
use crate::reflectance::sum::saddle::{self, Peak};
use chromascope_math::array::{array, each};
use chromascope_math::chebyshev::nodes;
use chromascope_math::exp::exp;
use multiversion::multiversion;
use std::cmp::Ordering;
use std::f64::consts::FRAC_PI_2;

type Square = [[f64; POINTS]; POINTS];

/// Points along x, and along y.
const POINTS: usize = 16;

/// From this g on the expansion has all digits; below, the terms are added.
const EXPANSION: f64 = 256.0;

impl Piece {
    /// The piece of an octave of g and of half an octave of t.
    pub(super) fn new(row: usize, column: usize) -> Self {
        let c = coefficients(points_g(row), points_b(row, column));
        let tile = |[p, q]: [usize; 2]| array(|r| array(|l| c[4 * p + r][4 * q + l]));
        Self { tiles: each(SHAPE, tile), lanes: LANES }
    }
}

fn points_g(row: usize) -> [f64; POINTS] {
    let middle = f64::from_bits((BIAS.wrapping_add_signed(FIRST) + row as u64) << 52) * ROOTS[1];
    each(nodes::<POINTS>(), |x| middle * (TO_X + x) / (TO_X - x))
}

fn points_b(row: usize, column: usize) -> [f64; POINTS] {
    let octave = f64::from_bits((BIAS + column as u64 / 2) << 52);
    let middle = octave * if column.is_multiple_of(2) { ROOTS[0] } else { ROOTS[2] };
    each(nodes::<POINTS>(), |y| (middle * (TO_Y + y) / (TO_Y - y) - 1.0) / GRID[row].scale)
}

/// ln S.
#[inline(always)]
fn values(g: &[f64; POINTS], b: &[f64; POINTS]) -> Square {
    if g[POINTS - 1] >= EXPANSION {
        return each(*g, |g| each(*b, |b| expanded(g, b)));
    }
    // The number of terms above e^-41 of the largest, at its most.
    let m = Peak::near(g[0], b[0]).m;
    let count = (m + 9.5 * m.sqrt() + 20.0) as usize;
    let mut sums = [[0.0; POINTS]; POINTS];
    let mut powers = each(*g, |g| g * exp(-g));
    let mut falls = [0.0; POINTS];
    for n in (1..=count).map(|n| n as f64) {
        let less = -1.0 / n;
        for k in 0..POINTS {
            falls[k] = exp(b[k] * less);
        }
        let ratio = n / ((n + 1.0) * (n + 1.0));
        for i in 0..POINTS {
            for k in 0..POINTS {
                sums[i][k] += powers[i] * falls[k];
            }
            powers[i] *= g[i] * ratio;
        }
    }
    each(sums, |sums| each(sums, f64::ln))
}

#[inline(always)]
fn expanded(g: f64, b: f64) -> f64 {
    let (ln_scale, rest) = saddle::sum(&Peak::near(g, b).refined(), f64::INFINITY);
    ln_scale + rest.ln()
}

/// `c_jk = 4/POINTS² Σ v T_j T_k` over the points, with half of that for j = 0 and for k = 0; then of products.
///
/// Compiled for several instruction sets; no operation is fused, so all of them give the same bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn coefficients(g: [f64; POINTS], b: [f64; POINTS]) -> Square {
    let values = values(&g, &b);
    let middle = values[POINTS / 2][POINTS / 2];
    let chebyshev = chebyshev();
    let line = |line| products(each(weighted(&each(line, |v| [v - middle]), &chebyshev), |[c]| c));
    let lines = each(values, line);
    let mut c = weighted(&lines, &chebyshev);
    for k in 0..POINTS {
        let column = products(each(c, |line| line[k]));
        for j in 0..POINTS {
            c[j][k] = column[j];
        }
    }
    c[0][0] += middle;
    c
}

/// `Σ_i T_k(x_i) v_i` for each k, of several v together.
#[inline(always)]
fn weighted<const N: usize>(values: &[[f64; N]; POINTS], chebyshev: &Square) -> [[f64; N]; POINTS] {
    let mut sums = [[0.0; N]; POINTS];
    for k in 0..POINTS {
        for i in 0..POINTS {
            for n in 0..N {
                sums[k][n] += values[i][n] * chebyshev[k][i];
            }
        }
    }
    sums
}

/// From coefficients of `T_k` to those of `T_4q T_l`, l < 4: `T_4q T_l = (T_{4q+l} + T_{4q−l})/2`.
#[inline(always)]
fn products(mut c: [f64; POINTS]) -> [f64; POINTS] {
    for q in (4..POINTS).step_by(4).rev() {
        for l in 1..4 {
            c[q - l] -= c[q + l];
            c[q + l] *= 2.0;
        }
    }
    c
}

/// `T_k` at the points for each k, with the weight of the sum.
///
/// From the cosines of one quadrant, so that what ought to cancel does: by the recurrence a constant of 20 would leave 1e-13.
fn chebyshev() -> Square {
    let quadrant: [f64; POINTS] = array(|i| (FRAC_PI_2 * i as f64 / POINTS as f64).cos());
    let cosine = |step: usize| {
        let step = step % (4 * POINTS);
        let step = step.min(4 * POINTS - step);
        match step.cmp(&POINTS) {
            Ordering::Less => quadrant[step],
            Ordering::Equal => 0.0,
            Ordering::Greater => -quadrant[2 * POINTS - step],
        }
    };
    array(|k| {
        let weight = if k == 0 { 1.0 } else { 2.0 } / POINTS as f64;
        array(|i| cosine(k * (2 * i + 1)) * weight)
    })
}
