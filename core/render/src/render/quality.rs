//! Levels of exactness of a rendering.

use chromascope_color::accuracy::RelTolerance;
use chromascope_color::spectral::grid::COUNT;
use chromascope_text::choices;

/// Share of the error for omitted coherent terms, and for the others.
const SKIPPED_OF_ERROR: f64 = 0.1;
const COHERENT_OF_ERROR: f64 = 0.4;
/// Share of the brightest sample below which coherent terms are omitted from the sums over the grid.
const REFERENCE_COHERENT_SHARE: f64 = 1e-14;

/// Exactness of the mean over the lobe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SkyFineness {
    /// Number of directions.
    pub directions: usize,
    /// Samples in a row that share one mean.
    pub run: usize,
}

/// Exactness of the spectral integrals of a picture.
///
/// All but the last two keep a tolerance: a [`super::Plan`] chooses the fastest [`super::IntegrationMethod`] whose estimated error
/// bound is within it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quality {
    /// Six wavelengths, or moments where the surface is rough: error below 1e-4 of the peak, 1e-3 of the brightest
    /// sample for the specular lobe. For pictures in motion: nothing is made beforehand.
    Preview,
    /// Error below 1e-5 of the peak.
    #[default]
    Full,
    /// Error below 1e-9 of the peak.
    Fine,
    /// Sum over 401 wavelengths, S within 1e-13.
    Reference,
    /// Sum over 401 wavelengths with the paper's three cases of g, to show their error.
    Regimes,
    /// Error within a tolerance relative to the brightest sample of the picture: of the diffuse component and of the specular
    /// one, both before signals are rounded to single precision (6e-8 of themselves).
    Within(RelTolerance),
}

impl Quality {
    /// Allowed error; none of the two that sum over 401 wavelengths.
    pub fn tolerance(self) -> Option<RelTolerance> {
        match self {
            Self::Preview => Some(RelTolerance::at_best(1e-4)),
            Self::Full => Some(RelTolerance::at_best(1e-5)),
            Self::Fine => Some(RelTolerance::at_best(1e-9)),
            Self::Within(tolerance) => Some(tolerance),
            Self::Reference | Self::Regimes => None,
        }
    }

    /// Tolerance that was given as a number: that of [`Self::Within`].
    pub const fn given_tolerance(self) -> Option<RelTolerance> {
        if let Self::Within(tolerance) = self { Some(tolerance) } else { None }
    }

    /// Largest error relative to the picture's brightest sample; 0 for the sums over the grid.
    fn error(self) -> f64 {
        match self {
            Self::Preview => 1e-3,
            Self::Full => 1e-5,
            Self::Fine => 1e-9,
            Self::Reference | Self::Regimes => 0.0,
            Self::Within(tolerance) => tolerance.max_relative_error(),
        }
    }

    /// Share of the brightest sample below which coherent terms are omitted.
    pub fn coherent_share(self) -> f64 {
        (SKIPPED_OF_ERROR * self.error()).max(REFERENCE_COHERENT_SHARE)
    }

    /// Error of the included coherent terms, relative to the picture's brightest sample; 0 for the sums over the grid.
    pub fn coherent_tolerance(self) -> f64 {
        COHERENT_OF_ERROR * self.error()
    }

    /// Exactness of the mean over the sky, in a picture with so many samples along a pixel's side.
    pub fn sky_fineness(self, samples: u32) -> SkyFineness {
        let pixel = samples.max(1) as usize;
        match self {
            Self::Preview => SkyFineness { directions: 16, run: 4 * pixel },
            Self::Full => SkyFineness { directions: 48, run: pixel },
            Self::Fine | Self::Reference | Self::Regimes | Self::Within(_) => SkyFineness { directions: 1024, run: 1 },
        }
    }

    /// Returns true if samples below e^-30 of their peak are left out.
    pub const fn leaves_dark(self) -> bool {
        !matches!(self, Self::Reference | Self::Regimes)
    }

    /// Exactness in a few words: "error < 1e-5".
    pub fn summary(self) -> String {
        match self {
            Self::Preview => "preview".to_owned(),
            Self::Reference => format!("{COUNT} wavelengths"),
            Self::Regimes => "the paper's three cases of g".to_owned(),
            Self::Full => "error < 1e-5".to_owned(),
            Self::Fine => "error < 1e-9".to_owned(),
            Self::Within(tolerance) => format!("error < {tolerance}"),
        }
    }

    /// Name of the level.
    pub const fn level(self) -> QualityLevel {
        match self {
            Self::Preview => QualityLevel::Preview,
            Self::Full => QualityLevel::Full,
            Self::Fine => QualityLevel::Fine,
            Self::Reference => QualityLevel::Reference,
            Self::Regimes => QualityLevel::Regimes,
            Self::Within(_) => QualityLevel::Tolerance,
        }
    }
}

choices! {
    /// A [`Quality`] by name, as documents and the command line have it: without the number of [`Quality::Within`].
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
    pub enum QualityLevel {
        /// [`Quality::Preview`].
        Preview = "preview", "Preview, error < 1e-4",
            "as while something moves: few wavelengths, and only the mean of the specular lobe's oscillation";
        /// [`Quality::Full`].
        #[default]
        Full = "full", "Full, error < 1e-5", "error below 1e-5 of the peak, by the fastest method that keeps it";
        /// [`Quality::Fine`].
        Fine = "fine", "Fine, error < 1e-9", "error below 1e-9 of the peak, by the fastest method that keeps it";
        /// [`Quality::Reference`].
        #[cfg_attr(feature = "serde", serde(rename = "exact", alias = "reference"))]
        Reference = "reference" | "exact", "Reference, 401 wavelengths", "sum over all 401 wavelengths";
        /// [`Quality::Within`] a tolerance.
        Tolerance = "tolerance", "Within a tolerance", "error within a tolerance, by the fastest method that keeps it";
        /// [`Quality::Regimes`].
        Regimes = "regimes", "Paper's three cases of g", "sum over all 401 wavelengths with the paper's three cases of g";
    }
}

impl QualityLevel {
    /// The quality of this name.
    pub const fn quality(self, tolerance: RelTolerance) -> Quality {
        match self {
            Self::Preview => Quality::Preview,
            Self::Full => Quality::Full,
            Self::Fine => Quality::Fine,
            Self::Reference => Quality::Reference,
            Self::Tolerance => Quality::Within(tolerance),
            Self::Regimes => Quality::Regimes,
        }
    }
}
