//! Broken files: an error or an image, never a panic, and no allocation beyond what the data allow.

use crate::{data, header};
use proptest::prelude::*;
use spectral_image::{EnviHeader, EnviImage, ExrImage};
use std::fs;
use std::io::Cursor;

/// Reads all rows if the file makes an image.
fn go_through(bytes: &[u8]) {
    let Ok(mut image) = ExrImage::new(Cursor::new(bytes), None) else { return };
    let (mut samples, height) = (Vec::new(), image.info().height);
    // A broken size may be large; a few rows are as informative as all.
    for rows in [0..1, height / 2..height / 2 + 1, height - 1..height] {
        if image.info().row_samples() < 1 << 22 {
            let _broken = image.read_rows(rows, &mut samples);
        }
    }
}

#[test]
fn sizes_that_the_data_do_not_have_are_refused_before_anything_is_allocated() {
    for (name, value) in [
        ("samples", "65536"),
        ("lines", "65536"),
        ("lines", "18446744073709551615"),
        ("samples", "-1"),
        ("bands", "0"),
        ("header offset", "18446744073709551615"),
        ("lines", "99999999999999999999999"),
    ] {
        let refused = EnviHeader::parse(&header(&[(name, value)]))
            .and_then(|header| EnviImage::new(header, Cursor::new(vec![0; 6])).map(|_| ()));
        assert!(refused.is_err(), "{name} = {value}");
    }
}

#[test]
fn truncated_files_are_refused() {
    for name in ["openexr_reflectance.exr", "openexr_radiance.exr"] {
        let whole = fs::read(data(name)).unwrap();
        for length in 0..whole.len() {
            go_through(&whole[..length]);
        }
    }
    let whole = fs::read(data("spy_bil.hdr")).unwrap();
    for length in 0..whole.len() {
        let _broken = EnviHeader::parse(&whole[..length]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn changed_bytes_of_openexr_never_panic(
        reflectance: bool,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let name = if reflectance { "openexr_reflectance.exr" } else { "openexr_radiance.exr" };
        let mut bytes = fs::read(data(name)).unwrap();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        go_through(&bytes);
    }

    #[test]
    fn any_header_never_panics(
        text in "ENVI\n((samples|lines|bands|data type|interleave|wavelength|bbl|byte order|header offset|\u{e9}) ?= ?(\\{[0-9,. \n]{0,20}\\}?|[0-9bil.e+-]{0,12})\n){0,12}",
        bytes in prop::collection::vec(any::<u8>(), 0..200),
    ) {
        if let Ok(header) = EnviHeader::parse(text.as_bytes())
            && let Ok(mut image) = EnviImage::new(header, Cursor::new(bytes))
        {
            let height = image.info().height;
            image.read_rows(0..height, &mut Vec::new()).unwrap();
        }
    }
}

#[test]
fn sizes_are_refused_in_the_words_of_the_format() {
    for (name, value, words) in [
        ("samples", "65537", "`samples` is 65537; expected 1 to 65536"),
        ("lines", "65537", "`lines` is 65537; expected 1 to 65536"),
        ("bands", "0", "`bands` is 0; expected 1 to 4096"),
    ] {
        assert_eq!(EnviHeader::parse(&header(&[(name, value)])).unwrap_err().to_string(), words);
    }
    // The first of the two corners of the window that is displayed, and then the second's x.
    let mut bytes = fs::read(data("openexr_reflectance.exr")).unwrap();
    let at = bytes.windows(11).position(|name| name == b"dataWindow\0").unwrap() + 11 + b"box2i\0".len() + 4;
    bytes[at + 8..at + 12].copy_from_slice(&65536_i32.to_le_bytes());
    let refused = ExrImage::new(Cursor::new(bytes), None).map(|_| ()).unwrap_err().to_string();
    assert_eq!(refused, "`width` is 65537; expected 1 to 65536");
}
