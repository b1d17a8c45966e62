//! Catalog of the data sets, built in and imported.
//!
//! The index consists of headers alone; a set's values are parsed when a query first needs them ([`load`]), and are
//! cached with the other answers.

pub mod chart_picture;
pub mod file_store;
pub mod folders;
pub mod import;
pub mod likeness;
pub mod load;
pub mod meshes;
pub mod names;
pub mod narrow_bands;
pub mod opened;
pub mod recorded;
pub mod recorded_store;
pub mod spectral_images;

use std::hash::{Hash, Hasher};

use chromascope_core::query::Shared;
use chromascope_core::spectral::{Dataset, Header};

use crate::document::SetKind;
use crate::document::imported::ImportedSet;
use crate::document::names::{BuiltInNames, caseless};

/// Location of a set's figures: a file of the program, with the value column if it holds several sets; or a set of the user's, held by
/// value.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Place {
    BuiltIn { file: BuiltInFile, column: Option<usize> },
    Own(Shared<ImportedSet>),
}

#[derive(Clone, Copy, Debug, Eq)]
pub struct BuiltInFile {
    pub path: &'static str,
    pub text: &'static str,
}

impl PartialEq for BuiltInFile {
    fn eq(&self, other: &Self) -> bool {
        // Files of one catalog share their text, so it is rarely compared.
        self.path == other.path && (std::ptr::eq(self.text, other.text) || self.text == other.text)
    }
}

impl Hash for BuiltInFile {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.path.hash(state);
    }
}

#[derive(Clone, Debug)]
pub struct Entry {
    pub kind: SetKind,
    pub name: String,
    /// A shorter name for narrow places; the name itself if there is none.
    pub short: String,
    /// A gloss shown after the name.
    pub also: Option<String>,
    pub place: Place,
    /// The facts about a built-in set.
    pub header: Option<Header>,
}

impl Entry {
    pub fn is_own(&self) -> bool {
        matches!(self.place, Place::Own(_))
    }

    /// True if an observer's color matching functions are XYZ, by its column heads alone: nothing is parsed for a menu.
    pub fn counts_in_xyz(&self) -> bool {
        self.header.as_ref().is_some_and(|header| header.columns.first().is_some_and(|head| head == "x_bar"))
    }

    /// True if its figures were read off a published figure.
    pub fn is_digitized(&self) -> bool {
        self.header.as_ref().is_some_and(Header::is_digitized)
    }

    /// Its name with its gloss, as lists of lights show it: "A, incandescent 2856 K".
    pub fn glossed_name(&self) -> String {
        self.also.as_ref().map_or_else(|| self.name.clone(), |also| format!("{}, {also}", self.name))
    }

    /// Words that find it beside its name: short name, gloss and kind.
    pub fn gloss(&self) -> String {
        let kind = if self.kind == SetKind::Illuminant { "CIE light illuminant" } else { self.kind.label() };
        format!("{} {kind} {}", self.synonyms(), self.kind.key())
    }

    /// Short name, gloss and the words of the file by which it is found.
    pub fn synonyms(&self) -> String {
        let found_by = self.header.as_ref().and_then(|header| header.found_by.as_deref());
        format!("{} {} {}", self.short, self.also.as_deref().unwrap_or_default(), found_by.unwrap_or_default())
    }

    pub fn from_own(set: &Shared<ImportedSet>) -> Self {
        let name = set.name.clone();
        Self {
            kind: SetKind::of_own(set),
            short: name.clone(),
            name,
            also: Some("yours".to_owned()),
            place: Place::Own(set.clone()),
            header: None,
        }
    }
}

#[derive(Clone, Debug)]
pub struct Catalog {
    entries: Vec<Entry>,
    names: BuiltInNames,
}

impl Catalog {
    /// Reads the headers of all built-in files; their figures are not parsed.
    pub fn built_in() -> Self {
        Self::built_in_with(&[])
    }

    /// The built-in sets and those of further data files: the catalog of a program that was built with these files in `assets`.
    pub fn built_in_with(further: &[BuiltInFile]) -> Self {
        let mut entries = Vec::new();
        for kind in SetKind::ALL {
            let built_in = chromascope_data::files(kind.key()).map(|(path, text)| BuiltInFile { path, text });
            let is_of_kind = |file: &BuiltInFile| file.path.split('/').next() == Some(kind.key());
            for file in built_in.chain(further.iter().copied().filter(is_of_kind)) {
                if let Ok(header) = Dataset::read_header(file.text) {
                    add_entries(&mut entries, kind, file, &header);
                }
            }
        }
        entries.sort_by_cached_key(|e| {
            // Of one model's tables the measured ones come first.
            (
                e.kind,
                names::rank_in_use(e),
                names::sort_key(names::model_of(&e.name)),
                e.is_digitized(),
                names::sort_key(&e.name),
            )
        });
        let names = BuiltInNames::new(entries.iter().map(|entry| (entry.kind, entry.name.as_str())));
        Self { entries, names }
    }

    pub fn names(&self) -> &BuiltInNames {
        &self.names
    }

    /// All sets, by kind and then by name, lights in common use first; of one model, measured tables before digitized ones.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    pub fn of_kind(&self, kind: SetKind) -> impl Iterator<Item = &Entry> {
        self.entries.iter().filter(move |entry| entry.kind == kind)
    }

    /// The set of this name, else the one whose name differs by case alone.
    pub fn get(&self, kind: SetKind, name: &str) -> Option<&Entry> {
        let exact = self.of_kind(kind).find(|entry| entry.name == name);
        exact.or_else(|| {
            let wanted = caseless(name);
            self.of_kind(kind).find(|entry| caseless(&entry.name) == wanted)
        })
    }
}

pub fn licenses() -> impl Iterator<Item = (&'static str, &'static str)> {
    chromascope_data::files("licenses").map(|(path, text)| (path.rsplit('/').next().unwrap_or(path), text))
}

/// A file is one set, or, with several value columns of lights, filters or materials, as many.
fn add_entries(entries: &mut Vec<Entry>, kind: SetKind, file: BuiltInFile, header: &Header) {
    // Coefficients from which daylight of any temperature is made; no light themselves.
    if file.path == load::DAYLIGHT_BASIS {
        return;
    }
    let many = matches!(kind, SetKind::Illuminant | SetKind::Filter | SetKind::Material) && header.columns.len() > 1;
    let names: Vec<(String, Option<usize>)> = if many {
        header.columns.iter().enumerate().map(|(column, name)| (name.clone(), Some(column))).collect()
    } else {
        vec![(header.title.clone(), None)]
    };
    for (name, column) in names {
        let short = header.short.clone().filter(|_| column.is_none()).unwrap_or_else(|| name.clone());
        let also = header.also.clone().or_else(|| column.map(|_| header.title.clone()));
        let place = Place::BuiltIn { file, column };
        entries.push(Entry { kind, name, short, also, place, header: Some(header.clone()) });
    }
}
