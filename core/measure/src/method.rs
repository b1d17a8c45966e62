//! Methods of one kind of work, measured side by side on the same inputs.

use crate::harness::{Budget, take_turns, timed};
use chromascope_core::render::Stop;
use serde::{Deserialize, Serialize};

/// A method that computes three numbers for each input.
pub struct Method<'a> {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub family: Family,
    /// Seconds that were spent before the first input.
    pub preparation: f64,
    /// Estimated error bound, where there is one.
    pub error_bound: Option<f64>,
    /// Computes all inputs.
    pub values: Box<dyn Fn() -> Vec<[f64; 3]> + 'a>,
}

/// A kind of method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Family {
    /// A sum over the grid.
    Sum,
    /// One of the program's qualities.
    Quality,
    /// The fastest that meets a tolerance.
    Tolerance,
}

impl Family {
    /// Name in words.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Sum => "sum over the grid",
            Self::Quality => "a quality of the program",
            Self::Tolerance => "fastest for a tolerance",
        }
    }
}

/// Time and error of a method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The method.
    pub name: String,
    /// Kind of method.
    pub family: Family,
    /// Seconds for one input and sensor, on one thread: the median of rounds in which the methods take turns.
    pub seconds: f64,
    /// Seconds that were spent before the first input, for one sensor.
    pub preparation: f64,
    /// The largest error.
    pub max: f64,
    /// The root of the errors' mean square.
    pub rms: f64,
    /// Estimated error bound, where a tolerance was requested.
    #[serde(alias = "certified")]
    pub error_bound: Option<f64>,
}

/// Time and error of each method against the first, on this thread alone: the cost of an input, not the power of a machine.
/// `share` is the error at an input: its index, the value, the first method's. None if stopped.
pub fn compare(
    methods: &[Method<'_>],
    share: impl Fn(usize, [f64; 3], [f64; 3]) -> f64,
    stop: &Stop,
) -> Option<Vec<Point>> {
    let exact = methods.first().map_or_else(Vec::new, |method| (method.values)());
    let times = take_turns(methods.len(), Budget::INTERACTIVE, stop, |which| timed(&methods[which].values).1)?;
    let count = exact.len().max(1) as f64;
    let point = |(method, times): (&Method<'_>, crate::harness::Times)| {
        let shares = (method.values)().into_iter().zip(&exact).enumerate();
        let (max, squares) = shares
            .map(|(index, (value, exact))| share(index, value, *exact))
            .fold((0.0_f64, 0.0), |(max, squares), share| (max.max(share), squares + share * share));
        Point {
            name: method.name.clone(),
            family: method.family,
            seconds: times.median() / count,
            preparation: method.preparation,
            max,
            rms: (squares / count).sqrt(),
            error_bound: method.error_bound,
        }
    };
    Some(methods.iter().zip(times).map(point).collect())
}

/// The points of several sensors as one: times are means, errors the worst.
pub fn together(sensors: &[Vec<Point>]) -> Vec<Point> {
    let Some(first) = sensors.first() else { return Vec::new() };
    let mut all = first.clone();
    for (index, sum) in all.iter_mut().enumerate() {
        for point in sensors[1..].iter().filter_map(|points| points.get(index)) {
            sum.seconds += point.seconds;
            sum.preparation += point.preparation;
            sum.max = sum.max.max(point.max);
            sum.rms = sum.rms.max(point.rms);
            sum.error_bound = sum.error_bound.zip(point.error_bound).map(|(a, b)| a.max(b));
        }
        sum.seconds /= sensors.len() as f64;
        sum.preparation /= sensors.len() as f64;
    }
    all
}

/// The largest of three magnitudes.
pub fn largest(values: [f64; 3]) -> f64 {
    values.iter().fold(0.0, |largest, value| largest.max(value.abs()))
}
