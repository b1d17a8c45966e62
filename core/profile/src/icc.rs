//! ICC matrix profiles of a camera (ICC.1:2022, version 4.4): linear RGB to XYZ relative to D50.

use crate::{Matrix, ProfileError, numbers, text};

/// White of the profile connection space, as the header states it.
pub const D50: [f64; 3] = [0.9642, 1.0, 0.8249];

/// ICC input profile of a matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct IccProfile {
    /// Description that programs list.
    pub description: String,
    /// Copyright; "None" where it is empty, because the tag must be there.
    pub copyright: String,
    /// XYZ relative to [`D50`], from balanced linear RGB; its rows sum to that white.
    pub xyz_from_rgb: Matrix,
    /// Chromatic adaptation from the light's white to D50, with which the matrix was made.
    pub adaptation: Matrix,
}

/// The largest magnitude of a number.
const LIMIT: u32 = 32_767;
const HEADER: usize = 128;

impl IccProfile {
    /// Bytes of the file. Its date is 2000-01-01 and its identifier zero (not computed), so that the same matrix gives the same file.
    ///
    /// # Errors
    ///
    /// [`ProfileError`] for a text or number that the format cannot hold.
    pub fn to_bytes(&self) -> Result<Vec<u8>, ProfileError> {
        text("description", &self.description, false)?;
        text("copyright", &self.copyright, true)?;
        numbers("colorants", self.xyz_from_rgb.iter().flatten(), LIMIT)?;
        numbers("chromatic adaptation", self.adaptation.iter().flatten(), LIMIT)?;
        let copyright = if self.copyright.is_empty() { "None" } else { &self.copyright };
        let column = |column: usize| xyz([0, 1, 2].map(|row: usize| self.xyz_from_rgb[row][column]));
        let linear = [b"curv".as_slice(), &[0; 8]].concat();
        let elements = [
            (vec![*b"desc"], localized(&self.description)),
            (vec![*b"cprt"], localized(copyright)),
            (vec![*b"wtpt"], xyz(D50)),
            (vec![*b"chad"], fixed_array(self.adaptation.iter().flatten())),
            (vec![*b"rXYZ"], column(0)),
            (vec![*b"gXYZ"], column(1)),
            (vec![*b"bXYZ"], column(2)),
            (vec![*b"rTRC", *b"gTRC", *b"bTRC"], linear),
        ];
        Ok(file(&elements))
    }
}

/// Header, table of tags and elements, each at a multiple of four.
fn file(elements: &[(Vec<[u8; 4]>, Vec<u8>)]) -> Vec<u8> {
    let tags: usize = elements.iter().map(|(names, _)| names.len()).sum();
    let mut table = (tags as u32).to_be_bytes().to_vec();
    let mut data = Vec::new();
    let start = HEADER + 4 + 12 * tags;
    for (names, element) in elements {
        for name in names {
            table.extend(name);
            table.extend(((start + data.len()) as u32).to_be_bytes());
            table.extend((element.len() as u32).to_be_bytes());
        }
        data.extend(element);
        data.resize(data.len().next_multiple_of(4), 0);
    }
    let size = (start + data.len()) as u32;
    [header(size), table, data].concat()
}

fn header(size: u32) -> Vec<u8> {
    let mut header = vec![0; HEADER];
    let mut put = |place: usize, bytes: &[u8]| header[place..place + bytes.len()].copy_from_slice(bytes);
    put(0, &size.to_be_bytes());
    put(8, &[4, 0x40, 0, 0]);
    put(12, b"scnrRGB XYZ ");
    // 2000-01-01 00:00:00.
    put(24, &[0x07, 0xd0, 0, 1, 0, 1]);
    put(36, b"acsp");
    // Media-relative colorimetric.
    put(64, &1_u32.to_be_bytes());
    put(68, &D50.map(fixed).concat());
    header
}

/// A number as s15Fixed16.
fn fixed(value: f64) -> [u8; 4] {
    ((value * 65_536.0).round() as i32).to_be_bytes()
}

fn xyz(values: [f64; 3]) -> Vec<u8> {
    [b"XYZ \0\0\0\0".as_slice(), &values.map(fixed).concat()].concat()
}

fn fixed_array<'a>(values: impl Iterator<Item = &'a f64>) -> Vec<u8> {
    b"sf32\0\0\0\0".iter().copied().chain(values.flat_map(|value| fixed(*value))).collect()
}

/// A text as `multiLocalizedUnicodeType` with one entry, en-US.
fn localized(value: &str) -> Vec<u8> {
    let units: Vec<u8> = value.encode_utf16().flat_map(u16::to_be_bytes).collect();
    let mut element = b"mluc\0\0\0\0".to_vec();
    element.extend([1_u32, 12].map(u32::to_be_bytes).concat());
    element.extend(b"enUS");
    element.extend([units.len() as u32, 28].map(u32::to_be_bytes).concat());
    element.extend(units);
    element
}
