//! Spectral images by rows: ENVI cubes and `OpenEXR` with spectral channels.
//!
//! [`EnviImage`] and [`ExrImage`] read any rows of an image through `Read + Seek` into one block of `f32`, pixel by pixel, bands in
//! ascending wavelength. Only that block and one buffer of the file's bytes are held, so a cube of any size can be gone through in
//! memory chosen by the caller. No file is opened here, and color is not known.
//!
//! Reading is total: any bytes give an image, an [`ImageError`] that names field and remedy, and never a panic. Dimensions are checked
//! against the length of the data before anything is allocated.

mod envi;
mod error;
mod exr_image;
mod header;
mod image;

use std::io::{Read, Seek};
use std::ops::Range;

pub use envi::EnviImage;
pub use error::ImageError;
pub use exr_image::{ExrImage, SpectralChannel};
pub use header::{DataType, EnviHeader, Interleave};
pub use image::{ImageInfo, ImageQuantity, MAX_BANDS, MAX_ROW_BYTES, MAX_SIDE, Note};

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

/// The example of the README, compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
