//! What was understood, for programs.

use chromascope_core::table::{Certainty, ReadError, Reading, Table};
use serde_json::{Value, json};

use super::samples::Tabulated;
use super::{Failure, Inspected, Understood};

/// One object: a file with its curves, or with an error.
pub(super) fn of(inspected: &Inspected) -> String {
    let Inspected { name, result } = inspected;
    let value = match result {
        Ok(Understood { table, written }) => file(name, table, written.as_ref()),
        Err(failure) => json!({ "file": name, "error": error(failure) }),
    };
    value.to_string()
}

fn file(name: &str, table: &Table, written: Option<&Tabulated>) -> Value {
    let decisions = table.decisions().into_iter().map(|decision| {
        let certainty = certainty(decision.certainty);
        json!({ "what": decision.what, "value": decision.value, "certainty": certainty, "why": decision.why })
    });
    let warnings = table.warnings.iter().map(|warning| json!({ "line": warning.line(), "text": warning.to_string() }));
    json!({
        "file": name,
        "kind": table.role.value,
        "curves": curves(table, written),
        "channels": table.reading.camera_columns,
        "decisions": decisions.collect::<Vec<_>>(),
        "warnings": warnings.collect::<Vec<_>>(),
        "reading": reading(&table.reading),
        "notes": written.map_or_else(Vec::new, |written| written.notes.iter().map(ToString::to_string).collect()),
    })
}

/// The curves as read, or as they are written where another step is asked for.
fn curves(table: &Table, written: Option<&Tabulated>) -> Vec<Value> {
    let mut resampled = written.map(|written| written.curves(table.curves.len()).into_iter());
    let role = table.role.value;
    let one = |curve: &chromascope_core::table::Curve| {
        let (wavelengths, values) = match resampled.as_mut().and_then(Iterator::next) {
            Some((wavelengths, values)) => (json!(wavelengths), json!(values)),
            None => (json!(curve.wavelengths_nm), json!(curve.values)),
        };
        json!({
            "name": curve.name,
            "unit": if role.is_fraction() { Some("1") } else { curve.unit.as_deref() },
            "quantity": table.reading.quantity.value.to_string(),
            "wavelengths_nm": wavelengths,
            "values": values,
            "missing": curve.missing,
        })
    };
    table.curves.iter().map(one).collect()
}

const fn certainty(certainty: Certainty) -> &'static str {
    match certainty {
        Certainty::Certain => "certain",
        Certainty::Guess => "guess",
        Certainty::Chosen => "chosen",
    }
}

fn reading(reading: &Reading) -> Value {
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
