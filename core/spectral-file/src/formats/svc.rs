//! Field spectrometers of Spectra Vista, before called GER (`.sig`): `key= value` lines, then `data=` and rows of a wavelength, the
//! radiances of the reference and of the target, and their ratio in percent. Ranges of detectors may overlap.

use crate::decision::{Decided, Decision, Delimiter, Quantity, Reader, Role, Values, WavelengthUnit};
use crate::dialect::Dialect;
use crate::error::ReadError;
use crate::formats::Format;
use crate::formats::spectra::{self, Found, Sample, Spectrum};
use crate::header::Header;
use crate::header_terms;
use crate::options::ReadOptions;
use crate::text::Lines;
use crate::watch::Log;

impl Reader {
    /// Spectra Vista field spectrometers.
    pub const SVC: Self = Self::new("svc", "Spectra Vista SIG data", "Spectra Vista .sig");
}

pub(super) const FORMAT: Format = Format {
    reader: Reader::SVC,
    fits: |head| STARTS.iter().any(|start| head.text.trim_start().starts_with(start)),
    read,
};

const STARTS: [&str; 2] = ["/*** Spectra Vista", "///GER SIGNATUR FILE"];

/// Columns behind the wavelengths; the last is the target over the reference, in percent.
const COLUMNS: [&str; 3] = ["Reference", "Target", "Reflectance (%)"];

fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let mut header = Header::default();
    let mut units = None;
    let mut lines = Lines::new(text);
    for (line, text) in lines.by_ref() {
        let Some((key, value)) = text.split_once('=') else { continue };
        match key.trim() {
            "data" => break,
            "name" => header.note(line, "title", value.trim().trim_end_matches(".sig")),
            "units" => units = Some((line, value.trim().to_owned())),
            _ => {}
        }
        header.note(line, key.trim(), value.trim());
    }
    let mut rows = lines.filter(|(_, line)| !line.trim().is_empty()).peekable();
    let (first_line, first) = rows.peek().copied().unwrap_or_default();
    let (width, mark) = (first.split_whitespace().count(), Dialect::of_number(first).mark);
    if !(2..=1 + COLUMNS.len()).contains(&width) {
        return Err(if first_line == 0 {
            ReadError::NoNumbers
        } else {
            ReadError::UnevenRow { line: first_line, found: width, expected: 4 }
        });
    }
    let ratio = width == 1 + COLUMNS.len() && options.raw != Some(true);
    let columns: Vec<usize> = if ratio { vec![3] } else { (1..width).collect() };
    let mut all = spectra::rows(rows, &columns, log)?;
    let mut notes = vec![Decision::certain("Program", "a file of Spectra Vista", "Line 1 shows it")];
    let mut overlaps = Vec::new();
    for samples in &mut all {
        overlaps = without_overlaps(samples);
    }
    if !overlaps.is_empty() {
        let value = format!("each read up to the middle of what it shares with the next, {}", overlaps.join(", "));
        notes.push(Decision::certain("Detectors", value, "The ranges of its detectors overlap"));
    }
    let name = |column: usize| (!ratio).then(|| COLUMNS[column - 1].to_owned());
    let spectra = all.into_iter().zip(&columns);
    let spectra = spectra.map(|(samples, &column)| Spectrum { name: name(column), samples, ..Spectrum::default() });
    let mut grid = spectra::grid(spectra.collect(), header, log)?;
    grid.unit = Some(Decided::certain(WavelengthUnit::Nanometer, "Spectra Vista prescribes it"));
    if ratio {
        let why = "Its fourth column is the target over the reference in percent";
        grid.role = Some(Decided::certain(Role::Reflectance, why));
        grid.quantity = Some(Decided::certain(Quantity::Reflectance, why));
        grid.header.values = Some((first_line, Values::Percent));
        let left = "“Reference” and “Target” are what it was computed from";
        let decided =
            Decided::or_chosen(options.raw.map(|_| "“Reflectance”"), || Decided::certain("“Reflectance”", left));
        notes.push(Decision::new("Columns", &decided));
    } else if let Some((line, units)) = units {
        grid.header.role = header_terms::role(&units).map(|role| (line, role));
        grid.header.quantity = header_terms::quantity(&units).map(|quantity| (line, quantity));
    }
    let why = "The first line names it";
    let dialect = (Delimiter::Spaces, mark);
    Ok(Found::fixed(grid, Decided::certain(Reader::SVC, why), (dialect, first_line, why), notes))
}

/// Where wavelengths fall back, as the next detector begins, leaves the samples of one detector on each side of the middle of
/// what both measured. Returns those ranges.
fn without_overlaps(samples: &mut Vec<Sample>) -> Vec<String> {
    const MOST: usize = 3;
    let falls = |pair: &[Sample]| pair[1].wavelength < pair[0].wavelength;
    let starts: Vec<usize> =
        samples.windows(2).enumerate().filter(|(_, pair)| falls(pair)).map(|(at, _)| at + 1).collect();
    let from = |start: &usize| samples[*start].wavelength;
    // Other disorder is no overlap.
    let in_order = starts.windows(2).all(|pair| from(&pair[0]) < from(&pair[1]));
    if starts.len() > MOST || !in_order || starts.first().is_some_and(|start| from(start) <= samples[0].wavelength) {
        return Vec::new();
    }
    let shared: Vec<(f64, f64)> = starts.iter().map(|start| (from(start), samples[start - 1].wavelength)).collect();
    let mut detector = 0;
    let mut index = 0;
    samples.retain(|sample| {
        detector += usize::from(starts.get(detector) == Some(&index));
        index += 1;
        let middle = |(from, to): &(f64, f64)| (from + to) / 2.0;
        let after = detector == 0 || sample.wavelength > middle(&shared[detector - 1]);
        after && shared.get(detector).is_none_or(|shared| sample.wavelength <= middle(shared))
    });
    shared.iter().map(|(from, to)| format!("{from} to {to} nm")).collect()
}
