//! Frames of the head under the sun through four sources, from visibility to signals.

use super::timing::{Bench, Candidate, Case};
use super::{LIGHT, REFLECTANCE};
use crate::data::{curve, sensor};
use crate::harness::timed;
use crate::workload::{BenchError, ErrorOf, ErrorScale, Errors, Workload};
use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::rendering::white_divisors;
use chromascope_core::reflectance::{Normalization, Surface, wavelength_power};
use chromascope_core::render::{
    CameraImage, Demand, GeometryImage, Plan, Quality, RasterSize, ShadingImage, Shadows, SpectralWeights, Stop,
    Visibility,
};
use chromascope_core::scene::lighting::SUN_RADIUS;
use chromascope_core::scene::viewpoint::ViewpointError;
use chromascope_core::scene::{Lighting, Viewpoint};
use chromascope_core::spectral::Quantity;
use chromascope_mesh::{Mesh, ShadowTree, head};
use std::hint::black_box;
use std::sync::Arc;

/// The reference and the cameras of the paper's third experiment.
const SOURCES: [&str; 4] = [
    "observers/stiles_burch_1955_2deg.csv",
    "cameras/canon_eos_10d_2007_figure.csv",
    "cameras/nikon_d70_2007_figure.csv",
    "cameras/kodak_dcs200.csv",
];
/// The side of the frames that errors are found on: each has the same peak.
const CHECKED: u32 = 48;

/// Up to this side slow qualities are measured too: beyond it they take minutes, and as long per pixel.
const SLOW_UP_TO: u32 = 128;

/// Roughness of the frames that are compared with those of the first in one case, with the names of their methods.
const ROUGHNESSES: [(&str, f64); 4] = [
    ("full, \u{3c3} 5 µm", 5e-6),
    ("full, \u{3c3} 0.3 µm", 0.3e-6),
    ("full, \u{3c3} 0.1 µm", 0.1e-6),
    ("full, \u{3c3} 0.05 µm", 0.05e-6),
];

/// Parts that are not recomputed per frame.
#[derive(Clone)]
struct FrameCase {
    mesh: Arc<Mesh>,
    tree: Arc<ShadowTree>,
    eye: Viewpoint,
    lighting: Lighting,
    surface: Surface,
    sources: Arc<Vec<SpectralWeights>>,
}

impl FrameCase {
    fn new(triangles: usize, sigma_m: f64) -> Result<Option<Self>, BenchError> {
        let (light, skin) = (curve(LIGHT, Quantity::Light)?, curve(REFLECTANCE, Quantity::Reflectance)?);
        let mut sources = Vec::new();
        for path in SOURCES {
            let sensor = sensor(path)?;
            let Ok(divisors) = white_divisors(&sensor, &light) else { return Ok(None) };
            let measure =
                SpectralWeights::new(&sensor, &light, &skin, divisors, wavelength_power(Normalization::Radiometric));
            sources.push(measure);
        }
        let eye = eye(0);
        let lighting = Lighting::from_angles(25_f64.to_radians(), -25_f64.to_radians(), SUN_RADIUS);
        let mesh = Arc::new(head::head(triangles));
        let tree = Arc::new(ShadowTree::new(&mesh));
        let (Ok(eye), Ok(lighting), Some(surface)) = (eye, lighting, surface(sigma_m)) else { return Ok(None) };
        Ok(Some(Self { mesh, tree, eye, lighting, surface, sources: Arc::new(sources) }))
    }

    fn visibility(&self, side: u32, stop: &Stop) -> Option<Visibility> {
        let eye = self.eye.eye(self.mesh.bounds());
        Visibility::new(&self.mesh, eye, RasterSize::new(side, side), stop)
    }

    fn geometry(&self, visibility: &Visibility, shadows: Shadows, stop: &Stop) -> Option<Arc<GeometryImage>> {
        let shadows = Some((&*self.tree, shadows));
        GeometryImage::new(&self.mesh, visibility, &self.lighting, shadows, stop).map(Arc::new)
    }

    /// Shading of the visible surface: everything in it that depends on the surface's material.
    fn shading(&self, side: u32, quality: Quality, stop: &Stop) -> Option<ShadingImage> {
        let visibility = self.visibility(side, stop)?;
        let geometry = self.geometry(&visibility, Shadows::Coarse, stop)?;
        ShadingImage::new(geometry, self.surface, Normalization::Radiometric, quality, stop)
    }

    /// A frame of a visible surface through all sources, by the plans that are known for its request.
    fn planned(
        &self,
        geometry: Arc<GeometryImage>,
        known: &mut KnownPlans,
        quality: Quality,
        stop: &Stop,
    ) -> Option<Vec<CameraImage>> {
        let shading = ShadingImage::new(geometry, self.surface, Normalization::Radiometric, quality, stop)?;
        let plans = known.of(&shading, &self.sources)?;
        let images = self.sources.iter().zip(plans);
        images.map(|(measure, plan)| CameraImage::new(&shading, measure, Arc::clone(plan), stop)).collect()
    }

