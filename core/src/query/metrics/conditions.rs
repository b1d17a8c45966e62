//! Conditions that metrics are computed under.

use crate::camera::quality::Electrons;
use crate::patch_set::PatchSet;
use crate::query::patches::RenderingQuery;
use crate::query::shared::Shared;
use crate::spectral::{GridSpectrum, Sensor};
use crate::units::Kelvin;

/// Figures of merit of one camera under one set of conditions.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CameraMetricsQuery {
    /// The camera and its color transform.
    pub rendering: RenderingQuery,
    /// The reference observer under the same conditions.
    pub reference: RenderingQuery,
    /// The patches that differences are taken over.
    pub patches: Shared<PatchSet>,
    /// Temperature of the blackbody whose place on the locus is compared.
    pub temperature: Kelvin,
    /// Light and patches of the metamerism index.
    pub index: IndexConditions,
    /// The camera's full-well capacity and read noise, if known.
    pub electrons: Option<Electrons>,
}

/// Conditions of the sensitivity metamerism index: by ISO 17321-1 the CIE 1931 observer, D55 and the 18 chromatic patches of the
/// `ColorChecker`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct IndexConditions {
    /// The observer; counts in XYZ.
    pub observer: Shared<Sensor>,
    /// The light.
    pub light: Shared<GridSpectrum>,
    /// The patches.
    pub patches: Shared<PatchSet>,
}
