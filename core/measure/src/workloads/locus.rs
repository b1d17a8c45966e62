//! Chromaticities of blackbodies: sums of several steps, Gauss rules of several sizes, what the program takes.

use super::timing::{Bench, Candidate, Case, Room, each, spaced};
use super::{CAMERA, CONSTANTS, OBSERVER, exact};
use crate::data::sensor;
use crate::harness::timed;
use crate::loci::{CHECKED_NODES, LocusMethod, gauss_rule, locus_methods};
use crate::workload::{BenchError, ErrorOf, ErrorScale, Errors, Workload};
use chromascope_core::camera::LocusEvaluator;
use chromascope_core::camera::locus_table::{LocusTable, LocusTableError};
use chromascope_core::colorimetry::Xy;
use chromascope_core::colorimetry::rgb::XYZ_FROM_SRGB;
use chromascope_core::light::PlanckianLocus;
use chromascope_core::spectral::{Primaries, Sensor};
use chromascope_core::units::Kelvin;
use chromascope_math::double::Double;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use std::hint::black_box;

type Place = [f64; 2];

pub(super) fn run(bench: &mut Bench<'_>) -> Result<(), BenchError> {
    for (name, path) in [("CIE 1931 2°", OBSERVER), ("Nikon D70 (2007 figure)", CAMERA)] {
        let sensor = sensor(path)?;
        one(bench, name, &sensor);
        let counts: &[usize] = bench.pick(&[10], if path == OBSERVER { &[1, 1000] } else { &[] }, &[1, 100, 10_000]);
        for &count in counts {
            from_nothing(bench, name, &sensor, count);
        }
    }
    Ok(())
}

/// Temperatures evenly in mired, from 1000 to 20 000 K; one alone is in between.
fn temperatures(count: usize) -> Vec<f64> {
    let mired = |index: usize| 1000.0 + (50.0 - 1000.0) * (index as f64 + 0.5) / count as f64;
    (0..count).map(|index| 1e6 / mired(index)).collect()
}

/// Chromaticity of signals: an observer's as they are, a camera's by Eq 13.
#[derive(Clone, Copy)]
struct Diagram {
    gain: DVec3,
    matrix: DMat3,
}

impl Diagram {
    fn new(sensor: &Sensor) -> Self {
        if sensor.primaries() == Primaries::Xyz {
            return Self { gain: DVec3::ONE, matrix: DMat3::IDENTITY };
        }
        Self { gain: 1.0 / DVec3::from_array(sensor.integrals()), matrix: XYZ_FROM_SRGB }
    }

    fn xy(&self, raw: [f64; 3]) -> Place {
        let xyz = self.matrix * (DVec3::from_array(raw) * self.gain);
        let sum = xyz.x + xyz.y + xyz.z;
        [xyz.x / sum, xyz.y / sum]
    }
}

fn one(bench: &mut Bench<'_>, name: &str, sensor: &Sensor) {
    let items = bench.pick(1000, 1_000_000, 1_000_000);
    let checked = bench.pick(5, 60, 500);
    let kelvins = temperatures(items);
    let some: Vec<f64> = spaced(items, checked).map(|index| kelvins[index]).collect();
    let exact: Vec<[Double; 2]> = bench.pools.on(bench.pools.most(), || {
        some.par_iter().map(|&kelvins| exact::black_body_xy(sensor, CONSTANTS, kelvins)).collect()
    });
    let error = |found: &[Place]| error(found, &exact);
    let room = Room::new(items, &[0.0; 2]);
    let diagram = Diagram::new(sensor);
    let temperatures: Vec<Kelvin> = kelvins.iter().filter_map(|&t| Kelvin::new(t).ok()).collect();
    let answers = Room::new(items, &Err(LocusTableError::Outside));
    let sums = LocusEvaluator::by_sum(sensor, CONSTANTS);
    let summed = |t: Kelvin| {
        let [x, y] = diagram.xy(sums.raw(t));
        Some(Xy { x, y })
    };
    let table = LocusTable::of(summed);
    let mut candidates: Vec<Candidate<'_>> = Vec::new();
    for method in methods(sensor, &[2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]) {
        let (made, seconds) = timed(method.make);
        let Ok(made) = made else { continue };
        let answer = move |&t: &f64| Kelvin::new(t).map_or(NOWHERE, |t| diagram.xy((made.raw)(t)));
        let many = if method.name == CHECKED_NODES { bench.pools.counts() } else { vec![1] };
        for threads in many {
            let name = method.name.as_str();
            let answer = answer.clone();
            candidates.push(each(name, [threads, checked], &kelvins, &room, error, answer).built_in(seconds));
        }
    }
    for threads in bench.pools.counts() {
        // Of an observer the program has the whole curve as polynomials.
        let (locus, seconds) = timed(|| bench.pools.on(threads, || PlanckianLocus::new(sensor, CONSTANTS)));
        if let Ok(locus) = locus {
            let answer = move |&t: &f64| {
                let place = Kelvin::new(t).ok().and_then(|t| locus.at(t));
                place.map_or(NOWHERE, |uv| {
                    let d = 2.0 * uv.u - 8.0 * uv.v + 4.0;
                    [3.0 * uv.u / d, 2.0 * uv.v / d]
                })
            };
            candidates.push(each("polynomials", [threads, checked], &kelvins, &room, error, answer).built_in(seconds));
        }
    }
    for threads in bench.pools.counts() {
        let some: Vec<Kelvin> = spaced(items, checked).map(|index| temperatures[index]).collect();
        let found: Vec<Place> = table.xys(&some).into_iter().map(|xy| xy.map_or(NOWHERE, |xy| [xy.x, xy.y])).collect();
        let (_, seconds) = timed(|| bench.pools.on(threads, || LocusTable::of(summed)));
        let (table, temperatures, answers) = (&table, &temperatures, &answers);
        let work =
            move |items: usize| answers.lend(|answers| table.xys_into(&temperatures[..items], &mut answers[..items]));
        let candidate = Candidate::new("table in mired", items, error(&found), work);
        candidates.push(candidate.on(threads).built_in(seconds));
    }
    bench.compare(Case { workload: Workload::Locus, name, item: "temperature" }, candidates);
}

