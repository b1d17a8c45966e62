//! Integrals along an axis of a patch.

use super::*;

const BAND: [f64; 2] = [8.0e6, 16.6e6];

fn value(axis: Axis, form: Form, k: f64) -> f64 {
    let mut values = [1.0; 11];
    multiply(axis, form, &[k; 11], &mut values);
    values[3]
}

#[test]
fn every_form_agrees_with_sine_integrals() {
    let mut seen = [0; 5];
    for i in 0..300 {
        let path = 1e-9 * 1.05_f64.powi(i);
        for spread in [0.0, 1e-15, 4e-9, 0.05e-6, 0.23e-6, 4.6e-6] {
            let axis = Axis { path, spread };
            let form = axis.form(BAND, false);
            let (kind, error) = match form {
                Form::Point => (0, 1e-13),
                Form::Narrow => (1, 4e-8),
                Form::Far { .. } => (2, 2e-9),
                Form::Tabulated => (3, 1e-11),
                Form::Wide => (4, 4e-9),
                _ => continue,
            };
            seen[kind] += 1;
            for k in [BAND[0], 11.3e6, BAND[1]] {
                let (found, exact) = (value(axis, form, k), mean_sinc_squared(k * path, k * spread));
                let envelope = axis.bounds([k, k]).largest;
                let off = (found - exact).abs() / envelope;
                assert!(off < error, "{axis:?}, {form:?}: {found:e}, not {exact:e}");
            }
        }
    }
    assert!(seen.into_iter().all(|count| count > 20), "{seen:?}");
}

#[test]
fn bounds_hold() {
    for i in 0..400 {
        for spread in [0.0, 4e-9, 0.05e-6, 0.23e-6, 4.6e-6] {
            let axis = Axis { path: 1e-9 * 1.04_f64.powi(i), spread };
            let bounds = axis.bounds(BAND);
            for k in (0..200).map(|j| BAND[0] + 43e3 * f64::from(j)) {
                let exact = mean_sinc_squared(k * axis.path, k * spread);
                assert!(exact <= bounds.largest * (1.0 + 1e-9), "{axis:?}");
                if bounds.oscillation.is_finite() {
                    let smooth = value(axis, axis.smooth(), k);
                    assert!(smooth <= bounds.smooth * (1.0 + 1e-9), "{axis:?}");
                    assert!((exact - smooth).abs() <= bounds.oscillation * (1.0 + 1e-6) + 1e-15, "{axis:?}");
                }
            }
        }
    }
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let node = |nm: f64| crate::render::measure::Node {
        wavelength_nm: nm,
        scale: (550.0 / nm).powi(2),
        weights: [0.3, 0.1, -0.2],
        reference: 0.6,
    };
    let dense: Vec<_> = (0..40).map(|i| node(400.0 + 8.0 * f64::from(i))).collect();
    let rules = super::super::rules::CoherentRules::new(&dense);
    let grid = rules.smallest(&dense, 1.0, 0.0, 1e-9);
    for i in 0..200 {
        let axes = [1.07_f64, 1.11].map(|step| Axis { path: 1e-9 * step.powi(i), spread: 0.02e-6 * step.powi(i % 50) });
        let axes = axes.map(|axis| (axis, axis.form(BAND, false)));
        assert_eq!(sum(grid, &axes, 0.7), sum_portable(grid, &axes, 0.7));
    }
}
