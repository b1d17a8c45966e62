//! Transmittance of a leaf from its reflectance: the generalized plate model (Allen, Gausman, Richardson and Thomas 1969; PROSPECT,
//! Jacquemoud and Baret 1990).
//!
//! A leaf is a pile of N plates of refractive index n that absorb. The inner transmittance θ of a plate is the only unknown; it is
//! the one for which the pile reflects what was measured, and then it says what the pile transmits.
//!
//! ```text
//! τ(α) = ∫_0^α T(θ) sin 2θ dθ / sin² α          Fresnel's transmittance of light within a cone (Stern 1964)
//! t12 = τ(90°), t21 = t12/n², r21 = 1 − t21;    into the first plate τ(40°)
//! t = τ t21 θ/(1 − r21² θ²),  r = 1 − τ + r21 θ t
//! ```
//! The N − 1 plates below the first by Stokes' formulas (1862), for N of any value. The reflection of the first face, 1 − τ(40°) =
//! 0.035, is taken to be left out of the measured reflectance, as under light from 45° seen from 0°.

use super::coherent::GAUSS;
use super::fresnel::transmittance;
use super::{Normalization, Surface, directional_hemispherical};
use rayon::prelude::*;

/// N: 1.5 plates, a typical leaf with palisade and spongy tissue (Jacquemoud and Baret 1990: 1.4 to 1.7 for dicotyledons).
const PLATES: f64 = 1.5;
/// n of the plates, PROSPECT's mean over the visible spectrum.
const INDEX: f64 = 1.45;
/// Half angle of the cone of incident light, in degrees: PROSPECT's.
const CONE_DEG: f64 = 40.0;

/// The plate model with Fresnel's transmittances of a plate's faces.
#[derive(Clone, Copy, Debug)]
pub struct LeafModel {
    cone: f64,
    diffuse: f64,
}

impl Default for LeafModel {
    fn default() -> Self {
        Self::new()
    }
}

impl LeafModel {
    /// 1.5 plates of index 1.45.
    pub fn new() -> Self {
        Self { cone: within_cone(CONE_DEG.to_radians()), diffuse: within_cone(std::f64::consts::FRAC_PI_2) }
    }

    /// Transmittance of a leaf of a reflectance, both hemispherical, from 0 to 1.
    ///
    /// The reflectance is without the mirror reflection of the surface. Where it is more than that of plates without absorption,
    /// their transmittance.
    ///
    /// ```
    /// use chromascope_core::reflectance::leaf::LeafModel;
    /// let [blue, green] = [0.01, 0.09].map(|reflectance| LeafModel::new().transmittance(reflectance));
    /// assert!(blue < 0.03 && (0.08..0.25).contains(&green));
    /// ```
    pub fn transmittance(&self, reflectance: f64) -> f64 {
        // The pile reflects the more, the more light its plates let through.
        let (mut dark, mut clear) = (0.0, 1.0);
        let whole = reflectance + 1.0 - self.cone;
        if reflectance.is_nan() || reflectance <= 0.0 {
            return 0.0;
        }
        if self.pile(clear)[0] <= whole {
            return self.pile(clear)[1];
        }
        for _ in 0..52 {
            let middle = f64::midpoint(dark, clear);
            *(if self.pile(middle)[0] < whole { &mut dark } else { &mut clear }) = middle;
        }
        self.pile(dark)[1]
    }

    /// Reflectance and transmittance of a plate whose first face lets this much in.
    fn plate(&self, first: f64, inner: f64) -> [f64; 2] {
        let out = self.diffuse / (INDEX * INDEX);
        let back = 1.0 - out;
        let through = first * out * inner / (1.0 - back * back * inner * inner);
        [1.0 - first + back * inner * through, through]
    }

    /// Reflectance and transmittance of the leaf whose plates have this inner transmittance.
    fn pile(&self, inner: f64) -> [f64; 2] {
        let [first_r, first_t] = self.plate(self.cone, inner);
        let [r, t] = self.plate(self.diffuse, inner);
        let [rest_r, rest_t] = stokes(r, t, PLATES - 1.0);
        let between = 1.0 - rest_r * r;
        [first_r + first_t * rest_r * t / between, first_t * rest_t / between]
    }
}

/// Share of the light that falls on a leaf that its rough surface scatters, by angle of incidence: the diffuse component's
/// directional-hemispherical reflectance of a white at 550 nm.
///
/// The model returns that share of R: the boundary takes some twice, and what would leave below the horizon is lost. T takes the
/// same share, so that the light a leaf lets through is to the light it returns as T is to R, whatever its surface.
#[derive(Clone, Debug, PartialEq)]
pub struct ScatteredShare {
    /// In equal steps of cos θi from 0 to 1.
    by_cosine: Vec<f64>,
    under_sky: f64,
}

impl ScatteredShare {
    /// Integrates over the hemisphere.
    pub fn new(surface: &Surface, reading: Normalization) -> Self {
        const STEPS: u32 = 32;
        let at = |step: u32| {
            let theta = (f64::from(step) / f64::from(STEPS)).acos();
            directional_hemispherical(surface, reading, theta).diffuse
        };
        let by_cosine: Vec<f64> = (0..=STEPS).into_par_iter().map(at).collect();
        // Irradiance from all directions alike goes with cos θ dω: 2 c dc.
        let moment = |step: usize| by_cosine[step] * step as f64 / f64::from(STEPS);
        let sum: f64 = (0..STEPS as usize).map(|step| moment(step) + moment(step + 1)).sum();
        let under_sky = sum / f64::from(STEPS);
        Self { by_cosine, under_sky }
    }

    /// Share of light from one direction above the horizon.
    pub fn at(&self, cos_i: f64) -> f64 {
        let last = self.by_cosine.len() - 1;
        let place = cos_i.clamp(0.0, 1.0) * last as f64;
        let low = (place as usize).min(last - 1);
        let t = place - low as f64;
        self.by_cosine[low] * (1.0 - t) + self.by_cosine[low + 1] * t
    }

    /// Share of light from all directions alike.
    pub fn under_sky(&self) -> f64 {
        self.under_sky
    }
}

/// Reflectance and transmittance of `count` plates, one of which has r and t.
fn stokes(r: f64, t: f64, count: f64) -> [f64; 2] {
    if t <= 0.0 {
        return [r, 0.0];
    }
    if r + t >= 1.0 - 1e-12 {
        let t = t / (t + (1.0 - t) * count);
        return [1.0 - t, t];
    }
    let root = ((1.0 + r + t) * (1.0 + r - t) * (1.0 - r + t) * (1.0 - r - t)).max(0.0).sqrt();
    let a = (1.0 + r * r - t * t + root) / (2.0 * r);
    let b = ((1.0 - r * r + t * t + root) / (2.0 * t)).powf(count);
    let divisor = a * a * b * b - 1.0;
    [a * (b * b - 1.0) / divisor, b * (a * a - 1.0) / divisor]
}

/// Mean transmittance of light that comes alike from all directions within a cone.
fn within_cone(angle: f64) -> f64 {
    const PANELS: u32 = 8;
    let half = 0.5 * angle / f64::from(PANELS);
    let at = |theta: f64| transmittance(theta.cos(), INDEX) * (2.0 * theta).sin();
    let panel = |panel: u32| {
        let middle = f64::from(2 * panel + 1) * half;
        GAUSS.iter().map(|&[x, weight]| weight * (at(middle - half * x) + at(middle + half * x))).sum::<f64>()
    };
    (0..PANELS).map(panel).sum::<f64>() * half / angle.sin().powi(2)
}
