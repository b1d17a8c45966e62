//! Reasons that bytes make no spectral image.

/// Reason that a spectral image cannot be read, with field and remedy.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The header is not ENVI's.
    #[error("line 1: the first line of an ENVI header is ENVI; name the .hdr file")]
    NotEnvi,
    /// A meaningless line of a header.
    #[error("line {line}: expected `field = value`")]
    Line {
        /// The line, from 1.
        line: usize,
    },
    /// A brace that is never closed.
    #[error("line {line}: the list of `{field}` has no closing brace")]
    Open {
        /// The line, from 1.
        line: usize,
        /// The field.
        field: String,
    },
    /// A field without which nothing can be read.
    #[error("the header has no `{field}`; add the line `{field} = {example}`")]
    Missing {
        /// The field.
        field: &'static str,
        /// A value it might have.
        example: &'static str,
    },
    /// A value that means nothing.
    #[error("line {line}: `{field} = {value}`: {remedy}")]
    Value {
        /// The line, from 1.
        line: usize,
        /// The field.
        field: &'static str,
        /// The value, shortened.
        value: String,
        /// Description of valid values.
        remedy: &'static str,
    },
    /// A list with another length than there are bands.
    #[error("line {line}: `{field}` has {found} entries for {bands} bands")]
    Length {
        /// The line, from 1.
        line: usize,
        /// The field.
        field: &'static str,
        /// Number of entries.
        found: usize,
        /// Number of bands.
        bands: usize,
    },
    /// A side or a number of bands that cannot be.
    #[error("`{field}` is {value}; expected 1 to {limit}")]
    Size {
        /// The field.
        field: &'static str,
        /// Its value.
        value: usize,
        /// The limit.
        limit: usize,
    },
    /// A row too large for memory.
    #[error("a row of {width} pixels with {bands} bands exceeds 256 MB; cut the image into narrower ones")]
    Row {
        /// Pixels across.
        width: usize,
        /// Number of bands.
        bands: usize,
    },
    /// Fewer data than the header states.
    #[error(
        "the data have {found} bytes, but the header states {expected}; check samples, lines, bands, data type and header offset"
    )]
    Short {
        /// Bytes that the header states.
        expected: u64,
        /// Bytes that there are.
        found: u64,
    },
    /// Two bands of one wavelength.
    #[error("`{field}` has {nm} nm twice; mark one of the bands as bad (bbl), or remove it")]
    Twice {
        /// The field.
        field: &'static str,
        /// Wavelength in nanometers.
        nm: f64,
    },
    /// No usable band is left.
    #[error("`bbl` marks every band as bad")]
    NoBands,
    /// An `OpenEXR` file without spectral channels.
    #[error("no spectral channels; expected names such as S0.550,0nm (radiance) or T.550,0nm (reflectance)")]
    NoSpectrum,
    /// Both emission and reflectance.
    #[error("the file has both radiance (S0) and reflectance (T) channels; choose one")]
    Both,
    /// An `OpenEXR` feature that is not read.
    #[error("{0}")]
    Unsupported(&'static str),
    /// Rows that the image does not have.
    #[error("rows {from} to {to} of an image of {height} rows")]
    Rows {
        /// First row.
        from: usize,
        /// Row after the last.
        to: usize,
        /// Number of rows.
        height: usize,
    },
    /// `OpenEXR` that cannot be decoded.
    #[error("OpenEXR: {0}")]
    Exr(String),
    /// The data cannot be read.
    #[error("the data cannot be read: {0}")]
    Io(#[from] std::io::Error),
}

impl From<exr::error::Error> for ImageError {
    fn from(error: exr::error::Error) -> Self {
        match error {
            exr::error::Error::Io(error) => Self::Io(error),
            other => Self::Exr(other.to_string()),
        }
    }
}
