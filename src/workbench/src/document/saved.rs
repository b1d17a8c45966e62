//! Document as saved between runs: small, as it is written with every change. The curves of imported sets are in files of
//! their own, each written once; the document names the file and the place in it.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::imported::{ImportedCurve, ImportedSet};
use super::session::{SessionError, from_value};
use super::{Document, unknown};

/// Key of a set whose curves are in another file.
const CURVES_IN: &str = "curves_in";

/// The file that holds a set's curves, by name, and their place in its list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Place(pub String, pub usize);

/// A document that was read, with its missing parts.
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

/// The JSON of a document whose sets have their curves at these places, indented, with a final newline.
pub fn to_json(document: &Document, places: &[(&ImportedSet, &Place)]) -> Result<String, SessionError> {
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
    unknown::put_back(&mut value, &document.unknown);
    Ok(serde_json::to_string_pretty(&value)? + "\n")
}

/// A document from JSON, with curves from their places: `curves` reads a file's list. A set that cannot be read is omitted.
pub fn from_json(
    json: &str,
    curves: &mut dyn FnMut(&Place) -> Result<Vec<ImportedCurve>, String>,
) -> Result<LoadedDocument, SessionError> {
    let mut value: Value = serde_json::from_str(json)?;
    let sets = value.get_mut("own").and_then(Value::as_array_mut).map(std::mem::take).unwrap_or_default();
    let (mut own, mut places, mut lost) = (Vec::new(), Vec::new(), Vec::new());
    let mut foreign = serde_json::Map::new();
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
    let unknown = unknown::of(&set, &serde_json::to_value(&head).map_err(words)?);
    Ok((ImportedSet { curves, ..head }, place, unknown))
}
