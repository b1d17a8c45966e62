//! TIFF directories of a file by the `tiff` crate, whatever their images hold.

use std::borrow::Cow;
use std::collections::VecDeque;
use std::io::Cursor;

use tiff::Directory;
use tiff::decoder::Decoder;
use tiff::decoder::ifd::Value;
use tiff::tags::{IfdPointer, Tag};

use crate::error::RawImageError;

/// Directories that are looked at: a camera's file has fewer than ten.
const MAX_DIRECTORIES: usize = 64;

/// Most values of a tag: a linearization table has 65,536, 400 megapixels in tiles of 64 × 64 pixels 97,656 offsets.
const MAX_VALUES: u64 = 1 << 17;

/// Directories of a file: the main ones in their order, then those named in `SubIFDs`.
pub(crate) struct Directories<'a> {
    decoder: Decoder<Cursor<Cow<'a, [u8]>>>,
    pub(crate) all: Vec<Directory>,
}

impl<'a> Directories<'a> {
    /// Reads every directory of a TIFF or `BigTIFF` file.
    pub(crate) fn read(bytes: &'a [u8]) -> Result<Self, RawImageError> {
        let big_endian = match bytes.get(..2) {
            Some(b"II") => false,
            Some(b"MM") => true,
            _ => return Err(RawImageError::NotDng),
        };
        let number = |range: std::ops::Range<usize>| {
            let digits = bytes.get(range).ok_or(RawImageError::NotDng)?.iter();
            let join = |sum: u64, digit: &u8| sum << 8 | u64::from(*digit);
            Ok::<_, RawImageError>(if big_endian { digits.fold(0, join) } else { digits.rev().fold(0, join) })
        };
        let (large, first) = match number(2..4)? {
            42 => (false, number(4..8)?),
            43 => (true, number(8..16)?),
            _ => return Err(RawImageError::NotDng),
        };
        // `Decoder::new` refuses a file whose first image is a mosaic: it is given one pixel in the same byte order, and
        // then the file.
        let mut decoder = Decoder::new(Cursor::new(Cow::Owned(one_pixel(big_endian, large))))?;
        *decoder.inner() = Cursor::new(Cow::Borrowed(bytes));
        let mut found = Self { decoder, all: Vec::new() };
        found.walk(first)?;
        if found.all.is_empty() { Err(RawImageError::NotDng) } else { Ok(found) }
    }

    fn walk(&mut self, first: u64) -> Result<(), RawImageError> {
        let (mut queue, mut seen) = (VecDeque::from([first]), Vec::new());
        while let Some(at) = queue.pop_front().filter(|_| self.all.len() < MAX_DIRECTORIES) {
            if at == 0 || seen.contains(&at) {
                continue;
            }
            seen.push(at);
            // A broken preview does no harm to the raw image.
            let directory = match self.decoder.read_directory(IfdPointer(at)) {
                Ok(directory) => directory,
                Err(error) if self.all.is_empty() => return Err(error.into()),
                Err(_) => continue,
            };
            queue.extend(directory.next().map(|next| next.0));
            self.all.push(directory);
            let below = self.numbers(self.all.len() - 1, tag::SUB_IFDS).ok().flatten();
            queue.extend(below.unwrap_or_default().iter().map(|&at| at as u64));
        }
        Ok(())
    }

    /// The Exif directory named by a directory, as a further one of `all`.
    pub(crate) fn exif(&mut self) -> Option<usize> {
        let at = self.numbers(0, tag::EXIF).ok()??.first().copied()?;
        let directory = self.decoder.read_directory(IfdPointer(at as u64)).ok()?;
        self.all.push(directory);
        Some(self.all.len() - 1)
    }

    /// Numbers of a tag; none where the directory has no such tag.
    pub(crate) fn numbers(&mut self, directory: usize, tag: u16) -> Result<Option<Vec<f64>>, RawImageError> {
        let value = self.value(directory, tag)?;
        Ok(value.map(|value| match &value {
            Value::List(list) => list.iter().map(number).collect(),
            single => vec![number(single)],
        }))
    }

    /// The one whole number of a tag, or the number that all its samples share.
    pub(crate) fn count(
        &mut self,
        directory: usize,
        tag: u16,
        field: &'static str,
    ) -> Result<Option<usize>, RawImageError> {
        let Some(numbers) = self.numbers(directory, tag)? else { return Ok(None) };
        match numbers.first() {
            Some(&n) if n >= 0.0 && n.fract() == 0.0 && numbers.iter().all(|&other| other == n) => Ok(Some(n as usize)),
            _ => Err(RawImageError::Value { field, value: format!("{numbers:?}"), expected: "one whole number" }),
        }
    }

