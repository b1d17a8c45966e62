//! The angles of light and view at every sample that the light reaches.

mod lanes;

use self::lanes::{EDGE, Found, Given, LANES};
use super::stop::Stop;
use super::visibility::{Hit, RasterSize, Rays, Visibility};
use crate::reflectance::Geometry;
use crate::scene::{Lighting, PlacedLight};
use chromascope_mesh::Mesh;
use chromascope_mesh::ShadowTree;
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::sync::Arc;

/// The side of the block of samples that share a coarse shadow ray.
const BLOCK: usize = 4;

/// Samples that one task works on.
const CHUNK: usize = 8192;

/// Fineness of shadows, if any are traced.
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

/// Reason that samples are dark, and how many.
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

/// Positions of a picture's lit samples: all that a camera's signals need of geometry.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LitSamples {
    size: RasterSize,
    samples: Vec<u32>,
    seen: Vec<u32>,
}

impl LitSamples {
    /// Positions of samples, both lists ascending.
    pub(super) fn new(size: RasterSize, samples: Vec<u32>, seen: Vec<u32>) -> Self {
        Self { size, samples, seen }
    }

    /// The picture's size.
    pub fn size(&self) -> RasterSize {
        self.size
    }

    /// The places of the lit samples, ascending, row by row from the top left.
    pub fn samples(&self) -> &[u32] {
        &self.samples
    }

    /// The places of all samples that see a triangle, ascending.
    pub fn seen(&self) -> &[u32] {
        &self.seen
    }
}

/// The angles at the lit samples of a picture. No spectrum, no roughness, no camera is in it.
#[derive(Clone, Debug)]
pub struct GeometryImage {
    placed: Arc<LitSamples>,
    angles: Vec<Angles>,
    angular_radius: f64,
    counts: GeometryCounts,
}

impl Angles {
    /// `cos θi cos⁴α`: what Eq 12 has beside the reflectance factor.
    pub fn light(&self) -> f64 {
        f64::from(self.falloff) * f64::from(self.cos_i)
    }

    /// Angles in the reflectance model's terms.
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
        let (mut samples, mut angles, mut seen) = (Vec::new(), Vec::new(), Vec::new());
        samples.reserve(bands.iter().map(|part| part.samples.len()).sum());
        angles.reserve(bands.iter().map(|part| part.angles.len()).sum());
        seen.reserve(bands.iter().map(|part| part.seen.len()).sum());
        let mut counts = GeometryCounts::default();
        for part in bands {
            samples.extend(part.samples);
            angles.extend(part.angles);
            seen.extend(part.seen);
            counts = counts.plus(part.counts);
        }
        let placed = Arc::new(LitSamples { size, samples, seen });
        Some(Self { placed, angles, angular_radius: lighting.angular_radius(), counts })
    }

    /// Positions of the samples.
    pub fn placed(&self) -> &Arc<LitSamples> {
        &self.placed
    }

    /// The places of the lit samples, ascending, row by row from the top left.
    pub fn samples(&self) -> &[u32] {
        self.placed.samples()
    }

    /// The angles at the lit samples.
    pub fn angles(&self) -> &[Angles] {
        &self.angles
    }

    /// The light's angular radius in radians.
    pub fn angular_radius(&self) -> f64 {
        self.angular_radius
    }

    /// Reason that samples are dark, and how many.
    pub fn counts(&self) -> GeometryCounts {
        self.counts
    }

    /// Picture with each `stride`-th of its lit samples only: to measure on.
    #[must_use]
    pub fn thinned(&self, stride: usize) -> Self {
        let stride = stride.max(1);
        let samples: Vec<u32> = self.samples().iter().copied().step_by(stride).collect();
        let angles = self.angles.iter().copied().step_by(stride).collect();
        let counts = GeometryCounts { lit: samples.len() as u64, ..self.counts };
        let placed = Arc::new(LitSamples { size: self.placed.size, samples, seen: self.placed.seen.clone() });
        Self { placed, angles, counts, ..*self }
    }

    /// Number of samples of a list one task works on.
    pub fn chunk() -> usize {
        CHUNK
    }
}

