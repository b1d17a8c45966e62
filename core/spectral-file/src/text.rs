//! Bytes to text: limits, binary files, encodings, line ends.

#[cfg(feature = "encodings")]
use encoding_rs::{GBK, SHIFT_JIS, UTF_16BE, UTF_16LE, WINDOWS_1252};
use std::borrow::Cow;

use crate::binary::{bare_utf16, binary};
use crate::decision::Encoding;
use crate::error::{MAX_BYTES, ReadError};

/// The text of a file and the encoding it was in. NUL padding, which some instruments write, is removed.
pub(super) fn decode(bytes: &[u8]) -> Result<(Cow<'_, str>, Encoding), ReadError> {
    if bytes.len() > MAX_BYTES {
        return Err(ReadError::TooLarge { megabytes: bytes.len().div_ceil(1 << 20), limit: MAX_BYTES >> 20 });
    }
    if let Some(kind) = binary(bytes) {
        return Err(ReadError::Binary(kind));
    }
    #[cfg(feature = "encodings")]
    let (text, encoding) = decode_any(bytes);
    #[cfg(not(feature = "encodings"))]
    let (text, encoding) = decode_utf8(bytes)?;
    let text = if text.contains('\0') { Cow::Owned(text.replace('\0', "")) } else { text };
    if text.trim().is_empty() {
        return Err(ReadError::Empty);
    }
    Ok((text, encoding))
}

#[cfg(not(feature = "encodings"))]
fn decode_utf8(bytes: &[u8]) -> Result<(Cow<'_, str>, Encoding), ReadError> {
    let rest = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let other = |_| ReadError::NotBuilt { what: "text in another encoding than UTF-8", feature: "encodings" };
    if bare_utf16(bytes).is_some() {
        return Err(ReadError::NotBuilt { what: "text in UTF-16", feature: "encodings" });
    }
    std::str::from_utf8(rest).map(|text| (Cow::Borrowed(text), Encoding::Utf8)).map_err(other)
}

#[cfg(feature = "encodings")]
fn decode_any(bytes: &[u8]) -> (Cow<'_, str>, Encoding) {
    let mut marked = [(b"\xFF\xFE", Encoding::Utf16Le), (b"\xFE\xFF", Encoding::Utf16Be)].into_iter();
    let marked = marked.find_map(|(mark, encoding)| Some((bytes.strip_prefix(mark)?, encoding)));
    if let Some((rest, encoding)) = marked.or_else(|| Some((bytes, bare_utf16(bytes)?))) {
        let utf16 = if encoding == Encoding::Utf16Le { UTF_16LE } else { UTF_16BE };
        return (utf16.decode_without_bom_handling(rest).0, encoding);
    }
    let rest = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    match std::str::from_utf8(rest) {
        Ok(text) => (Cow::Borrowed(text), Encoding::Utf8),
        Err(_) => match (shift_jis(rest), gbk(rest)) {
            (Some(text), _) => (text, Encoding::ShiftJis),
            (None, Some(text)) => (text, Encoding::Gbk),
            (None, None) if is_dos(rest) => {
                let text = WINDOWS_1252.decode_without_bom_handling(rest).0;
                (Cow::Owned(text.replace('æ', "µ").replace('ý', "²").replace('ø', "°")), Encoding::Dos)
            }
            (None, None) => {
                // No western language has so many accented letters side by side.
                let pair = |run: &&[u8]| run.len() > 1 && run.iter().any(|byte| *byte >= 0xC0);
                let pairs = rest.split(u8::is_ascii).filter(pair).count();
                let unknown = pairs > 2 || rest.split(u8::is_ascii).any(|run| run.len() > 2);
                let encoding = if unknown { Encoding::Unknown } else { Encoding::Windows1252 };
                (WINDOWS_1252.decode_without_bom_handling(rest).0, encoding)
            }
        },
    }
}

/// True where m² or µW is written as in the code pages 437 and 850: no word has such letters there.
#[cfg(feature = "encodings")]
fn is_dos(bytes: &[u8]) -> bool {
    bytes.windows(2).any(|pair| pair == b"m\xFD" || pair == b"\xE6W")
}

/// Bytes that are sound Shift-JIS and hold more of its common characters than of what accented letters look like in it.
#[cfg(feature = "encodings")]
fn shift_jis(bytes: &[u8]) -> Option<Cow<'_, str>> {
    const FEWEST: usize = 2;
    let (mut common, mut rare) = (0, 0);
    let mut rest = bytes.iter();
    while let Some(&byte) = rest.next() {
        match byte {
            0x81..=0x9F => {
                common += 1;
                rest.next();
            }
            0xE0..=0xFC => {
                rare += 1;
                rest.next();
            }
            0x80.. => rare += 1,
            _ => {}
        }
    }
    if common < FEWEST || common <= rare {
        return None;
    }
    SHIFT_JIS.decode_without_bom_handling_and_without_replacement(bytes)
}

/// Bytes that are sound GBK and hold one of its words for spectra or colors, which no two accented letters make.
#[cfg(feature = "encodings")]
fn gbk(bytes: &[u8]) -> Option<Cow<'_, str>> {
    const WORDS: &str = "波长|波長|波数|反射|透射|透过|吸收|吸光|强度|光谱|辐射|照度|响应|灵敏|光源|样品|样本|数据|测量|测试|名称|编号|日期|\
        时间|平均|红|绿|蓝|黄|黑|灰|紫";
    let is_lead = |byte: &u8| (0xA1..=0xFE).contains(byte);
    // Most files in Windows-1252 have one such byte alone, as in µm or °C.
    let paired = bytes.split(u8::is_ascii).all(|run| run.len() % 2 == 0 && run.iter().all(is_lead));
    let text = paired.then(|| GBK.decode_without_bom_handling_and_without_replacement(bytes))??;
    has_part(&text, WORDS).then_some(text)
}

