//! Numbers, times and messages of libraries as text for people.

use spectral_file::{Dropped, DroppedRow};

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

/// A time with three digits in the unit that suits it.
pub fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 0.9995e-6 => (s * 1e9, "ns"),
        s if s < 0.9995e-3 => (s * 1e6, "µs"),
        s if s < 0.9995 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    // A whole number of units is a tick of an axis.
    let decimals = match value {
        v if (v - v.round()).abs() < 1e-9 * v || v >= 99.95 => 0,
        v if v >= 9.995 => 1,
        _ => 2,
    };
    format!("{value:.decimals$} {unit}")
}

/// A text with a capital at its start.
pub fn capitalized(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A message of a library as a sentence: with a capital at its start and a full stop.
pub fn sentence(words: &str) -> String {
    format!("{}.", capitalized(words))
}

/// The system's reason for a failure, without its error number.
pub fn io_reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    let end = text.find(" (os error").unwrap_or(text.len());
    text[..end].to_lowercase()
}

/// Rows of a file that are in no curve: a sentence for those merged into others and one for those left out, each with the lines of
/// at most `told` rows.
pub fn dropped_rows(rows: &[DroppedRow], told: usize) -> Vec<String> {
    let (merged, left): (Vec<&DroppedRow>, Vec<&DroppedRow>) =
        rows.iter().partition(|row| row.why == Dropped::Averaged);
    let mut sentences = Vec::new();
    if !merged.is_empty() {
        let lines = listed(&merged, told, |row| row.line.to_string());
        let plural = if merged.len() == 1 { "line" } else { "lines" };
        let with = "merged with others of the same wavelength, of which the mean was taken";
        sentences.push(format!("{} {with}: {plural} {lines}", rows_of(merged.len())));
    }
    if !left.is_empty() {
        let lines = listed(&left, told, |row| format!("line {} ({})", row.line, row.why));
        sentences.push(format!("{} left out: {lines}", rows_of(left.len())));
    }
    sentences
}

fn rows_of(count: usize) -> String {
    if count == 1 { "1 row".to_owned() } else { format!("{count} rows") }
}

fn listed(rows: &[&DroppedRow], told: usize, one: impl Fn(&DroppedRow) -> String) -> String {
    let words: Vec<String> = rows.iter().take(told).map(|row| one(row)).collect();
    let more = rows.len().saturating_sub(told);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    words.join(", ") + &rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn merged_rows_are_not_left_out() {
        let row = |line, why| DroppedRow { line, why };
        let rows = [row(4, Dropped::Averaged), row(5, Dropped::NoWavelength), row(7, Dropped::Averaged)];
        let merged = "2 rows merged with others of the same wavelength, of which the mean was taken: lines 4, 7";
        assert_eq!(dropped_rows(&rows, 5), [merged, "1 row left out: line 5 (no wavelength)"]);
        let many: Vec<DroppedRow> = (1..=82).map(|line| row(line, Dropped::Repeated)).collect();
        assert_eq!(dropped_rows(&many, 1), ["82 rows left out: line 1 (the same as an earlier row) and 81 more"]);
        assert!(dropped_rows(&[], 5).is_empty());
    }

    #[test]
    fn times_have_units_that_suit() {
        let all = [1e-9, 1.5e-8, 9.99e-7, 1e-6, 2.5e-6, 1.5e-3, 0.9999, 12.0].map(duration);
        assert_eq!(all, ["1 ns", "15 ns", "999 ns", "1 µs", "2.50 µs", "1.50 ms", "1.00 s", "12 s"]);
    }
}
