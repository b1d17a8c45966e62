//! What is looked at in Metrics.

use serde::{Deserialize, Serialize};

use crate::plot_item::SensorId;

/// What is looked at in Metrics.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct MetricsLook {
    /// Cameras that are ranked.
    pub cameras: RankedCameras,
    /// The two that stand head to head; none for the selected one and the first compared one beside it.
    #[serde(skip)]
    pub pair: [Option<SensorId>; 2],
    /// The camera of the report card; none for the selected one.
    #[serde(skip)]
    pub card: Option<SensorId>,
}

/// A choice of cameras.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum RankedCameras {
    /// All of the library, the user's too.
    #[default]
    Library,
    /// Those that are compared.
    Compared,
    /// The user's.
    Yours,
}
