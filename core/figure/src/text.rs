//! Text: how wide it is, where it stands around a plot.

use super::{Anchor, Panel, Rect, TextSize};

/// Width of a line of text in points, from the advances of `DejaVu` Sans (rounded, without kerning).
pub fn text_width(text: &str, size: TextSize) -> f64 {
    let advance = |c: char| {
        if size == TextSize::Mono { 0.602 } else { advance(c) }
    };
    text.chars().map(advance).sum::<f64>() * f64::from(size.points())
}

/// Advance of a character in `DejaVu` Sans, relative to the font size.
fn advance(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | 'I' | 'J' | '\'' | '′' => 0.29,
        ' ' | '.' | ',' | ':' | ';' | '/' | '|' | 'f' => 0.345,
        't' | 'r' | '(' | ')' | '[' | ']' | '-' => 0.4,
        's' | 'z' | 'c' | '*' => 0.545,
        'k' | 'v' | 'x' | 'y' | 'L' | 'F' => 0.59,
        '0'..='9' | 'a'..='z' if c != 'm' && c != 'w' => 0.636,
        'm' | 'M' | 'W' | '@' | '%' => 0.96,
        'w' | '+' | '=' | '−' | '±' | '×' => 0.838,
        _ => 0.75,
    }
}

/// Breaks text at spaces into lines not wider than `width` points, unless a single word is.
pub fn wrapped(text: &str, size: TextSize, width: f64) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in text.lines() {
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
            if line.is_empty() || text_width(&longer, size) <= width {
                line = longer;
            } else {
                lines.push(std::mem::replace(&mut line, word.to_owned()));
            }
        }
        if !line.is_empty() {
            lines.push(line);
        }
    }
    lines
}

/// A small text inside a plot's corner: an axis' label, a panel's note.
#[derive(Debug, Clone, PartialEq)]
pub struct Annotation {
    /// Its place in points.
    pub at: [f64; 2],
    /// The text.
    pub text: String,
    /// Point of the text that lies there.
    pub anchor: Anchor,
}

/// Labels of the axes (y upper left, x lower right) and the note (upper right) of a panel whose plot covers the given
/// rectangle, for [`TextSize::Small`] drawn `text_scale` times as large as on screen. None covers another.
pub fn annotations(panel: &Panel, plot: Rect, text_scale: f64) -> Vec<Annotation> {
    let pad = 5.0 * text_scale;
    let width = |text: &str| text_scale * text_width(text, TextSize::Small);
    let beside = width(&panel.y.label) + width(&panel.note) + 4.0 * pad <= plot.width();
    let below = if beside || panel.y.label.is_empty() { 0.0 } else { 16.0 * text_scale };
    let left = plot.min[0] + pad;
    let right = plot.max[0] - pad;
    let top = plot.min[1] + pad;
    [
        ([left, top], &panel.y.label, Anchor::LEFT_TOP),
        ([right, top + below], &panel.note, Anchor::RIGHT_TOP),
        ([right, plot.max[1] - pad], &panel.x.label, Anchor::RIGHT_BOTTOM),
    ]
    .into_iter()
    .filter(|(_, text, _)| !text.is_empty())
    .map(|(at, text, anchor)| Annotation { at, text: text.clone(), anchor })
    .collect()
}
