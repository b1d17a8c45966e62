//! Command-line arguments.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, Parser};
use spectral_file::Values;

use super::bench::BenchArguments;
use super::compare::arguments::CompareArguments;
use super::figure::arguments::FigureArguments;
use super::identify::arguments::IdentifyArguments;
use super::inspect::arguments::InspectArguments;
use super::matrix::arguments::MatrixArguments;
use super::render::arguments::RenderArguments;
use super::report::arguments::ReportArguments;
pub(super) use super::sources::{CommonArguments, SourceArguments, Transform};
use crate::document::SetKind;

/// See, measure and explain how digital cameras render color, from spectra.
///
/// Without a command, opens the window with the given files.
#[derive(Debug, Parser)]
#[command(name = "chromascope", version, args_conflicts_with_subcommands = true, after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// A session (.chromascope), spectra or camera sensitivities to open in the window
    #[arg(value_name = "FILE")]
    pub(super) files: Vec<PathBuf>,
    /// A session to open in the window
    #[arg(long, value_name = "FILE")]
    pub(super) session: Option<PathBuf>,
    /// A computation without a window
    #[command(subcommand)]
    pub(super) subcommand: Option<Subcommand>,
}

const EXAMPLES: &str = "Examples:
  chromascope leaf.csv
  chromascope locus --camera \"Nikon D70\" --observer \"CIE 1931 2°\" --temperatures 2856,5500,6504
  chromascope patches --camera \"Canon EOS 10D\" --illuminant D55 --out patches.csv
  chromascope compare --illuminant A --sort metamerism-index
  chromascope matrix \"Nikon D850\" --illuminant A --second-illuminant D65 --format dcp --out d850.dcp
  chromascope render --mesh head --camera \"Nikon D70\" --out pictures
  chromascope inspect measured.txt --csv measured.csv
  chromascope report --out report
  chromascope list cameras

Names are those of `chromascope list`. Case, punctuation and words such as CIE, illuminant, standard and observer are ignored; whole
words, or any unambiguous part of one, match. A match that is not exact is reported on standard error.
No command overwrites a file that it reads, or any other file without --force.";

const LOCUS_EXAMPLES: &str = "\
Examples:
  chromascope locus > loci.csv
  chromascope locus --preset paper --from 2000 --to 10000 --count 50
  chromascope locus --camera \"Nikon D70\" --camera mine.csv --reference \"CIE 1964 10°\" --illuminant A --white-balance D55

Columns: sensor, temperature_k, x, y, u_prime, v_prime; distance_xy and distance_uv_prime, the distances to the reference at the same
temperature, in x, y and in u\u{2032}, v\u{2032}; cct_error_k, the correlated color temperature by CIE 15 read on
the reference's own locus (nearest in CIE 1960 u, v, within 0.05) minus the true temperature, the metric of `compare`; arc_length_xy,
the length in x, y of the straight steps from row to row since the sensor's first (more rows, nearer to the locus's own length);
extrapolated, true below the temperature from which the end of the sensor's table matters (drawn dotted in figures); then the
conditions: reference, illuminant, white_balance, transform, preset.

Temperatures are in kelvins, from 1 to 1e15. Rows are ordered by sensor, as named, then by temperature. Undefined values
are empty.";

const PATCHES_EXAMPLES: &str = "Examples:
  chromascope patches --preset paper
  chromascope patches --camera \"Canon EOS 10D\" --illuminant A --white-balance D55
  chromascope patches --camera mine.csv --per photon --chart leaves.csv --illuminant daylight:6504 --out leaves_seen.csv
  chromascope patches --radiance measured.csv --radiance-white \"white tile\"

Columns: sensor, patch; r, g, b after white balance (empty for CIE observers); x_tristimulus, y_tristimulus, z_tristimulus (Y = 1
for a perfect diffuser, under Eq 13 within 5e-5); x, y; u_prime, v_prime; lab_l, lab_a, lab_b, whose adopted white is a perfect diffuser;
cct_k, duv, the nearest blackbody for the CIE 1931 observer;
delta_…, the differences from the reference, a column for each metric; then the conditions: reference, illuminant,
white_balance, transform, preset. Undefined values are empty: with the paper's matrix, Eq 13 takes RGB as sRGB
whatever the sensor, so its colors have distances in the diagrams, but no L*a*b*, no color temperature and no \u{394}E*.

A file's reflectances are fractions or percent, its wavelengths nm or µm; guesses are reported on standard error. Numbers above one whose
scale the file does not state need --values percent or --values plain; a file of radiances is refused as a chart.";

