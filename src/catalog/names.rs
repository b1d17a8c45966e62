//! Finding a set by what a person types.

use super::Entry;

/// Why a name means no set.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NameError {
    /// Nothing of that name.
    #[error("no {kind} is named \"{name}\"{}", suggest(.nearest))]
    Unknown {
        /// What was looked for.
        kind: &'static str,
        /// What was typed.
        name: String,
        /// The nearest names.
        nearest: Vec<String>,
    },
    /// Several names contain it.
    #[error("\"{name}\" could be {}; give more of the name", .candidates.join(", "))]
    Ambiguous {
        /// What was typed.
        name: String,
        /// The names that contain it, the first few.
        candidates: Vec<String>,
    },
}

fn suggest(nearest: &[String]) -> String {
    match nearest {
        [] => String::new(),
        names => format!("; did you mean {}?", names.join(", ")),
    }
}

/// A name without case, spaces and punctuation, for comparing.
pub fn folded(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Orders numbers within names by their value: `FL2` before `FL10`.
pub fn sort_key(name: &str) -> Vec<(String, u64)> {
    let mut key = Vec::new();
    let mut rest = name;
    while !rest.is_empty() {
        let digits_at = rest.find(|c: char| c.is_ascii_digit()).unwrap_or(rest.len());
        let (word, tail) = rest.split_at(digits_at);
        let end = tail.find(|c: char| !c.is_ascii_digit()).unwrap_or(tail.len());
        key.push((word.to_lowercase(), tail[..end].parse().unwrap_or(0)));
        rest = &tail[end..];
    }
    key
}

/// Whether every word of a search occurs in an entry's name, short name or gloss.
pub fn matches_search(entry: &Entry, search: &str) -> bool {
    let text = format!("{} {} {}", entry.name, entry.short, entry.also.as_deref().unwrap_or_default());
    let text = folded(&text);
    search.split_whitespace().map(folded).all(|word| text.contains(&word))
}

/// The entry that a name means: the exact name (case and punctuation aside), else the only one that contains it.
pub fn find<'a>(
    entries: impl Iterator<Item = &'a Entry>,
    kind: &'static str,
    name: &str,
) -> Result<&'a Entry, NameError> {
    let entries: Vec<&Entry> = entries.collect();
    let wanted = folded(name);
    let exact = |text: &str| folded(text) == wanted;
    if let Some(entry) = entries.iter().find(|e| exact(&e.name)).or_else(|| entries.iter().find(|e| exact(&e.short))) {
        return Ok(entry);
    }
    let mut parts: Vec<&&Entry> =
        entries.iter().filter(|e| !wanted.is_empty() && folded(&e.name).contains(&wanted)).collect();
    if parts.is_empty() && !wanted.is_empty() {
        // Words with others between them: "ColorChecker Ohta 1997".
        parts = entries.iter().filter(|e| matches_search(e, name)).collect();
    }
    match parts.as_slice() {
        [one] => Ok(one),
        [] => Err(NameError::Unknown { kind, name: name.to_owned(), nearest: nearest(&entries, &wanted) }),
        many => {
            let candidates = many.iter().take(5).map(|e| e.name.clone()).collect();
            Err(NameError::Ambiguous { name: name.to_owned(), candidates })
        }
    }
}

/// Up to three names that are like the wanted one.
fn nearest(entries: &[&Entry], wanted: &str) -> Vec<String> {
    let mut scored: Vec<(f64, &str)> =
        entries.iter().map(|e| (strsim::jaro_winkler(&folded(&e.name), wanted), e.name.as_str())).collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    scored.iter().filter(|s| s.0 > 0.7).take(3).map(|s| s.1.to_owned()).collect()
}
