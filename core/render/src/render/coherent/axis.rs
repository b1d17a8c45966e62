//! Diffraction along one axis of the coherently illuminated area, averaged over the light's disk, at many wavelengths together.
//!
//! ```text
//! M(u, w) = mean of sinc² over [u − w, u + w] = (H(u + w) − H(u − w)) / 2w,  u = kP,  w = kW
//! H(u) = Si(2u) − sin²u/u = ±π/2 − 1/2u + T(u)
//! ```
//! P is the path, half-width times |v|/k, and W half-width times the light's angular radius. Without T, which oscillates, M is
//! smooth in wavelength: `1/2ab` with `a = u − w`, `b = u + w`, and `π/2w` more where the disk holds the specular direction.

use super::antiderivative;
use super::rules::{LANES, Rule};
use crate::reflectance::coherent::mean_sinc_squared;
use chromascope_math::exp::{ROUNDER, exp};
use multiversion::multiversion;
use std::f64::consts::{FRAC_1_PI, PI};

/// Path and spread of one axis, in meters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    /// Half-width times |v|/k.
    pub(super) path: f64,
    /// Half-width times the light's angular radius.
    pub(super) spread: f64,
}

/// Evaluation of M, the same for all wavelengths of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Form {
    /// Its smooth part alone.
    Smooth { inside: bool },
    /// sinc² u.
    Point,
    /// Three-point Gauss rule over the disk, w ≤ 0.15: error 3e-8 of the envelope.
    Narrow,
    /// Six-point Gauss rule, w ≤ 1: error 3e-9 of the envelope.
    Wide,
    /// Asymptotic series of T, |u − w| ≥ 16: error 1e-9 of T.
    Far { inside: bool },
    /// Table of H.
    Tabulated,
    /// Sine integrals.
    Exact,
}

/// Nodes that share a buffer.
const TOGETHER: usize = 64;
/// Smaller disks are points: M and sinc² differ by w²/6 at most.
const POINT: f64 = 1e-7;
/// Widest disks, in w, of the two Gauss rules.
const NARROW: f64 = 0.15;
const WIDE: f64 = 1.0;
/// |u − w| from which the asymptotic series is taken, and from which the smooth part stands alone.
const FAR: f64 = 16.0;
const SMOOTH: f64 = 4.0;
/// Largest argument whose reduction by multiples of π is exact.
const LARGEST: f64 = 1e6;

impl Axis {
    /// Bounds over the band between two wave numbers, the smaller first.
    pub(super) fn bounds(self, [red, _]: [f64; 2]) -> Bounds {
        let (near, far, w) = ((self.path - self.spread) * red, (self.path + self.spread) * red, self.spread * red);
        let disk = if w > PI / 2.0 { PI / (2.0 * w) } else { 1.0 };
        let largest = if near > 1.0 { disk.min(1.0 / (near * near)) } else { disk };
        if near.abs() < SMOOTH {
            return Bounds { largest, smooth: largest, oscillation: f64::INFINITY };
        }
        let (near2, far2) = (near * near, far * far);
        let oscillation = if w > 0.0 { (1.0 / near2 + 1.0 / far2) / (6.0 * w) } else { f64::INFINITY };
        let oscillation = if near > 0.0 { oscillation.min(0.5 / near2) } else { oscillation };
        let smooth = if near > 0.0 { 0.5 / (near * far) } else { disk };
        Bounds { largest, smooth, oscillation }
    }

    pub(super) fn form(self, [red, blue]: [f64; 2], precise: bool) -> Form {
        let (near, far) = (self.path - self.spread, self.path + self.spread);
        let inside = near < 0.0;
        if far * blue > LARGEST || far.is_nan() {
            Form::Exact
        } else if self.spread * blue < POINT {
            Form::Point
        } else if precise {
            Form::Exact
        } else if self.spread * blue <= NARROW {
            Form::Narrow
        } else if near.abs() * red >= FAR {
            Form::Far { inside }
        } else if self.spread * blue <= WIDE {
            Form::Wide
        } else if far * blue < antiderivative::LAST {
            Form::Tabulated
        } else {
            Form::Exact
        }
    }

    /// Without oscillation.
    pub(super) fn smooth(self) -> Form {
        Form::Smooth { inside: self.path < self.spread }
    }
}

/// Largest values over the band.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// Of M.
    pub(super) largest: f64,
    /// Of its smooth part.
    pub(super) smooth: f64,
    /// Of the rest, infinite where there is no such decomposition.
    pub(super) oscillation: f64,
}

