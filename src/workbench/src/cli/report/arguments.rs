//! Arguments of `report`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::Args;

use crate::cli::per::Per;
use crate::report::PIXELS;

pub(in crate::cli) const EXAMPLES: &str = "Examples:
  chromascope report --out report
  chromascope report --out mine --camera \"Canon EOS 5D Mark II\" --camera mine.csv --chart \"ColorChecker 24\"

The folder gets Figures 1 to 9 of the paper as PDF, SVG, PNG and CSV (the numbers behind them), claims.csv with each claim, what is
found and its rounding (half of the last digit, not how well it is known), and report.html: one page with all of that, without links
to the network. Claims about cameras that are not in the report are not judged; checks beyond the paper stand apart.";

/// Arguments of `report`.
#[derive(Debug, Args)]
pub(in crate::cli) struct ReportArguments {
    /// A folder, made if it is not there
    #[arg(long, value_name = "FOLDER")]
    pub(super) out: PathBuf,
    /// A camera in place of the paper's, or a file with three sensitivities; may be repeated
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) camera: Vec<OsString>,
    /// Unit of the sensitivities in camera files, overriding the files: response per energy or per photon
    #[arg(long, value_enum, value_name = "UNIT", requires = "camera")]
    pub(super) per: Option<Per>,
    /// A chart, a material, or a file with reflectances in place of the five patches
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) chart: Option<OsString>,
    /// A light in place of equal energy and of sunlight: a name, a file with one curve, `daylight:K` or `blackbody:K`
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) illuminant: Option<OsString>,
    /// Width and height of a rendered picture in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = PIXELS, value_parser = clap::value_parser!(u32).range(16..=2048))]
    pub(super) picture_size: u32,
    /// Overwrites the files of an earlier report
    #[arg(long)]
    pub(super) force: bool,
}
