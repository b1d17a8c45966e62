//! The mirror term's spectral integral: `∫ w ρ0² e^-g dλ`.
//!
//! ρ0² oscillates in wavelength: with the phase u = 2π X q / λ, q = |v| / k, a few nodes do while X q is below half a
//! micrometer; beyond 36 µm the oscillation is faster than the grid and stands for its mean 1 / (2 u²); in between all
//! wavelengths of the grid are needed.

use super::measure::Node;
use super::shading::Mirror;
use crate::math::exp::exp;
use crate::reflectance::{Surface, coherent::mean_sinc_squared};
use std::f64::consts::TAU;

/// Below this path difference in meters, half side times q, the phase is the same for a whole node.
const STILL: f64 = 0.5e-6;
/// Beyond this one the oscillation is faster than 1 nm.
const FAST: f64 = 36e-6;

/// The wavelengths that an integral may be made of.
#[derive(Clone, Copy, Debug)]
pub struct Nodes<'a> {
    /// Few, for what is smooth.
    pub smooth: &'a [Node],
    /// All of the grid.
    pub every: &'a [Node],
    /// How many neighbors of the grid one wavelength stands for.
    pub stride: usize,
    /// Whether all are to be taken always.
    pub exact: bool,
}

/// The three channels' mirror terms at one sample.
pub fn mirror_sum(mirror: &Mirror, surface: &Surface, nodes: Nodes<'_>, angular_radius: f64) -> [f64; 3] {
    let axes = [
        Axis::new(surface.half_x_m(), mirror.v[0], angular_radius, nodes.exact),
        Axis::new(surface.half_y_m(), mirror.v[1], angular_radius, nodes.exact),
    ];
    let smooth = !nodes.exact && axes.iter().all(|axis| axis.is_smooth());
    let (list, stride) = if smooth { (nodes.smooth, 1) } else { (nodes.every, nodes.stride) };
    let mut channels = [0.0; 3];
    for run in list.chunks(stride) {
        let middle = &run[run.len() / 2];
        let wave_number = TAU / (middle.wavelength_nm * 1e-9);
        let lobe = axes[0].mean(wave_number) * axes[1].mean(wave_number);
        let value = mirror.front * lobe * exp(-mirror.kappa * middle.scale);
        for node in run {
            for (channel, weight) in channels.iter_mut().zip(node.weights) {
                *channel += weight * value;
            }
        }
    }
    channels
}

/// One direction along the patch.
struct Axis {
    /// Half side times v / k, in meters.
    path: f64,
    /// Half side times the light's angular radius, in meters.
    spread: f64,
    fast: bool,
}

impl Axis {
    fn new(half_side: f64, v: f64, angular_radius: f64, exact: bool) -> Self {
        let path = half_side * v.abs();
        let spread = half_side * angular_radius;
        Self { path, spread, fast: !exact && path - spread > FAST }
    }

    fn is_smooth(&self) -> bool {
        self.fast || self.path + self.spread < STILL
    }

    /// The mean of sinc² over the light's disk.
    fn mean(&self, wave_number: f64) -> f64 {
        let u = wave_number * self.path;
        if self.fast { 0.5 / (u * u) } else { mean_sinc_squared(u, wave_number * self.spread) }
    }
}