/// A part of a text that knows where in the text it stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section<'a> {
    pub(super) text: &'a str,
    pub(super) line: usize,
    pub(super) byte: usize,
}

impl<'a> Section<'a> {
    pub(super) fn whole(text: &'a str) -> Self {
        Self { text, line: 1, byte: 0 }
    }

    pub(super) fn after(self, line: usize) -> Self {
        let mut lines = Lines::of(self);
        for _ in self.line..line {
            lines.next();
        }
        Self { text: lines.rest, line, byte: self.byte + self.text.len() - lines.rest.len() }
    }
}

/// The lines of a text with their numbers from 1. `\n`, `\r\n` and a lone `\r` each end a line.
#[derive(Debug, Clone)]
pub(super) struct Lines<'a> {
    rest: &'a str,
    number: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self::of(Section::whole(text))
    }

    pub(super) fn of(section: Section<'a>) -> Self {
        Self { rest: section.text, number: section.line - 1 }
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, &'a str);

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let bytes = self.rest.as_bytes();
        let Some(end) = bytes.iter().position(|&b| b == b'\n' || b == b'\r') else {
            return Some((self.number, std::mem::take(&mut self.rest)));
        };
        let line = &self.rest[..end];
        let ending = if bytes[end..].starts_with(b"\r\n") { 2 } else { 1 };
        self.rest = &self.rest[end + ending..];
        Some((self.number, line))
    }
}

/// The text of a comment line (`# …`, `;; …`, `; …` as IDL has it, or `% …` as MATLAB and LaTeX have it), or `None`. A line that
/// begins with a spreadsheet's error cell is no comment, `%R` is a name, and more semicolons separate.
pub(super) fn comment(line: &str) -> Option<&str> {
    let line = line.trim_start();
    let marked = |mark: char| line.strip_prefix(mark).map(|rest| rest.trim_start_matches(mark));
    let alone = || !line[1..].contains([';', ',', '\t']);
    if let Some(rest) = marked('%').or_else(|| marked(';').filter(|_| line.starts_with(";;") || alone())) {
        return (rest.is_empty() || rest.starts_with(' ')).then(|| rest.trim());
    }
    let rest = line.strip_prefix('#')?;
    let error_cell = ["N/A", "DIV/0!", "NUM!", "VALUE!", "REF!", "NAME?"].iter().any(|cell| rest.starts_with(cell));
    // As the name of a column that counts the rows it is none.
    let heads = |sign: &str| rest.starts_with(sign) && rest.matches(sign).count() > 1;
    (!error_cell && ![",", ";", "\t"].into_iter().any(heads)).then(|| rest.trim_start_matches('#').trim())
}

/// Longer header lines are prose, or hostile.
const LONGEST: usize = 2000;

/// Lower case, without what no header needs; empty if the text is too long to be a header.
pub(super) fn lower(text: &str) -> String {
    if text.len() > LONGEST { String::new() } else { text.to_lowercase() }
}

pub(super) fn words(lower: &str) -> impl Iterator<Item = &str> {
    lower.split(|c: char| !c.is_alphanumeric() && c != '-' && c != '^' && c != '/').filter(|word| !word.is_empty())
}

/// Returns whether a word of a text in lower case begins with one of the parts between bars: `emission` is in `emission lines`, not
/// in `remission`.
pub(super) fn begins(lower: &str, parts: &str) -> bool {
    let is_start = |at: usize| !lower[..at].ends_with(|c: char| c.is_ascii_alphabetic());
    let mut parts = parts.split('|').filter(|part| !part.is_empty());
    parts.any(|part| lower.match_indices(part).any(|(at, _)| is_start(at)))
}

pub(super) fn is_one(word: &str, list: &str) -> bool {
    list.split('|').any(|listed| listed == word)
}

/// Returns whether a text in lower case has one of the parts between bars in it.
pub(super) fn has_part(lower: &str, list: &str) -> bool {
    list.split('|').any(|part| lower.contains(part))
}

/// Returns whether a text in lower case has one of the words between bars.
pub(super) fn has_word(lower: &str, list: &str) -> bool {
    words(lower).any(|word| is_one(word, list))
}

/// A header with blanks between the words of names such as `LeafReflectance`, in lower case.
pub(super) fn spaced(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 8);
    for c in text.chars().filter(|_| text.len() <= LONGEST) {
        if c.is_uppercase() && out.ends_with(char::is_lowercase) {
            out.push(' ');
        }
        out.push(c);
    }
    out.to_lowercase()
}

/// At most the first 40 characters of a piece of text, for messages.
pub(super) fn excerpt(text: &str) -> String {
    const LIMIT: usize = 40;
    match text.char_indices().nth(LIMIT) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

pub(super) fn listed(all: &[String]) -> String {
    const MOST: usize = 4;
    let first = all[..all.len().min(MOST)].join(", ");
    if all.len() > MOST { format!("{first} and {} more", all.len() - MOST) } else { first }
}

/// A name and the unit behind a slash, as ISO 80000 has it: `Frequency/THz`, `λ / nm`. What stands before is letters alone.
pub(super) fn slashed(text: &str) -> Option<(&str, &str)> {
    let (name, unit) = text.split_once('/').map(|(name, unit)| (name.trim(), unit.trim()))?;
    let letters = name.starts_with(char::is_alphabetic) && !name.contains(|c: char| c.is_ascii_digit() || c == '(');
    Some((name, unit)).filter(|(_, unit)| letters && !unit.is_empty())
}
