//! Methods of one kind of work, measured side by side on the same inputs.

use chromascope_core::render::Stop;

use super::stopwatch::medians;
use super::{Family, Point};

/// A way of computing three numbers for each input.
pub(super) struct Method<'a> {
    /// Its name.
    pub(super) name: String,
    /// What kind of method it is.
    pub(super) family: Family,
    /// Seconds that were spent before the first input.
    pub(super) preparation: f64,
    /// The error that was promised.
    pub(super) certified: Option<f64>,
    /// Computes all inputs.
    pub(super) values: Box<dyn Fn() -> Vec<[f64; 3]> + 'a>,
}

/// Time and error of each method against the first, on this thread alone: what an input costs, not what a machine does.
/// `share` is the error at an input: which, the value, the first method's. None if stopped.
pub(super) fn measured(
    methods: &[Method<'_>],
    share: impl Fn(usize, [f64; 3], [f64; 3]) -> f64,
    stop: &Stop,
) -> Option<Vec<Point>> {
    let exact = methods.first().map_or_else(Vec::new, |method| (method.values)());
    let work: Vec<&dyn Fn() -> Vec<[f64; 3]>> = methods.iter().map(|method| &*method.values).collect();
    let seconds = medians(&work, stop)?;
    let count = exact.len().max(1) as f64;
    let point = |(method, seconds): (&Method<'_>, f64)| {
        let (mut max, mut squares) = (0.0_f64, 0.0);
        for (index, (value, exact)) in (method.values)().into_iter().zip(&exact).enumerate() {
            let share = share(index, value, *exact);
            max = max.max(share);
            squares += share * share;
        }
        Point {
            name: method.name.clone(),
            family: method.family,
            seconds: seconds / count,
            preparation: method.preparation,
            max,
            rms: (squares / count).sqrt(),
            certified: method.certified,
        }
    };
    Some(methods.iter().zip(seconds).map(point).collect())
}

/// The points of several sources as one: times are means, errors the worst.
pub(super) fn together(sources: &[Vec<Point>]) -> Vec<Point> {
    let Some(first) = sources.first() else { return Vec::new() };
    let mut all = first.clone();
    for (index, sum) in all.iter_mut().enumerate() {
        let others = sources[1..].iter().filter_map(|points| points.get(index));
        for point in others {
            sum.seconds += point.seconds;
            sum.preparation += point.preparation;
            sum.max = sum.max.max(point.max);
            sum.rms = sum.rms.max(point.rms);
            sum.certified = sum.certified.zip(point.certified).map(|(a, b)| a.max(b));
        }
        sum.seconds /= sources.len() as f64;
        sum.preparation /= sources.len() as f64;
    }
    all
}

/// The largest of three numbers, without their signs.
pub(super) fn largest(values: [f64; 3]) -> f64 {
    values.iter().fold(0.0, |largest, value| largest.max(value.abs()))
}
