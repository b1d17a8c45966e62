//! IDT matrices against those published with rawtoaces and colour-science.

use chromascope_core::correction::aces::{Idt, IdtError, IdtExposure, input_device_transform};

use super::off;
use crate::support::{CIE_1931, light, sensor, training};

fn idt(camera: &str, illuminant: &str, exposure: IdtExposure) -> Idt {
    let (camera, observer) = (sensor(camera), sensor(CIE_1931));
    input_device_transform(&camera, &light(illuminant), &observer, &training(), exposure, None).unwrap()
}

/// D200 under studio tungsten: balance and matrix of rawtoaces' own data, fitted by Ceres and again by colour-science 0.4.7.
#[test]
fn d200_under_studio_tungsten_is_that_of_rawtoaces() {
    let idt = idt("cameras/nikon_d200.csv", "illuminants/iso_7589_studio_tungsten.csv", IdtExposure::Rawtoaces);
    for (got, known) in idt.balance.iter().zip([1.139_726_5, 1.0, 2.324_015_1]) {
        assert!((got - known).abs() < 1e-6, "{:?}", idt.balance);
    }
    let rows = [
        [0.744_769_1, 0.143_420_0, 0.111_810_8],
        [0.045_176_0, 1.008_262_2, -0.053_438_2],
        [0.024_714_4, -0.124_552_5, 1.099_838_1],
    ];
    assert!(off(idt.matrix, rows) < 1e-5, "{}", idt.matrix);
}

/// Nikon D5100 (NPL) under D55: `colour.matrix_idt` of colour-science 0.4.7.
#[test]
fn d5100_under_d55_is_that_of_colour_science() {
    let idt = idt("cameras/nikon_d5100_npl.csv", "illuminants/d55.csv", IdtExposure::Rawtoaces);
    let rows =
        [[0.593_682, 0.304_184, 0.102_135], [0.004_580, 1.149_460, -0.154_040], [0.035_522, -0.163_123, 1.127_601]];
    assert!(off(idt.matrix, rows) < 1e-5, "{}", idt.matrix);
    // Each channel of the table peaks at 1; rawtoaces scales by the first, red, so it fits RGB that is 1.582 for white.
    assert!((idt.white_signal - 1.582_141_88).abs() < 1e-6, "{}", idt.white_signal);
}

#[test]
fn rows_sum_to_one_and_a_white_at_one_fits_better() {
    let mean = |idt: &Idt| idt.errors.iter().sum::<f64>() / idt.errors.len() as f64;
    let [bright, at_one] = [IdtExposure::Rawtoaces, IdtExposure::WhiteAtOne]
        .map(|exposure| idt("cameras/nikon_d5100_npl.csv", "illuminants/d55.csv", exposure));
    for idt in [&bright, &at_one] {
        for row in 0..3 {
            assert!((idt.matrix.row(row).element_sum() - 1.0).abs() < 1e-12);
        }
    }
    assert_eq!(at_one.white_signal, 1.0);
    assert!(mean(&at_one) < mean(&bright), "{} {}", mean(&at_one), mean(&bright));
}

#[test]
fn what_is_no_camera_is_refused() {
    let observer = sensor(CIE_1931);
    let light = light("illuminants/d55.csv");
    let exposure = IdtExposure::default();
    assert_eq!(
        input_device_transform(&observer, &light, &observer, &training(), exposure, None),
        Err(IdtError::NotCamera)
    );
    let camera = sensor("cameras/nikon_d200.csv");
    assert_eq!(input_device_transform(&camera, &light, &camera, &training(), exposure, None), Err(IdtError::Reference));
    let dark = chromascope_core::spectral::GridSpectrum::constant(0.0);
    let refused = input_device_transform(&camera, &dark, &observer, &training(), exposure, None);
    assert_eq!(refused, Err(IdtError::BlindToLight { channel: 0 }));
}

/// With the neutral of a raw file the multipliers are its reciprocals; of the table's own nothing changes.
#[test]
fn a_neutral_replaces_the_tables_ratio() {
    let (camera, observer) = (sensor("cameras/nikon_d5100.csv"), sensor(CIE_1931));
    let light = light("illuminants/d55.csv");
    let of =
        |neutral, exposure| input_device_transform(&camera, &light, &observer, &training(), exposure, neutral).unwrap();
    let plain = of(None, IdtExposure::WhiteAtOne);
    let given = of(Some("0.5,1,0.7".parse().unwrap()), IdtExposure::WhiteAtOne);
    assert_eq!(given.matrix, plain.matrix, "it takes balanced RGB");
    for (got, known) in given.balance.iter().zip([2.0, 1.0, 1.0 / 0.7]) {
        assert!((got - known).abs() < 1e-15, "{:?}", given.balance);
    }
    let own: Vec<String> = plain.balance.iter().map(|v| v.recip().to_string()).collect();
    let again = of(Some(own.join(",").parse().unwrap()), IdtExposure::Rawtoaces);
    assert!(off(again.matrix, rows_of(of(None, IdtExposure::Rawtoaces).matrix)) < 1e-9);
}

fn rows_of(matrix: glam::DMat3) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| matrix.row(row).to_array())
}
