//! A leaf's transmittance from its reflectance.

use chromascope_core::reflectance::leaf::LeafModel;

/// 1 − τ(40°) at n = 1.45: the first face's reflection, which the measured reflectance leaves out.
const FIRST_FACE: f64 = 0.035_197_469_107_156_8;

/// PROSPECT's plates written with numpy, Fresnel's integrals by QUADPACK, the inner transmittance by Brent's method: reflectance with
/// the first face's, and transmittance.
const REFERENCE: [[f64; 2]; 7] = [
    [0.04, 0.013_747_354_6],
    [0.05, 0.032_205_676_3],
    [0.08, 0.075_312_646_5],
    [0.12, 0.124_367_912_0],
    [0.2, 0.213_307_178_7],
    [0.3, 0.318_239_955_2],
    [0.45, 0.471_163_871_5],
];

#[test]
fn transmittance_is_that_of_the_plate_model() {
    for [reflectance, expected] in REFERENCE {
        let got = LeafModel::new().transmittance(reflectance - FIRST_FACE);
        assert!((got - expected).abs() < 2e-8, "{reflectance}: {got} for {expected}");
    }
}

#[test]
fn it_is_total_and_conserves_energy() {
    let leaf = LeafModel::new();
    assert_eq!([leaf.transmittance(f64::NAN), leaf.transmittance(-1.0), leaf.transmittance(0.0)], [0.0; 3]);
    let values: Vec<f64> = (0..=100).map(|i| leaf.transmittance(f64::from(i) / 100.0)).collect();
    assert!(values.windows(2).all(|two| two[0] <= two[1]), "it grows with the reflectance");
    assert!(values.iter().zip(0..45).all(|(t, i)| t + f64::from(i) / 100.0 + FIRST_FACE <= 1.0 + 1e-9));
    assert!(values[100] < 0.52, "no more than plates that absorb nothing");
}
