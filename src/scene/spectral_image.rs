//! A spectral image through every compared sensor.

use chromascope_core::camera::{Rendering, RenderingError};
use chromascope_core::query::{Ask as _, RenderingQuery};
use chromascope_core::render::develop::{develop_signals, signal_differences};
use chromascope_core::render::{
    BandWeights, ColorimetricScale, Development, ImageSensor, LitSamples, Picture, SampleQuantity, SpectralImageError,
    SpectralImageSignals, Stop,
};
use std::sync::Arc;

use spectral_image::{ImageError, ImageQuantity};

use super::{ComparedSensor, Scene, SceneError};
use crate::catalog::spectral_images::ImageOnDisk;
use crate::document::SetKind;

/// Maximum bytes of samples in memory.
const TILE_BYTES: usize = 16 << 20;
/// Most pixels of an image: the signals of each sensor take 12 bytes a pixel.
const MOST_PIXELS: usize = 40_000_000;
/// Share of the pixels that are darker than the white of radiances.
const WHITE_QUANTILE: f64 = 0.995;

/// Reason that a spectral image has no pictures.
#[derive(Debug, thiserror::Error)]
pub enum ImagePicturesError {
    /// The scene cannot be computed.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The image cannot be read.
    #[error(transparent)]
    Read(#[from] ImageError),
    /// The image cannot be put through cameras.
    #[error(transparent)]
    Image(#[from] SpectralImageError),
    /// The file does not state what its samples are.
    #[error("the file does not state whether its samples are reflectances or radiances")]
    Quantity,
    /// Too many pixels.
    #[error("{0} million pixels; the limit is {limit} million, so cut or bin the image", limit = MOST_PIXELS / 1_000_000)]
    Pixels(usize),
    /// No pixel has a value.
    #[error("no pixel has a value in every band")]
    Empty,
    /// Interrupted.
    #[error("stopped")]
    Stopped,
}

/// Use of a spectral image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageUse {
    /// Quantity of the samples, overriding the file's.
    pub quantity: Option<ImageQuantity>,
    /// Value that represents 1.
    pub scale: f64,
    /// Exposure in EV.
    pub exposure_ev: f64,
}

/// Differences of an image from the reference's, over all pixels with values.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageDifference {
    /// Difference of each pixel.
    pub map: Vec<f32>,
    /// Mean.
    pub mean: f64,
    /// Median (nearest rank).
    pub median: f64,
    /// 95th percentile (nearest rank).
    pub p95: f64,
    /// Largest.
    pub max: f64,
}

/// A spectral image through several sensors.
#[derive(Clone, Debug)]
pub struct ImagePictures {
    /// Pictures, or the reasons that there are none.
    pub pictures: Vec<Result<Arc<Picture>, RenderingError>>,
    /// Color transforms.
    pub renderings: Vec<Result<Rendering, RenderingError>>,
    /// Signals of each sensor at the pixels with values; empty for a sensor without a picture.
    pub signals: Vec<Vec<[f32; 3]>>,
    /// Differences from the reference; none for the reference, and where colors cannot be compared.
    pub differences: Vec<Option<ImageDifference>>,
    /// Pixels with values.
    pub placed: Arc<LitSamples>,
    /// Y of the white: 1 for reflectances, the 99.5 % quantile of the reference's Y for radiances.
    pub white: f64,
    /// Maximum bytes of samples in memory.
    pub tile_bytes: usize,
}

