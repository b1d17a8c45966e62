//! Arguments that several commands take.

use std::ffi::OsString;
use std::path::PathBuf;

use chromascope_core::correction::CorrectionMethod;
use chromascope_core::correction::classes::{ClassWeights, ColorClass};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use serde::de::value::{Error, StrDeserializer};
use serde::de::{DeserializeOwned, IntoDeserializer as _};
use spectral_file::Values;

use super::error::{CliError, Result};
use super::outputs;
use super::reading::Per;
use super::request::Request;
use crate::document::Pixel;
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
    /// A camera, a file with three sensitivities, or a folder of such files; may be repeated
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
    #[arg(long, value_name = "METHOD", value_parser = method())]
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
    #[command(flatten)]
    pub(super) out: OutArguments,
}

/// File of a text.
#[derive(Debug, Args)]
pub(super) struct OutArguments {
    /// Output file [default: standard output, also `-`]
    #[arg(long = "out", value_name = "FILE")]
    pub(super) path: Option<PathBuf>,
    /// Overwrites the file named by --out
    #[arg(long)]
    pub(super) force: bool,
}

impl OutArguments {
    /// Refuses the file before anything is computed.
    pub(super) fn check(&self, request: &Request) -> Result<()> {
        outputs::check(self.path.as_deref(), &request.inputs(), self.force)
    }

    pub(super) fn put(&self, text: &str) -> Result<()> {
        outputs::put(text, self.path.as_deref())
    }
}

/// Reflectances in place of the preset's.
#[derive(Debug, Args)]
pub(super) struct ChartArguments {
    /// A chart, a material, or a file with reflectances [default: the preset's]
    #[arg(long, value_name = "NAME|FILE")]
    chart: Option<OsString>,
    /// Scale of the values in a file of reflectances that does not state it
    #[arg(long, value_name = "VALUES", value_parser = values(), requires = "chart")]
    values: Option<Values>,
}

impl ChartArguments {
    pub(super) fn set(&self, request: &mut Request) -> Result<()> {
        request.values = self.values;
        request.set_chart(self.chart.as_deref())
    }
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

/// Conditions of a fit.
#[derive(Debug, Args)]
pub(super) struct FitArguments {
    /// The training reflectances: a chart, a material, or a file with reflectances [default: the built-in 190]
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) training: Option<OsString>,
    /// Weights of classes of reflectances in the fit, 0 to 100: `neutrals=4,skin=2,foliage=1,sky=1`
    #[arg(long, value_name = "CLASS=WEIGHT,…", value_delimiter = ',', value_parser = weight)]
    pub(super) weights: Vec<(ColorClass, f64)>,
    /// Fits without keeping the color of a perfect diffuser
    #[arg(long)]
    pub(super) free_white: bool,
}

pub(super) fn method() -> impl TypedValueParser<Value = CorrectionMethod> {
    let ids = CorrectionMethod::ALL.map(|method| PossibleValue::new(method.id()).help(method.label()));
    PossibleValuesParser::new(ids).map(|id| CorrectionMethod::by_id(&id).unwrap_or_default())
}

/// One weight, as `skin=2`.
fn weight(text: &str) -> Result<(ColorClass, f64), String> {
    let classes = || ColorClass::ALL.map(ColorClass::key).join(", ");
    let malformed = || format!("write a class and its weight, as skin=2; classes: {}", classes());
    let (class, number) = text.split_once('=').ok_or_else(malformed)?;
    let class = ColorClass::ALL.into_iter().find(|known| known.key() == class.trim());
    let class = class.ok_or_else(|| format!("no class is named so; classes: {}", classes()))?;
    let number = number.trim().parse::<f64>().ok().filter(|number| (0.0..=ClassWeights::MOST).contains(number));
    let number = number.ok_or_else(|| format!("a weight is a number from 0 to {}", ClassWeights::MOST))?;
    Ok((class, number))
}

/// Temperature in kelvins of the locus metrics unless another is named.
pub(super) const LOCUS_K: f64 = 2856.0;

/// A pixel of the cameras.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct PixelArguments {
    /// Full-well capacity of a pixel in electrons, for gray-snr
    #[arg(long, value_name = "ELECTRONS")]
    full_well: Option<f64>,
    /// Read noise of a pixel in electrons (RMS)
    #[arg(long, value_name = "ELECTRONS", default_value_t = 0.0, requires = "full_well")]
    read_noise: f64,
}

impl PixelArguments {
    /// The pixel, if its full well is named.
    pub(super) fn pixel(self) -> Result<Option<Pixel>> {
        let pixel = self.full_well.map(|full_well| Pixel { full_well, read_noise: self.read_noise });
        let valid = pixel.map_or(Ok(()), |pixel| pixel.electrons().map(drop));
        valid.map_err(|error| CliError::Argument { argument: "--full-well", reason: error.to_string() })?;
        Ok(pixel)
    }
}

/// Takes the names that sessions use too.
pub(super) fn named<T: DeserializeOwned + Clone + Send + Sync + 'static>(
    names: impl IntoIterator<Item = &'static str>,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(names.into_iter().collect::<Vec<_>>()).try_map(|name| {
        let name: StrDeserializer<'_, Error> = name.as_str().into_deserializer();
        T::deserialize(name)
    })
}

pub(super) fn values() -> impl TypedValueParser<Value = Values> {
    named::<Values>(["plain", "percent", "absorbance", "decibels"])
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// For reading.
    Table,
    Csv,
    Json,
}

/// Takes a form of a table, each described for the command.
pub(super) fn form([table, csv, json]: [&'static str; 3]) -> impl TypedValueParser<Value = Form> {
    let all = [("table", table), ("csv", csv), ("json", json)].map(|(name, help)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(all).map(|name| match name.as_str() {
        "csv" => Form::Csv,
        "json" => Form::Json,
        _ => Form::Table,
    })
}
