//! Numbers that stand for missing values: −999, 9999, −1.23e34.
//!
//! Such a number is taken for a gap only where it stands out: five times as large as all other values of its curve, or ten times
//! as far below them.

use crate::grid::{Grid, RawCurve};
use crate::warning::{LineList, Sentinel, Warning};
use crate::watch::Log;

/// Numbers that programs write for missing values, as sizes; each with either sign. (−9999 is one wherever it stands.)
const SIZES: [f64; 19] = [
    99.0,
    99.9,
    99.99,
    999.0,
    999.25,
    999.9,
    999.99,
    8_888.0,
    9_999.0,
    9_999.9,
    9_999.99,
    99_999.0,
    999_999.0,
    9_999_999.0,
    99_999_999.0,
    32_767.0,
    32_768.0,
    65_535.0,
    2_147_483_648.0,
];

/// Sizes far beyond what is measured: of USGS (1.23e34), netCDF (9.97e36), instruments with SCPI (9.91e37), and the largest number
/// in single precision, each to the digits that are written; and its half.
const HUGE: [f64; 13] =
    [1e30, 1e31, 1e32, 1e33, 1e34, 1.23e34, 1e35, 1e36, 9.969_21e36, 1e37, 9.9e37, 9.91e37, 3.402_823e38];
const HALF: [f64; 2] = [1.7e38, 1.701_411e38];
const WRITTEN: f64 = 1e-6;

/// Largest size of measured values beside them.
const COMMON: f64 = 1e19;

fn is_huge(size: f64) -> bool {
    let near = |known: &f64| (size - known).abs() <= WRITTEN * known;
    size >= HUGE[0] * (1.0 - WRITTEN) && HUGE.iter().chain(&HALF).any(near)
}

/// Factors by which a number must stand out below and above the others: percent reach 100, beside which 999 is none.
const TIMES: [f64; 2] = [10.0, 5.0];

fn is_candidate(value: f64) -> bool {
    let size = value.abs();
    // A reading of 99 is no rarity above zero.
    is_huge(size) || SIZES.contains(&size) && (value < 0.0 || size >= 999.0)
}

/// The values of a curve that stand for nothing else than themselves.
struct Others {
    low: f64,
    high: f64,
    count: usize,
}

impl Others {
    fn of(curve: &RawCurve) -> Self {
        let others = curve.values.iter().filter(|value| !value.is_nan() && !is_candidate(**value));
        let none = Self { low: f64::INFINITY, high: f64::NEG_INFINITY, count: 0 };
        others.fold(none, |all, &value| Self {
            low: all.low.min(value),
            high: all.high.max(value),
            count: all.count + 1,
        })
    }

    /// Returns whether a number stands for a missing value beside these.
    fn leave_out(&self, value: f64) -> bool {
        if !is_candidate(value) {
            return false;
        }
        let largest = self.low.abs().max(self.high.abs());
        match () {
            () if self.count == 0 => value < 0.0,
            () if is_huge(value.abs()) => largest <= COMMON,
            () if value < 0.0 => self.low >= value / TIMES[0],
            () => value >= TIMES[1] * largest,
        }
    }
}

/// Makes gaps of the numbers that stand for missing values.
pub(super) fn take(grid: &mut Grid, log: &mut Log<'_>) {
    let own_lines = grid.lines.len() == grid.wavelengths.len() && !grid.own_wavelengths;
    let mut cells = 0;
    let mut first: Option<Sentinel> = None;
    for curve in &mut grid.curves {
        if !curve.values.iter().any(|value| is_candidate(*value)) {
            continue;
        }
        let others = Others::of(curve);
        let Some(number) = curve.values.iter().copied().find(|value| others.leave_out(*value)) else { continue };
        first.get_or_insert_with(|| Sentinel { number, curve: curve.description() });
        for value in curve.values.iter_mut().filter(|value| others.leave_out(**value)) {
            *value = f64::NAN;
            cells += 1;
        }
    }
    if let Some(sentinel) = first {
        if own_lines {
            // Reported with the other gaps of the rows.
            grid.sentinel = Some(sentinel);
        } else {
            log.push(Warning::Gaps { cells, lines: LineList::default(), sentinel: Some(sentinel) });
        }
    }
}
