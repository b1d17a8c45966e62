//! How each source's integrals are made within a tolerance, and what was rejected.

use std::fmt::Write as _;

use chromascope_core::camera::NoRendering;
use chromascope_core::query::render::{PicturesOf, PlanOf, SourceOf};
use chromascope_core::query::{Ask, Query};
use chromascope_core::render::Against;
use chromascope_core::render::plan::{Candidate, Explanation, Method};

/// What is the plan of each source of these pictures? None inside where no sample takes an integral, and if stopped.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PlansOf(pub PicturesOf);

impl Query for PlansOf {
    type Answer = Vec<Result<Option<Explanation>, NoRendering>>;
    const NAME: &'static str = "plans";
    const KEPT: usize = 8;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        self.0.sources.iter().map(|source| explanation(&self.0, source, ask)).collect()
    }
}

/// The plan of one source; none where no sample takes an integral or no tolerance was asked for.
pub fn explanation(
    pictures: &PicturesOf,
    source: &SourceOf,
    ask: &impl Ask,
) -> Result<Option<Explanation>, NoRendering> {
    let shading = ask.ask(&pictures.shading);
    let Some(shading) = (*shading).as_ref() else { return Ok(None) };
    let (Some(accuracy), Some(demand)) = (shading.plan_accuracy(), shading.demand()) else { return Ok(None) };
    let measure = pictures.image(&source.rendering).measure;
    let plan = ask.ask(&PlanOf { measure, accuracy, against: Against::Peak, demand });
    (*plan).as_ref().map(|plan| Some(plan.explanation().clone())).map_err(|&error| error)
}

/// A way in words.
pub fn words(method: &Method) -> String {
    match method {
        Method::Nothing => "nothing".to_owned(),
        Method::Moments { orders, from_kappa } => {
            let plural = if *orders == 1 { "moment" } else { "moments" };
            format!("{orders} {plural} from κ {}", crate::number::number(*from_kappa))
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

/// A whole plan in words: how rough surfaces are made, and how the others.
pub fn sentence(explanation: &Explanation) -> String {
    let mut parts: Vec<&Candidate> = explanation.rough.iter().chain([&explanation.chosen]).collect();
    parts.dedup_by_key(|part| part.method);
    let mut used = parts.iter().filter(|part| part.method != Method::Nothing).map(|part| words(&part.method));
    let mut text = used.next().unwrap_or_else(|| "nothing".to_owned());
    for part in used {
        let _ = write!(text, ", below that {part}");
    }
    text
}
