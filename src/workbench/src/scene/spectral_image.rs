//! A spectral image through every compared sensor.

use std::sync::Arc;

use chromascope_core::camera::{Rendering, RenderingError};
use chromascope_core::colorimetry::Metric;
use chromascope_core::math::quantile::quantile;
use chromascope_core::query::render::difference::{BrightSamples, Difference};
use chromascope_core::query::{Ask, Query, RenderingQuery, Shared};
use chromascope_core::render::develop::{develop_signals, signal_differences};
use chromascope_core::render::exaggerate::{Exaggeration, develop_exaggerated};
use chromascope_core::render::{
    BandWeights, ColorimetricScale, Development, ImageSensor, LitSamples, Picture, SampleQuantity,
};
use chromascope_core::spectral::{GridSpectrum, Sensor};
use glam::DVec3;
use spectral_image::{ImageInfo, ImageQuantity};

use super::{ComparedSensor, Result, Scene, SceneError};
use crate::catalog::spectral_images::{ImageSource, ReadSignals, ReadSignalsError, read_signals};
use crate::document::SetKind;

/// Share of the pixels that are darker than the white of radiances.
const WHITE_QUANTILE: f64 = 0.995;
/// Most pixels of a picture on screen, and its longest side.
const SCREEN_PIXELS: usize = 2_000_000;
const SCREEN_SIDE: usize = 4096;
/// Pixels of the picture that comes first.
const FIRST_PIXELS: usize = 60_000;

#[derive(Debug, thiserror::Error)]
pub enum ImagePicturesError {
    #[error(transparent)]
    Reference(RenderingError),
    #[error(transparent)]
    Read(#[from] ReadSignalsError),
    #[error("the file does not state whether its samples are reflectances or radiances")]
    Quantity,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageUse {
    /// Quantity of the samples, overriding the file's.
    pub quantity: Option<ImageQuantity>,
    /// Value that represents 1.
    pub scale: f64,
    pub exposure_ev: f64,
    /// Every how many rows and pixels are taken.
    pub step: usize,
}

/// Query for the signals of sensors at the pixels of an image.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ImageSignalsQuery {
    pub source: ImageSource,
    pub wanted: Option<ImageQuantity>,
    /// Value that represents 1, as bits.
    pub scale: u64,
    pub step: usize,
    light: Shared<GridSpectrum>,
    /// Sensors with the divisors of their integrals, as bits.
    sensors: Vec<(Shared<Sensor>, [u64; 3])>,
}

#[derive(Clone, Debug)]
pub struct ImageSignals {
    /// Signals of each sensor at the pixels with values.
    pub read: ReadSignals,
    pub quantity: ImageQuantity,
    pub info: ImageInfo,
}

impl Query for ImageSignalsQuery {
    type Answer = Result<Arc<ImageSignals>, Arc<ImagePicturesError>>;
    const NAME: &'static str = "image signals";
    // The coarse and the fine picture's.
    const CAPACITY: usize = 2;

    fn bytes(answer: &Self::Answer) -> usize {
        answer.as_ref().map_or(0, |signals| signals.read.signals.iter().map(|signals| size_of_val(&**signals)).sum())
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        self.signals(ask).map(Arc::new).map_err(Arc::new)
    }
}

impl ImageSignalsQuery {
    fn signals(&self, ask: &impl Ask) -> Result<ImageSignals, ImagePicturesError> {
        let mut image = self.source.open(self.wanted)?;
        let info = image.info().clone();
        let quantity = self.wanted.or(info.quantity).ok_or(ImagePicturesError::Quantity)?;
        let samples = match quantity {
            ImageQuantity::Reflectance => SampleQuantity::Reflectance,
            ImageQuantity::Radiance => SampleQuantity::Radiance,
        };
        let sensors: Vec<ImageSensor<'_>> = self
            .sensors
            .iter()
            .map(|(sensor, divisors)| ImageSensor { sensor, divisors: DVec3::from(divisors.map(f64::from_bits)) })
            .collect();
        let weights = BandWeights::new(&info.wavelengths_nm, samples, &self.light, &sensors);
        let weights = weights.map_err(ReadSignalsError::from)?;
        let how = (self.step, f64::from_bits(self.scale));
        let read = read_signals(&mut image, weights, how, &self.source.rows, &ask.stop())?;
        Ok(ImageSignals { read, quantity, info })
    }
}

/// Query for a spectral image through several sensors.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ImagePicturesQuery {
    /// Signals of the reference, then of each sensor that has colors.
    pub signals: ImageSignalsQuery,
    pub reference: RenderingQuery,
    /// The sensors, and whether each is compared with the reference.
    pub sources: Vec<(RenderingQuery, bool)>,
    pub metric: Metric,
    pub ev: u64,
    /// Factor on the pictures' differences from the reference, as bits.
    pub exaggeration: u64,
}

