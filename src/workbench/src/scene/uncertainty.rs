//! Uncertainties of figures of merit as they are written: the same in tables, figures and files.

use std::sync::Arc;

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::Ask as _;
use chromascope_core::query::Shared;
use chromascope_core::query::metrics::{Better, OwnUncertainties, UncertaintySource};
use chromascope_core::query::{CameraMetric, CameraMetrics, MetricUncertainty, MetricValue};
use chromascope_core::spectral::{Correlation, Sensor, StatedUncertainty};
use chromascope_figure::{Cell, Column, Table};

use super::{Result, Scene};
use crate::catalog::Entry;
use crate::catalog::load::{Stated, StatedQuery};
use crate::document::{Light, SetKind};
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
pub fn table(
    names: (&str, impl IntoIterator<Item: Into<Cell>>),
    metrics: &[CameraMetric],
    cell: impl Fn(usize, CameraMetric) -> Cell,
) -> Table {
    let mut table = Table::new(std::iter::once(Column::from(names.0)).chain(metrics.iter().map(column)));
    for (row, name) in names.1.into_iter().enumerate() {
        table.push(std::iter::once(name.into()).chain(metrics.iter().map(|metric| cell(row, *metric))));
    }
    table
}

/// Inserts columns with the patch of each row that differs most by a metric, and its difference or the reason for none.
pub fn insert_worst<'a>(
    table: &mut Table,
    at: usize,
    (metric, patches): (Metric, &[String]),
    rows: impl Iterator<Item = Option<&'a CameraMetrics>>,
) {
    let place = Metric::ALL.iter().position(|known| *known == metric).unwrap_or(0);
    let worst = |metrics: Option<&CameraMetrics>| {
        let Some(metrics) = metrics else { return [Cell::Empty, Cell::Empty] };
        let Some(&patch) = metrics.worst.get(place).and_then(|worst| worst.first()) else {
            let why = metrics.patches.first().and_then(|patch| patch.by_metric.get(place)?.err());
            return [Cell::Empty, why.map_or(Cell::Empty, |why| Cell::Missing(why.to_string()))];
        };
        let difference = metrics.patches[patch].by_metric[place].ok();
        [patches.get(patch).map_or(Cell::Empty, |name| name.as_str().into()), difference.into()]
    };
    let (names, values): (Vec<Cell>, Vec<Cell>) = rows.map(worst).map(|[name, value]| (name, value)).unzip();
    table.insert(at, Column::quantity("worst_patch", "worst patch", ""), names);
    let [key, symbol] = [metric.column, metric.symbol].map(|name| ["worst ", name].concat());
    let column = Column::quantity(key.replace(' ', "_"), symbol, "");
    table.insert(at + 1, Column { decimals: Some(metric.decimals), ..column }, values);
}

/// The table with columns that tell what the uncertainties of a row are; extrapolated where any of them is.
pub fn with_nature<I: IntoIterator<Item = MetricUncertainty>>(mut table: Table, of: impl Fn(usize) -> I) -> Table {
    table.columns.extend(UNCERTAINTY_HEADS.map(Column::from));
    for (row, cells) in table.rows.iter_mut().enumerate() {
        cells.extend(nature(of(row)).map_or_else(Default::default, |(source, coverage, freedom, extrapolated)| {
            let freedom = if freedom.is_finite() { freedom.into() } else { "inf".into() };
            [source.into(), coverage.into(), freedom, extrapolated.to_string().into()]
        }));
    }
    table
}

