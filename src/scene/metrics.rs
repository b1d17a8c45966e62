//! Figures of merit of cameras under the document's conditions.

use std::collections::BTreeMap;

use chromascope_core::patch_set::COLOR_CHECKER_CHROMATIC;
use chromascope_core::query::{CameraMetricsQuery, IndexConditions, Replicates, Shared};

use super::{Scene, SceneError};
use crate::catalog::load::LightQuery;
use crate::document::{CHART, CIE_1931, SetKind};

/// The light of the sensitivity metamerism index (ISO 17321-1).
const INDEX_LIGHT: &str = "D55";

impl Scene<'_> {
    /// The question for all figures of merit of a sensor under the document's conditions.
    pub fn camera_metrics_query(&self, kind: SetKind, name: &str) -> Result<CameraMetricsQuery, SceneError> {
        let (models, replicates) = self.replicates()?;
        Ok(CameraMetricsQuery {
            rendering: self.rendering_of(kind, name)?,
            reference: self.rendering_of(SetKind::Observer, &self.document.reference)?,
            patches: self.patches()?,
            temperature: self.temperature()?,
            index: self.index_conditions()?,
            electrons: None,
            replicates,
            model: models.iter().position(|model| kind == SetKind::Camera && *model == model_of(name)),
        })
    }

    /// Observer, light and patches of the sensitivity metamerism index.
    fn index_conditions(&self) -> Result<IndexConditions, SceneError> {
        let light = self.entry(SetKind::Illuminant, INDEX_LIGHT)?;
        Ok(IndexConditions {
            observer: self.sensor(SetKind::Observer, CIE_1931)?,
            light: self.loaded(&LightQuery::Set(light.place), INDEX_LIGHT)?.grid,
            patches: self.patch_set(CHART, Some(&COLOR_CHECKER_CHROMATIC))?,
        })
    }

    /// The camera models with more than one built-in table, and those tables.
    fn replicates(&self) -> Result<(Vec<&str>, Shared<Replicates>), SceneError> {
        let mut tables: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for entry in self.catalog.of_kind(SetKind::Camera) {
            tables.entry(model_of(&entry.name)).or_default().push(&entry.name);
        }
        tables.retain(|_, names| names.len() > 1);
        let sensors = |names: &Vec<&str>| names.iter().map(|name| self.sensor(SetKind::Camera, name)).collect();
        let models = tables.values().map(sensors).collect::<Result<Vec<_>, _>>()?;
        Ok((tables.into_keys().collect(), Shared::new(Replicates::new(models))))
    }
}

/// Name of a camera's model: its set's name without the parenthesis that tells tables of one model apart.
pub fn model_of(name: &str) -> &str {
    name.split_once(" (").map_or(name, |(model, _)| model)
}
