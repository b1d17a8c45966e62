//! The rows of a file that are in no curve, in words: those that were merged into others apart from those left out.

use spectral_file::{Dropped, DroppedRow};

/// A sentence for those merged and one for those left out, at most `told` rows of each with their lines.
pub fn sentences(rows: &[DroppedRow], told: usize) -> Vec<String> {
    let (merged, left): (Vec<&DroppedRow>, Vec<&DroppedRow>) =
        rows.iter().partition(|row| row.why == Dropped::Averaged);
    let mut sentences = Vec::new();
    if !merged.is_empty() {
        let lines = listed(&merged, told, |row| row.line.to_string());
        let plural = if merged.len() == 1 { "line" } else { "lines" };
        let with = "merged with others of the same wavelength (mean)";
        sentences.push(format!("{} {with}: {plural} {lines}", rows_of(merged.len())));
    }
    if !left.is_empty() {
        let lines = listed(&left, told, |row| format!("line {} ({})", row.line, row.why));
        sentences.push(format!("{} skipped: {lines}", rows_of(left.len())));
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
        let merged = "2 rows merged with others of the same wavelength (mean): lines 4, 7";
        assert_eq!(sentences(&rows, 5), [merged, "1 row left out: line 5 (no wavelength)"]);
        let many: Vec<DroppedRow> = (1..=82).map(|line| row(line, Dropped::Repeated)).collect();
        assert_eq!(sentences(&many, 1), ["82 rows left out: line 1 (the same as an earlier row) and 81 more"]);
        assert!(sentences(&[], 5).is_empty());
    }
}
