//! Fresnel's formulas for unpolarized light on a dielectric, without cancellation.
//!
//! With c = cos θ and q = √(n² − sin² θ), n times the cosine of the refracted ray,
//! ```text
//! T(θ) = 2 c q [ 1/(c + q)² + n²/(n² c + q)² ],  F = 1 − T
//! ```
//! By Snell's law and the formulas' symmetry, the transmittance of a ray that leaves into the angle θ is T(θ) as well:
//! Eq 3's second factor needs neither an arcsine nor the inverse index.

use std::f64::consts::FRAC_1_SQRT_2;

/// Beyond this index everything is a mirror to all digits; its powers stay far from overflow.
const MIRROR: f64 = 1e30;

/// c and q, or none where all light is reflected; the cosine is taken as 1 at most.
#[inline]
fn refracted(cos: f64, index: f64) -> Option<(f64, f64)> {
    // Written so that NaN falls out too. The inverse of a subnormal cosine would overflow.
    if !(cos >= f64::MIN_POSITIVE && index > 0.0 && index <= MIRROR) {
        return None;
    }
    let c = cos.min(1.0);
    if index == 1.0 {
        // The square of a tiny cosine is 0, its root is not.
        return Some((c, c));
    }
    // The form with the smaller terms to cancel.
    let squared = if index < FRAC_1_SQRT_2 { index * index - sin2(c) } else { excess(index) + c * c };
    (squared > 0.0).then(|| (c, squared.sqrt()))
}

/// n² − 1.
#[inline]
fn excess(index: f64) -> f64 {
    (index - 1.0) * (index + 1.0)
}

/// sin² θ from cos θ.
#[inline]
fn sin2(c: f64) -> f64 {
    (1.0 - c) * (1.0 + c)
}

/// F: the share of unpolarized light that a smooth surface reflects, from the cosine of the angle to the normal and the
/// refractive index.
///
/// ```text
/// F = (r_s² + r_p²)/2,  r_s = (n² − 1)/(c + q)²,  r_p = (n² − 1)(n² c² − sin² θ)/(n² c + q)²
/// ```
/// Relative error below 1e-13, also for n near 1 (where F is near 0). 1 at and beyond grazing, where an index below 1
/// reflects totally, and for indices that are NaN or beyond 1e30.
///
/// ```
/// use chromascope_core::reflectance::fresnel::reflectance;
/// assert!((reflectance(1.0, 1.5) - 0.04).abs() < 1e-15);
/// ```
#[inline]
pub fn reflectance(cos: f64, index: f64) -> f64 {
    let Some((c, q)) = refracted(cos, index) else { return 1.0 };
    let (nc, excess) = (index * c, excess(index));
    let (across, along) = (1.0 / (c + q), 1.0 / (index * nc + q));
    let across = excess * across * across;
    let along = excess * along * (nc * nc - sin2(c)) * along;
    f64::midpoint(across * across, along * along).min(1.0)
}

/// T = 1 − F: the share of unpolarized light that passes, from the cosine of the angle to the normal and the index.
///
/// By its own formula (see the module), so that at grazing angles nothing cancels: relative error below 1e-13, but for an
/// index below 1 next to its critical angle, where T falls to 0 as steeply as a square root. 0 where the cosine is not positive
/// and where all light is reflected.
#[inline]
pub fn transmittance(cos: f64, index: f64) -> f64 {
    refracted(cos, index).map_or(0.0, |(c, q)| (c * by_cosine(c, q, index)).min(1.0))
}

/// T / cos θ, which stays finite at grazing angles: `2 q [1/(c + q)² + n²/(n² c + q)²]`.
///
/// At c → 0 with n > 1 it tends to `2 (1 + n²)/√(n² − 1)`. At n = 1 it is 1/c, which is cut at 1e15. 0 where the transmittance
/// is 0. As accurate as [`transmittance`].
#[inline]
pub fn transmittance_by_cosine(cos: f64, index: f64) -> f64 {
    refracted(cos, index).map_or(0.0, |(c, q)| by_cosine(c, q, index).min(1e15))
}

#[inline]
fn by_cosine(c: f64, q: f64, index: f64) -> f64 {
    let (across, along) = (1.0 / (c + q), 1.0 / (index * c + q / index));
    // In this order no product leaves the range where the whole does not.
    2.0 * (q * across * across + q * along * along)
}
