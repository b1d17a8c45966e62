//! Camera × light × reflectance as weights over wavelength, and the few wavelengths that stand for 401.
//!
//! One channel's integral of Eq 12, `∫ C_c S L P dλ / ∫ C_c L dλ`, is a sum of P over wavelengths with weights `w_c`. P is smooth
//! in wavelength, so a Gauss rule of the measure needs a dozen (see `math::gauss`); where P is rough the integral separates
//! into moments of the measure.

use super::coherent::rules::CoherentRules;
use crate::reflectance::leaf::ScatteredShare;
use chromascope_color::spectral::grid::{COUNT, wavelength_nm};
use chromascope_color::spectral::{GridSpectrum, Sensor};
use chromascope_math::gauss::{gauss_rule, interpolatory_rule};
use glam::DVec3;
use std::sync::{Arc, OnceLock};

pub use crate::reflectance::power::LAMBDA_0_NM;

/// Number of moments.
pub const MOMENTS: usize = 8;

/// A wavelength that stands for its neighborhood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// The wavelength in nanometers.
    pub wavelength_nm: f64,
    /// (λ0/λ)²: g there is κ times this.
    pub scale: f64,
    /// The weights of the three channels.
    pub weights: [f64; 3],
    /// The weight of the positive measure that the node was made for.
    pub reference: f64,
}

/// The weights of one camera, light and reflectance.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralWeights {
    dense: Vec<Node>,
    coarse: Vec<Node>,
    fine: Vec<Node>,
    moments: [[f64; MOMENTS]; 3],
    totals: [f64; 3],
    coherent_rules: OnceLock<CoherentRules>,
    /// Weights of the coherent component: those of a white, where a boundary's reflection does not take the material's color
    /// ([`crate::reflectance::Specular::Fresnel`]); none for its own.
    pub untinted: Option<Arc<SpectralWeights>>,
    /// Light that passes through a leaf; none where nothing does.
    pub transmitted: Option<Transmitted>,
    /// Signals of the surface under the whole sky, where there is one.
    pub sky: Option<Arc<SkySignals>>,
    /// Signals of the surface under as much light from a white ground, where there is a ground.
    pub bounce: Option<Arc<SkySignals>>,
    /// `∫ C_c S w_k L dλ / ∫ C_c L dλ` with the shares w of light spread within skin
    /// ([`crate::reflectance::diffusion::shares`]), where it is.
    pub spread: Option<[[f64; 3]; 3]>,
}

/// Light that passes through a leaf, equal in all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Transmitted {
    /// `∫ C_c T L dλ / ∫ C_c L dλ`.
    pub signals: [f64; 3],
    /// Share of it that the surface of the other side scatters.
    pub share: Arc<ScatteredShare>,
}

/// Signals of a surface under a whole uniform sky, in equal steps of cos θs from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct SkySignals {
    /// Of the diffuse component.
    pub diffuse: Vec<[f32; 3]>,
    /// Of the coherent component.
    pub coherent: Vec<[f32; 3]>,
}

/// Wavelengths for a table with errors below 1e-6 of the peak.
const COARSE_NODES: usize = 9;
/// Wavelengths for errors below 1e-9 of the peak.
const FINE_NODES: usize = 15;

