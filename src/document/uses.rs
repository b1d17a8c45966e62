//! Which names the user's own sets may have, and what a document uses them as.

use super::own::OwnSet;
use super::render::RenderSettings;
use super::{CHART, Document, LIGHT, Light, Subset, WhiteChoice};
use crate::catalog::{Entry, Kind, is_built_in};
use chromascope_core::query::Shared;

/// So many cameras at once have a color and a marker of their own.
pub const PLACES: usize = 8;

/// What has a name already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holder {
    /// Another own set.
    Own,
    /// A built-in set of the same kind.
    BuiltIn,
}

impl Document {
    /// What has a name that an own set of a kind is to have; none if it is free. `except` is the place of the set itself.
    pub fn holder_of(&self, kind: Kind, name: &str, except: Option<usize>) -> Option<Holder> {
        let own = self.own.iter().enumerate().any(|(index, set)| Some(index) != except && set.name == name);
        match (own, is_built_in(kind, name)) {
            (true, _) => Some(Holder::Own),
            (false, true) => Some(Holder::BuiltIn),
            (false, false) => None,
        }
    }

    /// A name that no other set of the kind has and no other own set: `Nikon D70 (own)` beside a built-in one, else
    /// `leaf (2)`.
    pub fn free_name(&self, kind: Kind, wanted: &str, except: Option<usize>) -> String {
        let holder = |name: &str| self.holder_of(kind, name, except);
        let marked = || format!("{wanted} (own)");
        match holder(wanted) {
            None => return wanted.to_owned(),
            Some(Holder::BuiltIn) if holder(&marked()).is_none() => return marked(),
            Some(_) => {}
        }
        let names = (2..).map(|number| format!("{wanted} ({number})"));
        names.take(self.own.len() + 2).find(|name| holder(name).is_none()).unwrap_or_else(marked)
    }

    /// Shows what was just opened: a camera in the list, a chart as the patches, a light as the light.
    pub fn put_to_use(&mut self, set: &Shared<OwnSet>) {
        match Entry::from_own(set).kind {
            Kind::Camera | Kind::Observer => self.compare(&set.name, Kind::Camera),
            Kind::Chart | Kind::Material => {
                self.chart.clone_from(&set.name);
                self.subset = Subset::All;
            }
            Kind::Illuminant => self.light = Light::Set(set.name.clone()),
            Kind::Unsorted => {}
        }
    }

    /// Shows what was opened among others: a camera, while there are places for more.
    pub fn put_beside(&mut self, set: &Shared<OwnSet>) {
        let shown = self.compared.iter().filter(|compared| compared.kind == Kind::Camera).count();
        if Entry::from_own(set).kind == Kind::Camera && shown < PLACES {
            self.compare(&set.name, Kind::Camera);
        }
    }

    /// Keeps an own set that has another name now in the uses it had; it gets no others.
    pub fn follow_name(&mut self, kind: Kind, old: &str, new: &str) {
        match kind {
            Kind::Camera | Kind::Observer => {
                for compared in self.compared.iter_mut().filter(|c| c.kind == Kind::Camera && c.name == old) {
                    new.clone_into(&mut compared.name);
                }
            }
            Kind::Chart | Kind::Material => {
                for used in [&mut self.chart, &mut self.render.material].into_iter().filter(|used| *used == old) {
                    new.clone_into(used);
                }
            }
            Kind::Illuminant => {
                if self.light == Light::Set(old.to_owned()) {
                    self.light = Light::Set(new.to_owned());
                }
                if self.white == WhiteChoice::Light(old.to_owned()) {
                    self.white = WhiteChoice::Light(new.to_owned());
                }
            }
            Kind::Unsorted => {}
        }
    }

    /// Takes an own set that is no more out of use.
    pub fn forget_name(&mut self, kind: Kind, name: &str) {
        match kind {
            Kind::Camera | Kind::Observer => self.compared.retain(|c| c.kind != Kind::Camera || c.name != name),
            Kind::Chart | Kind::Material => {
                if self.chart == name {
                    CHART.clone_into(&mut self.chart);
                    self.subset = Subset::Five;
                }
                if self.render.material == name {
                    self.render.material = RenderSettings::default().material;
                }
            }
            Kind::Illuminant => {
                if self.light == Light::Set(name.to_owned()) {
                    self.light = Light::Set(LIGHT.to_owned());
                }
                if self.white == WhiteChoice::Light(name.to_owned()) {
                    self.white = WhiteChoice::Unity;
                }
            }
            Kind::Unsorted => {}
        }
    }

    /// Gives own sets of a session from elsewhere names that no other set has; what used them goes on doing so.
    pub(super) fn part_names(&mut self) {
        for index in 0..self.own.len() {
            let set = (*self.own[index]).clone();
            let kind = Entry::from_own(&self.own[index]).kind;
            // Of two own sets with one name the second was never reached by it.
            let earlier = self.own[..index].iter().any(|other| other.name == set.name);
            if !earlier && !is_built_in(kind, &set.name) {
                continue;
            }
            let name = self.free_name(kind, &set.name, Some(index));
            if !earlier {
                self.follow_name(kind, &set.name, &name);
            }
            self.own[index] = Shared::new(OwnSet { name, ..set });
        }
    }
}
