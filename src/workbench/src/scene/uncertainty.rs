//! Uncertainties of figures of merit as they are written: the same in tables, figures and files.

use chromascope_core::query::metrics::{Better, UncertaintySource};
use chromascope_core::query::{CameraMetric, MetricUncertainty, MetricValue};
use chromascope_figure::{Cell, Column, Table};

use super::Scene;
use crate::format::{behind, decimals_by, rank_in_words, rounded, whole};

/// Heads of the columns that tell what uncertainties are.
const UNCERTAINTY_HEADS: [&str; 4] = ["uncertainty_source", "coverage_factor_95", "degrees_of_freedom", "extrapolated"];

/// Unit of a metric; empty for ratios and indices.
pub fn unit(metric: &CameraMetric) -> &'static str {
    if metric.unit == "1" { "" } else { metric.unit }
}

fn column(metric: &CameraMetric) -> Column {
    let better = match metric.better {
        Better::Lower => " Smaller is better.",
        Better::Higher => " Larger is better.",
        Better::Neither => "",
    };
    Column {
        hint: format!(
            "{}.{better} ± one standard uncertainty. Gray numbers do not differ from the selected camera's at 95 %.",
            metric.label
        ),
        group: metric.group.label().to_owned(),
        decimals: Some(metric.decimals),
        largest_first: metric.better == Better::Higher,
        shaded: metric.better != Better::Neither,
        uncertainty: format!("{}_uncertainty", metric.column),
        ..Column::quantity(metric.column, metric.symbol, unit(metric))
    }
}

/// A value with its uncertainty, or the reason that there is none.
pub fn cell(value: MetricValue) -> Cell {
    let number = match value.value {
        Ok(number) => number,
        Err(why) => return Cell::Missing(format!("{why}.")),
    };
    let Some(by) = value.uncertainty else { return number.into() };
    Cell::from(number).with(|note| {
        note.uncertainty = Some(by.standard);
        note.is_extrapolated = by.is_extrapolated;
    })
}

/// A rank; one that is not certain as a gray range.
pub fn rank_cell(rank: Option<[usize; 2]>) -> Cell {
    let Some([best, worst]) = rank else { return Cell::Empty };
    let cell = Cell::from(best as f64);
    if best == worst {
        return cell;
    }
    cell.with(|note| (note.words, note.is_gray) = (Some(rank_in_words(rank)), true))
}

/// A row for each name, a column for each metric.
pub fn table<'a>(
    names: (&str, impl IntoIterator<Item = &'a str>),
    metrics: &[CameraMetric],
    cell: impl Fn(usize, CameraMetric) -> Cell,
) -> Table {
    let mut table = Table::new(std::iter::once(Column::from(names.0)).chain(metrics.iter().map(column)));
    for (row, name) in names.1.into_iter().enumerate() {
        table.push(std::iter::once(name.into()).chain(metrics.iter().map(|metric| cell(row, *metric))));
    }
    table
}

/// The table with columns that tell what the uncertainties of a row are; extrapolated where any of them is.
pub fn with_nature<I: IntoIterator<Item = MetricUncertainty>>(mut table: Table, of: impl Fn(usize) -> I) -> Table {
    table.columns.extend(UNCERTAINTY_HEADS.map(Column::from));
    for (row, cells) in table.rows.iter_mut().enumerate() {
        cells.extend(nature(of(row)).map_or_else(Default::default, |(source, coverage, freedom, extrapolated)| {
            [source.word().into(), coverage.into(), freedom.into(), extrapolated.to_string().into()]
        }));
    }
    table
}

/// Source, coverage factor and degrees of freedom of uncertainties under the same conditions, and whether any is extrapolated; none
/// where there are none.
fn nature(of: impl IntoIterator<Item = MetricUncertainty>) -> Option<(UncertaintySource, f64, f64, bool)> {
    let mut of = of.into_iter();
    let first = of.next()?;
    let extrapolated = first.is_extrapolated || of.any(|next| next.is_extrapolated);
    Some((first.source, first.coverage, first.freedom, extrapolated))
}

/// Decimals of a value: those of its uncertainty, else the metric's.
fn decimals(metric: CameraMetric, value: MetricValue) -> i32 {
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
