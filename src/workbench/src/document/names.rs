//! Names of data sets: when two are one, which are taken, and every reference of the document to a set.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use chromascope_core::query::Shared;

use super::imported::ImportedSet;
use super::render::{GARMENT, RenderSettings};
use super::{
    CHART, Document, FIT_TARGET, LIGHT, Light, PAPER_REFERENCE, SetKind, Subset, TRAINING, TransformChoice,
    WhiteBalanceChoice,
};

/// A name without case (after full case mapping, so that `STRASSE` is `Straße`): two names with one such form are one name.
pub fn caseless(name: &str) -> String {
    name.chars().flat_map(char::to_uppercase).flat_map(char::to_lowercase).collect()
}

/// True if two names are one. Case of ASCII letters is mapped one by one, so that thousands of names are compared quickly.
fn is_same(a: &str, b: &str) -> bool {
    if a.is_ascii() && b.is_ascii() { a.eq_ignore_ascii_case(b) } else { caseless(a) == caseless(b) }
}

/// Names of the built-in sets, which no imported set of the same kind may have. A clone shares them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BuiltInNames(Arc<HashSet<(SetKind, String)>>);

impl BuiltInNames {
    pub fn new<'a>(sets: impl Iterator<Item = (SetKind, &'a str)>) -> Self {
        Self(Arc::new(sets.map(|(kind, name)| (kind, caseless(name))).collect()))
    }

    /// True if a built-in set of a kind has a name. Patches are chosen from charts and materials alike.
    pub fn has(&self, kind: SetKind, name: &str) -> bool {
        let name = caseless(name);
        SetKind::ALL.into_iter().any(|of| of.shares_names_with(kind) && self.0.contains(&(of, name.clone())))
    }
}

/// Number of cameras with a color and a marker of their own.
pub const PLACES: usize = 8;

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
        let is_taken = |(index, set): (usize, &Shared<ImportedSet>)| Some(index) != except && is_same(&set.name, name);
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

    /// Visits every reference of the document to a set, with the set's kind: the only list of them. Of a reference that is
    /// not to be kept the start's own set takes the place, if there has to be one.
    pub fn visit_uses(&mut self, mut keep: impl FnMut(SetKind, &mut String) -> bool) {
        self.compared.retain_mut(|compared| keep(compared.kind, &mut compared.name));
        if !keep(SetKind::Observer, &mut self.reference) {
            PAPER_REFERENCE.clone_into(&mut self.reference);
        }
        if let TransformChoice::Observer(name) = &mut self.transform
            && !keep(SetKind::Observer, name)
        {
            FIT_TARGET.clone_into(name);
        }
        if let Light::Set(name) = &mut self.light
            && !keep(SetKind::Illuminant, name)
        {
            LIGHT.clone_into(name);
        }
        self.filters.retain_mut(|name| keep(SetKind::Filter, name));
        if !keep(SetKind::Chart, &mut self.chart) {
            CHART.clone_into(&mut self.chart);
            self.subset = Subset::Five;
        }
        if let WhiteBalanceChoice::Light(name) = &mut self.white
            && !keep(SetKind::Illuminant, name)
        {
            self.white = WhiteBalanceChoice::Unity;
        }
        if !keep(SetKind::Material, &mut self.correction.training) {
            TRAINING.clone_into(&mut self.correction.training);
        }
        if self.correction.second_light.as_mut().is_some_and(|name| !keep(SetKind::Illuminant, name)) {
            self.correction.second_light = None;
        }
        for shot in &mut self.measurement.shots {
            if !keep(SetKind::Chart, &mut shot.chart) {
                CHART.clone_into(&mut shot.chart);
            }
            if let Some(Light::Set(name)) = &mut shot.light
                && !keep(SetKind::Illuminant, name)
            {
                shot.light = None;
            }
        }
        if !keep(SetKind::Material, &mut self.render.material) {
            self.render.material = RenderSettings::default().material;
        }
        if let Some(name) = &mut self.render.garment
            && !keep(SetKind::Material, name)
        {
            GARMENT.clone_into(name);
        }
    }

    /// Updates the references to an own set after it was renamed; adds none.
    pub fn follow_name(&mut self, kind: SetKind, old: &str, new: &str) {
        self.visit_uses(|of, name| {
            if of.shares_names_with(kind) && name == old {
                new.clone_into(name);
            }
            true
        });
    }

    /// Takes an own set that is no more out of use.
    pub fn forget_name(&mut self, kind: SetKind, name: &str) {
        self.visit_uses(|of, used| !of.shares_names_with(kind) || used != name);
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
    /// same role, and of the same part of it; or that was recovered in the same measurement.
    pub fn same_set(&self, set: &ImportedSet) -> Option<usize> {
        let is_same = |known: &Shared<ImportedSet>| {
            let contents = set.fingerprint.is_some() && set.fingerprint == known.fingerprint;
            let file = set.path.is_some() && set.path == known.path && set.role == known.role;
            let measured = set.measured.is_some() && set.measured == known.measured;
            (contents || file) && set.overrides.options.part == known.overrides.options.part || measured
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
