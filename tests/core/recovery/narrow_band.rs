//! Narrow bands: two passes of a Nikon D70 against the sensitivities that its measurers published from them, and synthetic bands.

use chromascope_core::recovery::{Band, Cell, Library, NarrowBandError, NarrowBands, Pass};

use super::support::cameras;
use crate::support::dataset;

fn pass(number: usize) -> Pass {
    let table = dataset(&format!("test-samples/nikon_d70_narrowband_pass{number}.csv"));
    let column = |at: usize, row: usize| table.curves[at].values()[row];
    let band = |(row, nm): (usize, &f64)| Band {
        wavelength_nm: *nm,
        width_nm: None,
        power: column(0, row),
        exposure: column(1, row),
        lit: [2, 3, 4].map(|at| column(at, row)),
        dark: [5, 6, 7].map(|at| column(at, row)),
    };
    table.curves[0].wavelengths_nm().iter().enumerate().map(band).collect()
}

fn library(nm: &[f64], omitted: &str) -> Library {
    Library::new(cameras().into_iter().filter(|(name, _)| !name.contains(omitted)), nm)
}

/// Root mean square of the difference relative to the peak, at the scale that fits best.
fn relative_to_peak(own: &[f64], published: &[f64]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let scale = dot(own, published) / dot(own, own);
    let squares: f64 = own.iter().zip(published).map(|(own, value)| (scale * own - value).powi(2)).sum();
    (squares / own.len() as f64).sqrt() / published.iter().copied().fold(0.0, f64::max)
}

#[test]
fn quotients_of_two_passes_are_the_published_sensitivities() {
    let bands = NarrowBands { passes: vec![pass(1), pass(2)], clip: 16384.0 };
    let nm = bands.wavelengths_nm().unwrap();
    let found = bands.recover(&library(&nm, "nikon_d70")).unwrap();
    let published = dataset("test-samples/nikon_d70_published.csv");
    // By hand: 0.36, 0.12 and 0.24 % of the peak where no pass is saturated.
    for (c, expected) in [0.0036, 0.0012, 0.0024].into_iter().enumerate() {
        let kept: Vec<usize> = (0..nm.len()).filter(|k| found.cells[c][*k] != Cell::Saturated).collect();
        let of = |values: &[f64]| kept.iter().map(|k| values[*k]).collect::<Vec<_>>();
        let rms = relative_to_peak(&of(&found.quotient[c]), &of(published.curves[c].values()));
        assert!((rms - expected).abs() < 1e-4, "{c}: {rms}");
    }
    let saturated: Vec<f64> = (0..nm.len()).filter(|k| found.cells[2][*k] == Cell::Saturated).map(|k| nm[k]).collect();
    assert_eq!(saturated, [410.0, 420.0, 430.0, 440.0]);
    assert!(found.cells[2].contains(&Cell::Dark));
    // The passes differ by 8 to 11 % in a band (RMS); where blue is weak the dark level adds to it.
    let scatter = found.scatter.unwrap();
    assert!(scatter.iter().all(|s| (0.05..0.12).contains(s)), "{scatter:?}");
    // The curve stays within what the passes themselves disagree by.
    for (c, most) in [0.025, 0.015, 0.015].into_iter().enumerate() {
        let kept: Vec<usize> = (0..nm.len()).filter(|k| found.cells[c][*k] != Cell::Saturated).collect();
        let of = |values: &[f64]| kept.iter().map(|k| values[*k]).collect::<Vec<_>>();
        let rms = relative_to_peak(&of(&found.curves.values[c]), &of(published.curves[c].values()));
        assert!(rms < most, "{c}: {rms}");
    }
    // Saturated quotients, the published ones among them, are too small; the library's filling is above them, with its own doubt.
    let (own, theirs, standard) = (&found.curves.values[2], published.curves[2].values(), found.curves.standard());
    for k in 1..=4 {
        assert!(own[k] / own[7] > theirs[k] / theirs[7] && standard[2][k] > 0.015, "{k}");
        assert!(found.curves.data_share[2][k] < 1.0);
    }
}

#[test]
fn bands_that_do_not_determine_curves_are_refused() {
    let few = NarrowBands { passes: vec![pass(1)[..5].to_vec()], clip: 16384.0 };
    assert_eq!(few.wavelengths_nm(), Err(NarrowBandError::TooFew { found: 5 }));
    let other = NarrowBands { passes: vec![pass(1), pass(2)[1..].to_vec()], clip: 16384.0 };
    assert_eq!(other.wavelengths_nm(), Err(NarrowBandError::Bands { pass: 2 }));
    let low = NarrowBands { passes: vec![pass(1)], clip: 100.0 };
    let nm = low.wavelengths_nm().unwrap();
    assert!(matches!(low.recover(&library(&nm, "nikon_d70")), Err(NarrowBandError::Unusable { .. })));
}
