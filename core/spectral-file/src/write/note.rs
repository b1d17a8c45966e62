//! Notes on changes to written curves, and errors of writing.

use std::fmt;

use crate::write::format::Format;

/// Something in the text that is not as it was in the curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Note {
    /// Values were interpolated at multiples of a step.
    Resampled {
        /// The step in nanometers.
        step_nm: f64,
        /// True if some of them by Sprague's polynomials, not linearly.
        smooth: bool,
    },
    /// The step is coarser than that of a curve: samples were picked, not averaged, and narrow lines may be lost.
    Thinned {
        /// The finest mean step of a curve in nanometers.
        from_nm: f64,
        /// The step in nanometers.
        to_nm: f64,
    },
    /// Values are means over bands around multiples of a step. Holds the step and the width of the bands, in nanometers.
    Averaged(f64),
    /// Some curves go on beyond what is written.
    Clipped {
        /// The first wavelength written, in nanometers.
        from_nm: f64,
        /// The last wavelength written, in nanometers.
        to_nm: f64,
    },
    /// Sensitivities per photon were multiplied by λ / 550 nm, because the format means sensitivities per energy.
    PerEnergy,
    /// Curves other than red, green and blue are not in the file.
    LeftOut(usize),
    /// Curves have no sample at any multiple of the step; their columns are blank.
    Blank(usize),
    /// Names of curves were blank, did not fit on a line, or would have been read as another quantity.
    Renamed(usize),
    /// The format has no place for the names of curves, or for one beside the title.
    NoNames,
    /// rawtoaces finds cameras by maker and model, which are not both known.
    Unidentified,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Resampled { step_nm, smooth } => {
                let how = if smooth { "by Sprague's interpolation" } else { "linearly" };
                write!(f, "resampled to {step_nm} nm, {how}")
            }
            Self::Thinned { from_nm, to_nm } => {
                let from_nm = (from_nm * 1e3).round() / 1e3;
                write!(f, "steps of {from_nm} nm became {to_nm} nm without averaging: narrow lines may be lost")
            }
            Self::Averaged(step_nm) => {
                write!(f, "averaged over bands of {step_nm} nm (means of the linear interpolant)")
            }
            Self::Clipped { from_nm, to_nm } => write!(f, "only {from_nm} to {to_nm} nm is written"),
            Self::PerEnergy => f.write_str("sensitivities per photon became sensitivities per energy"),
            Self::LeftOut(1) => f.write_str("one curve beside red, green and blue is not in the file"),
            Self::LeftOut(count) => write!(f, "{count} curves beside red, green and blue are not in the file"),
            Self::Blank(count) => {
                write!(f, "{count} of the columns are blank: no wavelength of the grid is in range")
            }
            Self::Renamed(1) => {
                f.write_str("one name was blank, did not fit on a line or meant other values: it was replaced")
            }
            Self::Renamed(count) => {
                write!(f, "{count} names were blank, did not fit on a line or meant other values: they were replaced")
            }
            Self::NoNames => f.write_str("names of curves are not in the file: the format has no place for them"),
            Self::Unidentified => f.write_str("rawtoaces finds a camera by maker and model, and both are not known"),
        }
    }
}

/// Reason why curves cannot be written. Curves count from one.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum WriteError {
    /// There is nothing to write.
    #[error("there are no curves")]
    NoCurves,
    /// A curve has more or fewer values than wavelengths.
    #[error("curve {0} has not one value for each wavelength")]
    Lengths(usize),
    /// A curve has fewer than two samples.
    #[error("curve {0} has fewer than two samples")]
    TooShort(usize),
    /// Wavelengths are not finite, not above zero or not ascending.
    #[error("the wavelengths of curve {0} do not ascend from above zero")]
    Wavelengths(usize),
    /// A value is not finite.
    #[error("curve {0} has a value that is no finite number")]
    NotFinite(usize),
    /// Red, green and blue are not three of the curves.
    #[error("red, green and blue are not three of the curves")]
    Channels,
    /// The step of the grid is NaN, or below 0.001 nm.
    #[error("the step must be a number of at least 0.001 nm")]
    Step,
    /// A format does not support this number of curves.
    #[error("{} takes {wanted} of such curves at once, not {found}", format.name())]
    Count {
        /// The format.
        format: Format,
        /// Number found.
        found: usize,
        /// Number that the format takes.
        wanted: usize,
    },
    /// A format is for something else.
    #[error("{} is not for curves of this kind", .0.name())]
    OtherContent(Format),
    /// The program that the format is for would not read this step.
    #[error("{} cannot be written in steps of {step_nm} nm", format.name())]
    StepOfFormat {
        /// The format.
        format: Format,
        /// The step in nanometers.
        step_nm: f64,
    },
    /// The program that the format is for would not read this number of bands.
    #[error("{} has at most {most} bands, and these would be {found}", format.name())]
    Bands {
        /// The format.
        format: Format,
        /// Number there would be.
        found: usize,
        /// Largest number allowed.
        most: usize,
    },
    /// There are not two wavelengths of the grid that every curve reaches and the format can hold.
    #[error("fewer than two wavelengths are in the range of the curves")]
    NoOverlap,
    /// There would be more curves or samples than can be read back.
    #[error("the table would have too many cells")]
    TooLarge,
}
