//! Words: names of alternatives, and names as they can stand on a screen, on a line and in a cell.

pub mod choice;
mod setting;

pub use choice::{Choice, Words};
pub use setting::{Flag, Look, Number, Pick, Setting, Settings, Value, place, words_of};

use std::borrow::Cow;

/// A text on one line: without control characters (which become spaces), without characters that turn the direction of what
/// follows, and without blanks around it.
pub fn on_one_line(text: &str) -> Cow<'_, str> {
    let text = text.trim();
    if !text.contains(|c| breaks_line(c) || turns_text(c)) {
        return Cow::Borrowed(text);
    }
    let shown = text.chars().filter(|c| !turns_text(*c)).map(|c| if breaks_line(c) { ' ' } else { c });
    Cow::Owned(shown.collect::<String>().trim().to_owned())
}

fn breaks_line(c: char) -> bool {
    c.is_control() || matches!(c, '\u{2028}' | '\u{2029}')
}

/// True if a character turns the direction of the text after it, so that what is shown is not what is there (bidirectional
/// embeddings, overrides and isolates, UAX #9).
pub fn turns_text(c: char) -> bool {
    matches!(c, '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}')
}

/// A text for a cell of a table, on one line, that no spreadsheet takes for a formula: one that begins as a formula and is no
/// number comes after an apostrophe, which marks text there. `unguarded` takes it off.
pub fn guarded(text: &str) -> Cow<'_, str> {
    let text = on_one_line(text);
    if begins_formula(text.trim_start_matches('\'')) { Cow::Owned(format!("'{text}")) } else { text }
}

/// A text as a cell of a delimited table: [`guarded`], and quoted where it has to be.
pub fn cell(text: &str, delimiter: char) -> String {
    quoted(&guarded(text), delimiter)
}

/// A text in quotes if a cell could not hold it without.
pub fn quoted(text: &str, delimiter: char) -> String {
    let needed = text.contains([delimiter, '"', '\n', '\r']);
    if needed { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// A text with its first letter in lower case.
pub fn lowered(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

/// The text of a cell without the apostrophe of [`guarded`].
pub fn unguarded(cell: &str) -> &str {
    match cell.strip_prefix('\'') {
        Some(rest) if begins_formula(rest.trim_start_matches('\'')) => rest,
        _ => cell,
    }
}

/// True if a spreadsheet evaluates a cell. The wide forms count too where East Asian text is typed.
fn begins_formula(text: &str) -> bool {
    text.starts_with(['=', '+', '-', '@', '＝', '＋', '－', '＠']) && text.parse::<f64>().is_err()
}
