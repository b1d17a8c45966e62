//! Figures of merit of cameras under the document's conditions.

use std::collections::BTreeMap;

use chromascope_core::metamers::{Confusion, MetamerLimits};
use chromascope_core::patch_set::COLOR_CHECKER_CHROMATIC;
use chromascope_core::query::{Ask as _, CameraMetricsQuery, IndexConditions, MetamersQuery, Replicates, Shared};
use chromascope_core::units::Kelvin;

use super::{Scene, SceneError};
use crate::catalog::load::{LightQuery, ReplicatesQuery};
use crate::catalog::{Entry, Place};
use crate::document::{CHART, CIE_1931, SetKind};

/// The light of the sensitivity metamerism index (ISO 17321-1).
const INDEX_LIGHT: &str = "D55";
/// Maximum number of metameric pairs listed.
const MOST_METAMERS: usize = 100;

impl Scene<'_> {
    /// Query for all figures of merit of a sensor under the document's conditions, the locus at the marked temperature.
    pub fn camera_metrics_query(&self, kind: SetKind, name: &str) -> Result<CameraMetricsQuery, SceneError> {
        self.camera_metrics_query_at(kind, name, self.document.temperature_k)
    }

    /// Query for all figures of merit of a sensor, with the locus at a temperature in kelvins.
    pub fn camera_metrics_query_at(
        &self,
        kind: SetKind,
        name: &str,
        temperature_k: f64,
    ) -> Result<CameraMetricsQuery, SceneError> {
        let (models, replicates) = self.replicates()?;
        Ok(CameraMetricsQuery {
            rendering: self.rendering_of(kind, name)?,
            reference: self.rendering_of(SetKind::Observer, &self.document.reference)?,
            patches: self.patches()?,
            temperature: Kelvin::new(temperature_k)?,
            index: self.index_conditions()?,
            electrons: None,
            replicates,
            model: models.iter().position(|model| kind == SetKind::Camera && *model == model_of(name)),
        })
    }

    /// Query for metamers of a camera and the reference among all sets of reflectances, with the names of the sets.
    pub fn metamers_query(
        &self,
        kind: SetKind,
        name: &str,
        confusion: Confusion,
    ) -> Result<(MetamersQuery, Vec<String>), SceneError> {
        let entries: Vec<_> =
            [SetKind::Chart, SetKind::Material].into_iter().flat_map(|kind| self.entries(kind)).collect();
        let load = |entry: &Entry| self.loaded_patches(entry.place.clone(), &entry.name, None);
        let query = MetamersQuery {
            rendering: self.rendering_of(kind, name)?,
            reference: self.rendering_of(SetKind::Observer, &self.document.reference)?,
            sets: entries.iter().map(load).collect::<Result<_, _>>()?,
            confusion,
            limits: MetamerLimits::USUAL,
            most: MOST_METAMERS,
        };
        Ok((query, entries.into_iter().map(|entry| entry.name).collect()))
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
        let mut tables: BTreeMap<&str, Vec<Place>> = BTreeMap::new();
        for entry in self.catalog.of_kind(SetKind::Camera) {
            tables.entry(model_of(&entry.name)).or_default().push(entry.place.clone());
        }
        tables.retain(|_, places| places.len() > 1);
        let (models, places): (Vec<_>, Vec<_>) = tables.into_iter().unzip();
        let answer = self.results.ask(&ReplicatesQuery(places));
        let failed = |error| SceneError::Load { name: "cameras with several tables".to_owned(), error };
        Ok((models, (*answer).clone().map_err(failed)?))
    }
}

/// Camera model of a set: its name without the parenthesis that distinguishes tables of one model.
pub fn model_of(name: &str) -> &str {
    name.split_once(" (").map_or(name, |(model, _)| model)
}
