//! Error and cost of the chosen quality, compared with the sum over all wavelengths, on the samples of this picture.

use std::sync::Arc;

use chromascope_core::camera::RenderingError;
use chromascope_core::query::Ask as _;
use chromascope_core::query::render::Roughness;
use chromascope_core::reflectance::{Normalization, Surface};
use chromascope_core::render::shading::DiffuseKind;
use chromascope_core::render::{CameraImage, GeometryImage, Plan, Quality, ShadingImage, SpectralWeights, Stop};
use chromascope_measure::harness::{Budget, take_turns, timed};
use rayon::ThreadPoolBuilder;

use super::Made;

/// At most this many lit samples are measured on.
const SAMPLES: usize = 2000;
/// Short work is repeated for 20 ms, and the shortest time taken.
const BUDGET: Budget = Budget { rounds: [0, 0], seconds: [0.02, 0.02] };

pub(super) struct Measured {
    /// Every `stride`th lit sample was measured.
    pub(super) stride: usize,
    pub(super) samples: usize,
    pub(super) chosen: Cost,
    /// The plain sum over all wavelengths.
    pub(super) exact: Cost,
    /// The paper's three cases of g.
    pub(super) regimes: Cost,
}

pub(super) struct Cost {
    /// Nanoseconds a sample and sensor, on one thread.
    pub(super) ns: f64,
    /// Number of samples whose integral is a sum over wavelengths.
    pub(super) sums: u64,
    /// Of each sensor its errors; none for a sensor without light anywhere.
    pub(super) errors: Vec<Option<Errors>>,
}

/// Differences to the sum over all wavelengths, as shares of the picture's peak.
#[derive(Clone, Copy)]
pub(super) struct Errors {
    /// The largest in any channel.
    pub(super) max: f64,
    /// The root of the mean square over all channels.
    pub(super) rms: f64,
}

/// The signals of each sensor by one quality.
struct Run {
    signals: Vec<Vec<[f32; 3]>>,
    sums: u64,
    seconds: f64,
}

/// Inputs of a measurement. All data are computed beforehand, so that no query runs while a stopwatch runs.
struct Bench {
    geometry: Arc<GeometryImage>,
    surface: Surface,
    reading: Normalization,
    quality: Quality,
    cameras: Vec<Camera>,
}

/// A sensor's weights, and the integration methods of the picture.
struct Camera {
    measure: Arc<Result<SpectralWeights, RenderingError>>,
    plan: Option<Arc<Plan>>,
}

/// Measures; none where nothing is lit, and where samples lie between vertices of different roughness.
pub(super) fn measure(made: &Made<'_>) -> Option<Measured> {
    let geometry = &made.pictures.angles;
    let lit = geometry.samples().len();
    if lit == 0 || made.query.shading.roughness == Roughness::Mesh {
        return None;
    }
    let stride = lit.div_ceil(SAMPLES);
    let bench = Bench::new(made, Arc::new(geometry.thinned(stride)));
    // One thread: times of a sample, not of a machine, and nothing waits for others.
    let pool = ThreadPoolBuilder::new().num_threads(1).build().ok()?;
    let run = |quality: Quality| pool.install(|| bench.shortest(quality));
    let [chosen, exact, regimes] = [made.setup.finish.quality, Quality::Reference, Quality::Regimes].map(run);
    let (chosen, exact, regimes) = (chosen?, exact?, regimes?);
    let peaks: Vec<f64> = made.pictures.images.iter().map(|image| image.as_ref().map_or(0.0, peak)).collect();
    let samples = bench.geometry.samples().len();
    let cost = |run: &Run| Cost {
        sums: run.sums,
        ns: run.seconds * 1e9 / (samples * run.signals.len().max(1)) as f64,
        errors: (0..peaks.len()).map(|i| errors(&run.signals[i], &exact.signals[i], peaks[i])).collect(),
    };
    Some(Measured { stride, samples, chosen: cost(&chosen), exact: cost(&exact), regimes: cost(&regimes) })
}

impl Bench {
    fn new(made: &Made<'_>, geometry: Arc<GeometryImage>) -> Self {
        let shading = made.scene.results.ask(&made.query.shading);
        let cameras = made.query.sources.iter().map(|source| {
            let image = made.query.image(source);
            let Some(shading) = (*shading).as_ref() else {
                return Camera { measure: made.scene.results.ask(&image.measure), plan: None };
            };
            let measure = image.measure.in_picture(shading, image.ground(), made.scene.results);
            let own = (*measure).as_ref().ok();
            let plan = own.and_then(|measure| image.plan(shading, measure, made.scene.results).ok());
            Camera { measure, plan }
        });
        let of = &made.query.shading;
        Self { geometry, surface: of.surface, reading: of.reading, quality: of.quality, cameras: cameras.collect() }
    }

    fn shortest(&self, quality: Quality) -> Option<Run> {
        let (run, seconds) = timed(|| self.once(quality));
        let mut run = Run { seconds, ..run? };
        if seconds < BUDGET.seconds[0] {
            let more = take_turns(1, BUDGET, &Stop::NEVER, |_| timed(|| self.once(quality)).1)?;
            run.seconds = seconds.min(more[0].least());
        }
        Some(run)
    }

    /// From angles to all sensors' signals. Finding the methods is not counted: that is done once for any number of samples.
    fn once(&self, quality: Quality) -> Option<Run> {
        let geometry = Arc::clone(&self.geometry);
        let shading = ShadingImage::new(geometry, self.surface, self.reading, quality, &Stop::NEVER)?;
        let image = |camera: &Camera| {
            let measure = (*camera.measure).as_ref().ok()?;
            // The plan of the whole picture: that of fewer samples may be another.
            let made = (quality == self.quality).then(|| camera.plan.clone()).flatten();
            let plan = made.unwrap_or_else(|| Arc::new(Plan::fixed(measure, quality)));
            CameraImage::new(&shading, measure, plan, &Stop::NEVER)
        };
        let images: Vec<CameraImage> = self.cameras.iter().map(image).collect::<Option<_>>()?;
        let signals = images.iter().map(|image| image.signals().to_vec()).collect();
        Some(Run {
            sums: images.iter().map(|image| sums(&shading, image.plan())).max().unwrap_or(0),
            signals,
            seconds: 0.0,
        })
    }
}

fn sums(shading: &ShadingImage, plan: &Plan) -> u64 {
    let spectral = shading.shades().iter().filter(|shade| shade.kind == DiffuseKind::Spectral);
    spectral.filter(|shade| plan.method(shade.kappa, shade.beta).node_count() > 0).count() as u64
}

/// The largest signal of a picture; 0 for a black one.
pub(super) fn peak(image: &CameraImage) -> f64 {
    f64::from(image.signals().iter().flatten().fold(0.0_f32, |largest, value| largest.max(value.abs())))
}

fn errors(signals: &[[f32; 3]], exact: &[[f32; 3]], peak: f64) -> Option<Errors> {
    let pairs = signals.as_flattened().iter().zip(exact.as_flattened());
    let shares = pairs.map(|(a, b)| (f64::from(*a) - f64::from(*b)).abs() / peak);
    let (max, squares) = shares.fold((0.0_f64, 0.0), |(max, sum), share| (max.max(share), sum + share * share));
    let rms = (squares / exact.as_flattened().len().max(1) as f64).sqrt();
    (peak > 0.0).then_some(Errors { max, rms })
}
