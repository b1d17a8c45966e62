//! View state of the Render pane: orbit, arrangement of pictures and pinned pixel.

use chromascope_text::choices;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::paint::PictureTextures;
use crate::plot_item::SensorId;
pub use crate::scene::orbit::Orbit;

/// The part that is saved between runs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RenderLook {
    /// Arrangement of pictures.
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

choices! {
    /// Arrangement of pictures.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum RenderMode {
        #[default]
        Grid = "grid", "Grid", "All sensors side by side";
        Split = "split", "Split", "The reference at the left, a sensor at the right, with a divider to drag";
        One = "one", "One", "One sensor, large (double-click a picture)";
        Difference = "difference", "Difference", "Difference of each sensor from the reference, pixel by pixel";
    }
}

/// A place in every picture, with the sensor that was pointed at.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelPlace {
    /// Right and down, from 0 to 1.
    pub at: [f64; 2],
    /// The sensor whose picture it was.
    pub source: SensorId,
}

/// View state of the Render pane.
#[derive(Debug, Default)]
pub struct RenderView {
    /// The pinned pixel.
    pub pinned: Option<PixelPlace>,
    /// The pixel under the pointer.
    pub hovered: Option<PixelPlace>,
    /// The sensor shown alone or with the reference; `None` for the first camera.
    pub chosen: Option<SensorId>,
    /// Running time of the rendering.
    pub busy: Option<Duration>,
    /// Name of the computation in progress.
    pub making: &'static str,
    /// Share of the rows of a spectral image that were read; none for a mesh.
    pub rows_read: Option<f32>,
    /// True if finer pictures than the current ones are not wanted.
    pub cancelled: bool,
    /// Time of egui in seconds since which the pictures are of something else than what is chosen.
    pub old_since: Option<f64>,
    /// The pictures as textures.
    pub textures: PictureTextures,
}

impl RenderView {
    /// After this long a computation is shown to be going on, and Esc ends it.
    pub const PATIENCE: Duration = Duration::from_millis(100);

    /// True if a computation has lasted long enough for progress to be shown.
    pub fn is_waiting(&self) -> bool {
        self.busy.is_some_and(|busy| busy >= Self::PATIENCE)
    }
}