    /// Width and height of the image of a directory.
    pub(crate) fn size(&mut self, directory: usize) -> Result<[usize; 2], RawImageError> {
        let mut side = |tag, field| match self.count(directory, tag, field)? {
            Some(side) if side > 0 => Ok(side),
            _ => Err(RawImageError::Missing { field }),
        };
        Ok([side(tag::WIDTH, "ImageWidth")?, side(tag::HEIGHT, "ImageLength")?])
    }

    /// Width and height of the tiles or strips of an image, then offset and length in bytes of each.
    pub(crate) fn chunks(
        &mut self,
        directory: usize,
        [width, height]: [usize; 2],
    ) -> Result<([usize; 2], Vec<[usize; 2]>), RawImageError> {
        let tiled = self.numbers(directory, tag::TILE_OFFSETS)?;
        let (tile, offsets, lengths, field) = if tiled.is_some() {
            let across = self.count(directory, tag::TILE_WIDTH, "TileWidth")?.unwrap_or(width);
            let down = self.count(directory, tag::TILE_HEIGHT, "TileLength")?.unwrap_or(height);
            ([across, down], tiled, self.numbers(directory, tag::TILE_COUNTS)?, "TileOffsets")
        } else {
            let rows = self.count(directory, tag::ROWS_PER_STRIP, "RowsPerStrip")?.unwrap_or(height).min(height);
            let offsets = self.numbers(directory, tag::STRIP_OFFSETS)?;
            ([width, rows], offsets, self.numbers(directory, tag::STRIP_COUNTS)?, "StripOffsets")
        };
        let (Some(offsets), Some(lengths)) = (offsets, lengths) else { return Err(RawImageError::Missing { field }) };
        // Tiles of far more than the image would make memory of nothing.
        let sound =
            [(tile[0], width), (tile[1], height)].iter().all(|&(tile, side)| (1..=2 * side.max(512)).contains(&tile));
        if !sound
            || offsets.len() != lengths.len()
            || offsets.len() != width.div_ceil(tile[0]) * height.div_ceil(tile[1])
        {
            let value = format!("{} of {} × {} pixels", offsets.len(), tile[0], tile[1]);
            return Err(RawImageError::Value { field, value, expected: "the tiles or strips that cover the image" });
        }
        let chunks = offsets.iter().zip(&lengths).map(|(&offset, &length)| [offset as usize, length as usize]);
        Ok((tile, chunks.collect()))
    }

    /// Text of a tag without its padding; none where it is missing or broken.
    pub(crate) fn text(&mut self, directory: usize, tag: u16) -> Option<String> {
        match self.value(directory, tag).ok()?? {
            Value::Ascii(text) => Some(text.trim_matches(|c: char| c == '\0' || c.is_whitespace()).to_owned()),
            _ => None,
        }
        .filter(|text| !text.is_empty())
    }

    fn value(&mut self, directory: usize, tag: u16) -> Result<Option<Value>, RawImageError> {
        let mut tags = self.decoder.read_directory_tags(&self.all[directory]);
        let tag = Tag::from_u16_exhaustive(tag);
        if tags.find_entry(tag).is_some_and(|entry| entry.count() > MAX_VALUES) {
            return Err(tiff::TiffError::LimitsExceeded.into());
        }
        Ok(tags.find_tag(tag)?)
    }
}

/// A number of any type, NaN for text.
fn number(value: &Value) -> f64 {
    match *value {
        Value::Byte(n) => n.into(),
        Value::Short(n) => n.into(),
        Value::SignedByte(n) => n.into(),
        Value::SignedShort(n) => n.into(),
        Value::Signed(n) => n.into(),
        Value::SignedBig(n) => n as f64,
        Value::Unsigned(n) | Value::Ifd(n) => n.into(),
        Value::UnsignedBig(n) | Value::IfdBig(n) => n as f64,
        Value::Float(n) => n.into(),
        Value::Double(n) => n,
        Value::Rational(n, d) => f64::from(n) / f64::from(d),
        Value::SRational(n, d) => f64::from(n) / f64::from(d),
        _ => f64::NAN,
    }
}

