//! The readers of spectral images against files of independent programs, known contents and hostile input.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should say so by failing")]
#![allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "the tests read files")]

mod hostile;
mod memory;

use spectral_image::{
    EnviHeader, EnviImage, ExrImage, ImageError, ImageQuantity, Note, SpectralChannel, SpectralImage,
};
use std::fs::{self, File};
use std::io::Cursor;
use std::path::PathBuf;

pub(crate) fn data(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/spectral-image/data").join(name)
}

/// Samples of the pictures, row by row, before any scale.
fn values() -> Vec<f64> {
    let text = fs::read_to_string(data("values.csv")).unwrap();
    text.lines().skip(1).flat_map(|row| row.split(',')).map(|field| field.parse().unwrap()).collect()
}

fn envi(name: &str) -> SpectralImage<File> {
    let header = EnviHeader::parse(&fs::read(data(&format!("{name}.hdr"))).unwrap()).unwrap();
    SpectralImage::Envi(EnviImage::new(header, File::open(data(&format!("{name}.img"))).unwrap()).unwrap())
}

/// Reads an image row by row, and whole: both must agree.
fn samples(image: &mut SpectralImage<File>) -> Vec<f32> {
    let (mut all, mut rows, mut row) = (Vec::new(), Vec::new(), Vec::new());
    let height = image.info().height;
    image.read_rows(0..height, &mut all).unwrap();
    for at in 0..height {
        image.read_rows(at..at + 1, &mut row).unwrap();
        rows.extend_from_slice(&row);
    }
    assert_eq!(all, rows);
    all
}

#[test]
fn images_of_spy_are_read_in_every_order_and_type() {
    let values = values();
    for name in ["bil", "bip", "bsq", "i16", "i32", "f32", "f64", "u32", "i64", "u64"] {
        let mut image = envi(&format!("spy_{name}"));
        let info = image.info();
        assert_eq!((info.width, info.height), (4, 3), "{name}");
        assert_eq!(info.wavelengths_nm, [400.0, 450.0, 500.5, 600.0, 700.0]);
        assert_eq!((info.quantity, &info.notes[..]), (Some(ImageQuantity::Reflectance), &[Note::Scale(4000.0)][..]));
        let expected: Vec<f32> = values.iter().map(|v| (v * 4000_f64.recip()) as f32).collect();
        assert_eq!(samples(&mut image), expected, "{name}");
    }
    let expected: Vec<f32> = values.iter().map(|v| ((v / 16.0).floor() * 250_f64.recip()) as f32).collect();
    assert_eq!(samples(&mut envi("spy_u8")), expected);
}

#[test]
fn openexr_of_another_program_is_read() {
    for (name, quantity, tolerance, others) in [
        ("openexr_reflectance", ImageQuantity::Reflectance, 1e-7, 3),
        ("openexr_radiance", ImageQuantity::Radiance, 5e-4, 0),
    ] {
        let file = File::open(data(&format!("{name}.exr"))).unwrap();
        let mut image = SpectralImage::Exr(ExrImage::new(file, None).unwrap());
        let info = image.info();
        assert_eq!((info.width, info.height, info.quantity), (4, 3, Some(quantity)));
        assert_eq!(info.wavelengths_nm, [400.0, 450.0, 500.5, 600.0, 700.0]);
        assert_eq!(info.notes.is_empty(), others == 0);
        for (found, value) in samples(&mut image).iter().zip(values()) {
            assert!((f64::from(*found) - value / 4000.0).abs() <= tolerance, "{name}: {found} is not {value}");
        }
    }
}

#[test]
fn names_of_spectral_channels() {
    // The forms of the proposal's section 3.
    for (name, nm) in [
        ("S0.400,0nm", 400.0),
        ("T.550nm", 550.0),
        ("S0.4,1E2nm", 410.0),
        ("T.0,7um", 700.0),
        ("S0.5E-7m", 500.0),
        ("S0.500THz", 599.584_916),
    ] {
        let channel = SpectralChannel::parse(name).unwrap_or_else(|| panic!("{name} is none"));
        assert!((channel.nm - nm).abs() < 1e-9 * nm, "{name}: {}", channel.nm);
    }
    for name in [
        "R",
        "S1.400,0nm",
        "T.400,0nm.500,0nm",
        "S0.nm",
        "S0.0nm",
        "T.-4nm",
        "S0.inf nm",
        "T.400",
        "S0.1,2,3nm",
        "é.4nm",
    ] {
        assert_eq!(SpectralChannel::parse(name), None, "{name}");
    }
}

/// A header of 2 × 1 pixels, 3 bands of bytes, with lines added or replaced.
pub(crate) fn header(lines: &[(&str, &str)]) -> Vec<u8> {
    let mut fields = vec![
        ("samples", "2"),
        ("lines", "1"),
        ("bands", "3"),
        ("data type", "1"),
        ("interleave", "bip"),
        ("wavelength", "{500, 600, 700}"),
        ("wavelength units", "Nanometers"),
    ];
    for (name, value) in lines {
        fields.retain(|(known, _)| known != name);
        fields.push((name, value));
    }
    let fields = fields.iter().filter(|(_, value)| !value.is_empty());
    fields.fold("ENVI\n".to_owned(), |text, (name, value)| format!("{text}{name} = {value}\n")).into_bytes()
}

