//! What can be said on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, ValueEnum};

use super::bench::BenchArguments;
use super::inspect::arguments::InspectArguments;
use super::render::arguments::RenderArguments;

/// See, measure and explain how digital cameras render color, from spectra.
///
/// Without a command, opens the window with the given files.
#[derive(Debug, Parser)]
#[command(name = "chromascope", version, args_conflicts_with_subcommands = true, after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// Spectra or camera sensitivities to open in the window: CSV, TSV or text
    #[arg(value_name = "FILE")]
    pub(super) files: Vec<PathBuf>,
    /// What to compute without a window
    #[command(subcommand)]
    pub(super) subcommand: Option<Subcommand>,
}

const EXAMPLES: &str = "\
Examples:
  chromascope leaf.csv
  chromascope locus --camera \"Nikon D70\" --observer \"CIE 1931 2°\" --temperatures 2856,5500,6504
  chromascope patches --camera \"Canon EOS 10D\" --illuminant D55 --transform observer --out patches.csv
  chromascope render --mesh head --camera \"Nikon D70\" --out pictures
  chromascope inspect measured.txt --csv measured.csv
  chromascope list cameras

Names are those of `chromascope list`, case and punctuation aside; a part will do where only one name has it.";

const LOCUS_EXAMPLES: &str = "\
Examples:
  chromascope locus > first_screen.csv
  chromascope locus --camera \"Nikon D70\" --camera mine.csv --from 2000 --to 10000 --count 50
  chromascope locus --camera \"Nikon D70\" --transform observer --reference \"CIE 1964 10°\" --illuminant D65

Temperatures are in kelvins, from 1 to 1e15. Rows come by source, in the order named, then by temperature.
A place without chromaticity is left empty.";

const PATCHES_EXAMPLES: &str = "\
Examples:
  chromascope patches --chart \"ColorChecker five\"
  chromascope patches --camera \"Canon EOS 10D\" --illuminant A --white D55
  chromascope patches --camera mine.csv --chart leaves.csv --illuminant daylight:6504 --out leaves_seen.csv

r, g, b are after white balance, empty for CIE observers; Y is 1 for a perfect white. A file's reflectances are
fractions or percent, its wavelengths nm or µm; what had to be guessed is said on standard error.";

/// What can be computed without a window.
#[derive(Debug, clap::Subcommand)]
pub(super) enum Subcommand {
    /// Planckian loci as CSV: `source,temperature_k,x,y,u_prime,v_prime`
    #[command(after_help = LOCUS_EXAMPLES)]
    Locus(LocusArguments),
    /// Chart patches as CSV: `source,patch,r,g,b,x_tristimulus,y_tristimulus,z_tristimulus,x,y`
    #[command(after_help = PATCHES_EXAMPLES)]
    Patches(PatchesArguments),
    /// Pictures of a mesh under a light, through cameras and observers, as PNG or OpenEXR
    #[command(after_help = super::render::arguments::EXAMPLES)]
    Render(Box<RenderArguments>),
    /// What files of spectra hold and how they were understood; their curves as CSV or JSON
    #[command(after_help = super::inspect::arguments::EXAMPLES)]
    Inspect(Box<InspectArguments>),
    /// Run time against error of every method, measured on this machine: figures, table and JSON
    #[command(after_help = super::bench::EXAMPLES)]
    Bench(BenchArguments),
    /// The names of the built-in data sets, one a line
    List {
        /// Which; all if left out
        kind: Option<ListKind>,
    },
}

/// Through what is looked, for tables and pictures.
#[derive(Debug, Args)]
pub(super) struct SourceArguments {
    /// An observer; may be repeated. Without any source: the truth, the paper's three cameras and, in tables, CIE 1931 2°
    #[arg(long, value_name = "NAME")]
    pub(super) observer: Vec<String>,
    /// A camera, or a file with three sensitivities; may be repeated
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) camera: Vec<String>,
    /// The way to the diagram: Eq 13 for cameras and RGB observers, or a matrix fitted to an observer
    #[arg(long, value_enum, default_value_t = Transform::Paper)]
    pub(super) transform: Transform,
    /// The observer fitted to, with `--transform observer` [default: CIE 1931 2°]
    #[arg(long, value_name = "OBSERVER")]
    pub(super) reference: Option<String>,
}

/// What both tables take.
#[derive(Debug, Args)]
pub(super) struct CommonArguments {
    #[command(flatten)]
    pub(super) sources: SourceArguments,
    /// The light: a name, a file with one curve, `daylight:K` or `blackbody:K` [default: E]
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) illuminant: Option<String>,
    /// Where to write; `-` or nothing for standard output
    #[arg(long, value_name = "FILE")]
    pub(super) out: Option<PathBuf>,
}

/// What `locus` takes.
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
    /// How many temperatures, evenly in 1/T [default: 200]
    #[arg(long, value_name = "N", conflicts_with = "temperatures", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    pub(super) count: Option<u32>,
    /// These temperatures in kelvins, in this order
    #[arg(long, value_name = "a,b,c", value_delimiter = ',')]
    pub(super) temperatures: Vec<f64>,
}

/// What `patches` takes.
#[derive(Debug, Args)]
pub(super) struct PatchesArguments {
    #[command(flatten)]
    pub(super) common: CommonArguments,
    /// A chart, a material, or a file with reflectances [default: ColorChecker 24 (Ohta 1997)]
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) chart: Option<String>,
    /// The color a perfect white is to take: `unity`, a light's name, `daylight:K` or `blackbody:K`
    #[arg(long, value_name = "WHITE", default_value = "unity")]
    pub(super) white: String,
}

/// The way to the diagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Transform {
    /// Eq 13
    Paper,
    /// A matrix fitted to an observer
    Observer,
}

/// A kind of data sets to list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ListKind {
    /// Camera sensitivities
    Cameras,
    /// Color matching functions
    Observers,
    /// Sets of patches
    Charts,
    /// Lights
    Illuminants,
    /// Single reflectances
    Materials,
}
