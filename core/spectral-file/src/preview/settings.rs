//! Lines that were kept as settings with the reading.

use super::super::Reading;
use super::cells;
use super::mark::{Mark, What};

/// The longest line that is looked at.
const LONGEST: usize = 2000;

/// The settings of a reading, in the order of their keys.
#[derive(Debug, Clone, Default)]
pub(super) struct Settings {
    /// The key as keys are compared, and the setting it belongs to.
    keys: Vec<(String, usize)>,
}

impl Settings {
    pub(super) fn of(reading: &Reading) -> Self {
        let mut keys: Vec<(String, usize)> =
            reading.header.iter().enumerate().map(|(index, (key, _))| (compared(key), index)).collect();
        keys.sort_unstable();
        Self { keys }
    }

    /// The mark of a line that holds the key and the value of a setting.
    pub(super) fn mark(&self, line: &str, reading: &Reading) -> Option<Mark> {
        const SEPARATORS: [char; 7] = [':', '=', ',', ';', '\t', ' ', '"'];
        if self.keys.is_empty() || line.len() > LONGEST {
            return None;
        }
        let whole = || Some(Mark::new(cells::trimmed(line), What::Setting));
        let trimmed = line.trim();
        let bare = trimmed.trim_start_matches(['#', '$', '@', '<', '"']).trim_start();
        let quoted = bare.split_once('"').map(|(key, _)| key);
        // Some programs write a remark without its key.
        let marked = bare.len() < trimmed.len();
        if marked && !bare.is_empty() && reading.header.iter().any(|(_, value)| value == bare) {
            return whole();
        }
        let keys = SEPARATORS.iter().filter_map(|c| bare.split_once(*c)).map(|(key, _)| key).chain(quoted);
        for key in keys {
            let key = compared(key);
            let from = self.keys.partition_point(|(known, _)| *known < key);
            let same = self.keys[from..].iter().take_while(|(known, _)| *known == key);
            let mut values = same.filter_map(|(_, index)| reading.header.get(*index));
            if !key.is_empty() && values.any(|(_, value)| line.contains(value.as_str())) {
                return whole();
            }
        }
        None
    }
}

/// A key as keys are compared: letters and digits, in one case.
fn compared(key: &str) -> String {
    key.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
