//! Gauss rules made for a given discrete measure, and interpolatory rules for signed ones.
//!
//! An integral that is needed many times, `Σ mᵢ f(xᵢ)` over hundreds of samples, is replaced by a few nodes: the N-point
//! Gauss rule of the measure m is exact for all polynomials f of degree 2N − 1, so that for smooth f its error falls by
//! an order of magnitude or more with each node.

use super::dot::dot;

/// Nodes and weights: `Σ weights[i] f(nodes[i])` stands for the sum over the measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// The abscissae, ascending.
    pub nodes: Vec<f64>,
    /// The weights, one for each node.
    pub weights: Vec<f64>,
}

/// The Gauss rule with `count` nodes of the positive measure with masses `masses` at `points`.
///
/// Lanczos tridiagonalization with full reorthogonalization (Golub and Welsch 1969; Gragg and Harrod 1984), then the
/// eigenvalues of the Jacobi matrix. A measure with fewer than `count` points of mass is returned as it is, which is exact.
/// Negative or zero masses are omitted. Weights are positive, nodes lie inside the support.
pub fn gauss_rule(points: &[f64], masses: &[f64], count: usize) -> Rule {
    let support: Vec<(f64, f64)> =
        points.iter().copied().zip(masses.iter().copied()).filter(|&(_, m)| m > 0.0).collect();
    if support.len() <= count {
        return Rule { nodes: support.iter().map(|p| p.0).collect(), weights: support.iter().map(|p| p.1).collect() };
    }
    let total: f64 = support.iter().map(|p| p.1).sum();
    // A rule on [-1, 1]: the recurrence is better scaled than in nanometers.
    let low = support.iter().map(|p| p.0).fold(f64::INFINITY, f64::min);
    let high = support.iter().map(|p| p.0).fold(f64::NEG_INFINITY, f64::max);
    let (center, half) = (f64::midpoint(low, high), (high - low) / 2.0);
    let x: Vec<f64> = support.iter().map(|p| (p.0 - center) / half).collect();
    let start: Vec<f64> = support.iter().map(|p| (p.1 / total).sqrt()).collect();
    let (mut diagonal, mut off) = lanczos(&x, &start, count);
    let first = tridiagonal_eigen(&mut diagonal, &mut off);
    let mut pairs: Vec<(f64, f64)> =
        diagonal.iter().zip(&first).map(|(&d, &f)| (d * half + center, f * f * total)).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    Rule { nodes: pairs.iter().map(|p| p.0).collect(), weights: pairs.iter().map(|p| p.1).collect() }
}

/// The interpolatory rule on given nodes of a measure of any sign: exact for polynomials of degree N − 1.
///
/// `weightᵢ = Σₖ massₖ lᵢ(pointₖ)` with the Lagrange polynomials lᵢ of the nodes. For curves with negative lobes, whose own
/// Gauss rule does not exist; take the nodes of the measure of absolute values.
pub fn interpolatory_rule(nodes: &[f64], points: &[f64], masses: &[f64]) -> Rule {
    let n = nodes.len();
    let mut weights = vec![0.0; n];
    let scale = nodes.last().zip(nodes.first()).map_or(1.0, |(b, a)| ((b - a) / 4.0).abs().max(f64::MIN_POSITIVE));
    let barycentric: Vec<f64> =
        (0..n).map(|i| (0..n).filter(|&j| j != i).map(|j| scale / (nodes[i] - nodes[j])).product()).collect();
    for (&x, &mass) in points.iter().zip(masses) {
        if mass == 0.0 {
            continue;
        }
        if let Some(hit) = nodes.iter().position(|&node| node == x) {
            weights[hit] += mass;
            continue;
        }
        let terms: Vec<f64> = (0..n).map(|i| barycentric[i] / (x - nodes[i])).collect();
        let sum: f64 = terms.iter().sum();
        for (weight, term) in weights.iter_mut().zip(terms) {
            *weight += mass * term / sum;
        }
    }
    Rule { nodes: nodes.to_vec(), weights }
}

/// Lanczos on diag(x) from a unit start vector: the Jacobi matrix's diagonal and the squares' roots beside it.
fn lanczos(x: &[f64], start: &[f64], count: usize) -> (Vec<f64>, Vec<f64>) {
    let mut basis: Vec<Vec<f64>> = vec![start.to_vec()];
    let (mut diagonal, mut off) = (Vec::with_capacity(count), Vec::with_capacity(count));
    for k in 0..count {
        let image: Vec<f64> = basis[k].iter().zip(x).map(|(q, x)| q * x).collect();
        diagonal.push(dot(&image, &basis[k]));
        let mut next = image;
        // Twice is enough (Kahan): one pass leaves the loss of orthogonality that spoils the small weights.
        for _ in 0..2 {
            for q in &basis {
                let overlap = dot(&next, q);
                for (value, q) in next.iter_mut().zip(q) {
                    *value -= overlap * q;
                }
            }
        }
        let norm = dot(&next, &next).sqrt();
        if k + 1 == count || norm == 0.0 {
            break;
        }
        off.push(norm);
        for value in &mut next {
            *value /= norm;
        }
        basis.push(next);
    }
    (diagonal, off)
}

/// Eigenvalues of a symmetric tridiagonal matrix, in place of its diagonal; returns the eigenvectors' first components.
///
/// Implicit QL with Wilkinson's shift (Dubrulle, Martin and Wilkinson 1968). Converges in about two sweeps a value; a cap
/// of 60 keeps it total.
fn tridiagonal_eigen(diagonal: &mut [f64], off: &mut Vec<f64>) -> Vec<f64> {
    let n = diagonal.len();
    off.resize(n, 0.0);
    let mut first = vec![0.0; n];
    if n > 0 {
        first[0] = 1.0;
    }
    for l in 0..n {
        for _ in 0..60 {
            let m = (l..n.saturating_sub(1))
                .find(|&m| off[m].abs() <= f64::EPSILON * (diagonal[m].abs() + diagonal[m + 1].abs()))
                .unwrap_or(n - 1);
            if m == l {
                break;
            }
            ql_sweep(diagonal, off, &mut first, l, m);
        }
    }
    first
}

/// One implicit QL sweep on rows l ..= m.
fn ql_sweep(diagonal: &mut [f64], off: &mut [f64], first: &mut [f64], l: usize, m: usize) {
    let mut g = (diagonal[l + 1] - diagonal[l]) / (2.0 * off[l]);
    let r = g.hypot(1.0);
    g = diagonal[m] - diagonal[l] + off[l] / (g + r.copysign(g));
    let (mut s, mut c, mut p) = (1.0, 1.0, 0.0);
    for i in (l..m).rev() {
        let f = s * off[i];
        let b = c * off[i];
        let r = f.hypot(g);
        off[i + 1] = r;
        if r == 0.0 {
            diagonal[i + 1] -= p;
            off[m] = 0.0;
            return;
        }
        s = f / r;
        c = g / r;
        let shifted = diagonal[i + 1] - p;
        let r = (diagonal[i] - shifted) * s + 2.0 * c * b;
        p = s * r;
        diagonal[i + 1] = shifted + p;
        g = c * r - b;
        let upper = first[i + 1];
        first[i + 1] = s * first[i] + c * upper;
        first[i] = c * first[i] - s * upper;
    }
    diagonal[l] -= p;
    off[l] = g;
    off[m] = 0.0;
}
