//! JSON as rawtoaces, dcamprof and Wasatch ENLIGHTEN write it, with or without comments.

mod comments;
mod content;
mod document;
mod enlighten;
mod rows;
mod spans;
mod watched;

use crate::error::ReadError;
use crate::formats::found::Found;
use crate::formats::json::content::{Content, Curves, line_of, note_remarks, range, says};
use crate::formats::json::document::{Aces, File, Shape};
use crate::formats::json::rows::{Fault, Rows};
use crate::formats::json::watched::Watched;
use crate::formats::spectra;
use crate::formats::spectra::{Sample, Spectrum};
use crate::grid::{Grid, RawCurve};
use crate::header::Header;
use crate::limits::{MAX_CURVES, MAX_PARTS, MAX_SAMPLES};
use crate::markup::Family;
use crate::options::ReadOptions;
use crate::places::PlaceId;
use crate::report::{Decided, Decision, Orientation, Part, Reader};
use crate::role::Role;
use crate::separators::{DecimalMark, Delimiter};
use crate::sniff::Layout;
use crate::watch::Log;
use crate::wavelength_unit::WavelengthUnit;
use crate::{decimal, header_terms, unit_text};

/// The fewest bytes for each quotation mark in a file of spectra.
const FEWEST_BYTES: usize = 5;

/// Reads a document of any of the layouts.
pub(super) fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    // Every list and every text has a name of its own; hostile text, which has nothing else, would need many times its size.
    if text.bytes().filter(|byte| *byte == b'"').count() > text.len() / FEWEST_BYTES + 1000 {
        return Err(ReadError::Unsupported(Family::Json));
    }
    let bare = comments::blank(text, log)?;
    let file = parse(text, &bare, log)?;
    let content = match file {
        File { spectral_data: Some(data), header, .. } => aces(text, data, &header.unwrap_or_default().0, options),
        File {
            ssf_bands: Some(bands),
            red_ssf: Some(r),
            green_ssf: Some(g),
            blue_ssf: Some(b),
            camera_name,
            comments,
            ..
        } => camera(text, &bands, [r, g, b], camera_name.as_deref(), &comments.0),
        File { spectrum: Some(Shape::Curves(curves)), settings, metadata, .. } => {
            enlighten::read(text, curves, settings, &metadata.unwrap_or_default().0, options)
        }
        File { bands: Some(bands), spectrum: Some(Shape::Values(values)), scale, comments, name, .. } => {
            spectrum(text, &bands, values, scale, &comments.0).map(|mut content| {
                content.header.note(0, "title", name.0.first().map_or("", String::as_str));
                content
            })
        }
        _ => return Err(ReadError::Unsupported(Family::Json)),
    };
    let Content { curves, mut header, reader, role, notes, parts, part } =
        content.map_err(|error| placed(text, error))?;
    if let Some(places) = &mut log.places {
        let group = part.as_ref().map_or(0, |part| part.value.saturating_sub(1));
        spans::record(&bare, group, places);
        spans::note_lines(text, &mut header);
    }
    let mut grid = match curves {
        Curves::Spectra(spectra) => spectra::grid(spectra, header, log)?,
        Curves::Rows { rows, names } => on_one_grid(rows, &names, header, log).map_err(|error| placed(text, error))?,
    };
    grid.unit = Some(Decided::certain(WavelengthUnit::Nanometer, "The layout prescribes it"));
    grid.role = role;
    // Each wavelength has one value for every curve.
    grid.rows = grid.wavelengths.len();
    (grid.parts, grid.part) = (parts, part);
    let unit = grid.header.unit.clone();
    grid.curves.iter_mut().for_each(|curve| curve.unit.clone_from(&unit));
    let dialect = (Delimiter::Comma, DecimalMark::Point);
    let first_line =
        ["data", "ssf_bands", "bands", "processed"].iter().find_map(|name| line_of(text, name)).unwrap_or(1);
    let layout = Layout::fixed(dialect, Orientation::Down, first_line, "JSON prescribes it");
    Ok(Found { grid, layout, reader, notes })
}

fn parse(text: &str, bare: &str, log: &Log<'_>) -> Result<File, ReadError> {
    log.look(0)?;
    serde_json::from_reader(Watched::new(bare.as_bytes(), log)).map_err(|error| {
        // Nothing else fails in a reader of bytes that are there.
        if error.is_io() { ReadError::Stopped } else { malformed(text, &error) }
    })
}

/// An error about a list with the line where the list is named.
fn placed(text: &str, error: ReadError) -> ReadError {
    match error {
        ReadError::WrongCount { name, found, expected, .. } => {
            let line = line_of(text, &name).unwrap_or(1);
            ReadError::WrongCount { line, name, found, expected }
        }
        other => other,
    }
}

