//! Stress tests of every numeric function of the core far beyond the physical range: finite or a typed error, monotone and
//! symmetric where it should be, and within its error bound where there is a second method.
//!
//! A hundred thousand cases in the test command, drawn log-uniformly from a fixed seed. More on demand, with a table of what was found:
//!
//! ```text
//! CHROMASCOPE_STRESS=1e9 CHROMASCOPE_SEED=7 cargo test --release -p chromascope-core --test core stress:: -- --nocapture
//! ```
//! A failing case is simplified as far as possible and printed with its seed; `CHROMASCOPE_WALK=name` tests one function
//! alone.

#![allow(clippy::disallowed_types, reason = "a run on demand says how long a case takes")]

mod color;
mod draw;
mod light;
mod many;
mod math;
mod plan;
mod reflectance;
mod render;
mod scene;
mod spectral;
mod sum;
mod walk;

use rayon::prelude::*;
use walk::{Tally, Walk};

/// Cases of an ordinary run.
const CASES: f64 = 1e5;
const SEED: u64 = 2026;

fn walks() -> Vec<Walk> {
    [
        math::WALKS,
        sum::WALKS,
        reflectance::WALKS,
        light::WALKS,
        color::WALKS,
        spectral::WALKS,
        many::WALKS,
        render::WALKS,
        plan::WALKS,
        scene::WALKS,
    ]
    .concat()
}

fn asked(name: &str) -> Option<String> {
    std::env::var(name).ok().filter(|value| !value.is_empty())
}

#[test]
fn every_numeric_function_holds_far_past_the_physical_range() {
    let cases: f64 = asked("CHROMASCOPE_STRESS").map_or(CASES, |n| n.parse().expect("CHROMASCOPE_STRESS is a number"));
    let seed = asked("CHROMASCOPE_SEED").map_or(SEED, |n| n.parse().expect("CHROMASCOPE_SEED is an integer"));
    let only = asked("CHROMASCOPE_WALK");
    many::ready();
    plan::ready();
    let all = walks();
    let walks: Vec<&Walk> = all.iter().filter(|walk| only.as_deref().is_none_or(|name| walk.name == name)).collect();
    let shares: f64 = walks.iter().map(|walk| walk.share).sum();
    let found: Vec<Tally> =
        walks.par_iter().map(|walk| walk.run(seed, ((cases * walk.share / shares).ceil() as u64).max(1))).collect();
    if asked("CHROMASCOPE_STRESS").is_some() {
        print(&walks, &found, seed);
    }
    let failures: Vec<String> =
        walks.iter().zip(&found).filter_map(|(walk, tally)| walk.failure(tally, seed)).collect();
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

#[allow(clippy::print_stdout, reason = "the table is what a run on demand is for")]
fn print(walks: &[&Walk], found: &[Tally], seed: u64) {
    println!("seed {seed}\n");
    println!("| function | cases | refused | subnormal | worst error | promise | worst at |");
    println!("|---|---:|---:|---:|---:|---:|---|");
    let mut total = 0;
    for (walk, tally) in walks.iter().zip(found) {
        total += tally.cases;
        let promised = |v: f64| if walk.promise > 0.0 { format!("{v:.1e}") } else { String::from("–") };
        let place = if walk.promise > 0.0 { walk.shown(&tally.at) } else { String::new() };
        println!(
            "| {} | {} | {} | {} | {} | {} | {place} |",
            walk.name,
            tally.cases,
            tally.refused,
            tally.subnormal,
            promised(tally.worst),
            promised(walk.promise),
        );
    }
    println!("\n{total} cases");
}