/// The methods that there are, and the Gauss rules of some sizes.
fn methods<'a>(sensor: &'a Sensor, gauss: &[usize]) -> Vec<LocusMethod<'a>> {
    let mut methods = locus_methods(sensor, CONSTANTS);
    methods.extend(gauss.iter().map(|&count| gauss_rule(sensor, CONSTANTS, count)));
    methods
}

/// A few temperatures of a sensor that nothing is known of: what is made first counts.
fn from_nothing(bench: &mut Bench<'_>, name: &str, sensor: &Sensor, count: usize) {
    let kelvins = temperatures(count);
    let checked = bench.pick(5, 60, 500);
    let some: Vec<f64> = spaced(count, checked).map(|index| kelvins[index]).collect();
    let exact: Vec<[Double; 2]> = bench.pools.on(bench.pools.most(), || {
        some.par_iter().map(|&kelvins| exact::black_body_xy(sensor, CONSTANTS, kelvins)).collect()
    });
    let diagram = Diagram::new(sensor);
    let table = move |kelvins: &[f64]| -> Vec<Place> {
        let sums = LocusEvaluator::by_sum(sensor, CONSTANTS);
        let table = LocusTable::of(|t| {
            let [x, y] = diagram.xy(sums.raw(t));
            Some(Xy { x, y })
        });
        let found = kelvins.iter().map(|&t| Kelvin::new(t).ok().and_then(|t| table.xy(t).ok()));
        found.map(|xy| xy.map_or(NOWHERE, |xy| [xy.x, xy.y])).collect()
    };
    let mut methods: Vec<(String, Box<Method<'_>>)> = Vec::new();
    for method in self::methods(sensor, &[3, 5, 8, 12]) {
        let answers = move |kelvins: &[f64]| -> Vec<Place> {
            let Ok(made) = (method.make)() else { return vec![NOWHERE; kelvins.len()] };
            kelvins.iter().map(|&t| Kelvin::new(t).map_or(NOWHERE, |t| diagram.xy((made.raw)(t)))).collect()
        };
        methods.push((method.name, Box::new(answers)));
    }
    methods.push(("table in mired".to_owned(), Box::new(table)));
    let candidates = methods.into_iter().map(|(method, answers)| {
        let error = error(&answers(&some), &exact);
        let kelvins = &kelvins;
        let work = move |_: usize| {
            black_box(answers(kelvins));
        };
        Candidate::new(method, count, error, work).undivided()
    });
    let case = format!("{name}, {count} from nothing");
    bench.compare(Case { workload: Workload::Locus, name: &case, item: "temperature" }, candidates.collect());
}

/// All answers to some temperatures, with what is made for them.
type Method<'a> = dyn Fn(&[f64]) -> Vec<Place> + Send + Sync + 'a;

/// Stands for a missing answer.
const NOWHERE: Place = [f64::NAN; 2];

fn error(found: &[Place], exact: &[[Double; 2]]) -> ErrorOf {
    let pairs = found.iter().zip(exact).flat_map(|(found, exact)| found.iter().zip(exact));
    Errors::against(pairs).sum_up("x and y, against the 1 nm sum in 106 bits", ErrorScale::Absolute)
}