/// A TIFF of one gray pixel.
fn one_pixel(big_endian: bool, large: bool) -> Vec<u8> {
    let mut file = if big_endian { b"MM".to_vec() } else { b"II".to_vec() };
    let mut put = |length: usize, n: u64| {
        let digits = n.to_be_bytes().into_iter().skip(8 - length);
        if big_endian { file.extend(digits) } else { file.extend(digits.rev()) }
    };
    // An unsigned number of a word, as TIFF calls its type.
    let (word, kind) = if large { (8, 16) } else { (4, 4) };
    let header: &[_] = if large { &[(2, 43), (2, 8), (2, 0), (8, 16), (8, 5)] } else { &[(2, 42), (4, 8), (2, 5)] };
    let tags = [tag::WIDTH, tag::HEIGHT, tag::PHOTOMETRIC, tag::STRIP_OFFSETS, tag::STRIP_COUNTS];
    let entries = tags.iter().flat_map(|&tag| [(2, tag.into()), (2, kind), (word, 1), (word, 1)]);
    for (length, n) in header.iter().copied().chain(entries) {
        put(length, n);
    }
    put(word, 0);
    file
}

/// Numbers of the tags that are read (TIFF 6.0, Exif 2.32, DNG 1.7.1).
pub(crate) mod tag {
    pub(crate) const NEW_SUBFILE_TYPE: u16 = 254;
    pub(crate) const WIDTH: u16 = 256;
    pub(crate) const HEIGHT: u16 = 257;
    pub(crate) const BITS: u16 = 258;
    pub(crate) const COMPRESSION: u16 = 259;
    pub(crate) const PHOTOMETRIC: u16 = 262;
    pub(crate) const MAKE: u16 = 271;
    pub(crate) const MODEL: u16 = 272;
    pub(crate) const STRIP_OFFSETS: u16 = 273;
    pub(crate) const ORIENTATION: u16 = 274;
    pub(crate) const SAMPLES: u16 = 277;
    pub(crate) const ROWS_PER_STRIP: u16 = 278;
    pub(crate) const STRIP_COUNTS: u16 = 279;
    pub(crate) const PLANAR: u16 = 284;
    pub(crate) const TILE_WIDTH: u16 = 322;
    pub(crate) const TILE_HEIGHT: u16 = 323;
    pub(crate) const TILE_OFFSETS: u16 = 324;
    pub(crate) const TILE_COUNTS: u16 = 325;
    pub(crate) const SUB_IFDS: u16 = 330;
    pub(crate) const SAMPLE_FORMAT: u16 = 339;
    pub(crate) const CFA_REPEAT: u16 = 33421;
    pub(crate) const CFA_PATTERN: u16 = 33422;
    pub(crate) const EXPOSURE_TIME: u16 = 33434;
    pub(crate) const F_NUMBER: u16 = 33437;
    pub(crate) const EXIF: u16 = 34665;
    pub(crate) const ISO: u16 = 34855;
    pub(crate) const ISO_SPEED: u16 = 34867;
    pub(crate) const RECOMMENDED_EXPOSURE_INDEX: u16 = 34866;
    pub(crate) const DNG_VERSION: u16 = 50706;
    pub(crate) const UNIQUE_CAMERA_MODEL: u16 = 50708;
    pub(crate) const CFA_PLANE_COLOR: u16 = 50710;
    pub(crate) const CFA_LAYOUT: u16 = 50711;
    pub(crate) const LINEARIZATION_TABLE: u16 = 50712;
    pub(crate) const BLACK_REPEAT: u16 = 50713;
    pub(crate) const BLACK_LEVEL: u16 = 50714;
    pub(crate) const BLACK_DELTA_H: u16 = 50715;
    pub(crate) const BLACK_DELTA_V: u16 = 50716;
    pub(crate) const WHITE_LEVEL: u16 = 50717;
    pub(crate) const AS_SHOT_NEUTRAL: u16 = 50728;
    pub(crate) const ACTIVE_AREA: u16 = 50829;
    pub(crate) const ROW_INTERLEAVE: u16 = 50975;
    pub(crate) const COLUMN_INTERLEAVE: u16 = 52547;
    /// `CalibrationIlluminant`, `ColorMatrix` and `ForwardMatrix` 1, 2 and 3.
    pub(crate) const CALIBRATIONS: [[u16; 3]; 3] =
        [[50778, 50721, 50964], [50779, 50722, 50965], [52529, 52531, 52532]];
}
