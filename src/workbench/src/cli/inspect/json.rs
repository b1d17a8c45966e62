//! Import report as JSON, for programs.

use std::io::{self, Write};

use serde_json::{Value, json};
use spectral_file::write::Prepared;
use spectral_file::{Certainty, Curve, ReadError, ReadReport, SpectralFile};

use super::Failure;
use crate::terminal::shown_json;

/// One object: a file that could not be read or written, and why.
pub(super) fn failure(name: &str, failure: &Failure) -> Value {
    json!({ "file": name, "error": error(failure) })
}

/// Writes one object: a file with its curves, as read or, if another step is requested, resampled; one curve at a
/// time.
pub(super) fn write(
    out: &mut dyn Write,
    name: &str,
    table: &SpectralFile,
    prepared: Option<&mut Prepared<'_>>,
) -> io::Result<()> {
    put(out, &format!("{{\"file\":{},\"kind\":{},\"curves\":[", json!(name), json!(table.role.value)))?;
    let notes = if let Some(prepared) = prepared {
        let (mut curves, mut done) = (table.curves.iter().enumerate(), Ok(()));
        prepared.each(|wavelengths, values| {
            let Some((index, one)) = curves.next() else { return false };
            done = curve(out, (index, one), table, (wavelengths, values));
            done.is_ok()
        });
        done?;
        prepared.notes()
    } else {
        for (index, one) in table.curves.iter().enumerate() {
            curve(out, (index, one), table, (&one.wavelengths_nm, &one.values))?;
        }
        Vec::new()
    };
    let decisions = table.decisions().into_iter().map(|decision| {
        let certainty = certainty(decision.certainty);
        json!({ "what": decision.what, "value": decision.value, "certainty": certainty, "why": decision.why })
    });
    let warnings = table.warnings.iter().map(|warning| json!({ "line": warning.line(), "text": warning.to_string() }));
    let end = format!(
        "],\"channels\":{},\"decisions\":{},\"warnings\":{},\"reading\":{},\"notes\":{}}}",
        json!(table.reading.camera_columns),
        decisions.collect::<Value>(),
        warnings.collect::<Value>(),
        reading(&table.reading),
        notes.iter().map(ToString::to_string).collect::<Value>(),
    );
    put(out, &end)
}

fn put(out: &mut dyn Write, json: &str) -> io::Result<()> {
    out.write_all(shown_json(json).as_bytes())
}

fn curve(
    out: &mut dyn Write,
    (index, curve): (usize, &Curve),
    table: &SpectralFile,
    (wavelengths, values): (&[f64], &[f64]),
) -> io::Result<()> {
    let unit = if table.role.value.is_fraction() { Some("1") } else { curve.unit.as_deref() };
    let start = format!(
        "{}{{\"name\":{},\"unit\":{},\"quantity\":{},\"wavelengths_nm\":",
        if index > 0 { "," } else { "" },
        json!(curve.name),
        json!(unit),
        json!(table.reading.quantity.value.to_string()),
    );
    put(out, &start)?;
    serde_json::to_writer(&mut *out, wavelengths)?;
    out.write_all(b",\"values\":")?;
    serde_json::to_writer(&mut *out, values)?;
    write!(out, ",\"missing\":{}}}", curve.missing)
}

const fn certainty(certainty: Certainty) -> &'static str {
    match certainty {
        Certainty::Certain => "certain",
        Certainty::Guess => "guess",
        Certainty::Open => "open",
        Certainty::Chosen => "chosen",
    }
}

fn reading(reading: &ReadReport) -> Value {
    let dropped = reading.dropped_rows.iter().map(|row| json!({ "line": row.line, "why": row.why.to_string() }));
    let comments = reading.header.iter().map(|(key, value)| json!({ "key": key, "value": value }));
    let parts = reading
        .parts
        .iter()
        .map(|part| json!({ "line": part.line, "name": part.name, "curves": part.curves, "rows": part.rows }));
    let step = reading.step_nm;
    json!({
        "reader": reading.reader.value,
        "encoding": reading.encoding.to_string(),
        "delimiter": reading.delimiter.value,
        "decimal_mark": reading.decimal_mark.value,
        "orientation": reading.orientation.value,
        "wavelength_unit": reading.wavelength_unit.value,
        "values": reading.values.value,
        "per_photon": reading.per_photon.as_ref().map(|decided| decided.value),
        "part": reading.part.value,
        "parts": parts.collect::<Vec<_>>(),
        "wavelength_column": reading.wavelength_column,
        "header_line": reading.header_line,
        "first_data_line": reading.first_data_line,
        "rows": reading.rows,
        "dropped_rows": dropped.collect::<Vec<_>>(),
        "descending": reading.descending,
        "range_nm": reading.range_nm,
        "step_nm": { "min": step.min, "median": step.median, "max": step.max },
        "comments": comments.collect::<Vec<_>>(),
    })
}

fn error(failure: &Failure) -> Value {
    let (line, column) = match failure {
        Failure::Read(error) => (error.line(), ReadError::column(error)),
        Failure::Disk(_) | Failure::Write(_) | Failure::NoCamera(_) => (None, None),
    };
    let text = failure.reason();
    json!({ "line": line, "column": column, "text": text })
}
