//! Uncertainties of figures of merit as they are written: the same in tables, figures and files.

use chromascope_core::query::metrics::UncertaintySource;
use chromascope_core::query::{CameraMetric, MetricUncertainty, MetricValue};

use super::Scene;
use crate::format::{behind, decimals_by, rounded, whole};

/// Heads of the columns that tell what uncertainties are.
pub const UNCERTAINTY_HEADS: [&str; 4] =
    ["uncertainty_source", "coverage_factor_95", "degrees_of_freedom", "extrapolated"];

/// Source, coverage factor and degrees of freedom of uncertainties under the same conditions, and whether any is extrapolated; none
/// where there are none.
pub fn nature(of: impl IntoIterator<Item = MetricUncertainty>) -> Option<(UncertaintySource, f64, f64, bool)> {
    let mut of = of.into_iter();
    let first = of.next()?;
    let extrapolated = first.is_extrapolated || of.any(|next| next.is_extrapolated);
    Some((first.source, first.coverage, first.freedom, extrapolated))
}

/// Decimals of a value: those of its uncertainty, else the metric's.
pub fn decimals(metric: CameraMetric, value: MetricValue) -> i32 {
    value.uncertainty.and_then(|by| decimals_by(by.standard)).unwrap_or(whole(metric.decimals))
}

pub fn number(metric: CameraMetric, value: MetricValue) -> String {
    value.value.map_or_else(|_| "–".to_owned(), |number| rounded(number, decimals(metric, value)))
}

/// The uncertainty behind a value: `± 0.12`, with a dagger where it is extrapolated.
pub fn uncertainty(value: MetricValue) -> Option<String> {
    value.uncertainty.and_then(|by| behind(by.standard, by.is_extrapolated))
}

/// What ± is, in sentences: coverage factor, degrees of freedom, origin, and the dagger where one stands.
pub fn in_words(of: impl IntoIterator<Item = MetricUncertainty> + Clone) -> String {
    let Some((_, coverage, freedom, extrapolated)) = nature(of.clone()) else { return String::new() };
    let is_prior = of.into_iter().all(|by| by.source == UncertaintySource::Prior);
    let origin = if is_prior {
        "prior: the spread of tables between laboratories"
    } else {
        "own where the camera's file states it, otherwise prior"
    };
    let dagger = if extrapolated {
        " † Extrapolated: the sensor is unlike the models of the prior, or the metric uses more than 400–700 nm."
    } else {
        ""
    };
    format!(
        "±: standard uncertainty u by the sensitivities ({origin}); 95 %: ± {coverage:.2} u, {freedom:.0} degrees of freedom.{dagger}"
    )
}

impl Scene<'_> {
    /// Conditions of figures of merit and what ± is, in sentences.
    pub fn metrics_words_with(&self, of: impl IntoIterator<Item = MetricUncertainty> + Clone) -> String {
        format!("{} {}", self.metrics_words(), in_words(of)).trim_end().to_owned()
    }
}
