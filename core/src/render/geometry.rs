//! The angles of light and view at every sample that the light reaches.

use super::Stop;
use super::shadow::ShadowTree;
use super::visibility::{Hit, RasterSize, Rays, Visibility};
use crate::reflectance::Geometry;
use crate::scene::{Lighting, Mesh, PlacedLight};
use glam::DVec3;
use rayon::prelude::*;

/// The side of the block of samples that share a coarse shadow ray.
const BLOCK: usize = 4;

/// Samples that one task works on.
const CHUNK: usize = 8192;

/// Whether and how finely shadows are traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Shadows {
    /// None: light passes through everything.
    Off,
    /// One ray for each 4 × 4 samples: while something moves.
    Coarse,
    /// One ray a sample.
    #[default]
    Full,
}

/// Why samples are dark, and how many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GeometryCounts {
    /// Samples that see a triangle.
    pub seen: u64,
    /// Those that the light reaches.
    pub lit: u64,
    /// Those turned away from the light.
    pub facing_away: u64,
    /// Those in shadow.
    pub shadowed: u64,
    /// Shadow rays that were traced.
    pub rays: u64,
}

impl GeometryCounts {
    fn plus(self, other: Self) -> Self {
        Self {
            seen: self.seen + other.seen,
            lit: self.lit + other.lit,
            facing_away: self.facing_away + other.facing_away,
            shadowed: self.shadowed + other.shadowed,
            rays: self.rays + other.rays,
        }
    }
}

/// The angles at one lit sample: all that the reflectance model needs to know of shape, light and view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angles {
    /// cos⁴ α: the lens's falloff (Eq 12).
    pub falloff: f32,
    /// cos θi.
    pub cos_i: f32,
    /// cos θs.
    pub cos_s: f32,
    /// |h × n|² / (h·n)² with h = l + v: tan² of the angle between the half vector and the normal.
    pub tan2: f32,
    /// (l·h)² with h of unit length.
    pub cos_half2: f32,
    /// `v_x / k`: along the plane of incidence.
    pub vx: f32,
    /// `v_y / k`: across it.
    pub vy: f32,
}

/// The angles at the lit samples of a picture. No spectrum, no roughness, no camera is in it.
#[derive(Clone, Debug)]
pub struct GeometryImage {
    size: RasterSize,
    /// For each row its first lit sample's place in the lists.
    samples: Vec<u32>,
    angles: Vec<Angles>,
    seen: Vec<u32>,
    angular_radius: f64,
    counts: GeometryCounts,
}

impl Angles {
    /// `cos θi cos⁴α`: what Eq 12 has beside the reflectance factor.
    pub fn light(&self) -> f64 {
        f64::from(self.falloff) * f64::from(self.cos_i)
    }

    /// The same in the reflectance model's terms.
    pub fn geometry(&self) -> Geometry {
        let (cos_i, cos_s) = (f64::from(self.cos_i), f64::from(self.cos_s));
        let vz_by_k = cos_i + cos_s;
        Geometry {
            cos_i,
            cos_s,
            vx_by_k: f64::from(self.vx),
            vy_by_k: f64::from(self.vy),
            vxy2_by_k2: f64::from(self.tan2) * vz_by_k * vz_by_k,
            vz_by_k,
            cos_half2: f64::from(self.cos_half2),
        }
    }
}

impl GeometryImage {
    /// Finds the angles wherever the light reaches what is seen; none if stopped.
    ///
    /// Normals are interpolated between vertices, turned towards the viewer where a sheet is seen from behind, and bent until
    /// edge-on where interpolation turned them away. Shadow rays start from the surface that the interpolated normals
    /// suggest (Hanika 2021), so that facets do not shadow themselves.
    pub fn new(
        mesh: &Mesh,
        visibility: &Visibility,
        lighting: &Lighting,
        shadows: Option<(&ShadowTree, Shadows)>,
        stop: &Stop,
    ) -> Option<Self> {
        let size = visibility.size();
        let light = lighting.before(visibility.eye());
        let scene = Scene { mesh, visibility, rays: visibility.rays(), light, shadows };
        // Rows whose samples share shadow rays together.
        let band = BLOCK * size.columns();
        let bands: Vec<Part> = (0..visibility.hits().len().div_ceil(band))
            .into_par_iter()
            .map(|index| if stop.is_set() { Part::default() } else { scene.part(index * band, band) })
            .collect();
        if stop.is_set() {
            return None;
        }
        let mut image = Self {
            size,
            samples: Vec::with_capacity(bands.iter().map(|part| part.samples.len()).sum()),
            angles: Vec::with_capacity(bands.iter().map(|part| part.angles.len()).sum()),
            seen: Vec::with_capacity(bands.iter().map(|part| part.seen.len()).sum()),
            angular_radius: lighting.angular_radius(),
            counts: GeometryCounts::default(),
        };
        for part in bands {
            image.samples.extend(part.samples);
            image.angles.extend(part.angles);
            image.seen.extend(part.seen);
            image.counts = image.counts.plus(part.counts);
        }
        Some(image)
    }

