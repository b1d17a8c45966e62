//! JSON as rawtoaces and dcamprof write it, with or without comments.

mod comments;
mod document;

use document::{Aces, File};

use super::super::family::Family;
use super::super::header::Header;
use super::super::sniff::Layout;
use super::super::{
    Decided, DecimalMark, Decision, Delimiter, MAX_CURVES, MAX_SAMPLES, Orientation, ReadError, Reader, Role, Warning,
    WavelengthUnit,
};
use super::Found;
use super::spectra::{self, Sample, Spectrum};

/// The fewest bytes for each quotation mark in a file of spectra.
const FEWEST_BYTES: usize = 5;

/// Reads a document of either layout.
pub(super) fn read(text: &str, warnings: &mut Vec<Warning>) -> Result<Found, ReadError> {
    // Every list and every text has a name of its own; hostile text, which has nothing else, would need many times its size.
    if text.bytes().filter(|byte| *byte == b'"').count() > text.len() / FEWEST_BYTES + 1000 {
        return Err(ReadError::Unsupported { family: Family::Json });
    }
    let bare = comments::blank(text);
    let file: File = serde_json::from_str(&bare).map_err(|error| malformed(text, &error))?;
    let parts = match file {
        File { spectral_data: Some(data), header, .. } => aces(data, &header.unwrap_or_default().0),
        File {
            ssf_bands: Some(bands), red_ssf: Some(r), green_ssf: Some(g), blue_ssf: Some(b), camera_name, ..
        } => camera(&bands, [r, g, b], camera_name.as_deref()),
        File { bands: Some(bands), spectrum: Some(values), scale, .. } => spectrum(&bands, values, scale),
        _ => return Err(ReadError::Unsupported { family: Family::Json }),
    };
    let Parts { spectra, header, reader, role, notes } = parts.map_err(|error| placed(text, error))?;
    let mut grid = spectra::grid(spectra, header, warnings)?;
    grid.unit = Some(Decided::certain(WavelengthUnit::Nanometer, "Both layouts prescribe it"));
    grid.role = role;
    let dialect = (Delimiter::Comma, DecimalMark::Point);
    let layout = Layout::fixed(dialect, Orientation::Down, 1, "JSON prescribes it");
    Ok(Found { grid, layout, reader, notes })
}

/// An error about a list with the line where the list is named.
fn placed(text: &str, error: ReadError) -> ReadError {
    match error {
        ReadError::WrongCount { name, found, expected, .. } => {
            let at = text.find(&format!("\"{name}\"")).unwrap_or(0);
            let line = 1 + text[..at].bytes().filter(|byte| *byte == b'\n').count();
            ReadError::WrongCount { line, name, found, expected }
        }
        other => other,
    }
}

/// What the layouts have in common.
struct Parts {
    spectra: Vec<Spectrum>,
    header: Header,
    reader: Decided<Reader>,
    role: Option<Decided<Role>>,
    notes: Vec<Decision>,
}

fn malformed(text: &str, error: &serde_json::Error) -> ReadError {
    // A list at the top, or members of other types than the known layouts have, is sound JSON of another layout.
    if error.is_data() && (text.trim_start().starts_with('[') || !has_marks(text)) {
        return ReadError::Unsupported { family: Family::Json };
    }
    ReadError::Malformed { family: Family::Json, line: error.line().max(1), column: error.column().max(1) }
}

fn has_marks(text: &str) -> bool {
    ["\"spectral_data\"", "\"ssf_bands\"", "\"spectrum\""].iter().any(|mark| text.contains(mark))
}

