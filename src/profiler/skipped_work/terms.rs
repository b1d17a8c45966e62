//! The terms of S that closed forms, tables and strides spare: a plain sum adds them here.

use std::hint::black_box;

use chromascope_core::reflectance::series_terms;
use chromascope_core::render::Quality;
use chromascope_measure::harness::shortest;
use chromascope_measure::pareto::duration;

use super::{SUMS, SkippedWork, Sources, measured_on, some_of};

/// Maximum total number of terms added: the time of a term is known by then.
const AT_MOST: f64 = 5e6;

/// The terms of plain sums at the wavelengths that a lit sample's integral uses. `None` for the paper's cases, which add at
/// most ten.
pub(super) fn terms(sources: &Sources<'_>) -> Option<SkippedWork> {
    let quality = sources.pictures.shading.quality;
    let lit = sources.lit();
    let taken = some_of(&lit, SUMS);
    if taken.is_empty() || sources.plans.is_empty() || quality == Quality::Regimes {
        return None;
    }
    let (mut all, mut added, mut arguments, mut wavelengths) = (0.0, 0.0, Vec::new(), 0);
    for plans in &sources.plans {
        let nodes = plans.nodes();
        wavelengths = wavelengths.max(nodes.len());
        for shade in &taken {
            let sums = plans.sums(shade);
            for node in &nodes {
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
    let seconds = shortest(sum);
    let of_a_term = seconds / arguments.iter().map(|[_, _, last]| last.min(budget).floor()).sum::<f64>().max(1.0);
    let counted = if added > 0.0 { "; where sums are made, those that matter count as added" } else { "" };
    let now: f64 = sources.plans.iter().map(|plans| plans.seconds(&taken)).sum();
    let scale = lit.len() as f64 / taken.len() as f64;
    let places = sources.places();
    Some(SkippedWork {
        what: format!("terms of S at a lit {}", sources.place()).into(),
        count: ((all - added) * scale) as u64,
        of: Some((all * scale) as u64),
        saved: ((of_a_term * all - now) * scale).max(0.0),
        how: format!(
            "plain sums up to the last term that matters at 1e-13, {} a term, at the {wavelengths} wavelengths that integrals \
             rest on, less what they cost now{counted}; {}, one thread",
            duration(of_a_term),
            measured_on(taken.len(), lit.len(), places),
        ),
    })
}

/// `e^-g Σ gⁿ/(n! n) e^(-b/n)` from the first term to the last, each weight from the one before.
fn plain_sum(g: f64, b: f64, last: u64) -> f64 {
    // The exponential is evaluated in parts; otherwise large g would underflow to 0.
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
