//! Document as JSON. A session file has its imported sets by value. Between runs it is saved small, as it is written with every
//! change: the curves are in files of their own, each written once; the document names the file and the place in it. Fields that
//! this version does not know are kept, and written back where they were.

use std::collections::{HashMap, HashSet};

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::Shared;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::imported::{ImportedCurve, ImportedSet, Role, same_but_folders};
use super::names::BuiltInNames;
use super::start::Start;
use super::{Document, MOST_COMPARED, SetKind, VERSION};

pub const ENDING: &str = "chromascope";
/// Key of the view in a session file.
const VIEW: &str = "view";
/// Key of a set whose curves are in another file.
const CURVES_IN: &str = "curves_in";

#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    #[error("{0}")]
    Json(#[from] serde_json::Error),
    #[error("this is not a Chromascope session (its format is \"{0}\")")]
    Format(String),
    #[error("{0} sensors are compared, but at most {MOST_COMPARED} can be shown; remove some from \"compared\"")]
    Compared(usize),
    #[error("{0} Update to open it")]
    Newer(String),
    #[error("{0}")]
    Set(String),
}

/// The file that holds a set's curves, by name, and their place in its list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Place(pub String, pub usize);

#[derive(Debug)]
pub struct LoadedDocument {
    pub document: Document,
    /// Places of the curves of its sets, in their order; none for a set that the document holds itself.
    pub places: Vec<Option<Place>>,
    /// Sets that could not be read: each with the reason.
    pub lost: Vec<String>,
    /// Parts of a document of a newer version that are not understood here, in a sentence.
    pub newer: Option<String>,
}

/// The document as JSON, indented, with a final newline.
pub fn to_json(document: &Document) -> Result<String, SessionError> {
    Ok(text(&value_of(document)?))
}

/// A session as JSON: the document with its curves, and the view. Files go by their names: a session is passed on, and folders are
/// those of this computer.
pub fn to_session(document: &Document, view: &impl Serialize) -> Result<String, SessionError> {
    let mut value = value_of(&Document { session: None, ..document.clone() })?;
    for set in value.get_mut("own").and_then(Value::as_array_mut).into_iter().flatten() {
        set.as_object_mut().map(|set| set.remove("path"));
    }
    value["render"]["mesh"] = serde_json::to_value(document.render.mesh.without_folder())?;
    let mut view = serde_json::to_value(view)?;
    if let Some(Value::Object(rest)) = document.unknown.get(VIEW) {
        put_back(&mut view, rest);
    }
    value[VIEW] = view;
    Ok(text(&value))
}

fn value_of(document: &Document) -> Result<Value, serde_json::Error> {
    let mut value = serde_json::to_value(document)?;
    put_back(&mut value, &document.unknown);
    Ok(value)
}

/// JSON with each list of numbers on one line, and a final newline.
fn text(value: &Value) -> String {
    let mut text = String::new();
    write(value, 0, &mut text);
    text + "\n"
}

fn write(value: &Value, depth: usize, text: &mut String) {
    let line = |depth: usize| format!("\n{:1$}", "", 2 * depth);
    let is_nested = |value: &Value| value.is_array() || value.is_object();
    match value {
        Value::Object(fields) if !fields.is_empty() => {
            for (index, (key, field)) in fields.iter().enumerate() {
                text.push_str(if index == 0 { "{" } else { "," });
                text.push_str(&line(depth + 1));
                text.push_str(&Value::from(key.as_str()).to_string());
                text.push_str(": ");
                write(field, depth + 1, text);
            }
            text.push_str(&(line(depth) + "}"));
        }
        Value::Array(items) if items.iter().any(is_nested) || items.iter().any(Value::is_string) => {
            for (index, item) in items.iter().enumerate() {
                text.push_str(if index == 0 { "[" } else { "," });
                text.push_str(&line(depth + 1));
                write(item, depth + 1, text);
            }
            text.push_str(&(line(depth) + "]"));
        }
        _ => text.push_str(&value.to_string()),
    }
}

/// Takes the view of a session from a document that was read; its unknown fields stay. Also returns the names of the fields that
/// could not be read.
pub fn take_view<V: DeserializeOwned + Serialize>(document: &mut Document) -> Option<(V, Vec<String>)> {
    let mut value = document.unknown.remove(VIEW)?;
    let refused = value.as_object_mut().map(take_unreadable::<V>)?;
    let view: V = serde_json::from_value(value.clone()).ok()?;
    if let Some(rest) = unknown_fields(&value, &serde_json::to_value(&view).ok()?) {
        document.unknown.insert(VIEW.to_owned(), rest);
    }
    Some((view, refused))
}

