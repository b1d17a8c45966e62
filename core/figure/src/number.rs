//! Numbers as they are written: in files, and for reading with a true minus sign.

/// A number for reading: six significant digits at most, a true minus sign.
pub fn number(value: f64) -> String {
    let magnitude = value.abs();
    let text = if value == 0.0 || (1e-4..1e6).contains(&magnitude) {
        let decimals = if magnitude >= 1.0 { 5_usize.saturating_sub(magnitude.log10() as usize) } else { 5 };
        let fixed = format!("{value:.decimals$}");
        if fixed.contains('.') { fixed.trim_end_matches('0').trim_end_matches('.').to_owned() } else { fixed }
    } else {
        format!("{value:.4e}")
    };
    text.replace('-', "−")
}

/// A number with a fixed count of decimals and a true minus sign; no minus before nothing but zeros.
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let is_zero = !text.bytes().any(|b| b.is_ascii_digit() && b != b'0');
    if is_zero { text.trim_start_matches('-').to_owned() } else { text.replace('-', "−") }
}

/// Most decimals of a value with its uncertainty.
const MOST_DECIMALS: i32 = 9;
/// Sign behind an uncertainty that is extrapolated.
const EXTRAPOLATED: &str = "†";

/// Decimals at which a value with a standard uncertainty ends: where two significant digits of the uncertainty do, the most that the GUM
/// finds useful (JCGM 100:2008, 7.2.6). Negative for tens and hundreds; none for an uncertainty of zero.
pub fn decimals_by(uncertainty: f64) -> Option<i32> {
    // Rounded before it is counted: 0.0996 is 0.10.
    let exponent: i32 = format!("{uncertainty:.1e}").split_once('e')?.1.parse().ok()?;
    (uncertainty > 0.0).then_some((1 - exponent).min(MOST_DECIMALS))
}

/// A count of decimals beside those that may be negative.
pub fn whole(decimals: usize) -> i32 {
    i32::try_from(decimals).unwrap_or(MOST_DECIMALS)
}

/// A number rounded to a count of decimals; a negative count is of zeros before the point.
pub fn rounded(value: f64, decimals: i32) -> String {
    let Ok(decimals) = usize::try_from(decimals) else {
        let unit = 10_f64.powi(-decimals);
        return fixed((value / unit).round() * unit, 0);
    };
    fixed(value, decimals)
}

/// A number with fewer decimals than others below it, padded so that decimal points stand below each other.
pub fn aligned(value: f64, decimals: i32, column: usize) -> String {
    let own = decimals.max(0) as usize;
    let point = usize::from(own == 0 && column > 0);
    format!("{}{}", rounded(value, decimals), " ".repeat(column.saturating_sub(own) + point))
}

/// A standard uncertainty as it is written behind its value; none for one of zero.
pub fn behind(uncertainty: f64, is_extrapolated: bool) -> Option<String> {
    let mark = if is_extrapolated { EXTRAPOLATED } else { "" };
    Some(format!("± {}{mark}", rounded(uncertainty, decimals_by(uncertainty)?)))
}

/// Duv and other signed numbers with four decimals: `+0.0032`.
pub fn signed(value: f64) -> String {
    let text = fixed(value, 4);
    if text.starts_with('−') { text } else { format!("+{text}") }
}

/// Fifteen significant digits, without an exponent where that stays short.
pub fn significant(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor() as i32;
    if (-6..15).contains(&exponent) {
        let decimals = usize::try_from(14 - exponent).unwrap_or(0);
        format!("{value:.decimals$}")
    } else {
        format!("{value:.14e}")
    }
}

/// As many digits as it takes to read the same double back, at most 17.
pub fn shortest(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(1e-5..1e15).contains(&magnitude) { format!("{value:e}") } else { format!("{value}") }
}
