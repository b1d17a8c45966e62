//! Run time against error, a panel for each case: down and to the left is better.

use chromascope_figure::{Figure, InkRole, LegendEntry, LegendPlace, Marker, Panel, Rect, Tag};

use crate::pareto::{self, Place};
use crate::report::table;
use crate::{Measurement, Report, Workload};

/// The size of a panel on paper, in points.
pub(crate) const PANEL: [f64; 2] = [420.0, 320.0];
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

/// The figure of a workload with panels of a size. The marks' tags are the places of measurements among those of the workload, from 1.
pub(crate) fn figure(report: &Report, workload: Workload, size: [f64; 2]) -> Option<Figure> {
    let cases = cases(report, workload);
    let across = if cases.len() < MANY { ACROSS.min(cases.len()) } else { ACROSS_OF_MANY };
    arranged(report, workload, &cases, (size, across))
}

/// The figure of a workload in a width in points, with as many panels side by side as stay readable.
pub(crate) fn figure_within(report: &Report, workload: Workload, width: f64) -> Option<Figure> {
    let cases = cases(report, workload);
    let across = ((width / LEAST_WIDTH) as usize).clamp(1, cases.len().max(1));
    let side = width / across as f64;
    arranged(report, workload, &cases, ([side, side * PANEL[1] / PANEL[0]], across))
}

/// Measurements with a place, by case.
fn cases(report: &Report, workload: Workload) -> Vec<Vec<Numbered<'_>>> {
    let mut cases: Vec<Vec<Numbered<'_>>> = Vec::new();
    // What gives none of the values has no error, and so no place.
    for numbered in report.of(workload).enumerate().filter(|(_, measurement)| measurement.error.checked > 0) {
        match cases.iter_mut().find(|case| case[0].1.case == numbered.1.case) {
            Some(case) => case.push(numbered),
            None => cases.push(vec![numbered]),
        }
    }
    cases
}

fn arranged(
    report: &Report,
    workload: Workload,
    cases: &[Vec<Numbered<'_>>],
    (size, across): ([f64; 2], usize),
) -> Option<Figure> {
    if cases.is_empty() {
        return None;
    }
    let down = cases.len().div_ceil(across);
    let mut figure = Figure::new(workload.title(), [size[0] * across as f64, size[1] * down as f64]);
    for (index, case) in cases.iter().enumerate() {
        let corner = [size[0] * (index % across) as f64, size[1] * (index / across) as f64];
        figure.panels.push(panel(case, Rect::from_min_size(corner, size)));
    }
    let threads = report.of(workload).map(|m| m.threads).collect::<std::collections::BTreeSet<_>>();
    figure.legend = threads.iter().map(|&threads| entry(threads)).collect();
    figure.legend_place = LegendPlace::Outside;
    figure.caption = format!(
        "Median time per item against the largest error of {}; the line joins methods that no other surpasses in \
         both. {}; {}, {}.",
        cases[0][0].1.error.what, report.machine, report.program, report.began
    );
    figure.table = table(report, report.of(workload));
    Some(figure)
}

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