/// `Σ w M_x M_y e^-g` of the three channels.
///
/// Compiled for several instruction sets, the best chosen at run time; no operation is fused, so all of them give the same bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
pub(super) fn sum(rule: &Rule, axes: &[(Axis, Form); 2], kappa: f64) -> [f64; 3] {
    sum_portable(rule, axes, kappa)
}

#[inline(always)]
fn sum_portable(rule: &Rule, axes: &[(Axis, Form); 2], kappa: f64) -> [f64; 3] {
    let mut sums = [[0.0; LANES]; 3];
    let mut buffer = [0.0; TOGETHER];
    for first in (0..rule.wave_numbers.len()).step_by(TOGETHER) {
        let range = first..rule.wave_numbers.len().min(first + TOGETHER);
        let (wave_numbers, scales) = (&rule.wave_numbers[range.clone()], &rule.scales[range.clone()]);
        let values = &mut buffer[..range.len()];
        for (value, scale) in values.iter_mut().zip(scales) {
            *value = exp(-kappa * scale);
        }
        for &(axis, form) in axes {
            multiply(axis, form, wave_numbers, values);
        }
        for (sums, weights) in sums.iter_mut().zip(&rule.weights) {
            for (weights, values) in weights[range.clone()].chunks_exact(LANES).zip(values.chunks_exact(LANES)) {
                for lane in 0..LANES {
                    sums[lane] += weights[lane] * values[lane];
                }
            }
        }
    }
    sums.map(|s| ((s[0] + s[4]) + (s[1] + s[5])) + ((s[2] + s[6]) + (s[3] + s[7])))
}

/// Multiplies values at wave numbers by M. Loops are written out: not every closure would be compiled into its caller.
#[inline(always)]
fn multiply(axis: Axis, form: Form, wave_numbers: &[f64], values: &mut [f64]) {
    let Axis { path, spread } = axis;
    let pairs = values.iter_mut().zip(wave_numbers);
    match form {
        Form::Smooth { inside } => {
            for (value, k) in pairs {
                *value *= smooth_mean(k * path, k * spread, inside);
            }
        }
        Form::Point => {
            for (value, k) in pairs {
                *value *= squared_ratio(sin_cos_of_half_turn(k * path).0, k * path);
            }
        }
        Form::Narrow => {
            for (value, k) in pairs {
                *value *= narrow_mean(k * path, k * spread);
            }
        }
        Form::Wide => {
            for (value, k) in pairs {
                *value *= wide_mean(k * path, k * spread);
            }
        }
        Form::Far { inside } => {
            for (value, k) in pairs {
                *value *= far_mean(k * path, k * spread, inside);
            }
        }
        Form::Tabulated => {
            for (value, k) in pairs {
                let (u, w) = (k * path, k * spread);
                *value *= (antiderivative::at(u + w) - antiderivative::at(u - w)) * (0.5 / w);
            }
        }
        Form::Exact => {
            for (value, k) in pairs {
                *value *= mean_sinc_squared(k * path, k * spread);
            }
        }
    }
}

#[inline(always)]
fn smooth_mean(u: f64, w: f64, inside: bool) -> f64 {
    let outside = 0.5 / ((u - w) * (u + w));
    if inside { outside + PI / (2.0 * w) } else { outside }
}

#[inline(always)]
fn far_mean(u: f64, w: f64, inside: bool) -> f64 {
    smooth_mean(u, w, inside) + (far_term(u + w) - far_term(u - w)) * (0.5 / w)
}

/// `T(u) = (1/x − f(x)) cos x − g(x) sin x` at x = 2u, f and g the auxiliary functions of the sine integral by their asymptotic
/// series (DLMF 6.12).
#[inline(always)]
fn far_term(u: f64) -> f64 {
    let inverse = 0.5 / u;
    let y = inverse * inverse;
    let even = y * (2.0 + y * (-24.0 + y * (720.0 + y * (-40320.0 + y * 3_628_800.0))));
    let odd = 1.0 + y * (-6.0 + y * (120.0 + y * (-5040.0 + y * (362_880.0 + y * -39_916_800.0))));
    let (sin, cos) = sin_cos_of_half_turn(u);
    inverse * (even * (cos * cos - sin * sin) - inverse * odd * (2.0 * sin * cos))
}

/// Three-point Gauss–Legendre rule over the disk.
#[inline(always)]
fn narrow_mean(u: f64, w: f64) -> f64 {
    let (sin, cos) = sin_cos_of_half_turn(u);
    (squared_ratio(sin, u) * 8.0 + pair(u, sin, cos, w * 0.774_596_669_241_483_4) * 5.0) * (1.0 / 18.0)
}

