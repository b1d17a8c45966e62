//! The workloads' quantities in 106 bits, from their definitions: the references. Nothing of the core computes here but its
//! constants and data.

use chromascope_core::colorimetry::rgb::XYZ_FROM_SRGB;
use chromascope_core::light::RadiationConstants;
use chromascope_core::spectral::grid::{COUNT, wavelength_nm};
use chromascope_core::spectral::{Primaries, Sensor};
use chromascope_math::double::Double;

/// The three integrals of a blackbody through a sensor (Eq 14, 15), up to a common factor.
///
/// ```text
/// Σ C(λ) (λ₀/λ)⁵ / (exp(c₂/λT) − 1),   λ₀ = 550 nm
/// ```
pub fn black_body(sensor: &Sensor, constants: RadiationConstants, kelvins: Double) -> [Double; 3] {
    planck(sensor, constants, kelvins).map(|sums| sums[0])
}

/// Per channel the integral, and its derivative by the reciprocal temperature in units of its own.
fn planck(sensor: &Sensor, constants: RadiationConstants, kelvins: Double) -> [[Double; 2]; 3] {
    let second = Double::new(constants.second()) * Double::new(1e9);
    let mut sums = [[Double::default(); 2]; 3];
    for index in 0..COUNT {
        let nm = Double::new(wavelength_nm(index));
        let rate = second / nm;
        let below = (rate / kelvins).exp_m1();
        let law = (Double::new(550.0) / nm).powi(5) / below;
        // d/dm of 1/(e^x − 1) is −x' e^x/(e^x − 1)² = −x' (1 + 1/(e^x − 1)) / (e^x − 1).
        let slope = -(law * rate * (Double::ONE + Double::ONE / below));
        for (channel, [sum, change]) in sums.iter_mut().enumerate() {
            let weight = Double::new(sensor.weighted(channel)[index]);
            *sum = *sum + weight * law;
            *change = *change + weight * slope;
        }
    }
    sums
}

/// The chromaticity of a blackbody: an observer's own, or a camera's by Eq 13.
pub fn black_body_xy(sensor: &Sensor, constants: RadiationConstants, kelvins: f64) -> [Double; 2] {
    let raw = black_body(sensor, constants, Double::new(kelvins));
    let xyz = if sensor.primaries() == Primaries::Xyz { raw } else { xyz_of_signals(sensor, raw) };
    let sum = xyz[0] + xyz[1] + xyz[2];
    [xyz[0] / sum, xyz[1] / sum]
}

/// Signals divided by the sensitivities' integrals, then to XYZ as if they were sRGB's.
fn xyz_of_signals(sensor: &Sensor, raw: [Double; 3]) -> [Double; 3] {
    let flat = |c: usize| -> Double { sensor.weighted(c).iter().map(|&weight| Double::new(weight)).sum() };
    let rgb = [0, 1, 2].map(|c: usize| raw[c] / flat(c));
    let rows = XYZ_FROM_SRGB.transpose();
    [rows.x_axis, rows.y_axis, rows.z_axis]
        .map(|row| row.to_array().into_iter().zip(rgb).map(|(m, v)| Double::new(m) * v).sum())
}

/// A point of the locus in the 1960 diagram with its derivative by m = 1/T.
fn locus(observer: &Sensor, constants: RadiationConstants, per_kelvin: Double) -> [[Double; 2]; 2] {
    let [x, y, z] = planck(observer, constants, Double::ONE / per_kelvin);
    let whole = |k: usize| x[k] + Double::new(15.0) * y[k] + Double::new(3.0) * z[k];
    let (sum, change) = (whole(0), whole(1));
    let (u, v) = (Double::new(4.0) * x[0] / sum, Double::new(6.0) * y[0] / sum);
    let du = (Double::new(4.0) * x[1] - u * change) / sum;
    let dv = (Double::new(6.0) * y[1] - v * change) / sum;
    [[u, v], [du, dv]]
}

/// The color of a temperature and Duv in the 1960 diagram, rounded to doubles.
pub fn off_locus(observer: &Sensor, constants: RadiationConstants, kelvins: f64, duv: f64) -> [f64; 2] {
    let [[u, v], [du, dv]] = locus(observer, constants, Double::ONE / Double::new(kelvins));
    let length = (du * du + dv * dv).sqrt();
    let duv = Double::new(duv);
    // Towards colder bodies v′ is on the left of the tangent: above is (−v′, u′).
    [(u - duv * dv / length).value(), (v + duv * du / length).value()]
}

/// Temperature in kelvins and Duv of a color from a nearby start: secants on the condition that the line to the nearest
/// point is perpendicular to the locus.
pub fn cct(observer: &Sensor, constants: RadiationConstants, color: [f64; 2], near_kelvins: f64) -> [Double; 2] {
    let [pu, pv] = color.map(Double::new);
    let condition = |m: Double| {
        let [[u, v], [du, dv]] = locus(observer, constants, m);
        (u - pu) * du + (v - pv) * dv
    };
    let mut m = Double::ONE / Double::new(near_kelvins);
    for relative in [1e-6, 1e-9, 1e-12] {
        let step = m * Double::new(relative);
        let here = condition(m);
        m = m - here * step / (condition(m + step) - here);
    }
    let [[u, v], [du, dv]] = locus(observer, constants, m);
    let duv = ((pv - v) * du - (pu - u) * dv) / (du * du + dv * dv).sqrt();
    [Double::ONE / m, duv]
}

/// `S(g, b) = e^-g Σ gⁿ/(n! n) e^(-b/n)`, term by term from the largest outward, for g up to 1e6 and S above 1e-290.
pub fn diffuse_sum(g: Double, b: Double) -> Double {
    if g.value() <= 0.0 {
        return Double::default();
    }
    let peak = largest_term(g.value(), b.value());
    // gⁿ/n! e^-g at the largest term, the exponential taken in parts so that nothing overflows.
    let (mut weight, mut rest) = (Double::ONE, g);
    let part = Double::new(-200.0).exp();
    for n in 1..=peak {
        weight = weight * g / Double::new(n as f64);
        while weight.value() > 1e100 && rest.value() > 200.0 {
            weight = weight * part;
            rest = rest - Double::new(200.0);
        }
    }
    weight = weight * (-rest).exp();
    let term = |weight: Double, n: u64| {
        let n = Double::new(n as f64);
        weight / n * (-(b / n)).exp()
    };
    let mut sum = term(weight, peak);
    let (mut up, mut n) = (weight, peak);
    loop {
        n += 1;
        up = up * g / Double::new(n as f64);
        let next = term(up, n);
        sum = sum + next;
        if next.value() < 1e-33 * sum.value() || n > peak + 100_000 {
            break;
        }
    }
    let mut down = weight;
    for n in (1..peak).rev() {
        down = down * Double::new((n + 1) as f64) / g;
        let next = term(down, n);
        sum = sum + next;
        if next.value() < 1e-33 * sum.value() {
            break;
        }
    }
    sum
}

/// Near which n the terms are largest: where `ln g − ln n + b/n²` changes sign.
fn largest_term(g: f64, b: f64) -> u64 {
    let (mut low, mut high) = (1.0_f64, 1e7_f64);
    for _ in 0..80 {
        let middle = (low * high).sqrt();
        if g.ln() - middle.ln() + b / (middle * middle) > 0.0 { low = middle } else { high = middle }
    }
    low.round().max(1.0) as u64
}