impl Scene<'_> {
    /// Takes an image through the sensors, a few rows at a time, and compares each with the reference.
    ///
    /// # Errors
    ///
    /// [`ImagePicturesError`] where the reference cannot be computed or the image cannot be read.
    pub fn image_pictures(
        &self,
        image: &mut ImageOnDisk,
        sources: &[ComparedSensor],
        wanted: ImageUse,
        stop: &Stop,
    ) -> Result<ImagePictures, ImagePicturesError> {
        let quantity = wanted.quantity.or(image.info().quantity).ok_or(ImagePicturesError::Quantity)?;
        let reference = self.rendering_of(SetKind::Observer, &self.document.reference)?;
        let rendering = |query: &RenderingQuery| (*self.results.ask(query)).clone();
        let of_reference = rendering(&reference)
            .map_err(|error| SceneError::Rendering { name: self.document.reference.clone(), error })?;
        let queries = sources.iter().map(|source| self.rendering_of(source.kind, &source.name));
        let queries: Vec<RenderingQuery> = queries.collect::<Result<_, _>>()?;
        let renderings: Vec<_> = queries.iter().map(rendering).collect();
        // The reference first, then those that have a rendering.
        let mut sensors = vec![ImageSensor { sensor: &reference.sensor, divisors: of_reference.white_integrals }];
        for (query, rendering) in queries.iter().zip(&renderings) {
            let divisors = rendering.as_ref().map(|rendering| rendering.white_integrals);
            sensors.extend(divisors.map(|divisors| ImageSensor { sensor: &query.sensor, divisors }));
        }
        let quantity = match quantity {
            ImageQuantity::Reflectance => SampleQuantity::Reflectance,
            ImageQuantity::Radiance => SampleQuantity::Radiance,
        };
        let light = self.light()?;
        let weights = BandWeights::new(&image.info().wavelengths_nm, quantity, &light.grid, &sensors)?;
        let (placed, all, tile_bytes) = gone_through(image, weights, wanted.scale, stop)?;
        let mut all = all.into_iter();
        let reference_signals = all.next().unwrap_or_default();
        let white = match quantity {
            SampleQuantity::Reflectance => 1.0,
            SampleQuantity::Radiance => bright(&of_reference, &reference_signals).ok_or(ImagePicturesError::Empty)?,
        };
        let signals: Vec<Vec<[f32; 3]>> = renderings
            .iter()
            .map(|rendering| if rendering.is_ok() { all.next().unwrap_or_default() } else { Vec::new() })
            .collect();
        let exposure = wanted.exposure_ev.exp2() / white;
        let scale = ColorimetricScale::new(&of_reference, white);
        let (mut pictures, mut differences) = (Vec::new(), Vec::new());
        for ((source, rendering), signals) in sources.iter().zip(&renderings).zip(&signals) {
            let rendering = match rendering {
                Ok(rendering) => rendering,
                Err(error) => {
                    pictures.push(Err(*error));
                    differences.push(None);
                    continue;
                }
            };
            let development = Development::new(rendering, exposure, None);
            let picture = develop_signals(&placed, signals, &development, stop).ok_or(ImagePicturesError::Stopped)?;
            pictures.push(Ok(Arc::new(picture)));
            let comparable = !source.is_reference && self.comparable(source.kind, &source.name)?.is_ok();
            let own = ColorimetricScale::new(rendering, white);
            let metric = self.document.difference;
            let map = comparable
                .then(|| signal_differences(metric, [signals, &reference_signals], [&own, &scale], 1, stop))
                .flatten();
            differences.push(map.and_then(|(map, _)| ImageDifference::new(map)));
        }
        Ok(ImagePictures { pictures, renderings, signals, differences, placed, white, tile_bytes })
    }
}

/// Signals of all sensors, with the pixels that have values and the bytes of samples that were held.
type Signals = (Arc<LitSamples>, Vec<Vec<[f32; 3]>>, usize);

/// Reads the image a few rows at a time.
fn gone_through(
    image: &mut ImageOnDisk,
    weights: BandWeights,
    scale: f64,
    stop: &Stop,
) -> Result<Signals, ImagePicturesError> {
    let info = image.info().clone();
    let pixels = info.width * info.height;
    if pixels > MOST_PIXELS {
        return Err(ImagePicturesError::Pixels(pixels.div_ceil(1_000_000)));
    }
    let mut signals = SpectralImageSignals::new(weights, info.width, info.height)?;
    let rows = info.rows_within(TILE_BYTES);
    let factor = scale.recip() as f32;
    let mut tile = Vec::new();
    for first in (0..info.height).step_by(rows) {
        if stop.is_set() {
            return Err(ImagePicturesError::Stopped);
        }
        image.read_rows(first..(first + rows).min(info.height), &mut tile)?;
        if scale != 1.0 {
            for sample in &mut tile {
                *sample *= factor;
            }
        }
        signals.push(&tile);
    }
    let (placed, signals) = signals.finish();
    if placed.samples().is_empty() {
        return Err(ImagePicturesError::Empty);
    }
    Ok((placed, signals, tile.capacity() * size_of::<f32>()))
}

/// Luminance below which most pixels are; none unless it is positive.
fn bright(rendering: &Rendering, signals: &[[f32; 3]]) -> Option<f64> {
    let scale = ColorimetricScale::new(rendering, 1.0);
    let mut luminances: Vec<f32> = signals.iter().map(|signal| scale.color(*signal).xyz.y as f32).collect();
    let y = f64::from(quantile(&mut luminances, WHITE_QUANTILE)?);
    (y > 0.0 && y.recip().is_finite()).then_some(y)
}

/// Quantile by nearest rank.
fn quantile(values: &mut [f32], share: f64) -> Option<f32> {
    let rank = ((values.len() as f64 * share).ceil() as usize).checked_sub(1)?;
    Some(*values.select_nth_unstable_by(rank, f32::total_cmp).1)
}

impl ImageDifference {
    fn new(map: Vec<f32>) -> Option<Self> {
        let mut values = map.clone();
        let [median, p95] = [0.5, 0.95].map(|share| quantile(&mut values, share).map(f64::from));
        let mean = map.iter().map(|&d| f64::from(d)).sum::<f64>() / map.len().max(1) as f64;
        let max = f64::from(map.iter().copied().fold(0.0, f32::max));
        Some(Self { mean, median: median?, p95: p95?, max, map })
    }
}
