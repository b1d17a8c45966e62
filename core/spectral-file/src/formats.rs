//! Formats of spectral files. A new one is a file here, with a line in [`FORMATS`].

mod agf;
mod camspec;
mod cgats;
#[cfg(feature = "xml")]
mod cxf;
mod jcamp;
#[cfg(feature = "json")]
mod json;
mod lamp_meter;
mod macam;
mod perkin_elmer;
pub(super) mod spectra;
mod svc;
mod table;
mod tidy;
#[cfg(feature = "xml")]
mod tm27;
#[cfg(feature = "xml")]
mod xml;

use crate::decision::{Decided, Family, Reader};
use crate::error::ReadError;
use crate::formats::spectra::Found;
use crate::options::ReadOptions;
use crate::text::Lines;
use crate::watch::Log;

/// A format: its reader with the words for it, and how it is recognized.
struct Format {
    reader: Reader,
    fits: fn(&Head<'_>) -> bool,
    read: fn(&str, &ReadOptions, &mut Log<'_>) -> Result<Found, ReadError>,
}

struct Head<'a> {
    text: &'a str,
    family: Option<Family>,
    /// True if the format was chosen, so that less has to speak for it.
    chosen: bool,
}

impl<'a> Head<'a> {
    fn new(text: &'a str, chosen: bool) -> Self {
        Self { text, family: family(text), chosen }
    }

    fn is(&self, family: Family) -> bool {
        self.family == Some(family)
    }

    /// Returns whether the text is of no family, or taken for none.
    fn is_plain(&self) -> bool {
        self.chosen || self.family.is_none()
    }

    /// Returns whether a format that begins lines so was chosen.
    fn is_chosen_for(&self, start: &str) -> bool {
        self.chosen && Lines::new(self.text).any(|(_, line)| line.trim_start().starts_with(start))
    }
}

/// Every format, in the order of a list of choices. The last that fits reads a text.
const FORMATS: &[Format] = &[
    table::FORMAT,
    tidy::FORMAT,
    cgats::FORMAT,
    jcamp::FORMAT,
    #[cfg(feature = "xml")]
    tm27::FORMAT,
    #[cfg(feature = "xml")]
    cxf::FORMAT,
    #[cfg(feature = "json")]
    json::RAWTOACES,
    #[cfg(feature = "json")]
    json::DCAMPROF,
    #[cfg(feature = "json")]
    json::ENLIGHTEN,
    #[cfg(feature = "json")]
    json::JSON,
    lamp_meter::FORMAT,
    macam::FORMAT,
    camspec::FORMAT,
    svc::FORMAT,
    perkin_elmer::FORMAT,
    agf::FORMAT,
];

impl Reader {
    /// The readers of all formats.
    pub const ALL: [Self; FORMATS.len()] = {
        let mut all = [Self::TABLE; FORMATS.len()];
        let mut at = 0;
        while at < all.len() {
            all[at] = FORMATS[at].reader;
            at += 1;
        }
        all
    };
}

/// Reads a text with the reader that was chosen, or with the one its content indicates.
pub(super) fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let Some(chosen) = options.reader else { return (recognize(text)?.read)(text, options, log) };
    let head = Head::new(text, true);
    let format = FORMATS.iter().find(|format| format.reader == chosen && (format.fits)(&head));
    let other = || ReadError::OtherLayout(chosen);
    let found = (format.ok_or_else(other)?.read)(text, options, log)?;
    // Formats of one family have a reader in common, which finds out which of them it is.
    if found.reader.value != chosen {
        return Err(other());
    }
    Ok(Found { reader: Decided::chosen(chosen), ..found })
}

fn recognize(text: &str) -> Result<&'static Format, ReadError> {
    let head = Head::new(text, false);
    let found = FORMATS.iter().rev().find(|format| (format.fits)(&head));
    found.ok_or(match head.family {
        Some(Family::Xml) if !cfg!(feature = "xml") => ReadError::NotBuilt { what: "XML", feature: "xml" },
        Some(Family::Json) if !cfg!(feature = "json") => ReadError::NotBuilt { what: "JSON", feature: "json" },
        Some(family) => ReadError::Unsupported(family),
        None => ReadError::NoNumbers,
    })
}

/// Bytes of the text that are searched for the marks of a family.
const LOOK: usize = 64 << 10;

const CGATS_FORMAT: &str = "BEGIN_DATA_FORMAT";

fn family(text: &str) -> Option<Family> {
    let start = text.trim_start();
    if start.starts_with("<?xml") || (start.starts_with('<') && start.trim_end().ends_with('>')) {
        return Some(Family::Xml);
    }
    if jcamp::recognize(&start[..floor(start)]) {
        return Some(Family::Jcamp);
    }
    // `[SpectrumHeader]` is the key of a section.
    let section = |rest: &str| {
        rest.lines().next().is_some_and(|key| key.trim_end().ends_with(']') && key.starts_with(char::is_alphabetic))
    };
    let list = start.strip_prefix('[').is_some_and(|rest| start.trim_end().ends_with(']') && !section(rest));
    if begins_object(start) || list || commented_json(start) {
        return Some(Family::Json);
    }
    if is_yaml(start) {
        return Some(Family::Yaml);
    }
    let head = &text[..floor(text)];
    let cgats = head.contains(CGATS_FORMAT) && head.lines().any(|line| line.trim() == CGATS_FORMAT);
    cgats.then_some(Family::Cgats)
}

/// Returns whether a text begins as an object of JSON does, or one with quotes of another kind. Others write remarks in braces.
fn begins_object(start: &str) -> bool {
    start.strip_prefix('{').is_some_and(|rest| {
        let rest = rest.trim_start();
        rest.is_empty() || rest.starts_with(['"', '\'', '}', '/'])
    })
}

/// Returns whether a text begins with a list of numbers as YAML writes it: `wavelengths: [300, 301, …`.
fn is_yaml(start: &str) -> bool {
    let start = start.strip_prefix("---").unwrap_or(start).trim_start();
    let line = start.lines().next().unwrap_or_default();
    let is_key = |key: &str| key.bytes().all(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-'));
    let list = line.split_once(": [").filter(|(key, _)| is_key(key)).and_then(|(_, list)| list.split_once(", "));
    list.is_some_and(|(first, _)| first.trim().parse::<f64>().is_ok())
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
