//! Samples of an image from its tiles or strips.

use jxl_oxide::{AllocTracker, JxlImage};
use rayon::prelude::*;

use crate::directory::{Directories, tag};
use crate::error::{LosslessJpegError, RawImageError};
use crate::lossless_jpeg;

/// Most pixels of an image.
const MAX_PIXELS: usize = 400_000_000;

/// Remedy for what the format allows and this reader does not read.
const CONVERT: &str = "convert the camera's file with Adobe DNG Converter (free of charge), without lossy compression";

#[derive(Clone, Copy, PartialEq)]
enum Compression {
    None,
    LosslessJpeg,
    JpegXl,
}

/// Place and form of the samples of an image in a file.
pub(crate) struct Layout {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Samples of a pixel: 1 or 3.
    pub(crate) planes: usize,
    pub(crate) bits: u32,
    compression: Compression,
    big_endian: bool,
    /// Width and height of tiles; a strip is a tile as wide as the image.
    tile: [usize; 2],
    /// Offset and length in bytes of each tile, row by row.
    chunks: Vec<[usize; 2]>,
    /// `RowInterleaveFactor`, `ColumnInterleaveFactor`.
    interleave: [usize; 2],
}

impl Layout {
    /// Form of the image of a directory with `planes` samples a pixel, checked against the length of the file.
    pub(crate) fn read(
        tags: &mut Directories<'_>,
        directory: usize,
        planes: usize,
        bytes: &[u8],
    ) -> Result<Self, RawImageError> {
        let [width, height] = tags.size(directory)?;
        let bits = tags.count(directory, tag::BITS, "BitsPerSample")?.unwrap_or(1);
        let compression = tags.count(directory, tag::COMPRESSION, "Compression")?.unwrap_or(1);
        let format = tags.count(directory, tag::SAMPLE_FORMAT, "SampleFormat")?.unwrap_or(1);
        let planar = tags.count(directory, tag::PLANAR, "PlanarConfiguration")?.unwrap_or(1);
        let unsupported = |what| Err(RawImageError::Unsupported { what, remedy: CONVERT });
        let compression = match compression {
            1 => Compression::None,
            7 => Compression::LosslessJpeg,
            52546 => Compression::JpegXl,
            8 | 32946 => return unsupported("a raw image with Deflate compression"),
            34892 => return unsupported("a raw image with lossy JPEG compression"),
            _ => return unsupported("a raw image with compression other than none, lossless JPEG or JPEG XL"),
        };
        if format != 1 {
            return unsupported("a raw image of floating point or signed samples");
        }
        if planar != 1 && planes > 1 {
            return unsupported("a linear raw image with separate planes");
        }
        if !(8..=16).contains(&bits) {
            return unsupported("a raw image with fewer than 8 or more than 16 bits a sample");
        }
        let (tile, chunks) = tags.chunks(directory, [width, height])?;
        let mut interleave = [1; 2];
        for (factor, (tag, field, limit)) in interleave.iter_mut().zip([
            (tag::ROW_INTERLEAVE, "RowInterleaveFactor", height),
            (tag::COLUMN_INTERLEAVE, "ColumnInterleaveFactor", width),
        ]) {
            *factor = tags.count(directory, tag, field)?.unwrap_or(1).clamp(1, limit);
        }
        let pixels = width.saturating_mul(height);
        let most = match compression {
            Compression::None => bytes.len() / bits * 8 + 8,
            // A sample takes at least a bit.
            Compression::LosslessJpeg => bytes.len().saturating_mul(8),
            // Noise of a sensor keeps to far more than a byte for a thousand samples.
            Compression::JpegXl => bytes.len().saturating_mul(1024),
        };
        if pixels > MAX_PIXELS || pixels * planes > most {
            return Err(RawImageError::Size { width, height });
        }
        let big_endian = bytes.starts_with(b"MM");
        Ok(Self { width, height, planes, bits: bits as u32, compression, big_endian, tile, chunks, interleave })
    }

    /// Decodes all samples, row by row.
    pub(crate) fn decode(&self, bytes: &[u8]) -> Result<Vec<u16>, RawImageError> {
        let (row, tile_row) = (self.width * self.planes, self.tile[0] * self.planes);
        let across = self.width.div_ceil(self.tile[0]);
        let mut samples = vec![0; row * self.height];
        let bands: Vec<Result<(), RawImageError>> = samples
            .par_chunks_mut(row * self.tile[1])
            .enumerate()
            .map(|(down, band)| {
                let tiles: Vec<_> = (down * across..(down + 1) * across)
                    .into_par_iter()
                    .map(|index| self.decode_tile(bytes, index, band.len() / row))
                    .collect();
                for (from, tile) in (0..row).step_by(tile_row).zip(tiles) {
                    for (line, tile) in band.chunks_mut(row).zip(tile?.chunks(tile_row)) {
                        let line = &mut line[from..];
                        let length = line.len().min(tile_row);
                        line[..length].copy_from_slice(&tile[..length]);
                    }
                }
                Ok(())
            })
            .collect();
        bands.into_iter().collect::<Result<(), _>>()?;
        Ok(if self.interleave == [1, 1] { samples } else { self.in_order(&samples) })
    }

