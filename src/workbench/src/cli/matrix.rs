//! `matrix`: the color correction of a camera, and the files in which other programs take it.

use std::ffi::OsString;

use chromascope_core::correction::CorrectionMethod;
use chromascope_core::correction::aces::IdtExposure;
use chromascope_core::correction::neutral::Neutral;
use chromascope_core::query::Ask as _;
use chromascope_core::query::correction::IdtQuery;
use chromascope_profile::icc::IccVersion;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{ArgMatches, Args, ValueEnum};

use super::arguments::{FitArguments, OutArguments, method};
use super::error::{Result, refused};
use super::outputs;
use super::reading::Per;
use super::request::{Request, say_light};
use crate::document::start::Start;
use crate::export::profile::{
    CorrectionFileQuery, CorrectionForm, CorrectionRequest, RAWTOACES, clf, has_ratio, idt_note,
};
use crate::results::Results;
use crate::scene::{Scene, SceneError};
use crate::terminal::{say, shown_json};

const EXAMPLES: &str = "Examples:
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

/// Color correction matrix of a camera, with its errors, as text, DNG values, DCP, ICC or CLF
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct MatrixArguments {
    /// The camera: a name, or a file with three sensitivities
    #[arg(value_name = "CAMERA|FILE")]
    camera: OsString,
    /// The illuminant: a name, a file with one curve, `daylight:K` or `blackbody:K`
    #[arg(long, value_name = "NAME|FILE")]
    illuminant: OsString,
    /// A filter in front of the illuminants: a name of `chromascope list filters`, or a file with one transmittance; may be repeated
    #[arg(long, value_name = "NAME|FILE")]
    filter: Vec<OsString>,
    /// A second illuminant, for text, json, dng and dcp: a name, a file with one curve, `daylight:K` or `blackbody:K`
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
    /// The camera model as its raw files state it (`UniqueCameraModel`), by which raw developers choose a DCP file [default: by the
    /// built-in table of names]
    #[arg(long, value_name = "MODEL")]
    model: Option<String>,
    /// `AsShotNeutral` of a raw file under the illuminant, in place of the table's own ratio between the channels; dng, dcp and clf need
    /// it where that ratio is lost or implausible
    #[arg(long, value_name = "R,G,B")]
    neutral: Option<Neutral>,
    /// For icc: the version of the format; 2 for programs that read no version 4
    #[arg(long, value_name = "VERSION", value_parser = icc_version(), default_value = "4")]
    icc_version: IccVersion,
    /// For clf: fit with white at 1 where rawtoaces' scaling puts it elsewhere
    #[arg(long)]
    white_at_one: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    out: OutArguments,
}

fn icc_version() -> impl TypedValueParser<Value = IccVersion> {
    PossibleValuesParser::new(["2", "4"]).map(|text| if text == "2" { IccVersion::V2 } else { IccVersion::V4 })
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
    /// One object with matrices and errors, with all digits
    Json,
}

pub(super) fn run(arguments: &MatrixArguments, _: &ArgMatches) -> Result<()> {
    let cameras = std::slice::from_ref(&arguments.camera);
    let mut request = Request::of_cameras(Start::Colorimetry, "CAMERA", cameras, arguments.per)?;
    request.set_light(&arguments.illuminant)?;
    request.set_filters(&arguments.filter)?;
    request.set_fit_target(&arguments.fit_to)?;
    request.set_correction(arguments.fit, &arguments.training)?;
    if let Some(light) = &arguments.second_illuminant {
        if matches!(arguments.format, Format::Icc | Format::Clf) {
            let reason = "ICC and CLF files hold one light; leave it out, or write dcp, dng or text".to_owned();
            return refused("--second-illuminant", reason);
        }
        request.set_second_light(light)?;
    }
    arguments.out.check(&request)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let bytes = written(arguments, &request, &scene)?;
    say_light(&scene)?;
    outputs::stream(arguments.out.path.as_deref(), |out| Ok(out.write_all(&bytes)?))
}

fn written(arguments: &MatrixArguments, request: &Request, scene: &Scene<'_>) -> Result<Vec<u8>> {
    let [(kind, name)] = request.sources.as_slice() else {
        return refused("CAMERA", format!("the folder has {} cameras; name the file of one", request.sources.len()));
    };
    let exposure = if arguments.white_at_one { IdtExposure::WhiteAtOne } else { IdtExposure::Rawtoaces };
    let neutral = arguments.neutral;
    if arguments.format == Format::Clf {
        let light = scene.light_name();
        has_ratio(name, &light, scene.channel_ratio(name)?, neutral)?;
        let query = IdtQuery { neutral, ..scene.input_device_transform(*kind, name, exposure)? };
        let idt = scene.results.ask(&query);
        let idt = idt.as_ref().as_ref().map_err(|error| SceneError::Idt { name: name.clone(), error: *error })?;
        if let Some(note) = idt_note(idt) {
            say(&format!("chromascope: {note}; --white-at-one fits it there\n"));
        }
        return Ok(clf(name, &light, idt, RAWTOACES)?.into_bytes());
    }
    let request = CorrectionRequest { camera: name, model: arguments.model.as_deref(), neutral, exposure };
    let file = (*scene.results.ask(&CorrectionFileQuery::new(scene, request)?)).clone()?;
    if let Some(Err(error)) = &file.sheet.second {
        return Err(SceneError::Rendering { name: name.clone(), error: *error }.into());
    }
    if arguments.format == Format::Json {
        return Ok(shown_json(&file.json()).into_owned().into_bytes());
    }
    Ok(file.written(match arguments.format {
        Format::Dng => CorrectionForm::Dng,
        Format::Dcp => CorrectionForm::Dcp,
        Format::Icc => CorrectionForm::Icc(arguments.icc_version),
        Format::Text | Format::Clf | Format::Json => CorrectionForm::Text,
    })?)
}
