//! The scattered power of Eq 12, whole and in the parts that a renderer keeps apart.
//!
//! ```text
//! factor(λ) = diffuse_prefactor · (λ0/λ)^p · S(g, βg)  +  coherent_prefactor · (λ0/λ)^p · ρ0² e^-g
//! g = κ (λ0/λ)²,  λ0 = 550 nm
//! ```
//! Neither prefactor contains a wavelength; κ and β neither wavelength, index nor patch. Nothing is divided by cos θs, so that
//! grazing views stay finite.

use super::coherent::rho0_squared;
use super::fresnel::{reflectance, transmittance, transmittance_by_cosine};
use super::geometry::Geometry;
use super::sum::{Precision, diffuse_sum};
use super::surface::{Normalization, Specular, Surface};
use std::f64::consts::{PI, TAU};

/// λ0, in nanometers: κ is g at this wavelength.
pub const LAMBDA_0_NM: f64 = 550.0;
/// λ0 in meters.
const LAMBDA_0_M: f64 = 550e-9;
/// Limit at which unbounded values are cut: a thousandth of what a product of two parts could carry.
const LARGEST: f64 = 1e150;

/// Sum of the two components of [`factors`]: the factor beside S(λ) in Eq 12 where both carry it ([`Specular::Paper`]), or of
/// a white.
pub fn factor(
    surface: &Surface,
    geometry: &Geometry,
    wavelength_nm: f64,
    reading: Normalization,
    angular_radius: f64,
) -> f64 {
    let [diffuse, coherent] = factors(surface, geometry, wavelength_nm, reading, angular_radius);
    bounded(diffuse + coherent)
}

/// The diffuse and the coherent component of P or π f in Eq 12, dimensionless, at a wavelength in nanometers under a light of an
/// angular radius in radians. S(λ) multiplies the diffuse one, and the coherent one under [`Specular::Paper`].
///
/// ```text
/// Radiometric, Microfacet   π f,  f = A/(λ² cos θs) (cos θi ρ0² e^-g + D)
/// Paper                     P = ρ0² e^-g + D
/// Lambertian                1
/// D = (π τ²/A) G² S(g, b),  G² = T(θi) T(θs) cos θi,  A = 4XY
/// ```
/// For [`Normalization::Microfacet`] the cos θi within G² is `4 (l·ĥ)⁴/(cos θi (cos θi + cos θs)²)`, and `cos θi/cos θs` before ρ0² is 1,
/// which it is in the specular direction. Under [`Specular::Fresnel`] ρ0² is multiplied by F(l·ĥ); in the paper it carries no
/// Fresnel factor. ρ0² is its mean over the light's disk. 0 unless both light and viewer are before the surface; always finite.
pub fn factors(
    surface: &Surface,
    geometry: &Geometry,
    wavelength_nm: f64,
    reading: Normalization,
    angular_radius: f64,
) -> [f64; 2] {
    if !(geometry.is_lit() && wavelength_nm > 0.0 && wavelength_nm.is_finite()) {
        return [0.0; 2];
    }
    if reading == Normalization::Lambertian {
        return [1.0, 0.0];
    }
    let wave_number = TAU / (wavelength_nm * 1e-9);
    let ratio = LAMBDA_0_NM / wavelength_nm;
    let g = kappa(surface, geometry) * (ratio * ratio);
    let reach = wave_number * surface.tau_m();
    let b = reach * reach * geometry.vxy2_by_k2 / 4.0;
    let sum = diffuse_sum(g, b, Precision::Full);
    let pattern = rho0_squared(geometry, surface, wave_number, angular_radius) * (-g).exp();
    let power = bounded(ratio.powi(wavelength_power(reading)));
    let (diffuse, coherent) =
        (diffuse_prefactor(surface, geometry, reading), coherent_prefactor(surface, geometry, reading));
    [diffuse * sum, coherent * pattern].map(|component| bounded(power * bounded(component)))
}

