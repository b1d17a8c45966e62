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
use crate::reflectance::{Precision, diffuse_sums_into, regimes::diffuse_sum_by_regimes};
use chromascope_math::chebyshev::evaluate;
use chromascope_math::exp::exp;

/// κ from which on all moments are within 1e-9 of J(κ, 0), and [`FEW_MOMENTS`] within 1e-6.
pub const ROUGH: f64 = 128.0;
/// κ from which on all moments are within 1e-6 of J(κ, 0), and [`FEW_MOMENTS`] within 1e-4.
pub const NEARLY_ROUGH: f64 = 64.0;
/// κ from which on [`FEW_MOMENTS`] are within 1e-9 of J(κ, 0).
pub const VERY_ROUGH: f64 = 1024.0;
/// Number of moments that serve where κ is large: half of the work.
pub const FEW_MOMENTS: usize = 4;
/// A sample is dark where J is below e^-30 of its peak.
pub const DARK: f64 = 30.0;

/// Number of sums evaluated together.
const TOGETHER: usize = 64;

/// J by a sum over wavelengths.
pub fn by_nodes(nodes: &[Node], kappa: f64, beta: f64, precision: Precision) -> [f64; 3] {
    let mut channels = [0.0; 3];
    let (mut g, mut b, mut sums) = ([0.0; TOGETHER], [0.0; TOGETHER], [0.0; TOGETHER]);
    for nodes in nodes.chunks(TOGETHER) {
        for (i, node) in nodes.iter().enumerate() {
            g[i] = kappa * node.scale;
            b[i] = beta * g[i];
        }
        diffuse_sums_into(&g[..nodes.len()], &b, precision, &mut sums);
        for (i, node) in nodes.iter().enumerate() {
            add(&mut channels, node, sums[i]);
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
            for i in 0..kappa.len() {
                g[i] = kappa[i] * node.scale;
                b[i] = beta[i] * g[i];
            }
            diffuse_sums_into(&g[..kappa.len()], &b, precision, &mut sums);
            for (i, answer) in answers.iter_mut().enumerate() {
                add(answer, node, sums[i]);
            }
        }
    }
}

/// J by a sum over wavelengths with the paper's three cases of g in place of Eq 2.
pub fn by_regimes(nodes: &[Node], kappa: f64, beta: f64) -> [f64; 3] {
    let mut channels = [0.0; 3];
    for node in nodes {
        let g = kappa * node.scale;
        add(&mut channels, node, diffuse_sum_by_regimes(g, beta * g));
    }
    channels
}

/// Adds a wavelength's sum S to the channels.
#[inline(always)]
fn add(channels: &mut [f64; 3], node: &Node, sum: f64) {
    for c in 0..3 {
        channels[c] += node.weights[c] * sum;
    }
}

/// Coefficients of `q_k(β)` for k = 1 … 7, from the constant on.
///
/// With the central moments `μ_j(g)` of Poisson's distribution and Laguerre's polynomials `L_j`,
/// ```text
/// q_k(β) = Σ_j (−1)^j L_j(β) [g^(j−k)] μ_j(g),   j ≤ 2k
/// ```
/// since S is the mean of `e^(-βg/n)/n` over n, expanded about n = g.
const Q1: [f64; 3] = [1.0, -2.0, 0.5];
const Q2: [f64; 5] = [2.0, -9.0, 7.5, -11.0 / 6.0, 0.125];
const Q3: [f64; 7] = [6.0, -44.0, 65.5, -34.0, 22.0 / 3.0, -2.0 / 3.0, 1.0 / 48.0];
const Q4: [f64; 9] =
    [24.0, -250.0, 550.0, -2695.0 / 6.0, 4045.0 / 24.0, -478.0 / 15.0, 223.0 / 72.0, -7.0 / 48.0, 1.0 / 384.0];
const Q5: [f64; 11] = [
    120.0,
    -1644.0,
    4862.0,
    -5510.0,
    24_015.0 / 8.0,
    -10_565.0 / 12.0,
    11_771.0 / 80.0,
    -214.0 / 15.0,
    905.0 / 1152.0,
    -13.0 / 576.0,
    1.0 / 3840.0,
];
const Q6: [f64; 13] = [
    720.0,
    -12_348.0,
    46_354.0,
    -203_896.0 / 3.0,
    196_567.0 / 4.0,
    -475_013.0 / 24.0,
    3_427_543.0 / 720.0,
    -1_193_831.0 / 1680.0,
    385_001.0 / 5760.0,
    -203_801.0 / 51_840.0,
    1603.0 / 11_520.0,
    -31.0 / 11_520.0,
    1.0 / 46_080.0,
];
const Q7: [f64; 15] = [
    5040.0,
    -104_544.0,
    479_286.0,
    -2_607_556.0 / 3.0,
    9_480_317.0 / 12.0,
    -2_450_119.0 / 6.0,
    93_206_239.0 / 720.0,
    -2_373_967.0 / 90.0,
    1_118_834.0 / 315.0,
    -907_483.0 / 2835.0,
    999_013.0 / 51_840.0,
    -985.0 / 1296.0,
    259.0 / 13_824.0,
    -1.0 / 3840.0,
    1.0 / 645_120.0,
];

/// Factors that J separates into for κ ≥ [`NEARLY_ROUGH`]: `J_c = Σ_k basis[k] M_ck`.
///
/// ```text
/// basis_k = e^-β / κ  q_k(β) κ^-k
/// ```
/// with `q_k` the coefficients of the expansion of S in 1/g at fixed β.
#[inline]
pub fn rough_basis(kappa: f64, beta: f64) -> [f64; MOMENTS] {
    // The exponential is 0 from there on, the polynomials would go on to infinity.
    rough_basis_of(kappa, beta.min(700.0))
}

/// The first N factors, for β up to 700; without branches or calls, so that a loop over it vectorizes.
#[inline(always)]
pub(super) fn rough_basis_of<const N: usize>(kappa: f64, beta: f64) -> [f64; N] {
    let t = 1.0 / kappa;
    let mut power = exp(-beta) * t;
    let mut basis = [0.0; N];
    for k in 0..N {
        let q = match k {
            0 => 1.0,
            1 => evaluate(&Q1, beta),
            2 => evaluate(&Q2, beta),
            3 => evaluate(&Q3, beta),
            4 => evaluate(&Q4, beta),
            5 => evaluate(&Q5, beta),
            6 => evaluate(&Q6, beta),
            _ => evaluate(&Q7, beta),
        };
        basis[k] = power * q;
        power *= t;
    }
    basis
}

/// J from its moments.
#[inline(always)]
pub fn by_moments(moments: &[[f64; MOMENTS]; 3], basis: &[f64; MOMENTS]) -> [f64; 3] {
    let mut channels = [0.0; 3];
    for c in 0..3 {
        for k in 0..MOMENTS {
            channels[c] += moments[c][k] * basis[k];
        }
    }
    channels
}
