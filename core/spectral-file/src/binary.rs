//! Binary files, recognized by their first bytes.

use std::fmt;

use crate::decision::Encoding;

const SHEET: &str = "save the sheet with the spectra as CSV";
const PICTURE: &str = "a picture has no spectra; open the table they came from";
const UNPACK: &str = "unpack it and open the text files in it";
const AVASOFT: &str = "export it in AvaSoft as text (File, Convert Graph, To ASCII)";
const EXPORT: &str = "export the measurement as text or CSV";

/// The kinds of binary files: each with its words, its remedy as the second half of a sentence, and the bytes it may begin with.
macro_rules! kinds {
    ($($kind:ident $words:literal, $remedy:expr, [$($magic:literal),*];)+) => {
        /// A kind of binary file that is recognized by its first bytes.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum BinaryKind {
            $(#[doc = concat!("This is ", $words, ".")] $kind,)+
        }

        impl fmt::Display for BinaryKind {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match self { $(Self::$kind => $words,)+ })
            }
        }

        impl BinaryKind {
            pub(super) fn remedy(self) -> &'static str {
                match self { $(Self::$kind => $remedy,)+ }
            }

            /// Returns whether such files hold something else than measurements.
            pub(super) fn is_of_no_spectra(self) -> bool {
                matches!(self, Self::Pdf | Self::Icc | Self::Unknown) || [PICTURE, UNPACK].contains(&self.remedy())
            }
        }

        const MAGIC: &[(&[u8], BinaryKind)] = &[$($(($magic, BinaryKind::$kind),)*)+];
    };
}

