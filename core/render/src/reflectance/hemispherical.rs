//! Hemispherical reflectance of the model: the share of parallel light that a surface returns, and what a viewer sees of it
//! under light from all directions alike.
//!
//! ```text
//! directional-hemispherical  ρ(θi) = ∫ f(θi → ωs) cos θs dωs,  f = P/π or the reading's f,  S(λ) = 1,  λ = 550 nm
//! hemispherical-directional  ρ(θs; λ) = ∫ f(ωi → θs) cos θi dωi
//! ```
//! Independent of the material, and the former at λ0 for all wavelengths where the surface is rough. In the plane of directions
//! projected onto the surface, `dA = cos θ dω`, the diffuse lobe is centered at the mirror direction: polar coordinates about it,
//! with panels that halve towards the center, follow lobes of any width. The two differ where the model is not reciprocal.

use super::coherent::GAUSS;
use super::geometry::Geometry;
use super::power::{LAMBDA_0_NM, coherent_prefactor, diffuse_prefactor, kappa, wavelength_power};
use super::sum::{Precision, diffuse_sum};
use super::surface::{Normalization, Surface};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// 2π/λ0, in 1/m.
const WAVE_NUMBER: f64 = TAU / (LAMBDA_0_NM * 1e-9);
/// Panels of half a turn around the specular direction.
const AZIMUTHS: u32 = 4;
/// Panels along a radius at most: correlation lengths up to 1 m.
const RADII: u32 = 32;

/// Shares of the light from one direction that the two components return.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HemisphericalReflectance {
    /// Of the diffuse component.
    pub diffuse: f64,
    /// Of the coherent (specular) component.
    pub coherent: f64,
}

impl HemisphericalReflectance {
    /// Sum of both components.
    pub fn total(self) -> f64 {
        self.diffuse + self.coherent
    }
}

/// Directional-hemispherical reflectance at 550 nm of light from the zenith angle `theta_i`, in radians; 0 at and below the
/// horizon.
///
/// The diffuse component by quadrature, relative error below 4e-3 up to 85°. The coherent one in the limit of a narrow lobe,
/// `X cos θi ≫ λ`: `A/(4XY) e^-g`, times F(θi) under [`super::Specular::Fresnel`]. Under [`Normalization::Paper`] P is no reflectance, and this is the
/// share that Eq 12 makes of it by putting P where π f belongs.
///
/// ```
/// use chromascope_core::reflectance::{Normalization, Surface, directional_hemispherical};
/// let skin = Surface::new(5e-6, 10e-6, 50e-6, 50e-6, 1.4)?;
/// let returned = |degrees: f64| directional_hemispherical(&skin, Normalization::Radiometric, degrees.to_radians()).total();
/// assert!((returned(0.0) - 0.488).abs() < 1e-3 && (returned(85.0) - 0.034).abs() < 1e-3);
/// # Ok::<(), chromascope_core::reflectance::SurfaceError>(())
/// ```
pub fn directional_hemispherical(surface: &Surface, reading: Normalization, theta_i: f64) -> HemisphericalReflectance {
    let (sin_i, cos_i) = theta_i.sin_cos();
    if cos_i <= 0.0 || cos_i.is_nan() {
        return HemisphericalReflectance::default();
    }
    if reading == Normalization::Lambertian {
        return HemisphericalReflectance { diffuse: 1.0, coherent: 0.0 };
    }
    let view = View { surface, reading, sin_i, cos_i, ratio: 1.0, is_viewer: false };
    HemisphericalReflectance { diffuse: view.diffuse(), coherent: view.coherent() }
}

/// Hemispherical-directional reflectance at a wavelength in nanometers: the radiance that a viewer at the zenith angle `theta_s`, in
/// radians, sees of a white of this surface under light from all directions alike, over that of a perfect diffuser; 0 at and below
/// the horizon.
///
/// As accurate as [`directional_hemispherical`], the coherent component in the same limit of a narrow lobe.
pub fn hemispherical_directional(
    surface: &Surface,
    reading: Normalization,
    theta_s: f64,
    wavelength_nm: f64,
) -> HemisphericalReflectance {
    let (sin_i, cos_i) = theta_s.sin_cos();
    let ratio = LAMBDA_0_NM / wavelength_nm;
    if !(cos_i > 0.0 && ratio > 0.0 && ratio.is_finite()) {
        return HemisphericalReflectance::default();
    }
    if reading == Normalization::Lambertian {
        return HemisphericalReflectance { diffuse: 1.0, coherent: 0.0 };
    }
    let view = View { surface, reading, sin_i, cos_i, ratio, is_viewer: true };
    HemisphericalReflectance { diffuse: view.diffuse(), coherent: view.coherent() }
}

