//! Conditions that metrics are computed under, and tables of the same models.

use crate::camera::quality::Electrons;
use crate::patch_set::PatchSet;
use crate::query::patches::RenderingQuery;
use crate::query::shared::Shared;
use crate::spectral::grid::COUNT;
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
    /// Tables of the same models, whose spread is the uncertainty.
    pub replicates: Shared<Replicates>,
    /// The model among [`Self::replicates`] that the camera is, if it is one.
    pub model: Option<usize>,
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

/// Relative RMS difference below which two tables are one measurement published twice.
const SAME: f64 = 1e-5;

/// Independent tables of the same camera models.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Replicates {
    models: Vec<Vec<Shared<Sensor>>>,
}

impl Replicates {
    /// Takes the tables of each model; one that equals another of the same model within a factor for each channel and 1e-5 of its RMS is
    /// the same measurement and counts once.
    ///
    /// Models keep their indices, also those with fewer than two independent tables, which contribute nothing.
    pub fn new(models: impl IntoIterator<Item = Vec<Shared<Sensor>>>) -> Self {
        let independent = |tables: Vec<Shared<Sensor>>| {
            let mut kept: Vec<Shared<Sensor>> = Vec::new();
            for table in tables {
                if !kept.iter().any(|other| same_measurement(other, &table)) {
                    kept.push(table);
                }
            }
            kept
        };
        Self { models: models.into_iter().map(independent).collect() }
    }

    /// The independent tables of each model.
    pub fn models(&self) -> &[Vec<Shared<Sensor>>] {
        &self.models
    }
}

/// True if two tables differ by rounding and a factor for each channel alone.
fn same_measurement(a: &Sensor, b: &Sensor) -> bool {
    (0..3).all(|channel| {
        let pairs = || (0..COUNT).map(|i| (a.at_index(i)[channel], b.at_index(i)[channel]));
        let sum = |f: fn((f64, f64)) -> f64| pairs().map(f).sum::<f64>();
        let (aa, bb, ab) = (sum(|(x, _)| x * x), sum(|(_, y)| y * y), sum(|(x, y)| x * y));
        // 1 − cos² is the squared relative residual of the best factor.
        let factor = ab / bb;
        pairs().map(|(x, y)| (x - factor * y).powi(2)).sum::<f64>() <= SAME * SAME * aa
    })
}
