//! `report`: the paper's figures and claims with public data, as files in a folder.

pub(super) mod arguments;

use std::io;
use std::path::PathBuf;

use self::arguments::ReportArguments;
use super::error::CliError;
use super::outputs::{self, show, write_to};
use super::render::make_folder;
use super::request::Request;
use crate::document::start::Start;
use crate::document::{Document, SetKind};
use crate::report::{PAGE, Report};
use crate::results::Results;
use crate::terminal::draw_progress;

/// Makes the report.
pub(super) fn run(arguments: &ReportArguments) -> Result<(), CliError> {
    let mut request = Request::of_cameras(Start::Paper, "--camera", &arguments.camera, arguments.per)?;
    request.set_chart(arguments.chart.as_deref())?;
    if let Some(illuminant) = &arguments.illuminant {
        request.set_light(illuminant)?;
    }
    let folder = &arguments.out;
    let paths: Vec<PathBuf> = Report::names().iter().map(|name| folder.join(name)).collect();
    outputs::check(paths.iter().map(PathBuf::as_path), &request.inputs(), arguments.force)?;
    make_folder(folder)?;
    let document = document(&request);
    let report = Report::new(document, arguments.illuminant.is_some(), arguments.picture_size);
    let results = Results::default();
    for step in 0..Report::STEPS {
        draw_progress(step, Report::STEPS, &Report::name(step));
        let files = report.make(step, &results).map_err(CliError::File)?;
        for file in files {
            let path = folder.join(&file.name);
            write_to(&path, &file.bytes).map_err(|error: io::Error| CliError::Output { path, error })?;
        }
    }
    draw_progress(Report::STEPS, Report::STEPS, "");
    show(&format!("{}\n", folder.join(PAGE).display()))
}

/// The paper's start with the cameras that were named.
fn document(request: &Request) -> Document {
    let mut document = request.document.clone();
    if request.sources.is_empty() {
        document.compared = Start::Paper.document().compared;
        return document;
    }
    document.compare(&document.reference.clone(), SetKind::Observer);
    for (kind, name) in &request.sources {
        document.compare(name, *kind);
    }
    document
}
