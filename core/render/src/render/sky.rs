//! Light of a uniform sky at every sample that sees the mesh.
//!
//! ```text
//! I_c = s cos⁴α / π  ∫_sky V(ω) cos θ [∫ C_c (πf)(ω → v; λ) S L dλ / ∫ C_c L dλ] dω
//!     = s cos⁴α [ W_d ∫ C_c ρ_d(θs; λ) S L dλ + W_m ∫ C_c ρ_m(θs; λ) S L dλ ] / ∫ C_c L dλ
//! ```
//! s = irradiance of a level surface by the whole sky over that of a surface that faces the light; V = visibility; `ρ_d`, `ρ_m` =
//! hemispherical-directional reflectance of a white by the diffuse and the coherent component
//! ([`hemispherical_directional`]); `W_d` = mean of V over the diffuse lobe at 550 nm, the directions below the horizon counted as
//! dark; `W_m` = V in the mirror direction. The sky has the spectrum of the light.
//!
//! `W_d` is a ratio of two sums over directions that are distributed as the lobe's slopes are. The only approximation is that it is
//! the same at all wavelengths: exact where the sky is seen whole, for Lambertian and for rough surfaces.

pub mod ground;
mod lobe;
mod visible;

use super::geometry::{Angles, SeenPlace};
use super::measure::{LAMBDA_0_NM, SkySignals, SpectralWeights};
use super::quality::SkyFineness;
use super::stop::Stop;
use super::visibility::Visibility;
use crate::reflectance::hemispherical::coherent_hemispherical;
use crate::reflectance::{
    Geometry, Normalization, Specular, Surface, hemispherical_directional, kappa, wavelength_power,
};
use chromascope_color::spectral::grid::{COUNT, FIRST_NM, LAST_NM, wavelength_nm};
use chromascope_math::chebyshev::nodes;
use chromascope_mesh::Mesh;
use glam::{DVec3, Vec3};
use lobe::Lobe;
use rayon::prelude::*;
use std::sync::Arc;

pub use visible::{SkyVisibility, VisibleCells, visible_share};

/// Up to this cosine towards the viewer a normal may have been bent.
const BENT: f32 = 2e-3;

/// Samples that one task works on.
const CHUNK: usize = 1024;

/// Visible shares of the sky at one sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SkySample {
    /// `W_d`, times cos⁴α; of matte parts the mean over the cosine.
    pub diffuse: f32,
    /// `W_m`, times cos⁴α.
    pub coherent: f32,
    /// Irradiance of the other side over that of a level surface under the whole sky, times cos⁴α; 0 where nothing shines through.
    pub behind: f32,
}

/// Visible shares of the sky at each sample that sees the mesh. No light, spectrum or camera is in it.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyImage {
    samples: Vec<SkySample>,
}

/// What the lobe of a surface is like, and what is wanted of it.
#[derive(Clone, Copy, Debug)]
pub struct SkyView<'a> {
    /// The surface.
    pub surface: &'a Surface,
    /// Its normalization.
    pub reading: Normalization,
    /// Exactness.
    pub fineness: SkyFineness,
    /// True if light shines through from behind.
    pub through: bool,
}

impl SkyImage {
    /// Finds the visible shares wherever the mesh is seen; none if stopped.
    pub fn new(
        mesh: &Mesh,
        visibility: &Visibility,
        sky: &SkyVisibility,
        view: SkyView<'_>,
        stop: &Stop,
    ) -> Option<Self> {
        let hits = visibility.hits();
        let seen: Vec<u32> = (0..hits.len() as u32).filter(|&sample| hits[sample as usize].is_some()).collect();
        let lobe = Lobe::new(view.surface, view.reading, view.fineness.directions);
        let even = view.through || !mesh.parts().is_empty();
        let even = even.then(|| Lobe::new(view.surface, Normalization::Lambertian, view.fineness.directions));
        let sample = Sampling { mesh, visibility, sky, lobe, even, through: view.through };
        let (run, columns) = (view.fineness.run.max(1), visibility.size().columns());
        let chunk = |chunk: &[u32]| {
            let mut samples: Vec<SkySample> = Vec::with_capacity(chunk.len());
            for (index, &at) in chunk.iter().enumerate() {
                if stop.is_set() {
                    break;
                }
                let is_first = (at as usize % columns).is_multiple_of(run);
                let shared = !is_first && index > 0 && at == chunk[index - 1] + 1;
                samples.push(match samples.last() {
                    Some(&last) if shared => last,
                    _ => sample.at(at as usize),
                });
            }
            samples
        };
        let samples: Vec<SkySample> = seen.par_chunks(CHUNK).flat_map_iter(chunk).collect();
        (!stop.is_set()).then_some(Self { samples })
    }

