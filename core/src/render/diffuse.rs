//! The diffuse part's spectral integral as a function of two numbers.
//!
//! Both g and b go with λ⁻² and the refractive index is constant, so one channel's integral of the diffuse sum
//! ```text
//! J_c(κ, β) = Σ_λ w_c(λ) S(κ (λ0/λ)², β κ (λ0/λ)²)
//! κ = g at λ0 = 550 nm,  β = b / g
//! ```
//! contains neither σ, τ, n nor the angles: one table of it serves every sample of every surface. Three ways, all within their
//! stated error of the sum over 401 wavelengths:
//!
//! | way | where | error, relative to J(κ, 0) |
//! |---|---|---|
//! | moments | κ ≥ 128 | 1e-6 |
//! | table | 1e-3 ≤ κ < 128, β < 5e4 | 2e-6 |
//! | nodes | everywhere | 1e-9 with 15 |

use super::measure::{MOMENTS, Node, SpectralWeights};
use crate::math::exp::exp;
use crate::reflectance::{Precision, diffuse_sums_into, ln_diffuse_sums_into, regimes::diffuse_sum_by_regimes};
use rayon::prelude::*;

/// From here on the surface is so rough that the integral separates.
pub const ROUGH: f64 = 128.0;
/// Where the table begins, in κ.
pub const SMOOTH: f64 = 1e-3;
/// Where the table ends, in 1 + β.
const LAST_BETA: f64 = 5e4;
/// Beyond this many powers of e below the peak a sample is dark.
pub const DARK: f64 = 30.0;

/// Places of the table along ln κ and along ln (1 + β).
const KAPPAS: usize = 120;
const BETAS: usize = 128;
/// Samples that an interpolation reads along each axis: a polynomial of degree five.
const STENCIL: usize = 6;

/// ln of the positive measure's J, and the three channels' J in units of it.
///
/// The ratios are smooth and bounded even where a channel's own integral changes sign, as with matching functions; one
/// exponential gives all three.
type Cell = [f64; 4];

/// J over (ln κ, ln (1 + β)), interpolated by polynomials of degree five.
#[derive(Clone, Debug, PartialEq)]
pub struct DiffuseTable {
    cells: Vec<Cell>,
}

impl DiffuseTable {
    /// Fills the table: 15 360 places, at nine wavelengths each.
    pub fn new(measure: &SpectralWeights) -> Self {
        let rows = (0..KAPPAS).into_par_iter().map(|i| {
            let kappa = (ln_smooth() + i as f64 * kappa_step()).exp();
            let betas: [f64; BETAS] = std::array::from_fn(|j| (j as f64 * beta_step()).exp_m1());
            row(measure.coarse(), kappa, &betas)
        });
        Self { cells: rows.collect::<Vec<_>>().concat() }
    }

    /// Whether the table holds these.
    pub fn holds(kappa: f64, beta: f64) -> bool {
        (SMOOTH..=ROUGH).contains(&kappa) && (0.0..LAST_BETA - 1.0).contains(&beta)
    }

    /// The three integrals.
    pub fn at(&self, kappa: f64, beta: f64) -> [f64; 3] {
        self.read(Self::position(kappa, beta))
    }

    /// Where these lie in any camera's table, in steps along its two axes.
    pub fn position(kappa: f64, beta: f64) -> [f64; 2] {
        [(kappa.ln() - ln_smooth()) / kappa_step(), beta.ln_1p() / beta_step()]
    }

    /// The three integrals at a [`DiffuseTable::position`].
    #[inline]
    pub fn read(&self, position: [f64; 2]) -> [f64; 3] {
        let (i, across) = place(position[0], KAPPAS);
        let (j, along) = place(position[1], BETAS);
        let mut mixed = [0.0; 4];
        for (k, u) in across.into_iter().enumerate() {
            let row = &self.cells[(i + k) * BETAS + j..][..STENCIL];
            let mut line = [0.0; 4];
            for (cell, v) in row.iter().zip(along) {
                for lane in 0..4 {
                    line[lane] += v * cell[lane];
                }
            }
            for lane in 0..4 {
                mixed[lane] += u * line[lane];
            }
        }
        let reference = exp(mixed[0]);
        [mixed[1] * reference, mixed[2] * reference, mixed[3] * reference]
    }
}

fn ln_smooth() -> f64 {
    SMOOTH.ln()
}

fn kappa_step() -> f64 {
    (ROUGH / SMOOTH).ln() / (KAPPAS - 1) as f64
}

fn beta_step() -> f64 {
    LAST_BETA.ln() / (BETAS - 1) as f64
}

/// The first of the six places around a position, and their weights.
#[inline]
fn place(position: f64, count: usize) -> (usize, [f64; STENCIL]) {
    // `position` lies within the table; near its ends the six lie to one side.
    let first = (position as usize).saturating_sub(2).min(count - STENCIL);
    (first, lagrange(position - first as f64))
}

/// The weights of Lagrange's polynomials on 0, 1, …, 5.
#[inline]
fn lagrange(t: f64) -> [f64; STENCIL] {
    const SCALE: [f64; STENCIL] = [-1.0 / 120.0, 1.0 / 24.0, -1.0 / 12.0, 1.0 / 12.0, -1.0 / 24.0, 1.0 / 120.0];
    let d = [t, t - 1.0, t - 2.0, t - 3.0, t - 4.0, t - 5.0];
    let before =
        [1.0, d[0], d[0] * d[1], d[0] * d[1] * d[2], d[0] * d[1] * d[2] * d[3], d[0] * d[1] * d[2] * d[3] * d[4]];
    let after =
        [d[1] * d[2] * d[3] * d[4] * d[5], d[2] * d[3] * d[4] * d[5], d[3] * d[4] * d[5], d[4] * d[5], d[5], 1.0];
    [0, 1, 2, 3, 4, 5].map(|k: usize| before[k] * after[k] * SCALE[k])
}

