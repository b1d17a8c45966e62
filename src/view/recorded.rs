//! View state of the Recorded pane, and of the page that measures a camera.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use chromascope_core::camera::recorded::Freedom;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::{RecordedSet, Shared};
use chromascope_core::spectral::GridSpectrum;

use crate::catalog::recorded_store::RecordedFile;
use crate::document::imported::Fingerprint;
use crate::scene::recorded::RankedCamera;

#[derive(Clone, Debug, Default)]
pub struct RecordedView {
    /// True while the open file dialog is for recorded values.
    pub opening: bool,
    pub path: Option<PathBuf>,
    /// Picture of a chart that is shown where a camera is measured.
    pub photo: Option<PathBuf>,
    /// All such pictures that were opened, with the contents of those that were read.
    pub photos: BTreeMap<PathBuf, Option<Fingerprint>>,
    /// Those of the last opening of which nothing could be made, with the reason.
    pub failed: BTreeMap<PathBuf, String>,
    pub freedom: Freedom,
    /// Raw value from which on a channel of a table is clipped; 0 for none.
    pub clip: f64,
    /// Camera whose residuals are shown; the best without one.
    pub camera: Option<String>,
    /// The current patches, and what they were made of.
    pub set: Option<(RecordedInputs, RecordedSet)>,
    /// The last ranking by values of the same file, and those values.
    pub ranked: Option<(RecordedSet, Arc<Vec<RankedCamera>>)>,
}

/// What patches with recorded values are made of.
#[derive(Clone, Debug)]
pub struct RecordedInputs {
    pub file: Arc<RecordedFile>,
    /// Its chart, if the file has no spectra of its own.
    pub chart: Option<Shared<PatchSet>>,
    pub light: Shared<GridSpectrum>,
    /// Raw value from which on a channel is clipped.
    pub clip: f64,
}

impl PartialEq for RecordedInputs {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.file, &other.file)
            && (&self.chart, &self.light) == (&other.chart, &other.light)
            && self.clip == other.clip
    }
}
