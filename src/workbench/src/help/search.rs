//! Full-text search over the help pages.

use super::{Page, markdown::Block};

/// Characters of context on each side of a match.
const CONTEXT: usize = 40;

/// A place where a search matches.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hit {
    /// Name of the page.
    pub page: &'static str,
    /// Index of the block on its page.
    pub block: usize,
    /// The nearest heading above, or the page's title.
    pub heading: String,
    /// The match with its context.
    pub excerpt: String,
}

/// The words of a query, folded for comparison.
pub fn terms(query: &str) -> Vec<String> {
    query.split_whitespace().map(str::to_lowercase).collect()
}

/// Blocks that contain every word of the query: headings first, then text in the order of the pages.
pub fn search(pages: &[Page], query: &str) -> Vec<Hit> {
    let terms = terms(query);
    if terms.is_empty() {
        return Vec::new();
    }
    let mut hits: Vec<(bool, Hit)> = pages.iter().flat_map(|page| on_page(page, &terms)).collect();
    hits.sort_by_key(|(heading, _)| !heading);
    hits.into_iter().map(|(_, hit)| hit).collect()
}

fn on_page(page: &Page, terms: &[String]) -> Vec<(bool, Hit)> {
    let mut hits = Vec::new();
    let mut heading = page.title.clone();
    for (block, content) in page.blocks.iter().enumerate() {
        let words = content.words();
        let is_heading = matches!(content, Block::Heading { .. });
        if is_heading {
            heading.clone_from(&words);
        }
        let folded = words.to_lowercase();
        if terms.iter().all(|term| folded.contains(term)) {
            let excerpt = excerpt(&words, &terms[0]);
            hits.push((is_heading, Hit { page: page.name, block, heading: heading.clone(), excerpt }));
        }
    }
    hits
}

/// The first match of a term with its context, in one line.
fn excerpt(words: &str, term: &str) -> String {
    let letters: Vec<char> = words.chars().map(|c| if c == '\n' { ' ' } else { c }).collect();
    let term: Vec<char> = term.chars().collect();
    let same = |part: &[char]| part.iter().zip(&term).all(|(a, b)| a.to_lowercase().eq(b.to_lowercase()));
    let at = letters.windows(term.len()).position(same).unwrap_or(0);
    let mut start = at.saturating_sub(CONTEXT);
    // From a word's beginning on.
    while start > 0 && start < at && letters[start - 1] != ' ' {
        start += 1;
    }
    let end = (at + term.len() + CONTEXT).min(letters.len());
    let text: String = letters[start..end].iter().collect();
    format!("{}{}{}", if start > 0 { "…" } else { "" }, text.trim(), if end < letters.len() { "…" } else { "" })
}
