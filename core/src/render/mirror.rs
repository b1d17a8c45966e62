//! The mirror term's spectral integral: `∫ w ρ0² e^-g dλ`.
//!
//! ρ0² oscillates in wavelength: with the phase u = 2π X q / λ, q = |v| / k, a few nodes do while the path X q is short;
//! beyond some path the oscillation cancels over a channel's wavelengths ([`SpectralWeights::settled_m`]) and its mean
//! 1 / 2(u² − w²) stands for it; in between all wavelengths of the grid are needed.
//!
//! [`SpectralWeights::settled_m`]: super::measure::SpectralWeights::settled_m

use super::lobe::mean_sinc_squared_quick;
use super::measure::{Node, SpectralWeights};
use super::shading::{Mirror, Quality, ShadingImage};
use crate::accuracy::RelTolerance;
use crate::math::exp::exp;
use crate::reflectance::Surface;
use crate::reflectance::coherent::{mean_sinc_squared, sinc};
use std::f64::consts::TAU;

/// Which paths a lobe is still over a few wavelengths at, and at which its oscillation cancels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Up to this path in meters a few wavelengths are enough.
    pub still_m: f64,
    /// From this path in meters on the oscillation cancels.
    pub settled_m: f64,
    /// Whether the lobe is read from a table, within 1e-7 of its height.
    pub quick: bool,
}

impl Reach {
    /// That of a quality by name; for an accuracy in numbers see [`Self::within`].
    pub fn of(quality: Quality, measure: &SpectralWeights) -> Self {
        let (still_m, settled_m) = match quality {
            // What oscillates in between is a thousandth of the lobe.
            Quality::Preview => (2e-6, 2e-6),
            Quality::Full => (1e-6, measure.coherent().settled_m()),
            Quality::Fine => (0.4e-6, f64::INFINITY),
            Quality::Reference | Quality::Regimes => (0.0, f64::INFINITY),
            Quality::Within(accuracy) => return Self::within(measure, accuracy),
        };
        Self { still_m, settled_m, quick: quality <= Quality::Full }
    }

    /// That of a picture's quality, relative to the picture's brightest sample: where no sample sees the middle of a lobe, errors
    /// relative to its height have to be so much smaller.
    pub fn in_picture(shading: &ShadingImage, measure: &SpectralWeights) -> Self {
        match Self::accuracy_in(shading) {
            Some(accuracy) => Self::within(measure, accuracy),
            None => Self::usual_in(shading, measure),
        }
    }

    /// The accuracy that [`Self::within`] has to be made for in a picture; none where the quality's own will do.
    pub(crate) fn accuracy_in(shading: &ShadingImage) -> Option<RelTolerance> {
        if shading.mirrors().is_empty() {
            return None;
        }
        let scale = shading.mirror_scale();
        let full = shading.quality() == Quality::Full && scale < USUAL_SCALE;
        shading.mirror_tolerance().or_else(|| full.then(|| RelTolerance::at_best(FULL_ERROR * scale)))
    }

    /// That of a picture for which there is no such accuracy.
    pub(crate) fn usual_in(shading: &ShadingImage, measure: &SpectralWeights) -> Self {
        let fine = shading.quality() == Quality::Fine && shading.mirror_scale() < USUAL_SCALE;
        let none = shading.mirrors().is_empty();
        Self::of(if fine || none { Quality::Reference } else { shading.quality() }, measure)
    }

    /// The widest that keeps the error of this measure's lobe ([`SpectralWeights::coherent`]) within an accuracy, relative to its height `front Σ|w|`: each of
    /// the lobe's table, the few wavelengths and what is left of the oscillation on two axes takes a part.
    ///
    /// The few wavelengths are compared with all at sixteen paths to an octave, along one axis and beside another, and at five κ,
    /// with a margin of two; the oscillation is bounded by its envelope over the wavelengths.
    pub fn within(measure: &SpectralWeights, accuracy: RelTolerance) -> Self {
        let (error, measure) = (accuracy.max_relative_error(), measure.coherent());
        let settled_m = settled(measure.dense(), error / 8.0);
        let still_m = still(measure, settled_m, error / 4.0);
        Self { still_m, settled_m, quick: LOBE_ERROR <= error / 4.0 }
    }
}

/// Down to this share of the highest lobe as the brightest sample, the qualities by name need no more than usual.
const USUAL_SCALE: f64 = 1.0 / 16.0;
/// What full quality promises.
const FULL_ERROR: f64 = 1e-5;
/// What is seen at some lobes is taken to be at most this much larger at others.
const MARGIN: f64 = 2.0;
/// What two readings of the lobe's table are off by.
const LOBE_ERROR: f64 = 2e-7;
/// The longest path that few wavelengths are tried for, and how many shorter ones.
const LONGEST: f64 = 3e-6;
const PATHS: u32 = 6 * PATHS_TO_AN_OCTAVE as u32;
const PATHS_TO_AN_OCTAVE: usize = 16;
/// The κ that few wavelengths are tried for.
const KAPPAS: [f64; 5] = [0.0, 0.4, 3.0, 12.0, 50.0];
/// Steps to an octave in which the oscillation's envelope is looked at.
const STEPS: f64 = 8.0;

