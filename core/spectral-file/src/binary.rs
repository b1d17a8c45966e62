//! Binary files, recognized by their first bytes.

use std::fmt;

/// A kind of binary file that is recognized by its first bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BinaryKind {
    /// A ZIP container, such as an Excel workbook (`.xlsx`).
    Zip,
    /// An OLE2 container, such as an old Excel workbook (`.xls`).
    Ole2,
    /// A PNG image.
    Png,
    /// A JPEG image.
    Jpeg,
    /// A PDF document.
    Pdf,
    /// A gzip archive.
    Gzip,
    /// A measurement in `AvaSoft` 8's own format.
    AvaSoft8,
    /// A measurement in the own format of `AvaSoft` 6 or 7.
    AvaSoft7,
    /// A spectrum in the format of GRAMS, `.spc`.
    GramsSpc,
    /// An ICC profile.
    Icc,
    /// The header of ENVI, beside which its numbers stand in a binary file.
    Envi,
    /// A Thermo OMNIC spectrum.
    Omnic,
    /// A `PerkinElmer` spectrum.
    PerkinElmer,
    /// A Renishaw `WiRE` measurement.
    Renishaw,
    /// An Andor image or spectrum.
    Andor,
    /// A netCDF file of version 3.
    NetCdf,
    /// An array of `NumPy`.
    Numpy,
    /// A workspace of R.
    RData,
    /// An `SQLite` database.
    Sqlite,
    /// A Parquet table.
    Parquet,
    /// An archive of 7-Zip or RAR.
    Archive,
    /// A measurement in ASD's own format.
    Asd,
    /// An HDF5 or netCDF 4 file.
    Hdf5,
    /// A TIFF image.
    Tiff,
    /// An `OpenEXR` image.
    Exr,
    /// A MATLAB workspace.
    Matlab,
    /// A measurement in Bruker OPUS's own format.
    Opus,
    /// Any other file with bytes that no text has.
    Unknown,
}

impl fmt::Display for BinaryKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Zip => "a ZIP container (such as .xlsx)",
            Self::Ole2 => "an OLE2 container (such as an old .xls)",
            Self::Png => "a PNG image",
            Self::Jpeg => "a JPEG image",
            Self::Pdf => "a PDF document",
            Self::Gzip => "a gzip archive",
            Self::AvaSoft8 => "an AvaSoft 8 binary measurement (AVS8x)",
            Self::AvaSoft7 => "an AvaSoft 6 or 7 binary measurement (such as .ROH or .TRM)",
            Self::GramsSpc => "a GRAMS spectrum (.spc)",
            Self::Icc => "an ICC profile",
            Self::Envi => "an ENVI header, whose numbers are in the binary file beside it",
            Self::Omnic => "a Thermo OMNIC spectrum (.spa)",
            Self::PerkinElmer => "a PerkinElmer spectrum (.sp)",
            Self::Renishaw => "a Renishaw WiRE measurement (.wdf)",
            Self::Andor => "an Andor file (.sif)",
            Self::NetCdf => "a netCDF file",
            Self::Numpy => "a NumPy array",
            Self::RData => "an R workspace",
            Self::Sqlite => "an SQLite database",
            Self::Parquet => "a Parquet table",
            Self::Archive => "an archive",
            Self::Asd => "an ASD binary measurement (.asd)",
            Self::Hdf5 => "an HDF5 file",
            Self::Tiff => "a TIFF image",
            Self::Exr => "an OpenEXR image",
            Self::Matlab => "a MATLAB workspace",
            Self::Opus => "a Bruker OPUS measurement",
            Self::Unknown => "a binary file of an unknown kind",
        })
    }
}

impl BinaryKind {
    /// Remedy, as the second half of a sentence.
    pub(super) fn remedy(self) -> &'static str {
        match self {
            Self::Zip | Self::Ole2 => "save the sheet with the spectra as CSV",
            Self::Gzip | Self::Archive => "unpack it and open the text files in it",
            Self::AvaSoft8 | Self::AvaSoft7 => "export it in AvaSoft as text (File, Convert Graph, To ASCII)",
            Self::GramsSpc => "export it as text (x, y) or as JCAMP-DX from the program that wrote it",
            Self::Icc => "it holds no spectra; open the measurements it was made of (.ti3, CGATS, CxF)",
            Self::Envi => "export the spectra in ENVI as an ASCII plot or spectral library text",
            Self::Asd => "export it in ViewSpec Pro as ASCII",
            Self::Opus => "save it in OPUS as a data point table or as JCAMP-DX",
            Self::Omnic | Self::PerkinElmer | Self::Renishaw => "save it in its program as CSV or as JCAMP-DX",
            Self::Png | Self::Jpeg | Self::Tiff | Self::Exr => {
                "a picture has no spectra; open the table they came from"
            }
            _ => "export the measurement as text or CSV",
        }
    }
}