    /// Visible shares in the order of [`super::LitSamples::seen`].
    pub fn samples(&self) -> &[SkySample] {
        &self.samples
    }
}

struct Sampling<'a> {
    mesh: &'a Mesh,
    visibility: &'a Visibility,
    sky: &'a SkyVisibility,
    lobe: Lobe,
    /// Of what scatters evenly, where there is such.
    even: Option<Lobe>,
    through: bool,
}

impl Sampling<'_> {
    fn at(&self, sample: usize) -> SkySample {
        let hit = self.visibility.hits()[sample];
        let ahead = self.visibility.rays().at(sample).normalize();
        let to_viewer = -(self.visibility.eye().world_from_view * DVec3::new(ahead.x, ahead.y, -ahead.z));
        let SeenPlace { normal, behind, .. } = SeenPlace::new(self.mesh, hit, to_viewer);
        let cells = self.mesh.triangles()[hit.triangle as usize].map(|v| self.sky.cells()[v as usize]);
        let [before, after] = if behind {
            [cells.map(|cells| cells.back), cells.map(|cells| cells.front)]
        } else {
            [cells.map(|cells| cells.front), cells.map(|cells| cells.back)]
        };
        let weights = hit.barycentric();
        let falloff = (ahead.z * ahead.z * ahead.z * ahead.z) as f32;
        let (normal, to_viewer) = (normal.as_vec3(), to_viewer.as_vec3());
        let visible = |direction: Vec3| visible_share(before, weights, direction);
        let cos_s = normal.dot(to_viewer);
        let mirrored = normal * (2.0 * cos_s) - to_viewer;
        // A normal that was bent to the viewer is no place's own: it would shine along the outline of every facet.
        let own = if cos_s > BENT { 1.0 } else { 0.0 };
        let through = self.even.as_ref().filter(|_| self.through).map_or(0.0, |lobe| {
            lobe.visible_mean(-normal, -normal, |direction| visible_share(after, weights, direction))
        });
        let is_matte = self.mesh.part_at(hit.triangle, hit.weights).is_matte();
        let lobe = self.even.as_ref().filter(|_| is_matte).unwrap_or(&self.lobe);
        SkySample {
            diffuse: falloff * lobe.visible_mean(normal, to_viewer, visible),
            coherent: own * falloff * lobe::above(mirrored.y, lobe::EDGE) * visible(mirrored),
            behind: falloff * through,
        }
    }
}

/// cos θs at which the reflectance is computed: the zeros of a Chebyshev polynomial, between which it is a polynomial.
const ANGLES: usize = 14;
/// Wavelengths at which the diffuse component's is.
const WAVELENGTHS: usize = 6;
/// Steps of cos θs.
const STEPS: usize = 256;

/// g from which on e^-g is nothing.
const NOTHING: f64 = 100.0;

/// Hemispherical-directional reflectance of a surface in equal steps of cos θs. No camera and no light is in it: under another
/// light, or through another camera, signals are sums of products.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyReflectance {
    specular: Specular,
    /// At the wavelengths of [`chebyshev`], without the power of the wavelength that a measure has already.
    diffuse: Vec<[f64; WAVELENGTHS]>,
    /// At the wavelengths of the grid, likewise; none where it is dark.
    coherent: Vec<Option<Box<[f32; COUNT]>>>,
    power: i32,
}

impl SkyReflectance {
    /// Integrates over the hemisphere.
    pub fn new(surface: Surface, reading: Normalization) -> Self {
        let wavelengths = chebyshev::<WAVELENGTHS>(FIRST_NM, LAST_NM);
        let at = |cos: f64| wavelengths.map(|nm| hemispherical_directional(&surface, reading, cos.acos(), nm).diffuse);
        let at_angles: Vec<[f64; WAVELENGTHS]> =
            chebyshev::<ANGLES>(0.0, 1.0).to_vec().into_par_iter().map(at).collect();
        let diffuse = |step: usize| {
            let shares = interpolated::<ANGLES>(0.0, 1.0, step as f64 / STEPS as f64);
            std::array::from_fn(|w| shares.iter().zip(&at_angles).map(|(share, row)| share * row[w]).sum())
        };
        let power = wavelength_power(reading);
        let coherent = |step: usize| {
            let theta = (step as f64 / STEPS as f64).acos();
            let g = kappa(&surface, &Geometry::from_angles(theta, theta, 0.0));
            (g * (LAMBDA_0_NM / LAST_NM).powi(2) <= NOTHING).then(|| {
                let at = |nm| coherent_hemispherical(&surface, reading, theta, nm) * (LAMBDA_0_NM / nm).powi(-power);
                Box::new(std::array::from_fn(|index| at(wavelength_nm(index)) as f32))
            })
        };
        Self {
            specular: surface.specular(),
            diffuse: (0..=STEPS).map(diffuse).collect(),
            coherent: (0..STEPS + 1).into_par_iter().map(coherent).collect(),
            power,
        }
    }

