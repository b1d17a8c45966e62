//! Names of data sets: when two are one, and which are taken.

use std::collections::HashSet;
use std::sync::Arc;

use super::kind::SetKind;

/// A name without case (after full case mapping, so that `STRASSE` is `Straße`): two names with one such form are one name.
pub fn caseless(name: &str) -> String {
    name.chars().flat_map(char::to_uppercase).flat_map(char::to_lowercase).collect()
}

/// Names of the built-in sets, which no imported set of the same kind may have. A clone shares them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BuiltInNames(Arc<HashSet<(SetKind, String)>>);

impl BuiltInNames {
    /// The names of these sets.
    pub fn new<'a>(sets: impl Iterator<Item = (SetKind, &'a str)>) -> Self {
        Self(Arc::new(sets.map(|(kind, name)| (kind, caseless(name))).collect()))
    }

    /// True if a built-in set of a kind has a name. Patches are chosen from charts and materials alike.
    pub fn has(&self, kind: SetKind, name: &str) -> bool {
        let name = caseless(name);
        let has = |kind| self.0.contains(&(kind, name.clone()));
        match kind {
            SetKind::Chart | SetKind::Material => has(SetKind::Chart) || has(SetKind::Material),
            _ => has(kind),
        }
    }
}
