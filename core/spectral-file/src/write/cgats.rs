//! CGATS and the two formats that Argyll makes of it.

use crate::write::base::Draft;
use crate::write::format::{Format, Note};
use crate::write::sheet::{Content, one_line, push, push_comment, push_quoted, push_real};

pub(super) fn write(draft: &mut Draft<'_>) -> String {
    let (format, cmf) = (draft.format, draft.format == Format::ArgyllCmf);
    // Argyll takes the three sets of an observer by their place, and the one of a spectrum for lack of others.
    let named = format == Format::Cgats || (!cmf && draft.pieces.len() > 1);
    if cmf {
        draft.notes.push(Note::NoNames);
    } else if !named {
        draft.note_lone_name();
    }
    let mut out = String::from(match format {
        Format::ArgyllSp => "SPECT\n\n",
        Format::ArgyllCmf => "CMF\n\n",
        _ => "CGATS.17\n\n",
    });
    push_keywords(&mut out, draft);
    push_format(&mut out, format, named, &draft.wavelengths);
    push_sets(&mut out, named, draft);
    out
}

fn push_keywords(out: &mut String, draft: &Draft<'_>) {
    let sheet = draft.sheet;
    let title = sheet.title();
    if !title.is_empty() {
        push_keyword(out, "DESCRIPTOR", &title);
    }
    push_keyword(out, "ORIGINATOR", "Chromascope");
    if let Some(created) = sheet.created.map(one_line).filter(|created| !created.is_empty()) {
        push_keyword(out, "CREATED", &created);
    }
    // Keywords are a closed list in CGATS; what is not in it stands in comments.
    for (key, value) in draft.known() {
        push_comment(out, &key, &value);
    }
    out.push('\n');
    if let Some(kind) = measurement(sheet.content).filter(|_| draft.format != Format::Cgats) {
        push_own(out, "MEAS_TYPE", kind);
    }
    let ends = [draft.wavelengths.first(), draft.wavelengths.last()].map(|end| end.copied().unwrap_or_default());
    push_own(out, "SPECTRAL_BANDS", &draft.wavelengths.len().to_string());
    push_own(out, "SPECTRAL_START_NM", &real(ends[0]));
    push_own(out, "SPECTRAL_END_NM", &real(ends[1]));
    push_own(out, "SPECTRAL_NORM", "1.0");
}

/// Argyll's name for a measurement of this kind. It refuses an observer that does not say it is one.
fn measurement(content: Content<'_>) -> Option<&'static str> {
    match content {
        Content::Camera { .. } | Content::Observer => Some("SENSITIVITY"),
        Content::Reflectance => Some("REFLECTIVE"),
        Content::Transmittance => Some("TRANSMISSIVE"),
        Content::Illuminant => Some("EMISSION"),
        Content::Other => None,
    }
}

fn push_keyword(out: &mut String, key: &str, value: &str) {
    push(out, format_args!("{key} "));
    push_quoted(out, value);
    out.push('\n');
}

/// A keyword that is not in the standard has to be declared.
fn push_own(out: &mut String, key: &str, value: &str) {
    push_keyword(out, "KEYWORD", key);
    push_keyword(out, key, value);
}

fn push_format(out: &mut String, format: Format, named: bool, wavelengths: &[f64]) {
    let prefix = if format == Format::Cgats { "SPECTRAL_NM_" } else { "SPEC_" };
    let mut fields: Vec<String> = Vec::with_capacity(wavelengths.len() + 2);
    if named {
        fields.extend(["SAMPLE_ID".to_owned(), "SAMPLE_NAME".to_owned()]);
        push_keyword(out, "KEYWORD", "SAMPLE_NAME");
    }
    // Whole numbers of three digits; the keywords give the exact ends.
    fields.extend(wavelengths.iter().map(|w| format!("{prefix}{:03}", (w + 0.5).floor())));
    push(out, format_args!("\nNUMBER_OF_FIELDS {}\nBEGIN_DATA_FORMAT\n", fields.len()));
    out.push_str(&fields.join(" "));
    out.push_str("\nEND_DATA_FORMAT\n");
}

fn push_sets(out: &mut String, named: bool, draft: &Draft<'_>) {
    push(out, format_args!("\nNUMBER_OF_SETS {}\nBEGIN_DATA\n", draft.pieces.len()));
    for (index, (piece, values)) in draft.pieces.iter().zip(&draft.values).enumerate() {
        if named {
            push(out, format_args!("{} ", index + 1));
            push_quoted(out, &piece.name);
            out.push(' ');
        }
        for (band, value) in values.iter().enumerate() {
            out.push_str(if band > 0 { " " } else { "" });
            push_real(out, *value);
        }
        out.push('\n');
    }
    out.push_str("END_DATA\n");
}

fn real(value: f64) -> String {
    let mut out = String::new();
    push_real(&mut out, value);
    out
}
