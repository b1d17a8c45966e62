//! The reflectance model: against 50-digit figures, laws of energy and exchange, and a microfacet model beside it.

mod coherent;
mod fresnel;
mod geometry;
mod hemispherical;
mod leaf;
mod power;
mod regimes;
mod sum;
mod surface;

use chromascope_core::reflectance::Surface;

/// Rough enough for geometrical optics, with slopes between those of the render pane's skin and a mirror's.
fn rough(sigma_m: f64, tau_m: f64, index: f64) -> Surface {
    Surface::new(sigma_m, tau_m, 1e-3, 1e-3, index).unwrap()
}

/// The integral over `from ..= to` by Gauss's five points in each of `pieces`.
fn integral(from: f64, to: f64, pieces: u32, f: impl Fn(f64) -> f64) -> f64 {
    const RULE: [[f64; 2]; 5] = [
        [0.0, 0.568_888_888_888_888_9],
        [-0.538_469_310_105_683_1, 0.478_628_670_499_366_5],
        [0.538_469_310_105_683_1, 0.478_628_670_499_366_5],
        [-0.906_179_845_938_664, 0.236_926_885_056_189_1],
        [0.906_179_845_938_664, 0.236_926_885_056_189_1],
    ];
    let half = (to - from) / (2.0 * f64::from(pieces));
    let piece = |i: u32| {
        let middle = from + half * (2.0 * f64::from(i) + 1.0);
        RULE.iter().map(|[x, weight]| weight * f(middle + half * x)).sum::<f64>()
    };
    (0..pieces).map(piece).sum::<f64>() * half
}
