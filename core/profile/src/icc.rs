//! ICC matrix profiles of a camera (ICC.1:2022, version 4.4; ICC.1:2001-04, version 2.4): linear RGB to XYZ relative to D50.

use crate::{Matrix, ProfileError, numbers, text};
use md5::{Digest as _, Md5};

/// White of the profile connection space, as the header states it.
pub const D50: [f64; 3] = [0.9642, 1.0, 0.8249];

/// Version of the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum IccVersion {
    /// 2.4, for programs that read no later one.
    V2,
    /// 4.4.
    #[default]
    V4,
}

/// ICC input profile of a matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct IccProfile {
    /// Description that programs list.
    pub description: String,
    /// Copyright or terms; the tag must be there.
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
    /// Bytes of the file. Its date is 2000-01-01, so that the same matrix gives the same file.
    ///
    /// # Errors
    /// [`ProfileError`] for a text or number that the format cannot hold.
    pub fn to_bytes(&self, version: IccVersion) -> Result<Vec<u8>, ProfileError> {
        text("description", &self.description, false)?;
        text("copyright", &self.copyright, false)?;
        numbers("colorants", self.xyz_from_rgb.iter().flatten(), LIMIT)?;
        numbers("chromatic adaptation", self.adaptation.iter().flatten(), LIMIT)?;
        let (description, copyright) = match version {
            IccVersion::V2 => (described(&self.description), [b"text\0\0\0\0", &*ascii(&self.copyright)].concat()),
            IccVersion::V4 => (localized(&self.description), localized(&self.copyright)),
        };
        let column = |column: usize| xyz([0, 1, 2].map(|row: usize| self.xyz_from_rgb[row][column]));
        let linear = [b"curv".as_slice(), &[0; 8]].concat();
        let elements = [
            (vec![*b"desc"], description),
            (vec![*b"cprt"], copyright),
            (vec![*b"wtpt"], xyz(D50)),
            (vec![*b"chad"], fixed_array(self.adaptation.iter().flatten())),
            (vec![*b"rXYZ"], column(0)),
            (vec![*b"gXYZ"], column(1)),
            (vec![*b"bXYZ"], column(2)),
            (vec![*b"rTRC", *b"gTRC", *b"bTRC"], linear),
        ];
        let mut file = file(&elements, version);
        if version == IccVersion::V4 {
            // The fields that the identifier leaves out (flags, rendering intent, itself) but the intent are zero.
            let mut hashed = file.clone();
            hashed[64..68].fill(0);
            file[84..100].copy_from_slice(&Md5::digest(&hashed));
        }
        Ok(file)
    }
}

/// Header, table of tags and elements, each at a multiple of four.
fn file(elements: &[(Vec<[u8; 4]>, Vec<u8>)], version: IccVersion) -> Vec<u8> {
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
    [header(size, version), table, data].concat()
}

fn header(size: u32, version: IccVersion) -> Vec<u8> {
    let mut header = vec![0; HEADER];
    let mut put = |place: usize, bytes: &[u8]| header[place..place + bytes.len()].copy_from_slice(bytes);
    put(0, &size.to_be_bytes());
    put(8, if version == IccVersion::V2 { &[2, 0x40, 0, 0] } else { &[4, 0x40, 0, 0] });
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

/// A text in seven bits with a zero at its end; other characters become question marks.
fn ascii(value: &str) -> Vec<u8> {
    let bytes = value.chars().map(|c| u8::try_from(c).ok().filter(u8::is_ascii).unwrap_or(b'?'));
    bytes.chain([0]).collect()
}

/// A text as `textDescriptionType` of version 2, in ASCII and in UTF-16; without its script code.
fn described(value: &str) -> Vec<u8> {
    let ascii = ascii(value);
    let units: Vec<u16> = value.encode_utf16().chain([0]).collect();
    let mut element = b"desc\0\0\0\0".to_vec();
    element.extend((ascii.len() as u32).to_be_bytes());
    element.extend(ascii);
    element.extend([0, units.len() as u32].map(u32::to_be_bytes).concat());
    element.extend(units.into_iter().flat_map(u16::to_be_bytes));
    // Code and length of the script text, and its fixed room.
    element.resize(element.len() + 2 + 1 + 67, 0);
    element
}
