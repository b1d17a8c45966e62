//! Measured cost and error of each method for the visible scene.
//!
//! A run starts with an empty cache, so that cached answers do not distort its times. It is a [`Job`], not a `Query`: each
//! request measures again.

mod conditions;
mod integral;
mod loci;
pub mod plans;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::query::{Ask, Shared};
use chromascope_core::render::{Quality, RasterSize, Shadows, Stop};
use chromascope_core::spectral::Sensor;
use chromascope_measure::harness::timed;
use chromascope_measure::method::Point;
use chromascope_measure::{BenchError, Effort, Progress, Report, Workload};
use chromascope_mesh::Mesh;
use serde::{Deserialize, Serialize};

use crate::jobs::{Job, Later};
use crate::results::Results;
use crate::scene::Scene;
use crate::scene::orbit::Orbit;
use crate::scene::render::Finish;
pub use conditions::Conditions;

/// The pictures that are measured on: as large as a pane's, whatever the window's size.
const WIDTH: u32 = 480;
const HEIGHT: u32 = 360;

/// Measures the cost of each method for a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneRunJob {
    pub scene: String,
    /// The pictures; none where there is nothing to render.
    pub pictures: Option<PicturesQuery>,
    pub sensors: Vec<Shared<Sensor>>,
}

impl SceneRunJob {
    /// The measurement job of a scene; `own` is a file's mesh, once it was read.
    pub fn of(scene: &Scene<'_>, own: Option<&Shared<Mesh>>, orbit: Option<Orbit>) -> Self {
        let sources = scene.visible_sources();
        Self {
            scene: conditions::words(scene, scene.rendered_sources().len()),
            pictures: Self::pictures_of(scene, own, orbit, scene.document.render.quality()),
            sensors: sources.iter().filter_map(|source| scene.sensor(source.kind, &source.name).ok()).collect(),
        }
    }

    /// The pictures that are measured on, at a quality; none where there is nothing to render.
    pub fn pictures_of(
        scene: &Scene<'_>,
        own: Option<&Shared<Mesh>>,
        orbit: Option<Orbit>,
        quality: Quality,
    ) -> Option<PicturesQuery> {
        let sources = scene.rendered_sources();
        let settings = &scene.document.render;
        let orbit = orbit.unwrap_or_else(|| Orbit::of(settings));
        let viewpoint = orbit.viewpoint(f64::from(WIDTH) / f64::from(HEIGHT))?;
        let size = RasterSize { width: WIDTH, height: HEIGHT, samples: 1 }.clamped();
        let finish = Finish { shadows: Shadows::Full, compared_samples: None, ..Finish::whole(size, quality) };
        if sources.is_empty() {
            return None;
        }
        scene.pictures_of(&sources, scene.mesh_of(own)?, viewpoint, finish, None).ok()
    }
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneRun {
    #[serde(default)]
    pub conditions: Conditions,
    /// Of each kind of work its methods.
    pub trials: Vec<Trial>,
    pub time: Duration,
}

/// The methods of one kind of work, side by side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    pub subject: Subject,
    pub inputs: usize,
    /// The methods, the reference first.
    pub points: Vec<Point>,
    /// Index of the method that the current settings select; `None` if it is not in the list.
    #[serde(default)]
    pub set: Option<usize>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Subject {
    /// The spectral integral of the rendered samples.
    #[default]
    Integral,
    /// Blackbodies through a sensor.
    Loci,
}

impl Subject {
    pub const ALL: [Self; 2] = [Self::Integral, Self::Loci];

    const fn either(self, integral: &'static str, loci: &'static str) -> &'static str {
        match self {
            Self::Integral => integral,
            Self::Loci => loci,
        }
    }

    pub const fn title(self) -> &'static str {
        self.either("Integral", "Loci")
    }

    pub const fn words(self) -> &'static str {
        self.either(
            "The diffuse spectral integral of the samples that the visible scene renders",
            "Planckian loci of the visible sensors",
        )
    }

    /// Unit of work that a time refers to.
    pub const fn per(self) -> &'static str {
        self.either("a sample through a sensor", "a temperature through a sensor")
    }

    /// Quantity that an error is relative to.
    pub const fn error_of(self) -> &'static str {
        self.either("of the peak J(κ, 0)", "of the largest signal")
    }
}

