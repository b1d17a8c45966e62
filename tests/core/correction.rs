//! Color correction against `SciPy`, colour-science, published matrices, and a second way of computing.

mod aces;
mod lights;
mod root_polynomial;

use chromascope_core::colorimetry::{Metric, Stimulus, Xyz};
use chromascope_core::correction::aces::XYZ_FROM_ACES;
use chromascope_core::correction::classes::{ClassWeights, ColorClass};
use chromascope_core::correction::minimize::Objective;
use chromascope_core::correction::root_polynomial::Degree;
use chromascope_core::correction::{Correction, CorrectionMethod, RgbTransform, Training};
use chromascope_core::math::least_squares::FitError;
use glam::{DMat3, DVec3};

use crate::support::reference_numbers;

/// Balanced RGB and XYZ of 190 reflectances.
pub(super) struct Set {
    pub(super) samples: Vec<DVec3>,
    pub(super) targets: Vec<DVec3>,
    pub(super) weights: Vec<f64>,
}

impl Set {
    pub(super) fn training(&self) -> Training<'_> {
        Training { samples: &self.samples, targets: &self.targets, weights: &self.weights }
    }
}

/// The reference table's samples; ACES white.
pub(super) fn set() -> Set {
    let rows = reference_numbers("idt_training_d5100_npl_d55.csv");
    let samples = rows.iter().map(|row| DVec3::new(row[0], row[1], row[2])).collect();
    let targets = rows.iter().map(|row| DVec3::new(row[3], row[4], row[5])).collect();
    Set { samples, targets, weights: vec![1.0; rows.len()] }
}

pub(super) fn white() -> Xyz {
    Xyz::from_vector(XYZ_FROM_ACES * DVec3::ONE)
}

pub(super) fn correction(method: CorrectionMethod, keeps_white: bool) -> Correction {
    Correction { method, keeps_white, ..Correction::default() }
}

fn matrix(fit: &RgbTransform) -> DMat3 {
    match fit {
        RgbTransform::Matrix(matrix) => *matrix,
        RgbTransform::RootPolynomial(_) => panic!("a matrix was asked for"),
    }
}

/// Largest difference of a matrix from rows.
pub(super) fn off(matrix: DMat3, rows: [[f64; 3]; 3]) -> f64 {
    let places = (0..9).map(|i| (i / 3, i % 3));
    places.map(|(row, column)| (matrix.col(column)[row] - rows[row][column]).abs()).fold(0.0, f64::max)
}

pub(super) fn differences(set: &Set, colors: &[DVec3], metric: Metric) -> Vec<f64> {
    let stimulus = |xyz: &DVec3| Stimulus::new(Xyz::from_vector(*xyz), white());
    let pairs = set.targets.iter().zip(colors);
    pairs.map(|(target, color)| metric.between(&stimulus(target), &stimulus(color)).unwrap()).collect()
}

fn through(set: &Set, fit: &RgbTransform) -> Vec<DVec3> {
    set.samples.iter().map(|rgb| fit.xyz(*rgb)).collect()
}

