//! Position of the light: far away in a direction, or at a point.

use super::viewpoint::Eye;
use chromascope_color::units::{bits, hash_by};
use glam::DVec3;

/// The Sun's angular radius in radians.
pub const SUN_RADIUS: f64 = 4.65e-3;

/// Reason that a light has no position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum LightingError {
    #[error("the light's coordinates must be finite numbers")]
    NotFinite,
    #[error("the light's direction must not be zero")]
    NoDirection,
    #[error("the light's angular radius must lie between 0 and 0.5 rad")]
    AngularRadius,
}

/// Distance of the light: infinite or finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Distance {
    /// Parallel rays from a direction.
    Far,
    /// From a point, its place counted from the mesh's center in scene radii. Without the inverse square.
    Near,
}

/// A light's place in view axes (x to the right, y up, z towards the viewer), so that it goes along when the eye orbits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lighting {
    distance: Distance,
    place: DVec3,
    angular_radius: f64,
}

hash_by!(Lighting, |of| (of.distance, of.place.to_array().map(bits), bits(of.angular_radius)));

impl Lighting {
    /// A light far away in a direction, its disk of an angular radius in radians.
    ///
    /// # Errors
    /// [`LightingError`] where the direction has no length or the angular radius is out of range.
    pub fn far(direction: DVec3, angular_radius: f64) -> Result<Self, LightingError> {
        Self::new(Distance::Far, direction, angular_radius)
    }

    /// A light at a place counted from the mesh's center in scene radii.
    ///
    /// # Errors
    /// [`LightingError`] where the position is not finite or the angular radius is out of range.
    pub fn near(place: DVec3, angular_radius: f64) -> Result<Self, LightingError> {
        Self::new(Distance::Near, place, angular_radius)
    }

    fn new(distance: Distance, place: DVec3, angular_radius: f64) -> Result<Self, LightingError> {
        if !place.is_finite() || !angular_radius.is_finite() {
            return Err(LightingError::NotFinite);
        }
        if !(0.0..=0.5).contains(&angular_radius) {
            return Err(LightingError::AngularRadius);
        }
        match (distance, unit(place)) {
            (Distance::Far, None) => Err(LightingError::NoDirection),
            (Distance::Far, Some(place)) => Ok(Self { distance, place, angular_radius }),
            (Distance::Near, _) => Ok(Self { distance, place, angular_radius }),
        }
    }

    /// A light far away, by its angles from the view axis: up, and to the right (negative: left), in radians.
    ///
    /// # Errors
    /// [`LightingError`] where an angle is not finite or out of range.
    pub fn from_angles(up: f64, right: f64, angular_radius: f64) -> Result<Self, LightingError> {
        let direction = DVec3::new(right.sin() * up.cos(), up.sin(), right.cos() * up.cos());
        Self::far(direction, angular_radius)
    }

    /// Far or near.
    pub fn distance(&self) -> Distance {
        self.distance
    }

    /// The direction (of unit length) or the place, in view axes.
    pub fn place(&self) -> DVec3 {
        self.place
    }

    /// The angular radius of its disk in radians.
    pub fn angular_radius(&self) -> f64 {
        self.angular_radius
    }

    /// The light in the mesh's coordinates.
    pub fn before(&self, eye: &Eye) -> PlacedLight {
        let turned = eye.world_from_view * self.place;
        match self.distance {
            Distance::Far => PlacedLight::Direction(turned),
            Distance::Near => PlacedLight::Point(eye.center + turned * eye.radius),
        }
    }
}

fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    // Beyond these its squares leave the range of a double.
    if (1e-140..1e140).contains(&largest) { v.try_normalize() } else { (v / largest).try_normalize() }
}

/// A light in the mesh's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlacedLight {
    /// The unit vector towards it.
    Direction(DVec3),
    /// Position.
    Point(DVec3),
}

impl PlacedLight {
    /// The unit vector from a point towards the light, and how far that is; none at the light itself.
    pub fn seen_from(self, point: DVec3) -> Option<(DVec3, f64)> {
        match self {
            Self::Direction(direction) => Some((direction, f64::INFINITY)),
            Self::Point(place) => {
                let transform = place - point;
                let (direction, length) = (unit(transform)?, transform.length());
                // The squares of the nearest and furthest leave the range of a double, their product with the direction does not.
                Some((direction, if length.is_normal() { length } else { transform.dot(direction) }))
            }
        }
    }
}
