//! How the rendered mesh is looked at: the orbit, how pictures stand, the pixel that is read.

use std::sync::Arc;
use std::time::Duration;

use chromascope_core::scene::Viewpoint;
use serde::{Deserialize, Serialize};

use crate::document::render::MeshChoice;
use crate::paint::PictureTextures;
use crate::plot_item::SensorId;
use crate::render_service::RenderedFrame;

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

impl Default for RenderLook {
    fn default() -> Self {
        Self { mode: RenderMode::Grid, orbit: None, split: 0.5 }
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

/// Where the mesh is seen from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Orbit {
    /// Around the vertical, in degrees.
    pub yaw_deg: f64,
    /// Above the horizon, in degrees.
    pub pitch_deg: f64,
    /// From the center, in radii of the scene.
    pub distance: f64,
    /// Vertical field of view in degrees; in an upright picture the horizontal one.
    pub field_of_view_deg: f64,
}

impl Default for Orbit {
    fn default() -> Self {
        Self { yaw_deg: 20.0, pitch_deg: 5.0, distance: 3.6, field_of_view_deg: 30.0 }
    }
}

impl Orbit {
    /// The view that a mesh is first seen in.
    pub fn of(mesh: &MeshChoice) -> Self {
        match mesh {
            MeshChoice::Fern => Self { pitch_deg: 15.0, ..Self::default() },
            _ => Self::default(),
        }
    }

    /// The same, turned by angles in degrees.
    #[must_use]
    pub fn turned(self, yaw_deg: f64, pitch_deg: f64) -> Self {
        let yaw_deg = (self.yaw_deg + yaw_deg + 180.0).rem_euclid(360.0) - 180.0;
        Self { yaw_deg, pitch_deg: (self.pitch_deg + pitch_deg).clamp(-89.0, 89.0), ..self }
    }

    /// The same, farther away by a factor.
    #[must_use]
    pub fn at_distance(self, factor: f64) -> Self {
        Self { distance: (self.distance * factor).clamp(1.05, 100.0), ..self }
    }

    /// The same with another field of view, moved so that the mesh stays as large as it was.
    #[must_use]
    pub fn with_field_of_view(self, degrees: f64) -> Self {
        let half = |degrees: f64| (degrees.to_radians() / 2.0).sin();
        let moved = self.at_distance(half(self.field_of_view_deg) / half(degrees));
        Self { field_of_view_deg: degrees, ..moved }
    }

    /// The viewpoint for a picture of the given width over height: what fits into a square is never cut.
    pub fn viewpoint(&self, aspect: f64) -> Option<Viewpoint> {
        let half = (self.field_of_view_deg.to_radians() / 2.0).tan() / aspect.clamp(0.05, 1.0);
        let field = (2.0 * half.atan()).min(150_f64.to_radians());
        Viewpoint::new(self.yaw_deg.to_radians(), self.pitch_deg.to_radians(), self.distance, field).ok()
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

/// What the pane shows now.
#[derive(Debug, Default)]
pub struct RenderView {
    /// The pictures on show.
    pub shot: Option<Arc<RenderedFrame>>,
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
    /// Whether finer pictures than those on show are not wanted.
    pub cancelled: bool,
    /// The pictures as textures.
    pub textures: PictureTextures,
    /// What is typed to find a material.
    pub material_search: String,
}

impl RenderView {
    /// After this long a computation is shown to be going on, and Esc ends it.
    pub const PATIENCE: Duration = Duration::from_millis(100);

    /// Whether a computation has been going on for long enough to be told of.
    pub fn is_waiting(&self) -> bool {
        self.busy.is_some_and(|busy| busy >= Self::PATIENCE)
    }
}
