//! View state of the Numerics workspace.

use chromascope_measure::Workload;

use crate::profiler::Subject;

#[derive(Clone, Debug, Default)]
pub struct AccuracyView {
    /// Selected measurement.
    pub shows: Shows,
}

/// Measurement whose methods are shown.
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
