//! Frames of the head under the sun through four sources, from visibility to signals.

use std::hint::black_box;
use std::sync::Arc;

use chromascope_core::accuracy::Accuracy;
use chromascope_core::camera::rendering::white_divisors;
use chromascope_core::reflectance::{Reading, Surface, wavelength_power};
use chromascope_core::render::mirror::Reach;
use chromascope_core::render::{
    Against, CameraImage, DiffuseTable, GeometryImage, Plan, Quality, RasterSize, ShadingImage, Shadows,
    SpectralWeights, Stop, Visibility,
};
use chromascope_core::scene::lighting::SUN_RADIUS;
use chromascope_core::scene::{Lighting, Viewpoint};
use chromascope_core::spectral::Quantity;
use chromascope_mesh::{Mesh, ShadowTree, head};

use super::timing::{Bench, Candidate, Case};
use super::{LIGHT, REFLECTANCE};
use crate::data::{curve, sensor};
use crate::harness::timed;
use crate::measurement::Errors;
use crate::{BenchError, ErrorOf, ErrorScale, Workload};

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

/// How the integral of a frame is made.
#[derive(Clone, Copy)]
enum Way<'a> {
    Quality(Quality),
    Plans(Accuracy, &'a [(Plan, Reach)]),
}

/// What no frame makes anew.
struct RenderService {
    mesh: Mesh,
    tree: ShadowTree,
    eye: Viewpoint,
    lighting: Lighting,
    surface: Surface,
    sources: Vec<(SpectralWeights, DiffuseTable)>,
}

impl RenderService {
    fn new(triangles: usize, sigma_m: f64) -> Result<Option<Self>, BenchError> {
        let (light, skin) = (curve(LIGHT, Quantity::Light)?, curve(REFLECTANCE, Quantity::Reflectance)?);
        let mut sources = Vec::new();
        for path in SOURCES {
            let sensor = sensor(path)?;
            let Ok(divisors) = white_divisors(&sensor, &light) else { return Ok(None) };
            let measure =
                SpectralWeights::new(&sensor, &light, &skin, divisors, wavelength_power(Reading::Radiometric));
            let table = DiffuseTable::new(&measure);
            sources.push((measure, table));
        }
        let eye = Viewpoint::new(0.3, 0.1, 3.6, 30_f64.to_radians());
        let lighting = Lighting::from_angles(25_f64.to_radians(), -25_f64.to_radians(), SUN_RADIUS);
        let surface = Surface::new(sigma_m, 10e-6, 50e-6, 50e-6, 1.4);
        let mesh = head::head(triangles);
        let tree = ShadowTree::new(&mesh);
        let (Ok(eye), Ok(lighting), Ok(surface)) = (eye, lighting, surface) else { return Ok(None) };
        Ok(Some(Self { mesh, tree, eye, lighting, surface, sources }))
    }

    /// What is seen, with what of it depends on the surface.
    fn shading(&self, side: u32, quality: Quality, stop: &Stop) -> Option<ShadingImage> {
        let eye = self.eye.eye(self.mesh.bounds());
        let visibility = Visibility::new(&self.mesh, eye, RasterSize::new(side, side), stop)?;
        let shadows = Some((&self.tree, Shadows::Coarse));
        let geometry = GeometryImage::new(&self.mesh, &visibility, &self.lighting, shadows, stop)?;
        ShadingImage::new(Arc::new(geometry), self.surface, Reading::Radiometric, quality, stop)
    }

    /// A frame through all sources; none only if it was stopped.
    fn frame(&self, side: u32, way: Way<'_>, stop: &Stop) -> Option<Vec<CameraImage>> {
        match way {
            Way::Quality(quality) => {
                let shading = self.shading(side, quality, stop)?;
                let images = self.sources.iter().map(|(measure, table)| {
                    let table = shading.needs_table().then_some(table);
                    CameraImage::new(&shading, measure, table, stop)
                });
                images.collect()
            }
            Way::Plans(accuracy, plans) => {
                let shading = self.shading(side, Quality::Within(accuracy), stop)?;
                let images = self.sources.iter().zip(plans).map(|((measure, _), (plan, reach))| {
                    CameraImage::by_plan(&shading, measure, Some(plan), *reach, stop)
                });
                images.collect()
            }
        }
    }

