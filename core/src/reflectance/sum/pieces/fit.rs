//! Making a piece: ln S at Chebyshev's points, and from there the coefficients.

use super::{BIAS, FIRST, GRID, LANES, Piece, ROOTS, Shape, TO_X, TO_Y};
use crate::math::chebyshev::nodes;
use crate::math::exp::exp;
use crate::reflectance::sum::saddle::{self, Peak};
use std::f64::consts::FRAC_PI_2;

/// Points along x and along y: a few more than coefficients, so that what is left out does not come back as something else.
const ACROSS: usize = 20;
const ALONG: usize = 24;

/// From this g on the expansion has all digits; below, the terms are added.
const EXPANSION: f64 = 256.0;

impl<const TILES: usize> Piece<TILES> {
    /// The piece of an octave of g, by its exponent, and of a half octave of t.
    pub(super) fn new(shape: &Shape<TILES>, exponent: i32, column: usize) -> Self {
        let c = coefficients(&values(&points_g(exponent), &points_b(exponent, column)));
        let tile = |[p, q]: [usize; 2]| [0, 1, 2, 3].map(|r| [0, 1, 2, 3].map(|l| c[4 * p + r][4 * q + l]));
        Self { tiles: shape.map(tile), lanes: LANES }
    }
}

fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(BIAS.wrapping_add_signed(exponent.into()) << 52)
}

fn points_g(exponent: i32) -> [f64; ACROSS] {
    let middle = power_of_two(exponent) * ROOTS[1];
    nodes::<ACROSS>().map(|x| middle * (TO_X + x) / (TO_X - x))
}

fn points_b(exponent: i32, column: usize) -> [f64; ALONG] {
    let middle = power_of_two(column as i32 / 2) * if column % 2 == 0 { ROOTS[0] } else { ROOTS[2] };
    let scale = GRID[(exponent - FIRST) as usize].scale;
    nodes::<ALONG>().map(|y| (middle * (TO_Y + y) / (TO_Y - y) - 1.0) / scale)
}

/// ln S.
fn values(g: &[f64; ACROSS], b: &[f64; ALONG]) -> [[f64; ALONG]; ACROSS] {
    if g[ACROSS - 1] >= EXPANSION {
        return g.map(|g| b.map(|b| expanded(g, b)));
    }
    // The number of terms above e^-41 of the largest, at its most.
    let m = Peak::near(g[0], b[0]).m;
    let count = (m + 9.5 * m.sqrt() + 20.0) as usize;
    let mut sums = [[0.0; ALONG]; ACROSS];
    let mut powers = g.map(|g| g * exp(-g));
    for n in (1..=count).map(|n| n as f64) {
        let falls = b.map(|b| exp(-b / n));
        for (sums, power) in sums.iter_mut().zip(powers) {
            for (sum, fall) in sums.iter_mut().zip(falls) {
                *sum += power * fall;
            }
        }
        let ratio = n / ((n + 1.0) * (n + 1.0));
        for (power, g) in powers.iter_mut().zip(g) {
            *power *= g * ratio;
        }
    }
    sums.map(|sums| sums.map(f64::ln))
}

fn expanded(g: f64, b: f64) -> f64 {
    let (ln_scale, rest) = saddle::sum(&Peak::near(g, b).refined(), f64::INFINITY);
    ln_scale + rest.ln()
}

/// `c_jk = 4/(ACROSS ALONG) Σ v T_j T_k` over the points, with half of that for j = 0 and for k = 0; then of products.
fn coefficients(values: &[[f64; ALONG]; ACROSS]) -> [[f64; ALONG]; ACROSS] {
    let (across, along) = (chebyshev::<ACROSS>(), chebyshev::<ALONG>());
    let middle = values[ACROSS / 2][ALONG / 2];
    let lines = values.map(|line| {
        let coefficient = |k: usize| -> f64 { line.iter().zip(&along[k]).map(|(v, t)| (v - middle) * t).sum() };
        products(std::array::from_fn::<f64, ALONG, _>(coefficient))
    });
    let columns: [[f64; ACROSS]; ALONG] = std::array::from_fn(|k| {
        products(across.map(|weights| lines.iter().zip(&weights).map(|(line, t)| line[k] * t).sum()))
    });
    let mut c: [[f64; ALONG]; ACROSS] = std::array::from_fn(|j| std::array::from_fn(|k| columns[k][j]));
    c[0][0] += middle;
    c
}

/// From coefficients of T_k to those of `T_4q T_l`, l < 4: `T_4q T_l = (T_{4q+l} + T_{4q−l})/2`.
fn products<const N: usize>(mut c: [f64; N]) -> [f64; N] {
    for q in (4..N).step_by(4).rev() {
        for l in 1..4 {
            c[q - l] -= c[q + l];
            c[q + l] *= 2.0;
        }
    }
    c
}

/// `T_k` at the N points for k below N, with the weight of the sum.
///
/// From the cosines of one quadrant, so that what ought to cancel does: by the recurrence a constant of 20 would leave 1e-13.
fn chebyshev<const N: usize>() -> [[f64; N]; N] {
    let quadrant: [f64; N] = std::array::from_fn(|i| (FRAC_PI_2 * i as f64 / N as f64).cos());
    let cosine = |step: usize| {
        let step = step % (4 * N);
        let step = step.min(4 * N - step);
        if step == N {
            0.0
        } else if step < N {
            quadrant[step]
        } else {
            -quadrant[2 * N - step]
        }
    };
    std::array::from_fn(|k| {
        let weight = if k == 0 { 1.0 } else { 2.0 } / N as f64;
        std::array::from_fn(|i| cosine(k * (2 * i + 1)) * weight)
    })
}
