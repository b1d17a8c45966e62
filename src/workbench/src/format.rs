//! Numbers, times and messages of libraries as text for display.

use std::path::Path;

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

/// A rank as `3`, or as `1–3` where it is not certain.
pub fn rank_in_words(rank: Option<[usize; 2]>) -> String {
    match rank {
        Some([first, last]) if first == last => first.to_string(),
        Some([first, last]) => format!("{first}–{last}"),
        None => "–".to_owned(),
    }
}

/// A text with a capital at its start.
pub fn capitalized(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A library's message as a sentence: with a capital at its start and a full stop.
pub fn sentence(words: &str) -> String {
    format!("{}.", capitalized(words))
}

/// The last part of a path; the whole path if it has none.
pub fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// The system's reason for a failure at a path, after the path.
pub fn io_failure(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {}", path.display(), io_reason(error))
}

/// The system's reason for a failure, without its error number.
pub fn io_reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    let end = text.find(" (os error").unwrap_or(text.len());
    spectral_file::lowered(&text[..end])
}

/// Rows of a file that are in no curve: a sentence for the merged and one for the omitted ones, each with the line numbers of at
/// most `most` rows.
pub fn dropped_rows(rows: &[DroppedRow], most: usize) -> Vec<String> {
    let (merged, left): (Vec<&DroppedRow>, Vec<&DroppedRow>) =
        rows.iter().partition(|row| row.why == Dropped::Averaged);
    let mut sentences = Vec::new();
    if !merged.is_empty() {
        let lines = listed(&merged, most, |row| row.line.to_string());
        let plural = if merged.len() == 1 { "line" } else { "lines" };
        let with = "merged with others of the same wavelength (mean)";
        sentences.push(format!("{} {with}: {plural} {lines}", rows_of(merged.len())));
    }
    if !left.is_empty() {
        let lines = listed(&left, most, |row| format!("line {} ({})", row.line, row.why));
        sentences.push(format!("{} skipped: {lines}", rows_of(left.len())));
    }
    sentences
}

fn rows_of(count: usize) -> String {
    if count == 1 { "1 row".to_owned() } else { format!("{count} rows") }
}

fn listed(rows: &[&DroppedRow], most: usize, one: impl Fn(&DroppedRow) -> String) -> String {
    let words: Vec<String> = rows.iter().take(most).map(|row| one(row)).collect();
    let more = rows.len().saturating_sub(most);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    words.join(", ") + &rest
}

/// A name that any file system takes: letters and digits, small, other signs as single hyphens.
pub fn slug(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let slug = words.map(str::to_lowercase).collect::<Vec<_>>().join("-");
    if slug.is_empty() { "unnamed".to_owned() } else { slug }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_ends_where_its_uncertainty_ends() {
        let cases = [
            (0.90512, Some(0.1149), "0.91", Some("± 0.11")),
            (0.90512, Some(0.0996), "0.91", Some("± 0.10")),
            (0.90512, Some(0.003_54), "0.9051", Some("± 0.0035")),
            (246.39, Some(123.0), "250", Some("± 120")),
            (-16.4348, Some(14.6), "−16", Some("± 15")),
            (20.8626, Some(2.3), "20.9", Some("± 2.3")),
            (-0.4, Some(15.0), "0", Some("± 15")),
            (99.96, Some(0.996), "100.0", Some("± 1.0")),
            (1.5, Some(0.0), "1.50", None),
            (1.5, Some(f64::NAN), "1.50", None),
            (1.5, Some(f64::INFINITY), "1.50", None),
            (1.5, None, "1.50", None),
        ];
        for (value, uncertainty, number, by) in cases {
            let own = uncertainty.and_then(decimals_by).unwrap_or(2);
            let written = uncertainty.and_then(|by| behind(by, false));
            assert_eq!(
                (rounded(value, own), written),
                (number.to_owned(), by.map(str::to_owned)),
                "{value} {uncertainty:?}"
            );
        }
        assert_eq!(behind(0.0996, true).as_deref(), Some("± 0.10†"));
        let column = [(12.3, 2), (4.52, 1), (7.1, 0), (123.0, -1)].map(|(value, own)| aligned(value, own, 2));
        assert_eq!(column, ["12.30", "4.5 ", "7   ", "120   "]);
        assert_eq!(aligned(123.0, -1, 0), "120");
    }

    #[test]
    fn merged_rows_are_not_left_out() {
        let row = |line, why| DroppedRow { line, why };
        let rows = [row(4, Dropped::Averaged), row(5, Dropped::NoWavelength), row(7, Dropped::Averaged)];
        let merged = "2 rows merged with others of the same wavelength (mean): lines 4, 7";
        assert_eq!(dropped_rows(&rows, 5), [merged, "1 row skipped: line 5 (no wavelength)"]);
        let many: Vec<DroppedRow> = (1..=82).map(|line| row(line, Dropped::Repeated)).collect();
        assert_eq!(dropped_rows(&many, 1), ["82 rows skipped: line 1 (the same as an earlier row) and 81 more"]);
        assert!(dropped_rows(&[], 5).is_empty());
    }
}