    /// A camera's signals of a sample under the whole sky, by cos θs.
    pub fn signals(&self, measure: &SpectralWeights) -> SkySignals {
        let mut weights = [[0.0; 3]; WAVELENGTHS];
        for node in measure.dense() {
            let shares = interpolated::<WAVELENGTHS>(FIRST_NM, LAST_NM, node.wavelength_nm);
            let power = (LAMBDA_0_NM / node.wavelength_nm).powi(-self.power);
            for (sum, share) in weights.iter_mut().zip(shares) {
                for (sum, weight) in sum.iter_mut().zip(node.weights) {
                    *sum += share * weight * power;
                }
            }
        }
        let diffuse = |row: &[f64; WAVELENGTHS]| {
            std::array::from_fn(|c| row.iter().zip(&weights).map(|(r, w)| r * w[c]).sum::<f64>() as f32)
        };
        let measure = if self.specular == Specular::Fresnel { measure.coherent() } else { measure };
        let mut spectrum = [[0.0_f32; 3]; COUNT];
        for node in measure.dense() {
            let index = (node.wavelength_nm - FIRST_NM).round() as usize;
            spectrum[index.min(COUNT - 1)] = node.weights.map(|weight| weight as f32);
        }
        let coherent = |row: &Option<Box<[f32; COUNT]>>| {
            let mut sums = [0.0; 3];
            for (share, weights) in row.iter().flat_map(|row| row.iter()).zip(&spectrum) {
                sums.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += share * weight);
            }
            sums
        };
        SkySignals {
            diffuse: self.diffuse.iter().map(diffuse).collect(),
            coherent: self.coherent.iter().map(coherent).collect(),
        }
    }

    /// Memory of the tables in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.diffuse) + self.coherent.iter().flatten().count() * size_of::<[f32; COUNT]>()
    }
}

/// A uniform sky over a shaded mesh.
#[derive(Clone, Debug)]
pub struct Sky {
    /// Visible shares.
    pub image: Arc<SkyImage>,
    /// s: irradiance of a level surface over that of a surface that faces the light.
    pub share: f64,
}

impl Sky {
    /// Adds the sky's light to the signals of all samples that see the mesh, where the measure says what the surface returns of it.
    pub(super) fn add(&self, measure: &SpectralWeights, angles: &[Angles], signals: &mut [[f32; 3]]) {
        let Some(table) = &measure.sky else { return };
        let share = self.share as f32;
        let through = measure.transmitted.as_ref().map_or([0.0; 3], |transmitted| {
            transmitted.signals.map(|signal| (signal * transmitted.share.under_sky()) as f32)
        });
        let add = |((signal, sample), angles): ((&mut [f32; 3], &SkySample), &Angles)| {
            let at = angles.cos_s.clamp(0.0, 1.0) * STEPS as f32;
            let low = (at as usize).min(STEPS - 1);
            let t = at - low as f32;
            let mix = |table: &[[f32; 3]], c: usize| table[low][c] * (1.0 - t) + table[low + 1][c] * t;
            for (c, signal) in signal.iter_mut().enumerate() {
                let own = sample.diffuse * mix(&table.diffuse, c) + sample.coherent * mix(&table.coherent, c);
                *signal += share * (own + sample.behind * through[c]);
            }
        };
        signals.par_iter_mut().zip(self.image.samples()).zip(angles).with_min_len(4096).for_each(add);
    }
}

/// Zeros of the Chebyshev polynomial of degree N on an interval, ascending.
fn chebyshev<const N: usize>(from: f64, to: f64) -> [f64; N] {
    nodes::<N>().map(|node| f64::midpoint(from, to) - 0.5 * (to - from) * node)
}

/// Weights of the values at [`chebyshev`]'s zeros in the polynomial through them, at a place.
fn interpolated<const N: usize>(from: f64, to: f64, x: f64) -> [f64; N] {
    let zeros = chebyshev::<N>(from, to);
    if let Some(exact) = zeros.iter().position(|&node| node == x) {
        return std::array::from_fn(|k| f64::from(u8::from(k == exact)));
    }
    let weight = |k: usize| {
        let angle = std::f64::consts::PI * (2 * k + 1) as f64 / (2 * N) as f64;
        let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * angle.sin() / (x - zeros[k])
    };
    let weights: [f64; N] = std::array::from_fn(weight);
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}
