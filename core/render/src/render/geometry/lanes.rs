//! The angles of many samples side by side, so that the arithmetic runs in vectors.

use super::{Angles, mix};
use crate::reflectance::Geometry;
use chromascope_math::array::{array, each};
use glam::{DMat3, DVec3};
use multiversion::multiversion;

/// Samples that are worked on side by side.
pub(super) const LANES: usize = 64;

/// Below this cosine towards the viewer a normal is bent.
pub(super) const EDGE: f64 = 1e-3;

/// One number for each sample.
type Row<T> = [T; LANES];

/// Three coordinates for each sample, axis by axis.
type Rows<T> = [Row<T>; 3];

pub(super) struct Given {
    /// The sample's block in its band.
    pub(super) blocks: Row<usize>,
    /// x and y of the sample's ray, which goes one ahead.
    pub(super) rays: [Row<f64>; 2],
    /// The weights of the triangle's second and third corner.
    pub(super) weights: [Row<f32>; 2],
    pub(super) points: [Rows<f32>; 3],
    pub(super) normals: [Rows<f32>; 3],
    /// The unit vector towards the light.
    pub(super) to_light: Rows<f64>,
}

impl Given {
    pub(super) const NOTHING: Self = Self {
        blocks: [0; LANES],
        rays: [[0.0; LANES]; 2],
        weights: [[0.0; LANES]; 2],
        points: [[[0.0; LANES]; 3]; 3],
        normals: [[[0.0; LANES]; 3]; 3],
        to_light: [[0.0; LANES]; 3],
    };

    #[inline(always)]
    fn weights(&self, lane: usize) -> [f64; 3] {
        let [b, c] = [self.weights[0][lane], self.weights[1][lane]];
        each([1.0 - b - c, b, c], f64::from)
    }

    #[inline]
    pub(super) fn point(&self, lane: usize) -> DVec3 {
        mix(array(|k| at(&self.points[k], lane)), self.weights(lane))
    }
}

pub(super) struct Found {
    /// True if what follows holds; if not, the sample is one of the rare ones that need care.
    pub(super) plain: Row<bool>,
    pub(super) behind: Row<bool>,
    normals: Rows<f64>,
    angles: [Row<f32>; 7],
}

impl Found {
    pub(super) const NOTHING: Self =
        Self { plain: [false; LANES], behind: [false; LANES], normals: [[0.0; LANES]; 3], angles: [[0.0; LANES]; 7] };

    #[inline]
    pub(super) fn normal(&self, lane: usize) -> DVec3 {
        at(&self.normals, lane)
    }

    #[inline]
    pub(super) fn angles(&self, lane: usize) -> Angles {
        let [falloff, cos_i, cos_s, tan2, cos_half2, vx, vy] = array(|k| self.angles[k][lane]);
        Angles { falloff, cos_i, cos_s, tan2, cos_half2, vx, vy }
    }
}

/// Finds the angles of all samples. Compiled for several instruction sets, the best chosen at run time; no operation is
/// fused, so all of them give the same bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
pub(super) fn find(given: &Given, world_from_view: &DMat3, found: &mut Found) {
    find_portable(given, world_from_view, found);
}

/// Portable form for any processor.
#[inline(always)]
fn find_portable(given: &Given, world_from_view: &DMat3, found: &mut Found) {
    for lane in 0..LANES {
        let ray = DVec3::new(given.rays[0][lane], given.rays[1][lane], 1.0);
        let ahead = ray.normalize();
        let to_viewer = -(*world_from_view * DVec3::new(ahead.x, ahead.y, -ahead.z));
        let to_light = at(&given.to_light, lane);
        let [a, b, c]: [DVec3; 3] = array(|k| at(&given.points[k], lane));
        let flat = (b - a).cross(c - a);
        let mixed = mix(array(|k| at(&given.normals[k], lane)), given.weights(lane));
        let shrink = mixed.length_recip();
        // The side that is seen: by the triangle itself, for its corners' normals may lie on either side of the view.
        let facing = flat.dot(to_viewer);
        let behind = if flat.dot(mixed) < 0.0 { facing > 0.0 } else { facing < 0.0 };
        let upright = mixed * shrink;
        let normal = if behind { -upright } else { upright };
        let (geometry, plain) = Geometry::from_directions_branchless(to_light, to_viewer, normal);
        found.plain[lane] = plain && shrink > 0.0 && shrink.is_finite() && geometry.cos_s >= EDGE;
        found.behind[lane] = behind;
        put(&mut found.normals, lane, normal);
        let angles = super::angles(&geometry, ahead.z);
        let Angles { falloff, cos_i, cos_s, tan2, cos_half2, vx, vy } = angles;
        let numbers = [falloff, cos_i, cos_s, tan2, cos_half2, vx, vy];
        for k in 0..numbers.len() {
            found.angles[k][lane] = numbers[k];
        }
    }
}

#[inline(always)]
fn at<T: Copy + Into<f64>>(rows: &Rows<T>, lane: usize) -> DVec3 {
    DVec3::new(rows[0][lane].into(), rows[1][lane].into(), rows[2][lane].into())
}

#[inline(always)]
fn put(rows: &mut Rows<f64>, lane: usize, v: DVec3) {
    (rows[0][lane], rows[1][lane], rows[2][lane]) = (v.x, v.y, v.z);
}

#[cfg(test)]
mod tests {
    use super::*;
    use chromascope_math::random::SplitMix64;

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let (mut given, mut random) = (Given::NOTHING, SplitMix64::new(1));
        let mut number = || 2.0 * random.unit() - 1.0;
        for lane in 0..LANES {
            (given.rays[0][lane], given.rays[1][lane]) = (number(), number());
            given.weights.iter_mut().for_each(|row| row[lane] = 0.01 * lane as f32);
            put(&mut given.to_light, lane, DVec3::new(number(), number(), number()).normalize());
        }
        for value in given.points.as_flattened_mut().iter_mut().chain(given.normals.as_flattened_mut()).flatten() {
            *value = number() as f32;
        }
        // Some that need care: no normal, no light.
        given.normals.iter_mut().flatten().for_each(|row| row[7] = 0.0);
        put(&mut given.to_light, 9, DVec3::NAN);
        let view = DMat3::from_rotation_y(0.3);
        let (mut chosen, mut portable) = (Found::NOTHING, Found::NOTHING);
        find(&given, &view, &mut chosen);
        find_portable(&given, &view, &mut portable);
        assert_eq!((chosen.plain, chosen.behind), (portable.plain, portable.behind));
        assert!(!chosen.plain[7] && !chosen.plain[9]);
        let plain: Vec<usize> = (0..LANES).filter(|&lane| chosen.plain[lane]).collect();
        assert!(plain.len() > 10, "{} are plain", plain.len());
        for lane in plain {
            assert_eq!(chosen.angles(lane), portable.angles(lane));
            assert_eq!(chosen.normal(lane), portable.normal(lane));
        }
    }
}
