//! Base of the readers of XML: choice of the reader, elements one after the other, places in the text.
//!
//! The text is pulled through `quick-xml`, so that a file needs no memory beyond the elements that are open. What an encoding
//! declaration says is of no interest, because the text is decoded already. Entities are the five of XML and characters by
//! number; those that a file declares for itself are refused, never expanded.

use quick_xml::XmlVersion;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesRef, BytesStart, Event};
use quick_xml::reader::Reader as Parser;
use std::borrow::Cow;

use crate::decision::{Decided, DecimalMark, Delimiter, Family, Reader, WavelengthUnit};
use crate::dialect::Dialect;
use crate::error::ReadError;
use crate::formats::spectra::{self, Found, Spectrum};
use crate::formats::{Head, recognize};
use crate::header::Header;
use crate::text::excerpt;
use crate::watch::{Log, PlaceId};

/// The deepest nesting that is followed; files of spectra stay below ten.
const DEEPEST: usize = 200;

/// Returns whether the root element of a document is of a format. One that is of no format is read as what was chosen.
pub(super) fn fits(head: &Head<'_>, is_root: impl FnOnce(&str) -> bool) -> bool {
    head.is(Family::Xml) && (root(head.text).is_some_and(is_root) || head.chosen && recognize(head.text).is_err())
}

fn root(text: &str) -> Option<&str> {
    let mut parser = Parser::from_str(text);
    let tag = loop {
        let from = parser.buffer_position() as usize;
        match parser.read_event() {
            Ok(Event::Start(_) | Event::Empty(_)) => break &text[from..],
            // A truncated tag still shows the intended format.
            Err(_) => break text.get(parser.error_position() as usize..)?,
            Ok(Event::Eof) => return None,
            Ok(_) => {}
        }
    };
    tag.strip_prefix('<')?.split(|c: char| c.is_whitespace() || matches!(c, '>' | '/')).next().map(local)
}

fn local(name: &str) -> &str {
    name.rsplit(':').next().unwrap_or(name)
}

/// An element: its tag, and once it is closed, the text that stands in it beside other elements.
pub(super) struct Element<'a> {
    tag: BytesStart<'a>,
    /// Offset in the tag of the name without its namespace.
    local: usize,
    /// The line of the tag, from 1.
    pub(super) line: usize,
    text: Cow<'a, str>,
    /// The byte and the line where the text begins.
    text_from: (usize, usize),
}

impl Element<'_> {
    pub(super) fn name(&self) -> &str {
        utf8(&self.tag.name().into_inner()[self.local..])
    }

    /// The value of an attribute without a namespace.
    pub(super) fn attribute(&self, name: &str) -> Result<Option<Cow<'_, str>>, ReadError> {
        let broken = |_| ReadError::Malformed { family: Family::Xml, line: self.line, column: 1 };
        let Some(attribute) = self.tag.try_get_attribute(name).map_err(|error| broken(error.into()))? else {
            return Ok(None);
        };
        attribute.normalized_value(XmlVersion::Implicit1_0).map(Some).map_err(broken)
    }

    /// The number in an attribute; NaN for a gap.
    pub(super) fn number_attribute(&self, name: &str) -> Result<Option<f64>, ReadError> {
        self.attribute(name)?.map(|text| number(&text, self.line)).transpose()
    }

    pub(super) fn content(&self) -> &str {
        self.text.trim()
    }

    /// The number that is the text; NaN for a gap.
    pub(super) fn number(&self) -> Result<f64, ReadError> {
        number(&self.text, self.line)
    }

    /// Records the number in an attribute and the one that is the text, as a sample.
    pub(super) fn pair(&self, name: &str, log: &mut Log<'_>) -> PlaceId {
        let Some(places) = &mut log.places else { return PlaceId::default() };
        match self.attribute(name) {
            Ok(Some(Cow::Borrowed(wavelength))) => places.pair(wavelength.trim(), self.content()),
            _ => PlaceId::default(),
        }
    }

    /// The numbers in the text, separated by white space; NaN for gaps.
    pub(super) fn numbers(
        &self,
        log: &mut Log<'_>,
        mut take: impl FnMut(f64, PlaceId) -> Result<(), ReadError>,
    ) -> Result<(), ReadError> {
        let (from, first_line) = self.text_from;
        let (mut done, mut found) = (0, from);
        for cell in self.text.split_ascii_whitespace() {
            done += cell.len() + 1;
            log.at(from + done)?;
            let value = parse(cell).ok_or_else(|| {
                let before = cell.as_ptr() as usize - self.text.as_ptr() as usize;
                not_a_number(cell, first_line + line_ends(&self.text[..before]))
            })?;
            let place = log.places.as_mut().map(|places| places.find(&mut found, cell)).unwrap_or_default();
            take(value, place)?;
        }
        Ok(())
    }
}

fn number(text: &str, line: usize) -> Result<f64, ReadError> {
    let text = text.trim();
    parse(text).ok_or_else(|| not_a_number(text, line))
}

fn parse(text: &str) -> Option<f64> {
    Dialect::new(Delimiter::Elements, DecimalMark::Point).value(text)
}

fn not_a_number(text: &str, line: usize) -> ReadError {
    ReadError::NotANumber { line, column: 1, text: excerpt(text) }
}

fn line_ends(text: &str) -> usize {
    let either = text.bytes().filter(|byte| matches!(byte, b'\n' | b'\r')).count();
    let pairs = text.as_bytes().windows(2).filter(|pair| *pair == b"\r\n").count();
    either - pairs
}

