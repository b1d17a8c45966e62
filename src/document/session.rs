//! The document as JSON: what is kept between runs, and what session files are.

use super::{Document, VERSION};
use crate::catalog::Kind;

/// Why a saved document cannot be opened.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// It is no JSON, or JSON of another shape.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
    /// It is JSON of another program.
    #[error("this is not a Chromascope session (its format is \"{0}\")")]
    Format(String),
    /// A newer program wrote it.
    #[error("written by a newer Chromascope (form {0}, this one reads up to {VERSION}); update to open it")]
    Newer(u32),
}

/// The document as JSON, indented, with a final newline.
pub fn to_json(document: &Document) -> Result<String, SessionError> {
    Ok(serde_json::to_string_pretty(document)? + "\n")
}

/// A document from JSON. Fields that are not known are kept; fields that are missing have their defaults.
pub fn from_json(json: &str) -> Result<Document, SessionError> {
    let mut document: Document = serde_json::from_str(json)?;
    if document.format != "chromascope" {
        return Err(SessionError::Format(document.format));
    }
    if document.version > VERSION {
        return Err(SessionError::Newer(document.version));
    }
    document.mend();
    Ok(document)
}

impl Document {
    /// Brings values that a file could have spoiled back into their ranges, so that everything past this is total.
    fn mend(&mut self) {
        let [low, high] = super::LOCUS_RANGE_K;
        self.temperature_k = if self.temperature_k.is_finite() { self.temperature_k.clamp(low, high) } else { 5500.0 };
        let truth = self.truth.clone();
        if !self.compared.iter().any(|c| c.kind == Kind::Observer && c.name == truth) {
            self.compare(&truth, Kind::Observer);
        }
        self.part_names();
        let mut seen = std::collections::HashSet::new();
        self.compared.retain(|c| seen.insert((c.kind, c.name.clone())));
        self.render.mend();
    }
}
