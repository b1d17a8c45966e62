//! The stopwatch.

use chromascope_core::render::Stop;
use chromascope_measure::harness::{Budget, Times, take_turns, utc};

#[test]
fn times_are_summed_up_by_quartiles_and_ratios_within_rounds() {
    let rounds = [[4.0, 2.0], [1.0, 1.0], [2.0, 1.0], [3.0, 1.0], [5.0, 1.0]];
    let (mut taken, budget) = ([0; 2], Budget { rounds: [5, 5], seconds: [0.0; 2] });
    let seconds = |which: usize| {
        taken[which] += 1;
        rounds[taken[which] - 1][which]
    };
    let [a, b] = <[Times; 2]>::try_from(take_turns(2, budget, &Stop::NEVER, seconds).unwrap()).unwrap();
    assert_eq!((a.rounds(), a.median(), a.least()), (5, 3.0, 1.0));
    assert!((a.spread() - 2.0 / 3.0).abs() < 1e-15);
    assert_eq!(a.ratio_to(&b), 2.0);
}

#[test]
fn rounds_are_those_of_the_budget_and_a_stop_leaves_nothing() {
    let rounds = |rounds, seconds| {
        let times = take_turns(3, Budget { rounds, seconds }, &Stop::NEVER, |which| which as f64).expect("no stop");
        assert!(times.iter().enumerate().all(|(which, times)| times.median() == which as f64));
        times[2].rounds()
    };
    assert_eq!(rounds([3, 9], [0.0, f64::INFINITY]), 9, "as many as wanted");
    assert_eq!(rounds([3, 9], [0.0, 0.0]), 3, "no time for more");
    assert_eq!(take_turns(0, Budget::INTERACTIVE, &Stop::NEVER, |_| 0.0), Some(Vec::new()));
    let set = Stop::at(std::sync::Arc::new(true.into()));
    assert_eq!(take_turns(1, Budget::INTERACTIVE, &set, |_| 0.0), None);
}

#[test]
fn dates_are_those_of_the_calendar() {
    // `date -u -d @… +%FT%TZ` of GNU coreutils.
    for (seconds, date) in [
        (0, "1970-01-01T00:00:00Z"),
        (951_782_400, "2000-02-29T00:00:00Z"),
        (1_795_367_111, "2026-11-22T17:05:11Z"),
        (4_107_542_399, "2100-02-28T23:59:59Z"),
        (4_107_542_400, "2100-03-01T00:00:00Z"),
    ] {
        assert_eq!(utc(seconds), date);
    }
}
