//! Differences of a camera's picture from the reference's.

use super::CameraImageQuery;
use super::picture::ExposureQuery;
use crate::ask::{Ask, Query};
use crate::compare;
use crate::patches::{RenderingQuery, patch_colors};
use chromascope_color::camera::RenderingError;
use chromascope_color::colorimetry::Metric;
use chromascope_color::spectral::GridSpectrum;
use chromascope_math::quantile::quantile;
use chromascope_mesh::Part;
use chromascope_render::render::ColorimetricScale;
use chromascope_render::render::develop::signal_differences;
use std::borrow::Cow;
use std::sync::Arc;

/// L* of the reference above which samples count in [`BrightSamples`].
pub const BRIGHT_L: f64 = 20.0;

/// Differences of a camera's picture from the reference's, sample by sample.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct DifferenceQuery {
    /// Metric of the differences.
    pub metric: Metric,
    /// The camera's signals.
    pub image: CameraImageQuery,
    /// Their balance and color transform.
    pub rendering: RenderingQuery,
    /// The reference's signals.
    pub reference: CameraImageQuery,
    /// The material, and the scale of colors, with the reference's balance.
    pub exposure: ExposureQuery,
    /// Every how many of the lit samples are compared.
    pub stride: usize,
}

/// Differences from the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Every how many of the lit samples were compared.
    pub stride: usize,
    /// Differences at those.
    pub map: Vec<f32>,
    /// Mean over all lit samples of the mesh: as dark samples differ little, it falls with the share of them.
    pub mean: f64,
    /// Largest.
    pub max: f64,
    /// Difference of the material as a flat patch that faces the light: [`compare::difference`] of the same reflectance.
    pub facing: Option<f64>,
    /// [`Self::facing`] of the garment; none without one.
    pub garment: Option<f64>,
    /// Quantiles over the samples that are bright in the reference; none where there is no such sample.
    pub bright: Option<BrightSamples>,
}

/// Quantiles of the differences over the lit samples whose L* in the reference is above [`BRIGHT_L`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrightSamples {
    /// Number of samples compared.
    pub count: usize,
    /// Median.
    pub median: f64,
    /// 95th percentile.
    pub p95: f64,
}

impl BrightSamples {
    /// Quantiles as [`quantile`] defines them; none of nothing.
    pub fn new(map: &[f32], lightness: &[f32]) -> Option<Self> {
        let bright = map.iter().zip(lightness).filter(|(_, l)| f64::from(**l) > BRIGHT_L);
        let mut values: Vec<f64> = bright.map(|(difference, _)| f64::from(*difference)).collect();
        let [median, p95] = [0.5, 0.95].map(|share| quantile(&mut values, share));
        Some(Self { count: values.len(), median: median?, p95: p95? })
    }
}

impl Query for DifferenceQuery {
    type Answer = Result<Option<Arc<Difference>>, RenderingError>;
    const NAME: &'static str = "difference";
    const CAPACITY: usize = 64;

    fn bytes(difference: &Self::Answer) -> usize {
        difference.as_ref().ok().and_then(Option::as_ref).map_or(0, |difference| size_of_val(&*difference.map))
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let facing = ask.ask(&self.exposure);
        let facing = (*facing).as_ref().map_err(|&e| e)?;
        let [rendering, reference] = [&self.rendering, &self.exposure.reference].map(|of| ask.ask(of));
        let (rendering, reference) = ((*rendering).as_ref().map_err(|&e| e)?, (*reference).as_ref().map_err(|&e| e)?);
        let scales = [rendering, reference].map(|rendering| ColorimetricScale::new(rendering, facing.white));
        let [image, reference_image] = [&self.image, &self.reference].map(|of| ask.ask(of));
        let (Some(image), Some(reference_image)) =
            ((*image).as_ref().map_err(|&e| e)?, (*reference_image).as_ref().map_err(|&e| e)?)
        else {
            return Ok(None);
        };
        let Some((map, mut lightness)) = signal_differences(
            self.metric,
            [image.signals(), reference_image.signals()],
            scales.each_ref(),
            self.stride,
            &ask.stop(),
        ) else {
            return Ok(None);
        };
        // Of the mesh alone: what stands about it is in the map.
        let parts = || image.placed().parts().iter().step_by(self.stride);
        lightness.iter_mut().zip(parts()).filter(|(_, part)| !part.is_subject()).for_each(|(value, _)| *value = 0.0);
        let own: Cow<'_, [f32]> = if image.placed().parts().is_empty() {
            Cow::Borrowed(&map)
        } else {
            map.iter().zip(parts()).filter(|(_, part)| part.is_subject()).map(|(&value, _)| value).collect()
        };
        let mean = own.iter().map(|&d| f64::from(d)).sum::<f64>() / own.len().max(1) as f64;
        let max = f64::from(own.iter().copied().fold(0.0, f32::max));
        drop(own);
        let facing = |material: &GridSpectrum| {
            let flat = |of, rendering| patch_colors(of, rendering, std::iter::once(material));
            let (sample, reference) = (flat(&self.rendering, rendering), flat(&self.exposure.reference, reference));
            compare::difference(self.metric, &reference[0], &sample[0]).ok()
        };
        let garment = self.image.parts.iter().find(|(part, _)| *part == Part::Garment);
        let garment = garment.and_then(|(_, garment)| facing(garment));
        let (facing, bright) = (facing(&self.exposure.reflectance), BrightSamples::new(&map, &lightness));
        Ok(Some(Arc::new(Difference { stride: self.stride, map, mean, max, facing, garment, bright })))
    }
}