fn malformed(text: &str, error: &serde_json::Error) -> ReadError {
    // A list at the top, or members of other types than the known layouts have, is sound JSON of another layout.
    if error.is_data() && (text.trim_start().starts_with('[') || !has_marks(text)) {
        return ReadError::Unsupported(Family::Json);
    }
    ReadError::Malformed { family: Family::Json, line: error.line().max(1), column: error.column().max(1) }
}

fn has_marks(text: &str) -> bool {
    ["\"spectral_data\"", "\"ssf_bands\"", "\"spectrum\""].iter().any(|mark| text.contains(mark))
}

/// Wavelengths are the keys of one object, each with a value for every name of the index.
fn aces(text: &str, data: Aces, comments: &[(String, String)], options: &ReadOptions) -> Result<Content, ReadError> {
    let (mut header, mut notes) = (Header::default(), Vec::new());
    for (key, value) in comments {
        header.note(0, key, value);
    }
    if let Some((_, remarks)) = comments.iter().find(|(key, _)| key == "comments") {
        note_remarks(text, &mut header, remarks.split("; "));
    }
    title(text, &mut header, &mut notes);
    if let Some(units) = data.units.as_deref().filter(|units| !units.is_empty()) {
        header.note(0, "unit", units);
        header.unit = unit_text::unit_cell(units);
        header.values = header_terms::values(units).map(|values| (line_of(text, "units").unwrap_or(1), values));
        header.quantity = header_terms::quantity(units).map(|quantity| (line_of(text, "units").unwrap_or(1), quantity));
        notes.push(Decision::new("Unit", &Decided::certain(units.to_owned(), says(text, "units"))));
    }
    let groups = &data.data.0;
    let list = groups.iter().take(MAX_PARTS).map(|(name, rows)| Part {
        line: line_of(text, name).unwrap_or(1),
        name: name.clone(),
        curves: rows.width,
        rows: rows.wavelengths.len(),
    });
    let parts: Vec<Part> = list.collect();
    let first = groups.iter().position(|(name, _)| name == "main").map_or(1, |index| index + 1);
    let part = options.part.unwrap_or(first);
    let group = part.checked_sub(1).and_then(|at| data.data.0.into_iter().nth(at));
    let (name, rows) = group.ok_or(match parts.len() {
        0 => ReadError::NoNumbers,
        parts => ReadError::NoSuchPart { part, parts },
    })?;
    let mut index = data.index.0;
    let at = index.iter().position(|(key, _)| *key == name).unwrap_or(0);
    let names = if at < index.len() { index.swap_remove(at).1 } else { Vec::new() };
    let power = names.len() == 1 && names[0] == "power";
    let role = power.then(|| Decided::certain(Role::Illuminant, format!("{} as its only value", says(text, "power"))));
    let reader = Decided::certain(Reader::Rawtoaces, says(text, "spectral_data"));
    let part = Decided::certain(part, format!("{} groups of data, of which “main” comes first", parts.len()));
    let curves = Curves::Rows { rows, names };
    Ok(Content { curves, header, reader, role, notes, parts, part: Some(part) })
}

/// The name of what was measured: a camera's maker and model, a light's type, else its description.
fn title(text: &str, header: &mut Header, notes: &mut Vec<Decision>) {
    let (what, key, title) = match (header.comment("manufacturer"), header.comment("model")) {
        (Some(maker), Some(model)) => ("Camera", "model", format!("{maker} {model}")),
        (None, Some(model)) => ("Camera", "model", model.to_owned()),
        _ => match (header.comment("type"), header.comment("description")) {
            (Some(kind), _) => ("Name", "type", kind.to_owned()),
            (None, Some(description)) => ("Name", "description", description.to_owned()),
            (None, None) => return,
        },
    };
    notes.push(Decision::new(what, &Decided::certain(title.clone(), says(text, key))));
    header.note(0, "title", &title);
}

/// Rows as their grid; wavelengths at which no curve has a value are omitted.
fn on_one_grid(rows: Rows, names: &[String], header: Header, log: &Log<'_>) -> Result<Grid, ReadError> {
    let Rows { wavelengths, values, width, fault } = rows;
    match fault {
        Some(Fault::Key(text)) => return Err(ReadError::NotANumber { line: 1, column: 1, text }),
        Some(Fault::Count { key, found }) => {
            return Err(ReadError::WrongCount { line: 1, name: key, found, expected: width });
        }
        None if width > MAX_CURVES => return Err(ReadError::TooManyCurves(1)),
        None if values.len() > MAX_SAMPLES => return Err(ReadError::TooManySamples(1)),
        None => {}
    }
    let gaps: Vec<bool> = values.chunks(width.max(1)).map(|row| row.iter().all(|value| value.is_nan())).collect();
    let single = width == 1;
    let title = header.comment("title").filter(|_| single).map(str::to_owned);
    let mut curves = Vec::with_capacity(width);
    let mut all = Some(values);
    for column in 0..width {
        log.look(usize::MAX)?;
        let values = match all.as_deref() {
            Some(values) if !single => values.iter().skip(column).step_by(width).copied().collect(),
            _ => all.take().unwrap_or_default(),
        };
        // A single curve is named by the title, which is more specific than "power".
        let given = names.get(column).filter(|_| !single).cloned().or_else(|| title.clone());
        let name = given.clone().unwrap_or_else(|| format!("Spectrum {}", column + 1));
        let label = names.get(column).cloned().unwrap_or_default();
        curves.push(RawCurve { name, named: given.is_some(), label, values, origin: column, ..RawCurve::default() });
    }
    drop(all);
    let mut grid = Grid { wavelengths, lines: vec![1], curves, header, own_wavelengths: true, ..Grid::default() };
    if gaps.contains(&true) && width > 0 {
        grid.remove(&gaps);
    }
    Ok(grid)
}

