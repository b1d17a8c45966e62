//! All that was measured in one run, as figures, a table and JSON.

use chromascope_figure::{Field, Figure, Panel, Table};
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

const COLUMNS: [Field<Measurement>; 22] = [
    Field::new("workload", |m| m.workload.name().into()),
    Field::new("case", |m| m.case.as_str().into()),
    Field::new("method", |m| m.method.as_str().into()),
    Field::new("threads", |m| (m.threads as f64).into()),
    Field::new("item", |m| m.item.as_str().into()),
    Field::new("items", |m| (m.items as f64).into()),
    Field::new("rounds", |m| (m.rounds as f64).into()),
    Field::quantity(["time per item (s)", "time per item", "s"], |m| m.seconds_per_item.into()),
    Field::quantity(["shortest time per item (s)", "shortest time per item", "s"], |m| m.least_seconds_per_item.into()),
    Field::quantity(["spread (quartiles / median)", "spread", "quartiles / median"], |m| m.spread.into()),
    Field::quantity(["time to build (s)", "time to build", "s"], |m| m.build_seconds.into()),
    Field::new("error of", |m| m.error.what.as_str().into()),
    Field::new("max abs error", |m| m.error.max_abs.into()),
    Field::new("rms abs error", |m| m.error.rms_abs.into()),
    Field::new("max rel error", |m| m.error.max_rel.into()),
    Field::new("rms rel error", |m| m.error.rms_rel.into()),
    Field::new("checked", |m| (m.error.checked as f64).into()),
    Field::new("refused", |m| (m.error.refused as f64).into()),
    Field::new("baseline", |m| m.baseline.as_str().into()),
    Field::new("time / baseline", |m| m.ratio.into()),
    Field::new("share of memory limit", |m| m.roof.map(|roof| roof.memory).into()),
    Field::new("share of arithmetic limit", |m| m.roof.map(|roof| roof.arithmetic).into()),
];

/// Measurements of a report as a table, each row with what and when it was measured on.
pub(crate) fn table<'a>(report: &Report, measurements: impl Iterator<Item = &'a Measurement>) -> Table {
    let constants = [("machine", report.machine.to_string()), ("program", report.program.clone())];
    Table::of(&COLUMNS, measurements).with_constants(constants).with_constants([("began", report.began.clone())])
}
