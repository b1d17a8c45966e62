//! DNG camera profiles with matrices alone (DNG specification 1.6.0.0, chapters 4 and 6).

use crate::{Matrix, ProfileError, numbers, text};

/// Calibration light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CalibrationIlluminant {
    /// Code of EXIF's `LightSource`: 17 A, 20 D55, 21 D65, 22 D75, 23 D50, 24 ISO studio tungsten.
    Exif(u16),
    /// Any other light by its chromaticity x, y (DNG 1.6: code 255 with `IlluminantData`).
    Other([f64; 2]),
}

/// EXIF's code for a light described by `IlluminantData`.
const OTHER: u16 = 255;

/// Matrices of one calibration light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibration {
    /// The light.
    pub illuminant: CalibrationIlluminant,
    /// `ColorMatrix`: camera RGB from XYZ.
    pub color: Matrix,
    /// `ForwardMatrix`: XYZ relative to D50 from balanced camera RGB.
    pub forward: Matrix,
}

/// DNG camera profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Dcp {
    /// `UniqueCameraModel`: raw developers offer the profile for files of this model only.
    pub camera: String,
    /// `ProfileName`.
    pub name: String,
    /// `ProfileCopyright`; may be empty.
    pub copyright: String,
    /// One light or two.
    pub calibrations: Vec<Calibration>,
}

/// Denominator of the matrices' rationals: six decimals.
const DENOMINATOR: i32 = 1_000_000;
/// The largest magnitude of a matrix's number.
const LIMIT: u32 = 2000;

/// Tags in the order of lights: calibration illuminant, color matrix, forward matrix, illuminant data.
const LIGHT_TAGS: [[u16; 4]; 2] = [[50778, 50721, 50964, 52533], [50779, 50722, 50965, 52534]];

const BYTE: u16 = 1;
const ASCII: u16 = 2;
const SHORT: u16 = 3;
const LONG: u16 = 4;
const UNDEFINED: u16 = 7;
const SRATIONAL: u16 = 10;

struct Field {
    tag: u16,
    kind: u16,
    count: usize,
    bytes: Vec<u8>,
}

impl Dcp {
    /// Bytes of the file: a TIFF directory, little-endian, with the version "RC".
    ///
    /// # Errors
    /// [`ProfileError`] for a text or number that the format cannot hold, and for no light or more than two.
    pub fn to_bytes(&self) -> Result<Vec<u8>, ProfileError> {
        text("UniqueCameraModel", &self.camera, false)?;
        text("ProfileName", &self.name, false)?;
        text("ProfileCopyright", &self.copyright, true)?;
        if !(1..=2).contains(&self.calibrations.len()) {
            return Err(ProfileError::Lights(self.calibrations.len()));
        }
        let mut fields = vec![
            string(50708, ASCII, &self.camera),
            string(50936, BYTE, &self.name),
            // Embedding: no restrictions.
            Field { tag: 50941, kind: LONG, count: 1, bytes: 0_u32.to_le_bytes().to_vec() },
        ];
        if !self.copyright.is_empty() {
            fields.push(string(50942, BYTE, &self.copyright));
        }
        for (calibration, tags) in self.calibrations.iter().zip(LIGHT_TAGS) {
            fields.extend(light(calibration, tags)?);
        }
        fields.sort_by_key(|field| field.tag);
        Ok(directory(&fields))
    }
}

fn string(tag: u16, kind: u16, value: &str) -> Field {
    let bytes: Vec<u8> = value.bytes().chain([0]).collect();
    Field { tag, kind, count: bytes.len(), bytes }
}

fn light(calibration: &Calibration, [illuminant, color, forward, data]: [u16; 4]) -> Result<Vec<Field>, ProfileError> {
    numbers("ColorMatrix", calibration.color.iter().flatten(), LIMIT)?;
    numbers("ForwardMatrix", calibration.forward.iter().flatten(), LIMIT)?;
    let code = match calibration.illuminant {
        CalibrationIlluminant::Exif(code) => code,
        CalibrationIlluminant::Other(_) => OTHER,
    };
    let mut fields = vec![
        Field { tag: illuminant, kind: SHORT, count: 1, bytes: code.to_le_bytes().to_vec() },
        matrix(color, &calibration.color),
        matrix(forward, &calibration.forward),
    ];
    if let CalibrationIlluminant::Other(xy) = calibration.illuminant {
        numbers("IlluminantData", &xy, 1)?;
        let mut bytes = 0_u16.to_le_bytes().to_vec();
        for value in xy {
            bytes.extend(scaled(value).to_le_bytes());
            bytes.extend(DENOMINATOR.to_le_bytes());
        }
        fields.push(Field { tag: data, kind: UNDEFINED, count: bytes.len(), bytes });
    }
    Ok(fields)
}

fn scaled(value: f64) -> i32 {
    // Within the limit that was checked this is far from the ends of the type.
    (value * f64::from(DENOMINATOR)).round() as i32
}

fn matrix(tag: u16, matrix: &Matrix) -> Field {
    let rational = |value: &f64| [scaled(*value).to_le_bytes(), DENOMINATOR.to_le_bytes()].concat();
    Field { tag, kind: SRATIONAL, count: 9, bytes: matrix.iter().flatten().flat_map(rational).collect() }
}

/// Header, directory, and behind it the values longer than four bytes, each at an even place.
fn directory(fields: &[Field]) -> Vec<u8> {
    let mut file = b"IIRC".to_vec();
    file.extend(8_u32.to_le_bytes());
    file.extend((fields.len() as u16).to_le_bytes());
    let mut end = 8 + 2 + 12 * fields.len() + 4;
    let mut values = Vec::new();
    for field in fields {
        file.extend(field.tag.to_le_bytes());
        file.extend(field.kind.to_le_bytes());
        file.extend((field.count as u32).to_le_bytes());
        let mut bytes = field.bytes.clone();
        if bytes.len() <= 4 {
            bytes.resize(4, 0);
            file.extend(bytes);
        } else {
            file.extend((end as u32).to_le_bytes());
            bytes.resize(bytes.len().next_multiple_of(2), 0);
            end += bytes.len();
            values.extend(bytes);
        }
    }
    file.extend(0_u32.to_le_bytes());
    file.extend(values);
    file
}
