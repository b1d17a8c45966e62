//! Walking one function: many cases at once, the worst error, and the plainest case that fails.

use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;

use super::draw::{Case, Draw};

/// Result of one case.
#[derive(Clone, Debug, Default)]
pub(super) struct Verdict {
    error: f64,
    refused: bool,
    subnormal: bool,
    wrong: Option<&'static str>,
}

impl Verdict {
    /// The function said that there is no answer.
    pub(super) fn refuse(&mut self) {
        self.refused = true;
    }

    /// Requires a condition of every answer.
    pub(super) fn holds(&mut self, what: &'static str, is_so: bool) {
        if !is_so && self.wrong.is_none() {
            self.wrong = Some(what);
        }
    }

    /// A result: finite, and counted where it is subnormal.
    pub(super) fn finite(&mut self, value: f64) {
        self.subnormal |= value.is_subnormal();
        self.holds("not finite", value.is_finite());
    }

    pub(super) fn all_finite(&mut self, values: impl IntoIterator<Item = f64>) {
        values.into_iter().for_each(|value| self.finite(value));
    }

    pub(super) fn normal(&mut self, value: f64) {
        self.finite(value);
        self.holds("subnormal", !value.is_subnormal());
    }

    /// An error in the measure of the bound.
    pub(super) fn error(&mut self, error: f64) {
        self.holds("the error is no number", !error.is_nan());
        self.error = self.error.max(error);
    }

    /// An error relative to `truth`, of which so much is excused.
    pub(super) fn relative(&mut self, value: f64, truth: f64, excused: f64) {
        let off = (value - truth).abs();
        self.error(if off == 0.0 { 0.0 } else { (off / truth.abs() - excused).max(0.0) });
    }
}

/// A function, how its cases are drawn, and what is checked of each.
#[derive(Clone, Copy)]
pub(super) struct Walk {
    pub(super) name: &'static str,
    /// Error bound; 0 if there is no second method.
    pub(super) promise: f64,
    /// Relative share of the cases.
    pub(super) share: f64,
    pub(super) draw: fn(&mut Draw) -> Case,
    pub(super) check: fn(&Case, &mut Verdict),
}

/// Summary of many cases.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    pub(super) cases: u64,
    pub(super) refused: u64,
    pub(super) subnormal: u64,
    pub(super) worst: f64,
    pub(super) at: Case,
    failed: Option<(u64, Case)>,
}

impl Tally {
    fn with(mut self, other: &Self) -> Self {
        self.cases += other.cases;
        self.refused += other.refused;
        self.subnormal += other.subnormal;
        if other.worst > self.worst {
            (self.worst, self.at) = (other.worst, other.at);
        }
        self.failed = match (self.failed, other.failed) {
            (Some(a), Some(b)) => Some(if b.0 < a.0 { b } else { a }),
            (a, b) => a.or(b),
        };
        self
    }
}

/// Cases that one task walks.
const RUN: u64 = 1000;

impl Walk {
    pub(super) fn run(&self, seed: u64, cases: u64) -> Tally {
        let runs: Vec<Tally> = (0..cases.div_ceil(RUN))
            .into_par_iter()
            .map(|run| self.part(seed, run * RUN..cases.min((run + 1) * RUN)))
            .collect();
        runs.iter().fold(Tally::default(), Tally::with)
    }

    fn part(&self, seed: u64, indices: std::ops::Range<u64>) -> Tally {
        let mut tally = Tally::default();
        for index in indices {
            let case = (self.draw)(&mut Draw::new(seed, self.name, index));
            let verdict = self.verdict(&case);
            tally.cases += 1;
            tally.refused += u64::from(verdict.refused);
            tally.subnormal += u64::from(verdict.subnormal);
            if verdict.error > tally.worst {
                (tally.worst, tally.at) = (verdict.error, case);
            }
            if self.complaint(&verdict).is_some() && tally.failed.is_none() {
                tally.failed = Some((index, case));
            }
        }
        tally
    }

    fn verdict(&self, case: &Case) -> Verdict {
        let judged = catch_unwind(AssertUnwindSafe(|| {
            let mut verdict = Verdict::default();
            (self.check)(case, &mut verdict);
            verdict
        }));
        judged.unwrap_or(Verdict { wrong: Some("panic"), ..Verdict::default() })
    }

