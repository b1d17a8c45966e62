//! JSON as rawtoaces and dcamprof read it.

use crate::write::common::{Common, Limits, common};
use crate::write::format::{Format, Grid};
use crate::write::note::{Note, WriteError};
use crate::write::resample::even_step;
use crate::write::sheet::{Content, Piece, Sheet};
use crate::write::text::{one_line, push, push_number};

/// Writes a document of rawtoaces, whose schema wants all of these members.
pub(super) fn rawtoaces(sheet: &Sheet<'_>, grid: Grid, notes: &mut Vec<Note>) -> Result<String, WriteError> {
    let pieces = sheet.channel_pieces(notes);
    let limits =
        Limits { format: Format::RawtoacesJson, range_nm: RAWTOACES_NM, bands: usize::MAX, reads: even_in_single };
    let common = common(&pieces, sheet.content, grid, &limits, notes)?;
    if sheet.content == Content::Illuminant {
        sheet.note_lone_name(notes);
    }
    let mut out = String::from("{\n    \"header\": {\n");
    push_header(&mut out, sheet, &common, notes);
    out.push_str("    },\n    \"spectral_data\": {\n");
    let (units, reflection, transmission) = match sheet.content {
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
    push_index(&mut out, sheet.content, &pieces, notes);
    out.push_str("]\n        },\n        \"data\": {\n            \"main\": {\n");
    push_keyed_rows(&mut out, &common);
    out.push_str("            }\n        }\n    }\n}\n");
    Ok(out)
}

/// Keys of three digits before the point: those alone are in the order of wavelengths when sorted as text.
const RAWTOACES_NM: [f64; 2] = [100.0, 999.999];

/// Returns whether wavelengths are evenly spaced for a program that takes them in single precision and compares exactly.
fn even_in_single(wavelengths: &[f64]) -> bool {
    let single: Vec<f32> = wavelengths.iter().map(|&w| w as f32).collect();
    let mut steps = single.windows(2).map(|pair| pair[1] - pair[0]);
    steps.next().is_some_and(|first| first > 0.0 && steps.all(|step| step == first))
}

fn push_header(out: &mut String, sheet: &Sheet<'_>, common: &Common, notes: &mut Vec<Note>) {
    let title = sheet.title();
    let (mut maker, mut camera) = (None, None);
    if let Content::Camera { manufacturer, model, .. } = sheet.content {
        let known = |text: Option<&str>| text.map(|text| one_line(text).into_owned()).filter(|text| !text.is_empty());
        (maker, camera) = (known(manufacturer), known(model));
        if maker.is_none() || camera.is_none() {
            notes.push(Note::Unidentified);
        }
        camera = camera.or_else(|| Some(title.to_string()));
    }
    let kind = (!matches!(sheet.content, Content::Camera { .. })).then_some(&*title);
    push_member(out, 8, "schema_version", Some("1.0.0"));
    push_member(out, 8, "manufacturer", maker.as_deref());
    push_member(out, 8, "model", camera.as_deref());
    push_member(out, 8, "type", kind);
    if sheet.content == Content::Illuminant {
        push_member(out, 8, "illuminant", kind);
    }
    push_member(out, 8, "description", Some(&title));
    push_member(out, 8, "document_creator", Some("Chromascope"));
    push_member(out, 8, "unique_identifier", None);
    push_member(out, 8, "measurement_equipment", None);
    push_member(out, 8, "laboratory", None);
    push_member(out, 8, "document_creation_date", Some(sheet.created.unwrap_or_default()));
    let mut comments = sheet.remarks();
    comments.extend(common.resampling.iter().map(|resampling| format!("resampling: {resampling}")));
    push_member(out, 8, "comments", (!comments.is_empty()).then_some(comments.join("; ")).as_deref());
    push_last(out, 8, "license", &quoted(&sheet.license()));
}

/// Names of the curves that rawtoaces expects.
fn push_index(out: &mut String, content: Content<'_>, pieces: &[Piece<'_>], notes: &mut Vec<Note>) {
    let fixed: &[&str] = match content {
        Content::Camera { .. } => &["R", "G", "B"],
        Content::Observer => &["X", "Y", "Z"],
        Content::Illuminant => &["power"],
        Content::Reflectance | Content::Transmittance | Content::Other => &[],
    };
    if content == Content::Observer && pieces.iter().zip(fixed).any(|(piece, fixed)| piece.name != *fixed) {
        notes.push(Note::NoNames);
    }
    for (index, piece) in pieces.iter().enumerate() {
        out.push_str(if index > 0 { ", " } else { "" });
        out.push_str(&quoted(fixed.get(index).unwrap_or(&&*piece.name)));
    }
}