kinds! {
    Zip "a ZIP container (such as .xlsx)", SHEET, [b"PK\x03\x04"];
    Xlsx "an Excel workbook (.xlsx)", SHEET, [];
    Ods "an OpenDocument sheet (.ods)", SHEET, [];
    ProcSpec "an Ocean binary measurement (.ProcSpec)",
        "save it in SpectraSuite or OceanView as tab delimited text or as JCAMP-DX", [];
    Ole2 "an OLE2 container (such as an old .xls)", SHEET, [b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"];
    Xls "an old Excel workbook (.xls)", SHEET, [];
    Shimadzu "a Shimadzu UVProbe spectrum (.spc)", "save it in UVProbe as text (File, Save As, Data Print Table)", [];
    Jasco "a JASCO spectrum (.jws)", "export it in Spectra Manager as CSV, text or JCAMP-DX", [];
    Png "a PNG image", PICTURE, [b"\x89PNG"];
    Jpeg "a JPEG image", PICTURE, [b"\xFF\xD8\xFF"];
    Pdf "a PDF document", "copy its table into a text file, a wavelength and its values in each line", [b"%PDF"];
    Gzip "a gzip archive", UNPACK, [b"\x1F\x8B"];
    AvaSoft8 "an AvaSoft 8 binary measurement (AVS8x)", AVASOFT, [b"AVS8"];
    // Versions 60 and 70 as numbers in single precision.
    AvaSoft7 "an AvaSoft 6 or 7 binary measurement (such as .ROH or .TRM)", AVASOFT,
        [b"\x00\x00\x70\x42", b"\x00\x00\x8C\x42"];
    GramsSpc "a GRAMS spectrum (.spc)",
        "export it as text (x, y) or as JCAMP-DX from the program that wrote it", [];
    Icc "an ICC profile", "it holds no spectra; open the measurements it was made of (.ti3, CGATS, CxF)", [];
    Envi "an ENVI header, whose numbers are in the binary file beside it",
        "export the spectra in ENVI as an ASCII plot or spectral library text", [b"ENVI\n", b"ENVI\r\n"];
    Omnic "a Thermo OMNIC spectrum (.spa)", "save it in OMNIC as CSV text or as JCAMP-DX", [b"Spectral Data File\r\n"];
    PerkinElmer "a PerkinElmer spectrum (.sp)", "save it in its program as ASCII (.asc) or as JCAMP-DX", [b"PEPE"];
    Renishaw "a Renishaw WiRE measurement (.wdf)", "save it in WiRE as text", [b"WDF1"];
    Andor "an Andor file (.sif)", EXPORT, [b"Andor Technology Multi-Channel File"];
    NetCdf "a netCDF file", EXPORT, [b"CDF\x01", b"CDF\x02"];
    Numpy "a NumPy array", "write it with numpy.savetxt, wavelengths in the first column", [b"\x93NUMPY"];
    RData "an R workspace", "write its spectra with write.csv", [b"RDX2\n", b"RDX3\n"];
    Sqlite "an SQLite database", EXPORT, [b"SQLite format 3\0"];
    Parquet "a Parquet table", EXPORT, [b"PAR1"];
    Archive "an archive", UNPACK, [b"7z\xBC\xAF\x27\x1C", b"Rar!\x1A\x07"];
    Asd "an ASD binary measurement (.asd)", "export it in ViewSpec Pro as ASCII",
        [b"ASD\0", b"as2\0", b"as3\0", b"as6\0", b"as7\0", b"as8\0"];
    Hdf5 "an HDF5 file", EXPORT, [b"\x89HDF\r\n"];
    Tiff "a TIFF image", PICTURE, [b"II*\0", b"MM\0*"];
    Exr "an OpenEXR image", PICTURE, [b"\x76\x2F\x31\x01"];
    Matlab "a MATLAB workspace", "write wavelengths and values with writematrix as CSV", [b"MATLAB 5.0 MAT-file", b"MATLAB 7.3 MAT-file"];
    Opus "a Bruker OPUS measurement", "save it in OPUS as a data point table or as JCAMP-DX", [b"\x0A\x0A\xFE\xFE"];
    Unknown "a binary file of an unknown kind", EXPORT, [];
}

pub(super) fn binary(bytes: &[u8]) -> Option<BinaryKind> {
    const LOOK: usize = 64;
    let control = bytes.iter().take(LOOK).any(|byte| *byte < b'\t');
    // Titles may begin with such letters.
    let lettered = |kind| matches!(kind, BinaryKind::PerkinElmer | BinaryKind::Parquet | BinaryKind::Renishaw);
    let begins = |(magic, kind): &&(&[u8], BinaryKind)| bytes.starts_with(magic) && (control || !lettered(*kind));
    let magic = MAGIC.iter().find(begins).map(|(_, kind)| *kind);
    let magic = magic.map(|kind| contained(kind, bytes));
    let icc = || (bytes.get(36..40) == Some(b"acsp")).then_some(BinaryKind::Icc);
    let spc = || is_grams(bytes).then_some(BinaryKind::GramsSpc);
    let unknown = || looks_binary(bytes).then_some(BinaryKind::Unknown);
    magic.or_else(icc).or_else(spc).or_else(unknown)
}

/// The kind of a file that is a container, by the names in its directory.
fn contained(container: BinaryKind, bytes: &[u8]) -> BinaryKind {
    const LOOK: usize = 64 << 10;
    const ZIPPED: [(&[u8], BinaryKind); 3] = [
        (b"OOISignatures.xml", BinaryKind::ProcSpec),
        (b"opendocument.spreadsheet", BinaryKind::Ods),
        (b"xl/work", BinaryKind::Xlsx),
    ];
    // Names are in UTF-16.
    const OLE2: [(&[u8], BinaryKind); 4] = [
        (b"W\0o\0r\0k\0b\0o\0o\0k\0", BinaryKind::Xls),
        (b"B\0o\0o\0k\0\0", BinaryKind::Xls),
        (b"Y\0-\0D\0a\0t\0a\0", BinaryKind::Jasco),
        (b"D\0a\0t\0a\0S\0", BinaryKind::Shimadzu),
    ];
    let begun = &bytes[..bytes.len().min(LOOK)];
    let (names, part): (&[_], _) = match container {
        BinaryKind::Zip => (&ZIPPED, &bytes[bytes.len().saturating_sub(LOOK)..]),
        BinaryKind::Ole2 => (&OLE2, ole2_directory(bytes).unwrap_or_default()),
        _ => return container,
    };
    let part = &part[..part.len().min(LOOK)];
    let has = |name: &[u8]| [begun, part].iter().any(|part| part.windows(name.len()).any(|window| window == name));
    names.iter().find(|(name, _)| has(name)).map_or(container, |(_, kind)| *kind)
}

/// The directory of an OLE2 container and what follows it: its sector stands at byte 48, the size of sectors at byte 30.
fn ole2_directory(bytes: &[u8]) -> Option<&[u8]> {
    let shift = u32::from(u16::from_le_bytes(*bytes.get(30..)?.first_chunk()?));
    let sector = u64::from(u32::from_le_bytes(*bytes.get(48..)?.first_chunk()?));
    bytes.get(usize::try_from((sector + 1).checked_shl(shift.min(16))?).ok()?..)
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
/// instruments pad with it, and half of UTF-16 is made of it; but no text has it among as many bytes beyond ASCII.
fn looks_binary(bytes: &[u8]) -> bool {
    const LOOK: usize = 4096;
    const FEWEST: usize = 32;
    let start = &bytes[..bytes.len().min(LOOK)];
    let strange = start.iter().filter(|byte| matches!(byte, 0x01..=0x08 | 0x0E..=0x19 | 0x1C..=0x1F)).count();
    let beyond = start.iter().filter(|byte| **byte >= 0x80).count();
    let zeros = start.split(|byte| *byte == 0).count() - 1;
    let numbers = beyond * 5 > start.len() && zeros * 50 > start.len() && bare_utf16(start).is_none();
    start.len() >= FEWEST
        && (strange * 10 > start.len() || numbers)
        && !start.starts_with(b"\xFF\xFE")
        && !start.starts_with(b"\xFE\xFF")
}

/// Text of two bytes for each character, most of which are of the first 256, without a byte order mark.
pub(super) fn bare_utf16(bytes: &[u8]) -> Option<Encoding> {
    const LOOK: usize = 4096;
    const FEWEST: usize = 8;
    let start = &bytes[..bytes.len().min(LOOK) & !1];
    let zeros = |from: usize| start.iter().skip(from).step_by(2).filter(|byte| **byte == 0).count();
    let (even, odd, half) = (zeros(0), zeros(1), start.len() / 2);
    // Padding leaves zeros in both places.
    let only = |these: usize, others: usize| half >= FEWEST && these * 2 > half && others == 0;
    match () {
        () if only(odd, even) => Some(Encoding::Utf16Le),
        () if only(even, odd) => Some(Encoding::Utf16Be),
        () => None,
    }
}
