//! Sets of the library as files.

use chromascope_core::query::Ask as _;

use super::ChromascopeApp;
use crate::document::SetKind;
use crate::export::profile::{self, CorrectionFileQuery, CorrectionForm};
use crate::export::spectra::{self, Form};
use crate::files::{FileForm, SaveRequest};
use crate::results::Results;
use crate::scene::Scene;

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
            let file = spectra::file(&entry, form, &Results::default()).map_err(refused)?;
            Ok(SaveRequest {
                what,
                name: file.name,
                forms: vec![FileForm::of_bytes(form.format.ending(), file.text.into_bytes())],
                note: spectra::notes_in_words(&file.notes),
            })
        });
    }

    /// Puts the curves of a set on the clipboard as text.
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
        let view = &self.view.correction;
        let Some(camera) = view.camera(&scene) else {
            return self.view.fail("No camera is compared: choose one in the pane Correction.");
        };
        let query = CorrectionFileQuery::new(&scene, view.request(&scene, &camera));
        self.files.make_to_save(move || {
            let file = query.and_then(|query| (*Results::default().ask(&query)).clone()).map_err(|e| e.to_string())?;
            let bytes = file.written(form).map_err(|error| error.to_string())?;
            let (what, name) = (format!("{}, color correction", file.camera), profile::file_name(&file, form));
            let forms = vec![FileForm::of_bytes(form.ending(), bytes)];
            Ok(SaveRequest { what, name, forms, note: String::new() })
        });
    }
}
