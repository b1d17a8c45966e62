//! Viewpoint of a mesh: an orbit around its center, through a lens.

use chromascope_color::units::{bits, hash_by};
use chromascope_mesh::{Bounds, Mesh};
use glam::{DMat3, DVec3, Vec3};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Reason that numbers are not an orbit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum ViewpointError {
    #[error("yaw, pitch, distance and field of view must be finite numbers")]
    NotFinite,
    #[error("the distance must lie between 0.05 and 1000 scene radii")]
    Distance,
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
    frame: Option<Frame>,
}

/// A picture that the mesh is to fill.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Frame {
    aspect: f64,
    /// Distance over the one from which the mesh fills the picture.
    zoom: f64,
}

/// Share of the picture that the mesh fills.
const FILLED: f64 = 0.92;

hash_by!(Viewpoint, |of| {
    let frame = of.frame.map(|frame| [frame.aspect, frame.zoom].map(bits));
    ([of.yaw, of.pitch, of.distance, of.field_of_view].map(bits), frame)
});

impl Viewpoint {
    /// Takes yaw and pitch in radians, the distance in scene radii, and the vertical field of view in radians.
    ///
    /// Yaw is brought within half a turn; pitch is held within ±90°.
    ///
    /// # Errors
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
        Ok(Self { yaw, pitch: pitch.clamp(-FRAC_PI_2, FRAC_PI_2), distance, field_of_view, frame: None })
    }

    /// This view at the distance and in the place where the mesh fills a picture of the given width over height, times a factor on
    /// the distance; the distance in radii counts no more.
    ///
    /// # Errors
    /// [`ViewpointError`] where a number is not finite or out of range.
    pub fn framed(self, aspect: f64, zoom: f64) -> Result<Self, ViewpointError> {
        if !(aspect.is_finite() && zoom.is_finite()) {
            return Err(ViewpointError::NotFinite);
        }
        if !(1e-3..=1e3).contains(&zoom) || aspect <= 0.0 {
            return Err(ViewpointError::Distance);
        }
        Ok(Self { frame: Some(Frame { aspect, zoom }), ..self })
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

    /// The factor on the distance from which the mesh fills the picture, where the distance goes by that.
    pub fn zoom(&self) -> Option<f64> {
        self.frame.map(|frame| frame.zoom)
    }

    /// The vertical field of view, in radians.
    pub fn field_of_view(&self) -> f64 {
        self.field_of_view
    }

    /// The eye before a mesh: [`Self::eye`], moved where the mesh is to fill a picture.
    ///
    /// With X, Y, Z the mesh's points in view axes from its center and t = tan of half the angle that it is to fill, it is seen
    /// whole from the distance `max over both axes of (max(X + tZ) − min(X − tZ))/2t`, the eye at the middle of the two; where the
    /// lowest part is left out, so high that this stays below a picture that is higher than needed.
    pub fn eye_before(&self, mesh: &Mesh) -> Eye {
        let eye = self.eye(mesh.bounds());
        let Some(frame) = self.frame else { return eye };
        let t = [frame.aspect, 1.0].map(|across| FILLED * across * eye.half_height);
        let empty = [[f64::NEG_INFINITY; 2]; 2];
        let reach = |ends: [[f64; 2]; 2], p: &Vec3| {
            let view = eye.world_from_view.transpose() * (p.as_dvec3() - eye.center);
            std::array::from_fn(|axis| {
                let (at, ahead) = (view[axis], t[axis] * view.z);
                [ends[axis][0].max(at + ahead), ends[axis][1].max(ahead - at)]
            })
        };
        let wider =
            |a: [[f64; 2]; 2], b: [[f64; 2]; 2]| std::array::from_fn(|i| std::array::from_fn(|j| a[i][j].max(b[i][j])));
        let ends: [[f64; 2]; 2] = mesh.framed().fold(|| empty, reach).reduce(|| empty, wider);
        let whole = |axis: usize| (ends[axis][0] + ends[axis][1]) / (2.0 * t[axis]);
        let middle = |axis: usize| (ends[axis][0] - ends[axis][1]) / 2.0;
        let needed = whole(0).max(whole(1));
        let height = if mesh.is_cropped() { t[1] * needed - ends[1][1] } else { middle(1) };
        let place = DVec3::new(middle(0), height, (frame.zoom * needed).max(1e-3 * eye.radius));
        if !place.is_finite() {
            return eye;
        }
        Eye { position: eye.center + eye.world_from_view * place, ..eye }
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