    /// The picture's size.
    pub fn size(&self) -> RasterSize {
        self.size
    }

    /// The places of the lit samples, ascending, row by row from the top left.
    pub fn samples(&self) -> &[u32] {
        &self.samples
    }

    /// The angles at the lit samples.
    pub fn angles(&self) -> &[Angles] {
        &self.angles
    }

    /// The places of all samples that see a triangle, ascending.
    pub fn seen(&self) -> &[u32] {
        &self.seen
    }

    /// The light's angular radius in radians.
    pub fn angular_radius(&self) -> f64 {
        self.angular_radius
    }

    /// Why samples are dark, and how many.
    pub fn counts(&self) -> GeometryCounts {
        self.counts
    }

    /// The same picture with each `stride`-th of its lit samples only: to measure on.
    #[must_use]
    pub fn thinned(&self, stride: usize) -> Self {
        let stride = stride.max(1);
        let samples: Vec<u32> = self.samples.iter().copied().step_by(stride).collect();
        let angles = self.angles.iter().copied().step_by(stride).collect();
        let counts = GeometryCounts { lit: samples.len() as u64, ..self.counts };
        Self { samples, angles, seen: self.seen.clone(), counts, ..*self }
    }

    /// How many tasks a list of lit samples is worked on by.
    pub fn chunk() -> usize {
        CHUNK
    }
}

/// What one task found.
#[derive(Default)]
struct Part {
    samples: Vec<u32>,
    angles: Vec<Angles>,
    seen: Vec<u32>,
    counts: GeometryCounts,
}

struct Scene<'a> {
    mesh: &'a Mesh,
    visibility: &'a Visibility,
    rays: Rays,
    light: PlacedLight,
    shadows: Option<(&'a ShadowTree, Shadows)>,
}

/// A place on the mesh with its normal.
struct Place {
    point: DVec3,
    normal: DVec3,
    corners: [u32; 3],
    weights: [f64; 3],
    /// Whether the triangle is seen from behind.
    behind: bool,
}

