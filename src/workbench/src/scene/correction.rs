//! Color corrections as queries: of which sensor, under which one or two lights.

use chromascope_core::colorimetry::Metric;
use chromascope_core::correction::aces::IdtExposure;
use chromascope_core::query::correction::{CorrectionSheetQuery, IdtQuery};
use chromascope_core::query::{CorrectionReportQuery, RenderingQuery};

use super::{Scene, SceneError};
use crate::document::{CIE_1931, FIT_TARGET, SetKind, TRAINING, TransformChoice};

/// EXIF's codes of lights by the names of their sets (`LightSource`).
const EXIF_LIGHTS: [(&str, u16); 8] = [
    ("A", 17),
    ("B", 18),
    ("C", 19),
    ("D55", 20),
    ("D65", 21),
    ("D75", 22),
    ("D50", 23),
    ("ISO 7589 studio tungsten", 24),
];

/// EXIF's code of a light; none for lights that EXIF does not name.
pub fn exif_light(name: &str) -> Option<u16> {
    EXIF_LIGHTS.iter().find(|(known, _)| *known == name).map(|(_, code)| *code)
}

impl Scene<'_> {
    /// Query for a sensor's color correction with all errors, under the light on the scene and the second of the document.
    pub fn correction_sheet(&self, kind: SetKind, name: &str) -> Result<CorrectionSheetQuery, SceneError> {
        let first = self.rendering_of(kind, name)?;
        let metric = self.correction_metric();
        let second = match &self.document.correction.second_light {
            Some(light) => Some(RenderingQuery { light: self.illuminant(light)?.grid, ..first.clone() }),
            None => None,
        };
        let report = |rendering| CorrectionReportQuery { rendering, metric };
        let observer = self.sensor(SetKind::Observer, CIE_1931)?;
        Ok(CorrectionSheetQuery { first: report(first), second: second.map(report), observer })
    }

    /// Metric of corrections' errors: the document's, where it is one of L\*a\*b\*.
    pub fn correction_metric(&self) -> Metric {
        Some(self.document.difference).filter(|metric| metric.needs_adopted_white()).unwrap_or(Metric::DELTA_E_2000)
    }

    /// Query for a camera's ACES input transform under the light on the scene.
    pub fn input_device_transform(
        &self,
        kind: SetKind,
        name: &str,
        exposure: IdtExposure,
    ) -> Result<IdtQuery, SceneError> {
        Ok(IdtQuery {
            camera: self.sensor(kind, name)?,
            light: self.light()?.grid,
            observer: self.sensor(SetKind::Observer, CIE_1931)?,
            training: self.patch_set(TRAINING, None)?,
            exposure,
            neutral: None,
        })
    }

    /// The observer that fitted color transforms are fitted to.
    pub fn fit_target(&self) -> &str {
        match &self.document.transform {
            TransformChoice::Paper => FIT_TARGET,
            TransformChoice::Observer(target) => target,
        }
    }
}