impl SpectralWeights {
    /// Weighs wavelengths by `C_c S L (λ0/λ)^power / ∫ C_c L dλ`.
    ///
    /// `white_integrals` are the divisors, those of [`chromascope_color::camera::Rendering`]; `power` is the reading's
    /// ([`crate::reflectance::wavelength_power`]).
    pub fn new(
        sensor: &Sensor,
        light: &GridSpectrum,
        reflectance: &GridSpectrum,
        white_integrals: DVec3,
        power: i32,
    ) -> Self {
        let divisors = white_integrals.to_array();
        let mut dense = Vec::with_capacity(COUNT);
        for index in 0..COUNT {
            let nm = wavelength_nm(index);
            let ratio = LAMBDA_0_NM / nm;
            let product = reflectance.values()[index] * light.values()[index] * ratio.powi(power);
            let weights = [0, 1, 2].map(|c: usize| sensor.weighted(c)[index] * product / divisors[c]);
            dense.push(Node { wavelength_nm: nm, scale: ratio * ratio, weights, reference: 0.0 });
        }
        let unsigned = [0, 1, 2].map(|c: usize| dense.iter().map(|node| node.weights[c].abs()).sum::<f64>());
        for node in &mut dense {
            let share = |c: usize| if unsigned[c] > 0.0 { node.weights[c].abs() / unsigned[c] } else { 0.0 };
            node.reference = share(0) + share(1) + share(2);
        }
        let moments = [0, 1, 2].map(|c: usize| moments(&dense, c));
        dense.retain(|node| node.reference > 0.0);
        let coarse = nodes(&dense, COARSE_NODES);
        let fine = nodes(&dense, FINE_NODES);
        let totals = [0, 1, 2].map(|c: usize| dense.iter().map(|node| node.weights[c]).sum());
        Self {
            dense,
            coarse,
            fine,
            moments,
            totals,
            coherent_rules: OnceLock::new(),
            untinted: None,
            transmitted: None,
            sky: None,
            bounce: None,
            spread: None,
        }
    }

    /// The weights of the coherent component: those of a white, or its own.
    pub fn coherent(&self) -> &Self {
        self.untinted.as_deref().unwrap_or(self)
    }

    /// All wavelengths of the grid with any weight: the reference.
    pub fn dense(&self) -> &[Node] {
        &self.dense
    }

    /// The wavelengths that fill a table: errors below 1e-6 of the peak.
    pub fn coarse(&self) -> &[Node] {
        &self.coarse
    }

    /// The wavelengths for errors below 1e-9 of the peak.
    pub fn fine(&self) -> &[Node] {
        &self.fine
    }

    /// Wavelengths for all three channels, this many; fewer where the weights themselves are at fewer.
    pub fn shared(&self, count: usize) -> Vec<Node> {
        nodes(&self.dense, count)
    }

    /// `M_ck = Σ w_c (λ/λ0)^(2k+2)`: what is left of the spectrum where the surface is rough.
    pub fn moments(&self) -> &[[f64; MOMENTS]; 3] {
        &self.moments
    }

    /// `Σ w_c`: the integral for a surface that scatters all wavelengths alike.
    pub fn totals(&self) -> [f64; 3] {
        self.totals
    }

    /// Quadrature rules of these weights for the coherent component, computed at first use.
    pub fn coherent_rules(&self) -> &CoherentRules {
        self.coherent_rules.get_or_init(|| CoherentRules::new(&self.dense))
    }
}

fn moments(dense: &[Node], channel: usize) -> [f64; MOMENTS] {
    let mut sums = [0.0; MOMENTS];
    for node in dense {
        let mut term = node.weights[channel];
        for sum in &mut sums {
            term /= node.scale;
            *sum += term;
        }
    }
    sums
}

/// Gauss nodes of the positive measure, with interpolatory weights for each channel, whose own may be negative.
fn nodes(dense: &[Node], count: usize) -> Vec<Node> {
    let points: Vec<f64> = dense.iter().map(|node| node.wavelength_nm).collect();
    let masses: Vec<f64> = dense.iter().map(|node| node.reference).collect();
    let rule = gauss_rule(&points, &masses, count);
    let weights = [0, 1, 2].map(|c: usize| {
        let masses: Vec<f64> = dense.iter().map(|node| node.weights[c]).collect();
        interpolatory_rule(&rule.nodes, &points, &masses).weights
    });
    let node = |(i, (&nm, &reference)): (usize, (&f64, &f64))| Node {
        wavelength_nm: nm,
        scale: (LAMBDA_0_NM / nm).powi(2),
        weights: [weights[0][i], weights[1][i], weights[2][i]],
        reference,
    };
    rule.nodes.iter().zip(&rule.weights).enumerate().map(node).collect()
}
