//! Workloads, the effort spent on them, and one method's time and error on one case of them.

use crate::data::DataError;
use crate::machine::Machine;
use chromascope_text::choices;
use serde::{Deserialize, Serialize};

choices! {
    /// A kind of computation that is measured, in the order of the pipeline's queries. Its key is the name of its files, too.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Workload {
        /// Chromaticities of blackbodies, 1000 to 20 000 K.
        Locus = "locus", "Chromaticities of blackbodies, 1000 to 20 000 K", "";
        /// Responses of reflectances through sensitivities.
        Responses = "responses", "Responses of reflectances through sensitivities", "";
        /// The diffuse sum S(g, b) of Eq 2.
        DiffuseSum = "diffuse-sum", "The diffuse sum S(g, b)", "";
        /// The spectral integral of a pixel, three channels.
        Integral = "integral", "The spectral integral of a pixel", "";
        /// Frames of the head through four sources.
        Frames = "frames", "Frames of the head through four sources", "";
        /// Correlated color temperature and Duv.
        Temperature = "temperature", "Correlated color temperature and Duv", "";
    }
}

/// Thoroughness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Effort {
    /// Few items and few rounds, for tests.
    Trial,
    /// A minute for all workloads on four cores.
    #[default]
    Quick,
    /// A quarter of an hour.
    Full,
}

/// A step of a run.
#[derive(Clone, Copy, Debug)]
pub enum Progress<'a> {
    /// The machine's limits are known.
    Machine(&'a Machine),
    /// A workload begins.
    Begins(Workload),
    /// A method was measured.
    Measured(&'a Measurement),
}

/// A benchmark that cannot run.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum BenchError {
    #[error("no threads to measure on: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    #[error(transparent)]
    Data(#[from] DataError),
}

/// One method on one case of a workload: how long it takes and how far off it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// The workload.
    pub workload: Workload,
    /// Its inputs, such as `CIE 1931 2°`. Methods are comparable within a case.
    pub case: String,
    /// The method.
    pub method: String,
    /// Number of threads it ran on.
    pub threads: usize,
    /// Name of an item, such as `temperature`.
    pub item: String,
    /// Number of items in each round.
    pub items: usize,
    /// Number of rounds.
    pub rounds: usize,
    /// The median time per item in seconds.
    pub seconds_per_item: f64,
    /// The shortest time per item in seconds: the one that other work on the machine disturbed least.
    pub least_seconds_per_item: f64,
    /// The distance between the quartiles of the times, relative to the median.
    pub spread: f64,
    /// Seconds of preparation before the first item.
    pub build_seconds: f64,
    /// Error of the results.
    pub error: ErrorOf,
    /// The method that times are compared with: the first of the case.
    pub baseline: String,
    /// The time relative to the baseline's: the median of the ratios within each round.
    pub ratio: f64,
    /// Shares of this machine's limits, where it is known what has to be moved and computed.
    pub roof: Option<Roof>,
}

/// Error of results, on those items that the reference was computed for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorOf {
    /// The quantity, its unit and the reference.
    pub what: String,
    /// The one of the two errors that the workload is about: it goes onto the figure's axis.
    pub scale: ErrorScale,
    /// The largest difference.
    pub max_abs: f64,
    /// The root of the mean square of the differences.
    pub rms_abs: f64,
    /// The largest difference relative to the reference, or to its scale if `what` says so.
    pub max_rel: f64,
    /// The root of the mean square of the relative differences.
    pub rms_rel: f64,
    /// Number of numbers compared.
    pub checked: usize,
    /// Number of the items checked that the method refused to answer; they count in no error.
    pub refused: usize,
}

/// The kind of error that a workload is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ErrorScale {
    /// The difference itself.
    Absolute,
    /// Relative to the reference or its scale.
    Relative,
}

/// Nearness of a method to the limits that [`crate::Machine`] was found to have, with as many threads. 1 is the limit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Roof {
    /// Bytes per second over those that a sum over a large array reads.
    pub memory: f64,
    /// Operations per second over those of multiply-adds of doubles in registers; operations on singles count half.
    pub arithmetic: f64,
}

impl ErrorOf {
    /// The largest error, in the scale that the workload is about.
    pub fn max(&self) -> f64 {
        match self.scale {
            ErrorScale::Absolute => self.max_abs,
            ErrorScale::Relative => self.max_rel,
        }
    }

    /// The root of the mean square, in the same scale.
    pub fn rms(&self) -> f64 {
        match self.scale {
            ErrorScale::Absolute => self.rms_abs,
            ErrorScale::Relative => self.rms_rel,
        }
    }
}

#[cfg(feature = "workloads")]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Errors {
    max: [f64; 2],
    squares: [f64; 2],
    checked: usize,
    refused: usize,
}

#[cfg(feature = "workloads")]
impl Errors {
    /// Adds a difference and the number that it is relative to. NaN and infinities count as refused.
    pub(crate) fn add(&mut self, difference: f64, scale: f64) {
        let relative = if difference == 0.0 { 0.0 } else { difference / scale };
        if !(difference.is_finite() && relative.is_finite()) {
            self.refused += 1;
            return;
        }
        for (k, value) in [difference, relative].into_iter().enumerate() {
            self.max[k] = self.max[k].max(value.abs());
            self.squares[k] += value * value;
        }
        self.checked += 1;
    }

    /// Differences of answers from exact ones, and relative to these.
    pub(crate) fn against<'a>(pairs: impl Iterator<Item = (&'a f64, &'a chromascope_math::double::Double)>) -> Self {
        let mut errors = Self::default();
        pairs.for_each(|(&found, exact)| errors.add(exact.error_of(found), exact.value()));
        errors
    }

    pub(crate) fn sum_up(self, what: &str, scale: ErrorScale) -> ErrorOf {
        let [rms_abs, rms_rel] = self.squares.map(|sum| (sum / self.checked.max(1) as f64).sqrt());
        let [max_abs, max_rel] = self.max;
        let (checked, refused) = (self.checked, self.refused);
        ErrorOf { what: what.to_owned(), scale, max_abs, rms_abs, max_rel, rms_rel, checked, refused }
    }
}
