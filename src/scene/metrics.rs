//! Figures of merit of cameras under the document's conditions.

use chromascope_core::query::CameraMetricsQuery;

use super::{Scene, SceneError};
use crate::document::SetKind;

impl Scene<'_> {
    /// The question for all figures of merit of a sensor under the document's conditions.
    pub fn camera_metrics_query(&self, kind: SetKind, name: &str) -> Result<CameraMetricsQuery, SceneError> {
        Ok(CameraMetricsQuery {
            rendering: self.rendering_of(kind, name)?,
            reference: self.rendering_of(SetKind::Observer, &self.document.reference)?,
            patches: self.patches()?,
        })
    }
}
