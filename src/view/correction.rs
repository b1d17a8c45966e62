//! View state of the Correction pane.

use std::collections::BTreeMap;
use std::sync::Arc;

use chromascope_core::correction::neutral::{Neutral, NeutralError};

use crate::export::profile::{CorrectionFile, CorrectionRequest};
use crate::scene::Scene;

#[derive(Debug, Default)]
pub struct CorrectionView {
    /// Camera models as typed, by camera.
    pub models: BTreeMap<String, String>,
    /// Neutrals as typed, by camera and light: one of another light would be wrong.
    pub neutrals: BTreeMap<(String, String), String>,
    pub shown: Option<Arc<CorrectionFile>>,
}

impl CorrectionView {
    /// The neutral typed for a camera under the light on the scene; none for an empty field.
    pub fn neutral(&self, scene: &Scene<'_>, camera: &str) -> Result<Option<Neutral>, NeutralError> {
        let typed = self.neutrals.get(&(camera.to_owned(), scene.light_name()));
        typed.filter(|typed| !typed.trim().is_empty()).map(|typed| typed.parse()).transpose()
    }

    /// What the files of a camera are to state. A neutral that cannot be read counts as none.
    pub fn request<'a>(&'a self, scene: &Scene<'_>, camera: &'a str) -> CorrectionRequest<'a> {
        let model = self.models.get(camera).map(|typed| typed.trim()).filter(|typed| !typed.is_empty());
        let neutral = self.neutral(scene, camera).ok().flatten();
        CorrectionRequest { camera, model, neutral, ..CorrectionRequest::default() }
    }
}
