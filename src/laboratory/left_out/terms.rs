//! The terms of S that closed forms, tables and strides spare: a plain sum adds them here.

use std::hint::black_box;

use chromascope_core::query::Ask;
use chromascope_core::query::render::PlanOf;
use chromascope_core::reflectance::series_terms;
use chromascope_core::render::measure::Node;
use chromascope_core::render::plan::Method;
use chromascope_core::render::shading::{Shade, Way};
use chromascope_core::render::{Against, Measure, Quality};

use super::{LeftOut, SUMS, Sources};
use crate::figures::pareto::duration;
use crate::laboratory::stopwatch::once;

/// At most so many terms of all sums together are added: the time of a term is known by then.
const AT_MOST: f64 = 5e6;

/// The terms of plain sums at the wavelengths that a lit sample's integral rests on. None where the paper's cases are asked
/// for, which add ten at most whatever matters.
pub(super) fn terms(sources: &Sources<'_>, each: f64, ask: &impl Ask) -> Option<LeftOut> {
    let quality = sources.pictures.shading.quality;
    let shades = sources.shading.shades().iter();
    let lit: Vec<&Shade> = shades.filter(|shade| !matches!(shade.way, Way::Dark | Way::Flat)).collect();
    let taken: Vec<&Shade> = lit.iter().step_by(lit.len().div_ceil(SUMS).max(1)).copied().collect();
    if taken.is_empty() || quality == Quality::Regimes {
        return None;
    }
    let sums_from = sums_from(sources, ask);
    let (mut all, mut added, mut arguments) = (0.0, 0.0, Vec::new());
    for (measure, sums_from) in sources.measures().zip(sums_from) {
        let nodes = nodes(measure, quality);
        for shade in &taken {
            let sums = match shade.way {
                Way::Sum => true,
                Way::Planned => shade.kappa < sums_from,
                _ => false,
            };
            for node in nodes {
                let [g, b] = [shade.kappa * node.scale, shade.beta * shade.kappa * node.scale];
                let terms = series_terms(g, b);
                all += terms.last;
                added += if sums { terms.weighing } else { 0.0 };
                arguments.push([g, b, terms.last]);
            }
        }
    }
    let budget = (AT_MOST / arguments.len() as f64).max(10.0);
    let sum = || arguments.iter().map(|&[g, b, last]| plain_sum(g, b, last.min(budget) as u64)).sum::<f64>();
    let (_, seconds) = once(sum);
    let of_a_term = seconds / arguments.iter().map(|[_, _, last]| last.min(budget).floor()).sum::<f64>().max(1.0);
    let counted = if added > 0.0 { "; where sums are made, those that matter count as added" } else { "" };
    let scale = lit.len() as f64 / taken.len() as f64;
    Some(LeftOut {
        what: "terms of S at a lit sample".into(),
        count: ((all - added) * scale) as u64,
        of: Some((all * scale) as u64),
        saved: (of_a_term * all * scale - each * lit.len() as f64).max(0.0),
        how: format!(
            "plain sums up to the last that matters at 1e-13, {} a term, at {} wavelengths of {} samples, less what they \
             cost now{counted}",
            duration(of_a_term),
            sources.measures().map(|measure| nodes(measure, quality).len()).max().unwrap_or(0),
            taken.len(),
        ),
    })
}

/// The wavelengths that integrals of this quality rest on.
fn nodes(measure: &Measure, quality: Quality) -> &[Node] {
    match quality {
        Quality::Exact | Quality::Regimes => measure.dense(),
        Quality::Fine => measure.fine(),
        Quality::Preview | Quality::Full | Quality::Within(_) => measure.coarse(),
    }
}

/// Per source the κ below which its plan makes sums: 0 where it makes none.
fn sums_from(sources: &Sources<'_>, ask: &impl Ask) -> Vec<f64> {
    let wanted = sources.shading.demand().zip(sources.shading.plan_accuracy());
    let of = |(source, measure): (&_, &std::sync::Arc<Result<Measure, _>>)| {
        (**measure).as_ref().ok()?;
        let Some((demand, accuracy)) = wanted else { return Some(0.0) };
        let measure = sources.pictures.image(source).measure;
        let plan = ask.ask(&PlanOf { measure, accuracy, against: Against::Peak, demand });
        let Ok(plan) = &*plan else { return Some(0.0) };
        let explanation = plan.explanation();
        let sums = |method| matches!(method, Method::Shared { .. } | Method::Own { .. } | Method::Every { .. });
        let rough = explanation.rough.as_ref().map_or(f64::INFINITY, |rough| match rough.method {
            Method::Moments { from_kappa, .. } => from_kappa,
            _ => f64::INFINITY,
        });
        Some(if sums(explanation.chosen.method) { rough } else { 0.0 })
    };
    let renderings = sources.pictures.sources.iter().map(|source| &source.rendering);
    renderings.zip(&sources.measures).filter_map(of).collect()
}

/// `e^-g Σ gⁿ/(n! n) e^(-b/n)` from the first term to the last, each weight from the one before.
fn plain_sum(g: f64, b: f64, last: u64) -> f64 {
    // The exponential is taken in parts, or large g would begin with 0.
    const PART: f64 = 200.0;
    let (mut weight, mut rest, mut sum) = (1.0, g, 0.0);
    for n in (1..=last).map(|n| n as f64) {
        weight *= g / n;
        while weight > 1e100 && rest > PART {
            weight *= (-PART).exp();
            sum *= (-PART).exp();
            rest -= PART;
        }
        sum += weight / n * (-b / n).exp();
    }
    black_box(sum * (-rest).exp())
}

#[cfg(test)]
mod tests {
    use chromascope_core::reflectance::{Precision, diffuse_sum};

    use super::*;

    #[test]
    fn a_plain_sum_to_the_last_term_is_the_sum() {
        for (g, b) in [(1e-6, 0.0), (0.5, 3.0), (10.0, 200.0), (500.0, 100.0), (3000.0, 0.0)] {
            let exact = diffuse_sum(g, b, Precision::Full);
            let off = plain_sum(g, b, series_terms(g, b).last as u64) / exact - 1.0;
            assert!(off.abs() < 1e-12, "g {g}, b {b}: {off:e}");
        }
    }
}
