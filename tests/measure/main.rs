//! The benchmark: its references hold 28 digits, every measurement has an error and a place in figures and table.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should say so by failing")]

mod harness;
mod loci;
mod pareto;

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use chromascope_core::light::RadiationConstants;
use chromascope_core::render::Stop;
use chromascope_math::double::Double;
use chromascope_measure::{Effort, Progress, Report, Workload, exact, run};

/// A decimal number with all its digits.
fn decimal(text: &str) -> Double {
    let (digits, sign) = text.strip_prefix('-').map_or((text, 1.0), |rest| (rest, -1.0));
    let (digits, exponent) = digits.split_once('e').map_or((digits, 0), |(d, e)| (d, e.parse::<i32>().unwrap()));
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let number = whole.bytes().chain(fraction.bytes());
    let sum = number.fold(Double::default(), |sum, d| sum * Double::new(10.0) + Double::new(f64::from(d - b'0')));
    let power = exponent - i32::try_from(fraction.len()).unwrap();
    let scale = Double::new(10.0).powi(power.unsigned_abs());
    Double::new(sign) * if power < 0 { sum / scale } else { sum * scale }
}

#[track_caller]
fn close(found: Double, expected: &str, within: f64) {
    let expected = decimal(expected);
    let off = ((found - expected) / expected).value().abs();
    assert!(off <= within, "{found:?} is off by {off:e} from {expected:?}");
}

// All literals here: mpmath 1.3.0 with 60 digits.

#[test]
fn references_hold_28_digits() {
    const WITHIN: f64 = 1e-28;
    let sum = |g: f64, b: f64| exact::diffuse_sum(g.into(), b.into());
    close(sum(0.0625, 1.5), "0.0135418905930105428909423759732780104608913", WITHIN);
    close(sum(7.5, 40.0), "0.000949759135924241254114511349626454642047349", WITHIN);
    close(sum(450.0, 2000.0), "0.0000262119568478756957758736175339967464204969", WITHIN);
}

#[test]
fn black_bodies_and_their_nearest_hold_24_digits() {
    let observer = chromascope_core::data::observer("CIE 1931 2°").unwrap();
    let constants = RadiationConstants::Paper;
    let [x, y] = exact::black_body_xy(&observer, constants, 5500.0);
    close(x, "0.332458040673795065696484509251830866928162", 1e-28);
    close(y, "0.341084706617028822257825490476673480485704", 1e-28);
    let [kelvins, duv] = exact::cct(&observer, constants, [0.2, 0.325], 5472.0);
    close(kelvins, "5472.58958556915514818383330829471048564113", 1e-20);
    close(duv, "0.00954752446180262102149434911714349018852882", 1e-20);
    let [u, v] = exact::off_locus(&observer, constants, kelvins.value(), duv.value());
    assert!((u - 0.2).abs() < 1e-15 && (v - 0.325).abs() < 1e-15);
}

/// The one workload that tests run; all of them run in trial after the release build, where times mean something.
fn trial() -> Report {
    run(&[Workload::DiffuseSum], Effort::Trial, &Stop::NEVER, &mut |_| ()).unwrap()
}

#[test]
fn every_measurement_has_an_error_and_a_baseline() {
    let report = trial();
    assert!(report.whole && report.workloads() == [Workload::DiffuseSum]);
    for m in &report.measurements {
        let error = &m.error;
        let numbers = [m.seconds_per_item, m.ratio, m.spread, error.max_abs, error.rms_abs, error.max_rel];
        assert!(numbers.iter().all(|number| number.is_finite() && *number >= 0.0), "{m:?}");
        assert!(m.least_seconds_per_item <= m.seconds_per_item, "{m:?}");
        assert!(error.checked + error.refused > 0 && error.rms_rel <= error.max_rel, "{m:?}");
        let first = report.of(m.workload).find(|other| other.case == m.case).unwrap();
        assert_eq!(first.method, m.baseline);
        assert!(first.ratio == 1.0);
    }
    let exact = report.measurements.iter().filter(|m| m.method.starts_with("uniform, 1e-13"));
    assert!(exact.map(|m| m.error.max()).reduce(f64::max).unwrap() < 1e-12);
    let json = report.to_json().unwrap();
    assert_eq!(serde_json::from_str::<Report>(&json).unwrap().measurements.len(), report.measurements.len());
    assert_eq!(report.table().rows.len(), report.measurements.len());
}

/// Measurements made by hand: of each workload two methods, the second twice as quick and less exact.
fn by_hand() -> Report {
    let measured = trial();
    let like = &measured.measurements[0];
    let of = |workload: Workload| {
        [("slow", 2e-6, 1.0, 1e-15), ("quick", 1e-6, 0.5, 1e-6)].map(|(method, seconds, ratio, error)| {
            let mut m = like.clone();
            (m.workload, m.case, m.item) = (workload, "a case".to_owned(), "item".to_owned());
            (m.method, m.baseline) = (method.to_owned(), "slow".to_owned());
            (m.seconds_per_item, m.least_seconds_per_item, m.ratio) = (seconds, seconds, ratio);
            [m.error.max_abs, m.error.rms_abs, m.error.max_rel, m.error.rms_rel] = [error; 4];
            m
        })
    };
    Report { measurements: Workload::ALL.into_iter().flat_map(of).collect(), ..measured }
}

#[test]
fn every_workload_has_a_figure_and_rows() {
    let report = by_hand();
    assert_eq!(report.workloads(), Workload::ALL);
    assert_eq!(report.table().rows.len(), 2 * Workload::ALL.len());
    let columns = report.table().columns.len();
    assert!(report.table().rows.iter().all(|row| row.len() == columns) && columns >= 20);
    let csv = report.table().to_csv();
    for workload in Workload::ALL {
        assert_eq!(csv.lines().filter(|line| line.starts_with(workload.key())).count(), 2, "{csv}");
        let figure = report.figure(workload).unwrap();
        assert!(!figure.panels.is_empty() && figure.caption.contains(&report.machine.processor));
        assert!(figure.panels.iter().all(|panel| panel.marks.len() >= 2), "{workload:?}");
    }
}

#[test]
fn what_is_stopped_says_so_and_begins_no_other_workload() {
    let flag = Arc::new(AtomicBool::new(false));
    let stop = Stop::at(Arc::clone(&flag));
    let mut seen = 0;
    let report = run(&[Workload::DiffuseSum, Workload::Locus], Effort::Trial, &stop, &mut |progress| {
        if matches!(progress, Progress::Measured(_)) {
            seen += 1;
            flag.store(true, std::sync::atomic::Ordering::Relaxed);
        }
    });
    let report = report.unwrap();
    assert!(!report.whole && report.workloads() == [Workload::DiffuseSum] && seen == report.measurements.len());
}
