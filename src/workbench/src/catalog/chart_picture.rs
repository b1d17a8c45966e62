//! Linear pictures of charts: 16-bit TIFF and PNG.

use std::io::Cursor;

use chromascope_core::camera::chart_grid::{ChartGrid, ChartGridError};
use chromascope_core::colorimetry::rgb::srgb_transfer;
use chromascope_figure::Image;
use image::codecs::png::PngDecoder;
use image::{DynamicImage, ImageDecoder as _, ImageFormat, ImageReader, Limits};

use super::recorded::{Levels, RawRow};

const MAX_BYTES: u64 = 1 << 30;
/// Maximum number of bytes of what stands beside its pixels, such as a color profile.
const MAX_METADATA: u64 = 64 << 20;
/// Value from which on sixteen bits are clipped.
const CLIP: f64 = 65535.0;

#[derive(Debug, thiserror::Error)]
pub enum ChartPictureError {
    #[error("{0}; expected a 16-bit TIFF or PNG")]
    Format(#[from] image::ImageError),
    #[error("TIFF tag {0} is text where a number is expected; save the picture again")]
    Tag(u16),
    #[error("the picture is {0}; save it as linear 16-bit RGB, without a tone curve")]
    Depth(&'static str),
    #[error(transparent)]
    Grid(#[from] ChartGridError),
}

#[derive(Debug)]
pub struct ChartPicture {
    picture: DynamicImage,
}

impl ChartPicture {
    /// Decodes a TIFF or PNG of 16 bits or 32-bit floats a channel.
    pub fn decode(bytes: &[u8]) -> Result<Self, ChartPictureError> {
        let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(image::ImageError::from)?;
        let limits = |bytes: u64| {
            let mut limits = Limits::default();
            limits.max_alloc = Some(bytes);
            limits
        };
        if let Some(tag) = text_for_number(bytes) {
            return Err(ChartPictureError::Tag(tag));
        }
        let picture = if reader.format() == Some(ImageFormat::Png) {
            // The limits of the first call are those of profiles and texts, the later ones of pixels.
            let mut decoder = PngDecoder::with_limits(Cursor::new(bytes), limits(MAX_METADATA))?;
            decoder.set_limits(limits(MAX_BYTES))?;
            DynamicImage::from_decoder(decoder)?
        } else {
            reader.limits(limits(MAX_BYTES));
            reader.decode()?
        };
        match picture {
            DynamicImage::ImageRgb16(_) | DynamicImage::ImageRgba16(_) | DynamicImage::ImageRgb32F(_) => {
                Ok(Self { picture })
            }
            DynamicImage::ImageRgb8(_) | DynamicImage::ImageRgba8(_) => Err(ChartPictureError::Depth("8-bit")),
            _ => Err(ChartPictureError::Depth("not RGB")),
        }
    }

    pub fn size(&self) -> [usize; 2] {
        [self.picture.width() as usize, self.picture.height() as usize]
    }

    pub fn pixel(&self, x: usize, y: usize) -> [f64; 3] {
        let (x, y) = (x as u32, y as u32);
        match &self.picture {
            DynamicImage::ImageRgb16(picture) => picture.get_pixel(x, y).0.map(f64::from),
            DynamicImage::ImageRgba16(picture) => {
                let [r, g, b, _] = picture.get_pixel(x, y).0;
                [r, g, b].map(f64::from)
            }
            DynamicImage::ImageRgb32F(picture) => picture.get_pixel(x, y).0.map(f64::from),
            _ => [f64::NAN; 3],
        }
    }

    /// The picture as it is shown, at most `longest` pixels along a side, the brightest pixel at white.
    pub fn preview(&self, longest: usize) -> Image {
        let [width, height] = self.size();
        let step = width.max(height).div_ceil(longest).max(1);
        let (across, down) = (width.div_ceil(step), height.div_ceil(step));
        let at = |index: usize| self.pixel(index % across * step, index / across * step);
        let brightest = (0..across * down).flat_map(at).fold(f64::MIN_POSITIVE, f64::max);
        let encode = |value: f64| (255.0 * srgb_transfer((value / brightest).clamp(0.0, 1.0))).round() as u8;
        let pixel = |index: usize| {
            let [r, g, b] = at(index).map(encode);
            [r, g, b, 255]
        };
        let rgba: Vec<u8> = (0..across * down).flat_map(pixel).collect();
        Image { width: across, height: down, rgba: rgba.into() }
    }

    /// Means of the patches; NaN marks a missing patch, infinity a channel with a clipped pixel.
    pub fn rows(&self, grid: &ChartGrid, levels: Levels) -> Result<Vec<RawRow>, ChartPictureError> {
        let clip = levels.clip.min(CLIP);
        let means = grid.means(self.size(), clip, |x, y| self.pixel(x, y))?;
        let row = |(index, patch): (usize, &chromascope_core::camera::chart_grid::PatchMean)| RawRow {
            line: index + 1,
            name: None,
            rgb: [0, 1, 2].map(|c: usize| if patch.clipped[c] { f64::INFINITY } else { patch.mean[c] }),
        };
        Ok(means.iter().enumerate().map(row).collect())
    }
}

/// The first tag of the first picture in a TIFF (of 32 or 64 bits) that is text (type 2) though its number is below those of private tags and of
/// the texts that TIFF 6.0 knows.
fn text_for_number(bytes: &[u8]) -> Option<u16> {
    const TEXTS: [u16; 11] = [269, 270, 271, 272, 285, 305, 306, 315, 316, 333, 337];
    const PRIVATE: u16 = 32768;
    let little = bytes.starts_with(b"II");
    let number = |at: usize, length: usize| -> Option<u64> {
        let field = bytes.get(at..at.checked_add(length)?)?;
        let digit = |number: u64, byte: &u8| number << 8 | u64::from(*byte);
        Some(if little { field.iter().rev().fold(0, digit) } else { field.iter().fold(0, digit) })
    };
    let is_big = number(2, 2)? == 43;
    let known = little || bytes.starts_with(b"MM");
    let (start, count, entry) = if is_big { (number(8, 8)?, 8, 20) } else { (number(4, 4)?, 2, 12) };
    let first = usize::try_from(start).ok()?;
    let entries = usize::try_from(number(first, count)?.min(u64::from(u16::MAX))).ok().filter(|_| known)?;
    (0..entries).find_map(|index| {
        let at = first.checked_add(count + index * entry)?;
        let (tag, kind) = (number(at, 2)? as u16, number(at.checked_add(2)?, 2)?);
        (kind == 2 && tag < PRIVATE && !TEXTS.contains(&tag)).then_some(tag)
    })
}
