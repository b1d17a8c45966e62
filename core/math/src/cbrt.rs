//! A cube root that vectorizes.

/// A third of the bits of a double that is a third of 1's exponent off, less what the mantissa's chord is off by on average.
const THIRD: u64 = 0x2a9f_7893_782d_a1ce;

/// ∛x for normal, positive, finite x, without branches or calls: a third of the exponent, twice Halley's step and once Newton's.
///
/// Relative error below 3e-16, held by a test against the standard library. The standard library's own takes six times as many
/// instructions.
///
/// ```
/// use chromascope_math::cbrt::cbrt;
/// assert!((cbrt(27.0) - 3.0).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn cbrt(x: f64) -> f64 {
    let mut y = f64::from_bits(x.to_bits() / 3 + THIRD);
    for _ in 0..2 {
        let cube = y * y * y;
        y *= (cube + 2.0 * x) / (2.0 * cube + x);
    }
    y + (x / (y * y) - y) * (1.0 / 3.0)
}
