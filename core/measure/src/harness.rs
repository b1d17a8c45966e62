//! The stopwatch: pieces of work take turns, so that a slow moment of the machine falls on all of them.

use chromascope_core::render::Stop;
use chromascope_math::quantile::quantile;
use std::hint::black_box;
use std::time::{Instant, SystemTime, UNIX_EPOCH};

/// Rounds and time to spend on a comparison.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// Rounds at least, however long they take, and rounds wanted.
    pub rounds: [usize; 2],
    /// Seconds at least, in further rounds if need be, and seconds after which no round begins.
    pub seconds: [f64; 2],
}

impl Budget {
    /// Budget of an interactive comparison.
    pub const INTERACTIVE: Self = Self { rounds: [3, 5], seconds: [0.1, 1.0] };

    fn is_spent(self, rounds: usize, seconds: f64) -> bool {
        let wanted = rounds >= self.rounds[1] && seconds >= self.seconds[0];
        rounds >= self.rounds[0] && (wanted || seconds >= self.seconds[1])
    }
}

/// Seconds of a piece of work, round by round.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Times(Vec<f64>);

impl Times {
    /// Number of rounds.
    pub fn rounds(&self) -> usize {
        self.0.len()
    }

    /// Median.
    pub fn median(&self) -> f64 {
        quartiles(self.0.clone())[1]
    }

    /// Shortest time: the one that other work on the machine disturbed least.
    pub fn least(&self) -> f64 {
        self.0.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Distance between the quartiles, relative to the median.
    pub fn spread(&self) -> f64 {
        let [low, middle, high] = quartiles(self.0.clone());
        (high - low) / middle
    }

    /// Median of the ratios to another's times in the same rounds.
    pub fn ratio_to(&self, other: &Self) -> f64 {
        quartiles(self.0.iter().zip(&other.0).map(|(time, base)| time / base).collect())[1]
    }
}

/// Times of `count` pieces of work that take turns; none if stopped. `seconds` does the piece of an index and returns its time.
pub fn take_turns(
    count: usize,
    budget: Budget,
    stop: &Stop,
    mut seconds: impl FnMut(usize) -> f64,
) -> Option<Vec<Times>> {
    let mut times = vec![Times::default(); count];
    let start = Instant::now();
    let mut round = 0;
    while count > 0 && !budget.is_spent(round, start.elapsed().as_secs_f64()) {
        for turn in 0..count {
            if stop.is_set() {
                return None;
            }
            // The order varies, as a fixed predecessor could leave caches cold or the clock rate low.
            let which = (turn + round * 7) % count;
            times[which].0.push(seconds(which));
        }
        round += 1;
    }
    Some(times)
}

/// Result of some work, and the seconds it took.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let made = black_box(work());
    (made, start.elapsed().as_secs_f64())
}

/// Seconds of the shortest of three runs.
pub fn shortest<T>(work: impl FnMut() -> T) -> f64 {
    shortest_of(3, work)
}

pub(crate) fn shortest_of<T>(runs: usize, mut work: impl FnMut() -> T) -> f64 {
    (0..runs).map(|_| timed(&mut work).1).fold(f64::INFINITY, f64::min)
}

/// The present time in UTC to the second, as `2026-11-21T18:05:11Z`.
pub fn now() -> String {
    utc(SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs()))
}

/// Date and time of seconds since 1970, in the proleptic Gregorian calendar (H. Hinnant, `civil_from_days`).
pub fn utc(seconds: u64) -> String {
    let (days, second) = (seconds / 86_400 + 719_468, seconds % 86_400);
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    // Months from March on: the leap day is the last of a year.
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (year, month) = (era * 400 + year + u64::from(month > 9), if month < 10 { month + 3 } else { month - 9 });
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// Quartiles and, between them, the median.
fn quartiles(mut values: Vec<f64>) -> [f64; 3] {
    [0.25, 0.5, 0.75].map(|share| quantile(&mut values, share).unwrap_or(0.0))
}
