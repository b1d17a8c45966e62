//! The words of a line: bare, or quoted with `""` for a quote, up to a comment. Between tabs, bare words may have blanks.

use std::borrow::Cow;

#[derive(Debug, Clone, Copy)]
pub(super) struct Token<'a> {
    /// The word as it is written, without the quotes around it.
    pub(super) written: &'a str,
    /// True if it stands between quotes, in which quotes are doubled.
    quoted: bool,
}

impl<'a> Token<'a> {
    fn bare_word(written: &'a str) -> Self {
        Self { written, quoted: false }
    }

    /// The word, if it was not quoted: only such a word can be a keyword of the format.
    pub(super) fn bare(&self) -> Option<&'a str> {
        (!self.quoted).then_some(self.written)
    }

    /// The word as it is meant.
    pub(super) fn text(&self) -> Cow<'a, str> {
        let doubled = self.quoted && self.written.contains("\"\"");
        if doubled { self.written.replace("\"\"", "\"").into() } else { self.written.into() }
    }
}

/// The words of a line. Quotes that are never closed end with the line.
pub(super) fn of(line: &str) -> impl Iterator<Item = Token<'_>> {
    let mut rest = line;
    std::iter::from_fn(move || {
        rest = rest.trim_start();
        if rest.is_empty() || rest.starts_with('#') {
            return None;
        }
        let (token, after) = if let Some(inner) = rest.strip_prefix('"') {
            let end = closing(inner);
            (Token { written: &inner[..end], quoted: true }, inner.get(end + 1..).unwrap_or_default())
        } else {
            let end = rest.find(char::is_whitespace).unwrap_or(rest.len());
            (Token::bare_word(&rest[..end]), &rest[end..])
        };
        rest = after;
        Some(token)
    })
}

/// The value behind a keyword: a word in quotes, or all that follows up to a comment.
pub(super) fn value<'a>(line: &'a str, key: &Token<'a>) -> Option<Token<'a>> {
    let second = of(line).nth(1)?;
    let Some(first) = second.bare() else { return Some(second) };
    let start = first.as_ptr().addr().saturating_sub(line.as_ptr().addr());
    let rest = line.get(start..).filter(|_| key.bare().is_some())?;
    let follows_blank = |(at, _): &(usize, &str)| rest[..*at].ends_with(char::is_whitespace);
    let end = rest.find([' ', '\t']).and_then(|_| rest.match_indices('#').find(follows_blank));
    Some(Token::bare_word(rest[..end.map_or(rest.len(), |(at, _)| at)].trim()))
}

pub(super) fn fields(line: &str) -> Vec<Token<'_>> {
    if !line.contains('\t') {
        return of(line).collect();
    }
    // Names with an underscore, or of wavelengths, have no blanks: several of them may stand between two tabs.
    let names_band = |word: &str| word.bytes().rev().take_while(u8::is_ascii_digit).count() >= 3;
    let several = |cell: &str| cell.contains('_') || cell.split_whitespace().any(names_band);
    let cells = between_tabs(line);
    let names = cells.into_iter().filter(|cell| !cell.is_empty()).flat_map(|cell| match unquoted(cell) {
        token if !token.quoted && !cell.starts_with('#') && cell.contains(' ') && !several(cell) => vec![token],
        _ => of(cell).collect(),
    });
    names.collect()
}

/// The values of a set that takes a whole line: cells between tabs if there are as many as fields, else words.
pub(super) fn set(line: &str, fields: usize) -> Vec<Token<'_>> {
    if line.contains('\t') && !line.trim_start().starts_with('#') {
        let mut cells = between_tabs(line);
        while cells.len() > fields && cells.last().is_some_and(|cell| cell.is_empty()) {
            cells.pop();
        }
        if cells.len() == fields && fields > 1 {
            return cells.into_iter().map(unquoted).collect();
        }
    }
    of(line).collect()
}

/// The pieces of a line between tabs that are not in quotes, without blanks around them.
fn between_tabs(line: &str) -> Vec<&str> {
    let mut quoted = false;
    let pieces = line.split(move |c: char| {
        quoted ^= c == '"';
        c == '\t' && !quoted
    });
    pieces.map(str::trim).collect()
}

/// A piece as a word; an empty one counts as quoted, so that it is no keyword.
fn unquoted(piece: &str) -> Token<'_> {
    let inner = piece.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
    Token { written: inner.unwrap_or(piece), quoted: inner.is_some() || piece.is_empty() }
}

fn closing(text: &str) -> usize {
    let bytes = text.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        match (bytes[at], bytes.get(at + 1)) {
            (b'"', Some(b'"')) => at += 2,
            (b'"', _) => return at,
            _ => at += 1,
        }
    }
    bytes.len()
}
