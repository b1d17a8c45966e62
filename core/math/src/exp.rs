//! An exponential that vectorizes.

use crate::ln::{LN_2_HIGH, LN_2_LOW};

/// `(e^r − 1 − r)/r²` for |r| ≤ ln 2 / 2, by powers of r: the polynomial through Chebyshev's points, from 60 digits.
const CURVE: [f64; 10] = [
    0.500_000_000_000_000_1,
    0.166_666_666_666_666_69,
    0.041_666_666_666_624_13,
    0.008_333_333_333_330_062,
    0.001_388_888_891_721_371_7,
    0.000_198_412_698_630_536_18,
    2.480_152_129_595_437_6e-5,
    2.755_726_845_999_706_4e-6,
    2.762_008_844_540_974_6e-7,
    2.510_038_549_551_032e-8,
];

/// Adding this rounds a double below 2⁵¹ to the nearest integer, in the low bits of its mantissa.
pub const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// eˣ for |x| ≤ 700, without branches or calls, so that a loop over it vectorizes.
///
/// Range reduction x = n ln 2 + r with |r| ≤ ln 2 / 2 (Cody and Waite), then a polynomial of degree 11 whose error is below
/// 2e-17, then the exponent set in the bits.
/// Relative error below 4e-16, held by a test against the standard library; outside the range the argument is clamped.
///
/// ```
/// use chromascope_math::exp::exp;
/// assert!((exp(1.0) - std::f64::consts::E).abs() < 5e-16);
/// ```
#[inline(always)]
pub fn exp(x: f64) -> f64 {
    let x = x.clamp(-700.0, 700.0);
    let shifted = x * std::f64::consts::LOG2_E + ROUNDER;
    let n = shifted - ROUNDER;
    let r = (x - n * LN_2_HIGH) - n * LN_2_LOW;
    let exponent = shifted.to_bits().wrapping_add(1023) << 52;
    (1.0 + exp_m1_near(r)) * f64::from_bits(exponent)
}

/// eˣ − 1 for |x| ≤ ln 2 / 2, by the same method; relative error below 4e-16, also near 0.
#[inline(always)]
pub fn exp_m1_near(x: f64) -> f64 {
    // In pairs of pairs, so that operations wait less for each other (Estrin 1960).
    let c = &CURVE;
    let (x2, x4) = (x * x, (x * x) * (x * x));
    let low = (c[0] + c[1] * x) + (c[2] + c[3] * x) * x2;
    let high = (c[4] + c[5] * x) + (c[6] + c[7] * x) * x2;
    x + x2 * (low + (high + (c[8] + c[9] * x) * x4) * x4)
}
