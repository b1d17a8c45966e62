//! Any bytes as a spectral file, by content and by every reader: curves in order, without gaps and finite, or an error.
#![no_main]

use chromascope_core::table::{ReadOptions, Reader, read};
use libfuzzer_sys::fuzz_target;

const READERS: [Option<Reader>; 10] = [
    None,
    Some(Reader::Table),
    Some(Reader::Cgats),
    Some(Reader::Jcamp),
    Some(Reader::Tm27),
    Some(Reader::Cxf),
    Some(Reader::Rawtoaces),
    Some(Reader::Labels),
    Some(Reader::Alternate),
    Some(Reader::Camspec),
];

fuzz_target!(|bytes: &[u8]| {
    for reader in READERS {
        if let Ok(table) = read(bytes, &ReadOptions { reader, ..ReadOptions::default() }) {
            assert!(!table.curves.is_empty());
            for curve in &table.curves {
                assert!(curve.wavelengths_nm.len() >= 2 && curve.wavelengths_nm.len() == curve.values.len());
                assert!(curve.wavelengths_nm.windows(2).all(|pair| pair[0] < pair[1]));
                assert!(curve.values.iter().all(|value| value.is_finite()));
            }
        }
    }
});
