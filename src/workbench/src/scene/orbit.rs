//! The viewpoint of a rendered mesh, as the user turns it.

use chromascope_core::scene::Viewpoint;
use serde::{Deserialize, Serialize};

use crate::document::render::{MeshChoice, RenderSettings};

/// The distance of an orbit from which a mesh fills the picture, at the initial field of view; of a round one, in radii.
pub const FRAMED: f64 = 3.6;

const FIELD_DEG: f64 = 30.0;

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Orbit {
    pub yaw_deg: f64,
    pub pitch_deg: f64,
    /// Over [`FRAMED`], the factor on the distance from which the mesh fills the picture.
    pub distance: f64,
    /// Vertical field of view in degrees; in an upright picture the horizontal one.
    pub field_of_view_deg: f64,
}

impl Default for Orbit {
    fn default() -> Self {
        Self { yaw_deg: -25.0, pitch_deg: 5.0, distance: FRAMED, field_of_view_deg: FIELD_DEG }
    }
}

impl Orbit {
    /// The view that a mesh begins with.
    pub fn of(settings: &RenderSettings) -> Self {
        let usual = Self::default();
        match settings.mesh {
            // From elsewhere a frond points at the eye.
            MeshChoice::Fern if settings.composed => Self { yaw_deg: usual.yaw_deg + 20.0, pitch_deg: 15.0, ..usual },
            MeshChoice::Fern => Self { pitch_deg: 15.0, ..usual },
            _ => usual,
        }
    }

    #[must_use]
    pub fn turned(self, yaw_deg: f64, pitch_deg: f64) -> Self {
        let yaw_deg = (self.yaw_deg + yaw_deg + 180.0).rem_euclid(360.0) - 180.0;
        Self { yaw_deg, pitch_deg: (self.pitch_deg + pitch_deg).clamp(-89.0, 89.0), ..self }
    }

    #[must_use]
    pub fn at_distance(self, factor: f64) -> Self {
        Self { distance: (self.distance * factor).clamp(1.05, 100.0), ..self }
    }

    /// This view with another field of view, moved so that the mesh stays as large as it was.
    #[must_use]
    pub fn with_field_of_view(self, degrees: f64) -> Self {
        let half = |degrees: f64| (degrees.to_radians() / 2.0).sin();
        let moved = self.at_distance(half(self.field_of_view_deg) / half(degrees));
        Self { field_of_view_deg: degrees, ..moved }
    }

    /// The viewpoint for a picture of the given width over height, which the mesh fills from the initial distance.
    pub fn viewpoint(&self, aspect: f64) -> Option<Viewpoint> {
        let half = (self.field_of_view_deg.to_radians() / 2.0).tan() / aspect.clamp(0.05, 1.0);
        let field = (2.0 * half.atan()).min(150_f64.to_radians());
        let sin = |degrees: f64| (degrees.to_radians() / 2.0).sin();
        // At another field of view the same size is seen from another distance.
        let framed = FRAMED * sin(FIELD_DEG) / sin(self.field_of_view_deg);
        let viewpoint = Viewpoint::new(self.yaw_deg.to_radians(), self.pitch_deg.to_radians(), self.distance, field);
        viewpoint.and_then(|viewpoint| viewpoint.framed(aspect.clamp(0.05, 20.0), self.distance / framed)).ok()
    }
}
