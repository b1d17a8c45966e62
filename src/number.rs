//! Numbers for reading.

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