    /// What a tolerance takes for each source of a frame of this size; nothing where it cannot be kept, or if stopped.
    fn plans(&self, side: u32, accuracy: Accuracy, stop: &Stop) -> Option<Vec<(Plan, Reach)>> {
        let shading = self.shading(side, Quality::Within(accuracy), stop)?;
        let (demand, accuracy) = shading.demand().zip(shading.plan_accuracy())?;
        let plans = self.sources.iter().map(|(measure, _)| {
            let plan = Plan::new(measure, accuracy, Against::Peak, demand).ok()?;
            Some((plan, Reach::in_picture(&shading, measure)))
        });
        plans.collect()
    }

    /// The signals of a small frame beside those of the sum over 401 wavelengths.
    fn error(&self, way: Way<'_>, stop: &Stop) -> ErrorOf {
        let mut errors = Errors::default();
        let exact = self.frame(CHECKED, Way::Quality(Quality::Exact), stop);
        let frames = self.frame(CHECKED, way, stop).zip(exact);
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

pub(super) fn run(bench: &mut Bench<'_>) -> Result<(), BenchError> {
    let triangles = bench.pick(2_000, 100_000, 100_000);
    let sides: [&[u32]; 2] = bench.pick(
        [&[32], &[]],
        [&[SLOW_UP_TO, 256, 512, 1024], &[256]],
        [&[SLOW_UP_TO, 256, 512, 1024], &[SLOW_UP_TO, 256, 512, 1024]],
    );
    for ((name, sigma_m), sides) in [("\u{3c3} 5 µm", 5e-6), ("\u{3c3} 0.3 µm", 0.3e-6)].into_iter().zip(sides) {
        let most = bench.pools.most();
        let Some(studio) = bench.pools.on(most, || RenderService::new(triangles, sigma_m))? else {
            continue;
        };
        let tables = || studio.sources.iter().map(|(measure, _)| DiffuseTable::new(measure)).collect::<Vec<_>>();
        let (_, table_seconds) = timed(|| bench.pools.on(most, tables));
        let studio = &studio;
        for &side in sides {
            let mut qualities = vec![("full", Quality::Full), ("preview", Quality::Preview)];
            if side <= SLOW_UP_TO {
                let slow = [
                    ("401 wavelengths", Quality::Exact),
                    ("401, the paper's cases", Quality::Regimes),
                    ("15 nodes", Quality::Fine),
                ];
                qualities.splice(0..0, slow);
            }
            let exponents: &[i32] = if side <= SLOW_UP_TO { &[-3, -5, -8] } else { &[-5] };
            let tolerances: Vec<Tolerance> =
                exponents.iter().filter_map(|&exponent| tolerance(bench, studio, side, exponent)).collect();
            let mut ways: Vec<(String, Way<'_>, f64)> = Vec::new();
            for (method, quality) in qualities {
                // The mesh and its tree are the same for all; of what is made once only that counts which a way needs.
                let tabled = quality <= Quality::Full && studio.surface.sigma_m() < 1e-6;
                ways.push((method.to_owned(), Way::Quality(quality), if tabled { table_seconds } else { 0.0 }));
            }
            for (method, accuracy, plans, seconds) in &tolerances {
                ways.push((method.clone(), Way::Plans(*accuracy, plans), *seconds));
            }
            let mut candidates = Vec::new();
            for (method, way, seconds) in ways {
                let error = bench.pools.on(most, || studio.error(way, bench.stop));
                let often = matches!(way, Way::Quality(Quality::Full));
                for threads in if often { bench.pools.counts() } else { vec![most] } {
                    let stop = bench.stop;
                    let work = move |_: usize| {
                        black_box(studio.frame(side, way, stop));
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

/// A tolerance by name, with what it takes for each source and how long that took to make.
type Tolerance = (String, Accuracy, Vec<(Plan, Reach)>, f64);

fn tolerance(bench: &Bench<'_>, studio: &RenderService, side: u32, exponent: i32) -> Option<Tolerance> {
    let accuracy = Accuracy::new(10_f64.powi(exponent)).ok()?;
    let (plans, seconds) = timed(|| bench.pools.on(bench.pools.most(), || studio.plans(side, accuracy, bench.stop)));
    Some((format!("within 1e{exponent}"), accuracy, plans?, seconds))
}
