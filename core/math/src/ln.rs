//! Logarithms that vectorize.

/// The bits of √½, from which on a mantissa counts to the next power of two.
const ROOT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
/// The bits of 1.
const ONE: u64 = 0x3ff0_0000_0000_0000;
/// The bits of a mantissa.
const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
/// 2⁵²: an integer below it, in the low bits of its mantissa, is added to it.
const INTEGERS: u64 = 0x4330_0000_0000_0000;

/// ln 2 in two parts, so that `n ln 2` is exact in the first for |n| below 2¹¹ (Cody and Waite 1980).
pub(crate) const LN_2_HIGH: f64 = 0.693_147_180_369_123_8;
pub(crate) const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// Twice the Taylor coefficients of `(artanh s / s - 1) / s²` in s²: `2/(2k + 3)`.
const ARTANH: [f64; 10] = [
    2.0 / 3.0,
    2.0 / 5.0,
    2.0 / 7.0,
    2.0 / 9.0,
    2.0 / 11.0,
    2.0 / 13.0,
    2.0 / 15.0,
    2.0 / 17.0,
    2.0 / 19.0,
    2.0 / 21.0,
];

/// ln x for normal x, without branches or calls, so that a loop over it vectorizes.
///
/// ```text
/// x = 2ⁿ (1 + f),  √½ ≤ 1 + f < √2,  s = f / (2 + f)
/// ln x = n ln 2 + f - s (f - 2 (s²/3 + s⁴/5 + …))
/// ```
/// The series ends with s²⁰/21, its rest being below 1e-17 of f. Error below 2 units in the last place, held by a test against
/// the standard library. Below 2.2e-308 and above the largest number the argument is clamped; NaN gives
/// some number.
///
/// ```
/// use chromascope_math::ln::ln;
/// assert!((ln(10.0) - std::f64::consts::LN_10).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn ln(x: f64) -> f64 {
    with_rest(x.clamp(f64::MIN_POSITIVE, f64::MAX), 0.0)
}

/// ln(1 + x) for x ≥ 0, also for x far below 1, without branches or calls.
///
/// Error below 2 units in the last place, held by a test against the standard library. The argument is clamped to the range
/// from 0 to the largest number.
///
/// ```
/// use chromascope_math::ln::ln_1p;
/// assert_eq!(ln_1p(1e-20), 1e-20);
/// ```
#[inline(always)]
pub fn ln_1p(x: f64) -> f64 {
    let x = x.clamp(0.0, f64::MAX);
    let sum = 1.0 + x;
    // What rounding the sum loses, exactly, by the larger of the two.
    let lost = x.min(1.0) - (sum - x.max(1.0));
    with_rest(sum, lost / sum)
}

/// ln x within 2e-14, absolute or relative, for what is positive, normal and finite; beyond that some number.
///
/// Less exact than [`ln`], and shorter; its operations wait less for each other.
#[inline(always)]
pub fn short_ln(x: f64) -> f64 {
    let [n, f] = split(x);
    let s = f / (2.0 + f);
    let z = s * s;
    let (c, z2) = (&ARTANH, z * z);
    let series = (c[0] + c[1] * z) + (c[2] + c[3] * z) * z2 + ((c[4] + c[5] * z) + c[6] * z2) * (z2 * z2);
    n * std::f64::consts::LN_2 + s * (2.0 + z * series)
}

/// n and f of `x = 2ⁿ (1 + f)`, 2ⁿ being what brings the mantissa between √½ and √2.
#[inline(always)]
fn split(x: f64) -> [f64; 2] {
    let raised = x.to_bits().wrapping_add(ONE - ROOT_HALF);
    let n = f64::from_bits(raised >> 52 | INTEGERS) - (4_503_599_627_370_496.0 + 1023.0);
    [n, f64::from_bits((raised & MANTISSA).wrapping_add(ROOT_HALF)) - 1.0]
}

/// ln x + rest.
#[inline(always)]
fn with_rest(x: f64, rest: f64) -> f64 {
    let [n, f] = split(x);
    let s = f / (2.0 + f);
    let z = s * s;
    let mut series = ARTANH[9];
    for k in (0..9).rev() {
        series = series * z + ARTANH[k];
    }
    n * LN_2_HIGH + (f - (s * (f - z * series) - (n * LN_2_LOW + rest)))
}
