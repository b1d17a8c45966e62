//! Which mirror terms are worth having, measured by the brightest sample of the picture.

use super::{Mirror, Place, Shade, Way};
use crate::reflectance::coherent::rho0_squared;
use crate::reflectance::power::LAMBDA_0_NM;
use crate::reflectance::{Precision, diffuse_sum};
use rayon::prelude::*;

/// So many of the lobes that may be highest are looked at.
const LOOKED_AT: usize = 32;
/// No picture is darker next to its lobes.
const LEAST_SCALE: f64 = -100.0;

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
    /// The brightest sample as a share of the highest lobe, a power of two not above 1.
    pub(super) scale: f64,
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
    /// Those above a share of the brightest sample. How bright that is at least is found at 550 nm: of the diffuse parts, and of
    /// the lobes that may be highest by `at_550_nm`.
    pub(super) fn worth_having(
        lobes: &[Lobe],
        shades: &[Shade],
        at_550_nm: impl Fn(&Lobe) -> f64 + Sync,
        share: f64,
    ) -> Self {
        if lobes.is_empty() {
            return Self { mirrors: Vec::new(), scale: 1.0 };
        }
        let mut highest: Vec<&Lobe> = lobes.iter().collect();
        let order = |a: &&Lobe, b: &&Lobe| b.most.total_cmp(&a.most).then(a.mirror.index.cmp(&b.mirror.index));
        if highest.len() > LOOKED_AT {
            highest.select_nth_unstable_by(LOOKED_AT, order);
            highest.truncate(LOOKED_AT);
        }
        let mirror = highest.par_iter().map(|lobe| at_550_nm(lobe)).reduce(|| 0.0, f64::max);
        let brightest = shades.par_iter().with_min_len(1024).map(diffuse).reduce(|| 0.0, f64::max).max(mirror);
        let threshold = share * brightest;
        let kept = || lobes.iter().filter(|lobe| lobe.most > threshold);
        let height = kept().map(|lobe| lobe.height).fold(0.0, f64::max);
        let ratio = if height > 0.0 { brightest / height } else { 1.0 };
        let scale = ratio.log2().floor().clamp(LEAST_SCALE, 0.0).exp2();
        Self { mirrors: kept().map(|lobe| lobe.mirror).collect(), scale }
    }
}

/// A sample's diffuse part at 550 nm.
fn diffuse(shade: &Shade) -> f64 {
    match shade.way {
        Way::Dark => 0.0,
        Way::Flat => shade.front,
        _ => shade.front * diffuse_sum(shade.kappa, shade.beta * shade.kappa, Precision::Coarse),
    }
}
