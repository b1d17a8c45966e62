//! ENVI images: a header of text, and samples in a file beside it.

use std::io::{Read, Seek, SeekFrom};
use std::ops::Range;

use crate::error::ImageError;
use crate::header::{DataType, EnviHeader, Interleave};
use crate::image::ImageInfo;

/// Bytes of the file in memory, if a row is not larger.
const BUFFER: usize = 1 << 20;

/// ENVI image whose rows are read when requested.
#[derive(Debug)]
pub struct EnviImage<R> {
    header: EnviHeader,
    data: R,
    buffer: Vec<u8>,
    /// Place of each band of the file in a pixel; none for a bad band.
    places: Vec<Option<usize>>,
}

impl<R: Read + Seek> EnviImage<R> {
    /// Takes a header and the data that it describes.
    ///
    /// # Errors
    ///
    /// [`ImageError::Short`] where there are fewer data than the header states.
    pub fn new(header: EnviHeader, mut data: R) -> Result<Self, ImageError> {
        let found = data.seek(SeekFrom::End(0))?;
        let expected = header.data_bytes().unwrap_or(u64::MAX);
        if found < expected {
            return Err(ImageError::Short { expected, found });
        }
        let mut places = vec![None; header.file_bands];
        for (place, &band) in header.bands.iter().enumerate() {
            places[band] = Some(place);
        }
        Ok(Self { header, data, buffer: Vec::new(), places })
    }

    /// Size, bands and quantity.
    pub fn info(&self) -> &ImageInfo {
        &self.header.info
    }

    /// Reads rows, as [`crate::SpectralImage::read_rows`].
    ///
    /// # Errors
    ///
    /// [`ImageError`] where the data cannot be read, or there are no such rows.
    pub fn read_rows(&mut self, rows: Range<usize>, samples: &mut Vec<f32>) -> Result<(), ImageError> {
        self.header.info.check_rows(&rows)?;
        samples.clear();
        samples.resize(rows.len() * self.header.info.row_samples(), f32::NAN);
        match self.header.interleave {
            Interleave::Bsq => self.by_bands(&rows, samples),
            Interleave::Bil | Interleave::Bip => self.by_rows(&rows, samples),
        }
    }

    /// Reads rows that hold all of their bands.
    fn by_rows(&mut self, rows: &Range<usize>, samples: &mut [f32]) -> Result<(), ImageError> {
        let (width, bands) = (self.header.info.width, self.header.file_bands);
        let row_bytes = width * bands * self.header.data_type.bytes();
        let at_once = (BUFFER / row_bytes).max(1);
        let kept = self.header.bands.len();
        for first in rows.clone().step_by(at_once) {
            let count = at_once.min(rows.end - first);
            self.fill(self.header.offset + (first * row_bytes) as u64, count * row_bytes)?;
            let from = (first - rows.start) * width * kept;
            let part = &mut samples[from..from + count * width * kept];
            for (row, pixels) in part.chunks_exact_mut(width * kept).enumerate() {
                for (place, &band) in self.header.bands.iter().enumerate() {
                    let (start, step) = match self.header.interleave {
                        Interleave::Bip => (row * width * bands + band, bands),
                        _ => ((row * bands + band) * width, 1),
                    };
                    self.decode(start, step, place, pixels);
                }
            }
        }
        Ok(())
    }

    fn by_bands(&mut self, rows: &Range<usize>, samples: &mut [f32]) -> Result<(), ImageError> {
        let (width, height) = (self.header.info.width, self.header.info.height);
        let row_bytes = width * self.header.data_type.bytes();
        let at_once = (BUFFER / row_bytes).max(1);
        let kept = self.header.bands.len();
        for band in 0..self.header.file_bands {
            let Some(place) = self.places[band] else { continue };
            for first in rows.clone().step_by(at_once) {
                let count = at_once.min(rows.end - first);
                let at = (band as u64 * height as u64 + first as u64) * row_bytes as u64;
                self.fill(self.header.offset + at, count * row_bytes)?;
                let from = (first - rows.start) * width * kept;
                self.decode(0, 1, place, &mut samples[from..from + count * width * kept]);
            }
        }
        Ok(())
    }

    fn fill(&mut self, at: u64, count: usize) -> Result<(), ImageError> {
        self.buffer.resize(count, 0);
        self.data.seek(SeekFrom::Start(at))?;
        Ok(self.data.read_exact(&mut self.buffer)?)
    }

    /// Writes one band of consecutive pixels: samples `start`, `start + step`, … of the buffer.
    fn decode(&self, start: usize, step: usize, place: usize, pixels: &mut [f32]) {
        macro_rules! each {
            ($type:ty) => {
                self.convert(start, step, place, pixels, |bytes| {
                    let bytes = bytes.try_into().unwrap_or_default();
                    let value = if self.header.big_endian {
                        <$type>::from_be_bytes(bytes)
                    } else {
                        <$type>::from_le_bytes(bytes)
                    };
                    value as f64
                })
            };
        }
        #[allow(clippy::cast_lossless, reason = "one expression for all types")]
        match self.header.data_type {
            DataType::U8 => each!(u8),
            DataType::I16 => each!(i16),
            DataType::I32 => each!(i32),
            DataType::F32 => each!(f32),
            DataType::F64 => each!(f64),
            DataType::U16 => each!(u16),
            DataType::U32 => each!(u32),
            DataType::I64 => each!(i64),
            DataType::U64 => each!(u64),
        }
    }

    fn convert(&self, start: usize, step: usize, place: usize, pixels: &mut [f32], read: impl Fn(&[u8]) -> f64) {
        let size = self.header.data_type.bytes();
        let (gain, offset) = (self.header.gains[place], self.header.offsets[place]);
        let ignore = self.header.ignore;
        let bytes = &self.buffer[start * size..];
        let samples = bytes.chunks(step * size).map(|sample| read(&sample[..size]));
        for (pixel, value) in pixels.chunks_exact_mut(self.header.bands.len()).zip(samples) {
            // Ignored values are often written in single precision where samples are.
            let missing = !value.is_finite() || ignore.is_some_and(|i| value == i || value == f64::from(i as f32));
            let value = (value * gain + offset) as f32;
            pixel[place] = if missing || !value.is_finite() { f32::NAN } else { value };
        }
    }
}
