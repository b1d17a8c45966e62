//! Properties that all spectral images share.

use std::ops::Range;

use crate::error::ImageError;
use chromascope_text::choices;

/// Largest width and height in pixels.
pub const MAX_SIDE: usize = 65_536;
/// Largest number of bands.
pub const MAX_BANDS: usize = 4096;
/// Largest size of one row of samples in memory, in bytes.
pub const MAX_ROW_BYTES: usize = 1 << 28;

choices! {
    /// Quantity of the samples.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum ImageQuantity {
        /// Reflectance or transmittance, 1 for a perfect diffuser.
        Reflectance = "reflectance", "Reflectance", "Reflectances, lit by the illuminant";
        /// Radiance, in any unit.
        Radiance = "radiance", "Radiance", "Radiances, taken as they are; the illuminant only balances white";
    }
}

/// Decision made on reading that the user should know of.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what was done")]
pub enum Note {
    #[error("`wavelength units` is missing; {first} to {last} were taken as {unit}")]
    Unit { first: f64, last: f64, unit: &'static str },
    #[error("{0} bands that `bbl` marks as bad were skipped")]
    BadBands(usize),
    #[error("bands were sorted by wavelength")]
    Sorted,
    #[error("samples were divided by the `reflectance scale factor` {0}")]
    Scale(f64),
    #[error("{0} channels that are not spectral were skipped")]
    OtherChannels(usize),
}

/// Size, bands and quantity of an image.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageInfo {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Wavelengths of the bands in nanometers, strictly ascending.
    pub wavelengths_nm: Vec<f64>,
    /// Quantity, where the file states it.
    pub quantity: Option<ImageQuantity>,
    /// Decisions made on reading.
    pub notes: Vec<Note>,
}

impl ImageInfo {
    /// Number of samples in a row: width × bands.
    pub fn row_samples(&self) -> usize {
        self.width * self.wavelengths_nm.len()
    }

    /// Number of rows whose samples take at most `bytes`, at least 1.
    pub fn rows_within(&self, bytes: usize) -> usize {
        (bytes / (self.row_samples() * size_of::<f32>()).max(1)).clamp(1, self.height)
    }

    /// Checks sides and bands before anything is allocated by them; `fields` names them as the format does.
    pub(crate) fn check_size([width, height, bands]: [usize; 3], fields: [&'static str; 3]) -> Result<(), ImageError> {
        let sizes = [(width, MAX_SIDE), (height, MAX_SIDE), (bands, MAX_BANDS)];
        for (field, (value, limit)) in fields.into_iter().zip(sizes) {
            if value == 0 || value > limit {
                return Err(ImageError::Size { field, value, limit });
            }
        }
        if width * bands > MAX_ROW_BYTES / size_of::<f32>() {
            return Err(ImageError::Row { width, bands });
        }
        Ok(())
    }

    pub(crate) fn check_rows(&self, rows: &Range<usize>) -> Result<(), ImageError> {
        if rows.start <= rows.end && rows.end <= self.height {
            Ok(())
        } else {
            Err(ImageError::Rows { from: rows.start, to: rows.end, height: self.height })
        }
    }
}

/// Order of bands by ascending wavelength, and the wavelengths in that order.
pub(crate) fn ascending(wavelengths: &[f64], field: &'static str) -> Result<Vec<usize>, ImageError> {
    let mut order: Vec<usize> = (0..wavelengths.len()).collect();
    order.sort_by(|&a, &b| wavelengths[a].total_cmp(&wavelengths[b]));
    match order.windows(2).find(|pair| wavelengths[pair[0]] == wavelengths[pair[1]]) {
        Some(pair) => Err(ImageError::Twice { field, nm: wavelengths[pair[0]] }),
        None => Ok(order),
    }
}