    fn complaint(&self, verdict: &Verdict) -> Option<String> {
        if let Some(wrong) = verdict.wrong {
            return Some(wrong.to_owned());
        }
        // Written so that an error that is NaN is too large.
        let kept = verdict.error <= self.promise;
        (!kept).then(|| format!("error {:.2e}, promised {:.1e}", verdict.error, self.promise))
    }

    /// Failure message: seed, function, and the simplest case that fails.
    pub(super) fn failure(&self, tally: &Tally, seed: u64) -> Option<String> {
        let (index, first) = tally.failed?;
        let fails = |case: &Case| self.complaint(&self.verdict(case)).is_some();
        let plain = plainer(first, fails);
        let complaint = self.complaint(&self.verdict(&plain)).unwrap_or_default();
        Some(format!(
            "{}: {complaint}\n  at   {}\n  from {} (seed {seed}, case {index})",
            self.name,
            self.shown(&plain),
            self.shown(&first)
        ))
    }

    pub(super) fn shown(&self, case: &Case) -> String {
        // What the function does not draw stays zero.
        let drawn = (0..20).map(|index| (self.draw)(&mut Draw::new(1, self.name, index)));
        let used = drawn.map(|case| case.iter().rposition(|v| *v != 0.0).map_or(0, |last| last + 1)).max();
        let numbers = case.iter().take(used.unwrap_or(case.len()));
        numbers.map(|v| format!("{v:e}")).collect::<Vec<_>>().join(" ")
    }
}

/// A case that fails as well, each number as near to 0 or 1 and as short as it can be with the others as they are.
pub(super) fn plainer(mut case: Case, fails: impl Fn(&Case) -> bool) -> Case {
    for _ in 0..4 {
        let before = case.map(f64::to_bits);
        for place in 0..case.len() {
            let with = |value: f64| {
                let mut other = case;
                other[place] = value;
                other
            };
            let stands = |value: f64| fails(&with(value));
            case[place] = plainest(case[place], stands);
        }
        if case.map(f64::to_bits) == before {
            break;
        }
    }
    case
}

fn plainest(value: f64, fails: impl Fn(f64) -> bool) -> f64 {
    for simple in [0.0_f64, 1.0, -1.0, 1e300, -1e300, 1e-300] {
        // Never further out than the case was: it may be a count.
        if value.to_bits() == simple.to_bits() || simple.abs() <= value.abs().max(1.0) && fails(simple) {
            return simple;
        }
    }
    if !value.is_finite() {
        return value;
    }
    // Bisection in the logarithm between what fails and one, which does not.
    let (mut failing, mut passing) = (value.abs().ln(), 0.0_f64);
    for _ in 0..30 {
        let middle = f64::midpoint(failing, passing);
        if fails(middle.exp().copysign(value)) {
            failing = middle;
        } else {
            passing = middle;
        }
    }
    let near = failing.exp().copysign(value);
    let near = if fails(near) { near } else { value };
    let rounded = (0..17).filter_map(|digits| format!("{near:.digits$e}").parse().ok()).find(|&v: &f64| fails(v));
    rounded.unwrap_or(near)
}

#[test]
fn what_fails_is_made_plain() {
    let start = [3.7e5, -0.2, 1e-9, f64::INFINITY, 5.5, 0.0, 0.0, 8.0];
    let plain = plainer(start, |case| case[0] > 1234.0 && case[1] < -0.1);
    assert_eq!(plain[1..], [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert!((1234.0..=1300.0).contains(&plain[0]) || plain[0] == 1e300, "{plain:?}");
}

#[test]
fn a_case_is_the_same_for_the_same_seed() {
    let numbers = |seed, name, index| Draw::new(seed, name, index).bits();
    assert_eq!(numbers(1, "sinc", 5), numbers(1, "sinc", 5));
    assert!(numbers(1, "sinc", 5) != numbers(2, "sinc", 5) && numbers(1, "sinc", 5) != numbers(1, "sinc", 6));
    assert_ne!(numbers(1, "sinc", 5), numbers(1, "exp", 5));
}
