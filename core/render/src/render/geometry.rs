//! The angles of light and view at every sample that the light reaches.

mod lanes;

use self::lanes::{EDGE, Found, Given, LANES};
use super::stop::Stop;
use super::visibility::{Hit, RasterSize, Rays, Visibility};
use crate::reflectance::Geometry;
use crate::scene::{Lighting, PlacedLight};
use chromascope_math::array::each;
use chromascope_mesh::{Mesh, Part, ShadowTree};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;

/// The side of the block of samples that share coarse shadow rays.
const BLOCK: usize = 4;

/// Rows of blocks that one task works on, which share their corners' rays.
const ROWS: usize = 4;

/// Samples that one task works on.
const CHUNK: usize = 8192;

/// Steps from one point of the light's disk to the next sample's, without a factor in common with any number of samples.
const DISK_STEP: u32 = 11;

/// Share of a turn from one point of the light's disk to the next.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Distance within which a ray that leaves a surface backward does not end, in scene radii: the thickness of a leaf.
pub const THIN: f64 = 4e-3;

/// Fineness of shadows, if any are traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Shadows {
    /// None: light passes through everything.
    Off,
    /// One ray for each corner of 4 × 4 samples, and for each sample where these differ: while something moves.
    Coarse,
    /// One ray a sample.
    #[default]
    Full,
}

/// Samples that are listed beside those that the light reaches from before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Reach {
    /// All that see the mesh: a sky lights them.
    pub everywhere: bool,
    /// Those that the light reaches from behind, through a leaf.
    pub through: bool,
}

/// Reason that samples are dark, and how many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GeometryCounts {
    /// Samples that see a triangle.
    pub seen: u64,
    /// Those that the light reaches from before.
    pub lit: u64,
    /// Those that it reaches from behind.
    pub through: u64,
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
            through: self.through + other.through,
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
    /// cos θi; 0 where the light does not reach the sample, negative where it does from behind.
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
    parts: Vec<Part>,
}

impl LitSamples {
    /// Positions of samples, both lists ascending.
    pub(super) fn new(size: RasterSize, samples: Vec<u32>, seen: Vec<u32>) -> Self {
        Self { size, samples, seen, parts: Vec::new() }
    }

    /// The picture's size.
    pub fn size(&self) -> RasterSize {
        self.size
    }

    /// The places of the lit samples, ascending, row by row from the top left.
    pub fn samples(&self) -> &[u32] {
        &self.samples
    }

    /// The part of the mesh that each lit sample sees; empty where all see the body.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The part of the mesh that a lit sample sees, by its index.
    pub fn part(&self, index: usize) -> Part {
        self.parts.get(index).copied().unwrap_or_default()
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
    reach: Reach,
    counts: GeometryCounts,
}

impl Angles {
    /// `cos θi cos⁴α`: what Eq 12 has beside the reflectance factor; 0 where no light comes from before.
    pub fn light(&self) -> f64 {
        f64::from(self.falloff) * f64::from(self.cos_i.max(0.0))
    }

    /// `|cos θi| cos⁴α` of light from behind.
    pub fn light_behind(&self) -> f64 {
        f64::from(self.falloff) * f64::from((-self.cos_i).max(0.0))
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
        Self::within(mesh, visibility, lighting, shadows, Reach::default(), stop)
    }

