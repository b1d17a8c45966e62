//! Polynomials through Chebyshev nodes: nearly the best there is for a smooth function on an interval.

use std::f64::consts::PI;

/// The N nodes on −1…1, `cos(π (2j + 1) / 2N)` for j = 0…N − 1.
pub fn nodes<const N: usize>() -> [f64; N] {
    std::array::from_fn(|j| (PI * (2 * j + 1) as f64 / (2 * N) as f64).cos())
}

/// The coefficients of 1, t, t², … of the polynomial that has these values at [`nodes`].
///
/// ```text
/// p(t) = Σ a_k T_k(t),   a_k = (2 − δ_k0)/N · Σ_j f(t_j) cos(π k (2j + 1) / 2N)
/// ```
/// For functions analytic around the interval the error falls geometrically with N. Powers of t lose digits as N grows: up
/// to N = 12 or so they are as good as Chebyshev's polynomials and cheaper to evaluate.
///
/// ```
/// use chromascope_math::chebyshev::{coefficients, nodes};
/// let c = coefficients(nodes::<4>().map(|t| 1.0 - 3.0 * t + t * t * t));
/// for (value, expected) in c.iter().zip([1.0, -3.0, 0.0, 1.0]) {
///     assert!((value - expected).abs() < 1e-14);
/// }
/// ```
pub fn coefficients<const N: usize>(values: [f64; N]) -> [f64; N] {
    let mut powers = [0.0; N];
    // T_{k−1} and T_k in powers of t.
    let (mut before, mut current) = ([0.0; N], [0.0; N]);
    if N > 0 {
        current[0] = 1.0;
    }
    for k in 0..N {
        let sum: f64 =
            values.iter().enumerate().map(|(j, f)| f * (PI * (k * (2 * j + 1)) as f64 / (2 * N) as f64).cos()).sum();
        let weight = sum * if k == 0 { 1.0 } else { 2.0 } / N as f64;
        powers.iter_mut().zip(current).for_each(|(p, c)| *p += weight * c);
        let mut next = before.map(|c| -c);
        let factor = if k == 0 { 1.0 } else { 2.0 };
        for power in 1..N {
            next[power] += factor * current[power - 1];
        }
        (before, current) = (current, next);
    }
    powers
}

/// The value at t of a polynomial given by the coefficients of 1, t, t², ….
#[inline(always)]
pub fn evaluate<const N: usize>(coefficients: &[f64; N], t: f64) -> f64 {
    let mut sum = 0.0;
    for k in (0..N).rev() {
        sum = sum * t + coefficients[k];
    }
    sum
}
