//! Color differences of many pairs.

use chromascope_core::colorimetry::Lab;
use chromascope_core::colorimetry::difference::{delta_e_1976, delta_e_2000, delta_e_2000_into};
use chromascope_math::double::Double;
use rayon::prelude::*;

use super::Numbers;
use super::exact;
use super::timing::{Bench, Candidate, Case, Room, each, spaced};
use crate::measurement::Errors;
use crate::{ErrorScale, Workload};

pub(super) fn run(bench: &mut Bench<'_>) {
    let items = bench.pick(300, 1_000_000, 1_000_000);
    let checked = bench.pick(20, 2000, 20_000);
    let mut numbers = Numbers::new(8);
    // Colors of surfaces, and others near them.
    let pairs: Vec<[Lab; 2]> = (0..items)
        .map(|_| {
            let first = [numbers.between(2.0, 98.0), numbers.between(-80.0, 80.0), numbers.between(-80.0, 80.0)];
            let second = first.map(|value| value + numbers.between(-5.0, 5.0));
            [first, second].map(|[l, a, b]| Lab { l, a, b })
        })
        .collect();
    let some: Vec<[Lab; 2]> = spaced(items, checked).map(|index| pairs[index]).collect();
    let exact: Vec<Double> = bench.pools.on(bench.pools.most(), || {
        some.par_iter().map(|&[first, second]| exact::delta_e_2000(first, second)).collect()
    });
    let error = |found: &[f64]| {
        Errors::against(found.iter().zip(&exact))
            .sum_up("\u{394}E*00, against its definition in 106 bits", ErrorScale::Absolute)
    };
    let room = Room::new(items, &0.0);
    let [firsts, seconds] = [0, 1].map(|k: usize| pairs.iter().map(|pair| pair[k]).collect::<Vec<Lab>>());
    let [some_firsts, some_seconds] = [0, 1].map(|k: usize| some.iter().map(|pair| pair[k]).collect::<Vec<Lab>>());
    let mut found = vec![0.0; some.len()];
    delta_e_2000_into(&some_firsts, &some_seconds, &mut found);
    let mut candidates = vec![each("pair by pair", [1, checked], &pairs, &room, error, |&[a, b]| delta_e_2000(a, b))];
    candidates.push(each("\u{394}E*ab in its place", [1, checked], &pairs, &room, error, |&[a, b]| delta_e_1976(a, b)));
    for threads in bench.pools.counts().into_iter().skip(1) {
        let answer = |&[a, b]: &[Lab; 2]| delta_e_2000(a, b);
        candidates.push(each("pair by pair", [threads, checked], &pairs, &room, error, answer));
    }
    for threads in bench.pools.counts() {
        let (firsts, seconds, room) = (&firsts, &seconds, &room);
        let work = move |items: usize| {
            room.lend(|answers| delta_e_2000_into(&firsts[..items], &seconds[..items], &mut answers[..items]));
        };
        candidates.push(Candidate::new("side by side", items, error(&found), work).on(threads));
    }
    bench.compare(Case { workload: Workload::Difference, name: "a million pairs", item: "pair" }, candidates);
}