/// The path from which on the oscillation of `sinc² u = (1 − cos 2u) / 2u²` over the wavelengths is below a share.
fn settled(dense: &[Node], share: f64) -> f64 {
    let unsigned = [0, 1, 2].map(|c: usize| dense.iter().map(|node| node.weights[c].abs()).sum::<f64>());
    let longest = dense.iter().fold(0.0_f64, |most, node| most.max(node.wavelength_nm)) * 1e-9;
    // Beyond this one the terms themselves are below it, however they add up.
    let last = longest / (TAU * (2.0 * share).sqrt());
    let path = |i: i32| last * (f64::from(-i) / STEPS).exp2();
    let envelope = |path: f64| {
        let mut sums = [[0.0; 2]; 3];
        for node in dense {
            let u = TAU * path / (node.wavelength_nm * 1e-9);
            let (sin, cos) = (2.0 * u).sin_cos();
            for (sum, weight) in sums.iter_mut().zip(node.weights) {
                sum[0] += weight * cos / (2.0 * u * u);
                sum[1] += weight * sin / (2.0 * u * u);
            }
        }
        let shares =
            sums.iter().zip(unsigned).map(|(sum, all)| if all > 0.0 { sum[0].hypot(sum[1]) / all } else { 0.0 });
        shares.fold(0.0, f64::max)
    };
    let unsettled = (1..10 * STEPS as i32).find(|&i| MARGIN * envelope(path(i)) > share);
    unsettled.map_or(last, |i| path(i - 1))
}

/// Up to which path a few wavelengths keep an error relative to a lobe's height, alone and beside another axis.
///
/// Looked at from the shortest path on, for the error changes its sign along it.
fn still(measure: &SpectralWeights, settled_m: f64, error: f64) -> f64 {
    let lists = [List::new(measure.fine(), settled_m), List::new(measure.dense(), settled_m)];
    let unsigned = |c: usize| measure.dense().iter().map(|node| node.weights[c].abs()).sum::<f64>();
    let height = unsigned(0).max(unsigned(1)).max(unsigned(2));
    let mut rows: Vec<[Vec<f64>; 2]> = Vec::new();
    let mut still_m = 0.0;
    for path in (0..PATHS).map(|i| LONGEST * (-f64::from(PATHS - 1 - i) / PATHS_TO_AN_OCTAVE as f64).exp2()) {
        let row = lists.each_ref().map(|list| list.lobe(path));
        // Along the other axis: its middle, the same, where it has settled, and a path shorter by √2.
        let shorter = rows.len().checked_sub(PATHS_TO_AN_OCTAVE / 2).map(|i| &rows[i]);
        let settled = [&lists[0].settled, &lists[1].settled];
        let others = [None, Some(row.each_ref()), Some(settled), shorter.map(<[_; 2]>::each_ref)];
        let off = |other: Option<[&Vec<f64>; 2]>, kappa: usize| {
            let [few, all] = [0, 1].map(|l: usize| lists[l].sums(&row[l], other.map(|o| o[l].as_slice()), kappa));
            few.iter().zip(all).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
        };
        let worst = others.iter().flat_map(|&other| (0..KAPPAS.len()).map(move |kappa| (other, kappa)));
        let worst = worst.map(|(other, kappa)| off(other, kappa)).fold(0.0, f64::max);
        if MARGIN * worst > error * height {
            break;
        }
        still_m = path;
        rows.push(row);
    }
    still_m
}

/// Wavelengths with what of a lobe's integral depends on nothing else.
struct List<'a> {
    nodes: &'a [Node],
    /// e^-g, for each κ.
    damped: [Vec<f64>; KAPPAS.len()],
    /// One axis where it has settled.
    settled: Vec<f64>,
    settled_m: f64,
}

impl<'a> List<'a> {
    fn new(nodes: &'a [Node], settled_m: f64) -> Self {
        let damped = KAPPAS.map(|kappa| nodes.iter().map(|node| exp(-kappa * node.scale)).collect());
        let mut list = Self { nodes, damped, settled: Vec::new(), settled_m };
        list.settled = list.lobe(settled_m);
        list
    }

    /// One axis at a path.
    fn lobe(&self, path: f64) -> Vec<f64> {
        let at = |node: &Node| {
            let u = TAU * path / (node.wavelength_nm * 1e-9);
            if path >= self.settled_m { 0.5 / (u * u) } else { sinc(u).powi(2) }
        };
        self.nodes.iter().map(at).collect()
    }

    /// The three integrals of a lobe.
    fn sums(&self, axis: &[f64], other: Option<&[f64]>, kappa: usize) -> [f64; 3] {
        let mut channels = [0.0; 3];
        for (i, node) in self.nodes.iter().enumerate() {
            let value = axis[i] * other.map_or(1.0, |other| other[i]) * self.damped[kappa][i];
            channels.iter_mut().zip(node.weights).for_each(|(channel, weight)| *channel += weight * value);
        }
        channels
    }
}

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
