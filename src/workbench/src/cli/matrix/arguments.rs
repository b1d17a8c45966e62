//! Arguments of `matrix`.

use std::ffi::OsString;
use std::path::PathBuf;

use chromascope_core::correction::CorrectionMethod;
use chromascope_core::correction::neutral::Neutral;
use chromascope_profile::icc::IccVersion;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use crate::cli::fit::{FitArguments, method};
use crate::cli::per::Per;

pub(in crate::cli) const EXAMPLES: &str = "Examples:
  chromascope matrix \"Nikon D850\" --illuminant D55
  chromascope matrix \"Nikon D850\" --illuminant A --second-illuminant D65 --format dcp --out d850.dcp
  chromascope matrix mine.csv --illuminant D50 --fit min-delta-e --weights skin=4,neutrals=2 --format icc --out mine.icc
  chromascope matrix \"Nikon D850\" --illuminant \"ISO 7589 studio tungsten\" --format clf --out d850.clf

text: the matrix from balanced RGB to XYZ, its errors over the training reflectances and by leave-one-out (each reflectance by a fit to
all others; optimistic where the set has near copies, as the 190 reflectances have), what it does to white and to narrow blue LEDs
(20 nm wide), the DNG matrices and the ACES IDT. dng: ColorMatrix and
ForwardMatrix as lines. dcp: DNG camera profile for raw developers, of one light or two. icc: matrix profile for linear RGB that is
balanced for the light. clf: the ACES input transform that rawtoaces defines (its own fit: least squares in L*a*b*, six
parameters, 190 training reflectances), for RGB balanced by the multipliers in its description. dng, dcp and clf hold the ratio between
the camera's channels: for a table that lost it they are refused without --neutral. icc does without.";

/// Arguments of `matrix`.
#[derive(Debug, Args)]
pub(in crate::cli) struct MatrixArguments {
    /// The camera: a name, or a file with three sensitivities
    #[arg(value_name = "CAMERA|FILE")]
    pub(super) camera: OsString,
    /// The illuminant: a name, a file with one curve, `daylight:K` or `blackbody:K`
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) illuminant: OsString,
    /// A filter in front of the illuminants: a name of `chromascope list filters`, or a file with one transmittance; may be repeated
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) filter: Vec<OsString>,
    /// A second illuminant, for text, dng and dcp: a name, a file with one curve, `daylight:K` or `blackbody:K`
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) second_illuminant: Option<OsString>,
    /// The fit
    #[arg(long, value_name = "FIT", value_parser = method(), default_value = "matrix")]
    pub(super) fit: CorrectionMethod,
    #[command(flatten)]
    pub(super) training: FitArguments,
    /// The XYZ observer that is fitted to
    #[arg(long, value_name = "OBSERVER", default_value = crate::document::FIT_TARGET)]
    pub(super) fit_to: String,
    /// Unit of the sensitivities in a camera file, overriding the file: response per energy or per photon
    #[arg(long, value_enum, value_name = "UNIT")]
    pub(super) per: Option<Per>,
    /// The camera model as its raw files state it (`UniqueCameraModel`), by which raw developers choose a DCP file [default: by the
    /// built-in table of names]
    #[arg(long, value_name = "MODEL")]
    pub(super) model: Option<String>,
    /// `AsShotNeutral` of a raw file under the illuminant, in place of the table's own ratio between the channels; dng, dcp and clf need
    /// it where that ratio is lost or implausible
    #[arg(long, value_name = "R,G,B")]
    pub(super) neutral: Option<Neutral>,
    /// For icc: the version of the format; 2 for programs that read no version 4
    #[arg(long, value_name = "VERSION", value_parser = icc_version(), default_value = "4")]
    pub(super) icc_version: IccVersion,
    /// For clf: fit with white at 1 where rawtoaces' scaling puts it elsewhere
    #[arg(long)]
    pub(super) white_at_one: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(super) format: Format,
    /// Output file [default: standard output, also `-`]
    #[arg(long, value_name = "FILE")]
    pub(super) out: Option<PathBuf>,
    /// Overwrites the file named by --out
    #[arg(long)]
    pub(super) force: bool,
}

/// Reads the version of ICC files.
fn icc_version() -> impl TypedValueParser<Value = IccVersion> {
    PossibleValuesParser::new(["2", "4"]).map(|text| if text == "2" { IccVersion::V2 } else { IccVersion::V4 })
}

/// A form in which a correction is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// Everything in words and aligned numbers
    Text,
    /// DNG's matrices as lines
    Dng,
    /// DNG camera profile
    Dcp,
    /// ICC matrix profile
    Icc,
    /// ACES IDT in Common LUT Format
    Clf,
}
