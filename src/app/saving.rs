//! Sets of the library as files.

use super::ChromascopeApp;
use crate::catalog::Kind;
use crate::export::spectra::{self, Form};
use crate::files::SaveRequest;
use crate::scene::Scene;

impl ChromascopeApp {
    /// Asks where to save a set; what differs in the file is said once it is there.
    pub(super) fn save_set(&mut self, kind: Kind, name: &str, form: Form) {
        let scene = Scene { document: self.history.document(), catalog: &self.catalog, results: &self.results };
        let entry = match scene.entry(kind, name) {
            Ok(entry) => entry,
            Err(error) => return self.view.fail(error.to_string()),
        };
        match spectra::file(&entry, form, &self.results) {
            Ok(file) => self.files.ask_to_save(SaveRequest {
                name: file.name,
                extension: form.format.ending(),
                bytes: file.text.into_bytes(),
                note: spectra::notes_in_words(&file.notes),
            }),
            Err(error) => self.view.fail(format!("{name} cannot be saved as {}: {error}.", form.name())),
        }
    }
}
