//! Raw columns: the counts that some instruments write beside the curve they made of them.

use crate::grid::{Grid, RawCurve};
use crate::header_terms;
use crate::options::ReadOptions;
use crate::report::{Decided, Decision};

/// Removes raw columns if a processed one exists, unless they are requested.
pub(super) fn leave_out(grid: &mut Grid, options: &ReadOptions) -> Option<Decision> {
    if options.raw == Some(true) {
        return None;
    }
    let raw = mark(&grid.curves)?;
    let list = |wanted: bool| {
        let named = grid.curves.iter().zip(&raw).filter(|(_, raw)| **raw == wanted);
        named.map(|(curve, _)| format!("“{}”", curve.name)).collect::<Vec<_>>().join(", ")
    };
    let (kept, left) = (list(false), list(true));
    let decided = Decided::or_chosen(options.raw.map(|_| kept.clone()), || {
        Decided::certain(kept, format!("Its header calls {left} raw counts"))
    });
    let mut marks = raw.iter();
    grid.curves.retain(|_| !marks.next().copied().unwrap_or(false));
    Some(Decision::new("Columns", &decided))
}

/// Flags for the curves that are raw; `None` if none is, or all are.
fn mark(curves: &[RawCurve]) -> Option<Vec<bool>> {
    const LETTERS: [&str; 3] = ["D", "R", "S"];
    let letters = curves.iter().all(|curve| curve.name == "P" || LETTERS.contains(&curve.name.as_str()));
    let jaz = letters && curves.len() >= 2 && curves.iter().any(|curve| curve.name == "P");
    let processed = curves.iter().any(is_processed);
    let raw = |curve: &RawCurve| {
        let counts = curve.label.to_lowercase().contains("count");
        if jaz { curve.name != "P" } else { processed && !is_processed(curve) && (counts || is_raw_name(&curve.name)) }
    };
    let marks: Vec<bool> = curves.iter().map(raw).collect();
    (marks.contains(&true) && marks.contains(&false)).then_some(marks)
}

/// Returns whether a header describes a column computed from others.
fn is_processed(curve: &RawCurve) -> bool {
    let counts = curve.label.to_lowercase().contains("count");
    let said = header_terms::role(&curve.label).is_some() || header_terms::says_percent(&curve.label);
    !counts && (said || curve.name.eq_ignore_ascii_case("processed"))
}

fn is_raw_name(name: &str) -> bool {
    // Spectral Evolution: `Norm. DN (Ref.)`, `Rad. (Target)`.
    let lower = name.to_lowercase();
    let measured = lower.starts_with("norm. dn") || lower.starts_with("rad. (");
    measured
        || ["raw", "dark", "ref", "reference", "sample", "scope"].iter().any(|word| name.eq_ignore_ascii_case(word))
}