/// A part of the view, without taking it out.
pub fn peek_view<V: DeserializeOwned>(document: &Document) -> Option<V> {
    serde_json::from_value(document.unknown.get(VIEW)?.clone()).ok()
}

/// Removes fields and items of lists that this version does not understand; returns the names of these fields.
fn take_unreadable<T: DeserializeOwned>(fields: &mut Map<String, Value>) -> Vec<String> {
    let is_read = |key: &str, field: &Value| {
        serde_json::from_value::<T>(Value::Object(Map::from_iter([(key.to_owned(), field.clone())]))).is_ok()
    };
    let unread: Vec<String> =
        fields.iter().filter(|(key, field)| !is_read(key, field)).map(|(key, _)| key.clone()).collect();
    for key in &unread {
        match fields.get_mut(key) {
            Some(Value::Array(items)) => items.retain(|item| is_read(key, &Value::Array(vec![item.clone()]))),
            _ => drop(fields.remove(key)),
        }
    }
    unread
}

/// True if a file that begins so is a document.
pub fn is_session(beginning: &[u8]) -> bool {
    let text = String::from_utf8_lossy(&beginning[..beginning.len().min(200)]);
    let spaceless: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    spaceless.starts_with("{\"format\":\"chromascope\"")
}

/// A document from JSON. Unknown fields are preserved; missing fields have their defaults.
pub fn from_json(json: &str) -> Result<Document, SessionError> {
    let mut elsewhere = |_: &Place| Err("its curves are in another file".to_owned());
    let read = from_json_with_places(json, &mut elsewhere)?;
    match (read.lost.into_iter().next(), read.newer) {
        (Some(lost), _) => Err(SessionError::Set(lost)),
        (None, Some(newer)) => Err(SessionError::Newer(newer)),
        (None, None) => Ok(read.document),
    }
}

/// The JSON of a document whose sets have their curves at these places, indented, with a final newline.
pub fn to_json_with_places(document: &Document, places: &[(&ImportedSet, &Place)]) -> Result<String, SessionError> {
    let mut rest = document.clone();
    rest.own.clear();
    let mut value = serde_json::to_value(rest)?;
    let sets = places.iter().map(|(set, place)| {
        let mut head = serde_json::to_value(set.without_curves())?;
        if let Some(head) = head.as_object_mut() {
            head.remove("curves");
            head.insert(CURVES_IN.to_owned(), serde_json::to_value(place)?);
        }
        Ok(head)
    });
    value["own"] = sets.collect::<Result<Vec<Value>, serde_json::Error>>()?.into();
    put_back(&mut value, &document.unknown);
    Ok(serde_json::to_string_pretty(&value)? + "\n")
}

/// A document from JSON, with curves from their places: `curves` reads a file's list. A set that cannot be read is omitted.
pub fn from_json_with_places(
    json: &str,
    curves: &mut dyn FnMut(&Place) -> Result<Vec<ImportedCurve>, String>,
) -> Result<LoadedDocument, SessionError> {
    let mut value: Value = serde_json::from_str(json)?;
    let sets = value.get_mut("own").and_then(Value::as_array_mut).map(std::mem::take).unwrap_or_default();
    let (mut own, mut places, mut lost) = (Vec::new(), Vec::new(), Vec::new());
    let mut foreign = Map::new();
    for set in sets {
        let name = set.get("name").and_then(Value::as_str).unwrap_or("a set").to_owned();
        match with_curves(set, curves) {
            Ok((set, place, unknown)) => {
                foreign.extend(unknown.map(|unknown| (name, unknown)));
                own.push(set);
                places.push(place);
            }
            Err(why) => lost.push(format!("{name}: {why}")),
        }
    }
    let (mut document, newer) = from_value(value, own)?;
    if !foreign.is_empty() {
        document.unknown.insert("own".to_owned(), foreign.into());
    }
    Ok(LoadedDocument { document, places, lost, newer })
}

type SetParts = (ImportedSet, Option<Place>, Option<Value>);