    /// [`Self::new`] with further samples listed.
    pub fn within(
        mesh: &Mesh,
        visibility: &Visibility,
        lighting: &Lighting,
        shadows: Option<(&ShadowTree, Shadows)>,
        reach: Reach,
        stop: &Stop,
    ) -> Option<Self> {
        let size = visibility.size();
        let light = lighting.before(visibility.eye());
        let disk = lighting.angular_radius();
        let scene = Scene { mesh, visibility, rays: visibility.rays(), light, disk, shadows, reach };
        // Rows whose samples share shadow rays together.
        let band = ROWS * BLOCK * size.columns();
        let bands: Vec<Band> = (0..visibility.hits().len().div_ceil(band))
            .into_par_iter()
            .map(|index| if stop.is_set() { Band::default() } else { scene.part(index * band, band) })
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
        let part = |&sample: &u32| {
            let Hit { triangle, weights } = visibility.hits()[sample as usize];
            mesh.part_at(triangle, weights)
        };
        let parts = if mesh.parts().is_empty() { Vec::new() } else { samples.iter().map(part).collect() };
        let placed = Arc::new(LitSamples { size, samples, seen, parts });
        Some(Self { placed, angles, angular_radius: disk, reach, counts })
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

    /// Samples that are listed beside those that the light reaches from before.
    pub fn reach(&self) -> Reach {
        self.reach
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
        let parts = self.placed.parts.iter().copied().step_by(stride).collect();
        let placed = Arc::new(LitSamples { size: self.placed.size, samples, seen: self.placed.seen.clone(), parts });
        Self { placed, angles, counts, ..*self }
    }

    /// Number of samples of a list one task works on.
    pub fn chunk() -> usize {
        CHUNK
    }
}

#[derive(Default)]
struct Band {
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
    /// Angular radius of the light in radians.
    disk: f64,
    shadows: Option<(&'a ShadowTree, Shadows)>,
    reach: Reach,
}

/// A place on the mesh with its normal.
pub(super) struct SeenPlace {
    pub(super) point: DVec3,
    /// Towards the viewer.
    pub(super) normal: DVec3,
    hit: Hit,
    /// True if the triangle is seen from behind.
    pub(super) behind: bool,
}

impl SeenPlace {
    /// The place where a hit is, its normal bent until edge-on where it points away from the viewer.
    pub(super) fn new(mesh: &Mesh, hit: Hit, to_viewer: DVec3) -> Self {
        let weights = hit.barycentric().map(f64::from);
        let (points, normals) = corners(mesh, hit);
        let flat = (points[1] - points[0]).cross(points[2] - points[0]);
        let mixed = mix(normals, weights);
        // The side that is seen: by the triangle itself, for its corners' normals may lie on either side of the view.
        let outward = if flat.dot(mixed) < 0.0 { -flat } else { flat };
        let normal = mixed.try_normalize().or_else(|| outward.try_normalize()).unwrap_or(to_viewer);
        let behind = outward.dot(to_viewer) < 0.0;
        let normal = turned_to(if behind { -normal } else { normal }, to_viewer);
        Self { point: mix(points, weights), normal, hit, behind }
    }
}

fn corners(mesh: &Mesh, hit: Hit) -> ([DVec3; 3], [DVec3; 3]) {
    let corners = mesh.triangles()[hit.triangle as usize];
    let of = |all: &[Vec3]| each(corners, |i| all[i as usize].as_dvec3());
    (of(mesh.positions()), of(mesh.normals()))
}

/// Shadow of a block of samples.
#[derive(Clone, Copy, Debug)]
enum Block {
    Unknown,
    /// Of all its samples: true if they are in shadow.
    Whole(bool),
    /// An edge may run through it: each sample has a ray of its own.
    Mixed,
}

/// The shadows of a band's blocks, as far as they were needed.
struct Blocks {
    /// The first row of samples, and the blocks in a row.
    row: usize,
    across: usize,
    known: Vec<Block>,
    /// Of samples where blocks meet; mixed where no mesh is seen or it is turned away from the light.
    corners: Vec<Block>,
}

impl Blocks {
    fn new(row: usize, columns: usize) -> Self {
        let across = columns.div_ceil(BLOCK);
        let (known, corners) = (vec![Block::Unknown; across * ROWS], vec![Block::Unknown; (across + 1) * (ROWS + 1)]);
        Self { row, across, known, corners }
    }
}

impl Scene<'_> {
    fn part(&self, start: usize, count: usize) -> Band {
        let hits = self.visibility.hits();
        let end = (start + count).min(hits.len());
        let mut part = Band::default();
        part.seen.extend((start..end).filter(|&sample| hits[sample].is_some()).map(|sample| sample as u32));
        part.counts.seen = part.seen.len() as u64;
        part.samples.reserve(part.seen.len());
        part.angles.reserve(part.seen.len());
        let columns = self.visibility.size().columns();
        let mut blocks = Blocks::new(start / columns, columns);
        let (mut given, mut found) = (Given::NOTHING, Found::NOTHING);
        for run in 0..part.seen.len().div_ceil(LANES) {
            let run = run * LANES..part.seen.len().min((run + 1) * LANES);
            self.gather(&part.seen[run.clone()], &blocks, &mut given);
            lanes::find(&given, &self.visibility.eye().world_from_view, &mut found);
            for (lane, at) in run.enumerate() {
                self.take(part.seen[at], lane, &given, &found, &mut blocks, &mut part);
            }
        }
        part
    }

