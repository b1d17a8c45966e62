//! How the rendered mesh is looked at: the orbit, how pictures stand, the pixel that is read.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::paint::PictureTextures;
use crate::plot_item::SensorId;
pub use crate::scene::orbit::Orbit;

/// The part that is kept between runs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RenderLook {
    /// How pictures stand.
    pub mode: RenderMode,
    /// Where the mesh is seen from; none for the mesh's own view.
    pub orbit: Option<Orbit>,
    /// Where the divider of the split picture stands, from 0 at the left to 1.
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
    /// Brings what a spoiled file says within its range.
    pub fn mend(&mut self) {
        if !(0.0..=1.0).contains(&self.split) {
            self.split = Self::default().split;
        }
        self.orbit = self.orbit.filter(|orbit| orbit.viewpoint(1.0).is_some());
    }
}

/// How pictures stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum RenderMode {
    /// One for each sensor.
    #[default]
    Grid,
    /// The reference and a sensor in one.
    Split,
    /// One sensor, large.
    One,
    /// How far each sensor is from the reference.
    Difference,
}

/// A place in every picture, with the sensor that was pointed at.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelPlace {
    /// Right and down, from 0 to 1.
    pub at: [f64; 2],
    /// The sensor whose picture it was.
    pub source: SensorId,
}

/// What the pane shows now.
#[derive(Debug, Default)]
pub struct RenderView {
    /// The pixel that is kept.
    pub pinned: Option<PixelPlace>,
    /// The pixel under the pointer.
    pub hovered: Option<PixelPlace>,
    /// The sensor that stands alone or beside the reference; none for the first camera.
    pub chosen: Option<SensorId>,
    /// For how long pictures have been in the making.
    pub busy: Option<Duration>,
    /// What is being made, in a word.
    pub making: &'static str,
    /// True if finer pictures than those on show are not wanted.
    pub cancelled: bool,
    /// The pictures as textures.
    pub textures: PictureTextures,
    /// What is typed to find a material.
    pub material_search: String,
}

impl RenderView {
    /// After this long a computation is shown to be going on, and Esc ends it.
    pub const PATIENCE: Duration = Duration::from_millis(100);

    /// True if a computation has been going on for long enough to be told of.
    pub fn is_waiting(&self) -> bool {
        self.busy.is_some_and(|busy| busy >= Self::PATIENCE)
    }
}
