//! Viewpoint of a mesh: an orbit around its center, through a lens.

use chromascope_mesh::Bounds;
use glam::{DMat3, DVec3};
use std::f64::consts::{FRAC_PI_2, PI};
use std::hash::{Hash, Hasher};

/// Reason that numbers are not an orbit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum ViewpointError {
    /// An angle or distance is not a number.
    #[error("yaw, pitch, distance and field of view must be finite numbers")]
    NotFinite,
    /// The eye would stand within the mesh or out of sight.
    #[error("the distance must lie between 0.05 and 1000 scene radii")]
    Distance,
    /// The lens would see nothing, or half of everything.
    #[error("the field of view must lie between 0.1° and 150°")]
    FieldOfView,
}

/// An eye on a sphere around the mesh's center, looking at the center.
///
/// Yaw 0 looks at the front (along -z), yaw 90° at what is on +x; pitch 90° looks down. Distances count in radii of the
/// mesh's bounding sphere, so that one orbit suits meshes of any size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    yaw: f64,
    pitch: f64,
    distance: f64,
    field_of_view: f64,
}

impl Eq for Viewpoint {}

impl Hash for Viewpoint {
    fn hash<H: Hasher>(&self, state: &mut H) {
        [self.yaw, self.pitch, self.distance, self.field_of_view].map(|v| (v + 0.0).to_bits()).hash(state);
    }
}

impl Viewpoint {
    /// Takes yaw and pitch in radians, the distance in scene radii, and the vertical field of view in radians.
    ///
    /// Yaw is brought within half a turn; pitch is held within ±90°.
    ///
    /// # Errors
    ///
    /// [`ViewpointError`] where a number is not finite or out of range.
    pub fn new(yaw: f64, pitch: f64, distance: f64, field_of_view: f64) -> Result<Self, ViewpointError> {
        if ![yaw, pitch, distance, field_of_view].iter().all(|v| v.is_finite()) {
            return Err(ViewpointError::NotFinite);
        }
        if !(0.05..=1000.0).contains(&distance) {
            return Err(ViewpointError::Distance);
        }
        if !(0.1_f64.to_radians()..=150_f64.to_radians()).contains(&field_of_view) {
            return Err(ViewpointError::FieldOfView);
        }
        let yaw = (yaw + PI).rem_euclid(2.0 * PI) - PI;
        Ok(Self { yaw, pitch: pitch.clamp(-FRAC_PI_2, FRAC_PI_2), distance, field_of_view })
    }

    /// The angle around the vertical, in radians.
    pub fn yaw(&self) -> f64 {
        self.yaw
    }

    /// The angle above the horizon, in radians.
    pub fn pitch(&self) -> f64 {
        self.pitch
    }

    /// From the center, in radii of the bounding sphere.
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// The vertical field of view, in radians.
    pub fn field_of_view(&self) -> f64 {
        self.field_of_view
    }

    /// The eye and its axes before a mesh with these bounds.
    pub fn eye(&self, bounds: Bounds) -> Eye {
        let (sin_yaw, cos_yaw) = self.yaw.sin_cos();
        let (sin_pitch, cos_pitch) = self.pitch.sin_cos();
        let back = DVec3::new(sin_yaw * cos_pitch, sin_pitch, cos_yaw * cos_pitch);
        let right = DVec3::new(cos_yaw, 0.0, -sin_yaw);
        let up = back.cross(right);
        let radius = f64::from(bounds.radius).max(f64::MIN_POSITIVE);
        let center = bounds.center().as_dvec3();
        Eye {
            position: center + back * (self.distance * radius),
            center,
            radius,
            world_from_view: DMat3::from_cols(right, up, back),
            half_height: (self.field_of_view / 2.0).tan(),
        }
    }
}

/// An eye in the mesh's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// Position.
    pub position: DVec3,
    /// Point looked at.
    pub center: DVec3,
    /// The radius of the mesh's bounding sphere.
    pub radius: f64,
    /// View axes: x to the right, y up, z towards the viewer.
    pub world_from_view: DMat3,
    /// The tangent of half the vertical field of view.
    pub half_height: f64,
}

impl Eye {
    /// A point of the mesh from the eye: to the right, up, and ahead.
    pub fn view_from_world(&self, point: DVec3) -> DVec3 {
        let view = self.world_from_view.transpose() * (point - self.position);
        DVec3::new(view.x, view.y, -view.z)
    }
}
