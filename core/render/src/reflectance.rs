//! Reflectance of rough surfaces: the model (Eq 1–4) and its parts.
//!
//! A surface whose heights are normally distributed with RMS roughness σ and autocorrelation exp(−r²/τ²) reflects part of
//! the light into the specular direction and scatters the rest (Beckmann and Spizzichino 1963), with Fresnel's
//! transmittances (Wolff 1994) and a form factor (Vernold and Harvey 1998; Ragheb and Hancock 2006).
//!
//! ```text
//! P = ρ0² e^-g + D                              Eq 1
//! D = (π τ²/A) G² S(g, b)                       Eq 2
//! S = e^-g Σ_{n≥1} gⁿ/(n! n) e^(-b/n)           one uniform method, no regimes
//! G² = T(θi) T(θs) cos θi,  T = 1 − F           Eq 3
//! g = σ² v_z²,  b = τ² (v_x² + v_y²) / 4
//! ```
//! φi = π as in the paper, so that the specular direction is θs = θi, φs = 0. Past [`Surface::new`] everything is total: finite
//! for any σ up to 1 m, any direction, any index, any wavelength.

pub mod coherent;
pub mod diffusion;
pub mod fresnel;
pub mod geometry;
pub mod hemispherical;
pub mod leaf;
pub mod power;
pub mod regimes;
pub mod sum;
pub mod surface;

pub use geometry::Geometry;
pub use hemispherical::{HemisphericalReflectance, directional_hemispherical, hemispherical_directional};
pub use power::{beta, coherent_prefactor, diffuse_prefactor, factor, factors, kappa, wavelength_power};
pub use regimes::{Regime, diffuse_sum_by_regimes};
pub use sum::{Precision, diffuse_sum, diffuse_sums_into, ln_diffuse_sum};
pub use surface::{Caution, IlluminatedArea, Normalization, Specular, Surface, SurfaceError};
