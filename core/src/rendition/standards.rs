//! Standard data of the indices, and the reasons that a light has none.

use crate::light::{CctError, DaylightBasis, DaylightError, LocusError};
use crate::patch_set::PatchSet;
use crate::spectral::Sensor;

/// Reason that a light has no index.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RenditionError {
    /// Nothing is seen of the light in the range of the index.
    #[error("the light has no power between {first_nm} and {last_nm} nm")]
    NoPower {
        /// First wavelength of the range in nanometers.
        first_nm: u16,
        /// Last wavelength of the range in nanometers.
        last_nm: u16,
    },
    /// Lamps of one line, such as low-pressure sodium, are outside CIE 13.3.
    #[error(
        "four fifths of the luminance lie within 20 nm of {nm} nm, and CIE 13.3 excludes lamps that are mainly monochromatic"
    )]
    Monochromatic {
        /// Peak of the band in nanometers.
        nm: u16,
    },
    /// There is no temperature to take the reference illuminant at.
    #[error("no reference illuminant: {0}")]
    Temperature(#[from] CctError),
    /// Daylight is undefined at the light's temperature.
    #[error("no reference illuminant: {0}")]
    Daylight(#[from] DaylightError),
    /// An observer does not count in XYZ.
    #[error("the observer of the index must be an XYZ observer: {0}")]
    Observer(#[from] LocusError),
    /// The set of test samples is another one.
    #[error("{found} test samples, but the index is defined for {expected}")]
    Samples {
        /// Number of samples that there are.
        found: usize,
        /// Number that the standard has.
        expected: usize,
    },
    /// A test sample has no color coordinates under the light, which is too saturated or partly negative.
    #[error("test sample {sample} has no color coordinates under this light")]
    Undefined {
        /// The sample, from 1.
        sample: usize,
    },
    /// No sample falls into a hue bin, so that there is no polygon.
    #[error("no test sample falls into hue bin {bin} under the reference illuminant")]
    EmptyBin {
        /// The bin, from 1.
        bin: usize,
    },
}

/// Observers, samples and basis that the indices are defined with.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Standards {
    /// CIE 1931 2° observer.
    pub cie_1931: Sensor,
    /// CIE 1964 10° observer.
    pub cie_1964: Sensor,
    /// Daylight by temperature.
    pub daylight: DaylightBasis,
    /// Test color samples 1 to 14 of CIE 13.3.
    pub test_colors: PatchSet,
    /// Color evaluation samples 1 to 99 of CIE 224 and TM-30.
    pub evaluation_colors: PatchSet,
}
