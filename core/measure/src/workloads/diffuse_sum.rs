//! The diffuse sum S(g, b): term by term, by the paper's three cases, by the program's uniform method.

use super::timing::{Bench, Case, Room, each, spaced};
use super::{Numbers, exact};
use crate::workload::{ErrorScale, Errors, Workload};
use chromascope_core::reflectance::{Precision, diffuse_sum, diffuse_sum_by_regimes};
use chromascope_math::double::Double;
use rayon::prelude::*;

pub(super) fn run(bench: &mut Bench<'_>) {
    let cases = [
        ("g from 0.001 to 1", 1e-3, 1.0),
        ("g from 1 to 60", 1.0, 60.0),
        ("g from 60 to 600", 60.0, 600.0),
        // Log-uniform arguments, as in a scene of all roughnesses.
        ("g from 0.001 to 600", 1e-3, 600.0),
    ];
    for (name, low, high) in cases {
        one(bench, name, low, high);
    }
}

/// The sum as one would write it down: terms until they no longer count, in doubles. For g below 700, where the first factor is
/// no longer a number of full length.
pub(super) fn term_by_term(g: f64, b: f64) -> f64 {
    let (mut weight, mut sum, mut n) = ((-g).exp(), 0.0, 1.0);
    loop {
        weight *= g / n;
        let term = weight / n * (-b / n).exp();
        sum += term;
        if n * n > g * g + b && term < 1e-17 * sum || n > 1e5 {
            return sum;
        }
        n += 1.0;
    }
}

fn one(bench: &mut Bench<'_>, name: &str, low: f64, high: f64) {
    let items = bench.pick(300, 100_000, 1_000_000);
    let checked = bench.pick(10, 300, 4000);
    let mut numbers = Numbers::new(5);
    let point = |_| {
        let g = numbers.log_between(low, high);
        // β = b/g is the squared slope over that of the surface: beyond 25 nothing is seen.
        (g, g * numbers.between(0.0, 25.0))
    };
    let points: Vec<(f64, f64)> = (0..items).map(point).collect();
    let some: Vec<(f64, f64)> = spaced(items, checked).map(|index| points[index]).collect();
    let exact: Vec<Double> = bench
        .pools
        .on(bench.pools.most(), || some.par_iter().map(|&(g, b)| exact::diffuse_sum(g.into(), b.into())).collect());
    let error = |found: &[f64]| {
        Errors::against(found.iter().zip(&exact))
            .sum_up("S, relative, against the sum in 106 bits", ErrorScale::Relative)
    };
    let room = Room::new(items, &0.0);
    let mut candidates = vec![
        each("term by term", [1, checked], &points, &room, error, |&(g, b)| term_by_term(g, b)),
        each("the paper's cases", [1, checked], &points, &room, error, |&(g, b)| diffuse_sum_by_regimes(g, b)),
    ];
    let precisions = [
        ("uniform, 1e-6", Precision::Coarse),
        ("uniform, 1e-10", Precision::Fine),
        ("uniform, 1e-13", Precision::Full),
    ];
    for (method, precision) in precisions {
        let threads = if precision == Precision::Full { bench.pools.counts() } else { vec![1] };
        for threads in threads {
            let answer = move |&(g, b): &(f64, f64)| diffuse_sum(g, b, precision);
            candidates.push(each(method, [threads, checked], &points, &room, error, answer));
        }
    }
    bench.compare(Case { workload: Workload::DiffuseSum, name, item: "sum" }, candidates);
}
