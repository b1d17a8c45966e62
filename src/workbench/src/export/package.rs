//! The built-in data sets as files that others can cite: a Frictionless Data Package (specification 1), each file with its checksum,
//! source and terms.

use chromascope_core::query::Ask;
use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};
use spectral_file::write::{Format, Grid};

use super::spectra::{Form, SpectraError, file, fits};
use crate::atomic::paths_beside;
use crate::catalog::{Catalog, licenses};
use crate::document::SetKind;
use crate::format::file_name;

/// Describes all other files.
pub const DESCRIPTOR: &str = "datapackage.json";

/// Files of the package, each with its path in it: every set as CSV, cameras, observers and lights as rawtoaces JSON too, license texts,
/// and last the descriptor.
pub fn package(catalog: &Catalog, ask: &impl Ask) -> Result<Vec<(String, Vec<u8>)>, SpectraError> {
    let mut files: Vec<(String, Vec<u8>)> =
        licenses().map(|(name, text)| (format!("licenses/{name}"), text.into())).collect();
    let mut resources: Vec<Value> = Vec::new();
    for entry in SetKind::ALL.into_iter().flat_map(|kind| catalog.of_kind(kind)) {
        let Some(header) = &entry.header else { continue };
        for format in [Format::Csv, Format::RawtoacesJson] {
            let form = Form { format, grid: Grid::Native };
            if fits(entry, form).is_err() {
                continue;
            }
            let written = file(entry, form, ask, None)?;
            let path = format!("{}/{}", entry.kind.key(), written.name);
            let (terms, text) = header.license.split_once(" (").unwrap_or((&header.license, ""));
            let mut license = json!({ "title": header.license });
            if text.starts_with("licenses/") {
                license["name"] = terms.into();
                license["path"] = text.trim_end_matches(')').into();
            }
            let plain = |c: char| if c.is_ascii_alphanumeric() || c == '.' { c.to_ascii_lowercase() } else { '-' };
            resources.push(json!({
                "name": path.chars().map(plain).collect::<String>(),
                "path": path,
                "title": entry.name,
                "description": format!("{}. {}", header.quantity, header.notes.join(" ")).trim_end(),
                "format": format.ending(),
                "encoding": "utf-8",
                "bytes": written.text.len(),
                "hash": checksum(&written.text),
                "sources": [{ "title": header.source }],
                "licenses": [license],
            }));
            if let Some(known) = written.beside.metadata.filter(|_| format.is_csv()) {
                let [beside, _] = paths_beside(path.as_ref());
                files.push((beside.to_string_lossy().into_owned(), known.text(&file_name(path.as_ref())).into()));
            }
            files.push((path, written.text.into()));
        }
    }
    let descriptor = json!({
        "profile": "data-package",
        "name": "chromascope-data",
        "title": "Spectral data sets of Chromascope",
        "description": env!("CARGO_PKG_DESCRIPTION"),
        "version": env!("CARGO_PKG_VERSION"),
        "resources": resources,
    });
    files.push((DESCRIPTOR.into(), format!("{descriptor:#}\n").into()));
    Ok(files)
}

/// SHA-256 as the specification writes it.
pub fn checksum(text: &str) -> String {
    format!("sha256:{:x}", Sha256::digest(text))
}