    /// This scene after turns by 2°, from the front again after sixteen.
    fn turned(&self, count: usize) -> Self {
        Self { eye: eye(count).unwrap_or(self.eye), ..self.clone() }
    }

    /// A frame through all sources by plans of this quality; none only if it was stopped.
    fn frame(&self, side: u32, quality: Quality, plans: &[Arc<Plan>], stop: &Stop) -> Option<Vec<CameraImage>> {
        let shading = self.shading(side, quality, stop)?;
        let images = self.sources.iter().zip(plans);
        images.map(|(measure, plan)| CameraImage::new(&shading, measure, plan.clone(), stop)).collect()
    }

    /// The plans of a frame of this size, one for each sensor; `None` if the tolerance cannot be met, or if stopped.
    fn plans(&self, side: u32, quality: Quality, stop: &Stop) -> Option<Vec<Arc<Plan>>> {
        let shading = self.shading(side, quality, stop)?;
        let plans = self.sources.iter().map(|measure| shading.plan(measure).ok().map(Arc::new));
        plans.collect()
    }

    /// The signals of a small frame beside those of the sum over 401 wavelengths.
    fn error(&self, quality: Quality, plans: &[Arc<Plan>], stop: &Stop) -> ErrorOf {
        let mut errors = Errors::default();
        let reference = self.plans(CHECKED, Quality::Reference, stop);
        let exact = reference.and_then(|plans| self.frame(CHECKED, Quality::Reference, &plans, stop));
        let frames = self.frame(CHECKED, quality, plans, stop).zip(exact);
        for (found, exact) in frames.into_iter().flat_map(|(found, exact)| found.into_iter().zip(exact)) {
            let signals = |image: &CameraImage| -> Vec<f64> {
                image.signals().iter().flatten().map(|&signal| f64::from(signal)).collect()
            };
            let (found, exact) = (signals(&found), signals(&exact));
            let peak = exact.iter().fold(0.0_f64, |most, signal| most.max(signal.abs()));
            found.iter().zip(&exact).for_each(|(found, exact)| errors.add(found - exact, peak));
        }
        errors.sum_up("signals, of a frame's peak, against the sums over 401 wavelengths in f32", ErrorScale::Relative)
    }
}

/// The viewpoint after turns by 2°.
fn eye(turns: usize) -> Result<Viewpoint, ViewpointError> {
    Viewpoint::new(0.3 + 2_f64.to_radians() * (turns % 16) as f64, 0.1, 3.6, 30_f64.to_radians())
}

fn surface(sigma_m: f64) -> Option<Surface> {
    Surface::new(sigma_m, 10e-6, 50e-6, 50e-6, 1.4).ok()
}

/// What a plan is made for, beside the sensor under its light: few for all views, places of the light and roughnesses.
type Request = Option<(RelTolerance, Demand)>;

/// Plans of all sources by request, as the window keeps them.
#[derive(Default)]
struct KnownPlans(Vec<(Request, Vec<Arc<Plan>>)>);

impl KnownPlans {
    /// The plans of a picture, made if they are not known; none if the tolerance cannot be met.
    fn of(&mut self, shading: &ShadingImage, sources: &[SpectralWeights]) -> Option<&[Arc<Plan>]> {
        let request = shading.plan_request();
        let found = self.0.iter().position(|(known, _)| *known == request);
        let index = if let Some(index) = found {
            index
        } else {
            let plan = |measure: &SpectralWeights| shading.plan(measure).ok().map(Arc::new);
            self.0.push((request, sources.iter().map(plan).collect::<Option<_>>()?));
            self.0.len() - 1
        };
        Some(&self.0[index].1)
    }
}

/// A change, after which a frame is made from the first stage that depends on it.
#[derive(Clone, Copy, PartialEq)]
enum Change {
    /// The view: everything but the mesh and the shadow tree.
    View(Shadows),
    /// The position of the light: the visible surface is reused.
    Light,
    /// The roughness: the light on the visible surface is reused too.
    Roughness,
    /// The spectrum of the light or the material: only the plans and the signals are made anew.
    Spectrum,
}

const CHANGES: [(&str, Change); 5] = [
    ("view, coarse shadows", Change::View(Shadows::Coarse)),
    ("view, a shadow ray per sample", Change::View(Shadows::Full)),
    ("light, a shadow ray per sample", Change::Light),
    ("roughness", Change::Roughness),
    ("spectrum, with new plans", Change::Spectrum),
];