/// Spectra as the result of a format that prescribes nanometers.
pub(super) fn found(
    spectra: Vec<Spectrum>,
    header: Header,
    (reader, why): (Decided<Reader>, &str),
    log: &mut Log<'_>,
) -> Result<Found, ReadError> {
    let first_line = spectra.iter().find_map(|spectrum| spectrum.samples.first()).map(|sample| sample.line);
    let first_line = first_line.ok_or(ReadError::NoNumbers)?;
    let mut grid = spectra::grid(spectra, header, log)?;
    grid.unit = Some(Decided::certain(WavelengthUnit::Nanometer, why));
    Ok(Found::fixed(grid, reader, ((Delimiter::Elements, DecimalMark::Point), first_line, why), Vec::new()))
}

pub(super) enum Step<'a> {
    /// An element begins: [`Walk::innermost`].
    Open,
    /// An element is complete; [`Walk::innermost`] is the one around it.
    Close(Element<'a>),
}

/// A walk through the elements of a text, in the order of the text.
pub(super) struct Walk<'a> {
    text: &'a str,
    parser: Parser<&'a [u8]>,
    open: Vec<Element<'a>>,
    root: Option<String>,
    /// A byte and the line it stands in.
    place: (usize, usize),
}

impl<'a> Walk<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        let mut parser = Parser::from_str(text);
        parser.config_mut().expand_empty_elements = true;
        Self { text, parser, open: Vec::new(), root: None, place: (0, 1) }
    }

    pub(super) fn root(&self) -> &str {
        self.root.as_deref().unwrap_or_default()
    }

    pub(super) fn innermost(&self) -> Option<&Element<'a>> {
        self.open.last()
    }

    /// Advances to the next beginning or end of an element; `None` at the end of a valid text.
    pub(super) fn next(&mut self, log: &mut Log<'_>) -> Result<Option<Step<'a>>, ReadError> {
        loop {
            let from = self.parser.buffer_position() as usize;
            let Ok(event) = self.parser.read_event() else {
                return Err(self.malformed(self.parser.error_position() as usize));
            };
            match event {
                Event::Start(tag) => {
                    log.at(from)?;
                    self.begin(tag, from)?;
                    return Ok(Some(Step::Open));
                }
                Event::End(_) => {
                    let closed = self.open.pop().ok_or_else(|| self.malformed(from))?;
                    return Ok(Some(Step::Close(closed)));
                }
                Event::Eof if self.open.is_empty() && self.root.is_some() => return Ok(None),
                Event::Eof => return Err(self.malformed(self.text.len())),
                // Indents.
                Event::Text(text)
                    if utf8(&text).trim_ascii().is_empty()
                        && self.open.last().is_none_or(|open| open.text.is_empty()) => {}
                Event::Text(text) => self.add(text.xml10_content().map_err(|_| self.malformed(from))?, from)?,
                Event::CData(text) => self.add(text.xml10_content().map_err(|_| self.malformed(from))?, from)?,
                Event::GeneralRef(reference) => {
                    log.at(from)?;
                    let text = resolve(&reference).ok_or_else(|| self.malformed(from))?;
                    self.add(Cow::Owned(text), from)?;
                }
                Event::Empty(_) | Event::Comment(_) | Event::Decl(_) | Event::PI(_) | Event::DocType(_) => {
                    log.at(from)?;
                }
            }
        }
    }

    fn begin(&mut self, tag: BytesStart<'a>, from: usize) -> Result<(), ReadError> {
        if self.open.is_empty() && self.root.is_some() {
            return Err(self.malformed(from));
        }
        if self.open.len() >= DEEPEST {
            return Err(ReadError::Unsupported(Family::Xml));
        }
        let line = self.line(from);
        let name = utf8(tag.name().into_inner());
        let local = name.len() - local(name).len();
        let element = Element { tag, local, line, text: Cow::Borrowed(""), text_from: (from, line) };
        self.root.get_or_insert_with(|| element.name().to_owned());
        self.open.push(element);
        Ok(())
    }

    fn add(&mut self, text: Cow<'a, str>, from: usize) -> Result<(), ReadError> {
        let line = self.line(from);
        let Some(element) = self.open.last_mut() else { return Err(self.malformed(from)) };
        if element.text.is_empty() {
            element.text_from = (from, line);
            element.text = text;
        } else {
            element.text.to_mut().push_str(&text);
        }
        Ok(())
    }

    /// The line of a byte that is not before any requested until now.
    fn line(&mut self, byte: usize) -> usize {
        let (from, line) = self.place;
        self.place = (byte, line + line_ends(&self.text[from..byte]));
        self.place.1
    }

    fn malformed(&self, byte: usize) -> ReadError {
        let before = &self.text[..self.text.floor_char_boundary(byte)];
        let start = before.rfind(['\n', '\r']).map_or(0, |end| end + 1);
        let column = before[start..].chars().count() + 1;
        ReadError::Malformed { family: Family::Xml, line: line_ends(before) + 1, column }
    }
}

/// Part of a text that was read from a `str`, cut at ASCII characters.
fn utf8(part: &[u8]) -> &str {
    std::str::from_utf8(part).unwrap_or_default()
}

fn resolve(reference: &BytesRef<'_>) -> Option<String> {
    match reference.resolve_char_ref() {
        Ok(Some(character)) => Some(character.into()),
        Ok(None) => resolve_predefined_entity(utf8(reference)).map(str::to_owned),
        Err(_) => None,
    }
}
