//! A ranking as an aligned table, as CSV and as JSON.

use chromascope_core::query::metrics::Better;
use chromascope_core::query::{CameraMetric, MetricUncertainty, MetricValue};
use serde_json::{Value, json};
use std::fmt::Write as _;

use super::{Comparison, Row};
use crate::cli::tables::{field, significant};
use crate::format::{aligned, rank_in_words};
use crate::scene::uncertainty::{UNCERTAINTY_HEADS, decimals, in_words, nature, uncertainty};

/// Version of the JSON form.
const VERSION: u32 = 1;

/// The most characters of a name in the aligned table.
const LONGEST_NAME: usize = 40;

/// Aligned columns: rank, sensor, values with uncertainties; then the conditions and the reasons for missing values.
pub(super) fn table(comparison: &Comparison) -> String {
    let heads = comparison.metrics.iter().map(head);
    let mut cells: Vec<Vec<String>> = vec![["rank".to_owned(), "sensor".to_owned()].into_iter().chain(heads).collect()];
    let columns =
        comparison.metrics.iter().enumerate().map(|(at, metric)| {
            cells_of(*metric, &comparison.rows.iter().map(|row| row.values[at]).collect::<Vec<_>>())
        });
    let columns: Vec<Vec<String>> = columns.collect();
    for (at, row) in comparison.rows.iter().enumerate() {
        let values = columns.iter().map(|column| column[at].clone());
        let name = row.name.chars().take(LONGEST_NAME).collect();
        cells.push([rank_in_words(row.rank), name].into_iter().chain(values).collect());
    }
    let columns = cells.first().map_or(0, Vec::len);
    let width = |column: usize| cells.iter().map(|row| length(&row[column])).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in &cells {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let pad = " ".repeat(width - length(cell));
            // Names are left-aligned and all else right-aligned, so that digits line up.
            let (first, second) = if column == 1 { (cell, &pad) } else { (&pad, cell) };
            line.extend([first.as_str(), second.as_str()]);
            line += "  ";
        }
        text += line.trim_end();
        text.push('\n');
    }
    text + &notes(comparison)
}

/// Symbol with unit.
fn head(metric: &CameraMetric) -> String {
    if metric.unit == "1" { metric.symbol.to_owned() } else { format!("{} [{}]", metric.symbol, metric.unit) }
}

/// Characters that take a place.
fn length(text: &str) -> usize {
    text.chars().count()
}

/// Cells of a metric, with decimal points and ± below each other.
fn cells_of(metric: CameraMetric, values: &[MetricValue]) -> Vec<String> {
    let has_value = |value: &&MetricValue| value.value.is_ok();
    let ends = values.iter().filter(has_value).map(|value| decimals(metric, *value).max(0));
    let column = ends.max().unwrap_or(0) as usize;
    let behind: Vec<String> = values.iter().map(|value| uncertainty(*value).unwrap_or_default()).collect();
    let width = behind.iter().map(|words| length(words)).max().unwrap_or(0);
    let cell = |(value, behind): (&MetricValue, String)| {
        let number = value.value.map_or("–".to_owned(), |number| aligned(number, decimals(metric, *value), column));
        format!("{number} {behind:width$}")
    };
    values.iter().zip(behind).map(cell).collect()
}

/// Conditions, the meaning of rank and ±, and why values are missing.
fn notes(comparison: &Comparison) -> String {
    let mut text = "\n".to_owned();
    for (head, value) in &comparison.conditions {
        let _ = writeln!(text, "{}: {value}", head.replace("_k", " in kelvins").replace('_', " "));
    }
    if let Some(metric) = comparison.sorted_by {
        let _ =
            writeln!(text, "Rank by {}; a range where values do not differ at 95 % (k √(u₁² + u₂²)).", metric.symbol);
    }
    let all: Vec<MetricUncertainty> = comparison.rows.iter().flat_map(uncertainties).collect();
    text.extend(Some(in_words(all)).filter(|words| !words.is_empty()).map(|words| words + "\n"));
    let mut reasons: Vec<(String, Vec<&str>)> = Vec::new();
    for row in &comparison.rows {
        for (metric, value) in comparison.metrics.iter().zip(&row.values) {
            let Err(why) = value.value else { continue };
            let reason = format!("{}: {why}", metric.symbol);
            match reasons.iter_mut().find(|(known, _)| *known == reason) {
                Some((_, names)) => names.push(&row.name),
                None => reasons.push((reason, vec![&row.name])),
            }
        }
    }
    for (reason, names) in reasons {
        let who = if names.len() == comparison.rows.len() { "all".to_owned() } else { names.join(", ") };
        let _ = writeln!(text, "– {reason} ({who})");
    }
    text
}

