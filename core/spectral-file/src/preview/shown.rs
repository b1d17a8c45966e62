//! A part of a line in letters of one width.

use std::ops::Range;

/// A part of a line as it is drawn: one visible character for each character, whatever it was.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shown {
    /// Text as drawn. Tabs are arrows, other control characters are dots.
    pub text: String,
    /// True if the line has more before.
    pub more_before: bool,
    /// True if the line has more after.
    pub more_after: bool,
    /// The bytes of the line that are drawn.
    pub window: Range<usize>,
    /// For each character and for the end: its byte in the line, and in the text.
    places: Vec<(usize, usize)>,
}

impl Shown {
    pub(super) fn new(line: &str, from: usize, count: usize) -> Self {
        let start = start(line, from);
        let mut text = String::new();
        let mut places = Vec::new();
        let mut end = start;
        for (at, c) in line[start..].char_indices().take(count) {
            places.push((start + at, text.len()));
            text.push(visible(c));
            end = start + at + c.len_utf8();
        }
        places.push((end, text.len()));
        Self { more_before: start > 0, more_after: end < line.len(), text, window: start..end, places }
    }

    /// The bytes of [`text`](Self::text) that a range of bytes of the line takes; `None` if it is not drawn.
    pub fn map(&self, range: &Range<usize>) -> Option<Range<usize>> {
        if range.start > self.window.end || range.end < self.window.start || range.end < range.start {
            return None;
        }
        let place = |byte: usize| {
            let index = self.places.partition_point(|(at, _)| *at < byte);
            self.places.get(index).map_or(self.text.len(), |(_, shown)| *shown)
        };
        let mapped = place(range.start)..place(range.end);
        (range.is_empty() || !mapped.is_empty()).then_some(mapped)
    }
}

/// The byte at which a character begins, or the end.
fn start(line: &str, character: usize) -> usize {
    line.char_indices().nth(character).map_or(line.len(), |(at, _)| at)
}

fn visible(c: char) -> char {
    match c {
        '\t' => '\u{2192}',
        c if c.is_control() => '\u{00B7}',
        // Marks that turn the direction of text, join what stands around them, or have no width at all.
        '\u{200B}'..='\u{200F}' | '\u{202A}'..='\u{202E}' | '\u{2060}'..='\u{2069}' | '\u{FEFF}' => '\u{00B7}',
        c => c,
    }
}