fn push_keyed_rows(out: &mut String, common: &Common) {
    for (row, wavelength) in common.wavelengths.iter().enumerate() {
        out.push_str(if row > 0 { ",\n                \"" } else { "                \"" });
        // Never in powers of ten: the keys are sorted as text.
        push(out, format_args!("{wavelength}\": ["));
        push_list(out, common.values.iter().map(|values| values[row]));
        out.push(']');
    }
    out.push('\n');
}

/// Writes a document of dcamprof: `ssf_bands` and three lists for a camera, `bands` and one list for anything else.
///
/// Members that dcamprof lacks stand in `comments`, which it passes over.
pub(super) fn dcamprof(sheet: &Sheet<'_>, grid: Grid, notes: &mut Vec<Note>) -> Result<String, WriteError> {
    let pieces = sheet.channel_pieces(notes);
    let any = |_: &[f64]| true;
    let limits = Limits { format: Format::DcamprofJson, range_nm: [0.0, f64::MAX], bands: DCAMPROF_BANDS, reads: any };
    let common = common(&pieces, sheet.content, grid, &limits, notes)?;
    let mut out = String::from("{\n");
    let title = sheet.title();
    let camera = matches!(sheet.content, Content::Camera { .. });
    if !camera {
        sheet.note_lone_name(notes);
    }
    push_member(&mut out, 4, if camera { "camera_name" } else { "description" }, Some(&title));
    let mut comments = sheet.remarks();
    comments.extend(common.resampling.iter().map(|resampling| format!("resampling: {resampling}")));
    comments.extend(Some(sheet.license()).filter(|text| !text.is_empty()).map(|license| format!("license: {license}")));
    if !comments.is_empty() {
        let list: Vec<String> = comments.iter().map(|comment| format!("\n        {}", quoted(comment))).collect();
        push(&mut out, format_args!("    \"comments\": [{}\n    ],\n", list.join(",")));
    }
    let lists = if camera { ["red_ssf", "green_ssf", "blue_ssf"].as_slice() } else { ["spectrum"].as_slice() };
    out.push_str(if camera { "    \"ssf_bands\": [" } else { "    \"bands\": [" });
    push_bands(&mut out, &common.wavelengths);
    for (name, values) in lists.iter().zip(&common.values) {
        push(&mut out, format_args!("],\n    \"{name}\": ["));
        push_list(&mut out, values.iter().copied());
    }
    out.push_str("]\n}\n");
    Ok(out)
}

/// The most bands that dcamprof takes for a range.
const DCAMPROF_BANDS: usize = 1_000_000;

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
fn quoted(text: &str) -> String {
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

fn push_member(out: &mut String, indent: usize, key: &str, value: Option<&str>) {
    push_last(out, indent, key, &value.map_or_else(|| "null".to_owned(), quoted));
    out.truncate(out.len() - 1);
    out.push_str(",\n");
}

fn push_last(out: &mut String, indent: usize, key: &str, value: &str) {
    push(out, format_args!("{:indent$}\"{key}\": {value}\n", ""));
}

fn push_list(out: &mut String, values: impl Iterator<Item = f64>) {
    for (index, value) in values.enumerate() {
        out.push_str(if index > 0 { ", " } else { "" });
        push_number(out, value);
    }
}
