//! Lateral spread of light within skin, by wavelength: the dipole (Jensen, Marschner, Levoy and Hanrahan 2001) as a mixture of
//! Gaussians (d'Eon and Irving 2011).
//!
//! ```text
//! μs′ = 4.6/mm (λ/500 nm)^−1.421                                     skin, mean of 8 studies: Jacques 2013, Table 2
//! S(λ) = α′/2 (1 + exp(−4/3 A √(3(1−α′)))) exp(−√(3(1−α′)))          gives α′ = μs′/(μa + μs′), and so μa
//! R(r) = α′/2 ∫ Σ_z f(z, v) exp(−μa v/2D) exp(−r²/2v)/2πv dv,        z = 1/μt′ and 1/μt′ + 4 A D
//! f(z, v) = z exp(−z²/2v)/(√(2π) v^3/2),   D = 1/3μt′,   A = (1 + F)/(1 − F)
//! ```
//! r = distance on the surface; F = diffuse reflectance of the boundary from within. Absorption is the one that gives the material's
//! own reflectance, so the light returned is as measured: only the place where it leaves is new. Each variance v of the integral
//! is shared between the two nearest of a few that all wavelengths have ([`SPREADS_MM`], and 0), which keeps the mean of r².

/// Standard deviations, along one direction of the surface, of the Gaussians that all wavelengths share, in millimeters.
pub const SPREADS_MM: [f64; 3] = [0.5, 1.3, 3.4];

/// Refractive index of skin (Donner and Jensen 2006).
const INDEX: f64 = 1.40;
/// μs′ at 500 nm per millimeter, and the power of the wavelength that it falls with.
const SCATTERING: (f64, f64) = (4.6, 1.421);
/// Steps of ln v, their number, and the first v over the square of 1/μt′.
const STEP: f64 = 0.1;
const STEPS: u32 = 140;
const FIRST: f64 = 0.03;

/// Shares of the light returned at a wavelength (nm) by skin of a reflectance that leave spread by [`SPREADS_MM`]; the rest leaves
/// where it entered. None spreads where the reflectance is not above 0.
///
/// ```
/// use chromascope_core::reflectance::diffusion::{SPREADS_MM, shares};
/// let rms = |shares: [f64; 3]| (0..3).map(|k| shares[k] * SPREADS_MM[k].powi(2)).sum::<f64>().sqrt();
/// let [blue, red] = [(450.0, 0.25), (650.0, 0.58)].map(|(nm, reflectance)| rms(shares(nm, reflectance)));
/// assert!(blue < 0.3 && (0.8..1.4).contains(&red), "{blue} mm, {red} mm");
/// ```
pub fn shares(nm: f64, reflectance: f64) -> [f64; 3] {
    if reflectance.is_nan() || reflectance <= 1e-6 {
        return [0.0; 3];
    }
    let (scattering, power) = SCATTERING;
    let scattering = scattering * (nm / 500.0).powf(-power);
    // Egan and Hilgeman 1973, as in Jensen et al.
    let inner = -1.440 / (INDEX * INDEX) + 0.710 / INDEX + 0.668 + 0.0636 * INDEX;
    let a = (1.0 + inner) / (1.0 - inner);
    let (mut low, mut high) = (0.0, 1.0 - 1e-6);
    for _ in 0..48 {
        let albedo = f64::midpoint(low, high);
        let depth = (3.0 * (1.0 - albedo)).sqrt();
        let returned = 0.5 * albedo * (1.0 + (-4.0 / 3.0 * a * depth).exp()) * (-depth).exp();
        *(if returned < reflectance { &mut low } else { &mut high }) = albedo;
    }
    let extinction = scattering / low;
    let (free, d, absorption) = (1.0 / extinction, 1.0 / (3.0 * extinction), extinction - scattering);
    let (mut all, mut sums) = (0.0, [0.0; 3]);
    for step in 0..STEPS {
        let v = FIRST * free * free * (STEP * f64::from(step)).exp();
        let first_passage = |z: f64| z * (-z * z / (2.0 * v)).exp() / v.sqrt();
        let weight = (first_passage(free) + first_passage(free + 4.0 * a * d)) * (-absorption * v / (2.0 * d)).exp();
        all += weight;
        let variances = SPREADS_MM.map(|spread| spread * spread);
        let above = variances.iter().position(|&variance| v < variance).unwrap_or(SPREADS_MM.len());
        let below = if above == 0 { 0.0 } else { variances[above - 1] };
        let upper = variances.get(above).map_or(0.0, |variance| (v - below) / (variance - below));
        if above < SPREADS_MM.len() {
            sums[above] += weight * upper;
        }
        if above > 0 {
            sums[above - 1] += weight * (1.0 - upper);
        }
    }
    sums.map(|sum| sum / all)
}
