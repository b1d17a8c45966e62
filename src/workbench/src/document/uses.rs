//! Names available to the user's own sets, and their uses in a document.

use super::imported::ImportedSet;
use super::kind::SetKind;
use super::names::{BuiltInNames, caseless};
use super::render::{GARMENT, RenderSettings};
use super::{CHART, Document, LIGHT, Light, Subset, TRAINING, WhiteBalanceChoice};
use chromascope_core::query::Shared;
use std::collections::{HashMap, HashSet};

/// Number of cameras with a color and a marker of their own.
pub const PLACES: usize = 8;

/// Holder of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holder {
    Own,
    /// A built-in set of the same kind.
    BuiltIn,
}

impl Document {
    /// Present holder of a name for an own set of a kind; `None` if it is free. `except` is the index of the set itself.
    pub fn holder_of(
        &self,
        kind: SetKind,
        name: &str,
        except: Option<usize>,
        built_in: &BuiltInNames,
    ) -> Option<Holder> {
        let wanted = caseless(name);
        let is_taken =
            |(index, set): (usize, &Shared<ImportedSet>)| Some(index) != except && caseless(&set.name) == wanted;
        let own = self.own.iter().enumerate().any(is_taken);
        match (own, built_in.has(kind, name)) {
            (true, _) => Some(Holder::Own),
            (false, true) => Some(Holder::BuiltIn),
            (false, false) => None,
        }
    }

    /// A name that no other set of the kind and no other own set has: `Nikon D70 (own)` if a built-in one is named so,
    /// else `leaf (2)`.
    pub fn free_name(&self, kind: SetKind, wanted: &str, except: Option<usize>, built_in: &BuiltInNames) -> String {
        let others = self.own.iter().enumerate().filter(|(index, _)| Some(*index) != except);
        let taken: HashSet<String> = others.map(|(_, set)| caseless(&set.name)).collect();
        free_name(kind, wanted, &taken, built_in, &mut HashMap::new())
    }

    /// Uses a set: a camera in the comparison, a chart as the patches, a light as the light.
    pub fn put_to_use(&mut self, set: &Shared<ImportedSet>) {
        match SetKind::of_own(set) {
            SetKind::Camera | SetKind::Observer => self.compare(&set.name, SetKind::Camera),
            SetKind::Chart | SetKind::Material => {
                self.chart.clone_from(&set.name);
                self.subset = Subset::All;
            }
            SetKind::Illuminant => self.light = Light::Set(set.name.clone()),
            SetKind::Filter => self.set_filter(&set.name, true),
            SetKind::Unsorted => {}
        }
    }

    /// Compares an opened set that is a camera, while fewer than `most` cameras are compared.
    pub fn compare_camera(&mut self, set: &Shared<ImportedSet>, most: usize) {
        let shown = self.compared.iter().filter(|compared| compared.kind == SetKind::Camera).count();
        if SetKind::of_own(set) == SetKind::Camera && shown < most {
            self.compare(&set.name, SetKind::Camera);
        }
    }

    /// True if a set is compared, or is the light, the chart or a filter.
    pub fn uses(&self, kind: SetKind, name: &str) -> bool {
        match kind {
            SetKind::Camera | SetKind::Observer => self.compared(kind, name).is_some(),
            SetKind::Chart | SetKind::Material => self.chart == name,
            SetKind::Illuminant => matches!(&self.light, Light::Set(light) if light == name),
            SetKind::Filter => self.filters.iter().any(|filter| filter == name),
            SetKind::Unsorted => false,
        }
    }

    /// Updates the uses of an own set after it was renamed; adds none.
    pub fn follow_name(&mut self, kind: SetKind, old: &str, new: &str) {
        match kind {
            SetKind::Camera | SetKind::Observer => {
                for compared in self.compared.iter_mut().filter(|c| c.kind == SetKind::Camera && c.name == old) {
                    new.clone_into(&mut compared.name);
                }
            }
            SetKind::Chart | SetKind::Material => {
                let uses = [&mut self.chart, &mut self.render.material, &mut self.correction.training];
                for used in uses.into_iter().chain(&mut self.render.garment).filter(|used| *used == old) {
                    new.clone_into(used);
                }
            }
            SetKind::Illuminant => {
                if self.light == Light::Set(old.to_owned()) {
                    self.light = Light::Set(new.to_owned());
                }
                if self.white == WhiteBalanceChoice::Light(old.to_owned()) {
                    self.white = WhiteBalanceChoice::Light(new.to_owned());
                }
                if self.correction.second_light.as_deref() == Some(old) {
                    self.correction.second_light = Some(new.to_owned());
                }
            }
            SetKind::Filter => {
                for used in self.filters.iter_mut().filter(|used| *used == old) {
                    new.clone_into(used);
                }
            }
            SetKind::Unsorted => {}
        }
    }

