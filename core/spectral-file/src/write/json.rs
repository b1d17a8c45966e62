//! JSON as rawtoaces and dcamprof read it.

use crate::write::base::{Draft, even_step};
use crate::write::format::Note;
use crate::write::sheet::{Content, one_line, push, push_number};

/// Writes a document of rawtoaces, by schema 1.0.0 of rawtoaces-data.
pub(super) fn rawtoaces(draft: &mut Draft<'_>) -> String {
    let content = draft.sheet.content;
    if content == Content::Illuminant {
        draft.note_lone_name();
    }
    let mut out = String::from("{\n    \"header\": {\n");
    push_header(&mut out, draft);
    out.push_str("    },\n    \"spectral_data\": {\n");
    let (units, reflection, transmission) = match content {
        Content::Reflectance => ("reflectance", Some("other"), None),
        Content::Transmittance => ("transmittance", None, Some("other")),
        Content::Other => ("other", None, None),
        Content::Camera { .. } | Content::Observer | Content::Illuminant => ("relative", None, None),
    };
    push_member(&mut out, 8, "units", Some(units));
    push_member(&mut out, 8, "reflection_geometry", reflection);
    push_member(&mut out, 8, "transmission_geometry", transmission);
    push_member(&mut out, 8, "bandwidth_FWHM", None);
    push_member(&mut out, 8, "bandwidth_corrected", None);
    out.push_str("        \"index\": {\n            \"main\": [");
    push_index(&mut out, draft);
    out.push_str("]\n        },\n        \"data\": {\n            \"main\": {\n");
    push_keyed_rows(&mut out, draft);
    out.push_str("            }\n        }\n    }\n}\n");
    out
}

fn push_header(out: &mut String, draft: &mut Draft<'_>) {
    let sheet = draft.sheet;
    let title = sheet.title();
    let (mut maker, mut camera) = (None, None);
    if let Content::Camera { manufacturer, model, .. } = sheet.content {
        let known = |text: Option<&str>| text.map(|text| one_line(text).into_owned()).filter(|text| !text.is_empty());
        (maker, camera) = (known(manufacturer), known(model));
        if maker.is_none() || camera.is_none() {
            draft.notes.push(Note::Unidentified);
        }
        camera = camera.or_else(|| Some(title.to_string()));
    }
    let title = if title.is_empty() { sheet.quantity().into() } else { title };
    let kind = (!matches!(sheet.content, Content::Camera { .. })).then_some(&*title);
    push_member(out, 8, "schema_version", Some("1.0.0"));
    push_member(out, 8, "manufacturer", maker.as_deref());
    push_member(out, 8, "model", camera.as_deref());
    push_member(out, 8, "type", kind);
    push_member(out, 8, "description", Some(&title));
    push_member(out, 8, "document_creator", Some("Chromascope"));
    push_member(out, 8, "unique_identifier", None);
    push_member(out, 8, "measurement_equipment", None);
    push_member(out, 8, "laboratory", None);
    push_member(out, 8, "document_creation_date", Some(sheet.created.unwrap_or_default()));
    let (comments, license) = draft.remarks();
    push_member(out, 8, "comments", (!comments.is_empty()).then_some(comments.join("; ")).as_deref());
    // The schema allows no empty text.
    push_last(out, 8, "license", &quoted(if license.is_empty() { "not stated" } else { &license }));
}

fn push_index(out: &mut String, draft: &mut Draft<'_>) {
    let (content, pieces) = (draft.sheet.content, &draft.pieces);
    let fixed: &[&str] = match content {
        Content::Camera { .. } => &["R", "G", "B"],
        Content::Observer => &["X", "Y", "Z"],
        Content::Illuminant => &["power"],
        Content::Reflectance | Content::Transmittance | Content::Other => &[],
    };
    if content == Content::Observer && pieces.iter().zip(fixed).any(|(piece, fixed)| piece.name != *fixed) {
        draft.notes.push(Note::NoNames);
    }
    for (index, piece) in pieces.iter().enumerate() {
        out.push_str(if index > 0 { ", " } else { "" });
        out.push_str(&quoted(fixed.get(index).unwrap_or(&&*piece.name)));
    }
}