/// Wavelengths are the keys of one object, each with a value for every name of the index.
fn aces(data: Aces, comments: &[(String, String)]) -> Result<Parts, ReadError> {
    let mut header = Header::default();
    for (key, value) in comments {
        header.note(key, value);
    }
    let camera = match (header.comment("manufacturer"), header.comment("model")) {
        (Some(maker), Some(model)) => Some(format!("{maker} {model}")),
        (None, Some(model)) => Some(model.to_owned()),
        _ => None,
    };
    let title = camera.or_else(|| header.comment("type").or(header.comment("description")).map(str::to_owned));
    if let Some(title) = title {
        header.note("title", &title);
    }
    header.note("unit", data.units.as_deref().unwrap_or_default());
    let names = main(data.index).unwrap_or_default();
    let rows = main(data.data).ok_or(ReadError::NoNumbers)?.0;
    let power = names.len() == 1 && names[0] == "power";
    let role = power.then(|| Decided::certain(Role::Illuminant, "The only value is called “power”"));
    let width = rows.first().map_or(0, |(_, values)| values.len());
    if width > MAX_CURVES {
        return Err(ReadError::TooManyCurves { line: 1 });
    }
    let single = width == 1;
    let mut all: Vec<Spectrum> = (0..width)
        .map(|i| Spectrum {
            // A single curve goes by the title, which says more than "power".
            name: names.get(i).filter(|_| !single).cloned(),
            label: names.get(i).cloned().unwrap_or_default(),
            samples: Vec::with_capacity(rows.len()),
        })
        .collect();
    for (key, values) in rows {
        let wavelength: f64 = key
            .trim()
            .parse()
            .ok()
            .filter(|value: &f64| value.is_finite())
            .ok_or_else(|| ReadError::NotANumber { line: 1, column: 1, text: super::super::text::excerpt(&key) })?;
        if values.len() != width {
            return Err(ReadError::WrongCount { line: 1, name: key, found: values.len(), expected: width });
        }
        for (spectrum, value) in all.iter_mut().zip(values) {
            spectrum.samples.extend(value.map(|value| Sample { wavelength, value, line: 1 }));
        }
    }
    let reader = Decided::certain(Reader::Rawtoaces, "The document has “spectral_data”");
    Ok(Parts { spectra: all, header, reader, role, notes: Vec::new() })
}

/// The part called "main", else the first.
fn main<T>(mut parts: std::collections::BTreeMap<String, T>) -> Option<T> {
    parts.remove("main").or_else(|| parts.into_values().next())
}

fn camera(bands: &[f64], curves: [Vec<f64>; 3], name: Option<&str>) -> Result<Parts, ReadError> {
    let (wavelengths, note) = wavelengths(bands, "ssf_bands")?;
    let mut header = Header::default();
    header.note("title", name.unwrap_or_default());
    let names = [("R", "red_ssf"), ("G", "green_ssf"), ("B", "blue_ssf")];
    let mut all = Vec::with_capacity(3);
    for (values, (short, long)) in curves.into_iter().zip(names) {
        all.push(on(&wavelengths, &values, long)?.named(short));
    }
    let reader = Decided::certain(Reader::Dcamprof, "The document has “ssf_bands”");
    let role = Some(Decided::certain(Role::Camera, "Its lists are called “red_ssf”, “green_ssf” and “blue_ssf”"));
    Ok(Parts { spectra: all, header, reader, role, notes: vec![note] })
}

fn spectrum(bands: &[f64], mut values: Vec<f64>, scale: Option<f64>) -> Result<Parts, ReadError> {
    let (wavelengths, note) = wavelengths(bands, "bands")?;
    let mut notes = vec![note];
    if let Some(scale) = scale.filter(|scale| *scale > 0.0 && *scale != 1.0) {
        for value in &mut values {
            *value /= scale;
        }
        notes.push(Decision::new("Scale", &Decided::certain(format!("divided by {scale}"), "“scale” says so")));
    }
    let spectra = vec![on(&wavelengths, &values, "spectrum")?];
    let reader = Decided::certain(Reader::Dcamprof, "The document has “bands” and “spectrum”");
    Ok(Parts { spectra, header: Header::default(), reader, role: None, notes })
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
    let samples = wavelengths.iter().zip(values).map(|(&wavelength, &value)| Sample { wavelength, value, line: 1 });
    Ok(Spectrum { samples: samples.collect(), ..Spectrum::default() })
}

/// Three numbers are the ends of a range and its step, unless the third goes on from the second.
fn wavelengths(bands: &[f64], key: &str) -> Result<(Vec<f64>, Decision), ReadError> {
    let listed = |bands: &[f64]| {
        let listed = Decided::certain(format!("{} wavelengths", bands.len()), format!("“{key}” lists them"));
        Ok((bands.to_vec(), Decision::new("Grid", &listed)))
    };
    let &[first, last, step] = bands else { return listed(bands) };
    if step > last || step <= 0.0 {
        return listed(bands);
    }
    let steps = ((last - first) / step).round();
    if !(1.0..=MAX_SAMPLES as f64).contains(&steps) {
        return Err(ReadError::NoWavelengths { line: 1 });
    }
    let grid = (0..=steps as usize).map(|i| super::super::reading::clean(first + step * i as f64)).collect();
    let range = Decided::certain(
        format!("{first} to {last} nm in steps of {step}"),
        format!("Three numbers in “{key}” are a range"),
    );
    Ok((grid, Decision::new("Grid", &range)))
}
