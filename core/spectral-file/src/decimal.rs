//! Shifts of the decimal point that keep a number's digits.

/// A number times a power of ten, as its decimal digits with the point moved: 23.333 by −2 is 0.23333, where a binary division
/// gives 0.23332999999999998. The digits are the shortest that mean the number; the result is the double nearest to them.
pub(super) fn shifted(value: f64, power: i32) -> f64 {
    // Whole numbers below 2^53 over powers of ten up to 10^22 are divided exactly rounded (W. D. Clinger 1990).
    const EXACT: f64 = 9_007_199_254_740_992.0;
    const LARGEST: i32 = 22;
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let mut scale = 1.0;
    for digits in 0..=15 {
        let whole = (value * scale).round();
        if whole.abs() >= EXACT {
            break;
        }
        if whole / scale == value {
            let power = power - digits;
            if (-LARGEST..=0).contains(&power) {
                return whole / 10_f64.powi(-power);
            }
            if (1..=LARGEST).contains(&power) && whole.abs() * 10_f64.powi(power) < EXACT {
                return whole * 10_f64.powi(power);
            }
            break;
        }
        scale *= 10.0;
    }
    by_text(value, power)
}

fn by_text(value: f64, power: i32) -> f64 {
    let written = format!("{value:e}");
    let parts = written.split_once('e').and_then(|(digits, exponent)| Some((digits, exponent.parse::<i32>().ok()?)));
    let moved = parts.and_then(|(digits, exponent)| format!("{digits}e{}", exponent + power).parse().ok());
    moved.unwrap_or_else(|| value * 10_f64.powi(power))
}

pub(super) fn extent(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), number| (min.min(number), max.max(number)))
}

/// The number in the middle, the upper one of two; 0 for none.
pub(super) fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut all: Vec<f64> = numbers.filter(|number| !number.is_nan()).collect();
    all.sort_unstable_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(0.0)
}

/// The ends of numbers that rise or fall all the way, from the first to the last one.
pub(super) fn ends(values: &[f64]) -> Option<(f64, f64)> {
    let start = values.iter().position(|value| !value.is_nan())?;
    let end = values.iter().rposition(|value| !value.is_nan())?;
    let values = &values[start..=end];
    let ordered = |sign: f64| values.windows(2).all(|pair| sign * (pair[1] - pair[0]) > 0.0);
    let (a, b) = (*values.first()?, *values.last()?);
    (a.is_finite() && b.is_finite() && (ordered(1.0) || ordered(-1.0))).then_some((a.min(b), a.max(b)))
}

/// The exponent of a number that is a power of ten, such as 2 for 100.
pub(super) fn power_of_ten(number: f64) -> Option<i32> {
    (-15..=15).find(|power| 10_f64.powi(*power) == number)
}

/// A number divided by another; where that is a power of ten, by moving the decimal point.
pub(super) fn divided(value: f64, divisor: f64) -> f64 {
    power_of_ten(divisor).map_or(value / divisor, |power| shifted(value, -power))
}

/// A number with at most the given number of significant digits, for display.
pub(super) fn short(value: f64, digits: i32) -> String {
    const LONGEST: i32 = 12;
    if value == 0.0 || !value.is_finite() {
        return "0".to_owned();
    }
    let decimals = digits - 1 - value.abs().log10().floor() as i32;
    if (digits - LONGEST..=LONGEST).contains(&decimals) {
        let scale = 10_f64.powi(decimals.max(0));
        format!("{}", (value * scale).round() / scale)
    } else {
        let decimals = usize::try_from(digits - 1).unwrap_or(0);
        format!("{value:.decimals$e}")
    }
}

/// A length in nanometers rounded to 1e-9: the noise of decimal fractions goes, nothing measurable does.
pub(super) fn clean(nm: f64) -> f64 {
    const PER_NM: f64 = 1e9;
    let rounded = (nm * PER_NM).round() / PER_NM;
    if rounded.is_finite() { rounded } else { nm }
}

/// The unit of the last digit of a number: 0.01 for `4.25`, 10 for `4.25E+3`.
pub(super) fn last_digit(number: &str) -> f64 {
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    let exponent = exponent.parse::<i32>().unwrap_or(0).clamp(-300, 300);
    10_f64.powi(exponent - i32::try_from(decimals).unwrap_or(300).min(300))
}