impl Job for SceneRunJob {
    type Answer = SceneRun;
    const NAME: &'static str = "scene runs";

    fn run(&self, results: &Results) -> Arc<SceneRun> {
        let (conditions, ask) = (Conditions::now(self), &fresh(results));
        let (trials, seconds) =
            timed(|| [integral::trial(self, ask), loci::trial(self, ask)].into_iter().flatten().collect());
        Arc::new(SceneRun { conditions, trials, time: Duration::from_secs_f64(seconds) })
    }
}

/// An empty cache: cached answers of earlier runs would be timed as lookups.
fn fresh(ask: &impl Ask) -> Results {
    Results::default().until(ask.stop())
}

/// The benchmark: measures workloads, telling of its progress, until it is done or stopped.
pub type Bench = fn(&[Workload], Effort, &Stop, &mut dyn FnMut(Progress<'_>)) -> Result<Report, BenchError>;

/// The command that runs the program with the benchmark.
pub const BUILD: &str = "cargo run --release --features bench";

#[cfg(feature = "bench")]
pub fn bench() -> Option<Bench> {
    Some(chromascope_measure::run)
}

/// Returns none: this build has no benchmark.
#[cfg(not(feature = "bench"))]
pub fn bench() -> Option<Bench> {
    None
}

/// Measures the program on a benchmark workload, independent of the scene.
#[derive(Clone, Debug, PartialEq, Eq)]
struct BenchJob(Workload);

impl Job for BenchJob {
    type Answer = Result<Report, String>;
    const NAME: &'static str = "bench";

    fn run(&self, results: &Results) -> Arc<Self::Answer> {
        let Some(bench) = bench() else { return Arc::new(Err("this build has no benchmark".to_owned())) };
        let report = bench(&[self.0], Effort::Quick, &results.stop(), &mut |_| ());
        Arc::new(report.map_err(|error| error.to_string()))
    }
}

#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// The last run on the scene.
    pub run: Option<Arc<SceneRun>>,
    /// True if it is of the scene as it is now.
    pub is_current: bool,
    /// The last reports of the bench, or why there is none.
    pub reports: BTreeMap<Workload, Arc<Result<Report, String>>>,
}

/// Measures on request, and holds the latest measurements.
pub struct Profiler {
    pub measured: Measured,
}

impl Profiler {
    /// Measurements are made under one name.
    const PANE: &'static str = "Methods";

    /// Measures a scene, again even if it is unchanged.
    pub fn run(later: &Later, scene: SceneRunJob) {
        later.begin(Self::PANE, vec![scene]);
    }

    /// Measures a workload of the bench.
    pub fn run_bench(later: &Later, workload: Workload) {
        later.begin(Self::PANE, vec![BenchJob(workload)]);
    }

    pub fn stop(later: &Later) {
        later.stop::<SceneRunJob>(Self::PANE);
        later.stop::<BenchJob>(Self::PANE);
    }

    /// Updates the latest measurements; a run is current if it is of this scene. A report that was stopped is
    /// discarded.
    pub fn refresh(&mut self, later: &Later, scene: &SceneRunJob) {
        if let Some(shown) = later.seen::<SceneRunJob>(Self::PANE).shown {
            (self.measured.run, self.measured.is_current) = (Some(shown.answer), shown.job == *scene);
        }
        if let Some(shown) = later.seen::<BenchJob>(Self::PANE).shown {
            self.measured.reports.insert(shown.job.0, shown.answer);
        }
    }

    /// Running time of the measurement, if it is still running.
    pub fn busy(later: &Later) -> Option<Duration> {
        later.seen::<SceneRunJob>(Self::PANE).busy.or_else(|| later.seen::<BenchJob>(Self::PANE).busy)
    }

    /// Reason that there is nothing, if measuring failed.
    pub fn failure(later: &Later) -> Option<String> {
        later.seen::<SceneRunJob>(Self::PANE).failure.or_else(|| later.seen::<BenchJob>(Self::PANE).failure)
    }
}