    /// Brings together what the angles of some samples are made of.
    fn gather(&self, samples: &[u32], blocks: &Blocks, given: &mut Given) {
        let (hits, triangles) = (self.visibility.hits(), self.mesh.triangles());
        let (positions, normals) = (self.mesh.positions(), self.mesh.normals());
        let columns = self.visibility.size().columns() as u32;
        for (lane, &sample) in samples.iter().enumerate().take(LANES) {
            let hit = hits[sample as usize];
            // Divided once: that is slow.
            let (row, column) = (sample / columns, sample % columns);
            given.blocks[lane] = (row as usize - blocks.row) / BLOCK * blocks.across + column as usize / BLOCK;
            given.rays[0][lane] = self.rays.x(column as usize);
            given.rays[1][lane] = self.rays.y(row as usize);
            given.weights[0][lane] = hit.weights[0];
            given.weights[1][lane] = hit.weights[1];
            let corners = triangles[hit.triangle as usize];
            for corner in 0..3 {
                let vertex = corners[corner] as usize;
                let (point, normal) = (positions[vertex].to_array(), normals[vertex].to_array());
                for axis in 0..3 {
                    given.points[corner][axis][lane] = point[axis];
                    given.normals[corner][axis][lane] = normal[axis];
                }
            }
        }
        for lane in 0..samples.len().min(LANES) {
            // Where the light stands on the surface there is none.
            let (to_light, _) = self.light.seen_from(given.point(lane)).unwrap_or((DVec3::NAN, 0.0));
            let [x, y, z] = &mut given.to_light;
            (x[lane], y[lane], z[lane]) = (to_light.x, to_light.y, to_light.z);
        }
    }

    /// Adds a sample to those that the light reaches, or counts why it does not.
    fn take(&self, sample: u32, lane: usize, given: &Given, found: &Found, blocks: &mut Blocks, part: &mut Band) {
        let hit = self.visibility.hits()[sample as usize];
        let (place, mut angles) = if found.plain[lane] {
            let (point, normal, behind) = (given.point(lane), found.normal(lane), found.behind[lane]);
            (SeenPlace { point, normal, hit, behind }, found.angles(lane))
        } else {
            self.checked_angles(sample as usize, hit)
        };
        if angles.cos_i > 0.0 && angles.cos_s > 0.0 {
            if self.is_shadowed(&place, sample, (given.blocks[lane], blocks), &mut part.counts.rays) {
                part.counts.shadowed += 1;
                angles.cos_i = 0.0;
            } else {
                part.counts.lit += 1;
            }
        } else if self.reach.through && angles.cos_i < 0.0 && self.shines_through(&place, &mut part.counts.rays) {
            part.counts.through += 1;
        } else {
            part.counts.facing_away += 1;
            angles.cos_i = 0.0;
        }
        if angles.cos_i != 0.0 || self.reach.everywhere {
            part.samples.push(sample);
            part.angles.push(angles);
        }
    }

    /// The angles at a sample of any kind.
    fn checked_angles(&self, sample: usize, hit: Hit) -> (SeenPlace, Angles) {
        let ahead = self.rays.at(sample).normalize();
        let to_viewer = -(self.visibility.eye().world_from_view * DVec3::new(ahead.x, ahead.y, -ahead.z));
        let place = SeenPlace::new(self.mesh, hit, to_viewer);
        let towards = self.light.seen_from(place.point);
        let geometry = towards
            .map_or(Geometry::DARK, |(to_light, _)| Geometry::from_directions(to_light, to_viewer, place.normal));
        (place, angles(&geometry, ahead.z))
    }

    /// True if the light reaches the other side of a leaf.
    fn shines_through(&self, place: &SeenPlace, rays: &mut u64) -> bool {
        let Some((tree, _)) = self.shadows else { return true };
        *rays += 1;
        let skipped = self.visibility.eye().radius * THIN;
        self.light.seen_from(place.point).is_some_and(|(to_light, distance)| {
            !tree.is_blocked(place.point + to_light * skipped, to_light, distance - skipped)
        })
    }