/// Frames after a change, with the plans that it requires and the window does not know yet, as a multiple of a changed view's
/// time. The view turns from frame to frame.
fn changes(bench: &mut Bench<'_>, service: &FrameCase, side: u32, roughness: &str) {
    let (quality, stop) = (Quality::Full, bench.stop);
    let counts = bench.pools.counts();
    let most = bench.pools.most();
    let Some(plans) = bench.pools.on(most, || service.plans(side, quality, stop)) else { return };
    let error = bench.pools.on(most, || service.error(quality, &plans, stop));
    let made = bench.pools.on(most, || {
        let visibility = service.visibility(side, stop)?;
        let geometry = service.geometry(&visibility, Shadows::Full, stop)?;
        Some((visibility, geometry))
    });
    let Some((visibility, geometry)) = &made else { return };
    let mut candidates = Vec::new();
    for (name, change) in CHANGES {
        for &threads in &counts {
            let (mut known, mut frames) = (KnownPlans::default(), 0);
            let work = move |_: usize| {
                frames += 1;
                let geometry = match change {
                    Change::View(shadows) => service
                        .turned(frames)
                        .visibility(side, stop)
                        .and_then(|visibility| service.geometry(&visibility, shadows, stop)),
                    Change::Light => service.geometry(visibility, Shadows::Full, stop),
                    Change::Roughness | Change::Spectrum => Some(Arc::clone(geometry)),
                };
                if change == Change::Spectrum {
                    known = KnownPlans::default();
                }
                black_box(geometry.and_then(|geometry| service.planned(geometry, &mut known, quality, stop)));
            };
            candidates.push(Candidate::new(name, 1, error.clone(), work).undivided().on(threads));
        }
    }
    let case = format!("{side} × {side}, what changes, {roughness}");
    bench.compare(Case { workload: Workload::Frames, name: &case, item: "frame" }, candidates);
}

/// Frames of smooth surfaces as a multiple of a rough one's time.
fn smooth_surfaces(bench: &mut Bench<'_>, service: &FrameCase, side: u32) {
    let most = bench.pools.most();
    let with = |sigma_m| surface(sigma_m).map(|surface| FrameCase { surface, ..service.clone() });
    let services = ROUGHNESSES.map(|(name, sigma_m)| (name, with(sigma_m)));
    let mut candidates = Vec::new();
    for (name, service) in services {
        let Some(service) = service else { continue };
        let (quality, stop) = (Quality::Full, bench.stop);
        let (plans, seconds) = timed(|| bench.pools.on(most, || service.plans(side, quality, stop)));
        let Some(plans) = plans else { continue };
        let error = bench.pools.on(most, || service.error(quality, &plans, stop));
        let work = move |_: usize| {
            black_box(service.frame(side, quality, &plans, stop));
        };
        candidates.push(Candidate::new(name, 1, error, work).undivided().on(most).built_in(seconds));
    }
    let case = format!("{side} × {side}, smooth surfaces");
    bench.compare(Case { workload: Workload::Frames, name: &case, item: "frame" }, candidates);
}

pub(super) fn run(bench: &mut Bench<'_>) -> Result<(), BenchError> {
    let triangles = bench.pick(2_000, 100_000, 100_000);
    let sides: [&[u32]; 2] = bench.pick(
        [&[32], &[]],
        [&[SLOW_UP_TO, 256, 512, 1024], &[256]],
        [&[SLOW_UP_TO, 256, 512, 1024], &[SLOW_UP_TO, 256, 512, 1024]],
    );
    for ((name, sigma_m), sides) in [("\u{3c3} 5 µm", 5e-6), ("\u{3c3} 0.3 µm", 0.3e-6)].into_iter().zip(sides) {
        let most = bench.pools.most();
        let Some(service) = bench.pools.on(most, || FrameCase::new(triangles, sigma_m))? else { continue };
        let service = &service;
        let side = bench.pick(32, 512, 512);
        if sigma_m > 1e-6 {
            smooth_surfaces(bench, service, side);
        }
        changes(bench, service, side, name);
        for &side in sides {
            let mut qualities = vec![("full", Quality::Full), ("preview", Quality::Preview)];
            if side <= SLOW_UP_TO {
                let slow = [
                    ("401 wavelengths", Quality::Reference),
                    ("401, the paper's cases", Quality::Regimes),
                    ("fine", Quality::Fine),
                ];
                qualities.splice(0..0, slow);
            }
            let exponents: &[i32] = if side <= SLOW_UP_TO { &[-3, -5, -8] } else { &[-5] };
            let tolerances = exponents.iter().filter_map(|&exponent| {
                let tolerance = RelTolerance::new(10_f64.powi(exponent)).ok()?;
                Some((format!("within 1e{exponent}"), Quality::Within(tolerance)))
            });
            let named = qualities.into_iter().map(|(name, quality)| (name.to_owned(), quality));
            let mut candidates = Vec::new();
            for (method, quality) in named.chain(tolerances) {
                let (plans, seconds) = timed(|| bench.pools.on(most, || service.plans(side, quality, bench.stop)));
                let Some(plans) = plans.map(Arc::new) else { continue };
                let error = bench.pools.on(most, || service.error(quality, &plans, bench.stop));
                let often = quality == Quality::Full;
                for threads in if often { bench.pools.counts() } else { vec![most] } {
                    let (stop, plans) = (bench.stop, Arc::clone(&plans));
                    let work = move |_: usize| {
                        black_box(service.frame(side, quality, &plans, stop));
                    };
                    let candidate = Candidate::new(method.as_str(), 1, error.clone(), work);
                    candidates.push(candidate.undivided().on(threads).built_in(seconds));
                }
            }
            let case = format!("{side} × {side}, {name}");
            bench.compare(Case { workload: Workload::Frames, name: &case, item: "frame" }, candidates);
        }
    }
    Ok(())
}
