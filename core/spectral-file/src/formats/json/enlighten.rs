//! A measurement of Wasatch ENLIGHTEN: curves by name, wavelengths among the settings of the spectrometer.

use crate::error::ReadError;
use crate::formats::json::content::{Content, Curves, line_of, says};
use crate::formats::json::document::{InOrder, Settings};
use crate::formats::spectra::{Sample, Spectrum};
use crate::header::Header;
use crate::header_terms;
use crate::options::ReadOptions;
use crate::places::PlaceId;
use crate::report::{Decided, Decision, Reader};
use crate::role::{Role, Values};

/// Reads the processed curve, or all of them where raw ones are requested.
pub(super) fn read(
    text: &str,
    curves: InOrder<Option<Vec<Option<f64>>>>,
    settings: Option<Settings>,
    metadata: &[(String, String)],
    options: &ReadOptions,
) -> Result<Content, ReadError> {
    let mut curves: Vec<(String, Vec<Option<f64>>)> =
        curves.0.into_iter().filter_map(|(name, values)| Some((name, values?))).collect();
    let at = curves.iter().position(|(name, _)| name.to_lowercase().starts_with("wavelength"));
    let own = at.map(|at| curves.remove(at).1.into_iter().map(|nm| nm.unwrap_or(f64::NAN)).collect());
    let wavelengths: Option<Vec<f64>> = own.or(settings.and_then(|settings| settings.wavelengths));
    let line = line_of(text, "spectrum").unwrap_or(1);
    let wavelengths = wavelengths.filter(|all| !all.is_empty()).ok_or(ReadError::NoWavelengths(line))?;
    let mut header = Header::default();
    for (key, value) in metadata {
        header.note(0, key, value);
    }
    let mut notes = vec![Decision::new(
        "Program",
        &Decided::certain("a file of Wasatch ENLIGHTEN".to_owned(), says(text, "spectrum")),
    )];
    let label = header.comment("Label").map(str::to_owned);
    header.note(0, "title", label.as_deref().unwrap_or_default());
    let role = technique(text, &mut header);
    let processed = curves.iter().position(|(name, _)| name.eq_ignore_ascii_case("processed"));
    if let Some(processed) = processed.filter(|_| options.raw != Some(true)) {
        let left: Vec<String> = curves.iter().map(|(name, _)| format!("“{name}”")).collect();
        let left: Vec<&str> = left.iter().map(String::as_str).filter(|name| *name != "“processed”").collect();
        curves = vec![curves.swap_remove(processed)];
        if !left.is_empty() {
            let why = format!("{} are raw counts", left.join(", "));
            let decided =
                Decided::or_chosen(options.raw.map(|_| "“processed”"), || Decided::certain("“processed”", why));
            notes.push(Decision::new("Columns", &decided));
        }
    }
    let only = curves.len() == 1;
    let all: Result<Vec<Spectrum>, ReadError> = curves
        .into_iter()
        .map(|(name, values)| spectrum(&wavelengths, &name, values, label.as_deref(), only))
        .collect();
    let reader = Decided::certain(Reader::Enlighten, says(text, "spectrometerSettings"));
    Ok(Content { curves: Curves::Spectra(all?), header, reader, role, notes, parts: Vec::new(), part: None })
}

/// The role by the technique of the measurement.
fn technique(text: &str, header: &mut Header) -> Option<Decided<Role>> {
    let technique = header.comment("Technique")?.to_owned();
    let line = line_of(text, "Technique").unwrap_or(1);
    let why = format!("Line {line} says {technique}");
    match technique.to_lowercase().as_str() {
        "absorbance" => {
            header.values = Some((line, Values::Absorbance));
            Some(Decided::guess(Role::Transmittance, why))
        }
        "scope" | "raman" | "fluorescence" => Some(Decided::certain(Role::Unknown, why)),
        other => header_terms::role(other).map(|role| Decided::certain(role, why)),
    }
}

fn spectrum(
    wavelengths: &[f64],
    name: &str,
    values: Vec<Option<f64>>,
    label: Option<&str>,
    only: bool,
) -> Result<Spectrum, ReadError> {
    if values.len() != wavelengths.len() {
        let (found, expected) = (values.len(), wavelengths.len());
        return Err(ReadError::WrongCount { line: 1, name: name.to_owned(), found, expected });
    }
    let present = wavelengths.iter().zip(values).filter_map(|(&wavelength, value)| Some((wavelength, value?)));
    let samples = present.filter(|(wavelength, _)| wavelength.is_finite());
    let samples =
        samples.map(|(wavelength, value)| Sample { wavelength, value, line: 1, place: PlaceId::default() }).collect();
    let shown = label.filter(|_| only).unwrap_or(name);
    Ok(Spectrum { name: Some(shown.to_owned()), label: String::new(), samples })
}
