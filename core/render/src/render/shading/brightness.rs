//! Brightness of a picture, for errors that are relative to something in it.

use super::sample::{DiffuseKind, Shade};
use crate::reflectance::{Precision, diffuse_sum};
use rayon::prelude::*;

/// Approximate number of samples examined.
const LOOKED_AT: usize = 1024;
/// No picture is darker, as a power of two, next to what it might be.
const LEAST_SCALE: f64 = -100.0;

/// Diffuse parts at 550 nm, of some samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Brightness {
    /// The largest, which the picture's is not below.
    pub(super) brightest: f64,
    pub(super) highest: f64,
}

impl Brightness {
    pub(super) fn of(shades: &[Shade]) -> Self {
        let stride = shades.len().div_ceil(LOOKED_AT).max(1);
        let looked_at = shades.par_iter().step_by(stride).filter(|shade| shade.kind == DiffuseKind::Spectral);
        let of = |shade: &Shade| {
            let at = |beta: f64| shade.front * diffuse_sum(shade.kappa, beta * shade.kappa, Precision::Coarse);
            [at(shade.beta), at(0.0)]
        };
        let [brightest, highest] = looked_at.map(of).reduce(|| [0.0; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])]);
        Self { brightest, highest }
    }
}

/// The brightest as a share of what might be, a power of two not above 1; 1 where there is nothing.
pub(super) fn scale(brightest: f64, highest: f64) -> f64 {
    if brightest > 0.0 && highest > 0.0 {
        (brightest / highest).log2().floor().clamp(LEAST_SCALE, 0.0).exp2()
    } else {
        1.0
    }
}
