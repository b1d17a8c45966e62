//! The diffuse part's spectral integral of a pixel: every wavelength, few wavelengths, tables and moments.

use super::diffuse_sum::term_by_term;
use super::timing::{Bench, CHUNK, Candidate, Case, Room, each, spaced};
use super::{CAMERA, LIGHT, Numbers, REFLECTANCE, exact};
use crate::data::{curve, sensor};
use crate::harness::timed;
use crate::workload::{BenchError, ErrorOf, ErrorScale, Errors, Workload};
use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::rendering::white_divisors;
use chromascope_core::reflectance::{Precision, diffuse_sum};
use chromascope_core::render::diffuse::{ROUGH, by_moments, by_nodes, by_regimes, rough_basis};
use chromascope_core::render::measure::Node;
use chromascope_core::render::{Demand, Plan, SpectralWeights};
use chromascope_core::spectral::Quantity;
use chromascope_math::double::Double;
use chromascope_math::gauss::gauss_rule;
use rayon::prelude::*;
use std::hint::black_box;

/// κ and β.
type Pixel = (f64, f64);
type Signals = [f64; 3];

const TOLERANCES: [f64; 4] = [1e-3, 1e-5, 1e-8, 1e-10];

pub(super) fn run(bench: &mut Bench<'_>) -> Result<(), BenchError> {
    let sensor = sensor(CAMERA)?;
    let light = curve(LIGHT, Quantity::Light)?;
    let reflectance = curve(REFLECTANCE, Quantity::Reflectance)?;
    let Ok(divisors) = white_divisors(&sensor, &light) else { return Ok(()) };
    let (measure, seconds) = timed(|| SpectralWeights::new(&sensor, &light, &reflectance, divisors, 2));
    let cases = [("smooth: κ from 0.001 to 1", 1e-3, 1.0), ("between: κ from 1 to 128", 1.0, ROUGH)];
    for (name, low, high) in cases.into_iter().chain([("rough: κ from 128 to 330", ROUGH, 330.0)]) {
        one(bench, name, [low, high], &measure, seconds);
    }
    Ok(())
}

/// The Gauss rule of each channel's own weights: the scale of g, and the weight.
fn own_rules(measure: &SpectralWeights, count: usize) -> [Vec<(f64, f64)>; 3] {
    let points: Vec<f64> = measure.dense().iter().map(|node| node.wavelength_nm).collect();
    [0, 1, 2].map(|c: usize| {
        let masses: Vec<f64> = measure.dense().iter().map(|node| node.weights[c]).collect();
        let rule = gauss_rule(&points, &masses, count);
        rule.nodes.iter().zip(&rule.weights).map(|(nm, &weight)| ((550.0 / nm).powi(2), weight)).collect()
    })
}

fn by_own_rules(rules: &[Vec<(f64, f64)>; 3], (kappa, beta): Pixel) -> Signals {
    [0, 1, 2].map(|c: usize| {
        let term = |(scale, weight): &(f64, f64)| {
            let g = kappa * scale;
            weight * diffuse_sum(g, beta * g, Precision::Full)
        };
        rules[c].iter().map(term).sum::<f64>()
    })
}

fn by_terms(nodes: &[Node], (kappa, beta): Pixel) -> Signals {
    let mut sums = [0.0; 3];
    for node in nodes {
        let g = kappa * node.scale;
        let value = term_by_term(g, beta * g);
        sums.iter_mut().zip(node.weights).for_each(|(sum, weight)| *sum += weight * value);
    }
    sums
}

fn exactly(nodes: &[Node], (kappa, beta): Pixel) -> [Double; 3] {
    let mut sums = [Double::default(); 3];
    for node in nodes {
        let ratio = Double::new(550.0) / Double::new(node.wavelength_nm);
        let g = Double::new(kappa) * ratio * ratio;
        let value = exact::diffuse_sum(g, Double::new(beta) * g);
        for (sum, weight) in sums.iter_mut().zip(node.weights) {
            *sum = *sum + Double::new(weight) * value;
        }
    }
    sums
}

