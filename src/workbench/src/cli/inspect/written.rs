//! Files of the curves that were read, in every format.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use spectral_file::write::{Content, Format, Note, Prepared, Sheet, Trace, Written};
use spectral_file::{Role, SpectralFile};

use crate::atomic::{files_beside, write_with};
use crate::cli::error::{CliError, Result};
use crate::cli::outputs::{Stop, is_stream, stream};
use crate::export::spectra::{maker_and_model, notes_in_words};
use crate::format::file_name;
use crate::terminal::say;

/// Parser of formats; that of CSV with comments has a flag of its own.
pub(in crate::cli) fn format() -> impl TypedValueParser<Value = Format> {
    let all = || Format::ALL.into_iter().filter(|format| *format != Format::CommentedCsv);
    let of = move |key: String| all().find(|format| format.key() == key).unwrap_or(Format::Csv);
    PossibleValuesParser::new(all().map(Format::key)).map(of)
}

/// What the file says about its curves, its name as their source unless it names another, and how it was read.
pub(super) fn known(table: &SpectralFile, file: &Path) -> Vec<(String, String)> {
    let mut known = table.reading.header.clone();
    if table.reading.comment("source").is_none() {
        known.push(("source".to_owned(), file_name(file)));
    }
    let decisions = table.decisions().into_iter().map(|decision| format!("{decision} ({})", decision.certainty));
    known.extend(decisions.map(|decision| ("reading".to_owned(), decision)));
    known
}

pub(super) fn sheet<'a>(
    table: &'a SpectralFile,
    curves: &'a [Trace<'a>],
    comments: &'a [(String, String)],
    created: &'a str,
) -> Sheet<'a> {
    let title = table.reading.comment("title").unwrap_or_default().trim();
    let units = || table.curves.iter().map(|curve| curve.unit.as_deref());
    let unit = units().next().flatten().filter(|unit| units().all(|other| other == Some(unit)));
    let covariance = table.covariance.as_ref();
    Sheet { title, content: content(table, title), curves, covariance, unit, created: Some(created), comments }
}

fn content<'a>(table: &'a SpectralFile, title: &'a str) -> Content<'a> {
    let reading = &table.reading;
    match table.role.value {
        Role::Camera => reading.camera_columns.map_or(Content::Observer, |channels| {
            let (manufacturer, model) = maker_and_model(title);
            Content::Camera {
                channels,
                per_photon: reading.per_photon.as_ref().map(|decided| decided.value),
                manufacturer: reading.comment("manufacturer").or(manufacturer),
                model: reading.comment("model").or(model),
            }
        }),
        Role::Reflectance => Content::Reflectance,
        Role::Transmittance => Content::Transmittance,
        Role::Illuminant => Content::Illuminant,
        Role::Unknown => Content::Other,
    }
}

/// Writes curves to a place: the text of another format, or the table, with its files beside it unless it is a stream.
pub(in crate::cli) fn put(
    name: &str,
    place: &Path,
    (format, is_described): (Format, bool),
    mut prepared: Option<&mut Prepared<'_>>,
    text: Option<&Written>,
) -> Result<()> {
    let described = is_described && format == Format::Csv && !is_stream(place);
    let beside = prepared.as_mut().map(|prepared| prepared.beside(described)).unwrap_or_default();
    let mut notes = Vec::new();
    if is_stream(place) || !format.is_csv() {
        notes.extend(beside.covariance.is_some().then_some(Note::NoCovariance));
        table_to(place, format, prepared.as_deref_mut(), text)?;
    } else {
        let files = files_beside(place, &beside);
        let former = |(path, text): &&(PathBuf, Option<String>)| text.is_none() && path.exists();
        for (path, _) in files.iter().filter(former) {
            say(&format!("chromascope: {name}: {} of the former table is removed\n", path.display()));
        }
        let failed = |path: &Path, error| CliError::Output { path: path.to_owned(), error };
        write_with(&files, failed, || table_to(place, format, prepared.as_deref_mut(), text))?;
    }
    let made = text.map_or_else(|| prepared.map_or_else(Vec::new, |made| made.notes()), |text| text.notes.clone());
    notes.extend(made.into_iter().filter(|_| is_described));
    if !notes.is_empty() {
        say(&format!("chromascope: {name}: written: {}\n", notes_in_words(&notes)));
    }
    Ok(())
}

fn table_to(place: &Path, format: Format, prepared: Option<&mut Prepared<'_>>, text: Option<&Written>) -> Result<()> {
    stream(Some(place), |out| table(out, format, prepared, text))
}

fn table(
    out: &mut dyn Write,
    format: Format,
    prepared: Option<&mut Prepared<'_>>,
    text: Option<&Written>,
) -> Result<(), Stop> {
    let mut done = text.map_or(Ok(()), |text| out.write_all(text.text.as_bytes()));
    let mut put = |part: &str| {
        done = out.write_all(part.as_bytes());
        done.is_ok()
    };
    match prepared {
        Some(prepared) if format == Format::CommentedCsv => prepared.with_comments(&mut put),
        Some(prepared) => prepared.table(&mut put),
        None => {}
    }
    Ok(done?)
}
