//! `render`: pictures of a mesh or a spectral image, made as in the window and written to files.

mod accuracy;
pub(super) mod arguments;
pub(super) mod files;
mod image;
pub(super) mod setup;
mod stats;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use chromascope_core::camera::Rendering;
use chromascope_core::query::DifferenceError;
use chromascope_core::query::render::picture::{Pictures, PicturesQuery};
use chromascope_core::render::{CameraImage, Picture};
use clap::ArgMatches;
use exr::prelude::LayerAttributes;
use rayon::prelude::*;

use self::arguments::{Format, RenderArguments};
pub(super) use self::files::make_folder;
use self::files::{file_names, patiently};
use self::setup::Setup;
use super::error::{CliError, Result};
use super::outputs::{self, is_standard_output, put, show, write_to};
use crate::export::render::{PictureError, exr_bytes, mesh_header, png_bytes};
use crate::figures::render::headline::{Detail, Measure};
use crate::figures::render::returned;
use crate::profiler::plans;
use crate::results::{Count, Results};
use crate::scene::{ComparedSensor, Scene, SceneError};
use crate::terminal::{say, shown_json};

pub(super) fn run(arguments: &RenderArguments, matches: &ArgMatches) -> Result<()> {
    if let Some(path) = &arguments.image {
        return image::run(arguments, path, matches);
    }
    let start = Instant::now();
    let setup = Setup::new(arguments, matches)?;
    let results = Results::default();
    let made = patiently("rendering", || Made::new(arguments, &setup, &results))?;
    let files = Instant::now();
    made.write(arguments)?;
    let times = Times { all: start.elapsed(), reading: setup.reading, writing: files.elapsed() };
    // Before any query is evaluated for the measurement.
    let counts = results.counts();
    let lines = made.lines(&counts, &times);
    let to_stdout = arguments.stats.as_deref().is_some_and(is_standard_output);
    if to_stdout {
        say(&lines);
    } else {
        show(&lines)?;
    }
    match &arguments.stats {
        Some(path) => put(&shown_json(&patiently("measuring", || stats::json(&made, &counts, &times))), Some(path)),
        None => Ok(()),
    }
}

/// Times that no query records.
struct Times {
    all: Duration,
    reading: Duration,
    writing: Duration,
}

struct Made<'a> {
    setup: &'a Setup,
    scene: Scene<'a>,
    sources: Vec<ComparedSensor>,
    /// Reason that a sensor cannot be compared with the reference.
    not_comparable: Vec<Option<DifferenceError>>,
    files: Vec<PathBuf>,
    query: PicturesQuery,
    pictures: Pictures,
}

impl<'a> Made<'a> {
    fn new(arguments: &RenderArguments, setup: &'a Setup, results: &'a Results) -> Result<Self> {
        let document = &setup.request.document;
        let scene = Scene { document, catalog: &setup.request.catalog, results };
        let sources = scene.sources();
        let mesh = scene.mesh_of(setup.own_mesh.as_ref());
        let mesh = mesh.ok_or_else(|| CliError::File(format!("{}: no mesh", arguments.mesh.display())))?;
        let query = scene.pictures_of(&sources, mesh, setup.viewpoint, setup.finish, None)?;
        // Exposure refers to the reference, compared or not. Errors are reported before anything large is computed.
        scene.rendered(&query.reference, &document.reference)?;
        for (source, of) in sources.iter().zip(&query.sources) {
            scene.rendered(of, &source.name)?;
        }
        let comparable = |source: &ComparedSensor| Ok(scene.comparable(source.kind, &source.name)?.err());
        let not_comparable = sources.iter().map(comparable).collect::<Result<_, SceneError>>()?;
        let files = file_names(arguments, &setup.mesh_name, &sources);
        let outputs = files.iter().map(PathBuf::as_path).chain(arguments.stats.as_deref());
        outputs::check(outputs, &setup.request.inputs(), arguments.force)?;
        make_folder(&arguments.out)?;
        let unfinished = || CliError::File("the pictures were not finished".to_owned());
        let pictures = scene.rendered(&query, &document.reference)?.ok_or_else(unfinished)?;
        Ok(Self { setup, scene, sources, not_comparable, files, query, pictures })
    }

