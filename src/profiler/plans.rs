//! How each source's integrals are made within a tolerance, and what was rejected.

use std::fmt::Write as _;

use chromascope_core::accuracy::Accuracy;
use chromascope_core::camera::RenderingError;
use chromascope_core::query::render::{PicturesQuery, PlanQuery, SourceOf};
use chromascope_core::query::{Ask, Query};
use chromascope_core::render::Against;
use chromascope_core::render::plan::{Candidate, Explanation, Method};

/// What is the plan of each source of these pictures? None inside if stopped.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PlansQuery(pub PicturesQuery);

/// A source's plan; none where no tolerance was asked for, and if stopped.
pub type PlanAnswer = Result<Option<Planned>, RenderingError>;

impl PlansQuery {
    /// What was answered as far as it is of other pictures' sources, in their order: a plan is its camera's under a light with
    /// a material. None if one is missing.
    pub(super) fn plans_for(&self, pictures: &PicturesQuery, plans: &[PlanAnswer]) -> Option<Vec<PlanAnswer>> {
        let known: Vec<_> = self.0.sources.iter().map(|source| self.0.image(&source.rendering).measure).collect();
        let plan = |source: &SourceOf| {
            let measure = pictures.image(&source.rendering).measure;
            plans.get(known.iter().position(|known| *known == measure)?).cloned()
        };
        pictures.sources.iter().map(plan).collect()
    }
}

impl Query for PlansQuery {
    type Answer = Vec<PlanAnswer>;
    const NAME: &'static str = "plans";
    const KEPT: usize = 8;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        self.0.sources.iter().map(|source| planned(&self.0, source, ask)).collect()
    }
}

/// How a source's samples are made within a tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// The plan of the diffuse integral; none where no sample takes one.
    pub explanation: Option<Explanation>,
    /// What is certain of the samples.
    pub certain: Certain,
}

/// The error of a rendered sample in its parts; none where a sample has no such part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certain {
    /// Of the diffuse integral, relative to its peak J(κ, 0) at the sample's κ: the largest seen in the check, times a margin.
    pub diffuse: Option<f64>,
    /// Of the mirror lobes, relative to the brightest sample of the picture.
    pub mirror: Option<f64>,
}

/// What keeping a signal as a single-precision number changes at most, relative to the signal itself: `2^-24`.
pub const SINGLE_PRECISION: f64 = 6e-8;

impl Certain {
    /// Where other errors are below this, that of single precision is worth saying.
    const WORTH_SAYING: f64 = 1e-7;

    /// What is certain with this plan, so many mirror lobes, and this tolerance.
    pub fn of(explanation: Option<&Explanation>, mirrors: u64, tolerance: Accuracy) -> Self {
        let mirror = (mirrors > 0).then_some(tolerance.max_relative_error());
        Self { diffuse: explanation.map(Explanation::certified), mirror }
    }

    /// Whether single precision is what limits it.
    pub fn is_limited_by_storage(self) -> bool {
        self.diffuse.is_none_or(|error| error < Self::WORTH_SAYING)
            && self.mirror.is_none_or(|error| error < Self::WORTH_SAYING)
    }

    /// In words, without a capital or a full stop: each error with what it is relative to.
    pub fn words(self) -> String {
        let diffuse = self.diffuse.map_or_else(
            || "no sample takes a spectral integral".to_owned(),
            |error| format!("diffuse component: estimated error bound {error:.1e} of the peak"),
        );
        let mirror = self.mirror.map(|error| format!("specular lobes within {error:e} of the brightest sample"));
        let storage = format!("stored in single precision ({SINGLE_PRECISION:e})");
        let storage = ((self.diffuse.or(self.mirror)).is_some() && self.is_limited_by_storage()).then_some(storage);
        [Some(diffuse), mirror, storage].into_iter().flatten().collect::<Vec<_>>().join("; ")
    }
}

/// The plan of one source; none where no tolerance was asked for, and if stopped.
pub fn planned(pictures: &PicturesQuery, source: &SourceOf, ask: &impl Ask) -> PlanAnswer {
    let shading = ask.ask(&pictures.shading);
    let Some(shading) = (*shading).as_ref() else { return Ok(None) };
    let (Some(tolerance), Some(accuracy)) = (shading.quality().accuracy(), shading.plan_accuracy()) else {
        return Ok(None);
    };
    let explanation = match shading.demand() {
        None => None,
        Some(demand) => {
            let measure = pictures.image(&source.rendering).measure;
            let plan = ask.ask(&PlanQuery { measure, accuracy, against: Against::Peak, demand });
            Some((*plan).as_ref().map_err(|&error| error)?.explanation().clone())
        }
    };
    let certain = Certain::of(explanation.as_ref(), shading.counts().mirrors, tolerance);
    Ok(Some(Planned { explanation, certain }))
}

/// A way in words.
pub fn words(method: &Method) -> String {
    match method {
        Method::Nothing => "nothing".to_owned(),
        Method::Moments { orders, from_kappa } => {
            let plural = if *orders == 1 { "moment" } else { "moments" };
            format!("{orders} {plural} (κ ≥ {})", crate::number::number(*from_kappa))
        }
        Method::Table { degree, kappas, betas, nodes } => {
            format!("table of {kappas} × {betas}, degree {degree}, {nodes} wavelengths a place")
        }
        Method::Shared { nodes, precision } => {
            format!("{nodes} wavelengths for all channels, S to {:e}", precision.max_relative_error())
        }
        Method::Own { nodes, precision } => {
            format!("{nodes} wavelengths, each channel its own, S to {:e}", precision.max_relative_error())
        }
        Method::Every { precision } => format!("all 401 wavelengths, S to {:e}", precision.max_relative_error()),
    }
}

/// The ways that a plan takes: how rough surfaces are made, if not as the others, and how the others.
pub fn parts(explanation: &Explanation) -> impl Iterator<Item = &Candidate> {
    let mut parts: Vec<&Candidate> = explanation.rough.iter().chain([&explanation.chosen]).collect();
    parts.dedup_by_key(|part| part.method);
    parts.into_iter().filter(|part| part.method != Method::Nothing)
}

/// A whole plan in words: how rough surfaces are made, and how the others.
pub fn sentence(explanation: &Explanation) -> String {
    let mut used = parts(explanation).map(|part| words(&part.method));
    let mut text = used.next().unwrap_or_else(|| "nothing".to_owned());
    for part in used {
        let _ = write!(text, ", below that {part}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_error_is_said_with_what_it_is_relative_to() {
        let words = |diffuse, mirror| Certain { diffuse, mirror }.words();
        assert_eq!(
            words(Some(3.4e-10), Some(1e-9)),
            "diffuse part certified below 3.4e-10 of the peak; mirror lobes within 1e-9 of the brightest sample; \
             kept in single precision (6e-8)"
        );
        assert_eq!(
            words(Some(4.3e-8), None),
            "diffuse part certified below 4.3e-8 of the peak; kept in single precision (6e-8)"
        );
        assert_eq!(
            words(Some(4.3e-8), Some(1e-3)),
            "diffuse part certified below 4.3e-8 of the peak; mirror lobes within 1e-3 of the brightest sample"
        );
        assert_eq!(words(None, None), "no sample takes a spectral integral");
        assert_eq!(
            words(None, Some(1e-5)),
            "no sample takes a spectral integral; mirror lobes within 1e-5 of the brightest sample"
        );
    }
}
