//! How exact the chosen quality is and what it costs, beside the sum over all wavelengths, on the samples of this very picture.

use std::sync::Arc;
use std::time::{Duration, Instant};

use chromascope_core::camera::RenderingError;
use chromascope_core::query::Ask as _;
use chromascope_core::query::render::{DiffuseTableQuery, PlanQuery, Roughness, SpectralWeightsQuery};
use chromascope_core::reflectance::{Reading, Surface};
use chromascope_core::render::mirror::Reach;
use chromascope_core::render::{
    Against, CameraImage, DiffuseTable, GeometryImage, Plan, Quality, ShadingImage, SpectralWeights, Stop,
};
use rayon::ThreadPoolBuilder;

use super::Made;

/// At most this many lit samples are measured on.
const SAMPLES: usize = 2000;
/// Short work is repeated for so long, and the shortest taken.
const AT_LEAST: Duration = Duration::from_millis(20);

/// What was measured.
pub(super) struct Measured {
    /// Each how many of the lit samples were taken.
    pub(super) stride: usize,
    /// How many they are.
    pub(super) samples: usize,
    /// The chosen quality.
    pub(super) chosen: Cost,
    /// The plain sum over all wavelengths.
    pub(super) exact: Cost,
    /// The paper's three cases of g.
    pub(super) regimes: Cost,
}

/// What a way of integrating costs.
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
    time: Duration,
}

/// Inputs of a measurement. All data are computed beforehand, so that no query runs while a stopwatch runs.
struct Bench {
    geometry: Arc<GeometryImage>,
    surface: Surface,
    reading: Reading,
    cameras: Vec<Camera>,
}

/// A sensor's weights, and its table where the picture takes one.
struct Camera {
    measure: Arc<Result<SpectralWeights, RenderingError>>,
    table: Option<Arc<Result<DiffuseTable, RenderingError>>>,
    /// What a tolerance takes.
    planned: Option<(Arc<Result<Plan, RenderingError>>, Reach)>,
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
    let [chosen, exact, regimes] = [made.setup.finish.quality, Quality::Exact, Quality::Regimes].map(run);
    let (chosen, exact, regimes) = (chosen?, exact?, regimes?);
    let peaks: Vec<f64> = made.pictures.images.iter().map(|image| image.as_ref().map_or(0.0, peak)).collect();
    let samples = bench.geometry.samples().len();
    let cost = |run: &Run| Cost {
        sums: run.sums,
        ns: run.time.as_secs_f64() * 1e9 / (samples * run.signals.len().max(1)) as f64,
        errors: (0..peaks.len()).map(|i| errors(&run.signals[i], &exact.signals[i], peaks[i])).collect(),
    };
    Some(Measured { stride, samples, chosen: cost(&chosen), exact: cost(&exact), regimes: cost(&regimes) })
}

impl Bench {
    fn new(made: &Made<'_>, geometry: Arc<GeometryImage>) -> Self {
        let needs_table = made.pictures.shading.table > 0;
        let shading = made.scene.results.ask(&made.query.shading);
        let cameras = made.query.sources.iter().map(|source| {
            let of = made.query.image(&source.rendering).measure;
            let table = needs_table.then(|| made.scene.results.ask(&DiffuseTableQuery(of.clone())));
            let measure = match (*shading).as_ref() {
                Some(shading) => of.in_picture(shading, made.scene.results),
                None => made.scene.results.ask(&of),
            };
            let planned = planned(made, &of, (*measure).as_ref().ok());
            Camera { measure, table, planned }
        });
        let of = &made.query.shading;
        Self { geometry, surface: of.surface, reading: of.reading, cameras: cameras.collect() }
    }

    fn shortest(&self, quality: Quality) -> Option<Run> {
        let start = Instant::now();
        let mut best = self.once(quality)?;
        while start.elapsed() < AT_LEAST {
            best.time = best.time.min(self.once(quality)?.time);
        }
        Some(best)
    }

    /// From angles to all sensors' signals. Making a table is not counted: that is done once for any number of samples.
    fn once(&self, quality: Quality) -> Option<Run> {
        let start = Instant::now();
        let geometry = Arc::clone(&self.geometry);
        let shading = ShadingImage::new(geometry, self.surface, self.reading, quality, &Stop::NEVER)?;
        let image = |camera: &Camera| {
            if let (Quality::Within(_), Some((plan, reach))) = (quality, &camera.planned) {
                let (measure, plan) = ((*camera.measure).as_ref().ok()?, (**plan).as_ref().ok());
                return CameraImage::by_plan(&shading, measure, plan, *reach, &Stop::NEVER);
            }
            let table = camera.table.as_deref().and_then(|table| table.as_ref().ok());
            CameraImage::new(&shading, (*camera.measure).as_ref().ok()?, table, &Stop::NEVER)
        };
        let images: Vec<CameraImage> = self.cameras.iter().map(image).collect::<Option<_>>()?;
        let time = start.elapsed();
        let signals = images.iter().map(|image| image.signals().to_vec()).collect();
        Some(Run { signals, sums: shading.counts().sums, time })
    }
}

/// A sensor's plan for the whole picture, if a tolerance was asked for.
fn planned(
    made: &Made<'_>,
    of: &SpectralWeightsQuery,
    measure: Option<&SpectralWeights>,
) -> Option<(Arc<Result<Plan, RenderingError>>, Reach)> {
    let shading = made.scene.results.ask(&made.query.shading);
    let shading = (*shading).as_ref()?;
    let accuracy = shading.plan_accuracy()?;
    let plan = PlanQuery { measure: of.clone(), accuracy, against: Against::Peak, demand: shading.demand()? };
    Some((made.scene.results.ask(&plan), Reach::in_picture(shading, measure?)))
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
