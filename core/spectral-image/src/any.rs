//! An image of any of the formats.

use std::io::{Read, Seek};
use std::ops::Range;

use crate::envi::EnviImage;
use crate::error::ImageError;
use crate::exr_image::ExrImage;
use crate::image::ImageInfo;

/// An image of any of the formats.
#[derive(Debug)]
#[allow(
    clippy::large_enum_variant,
    reason = "one image is open at a time; the sizes depend on features of other crates"
)]
pub enum SpectralImage<R> {
    /// ENVI.
    Envi(EnviImage<R>),
    /// `OpenEXR`.
    Exr(ExrImage<R>),
}

impl<R: Read + Seek> SpectralImage<R> {
    /// Size, bands and quantity.
    pub fn info(&self) -> &ImageInfo {
        match self {
            Self::Envi(image) => image.info(),
            Self::Exr(image) => image.info(),
        }
    }

    /// Reads rows into `samples`, pixel by pixel, bands in ascending wavelength; NaN where the file has no value.
    ///
    /// # Errors
    ///
    /// [`ImageError`] where the data end early, cannot be read, or there are no such rows.
    pub fn read_rows(&mut self, rows: Range<usize>, samples: &mut Vec<f32>) -> Result<(), ImageError> {
        match self {
            Self::Envi(image) => image.read_rows(rows, samples),
            Self::Exr(image) => image.read_rows(rows, samples),
        }
    }
}
