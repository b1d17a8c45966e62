//! File families that are text but no table of numbers, and the marks by which they are known.

use std::fmt;

/// A family of text files with a grammar of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Family {
    /// XML, such as TM-27 or `CxF`.
    Xml,
    /// JSON, with or without comments.
    Json,
    /// JCAMP-DX.
    Jcamp,
    /// CGATS and its relatives, as Argyll and X-Rite write them.
    Cgats,
}

impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Xml => "XML",
            Self::Json => "JSON",
            Self::Jcamp => "JCAMP-DX",
            Self::Cgats => "CGATS",
        })
    }
}

/// Bytes of the text that are searched for the marks of a family.
const LOOK: usize = 64 << 10;

/// The line that begins the names of fields in CGATS.
const CGATS_FORMAT: &str = "BEGIN_DATA_FORMAT";

/// The family of a text, from its beginning.
pub(super) fn recognize(text: &str) -> Option<Family> {
    let start = text.trim_start();
    if start.starts_with("<?xml") || (start.starts_with('<') && start.trim_end().ends_with('>')) {
        return Some(Family::Xml);
    }
    if start.starts_with("##") && start[..floor(start)].contains("DATA TYPE=") || start.starts_with("##TITLE=") {
        return Some(Family::Jcamp);
    }
    let list = start.starts_with('[') && start.trim_end().ends_with(']');
    if start.starts_with('{') || list || commented_json(start) {
        return Some(Family::Json);
    }
    let head = &text[..floor(text)];
    let cgats = head.contains(CGATS_FORMAT) && head.lines().any(|line| line.trim() == CGATS_FORMAT);
    cgats.then_some(Family::Cgats)
}

fn commented_json(start: &str) -> bool {
    (start.starts_with("//") || start.starts_with("/*"))
        && start
            .lines()
            .map(str::trim)
            .find(|l| !l.is_empty() && !l.starts_with("//") && !l.starts_with("/*") && !l.starts_with('*'))
            .is_some_and(|l| l.starts_with('{'))
}

/// The end of the part that is looked at, on a character boundary.
fn floor(text: &str) -> usize {
    text.floor_char_boundary(LOOK)
}
