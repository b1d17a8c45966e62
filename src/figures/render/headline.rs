//! How far a picture is from the reference, in words.
//!
//! The headline is the difference of the material facing the light: one flat patch, the same for any mesh, view and exposure. A mean
//! over all lit samples would say how much of a picture is dark.

use chromascope_core::query::render::Difference;

use crate::document::{DifferenceChoice, Document};
use crate::widgets::lines::fixed;

/// What the numbers mean, for hints.
pub const MEANING: &str = "Facing the light: the flat material under this light, as a patch. Median and 95 %: over the \
                           lit samples whose L* in the reference is above 20.";

/// How much is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// The number of the headline.
    Number,
    /// With its measure.
    SpectralWeights,
    /// With median and 95th percentile.
    Quantiles,
    /// With the largest as well.
    Largest,
}

/// The measure of pictures' differences, by the name it has under a document's color transform.
pub fn measure(document: &Document) -> &'static str {
    DifferenceChoice::DeltaE2000.name_under(&document.transform)
}

/// The difference of a picture in words: "no light" where nothing is lit; the quantiles are of samples that are bright enough to judge.
pub fn words(difference: &Difference, measure: &str, detail: Detail) -> String {
    if difference.map.is_empty() {
        return "no light".to_owned();
    }
    let short = measure.split(['E', ' ']).next().unwrap_or(measure);
    let facing = difference.facing.map_or_else(|| "undefined".to_owned(), |facing| fixed(facing, 1));
    let quantiles = || {
        let rest = difference.bright.map_or_else(
            || "all other samples too dark".to_owned(),
            |bright| format!("median {}, 95 % {}", fixed(bright.median, 1), fixed(bright.p95, 1)),
        );
        format!("{measure} {facing} facing light, {rest}")
    };
    match detail {
        Detail::Number if measure.starts_with("ΔE") => format!("{short}E {facing}"),
        Detail::Number => format!("{short} {facing}"),
        Detail::SpectralWeights => format!("{measure} {facing}"),
        Detail::Quantiles => quantiles(),
        Detail::Largest => format!("{}, max {}", quantiles(), fixed(difference.max, 1)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chromascope_core::query::render::BrightSamples;

    #[test]
    fn a_picture_without_light_has_no_difference() {
        let bright = Some(BrightSamples { count: 2, median: 2.0, p95: 4.0 });
        let some = Difference { stride: 1, map: vec![1.0; 3], mean: 1.0, max: 5.0, facing: Some(3.12), bright };
        let said = [Detail::Number, Detail::SpectralWeights, Detail::Quantiles, Detail::Largest];
        assert_eq!(
            said.map(|detail| words(&some, "ΔE*00", detail)),
            [
                "ΔE 3.1",
                "ΔE*00 3.1",
                "ΔE*00 3.1 facing light, median 2.0, 95 % 4.0",
                "ΔE*00 3.1 facing light, median 2.0, 95 % 4.0, max 5.0"
            ]
        );
        assert_eq!(words(&some, "Δ of Eq 13 colors", Detail::Number), "Δ 3.1");
        let dark = Difference { bright: None, ..some.clone() };
        let unlit = Difference { map: Vec::new(), mean: 0.0, max: 0.0, ..dark.clone() };
        assert_eq!(words(&dark, "ΔE*00", Detail::Number), "ΔE 3.1");
        let whole = words(&dark, "ΔE*00", Detail::Quantiles);
        assert_eq!(whole, "ΔE*00 3.1 facing light, all other samples too dark");
        assert!(said.iter().all(|&detail| words(&unlit, "ΔE*00", detail) == "no light"));
    }

    #[test]
    fn under_eq_13_it_is_no_delta_e() {
        assert_eq!(measure(&Document::colorimetry()), "ΔE*00");
        assert_eq!(measure(&Document::paper()), "Δ of Eq 13 colors");
    }
}
