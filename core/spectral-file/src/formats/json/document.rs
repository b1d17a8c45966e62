//! Values of a document as they are written, each read when it is asked for, and their places in the text.

use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::fmt;

use crate::decision::Family;
use crate::error::ReadError;
use crate::text::excerpt;
use crate::watch::Log;

/// Bytes between two looks at the watch: some milliseconds.
const STRIDE: usize = 1 << 20;

const MAX_TEXTS: usize = 1000;

#[derive(Debug, Clone, Copy)]
pub(super) struct Value<'a> {
    document: &'a str,
    pub(super) written: &'a str,
}

impl<'a> Value<'a> {
    pub(super) fn whole(document: &'a str) -> Self {
        Self { document, written: document.trim() }
    }

    pub(super) fn offset(self, piece: &str) -> usize {
        piece.as_ptr().addr().saturating_sub(self.document.as_ptr().addr())
    }

    /// The value as a type. JSON in which it is of another holds no spectra where they are looked for.
    pub(super) fn read<T: Deserialize<'a>>(self) -> Result<T, ReadError> {
        serde_json::from_str(self.written).map_err(|error| {
            // A reader of bytes finds the very end of what is sound.
            let broken = serde_json::from_reader::<_, IgnoredAny>(self.written.as_bytes());
            let error = broken.err().unwrap_or(error);
            let lines = self.written.split_inclusive('\n').take(error.line().saturating_sub(1));
            let end = lines.map(str::len).sum::<usize>() + error.column();
            if error.is_data() {
                return ReadError::Unsupported(Family::Json);
            }
            let before = &self.document.as_bytes()[..(self.offset(self.written) + end).min(self.document.len())];
            let start = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
            let line = before.split(|byte| *byte == b'\n').count();
            // As Python writes them.
            let at = before.len().saturating_sub(2).max(start);
            let mut names = ["NaN", "Infinity"].into_iter();
            let rest = self.document.get(at..).unwrap_or_default();
            if let Some(text) = names.find(|name| rest.find(*name).is_some_and(|at| at < 3)) {
                return ReadError::NoJsonNumber { line, text };
            }
            ReadError::Malformed { family: Family::Json, line, column: (before.len() - start).max(1) }
        })
    }

    pub(super) fn members(self) -> Result<Members<'a>, ReadError> {
        let Entries(entries) = self.read()?;
        Ok(Members { whole: self, entries })
    }

    /// The numbers of a list, as they are written.
    pub(super) fn pieces(self) -> impl Iterator<Item = &'a str> {
        let inner = self.written.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')).unwrap_or_default().trim();
        inner.split(',').map(str::trim).filter(move |_| !inner.is_empty())
    }

    /// A number of a list, by its place there; NaN for `null`.
    pub(super) fn number(self, piece: &str, at: usize) -> Result<f64, ReadError> {
        if piece == "null" {
            return Ok(f64::NAN);
        }
        let before = self.document.get(..self.offset(piece)).unwrap_or_default();
        let line = || 1 + before.bytes().filter(|byte| *byte == b'\n').count();
        let wrong = || ReadError::NotANumber { line: line(), column: at + 1, text: excerpt(piece) };
        piece.parse().ok().filter(|number: &f64| number.is_finite()).ok_or_else(wrong)
    }

    /// The members of a list.
    pub(super) fn items(self) -> Result<Vec<&'a str>, ReadError> {
        let items: Vec<&'a RawValue> = self.read()?;
        Ok(items.into_iter().map(RawValue::get).collect())
    }

    /// Another value of the document.
    pub(super) fn with(self, written: &'a str) -> Self {
        Self { written, ..self }
    }

    /// The text, or the texts among the members of a list; what is none is passed over.
    pub(super) fn texts(self) -> Vec<String> {
        let list: Vec<&str> = match serde_json::from_str::<Vec<&RawValue>>(self.written) {
            Ok(list) => list.into_iter().map(RawValue::get).collect(),
            Err(_) => vec![self.written],
        };
        list.into_iter().filter_map(|text| serde_json::from_str(text).ok()).take(MAX_TEXTS).collect()
    }
}

pub(super) struct Members<'a> {
    whole: Value<'a>,
    entries: Vec<(Cow<'a, str>, &'a str)>,
}

impl<'a> Members<'a> {
    pub(super) fn none(whole: Value<'a>) -> Self {
        Self { whole, entries: Vec::new() }
    }

    pub(super) fn each(&self) -> impl ExactSizeIterator<Item = (&Cow<'a, str>, Value<'a>)> {
        self.entries.iter().map(|(name, written)| (name, Value { written, ..self.whole }))
    }

    pub(super) fn get(&self, name: &str) -> Option<Value<'a>> {
        self.each().find(|(other, value)| *other == name && value.written != "null").map(|(_, value)| value)
    }

    pub(super) fn read<T: Deserialize<'a>>(&self, name: &str) -> Result<Option<T>, ReadError> {
        self.get(name).map(Value::read).transpose()
    }

    pub(super) fn members(&self, name: &str) -> Result<Option<Members<'a>>, ReadError> {
        self.get(name).map(Value::members).transpose()
    }
}

struct Entries<'a>(Vec<(Cow<'a, str>, &'a str)>);

impl<'de> Deserialize<'de> for Entries<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InOrder;
        impl<'de> Visitor<'de> for InOrder {
            type Value = Entries<'de>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an object")
            }
            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Entries<'de>, M::Error> {
                let mut entries = Vec::new();
                while let Some((name, value)) = map.next_entry::<&RawValue, &RawValue>()? {
                    let name = name.get();
                    // Most names stand as they are between their quotes.
                    let plain = || Cow::Borrowed(name.trim_matches('"'));
                    let escaped = name.contains('\\').then(|| serde_json::from_str(name).ok()).flatten();
                    entries.push((escaped.map_or_else(plain, Cow::Owned), value.get()));
                }
                Ok(Entries(entries))
            }
        }
        deserializer.deserialize_map(InOrder)
    }
}

/// Context of a byte in a document.
#[derive(Clone, Copy, PartialEq)]
enum In {
    Code,
    String,
    Line,
    Block,
}

/// A text in which comments, and commas behind the last of a list, are spaces, so that lines and columns in errors are those of the
/// file.
pub(super) fn without_comments<'a>(text: &'a str, log: &Log<'_>) -> Result<Cow<'a, str>, ReadError> {
    let spare = || text.split([']', '}']).any(|before| before.trim_end().ends_with(','));
    if !text.contains("//") && !text.contains("/*") && !spare() {
        return Ok(Cow::Borrowed(text));
    }
    let mut bytes = text.as_bytes().to_vec();
    let (mut state, mut at, mut next_look) = (In::Code, 0, STRIDE);
    // The last comma, if nothing but blanks and comments has followed it.
    let mut comma = None;
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
        } else if matches!(pair.0, b']' | b'}') && state == In::Code {
            if let Some(comma) = comma.take() {
                bytes[comma] = b' ';
            }
        } else if !pair.0.is_ascii_whitespace() {
            comma = (pair.0 == b',' && state == In::Code).then_some(at);
        }
        state = next;
        at += width;
    }
    // Comments are replaced whole, so no character is cut.
    Ok(Cow::Owned(String::from_utf8(bytes).unwrap_or_default()))
}
