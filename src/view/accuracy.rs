//! What is looked at in Accuracy.

use std::collections::BTreeMap;
use std::sync::Arc;

use chromascope_measure::{Report, Workload};

use crate::profiler::{SceneRun, SkippedWork, Subject};

/// What is looked at in Accuracy.
#[derive(Clone, Debug, Default)]
pub struct AccuracyView {
    /// Whose methods are on show.
    pub shows: Shows,
    /// The last run on the scene.
    pub run: Option<Arc<SceneRun>>,
    /// True if it is of the scene as it is now.
    pub is_current: bool,
    /// What was remembered since the start.
    pub remembered: Vec<SkippedWork>,
    /// The last reports of the bench.
    pub reports: BTreeMap<Workload, Arc<Result<Report, String>>>,
}

/// Whose methods are on show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shows {
    /// Those of the scene.
    Scene(Subject),
    /// Those of the program, on a workload of the bench.
    Bench(Workload),
}

impl Default for Shows {
    fn default() -> Self {
        Self::Scene(Subject::default())
    }
}
