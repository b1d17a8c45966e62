//! Which mirror terms are worth having, measured by the brightest sample of the picture.

use super::brightness::{self, Brightness};
use super::{Mirror, Place};
use crate::reflectance::coherent::rho0_squared;
use crate::reflectance::power::LAMBDA_0_NM;
use rayon::prelude::*;

/// So many of the lobes that may be highest are looked at.
const LOOKED_AT: usize = 32;

/// A sample's mirror term, with what it does not exceed.
#[derive(Clone, Debug)]
pub(super) struct Lobe {
    pub(super) mirror: Mirror,
    /// What the middle of its lobe does not exceed.
    pub(super) height: f64,
    /// What it does not exceed itself.
    pub(super) most: f64,
}

/// The mirror terms of a picture.
pub(super) struct Lobes {
    /// Ascending.
    pub(super) mirrors: Vec<Mirror>,
    /// The brightest sample as a share of the highest lobe and of the highest diffuse part, powers of two not above 1.
    pub(super) scale: f64,
    pub(super) diffuse_scale: f64,
}

impl Lobe {
    /// What it is at 550 nm.
    pub(super) fn at_550_nm(&self, place: &Place, angular_radius: f64) -> f64 {
        let wave_number = std::f64::consts::TAU / (LAMBDA_0_NM * 1e-9);
        let lobe = rho0_squared(&place.geometry, &place.surface, wave_number, angular_radius);
        self.mirror.front * lobe * (-self.mirror.kappa).exp()
    }
}

impl Lobes {
    /// Those above a share of the brightest sample. How bright that is at least is found at 550 nm: of some diffuse parts, and of
    /// the lobes that may be highest by `at_550_nm`. Beside lobes, diffuse parts count with a reflectance of `darkest`.
    pub(super) fn worth_having(
        lobes: &[Lobe],
        diffuse: Brightness,
        darkest: f64,
        at_550_nm: impl Fn(&Lobe) -> f64 + Sync,
        share: f64,
    ) -> Self {
        // The others make nothing brighter.
        let mut highest: Vec<&Lobe> = lobes.iter().filter(|lobe| lobe.most > darkest * diffuse.brightest).collect();
        let order = |a: &&Lobe, b: &&Lobe| b.most.total_cmp(&a.most).then(a.mirror.index.cmp(&b.mirror.index));
        if highest.len() > LOOKED_AT {
            highest.select_nth_unstable_by(LOOKED_AT, order);
            highest.truncate(LOOKED_AT);
        }
        let mirror = highest.par_iter().map(|lobe| at_550_nm(lobe)).reduce(|| 0.0, f64::max);
        let brightest = (darkest * diffuse.brightest).max(mirror);
        let threshold = share * brightest;
        let kept = || lobes.iter().filter(|lobe| lobe.most > threshold);
        let height = kept().map(|lobe| lobe.height).fold(0.0, f64::max);
        Self {
            mirrors: kept().map(|lobe| lobe.mirror).collect(),
            scale: brightness::scale(brightest, height),
            // A darker material makes this larger.
            diffuse_scale: brightness::scale(diffuse.brightest.max(mirror), diffuse.highest),
        }
    }
}
