//! Quantiles of samples.

/// Quantile of values in any order, linear between the order statistics `x₀ ≤ … ≤ xₙ₋₁` (type 7 of Hyndman and Fan 1996, the
/// default of `NumPy` and R); none of nothing. The values are reordered.
///
/// ```text
/// Q(p) = x_⌊h⌋ + (h − ⌊h⌋)(x_⌊h⌋₊₁ − x_⌊h⌋),   h = (n − 1) p
/// ```
///
/// ```
/// # use chromascope_math::quantile::quantile;
/// assert_eq!(quantile(&mut [4.0, 1.0, 3.0, 2.0], 0.5), Some(2.5));
/// assert_eq!(quantile(&mut [], 0.5), None);
/// ```
pub fn quantile(values: &mut [f64], share: f64) -> Option<f64> {
    let h = values.len().checked_sub(1)? as f64 * share.clamp(0.0, 1.0);
    let (_, &mut below, above) = values.select_nth_unstable_by(h as usize, f64::total_cmp);
    let next = above.iter().copied().min_by(f64::total_cmp).unwrap_or(below);
    Some(below + (next - below) * (h - h as usize as f64))
}