    /// Takes an own set that is no more out of use.
    pub fn forget_name(&mut self, kind: SetKind, name: &str) {
        match kind {
            SetKind::Camera | SetKind::Observer => {
                self.compared.retain(|c| c.kind != SetKind::Camera || c.name != name);
            }
            SetKind::Chart | SetKind::Material => {
                if self.chart == name {
                    CHART.clone_into(&mut self.chart);
                    self.subset = Subset::Five;
                }
                if self.render.material == name {
                    self.render.material = RenderSettings::default().material;
                }
                if self.render.garment.as_deref() == Some(name) {
                    self.render.garment = Some(GARMENT.to_owned());
                }
                if self.correction.training == name {
                    TRAINING.clone_into(&mut self.correction.training);
                }
            }
            SetKind::Illuminant => {
                if self.light == Light::Set(name.to_owned()) {
                    self.light = Light::Set(LIGHT.to_owned());
                }
                if self.white == WhiteBalanceChoice::Light(name.to_owned()) {
                    self.white = WhiteBalanceChoice::Unity;
                }
                if self.correction.second_light.as_deref() == Some(name) {
                    self.correction.second_light = None;
                }
            }
            SetKind::Filter => self.set_filter(name, false),
            SetKind::Unsorted => {}
        }
    }

    /// Renames imported sets of a session from elsewhere whose names are in use; their uses follow.
    pub fn part_names(&mut self, built_in: &BuiltInNames) {
        let mut taken: HashSet<String> = self.own.iter().map(|set| caseless(&set.name)).collect();
        let (mut seen, mut numbers) = (HashSet::new(), HashMap::new());
        for index in 0..self.own.len() {
            let (kind, old) = (SetKind::of_own(&self.own[index]), self.own[index].name.clone());
            // Of two own sets with one name the second was never reached by it.
            let earlier = !seen.insert(caseless(&old));
            if !earlier && !built_in.has(kind, &old) {
                continue;
            }
            if !earlier {
                taken.remove(&caseless(&old));
            }
            let name = free_name(kind, &old, &taken, built_in, &mut numbers);
            if !earlier {
                self.follow_name(kind, &old, &name);
            }
            taken.insert(caseless(&name));
            seen.insert(caseless(&name));
            self.own[index] = Shared::new(ImportedSet { name, ..(*self.own[index]).clone() });
        }
    }

    /// The place of the own set that another reading of a file is of: of the same contents, or of the same file on disk in the
    /// same role, and of the same part of it.
    pub fn same_set(&self, set: &ImportedSet) -> Option<usize> {
        let is_same = |known: &Shared<ImportedSet>| {
            let contents = set.fingerprint.is_some() && set.fingerprint == known.fingerprint;
            let file = set.path.is_some() && set.path == known.path && set.role == known.role;
            (contents || file) && set.wishes.options.part == known.wishes.options.part
        };
        self.own.iter().position(is_same)
    }
}

/// A name that is not among those taken (without case) and not built in. `numbers` remembers up to which number the names of a
/// stem are taken.
fn free_name(
    kind: SetKind,
    wanted: &str,
    taken: &HashSet<String>,
    built_in: &BuiltInNames,
    numbers: &mut HashMap<String, usize>,
) -> String {
    let is_free = |name: &str| !taken.contains(&caseless(name)) && !built_in.has(kind, name);
    let marked = format!("{wanted} (own)");
    if is_free(wanted) {
        return wanted.to_owned();
    }
    if !taken.contains(&caseless(wanted)) && is_free(&marked) {
        return marked;
    }
    let number = numbers.entry(caseless(wanted)).or_insert(2);
    loop {
        let name = format!("{wanted} ({number})");
        *number += 1;
        if is_free(&name) {
            return name;
        }
    }
}
