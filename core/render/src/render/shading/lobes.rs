//! Coherent terms that count next to the brightest sample of the picture.

use super::brightness::{self, Brightness};
use super::sample::{CoherentSample, Place};
use crate::reflectance::coherent::rho0_squared;
use crate::reflectance::power::LAMBDA_0_NM;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Number of the highest lobes that are evaluated.
const LOOKED_AT: usize = 32;
/// Wavelengths of a lobe's brightness: first, step and number.
const FIRST_NM: f64 = 463.0;
const STEP_NM: f64 = 11.3;
const WAVELENGTHS: u32 = 16;

/// A sample's coherent component, with an upper bound.
#[derive(Clone, Debug)]
pub(super) struct Lobe {
    pub(super) coherent: CoherentSample,
    /// Upper bound of the term.
    pub(super) most: f64,
}

/// The coherent components of a picture.
pub(super) struct Lobes {
    /// Ascending.
    pub(super) coherent_samples: Vec<CoherentSample>,
    /// Estimate from below of the brightest sample.
    pub(super) brightness: f64,
    /// The brightest sample as a share of the highest diffuse part, a power of two not above 1.
    pub(super) diffuse_scale: f64,
}

impl Lobe {
    /// Mean over some wavelengths about 550 nm: at a single one the interference may have its crest.
    pub(super) fn brightness(&self, place: &Place, angular_radius: f64) -> f64 {
        let at = |nm: f64| {
            let ratio = LAMBDA_0_NM / nm;
            let pattern = rho0_squared(&place.geometry, &place.surface, TAU / (nm * 1e-9), angular_radius);
            pattern * (-self.coherent.kappa * ratio * ratio).exp()
        };
        let sum: f64 = (0..WAVELENGTHS).map(|i| at(FIRST_NM + STEP_NM * f64::from(i))).sum();
        self.coherent.front * sum / f64::from(WAVELENGTHS)
    }
}

impl Lobes {
    /// Those above a share of the brightest sample. How bright that is at least is found of some diffuse parts, and of the lobes that
    /// may be highest by `brightness`. Beside lobes, diffuse parts count with a reflectance of `darkest`.
    pub(super) fn worth_having(
        lobes: &[Lobe],
        diffuse: Brightness,
        darkest: f64,
        brightness: impl Fn(&Lobe) -> f64 + Sync,
        share: f64,
    ) -> Self {
        // The others make nothing brighter.
        let mut highest: Vec<&Lobe> = lobes.iter().filter(|lobe| lobe.most > darkest * diffuse.brightest).collect();
        let order = |a: &&Lobe, b: &&Lobe| b.most.total_cmp(&a.most).then(a.coherent.index.cmp(&b.coherent.index));
        if highest.len() > LOOKED_AT {
            highest.select_nth_unstable_by(LOOKED_AT, order);
            highest.truncate(LOOKED_AT);
        }
        let coherent = highest.par_iter().map(|lobe| brightness(lobe)).reduce(|| 0.0, f64::max);
        let brightest = (darkest * diffuse.brightest).max(coherent);
        let threshold = share * brightest;
        Self {
            coherent_samples: lobes.iter().filter(|lobe| lobe.most > threshold).map(|lobe| lobe.coherent).collect(),
            brightness: brightest,
            // A darker material makes this larger.
            diffuse_scale: brightness::scale(diffuse.brightest.max(coherent), diffuse.highest),
        }
    }
}
