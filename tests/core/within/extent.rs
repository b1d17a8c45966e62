//! Extents of plans.

use super::*;

#[test]
fn logarithms_are_near_enough() {
    let off = |i: i32| {
        let x = 1.003_f64.powi(i);
        (ln(x) - x.ln()).abs() / x.ln().abs().max(1.0)
    };
    assert!((-60_000..=60_000).map(off).fold(0.0, f64::max) < 2e-14);
    // Where there is nothing to be seen v is above 1.
    for kappa in [1e-3, 1.0, 1000.0] {
        let extent = Extent::new([1e-3, 1000.0]);
        for beta in [f64::INFINITY, f64::NAN, f64::MAX] {
            assert!(extent.place(kappa, beta)[1] > 1.0, "{beta}");
        }
    }
}

#[test]
fn places_and_what_lies_there_belong_together() {
    for kappa in [[1e-3, 300.0], [0.5, 1.0], [1e-15, 1e-9]] {
        let extent = Extent::new(kappa);
        for (t, v) in [(-1.0, 0.0), (-0.3, 0.2), (0.4, 0.77), (1.0, 1.0)] {
            let [kappa, beta] = extent.at(t, v);
            let place = extent.place(kappa, beta);
            assert!((place[0] - t).abs() < 1e-12 && (place[1] - v).abs() < 1e-12, "{t} {v}: {place:?}");
            let last = ln_last(kappa);
            let edge = extent.place(kappa, last.exp_m1())[1];
            assert!(edge <= 1.0 + 1e-4 && edge > 0.97, "{kappa}: {edge}");
        }
    }
}
