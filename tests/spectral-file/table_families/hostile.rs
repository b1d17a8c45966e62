//! Tests of damaged files of every layout: no panic, no value that is not a number, the same answer twice.

use proptest::prelude::*;
use spectral_file::{MAX_BYTES, ReadError, ReadOptions, Reader, read};

use super::layouts;

fn sound() -> Vec<Vec<u8>> {
    let mut all: Vec<Vec<u8>> = [
        layouts::ARGYLL_SP,
        layouts::XRITE,
        layouts::JCAMP_LINK,
        layouts::TM27,
        layouts::CXF,
        layouts::RAWTOACES,
        layouts::DCAMPROF,
        "@19/5/1997\n#No Title\n 2.5E+02\n 0.0E+00\n 2.51E+02\n 1.5E-04\n",
        "##TITLE= a\n##FIRSTX= 400\n##LASTX= 440\n##NPOINTS= 5\n##XYDATA= (X++(Y..Y))\n400A00J0T%\n430A20p0\n##END=\n",
    ]
    .map(|text| text.as_bytes().to_vec())
    .to_vec();
    all.push(layouts::sekonic("Spectral Data ").into_bytes());
    all
}

/// Invariants of every result.
fn check(bytes: &[u8], options: &ReadOptions) {
    let answer = read(bytes, options);
    if let Ok(table) = &answer {
        assert!(!table.curves.is_empty());
        for curve in &table.curves {
            assert!(curve.wavelengths_nm.len() >= 2 && curve.wavelengths_nm.len() == curve.values.len());
            assert!(curve.wavelengths_nm.windows(2).all(|pair| pair[0] < pair[1]));
            assert!(curve.values.iter().all(|value| value.is_finite()));
        }
        assert!(table.decisions().iter().all(|decision| !decision.to_string().is_empty()));
    }
    if let Err(error) = &answer {
        assert!(!error.to_string().is_empty() && error.line() != Some(0));
    }
    assert_eq!(read(bytes, options), answer);
}

#[test]
fn every_truncation_of_every_layout() {
    for bytes in sound() {
        for end in 0..bytes.len() {
            check(&bytes[..end], &ReadOptions::default());
        }
    }
}

#[test]
fn every_flipped_bit_of_every_layout() {
    for mut bytes in sound() {
        for at in 0..bytes.len() {
            for bit in 0..8 {
                bytes[at] ^= 1 << bit;
                let _ = read(&bytes, &ReadOptions::default());
                bytes[at] ^= 1 << bit;
            }
        }
    }
}

#[test]
fn deep_nesting_and_huge_counts_are_refused() {
    let deep = "<a>".repeat(200_000);
    assert!(read(format!("<CxF>{deep}").as_bytes(), &ReadOptions::default()).is_err());
    let deep = "[".repeat(200_000);
    assert!(read(format!("{{\"spectral_data\":{deep}").as_bytes(), &ReadOptions::default()).is_err());
    let range = "{\"bands\": [400, 1e300, 1e-300], \"spectrum\": [1, 2]}";
    assert_eq!(read(range.as_bytes(), &ReadOptions::default()), Err(ReadError::NoWavelengths(1)));
    let repeats =
        format!("##TITLE= a\n##FIRSTX= 1\n##LASTX= 2\n##XYDATA= (X++(Y..Y))\n400 1{}\n", "Z9999".repeat(5000));
    assert!(read(repeats.as_bytes(), &ReadOptions::default()).is_err());
    let line = format!("##TITLE= a\n##FIRSTX= 1\n##LASTX= 2\n##XYDATA= (X++(Y..Y))\n400{}\n", "AZ99999".repeat(50_000));
    assert!(read(line.as_bytes(), &ReadOptions::default()).is_err());
    let entities = "<!DOCTYPE a [<!ENTITY b \"cccc\">]><CxF>&b;</CxF>";
    assert!(read(entities.as_bytes(), &ReadOptions::default()).is_err());
    let large = vec![b'<'; MAX_BYTES + 1];
    assert!(matches!(read(&large, &ReadOptions::default()), Err(ReadError::TooLarge { .. })));
}

#[test]
fn spectra_that_share_no_wavelength_are_bounded() {
    let mut text = String::from("<CxF>");
    for i in 0..5_000_u32 {
        let w = 400.0 + f64::from(i) / 100.0;
        text += &format!("<Object><XSpectrum><SpectralPoint WL=\"{w}\">1</SpectralPoint>");
        text += &format!("<SpectralPoint WL=\"{}\">1</SpectralPoint></XSpectrum></Object>", w + 100.0);
    }
    text += "</CxF>";
    assert!(matches!(read(text.as_bytes(), &ReadOptions::default()), Err(ReadError::TooManySamples(..))));
}

fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let piece = prop_oneof![
        prop::collection::vec(any::<u8>(), 0..4),
        prop::sample::select(vec![
            "\"",
            "##",
            "END_DATA\n",
            "BEGIN_DATA\n",
            "<",
            ">",
            "[",
            "]",
            "{",
            "}",
            "//",
            "/*",
            "1e999",
            "-9999",
            "NaN",
            "\0",
            "Z9",
            "%",
            "\r",
            "\n",
            "380nm",
            "@",
        ])
        .prop_map(|piece| piece.as_bytes().to_vec()),
    ];
    let edits = prop::collection::vec((any::<prop::sample::Index>(), 0..20_usize, piece), 1..6);
    (prop::sample::select(sound()), edits).prop_map(|(mut bytes, edits)| {
        for (at, length, piece) in edits {
            let at = at.index(bytes.len() + 1);
            let until = (at + length).min(bytes.len());
            bytes.splice(at..until, piece);
        }
        bytes
    })
}

proptest! {
    #[test]
    fn damaged_files_are_survived(
        bytes in damaged(),
        reader in prop::option::weighted(0.3, prop::sample::select(vec![
            Reader::TABLE, Reader::CGATS, Reader::JCAMP, Reader::TM27, Reader::CXF, Reader::RAWTOACES, Reader::LABELS,
            Reader::ALTERNATE,
        ])),
        raw in any::<Option<bool>>(),
    ) {
        check(&bytes, &ReadOptions { reader, raw, ..ReadOptions::default() });
    }
}
