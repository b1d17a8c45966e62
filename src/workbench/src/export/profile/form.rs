//! Files that a color correction is saved as.

use chromascope_profile::icc::IccVersion;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CorrectionForm {
    Dcp,
    Icc(IccVersion),
    Clf,
    Dng,
    Text,
}

impl CorrectionForm {
    /// All forms, in the order of their buttons.
    pub const ALL: [Self; 6] =
        [Self::Dcp, Self::Icc(IccVersion::V4), Self::Icc(IccVersion::V2), Self::Clf, Self::Dng, Self::Text];

    pub const fn ending(self) -> &'static str {
        match self {
            Self::Dcp => "dcp",
            Self::Icc(_) => "icc",
            Self::Clf => "clf",
            Self::Dng | Self::Text => "txt",
        }
    }

    /// What the names of such files end with before the ending, so that no two forms of a correction share a name.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Icc(IccVersion::V2) => "-v2",
            Self::Dng => "-dng",
            _ => "",
        }
    }

    /// Label of the button, and the object it saves.
    pub const fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Dcp => ("DCP…", "DNG camera profile for raw developers: matrices of one light or two"),
            Self::Icc(IccVersion::V4) => {
                ("ICC v4…", "ICC matrix profile, version 4, for linear RGB balanced for the light")
            }
            Self::Icc(IccVersion::V2) => {
                ("ICC v2…", "ICC matrix profile, version 2, for programs that read no version 4, as ArgyllCMS")
            }
            Self::Clf => ("ACES CLF…", "ACES input transform as rawtoaces defines it, in Common LUT Format"),
            Self::Dng => ("DNG text…", "DNG's matrices and AsShotNeutral as lines of text"),
            Self::Text => ("Text…", "All matrices and errors as text"),
        }
    }
}
