//! Timing of alternating candidates by their median.

use crate::harness::{Budget, Times, take_turns, timed};
use crate::machine::Machine;
use crate::workload::{Effort, ErrorOf, Measurement, Progress, Roof, Workload};
use chromascope_core::render::Stop;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::hint::black_box;
use std::iter::successors;
use std::sync::{Mutex, PoisonError};

/// Pools of one, two, four, … threads, up to all that the machine runs at a time.
pub(crate) struct Pools(Vec<(usize, ThreadPool)>);

impl Pools {
    pub(crate) fn new() -> Result<Self, ThreadPoolBuildError> {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let mut counts: Vec<usize> =
            successors(Some(1), |count| Some(2 * count)).take_while(|&count| count < cores).collect();
        counts.push(cores);
        let pool = |threads: usize| Ok((threads, ThreadPoolBuilder::new().num_threads(threads).build()?));
        Ok(Self(counts.into_iter().map(pool).collect::<Result<_, ThreadPoolBuildError>>()?))
    }

    /// The numbers of threads there are, ascending.
    pub(crate) fn counts(&self) -> Vec<usize> {
        self.0.iter().map(|(threads, _)| *threads).collect()
    }

    pub(crate) fn most(&self) -> usize {
        self.0.last().map_or(1, |(threads, _)| *threads)
    }

    pub(crate) fn on<T: Send>(&self, threads: usize, work: impl FnOnce() -> T + Send) -> T {
        match self.0.iter().find(|(count, _)| *count == threads) {
            Some((_, pool)) => pool.install(work),
            None => work(),
        }
    }
}

/// Bytes moved and operations of an item at the least, for a comparison with the machine's limits.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cost {
    pub(super) bytes: f64,
    pub(super) flops: f64,
}

pub(super) struct Candidate<'a> {
    method: String,
    threads: usize,
    items: usize,
    least: usize,
    build_seconds: f64,
    error: ErrorOf,
    cost: Option<Cost>,
    work: Box<dyn FnMut(usize) + Send + 'a>,
}

impl<'a> Candidate<'a> {
    /// A method on one thread. `work` does the first n of up to `items`.
    pub(super) fn new(
        method: impl Into<String>,
        items: usize,
        error: ErrorOf,
        work: impl FnMut(usize) + Send + 'a,
    ) -> Self {
        Self {
            method: method.into(),
            threads: 1,
            items,
            least: 1,
            build_seconds: 0.0,
            error,
            cost: None,
            work: Box::new(work),
        }
    }

    pub(super) fn on(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// Candidate that can only do all of its items at a time.
    pub(super) fn undivided(self) -> Self {
        Self { least: self.items, ..self }
    }

    /// Candidate with no fewer items at a time: more than caches hold.
    pub(super) fn at_least(self, items: usize) -> Self {
        Self { least: items.min(self.items), ..self }
    }

    pub(super) fn built_in(self, build_seconds: f64) -> Self {
        Self { build_seconds, ..self }
    }

    pub(super) fn costing(self, cost: Cost) -> Self {
        Self { cost: Some(cost), ..self }
    }

    fn seconds(&mut self, pools: &Pools, batch: Batch) -> f64 {
        let work = &mut self.work;
        pools.on(self.threads, || timed(|| (0..batch.repeats).for_each(|_| work(batch.items))).1)
    }

    /// Numbers of items and repetitions that take about as long as wanted. This also warms up.
    fn batch(&mut self, pools: &Pools, target: f64) -> Batch {
        let mut items = self.items.min(64).max(self.least);
        loop {
            let taken = self.seconds(pools, Batch { items, repeats: 1 });
            if taken >= target / 8.0 || items == self.items {
                let wanted = items as f64 * (target / taken.max(1e-9));
                let most = (wanted as usize).clamp(self.least, self.items);
                let repeats = (wanted / self.items as f64).round().clamp(1.0, 1e6) as usize;
                return Batch { items: most, repeats };
            }
            items = (items * 8).min(self.items);
        }
    }
}

#[derive(Clone, Copy)]
struct Batch {
    items: usize,
    repeats: usize,
}

pub(super) struct Bench<'a> {
    pub(super) effort: Effort,
    pub(super) stop: &'a Stop,
    pub(super) pools: Pools,
    pub(super) machine: Machine,
    pub(super) progress: &'a mut dyn FnMut(Progress<'_>),
    pub(super) measurements: Vec<Measurement>,
}

#[derive(Clone, Copy)]
pub(super) struct Case<'a> {
    pub(super) workload: Workload,
    pub(super) name: &'a str,
    pub(super) item: &'a str,
}

