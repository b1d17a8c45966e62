//! Content that the layouts of JSON have in common.

use crate::decimal::clean;
use crate::formats::json::rows::Rows;
use crate::formats::spectra::Spectrum;
use crate::header::Header;
use crate::limits::MAX_SAMPLES;
use crate::report::{Decided, Decision, Part, Reader};
use crate::role::Role;

/// The line in which a name stands between quotes, if it does.
pub(super) fn line_of(text: &str, name: &str) -> Option<usize> {
    let at = text.find(&format!("\"{name}\""))?;
    Some(1 + text[..at].bytes().filter(|byte| *byte == b'\n').count())
}

/// Evidence: the line that has a member of this name.
pub(super) fn says(text: &str, name: &str) -> String {
    line_of(text, name).map_or_else(|| format!("The document has “{name}”"), |line| format!("Line {line} has “{name}”"))
}

/// Curves as a layout has them.
pub(super) enum Curves {
    Spectra(Vec<Spectrum>),
    /// All over the same wavelengths.
    Rows {
        rows: Rows,
        names: Vec<String>,
    },
}

/// Content that all layouts share.
pub(super) struct Content {
    pub(super) curves: Curves,
    pub(super) header: Header,
    pub(super) reader: Decided<Reader>,
    pub(super) role: Option<Decided<Role>>,
    pub(super) notes: Vec<Decision>,
    pub(super) parts: Vec<Part>,
    pub(super) part: Option<Decided<usize>>,
}

/// Stores the remarks on the values, in the words of this program's own files.
pub(super) fn note_remarks<'a>(text: &str, header: &mut Header, remarks: impl Iterator<Item = &'a str>) {
    for (key, value) in remarks.filter_map(|remark| remark.split_once(": ")) {
        if matches!(key, "quantity" | "unit" | "response") {
            header.take_comment(line_of(text, "comments").unwrap_or(1), key, value);
        }
    }
}

/// The wavelengths of a range, given by its ends and its step.
pub(super) fn range(bands: &[f64]) -> Option<Vec<f64>> {
    let &[first, last, step] = bands else { return None };
    let steps = ((last - first) / step).round();
    let some = (1.0..=MAX_SAMPLES as f64).contains(&steps);
    some.then(|| (0..=steps as usize).map(|i| clean(first + step * i as f64)).collect())
}
