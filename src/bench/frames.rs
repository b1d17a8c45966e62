//! Frames of the head under the sun through four sources, from visibility to signals.

use std::hint::black_box;
use std::sync::Arc;

use chromascope_core::camera::rendering::white_divisors;
use chromascope_core::reflectance::{Reading, Surface, wavelength_power};
use chromascope_core::render::{
    CameraImage, DiffuseTable, GeometryImage, Measure, Quality, RasterSize, ShadingImage, ShadowTree, Shadows, Stop,
    Visibility,
};
use chromascope_core::scene::lighting::SUN_RADIUS;
use chromascope_core::scene::{Lighting, Mesh, Viewpoint, head};
use chromascope_core::spectral::Quantity;

use super::case::{ErrorOf, ErrorScale, Errors};
use super::inputs::{LIGHT, REFLECTANCE, curve, sensor};
use super::timing::{Bench, Candidate, Case, timed};
use super::{BenchError, Workload};

/// The truth and the cameras of the paper's third experiment.
const SOURCES: [&str; 4] = [
    "observers/stiles_burch_1955_2deg.csv",
    "cameras/canon_eos_10d.csv",
    "cameras/nikon_d70.csv",
    "cameras/kodak_dcs200.csv",
];
/// The side of the frames that errors are found on: each has the same peak.
const CHECKED: u32 = 48;

/// Up to this side slow qualities are measured too: beyond it they take minutes, and as long per pixel.
const SLOW_UP_TO: u32 = 128;

/// What no frame makes anew.
struct Studio {
    mesh: Mesh,
    tree: ShadowTree,
    eye: Viewpoint,
    lighting: Lighting,
    surface: Surface,
    sources: Vec<(Measure, DiffuseTable)>,
}

impl Studio {
    fn new(triangles: usize, sigma_m: f64) -> Result<Option<Self>, BenchError> {
        let (light, skin) = (curve(LIGHT, Quantity::Light)?, curve(REFLECTANCE, Quantity::Reflectance)?);
        let mut sources = Vec::new();
        for path in SOURCES {
            let sensor = sensor(path)?;
            let Ok(divisors) = white_divisors(&sensor, &light) else { return Ok(None) };
            let measure = Measure::new(&sensor, &light, &skin, divisors, wavelength_power(Reading::Radiometric));
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

    /// A frame through all sources; none only if it was stopped.
    fn frame(&self, side: u32, quality: Quality, stop: &Stop) -> Option<Vec<CameraImage>> {
        let eye = self.eye.eye(self.mesh.bounds());
        let visibility = Visibility::new(&self.mesh, eye, RasterSize::new(side, side), stop)?;
        let shadows = Some((&self.tree, Shadows::Coarse));
        let geometry = GeometryImage::new(&self.mesh, &visibility, &self.lighting, shadows, stop)?;
        let shading = ShadingImage::new(Arc::new(geometry), self.surface, Reading::Radiometric, quality, stop)?;
        let images = self.sources.iter().map(|(measure, table)| {
            let table = shading.needs_table().then_some(table);
            CameraImage::new(&shading, measure, table, stop)
        });
        images.collect()
    }

    /// The signals of a small frame beside those of the sum over 401 wavelengths.
    fn error(&self, quality: Quality, stop: &Stop) -> ErrorOf {
        let mut errors = Errors::default();
        let frames = self.frame(CHECKED, quality, stop).zip(self.frame(CHECKED, Quality::Exact, stop));
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
        let (studio, seconds) = timed(|| bench.pools.on(most, || Studio::new(triangles, sigma_m)));
        let Some(studio) = studio? else { continue };
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
            let mut candidates = Vec::new();
            for (method, quality) in qualities {
                let error = bench.pools.on(most, || studio.error(quality, bench.stop));
                let threads = if matches!(quality, Quality::Full) { bench.pools.counts() } else { vec![most] };
                for threads in threads {
                    let stop = bench.stop;
                    let work = move |_: usize| {
                        black_box(studio.frame(side, quality, stop));
                    };
                    let candidate = Candidate::new(method, 1, error.clone(), work);
                    candidates.push(candidate.undivided().on(threads).built_in(seconds));
                }
            }
            let case = format!("{side} × {side}, {name}");
            bench.compare(Case { workload: Workload::Frames, name: &case, item: "frame" }, candidates);
        }
    }
    Ok(())
}
