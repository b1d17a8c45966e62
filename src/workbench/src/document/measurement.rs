//! What a camera recorded of charts, by value: the photographs themselves are not part of a document.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::imported::Fingerprint;
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

    /// That by which a camera recovered from these pictures is known: further pictures do not make another one.
    pub fn origin(&self) -> Option<Fingerprint> {
        self.shots.first().map(|shot| shot.contents.unwrap_or_else(|| Fingerprint::of(shot.file.as_bytes())))
    }

    /// Place of a picture's shot.
    pub fn place(&self, contents: Fingerprint, name: &str) -> Option<usize> {
        self.shots.iter().position(|shot| shot.is_of(contents, name))
    }
}

/// One picture of a chart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredShot {
    /// Name of the picture; with its folder where another one has the same name.
    pub file: String,
    /// By which the picture is known wherever it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contents: Option<Fingerprint>,
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
    /// True for that of a picture: of its name and, unless the document is older, its contents.
    pub fn is_of(&self, contents: Fingerprint, name: &str) -> bool {
        Path::new(&self.file).ends_with(name) && self.contents.is_none_or(|own| own == contents)
    }

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
