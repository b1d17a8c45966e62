//! Splines of plans.

use super::*;

/// The largest errors of the spline for e^(x/4) in parts of its derivative: at the ends and between.
fn errors(degree: usize) -> [f64; 2] {
    let (intervals, step) = (48, 0.25_f64);
    let half = 0.5 * step * intervals as f64;
    let axis = Axis::new(degree, intervals);
    let mut spline: Vec<f64> = axis.sites().iter().map(|x| (half * (2.0 * x - 1.0)).exp()).collect();
    axis.solve(&mut spline, 1);
    let mut worst = [0.0_f64; 2];
    for i in 0..intervals * 40 {
        let x = (i as f64 + 0.5) / 40.0;
        let cell = x.floor();
        let weights = at_place(degree, 2.0 * (x - cell) - 1.0);
        let found: f64 = weights.iter().zip(&spline[cell as usize..]).map(|(w, c)| w * c).sum();
        let exact = (step * x - half).exp();
        let error = (found - exact).abs() / exact / step.powf((degree + 1) as f64);
        let end = usize::from((20.0..28.0).contains(&x));
        worst[end] = worst[end].max(error);
    }
    worst
}

#[test]
fn errors_are_those_of_splines_up_to_the_ends() {
    // The largest of (B_{p+1}(t) − B_{p+1})/(p + 1)!, Bernoulli's polynomials.
    for (degree, expected) in [(3, 1.0 / 384.0), (5, 6.5e-5), (7, 1.65e-6), (9, 4.2e-8)] {
        let [ends, between] = errors(degree);
        assert!((between / expected - 1.0).abs() < 0.15, "{degree}: {between}");
        assert!(ends < 4.0 * expected, "{degree}: {ends}");
    }
}

#[test]
fn weights_sum_to_one() {
    fn off<const N: usize>() -> f64 {
        let s = std::array::from_fn(|i| i as f64 / (0.5 * (BLOCK - 1) as f64) - 1.0);
        let mut all = [[0.0; BLOCK]; N];
        weights(&s, &mut all);
        let alike = |i: usize| {
            let one = at_place(N - 1, s[i]);
            let apart = (0..N).map(|k| (one[k] - all[k][i]).abs()).fold(0.0, f64::max);
            apart.max((all.iter().map(|w| w[i]).sum::<f64>() - 1.0).abs())
        };
        (0..BLOCK).map(alike).fold(0.0, f64::max)
    }
    let worst = [off::<4>(), off::<6>(), off::<8>(), off::<10>()];
    assert!(worst.iter().all(|&off| off < 1e-15), "{worst:?}");
}