/// Subcommands, which run without a window.
#[derive(Debug, clap::Subcommand)]
pub(super) enum Subcommand {
    /// Planckian loci as CSV: chromaticity, distances to the reference, CCT error and arc length of blackbodies by temperature
    #[command(after_help = LOCUS_EXAMPLES)]
    Locus(LocusArguments),
    /// Chart patches or measured radiances as CSV: RGB, XYZ, xy, u′v′, L*a*b* and differences from the reference
    #[command(after_help = PATCHES_EXAMPLES)]
    Patches(PatchesArguments),
    /// Cameras ranked by figures of merit, with uncertainties: a table, CSV or JSON
    #[command(after_help = super::compare::arguments::examples())]
    Compare(Box<CompareArguments>),
    /// Lights: CCT and Duv, Ra, Rf and Rg, spectral similarity, and how consistent cameras are under them
    #[command(after_help = super::light::arguments::EXAMPLES)]
    Light(Box<super::light::arguments::LightArguments>),
    /// Color correction matrix of a camera, with its errors, as text, DNG values, DCP, ICC or CLF
    #[command(after_help = super::matrix::arguments::EXAMPLES)]
    Matrix(Box<MatrixArguments>),
    /// Figures for paper, laid out for a width: PDF, SVG, PNG, or the numbers behind them as CSV
    #[command(after_help = super::figure::arguments::EXAMPLES)]
    Figure(Box<FigureArguments>),
    /// Figures and claims of the 2007 paper with public data: PDF, SVG, PNG, CSV and one page
    #[command(after_help = super::report::arguments::EXAMPLES)]
    Report(Box<ReportArguments>),
    /// Pictures of a mesh under a light, through cameras and observers, as PNG or OpenEXR
    #[command(after_help = super::render::arguments::EXAMPLES)]
    Render(Box<RenderArguments>),
    /// Cameras ranked by how well their sensitivities explain the raw RGB of known patches, by log error
    #[command(after_help = super::identify::arguments::EXAMPLES)]
    Identify(Box<IdentifyArguments>),
    /// Contents of files of spectra and the decisions made when reading them; curves as CSV or JSON
    #[command(after_help = super::inspect::arguments::EXAMPLES)]
    Inspect(Box<InspectArguments>),
    /// Run time against error of every method, measured on this machine: figures, table and JSON
    #[command(after_help = super::bench::EXAMPLES)]
    Bench(BenchArguments),
    /// The names of the built-in data sets, one per line
    List {
        /// Kind of data sets [default: all]
        #[arg(value_parser = super::settings::choice_of(&SetKind::ALL[..6]))]
        kind: Option<SetKind>,
    },
}

/// Arguments of `locus`.
#[derive(Debug, Args)]
pub(super) struct LocusArguments {
    #[command(flatten)]
    pub(super) common: CommonArguments,
    /// The first temperature in kelvins [default: 1000]
    #[arg(long, value_name = "K", conflicts_with = "temperatures")]
    pub(super) from: Option<f64>,
    /// The last temperature in kelvins [default: 20000]
    #[arg(long, value_name = "K", conflicts_with = "temperatures")]
    pub(super) to: Option<f64>,
    /// Number of temperatures, evenly in 1/T [default: 200]
    #[arg(long, value_name = "N", conflicts_with = "temperatures", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    pub(super) count: Option<u32>,
    /// These temperatures in kelvins, in this order
    #[arg(long, value_name = "a,b,c", value_delimiter = ',')]
    pub(super) temperatures: Vec<f64>,
}

/// Arguments of `patches`.
#[derive(Debug, Args)]
pub(super) struct PatchesArguments {
    #[command(flatten)]
    pub(super) common: CommonArguments,
    /// A chart, a material, or a file with reflectances [default: the preset's]
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) chart: Option<OsString>,
    /// Scale of the values in a file of reflectances that does not state it
    #[arg(long, value_name = "VALUES", value_parser = super::inspect::arguments::values(), requires = "chart")]
    pub(super) values: Option<Values>,
    /// A file with spectra of radiance, which are integrated as they are: no chart and no illuminant is named then. Without
    /// --radiance-white they are balanced to equal energy, X, Y, Z are relative, and there is no L*a*b*
    #[arg(long, value_name = "FILE", conflicts_with_all = ["chart", "illuminant"])]
    pub(super) radiance: Option<PathBuf>,
    /// The radiance of a perfect diffuser among those of the file: it takes the white-balance target and Y = 1
    #[arg(long, value_name = "NAME", requires = "radiance")]
    pub(super) radiance_white: Option<String>,
}