/// Factor before `(λ0/λ)^p S(g, βg)`: dimensionless, without wavelength.
///
/// ```text
/// Radiometric   π² τ²/λ0² · T(θi) T(θs)/cos θs · cos θi
/// Microfacet    π² τ²/λ0² · T(θi)/cos θi · T(θs)/cos θs · 4 (l·ĥ)⁴/(cos θi + cos θs)²
/// Paper         π τ²/A · T(θi) T(θs) cos θi
/// ```
/// 0 for [`Normalization::Lambertian`], whose factor has no such part, and unless both light and viewer are before the surface.
#[inline]
pub fn diffuse_prefactor(surface: &Surface, geometry: &Geometry, reading: Normalization) -> f64 {
    if !geometry.is_lit() {
        return 0.0;
    }
    let (cos_i, cos_s, index) = (geometry.cos_i, geometry.cos_s, surface.index());
    let correlation = surface.tau_m() / LAMBDA_0_M;
    bounded(match reading {
        Normalization::Radiometric => {
            PI * PI
                * correlation
                * correlation
                * transmittance(cos_i, index)
                * transmittance_by_cosine(cos_s, index)
                * cos_i
        }
        Normalization::Microfacet => {
            let form = 2.0 * geometry.cos_half2 / geometry.vz_by_k;
            // The fourth power of a half vector near grazing can overflow where the transmittances are 0.
            PI * PI
                * correlation
                * correlation
                * transmittance_by_cosine(cos_i, index)
                * transmittance_by_cosine(cos_s, index)
                * bounded(form * form)
        }
        Normalization::Paper => {
            PI * surface.tau_m() * surface.tau_m() / surface.area_m2()
                * transmittance(cos_i, index)
                * transmittance(cos_s, index)
                * cos_i
        }
        Normalization::Lambertian => 0.0,
    })
}

/// Factor before `(λ0/λ)^p ρ0² e^-g`, the coherent component: dimensionless, without wavelength.
///
/// ```text
/// Radiometric   π A/λ0² · cos θi/cos θs
/// Microfacet    π A/λ0²
/// Paper         1
/// ```
/// Under [`Specular::Fresnel`] times F(l·ĥ), Fresnel's reflectance at the half vector: `((n − 1)/(n + 1))²` at normal incidence.
///
/// 0 for [`Normalization::Lambertian`], and unless both light and viewer are before the surface.
#[inline]
pub fn coherent_prefactor(surface: &Surface, geometry: &Geometry, reading: Normalization) -> f64 {
    if !geometry.is_lit() {
        return 0.0;
    }
    let patch = PI * surface.area_m2() / (LAMBDA_0_M * LAMBDA_0_M);
    let mirror = match reading {
        Normalization::Radiometric => bounded(patch * (geometry.cos_i / geometry.cos_s)),
        Normalization::Microfacet => patch,
        Normalization::Paper => 1.0,
        Normalization::Lambertian => 0.0,
    };
    match surface.specular() {
        Specular::Paper => mirror,
        Specular::Fresnel => mirror * reflectance(geometry.cos_half2.max(0.0).sqrt(), surface.index()),
    }
}

/// p: the power of λ0/λ that both parts of a reading carry beside g.
pub const fn wavelength_power(reading: Normalization) -> i32 {
    match reading {
        Normalization::Radiometric | Normalization::Microfacet => 2,
        Normalization::Paper | Normalization::Lambertian => 0,
    }
}

/// κ: `g = σ² v_z²` at 550 nm, `(2π σ (cos θi + cos θs)/λ0)²`.
#[inline]
pub fn kappa(surface: &Surface, geometry: &Geometry) -> f64 {
    let phase = TAU / LAMBDA_0_M * surface.sigma_m() * geometry.vz_by_k;
    phase * phase
}

/// β = b/g, the same for all wavelengths: `(τ/2σ)² v_xy²/v_z²`.
///
/// Cut at 1e150, which no sum survives. Where g is 0 (a smooth surface, or both rays grazing) β has no meaning and is given
/// as 0; the diffuse sum is 0 there.
#[inline]
pub fn beta(surface: &Surface, geometry: &Geometry) -> f64 {
    let height = 2.0 * surface.sigma_m() * geometry.vz_by_k;
    if height == 0.0 {
        return 0.0;
    }
    let ratio = surface.tau_m() / height;
    bounded(ratio * ratio * geometry.vxy2_by_k2)
}

/// The value, cut at [`LARGEST`]; 0 for NaN.
#[inline]
fn bounded(value: f64) -> f64 {
    // `min` would take the bound in place of NaN.
    if value.is_nan() { 0.0 } else { value.min(LARGEST) }
}
