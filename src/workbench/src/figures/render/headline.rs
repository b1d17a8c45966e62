//! Difference of a picture from the reference, in words.
//!
//! The headline is the difference of the material facing the light: one flat patch, the same for any mesh, view and exposure. A mean
//! over all lit samples would say how much of a picture is dark.

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::ColorTransformSpec;
use chromascope_core::query::render::difference::Difference;
use chromascope_core::query::render::picture::PicturesQuery;

use crate::format::fixed;
use crate::render_service::RenderedFrame;

/// Meaning of the numbers, for hints.
pub const MEANING: &str = "Facing the light: the flat material, or garment, under this light, as a patch. Median and 95 %: over the lit \
    samples whose L* in the reference is above 20.";
/// Meaning of a single number, for captions.
pub const SHORT_MEANING: &str = "Differences: of the flat material facing the light.";
/// Meaning of the numbers of a spectral image.
pub const IMAGE_MEANING: &str = "Mean, median, 95 % and maximum over all pixels with a value in every band.";

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// The number of the headline.
    Number,
    /// With its metric.
    Metric,
    /// With median and 95th percentile.
    Quantiles,
    /// With the largest as well.
    Largest,
}

/// Metric of pictures' differences, and whether they are of Eq 13 colors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measure {
    pub metric: Metric,
    pub by_eq_13: bool,
    pub of_image: bool,
}

impl Measure {
    /// Metric that pictures of a mesh are compared by.
    pub fn of(pictures: &PicturesQuery) -> Self {
        let by_eq_13 = matches!(pictures.reference.transform, ColorTransformSpec::Paper);
        Self { metric: pictures.metric, by_eq_13, of_image: false }
    }

    /// Metric that the pictures on show were compared by.
    pub fn of_frame(frame: &RenderedFrame) -> Self {
        let by_eq_13 = matches!(frame.query.reference().transform, ColorTransformSpec::Paper);
        Self { metric: frame.query.metric(), by_eq_13, of_image: frame.query.image().is_some() }
    }

    pub const fn meaning(self) -> &'static str {
        if self.of_image { IMAGE_MEANING } else { MEANING }
    }

    pub const fn short_meaning(self) -> &'static str {
        if self.of_image { "Differences: mean over all pixels." } else { SHORT_MEANING }
    }

    pub const fn name(self) -> &'static str {
        self.metric.name(self.by_eq_13)
    }

    /// Name where room is short.
    pub const fn short_name(self) -> &'static str {
        self.metric.short_name(self.by_eq_13)
    }

    /// A difference in words: single differences of pictures have a decimal less than those of patches.
    pub fn number(self, difference: f64) -> String {
        fixed(difference, self.metric.decimals.saturating_sub(1))
    }

    /// Difference of a picture in words: "no light" if nothing is lit; the quantiles are of samples that are bright enough.
    /// An image, which has no one material, is headed by its mean.
    pub fn words(self, difference: &Difference, detail: Detail) -> String {
        if difference.map.is_empty() {
            return "no light".to_owned();
        }
        let name = self.name();
        if self.of_image {
            let mean = self.number(difference.mean);
            return match detail {
                Detail::Number => format!("{} {mean}", self.short_name()),
                Detail::Metric => format!("{name} mean {mean}"),
                Detail::Quantiles | Detail::Largest => {
                    let [median, p95] = difference.bright.map_or([f64::NAN; 2], |all| [all.median, all.p95]);
                    let [median, p95, max] = [median, p95, difference.max].map(|value| self.number(value));
                    let rest = if detail == Detail::Largest { format!(", max {max}") } else { String::new() };
                    format!("{name} mean {mean}, median {median}, 95 % {p95}{rest}")
                }
            };
        }
        let facing = difference.facing.map_or_else(|| "undefined".to_owned(), |facing| self.number(facing));
        let quantiles = || {
            let rest = difference.bright.map_or_else(
                || "all other samples too dark".to_owned(),
                |bright| format!("median {}, 95 % {}", self.number(bright.median), self.number(bright.p95)),
            );
            let garment =
                difference.garment.map_or_else(String::new, |garment| format!(" (garment {})", self.number(garment)));
            format!("{name} {facing}{garment} facing light, {rest}")
        };
        match detail {
            Detail::Number => format!("{} {facing}", self.short_name()),
            Detail::Metric => format!("{name} {facing}"),
            Detail::Quantiles => quantiles(),
            Detail::Largest => format!("{}, max {}", quantiles(), self.number(difference.max)),
        }
    }
}
