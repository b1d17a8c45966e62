//! What a camera recorded of charts, by value: the photographs themselves are not part of a document.

use serde::{Deserialize, Serialize};

use super::kind::Light;

/// Shots of one camera from which its sensitivities are recovered.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Measurement {
    /// Name of the camera.
    pub camera: String,
    pub shots: Vec<MeasuredShot>,
}

impl Measurement {
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

/// One picture of a chart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredShot {
    /// Name of the picture.
    pub file: String,
    pub chart: String,
    /// The light; none until it is chosen.
    pub light: Option<Light>,
    /// Of a light by formula, in kelvins; none for daylight of unknown temperature.
    pub temperature_k: Option<f64>,
    /// Corners of the grid of patches in pixels, around the chart from the first patch.
    pub corners: [[f64; 2]; 4],
    pub patches: Vec<MeasuredPatch>,
}

impl MeasuredShot {
    /// True under daylight of unknown temperature.
    pub fn is_daylight(&self) -> bool {
        self.light == Some(Light::Daylight) && self.temperature_k.is_none()
    }
}

/// Means of a patch in the picture, linear, black at 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredPatch {
    /// Red, green and blue; none where too many pixels are clipped or there is no value.
    pub rgb: [Option<f64>; 3],
    /// Standard deviations of these means by the pixels.
    pub deviation: [f64; 3],
    /// Share of clipped pixels.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub clipped: f64,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde calls")]
fn is_zero(share: &f64) -> bool {
    *share == 0.0
}