/// The coherent component of [`hemispherical_directional`] alone.
pub fn coherent_hemispherical(surface: &Surface, reading: Normalization, theta_s: f64, wavelength_nm: f64) -> f64 {
    let (sin_i, cos_i) = theta_s.sin_cos();
    let ratio = LAMBDA_0_NM / wavelength_nm;
    if !(cos_i > 0.0 && ratio > 0.0 && ratio.is_finite()) || reading == Normalization::Lambertian {
        return 0.0;
    }
    View { surface, reading, sin_i, cos_i, ratio, is_viewer: true }.coherent()
}

/// One direction, of the light or of the viewer; the others are integrated over.
struct View<'a> {
    surface: &'a Surface,
    reading: Normalization,
    sin_i: f64,
    cos_i: f64,
    /// λ0/λ.
    ratio: f64,
    is_viewer: bool,
}

impl View<'_> {
    fn diffuse(&self) -> f64 {
        if self.sin_i == 0.0 {
            // All azimuths are alike.
            return TAU * self.along(1.0) / PI;
        }
        let step = PI / f64::from(AZIMUTHS);
        let panels = (0..AZIMUTHS).map(|panel| {
            let middle = (f64::from(panel) + 0.5) * step;
            gauss(|x| self.along((middle + 0.5 * step * x).cos())) * 0.5 * step
        });
        // Symmetric about the plane of incidence.
        2.0 * panels.sum::<f64>() / PI
    }

    /// `∫ π f r dr` from the specular direction to the horizon, in the direction of one azimuth's cosine.
    fn along(&self, cos_psi: f64) -> f64 {
        let towards = self.sin_i * cos_psi;
        let root = self.cos_i.hypot(towards);
        // |s0 − r u| = 1, in the form that does not cancel.
        let end = if towards >= 0.0 { towards + root } else { self.cos_i * self.cos_i / (root - towards) };
        // The narrowest lobe, e^-b, falls to e^-1/4 here.
        let narrow = 1.0 / (self.wave_number() * self.surface.tau_m());
        let at = |r: f64| self.integrand(r, end, towards) * r;
        let (mut upper, mut sum) = (end, 0.0);
        for panel in 0..RADII {
            let lower = if upper <= narrow || panel + 1 == RADII { 0.0 } else { upper / 2.0 };
            let width = upper - lower;
            sum += if panel == 0 {
                // cos θs goes with the root of the distance to the horizon.
                gauss(|x| {
                    let u = 0.5 * (1.0 + x);
                    at(upper - width * u * u) * u
                }) * width
            } else {
                gauss(|x| at(lower + 0.5 * width * (1.0 + x))) * 0.5 * width
            };
            if lower == 0.0 {
                break;
            }
            upper = lower;
        }
        sum
    }

    /// π f at a distance from the specular direction, of which `end` is on the horizon.
    fn integrand(&self, r: f64, end: f64, towards: f64) -> f64 {
        // cos² θs = (end − r)(r − other end), the ends' sum being 2 `towards`.
        let cos_s = ((end - r) * (r + end - 2.0 * towards)).max(0.0).sqrt();
        let vz_by_k = self.cos_i + cos_s;
        let vxy2_by_k2 = r * r;
        let cos_half2 = ((vxy2_by_k2 + vz_by_k * vz_by_k) / 4.0).min(1.0);
        let [cos_i, cos_s] = if self.is_viewer { [cos_s, self.cos_i] } else { [self.cos_i, cos_s] };
        let (vx_by_k, vy_by_k) = (r, 0.0);
        let geometry = Geometry { cos_i, cos_s, vx_by_k, vy_by_k, vxy2_by_k2, vz_by_k, cos_half2 };
        let reach = self.wave_number() * self.surface.tau_m() * r;
        let g = kappa(self.surface, &geometry) * self.ratio * self.ratio;
        let sum = diffuse_sum(g, reach * reach / 4.0, Precision::Coarse);
        self.power() * diffuse_prefactor(self.surface, &geometry, self.reading) * sum
    }

    fn wave_number(&self) -> f64 {
        WAVE_NUMBER * self.ratio
    }

    /// The power of λ0/λ that the normalization carries.
    fn power(&self) -> f64 {
        self.ratio.powi(wavelength_power(self.reading))
    }

    fn coherent(&self) -> f64 {
        let theta = self.sin_i.atan2(self.cos_i).clamp(-FRAC_PI_2, FRAC_PI_2);
        let mirrored = Geometry::from_angles(theta, theta, 0.0);
        // ∫ ρ0² dA = λ²/(4XY).
        let wavelength_m = LAMBDA_0_NM * 1e-9 / self.ratio;
        let lobe = wavelength_m * wavelength_m / (4.0 * self.surface.half_x_m() * self.surface.half_y_m());
        let g = kappa(self.surface, &mirrored) * self.ratio * self.ratio;
        self.power() * coherent_prefactor(self.surface, &mirrored, self.reading) * lobe / PI * (-g).exp()
    }
}

/// `∫ f(x) dx` from −1 to 1 by the eight-point Gauss–Legendre rule.
fn gauss(f: impl Fn(f64) -> f64) -> f64 {
    GAUSS.iter().map(|&[node, weight]| weight * (f(-node) + f(node))).sum()
}
