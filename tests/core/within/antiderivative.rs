//! The table of the antiderivative.

use super::*;

#[test]
fn the_table_agrees_with_sine_integrals() {
    let mut worst = 0.0_f64;
    for i in 0..20_000 {
        let u = 0.0128 * f64::from(i);
        worst = worst.max((at(u) - derivatives(u)[0]).abs());
        assert_eq!(at(-u), -at(u));
    }
    assert!(worst < 1e-11, "{worst:.1e}");
}
