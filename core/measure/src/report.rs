//! All that was measured in one run, as figures, a table and JSON.

use crate::machine::Machine;
use crate::pareto::{self, Place};
use crate::workload::{Effort, Measurement, Workload};
use chromascope_figure::{Field, Figure, InkRole, LegendEntry, LegendPlace, Marker, Panel, Rect, Table, Tag};
use serde::{Deserialize, Serialize};

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
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum ReportError {
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
        self.measurements.chunk_by(|a, b| a.workload == b.workload).map(|of_one| of_one[0].workload).collect()
    }

    /// The run time of a workload's methods against their error, a panel for each case: down and to the left is better. None if it
    /// was not measured. The marks' tags are the places of measurements among those of the workload, from 1.
    pub fn figure(&self, workload: Workload) -> Option<Figure> {
        self.sized(workload, PANEL)
    }

    /// That figure in a width in points, with as many panels side by side as stay readable.
    pub fn figure_within(&self, workload: Workload, width: f64) -> Option<Figure> {
        let cases = self.cases(workload);
        let across = ((width / LEAST_WIDTH) as usize).clamp(1, cases.len().max(1));
        let side = width / across as f64;
        self.arranged(workload, &cases, [side, side * PANEL[1] / PANEL[0]], across)
    }

    /// The panels of that figure for areas of a size in points.
    pub fn panels(&self, workload: Workload, size: [f64; 2]) -> Vec<Panel> {
        self.sized(workload, size).map_or_else(Vec::new, |figure| figure.panels)
    }

    fn sized(&self, workload: Workload, size: [f64; 2]) -> Option<Figure> {
        let cases = self.cases(workload);
        let across = if cases.len() < MANY { ACROSS.min(cases.len()) } else { ACROSS_OF_MANY };
        self.arranged(workload, &cases, size, across)
    }

    /// Measurements with a place, by case.
    fn cases(&self, workload: Workload) -> Vec<Vec<Numbered<'_>>> {
        // What gives none of the values has no error, and so no place.
        let placed: Vec<_> = self.of(workload).enumerate().filter(|(_, m)| m.error.checked > 0).collect();
        placed.chunk_by(|a, b| a.1.case == b.1.case).map(<[_]>::to_vec).collect()
    }

    fn arranged(
        &self,
        workload: Workload,
        cases: &[Vec<Numbered<'_>>],
        size: [f64; 2],
        across: usize,
    ) -> Option<Figure> {
        let what = &cases.first()?[0].1.error.what;
        let down = cases.len().div_ceil(across);
        let mut figure = Figure::new(workload.label(), [size[0] * across as f64, size[1] * down as f64]);
        for (index, case) in cases.iter().enumerate() {
            let corner = [size[0] * (index % across) as f64, size[1] * (index / across) as f64];
            figure.panels.push(panel(case, Rect::from_min_size(corner, size)));
        }
        let threads = self.of(workload).map(|m| m.threads).collect::<std::collections::BTreeSet<_>>();
        figure.legend = threads.iter().map(|&threads| entry(threads)).collect();
        figure.legend_place = LegendPlace::Outside;
        figure.caption = format!(
            "Median time per item against the largest error of {what}; the line joins methods that no other surpasses in \
             both. {}; {}, {}.",
            self.machine, self.program, self.began
        );
        figure.table = self.table_of(self.of(workload));
        Some(figure)
    }

    /// All measurements as a table, a row for each.
    pub fn table(&self) -> Table {
        self.table_of(self.measurements.iter())
    }

    /// Measurements as a table, each row with what and when it was measured on.
    fn table_of<'a>(&self, measurements: impl Iterator<Item = &'a Measurement>) -> Table {
        let constants = [("machine", self.machine.to_string()), ("program", self.program.clone())];
        Table::of(&COLUMNS, measurements).with_constants(constants).with_constants([("began", self.began.clone())])
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
    Field::new("workload", |m| m.workload.key().into()),
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

/// The size of a panel on paper, in points.
const PANEL: [f64; 2] = [420.0, 320.0];
/// Panels side by side, and where there are many.
const ACROSS: usize = 2;
/// Width in points below which a panel is hard to read.
const LEAST_WIDTH: f64 = 300.0;
const ACROSS_OF_MANY: usize = 3;
const MANY: usize = 7;
/// Markers for 1, 2, 4 and more threads: distinct from those of cameras, so without their colors, and with those of the
/// first three last.
const MARKERS: [Marker; 8] = [
    Marker::Diamond,
    Marker::TriangleDown,
    Marker::Hexagon,
    Marker::TriangleRight,
    Marker::TriangleLeft,
    Marker::Circle,
    Marker::Square,
    Marker::TriangleUp,
];
/// A measurement with its place among those of its workload.
type Numbered<'a> = (usize, &'a Measurement);

fn entry(threads: usize) -> LegendEntry {
    let (marker, role) = look(threads);
    let name = if threads == 1 { "1 thread".to_owned() } else { format!("{threads} threads") };
    LegendEntry { name, stroke: None, marker: Some(marker), fill: Some(role.into()) }
}

fn look(threads: usize) -> (Marker, InkRole) {
    let slot = threads.max(1).ilog2() as usize;
    (MARKERS[slot % MARKERS.len()], if slot.is_multiple_of(2) { InkRole::Text } else { InkRole::Weak })
}

fn panel(case: &[Numbered<'_>], area: Rect) -> Panel {
    let place = |(index, measurement): &Numbered<'_>| {
        let (marker, role) = look(measurement.threads);
        let (name, tag) = (measurement.method.clone(), Tag(u32::try_from(index + 1).unwrap_or(u32::MAX)));
        Place { name, tag, error: measurement.error.max(), seconds: measurement.seconds_per_item, marker, role }
    };
    let places: Vec<Place> = case.iter().map(place).collect();
    let labels = [format!("error of {}", short(&case[0].1.error.what)), format!("time per {}", case[0].1.item)];
    let name = &case[0].1.case;
    pareto::panel(name, labels.each_ref().map(String::as_str), name.clone(), &places, area)
}

/// Part of a name before the first comma, semicolon or parenthesis: the rest is in the table.
fn short(what: &str) -> &str {
    what.split([',', '(', ';']).next().unwrap_or(what).trim_end()
}

/// Program and version.
pub fn program() -> String {
    concat!("Chromascope ", env!("CARGO_PKG_VERSION")).to_owned()
}
