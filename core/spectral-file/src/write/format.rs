//! Formats and grids of written files, notes on changes to what is written, and errors of writing.

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

    /// The range in which a curve of a range has values.
    pub(super) fn within(self, [first, last]: [f64; 2]) -> [f64; 2] {
        let half = if let Self::Average(width) = self { width / 2.0 } else { 0.0 };
        [first + half, last - half]
    }
}

/// A format that curves can be written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// Wavelengths down the first column, curves beside it, below a header `wavelength_nm,<curve> [<quantity> in <unit>],...`. Curves
    /// keep their own wavelengths; a cell is blank where a curve has no sample. Names are quoted as in RFC 4180.
    Csv,
    /// The same table below comments `# key: value`, without a file beside it.
    CommentedCsv,
    /// JSON of rawtoaces (schema 1.0.0 of rawtoaces-data): wavelengths as keys, a value for each curve. The schema requires
    /// [`Sheet::created`](super::Sheet::created).
    ///
    /// rawtoaces takes the keys in the order of their text and compares their distances in single precision, so that they
    /// must stay below 1000 nm, and be even to the last bit.
    RawtoacesJson,
    /// JSON of dcamprof: the sensitivities of a camera, or one spectrum of any other kind. The grid may be uneven.
    DcamprofJson,
    /// `.sp` of Argyll: one or several spectra. At most 601 bands, evenly spaced, at least 1 nm apart; of more, those that cover 380 to
    /// 780 nm and leave out the least.
    ArgyllSp,
    /// `.cmf` of Argyll: three curves for the place of an observer, on a grid like that of `.sp`. Has no names.
    ArgyllCmf,
    /// CGATS.17, one row for each curve, evenly spaced, at least 1 nm apart.
    Cgats,
}

impl Format {
    /// Every format, in the order of a menu.
    pub const ALL: [Self; 7] = [
        Self::Csv,
        Self::CommentedCsv,
        Self::RawtoacesJson,
        Self::DcamprofJson,
        Self::ArgyllSp,
        Self::ArgyllCmf,
        Self::Cgats,
    ];

    fn words(self) -> [&'static str; 3] {
        match self {
            Self::Csv => ["CSV", "csv", "csv"],
            Self::CommentedCsv => ["CSV with comments", "csv", "commented-csv"],
            Self::RawtoacesJson => ["rawtoaces JSON", "json", "rawtoaces"],
            Self::DcamprofJson => ["dcamprof JSON", "json", "dcamprof"],
            Self::ArgyllSp => ["Argyll spectrum", "sp", "sp"],
            Self::ArgyllCmf => ["Argyll color matching functions", "cmf", "cmf"],
            Self::Cgats => ["CGATS", "txt", "cgats"],
        }
    }

    /// True for tables of CSV, which have files beside them.
    pub const fn is_csv(self) -> bool {
        matches!(self, Self::Csv | Self::CommentedCsv)
    }

    /// The name for a menu.
    pub fn name(self) -> &'static str {
        self.words()[0]
    }

    /// The usual ending of the file's name, without the point.
    pub fn ending(self) -> &'static str {
        self.words()[1]
    }

    /// The name for a command line.
    pub fn key(self) -> &'static str {
        self.words()[2]
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} (.{})", self.name(), self.ending())
    }
}

/// Something in the text that is not as it was in the curves.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what changed")]
pub enum Note {
    #[error("resampled to {step_nm} nm, {}", if *.smooth { "by Sprague's interpolation" } else { "linearly" })]
    Resampled { step_nm: f64, smooth: bool },
    #[error("steps of {} nm became {to_nm} nm without averaging: narrow lines may be lost", (.from_nm * 1e3).round() / 1e3)]
    Thinned { from_nm: f64, to_nm: f64 },
    /// Values are means over bands around multiples of a step. Holds the step and the width of the bands, in nanometers.
    #[error("averaged over bands of {0} nm (means of the linear interpolant)")]
    Averaged(f64),
    #[error("only {from_nm} to {to_nm} nm is written")]
    Clipped { from_nm: f64, to_nm: f64 },
    /// Sensitivities per photon were multiplied by λ / 550 nm, because the format means sensitivities per energy.
    #[error("sensitivities per photon became sensitivities per energy")]
    PerEnergy,
    #[error("{} beside red, green and blue {} not in the file", counted(*.0, "curve"), if *.0 == 1 { "is" } else { "are" })]
    LeftOut(usize),
    #[error("{0} of the columns are blank: no wavelength of the grid is in range")]
    Blank(usize),
    #[error("{} {} blank, did not fit on a line or meant other values: {} replaced", counted(*.0, "name"), if *.0 == 1 { "was" } else { "were" }, if *.0 == 1 { "it was" } else { "they were" })]
    Renamed(usize),
    #[error("names of curves are not in the file: the format has no place for them")]
    NoNames,
    #[error("uncertainties of the values are not in the file: the format has no place for them")]
    NoUncertainty,
    #[error("uncertainties between samples and of averages are as if all samples erred alike")]
    Alike,
    #[error(
        "the covariance of the samples is not written: it goes into a file beside CSV, and is that of the curves as measured"
    )]
    NoCovariance,
    #[error("rawtoaces finds a camera by maker and model, and both are not known")]
    Unidentified,
}

fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("one {noun}") } else { format!("{count} {noun}s") }
}

/// Reason why curves cannot be written. Curves count from one.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum WriteError {
    #[error("there are no curves")]
    NoCurves,
    #[error("curve {0} has not one value for each wavelength")]
    Lengths(usize),
    #[error("curve {0} has fewer than two samples")]
    TooShort(usize),
    #[error("the wavelengths of curve {0} do not ascend from above zero")]
    Wavelengths(usize),
    #[error("curve {0} has a value that is no finite number")]
    NotFinite(usize),
    #[error("curve {0} has not one uncertainty of at least zero for each value, and a coverage factor above zero")]
    Uncertainty(usize),
    #[error("the covariance is not one of the samples of all curves")]
    Covariance,
    #[error("red, green and blue are not three of the curves")]
    Channels,
    #[error("the step must be a number of at least 0.001 nm")]
    Step,
    #[error("{} takes {wanted} of such curves at once, not {found}", format.name())]
    Count { format: Format, found: usize, wanted: usize },
    #[error("{} is not for curves of this kind", .0.name())]
    OtherContent(Format),
    #[error("{} cannot be written in steps of {step_nm} nm", format.name())]
    StepOfFormat { format: Format, step_nm: f64 },
    #[error("{} has at most {most} bands, and these would be {found}", format.name())]
    Bands { format: Format, found: usize, most: usize },
    #[error("fewer than two wavelengths are in the range of the curves")]
    NoOverlap,
    #[error("the table would have too many cells")]
    TooLarge,
}
