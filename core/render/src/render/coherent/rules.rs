//! Quadrature rules of the coherent component for one camera, and the paths over which its interference fades.
//!
//! The integrand is band limited: along a path L its oscillation in t = 1/λ is no faster than `cos 4πLt`. Chebyshev nodes in t
//! over the camera's band, with interpolatory weights, are off by no more than the integrand's interpolation there, whatever the
//! weights; see [`nodes_needed`].

use crate::render::measure::Node;
use chromascope_color::spectral::grid::{FIRST_NM, LAST_NM};
use chromascope_math::array::each;
use chromascope_math::exp::exp;
use std::f64::consts::{LN_2, PI, TAU};
use std::sync::{LazyLock, OnceLock};

/// Number of nodes processed together.
pub(super) const LANES: usize = 8;
/// Node counts of the rules; beyond the last all wavelengths of the grid are taken.
const COUNTS: [usize; 12] = [8, 16, 24, 32, 40, 48, 64, 80, 96, 128, 160, 208];

/// A quadrature rule, padded with weightless nodes to whole lanes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rule {
    /// 2π/λ in 1/m.
    pub(super) wave_numbers: Vec<f64>,
    /// (λ0/λ)².
    pub(super) scales: Vec<f64>,
    pub(super) weights: [Vec<f64>; 3],
    /// Wavelengths, without the padding.
    pub(super) count: usize,
}

impl Rule {
    /// Each node as `[2π/λ, (λ0/λ)², weights]`.
    fn new(nodes: impl Iterator<Item = (f64, f64, [f64; 3])>) -> Self {
        let mut rule = Self { wave_numbers: Vec::new(), scales: Vec::new(), weights: Default::default(), count: 0 };
        for (wave_number, scale, weights) in nodes {
            rule.wave_numbers.push(wave_number);
            rule.scales.push(scale);
            rule.weights.iter_mut().zip(weights).for_each(|(all, weight)| all.push(weight));
        }
        rule.count = rule.scales.len();
        let padded = rule.count.next_multiple_of(LANES);
        for (values, padding) in [(&mut rule.wave_numbers, 1e7), (&mut rule.scales, 1.0)] {
            values.resize(padded, padding);
        }
        rule.weights.iter_mut().for_each(|weights| weights.resize(padded, 0.0));
        rule
    }

    fn of_grid(dense: &[Node]) -> Self {
        Self::new(dense.iter().map(|node| (TAU / (node.wavelength_nm * 1e-9), node.scale, node.weights)))
    }

    /// Chebyshev nodes of the first kind in 1/λ, with weights by the second barycentric formula (Berrut and Trefethen 2004).
    fn chebyshev(dense: &[Node], band: Band, count: usize) -> Self {
        let angle = |m: usize| PI * (m as f64 + 0.5) / count as f64;
        let t: Vec<f64> = (0..count).map(|m| band.center + band.half * angle(m).cos()).collect();
        let factors: Vec<f64> = (0..count).map(|m| angle(m).sin() * if m % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let mut weights = vec![[0.0; 3]; count];
        let mut terms = vec![0.0; count];
        for node in dense {
            let own = 1e9 / node.wavelength_nm;
            let mut sum = 0.0;
            for ((term, t), factor) in terms.iter_mut().zip(&t).zip(&factors) {
                let apart = own - t;
                // On a node its own term outweighs all others.
                *term = factor / if apart.abs() < 1e-9 * band.center { 1e-9 * band.center } else { apart };
                sum += *term;
            }
            for (weights, term) in weights.iter_mut().zip(&terms) {
                (0..3).for_each(|c| weights[c] += node.weights[c] * (term / sum));
            }
        }
        Self::new(t.iter().zip(weights).map(|(t, weights)| (TAU * t, (t * LAMBDA_0).powi(2), weights)))
    }
}

/// λ0 in meters.
const LAMBDA_0: f64 = crate::render::measure::LAMBDA_0_NM * 1e-9;

/// Interval of 1/λ, in 1/m.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Band {
    center: f64,
    half: f64,
}

impl Band {
    fn new(shortest_nm: f64, longest_nm: f64) -> Self {
        let [high, low] = [shortest_nm, longest_nm].map(|nm| 1e9 / nm);
        Self { center: f64::midpoint(low, high), half: (high - low) / 2.0 }
    }
}

