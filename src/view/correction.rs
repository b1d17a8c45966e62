//! View state of the Correction pane.

use std::sync::Arc;

use crate::export::profile::CorrectionFile;

/// State of the Correction pane.
#[derive(Debug, Default)]
pub struct CorrectionView {
    /// The camera chosen there; the first that is compared otherwise.
    pub camera: Option<String>,
    /// The current correction.
    pub shown: Option<Arc<CorrectionFile>>,
}

/// A file that a correction is saved as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CorrectionForm {
    /// DNG camera profile.
    Dcp,
    /// ICC matrix profile.
    Icc,
    /// ACES input transform.
    Clf,
    /// Everything in words and numbers.
    Text,
}

impl CorrectionForm {
    /// All forms, in the order of their buttons.
    pub const ALL: [Self; 4] = [Self::Dcp, Self::Icc, Self::Clf, Self::Text];

    /// The ending of such files.
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Dcp => "dcp",
            Self::Icc => "icc",
            Self::Clf => "clf",
            Self::Text => "txt",
        }
    }

    /// Label of the button, and the object it saves.
    pub const fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Dcp => ("DCP…", "Save a DNG camera profile for raw developers: matrices of one light or two"),
            Self::Icc => ("ICC…", "Save an ICC matrix profile for linear RGB, balanced for the light"),
            Self::Clf => ("ACES CLF…", "Save the ACES input transform as rawtoaces defines it, in Common LUT Format"),
            Self::Text => ("Text…", "Save all that stands here as text"),
        }
    }
}