const MAGIC: [(&[u8], BinaryKind); 37] = [
    (b"PK\x03\x04", BinaryKind::Zip),
    (b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1", BinaryKind::Ole2),
    (b"\x89PNG", BinaryKind::Png),
    (b"\xFF\xD8\xFF", BinaryKind::Jpeg),
    (b"%PDF", BinaryKind::Pdf),
    (b"\x1F\x8B", BinaryKind::Gzip),
    (b"AVS8", BinaryKind::AvaSoft8),
    (b"ASD\0", BinaryKind::Asd),
    (b"as2\0", BinaryKind::Asd),
    (b"as3\0", BinaryKind::Asd),
    (b"as6\0", BinaryKind::Asd),
    (b"as7\0", BinaryKind::Asd),
    (b"as8\0", BinaryKind::Asd),
    (b"\x89HDF\r\n", BinaryKind::Hdf5),
    (b"II*\0", BinaryKind::Tiff),
    (b"MM\0*", BinaryKind::Tiff),
    (b"\x76\x2F\x31\x01", BinaryKind::Exr),
    (b"MATLAB 5.0 MAT-file", BinaryKind::Matlab),
    (b"\x0A\x0A\xFE\xFE", BinaryKind::Opus),
    // Versions 60 and 70 as numbers in single precision.
    (b"\x00\x00\x70\x42", BinaryKind::AvaSoft7),
    (b"\x00\x00\x8C\x42", BinaryKind::AvaSoft7),
    (b"MATLAB 7.3 MAT-file", BinaryKind::Matlab),
    (b"Spectral Data File\r\n", BinaryKind::Omnic),
    (b"PEPE", BinaryKind::PerkinElmer),
    (b"WDF1", BinaryKind::Renishaw),
    (b"Andor Technology Multi-Channel File", BinaryKind::Andor),
    (b"CDF\x01", BinaryKind::NetCdf),
    (b"CDF\x02", BinaryKind::NetCdf),
    (b"\x93NUMPY", BinaryKind::Numpy),
    (b"RDX2\n", BinaryKind::RData),
    (b"RDX3\n", BinaryKind::RData),
    (b"SQLite format 3\0", BinaryKind::Sqlite),
    (b"PAR1", BinaryKind::Parquet),
    (b"7z\xBC\xAF\x27\x1C", BinaryKind::Archive),
    (b"Rar!\x1A\x07", BinaryKind::Archive),
    (b"ENVI\n", BinaryKind::Envi),
    (b"ENVI\r\n", BinaryKind::Envi),
];

/// The kind of a binary file by its first bytes.
pub(super) fn binary(bytes: &[u8]) -> Option<BinaryKind> {
    const LOOK: usize = 64;
    let control = bytes.iter().take(LOOK).any(|byte| *byte < b'\t');
    // Titles may begin with such letters.
    let lettered = |kind| matches!(kind, BinaryKind::PerkinElmer | BinaryKind::Parquet | BinaryKind::Renishaw);
    let begins = |(magic, kind): &&(&[u8], BinaryKind)| bytes.starts_with(magic) && (control || !lettered(*kind));
    let magic = MAGIC.iter().find(begins).map(|(_, kind)| *kind);
    let icc = || (bytes.get(36..40) == Some(b"acsp")).then_some(BinaryKind::Icc);
    let spc = || is_grams(bytes).then_some(BinaryKind::GramsSpc);
    let unknown = || looks_binary(bytes).then_some(BinaryKind::Unknown);
    magic.or_else(icc).or_else(spc).or_else(unknown)
}

/// Returns whether bytes begin as a GRAMS `.spc` does: flags, a version, a type, an exponent, and the number of points.
fn is_grams(bytes: &[u8]) -> bool {
    const MOST_POINTS: u32 = 100_000_000;
    const HEADER: usize = 256;
    let Some(&[_, version, kind, _, a, b, c, d]) = bytes.first_chunk::<8>() else { return false };
    // Four letters or digits of a text are a far larger number. The old form gives the number in single precision.
    let points = |number: u32| (1..MOST_POINTS).contains(&number);
    let old = f32::from_le_bytes([a, b, c, d]);
    bytes.len() >= HEADER
        && match version {
            0x4B => kind <= 13 && points(u32::from_le_bytes([a, b, c, d])),
            0x4C => kind <= 13 && points(u32::from_be_bytes([a, b, c, d])),
            0x4D => old.fract() == 0.0 && (1.0..1e7).contains(&old) && bytes[..HEADER].contains(&0),
            _ => false,
        }
}

/// Returns whether one byte in ten of the beginning is a control character that text has no use for. NUL is not counted:
/// instruments pad with it, and half of UTF-16 is made of it.
fn looks_binary(bytes: &[u8]) -> bool {
    const LOOK: usize = 4096;
    const FEWEST: usize = 32;
    let start = &bytes[..bytes.len().min(LOOK)];
    let strange = start.iter().filter(|byte| matches!(byte, 0x01..=0x08 | 0x0E..=0x19 | 0x1C..=0x1F)).count();
    start.len() >= FEWEST
        && strange * 10 > start.len()
        && !start.starts_with(b"\xFF\xFE")
        && !start.starts_with(b"\xFE\xFF")
}