/// Rules of one camera, each computed at first use.
#[derive(Clone, Debug, PartialEq)]
pub struct CoherentRules {
    rules: [OnceLock<Rule>; COUNTS.len()],
    grid: Rule,
    fade: Fade,
    band: Band,
}

impl CoherentRules {
    /// Prepares the rules for the weights on the grid.
    pub fn new(dense: &[Node]) -> Self {
        let band = match (dense.first(), dense.last()) {
            (Some(first), Some(last)) => Band::new(first.wavelength_nm, last.wavelength_nm),
            _ => Band::new(FIRST_NM, LAST_NM),
        };
        let rules = std::array::from_fn(|_| OnceLock::new());
        Self { rules, grid: Rule::of_grid(dense), fade: Fade::new(dense), band }
    }

    /// Smallest rule whose error stays below a share of the integrand's largest value, for oscillation along `path_m`.
    pub(super) fn smallest(&self, dense: &[Node], path_m: f64, kappa: f64, share: f64) -> &Rule {
        let place = nodes_needed(TAU * 2.0 * self.band.half * path_m, kappa, share);
        match self.rules.get(place).filter(|_| COUNTS[place] < self.grid.count) {
            Some(rule) => rule.get_or_init(|| Rule::chebyshev(dense, self.band, COUNTS[place])),
            None => &self.grid,
        }
    }

    pub(super) fn fade(&self) -> &Fade {
        &self.fade
    }

    /// Least and greatest 2π/λ, in 1/m.
    pub(super) fn wave_numbers(&self) -> [f64; 2] {
        [self.band.center - self.band.half, self.band.center + self.band.half].map(|t| TAU * t)
    }
}

/// Powers of 16 that a share of the integrand's largest value is rounded down to.
const SHARES: usize = 13;
/// Upper ends of the κ that a limit is found for: 1/4 and its octaves.
const KAPPAS: usize = 13;

/// Fastest oscillation ω, half the phase's range over the band, that each rule follows within each share at each κ.
static LIMITS: LazyLock<Vec<[[f64; COUNTS.len()]; SHARES]>> = LazyLock::new(|| {
    let ellipses: Vec<Ellipse> = (1..=48).map(|i| Ellipse::new(0.035 * f64::from(i))).collect();
    let limit = |count: usize, share: usize, kappa: f64| {
        let ln_share = -4.0 * LN_2 * share as f64;
        let fastest = |e: &Ellipse| (count as f64 * e.eta + e.ln_front + ln_share - kappa * e.growth) / e.sinh;
        ellipses.iter().map(fastest).fold(f64::NEG_INFINITY, f64::max)
    };
    let row = |kappa: f64| std::array::from_fn(|share| COUNTS.map(|count| limit(count, share, kappa)));
    (0..KAPPAS).map(|i| row(0.25 * (i as f64).exp2())).collect()
});

/// Bernstein ellipse `cosh(η + iθ)` of the visible band in 1/λ.
struct Ellipse {
    eta: f64,
    sinh: f64,
    /// Logarithm by which e^-g at κ = 1 exceeds its largest value on the band.
    growth: f64,
    /// Logarithm of what divides the rest of the bound: `(e^η − 1)/4` and the growth of `(2π/λ)^-6`.
    ln_front: f64,
}

impl Ellipse {
    fn new(eta: f64) -> Self {
        let band = Band::new(FIRST_NM, LAST_NM);
        let part = band.half / band.center;
        let (cosh, sinh) = (eta.cosh(), eta.sinh());
        // Least real part of (1 + part · cosh(η + iθ))², in the middle of the ellipse or at its red end.
        let cos = (-cosh / (part * (cosh * cosh + sinh * sinh))).max(-1.0);
        let least = (1.0 + part * cosh * cos).powi(2) - (part * sinh).powi(2) * (1.0 - cos * cos);
        let growth = ((1.0 - part).powi(2) - least) * (band.center * LAMBDA_0).powi(2);
        let amplitude = (1.0 - part) / (1.0 - part * cosh);
        Self { eta, sinh, growth, ln_front: (eta.exp_m1() / 4.0).ln() - 6.0 * amplitude.ln() }
    }
}