    /// Origin of a shadow ray: on the surface that the corners' normals suggest, a little above it.
    fn lifted(&self, place: &SeenPlace) -> DVec3 {
        let (points, normals) = corners(self.mesh, place.hit);
        let lifts = [0, 1, 2].map(|k: usize| {
            let normal = if place.behind { -normals[k] } else { normals[k] };
            normal * (points[k] - place.point).dot(normal).max(0.0)
        });
        // A hundred-thousandth of the scene above the surface: single precision does not see it on it.
        let above = place.normal * (self.visibility.eye().radius * 1e-5);
        place.point + mix(lifts, place.hit.barycentric().map(f64::from)) + above
    }

    fn is_shadowed(
        &self,
        place: &SeenPlace,
        sample: u32,
        (block, blocks): (usize, &mut Blocks),
        rays: &mut u64,
    ) -> bool {
        let Some((tree, shadows)) = self.shadows else { return false };
        let mut trace = |place: &SeenPlace, sample: u32| {
            *rays += 1;
            let way = self.light.seen_from(place.point);
            way.is_some_and(|(to_light, distance)| {
                let to_light = self.on_disk(to_light, sample);
                tree.is_blocked(self.lifted(place), to_light, distance)
            })
        };
        match shadows {
            Shadows::Off => false,
            Shadows::Full => trace(place, sample),
            Shadows::Coarse => {
                if let Block::Unknown = blocks.known[block] {
                    blocks.known[block] =
                        self.whole_block(block, blocks, &mut trace).map_or(Block::Mixed, Block::Whole);
                }
                if let Block::Whole(is_shadowed) = blocks.known[block] { is_shadowed } else { trace(place, sample) }
            }
        }
    }

    /// Shadow of a block if its corners all see the mesh turned to the light and are alike.
    fn whole_block(
        &self,
        block: usize,
        blocks: &mut Blocks,
        trace: &mut impl FnMut(&SeenPlace, u32) -> bool,
    ) -> Option<bool> {
        let size = self.visibility.size();
        let (across, first) = (blocks.across, blocks.row);
        let (row, column) = (block / across, block % across);
        let mut of_corner = |(row, column): (usize, usize)| {
            let known = &mut blocks.corners[row * (across + 1) + column];
            if let Block::Unknown = known {
                let row = (first + row * BLOCK).min(size.rows() - 1);
                let at = row * size.columns() + (column * BLOCK).min(size.columns() - 1);
                let hit = self.visibility.hits()[at];
                let seen = hit.is_some().then(|| self.checked_angles(at, hit));
                let lit = seen.filter(|(_, angles)| angles.cos_i > 0.0 && angles.cos_s > 0.0);
                *known = lit.map_or(Block::Mixed, |(place, _)| Block::Whole(trace(&place, at as u32)));
            }
            if let Block::Whole(is_shadowed) = *known { Some(is_shadowed) } else { None }
        };
        let shadow = of_corner((row, column))?;
        let others = [(row, column + 1), (row + 1, column), (row + 1, column + 1)];
        others.into_iter().all(|corner| of_corner(corner) == Some(shadow)).then_some(shadow)
    }

    /// The direction to a point of the light's disk: each of a pixel's samples has its own, so that their mean is the visible share.
    fn on_disk(&self, to_light: DVec3, sample: u32) -> DVec3 {
        let size = self.visibility.size();
        if size.samples < 2 || self.disk == 0.0 {
            return to_light;
        }
        let (columns, side) = (size.columns() as u32, size.samples);
        let (row, column) = (sample / columns, sample % columns);
        // Neighboring samples of a pixel see neighboring points in another order: the disk's place and the pixel's are independent.
        let index = (row % side * side + column % side) * DISK_STEP % (side * side);
        let share = (f64::from(index) + 0.5) / f64::from(side * side);
        // Pixels are turned against each other, so that no pattern repeats.
        let turn = f64::from((row / side * 5 + column / side * 3) % 8) / 8.0;
        let (sin, cos) = (TAU * (f64::from(index) * GOLDEN + turn)).sin_cos();
        let radius = self.disk.tan() * share.sqrt();
        let (across, along) = to_light.any_orthonormal_pair();
        (to_light + (across * cos + along * sin) * radius).normalize()
    }
}

#[inline(always)]
fn mix(v: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    v[0] * weights[0] + v[1] * weights[1] + v[2] * weights[2]
}

fn turned_to(normal: DVec3, to_viewer: DVec3) -> DVec3 {
    let cos = normal.dot(to_viewer);
    if cos >= EDGE {
        return normal;
    }
    let bent = normal + to_viewer * (EDGE - cos);
    bent.try_normalize().unwrap_or(to_viewer)
}

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
