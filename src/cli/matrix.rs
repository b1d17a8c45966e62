//! `chromascope matrix`: the color correction of a camera, and the files in which other programs take it.

use std::ffi::OsString;
use std::path::PathBuf;

use chromascope_core::correction::CorrectionMethod;
use chromascope_core::correction::aces::IdtExposure;
use chromascope_core::correction::classes::{ClassWeights, ColorClass};
use chromascope_core::query::Ask as _;
use clap::builder::{PossibleValuesParser, TypedValueParser as _};
use clap::{Args, ValueEnum};

use super::error::CliError;
use super::outputs;
use super::per::Per;
use super::request::Request;
use crate::document::SetKind;
use crate::export::profile::{CorrectionFile, clf, idt_note};
use crate::results::Results;
use crate::scene::{Scene, SceneError};
use crate::terminal::say;

pub(super) const EXAMPLES: &str = "Examples:
  chromascope matrix \"Nikon D850\" --illuminant D55
  chromascope matrix \"Nikon D850\" --illuminant A --second-illuminant D65 --format dcp --out d850.dcp
  chromascope matrix mine.csv --illuminant D50 --fit min-delta-e --weights skin=4,neutrals=2 --format icc --out mine.icc
  chromascope matrix \"Nikon D200\" --illuminant \"ISO 7589 studio tungsten\" --format clf --out d200.clf

text: the matrix from balanced RGB to XYZ, its errors over the training reflectances and by leave-one-out (each reflectance by a fit to
all others), what it does to white and to narrow blue LEDs (20 nm wide), the DNG matrices and the ACES IDT. dng: ColorMatrix and
ForwardMatrix as lines. dcp: DNG camera profile for raw developers, of one light or two. icc: matrix profile for linear RGB that is
balanced for the light. clf: the ACES input transform that rawtoaces defines (its own fit: least squares in L*a*b*, six
parameters, 190 training reflectances), for RGB balanced by the multipliers in its description.";

/// What `matrix` takes.
#[derive(Debug, Args)]
pub(super) struct MatrixArguments {
    /// The camera: a name, or a file with three sensitivities
    #[arg(value_name = "CAMERA|FILE")]
    camera: OsString,
    /// The illuminant: a name, a file with one curve, `daylight:K` or `blackbody:K`
    #[arg(long, value_name = "NAME|FILE")]
    illuminant: OsString,
    /// A second illuminant, for text, dng and dcp: a name or a file
    #[arg(long, value_name = "NAME|FILE")]
    second_illuminant: Option<OsString>,
    /// The fit
    #[arg(long, value_name = "FIT", value_parser = method(), default_value = "matrix")]
    fit: CorrectionMethod,
    #[command(flatten)]
    training: FitArguments,
    /// The XYZ observer that is fitted to
    #[arg(long, value_name = "OBSERVER", default_value = crate::document::FIT_TARGET)]
    fit_to: String,
    /// Unit of the sensitivities in a camera file, overriding the file: response per energy or per photon
    #[arg(long, value_enum, value_name = "UNIT")]
    per: Option<Per>,
    /// The camera model as its raw files state it, by which raw developers choose a DCP file [default: the camera's name]
    #[arg(long, value_name = "MODEL")]
    model: Option<String>,
    /// For clf: fit with white at 1 where rawtoaces' scaling puts it elsewhere
    #[arg(long)]
    white_at_one: bool,
    /// What is written
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Output file [default: standard output, also `-`]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrites the file named by --out
    #[arg(long)]
    force: bool,
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

/// A form in which a correction is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
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

/// Names of the correction methods.
pub(super) fn method() -> impl clap::builder::TypedValueParser<Value = CorrectionMethod> {
    let ids = CorrectionMethod::ALL.map(|method| clap::builder::PossibleValue::new(method.id()).help(method.label()));
    PossibleValuesParser::new(ids).map(|id| CorrectionMethod::by_id(&id).unwrap_or_default())
}

/// One weight, as `skin=2`.
fn weight(text: &str) -> Result<(ColorClass, f64), String> {
    let classes = || ColorClass::ALL.map(ColorClass::id).join(", ");
    let malformed = || format!("write a class and its weight, as skin=2; classes: {}", classes());
    let (class, number) = text.split_once('=').ok_or_else(malformed)?;
    let class = ColorClass::ALL.into_iter().find(|known| known.id() == class.trim());
    let class = class.ok_or_else(|| format!("no class is named so; classes: {}", classes()))?;
    let number = number.trim().parse::<f64>().ok().filter(|number| (0.0..=ClassWeights::MOST).contains(number));
    let number = number.ok_or_else(|| format!("a weight is a number from 0 to {}", ClassWeights::MOST))?;
    Ok((class, number))
}

/// Writes the color correction of a camera.
pub(super) fn run(arguments: &MatrixArguments) -> Result<(), CliError> {
    let mut request = Request::of_camera(&arguments.camera, arguments.per)?;
    request.set_light(&arguments.illuminant)?;
    request.set_fit_target(&arguments.fit_to)?;
    request.set_correction(arguments.fit, &arguments.training)?;
    if let Some(light) = &arguments.second_illuminant {
        if matches!(arguments.format, Format::Icc | Format::Clf) {
            let reason = "ICC and CLF files hold one light; leave it out, or write dcp, dng or text".to_owned();
            return Err(CliError::Argument { argument: "--second-illuminant", reason });
        }
        request.set_second_light(light)?;
    }
    outputs::check(arguments.out.as_deref(), &request.inputs(), arguments.force)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let bytes = written(arguments, &request, &scene)?;
    outputs::stream(arguments.out.as_deref(), |out| Ok(out.write_all(&bytes)?))
}

fn written(arguments: &MatrixArguments, request: &Request, scene: &Scene<'_>) -> Result<Vec<u8>, CliError> {
    let [(kind, name)] = request.sources.as_slice() else { return Ok(Vec::new()) };
    let exposure = if arguments.white_at_one { IdtExposure::WhiteAtOne } else { IdtExposure::Rawtoaces };
    if arguments.format == Format::Clf {
        let idt = scene.input_device_transform(*kind, name, exposure)?;
        if let Some(note) = idt_note(&idt) {
            say(&format!("chromascope: {note}; --white-at-one fits it there\n"));
        }
        return Ok(clf(name, &scene.light_name(), &idt)?.into_bytes());
    }
    let file = correction_file(scene, *kind, name, arguments.model.as_deref())?;
    if let Some(Err(error)) = &file.sheet.second {
        return Err(SceneError::Rendering { name: name.clone(), error: *error }.into());
    }
    Ok(match arguments.format {
        Format::Dng => file.dng()?.into_bytes(),
        Format::Dcp => file.dcp()?,
        Format::Icc => file.icc()?,
        Format::Text | Format::Clf => {
            let idt = scene.input_device_transform(*kind, name, exposure);
            file.text(idt.ok().as_deref()).into_bytes()
        }
    })
}

fn correction_file(
    scene: &Scene<'_>,
    kind: SetKind,
    name: &str,
    model: Option<&str>,
) -> Result<CorrectionFile, CliError> {
    let query = scene.correction_sheet(kind, name)?;
    let answer = scene.results.ask(&query);
    let sheet = (*answer).clone().map_err(|error| SceneError::Rendering { name: name.to_owned(), error })?;
    Ok(CorrectionFile::new(scene, name, model, sheet)?)
}