impl Scene<'_> {
    fn part(&self, start: usize, count: usize) -> Part {
        let hits = self.visibility.hits();
        let columns = self.visibility.size().columns();
        let mut part = Part::default();
        // Whether a block of samples is in shadow, once known.
        let mut blocks: Vec<Option<bool>> = vec![None; columns.div_ceil(BLOCK)];
        for (sample, hit) in hits.iter().enumerate().take((start + count).min(hits.len())).skip(start) {
            if !hit.is_some() {
                continue;
            }
            part.seen.push(sample as u32);
            part.counts.seen += 1;
            let Some((place, to_light, distance, angles)) = self.angles(sample, *hit) else {
                part.counts.facing_away += 1;
                continue;
            };
            let block = &mut blocks[sample % columns / BLOCK];
            if self.is_shadowed(&place, to_light, distance, block, &mut part.counts.rays) {
                part.counts.shadowed += 1;
                continue;
            }
            part.counts.lit += 1;
            part.samples.push(sample as u32);
            part.angles.push(angles);
        }
        part
    }

    /// The angles at a sample, unless its surface is turned away from the light.
    fn angles(&self, sample: usize, hit: Hit) -> Option<(Place, DVec3, f64, Angles)> {
        let ray = self.rays.at(sample);
        let eye = self.visibility.eye();
        let ahead = ray.normalize();
        let to_viewer = -(eye.world_from_view * DVec3::new(ahead.x, ahead.y, -ahead.z));
        let place = self.place(hit, to_viewer);
        let (to_light, distance) = self.light.seen_from(place.point)?;
        let angles = angles(to_light, to_viewer, place.normal, ahead.z)?;
        Some((place, to_light, distance, angles))
    }

    fn place(&self, hit: Hit, to_viewer: DVec3) -> Place {
        let corners = self.mesh.triangles()[hit.triangle as usize];
        let weights = hit.barycentric().map(f64::from);
        let points = self.points(corners);
        let flat = (points[1] - points[0]).cross(points[2] - points[0]);
        let mixed = mix(self.normals(corners), weights);
        // The side that is seen: by the triangle itself, for its corners' normals may lie on either side of the view.
        let outward = if flat.dot(mixed) < 0.0 { -flat } else { flat };
        let normal = mixed.try_normalize().or_else(|| outward.try_normalize()).unwrap_or(to_viewer);
        let behind = outward.dot(to_viewer) < 0.0;
        let normal = turned_to(if behind { -normal } else { normal }, to_viewer);
        Place { point: mix(points, weights), normal, corners, weights, behind }
    }

    fn points(&self, corners: [u32; 3]) -> [DVec3; 3] {
        corners.map(|i| self.mesh.positions()[i as usize].as_dvec3())
    }

    fn normals(&self, corners: [u32; 3]) -> [DVec3; 3] {
        corners.map(|i| self.mesh.normals()[i as usize].as_dvec3())
    }

    /// Where a shadow ray starts: on the surface that the corners' normals suggest, a little above it.
    fn lifted(&self, place: &Place) -> DVec3 {
        let (points, normals) = (self.points(place.corners), self.normals(place.corners));
        let lifts = [0, 1, 2].map(|k: usize| {
            let normal = if place.behind { -normals[k] } else { normals[k] };
            normal * (points[k] - place.point).dot(normal).max(0.0)
        });
        // A hundred-thousandth of the scene above the surface: single precision does not see it on it.
        place.point + mix(lifts, place.weights) + place.normal * (self.visibility.eye().radius * 1e-5)
    }

    fn is_shadowed(
        &self,
        place: &Place,
        to_light: DVec3,
        distance: f64,
        block: &mut Option<bool>,
        rays: &mut u64,
    ) -> bool {
        let Some((tree, shadows)) = self.shadows else { return false };
        let mut trace = || {
            *rays += 1;
            tree.is_blocked(self.lifted(place), to_light, distance)
        };
        match shadows {
            Shadows::Off => false,
            Shadows::Full => trace(),
            Shadows::Coarse => *block.get_or_insert_with(trace),
        }
    }
}

fn mix(v: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    v[0] * weights[0] + v[1] * weights[1] + v[2] * weights[2]
}

/// A normal, bent until it is edge-on where it points away from the viewer.
fn turned_to(normal: DVec3, to_viewer: DVec3) -> DVec3 {
    const EDGE: f64 = 1e-3;
    let cos = normal.dot(to_viewer);
    if cos >= EDGE {
        return normal;
    }
    let bent = normal + to_viewer * (EDGE - cos);
    bent.try_normalize().unwrap_or(to_viewer)
}

/// The angles between light, viewer and normal, all of unit length; none where the light is behind the surface.
fn angles(to_light: DVec3, to_viewer: DVec3, normal: DVec3, cos_alpha: f64) -> Option<Angles> {
    let geometry = Geometry::from_directions(to_light, to_viewer, normal);
    if !geometry.is_lit() {
        return None;
    }
    let vz2 = geometry.vz_by_k * geometry.vz_by_k;
    Some(Angles {
        falloff: (cos_alpha * cos_alpha * cos_alpha * cos_alpha) as f32,
        cos_i: geometry.cos_i as f32,
        cos_s: geometry.cos_s as f32,
        tan2: (geometry.vxy2_by_k2 / vz2).min(f64::from(f32::MAX)) as f32,
        cos_half2: geometry.cos_half2 as f32,
        vx: geometry.vx_by_k as f32,
        vy: geometry.vy_by_k as f32,
    })
}