fn camera(
    text: &str,
    bands: &[f64],
    curves: [Vec<f64>; 3],
    name: Option<&str>,
    remarks: &[String],
) -> Result<Content, ReadError> {
    let (wavelengths, note) = wavelengths(text, bands, "ssf_bands")?;
    let mut header = Header::default();
    let mut notes = vec![note];
    if let Some(name) = name {
        notes.push(Decision::new("Camera", &Decided::certain(name.to_owned(), says(text, "camera_name"))));
    }
    header.note(0, "title", name.unwrap_or_default());
    note_remarks(text, &mut header, remarks.iter().map(String::as_str));
    let names = [("R", "red_ssf"), ("G", "green_ssf"), ("B", "blue_ssf")];
    let mut all = Vec::with_capacity(3);
    for (values, (short, long)) in curves.into_iter().zip(names) {
        all.push(on(&wavelengths, &values, long)?.named(short));
    }
    let reader = Decided::certain(Reader::Dcamprof, says(text, "ssf_bands"));
    let role = Some(Decided::certain(Role::Camera, says(text, "red_ssf")));
    Ok(Content { curves: Curves::Spectra(all), header, reader, role, notes, parts: Vec::new(), part: None })
}

fn spectrum(
    text: &str,
    bands: &[f64],
    mut values: Vec<f64>,
    scale: Option<f64>,
    remarks: &[String],
) -> Result<Content, ReadError> {
    let (wavelengths, note) = wavelengths(text, bands, "bands")?;
    let mut header = Header::default();
    note_remarks(text, &mut header, remarks.iter().map(String::as_str));
    let mut notes = vec![note];
    if let Some(scale) = scale.filter(|scale| *scale > 0.0 && *scale != 1.0) {
        for value in &mut values {
            *value = decimal::divided(*value, scale);
        }
        notes.push(Decision::new("Scale", &Decided::certain(format!("divided by {scale}"), says(text, "scale"))));
    }
    let spectra = vec![on(&wavelengths, &values, "spectrum")?];
    let reader = Decided::certain(Reader::Dcamprof, says(text, "spectrum"));
    let curves = Curves::Spectra(spectra);
    Ok(Content { curves, header, reader, role: None, notes, parts: Vec::new(), part: None })
}

impl Spectrum {
    fn named(self, name: &str) -> Self {
        Self { name: Some(name.to_owned()), label: name.to_owned(), ..self }
    }
}

fn on(wavelengths: &[f64], values: &[f64], name: &str) -> Result<Spectrum, ReadError> {
    if values.len() != wavelengths.len() {
        let (found, expected) = (values.len(), wavelengths.len());
        return Err(ReadError::WrongCount { line: 1, name: name.to_owned(), found, expected });
    }
    let samples = wavelengths.iter().zip(values).map(|(&wavelength, &value)| Sample {
        wavelength,
        value,
        line: 1,
        place: PlaceId::default(),
    });
    Ok(Spectrum { samples: samples.collect(), ..Spectrum::default() })
}

/// Three numbers are the ends of a range and its step, unless the third goes on from the second.
fn wavelengths(text: &str, bands: &[f64], key: &str) -> Result<(Vec<f64>, Decision), ReadError> {
    let listed = |bands: &[f64]| {
        let listed = Decided::certain(format!("{} wavelengths", bands.len()), says(text, key));
        Ok((bands.to_vec(), Decision::new("Grid", &listed)))
    };
    let &[first, last, step] = bands else { return listed(bands) };
    if step > last || step <= 0.0 {
        return listed(bands);
    }
    let grid = range(bands).ok_or(ReadError::NoWavelengths(1))?;
    let range = Decided::certain(
        format!("{first} to {last} nm in steps of {step}"),
        format!("{}, and three numbers are a range", says(text, key)),
    );
    Ok((grid, Decision::new("Grid", &range)))
}