/// Rounding error of a root polynomial at white: its coefficients grow with the degree and cancel.
pub(super) fn rounding(fit: &RgbTransform) -> f64 {
    let RgbTransform::RootPolynomial(polynomial) = fit else { return 0.0 };
    22.0 * f64::EPSILON * polynomial.coefficients().iter().map(|c| c.abs().max_element()).sum::<f64>()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Means by `SciPy`'s Nelder–Mead, run to 1e-13 from the least-squares matrix and again from its own result, with ΔE of
/// colour-science 0.4.7.
const MINIMA: [(Objective, bool, f64); 6] = [
    (Objective::LabSquares, true, 1_481.025_856_034_291_3),
    (Objective::DeltaE1976, true, 2.213_495_654_791_622_2),
    (Objective::DeltaE2000, true, 1.146_465_949_465_199_9),
    (Objective::LabSquares, false, 1_316.145_265_767_388_8),
    (Objective::DeltaE1976, false, 2.125_447_811_824_677_6),
    (Objective::DeltaE2000, false, 1.102_896_875_150_865_2),
];

#[test]
fn minima_are_not_above_those_of_another_optimizer() {
    let set = set();
    for (objective, keeps_white, known) in MINIMA {
        let fit = set.training().fit(&correction(CorrectionMethod::Minimize(objective), keeps_white), white()).unwrap();
        let colors = through(&set, &fit);
        let metric = if objective == Objective::DeltaE2000 { "delta-e2000" } else { "delta-e1976" };
        let errors = differences(&set, &colors, Metric::by_id(metric).unwrap());
        let value = match objective {
            Objective::LabSquares => errors.iter().map(|e| e * e).sum::<f64>(),
            _ => mean(&errors),
        };
        let above = value / known - 1.0;
        assert!(above.abs() < 2e-6, "{objective:?} {keeps_white}: {value} is {above:e} above {known}");
    }
}

#[test]
fn least_squares_in_xyz_are_those_of_numpy() {
    let set = set();
    let free = set.training().fit(&correction(CorrectionMethod::LeastSquares, false), white()).unwrap();
    let kept = set.training().fit(&correction(CorrectionMethod::LeastSquares, true), white()).unwrap();
    // numpy.linalg.lstsq on the table, without and with white eliminated.
    let rows = [
        [0.691_481_743_612_034_2, 0.180_390_266_423_125_14, 0.067_676_753_895_116_29],
        [0.272_276_175_297_470_34, 0.939_233_860_973_057_9, -0.220_520_473_515_824_96],
        [0.083_654_968_582_292_72, -0.354_021_400_588_093_56, 1.265_116_901_103_707_1],
    ];
    assert!(off(matrix(&free), rows) < 1e-9);
    let rows = [
        [0.689_803_505_275_454_6, 0.186_281_383_062_868_15, 0.076_561_186_231_523_53],
        [0.271_121_612_988_418, 0.943_286_718_712_169_1, -0.214_408_331_700_587_15],
        [0.081_851_489_428_045_39, -0.347_690_651_359_310_7, 1.274_664_346_282_850_9],
    ];
    assert!(off(matrix(&kept), rows) < 1e-7);
}

#[test]
fn white_is_kept_exactly_where_it_is_asked_for() {
    let set = set();
    for method in CorrectionMethod::ALL {
        let fit = set.training().fit(&correction(method, true), white()).unwrap();
        let error = (fit.xyz(DVec3::ONE) - white().to_vector()).abs().max_element();
        assert!(error < 1e-12_f64.max(rounding(&fit)), "{method:?}: {error:e}");
    }
    let free = set.training().fit(&correction(CorrectionMethod::LeastSquares, false), white()).unwrap();
    assert!(
        (free.xyz(DVec3::ONE) - white().to_vector()).abs().max_element() > 1e-3,
        "the free fit has no reason to keep white"
    );
}

/// A camera that is a linear combination of the observer is corrected to nothing by every fit.
#[test]
fn an_exact_camera_is_recovered_exactly() {
    let rows = [[0.6, 0.3, 0.052_646], [0.25, 0.8, -0.05], [0.02, -0.1, 1.088_825]];
    let camera = DMat3::from_cols_array_2d(&rows).transpose();
    let white = Xyz::from_vector(camera * DVec3::ONE);
    let mut set = set();
    set.targets = set.samples.iter().map(|rgb| camera * *rgb).collect();
    for method in CorrectionMethod::ALL.into_iter().filter(|method| *method != CorrectionMethod::None) {
        for keeps_white in [true, false] {
            let fit = set.training().fit(&correction(method, keeps_white), white).unwrap();
            let worst = set.samples.iter().map(|rgb| (fit.xyz(*rgb) - camera * *rgb).abs().max_element());
            let worst = worst.fold(0.0, f64::max);
            assert!(worst < 1e-9, "{method:?} {keeps_white}: {worst:e}");
        }
    }
}

#[test]
fn leave_one_out_equals_refitting() {
    let mut set = set();
    set.weights = (0..set.weights.len()).map(|i| 1.0 + (i % 3) as f64).collect();
    let methods = [CorrectionMethod::LeastSquares].into_iter().chain(DEGREES.map(CorrectionMethod::RootPolynomial));
    for method in methods {
        for keeps_white in [true, false] {
            let correction = correction(method, keeps_white);
            let fitted = set.training().fit(&correction, white()).unwrap();
            let short = set.training().leave_one_out(&correction, white(), &fitted, || false).unwrap();
            let long = set.training().refitted(&correction, white(), &fitted, || false);
            for (short, long) in short.iter().zip(&long) {
                let (short, long) = (short.unwrap(), long.unwrap());
                assert!((short - long).abs().max_element() < 1e-8, "{method:?} {keeps_white}: {short} {long}");
            }
        }
    }
}

#[test]
fn refitting_ends_when_it_is_told_to() {
    let set = set();
    let correction = correction(CorrectionMethod::Minimize(Objective::LabSquares), true);
    let fitted = set.training().fit(&correction, white()).unwrap();
    let asked = std::sync::atomic::AtomicUsize::new(0);
    let stop = || asked.fetch_add(1, std::sync::atomic::Ordering::Relaxed) >= 5;
    let left_out = set.training().leave_one_out(&correction, white(), &fitted, stop).unwrap();
    assert_eq!(left_out.iter().flatten().count(), 5);
}

const DEGREES: [Degree; 3] = [Degree::Two, Degree::Three, Degree::Four];

#[test]
fn errors_left_out_exceed_those_of_training() {
    let set = set();
    for method in CorrectionMethod::ALL.into_iter().filter(|method| *method != CorrectionMethod::None) {
        let correction = correction(method, true);
        let fitted = set.training().fit(&correction, white()).unwrap();
        let trained = through(&set, &fitted);
        let left_out: Option<Vec<DVec3>> =
            set.training().leave_one_out(&correction, white(), &fitted, || false).unwrap().into_iter().collect();
        let [trained, left_out] =
            [trained, left_out.unwrap()].map(|colors| mean(&differences(&set, &colors, Metric::DELTA_E_2000)));
        assert!(left_out > trained, "{method:?}: {left_out} {trained}");
    }
}

#[test]
fn a_weight_counts_as_often_as_the_reflectance_were_there() {
    let mut twice = set();
    for i in 0..40 {
        twice.samples.push(twice.samples[i]);
        twice.targets.push(twice.targets[i]);
        twice.weights.push(1.0);
    }
    let mut weighted = set();
    weighted.weights[..40].fill(2.0);
    for method in CorrectionMethod::ALL {
        let [a, b] = [&twice, &weighted].map(|set| set.training().fit(&correction(method, true), white()).unwrap());
        let worst = twice.samples.iter().map(|rgb| (a.xyz(*rgb) - b.xyz(*rgb)).abs().max_element()).fold(0.0, f64::max);
        assert!(worst < 2e-6, "{method:?}: {worst:e}");
    }
}

#[test]
fn classes_find_the_memory_colors_of_a_chart() {
    // L*a*b* (D50) of dark skin, light skin, blue sky, foliage, neutral 5 and red of the ColorChecker (BabelColor average).
    let lab = |l, a, b| chromascope_core::colorimetry::Lab { l, a, b };
    assert_eq!(ColorClass::of(lab(37.99, 13.56, 14.06)), Some(ColorClass::Skin));
    assert_eq!(ColorClass::of(lab(65.71, 18.13, 17.81)), Some(ColorClass::Skin));
    assert_eq!(ColorClass::of(lab(49.93, -4.88, -21.93)), Some(ColorClass::Sky));
    assert_eq!(ColorClass::of(lab(43.14, -13.1, 21.91)), Some(ColorClass::Foliage));
    assert_eq!(ColorClass::of(lab(50.87, -0.15, -0.27)), Some(ColorClass::Neutral));
    assert_eq!(ColorClass::of(lab(42.1, 53.38, 28.19)), None);
    let weights = ClassWeights::new(ColorClass::ALL.map(|class| if class == ColorClass::Sky { f64::NAN } else { 1e9 }));
    assert_eq!(weights.of(ColorClass::Sky), 1.0);
    assert_eq!(weights.of(ColorClass::Skin), ClassWeights::MOST);
}

#[test]
fn hopeless_training_is_refused() {
    let set = set();
    let few = Training { samples: &set.samples[..4], targets: &set.targets[..4], weights: &set.weights[..4] };
    let fit = few.fit(&correction(CorrectionMethod::RootPolynomial(Degree::Two), true), white());
    assert_eq!(fit, Err(FitError::TooFew { samples: 4, needed: 5 }));
    let nothing = Training { samples: &[], targets: &[], weights: &[] };
    for method in CorrectionMethod::ALL.into_iter().filter(|method| *method != CorrectionMethod::None) {
        for keeps_white in [true, false] {
            assert!(nothing.fit(&correction(method, keeps_white), white()).is_err(), "{method:?}");
        }
    }
    let huge: Vec<DVec3> = set.samples.iter().map(|rgb| *rgb * 1e300).collect();
    let no_weight = vec![0.0; set.weights.len()];
    for method in CorrectionMethod::ALL {
        for (samples, weights) in [(&huge, &set.weights), (&set.samples, &no_weight)] {
            let training = Training { samples, targets: &set.targets, weights };
            if let Ok(fit) = training.fit(&correction(method, false), white()) {
                assert!(fit.xyz(DVec3::ONE).is_finite(), "{method:?}");
            }
        }
    }
}

#[test]
fn ids_name_one_method_each() {
    for method in CorrectionMethod::ALL {
        assert_eq!(CorrectionMethod::by_id(method.id()), Some(method));
    }
}

#[test]
fn weights_that_are_all_zero_are_refused_with_a_remedy() {
    let set = Set { weights: vec![0.0; set().weights.len()], ..set() };
    let methods = [
        CorrectionMethod::LeastSquares,
        CorrectionMethod::Minimize(Objective::DeltaE2000),
        CorrectionMethod::RootPolynomial(Degree::Two),
    ];
    for (method, keeps_white) in methods.into_iter().flat_map(|method| [(method, true), (method, false)]) {
        let error = set.training().fit(&correction(method, keeps_white), white()).unwrap_err();
        assert_eq!(error, FitError::NoWeight, "{method:?}");
        assert!(error.to_string().contains("give at least one class a weight above 0"));
    }
    let uncorrected = correction(CorrectionMethod::None, true);
    assert!(set.training().fit(&uncorrected, white()).is_ok(), "weights do not matter without a fit");
}
