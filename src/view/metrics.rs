//! View state of the Metrics pane.

use chromascope_core::metamers::Confusion;
use chromascope_text::choices;
use serde::{Deserialize, Serialize};

use crate::plot_item::SensorId;
pub use crate::scene::metrics::RankedCameras;

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct MetricsLook {
    pub cameras: RankedCameras,
    pub confusion: Confuses,
    /// The two cameras of Head to head; `None` for the selected one and the first compared one.
    #[serde(skip)]
    pub pair: [Option<SensorId>; 2],
    /// The camera of the report card; none for the selected one.
    #[serde(skip)]
    pub card: Option<SensorId>,
}

choices! {
    /// The one that takes two reflectances for one.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Confuses {
        #[default]
        Camera = "camera", "Camera confuses", "Equal to the camera, different to the reference";
        Reference = "reference", "Reference confuses", "Equal to the reference, different to the camera";
    }
}

impl Confuses {
    pub const fn confusion(self) -> Confusion {
        match self {
            Self::Camera => Confusion::Camera,
            Self::Reference => Confusion::Observer,
        }
    }
}
