//! Fresnel's formulas for unpolarized light on a dielectric, without cancellation.
//!
//! With c = cos θ and q = √(n² − sin² θ), n times the cosine of the refracted ray,
//! ```text
//! T(θ) = 2 c q [ 1/(c + q)² + n²/(n² c + q)² ],  F = 1 − T
//! ```
//! By Snell's law and the formulas' symmetry, the transmittance of a ray that leaves into the angle θ is T(θ) as well:
//! Eq 3's second factor needs neither an arcsine nor the inverse index.

/// Beyond this index everything is a mirror to all digits; its powers stay far from overflow.
const MIRROR: f64 = 1e30;

/// c and q, or none where all light is reflected; the cosine is taken as 1 at most.
#[inline]
fn refracted(cos: f64, index: f64) -> Option<(f64, f64)> {
    // Written so that NaN falls out too.
    if !(cos > 0.0 && index > 0.0 && index <= MIRROR) {
        return None;
    }
    let c = cos.min(1.0);
    let squared = (index - 1.0) * (index + 1.0) + c * c;
    (squared > 0.0).then(|| (c, squared.sqrt()))
}

/// F: the share of unpolarized light that a smooth surface reflects, from the cosine of the angle to the normal and the
/// refractive index.
///
/// ```text
/// F = (r_s² + r_p²)/2,  r_s = (n² − 1)/(c + q)²,  r_p = (n² − 1)(c²(n² + 1) − 1)/(n² c + q)²
/// ```
/// Relative error below 1e-13, also for n near 1 (where F is near 0). 1 at and beyond grazing, where an index below 1
/// reflects totally, and for indices that are no number or beyond 1e30.
///
/// ```
/// use chromascope_core::reflectance::fresnel::reflectance;
/// assert!((reflectance(1.0, 1.5) - 0.04).abs() < 1e-15);
/// ```
#[inline]
pub fn reflectance(cos: f64, index: f64) -> f64 {
    let Some((c, q)) = refracted(cos, index) else { return 1.0 };
    let n2 = index * index;
    let excess = (index - 1.0) * (index + 1.0);
    let across = excess / ((c + q) * (c + q));
    let along = excess * (c * c * (n2 + 1.0) - 1.0) / ((n2 * c + q) * (n2 * c + q));
    f64::midpoint(across * across, along * along).min(1.0)
}

/// T = 1 − F: the share of unpolarized light that passes, from the cosine of the angle to the normal and the index.
///
/// By its own formula (see the module), so that at grazing angles nothing cancels: relative error below 1e-13. 0 where the
/// cosine is not positive and where all light is reflected.
#[inline]
pub fn transmittance(cos: f64, index: f64) -> f64 {
    refracted(cos, index).map_or(0.0, |(c, q)| (c * by_cosine(c, q, index)).min(1.0))
}

/// T / cos θ, which stays finite at grazing angles: `2 q [1/(c + q)² + n²/(n² c + q)²]`.
///
/// At c → 0 with n > 1 it tends to `2 (1 + n²)/√(n² − 1)`. At n = 1 it is 1/c, which is cut at 1e15. 0 where the transmittance
/// is 0. Relative error below 1e-13.
#[inline]
pub fn transmittance_by_cosine(cos: f64, index: f64) -> f64 {
    refracted(cos, index).map_or(0.0, |(c, q)| by_cosine(c, q, index).min(1e15))
}

#[inline]
fn by_cosine(c: f64, q: f64, index: f64) -> f64 {
    let (across, along) = (c + q, index * c + q / index);
    2.0 * q * (1.0 / (across * across) + 1.0 / (along * along))
}
