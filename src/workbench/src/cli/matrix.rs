//! `chromascope matrix`: the color correction of a camera, and the files in which other programs take it.

pub(super) mod arguments;

use chromascope_core::correction::aces::IdtExposure;
use chromascope_core::query::Ask as _;
use chromascope_core::query::correction::IdtQuery;

use arguments::{Format, MatrixArguments};

use super::error::CliError;
use super::outputs;
use super::request::Request;
use super::tables::say_light;
use crate::document::start::Start;
use crate::export::profile::{CorrectionFileQuery, CorrectionForm, CorrectionRequest, clf, has_ratio, idt_note};
use crate::results::Results;
use crate::scene::{Scene, SceneError};
use crate::terminal::say;

/// Writes the color correction of a camera.
pub(super) fn run(arguments: &MatrixArguments) -> Result<(), CliError> {
    let cameras = std::slice::from_ref(&arguments.camera);
    let mut request = Request::of_cameras(Start::Colorimetry, "CAMERA", cameras, arguments.per)?;
    request.set_light(&arguments.illuminant)?;
    request.set_filters(&arguments.filter)?;
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
    say_light(&scene)?;
    outputs::stream(arguments.out.as_deref(), |out| Ok(out.write_all(&bytes)?))
}

fn written(arguments: &MatrixArguments, request: &Request, scene: &Scene<'_>) -> Result<Vec<u8>, CliError> {
    let [(kind, name)] = request.sources.as_slice() else { return Ok(Vec::new()) };
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
        return Ok(clf(name, &light, idt)?.into_bytes());
    }
    let request = CorrectionRequest { camera: name, model: arguments.model.as_deref(), neutral, exposure };
    let file = (*scene.results.ask(&CorrectionFileQuery::new(scene, request)?)).clone()?;
    if let Some(Err(error)) = &file.sheet.second {
        return Err(SceneError::Rendering { name: name.clone(), error: *error }.into());
    }
    Ok(file.written(match arguments.format {
        Format::Dng => CorrectionForm::Dng,
        Format::Dcp => CorrectionForm::Dcp,
        Format::Icc => CorrectionForm::Icc(arguments.icc_version),
        Format::Text | Format::Clf => CorrectionForm::Text,
    })?)
}
