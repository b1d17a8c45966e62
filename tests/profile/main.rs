//! Profiles read back by readers that share no code with the writers, and against bytes that other programs have read.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should say so by failing")]
#![allow(clippy::disallowed_methods, reason = "the tests read files")]

mod reading;

use chromascope_profile::clf::Clf;
use chromascope_profile::dcp::{Calibration, CalibrationIlluminant, Dcp};
use chromascope_profile::icc::{IccProfile, IccVersion};
use chromascope_profile::{Matrix, ProfileError};
use proptest::prelude::*;
use reading::{clf_numbers, icc_tags, md5, tiff_fields};
use std::path::PathBuf;

const FORWARD: Matrix = [[0.7, 0.2, 0.0642], [0.3, 0.8, -0.1], [0.0, -0.1, 0.9249]];
const COLOR: Matrix = [[0.9, -0.3, -0.1], [-0.4, 1.2, 0.2], [-0.1, 0.2, 0.6]];
const BRADFORD: Matrix = [[1.0479, 0.0229, -0.0502], [0.0296, 0.9904, -0.0171], [-0.0092, 0.0151, 0.7519]];

fn dcp(calibrations: Vec<Calibration>) -> Dcp {
    Dcp {
        camera: "Nikon D200".to_owned(),
        name: "Chromascope A + D65".to_owned(),
        copyright: "None".to_owned(),
        calibrations,
    }
}

fn two_lights() -> Vec<Calibration> {
    let light = |illuminant| Calibration { illuminant, color: COLOR, forward: FORWARD };
    vec![light(CalibrationIlluminant::Exif(17)), light(CalibrationIlluminant::Other([0.3324, 0.3474]))]
}

fn icc() -> IccProfile {
    IccProfile {
        description: "Nikon D200, σ".to_owned(),
        copyright: "Terms of the table: Apache-2.0".to_owned(),
        xyz_from_rgb: FORWARD,
        adaptation: BRADFORD,
    }
}

fn clf() -> Clf {
    Clf {
        id: "chromascope-nikon-d200".to_owned(),
        name: "Nikon <D200> & \"tungsten\"".to_owned(),
        descriptions: vec!["Fitted & written".to_owned()],
        input: "Camera RGB".to_owned(),
        output: "ACES2065-1".to_owned(),
        matrix: COLOR,
    }
}

/// Compares with a committed file; `UPDATE_PROFILES=1` writes it.
fn compare(name: &str, bytes: &[u8]) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/profile/expected").join(name);
    if std::env::var_os("UPDATE_PROFILES").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, bytes).unwrap();
    }
    assert_eq!(std::fs::read(&path).unwrap(), bytes, "{name}");
}

/// The committed file was read by `ExifTool` 12.57: "DNG Camera Profile" with all fields below.
#[test]
fn dcp_holds_its_fields_in_the_order_of_tags() {
    let bytes = dcp(two_lights()).to_bytes().unwrap();
    compare("two_lights.dcp", &bytes);
    let fields = tiff_fields(&bytes);
    assert!(fields.windows(2).all(|pair| pair[0].tag < pair[1].tag));
    let field = |tag: u16| fields.iter().find(|field| field.tag == tag).unwrap();
    assert_eq!(field(50708).text(), "Nikon D200");
    assert_eq!(field(50936).text(), "Chromascope A + D65");
    assert_eq!(field(50942).text(), "None");
    assert_eq!(field(50941).unsigned(), 0);
    assert_eq!((field(50778).unsigned(), field(50779).unsigned()), (17, 255));
    for (tag, matrix) in [(50721, COLOR), (50722, COLOR), (50964, FORWARD), (50965, FORWARD)] {
        for (got, known) in field(tag).rationals().iter().zip(matrix.iter().flatten()) {
            assert!((got - known).abs() < 1e-9, "{tag}: {got} {known}");
        }
    }
    // Type 0, then x and y as rationals.
    let data = &field(52534).bytes;
    assert_eq!(data.len(), 18);
    assert_eq!(data[..2], [0, 0]);
    let number = |at: usize| f64::from(u32::from_le_bytes(data[at..at + 4].try_into().unwrap()));
    assert_eq!([number(2) / number(6), number(10) / number(14)], [0.3324, 0.3474]);
    assert!(!fields.iter().any(|field| field.tag == 52533), "EXIF's A needs no description");
}