    /// At least `rows` rows of a tile.
    fn decode_tile(&self, bytes: &[u8], index: usize, rows: usize) -> Result<Vec<u16>, RawImageError> {
        let [offset, length] = self.chunks[index];
        let truncated = RawImageError::Truncated { index };
        let Some(data) = offset.checked_add(length).and_then(|end| bytes.get(offset..end)) else {
            return Err(truncated);
        };
        let row = self.tile[0] * self.planes;
        match self.compression {
            Compression::None => unpack(data, [row, rows], self.bits, self.big_endian).ok_or(truncated),
            Compression::LosslessJpeg => {
                let tile = row * self.tile[1];
                lossless_jpeg::decode(data, 2 * tile)
                    .and_then(|frame| {
                        let (found, expected) = (frame.samples.len(), row * rows);
                        if found != tile && frame.row > row && found / frame.row >= rows {
                            // A frame wider than its tile, as of an odd width in two components.
                            Ok(frame.samples.chunks(frame.row).flat_map(|line| &line[..row]).copied().collect())
                        } else if found >= expected && (frame.row.is_multiple_of(row) || row.is_multiple_of(frame.row))
                        {
                            // The samples are the tile's in their order, whatever the rows of the frame.
                            Ok(frame.samples)
                        } else {
                            Err(LosslessJpegError::Size { found, expected })
                        }
                    })
                    .map_err(|error| RawImageError::LosslessJpeg { index, error })
            }
            Compression::JpegXl => {
                self.jpeg_xl(data, rows).map_err(|error| RawImageError::JpegXl { index, error: error.to_string() })
            }
        }
    }

    /// Samples of a JPEG XL image, bare or in a container, as integers of the directory's bits.
    fn jpeg_xl(&self, data: &[u8], rows: usize) -> jxl_oxide::Result<Vec<u16>> {
        let limit = self.tile[0].saturating_mul(self.tile[1]).saturating_mul(64).saturating_add(1 << 26);
        let image = JxlImage::builder().alloc_tracker(AllocTracker::with_limit(limit)).read(data)?;
        let [width, height] = [image.width() as usize, image.height() as usize];
        if width < self.tile[0].min(self.width) || width > self.tile[0] || height < rows || height > self.tile[1] {
            return Err(format!("{width} × {height} pixels in a tile of {} × {}", self.tile[0], self.tile[1]).into());
        }
        let frame = image.render_frame(0)?;
        let mut stream = frame.stream_no_alpha();
        if stream.channels() as usize != self.planes || stream.width() as usize != width {
            return Err("other channels or orientation than the DNG's".into());
        }
        let largest = ((1_u32 << self.bits) - 1) as f32;
        let mut samples = vec![0; self.tile[0] * self.planes * rows];
        let mut line = vec![0_f32; width * self.planes];
        for samples in samples.chunks_exact_mut(self.tile[0] * self.planes) {
            stream.write_to_buffer(&mut line);
            for (sample, value) in samples.iter_mut().zip(&line) {
                *sample = (value * largest).round() as u16;
            }
        }
        Ok(samples)
    }

    /// Samples with interleaved rows and columns in their order in the image: field `f` of `n` holds rows f, f + n, f + 2n …
    fn in_order(&self, samples: &[u16]) -> Vec<u16> {
        let stored_at = |length: usize, factor: usize| {
            let mut at = vec![0; length];
            let fields = (0..factor).flat_map(|field| (field..length).step_by(factor));
            fields.enumerate().for_each(|(stored, place)| at[place] = stored);
            at
        };
        let [rows, columns] = [stored_at(self.height, self.interleave[0]), stored_at(self.width, self.interleave[1])];
        let row = self.width * self.planes;
        let mut ordered = vec![0; samples.len()];
        ordered.par_chunks_mut(row).zip(&rows).for_each(|(line, &stored)| {
            let stored = &samples[stored * row..][..row];
            for (pixel, &column) in line.chunks_exact_mut(self.planes).zip(&columns) {
                pixel.copy_from_slice(&stored[column * self.planes..][..self.planes]);
            }
        });
        ordered
    }
}

/// Uncompressed samples; those of other than 8 or 16 bits packed from the highest bit on, rows padded to bytes.
fn unpack(data: &[u8], [row, rows]: [usize; 2], bits: u32, big_endian: bool) -> Option<Vec<u16>> {
    let row_bytes = row.checked_mul(bits as usize)?.div_ceil(8);
    let data = data.get(..row_bytes.checked_mul(rows)?)?;
    let mut samples = vec![0; row * rows];
    samples.par_chunks_mut(row).zip(data.par_chunks(row_bytes)).for_each(|(line, data)| match bits {
        8 => line.iter_mut().zip(data).for_each(|(sample, &byte)| *sample = byte.into()),
        16 => line.iter_mut().zip(data.as_chunks().0).for_each(|(sample, &bytes)| {
            *sample = if big_endian { u16::from_be_bytes(bytes) } else { u16::from_le_bytes(bytes) };
        }),
        _ => {
            let (mut held, mut count, mut data) = (0_u32, 0, data.iter());
            for sample in line {
                while count < bits {
                    held = held << 8 | u32::from(*data.next().expect("rows hold all samples"));
                    count += 8;
                }
                count -= bits;
                *sample = (held >> count & ((1 << bits) - 1)) as u16;
            }
        }
    });
    Some(samples)
}
