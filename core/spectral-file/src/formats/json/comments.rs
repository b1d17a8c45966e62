//! Removal of comments from JSON, preserving all positions.

use std::borrow::Cow;

use crate::error::ReadError;
use crate::watch::Log;

/// Bytes between two looks at the watch: some milliseconds.
const STRIDE: usize = 1 << 20;

/// Context of a byte in a document.
#[derive(Clone, Copy, PartialEq)]
enum In {
    Code,
    String,
    Line,
    Block,
}

/// Comments become spaces, so that lines and columns in errors are those of the file.
pub(super) fn blank<'a>(text: &'a str, log: &Log<'_>) -> Result<Cow<'a, str>, ReadError> {
    if !text.contains("//") && !text.contains("/*") {
        return Ok(Cow::Borrowed(text));
    }
    let mut bytes = text.as_bytes().to_vec();
    let (mut state, mut at, mut next_look) = (In::Code, 0, STRIDE);
    while at < bytes.len() {
        if at >= next_look {
            next_look = at + STRIDE;
            log.look(0)?;
        }
        let pair = (bytes[at], bytes.get(at + 1).copied().unwrap_or(0));
        let (next, width) = match (state, pair) {
            (In::Code, (b'"', _)) => (In::String, 1),
            (In::Code, (b'/', b'/')) => (In::Line, 2),
            (In::Code, (b'/', b'*')) => (In::Block, 2),
            (In::String, (b'\\', _)) => (In::String, 2),
            (In::String, (b'"', _)) | (In::Line, (b'\n' | b'\r', _)) => (In::Code, 1),
            (In::Block, (b'*', b'/')) => (In::Code, 2),
            (state, _) => (state, 1),
        };
        let comment = |state| matches!(state, In::Line | In::Block);
        if comment(state) || comment(next) {
            let end = (at + width).min(bytes.len());
            bytes[at..end].iter_mut().filter(|byte| !matches!(byte, b'\n' | b'\r')).for_each(|byte| *byte = b' ');
        }
        state = next;
        at += width;
    }
    // Comments are replaced whole, so no character is cut.
    Ok(Cow::Owned(String::from_utf8(bytes).unwrap_or_default()))
}
