//! The measurement of the document as a question.

use chromascope_core::camera::chart_grid::grids;
use chromascope_core::camera::recorded::{RecordedPatch, Signal};
use chromascope_core::query::ChartShot;
use chromascope_core::recovery::NarrowBands;

use super::recorded::in_grid;
use super::recovery::{MeasuredBandsQuery, MeasuredCameraQuery};
use super::{Scene, SceneError};
use crate::document::measurement::{MeasuredPatch, MeasuredShot, Measurement};
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
        let recorded = scene.recorded_patches(&shot.patches, shot.grid);
        let recorded = recorded.map_err(|error| format!("{}: {error}", shot.file))?;
        let made = scene.chart_shot(recorded, Some(shot.grid[0]), RELATIVE, shot.is_daylight());
        let made = made.map_err(|error| format!("{}: {error}", shot.file))?;
        Ok(ChartShot { picture: shot.file.clone(), ..made })
    }

    /// Question for the sensitivities by the passes over bands of the document; none without any, or while their clipping level is not named.
    pub fn measured_passes(&self) -> Option<MeasuredBandsQuery> {
        let Measurement { passes, clip, .. } = &self.document.measurement;
        let clip = clip.filter(|_| !passes.is_empty())?;
        Some(self.measured_bands(NarrowBands { passes: passes.iter().map(|pass| pass.bands.clone()).collect(), clip }))
    }

    /// Grids that the patches of a chart fill, the likeliest first.
    pub fn grids_of(&self, chart: &str) -> Vec<[usize; 2]> {
        let set = self.patch_set(chart, None);
        set.map_or_else(|_| Vec::new(), |set| grids(&set.patches().iter().map(|p| p.name.as_str()).collect::<Vec<_>>()))
    }

    /// Patches of the chart with what a picture has of them, and the standard deviations of that.
    pub fn recorded_patches(
        &self,
        patches: &[MeasuredPatch],
        grid: [usize; 2],
    ) -> Result<(Vec<RecordedPatch>, Vec<[f64; 3]>), String> {
        let radiances = self.patch_radiances().map_err(|error: SceneError| error.to_string())?;
        let radiances = in_grid(radiances, grid);
        if radiances.len() != patches.len() {
            let (chart, found) = (&self.document.chart, patches.len());
            return Err(format!(
                "{chart} has {} patches, the picture {found}: choose another chart or grid",
                radiances.len()
            ));
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
