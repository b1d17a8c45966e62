//! Integration methods of a source in the picture as it is.

use std::hint::black_box;
use std::sync::Arc;

use chromascope_core::camera::RenderingError;
use chromascope_core::query::Ask;
use chromascope_core::query::render::picture::{PicturesQuery, SourceOf};
use chromascope_core::render::measure::Node;
use chromascope_core::render::shading::{DiffuseKind, Shade};
use chromascope_core::render::{Plan, ShadingImage, SpectralWeights};
use chromascope_measure::harness::shortest;

/// Measure and plan of a source.
pub(super) struct SourcePlans {
    measure: Arc<Result<SpectralWeights, RenderingError>>,
    plan: Arc<Plan>,
}

impl SourcePlans {
    /// With the plan of the picture; none for a source that gives no signals under this light.
    pub(super) fn new(
        pictures: &PicturesQuery,
        source: &SourceOf,
        shading: &ShadingImage,
        ask: &impl Ask,
    ) -> Option<Self> {
        let image = pictures.image(&source.rendering);
        let measure = image.measure.in_picture(shading, ask);
        let plan = image.plan(shading, (*measure).as_ref().ok()?, ask).ok()?;
        Some(Self { measure, plan })
    }

    pub(super) fn measure(&self) -> &SpectralWeights {
        (*self.measure).as_ref().expect("made of nothing else")
    }

    pub(super) fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// Number of wavelengths at which S is evaluated for a sample; those that filled a table beforehand do not count.
    pub(super) fn looked_at(&self, shade: &Shade) -> usize {
        let method = self.plan.method(shade.kappa, shade.beta);
        let is_spectral = shade.kind == DiffuseKind::Spectral;
        if is_spectral { method.node_count().min(self.measure().dense().len()) } else { 0 }
    }

    /// Returns true if S is evaluated for a sample.
    pub(super) fn sums(&self, shade: &Shade) -> bool {
        self.looked_at(shade) > 0
    }

    /// The wavelengths used by integrals, in the sample or in its precomputed tables.
    pub(super) fn nodes(&self) -> Vec<Node> {
        self.plan.nodes(self.measure())
    }

    /// Seconds that the integrals of these take as the picture makes them, on this thread.
    pub(super) fn seconds(&self, shades: &[&Shade]) -> f64 {
        let places: Vec<[f64; 2]> = shades.iter().map(|shade| [shade.kappa, shade.beta]).collect();
        let mut sums = vec![[0.0; 3]; places.len()];
        shortest(|| {
            self.plan.fill(&places, &mut sums);
            black_box(&sums);
        })
    }
}