/// Six-point Gauss–Legendre rule over the disk.
#[inline(always)]
fn wide_mean(u: f64, w: f64) -> f64 {
    let (sin, cos) = sin_cos_of_half_turn(u);
    let inner = pair(u, sin, cos, w * 0.238_619_186_083_196_9) * 0.233_956_967_286_345_5;
    let middle = pair(u, sin, cos, w * 0.661_209_386_466_264_5) * 0.180_380_786_524_069_3;
    let outer = pair(u, sin, cos, w * 0.932_469_514_203_152) * 0.085_662_246_189_585_18;
    inner + middle + outer
}

/// sinc² at two sides of an angle of which sine and cosine are known, no further than 1 away.
#[inline(always)]
fn pair(u: f64, sin: f64, cos: f64, offset: f64) -> f64 {
    let y = offset * offset;
    let [a, b, c, d, e, f, g, h, ..] = SINE;
    let small_sin = offset * (a + y * (b + y * (c + y * (d + y * (e + y * (f + y * (g + y * h)))))));
    let [a, b, c, d, e, f, g, h, i, ..] = COSINE;
    let small_cos = a + y * (b + y * (c + y * (d + y * (e + y * (f + y * (g + y * (h + y * i)))))));
    let (apart, along) = (cos * small_sin, sin * small_cos);
    squared_ratio(along - apart, u - offset) + squared_ratio(along + apart, u + offset)
}

/// sinc² of an angle, given its sine.
#[inline(always)]
fn squared_ratio(sin: f64, angle: f64) -> f64 {
    // Next to 0 the sine may have lost its digits; there sinc² is 1 − angle²/3.
    let near = angle.abs() < 1e-5;
    let ratio = if near { 1.0 } else { sin } / if near { 1.0 } else { angle };
    if near { 1.0 - angle * angle * (1.0 / 3.0) } else { ratio * ratio }
}

/// π in three parts, the first two short enough for exact products with integers below 2²⁰.
const PI_PARTS: [f64; 3] = [3.141_592_653_468_251_2, 1.215_420_101_260_793_2e-10, 4.044_532_497_591_901e-21];

/// Sine and cosine of an angle less the nearest multiple of π, by powers: those of the angle but for a sign that both share.
#[inline(always)]
fn sin_cos_of_half_turn(angle: f64) -> (f64, f64) {
    let n = (angle * FRAC_1_PI + ROUNDER) - ROUNDER;
    let r = ((angle - n * PI_PARTS[0]) - n * PI_PARTS[1]) - n * PI_PARTS[2];
    let y = r * r;
    (r * polynomial(&SINE, y), polynomial(&COSINE, y))
}

/// In pairs of pairs, so that operations wait less for each other (Estrin 1960).
#[inline(always)]
fn polynomial(c: &[f64; 12], y: f64) -> f64 {
    let (y2, y4) = (y * y, (y * y) * (y * y));
    let low = (c[0] + y * c[1]) + y2 * (c[2] + y * c[3]);
    let middle = (c[4] + y * c[5]) + y2 * (c[6] + y * c[7]);
    let high = (c[8] + y * c[9]) + y2 * (c[10] + y * c[11]);
    low + y4 * (middle + y4 * high)
}

const SINE: [f64; 12] = alternating_inverse_factorials(1);
const COSINE: [f64; 12] = alternating_inverse_factorials(0);

/// `(−1)^k / (2k + first)!`.
const fn alternating_inverse_factorials(first: usize) -> [f64; 12] {
    let (mut values, mut k, mut value) = ([0.0; 12], 0, 1.0);
    while k < 12 {
        values[k] = value;
        let next = (2 * k + first + 1) as f64;
        value = -value / (next * (next + 1.0));
        k += 1;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    const BAND: [f64; 2] = [8.0e6, 16.6e6];

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let node = |nm: f64| crate::render::measure::Node {
            wavelength_nm: nm,
            scale: (550.0 / nm).powi(2),
            weights: [0.3, 0.1, -0.2],
            reference: 0.6,
        };
        let dense: Vec<_> = (0..40).map(|i| node(400.0 + 8.0 * f64::from(i))).collect();
        let rules = super::super::rules::CoherentRules::new(&dense);
        let grid = rules.smallest(&dense, 1.0, 0.0, 1e-9);
        for i in 0..200 {
            let axes =
                [1.07_f64, 1.11].map(|step| Axis { path: 1e-9 * step.powi(i), spread: 0.02e-6 * step.powi(i % 50) });
            let axes = axes.map(|axis| (axis, axis.form(BAND, false)));
            assert_eq!(sum(grid, &axes, 0.7), sum_portable(grid, &axes, 0.7));
        }
    }
}