/// The committed file was opened by Little CMS 2 (Pillow's `ImageCms`), which converts RGB 128, 64, 191 of 255 to L*a*b* in eight
/// bits 152, 190, 72; the matrix and colour-science 0.4.7 give 151.90, 190.01, 71.90.
#[test]
fn icc_profile_has_its_tags() {
    let bytes = icc().to_bytes(IccVersion::V4).unwrap();
    compare("matrix.icc", &bytes);
    assert_eq!(u32::from_be_bytes(bytes[..4].try_into().unwrap()) as usize, bytes.len());
    assert_eq!(&bytes[8..12], [4, 0x40, 0, 0]);
    assert_eq!(&bytes[12..24], b"scnrRGB XYZ ");
    assert_eq!(&bytes[36..40], b"acsp");
    let tags = icc_tags(&bytes);
    let names: Vec<&str> = tags.iter().map(|tag| tag.name.as_str()).collect();
    assert_eq!(names, ["desc", "cprt", "wtpt", "chad", "rXYZ", "gXYZ", "bXYZ", "rTRC", "gTRC", "bTRC"]);
    let tag = |name: &str| tags.iter().find(|tag| tag.name == name).unwrap();
    for (column, name) in ["rXYZ", "gXYZ", "bXYZ"].into_iter().enumerate() {
        for (row, got) in tag(name).fixed().iter().enumerate() {
            assert!((got - FORWARD[row][column]).abs() <= 0.5 / 65_536.0);
        }
    }
    for (got, known) in tag("chad").fixed().iter().zip(BRADFORD.iter().flatten()) {
        assert!((got - known).abs() <= 0.5 / 65_536.0);
    }
    // ICC.1:2022, 7.2.16: D50 is F6D6, 10000, D32D.
    assert_eq!(tag("wtpt").bytes[8..], [0, 0, 0xf6, 0xd6, 0, 1, 0, 0, 0, 0, 0xd3, 0x2d]);
    assert_eq!(bytes[68..80], tag("wtpt").bytes[8..]);
    // A curve without entries is the identity.
    assert_eq!(tag("gTRC").bytes, b"curv\0\0\0\0\0\0\0\0");
    assert_eq!(tag("desc").text(), "Nikon D200, σ");
    assert_eq!(tag("cprt").text(), "Terms of the table: Apache-2.0");
    assert!(tags.iter().all(|tag| tag.offset.is_multiple_of(4)));
}

/// ICC.1:2010, 7.2.18: MD5 (RFC 1321) of the file with flags, rendering intent and the identifier itself zero.
#[test]
fn the_profile_id_is_the_md5_of_the_rule() {
    let bytes = icc().to_bytes(IccVersion::V4).unwrap();
    let mut hashed = bytes.clone();
    for field in [44..48, 64..68, 84..100] {
        hashed[field].fill(0);
    }
    assert_eq!(bytes[84..100], md5(&hashed));
    // RFC 1321, A.5: of nothing, and of "abc".
    let hex = |bytes: [u8; 16]| bytes.map(|byte| format!("{byte:02x}")).concat();
    assert_eq!(hex(md5(b"")), "d41d8cd98f00b204e9800998ecf8427e");
    assert_eq!(hex(md5(b"abc")), "900150983cd24fb0d6963f7d28e17f72");
    let other = IccProfile { description: "Nikon D201".to_owned(), ..icc() }.to_bytes(IccVersion::V4).unwrap();
    assert_ne!(bytes[84..100], other[84..100]);
}

