//! Spectral integral of the coherent (specular) component: `front Σ w ρ0² e^-g`, ρ0² averaged over the light's disk.
//!
//! ρ0² is a product of one factor along each axis of the illuminated area, and each is a smooth part and interference that
//! oscillates in 1/λ, the faster the longer its path. A sample takes the cheapest sum that keeps a tolerance:
//!
//! | where | wavelengths |
//! |---|---|
//! | a bound on all of it is within the tolerance | none |
//! | the camera's band averages an axis' interference out | few, of the smooth part |
//! | elsewhere | Chebyshev nodes, the more the longer the path; beyond 208 the whole grid |
//!
//! The tolerance is relative to the picture's brightest sample: one that is a thousand times darker takes a thousand times the
//! error.

mod antiderivative;
mod axis;
pub(super) mod rules;

use super::measure::SpectralWeights;
use super::shading::{CoherentSample, Quality, ShadingImage};
use crate::reflectance::Surface;
use crate::reflectance::coherent::mean_sinc_squared;
use axis::{Axis, Form};
use chromascope_color::spectral::grid::LAST_NM;
use chromascope_math::exp::exp;
use std::f64::consts::TAU;

pub use rules::CoherentRules;

/// Integrals of one camera's coherent component over a picture.
#[derive(Clone, Copy, Debug)]
pub struct CoherentIntegral<'a> {
    measure: &'a SpectralWeights,
    rules: &'a CoherentRules,
    half_widths_m: [f64; 2],
    angular_radius: f64,
    /// Error in units of `Σ|w|`; 0 for the sum over the grid.
    tolerance: f64,
}

/// Work of one sample.
struct Method<'a> {
    rule: &'a rules::Rule,
    axes: [(Axis, Form); 2],
}

/// Sharper tolerances than this share of a sample's bound take sine integrals.
const PRECISE: f64 = 1e-7;

impl<'a> CoherentIntegral<'a> {
    /// For samples of a surface under a light of an angular radius in radians, with an absolute error below `tolerance Σ|w|`, the
    /// largest of the three channels; 0 sums over all wavelengths of the grid.
    pub fn new(measure: &'a SpectralWeights, surface: &Surface, angular_radius: f64, tolerance: f64) -> Self {
        let measure = measure.coherent();
        let half_widths_m = [surface.half_x_m(), surface.half_y_m()];
        Self { measure, rules: measure.coherent_rules(), half_widths_m, angular_radius, tolerance }
    }

    /// For the samples of a picture, at its quality.
    pub fn in_picture(shading: &ShadingImage, measure: &'a SpectralWeights) -> Self {
        let tolerance = match shading.quality() {
            Quality::Reference | Quality::Regimes => 0.0,
            quality => quality.coherent_tolerance() * shading.brightness(),
        };
        Self::new(measure, shading.surface(), shading.geometry().angular_radius(), tolerance)
    }

    /// The three channels' integrals of a sample.
    pub fn at(&self, coherent: &CoherentSample) -> [f64; 3] {
        if self.tolerance <= 0.0 {
            return self.over_grid(coherent);
        }
        match self.method(coherent) {
            Some(Method { rule, axes }) => axis::sum(rule, &axes, coherent.kappa).map(|sum| coherent.front * sum),
            None => [0.0; 3],
        }
    }

    /// Wavelengths that a sample is evaluated at.
    pub fn evaluations(&self, coherent: &CoherentSample) -> usize {
        if self.tolerance <= 0.0 {
            return self.measure.dense().len();
        }
        self.method(coherent).map_or(0, |method| method.rule.count)
    }

    /// None where the whole component is within the tolerance.
    fn method(&self, coherent: &CoherentSample) -> Option<Method<'a>> {
        let (dense, band) = (self.measure.dense(), self.rules.wave_numbers());
        // Averaging either axis and the rule have a third each.
        let share = self.tolerance / (3.0 * coherent.front);
        let damping = exp(-coherent.kappa * REDDEST);
        let axes = self.axes(coherent);
        let [x, y] = axes.map(|axis| axis.bounds(band));
        let largest = x.largest * y.largest * damping;
        if largest <= share || !largest.is_finite() {
            return None;
        }
        // The longer path is averaged first, the shorter one beside it still oscillates.
        let order = if axes[0].path <= axes[1].path { [0, 1] } else { [1, 0] };
        let (short, long) = (axes[order[0]], axes[order[1]]);
        let (of_short, of_long) = if order[0] == 0 { (x, y) } else { (y, x) };
        let reach = short.path + short.spread;
        let fades = |bound: f64, from: f64, to: f64| {
            bound * damping <= share
                || (from > 0.0 && bound * self.rules.fade().largest(coherent.kappa, from, to) <= share)
        };
        let nearest = long.path - long.spread - reach;
        let long_smooth = fades(of_short.largest * of_long.oscillation, nearest, long.path + long.spread + reach);
        let short_smooth =
            long_smooth && fades(of_short.oscillation * of_long.smooth, short.path - short.spread, reach);
        let smooth = if order[0] == 0 { [short_smooth, long_smooth] } else { [long_smooth, short_smooth] };
        let path = |i: usize| if smooth[i] { 0.0 } else { axes[i].path + axes[i].spread };
        let rule = self.rules.smallest(dense, path(0) + path(1), coherent.kappa, share / largest);
        let precise = share < PRECISE * largest;
        let form = |i: usize| if smooth[i] { axes[i].smooth() } else { axes[i].form(band, precise) };
        Some(Method { rule, axes: [(axes[0], form(0)), (axes[1], form(1))] })
    }

    fn axes(&self, coherent: &CoherentSample) -> [Axis; 2] {
        let axis = |i: usize| Axis {
            path: self.half_widths_m[i] * coherent.v[i].abs(),
            spread: self.half_widths_m[i] * self.angular_radius,
        };
        [axis(0), axis(1)]
    }

    fn over_grid(&self, coherent: &CoherentSample) -> [f64; 3] {
        let mut channels = [0.0; 3];
        for node in self.measure.dense() {
            let wave_number = TAU / (node.wavelength_nm * 1e-9);
            let [x, y] = self.axes(coherent).map(|a| mean_sinc_squared(wave_number * a.path, wave_number * a.spread));
            let value = coherent.front * (x * y) * exp(-coherent.kappa * node.scale);
            for (channel, weight) in channels.iter_mut().zip(node.weights) {
                *channel += weight * value;
            }
        }
        channels
    }
}

/// (λ0/λ)² at the red end of the grid, where e^-g is largest.
const REDDEST: f64 = (super::measure::LAMBDA_0_NM / LAST_NM) * (super::measure::LAMBDA_0_NM / LAST_NM);
