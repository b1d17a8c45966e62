//! What was read: as lines for the user and as JSON for programs.

use std::fmt::{Display, Write as _};
use std::io::{self, Write};

use serde_json::{Value, json};
use spectral_file::write::{Note, Prepared};
use spectral_file::{Certainty, Curve, ReadError, ReadReport, SpectralFile};

use super::Failure;
use crate::format;
use crate::terminal::shown_json;

const NAMED: usize = 20;
const MAX_DROPPED_ROWS: usize = 6;

/// The name of the file, and below it a line for each decision, fact and warning.
pub(super) fn report(name: &str, table: &SpectralFile, notes: &[Note]) -> String {
    let mut text = format!("{name}\n");
    for decision in table.decisions() {
        line(&mut text, decision.what, format_args!("{} ({}): {}", decision.value, decision.certainty, decision.why));
    }
    facts(&mut text, table);
    for warning in &table.warnings {
        line(&mut text, "Warning", warning);
    }
    for note in notes {
        line(&mut text, "Written", note);
    }
    text
}

fn line(text: &mut String, what: &str, words: impl Display) {
    // Writing to a string cannot fail.
    let _infallible = writeln!(text, "  {what}: {words}");
}

fn facts(text: &mut String, table: &SpectralFile) {
    let reading = &table.reading;
    line(text, "Rows", rows(reading));
    let [first, last] = reading.range_nm;
    let order = if reading.descending { ", written in descending order" } else { "" };
    line(text, "Range", format_args!("{first} to {last} nm{order}"));
    let step = reading.step_nm;
    if step.min == step.max {
        line(text, "Step", format_args!("{} nm", step.min));
    } else {
        line(text, "Step", format_args!("{} to {} nm, median {} nm", step.min, step.max, step.median));
    }
    line(text, "Curves", curves(&table.curves));
    let units: Vec<&str> = table.curves.iter().filter_map(|curve| curve.unit.as_deref()).collect();
    if let [unit, rest @ ..] = units.as_slice() {
        let others = if rest.iter().all(|other| other == unit) { "" } else { " and others" };
        line(text, "Unit", format_args!("{unit}{others}"));
    }
    if let Some(channels) = reading.camera_columns {
        let [red, green, blue] = channels.map(|index| table.curves.get(index).map_or("", |curve| curve.name.as_str()));
        line(text, "Channels", format_args!("red is {red}, green is {green}, blue is {blue}"));
    }
}

fn rows(reading: &ReadReport) -> String {
    let first = reading.first_data_line;
    let begin = format!("{}, from line {first}", reading.rows);
    [vec![begin], format::dropped_rows(&reading.dropped_rows, MAX_DROPPED_ROWS)].concat().join("; ")
}

fn curves(curves: &[Curve]) -> String {
    let names: Vec<&str> = curves.iter().take(NAMED).map(|curve| curve.name.as_str()).collect();
    let more = if curves.len() > NAMED { format!(" and {} more", curves.len() - NAMED) } else { String::new() };
    format!("{}: {}{more}", curves.len(), names.join(", "))
}

pub(super) fn failure(name: &str, failure: &Failure) -> Value {
    json!({ "file": name, "error": error(failure) })
}

/// Writes one object: a file with its curves, as read or, if another step is requested, resampled; one curve at a
/// time.
pub(super) fn json(
    out: &mut dyn Write,
    name: &str,
    table: &SpectralFile,
    prepared: Option<&mut Prepared<'_>>,
) -> io::Result<()> {
    put(out, &format!("{{\"file\":{},\"kind\":{},\"curves\":[", json!(name), json!(table.role.value)))?;
    let notes = if let Some(prepared) = prepared {
        let (mut curves, mut done) = (table.curves.iter().enumerate(), Ok(()));
        prepared.each(|wavelengths, values, standard| {
            let Some((index, one)) = curves.next() else { return false };
            done = curve(out, (index, one), table, (wavelengths, values, standard));
            done.is_ok()
        });
        done?;
        prepared.notes()
    } else {
        for (index, one) in table.curves.iter().enumerate() {
            let standard = one.uncertainty.as_ref().map(|of| &*of.standard);
            curve(out, (index, one), table, (&one.wavelengths_nm, &one.values, standard))?;
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
    (wavelengths, values, standard): (&[f64], &[f64], Option<&[f64]>),
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
    out.write_all(b",\"standard_uncertainty\":")?;
    serde_json::to_writer(&mut *out, &standard)?;
    let coverage = curve.uncertainty.as_ref().map(|of| of.coverage);
    write!(out, ",\"coverage_factor\":{},\"missing\":{}}}", json!(coverage), curve.missing)
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
        Failure::Other(_) => (None, None),
    };
    let text = failure.reason();
    json!({ "line": line, "column": column, "text": text })
}

/// The differences between curves that are written and those that were read, found by resampling all of them.
pub(super) fn notes(prepared: &mut Prepared<'_>) -> Vec<Note> {
    prepared.each(|_, _, _| true);
    prepared.notes()
}
