//! Formats and grids of written files.

use std::fmt;

/// At which wavelengths curves are written.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Grid {
    /// Those of the curves. Formats with one even grid for all get it where the curves have one; else multiples of the
    /// largest of 1, 5 and 10 nm that is not above the curves' own step, over the range that all share.
    #[default]
    Native,
    /// Whole multiples of a step in nanometers, at least 0.001 nm: the values there.
    Step(f64),
    /// Whole multiples of a step in nanometers, at least 0.001 nm: the means over the band of one step around each.
    Average(f64),
}

impl Grid {
    /// The requested step in nanometers, if any.
    pub fn step_nm(self) -> Option<f64> {
        match self {
            Self::Native => None,
            Self::Step(step) | Self::Average(step) => Some(step),
        }
    }
}

/// A format that curves can be written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// Wavelengths down the first column, curves beside it, comments `# key: value` above. Curves keep their own
    /// wavelengths; a cell is blank where a curve has no sample. Names are quoted as in RFC 4180.
    Csv,
    /// JSON of rawtoaces (schema 1.0.0 of rawtoaces-data): wavelengths as keys, a value for each curve.
    ///
    /// rawtoaces takes the keys in the order of their text and compares their distances in single precision, so that they
    /// must stay below 1000 nm, and be even to the last bit.
    RawtoacesJson,
    /// JSON of dcamprof: the sensitivities of a camera, or one spectrum of any other kind. The grid may be uneven.
    DcamprofJson,
    /// `.sp` of Argyll: one or several spectra. At most 601 bands, evenly spaced, at least 1 nm apart.
    ArgyllSp,
    /// `.cmf` of Argyll: three curves for the place of an observer, on a grid like that of `.sp`. Has no names.
    ArgyllCmf,
    /// CGATS.17, one row for each curve, evenly spaced, at least 1 nm apart.
    Cgats,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} (.{})", self.name(), self.ending())
    }
}
