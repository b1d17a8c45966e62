//! What a person can point at: the same thing in every pane.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use chromascope_figure::Tag;

use crate::catalog::Kind;

/// A source by kind and name.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SourceId {
    /// Camera or observer.
    pub kind: Kind,
    /// Its name in the catalog.
    pub name: String,
}

/// Something on screen that can be hovered, selected or pinned.
#[derive(Clone, Debug, PartialEq)]
pub enum Thing {
    /// A camera or observer: its key, its locus, its curves.
    Source(SourceId),
    /// A patch, through one source or (a column head, a reflectance curve) through none.
    Patch {
        /// The source, if one is meant.
        source: Option<SourceId>,
        /// The patch's name.
        patch: String,
    },
    /// A black body through a source.
    Radiator {
        /// The source.
        source: SourceId,
        /// The temperature in kelvins.
        kelvin: f64,
    },
    /// The light on the scene.
    Light,
}

/// How a drawn thing stands to the one that is pointed at or chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It is that thing, or that thing's part or whole.
    Same,
    /// It is what the thing is compared with: the truth's patch beside a camera's.
    Beside,
    /// Neither.
    Apart,
}

impl Thing {
    /// The source it belongs to, if any.
    pub fn source(&self) -> Option<&SourceId> {
        match self {
            Self::Source(source) | Self::Radiator { source, .. } => Some(source),
            Self::Patch { source, .. } => source.as_ref(),
            Self::Light => None,
        }
    }

    /// A number that equal things share.
    fn hashed(&self) -> u64 {
        let kelvin = if let Self::Radiator { kelvin, .. } = self { (*kelvin + 0.0).to_bits() } else { 0 };
        let mut hasher = DefaultHasher::new();
        (self.source(), self.patch(), kelvin).hash(&mut hasher);
        hasher.finish()
    }

    /// The patch it is, if any.
    pub fn patch(&self) -> Option<&str> {
        match self {
            Self::Patch { patch, .. } => Some(patch),
            _ => None,
        }
    }

    /// How a drawn thing stands to this one.
    pub fn standing_of(&self, drawn: &Self, truth: &str) -> Standing {
        let is_truth = |s: Option<&SourceId>| s.is_some_and(|s| s.kind == Kind::Observer && s.name == truth);
        let same_source = |a: Option<&SourceId>, b: Option<&SourceId>| a.is_none() || b.is_none() || a == b;
        match (self, drawn) {
            (Self::Light, Self::Light) => Standing::Same,
            (Self::Patch { source: a, patch: p }, Self::Patch { source: b, patch: q }) if p == q => {
                if same_source(a.as_ref(), b.as_ref()) {
                    Standing::Same
                } else if is_truth(b.as_ref()) {
                    Standing::Beside
                } else {
                    Standing::Apart
                }
            }
            (Self::Light | Self::Patch { source: None, .. }, _)
            | (_, Self::Light | Self::Patch { source: None, .. })
            | (Self::Patch { .. }, Self::Patch { .. }) => Standing::Apart,
            _ if self.source() == drawn.source() => Standing::Same,
            _ if is_truth(drawn.source()) => Standing::Beside,
            _ => Standing::Apart,
        }
    }
}

/// The things that a figure's marks stand for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Things {
    all: Vec<Thing>,
    /// Indices of the things of each hash: a chart may have a hundred thousand patches.
    places: HashMap<u64, Vec<usize>>,
}

impl Things {
    /// The tag for marks that stand for nothing.
    pub const NONE: Tag = Tag(0);

    /// A tag for a thing; equal things get the same.
    pub fn tag(&mut self, thing: Thing) -> Tag {
        let places = self.places.entry(thing.hashed()).or_default();
        let known = places.iter().copied().find(|&index| self.all[index] == thing);
        let index = known.unwrap_or_else(|| {
            places.push(self.all.len());
            self.all.push(thing);
            self.all.len() - 1
        });
        Tag(u32::try_from(index + 1).unwrap_or(0))
    }

    /// What a tag stands for.
    pub fn get(&self, tag: Tag) -> Option<&Thing> {
        self.all.get((tag.0 as usize).checked_sub(1)?)
    }
}
