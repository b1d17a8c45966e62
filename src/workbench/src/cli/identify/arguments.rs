//! Arguments of `identify`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use spectral_file::Values;

use crate::cli::per::Per;

pub(in crate::cli) const EXAMPLES: &str = "Examples:
  chromascope identify raw.csv --chart \"ColorChecker 24 (Ohta 1997)\" --illuminant D50
  chromascope identify measured.csv --illuminant lamp.csv --residuals residuals.csv
  chromascope identify radiances.csv --radiance --raw raw.csv --clip 4095 --format json
  chromascope identify --image chart.tif --corners 212,180 1840,195 1826,1290 220,1275 --chart colorchecker.csv --illuminant D50

FILE is a spectral table, one row a patch, with three more columns R, G, B of linear raw values; or the spectra alone with --raw; or,
with --chart, a table of R, G, B alone. Rows belong to spectra by the patches' names, or in order. Model: recorded = gain of the
channel × brightness of the patch × the integral of sensitivity, reflectance and light; fitted by least squares of the logarithm.
RMS is that of the remaining log error in percent; missing, zero, negative and clipped values are excluded and listed.
A rank is given as its 95 % range by a bootstrap over the patches. It is of tables: sensors of one maker or family often fit equally
well, so it does not prove a model.

Columns of --format csv: rank, rank_first, rank_last (95 % range), first_share (of the resamples with the smallest RMS), camera, rms_percent, deviation_percent (RMS over the degrees of freedom), rms_r_percent, rms_g_percent,
rms_b_percent, gain_r, gain_g, gain_b, values, parameters, worst_patch, worst_patch_percent, cause, cause_share (of the squares, to
first order). Columns of --residuals: camera, patch, channel, residual_percent (100 ln recorded / modeled), excluded.";

/// Arguments of `identify`.
#[derive(Debug, Args)]
pub(in crate::cli) struct IdentifyArguments {
    /// Spectra with raw RGB, spectra alone (with --raw or --image), or raw RGB alone (with --chart)
    #[arg(value_name = "FILE", required_unless_present = "image")]
    pub(super) file: Option<PathBuf>,
    /// A table of raw RGB: columns patch, R, G, B
    #[arg(long, value_name = "FILE", conflicts_with = "image")]
    pub(super) raw: Option<PathBuf>,
    /// A linear 16-bit TIFF or PNG of the chart
    #[arg(long, value_name = "FILE", requires = "corners")]
    pub(super) image: Option<PathBuf>,
    /// Corners of the grid of patches in pixels, around the chart from the first patch: top left, top right, bottom right, bottom left
    #[arg(long, value_name = "x,y", num_args = 4, value_parser = corner, requires = "image")]
    pub(super) corners: Vec<[f64; 2]>,
    /// Patches across and down the chart in the picture
    #[arg(long, value_name = "CxR", default_value = "6x4", value_parser = grid, requires = "image")]
    pub(super) grid: [usize; 2],
    /// The patches' reflectances: a chart, or a file
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) chart: Option<OsString>,
    /// The light that the patches were recorded under: a name, a file with one curve, `daylight:K` or `blackbody:K`
    #[arg(long, value_name = "NAME|FILE", required_unless_present = "radiance", conflicts_with = "radiance")]
    pub(super) illuminant: Option<OsString>,
    /// A filter in front of the light: a name, or a file with a transmittance; may be repeated
    #[arg(long, value_name = "NAME|FILE", conflicts_with = "radiance")]
    pub(super) filter: Vec<OsString>,
    /// The file's spectra are radiances, not reflectances: there is no light to name
    #[arg(long, conflicts_with = "chart", requires = "file")]
    pub(super) radiance: bool,
    /// Scale of the values in a file of reflectances that does not state it
    #[arg(long, value_name = "VALUES", value_parser = crate::cli::inspect::arguments::values())]
    pub(super) values: Option<Values>,
    /// A camera, or a file with three sensitivities; may be repeated [default: all of the library]
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) camera: Vec<OsString>,
    /// Unit of the sensitivities in camera files, overriding the files: response per energy or per photon
    #[arg(long, value_enum, value_name = "UNIT", requires = "camera")]
    pub(super) per: Option<Per>,
    /// Raw value of no light, subtracted
    #[arg(long, value_name = "LEVEL", default_value_t = 0.0, allow_hyphen_values = true)]
    pub(super) black: f64,
    /// Raw value from which on a channel is clipped [default: none; 65535 in pictures]
    #[arg(long, value_name = "LEVEL")]
    pub(super) clip: Option<f64>,
    /// Holds parameters of the model: one gain for all channels, brightness 1 for all patches
    #[arg(long, value_enum, value_delimiter = ',', value_name = "WHAT")]
    pub(super) hold: Vec<Held>,
    /// Format of the ranking
    #[arg(long, value_enum, default_value_t = Format::Table)]
    pub(super) format: Format,
    /// Output file of the ranking [default: standard output, also `-`]
    #[arg(long, value_name = "FILE")]
    pub(super) out: Option<PathBuf>,
    /// Writes all residuals as CSV
    #[arg(long, value_name = "FILE")]
    pub(super) residuals: Option<PathBuf>,
    /// Overwrites existing files
    #[arg(long)]
    pub(super) force: bool,
}

/// A parameter that is not fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Held {
    /// One gain for all channels
    Gains,
    /// Brightness 1 for all patches
    Brightness,
}

/// Format of the ranking.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// Aligned columns, then the best camera's residuals
    Table,
    /// Comma-separated values
    Csv,
    /// JSON with gains, brightnesses and residuals
    Json,
}

fn corner(text: &str) -> Result<[f64; 2], String> {
    let wrong = || format!("\"{text}\" is not a corner; write x,y in pixels, such as 212,180.5");
    let (x, y) = text.split_once(',').ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(wrong);
    Ok([number(x)?, number(y)?])
}

fn grid(text: &str) -> Result<[usize; 2], String> {
    let wrong = || format!("\"{text}\" is not a grid; write patches across and down, such as 6x4");
    let (columns, rows) = text.split_once(['x', 'X', '×']).ok_or_else(wrong)?;
    let count = |text: &str| text.trim().parse::<usize>().ok().filter(|n| (1..=100).contains(n)).ok_or_else(wrong);
    Ok([count(columns)?, count(rows)?])
}