/// The committed file was read by `ArgyllCMS` (`iccdump`), which refuses version 4, and by Little CMS 2.
#[test]
fn icc_version_2_has_its_types() {
    let bytes = icc().to_bytes(IccVersion::V2).unwrap();
    compare("matrix_v2.icc", &bytes);
    assert_eq!(u32::from_be_bytes(bytes[..4].try_into().unwrap()) as usize, bytes.len());
    assert_eq!(bytes[8..12], [2, 0x40, 0, 0]);
    assert_eq!(bytes[84..100], [0; 16], "version 2 has no identifier");
    let (two, four) = (icc_tags(&bytes), icc_tags(&icc().to_bytes(IccVersion::V4).unwrap()));
    for (two, four) in two.iter().zip(&four).skip(2) {
        assert_eq!((&two.name, &two.bytes), (&four.name, &four.bytes));
    }
    // ICC.1:2001-04, 6.5.17: ASCII with its zero, then UTF-16 with its count, then 70 bytes of script code.
    let description = &two[0].bytes;
    assert_eq!(&description[..8], b"desc\0\0\0\0");
    assert_eq!(&description[8..12], [0, 0, 0, 14]);
    assert_eq!(&description[12..26], b"Nikon D200, ?\0");
    assert_eq!(description[26..34], [0, 0, 0, 0, 0, 0, 0, 14]);
    let units: Vec<u16> = description[34..62].chunks(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
    assert_eq!(String::from_utf16(&units).unwrap(), "Nikon D200, σ\0");
    assert_eq!(description.len(), 62 + 70);
    assert_eq!(two[1].bytes, b"text\0\0\0\0Terms of the table: Apache-2.0\0");
}

/// The committed file was read by `OpenColorIO` 2.6, which takes 0.5, 0.25, 0.75 to 0.3, 0.25, 0.45 as the matrix does.
#[test]
fn clf_is_xml_with_one_matrix() {
    let xml = clf().to_xml().unwrap();
    compare("matrix.clf", xml.as_bytes());
    assert!(xml.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>"));
    assert!(xml.contains("name=\"Nikon &lt;D200&gt; &amp; &quot;tungsten&quot;\""));
    assert!(xml.contains("compCLFversion=\"3.0\"") && xml.contains("xmlns=\"urn:AMPAS:CLF:v3.0\""));
    assert_eq!(clf_numbers(&xml), COLOR.concat());
}

#[test]
fn what_a_format_cannot_hold_is_refused() {
    assert_eq!(dcp(Vec::new()).to_bytes(), Err(ProfileError::Lights(0)));
    let three = [two_lights(), two_lights()].concat();
    assert_eq!(dcp(three).to_bytes(), Err(ProfileError::Lights(4)));
    let refused = Dcp { camera: String::new(), ..dcp(two_lights()) }.to_bytes();
    assert_eq!(refused, Err(ProfileError::Empty { field: "UniqueCameraModel" }));
    let refused = Dcp { name: "a\0b".to_owned(), ..dcp(two_lights()) }.to_bytes();
    assert_eq!(refused, Err(ProfileError::Control { field: "ProfileName" }));
    let refused = IccProfile { description: "x".repeat(1001), ..icc() }.to_bytes(IccVersion::V2);
    assert_eq!(refused, Err(ProfileError::Long { field: "description", bytes: 1001 }));
    for bad in [f64::NAN, f64::INFINITY, 1e9] {
        let matrix = [[bad; 3]; 3];
        let calibration = Calibration { color: matrix, ..two_lights()[0] };
        assert!(dcp(vec![calibration]).to_bytes().is_err());
        assert!(IccProfile { xyz_from_rgb: matrix, ..icc() }.to_bytes(IccVersion::V4).is_err());
        assert!(Clf { matrix, ..clf() }.to_xml().is_err());
    }
    assert!(Clf { name: "\u{8}".to_owned(), ..clf() }.to_xml().is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn whatever_is_written_can_be_read(values in prop::array::uniform9(-3.0..3.0_f64), name in "[ -~é]{1,40}") {
        let matrix = [0, 3, 6].map(|i: usize| [values[i], values[i + 1], values[i + 2]]);
        let calibration = Calibration { color: matrix, ..two_lights()[0] };
        let bytes = Dcp { name: name.clone(), ..dcp(vec![calibration]) }.to_bytes().unwrap();
        let fields = tiff_fields(&bytes);
        let colors = fields.iter().find(|field| field.tag == 50721).unwrap().rationals();
        prop_assert!(colors.iter().zip(values).all(|(a, b)| (a - b).abs() <= 0.5e-6 + 1e-12));
        prop_assert_eq!(fields.iter().find(|field| field.tag == 50936).unwrap().text(), name.clone());
        let bytes = IccProfile { description: name.clone(), xyz_from_rgb: matrix, ..icc() };
        let bytes = bytes.to_bytes(IccVersion::V4).unwrap();
        prop_assert_eq!(icc_tags(&bytes)[0].text(), name.clone());
        let xml = Clf { name, matrix, ..clf() }.to_xml().unwrap();
        prop_assert!(clf_numbers(&xml).iter().zip(values).all(|(a, b)| (a - b).abs() <= 1e-10));
    }
}
