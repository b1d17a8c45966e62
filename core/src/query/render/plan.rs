//! Questions about how a camera's integrals are made at a chosen accuracy.

use super::SpectralWeightsQuery;
use crate::accuracy::Accuracy;
use crate::camera::RenderingError;
use crate::query::ask::{Ask, Query};
use crate::render::mirror::Reach;
use crate::render::{Against, Demand, Plan, Quality};

/// What is the cheapest way to a camera's spectral integral that keeps an error? Asks for no surface or angle: what a scene
/// demands changes only as its κ leave a power of two, or its samples.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PlanQuery {
    /// The camera under the light.
    pub measure: SpectralWeightsQuery,
    /// The error.
    pub accuracy: Accuracy,
    /// What it is relative to.
    pub against: Against,
    /// The κ and how many samples.
    pub demand: Demand,
}

impl Query for PlanQuery {
    type Answer = Result<Plan, RenderingError>;
    const NAME: &'static str = "plan";
    const WHOLE: bool = true;
    const KEPT: usize = 64;

    fn bytes(plan: &Self::Answer) -> usize {
        plan.as_ref().map_or(0, Plan::bytes)
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let measure = ask.ask(&self.measure);
        let measure = (*measure).as_ref().map_err(|&e| e)?;
        Ok(Plan::new(measure, self.accuracy, self.against, self.demand)?)
    }
}

/// Over which paths is a mirror's lobe made of a few wavelengths, or of its mean, at an accuracy?
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ReachQuery {
    /// The camera under the light.
    pub measure: SpectralWeightsQuery,
    /// The error.
    pub accuracy: Accuracy,
}

impl Query for ReachQuery {
    type Answer = Result<Reach, RenderingError>;
    const NAME: &'static str = "mirror reach";
    const WHOLE: bool = true;
    const KEPT: usize = 64;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let measure = ask.ask(&self.measure);
        Ok(Reach::of(Quality::Within(self.accuracy), (*measure).as_ref().map_err(|&e| e)?))
    }
}
