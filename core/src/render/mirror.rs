//! The mirror term's spectral integral: `∫ w ρ0² e^-g dλ`.
//!
//! ρ0² oscillates in wavelength: with the phase u = 2π X q / λ, q = |v| / k, a few nodes do while the path X q is short;
//! beyond some path the oscillation cancels over a channel's wavelengths ([`Measure::settled_m`]) and its mean
//! 1 / 2(u² − w²) stands for it; in between all wavelengths of the grid are needed.
//!
//! [`Measure::settled_m`]: super::measure::Measure::settled_m

use super::lobe::mean_sinc_squared_quick;
use super::measure::Node;
use super::shading::Mirror;
use crate::math::exp::exp;
use crate::reflectance::{Surface, coherent::mean_sinc_squared};
use std::f64::consts::TAU;

/// The wavelengths that an integral may be made of.
#[derive(Clone, Copy, Debug)]
pub struct Nodes<'a> {
    /// Few, for what is smooth.
    pub smooth: &'a [Node],
    /// All of the grid.
    pub every: &'a [Node],
    /// Up to this path in meters the few are enough.
    pub still_m: f64,
    /// From this path in meters on the oscillation cancels.
    pub settled_m: f64,
    /// Whether the lobe is read from a table.
    pub quick: bool,
}

/// The three channels' mirror terms at one sample.
pub fn mirror_sum(mirror: &Mirror, surface: &Surface, nodes: Nodes<'_>, angular_radius: f64) -> [f64; 3] {
    let axes = [
        Axis::new(surface.half_x_m(), mirror.v[0], angular_radius, nodes),
        Axis::new(surface.half_y_m(), mirror.v[1], angular_radius, nodes),
    ];
    let list = if axes.iter().all(|axis| axis.smooth) { nodes.smooth } else { nodes.every };
    let mut channels = [0.0; 3];
    for node in list {
        let wave_number = TAU / (node.wavelength_nm * 1e-9);
        let lobe = axes[0].mean(wave_number) * axes[1].mean(wave_number);
        let value = mirror.front * lobe * exp(-mirror.kappa * node.scale);
        for (channel, weight) in channels.iter_mut().zip(node.weights) {
            *channel += weight * value;
        }
    }
    channels
}

/// One direction along the patch.
struct Axis {
    /// Half side times |v| / k, in meters.
    path: f64,
    /// Half side times the light's angular radius, in meters.
    spread: f64,
    settled: bool,
    smooth: bool,
    quick: bool,
}

impl Axis {
    fn new(half_side: f64, v: f64, angular_radius: f64, nodes: Nodes<'_>) -> Self {
        let path = half_side * v.abs();
        let spread = half_side * angular_radius;
        let settled = path - spread > nodes.settled_m;
        Self { path, spread, settled, smooth: settled || path + spread < nodes.still_m, quick: nodes.quick }
    }

    /// The mean of sinc² over the light's disk.
    #[inline]
    fn mean(&self, wave_number: f64) -> f64 {
        let (u, w) = (wave_number * self.path, wave_number * self.spread);
        if self.settled {
            0.5 / ((u - w) * (u + w))
        } else if self.quick {
            mean_sinc_squared_quick(u, w)
        } else {
            mean_sinc_squared(u, w)
        }
    }
}