    /// Writes the files side by side: encoding takes longer than the disk.
    fn write(&self, arguments: &RenderArguments) -> Result<()> {
        let names = [self.scene.light_name(), self.scene.document.white.name()];
        let contents = (0..self.files.len()).map(|index| self.content(index, arguments, &names));
        let contents = contents.collect::<Result<Vec<_>, _>>()?;
        contents.par_iter().zip(&self.files).try_for_each(|(content, path)| {
            let bytes = content.bytes().map_err(|error| CliError::Picture { path: path.clone(), error })?;
            write_to(path, &bytes)
        })
    }

    fn content(&self, index: usize, arguments: &RenderArguments, conditions: &[String; 2]) -> Result<Content<'_>> {
        let name = &self.sources[index].name;
        let picture = self.pictures.pictures[index].as_ref();
        let picture = picture.map_err(|error| SceneError::Rendering { name: name.clone(), error: *error })?;
        if arguments.format == Format::Png {
            return Ok(Content::Png(picture));
        }
        let image = self.pictures.images[index].as_ref();
        let image = image.ok_or_else(|| CliError::File(format!("{name}: no picture")))?;
        let rendering = self.scene.rendered(&self.query.sources[index], name)?;
        let subject = (&self.scene.document.render, self.setup.mesh_name.as_str());
        let header = mesh_header(&rendering, name, conditions, subject, &self.query.shading);
        Ok(Content::Exr { image, rendering: Box::new(rendering), header: Box::new(header) })
    }

    /// A line for each picture, and one for all.
    fn lines(&self, counts: &BTreeMap<&'static str, Count>, times: &Times) -> String {
        let pictures = self.files.iter().enumerate();
        let lines = pictures.map(|(index, path)| {
            let plan = self.plan(index).map_or_else(String::new, |plan| format!("; {plan}"));
            format!("{}: {}{plan}", path.display(), self.difference(index))
        });
        let mut lines: Vec<String> = lines.collect();
        lines.extend(returned::words(&self.scene).map(|words| format!("surface: {}", words.text)));
        let milliseconds = |time: Duration| time.as_secs_f64() * 1e3;
        let stages = counts.iter().map(|(name, count)| (*name, count.own_time));
        let stages = stages.chain([("mesh file", times.reading), ("files", times.writing)]);
        let mut stages: Vec<(&str, f64)> = stages.map(|(name, time)| (name, milliseconds(time))).collect();
        stages.sort_by(|a, b| b.1.total_cmp(&a.1));
        let stages = stages.iter().filter(|(_, time)| *time >= 0.5).map(|(name, time)| format!("{name} {time:.0}"));
        let (count, size) = (self.files.len(), self.setup.finish.size);
        lines.push(format!(
            "{count} picture{} of {}x{}, {} of {} samples lit: {:.0} ms ({})",
            if count == 1 { "" } else { "s" },
            size.width,
            size.height,
            self.pictures.geometry.lit,
            size.columns() * size.rows(),
            milliseconds(times.all),
            stages.collect::<Vec<_>>().join(", ")
        ));
        lines.push(String::new());
        lines.join("\n")
    }

    /// Integration methods of a picture within a tolerance, in words.
    fn plan(&self, index: usize) -> Option<String> {
        let planned = plans::planned(&self.query, &self.query.sources[index], self.scene.results).ok()??;
        let bounds = planned.bounds.words();
        Some(planned.explanation.map_or_else(|| bounds.clone(), |explanation| format!("{explanation}; {bounds}")))
    }

    fn difference(&self, index: usize) -> String {
        match (&self.pictures.differences[index], self.not_comparable[index]) {
            _ if self.sources[index].is_reference => "the reference".to_owned(),
            (Some(difference), None) => Measure::of(&self.query).words(difference, Detail::Largest),
            (_, why) => no_difference(why),
        }
    }
}

fn no_difference(why: Option<DifferenceError>) -> String {
    match why {
        Some(DifferenceError::Ways) => "no difference by Eq 13; add --transform fitted to compare".to_owned(),
        Some(other) => format!("no difference: {other}"),
        None => "no difference".to_owned(),
    }
}

enum Content<'a> {
    Png(&'a Picture),
    Exr { image: &'a CameraImage, rendering: Box<Rendering>, header: Box<LayerAttributes> },
}

impl Content<'_> {
    fn bytes(&self) -> Result<Vec<u8>, PictureError> {
        match self {
            Self::Png(picture) => png_bytes(picture),
            Self::Exr { image, rendering, header } => {
                exr_bytes(image.placed(), image.signals(), rendering, (**header).clone())
            }
        }
    }
}
