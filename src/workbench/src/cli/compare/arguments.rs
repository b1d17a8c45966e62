//! Arguments of `compare`.

use std::ffi::OsString;

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::CameraMetric;
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};
use spectral_file::Values;

use crate::cli::arguments::CommonArguments;
use crate::cli::pixel::PixelArguments;

/// Arguments of `compare`.
#[derive(Debug, Args)]
pub(in crate::cli) struct CompareArguments {
    #[command(flatten)]
    pub(in crate::cli) common: CommonArguments,
    /// A chart, a material, or a file with reflectances [default: the preset's]
    #[arg(long, value_name = "NAME|FILE")]
    pub(in crate::cli) chart: Option<OsString>,
    /// Scale of the values in a file of reflectances that does not state it
    #[arg(long, value_name = "VALUES", value_parser = super::super::inspect::arguments::values(), requires = "chart")]
    pub(in crate::cli) values: Option<Values>,
    /// Metrics in the order of the columns, or `all` [default: the usual eight]
    #[arg(long, value_name = "a,b,c", value_delimiter = ',', value_parser = metric_names([ALL]), hide_possible_values = true)]
    pub(in crate::cli) metrics: Vec<String>,
    /// Metric that orders the rows, best first, or `name` [default: the first of --metrics]
    #[arg(long, value_name = "METRIC", value_parser = metric_names([NAME]), hide_possible_values = true)]
    pub(in crate::cli) sort: Option<String>,
    /// Form of the output
    #[arg(long, value_enum, default_value_t = Format::Table)]
    pub(in crate::cli) format: Format,
    /// Temperature in kelvins of the blackbody whose place on the locus is compared [default: that of a blackbody or daylight as the
    /// illuminant, otherwise 2856]
    #[arg(long, value_name = "K")]
    pub(in crate::cli) temperature: Option<f64>,
    #[command(flatten)]
    pub(in crate::cli) pixel: PixelArguments,
}

/// Metrics of the table unless some are named.
pub(super) const USUAL: [&str; 8] = [
    "delta-e2000-mean",
    "delta-e2000-p95",
    "delta-e2000-max",
    "metamerism-index",
    "vora",
    "luther",
    "cct-error",
    "noise-gain",
];
/// All metrics, in the place of their names.
pub(in crate::cli) const ALL: &str = "all";
/// The order of names, in the place of a metric.
pub(in crate::cli) const NAME: &str = "name";

/// Examples and what the numbers mean, with every metric.
pub(in crate::cli) fn examples() -> String {
    let statistics = Metric::ALL.len() * 4;
    let line = |(id, label): (&str, &str)| format!("\n  {id:22} {label}");
    let named = |metric: &CameraMetric| line((metric.id, metric.label));
    let list = CameraMetric::ALL[statistics..].iter().map(named).collect::<Vec<_>>().concat();
    let differences = Metric::ALL.iter().map(|metric| line((metric.id, metric.label))).collect::<Vec<_>>().concat();
    format!(
        "Examples:
  chromascope compare
  chromascope compare --camera \"Nikon D70 (A.M.P.A.S.)\" --camera mine.csv --illuminant A --metrics all
  chromascope compare --sort metamerism-index --metrics metamerism-index,metamerism-index-min,vora,luther
  chromascope compare --correction min-delta-e --chart leaves.csv --format csv --out ranking.csv

Without --camera and --observer: all built-in cameras. Metrics of the chart's patches, each followed by -mean, -median, -p95 or -max:
{differences}

Other metrics:
{list}

The number after ± is the standard uncertainty that errors of the sensitivities cause: the spread between laboratories, propagated
through the camera's own curves. A rank is a range where values do not differ at 95 %. A value that is undefined is –, with the reason
below.

CSV: sensor, rank_first, rank_last (by the metric of --sort); for each metric its column and the same with _uncertainty; origin of the
uncertainty, coverage factor, degrees of freedom, extrapolated; then the conditions. JSON: format, version, conditions, metrics,
cameras with value, uncertainty, its budget and rank of each metric or the reason for none, and worst_patches, those of the largest
\u{394}E*00."
    )
}

/// Names of all metrics and one more word.
pub(in crate::cli) fn metric_names(more: [&'static str; 1]) -> PossibleValuesParser {
    PossibleValuesParser::new(CameraMetric::ALL.iter().map(|metric| metric.id).chain(more))
}

/// Form of the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Format {
    /// Aligned columns for reading
    Table,
    /// One row for each sensor, with 15 significant digits
    Csv,
    /// One object with conditions, metrics and values
    Json,
}
