//! Measured cost and error of each method for the visible scene.
//!
//! A run starts with an empty cache, so that cached answers do not distort its times. It is a [`Job`], not a `Query`: each
//! request measures again.

mod asked;
pub mod bench;
mod conditions;
mod integral;
mod loci;
pub mod plans;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::query::{Ask, Shared};
use chromascope_core::spectral::Sensor;
use chromascope_measure::harness::timed;
use chromascope_measure::method::Point;
use chromascope_measure::{Effort, Report, Workload};
use serde::{Deserialize, Serialize};

use crate::jobs::{Background, Executor, Job};
use crate::results::Results;
pub use conditions::Conditions;
use plans::{PlanAnswer, PlansQuery};

/// Measures the cost of each method for a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneRunJob {
    /// Description of the rendered scene.
    pub scene: String,
    /// The pictures; none where there is nothing to render.
    pub pictures: Option<PicturesQuery>,
    /// The visible sensors.
    pub sensors: Vec<Shared<Sensor>>,
}

/// Measurements of a scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneRun {
    /// Conditions of the measurement.
    #[serde(default)]
    pub conditions: Conditions,
    /// Of each kind of work its methods.
    pub trials: Vec<Trial>,
    /// Total time of the measurement.
    pub time: Duration,
}

/// The methods of one kind of work, side by side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Kind of work.
    pub subject: Subject,
    /// Number of inputs measured on.
    pub inputs: usize,
    /// The methods, the reference first.
    pub points: Vec<Point>,
    /// Index of the method that the current settings select; `None` if it is not in the list.
    #[serde(default)]
    pub set: Option<usize>,
}

/// A kind of work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Subject {
    /// The spectral integral of the rendered samples.
    #[default]
    Integral,
    /// Blackbodies through a sensor.
    Loci,
}

impl Subject {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Integral, Self::Loci];

    /// In words.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Integral => "Integral",
            Self::Loci => "Loci",
        }
    }

    /// Long title.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Integral => "The diffuse spectral integral of the samples that the visible scene renders",
            Self::Loci => "Planckian loci of the visible sensors",
        }
    }

    /// Unit of work that a time refers to.
    pub const fn per(self) -> &'static str {
        match self {
            Self::Integral => "a sample through a sensor",
            Self::Loci => "a temperature through a sensor",
        }
    }

    /// Quantity that an error is relative to.
    pub const fn error_of(self) -> &'static str {
        match self {
            Self::Integral => "of the peak J(κ, 0)",
            Self::Loci => "of the largest signal",
        }
    }
}

impl Job for SceneRunJob {
    type Answer = SceneRun;

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

/// Measures the program on a benchmark workload, independent of the scene.
#[derive(Clone, Debug, PartialEq, Eq)]
struct BenchJob(Workload);

impl Job for BenchJob {
    type Answer = Result<Report, String>;

    fn run(&self, results: &Results) -> Arc<Self::Answer> {
        let Some(bench) = bench::bench() else { return Arc::new(Err("this build has no benchmark".to_owned())) };
        let report = bench(&[self.0], Effort::Quick, &results.stop(), &mut |_| ());
        Arc::new(report.map_err(|error| error.to_string()))
    }
}

/// Latest measurements.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// The last run on the scene.
    pub run: Option<Arc<SceneRun>>,
    /// True if it is of the scene as it is now.
    pub is_current: bool,
    /// The last reports of the bench, or why there is none.
    pub reports: BTreeMap<Workload, Arc<Result<Report, String>>>,
}

/// Background measurements and their latest results.
pub struct Profiler {
    /// Latest measurements.
    pub measured: Measured,
    worker: Background<SceneRunJob>,
    bench: Background<BenchJob>,
    plans: Background<PlansQuery>,
}

impl Profiler {
    /// Starts the worker, which wakes the window when it has measured.
    pub fn new(wake: impl Fn() + Send + Sync + Clone + 'static) -> Self {
        Self::on(&Executor::default(), wake)
    }

    /// Measures on an executor.
    pub fn on(executor: &Executor, wake: impl Fn() + Send + Sync + Clone + 'static) -> Self {
        let (also, third) = (wake.clone(), wake.clone());
        Self {
            measured: Measured::default(),
            worker: Background::on(executor, "scene runs", wake),
            bench: Background::on(executor, "bench", third),
            plans: Background::on(executor, "plans", also),
        }
    }

    /// Begins to make the plans of these pictures' sources.
    pub fn plan(&self, pictures: &PicturesQuery) {
        self.plans.ask(vec![PlansQuery(pictures.clone())]);
    }

    /// The plan of each of these pictures' sources, in their order. Until it is made, the last one that was made for the same
    /// camera, light and material; none while there is a source without one.
    pub fn plans(&self, pictures: &PicturesQuery) -> Option<Vec<PlanAnswer>> {
        let plans = self.plans.shown()?;
        plans.job.plans_for(pictures, &plans.answer)
    }

    /// Measures a scene, again even if it is unchanged.
    pub fn run(&self, scene: SceneRunJob) {
        self.worker.ask_anew(vec![scene]);
    }

    /// Measures a workload of the bench.
    pub fn run_bench(&self, workload: Workload) {
        self.bench.ask_anew(vec![BenchJob(workload)]);
    }

    /// Stops the measurement.
    pub fn stop(&self) {
        self.worker.rest();
        self.bench.rest();
    }

    /// Updates the latest measurements; a run is current if it is of this scene. A report that was stopped is
    /// discarded.
    pub fn refresh(&mut self, scene: &SceneRunJob) {
        if let Some(shown) = self.worker.shown() {
            (self.measured.run, self.measured.is_current) = (Some(shown.answer), shown.job == *scene);
        }
        if let Some(shown) = self.bench.shown() {
            self.measured.reports.insert(shown.job.0, shown.answer);
        }
    }

    /// Running time of the measurement, if it is still running.
    pub fn busy(&self) -> Option<Duration> {
        self.worker.busy().or_else(|| self.bench.busy())
    }

    /// Reason that there is nothing, if measuring failed.
    pub fn failure(&self) -> Option<String> {
        self.worker.failure().or_else(|| self.bench.failure())
    }

    /// Waits for the run. For tests.
    pub fn wait(&self) {
        self.worker.wait();
        self.bench.wait();
        self.plans.wait();
    }
}
