//! Minimum of a function of one variable.

/// Place of the minimum between two ends of a function that has one there, by golden sections: one evaluation a step, until the ends are
/// at most `width` apart, or as near as rounding lets them come.
///
/// ```
/// use chromascope_math::minimum::minimum;
/// assert!((minimum(0.0, 3.0, 1e-7, |x| (x - 1.3_f64).abs()) - 1.3).abs() < 1e-7);
/// ```
pub fn minimum(mut low: f64, mut high: f64, width: f64, f: impl Fn(f64) -> f64) -> f64 {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let width = width.max(4.0 * f64::EPSILON * low.abs().max(high.abs()));
    let (mut left, mut right) = (high - RATIO * (high - low), low + RATIO * (high - low));
    let (mut of_left, mut of_right) = (f(left), f(right));
    while high - low > width {
        if of_left < of_right {
            (high, right, of_right) = (right, left, of_left);
            left = high - RATIO * (high - low);
            of_left = f(left);
        } else {
            (low, left, of_left) = (left, right, of_right);
            right = low + RATIO * (high - low);
            of_right = f(right);
        }
    }
    f64::midpoint(low, high)
}
