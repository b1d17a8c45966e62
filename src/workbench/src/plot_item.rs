//! Items that can be hovered, selected or pinned, shared by all panes.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use chromascope_figure::Tag;

pub use crate::document::SensorId;
use crate::document::SetKind;

/// Something on screen that can be hovered, selected or pinned: a camera or observer (its key, its locus, its curves); a patch,
/// through one sensor or (a column head, a reflectance curve) through none; a blackbody through a sensor; the light; a set of the
/// library that is no sensor (a chart, a light, a filter, a material).
#[derive(Clone, Debug, PartialEq)]
pub enum PlotItem {
    Sensor(SensorId),
    Patch { source: Option<SensorId>, patch: String },
    Radiator { source: SensorId, kelvin: f64 },
    Light,
    DataSet { kind: SetKind, name: String },
}

/// Relation of a drawn item to the hovered or selected one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// Identical item, or a part or the whole of it.
    Same,
    /// The item's reference: the reference's patch for a camera's.
    Reference,
    Other,
}

impl PlotItem {
    pub fn of_set(kind: SetKind, name: &str) -> Self {
        let name = name.to_owned();
        match kind {
            SetKind::Camera | SetKind::Observer => Self::Sensor(SensorId { kind, name }),
            _ => Self::DataSet { kind, name },
        }
    }

    pub fn source(&self) -> Option<&SensorId> {
        match self {
            Self::Sensor(source) | Self::Radiator { source, .. } => Some(source),
            Self::Patch { source, .. } => source.as_ref(),
            Self::Light | Self::DataSet { .. } => None,
        }
    }

    /// Hash of the item; equal items have equal hashes.
    fn hashed(&self) -> u64 {
        let kelvin = if let Self::Radiator { kelvin, .. } = self { (*kelvin + 0.0).to_bits() } else { 0 };
        let mut hasher = DefaultHasher::new();
        (self.source(), self.patch(), kelvin).hash(&mut hasher);
        hasher.finish()
    }

    pub fn patch(&self) -> Option<&str> {
        match self {
            Self::Patch { patch, .. } => Some(patch),
            _ => None,
        }
    }

    /// True if both are patches, or equal: neither is part of the other.
    pub fn is_alike(&self, other: &Self) -> bool {
        self == other || matches!((self, other), (Self::Patch { .. }, Self::Patch { .. }))
    }

    pub fn relation_to(&self, drawn: &Self, reference: &str) -> Relation {
        let is_reference = |s: Option<&SensorId>| s.is_some_and(|s| s.kind == SetKind::Observer && s.name == reference);
        let same_source = |a: Option<&SensorId>, b: Option<&SensorId>| a.is_none() || b.is_none() || a == b;
        match (self, drawn) {
            (Self::Light, Self::Light) => Relation::Same,
            (Self::Patch { source: a, patch: p }, Self::Patch { source: b, patch: q }) if p == q => {
                if same_source(a.as_ref(), b.as_ref()) {
                    Relation::Same
                } else if is_reference(b.as_ref()) {
                    Relation::Reference
                } else {
                    Relation::Other
                }
            }
            (Self::Light | Self::DataSet { .. } | Self::Patch { source: None, .. }, _)
            | (_, Self::Light | Self::DataSet { .. } | Self::Patch { source: None, .. })
            | (Self::Patch { .. }, Self::Patch { .. }) => Relation::Other,
            _ if self.source() == drawn.source() => Relation::Same,
            _ if is_reference(drawn.source()) => Relation::Reference,
            _ => Relation::Other,
        }
    }
}

/// The items of a figure's marks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PickIndex {
    all: Vec<PlotItem>,
    /// Indices of the items of each hash: a chart may have a hundred thousand patches.
    places: HashMap<u64, Vec<usize>>,
}

impl PickIndex {
    /// The tag of marks without an item.
    pub const NONE: Tag = Tag(0);

    /// Returns the tag of an item; equal items share a tag.
    pub fn tag(&mut self, thing: PlotItem) -> Tag {
        let places = self.places.entry(thing.hashed()).or_default();
        let known = places.iter().copied().find(|&index| self.all[index] == thing);
        let index = known.unwrap_or_else(|| {
            places.push(self.all.len());
            self.all.push(thing);
            self.all.len() - 1
        });
        Tag(u32::try_from(index + 1).unwrap_or(0))
    }

    pub fn get(&self, tag: Tag) -> Option<&PlotItem> {
        self.all.get((tag.0 as usize).checked_sub(1)?)
    }
}
