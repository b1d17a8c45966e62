//! Reasons that bytes make no spectral image.

/// Reason that a spectral image cannot be read, with field and remedy.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum ImageError {
    #[error("line 1: the first line of an ENVI header is ENVI; name the .hdr file")]
    NotEnvi,
    #[error("line {line}: expected `field = value`")]
    Line { line: usize },
    #[error("line {line}: the list of `{field}` has no closing brace")]
    Open { line: usize, field: String },
    #[error("the header has no `{field}`; add the line `{field} = {example}`")]
    Missing { field: &'static str, example: &'static str },
    #[error("line {line}: `{field} = {value}`: {remedy}")]
    Value { line: usize, field: &'static str, value: String, remedy: &'static str },
    #[error("line {line}: `{field}` has {found} entries for {bands} bands")]
    Length { line: usize, field: &'static str, found: usize, bands: usize },
    #[error("`{field}` is {value}; expected 1 to {limit}")]
    Size { field: &'static str, value: usize, limit: usize },
    #[error("a row of {width} pixels with {bands} bands exceeds 256 MB; cut the image into narrower ones")]
    Row { width: usize, bands: usize },
    #[error(
        "the data have {found} bytes, but the header states {expected}; check samples, lines, bands, data type and header offset"
    )]
    Short { expected: u64, found: u64 },
    #[error("`{field}` has {nm} nm twice; mark one of the bands as bad (bbl), or remove it")]
    Twice { field: &'static str, nm: f64 },
    #[error("`bbl` marks every band as bad")]
    NoBands,
    #[error("no spectral channels; expected names such as S0.550,0nm (radiance) or T.550,0nm (reflectance)")]
    NoSpectrum,
    #[error("the file has both radiance (S0) and reflectance (T) channels; choose one")]
    Both,
    #[error("{0}")]
    Unsupported(&'static str),
    #[error("rows {from} to {to} of an image of {height} rows")]
    Rows { from: usize, to: usize, height: usize },
    #[error("OpenEXR: {0}")]
    Exr(String),
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
