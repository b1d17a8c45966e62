//! All that was measured in one run, as figures, a table and JSON.

use chromascope_figure::{Cell, Figure, Panel, Table};
use serde::{Deserialize, Serialize};

use crate::{Effort, Machine, Measurement, Workload, figure};

/// All that was measured in one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// By which program.
    pub program: String,
    /// Begin in UTC, as `2026-11-21T18:05:11Z`.
    pub began: String,
    /// On what.
    pub machine: Machine,
    /// Effort.
    pub effort: Effort,
    /// True if nothing stopped it.
    pub whole: bool,
    /// Measurements, workload by workload, case by case, the baseline of each case first.
    pub measurements: Vec<Measurement>,
}

/// A report that cannot be written down.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// It cannot be put as JSON.
    #[error("the measurements cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

impl Report {
    /// The measurements of a workload.
    pub fn of(&self, workload: Workload) -> impl Iterator<Item = &Measurement> {
        self.measurements.iter().filter(move |measurement| measurement.workload == workload)
    }

    /// The workloads that were measured, in order.
    pub fn workloads(&self) -> Vec<Workload> {
        let mut found: Vec<Workload> = Vec::new();
        for measurement in &self.measurements {
            if !found.contains(&measurement.workload) {
                found.push(measurement.workload);
            }
        }
        found
    }

    /// The run time of a workload's methods against their error; none if it was not measured.
    pub fn figure(&self, workload: Workload) -> Option<Figure> {
        figure::figure(self, workload, figure::PANEL)
    }

    /// That figure in a width in points.
    pub fn figure_within(&self, workload: Workload, width: f64) -> Option<Figure> {
        figure::figure_within(self, workload, width)
    }

    /// The panels of that figure for areas of a size in points.
    pub fn panels(&self, workload: Workload, size: [f64; 2]) -> Vec<Panel> {
        figure::figure(self, workload, size).map_or_else(Vec::new, |figure| figure.panels)
    }

    /// All measurements as a table, a row for each.
    pub fn table(&self) -> Table {
        table(self, self.measurements.iter())
    }

    /// The report as JSON, indented.
    ///
    /// # Errors
    /// [`ReportError`] if a value has no JSON form.
    pub fn to_json(&self) -> Result<String, ReportError> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }
}

/// Measurements of a report as a table, each row with what and when it was measured on.
pub(crate) fn table<'a>(report: &Report, measurements: impl Iterator<Item = &'a Measurement>) -> Table {
    let columns = "workload; case; method; threads; item; items; rounds; time per item (s); \
                   shortest time per item (s); spread (quartiles / median); time to build (s); error of; \
                   max abs error; rms abs error; max rel error; rms rel error; checked; refused; baseline; \
                   time / baseline; share of memory limit; share of arithmetic limit; machine; program; began";
    let machine = report.machine.to_string();
    let mut table = Table::new(columns.split("; "));
    for m in measurements {
        let count = |number: usize| Cell::from(number as f64);
        table.push([
            Cell::from(m.workload.name()),
            Cell::from(m.case.as_str()),
            Cell::from(m.method.as_str()),
            count(m.threads),
            Cell::from(m.item.as_str()),
            count(m.items),
            count(m.rounds),
            Cell::from(m.seconds_per_item),
            Cell::from(m.least_seconds_per_item),
            Cell::from(m.spread),
            Cell::from(m.build_seconds),
            Cell::from(m.error.what.as_str()),
            Cell::from(m.error.max_abs),
            Cell::from(m.error.rms_abs),
            Cell::from(m.error.max_rel),
            Cell::from(m.error.rms_rel),
            count(m.error.checked),
            count(m.error.refused),
            Cell::from(m.baseline.as_str()),
            Cell::from(m.ratio),
            Cell::from(m.roof.map(|roof| roof.memory)),
            Cell::from(m.roof.map(|roof| roof.arithmetic)),
            Cell::from(machine.as_str()),
            Cell::from(report.program.as_str()),
            Cell::from(report.began.as_str()),
        ]);
    }
    table
}