/// Sources of uncertainties, their largest coverage factor and fewest degrees of freedom, and whether any is extrapolated; none where
/// there are none.
fn nature(of: impl IntoIterator<Item = MetricUncertainty>) -> Option<(String, f64, f64, bool)> {
    let (mut sources, mut found): (Vec<&str>, Option<(f64, f64, bool)>) = (Vec::new(), None);
    for by in of {
        if !sources.contains(&by.source.word()) {
            sources.push(by.source.word());
        }
        let (coverage, freedom, extrapolated) = found.unwrap_or((0.0, f64::INFINITY, false));
        let extrapolated = extrapolated || by.is_extrapolated;
        found = Some((by.coverage.max(coverage), by.freedom.min(freedom), extrapolated));
    }
    found.map(|(coverage, freedom, extrapolated)| (sources.join(" and "), coverage, freedom, extrapolated))
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

/// What ± is, in sentences: origin, coverage factor and degrees of freedom of each kind, and the dagger where one stands.
pub fn in_words(of: impl IntoIterator<Item = MetricUncertainty>) -> String {
    let (prior, own): (Vec<_>, Vec<_>) = of.into_iter().partition(|by| by.source == UncertaintySource::Prior);
    let interval = |of: &[MetricUncertainty]| {
        let (_, coverage, freedom, _) = nature(of.iter().copied())?;
        let freedom = if freedom.is_finite() { format!("{freedom:.0}") } else { "∞".to_owned() };
        Some(format!("95 %: ± {coverage:.2} u, {freedom} degrees of freedom"))
    };
    let is_decided = own.iter().all(|by| by.source == UncertaintySource::Own(Correlation::Stated));
    let correlation =
        if is_decided { "with its covariance" } else { "uncorrelated or fully correlated, whichever gives more" };
    let of_prior = "prior: the spread of tables between laboratories";
    let of_own = format!("own: as the camera's file states it, {correlation}");
    let kinds = match (interval(&prior), interval(&own)) {
        (None, None) => return String::new(),
        (Some(prior), None) => format!("({of_prior}); {prior}."),
        (None, Some(own)) => format!("({of_own}); {own}."),
        (Some(prior), Some(own)) => format!("({of_own}; {own}. Without: {of_prior}; {prior})."),
    };
    let any = |is: fn(&MetricUncertainty) -> bool| prior.iter().chain(&own).any(is);
    let light = if any(|by| by.contributions.light > 0.0) { " and the light" } else { "" };
    let patches = if any(|by| by.contributions.patches > 0.0) { " and the patches" } else { "" };
    let dagger = match any(|by| by.is_extrapolated) {
        false => "",
        true if prior.is_empty() => " † Extrapolated: the camera's table does not reach over 400–700 nm.",
        true => {
            " † Extrapolated: the sensor is unlike the models of the prior, or the metric uses more than 400–700 nm."
        }
    };
    format!("±: standard uncertainty u by the sensitivities{light}{patches} {kinds}{dagger}")
}

impl Scene<'_> {
    /// Conditions of figures of merit and what ± is, in sentences.
    pub fn metrics_words_with(
        &self,
        metrics: &[CameraMetric],
        of: impl IntoIterator<Item = MetricUncertainty>,
    ) -> String {
        format!("{} {}", self.metrics_words(metrics), in_words(of)).trim().to_owned()
    }

    /// Uncertainties that the files of the light and the chart state; the camera's is not among them.
    pub(super) fn own_uncertainties(&self) -> Result<OwnUncertainties> {
        Ok(OwnUncertainties { camera: None, light: self.light()?.stated, patches: self.stated_of_chart() })
    }

    /// Uncertainty of the patches that are compared, where their file states one.
    pub fn stated_of_chart(&self) -> Option<Shared<StatedUncertainty>> {
        let place = self.find_chart(&self.document.chart).ok()?.place.clone();
        self.results.ask(&StatedQuery { place, names: self.subset() }).uncertainty.clone()
    }

    /// Uncertainty of a sensor's curves per unit energy, where its file states one.
    pub fn stated_of_sensor(&self, kind: SetKind, name: &str, sensor: &Sensor) -> Option<StatedUncertainty> {
        let place = self.entry(kind, name).ok()?.place;
        let stated = self.results.ask(&StatedQuery { place, names: None }).uncertainty.clone()?;
        stated.per_energy(sensor)
    }

    /// Sentences on uncertainties that files of the light, the chart and some cameras state, and that are not used.
    pub fn refused_uncertainties<'a>(&self, cameras: impl IntoIterator<Item = &'a str>) -> Vec<String> {
        let light = match &self.document.light {
            Light::Set(name) => self.entry(SetKind::Illuminant, name).ok(),
            _ => None,
        };
        let cameras = cameras.into_iter().filter_map(|name| self.entry(SetKind::Camera, name).ok());
        let entries: Vec<Entry> =
            light.into_iter().chain(self.chart_entry(&self.document.chart)).chain(cameras).collect();
        let query = |entry: &Entry| StatedQuery { place: entry.place.clone(), names: None };
        let sentence = |(entry, stated): (&Entry, Arc<Stated>)| {
            let instead = match stated.uncertainty {
                Some(_) => "Its uncertainties are used without",
                None => "No uncertainty of its own is used",
            };
            stated.refused.as_ref().map(|refused| format!("{}: {refused}. {instead}.", entry.name))
        };
        let stated = self.results.ask_all(&entries.iter().map(query).collect::<Vec<_>>());
        entries.iter().zip(stated).filter_map(sentence).collect()
    }
}
