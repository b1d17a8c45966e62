//! The coherent component's pattern: diffraction at the patch, averaged over the disk of the light.
//!
//! ```text
//! ρ0 = sinc(v_x X) sinc(v_y Y)
//! ```
//! A patch of a millimeter makes a lobe of a quarter of a milliradian, far narrower than the Sun's 4.65 mrad: what is seen is
//! the mean of ρ0² over the light. It is taken along each axis, over a square as wide as the disk, which separates.

use super::geometry::Geometry;
use super::surface::Surface;
use std::f64::consts::FRAC_PI_2;

/// sin x / x, 1 at 0. Infinite x and NaN give 0.
pub fn sinc(x: f64) -> f64 {
    if x == 0.0 {
        1.0
    } else if x.is_finite() {
        x.sin() / x
    } else {
        0.0
    }
}

/// Beyond this, arguments and half widths are as good as infinite.
const FAR: f64 = 1e150;

/// The mean of sinc² over `u0 − half_width ..= u0 + half_width`.
///
/// ```text
/// (H(u0 + w) − H(u0 − w)) / 2w,  H(u) = Si(2u) − sin² u / u
/// ```
/// For w ≤ 1/2 an eight-point Gauss rule, for u0 − w > 100 the expansion for large arguments: absolute error below 1e-14,
/// relative below 1e-9 where u0 is large. A half-width of 0 (or below) gives sinc² itself; NaN gives 0.
pub fn mean_sinc_squared(u0: f64, half_width: f64) -> f64 {
    let (u0, w) = (u0.abs(), half_width.max(0.0));
    // Written so that NaN falls out too.
    if !(u0 < FAR && half_width < FAR) {
        return 0.0;
    }
    if w == 0.0 {
        sinc(u0).powi(2)
    } else if w <= 0.5 {
        by_gauss_rule(u0, w)
    } else if u0 - w > 100.0 {
        far_out(u0 - w, u0 + w, w)
    } else {
        ((antiderivative(u0 + w) - antiderivative(u0 - w)) / (2.0 * w)).max(0.0)
    }
}

/// The positive half of the eight-point Gauss–Legendre rule: nodes and weights.
pub(super) const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];

fn by_gauss_rule(u0: f64, w: f64) -> f64 {
    let pair = |[node, weight]: [f64; 2]| {
        let (below, above) = (sinc(u0 - w * node), sinc(u0 + w * node));
        weight * (below * below + above * above)
    };
    GAUSS.into_iter().map(pair).sum::<f64>() / 2.0
}

/// The mean from a to b by integration by parts, where the sine integrals of both ends agree in most digits.
fn far_out(a: f64, b: f64, w: f64) -> f64 {
    let part = |u: f64| {
        let (sin, cos) = (2.0 * u).sin_cos();
        let inverse = 1.0 / u;
        let tail = cos * 0.75 + inverse * (sin * 1.875 - inverse * cos * 5.625);
        (sin * 0.25 - inverse * (cos * 0.25 + inverse * (sin * 0.375 - inverse * tail))) * inverse * inverse
    };
    0.5 / a / b + (part(a) - part(b)) / (2.0 * w)
}

/// H(u), odd in u.
fn antiderivative(u: f64) -> f64 {
    let sin = u.sin();
    if u == 0.0 { 0.0 } else { sine_integral(2.0 * u) - sin * sin / u }
}

/// `Si(x) = ∫ sin t / t dt` from 0 to x, within 1e-15 (2e-15 for large x).
///
/// The power series up to 4, beyond it π/2 + Im E₁(ix) by the continued fraction of the exponential integral. An infinite x
/// gives ±π/2, NaN 0.
pub fn sine_integral(x: f64) -> f64 {
    if x.is_nan() {
        return 0.0;
    }
    let distance = x.abs();
    let value = if distance <= 4.0 {
        by_power_series(distance)
    } else if distance < FAR {
        by_continued_fraction(distance)
    } else {
        FRAC_PI_2
    };
    value.copysign(x)
}

fn by_power_series(x: f64) -> f64 {
    let (mut power, mut sum) = (x, x);
    for k in (3..=31).step_by(2).map(f64::from) {
        power *= -x * x / (k * (k - 1.0));
        sum += power / k;
    }
    sum
}

/// `E₁(z) = e^-z / (z + 1 − 1²/(z + 3 − 2²/(z + 5 − …)))` at z = ix, from the tail up.
fn by_continued_fraction(x: f64) -> f64 {
    let levels = (12.0 + 480.0 / x).ceil();
    let (mut re, mut im) = (2.0 * levels + 1.0, x);
    let mut k = levels;
    while k >= 1.0 {
        let scale = k * k / (re * re + im * im);
        (re, im) = (2.0 * k - 1.0 - scale * re, x + scale * im);
        k -= 1.0;
    }
    let size = re * re + im * im;
    let (sin, cos) = x.sin_cos();
    FRAC_PI_2 - (im * cos + re * sin) / size
}

/// Center and half-width of the phase along one axis: the area's half-width times v, and times the light's spread of v.
fn axes(geometry: &Geometry, surface: &Surface, wave_number: f64, angular_radius: f64) -> [[f64; 2]; 2] {
    [(surface.half_x_m(), geometry.vx_by_k), (surface.half_y_m(), geometry.vy_by_k)].map(|(half_side, v_by_k)| {
        let reach = wave_number * half_side;
        [reach * v_by_k, reach * angular_radius]
    })
}

/// The mean of ρ0² over a light of an angular radius in radians; `wave_number` is 2π/λ in 1/m.
///
/// A radius of 0 gives the paper's ρ0² itself. Between 0 and 1.
pub fn rho0_squared(geometry: &Geometry, surface: &Surface, wave_number: f64, angular_radius: f64) -> f64 {
    let [x, y] = axes(geometry, surface, wave_number, angular_radius).map(|[u0, w]| mean_sinc_squared(u0, w));
    x * y
}

/// Upper bound of [`rho0_squared`] that needs no sine.
///
/// ```text
/// min(1, 1/u²) for each axis, u the end of u0 ± w that is nearer to 0; not above π/2w
/// ```
pub fn rho0_squared_bound(geometry: &Geometry, surface: &Surface, wave_number: f64, angular_radius: f64) -> f64 {
    let [x, y] = axes(geometry, surface, wave_number, angular_radius).map(|[u0, w]| {
        let nearest = (u0.abs() - w.max(0.0)).max(1.0);
        // The whole integral of sinc² is π.
        (1.0 / (nearest * nearest)).min(FRAC_PI_2 / w.max(FRAC_PI_2))
    });
    x * y
}
