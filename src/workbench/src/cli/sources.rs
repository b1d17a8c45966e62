//! Arguments that choose sensors, the reference and the color transform.

use std::ffi::OsString;
use std::path::PathBuf;

use chromascope_core::correction::CorrectionMethod;
use clap::{Args, ValueEnum};

use super::fit::FitArguments;
use super::per::Per;
use crate::document::start::Start;

/// Sensors, the reference and the color transform, for tables and pictures.
#[derive(Debug, Args)]
pub(super) struct SourceArguments {
    /// Defaults of all options that are not given: reference, sensors, color transform and, in tables, illuminant, white balance and
    /// patches
    #[arg(long, value_parser = super::settings::choice::<Start>(), default_value = Start::Colorimetry.key())]
    pub(super) preset: Start,
    /// An observer; may be repeated. Without any sensor: those of the preset
    #[arg(long, value_name = "NAME")]
    pub(super) observer: Vec<String>,
    /// A camera, or a file with three sensitivities; may be repeated
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) camera: Vec<OsString>,
    /// Unit of the sensitivities in camera files, overriding the files: response per energy or per photon
    #[arg(long, value_enum, value_name = "UNIT")]
    pub(super) per: Option<Per>,
    /// The reference observer that all sensors are compared with [default: the preset's]
    #[arg(long, value_name = "OBSERVER")]
    pub(super) reference: Option<String>,
    /// The color transform from camera RGB to XYZ [default: the preset's]
    #[arg(long, value_enum)]
    pub(super) transform: Option<Transform>,
    /// The observer that 3×3 matrices are fitted to [default: the reference if it is an XYZ observer, else CIE 1931 2°]
    #[arg(long, value_name = "OBSERVER")]
    pub(super) fit_to: Option<String>,
    /// The color correction of a fitted transform [default: matrix]
    #[arg(long, value_name = "METHOD", value_parser = super::fit::method())]
    pub(super) correction: Option<CorrectionMethod>,
    #[command(flatten)]
    pub(super) fit: FitArguments,
}

/// Arguments of tables and figures: sensors, light, output.
#[derive(Debug, Args)]
pub(super) struct CommonArguments {
    #[command(flatten)]
    pub(super) sources: SourceArguments,
    /// The illuminant: a name, a file with one curve, `daylight:K` or `blackbody:K` [default: the preset's]
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) illuminant: Option<OsString>,
    /// A filter in front of the illuminant: a name of `chromascope list filters`, or a file with one transmittance; may be repeated,
    /// in any order
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) filter: Vec<OsString>,
    /// The white-balance target, the RGB a perfect diffuser is mapped to: `unity`, an illuminant, `daylight:K` or `blackbody:K`
    /// [default: the preset's]
    #[arg(long = "white-balance", alias = "white", value_name = "WHITE")]
    pub(super) white: Option<String>,
    /// Output file [default: standard output, also `-`]
    #[arg(long, value_name = "FILE")]
    pub(super) out: Option<PathBuf>,
    /// Overwrites the file named by --out
    #[arg(long)]
    pub(super) force: bool,
}

impl SourceArguments {
    /// The first argument that only a fitted transform has.
    pub(super) fn names_fit(&self) -> Option<&'static str> {
        let FitArguments { training, weights, free_white } = &self.fit;
        let given = [
            ("--fit-to", self.fit_to.is_some()),
            ("--correction", self.correction.is_some()),
            ("--training", training.is_some()),
            ("--weights", !weights.is_empty()),
            ("--free-white", *free_white),
        ];
        given.into_iter().find(|(_, given)| *given).map(|(argument, _)| argument)
    }

    /// True if no sensor was named.
    pub(super) fn names_no_sensor(&self) -> bool {
        self.observer.is_empty() && self.camera.is_empty()
    }
}

/// A color transform from camera RGB to XYZ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Transform {
    /// Eq 13 for cameras and RGB observers
    Paper,
    /// A 3×3 matrix for each sensor, fitted over 190 training reflectances
    #[value(alias = "observer")]
    Fitted,
}