impl Bench<'_> {
    /// One of three, by how much time may be taken.
    pub(super) fn pick<T>(&self, trial: T, quick: T, full: T) -> T {
        match self.effort {
            Effort::Trial => trial,
            Effort::Quick => quick,
            Effort::Full => full,
        }
    }

    /// Measures the candidates by turns. The first is the baseline.
    pub(super) fn compare(&mut self, case: Case<'_>, mut candidates: Vec<Candidate<'_>>) {
        let target = self.pick(2e-4, 6e-3, 3e-2);
        let mut batches = Vec::with_capacity(candidates.len());
        for candidate in &mut candidates {
            if self.stop.is_set() {
                return;
            }
            batches.push(candidate.batch(&self.pools, target));
        }
        // Where a round takes long, a few must do.
        let (most, seconds) = self.pick((3, 0.0), (9, 1.5), (31, 25.0));
        let budget = Budget { rounds: [3, most], seconds: [0.0, seconds] };
        let turn = |which: usize| {
            let batch: Batch = batches[which];
            candidates[which].seconds(&self.pools, batch) / (batch.items * batch.repeats) as f64
        };
        let Some(times) = take_turns(batches.len(), budget, self.stop, turn) else { return };
        for (index, candidate) in candidates.iter().enumerate() {
            let measurement = self.measurement(case, candidate, (&times[index], &times[0]), batches[index].items);
            let baseline = candidates[0].method.clone();
            let measurement = Measurement { baseline, ..measurement };
            (self.progress)(Progress::Measured(&measurement));
            self.measurements.push(measurement);
        }
    }

    fn measurement(
        &self,
        case: Case<'_>,
        candidate: &Candidate<'_>,
        (times, base): (&Times, &Times),
        items: usize,
    ) -> Measurement {
        let seconds = times.median();
        Measurement {
            workload: case.workload,
            case: case.name.to_owned(),
            method: candidate.method.clone(),
            threads: candidate.threads,
            item: case.item.to_owned(),
            items,
            rounds: times.rounds(),
            seconds_per_item: seconds,
            least_seconds_per_item: times.least(),
            spread: times.spread(),
            build_seconds: candidate.build_seconds,
            error: candidate.error.clone(),
            baseline: String::new(),
            ratio: times.ratio_to(base),
            roof: candidate.cost.map(|cost| self.roof(cost, candidate.threads, seconds)),
        }
    }

    fn roof(&self, cost: Cost, threads: usize, seconds: f64) -> Roof {
        let [memory, arithmetic] = self.machine.limits(threads);
        Roof { memory: cost.bytes / seconds / memory, arithmetic: cost.flops / seconds / arithmetic }
    }
}

/// Memory for results that the candidates of a case, which take turns, share.
pub(super) struct Room<O>(Mutex<Vec<O>>);

impl<O: Clone + Send> Room<O> {
    pub(super) fn new(items: usize, nothing: &O) -> Self {
        Self(Mutex::new(vec![nothing.clone(); items]))
    }

    pub(super) fn lend<T>(&self, work: impl FnOnce(&mut [O]) -> T) -> T {
        work(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

pub(super) const CHUNK: usize = 512;

/// A candidate that answers item by item, in a plain loop or, on several threads, in pieces of it.
pub(super) fn each<'a, I: Sync, O: Clone + Send>(
    method: impl Into<String>,
    [threads, checked]: [usize; 2],
    inputs: &'a [I],
    room: &'a Room<O>,
    error: impl FnOnce(&[O]) -> ErrorOf,
    answer: impl Fn(&I) -> O + Sync + Send + 'a,
) -> Candidate<'a> {
    let first: Vec<O> = spaced(inputs.len(), checked).map(|index| answer(&inputs[index])).collect();
    let work = move |items: usize| {
        room.lend(|outputs| {
            let (inputs, outputs) = (&inputs[..items], &mut outputs[..items]);
            if threads == 1 {
                outputs.iter_mut().zip(inputs).for_each(|(output, input)| *output = answer(input));
            } else {
                let chunks = outputs.par_chunks_mut(CHUNK).zip(inputs.par_chunks(CHUNK));
                chunks.for_each(|(outputs, inputs)| {
                    outputs.iter_mut().zip(inputs).for_each(|(output, input)| *output = answer(input));
                });
            }
            black_box(outputs);
        });
    };
    Candidate::new(method, inputs.len(), error(&first), work).on(threads)
}

/// The places of some items, evenly among all, the ends included.
pub(super) fn spaced(items: usize, some: usize) -> impl Iterator<Item = usize> {
    let some = some.min(items);
    (0..some).map(move |k| if some < 2 { 0 } else { k * (items - 1) / (some - 1) })
}