/// Those of a row's columns that tell what its uncertainties are; extrapolated where any of them is.
fn uncertainty_cells(row: &Row) -> [String; 4] {
    let Some((source, coverage, freedom, extrapolated)) = nature(uncertainties(row)) else { return Default::default() };
    [source.word().to_owned(), significant(coverage), significant(freedom), extrapolated.to_string()]
}

fn uncertainties(row: &Row) -> impl Iterator<Item = MetricUncertainty> + Clone {
    row.values.iter().filter_map(|value| value.uncertainty)
}

/// One row for each sensor; values with 15 significant digits.
pub(super) fn csv(comparison: &Comparison) -> String {
    let mut heads = vec!["sensor".to_owned(), "rank_first".to_owned(), "rank_last".to_owned()];
    for metric in &comparison.metrics {
        heads.extend([metric.column.to_owned(), format!("{}_uncertainty", metric.column)]);
    }
    heads.extend(UNCERTAINTY_HEADS.map(str::to_owned));
    heads.extend(comparison.conditions.iter().map(|(head, _)| (*head).to_owned()));
    let conditions: Vec<String> = comparison.conditions.iter().map(|(_, value)| field(value)).collect();
    let row = |row: &Row| {
        let optional = |value: Option<f64>| value.map(significant).unwrap_or_default();
        let place = |end: usize| row.rank.map(|rank| rank[end].to_string()).unwrap_or_default();
        let standard = |value: &MetricValue| value.uncertainty.map(|u| u.standard);
        let values = row.values.iter().flat_map(|value| [optional(value.value.ok()), optional(standard(value))]);
        let cells = [field(&row.name), place(0), place(1)].into_iter().chain(values).chain(uncertainty_cells(row));
        cells.chain(conditions.iter().cloned()).collect::<Vec<_>>().join(",") + "\n"
    };
    format!("{}\n{}", heads.join(","), comparison.rows.iter().map(row).collect::<String>())
}

/// What an uncertainty is made of.
fn budget(of: MetricUncertainty) -> Value {
    json!({
        "source": of.source.word(),
        "coverage_factor_95": of.coverage,
        "degrees_of_freedom": of.freedom,
        "extrapolated": of.is_extrapolated,
        "curves": of.contributions.curves,
        "response": of.contributions.response,
        "channel_ratio": of.contributions.channel_ratio,
        "bias": of.bias,
    })
}

/// One object.
pub(super) fn json(comparison: &Comparison) -> String {
    let metric = |metric: &CameraMetric| {
        json!({
            "id": metric.id, "label": metric.label, "symbol": metric.symbol, "unit": metric.unit,
            "better": match metric.better {
                Better::Lower => "lower",
                Better::Higher => "higher",
                Better::Neither => "neither",
            },
        })
    };
    let camera = |row: &Row| {
        let values = comparison.metrics.iter().zip(&row.values).zip(&row.ranks).map(|((metric, value), rank)| {
            let told = match value.value {
                Ok(number) => {
                    let standard = value.uncertainty.map(|u| u.standard);
                    json!({ "value": number, "uncertainty": standard, "budget": value.uncertainty.map(budget), "rank": rank })
                }
                Err(why) => json!({ "reason": why.to_string() }),
            };
            (metric.id.to_owned(), told)
        });
        let worst: Vec<&String> =
            row.all.metrics.worst.iter().take(1).flatten().filter_map(|&patch| comparison.patches.get(patch)).collect();
        json!({
            "name": row.name,
            "kind": row.kind.singular(),
            "values": values.collect::<serde_json::Map<String, Value>>(),
            "worst_patches": worst,
        })
    };
    let conditions = comparison.conditions.iter().map(|(head, value)| ((*head).to_owned(), json!(value)));
    let all = json!({
        "format": "chromascope-comparison",
        "version": VERSION,
        "conditions": conditions.collect::<serde_json::Map<String, Value>>(),
        "sorted_by": comparison.sorted_by.map(|metric| metric.id),
        "metrics": comparison.metrics.iter().map(metric).collect::<Vec<_>>(),
        "cameras": comparison.rows.iter().map(camera).collect::<Vec<_>>(),
    });
    format!("{all:#}\n")
}
