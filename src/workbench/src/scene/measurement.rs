//! The measurement of the document as a question.

use chromascope_core::camera::recorded::{RecordedPatch, Signal};
use chromascope_core::query::ChartShot;

use super::recovery::MeasuredCameraQuery;
use super::{Scene, SceneError};
use crate::document::measurement::{MeasuredPatch, MeasuredShot};
use crate::document::{Document, Subset};

/// Relative standard deviation by which charts of one edition, and light and model, differ from what is assumed.
pub const RELATIVE: f64 = 0.015;
/// Temperature that daylight of unknown temperature is looked for from.
pub const STAND_IN_K: f64 = 6500.0;

impl Scene<'_> {
    /// Question for the sensitivities of the camera that the document has pictures of; none without any.
    pub fn measurement(&self) -> Result<Option<MeasuredCameraQuery>, String> {
        let shots = &self.document.measurement.shots;
        let made: Vec<ChartShot> = shots.iter().map(|shot| self.measured_shot(shot)).collect::<Result<_, String>>()?;
        if made.is_empty() {
            return Ok(None);
        }
        self.measured_camera(made).map(Some).map_err(|error| error.to_string())
    }

    /// The document under the conditions of a shot.
    fn under(&self, shot: &MeasuredShot) -> Document {
        let mut document = self.document.clone();
        if let Some(light) = &shot.light {
            (document.light, document.temperature_k) = (light.clone(), shot.temperature_k.unwrap_or(STAND_IN_K));
        }
        (document.chart, document.subset) = (shot.chart.clone(), Subset::All);
        document.filters.clear();
        document
    }

    fn measured_shot(&self, shot: &MeasuredShot) -> Result<ChartShot, String> {
        if shot.light.is_none() {
            return Err(format!("{}: choose the light that it was photographed under", shot.file));
        }
        let document = self.under(shot);
        let scene = Scene { document: &document, ..*self };
        let (patches, pixels) = scene.recorded_patches(&shot.patches)?;
        let made = scene.chart_shot(patches, &pixels, RELATIVE, shot.is_daylight());
        let made = made.map_err(|error| format!("{}: {error}", shot.file))?;
        Ok(ChartShot { picture: shot.file.clone(), ..made })
    }

    /// Patches of the chart with what a picture has of them, and the standard deviations of that.
    pub fn recorded_patches(&self, patches: &[MeasuredPatch]) -> Result<(Vec<RecordedPatch>, Vec<[f64; 3]>), String> {
        let radiances = self.patch_radiances().map_err(|error: SceneError| error.to_string())?;
        if radiances.len() != patches.len() {
            let (chart, found) = (&self.document.chart, patches.len());
            return Err(format!("{chart} has {} patches, the picture {found}: choose another chart", radiances.len()));
        }
        // No value stands for too many clipped pixels.
        let signal = |value: Option<f64>| Signal::new(value.unwrap_or(f64::INFINITY), f64::INFINITY);
        let pairs = radiances.into_iter().zip(patches);
        let patch = |((name, radiance), patch): ((String, _), &MeasuredPatch)| RecordedPatch {
            name,
            radiance,
            rgb: patch.rgb.map(signal),
        };
        Ok((pairs.map(patch).collect(), patches.iter().map(|patch| patch.deviation).collect()))
    }
}
