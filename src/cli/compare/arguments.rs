//! What `compare` takes.

use std::ffi::OsString;

use chromascope_core::colorimetry::Metric;
use chromascope_core::correction::CorrectionMethod;
use chromascope_core::query::CameraMetric;
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};
use spectral_file::Values;

use crate::cli::arguments::CommonArguments;

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
pub(super) const ALL: &str = "all";
/// The order of names, in the place of a metric.
pub(super) const NAME: &str = "name";

/// Examples and what the numbers mean, with every metric.
pub(in crate::cli) fn examples() -> String {
    let statistics = Metric::ALL.len() * 4;
    let list: String =
        CameraMetric::ALL[statistics..].iter().map(|metric| format!("\n  {:22} {}", metric.id, metric.label)).collect();
    let differences: String =
        Metric::ALL.iter().map(|metric| format!("\n  {:22} {}", metric.id, metric.label)).collect();
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

The number after ± is the standard uncertainty that the sensitivities' own uncertainty causes: the spread of independent tables of
the model where there are several, otherwise the pooled spread of those models. A rank is a range where values differ by less than
the standard uncertainty of their difference. A value that is undefined is –, with the reason below.

CSV: sensor, rank_first, rank_last (by the metric of --sort); for each metric its column and the same with _uncertainty; then the
conditions. JSON: format, version, conditions, metrics, cameras with value,
uncertainty and rank of each metric or the reason for none, and worst_patches, those of the largest \u{394}E*00."
    )
}

/// What `compare` takes.
#[derive(Debug, Args)]
pub(in crate::cli) struct CompareArguments {
    #[command(flatten)]
    pub(super) common: CommonArguments,
    /// A chart, a material, or a file with reflectances [default: the preset's]
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) chart: Option<OsString>,
    /// Scale of the values in a file of reflectances that does not state it
    #[arg(long, value_name = "VALUES", value_parser = crate::cli::inspect::arguments::values(), requires = "chart")]
    pub(super) values: Option<Values>,
    /// Color correction, fitted over the 190 training reflectances with white kept
    #[arg(long, value_enum, conflicts_with = "transform")]
    pub(super) correction: Option<CorrectionChoice>,
    /// Metrics in the order of the columns, or `all` [default: the usual eight]
    #[arg(long, value_name = "a,b,c", value_delimiter = ',', value_parser = metric_names([ALL]), hide_possible_values = true)]
    pub(super) metrics: Vec<String>,
    /// Metric that orders the rows, best first, or `name` [default: the first of --metrics]
    #[arg(long, value_name = "METRIC", value_parser = metric_names([NAME]), hide_possible_values = true)]
    pub(super) sort: Option<String>,
    /// Form of the output
    #[arg(long, value_enum, default_value_t = Format::Table)]
    pub(super) format: Format,
    /// Temperature in kelvins of the blackbody whose place on the locus is compared
    #[arg(long, value_name = "K", default_value_t = 2856.0)]
    pub(super) temperature: f64,
    /// Full-well capacity of a pixel in electrons, for gray-snr
    #[arg(long, value_name = "ELECTRONS")]
    pub(super) full_well: Option<f64>,
    /// Read noise of a pixel in electrons (RMS)
    #[arg(long, value_name = "ELECTRONS", default_value_t = 0.0, requires = "full_well")]
    pub(super) read_noise: f64,
}

fn metric_names(more: [&'static str; 1]) -> PossibleValuesParser {
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

/// A color correction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum CorrectionChoice {
    /// None: Eq 13, RGB as sRGB
    None,
    /// 3×3 by least squares in XYZ
    Matrix,
    /// 3×3 of minimum mean ΔE*00
    MinDeltaE,
    /// Root polynomial of degree 2 (6 terms)
    RootPolynomial,
}

impl CorrectionChoice {
    /// The method that is fitted; none for Eq 13.
    pub(super) fn method(self) -> Option<CorrectionMethod> {
        let id = self.to_possible_value()?;
        CorrectionMethod::by_id(id.get_name()).filter(|_| self != Self::None)
    }
}
