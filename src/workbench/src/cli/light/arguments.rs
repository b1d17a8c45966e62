//! Arguments of `light`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::cli::sources::SourceArguments;

pub(in crate::cli) const EXAMPLES: &str = "Examples:
  chromascope light FL2 LED-B3 D65
  chromascope light lamp.csv --camera \"Nikon D70\" --format csv --out lamp_indices.csv
  chromascope light blackbody:3200 --filter \"Cooling 131 mired\"
  chromascope light LED-B3 --ssi-reference blackbody:3200

CSV columns: light; cct_k, duv (CIE 1931 2\u{b0}, 380-780 nm); ra, r1 to r14 (CIE 13.3; none for lamps that are
mainly monochromatic, which it excludes); rf, rg (ANSI/IES TM-30, CIE 224); ssi, the spectral similarity of SMPTE ST 2122 to the
reference of the same temperature, unrounded; rf_h1, rcs_h1, fidelity and chroma shift of the first hue bin (reds); ssi_to, the similarity
to the light of --ssi-reference, and ssi_reference, its name; then, in a row for each camera: camera,
consistency_mean, consistency_p95, consistency_max, the \u{394}E*00 of the patches between this light and its reference illuminant
through the camera, balanced to each and corrected by the matrix of the reference; worst_patch; cautions, what
to know about the indices. Undefined values are empty; the
reason is reported on standard error.";

/// Arguments of `light`.
#[derive(Debug, Args)]
pub(in crate::cli) struct LightArguments {
    /// Illuminants: names, files with one curve, `daylight:K` or `blackbody:K`
    #[arg(value_name = "NAME|FILE", required = true)]
    pub(super) lights: Vec<OsString>,
    /// A filter in front of each light: a name of `chromascope list filters`, or a file with one transmittance; may be repeated
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) filter: Vec<OsString>,
    /// A light that the spectral similarity is taken to as well, such as `blackbody:3200` or D55: a name or a file with one curve
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) ssi_reference: Option<OsString>,
    #[command(flatten)]
    pub(super) sources: SourceArguments,
    /// The patches that cameras are compared over: a chart, a material, or a file with reflectances [default: the preset's]
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) chart: Option<OsString>,
    /// Form of the output
    #[arg(long, value_enum, default_value_t = TableFormat::Table)]
    pub(super) format: TableFormat,
    /// Output file [default: standard output, also `-`]
    #[arg(long, value_name = "FILE")]
    pub(super) out: Option<PathBuf>,
    /// Overwrites the file named by --out
    #[arg(long)]
    pub(super) force: bool,
}

/// A form of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum TableFormat {
    /// For people
    Table,
    /// Comma-separated, 15 digits
    Csv,
    /// One object for each light
    Json,
}