fn push_keyed_rows(out: &mut String, draft: &Draft<'_>) {
    for (row, wavelength) in draft.wavelengths.iter().enumerate() {
        out.push_str(if row > 0 { ",\n                \"" } else { "                \"" });
        // Never in powers of ten: the keys are sorted as text.
        push(out, format_args!("{wavelength}\": ["));
        push_list(out, draft.values.iter().map(|values| values[row]));
        out.push(']');
    }
    out.push('\n');
}

/// Writes a document of dcamprof: `ssf_bands` and three lists for a camera, `bands` and one list for anything else.
///
/// Members that dcamprof lacks stand in `comments`, which it passes over.
pub(super) fn dcamprof(draft: &mut Draft<'_>) -> String {
    let mut out = String::from("{\n");
    let sheet = draft.sheet;
    let title = sheet.title();
    let camera = matches!(sheet.content, Content::Camera { .. });
    if !camera {
        draft.note_lone_name();
    }
    push_member(&mut out, 4, if camera { "camera_name" } else { "description" }, Some(&title));
    let (mut comments, license) = draft.remarks();
    comments.extend((!license.is_empty()).then(|| format!("license: {license}")));
    if !comments.is_empty() {
        push_list_of(&mut out, 4, "comments", comments.iter().map(|comment| quoted(comment)));
        out.push_str(",\n");
    }
    let lists = if camera { ["red_ssf", "green_ssf", "blue_ssf"].as_slice() } else { ["spectrum"].as_slice() };
    out.push_str(if camera { "    \"ssf_bands\": [" } else { "    \"bands\": [" });
    push_bands(&mut out, &draft.wavelengths);
    for (name, values) in lists.iter().zip(&draft.values) {
        push(&mut out, format_args!("],\n    \"{name}\": ["));
        push_list(&mut out, values.iter().copied());
    }
    out.push_str("]\n}\n");
    out
}

/// First, last and step where they are whole numbers; else every wavelength.
fn push_bands(out: &mut String, wavelengths: &[f64]) {
    // Three numbers are a range only if the last is not the largest; fewer than four bands are clearer as a list.
    const FEWEST: usize = 4;
    let whole = |x: f64| x.fract() == 0.0 && x < f64::from(i32::MAX);
    let first = wavelengths.first().copied().unwrap_or_default();
    let step = even_step(wavelengths).map(f64::round).filter(|&step| {
        let exact = |(i, w): (usize, &f64)| *w == first + step * i as f64;
        wavelengths.len() >= FEWEST && whole(first) && step >= 1.0 && wavelengths.iter().enumerate().all(exact)
    });
    match (step, wavelengths.last().filter(|last| whole(**last))) {
        (Some(step), Some(&last)) => push_list(out, [first, last, step].into_iter()),
        _ => push_list(out, wavelengths.iter().copied()),
    }
}

/// A text between quotes, escaped as in RFC 8259.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            '\u{8}' => out.push_str("\\b"),
            '\u{c}' => out.push_str("\\f"),
            '\0'..='\u{1f}' => push(&mut out, format_args!("\\u{:04x}", u32::from(c))),
            _ => out.push(c),
        }
    }
    out.push('"');
    out
}

pub(super) fn push_member(out: &mut String, indent: usize, key: &str, value: Option<&str>) {
    push_last(out, indent, key, &value.map_or_else(|| "null".to_owned(), quoted));
    out.truncate(out.len() - 1);
    out.push_str(",\n");
}

fn push_last(out: &mut String, indent: usize, key: &str, value: &str) {
    push(out, format_args!("{:indent$}\"{key}\": {value}\n", ""));
}

/// Appends a member with a list of texts that are JSON, each on a line of its own, without the end of its line.
pub(super) fn push_list_of(out: &mut String, indent: usize, key: &str, items: impl Iterator<Item = String>) {
    let items: Vec<String> = items.map(|item| format!("\n{:indent$}    {item}", "")).collect();
    push(out, format_args!("{:indent$}\"{key}\": [{}\n{:indent$}]", "", items.join(","), ""));
}

fn push_list(out: &mut String, values: impl Iterator<Item = f64>) {
    for (index, value) in values.enumerate() {
        out.push_str(if index > 0 { ", " } else { "" });
        push_number(out, value);
    }
}
