//! Sets of the library as files.

use super::ChromascopeApp;
use crate::document::SetKind;
use crate::export::spectra::{self, Form};
use crate::files::{FileForm, SaveRequest};
use crate::results::Results;
use crate::scene::Scene;

impl ChromascopeApp {
    /// Writes a set beside the window and asks where to save it; what differs in the file is said once it is there.
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
}
