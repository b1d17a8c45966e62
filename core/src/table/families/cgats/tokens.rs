//! The words of a line: bare, or quoted with `""` for a quote, up to a comment.

use std::borrow::Cow;

/// One word of a line.
#[derive(Debug, Clone, Copy)]
pub(super) enum Token<'a> {
    Bare(&'a str),
    /// Between quotes, doubled quotes still in it.
    Quoted(&'a str),
}

impl<'a> Token<'a> {
    /// The word, if it was not quoted: only such a word can be a keyword of the format.
    pub(super) fn bare(&self) -> Option<&'a str> {
        match self {
            Self::Bare(text) => Some(text),
            Self::Quoted(_) => None,
        }
    }

    /// The word as it is meant.
    pub(super) fn text(&self) -> Cow<'a, str> {
        match self {
            Self::Quoted(text) if text.contains("\"\"") => Cow::Owned(text.replace("\"\"", "\"")),
            Self::Bare(text) | Self::Quoted(text) => Cow::Borrowed(text),
        }
    }

    /// Where the word stands in memory.
    pub(super) fn start(&self) -> *const u8 {
        match self {
            Self::Bare(text) | Self::Quoted(text) => text.as_ptr(),
        }
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
            (Token::Quoted(&inner[..end]), inner.get(end + 1..).unwrap_or_default())
        } else {
            let end = rest.find(char::is_whitespace).unwrap_or(rest.len());
            (Token::Bare(&rest[..end]), &rest[end..])
        };
        rest = after;
        Some(token)
    })
}

/// Where the closing quote stands, or the end.
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