/// Place of the smallest rule that follows an oscillation within a share of the integrand's largest value.
///
/// For f analytic within the Bernstein ellipse of parameter ρ = e^η, N Chebyshev nodes are off by at most `4 M ρ^-N / (ρ − 1)`,
/// M the largest |f| on it (Trefethen 2013, theorem 8.2). Here f grows by `e^(ω sinh η)` for its oscillation, by what e^-g
/// grows, and by at most the sixth power of 1/k.
fn nodes_needed(omega: f64, kappa: f64, share: f64) -> usize {
    let exponent = |x: f64| ((x.to_bits() >> 52) & 0x7FF).cast_signed() - 1023;
    let share = usize::try_from((-exponent(share) + 3).div_euclid(4)).unwrap_or(0);
    let class = usize::try_from(exponent(kappa * 4.0) + 1).unwrap_or(0);
    match LIMITS.get(class).and_then(|row| row.get(share)) {
        Some(row) => row.iter().position(|&limit| omega <= limit).unwrap_or(COUNTS.len()),
        None => COUNTS.len(),
    }
}

/// κ at which the fading is found; between two the larger counts.
const FADE_KAPPAS: [f64; 6] = [0.0, 0.5, 1.5, 5.0, 15.0, 50.0];
/// Steps to an octave of paths, shortest path, and number of paths.
const STEPS: usize = 8;
const SHORTEST: f64 = 0.25e-6;
const PATHS: usize = 13 * STEPS + 1;
/// Between the paths that were looked at the interference is taken to be at most this much larger.
const MARGIN: f64 = 2.0;

/// Largest `|Σ w e^-g e^(i 4πL/λ)|` of the channels as a share of the largest `Σ|w|`, over paths L.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fade {
    rows: Vec<[f32; PATHS]>,
}

impl Fade {
    fn new(dense: &[Node]) -> Self {
        let unsigned = [0, 1, 2].map(|c: usize| dense.iter().map(|node| node.weights[c].abs()).sum::<f64>());
        let height = unsigned.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        let damped: Vec<Vec<[f64; 3]>> = FADE_KAPPAS
            .iter()
            .map(|kappa| dense.iter().map(|n| each(n.weights, |w| w * exp(-kappa * n.scale) / height)).collect())
            .collect();
        let mut at: Vec<[f32; PATHS]> = vec![[0.0; PATHS]; FADE_KAPPAS.len()];
        for step in 0..STEPS {
            let path = SHORTEST * (step as f64 / STEPS as f64).exp2();
            let phase = |node: &Node| (2.0 * TAU * path / (node.wavelength_nm * 1e-9)).sin_cos();
            let mut phases: Vec<(f64, f64)> = dense.iter().map(phase).collect();
            for place in (step..PATHS).step_by(STEPS) {
                for (row, damped) in at.iter_mut().zip(&damped) {
                    let mut sums = [[0.0; 2]; 3];
                    for ((sin, cos), weights) in phases.iter().zip(damped) {
                        for c in 0..3 {
                            sums[c][0] += weights[c] * cos;
                            sums[c][1] += weights[c] * sin;
                        }
                    }
                    row[place] = sums.iter().map(|[re, im]| re.hypot(*im)).fold(0.0, f64::max) as f32;
                }
                // An octave further the phase has doubled.
                for (sin, cos) in &mut phases {
                    (*sin, *cos) = (2.0 * *sin * *cos, (*cos - *sin) * (*cos + *sin));
                }
            }
        }
        let larger = |pair: &[[f32; PATHS]]| std::array::from_fn(|i| MARGIN as f32 * pair[0][i].max(pair[1][i]));
        Self { rows: at.windows(2).map(larger).collect() }
    }

    /// Largest share that is left anywhere on paths from `from_m` to `to_m`.
    pub(super) fn largest(&self, kappa: f64, from_m: f64, to_m: f64) -> f64 {
        let row = FADE_KAPPAS[1..].iter().position(|&end| kappa <= end);
        let place = |path: f64| (path / SHORTEST).max(f64::MIN_POSITIVE).log2() * STEPS as f64;
        let (first, last) = (place(from_m).floor(), place(to_m).ceil());
        match row {
            Some(row) if first >= 0.0 && last < PATHS as f64 => {
                f64::from(self.rows[row][first as usize..=last as usize].iter().copied().fold(0.0, f32::max))
            }
            _ => 1.0,
        }
    }
}
