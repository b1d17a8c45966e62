//! Reasons that bytes make no raw image.

/// Free converters from the raw files of makers to DNG.
pub const CONVERTERS: &str = "Adobe DNG Converter or dnglab";
/// Remedy for what no DNG converter makes readable.
pub(crate) const DEVELOP: &str = "develop it to a linear TIFF in camera RGB with LibRaw's `dcraw_emu -4 -T -o 0 -r 1 1 1 1` (or `dcraw` with the same options)";

/// Reason that a raw image cannot be read, with field and remedy.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum RawImageError {
    #[error("not a DNG (no TIFF header with a DNGVersion); open a DNG, or a linear TIFF, PNG or EXR as a picture")]
    NotDng,
    #[error("{format} is not read: convert it to DNG with {CONVERTERS}, or {DEVELOP}, all free of charge")]
    OtherRaw { format: &'static str },
    #[error("{0}; the file is damaged or incomplete, copy it again")]
    Directory(#[from] tiff::TiffError),
    #[error("the DNG has no raw image, only previews; convert the camera's file anew")]
    NoRawImage,
    #[error("the DNG has no `{field}`; convert the camera's file anew")]
    Missing { field: &'static str },
    #[error("`{field}` is {value}; expected {expected}")]
    Value { field: &'static str, value: String, expected: &'static str },
    #[error("{what} is not read; {remedy}")]
    Unsupported { what: &'static str, remedy: &'static str },
    #[error("{width} × {height} pixels are more than the file holds, or than 400 million; copy the file again")]
    Size { width: usize, height: usize },
    #[error("the data of tile or strip {index} end early; the file is damaged or incomplete, copy it again")]
    Truncated { index: usize },
    #[error("tile or strip {index}: {error}")]
    LosslessJpeg { index: usize, error: LosslessJpegError },
    #[error("tile or strip {index}: JPEG XL: {error}")]
    JpegXl { index: usize, error: String },
}

/// Reason that a lossless JPEG (ITU-T T.81, process 14) cannot be decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum LosslessJpegError {
    #[error("the JPEG data end early; the file is damaged or incomplete, copy it again")]
    Truncated,
    #[error("no JPEG data; the file is damaged, copy it again")]
    NotJpeg,
    #[error(
        "a lossy JPEG (start of frame {0:#04X}) is not read; convert the camera's file anew with lossless compression"
    )]
    Lossy(u8),
    #[error("broken `{0}` of the JPEG data; the file is damaged, copy it again")]
    Segment(&'static str),
    #[error("the JPEG has {found} samples, the tile {expected}; convert the camera's file anew")]
    Size { found: usize, expected: usize },
    #[error("broken Huffman code in row {row}; the file is damaged, copy it again")]
    Code { row: usize },
}