#[derive(Clone, Debug)]
pub struct ImagePictures {
    pub pictures: Vec<Result<Arc<Picture>, RenderingError>>,
    /// Differences from the reference over all pixels with values; none for the reference, and where colors cannot be compared.
    pub differences: Vec<Option<Arc<Difference>>>,
    pub image: Arc<ImageSignals>,
    /// Y of the white: 1 for reflectances, the 99.5 % quantile of the reference's Y for radiances.
    pub white: f64,
    /// Place of each sensor's signals among those read.
    places: Vec<Option<usize>>,
}

impl ImagePictures {
    pub fn placed(&self) -> &LitSamples {
        &self.image.read.placed
    }

    /// Signals of a sensor at the pixels with values; none for a sensor without a picture.
    pub fn signals(&self, index: usize) -> Option<&[[f32; 3]]> {
        self.image.read.signals.get((*self.places.get(index)?)?).map(Vec::as_slice)
    }

    /// Factor on all signals at an exposure in EV.
    pub fn factor(&self, ev: f64) -> f64 {
        ev.exp2() / self.white
    }
}

impl Query for ImagePicturesQuery {
    type Answer = Result<ImagePictures, Arc<ImagePicturesError>>;
    const NAME: &'static str = "image pictures";
    // Each holds on to all of its parts.
    const CAPACITY: usize = 2;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let stopped = || Arc::new(ImagePicturesError::Read(ReadSignalsError::Stopped));
        let image = (*ask.ask(&self.signals)).clone()?;
        let reference = ask.ask(&self.reference);
        let of_reference = (*reference).as_ref().map_err(|&error| Arc::new(ImagePicturesError::Reference(error)))?;
        let reference_signals = image.read.signals.first().map_or(&[][..], Vec::as_slice);
        let white = match image.quantity {
            ImageQuantity::Reflectance => 1.0,
            ImageQuantity::Radiance => bright(of_reference, reference_signals)
                .ok_or_else(|| Arc::new(ImagePicturesError::Read(ReadSignalsError::Empty)))?,
        };
        let scale = ColorimetricScale::new(of_reference, white);
        let (mut pictures, mut differences, mut places) = (Vec::new(), Vec::new(), Vec::new());
        let mut next = 1;
        for (rendering, is_compared) in &self.sources {
            let rendering = ask.ask(rendering);
            let rendering = match &*rendering {
                Ok(rendering) => rendering,
                Err(error) => {
                    pictures.push(Err(*error));
                    differences.push(None);
                    places.push(None);
                    continue;
                }
            };
            let signals = image.read.signals.get(next).map_or(&[][..], Vec::as_slice);
            places.push(Some(next));
            next += 1;
            let development = Development::new(rendering, f64::from_bits(self.ev).exp2() / white, None);
            let picture = develop_signals(&image.read.placed, signals, &development, &ask.stop());
            let mut picture = picture.ok_or_else(stopped)?;
            let own = ColorimetricScale::new(rendering, white);
            let factor = f64::from_bits(self.exaggeration);
            if *is_compared && factor != 1.0 {
                let how = Exaggeration {
                    scales: [&own, &scale],
                    srgb_from_xyz: rendering.srgb_from_xyz,
                    brightness: f64::from_bits(self.ev).exp2(),
                    factor,
                    background: None,
                };
                let shown = develop_exaggerated(&image.read.placed, [signals, reference_signals], &how, &ask.stop());
                picture.rgba = shown.ok_or_else(stopped)?.rgba;
            }
            pictures.push(Ok(Arc::new(picture)));
            let compare =
                || signal_differences(self.metric, [signals, reference_signals], [&own, &scale], 1, &ask.stop());
            let map = if *is_compared { Some(compare().ok_or_else(stopped)?.0) } else { None };
            differences.push(map.map(|map| Arc::new(difference(map))));
        }
        Ok(ImagePictures { pictures, differences, image, white, places })
    }
}

