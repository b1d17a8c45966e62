//! Integration plan of each sensor for a tolerance, with the rejected methods.

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::RenderingError;
use chromascope_core::query::RenderingQuery;
use chromascope_core::query::render::PlanQuery;
use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::query::{Ask, Query};
use chromascope_core::render::plan::Explanation;

use crate::jobs::Later;

/// Integration plan of each sensor of a set of pictures; `None` if stopped.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PlansQuery(pub PicturesQuery);

/// A source's plan; none where no tolerance was requested, and if stopped.
pub type PlanAnswer = Result<Option<Planned>, RenderingError>;

impl PlansQuery {
    /// Who waits for plans.
    const PANE: &'static str = "Tolerance";

    /// Asks for the plans of these pictures' sources or, if `now` is false, once more for those asked last; returns what
    /// [`Self::seen`] does.
    pub fn ask(later: &Later, pictures: &PicturesQuery, now: bool) -> Option<Vec<PlanAnswer>> {
        if now {
            later.ask(Self::PANE, vec![Self(pictures.clone())]);
        } else {
            later.again::<Self>(Self::PANE);
        }
        Self::seen(later, pictures)
    }

    /// The plan of each of these pictures' sources, in their order. Until it is made, the last one that was made for the same
    /// camera, light and material; none while there is a source without one.
    pub fn seen(later: &Later, pictures: &PicturesQuery) -> Option<Vec<PlanAnswer>> {
        let plans = later.seen::<Self>(Self::PANE).shown?;
        plans.job.plans_for(pictures, &plans.answer)
    }

    /// Plans for other pictures' sources, in their order, as far as they are among `plans`; `None` if one is missing. A plan
    /// holds for its camera under a light with a material.
    fn plans_for(&self, pictures: &PicturesQuery, plans: &[PlanAnswer]) -> Option<Vec<PlanAnswer>> {
        let known: Vec<_> = self.0.sources.iter().map(|source| self.0.image(source).measure).collect();
        let plan = |source: &RenderingQuery| {
            let measure = pictures.image(source).measure;
            plans.get(known.iter().position(|known| *known == measure)?).cloned()
        };
        pictures.sources.iter().map(plan).collect()
    }
}

impl Query for PlansQuery {
    type Answer = Vec<PlanAnswer>;
    const NAME: &'static str = "plans";
    const CAPACITY: usize = 8;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        self.0.sources.iter().map(|source| planned(&self.0, source, ask)).collect()
    }
}

/// Integration plan of a sensor for a tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// The plan of the diffuse integral; none where no sample takes one.
    pub explanation: Option<Explanation>,
    pub bounds: ErrorBounds,
}

/// The error of a rendered sample in its parts; none where a sample has no such part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorBounds {
    /// Of the diffuse integral, relative to its peak J(κ, 0) at the sample's κ: the largest seen in the check, times a margin.
    pub diffuse: Option<f64>,
    /// Bound of the specular lobes, relative to the brightest sample of the picture.
    pub coherent: Option<f64>,
}

/// Largest relative rounding error of a signal stored in single precision: `2^-24`.
pub const SINGLE_PRECISION: f64 = 6e-8;

impl ErrorBounds {
    /// Largest error beside which that of single precision is worth mentioning.
    const WORTH_SAYING: f64 = 1e-7;

    /// Bounds with this plan, this number of specular lobes, and this tolerance.
    pub fn of(explanation: Option<&Explanation>, coherent_samples: u64, tolerance: RelTolerance) -> Self {
        let coherent = (coherent_samples > 0).then_some(tolerance.max_relative_error());
        Self { diffuse: explanation.map(Explanation::error_bound), coherent }
    }

    /// True if single precision is what limits it.
    pub fn is_limited_by_storage(self) -> bool {
        self.diffuse.is_none_or(|error| error < Self::WORTH_SAYING)
            && self.coherent.is_none_or(|error| error < Self::WORTH_SAYING)
    }

    /// Description without a capital or a full stop: each error with its scale.
    pub fn words(self) -> String {
        let diffuse = self.diffuse.map_or_else(
            || "no sample takes a spectral integral".to_owned(),
            |error| format!("diffuse component: estimated error bound {error:.1e} of the peak"),
        );
        let coherent = self.coherent.map(|error| format!("specular lobes within {error:e} of the brightest sample"));
        let storage = format!("stored in single precision ({SINGLE_PRECISION:e})");
        let storage = ((self.diffuse.or(self.coherent)).is_some() && self.is_limited_by_storage()).then_some(storage);
        [Some(diffuse), coherent, storage].into_iter().flatten().collect::<Vec<_>>().join("; ")
    }
}

/// The plan of one source; none where no tolerance was requested, and if stopped.
pub fn planned(pictures: &PicturesQuery, source: &RenderingQuery, ask: &impl Ask) -> PlanAnswer {
    let shading = ask.ask(&pictures.shading);
    let Some(shading) = (*shading).as_ref() else { return Ok(None) };
    let (Some(tolerance), Some(of_peak)) = (shading.quality().given_tolerance(), shading.plan_tolerance()) else {
        return Ok(None);
    };
    let explanation = match shading.demand() {
        None => None,
        Some(demand) => {
            let measure = pictures.image(source).measure;
            let plan = ask.ask(&PlanQuery { measure, tolerance: of_peak, demand });
            Some((*plan).as_ref().map_err(|&error| error)?.explanation().clone())
        }
    };
    let bounds = ErrorBounds::of(explanation.as_ref(), shading.counts().coherent_samples, tolerance);
    Ok(Some(Planned { explanation, bounds }))
}
