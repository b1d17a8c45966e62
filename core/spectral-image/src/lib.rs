//! Spectral images by rows: ENVI cubes and `OpenEXR` with spectral channels.
//!
//! [`EnviImage`] and [`ExrImage`] read any rows of an image through `Read + Seek` into one block of `f32`, pixel by pixel, bands in
//! ascending wavelength. Only that block and one buffer of the file's bytes are held, so a cube of any size can be gone through in
//! memory chosen by the caller. No file is opened here, and color is not known.
//!
//! Reading is total: any bytes give an image, an [`ImageError`] that names field and remedy, and never a panic. Dimensions are checked
//! against the length of the data before anything is allocated.

mod any;
mod envi;
mod error;
mod exr_image;
mod header;
mod image;
mod names;

pub use any::SpectralImage;
pub use envi::EnviImage;
pub use error::ImageError;
pub use exr_image::ExrImage;
pub use header::{DataType, EnviHeader, Interleave};
pub use image::{ImageInfo, ImageQuantity, MAX_BANDS, MAX_ROW_BYTES, MAX_SIDE, Note};
pub use names::SpectralChannel;

/// The example of the README, compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
