//! Files of one kind: written by the same program in the same layout.

use serde::{Deserialize, Serialize};

use crate::document::imported::Fingerprint;

/// Layout of a file's beginning without its figures. Equal on every machine, so that it can be saved.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Likeness {
    shapes: Vec<Fingerprint>,
    /// True if some of them hold words.
    words: bool,
}

const LOOK: usize = 1 << 14;
const LINES: usize = 24;
/// A longer line is no header; its beginning suffices.
const WIDTH: usize = 120;
/// The share of their lines that two files of a kind have in common.
const ALIKE: f64 = 0.7;

impl Likeness {
    pub fn of(bytes: &[u8]) -> Self {
        let text = String::from_utf8_lossy(&bytes[..bytes.len().min(LOOK)]);
        let lines = text.split(['\n', '\r']).map(|line| line.trim_matches(['\0', ' ', '\u{feff}']));
        let lines: Vec<String> = lines.filter(|line| !line.is_empty()).take(LINES).map(shape).collect();
        let words = lines.iter().any(|line| line.chars().filter(|c| c.is_alphabetic()).count() >= 2);
        let mut shapes: Vec<Fingerprint> = lines.iter().map(|line| Fingerprint::of(line.as_bytes())).collect();
        shapes.sort_unstable();
        shapes.dedup();
        Self { shapes, words }
    }

    /// True if the kind is identified by more than numbers, so that it is worth remembering.
    pub fn is_telling(&self) -> bool {
        self.words
    }

    pub fn is_like(&self, other: &Self) -> bool {
        let common = self.shapes.iter().filter(|shape| other.shapes.binary_search(shape).is_ok()).count();
        let all = self.shapes.len() + other.shapes.len() - common;
        all > 0 && common as f64 >= ALIKE * all as f64
    }
}

/// A line without what differs from file to file: the key alone of `key: value`, and any number as `0`.
fn shape(line: &str) -> String {
    let line: String = line.chars().filter(|c| *c != '\0').take(WIDTH).collect();
    let begins_with_number =
        line.trim_start().starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.'));
    if !begins_with_number && let Some((key, _)) = line.split_once([':', '=']) {
        return format!("{}:", key.trim());
    }
    let mut shape = String::new();
    let mut in_number = false;
    for c in line.chars() {
        let of_number = c.is_ascii_digit() || (in_number && matches!(c, '.' | 'e' | 'E' | '-' | '+'));
        match (in_number, of_number) {
            (true, true) => {}
            (false, true) => {
                // A sign or a space before it comes and goes with the number.
                let kept = shape.trim_end_matches([' ', '-', '+']).len();
                shape.truncate(kept);
                shape.push('0');
            }
            (_, false) => shape.push(c),
        }
        in_number = of_number;
    }
    shape.trim_end().to_owned()
}
