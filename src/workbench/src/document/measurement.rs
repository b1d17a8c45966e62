//! What a camera recorded of charts or of narrow bands, by value: the photographs themselves are not part of a document.

use std::fmt;
use std::path::Path;

use chromascope_core::camera::chart_search::CHART_SIZE;
use chromascope_core::recovery::Pass;
use serde::{Deserialize, Serialize};

use super::imported::Fingerprint;
use super::kind::Light;

/// Name of a camera that no file states.
pub const MY_CAMERA: &str = "My camera";

/// Shots of a chart by one camera, or passes over narrow bands, from which its sensitivities are recovered.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Measurement {
    /// Name of the camera.
    pub camera: String,
    pub shots: Vec<MeasuredShot>,
    /// Where there are any, there are no shots.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub passes: Vec<MeasuredPass>,
    /// Raw value from which on a mean of a band is saturated; none until it is named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clip: Option<f64>,
    /// True if shots whose files state several models are of one camera by the user's word.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_one_camera: bool,
}

impl Measurement {
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// That by which a camera recovered from these files is known: further ones do not make another one.
    pub fn origin(&self) -> Option<Fingerprint> {
        let of_shot = |shot: &MeasuredShot| shot.contents.unwrap_or_else(|| Fingerprint::of(shot.file.as_bytes()));
        self.shots.first().map(of_shot).or_else(|| self.passes.first().map(|pass| pass.contents))
    }

    /// Camera model of profile files, as the first file states it that states one.
    pub fn model(&self) -> Option<&str> {
        self.shots.iter().find_map(|shot| shot.model.as_deref())
    }

    /// Sentence about files that state different models: nothing is made of them unless they are of one camera by the user's word.
    pub fn mixed(&self) -> Option<String> {
        let stated = self.shots.iter().filter_map(|shot| Some((shot.file.as_str(), shot.model.as_deref()?)));
        mixed_models(stated).filter(|_| !self.is_one_camera)
    }

    /// Place of a picture's shot.
    pub fn place(&self, contents: Fingerprint, name: &str) -> Option<usize> {
        self.shots.iter().position(|shot| shot.is_of(contents, name))
    }
}

/// Sentence about files that state different camera models, if they do.
pub fn mixed_models<'a>(mut stated: impl Iterator<Item = (&'a str, &'a str)>) -> Option<String> {
    let (first, model) = stated.next()?;
    let (file, other) = stated.find(|(_, other)| *other != model)?;
    Some(format!("{first} is from a camera of the model \"{model}\", {file} from a \"{other}\""))
}

/// One picture of a chart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredShot {
    /// Name of the picture; with its folder where another one has the same name.
    pub file: String,
    /// By which the picture is known wherever it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contents: Option<Fingerprint>,
    /// Camera model by which raw converters offer profiles, where the file states it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<String>,
    pub chart: String,
    /// The light; none until it is chosen.
    pub light: Option<Light>,
    /// Of a light by formula, in kelvins; none for daylight of unknown temperature.
    pub temperature_k: Option<f64>,
    /// Columns and rows of the grid of patches.
    #[serde(default = "usual_grid", skip_serializing_if = "is_usual_grid")]
    pub grid: [usize; 2],
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

/// Raw means of one pass over narrow bands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredPass {
    pub file: String,
    pub contents: Fingerprint,
    pub bands: Pass,
    /// Of which part of which pictures the means are; none of a table of means.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pictures: Option<BandPictures>,
}

impl MeasuredPass {
    /// True for the same table, or for one of its name that differs in nothing but the region of its pictures that counts.
    pub fn is_again(&self, other: &Self) -> bool {
        let conditions = |of: &Self| -> Vec<[f64; 3]> {
            of.bands.iter().map(|band| [band.wavelength_nm, band.power, band.exposure]).collect()
        };
        let have_pictures = self.pictures.is_some() && other.pictures.is_some();
        self.contents == other.contents
            || have_pictures && self.file == other.file && conditions(self) == conditions(other)
    }
}

/// What the means of bands were taken of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BandPictures {
    /// Left, top, width and height in pixels.
    pub region: [usize; 4],
    /// Value from which on the pictures are clipped.
    pub clip: f64,
}

impl fmt::Display for BandPictures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [left, top, width, height] = self.region;
        write!(f, "means of {width} × {height} pixels at {left}, {top} of each picture")
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

fn usual_grid() -> [usize; 2] {
    CHART_SIZE
}

fn is_usual_grid(grid: &[usize; 2]) -> bool {
    *grid == CHART_SIZE
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde calls")]
fn is_zero(share: &f64) -> bool {
    *share == 0.0
}
