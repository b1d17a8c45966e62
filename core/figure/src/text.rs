//! Widths of text, and its breaking into lines.

use super::mark::{Anchor, TextSize};
use super::rect::Rect;

/// Width of a line of text in points, from the advances of `DejaVu` Sans (rounded, without kerning).
pub fn text_width(text: &str, size: TextSize) -> f64 {
    let advance = |c: char| {
        if size == TextSize::Mono { 0.602 } else { advance(c) }
    };
    text.chars().map(advance).sum::<f64>() * f64::from(size.points())
}

/// Rectangle in points of a line of text whose anchor lies at a place: as high as its line, on screen as on paper.
pub fn text_area(text: &str, size: TextSize, at: [f64; 2], anchor: Anchor) -> Rect {
    let extent = [text_width(text, size), 1.2 * f64::from(size.points())];
    Rect::from_min_size([at[0] - anchor.0 * extent[0], at[1] - anchor.1 * extent[1]], extent)
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

/// True if a word stays in the line of the word before it: a unit or an observer's field after a number, the number of an
/// edition, what a sign stands before, an equals sign.
fn is_bound(before: &str, word: &str) -> bool {
    let bare = word.trim_end_matches(['.', ',', ';', ':', ')']);
    let is_number = before.parse::<f64>().is_ok();
    (is_number && ["K", "µm", "nm", "%", "2°", "10°"].contains(&bare))
        || ["II", "III", "IV"].contains(&bare)
        || ["±", "=", "†"].contains(&before)
        || word == "="
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
                let mut next = word.to_owned();
                while let Some(at) = line.rfind(' ')
                    && is_bound(&line[at + 1..], next.split(' ').next().unwrap_or_default())
                {
                    next = format!("{} {next}", line.split_off(at).trim_start());
                }
                lines.push(std::mem::replace(&mut line, next));
            }
        }
        if !line.is_empty() {
            lines.push(line);
        }
    }
    lines
}