/// A set, the place of its curves, and its unknown fields.
fn with_curves(
    mut set: Value,
    curves: &mut dyn FnMut(&Place) -> Result<Vec<ImportedCurve>, String>,
) -> Result<SetParts, String> {
    let words = |error: serde_json::Error| error.to_string();
    let mut take = |key: &str| set.as_object_mut().and_then(|set| set.remove(key));
    let (place, by_value) = (take(CURVES_IN), take("curves"));
    set["curves"] = Value::Array(Vec::new());
    let place: Option<Place> = place.map(serde_json::from_value).transpose().map_err(words)?;
    let head = ImportedSet::deserialize(&set).map_err(words)?;
    let curves = match (&place, by_value) {
        (Some(place), _) => curves(place)?,
        (None, Some(curves)) => serde_json::from_value(curves).map_err(words)?,
        (None, None) => return Err("it has no curves".to_owned()),
    };
    let unknown = unknown_fields(&set, &serde_json::to_value(&head).map_err(words)?);
    Ok((ImportedSet { curves, ..head }, place, unknown))
}

/// A document from JSON without its sets, and these; of a newer version, what is understood, with a sentence about the rest.
fn from_value(mut value: Value, own: Vec<ImportedSet>) -> Result<(Document, Option<String>), SessionError> {
    rename_fields(&mut value);
    let version = value.get("version").and_then(Value::as_u64);
    if version == Some(1) {
        renew(&mut value, &own)?;
    }
    let newer = version.filter(|version| *version > u64::from(VERSION));
    let refused = match value.as_object_mut().filter(|_| newer.is_some()) {
        Some(fields) => {
            fields.insert("version".to_owned(), VERSION.into());
            take_unreadable::<Document>(fields)
        }
        None => Vec::new(),
    };
    let mut document = Document::deserialize(&value)?;
    if document.format != "chromascope" {
        return Err(SessionError::Format(document.format));
    }
    if let Some(Value::Object(rest)) = unknown_fields(&value, &serde_json::to_value(&document)?) {
        document.unknown = rest;
    }
    let newer = newer.map(|version| sentence_of_newer(version, &document.unknown, &refused));
    document.version = VERSION;
    document.own = own.into_iter().map(Shared::new).collect();
    document.mend();
    if document.compared.len() > MOST_COMPARED {
        return Err(SessionError::Compared(document.compared.len()));
    }
    Ok((document, newer))
}

/// Parts of a document of a newer version that are not understood, in a sentence.
fn sentence_of_newer(version: u64, foreign: &Map<String, Value>, refused: &[String]) -> String {
    use std::fmt::Write as _;
    let mut words =
        format!("written by a newer version of Chromascope (format {version}; this version reads up to {VERSION}).");
    let known = serde_json::to_value(Document::default()).unwrap_or_default();
    let name = |key: &String| if known.get(key).is_some() { format!("a part of {key}") } else { key.clone() };
    let names: Vec<String> = foreign.keys().filter(|key| *key != VIEW).map(name).collect();
    if !names.is_empty() {
        let _ = write!(words, " Unknown here, and kept: {}.", names.join(", "));
    }
    if !refused.is_empty() {
        let _ = write!(words, " Not understood here, and skipped: {}.", refused.join(", "));
    }
    words
}

/// Fields of versions 1 to 3, with their present names.
const RENAMED_FIELDS: [(&str, &str); 2] = [("truth", "reference"), ("way", "transform")];

/// Gives the fields of earlier versions their present names.
fn rename_fields(value: &mut Value) {
    let Some(fields) = value.as_object_mut() else { return };
    for (before, now) in RENAMED_FIELDS {
        if !fields.contains_key(now)
            && let Some(field) = fields.remove(before)
        {
            fields.insert(now.to_owned(), field);
        }
    }
}

/// Names of built-in sets used in version 1, with their present names.
const RENAMED: [(&str, &str); 2] =
    [("Nikon D70", "Nikon D70 (2007 figure)"), ("Canon EOS 10D", "Canon EOS 10D (2007 figure)")];

