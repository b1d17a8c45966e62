//! Sets of the library, cards, rendered pictures, color corrections and reports as files and on the clipboard.

use std::path::PathBuf;
use std::sync::Arc;

use chromascope_core::query::Ask as _;
use chromascope_figure::{Figure, FigureRoom, LegendPlace};
use chromascope_measure::harness::now;

use super::ChromascopeApp;
use crate::document::SetKind;
use crate::document::start::Start;
use crate::export::card::{self, Card};
use crate::export::profile::{self, CorrectionFileQuery, CorrectionForm};
use crate::export::render::{exr_bytes, image_header, mesh_header};
use crate::export::spectra::{self, Form};
use crate::figures::render::index_of;
use crate::figures::{chromaticity, swatches};
use crate::files::{FileForm, SaveRequest, new_folder};
use crate::format::{io_reason, slug};
use crate::plot_item::SensorId;
use crate::report::{PIXELS, Report, ReportJob};
use crate::results::Results;
use crate::scene::Scene;
use crate::view::ReportOn;
use crate::workspaces::PaneKind;
use crate::{export, panes};

impl ChromascopeApp {
    /// Writes a set in the background and asks where to save it; differences from the set are reported when it is
    /// written.
    pub(super) fn save_set(&mut self, kind: SetKind, name: &str, form: Form) {
        let scene = Scene { document: self.history.document(), catalog: &self.catalog, results: &self.results };
        let entry = match scene.entry(kind, name) {
            Ok(entry) => entry,
            Err(error) => return self.view.fail(error.to_string()),
        };
        let what = format!("{name} as {}", form.name());
        self.files.make_to_save(move || {
            let refused = |error| format!("{} cannot be saved as {}: {error}.", entry.name, form.name());
            let file = spectra::file(&entry, form, &Results::default(), Some(&now())).map_err(refused)?;
            let bytes = FileForm::of_bytes(form.format.ending(), file.text.into_bytes());
            let beside = form.format.is_csv().then_some(file.beside);
            let forms = vec![FileForm { beside, ..bytes }];
            let note = spectra::notes_in_words(&file.notes);
            Ok(SaveRequest { note, ..SaveRequest::new(what, file.name, forms) })
        });
    }

    pub(super) fn copy_set(&mut self, ctx: &egui::Context, kind: SetKind, name: &str) {
        let scene = Scene { document: self.history.document(), catalog: &self.catalog, results: &self.results };
        let table = scene.entry(kind, name).map_err(|error| error.to_string()).and_then(|entry| {
            spectra::table(&entry, &self.results).map_err(|error| format!("{name} cannot be copied: {error}."))
        });
        match table {
            Ok(table) => {
                ctx.copy_text(table.to_tsv());
                self.view.say(format!("{name}: {} wavelengths copied as text.", table.rows.len()));
            }
            Err(why) => self.view.fail(why),
        }
    }

    /// Makes a file of the camera's color correction in the background and asks where to save it. Needs no visible pane.
    pub(super) fn save_correction(&mut self, form: CorrectionForm) {
        let scene = Scene { document: self.history.document(), catalog: &self.catalog, results: &self.results };
        let Some(SensorId { name: camera, .. }) = self.view.camera(&scene) else {
            return self.view.fail("No camera is compared: choose one on the page Matrix of Rank.");
        };
        let query = CorrectionFileQuery::new(&scene, self.view.correction.request(&scene, &camera));
        self.files.make_to_save(move || {
            let file = query.and_then(|query| (*Results::default().ask(&query)).clone()).map_err(|e| e.to_string())?;
            let bytes = file.written(form).map_err(|error| error.to_string())?;
            let (what, name) = (format!("{}, color correction", file.of.camera), profile::file_name(&file, form));
            let forms = vec![FileForm::of_bytes(form.ending(), bytes)];
            Ok(SaveRequest::new(what, name, forms))
        });
    }

    pub(super) fn save_profile(&mut self, camera: &str, form: CorrectionForm, bytes: &[u8]) {
        let name = format!("{}.{}", slug(camera), form.ending());
        let forms = vec![FileForm::of_bytes(form.ending(), bytes.to_vec())];
        self.files.ask_to_save(SaveRequest::new(format!("the profile of {camera}"), name, forms));
    }

    pub(super) fn card(&mut self, pane: PaneKind) -> Option<Card> {
        let shown = self.figure(pane)?;
        let scene = Scene { document: self.history.document(), catalog: &self.catalog, results: &self.results };
        let beside = pane != PaneKind::SWATCHES && pane != PaneKind::METRICS;
        let look = self.view.look(pane);
        let swatches = beside.then(|| swatches::figure_sized(&scene, &look, card::swatches_size()));
        let figure = if pane == PaneKind::CHROMATICITY {
            let [width, height] = card::figure_size();
            let size = [width, height - chromaticity::STRIP];
            let figure = chromaticity::figure_sized(&scene, &look, FigureRoom::default(), size);
            // The swatches' heads are its legend.
            Figure { legend_place: LegendPlace::None, ..figure }
        } else {
            shown
        };
        let title = swatches::headline(&scene).unwrap_or_else(|| figure.title.clone());
        let figure = Figure { title, ..figure };
        Some(Card { figure, swatches })
    }

