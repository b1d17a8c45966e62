//! Query for a camera's color correction, with the names that its files need.

use std::sync::Arc;

use chromascope_core::camera::RenderingError;
use chromascope_core::correction::aces::IdtExposure;
use chromascope_core::correction::neutral::Neutral;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::correction::{CorrectionSheetQuery, IdtQuery};
use chromascope_core::query::{Ask, Query, Shared};

use super::CorrectionFile;
use crate::catalog::Entry;
use crate::catalog::names::model_of;
use crate::document::SetKind;
use crate::document::imported::Role;
use crate::scene::correction::ChannelRatioQuery;
use crate::scene::{Scene, SceneError};

/// Camera whose correction is wanted, and what its files are to state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CorrectionRequest<'a> {
    pub camera: &'a str,
    /// Camera model as raw files call it; by [`stated_model`] where none is given.
    pub model: Option<&'a str>,
    /// Camera RGB of a neutral under the light on the scene, in place of the table's own.
    pub neutral: Option<Neutral>,
    /// Brightness of the ACES input transform's samples.
    pub exposure: IdtExposure,
}

/// Query for the color correction of a camera of the scene, with its ACES input transform.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CorrectionFileQuery {
    pub camera: String,
    /// Camera model as raw files call it.
    pub(super) model: String,
    /// Correction in words.
    pub(super) correction: String,
    pub lights: Vec<String>,
    /// Symbol of the metric of the errors.
    pub metric: &'static str,
    pub training: Shared<PatchSet>,
    sheet: CorrectionSheetQuery,
    pub(super) idt: IdtQuery,
    ratio: ChannelRatioQuery,
    /// Terms of the table, for the files' copyright.
    pub(super) terms: String,
}

impl CorrectionFileQuery {
    pub fn new(scene: &Scene<'_>, request: CorrectionRequest<'_>) -> Result<Self, SceneError> {
        let CorrectionRequest { camera, model, neutral, exposure } = request;
        if scene.document.transform.is_eq_13() {
            return Err(SceneError::Rendering { name: camera.to_owned(), error: RenderingError::NotFitted });
        }
        let choice = &scene.document.correction;
        let kind = SetKind::Camera;
        Ok(Self {
            camera: camera.to_owned(),
            model: model.map_or_else(|| stated_model(scene, camera), str::to_owned),
            correction: choice.describe(scene.fit_target()),
            lights: std::iter::once(scene.light_name())
                .chain(choice.second_light.clone().map(|light| scene.with_filters(light)))
                .collect(),
            metric: scene.correction_metric().symbol,
            training: scene.patch_set(&choice.training, None)?,
            sheet: scene.correction_sheet(kind, camera)?,
            idt: IdtQuery { neutral, ..scene.input_device_transform(kind, camera, exposure)? },
            ratio: scene.channel_ratio_query(camera)?,
            terms: terms(&scene.entry(kind, camera)?),
        })
    }
}

/// Terms of a camera's table in a few words, as a copyright field states them.
fn terms(entry: &Entry) -> String {
    let license = entry.header.as_ref().map_or("the user's own", |header| &header.license);
    let license = license.split_once(" (").map_or(license, |(license, _)| license);
    format!("Computed from spectral sensitivities of {}; terms of the table: {license}", entry.name)
}

impl Query for CorrectionFileQuery {
    type Answer = Result<Arc<CorrectionFile>, SceneError>;
    const NAME: &'static str = "color correction with its names";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let name = || self.camera.clone();
        let sheet = (*ask.ask(&self.sheet)).clone().map_err(|error| SceneError::Rendering { name: name(), error })?;
        let ratio = (*ask.ask(&self.ratio)).clone().map_err(|error| SceneError::Load { name: name(), error })?;
        Ok(Arc::new(CorrectionFile { of: self.clone(), sheet, idt: (*ask.ask(&self.idt)).clone(), ratio }))
    }
}

/// Names of the library and `UniqueCameraModel` of raw files, as rows of a data file.
const MODELS: &str = "models/unique_camera_model.csv";

/// Camera model as the user's table states it, else by [`unique_camera_model`].
pub fn stated_model(scene: &Scene<'_>, camera: &str) -> String {
    let own = scene.document.own.iter().find(|set| set.name == camera && set.role == Role::Camera);
    own.and_then(|set| set.model.clone()).unwrap_or_else(|| unique_camera_model(camera))
}

/// Camera model as its raw files state it (DNG's `UniqueCameraModel`), by which raw developers offer a profile: that of the table of
/// names, else the camera's name without the parenthesis that distinguishes tables of one model.
pub fn unique_camera_model(camera: &str) -> String {
    let model = model_of(camera);
    let rows = chromascope_data::text(MODELS).unwrap_or_default().lines();
    let known = rows.filter_map(|row| row.split_once(',')).find(|(name, _)| *name == model);
    known.map_or(model, |(_, known)| known).to_owned()
}
