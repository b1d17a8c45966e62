//! Files of recorded raw values.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use chromascope_core::camera::recorded::RecordedPatch;
use chromascope_core::spectral::{GridSpectrum, Quantity, SpectralDistribution};
use chromascope_figure::Image;
use spectral_file::{Certainty, ReadOptions, Role};

use super::chart_picture::{ChartPicture, is_picture};
use super::file_store::{FileStore, FromFile};
use super::recorded::{self, Levels, RawRow};
use crate::document::imported::Fingerprint;
use crate::format::{file_name, io_reason};

const MAX_BYTES: u64 = 1 << 30;
/// Longest side of a picture as it is shown.
const SHOWN: usize = 1024;

#[derive(Clone, Debug)]
pub struct TableSpectra {
    /// By the names of their patches.
    pub curves: Vec<(String, SpectralDistribution)>,
    /// True if they are radiances; false for reflectances.
    pub are_radiances: bool,
}

#[derive(Debug)]
pub enum RecordedContent {
    Table(Vec<RawRow>, Option<TableSpectra>),
    Picture(ChartPhoto),
}

/// A picture of a chart.
#[derive(Debug)]
pub struct ChartPhoto {
    pub picture: ChartPicture,
    /// By which it is known wherever it is.
    pub contents: Fingerprint,
    /// The picture as it is shown.
    pub shown: Image,
    /// Corners of the grid of patches, if a chart was found for certain.
    pub found: Option<[[f64; 2]; 4]>,
}

#[derive(Debug)]
pub struct RecordedFile {
    pub name: String,
    pub content: RecordedContent,
}

pub type RecordedStore = FileStore<RecordedFile>;

impl FromFile for RecordedFile {
    type Failure = String;
    type Version = ();
    const THREAD: &'static str = "recorded";

    fn read_unless(path: &Path, _: Option<()>, _: &dyn Fn() -> bool) -> Result<Option<(Self, ())>, String> {
        read(path).map(|file| Some((file, ())))
    }

    fn bytes(&self) -> usize {
        match &self.content {
            RecordedContent::Table(rows, _) => size_of_val(rows.as_slice()),
            RecordedContent::Picture(photo) => photo.picture.size().iter().product::<usize>() * size_of::<[f32; 3]>(),
        }
    }

    fn summary(&self) -> &str {
        &self.name
    }
}

/// Reads a table or a picture; the error is a message with the file's name.
fn read(path: &Path) -> Result<RecordedFile, String> {
    let name = file_name(path);
    let failed = |why: String| format!("{name}: {why}");
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|error| failed(io_reason(&error)))?;
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(|error| failed(io_reason(&error)))?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(failed(format!("larger than {} MB; cut or bin the picture", MAX_BYTES >> 20)));
    }
    let content = if is_picture(path) {
        let picture = ChartPicture::read(path, &bytes).map_err(|error| failed(error.to_string()))?;
        let (shown, found) = (picture.preview(SHOWN), picture.find_chart());
        RecordedContent::Picture(ChartPhoto { picture, contents: Fingerprint::of(&bytes), shown, found })
    } else {
        let table = recorded::read_table(&bytes).map_err(|error| failed(error.to_string()))?;
        let spectra = table.spectra.as_deref().map(spectra).transpose().map_err(failed)?;
        RecordedContent::Table(table.rows, spectra)
    };
    Ok(RecordedFile { name, content })
}

fn spectra(text: &str) -> Result<TableSpectra, String> {
    let read = |role: Option<Role>| {
        let options = ReadOptions { role, ..ReadOptions::default() };
        spectral_file::read(text.as_bytes(), &options).map_err(|error| error.to_string())
    };
    let mut table = read(None)?;
    // Beside the raw values of a chart, spectra that are no radiances are its reflectances.
    if table.role.certainty == Certainty::Open {
        table = read(Some(Role::Reflectance))?;
    }
    let are_radiances = table.role.value == Role::Illuminant;
    let curve = |curve: &spectral_file::Curve| {
        let spectrum = SpectralDistribution::new(curve.wavelengths_nm.clone(), curve.values.clone());
        spectrum.map(|spectrum| (curve.name.clone(), spectrum)).map_err(|error| error.to_string())
    };
    Ok(TableSpectra { curves: table.curves.iter().map(curve).collect::<Result<_, _>>()?, are_radiances })
}

impl RecordedFile {
    /// True if the chart and the light come from elsewhere.
    pub fn needs_chart(&self) -> bool {
        !matches!(&self.content, RecordedContent::Table(_, Some(_)))
    }

    /// Patches with spectra and raw values. `chart` is the current chart's radiances, `light` the current light.
    pub fn patches(
        &self,
        chart: &[(String, GridSpectrum)],
        light: &GridSpectrum,
        levels: Levels,
    ) -> Result<Vec<RecordedPatch>, String> {
        let join = |spectra: &[(String, GridSpectrum)], rows: &[RawRow]| {
            recorded::join(spectra, rows, levels).map_err(|error| error.to_string())
        };
        match &self.content {
            RecordedContent::Table(rows, None) => join(chart, rows),
            RecordedContent::Table(rows, Some(spectra)) => {
                let radiance = |(name, curve): &(String, SpectralDistribution)| {
                    let spectrum = if spectra.are_radiances {
                        GridSpectrum::resample(curve, Quantity::Light)
                    } else {
                        recorded::lit(&GridSpectrum::resample(curve, Quantity::Reflectance), light)
                    };
                    (name.clone(), spectrum)
                };
                join(&spectra.curves.iter().map(radiance).collect::<Vec<_>>(), rows)
            }
            RecordedContent::Picture(_) => Err("a picture of a chart: open it in Data, Measure a camera".to_owned()),
        }
    }
}
