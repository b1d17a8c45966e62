//! What the scene on show costs by each method, with its error, and what was left out of it: measured, not estimated.
//!
//! A run computes with answers of its own, so that nothing remembered makes it look cheap. It is a question like any other,
//! except that asking again measures again: [`SceneRunQuery::run`] tells runs apart.

mod asked;
pub mod bench;
mod conditions;
mod integral;
mod loci;
pub mod plans;
mod skipped_work;

use std::time::Duration;

use chromascope_core::query::render::picture::{PicturesQuery, SourceOf};
use chromascope_core::query::{Ask, LocusQuery, PatchColorsQuery, Query, Shared};
use chromascope_core::spectral::Sensor;
use chromascope_measure::harness::timed;
use chromascope_measure::method::Point;
use chromascope_measure::{Effort, Report, Workload};
use serde::{Deserialize, Serialize};

use crate::jobs::{Background, Executor};
use crate::results::Results;
pub use conditions::Conditions;
use plans::{PlanAnswer, PlansQuery};
pub use skipped_work::{LOCI, PATCHES, SkippedWork};

/// What does the scene cost by each method, and what was left out?
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SceneRunQuery {
    /// What is rendered, in words.
    pub scene: String,
    /// The pictures; none where there is nothing to render.
    pub pictures: Option<PicturesQuery>,
    /// The sources that are not on show.
    pub hidden: Vec<SourceOf>,
    /// The sensors on show.
    pub sensors: Vec<Shared<Sensor>>,
    /// The loci of the diagram.
    pub loci: Vec<LocusQuery>,
    /// The patches of the diagram and the swatches.
    pub patches: Vec<PatchColorsQuery>,
    /// Tells runs of the same scene apart.
    pub run: u64,
}

/// What was measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneRun {
    /// What it was of, and on what.
    #[serde(default)]
    pub conditions: Conditions,
    /// Of each kind of work its methods.
    pub trials: Vec<Trial>,
    /// What was not computed.
    #[serde(alias = "left_out")]
    pub skipped_work: Vec<SkippedWork>,
    /// How long measuring took.
    pub time: Duration,
}

/// The methods of one kind of work, side by side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// What is computed.
    pub subject: Subject,
    /// Number of inputs measured on.
    pub inputs: usize,
    /// The methods, the reference first.
    pub points: Vec<Point>,
    /// Which of them pictures take as things are set; none if it is not among them.
    #[serde(default)]
    pub set: Option<usize>,
}

/// A kind of work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Subject {
    /// The spectral integral of the rendered samples.
    #[default]
    Integral,
    /// Black bodies through a sensor.
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

    /// The same, said at length.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Integral => "The diffuse spectral integral of the samples that the visible scene renders",
            Self::Loci => "Planckian loci of the visible sensors",
        }
    }

    /// What a time is the time of.
    pub const fn per(self) -> &'static str {
        match self {
            Self::Integral => "a sample through a sensor",
            Self::Loci => "a temperature through a sensor",
        }
    }

    /// What an error is relative to.
    pub const fn error_of(self) -> &'static str {
        match self {
            Self::Integral => "of the peak J(κ, 0)",
            Self::Loci => "of the largest signal",
        }
    }
}

impl Query for SceneRunQuery {
    type Answer = SceneRun;
    const NAME: &'static str = "scene run";
    const KEPT: usize = 1;

    fn answer(&self, ask: &impl Ask) -> SceneRun {
        let (conditions, ask) = (Conditions::now(self), &fresh(ask));
        let ((trials, skipped_work), seconds) = timed(|| {
            let trials = [integral::trial(self, ask), loci::trial(self, ask)].into_iter().flatten().collect();
            (trials, skipped_work::rows(self, ask))
        });
        SceneRun { conditions, trials, skipped_work, time: Duration::from_secs_f64(seconds) }
    }
}

/// Answers of their own: whoever asks remembers those of runs before, whose times would be those of looking them up.
fn fresh(ask: &impl Ask) -> Results {
    let results = Results::bounded();
    results.stop_at(ask.stop());
    results
}

/// What does the program cost on a workload of its own, whatever the scene?
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct BenchQuery {
    workload: Workload,
    run: u64,
}

impl Query for BenchQuery {
    type Answer = Result<Report, String>;
    const NAME: &'static str = "bench";
    const KEPT: usize = 1;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let Some(bench) = bench::bench() else { return Err("this build has no benchmark".to_owned()) };
        bench(&[self.workload], Effort::Quick, &ask.stop(), &mut |_| ()).map_err(|error| error.to_string())
    }
}

/// Where runs are made, and the last ones.
pub struct Profiler {
    worker: Background<SceneRunQuery>,
    bench: Background<BenchQuery>,
    plans: Background<PlansQuery>,
    runs: u64,
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
            worker: Background::on(executor, "scene runs", wake),
            bench: Background::on(executor, "bench", third),
            plans: Background::on(executor, "plans", also),
            runs: 0,
        }
    }

    /// The plan of each of these pictures' sources, in their order. Until it is made, the last one that was made for the same
    /// camera, light and material; none while there is a source without one.
    pub fn plans(&self, pictures: &PicturesQuery) -> Option<Vec<PlanAnswer>> {
        self.plans.ask(vec![PlansQuery(pictures.clone())]);
        let (of, plans) = self.plans.answered()?;
        of.plans_for(pictures, &plans)
    }

    /// Measures a scene, anew even if it is the same.
    pub fn run(&mut self, scene: SceneRunQuery) {
        self.runs += 1;
        self.worker.ask(vec![SceneRunQuery { run: self.runs, ..scene }]);
    }

    /// Measures a workload of the bench.
    pub fn run_bench(&mut self, workload: Workload) {
        self.runs += 1;
        self.bench.ask(vec![BenchQuery { workload, run: self.runs }]);
    }

    /// The last report of the bench, or why there is none. One that was stopped is not kept.
    pub fn report(&self) -> Option<(Workload, std::sync::Arc<Result<Report, String>>)> {
        let (of, report) = self.bench.answered()?;
        Some((of.workload, report))
    }

    /// Gives up what is being measured.
    pub fn stop(&mut self) {
        self.worker.rest();
        self.bench.rest();
    }

    /// The last run, and whether it is of this scene.
    pub fn shown(&self, scene: &SceneRunQuery) -> Option<(std::sync::Arc<SceneRun>, bool)> {
        let (of, run) = self.worker.answered()?;
        let same = SceneRunQuery { run: of.run, ..scene.clone() } == of;
        Some((run, same))
    }

    /// For how long it has been measured, if it still is.
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