    pub(super) fn save_card(&mut self, pane: PaneKind) {
        let Some(card) = self.card(pane) else { return };
        let make = move || {
            let file = card.picture().and_then(|picture| export::png_file(&picture));
            file.map_err(|error| error.to_string())
        };
        let title = panes::title(pane);
        let name = format!("{}-card.png", title.to_lowercase());
        let forms = vec![FileForm::new("png", make)];
        let what = format!("{title} as a card");
        self.files.ask_to_save(SaveRequest::new(what, name, forms));
    }

    pub(super) fn export_exr(&mut self, source: &SensorId) {
        match self.exr(source) {
            Some(Ok(bytes)) => {
                let name: String = source.name.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
                let name = format!("{name}.exr");
                let what = format!("the picture of {}", source.name);
                let forms = vec![FileForm::of_bytes("exr", bytes)];
                self.files.ask_to_save(SaveRequest::new(what, name, forms));
            }
            Some(Err(why)) => self.view.fail(why),
            None => self.view.fail(format!("{}: no picture yet.", source.name)),
        }
    }

    fn exr(&self, source: &SensorId) -> Option<Result<Vec<u8>, String>> {
        let shot = self.render_service.frame()?;
        if !self.render_service.is_settled() {
            return Some(Err("The pictures are not finished yet; save again when rendering is complete.".to_owned()));
        }
        let index = index_of(shot, source)?;
        let rendering = self.results.ask(shot.query.rendering(index)?);
        let rendering = (*rendering).as_ref().ok()?;
        let document = self.history.document();
        let scene = Scene { document, catalog: &self.catalog, results: &self.results };
        let (conditions, subject) = (scene.rendered_conditions(), document.render.mesh.name());
        let bytes = if let Some(made) = shot.made()?.image() {
            let header = image_header(rendering, &source.name, &conditions, &subject);
            exr_bytes(made.placed(), made.signals(index)?, rendering, header)
        } else {
            let image = shot.made()?.mesh()?.images.get(index)?.as_ref()?;
            let (shading, subject) = (&shot.query.mesh()?.shading, (&document.render, subject.as_str()));
            let header = mesh_header(rendering, &source.name, &conditions, subject, shading);
            exr_bytes(image.placed(), image.signals(), rendering, header)
        };
        Some(bytes.map_err(|error| error.to_string()))
    }
}

impl ChromascopeApp {
    /// Begins a report in a folder of its own within the chosen one, so that nothing is overwritten.
    pub(super) fn begin_report(&mut self, chosen: &[PathBuf]) {
        let Some((on, parent)) = self.report_on.take().zip(chosen.first()) else { return };
        let name = if on == ReportOn::Library { "Chromascope library" } else { "Chromascope report" };
        let folder = match new_folder(parent, name) {
            Ok(folder) => folder,
            Err(error) => {
                let why = io_reason(&error);
                return self.view.fail(format!("Cannot make a folder in {}: {why}.", parent.display()));
            }
        };
        let report = match on {
            ReportOn::Comparison => {
                let document = self.history.document();
                Report::on_comparison(document, Ok(self.meshes.chosen(&document.render.mesh)), PIXELS)
            }
            ReportOn::Paper => Report::new(Start::Paper.document(), false, PIXELS),
            ReportOn::Document => Report::of_document(self.history.document()),
            ReportOn::Library => Report::of_library(),
        };
        self.later.begin(Report::NAME, ReportJob::all(&Arc::new(report), &folder));
    }

    pub(super) fn take_report(&mut self) {
        let report = self.later.seen::<ReportJob>(Report::NAME);
        let Some(page) = report.stages.first().map(|job| job.folder.join(job.report.page())) else { return };
        let is_finished = report.done == report.stages.len();
        if let Err(why) = report.current().and_then(|made| made.map_or(Ok(()), |made| (*made).clone())) {
            self.later.stop::<ReportJob>(Report::NAME);
            self.view.fail(format!("The report is not finished. {why}"));
        } else if is_finished {
            self.later.stop::<ReportJob>(Report::NAME);
            self.view.say(format!("Report saved: {}.", page.display()));
        }
    }

    pub(super) fn stop_report(&mut self) -> bool {
        let report = self.later.seen::<ReportJob>(Report::NAME);
        let Some(job) = report.stages.first() else { return false };
        self.later.stop::<ReportJob>(Report::NAME);
        let (done, all, folder) = (report.done, report.stages.len(), job.folder.display());
        self.view.say(format!("Report stopped after {done} of {all} steps; these are in {folder}."));
        true
    }
}
