//! View state of the Render pane: orbit, arrangement of pictures and pinned pixel.

use serde::{Deserialize, Serialize};

pub use crate::figures::look::{PixelPlace, RenderMode};
use crate::plot_item::SensorId;
pub use crate::scene::orbit::Orbit;

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RenderLook {
    pub mode: RenderMode,
    /// Viewpoint; `None` for the mesh's own.
    pub orbit: Option<Orbit>,
    /// Position of the divider of the split picture, from 0 (left) to 1.
    pub split: f32,
}

/// Where the divider begins: through the face of the head as it is first seen.
const SPLIT: f32 = 0.62;

impl Default for RenderLook {
    fn default() -> Self {
        Self { mode: RenderMode::Grid, orbit: None, split: SPLIT }
    }
}

impl RenderLook {
    /// Corrects values of a damaged file that are out of range.
    pub fn mend(&mut self) {
        if !(0.0..=1.0).contains(&self.split) {
            self.split = Self::default().split;
        }
        self.orbit = self.orbit.filter(|orbit| orbit.viewpoint(1.0).is_some());
    }
}

#[derive(Debug, Default)]
pub struct RenderView {
    pub pinned: Option<PixelPlace>,
    pub hovered: Option<PixelPlace>,
    /// The sensor shown alone or with the reference; `None` for the first camera.
    pub chosen: Option<SensorId>,
    /// True if finer pictures than the current ones are not wanted.
    pub cancelled: bool,
}