/// Differences of all pixels with values.
fn difference(map: Vec<f32>) -> Difference {
    let mean = map.iter().map(|&d| f64::from(d)).sum::<f64>() / map.len().max(1) as f64;
    let max = f64::from(map.iter().copied().fold(0.0, f32::max));
    // Every pixel counts: an image has no samples that are dark because they face away from a light.
    let bright = BrightSamples::new(&map, &vec![f32::INFINITY; map.len()]);
    Difference { stride: 1, map, mean, max, facing: None, garment: None, bright }
}

impl Scene<'_> {
    pub fn image_pictures(
        &self,
        source: &ImageSource,
        sources: &[ComparedSensor],
        wanted: ImageUse,
    ) -> Result<ImagePicturesQuery> {
        let reference = self.rendering_of(SetKind::Observer, &self.document.reference)?;
        let is_compared = |source: &ComparedSensor| {
            Ok::<_, SceneError>(!source.is_reference && self.comparable(source.kind, &source.name)?.is_ok())
        };
        let queries = sources
            .iter()
            .map(|source| Ok((self.rendering_of(source.kind, &source.name)?, is_compared(source)?)))
            .collect::<Result<Vec<_>>>()?;
        let divisors = |query: &RenderingQuery| {
            let rendering = self.results.ask(query);
            let integrals = (*rendering).as_ref().map(|rendering| rendering.white_integrals);
            integrals.map(|integrals| (query.sensor.clone(), integrals.to_array().map(f64::to_bits))).map_err(|&e| e)
        };
        let of_reference = divisors(&reference)
            .map_err(|error| SceneError::Rendering { name: self.document.reference.clone(), error })?;
        let sensors = std::iter::once(of_reference).chain(queries.iter().filter_map(|(query, _)| divisors(query).ok()));
        let signals = ImageSignalsQuery {
            source: source.clone(),
            wanted: wanted.quantity,
            scale: wanted.scale.to_bits(),
            step: wanted.step,
            light: self.light()?.grid,
            sensors: sensors.collect(),
        };
        let (metric, ev) = (self.document.difference, wanted.exposure_ev.to_bits());
        let exaggeration = self.document.exaggeration.factor().to_bits();
        Ok(ImagePicturesQuery { signals, reference, sources: queries, metric, ev, exaggeration })
    }

    /// Use of an image as the document has it.
    pub fn image_use(&self, step: usize) -> ImageUse {
        let settings = &self.document.render;
        let quantity = settings.image_quantity;
        ImageUse { quantity, scale: settings.image_scale, exposure_ev: settings.exposure_ev, step }
    }
}

/// Steps of the pictures of an image on screen, from coarse to fine: every how many rows and pixels are taken.
pub fn screen_steps(info: &ImageInfo) -> Vec<usize> {
    let within = |pixels: usize| {
        let area = ((info.width * info.height) as f64 / pixels as f64).sqrt().ceil() as usize;
        area.max(info.width.max(info.height).div_ceil(SCREEN_SIDE)).max(1)
    };
    let mut steps = vec![within(FIRST_PIXELS), within(SCREEN_PIXELS)];
    steps.dedup();
    steps
}

/// Luminance below which most pixels are; none unless it is positive.
fn bright(rendering: &Rendering, signals: &[[f32; 3]]) -> Option<f64> {
    let scale = ColorimetricScale::new(rendering, 1.0);
    let mut luminances: Vec<f64> = signals.iter().map(|signal| scale.color(*signal).xyz.y).collect();
    let y = quantile(&mut luminances, WHITE_QUANTILE)?;
    (y > 0.0 && y.recip().is_finite()).then_some(y)
}

/// Query for the spectrum of one pixel of an image.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PixelSpectrumQuery {
    pub source: ImageSource,
    pub wanted: Option<ImageQuantity>,
    /// Value that represents 1, as bits.
    pub scale: u64,
    /// Right and down, in pixels of the file.
    pub at: [usize; 2],
}

impl Query for PixelSpectrumQuery {
    type Answer = Result<Vec<[f64; 2]>, ReadSignalsError>;
    const NAME: &'static str = "spectrum of a pixel";
    const CAPACITY: usize = 16;

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        let mut spectrum = self.source.spectrum(self.wanted, self.at)?;
        for point in &mut spectrum {
            point[1] /= f64::from_bits(self.scale);
        }
        Ok(spectrum)
    }
}
