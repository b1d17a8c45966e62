//! Rules over wave numbers.

use super::*;

/// Error of a rule at the worst of many places, for weights at single wavelengths.
fn interpolation_error(count: usize, omega: f64, kappa: f64) -> f64 {
    let band = Band::new(FIRST_NM, LAST_NM);
    let path = omega / (2.0 * TAU * band.half);
    let largest = (-kappa * (LAMBDA_0 * 1e9 / LAST_NM).powi(2)).exp();
    let f = |wave_number: f64, scale: f64| {
        let (sin, cos) = (2.0 * wave_number * path).sin_cos();
        [sin, cos].map(|wave| wave * (-kappa * scale).exp() / largest)
    };
    let mut worst = 0.0_f64;
    for i in 0..80 {
        let wavelength_nm = FIRST_NM + 5.0 * f64::from(i) + 0.3;
        let scale = (LAMBDA_0 * 1e9 / wavelength_nm).powi(2);
        let node = Node { wavelength_nm, scale, weights: [1.0; 3], reference: 1.0 };
        let rule = Rule::chebyshev(&[node], band, count);
        let mut sums = [0.0; 2];
        for m in 0..count {
            let values = f(rule.wave_numbers[m], rule.scales[m]);
            (0..2).for_each(|j| sums[j] += rule.weights[0][m] * values[j]);
        }
        let exact = f(TAU / (wavelength_nm * 1e-9), scale);
        worst = worst.max((sums[0] - exact[0]).abs()).max((sums[1] - exact[1]).abs());
    }
    worst
}

#[test]
fn rules_follow_what_they_are_chosen_for() {
    let mut tried = 0;
    for omega in [0.0, 3.0, 11.0, 40.0, 110.0] {
        for kappa in [0.0, 0.9, 7.0, 40.0] {
            for share in [1e-2, 1e-5, 1e-9] {
                let Some(&count) = COUNTS.get(nodes_needed(omega, kappa, share)) else { continue };
                let error = interpolation_error(count, omega, kappa);
                assert!(error <= share, "{count} nodes, ω {omega}, κ {kappa}: {error:.1e}, not {share:e}");
                tried += 1;
            }
        }
    }
    assert!(tried > 50, "{tried}");
}

#[test]
fn few_nodes_follow_short_paths() {
    assert_eq!(nodes_needed(0.0, 0.0, 1e-6), 1);
    assert!(COUNTS[nodes_needed(8.5, 1.0, 1e-5)] <= 32);
    assert_eq!(nodes_needed(1e6, 0.0, 0.1), COUNTS.len());
    assert_eq!(nodes_needed(f64::NAN, 0.0, 0.1), COUNTS.len());
    assert_eq!(nodes_needed(1.0, 1e9, 0.1), COUNTS.len());
    assert_eq!(nodes_needed(1.0, 1.0, 0.0), COUNTS.len());
}
