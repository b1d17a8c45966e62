//! Linear pictures of charts: DNG, 16-bit TIFF and PNG, and OpenEXR.

use std::io::Cursor;
use std::path::Path;

use chromascope_core::camera::chart_grid::{ChartGrid, ChartGridError, PatchMean, region_mean};
use chromascope_core::camera::chart_search::{FoundChart, find_chart, refine_chart};
use chromascope_core::colorimetry::rgb::srgb_transfer;
use chromascope_core::patch_set::Patch;
use chromascope_core::query::Ask as _;
use chromascope_figure::Image;
use image::codecs::png::PngDecoder;
use image::{DynamicImage, ImageDecoder as _, ImageFormat, ImageReader, Limits};
pub use raw_image::CONVERTERS;
use raw_image::{RawImage, RawImageError};

use super::Catalog;
use super::load::{LightQuery, PatchesQuery, SensorQuery};
use super::recorded::{Levels, RawRow, lit};
use crate::document::measurement::MeasuredPatch;
use crate::document::{CHART, SetKind};
use crate::results::Results;

/// Endings of pictures that are read.
const READ: [&str; 5] = ["dng", "tif", "tiff", "png", "exr"];
/// Endings of developed pictures, and of raw files of makers: of these reason and remedy are told.
const DEVELOPED: [&str; 6] = ["jpg", "jpeg", "heic", "heif", "avif", "webp"];
const RAW: [&str; 18] = [
    "nef", "nrw", "cr2", "cr3", "crw", "arw", "sr2", "raf", "orf", "rw2", "rwl", "pef", "srw", "3fr", "fff", "iiq",
    "x3f", "kdc",
];

/// Endings of all pictures.
pub fn pictures() -> impl Iterator<Item = &'static str> {
    READ.into_iter().chain(DEVELOPED).chain(RAW)
}

/// True for the ending of a picture.
pub fn is_picture(path: &Path) -> bool {
    ends_in(path, pictures())
}

fn ends_in(path: &Path, mut endings: impl Iterator<Item = &'static str>) -> bool {
    path.extension().is_some_and(|own| endings.any(|ending| own.eq_ignore_ascii_case(ending)))
}

const MAX_BYTES: u64 = 1 << 30;
/// Maximum number of bytes of what stands beside its pixels, such as a color profile.
const MAX_METADATA: u64 = 64 << 20;
/// Longest side of the copy in which the chart is searched.
const SEARCHED: usize = 1000;
/// Camera and light by which patches are told from each other: any will do.
const CAMERA: &str = "Nikon D700";
const LIGHT: &str = "D65";
/// Value from which on sixteen bits are clipped.
const CLIP: f64 = 65535.0;

