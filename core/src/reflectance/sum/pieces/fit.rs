//! Making a piece: ln S at Chebyshev's points, and from there the coefficients.

#![expect(clippy::inline_always, reason = "every instruction set needs a copy of its own")]

use super::{BIAS, FIRST, GRID, LANES, Piece, ROOTS, SHAPE, TO_X, TO_Y};
use crate::math::chebyshev::nodes;
use crate::math::exp::exp;
use crate::reflectance::sum::saddle::{self, Peak};
use multiversion::multiversion;
use std::f64::consts::FRAC_PI_2;

type Square = [[f64; POINTS]; POINTS];

/// Points along x, and along y.
const POINTS: usize = 16;

/// From this g on the expansion has all digits; below, the terms are added.
const EXPANSION: f64 = 256.0;

impl Piece {
    /// The piece of an octave of g, by its exponent, and of a half octave of t.
    pub(super) fn new(exponent: i32, column: usize) -> Self {
        let c = coefficients(points_g(exponent), points_b(exponent, column));
        let tile = |[p, q]: [usize; 2]| [0, 1, 2, 3].map(|r| [0, 1, 2, 3].map(|l| c[4 * p + r][4 * q + l]));
        Self { tiles: SHAPE.map(tile), lanes: LANES }
    }
}

fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(BIAS.wrapping_add_signed(exponent.into()) << 52)
}

fn points_g(exponent: i32) -> [f64; POINTS] {
    let middle = power_of_two(exponent) * ROOTS[1];
    nodes::<POINTS>().map(|x| middle * (TO_X + x) / (TO_X - x))
}

fn points_b(exponent: i32, column: usize) -> [f64; POINTS] {
    let middle = power_of_two(column as i32 / 2) * if column % 2 == 0 { ROOTS[0] } else { ROOTS[2] };
    let scale = GRID[(exponent - FIRST) as usize].scale;
    nodes::<POINTS>().map(|y| (middle * (TO_Y + y) / (TO_Y - y) - 1.0) / scale)
}

/// ln S.
#[inline(always)]
fn values(g: &[f64; POINTS], b: &[f64; POINTS]) -> Square {
    if g[POINTS - 1] >= EXPANSION {
        return g.map(|g| b.map(|b| expanded(g, b)));
    }
    // The number of terms above e^-41 of the largest, at its most.
    let m = Peak::near(g[0], b[0]).m;
    let count = (m + 9.5 * m.sqrt() + 20.0) as usize;
    let mut sums = [[0.0; POINTS]; POINTS];
    let mut powers = g.map(|g| g * exp(-g));
    let mut falls = [0.0; POINTS];
    for n in (1..=count).map(|n| n as f64) {
        let less = -1.0 / n;
        for (fall, b) in falls.iter_mut().zip(b) {
            *fall = exp(b * less);
        }
        let ratio = n / ((n + 1.0) * (n + 1.0));
        for i in 0..POINTS {
            for (sum, fall) in sums[i].iter_mut().zip(&falls) {
                *sum += powers[i] * fall;
            }
            powers[i] *= g[i] * ratio;
        }
    }
    sums.map(|sums| sums.map(f64::ln))
}

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
    let lines = values.map(|line| products(weighted(&line.map(|v| [v - middle]), &chebyshev).map(|[c]| c)));
    let mut c = weighted(&lines, &chebyshev);
    for k in 0..POINTS {
        let column = products(c.map(|line| line[k]));
        for j in 0..POINTS {
            c[j][k] = column[j];
        }
    }
    c[0][0] += middle;
    c
}

/// `Σ_i T_k(x_i) v_i` for each k, of several v at once.
#[inline(always)]
fn weighted<const N: usize>(values: &[[f64; N]; POINTS], chebyshev: &Square) -> [[f64; N]; POINTS] {
    let mut sums = [[0.0; N]; POINTS];
    for (sums, weights) in sums.iter_mut().zip(chebyshev) {
        for (value, weight) in values.iter().zip(weights) {
            for n in 0..N {
                sums[n] += value[n] * weight;
            }
        }
    }
    sums
}

/// From coefficients of T_k to those of `T_4q T_l`, l < 4: `T_4q T_l = (T_{4q+l} + T_{4q−l})/2`.
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
    let quadrant: [f64; POINTS] = std::array::from_fn(|i| (FRAC_PI_2 * i as f64 / POINTS as f64).cos());
    let cosine = |step: usize| {
        let step = step % (4 * POINTS);
        let step = step.min(4 * POINTS - step);
        if step == POINTS {
            0.0
        } else if step < POINTS {
            quadrant[step]
        } else {
            -quadrant[2 * POINTS - step]
        }
    };
    std::array::from_fn(|k| {
        let weight = if k == 0 { 1.0 } else { 2.0 } / POINTS as f64;
        std::array::from_fn(|i| cosine(k * (2 * i + 1)) * weight)
    })
}
