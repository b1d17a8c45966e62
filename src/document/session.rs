//! Document as JSON, as saved between runs and in session files.

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::Shared;

use super::imported::{ImportedSet, Role};
use super::kind::SetKind;
use super::names::BuiltInNames;
use super::start::Start;
use super::{Document, MOST_COMPARED, VERSION, saved};

/// Reason that a saved document cannot be opened.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// It is no JSON, or JSON of another shape.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
    /// It is JSON of another program.
    #[error("this is not a Chromascope session (its format is \"{0}\")")]
    Format(String),
    /// More sensors than have a place in the palette.
    #[error("{0} sensors are compared, but at most {MOST_COMPARED} can be shown; remove some from \"compared\"")]
    Compared(usize),
    /// A newer program wrote it.
    #[error(
        "written by a newer version of Chromascope (format {0}; this version reads up to {VERSION}); update to \
             open it"
    )]
    Newer(u32),
    /// One of its imported sets cannot be read.
    #[error("{0}")]
    Set(String),
}

/// The document as JSON, indented, with a final newline.
pub fn to_json(document: &Document) -> Result<String, SessionError> {
    Ok(serde_json::to_string_pretty(document)? + "\n")
}

/// True if a file that begins so is a document.
pub fn is_session(beginning: &[u8]) -> bool {
    let text = String::from_utf8_lossy(&beginning[..beginning.len().min(200)]);
    let spaceless: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    spaceless.starts_with("{\"format\":\"chromascope\"")
}

/// A document from JSON. Unknown fields are preserved; missing fields have their defaults.
pub fn from_json(json: &str) -> Result<Document, SessionError> {
    let mut elsewhere = |_: &saved::Place| Err("its curves are in another file".to_owned());
    let read = saved::from_json(json, &mut elsewhere)?;
    match read.lost.into_iter().next() {
        Some(lost) => Err(SessionError::Set(lost)),
        None => Ok(read.document),
    }
}

/// A document from JSON without its sets, and these.
pub(super) fn from_value(mut value: serde_json::Value, own: Vec<ImportedSet>) -> Result<Document, SessionError> {
    rename_fields(&mut value);
    if value.get("version").and_then(serde_json::Value::as_u64) == Some(1) {
        renew(&mut value, &own)?;
    }
    let mut document: Document = serde_json::from_value(value)?;
    if document.format != "chromascope" {
        return Err(SessionError::Format(document.format));
    }
    if document.version > VERSION {
        return Err(SessionError::Newer(document.version));
    }
    document.version = VERSION;
    document.own = own.into_iter().map(Shared::new).collect();
    document.mend();
    if document.compared.len() > MOST_COMPARED {
        return Err(SessionError::Compared(document.compared.len()));
    }
    Ok(document)
}

/// Fields of versions 1 to 3, with their present names.
const RENAMED_FIELDS: [(&str, &str); 2] = [("truth", "reference"), ("way", "transform")];

/// Gives the fields of earlier versions their present names.
fn rename_fields(value: &mut serde_json::Value) {
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
fn renew(value: &mut serde_json::Value, own: &[ImportedSet]) -> Result<(), SessionError> {
    let Some(old) = value.as_object_mut() else { return Ok(()) };
    let is_own = |name: &String| own.iter().any(|set| set.role == Role::Camera && set.name == *name);
    for compared in old.get_mut("compared").and_then(|list| list.as_array_mut()).into_iter().flatten() {
        let Some(known) = name(compared).filter(|name| !is_own(name)) else { continue };
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
    let serde_json::Value::Object(defaults) = serde_json::to_value(Start::Paper.document())? else { return Ok(()) };
    for (key, default) in defaults {
        old.entry(key).or_insert(default);
    }
    Ok(())
}

/// The name that a record has.
fn name(record: &serde_json::Value) -> Option<String> {
    record.get("name")?.as_str().map(str::to_owned)
}

impl Document {
    /// Brings values that a file could have spoiled back into their ranges, so that everything past this is total.
    fn mend(&mut self) {
        let [low, high] = super::LOCUS_RANGE_K;
        self.temperature_k = if self.temperature_k.is_finite() { self.temperature_k.clamp(low, high) } else { 5500.0 };
        let reference = self.reference.clone();
        if !self.compared.iter().any(|c| c.kind == SetKind::Observer && c.name == reference) {
            self.compare(&reference, SetKind::Observer);
        }
        if !self.transform.metrics().contains(&self.difference) {
            self.difference = self.transform.preferred_metric(self.diagram);
        }
        self.part_names(&BuiltInNames::default());
        let mut seen = std::collections::HashSet::new();
        self.compared.retain(|c| seen.insert((c.kind, c.name.clone())));
        self.render.mend();
        self.correction.mend();
    }
}