#[derive(Debug, thiserror::Error)]
pub enum ChartPictureError {
    #[error("{0}; expected a DNG, a 16-bit TIFF or PNG, or an OpenEXR with channels R, G and B")]
    Format(#[from] image::ImageError),
    #[error(transparent)]
    Raw(#[from] RawImageError),
    #[error("TIFF tag {0} is text where a number is expected; save the picture again")]
    Tag(u16),
    #[error("the picture is {0}; save it as linear 16-bit RGB, without a tone curve")]
    Depth(&'static str),
    #[error(
        "a developed picture such as a JPEG: its tone curve hides the raw values. Photograph raw and convert to DNG with {CONVERTERS}, both free of charge"
    )]
    Developed,
    #[error(transparent)]
    Grid(#[from] ChartGridError),
}

#[derive(Debug)]
pub struct ChartPicture(Pixels);

#[derive(Debug)]
enum Pixels {
    Picture(DynamicImage),
    /// Scaled so that white is at 1.
    Raw(Box<RawImage>),
}

impl ChartPicture {
    /// [`Self::decode`], with the remedy where the ending is that of a picture of another kind.
    pub fn read(path: &Path, bytes: &[u8]) -> Result<Self, ChartPictureError> {
        Self::decode(bytes).map_err(|error| match error {
            ChartPictureError::Raw(RawImageError::OtherRaw { .. }) => error,
            _ if ends_in(path, RAW.into_iter()) => {
                RawImageError::OtherRaw { format: "the raw format of this maker" }.into()
            }
            _ if ends_in(path, DEVELOPED.into_iter()) => ChartPictureError::Developed,
            _ => error,
        })
    }

    /// Decodes a DNG, a TIFF or PNG of 16 bits or 32-bit floats a channel, or an OpenEXR.
    pub fn decode(bytes: &[u8]) -> Result<Self, ChartPictureError> {
        match RawImage::read(bytes) {
            Ok(raw) => return Ok(Self(Pixels::Raw(Box::new(raw)))),
            Err(RawImageError::NotDng) => {}
            Err(error) => return Err(error.into()),
        }
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
            DynamicImage::ImageRgb16(_)
            | DynamicImage::ImageRgba16(_)
            | DynamicImage::ImageRgb32F(_)
            | DynamicImage::ImageRgba32F(_) => Ok(Self(Pixels::Picture(picture))),
            DynamicImage::ImageRgb8(_) | DynamicImage::ImageRgba8(_) => Err(ChartPictureError::Depth("8-bit")),
            _ => Err(ChartPictureError::Depth("not RGB")),
        }
    }

    pub fn size(&self) -> [usize; 2] {
        match &self.0 {
            Pixels::Picture(picture) => [picture.width() as usize, picture.height() as usize],
            Pixels::Raw(raw) => raw.size(),
        }
    }

    /// Camera model by which raw converters offer a profile (DNG's `UniqueCameraModel`), where the file states one.
    pub fn model(&self) -> Option<String> {
        let Pixels::Raw(raw) = &self.0 else { return None };
        raw.metadata().unique_camera_model.clone().or_else(|| self.camera())
    }

    /// Maker and model of the camera, where the file states them.
    pub fn camera(&self) -> Option<String> {
        let Pixels::Raw(raw) = &self.0 else { return None };
        let about = raw.metadata();
        let (make, model) = (about.make.clone().unwrap_or_default(), about.model.clone()?);
        // Many a model begins with the maker's name, in its own case.
        let maker = make.split(' ').next().unwrap_or_default();
        let has_maker = model.to_lowercase().starts_with(&maker.to_lowercase());
        Some(if has_maker { model } else { format!("{maker} {model}") })
    }

    /// Linear RGB of a pixel; NaN in the channels that a mosaic does not have there.
    pub fn pixel(&self, x: usize, y: usize) -> [f64; 3] {
        let picture = match &self.0 {
            Pixels::Picture(picture) => picture,
            Pixels::Raw(raw) => return raw.pixel(x, y),
        };
        let (x, y) = (x as u32, y as u32);
        match picture {
            DynamicImage::ImageRgb16(picture) => picture.get_pixel(x, y).0.map(f64::from),
            DynamicImage::ImageRgba16(picture) => {
                let [r, g, b, _] = picture.get_pixel(x, y).0;
                [r, g, b].map(f64::from)
            }
            DynamicImage::ImageRgb32F(picture) => picture.get_pixel(x, y).0.map(f64::from),
            DynamicImage::ImageRgba32F(picture) => {
                let [r, g, b, _] = picture.get_pixel(x, y).0;
                [r, g, b].map(f64::from)
            }
            _ => [f64::NAN; 3],
        }
    }

    /// Linear RGB of a small copy, at most `longest` pixels along a side, with the number of pixels that one of its stands for.
    fn small(&self, longest: usize) -> ([usize; 2], usize, Vec<[f32; 3]>) {
        if let Pixels::Raw(raw) = &self.0 {
            let preview = raw.preview(longest);
            return (preview.size, preview.step, preview.rgb);
        }
        let [width, height] = self.size();
        let step = width.max(height).div_ceil(longest).max(1);
        let (across, down) = (width.div_ceil(step), height.div_ceil(step));
        let at = |index: usize| self.pixel(index % across * step, index / across * step).map(|value| value as f32);
        ([across, down], step, (0..across * down).map(at).collect())
    }

    /// The picture as it is shown, at most `longest` pixels along a side, the brightest pixel at white.
    pub fn preview(&self, longest: usize) -> Image {
        let ([width, height], _, rgb) = self.small(longest);
        // Without balance a raw picture is green.
        let brightest = [0, 1, 2].map(|c: usize| rgb.iter().fold(f32::MIN_POSITIVE, |most, rgb| most.max(rgb[c])));
        let encode = |value: f32, most: f32| {
            (255.0 * srgb_transfer((f64::from(value) / f64::from(most)).clamp(0.0, 1.0))).round() as u8
        };
        let pixel = |rgb: &[f32; 3]| {
            let [r, g, b] = [0, 1, 2].map(|c: usize| encode(rgb[c], brightest[c]));
            [r, g, b, 255]
        };
        let rgba: Vec<u8> = rgb.iter().flat_map(pixel).collect();
        Image { width, height, rgba: rgba.into() }
    }

    /// Corners of the grid of 6 × 4 patches in pixels, if a chart is found for certain.
    pub fn find_chart(&self) -> Option<[[f64; 2]; 4]> {
        let (size, step, rgb) = self.small(SEARCHED);
        let found = find_chart(size, &rgb, &expected()?)?;
        let corners = found.corners.map(|corner| corner.map(|side| side * step as f64));
        let rough = FoundChart { corners, ..found };
        Some(refine_chart(&rough, self.size(), |x, y| self.pixel(x, y)).map_or(corners, |fine| fine.corners))
    }

    /// Value from which on pixels are clipped, at most the given one.
    pub(super) fn clip(&self, clip: f64) -> f64 {
        match &self.0 {
            Pixels::Picture(_) => clip.min(CLIP),
            Pixels::Raw(raw) => clip.min(raw.clip()),
        }
    }

    /// Patches within the corners of a grid of so many columns and rows.
    pub fn patches(&self, corners: [[f64; 2]; 4], grid: [usize; 2]) -> Result<Vec<MeasuredPatch>, ChartPictureError> {
        let means = self.means(&ChartGrid::new(corners, grid[0], grid[1])?, f64::INFINITY)?;
        let patch = |patch: &PatchMean| MeasuredPatch {
            rgb: [0, 1, 2].map(|c: usize| Some(patch.mean[c]).filter(|mean| !patch.clipped[c] && mean.is_finite())),
            deviation: patch.noise.map(|noise| if noise.is_finite() { noise } else { 0.0 }),
            clipped: patch.clipped_share.into_iter().fold(0.0, f64::max),
        };
        Ok(means.iter().map(patch).collect())
    }

    /// Means of left, top, width and height in pixels.
    pub(super) fn region(&self, region: [usize; 4]) -> Result<PatchMean, ChartPictureError> {
        Ok(region_mean(region, self.size(), self.clip(f64::INFINITY), |x, y| self.pixel(x, y))?)
    }

    fn means(&self, grid: &ChartGrid, clip: f64) -> Result<Vec<PatchMean>, ChartPictureError> {
        Ok(grid.means(self.size(), self.clip(clip), |x, y| self.pixel(x, y))?)
    }

    /// Means of the patches; NaN marks a missing patch, infinity a channel with too many clipped pixels.
    pub fn rows(&self, grid: &ChartGrid, levels: Levels) -> Result<Vec<RawRow>, ChartPictureError> {
        let means = self.means(grid, levels.clip)?;
        let row = |(index, patch): (usize, &PatchMean)| RawRow {
            line: index + 1,
            name: None,
            rgb: [0, 1, 2].map(|c: usize| if patch.clipped[c] { f64::INFINITY } else { patch.mean[c] }),
        };
        Ok(means.iter().enumerate().map(row).collect())
    }
}

/// RGB of the chart's patches by a camera of the library under daylight.
fn expected() -> Option<Vec<[f64; 3]>> {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let place = |kind, name| catalog.get(kind, name).map(|entry| entry.place.clone());
    let sensor = (*results.ask(&SensorQuery(place(SetKind::Camera, CAMERA)?))).clone().ok()?;
    let light = (*results.ask(&LightQuery::Set(place(SetKind::Illuminant, LIGHT)?))).clone().ok()?;
    let patches = PatchesQuery { place: place(SetKind::Chart, CHART)?, names: None };
    let patches = (*results.ask(&patches)).clone().ok()?;
    let rgb = |patch: &Patch| sensor.integrate(lit(&patch.grid, &light.grid).values());
    Some(patches.patches().iter().map(rgb).collect())
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