/// Converts a document of version 1 to the present format: cameras by their present names; missing parts are those of the
/// paper's start, which was the only one.
fn renew(value: &mut Value, own: &[ImportedSet]) -> Result<(), SessionError> {
    let Some(old) = value.as_object_mut() else { return Ok(()) };
    let is_own = |name: &str| own.iter().any(|set| set.role == Role::Camera && set.name == *name);
    for compared in old.get_mut("compared").and_then(|list| list.as_array_mut()).into_iter().flatten() {
        let Some(known) = name(compared).filter(|name| !is_own(name)).map(str::to_owned) else { continue };
        if compared.get("kind").and_then(|kind| kind.as_str()) != Some("camera") {
            continue;
        }
        if let Some((_, now)) = RENAMED.iter().find(|(before, _)| *before == known) {
            compared["name"] = (*now).into();
        }
    }
    old.insert("version".to_owned(), VERSION.into());
    // ΔE*00 was all that the first version began with; under Eq 13, where it is none, the distance in the diagram takes its place.
    let was_fitted = old.get("transform").is_some_and(|transform| transform.as_str() != Some("paper"));
    if !was_fitted && old.get("difference").and_then(|d| d.as_str()).is_some_and(|d| d.starts_with("delta-e")) {
        old.remove("difference");
        let diagram = old.get("diagram").and_then(|diagram| diagram.as_str());
        let distance = if diagram == Some("uv-prime") { Metric::UV_PRIME } else { Metric::XY };
        old.insert("difference".to_owned(), distance.id.into());
    }
    let Value::Object(defaults) = serde_json::to_value(Start::Paper.document())? else { return Ok(()) };
    for (key, default) in defaults {
        old.entry(key).or_insert(default);
    }
    Ok(())
}

/// Fields of a value that its known form lacks, in the same nesting; items of lists are told apart by `name`.
fn unknown_fields(value: &Value, known: &Value) -> Option<Value> {
    let mut rest = Map::new();
    match (value, known) {
        (Value::Object(fields), Value::Object(known)) => {
            for (key, field) in fields {
                let unknown = known.get(key).map_or_else(|| Some(field.clone()), |known| unknown_fields(field, known));
                rest.extend(unknown.map(|unknown| (key.clone(), unknown)));
            }
        }
        (Value::Array(items), Value::Array(known)) => {
            let by_name: HashMap<&str, &Value> =
                known.iter().rev().filter_map(|known| name(known).map(|name| (name, known))).collect();
            for item in items {
                let Some(name) = name(item) else { continue };
                let known = by_name.get(name);
                rest.extend(
                    known.and_then(|known| unknown_fields(item, known)).map(|unknown| (name.to_owned(), unknown)),
                );
            }
        }
        _ => {}
    }
    (!rest.is_empty()).then_some(Value::Object(rest))
}

/// Writes unknown fields back. Known ones stay as they are.
fn put_back(value: &mut Value, unknown: &Map<String, Value>) {
    match value {
        Value::Object(fields) => {
            for (key, rest) in unknown {
                match (fields.get_mut(key), rest) {
                    (None, _) => drop(fields.insert(key.clone(), rest.clone())),
                    (Some(field), Value::Object(rest)) => put_back(field, rest),
                    (Some(_), _) => {}
                }
            }
        }
        Value::Array(items) => {
            for item in items {
                let rest = name(item).and_then(|name| unknown.get(name)).and_then(Value::as_object);
                if let Some(rest) = rest.cloned() {
                    put_back(item, &rest);
                }
            }
        }
        _ => {}
    }
}

fn name(record: &Value) -> Option<&str> {
    record.get("name")?.as_str()
}

impl Document {
    /// True if another document is the same in a session's file, where files have no folders.
    pub fn is_same_session(&self, other: &Self) -> bool {
        let rest = |document: &Self| {
            let mut rest = Self { own: Vec::new(), session: None, unknown: Map::new(), ..document.clone() };
            rest.render.mesh = rest.render.mesh.without_folder();
            rest
        };
        rest(self) == rest(other) && same_but_folders(&self.own, &other.own)
    }

    /// Brings values that a file could have spoiled back into their ranges, so that everything past this is total.
    fn mend(&mut self) {
        let [low, high] = super::LOCUS_RANGE_K;
        self.temperature_k = if self.temperature_k.is_finite() { self.temperature_k.clamp(low, high) } else { 5500.0 };
        self.pixel = self.pixel.filter(|pixel| pixel.electrons().is_ok());
        let reference = self.reference.clone();
        if !self.compared.iter().any(|c| c.kind == SetKind::Observer && c.name == reference) {
            self.compare(&reference, SetKind::Observer);
        }
        if !self.transform.metrics().contains(&self.difference) {
            self.difference = self.transform.preferred_metric(self.diagram);
        }
        self.part_names(&BuiltInNames::default());
        let mut seen = HashSet::new();
        self.compared.retain(|c| seen.insert((c.kind, c.name.clone())));
        self.render.mend();
        self.correction.mend();
    }
}
