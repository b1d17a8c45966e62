//! The mirror lobe along one axis, read from a table: quicker than the sine integrals of [`crate::reflectance::coherent`].

use crate::reflectance::coherent::{mean_sinc_squared, sinc, sine_integral};
use std::sync::LazyLock;

/// Steps of the table to a radian.
const STEPS: f64 = 16.0;
/// Where the table ends, in radians.
const LAST: f64 = 700.0;

/// `H(u) = Si(2u) − sin² u / u` and its slope `sinc² u` at each step.
static ANTIDERIVATIVE: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
    let at = |i: usize| {
        let u = i as f64 / STEPS;
        let slope = sinc(u).powi(2);
        [sine_integral(2.0 * u) - u * slope, slope / STEPS]
    };
    (0..=(LAST * STEPS) as usize + 1).map(at).collect()
});

/// The mean of sinc² over `u − w ..= u + w`, within 1e-7.
///
/// By cubics between the values and slopes of its antiderivative; by four nodes where the interval is short; exactly far
/// out.
#[inline]
pub fn mean_sinc_squared_quick(u: f64, w: f64) -> f64 {
    let u = u.abs();
    if w <= 0.0 {
        return sinc(u).powi(2);
    }
    if w <= 0.5 {
        return by_four_nodes(u, w);
    }
    if u + w < LAST {
        let table = ANTIDERIVATIVE.as_slice();
        return (read(table, u + w) - read(table, u - w)) / (2.0 * w);
    }
    mean_sinc_squared(u, w)
}

/// Gauss and Legendre's rule: error below 2e-8 up to w = 1/2.
fn by_four_nodes(u: f64, w: f64) -> f64 {
    const PAIRS: [[f64; 2]; 2] =
        [[0.339_981_043_584_856_3, 0.652_145_154_862_546_1], [0.861_136_311_594_052_6, 0.347_854_845_137_453_9]];
    let pair = |[node, weight]: [f64; 2]| {
        let (below, above) = (sinc(u - w * node), sinc(u + w * node));
        weight * (below * below + above * above)
    };
    PAIRS.into_iter().map(pair).sum::<f64>() / 2.0
}

/// H(u), odd in u, |u| below the table's end.
#[inline]
fn read(table: &[[f64; 2]], u: f64) -> f64 {
    let position = u.abs() * STEPS;
    let index = position as usize;
    let t = position - index as f64;
    let ([a, slope_a], [b, slope_b]) = (table[index], table[index + 1]);
    let rise = b - a;
    let value = a + t * (slope_a + t * (3.0 * rise - 2.0 * slope_a - slope_b + t * (slope_a + slope_b - 2.0 * rise)));
    value.copysign(u)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quick_is_near_exact() {
        let mut worst = 0.0_f64;
        for i in 0..4000 {
            let u = 0.173 * f64::from(i) * (1.0 + f64::from(i % 7));
            for w in [0.0, 1e-3, 0.3, 0.5, 0.51, 1.0, 2.65, 17.0, 400.0] {
                worst = worst.max((mean_sinc_squared_quick(u, w) - mean_sinc_squared(u, w)).abs());
            }
        }
        assert!(worst < 1e-7, "{worst:.1e}");
    }
}