fn read(lines: &[(&str, &str)], bytes: &[u8]) -> Result<(EnviHeader, Vec<f32>), ImageError> {
    let header = EnviHeader::parse(&header(lines))?;
    let mut image = EnviImage::new(header.clone(), Cursor::new(bytes))?;
    let mut samples = Vec::new();
    image.read_rows(0..header.info.height, &mut samples)?;
    Ok((header, samples))
}

#[test]
fn bad_bands_units_order_offsets_and_ignored_values() {
    let (header, samples) = read(
        &[
            ("wavelength", "{0.7,\n 0.5,\n 0.6}"),
            ("wavelength units", "Micrometers"),
            ("Header  Offset", "2"),
            ("bbl", "{1, 1, 0}"),
            ("data ignore value", "255"),
            ("data gain values", "{0.5, 2, 1}"),
            ("data offset values", "{1, 0, 0}"),
            ("; a comment", " x"),
        ],
        &[9, 9, 10, 20, 30, 255, 40, 50],
    )
    .unwrap();
    assert_eq!(header.info.wavelengths_nm, [500.0, 700.0]);
    assert_eq!(header.info.notes, [Note::BadBands(1), Note::Sorted]);
    assert_eq!(samples[..3], [40.0, 6.0, 80.0]);
    assert!(samples[3].is_nan());
    let (header, _) = read(&[("wavelength units", "")], &[0; 6]).unwrap();
    assert_eq!(header.info.notes, [Note::Unit { first: 500.0, last: 700.0, unit: "nanometers" }]);
    assert_eq!(
        read(&[("data units", "Radiance (W/m2/sr/nm)")], &[0; 6]).unwrap().0.info.quantity,
        Some(ImageQuantity::Radiance)
    );
    assert_eq!(read(&[], &[0; 6]).unwrap().0.info.quantity, None);
    assert_eq!(read(&[("data ignore value", "nan")], &[0; 6]).unwrap().0.ignore, None);
}

#[test]
fn errors_name_line_field_and_remedy() {
    let complaint = |lines: &[(&str, &str)]| read(lines, &[0; 6]).unwrap_err().to_string();
    assert_eq!(complaint(&[("samples", "")]), "the header has no `samples`; add the line `samples = 640`");
    assert_eq!(complaint(&[("lines", "many")]), "line 8: `lines = many`: expected a whole number");
    assert_eq!(complaint(&[("bands", "9999999")]), "`bands` is 9999999; expected 1 to 4096");
    assert_eq!(
        complaint(&[("data type", "6")]),
        "line 8: `data type = 6`: expected 1, 2, 3, 4, 5, 12, 13, 14 or 15; complex samples are not supported"
    );
    assert_eq!(complaint(&[("data type", "2")]), "the header has no `byte order`; add the line `byte order = 0`");
    assert_eq!(complaint(&[("interleave", "bsp")]), "line 8: `interleave = bsp`: expected bil, bip or bsq");
    assert_eq!(complaint(&[("wavelength", "{500, 600}")]), "line 8: `wavelength` has 2 entries for 3 bands");
    assert!(complaint(&[("wavelength", "{500, 500, 600}")]).starts_with("`wavelength` has 500 nm twice"));
    assert!(complaint(&[("wavelength", "{500, 500")]).starts_with("line 8: the list of `wavelength` has no closing"));
    assert!(
        complaint(&[("wavelength units", "Wavenumber")]).ends_with("expected Nanometers, Micrometers or Angstroms")
    );
    assert!(complaint(&[("data ignore value", "none")]).ends_with("expected a number"));
    for scale in ["nan", "inf", "0", "-1"] {
        assert!(complaint(&[("reflectance scale factor", scale)]).ends_with("for a reflectance of 1"), "{scale}");
    }
    assert_eq!(complaint(&[("bbl", "{0, 0, 0}")]), "`bbl` marks every band as bad");
    assert!(complaint(&[("file compression", "1")]).ends_with("save the image without compression"));
    assert_eq!(
        complaint(&[("lines", "2")]),
        "the data have 6 bytes, but the header states 12; check samples, lines, bands, data type and header offset"
    );
    assert!(matches!(EnviHeader::parse(b"BM nothing"), Err(ImageError::NotEnvi)));
    assert!(matches!(EnviHeader::parse(b"ENVI\nno field"), Err(ImageError::Line { line: 2 })));
    let mut image = envi("spy_bil");
    assert!(matches!(image.read_rows(2..4, &mut Vec::new()), Err(ImageError::Rows { .. })));
    let plain = ExrImage::new(Cursor::new(b"not an exr"), None).unwrap_err();
    assert!(plain.to_string().starts_with("OpenEXR: "), "{plain}");
}
