//! Raw values of DNG files (Adobe, DNG specification 1.7.1), mosaic and linear.
//!
//! [`RawImage`] holds the samples of the sensor as the file stores them and applies black and white levels where a pixel is
//! asked for: nothing is demosaiced, balanced or rendered, and opcodes are not applied. No file is opened here.
//!
//! Reading is total: any bytes give an image or a [`RawImageError`] that names field and remedy, never a panic. Sizes are
//! checked against the length of the file before anything is allocated.

mod directory;
mod error;
mod layout;
mod levels;
mod lossless_jpeg;
mod metadata;
mod preview;

use rayon::prelude::*;

use directory::{Directories, tag};
use error::DEVELOP;
pub use error::{CONVERTERS, LosslessJpegError, RawImageError};
use layout::Layout;
use levels::Levels;
pub use metadata::{DngColorMatrix, RawMetadata};
pub use preview::Preview;

/// Raw image of a DNG: the samples of its active area.
#[derive(Debug, Clone, PartialEq)]
pub struct RawImage {
    samples: Vec<u16>,
    /// Samples of a stored row, and of a pixel.
    row: usize,
    planes: usize,
    /// First column and row of the active area, and its size.
    origin: [usize; 2],
    size: [usize; 2],
    /// Channel of each sample of a 2 × 2 mosaic, or that of each sample of a pixel twice.
    mosaic: Option<[[usize; 2]; 2]>,
    levels: Levels,
    orientation: u8,
    metadata: RawMetadata,
}

impl RawImage {
    /// Decodes the raw image of a DNG.
    ///
    /// Mosaics of 2 × 2 filters in red, green and blue, and linear raw of three channels; uncompressed, lossless JPEG (ITU-T
    /// T.81, process 14) or JPEG XL, 8 to 16 bits, in tiles or strips.
    ///
    /// # Errors
    ///
    /// [`RawImageError`] where the bytes are no DNG, or one of another form, or broken.
    pub fn read(bytes: &[u8]) -> Result<Self, RawImageError> {
        if let Some(format) = other_raw(bytes) {
            return Err(RawImageError::OtherRaw { format });
        }
        let mut tags = Directories::read(bytes)?;
        let raw = raw_directory(&mut tags)?;
        let mosaic = mosaic(&mut tags, raw)?;
        let planes = if mosaic.is_some() { 1 } else { 3 };
        let layout = Layout::read(&mut tags, raw, planes, bytes)?;
        let (origin, size) = active_area(&mut tags, raw, &layout)?;
        let levels = Levels::read(&mut tags, raw, size, planes, layout.bits)?;
        let table = tags.numbers(raw, tag::LINEARIZATION_TABLE)?.filter(|table| !table.is_empty());
        let orientation = tags.count(0, tag::ORIENTATION, "Orientation").ok().flatten();
        let metadata = RawMetadata::read(&mut tags);
        let mut samples = layout.decode(bytes)?;
        if let Some(table) = table {
            let table: Vec<u16> = table.iter().map(|&value| value as u16).collect();
            samples.par_iter_mut().for_each(|sample| *sample = table[usize::from(*sample).min(table.len() - 1)]);
        }
        Ok(Self {
            samples,
            row: layout.width * planes,
            planes,
            origin,
            size,
            mosaic,
            levels,
            orientation: orientation.filter(|turn| (1..=8).contains(turn)).unwrap_or(1) as u8,
            metadata,
        })
    }

    /// Width and height of the active area in pixels as stored, not turned by [`RawImage::orientation`].
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Orientation as in TIFF, 1 to 8: row 0 and column 0 of the image are for 1 top and left, 3 bottom and right, 6 right
    /// and top, 8 left and bottom; 2, 4, 5 and 7 are mirrored.
    pub fn orientation(&self) -> u8 {
        self.orientation
    }