/// Places of the table with κ in common: much faster than one by one.
pub(super) fn row(nodes: &[Node], kappa: f64, betas: &[f64]) -> Vec<Cell> {
    let g: Vec<f64> = betas.iter().flat_map(|_| nodes.iter().map(|node| kappa * node.scale)).collect();
    let b: Vec<f64> = betas.iter().flat_map(|beta| nodes.iter().map(move |node| beta * (kappa * node.scale))).collect();
    let mut logs = vec![0.0; g.len()];
    ln_diffuse_sums_into(&g, &b, Precision::Fine, &mut logs);
    (0..betas.len()).map(|j| of_logs(nodes, &logs[j * nodes.len()..][..nodes.len()])).collect()
}

/// Sums are scaled by the largest, so that none is lost far down.
fn of_logs(nodes: &[Node], logs: &[f64]) -> Cell {
    let largest = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (mut reference, mut channels) = (0.0, [0.0; 3]);
    for (node, &ln) in nodes.iter().zip(logs) {
        let sum = (ln - largest).exp();
        reference += node.reference * sum;
        for (channel, weight) in channels.iter_mut().zip(node.weights) {
            *channel += weight * sum;
        }
    }
    if reference > 0.0 {
        [largest + reference.ln(), channels[0] / reference, channels[1] / reference, channels[2] / reference]
    } else {
        // No weight anywhere: black at any temperature.
        [0.0; 4]
    }
}

/// Sums that are asked for together.
const TOGETHER: usize = 64;

/// J by a sum over wavelengths.
pub fn by_nodes(nodes: &[Node], kappa: f64, beta: f64, precision: Precision) -> [f64; 3] {
    let mut channels = [0.0; 3];
    let (mut g, mut b, mut sums) = ([0.0; TOGETHER], [0.0; TOGETHER], [0.0; TOGETHER]);
    for nodes in nodes.chunks(TOGETHER) {
        for ((g, b), node) in g.iter_mut().zip(&mut b).zip(nodes) {
            *g = kappa * node.scale;
            *b = beta * *g;
        }
        diffuse_sums_into(&g[..nodes.len()], &b, precision, &mut sums);
        for (node, sum) in nodes.iter().zip(sums) {
            for (channel, weight) in channels.iter_mut().zip(node.weights) {
                *channel += weight * sum;
            }
        }
    }
    channels
}

/// J of many samples by a sum over wavelengths, each to the last bit what [`by_nodes`] gives. What of a longer slice is beyond
/// the shortest is left alone.
pub fn by_nodes_into(nodes: &[Node], kappa: &[f64], beta: &[f64], precision: Precision, answers: &mut [[f64; 3]]) {
    let (mut g, mut b, mut sums) = ([0.0; TOGETHER], [0.0; TOGETHER], [0.0; TOGETHER]);
    let count = kappa.len().min(beta.len()).min(answers.len());
    let samples = kappa[..count].chunks(TOGETHER).zip(beta[..count].chunks(TOGETHER));
    for ((kappa, beta), answers) in samples.zip(answers[..count].chunks_mut(TOGETHER)) {
        answers.fill([0.0; 3]);
        for node in nodes {
            for (i, (kappa, beta)) in kappa.iter().zip(beta).enumerate() {
                g[i] = kappa * node.scale;
                b[i] = beta * g[i];
            }
            diffuse_sums_into(&g[..kappa.len()], &b, precision, &mut sums);
            for (answer, sum) in answers.iter_mut().zip(sums) {
                for (channel, weight) in answer.iter_mut().zip(node.weights) {
                    *channel += weight * sum;
                }
            }
        }
    }
}

/// J by a sum over wavelengths with the paper's three cases of g in place of Eq 2: the error that they make.
pub fn by_regimes(nodes: &[Node], kappa: f64, beta: f64) -> [f64; 3] {
    let mut channels = [0.0; 3];
    for node in nodes {
        let g = kappa * node.scale;
        let sum = diffuse_sum_by_regimes(g, beta * g);
        for (channel, weight) in channels.iter_mut().zip(node.weights) {
            *channel += weight * sum;
        }
    }
    channels
}

/// What J separates into for κ ≥ [`ROUGH`]: `J_c = Σ_k basis[k] M_ck`.
///
/// ```text
/// basis_k = e^-β / κ  q_k(β) κ^-k
/// ```
/// with `q_k` the coefficients of the expansion of S in 1/g at fixed β.
#[inline]
pub fn rough_basis(kappa: f64, beta: f64) -> [f64; MOMENTS] {
    let t = 1.0 / kappa;
    // The exponential is 0 from there on, the polynomials would go on to infinity.
    let beta = beta.min(700.0);
    let front = exp(-beta) * t;
    let q1 = 1.0 + beta * (-2.0 + beta * 0.5);
    let q2 = 2.0 + beta * (-9.0 + beta * (7.5 + beta * (-11.0 / 6.0 + beta * 0.125)));
    let q3 = 6.0
        + beta
            * (-44.0
                + beta * (65.5 + beta * (-34.0 + beta * (22.0 / 3.0 + beta * (-2.0 / 3.0 + beta * (1.0 / 48.0))))));
    [front, front * t * q1, front * t * t * q2, front * t * t * t * q3]
}

/// J from its moments.
#[inline]
pub fn by_moments(moments: &[[f64; MOMENTS]; 3], basis: &[f64; MOMENTS]) -> [f64; 3] {
    let mut channels = [0.0; 3];
    for (channel, moments) in channels.iter_mut().zip(moments) {
        for (m, b) in moments.iter().zip(basis) {
            *channel += m * b;
        }
    }
    channels
}