/// Result of one task.
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
    hit: Hit,
    /// True if the triangle is seen from behind.
    behind: bool,
}

/// True if each block of a band of rows is in shadow, once known.
type Blocks = Vec<Option<bool>>;

impl Scene<'_> {
    fn part(&self, start: usize, count: usize) -> Part {
        let hits = self.visibility.hits();
        let end = (start + count).min(hits.len());
        let mut part = Part::default();
        part.seen.extend((start..end).filter(|&sample| hits[sample].is_some()).map(|sample| sample as u32));
        part.counts.seen = part.seen.len() as u64;
        part.samples.reserve(part.seen.len());
        part.angles.reserve(part.seen.len());
        let mut blocks = vec![None; self.visibility.size().columns().div_ceil(BLOCK)];
        let (mut given, mut found) = (Given::NOTHING, Found::NOTHING);
        for run in 0..part.seen.len().div_ceil(LANES) {
            let run = run * LANES..part.seen.len().min((run + 1) * LANES);
            self.gather(&part.seen[run.clone()], &mut given);
            lanes::find(&given, &self.visibility.eye().world_from_view, &mut found);
            for (lane, at) in run.enumerate() {
                self.take(part.seen[at], lane, &given, &found, &mut blocks, &mut part);
            }
        }
        part
    }

    /// Brings together what the angles of some samples are made of.
    fn gather(&self, samples: &[u32], given: &mut Given) {
        let (hits, triangles) = (self.visibility.hits(), self.mesh.triangles());
        let (positions, normals) = (self.mesh.positions(), self.mesh.normals());
        let columns = self.visibility.size().columns() as u32;
        for (lane, &sample) in samples.iter().enumerate().take(LANES) {
            let hit = hits[sample as usize];
            // Divided once: that is slow.
            let (row, column) = (sample / columns, sample % columns);
            given.columns[lane] = column;
            given.rays[0][lane] = self.rays.x(column as usize);
            given.rays[1][lane] = self.rays.y(row as usize);
            given.weights[0][lane] = hit.weights[0];
            given.weights[1][lane] = hit.weights[1];
            for (corner, vertex) in triangles[hit.triangle as usize].into_iter().enumerate() {
                let (point, normal) = (positions[vertex as usize], normals[vertex as usize]);
                for (axis, (v, n)) in point.to_array().into_iter().zip(normal.to_array()).enumerate() {
                    given.points[corner][axis][lane] = v;
                    given.normals[corner][axis][lane] = n;
                }
            }
        }
        for lane in 0..samples.len().min(LANES) {
            // Where the light stands on the surface there is none.
            let (to_light, _) = self.light.seen_from(given.point(lane)).unwrap_or((DVec3::NAN, 0.0));
            for (row, v) in given.to_light.iter_mut().zip(to_light.to_array()) {
                row[lane] = v;
            }
        }
    }

    /// Adds a sample to those that the light reaches, or counts why it does not.
    fn take(&self, sample: u32, lane: usize, given: &Given, found: &Found, blocks: &mut Blocks, part: &mut Part) {
        let hit = self.visibility.hits()[sample as usize];
        let lit = if found.plain[lane] {
            found.lit[lane].then(|| {
                let place =
                    Place { point: given.point(lane), normal: found.normal(lane), hit, behind: found.behind[lane] };
                (place, found.angles(lane))
            })
        } else {
            self.checked_angles(sample as usize, hit)
        };
        let Some((place, angles)) = lit else {
            part.counts.facing_away += 1;
            return;
        };
        let block = &mut blocks[given.columns[lane] as usize / BLOCK];
        if self.is_shadowed(&place, block, &mut part.counts.rays) {
            part.counts.shadowed += 1;
            return;
        }
        part.counts.lit += 1;
        part.samples.push(sample);
        part.angles.push(angles);
    }

    /// The angles at a sample of any kind, unless its surface is turned away from the light.
    fn checked_angles(&self, sample: usize, hit: Hit) -> Option<(Place, Angles)> {
        let ahead = self.rays.at(sample).normalize();
        let to_viewer = -(self.visibility.eye().world_from_view * DVec3::new(ahead.x, ahead.y, -ahead.z));
        let place = self.place(hit, to_viewer);
        let (to_light, _) = self.light.seen_from(place.point)?;
        let geometry = Geometry::from_directions(to_light, to_viewer, place.normal);
        geometry.is_lit().then(|| (place, angles(&geometry, ahead.z)))
    }

    fn place(&self, hit: Hit, to_viewer: DVec3) -> Place {
        let weights = hit.barycentric().map(f64::from);
        let (points, normals) = self.corners(hit);
        let flat = (points[1] - points[0]).cross(points[2] - points[0]);
        let mixed = mix(normals, weights);
        // The side that is seen: by the triangle itself, for its corners' normals may lie on either side of the view.
        let outward = if flat.dot(mixed) < 0.0 { -flat } else { flat };
        let normal = mixed.try_normalize().or_else(|| outward.try_normalize()).unwrap_or(to_viewer);
        let behind = outward.dot(to_viewer) < 0.0;
        let normal = turned_to(if behind { -normal } else { normal }, to_viewer);
        Place { point: mix(points, weights), normal, hit, behind }
    }

    /// Places and normals of a triangle's corners.
    fn corners(&self, hit: Hit) -> ([DVec3; 3], [DVec3; 3]) {
        let corners = self.mesh.triangles()[hit.triangle as usize];
        let of = |all: &[Vec3]| corners.map(|i| all[i as usize].as_dvec3());
        (of(self.mesh.positions()), of(self.mesh.normals()))
    }

    /// Origin of a shadow ray: on the surface that the corners' normals suggest, a little above it.
    fn lifted(&self, place: &Place) -> DVec3 {
        let (points, normals) = self.corners(place.hit);
        let lifts = [0, 1, 2].map(|k: usize| {
            let normal = if place.behind { -normals[k] } else { normals[k] };
            normal * (points[k] - place.point).dot(normal).max(0.0)
        });
        // A hundred-thousandth of the scene above the surface: single precision does not see it on it.
        let above = place.normal * (self.visibility.eye().radius * 1e-5);
        place.point + mix(lifts, place.hit.barycentric().map(f64::from)) + above
    }

    fn is_shadowed(&self, place: &Place, block: &mut Option<bool>, rays: &mut u64) -> bool {
        let Some((tree, shadows)) = self.shadows else { return false };
        let mut trace = || {
            *rays += 1;
            let way = self.light.seen_from(place.point);
            way.is_some_and(|(to_light, distance)| tree.is_blocked(self.lifted(place), to_light, distance))
        };
        match shadows {
            Shadows::Off => false,
            Shadows::Full => trace(),
            Shadows::Coarse => *block.get_or_insert_with(trace),
        }
    }
}

#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
fn mix(v: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    v[0] * weights[0] + v[1] * weights[1] + v[2] * weights[2]
}

/// A normal, bent until it is edge-on where it points away from the viewer.
fn turned_to(normal: DVec3, to_viewer: DVec3) -> DVec3 {
    let cos = normal.dot(to_viewer);
    if cos >= EDGE {
        return normal;
    }
    let bent = normal + to_viewer * (EDGE - cos);
    bent.try_normalize().unwrap_or(to_viewer)
}

#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
fn angles(geometry: &Geometry, cos_alpha: f64) -> Angles {
    let vz2 = geometry.vz_by_k * geometry.vz_by_k;
    Angles {
        falloff: (cos_alpha * cos_alpha * cos_alpha * cos_alpha) as f32,
        cos_i: geometry.cos_i as f32,
        cos_s: geometry.cos_s as f32,
        tan2: (geometry.vxy2_by_k2 / vz2).min(f64::from(f32::MAX)) as f32,
        cos_half2: geometry.cos_half2 as f32,
        vx: geometry.vx_by_k as f32,
        vy: geometry.vy_by_k as f32,
    }
}
