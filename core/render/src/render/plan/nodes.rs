//! Sums over a few wavelengths.

use crate::reflectance::{Precision, diffuse_sum, diffuse_sums_into};
use crate::render::measure::{LAMBDA_0_NM, Node};
use chromascope_math::gauss::{Rule, gauss_rule, interpolatory_rule};

/// A rule of one channel's own: (λ0/λ)² and weight.
pub(super) type OwnRule = Vec<[f64; 2]>;

/// The rules with `count` wavelengths for each channel: Gauss's own where its weights have one sign, else the wavelengths of
/// the unsigned weights.
pub(super) fn own_rules(dense: &[Node], count: usize) -> [OwnRule; 3] {
    let points: Vec<f64> = dense.iter().map(|node| node.wavelength_nm).collect();
    [0, 1, 2].map(|c: usize| {
        let masses: Vec<f64> = dense.iter().map(|node| node.weights[c]).collect();
        let unsigned: Vec<f64> = masses.iter().map(|m| m.abs()).collect();
        let rule = gauss_rule(&points, &unsigned, count);
        let Rule { nodes, weights } =
            if masses.iter().all(|&m| m >= 0.0) { rule } else { interpolatory_rule(&rule.nodes, &points, &masses) };
        nodes.iter().zip(weights).map(|(nm, weight)| [(LAMBDA_0_NM / nm).powi(2), weight]).collect()
    })
}

/// The three integrals by rules of their own.
pub(super) fn by_own(rules: &[OwnRule; 3], kappa: f64, beta: f64, precision: Precision) -> [f64; 3] {
    let sum = |rule: &OwnRule| -> f64 {
        let term = |[scale, weight]: &[f64; 2]| {
            let g = kappa * scale;
            weight * diffuse_sum(g, beta * g, precision)
        };
        rule.iter().map(term).sum()
    };
    [sum(&rules[0]), sum(&rules[1]), sum(&rules[2])]
}

/// S for many κ and β, wavelength by wavelength.
pub(super) fn for_each_node(
    nodes: &[Node],
    points: &[[f64; 2]],
    precision: Precision,
    mut each: impl FnMut(&Node, &[f64]),
) {
    let [mut g, mut b, mut sums] = [0, 1, 2].map(|_| vec![0.0; points.len()]);
    for node in nodes {
        for ((g, b), [kappa, beta]) in g.iter_mut().zip(&mut b).zip(points) {
            *g = kappa * node.scale;
            *b = beta * *g;
        }
        diffuse_sums_into(&g, &b, precision, &mut sums);
        each(node, &sums);
    }
}

pub(super) fn many_by_nodes(nodes: &[Node], points: &[[f64; 2]]) -> Vec<[f64; 3]> {
    let mut totals = vec![[0.0; 3]; points.len()];
    for_each_node(nodes, points, Precision::Full, |node, sums| {
        for (total, sum) in totals.iter_mut().zip(sums) {
            total.iter_mut().zip(node.weights).for_each(|(total, weight)| *total += weight * sum);
        }
    });
    totals
}

/// `Σ |w| S` of the channel where it is largest: what a relative error of S is carried by.
pub(super) fn carried(nodes: &[Node], sums: &[f64]) -> f64 {
    let of = |c: usize| nodes.iter().zip(sums).map(|(node, sum)| (node.weights[c] * sum).abs()).sum::<f64>();
    of(0).max(of(1)).max(of(2))
}