    /// Channel (0 red, 1 green, 2 blue) of the filter over a pixel; none in a linear image, whose pixels have all three.
    pub fn filter(&self, x: usize, y: usize) -> Option<usize> {
        self.mosaic.map(|mosaic| mosaic[y % 2][x % 2])
    }

    /// Linear camera RGB of a pixel: (sample − black) / (white − highest black of the sample's plane).
    ///
    /// Not clamped: noise goes below 0, a clipped sample is at [`RawImage::clip`] or above. NaN in the channels that a
    /// mosaic does not have at the pixel, and outside the image.
    pub fn pixel(&self, x: usize, y: usize) -> [f64; 3] {
        let mut rgb = [f64::NAN; 3];
        if x >= self.size[0] || y >= self.size[1] {
            return rgb;
        }
        let (black, added) = self.levels.row(y);
        let at = x * self.planes;
        let samples = &self.row_samples(y)[at..at + self.planes];
        for (plane, (&sample, black)) in samples.iter().zip(&black[at..]).enumerate() {
            let channel = self.filter(x, y).unwrap_or(plane);
            rgb[channel] = (f64::from(sample) - black - added) * self.levels.scale[plane];
        }
        rgb
    }

    /// Value from which on a channel of [`RawImage::pixel`] is clipped: that of a sample at `WhiteLevel`, less half a step.
    pub fn clip(&self) -> f64 {
        self.levels.clip()
    }

    /// Camera, exposure and color calibration as the file states them.
    pub fn metadata(&self) -> &RawMetadata {
        &self.metadata
    }

    /// Stored samples of a row of the active area.
    fn row_samples(&self, y: usize) -> &[u16] {
        let from = (self.origin[1] + y) * self.row + self.origin[0] * self.planes;
        &self.samples[from..from + self.size[0] * self.planes]
    }
}

/// The largest full-resolution directory with a mosaic or linear raw.
fn raw_directory(tags: &mut Directories<'_>) -> Result<usize, RawImageError> {
    let (mut largest, mut mosaic) = (None, false);
    for directory in 0..tags.all.len() {
        let photometric = tags.count(directory, tag::PHOTOMETRIC, "PhotometricInterpretation").ok().flatten();
        let full = tags.numbers(directory, tag::NEW_SUBFILE_TYPE)?.is_none_or(|kind| kind == [0.0]);
        mosaic |= photometric == Some(32803);
        if matches!(photometric, Some(32803 | 34892)) && full {
            let [width, height] = tags.size(directory)?;
            largest = largest.max(Some((width.saturating_mul(height), std::cmp::Reverse(directory))));
        }
    }
    if tags.numbers(0, tag::DNG_VERSION)?.is_none() {
        let format = maker_format(&tags.text(0, tag::MAKE).unwrap_or_default());
        return Err(if mosaic { RawImageError::OtherRaw { format } } else { RawImageError::NotDng });
    }
    largest.map(|(_, directory)| directory.0).ok_or(RawImageError::NoRawImage)
}

