//! Tests of curves written in every format, read back, and checked against the requirements of other programs' readers.

mod averages;
mod layouts;
mod limits;
mod random;
mod round_trip;
mod streamed;
mod uncertain;

use spectral_file::write::{Content, Format, Grid, Note, Sheet, Trace, Written, write};
use spectral_file::{ReadOptions, Source, SpectralFile, read};

const CAMERA: Content<'static> =
    Content::Camera { channels: [0, 1, 2], per_photon: Some(false), manufacturer: Some("Nobody"), model: Some("N1") };

/// Curves on wavelengths of their own.
#[derive(Debug)]
struct Curves(Vec<(String, Vec<f64>, Vec<f64>)>);

impl Curves {
    /// Bells of height one around some wavelengths, at multiples of a step.
    fn bells(names: &[&str], [first, last]: [f64; 2], step: f64) -> Self {
        let count = ((last - first) / step).round() as usize;
        let wavelengths: Vec<f64> = (0..=count).map(|i| first + step * i as f64).collect();
        let curve = |(i, name): (usize, &&str)| {
            let values = wavelengths.iter().map(|&w| bell(i, w)).collect();
            ((*name).to_owned(), wavelengths.clone(), values)
        };
        Self(names.iter().enumerate().map(curve).collect())
    }

    fn traces(&self) -> Vec<Trace<'_>> {
        self.0
            .iter()
            .map(|(name, wavelengths_nm, values)| Trace { name, wavelengths_nm, values, uncertainty: None })
            .collect()
    }
}

/// A smooth curve: red, green, blue, and so on in turns.
fn bell(index: usize, w: f64) -> f64 {
    const SIGMA_NM: f64 = 30.0;
    let center = [610.0, 540.0, 455.0][index % 3];
    (-0.5 * ((w - center) / SIGMA_NM).powi(2)).exp()
}

fn sheet<'a>(content: Content<'a>, curves: &'a [Trace<'a>]) -> Sheet<'a> {
    Sheet { title: "Made up", content, curves, ..Sheet::default() }
}

fn written(sheet: &Sheet<'_>, format: Format, grid: Grid) -> Written {
    write(sheet, format, grid).unwrap_or_else(|error| panic!("{format}: {error}"))
}

fn back(text: &str) -> SpectralFile {
    let start: String = text.chars().take(2000).collect();
    read(text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}\n{start}"))
}

/// What is read with what is beside it.
fn beside(written: &Written) -> SpectralFile {
    let metadata = written.beside.metadata.as_ref().map(|metadata| metadata.text("a.csv")).unwrap_or_default();
    let covariance = written.beside.covariance.as_deref().unwrap_or_default().as_bytes();
    let source =
        Source { bytes: written.text.as_bytes(), metadata: metadata.as_bytes(), covariance, ..Source::default() };
    read(source, &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}\n{}", written.text))
}

fn has(notes: &[Note], wanted: fn(&Note) -> bool) -> bool {
    notes.iter().any(wanted)
}
