//! What the readers of XML share: which one takes a text, parsing within bounds, places in the text.

use roxmltree::{Document, Node};

use super::super::dialect::{Cell, Dialect};
use super::super::family::Family;
use super::super::text::excerpt;
use super::super::{DecimalMark, Delimiter, ReadError, Reader};

/// How much of the text is looked at for the root element.
const LOOK: usize = 4096;

/// The fewest bytes for each tag, and for each attribute, in a file of spectra: hostile text must not need much more memory
/// than its size.
const FEWEST_BYTES: usize = 16;

/// The reader for the root element of a text.
pub(super) fn recognize(text: &str) -> Option<Reader> {
    let start = &text[..text.floor_char_boundary(LOOK)];
    start.split('<').find_map(|tag| {
        let name = tag.split(|c: char| c.is_whitespace() || matches!(c, '>' | '/')).next()?;
        let local = name.rsplit(':').next()?;
        match local {
            "CxF" => Some(Reader::Cxf),
            _ if local.starts_with("IESTM27") => Some(Reader::Tm27),
            _ => None,
        }
    })
}

/// Parses a text.
pub(super) fn parse(text: &str) -> Result<Document<'_>, ReadError> {
    let most = text.len() / FEWEST_BYTES + 1000;
    let count = |wanted: u8| text.bytes().filter(|byte| *byte == wanted).count();
    if count(b'<') > most || count(b'=') > most {
        return Err(ReadError::Unsupported { family: Family::Xml });
    }
    Document::parse(text).map_err(|error| {
        let place = error.pos();
        ReadError::Malformed { family: Family::Xml, line: place.row as usize, column: place.col as usize }
    })
}

/// Where the lines of a text begin.
pub(super) struct LineIndex(Vec<usize>);

impl LineIndex {
    pub(super) fn new(text: &str) -> Self {
        Self(text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at).collect())
    }

    /// The line of a node, from 1.
    pub(super) fn line(&self, node: Node) -> usize {
        self.0.partition_point(|&end| end < node.range().start) + 1
    }
}

/// The elements below a node with a local name, whatever their namespace.
pub(super) fn elements<'a, 'input: 'a>(
    node: Node<'a, 'input>,
    name: &'static str,
) -> impl Iterator<Item = Node<'a, 'input>> {
    node.descendants().filter(move |node| node.is_element() && node.tag_name().name() == name)
}

/// The text of an element, trimmed.
pub(super) fn content<'a>(node: Node<'a, '_>) -> &'a str {
    node.text().unwrap_or_default().trim()
}

/// A number; NaN for a gap.
pub(super) fn number(text: &str, line: usize) -> Result<f64, ReadError> {
    match (Dialect { delimiter: Delimiter::Elements, mark: DecimalMark::Point }).parse(text.trim()) {
        Cell::Number(value) => Ok(value),
        Cell::Gap => Ok(f64::NAN),
        Cell::Text => Err(ReadError::NotANumber { line, column: 1, text: excerpt(text.trim()) }),
    }
}