fn one(bench: &mut Bench<'_>, name: &str, [low, high]: [f64; 2], measure: &SpectralWeights, made: f64) {
    let items = bench.pick(20, 20_000, 200_000);
    let checked = bench.pick(2, 24, 200);
    let mut numbers = Numbers::new(4);
    let pixels: Vec<Pixel> = (0..items).map(|_| (numbers.log_between(low, high), numbers.between(0.0, 20.0))).collect();
    let points: Vec<[f64; 2]> = pixels.iter().map(|&(kappa, beta)| [kappa, beta]).collect();
    let some: Vec<Pixel> = spaced(items, checked).map(|index| pixels[index]).collect();
    // Scale of relative errors: the integral of a pixel that sees the specular direction.
    let exact: Vec<([Double; 3], Signals)> = bench.pools.on(bench.pools.most(), || {
        let scale = |&(kappa, _): &Pixel| by_nodes(measure.dense(), kappa, 0.0, Precision::Full);
        some.par_iter().map(|pixel| (exactly(measure.dense(), *pixel), scale(pixel))).collect()
    });
    let error = |found: &[Signals]| error(found, &exact);
    let room = Room::new(items, &[0.0; 3]);
    let one = [1, checked];
    let dense = measure.dense();
    let mut candidates: Vec<Candidate<'_>> = vec![
        each("401 × term by term", one, &pixels, &room, error, |&pixel| by_terms(dense, pixel)),
        each("401 × the paper's cases", one, &pixels, &room, error, |&(k, b)| by_regimes(dense, k, b)),
    ];
    let precisions = [("1e-6", Precision::Coarse), ("1e-10", Precision::Fine), ("1e-13", Precision::Full)];
    for (digits, precision) in precisions {
        let nodes = [("401", dense), ("15", measure.fine()), ("9", measure.coarse())];
        for (count, nodes) in nodes {
            let answer = move |&(k, b): &Pixel| by_nodes(nodes, k, b, precision);
            let candidate = each(format!("{count} × uniform, {digits}"), one, &pixels, &room, error, answer);
            candidates.push(candidate.built_in(made));
        }
    }
    for count in [3, 5, 7, 9, 12] {
        let (rules, seconds) = timed(|| own_rules(measure, count));
        let answer = move |&pixel: &Pixel| by_own_rules(&rules, pixel);
        candidates
            .push(each(format!("Gauss {count} per channel"), one, &pixels, &room, error, answer).built_in(seconds));
    }
    for threads in bench.pools.counts() {
        let many = [threads, checked];
        if low >= ROUGH {
            let answer = move |&(k, b): &Pixel| by_moments(measure.moments(), &rough_basis(k, b));
            candidates.push(each("eight moments", many, &pixels, &room, error, answer).built_in(made));
        }
    }
    for tolerance in TOLERANCES {
        candidates.extend(plans(bench, tolerance, [low, high], measure, (&points, &some, &room), error));
    }
    bench.compare(Case { workload: Workload::Integral, name, item: "pixel" }, candidates);
}

/// A plan for a tolerance, made and used on each number of threads.
fn plans<'a>(
    bench: &Bench<'_>,
    tolerance: f64,
    kappa: [f64; 2],
    measure: &SpectralWeights,
    (points, some, room): (&'a [[f64; 2]], &[Pixel], &'a Room<Signals>),
    error: impl Fn(&[Signals]) -> ErrorOf,
) -> Vec<Candidate<'a>> {
    let Ok(accuracy) = RelTolerance::new(tolerance) else { return Vec::new() };
    let demand = Demand::new(kappa, points.len() as u64);
    let plan = || timed(|| Plan::new(measure, accuracy, demand));
    let on = |threads| {
        let (Ok(plan), seconds) = bench.pools.on(threads, plan) else { return None };
        let checked: Vec<Signals> = some.iter().map(|&(kappa, beta)| plan.at(kappa, beta)).collect();
        Some(planned(plan, points, room, error(&checked)).on(threads).built_in(seconds))
    };
    bench.pools.counts().into_iter().filter_map(on).collect()
}

/// Evaluates all pixels by a plan, in pieces for several threads.
fn planned<'a>(plan: Plan, points: &'a [[f64; 2]], room: &'a Room<Signals>, error: ErrorOf) -> Candidate<'a> {
    let explanation = plan.explanation();
    let name = format!("plan for {}: {}", explanation.asked, explanation.chosen.method.name());
    let work = move |items: usize| {
        room.lend(|sums| {
            let chunks = sums[..items].par_chunks_mut(CHUNK).zip(points[..items].par_chunks(CHUNK));
            chunks.for_each(|(sums, points)| plan.fill(points, sums));
            black_box(sums);
        });
    };
    Candidate::new(name, points.len(), error, work)
}

fn error(found: &[Signals], exact: &[([Double; 3], Signals)]) -> ErrorOf {
    let mut errors = Errors::default();
    for (found, (exact, scale)) in found.iter().zip(exact) {
        for channel in 0..3 {
            errors.add(exact[channel].error_of(found[channel]), scale[channel]);
        }
    }
    errors.sum_up(
        "three channels, relative to the peak at \u{3b2} = 0, against 401 sums in 106 bits",
        ErrorScale::Relative,
    )
}
