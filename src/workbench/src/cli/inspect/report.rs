//! Import report in lines for the user.

use std::fmt::{Display, Write as _};

use spectral_file::write::Note;
use spectral_file::{Curve, ReadReport, SpectralFile};

use crate::format;

/// Largest number of curves named.
const NAMED: usize = 20;
/// Largest number of dropped rows listed one by one.
const MAX_DROPPED_ROWS: usize = 6;

/// The name of the file, and below it a line for each decision, fact and warning.
pub(super) fn of(name: &str, table: &SpectralFile, notes: &[Note]) -> String {
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
