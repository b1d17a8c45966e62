//! Queries for the methods of a camera's spectral integrals within a tolerance.

use super::SpectralWeightsQuery;
use crate::accuracy::RelTolerance;
use crate::camera::RenderingError;
use crate::query::ask::{Ask, Query};
use crate::render::{Demand, Plan};
use std::sync::Arc;

/// The fastest method of a camera's spectral integral within a tolerance. Depends on no surface or angle: the demands of pictures
/// are rounded out to a few ([`Demand::of_picture`]).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PlanQuery {
    /// The camera under the light.
    pub measure: SpectralWeightsQuery,
    /// The allowed error.
    pub tolerance: RelTolerance,
    /// Range of κ and number of samples.
    pub demand: Demand,
}

impl Query for PlanQuery {
    type Answer = Result<Arc<Plan>, RenderingError>;
    const NAME: &'static str = "plan";
    const ALWAYS_COMPLETE: bool = true;
    const CAPACITY: usize = 64;

    fn bytes(plan: &Self::Answer) -> usize {
        plan.as_ref().map_or(0, |plan| plan.bytes())
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let measure = ask.ask(&self.measure);
        let measure = (*measure).as_ref().map_err(|&e| e)?;
        Ok(Arc::new(Plan::new(measure, self.tolerance, self.demand)?))
    }
}
