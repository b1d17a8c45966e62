//! The diffuse part's spectral integral as a function of two numbers.
//!
//! Both g and b go with λ⁻² and the refractive index is constant, so one channel's integral of the diffuse sum
//! ```text
//! J_c(κ, β) = Σ_λ w_c(λ) S(κ (λ0/λ)², β κ (λ0/λ)²)
//! κ = g at λ0 = 550 nm,  β = b / g
//! ```
//! contains neither σ, τ, n nor the angles. Evaluated here by sums over wavelengths and by moments; [`super::plan`] decides which
//! serves a sample.

use super::measure::{MOMENTS, Node};
use crate::math::exp::exp;
use crate::reflectance::{Precision, diffuse_sums_into, regimes::diffuse_sum_by_regimes};

/// κ from which on four moments are within 1e-6 of J(κ, 0).
pub const ROUGH: f64 = 128.0;
/// κ from which on four moments are within 1e-9 of J(κ, 0).
pub const VERY_ROUGH: f64 = 1024.0;
/// A sample is dark where J is below e^-30 of its peak.
pub const DARK: f64 = 30.0;

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

/// J of many samples by a sum over wavelengths, each to the last bit what [`by_nodes`] gives. Extra elements of longer slices are
/// ignored.
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

/// J by a sum over wavelengths with the paper's three cases of g in place of Eq 2.
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

/// Factors that J separates into for κ ≥ [`ROUGH`]: `J_c = Σ_k basis[k] M_ck`.
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