/// Channels of the mosaic of a directory; none for linear raw.
fn mosaic(tags: &mut Directories<'_>, raw: usize) -> Result<Option<[[usize; 2]; 2]>, RawImageError> {
    let linear = tags.count(raw, tag::PHOTOMETRIC, "PhotometricInterpretation")? == Some(34892);
    let planes = tags.count(raw, tag::SAMPLES, "SamplesPerPixel")?.unwrap_or(1);
    if planes != if linear { 3 } else { 1 } {
        return Err(RawImageError::Unsupported { what: "a raw image of other than three colors", remedy: DEVELOP });
    }
    if linear {
        return Ok(None);
    }
    let layout = tags.count(raw, tag::CFA_LAYOUT, "CFALayout")?.unwrap_or(1);
    let repeat = tags.numbers(raw, tag::CFA_REPEAT)?.ok_or(RawImageError::Missing { field: "CFARepeatPatternDim" })?;
    if repeat == [6.0; 2] {
        return Err(RawImageError::Unsupported { what: "a mosaic of 6 × 6 filters (X-Trans)", remedy: DEVELOP });
    }
    if repeat != [2.0; 2] || layout != 1 {
        return Err(RawImageError::Unsupported { what: "a mosaic of other than 2 × 2 filters", remedy: DEVELOP });
    }
    let colors = tags.numbers(raw, tag::CFA_PLANE_COLOR)?.unwrap_or_else(|| vec![0.0, 1.0, 2.0]);
    let pattern = tags.numbers(raw, tag::CFA_PATTERN)?.ok_or(RawImageError::Missing { field: "CFAPattern" })?;
    let has = |color: f64| pattern.contains(&color);
    let within = pattern.iter().all(|color| [0.0, 1.0, 2.0].contains(color));
    match pattern.as_slice() {
        &[a, b, c, d] if colors == [0.0, 1.0, 2.0] && within && has(0.0) && has(1.0) && has(2.0) => {
            Ok(Some([[a, b], [c, d]].map(|row| row.map(|color| color as usize))))
        }
        _ => Err(RawImageError::Unsupported {
            what: "a mosaic of filters other than red, green and blue",
            remedy: DEVELOP,
        }),
    }
}

/// Origin and size of the active area.
fn active_area(
    tags: &mut Directories<'_>,
    raw: usize,
    layout: &Layout,
) -> Result<([usize; 2], [usize; 2]), RawImageError> {
    let image = [0, 0, layout.height, layout.width].map(|side| side as f64);
    let area = tags.numbers(raw, tag::ACTIVE_AREA)?.unwrap_or_else(|| image.to_vec());
    let smallest = if layout.planes == 1 { 2 } else { 1 };
    let whole = area.iter().all(|side| *side >= 0.0 && side.fract() == 0.0);
    let sides: Vec<usize> = area.iter().map(|&side| side as usize).collect();
    match sides[..] {
        [top, left, bottom, right]
            if whole
                && bottom <= layout.height
                && right <= layout.width
                && top + smallest <= bottom
                && left + smallest <= right =>
        {
            Ok(([left, top], [right - left, bottom - top]))
        }
        _ => {
            let expected = "top, left, bottom and right within the image";
            Err(RawImageError::Value { field: "ActiveArea", value: format!("{area:?}"), expected })
        }
    }
}

/// Raw format other than DNG by the first bytes of a file.
fn other_raw(bytes: &[u8]) -> Option<&'static str> {
    let known: [(usize, &[u8], &str); 9] = [
        (4, b"ftypcrx ", "Canon CR3"),
        (8, b"CR\x02", "Canon CR2"),
        (6, b"HEAPCCDR", "Canon CRW"),
        (0, b"FUJIFILMCCD-RAW", "Fujifilm RAF"),
        (0, b"IIU\0", "Panasonic RW2"),
        (0, b"IIRO", "Olympus ORF"),
        (0, b"IIRS", "Olympus ORF"),
        (0, b"MMOR", "Olympus ORF"),
        (0, b"FOVb", "Sigma X3F"),
    ];
    known
        .iter()
        .find(|(at, magic, _)| bytes.get(*at..).is_some_and(|rest| rest.starts_with(magic)))
        .map(|known| known.2)
}

/// Raw format of a maker whose files are TIFF without `DNGVersion`.
fn maker_format(make: &str) -> &'static str {
    let known = [
        ("NIKON", "Nikon NEF"),
        ("SONY", "Sony ARW"),
        ("PENTAX", "Pentax PEF"),
        ("RICOH", "Pentax PEF"),
        ("SAMSUNG", "Samsung SRW"),
        ("HASSELBLAD", "Hasselblad 3FR"),
        ("KODAK", "Kodak DCR"),
        ("EPSON", "Epson ERF"),
    ];
    let make = make.to_uppercase();
    known.iter().find(|(maker, _)| make.starts_with(maker)).map_or("A raw file without DNGVersion", |known| known.1)
}

/// The example of the README, compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
