//! Opening of the user's mesh files: read first, then shown.

use std::path::Path;

use super::ChromascopeApp;
use crate::action::{Action, RenderAction};
use crate::document::render::MeshChoice;
use crate::format::file_name;
use crate::workspaces::Workspace;

impl ChromascopeApp {
    /// Begins to read a mesh. The document stays as it is until that is done.
    pub(super) fn open_mesh(&mut self, path: &Path) {
        let before = self.meshes.opening().filter(|before| before != path);
        self.meshes.open(path);
        let given_up =
            before.map(|before| format!(" {} was canceled: one mesh is shown at a time.", file_name(&before)));
        self.view.say(format!("Reading {}… Esc stops.{}", file_name(path), given_up.unwrap_or_default()));
    }

    /// Shows meshes that were read, and stops reads that are no longer needed.
    pub(super) fn take_meshes(&mut self) {
        for opened in self.meshes.poll() {
            match opened.result {
                Ok(mesh) => {
                    self.view.remember_file(opened.path.clone());
                    self.history.apply(&Action::Render(RenderAction::Open(opened.path)));
                    self.history.end_gesture();
                    self.view.saved.workspace = Workspace::Render;
                    self.view.maximized = None;
                    self.view.say(mesh.message.clone());
                }
                Err(sentence) => self.view.fail(sentence),
            }
        }
        let wanted = match &self.history.document().render.mesh {
            MeshChoice::File(path) => Some(path.as_path()),
            _ => None,
        };
        self.meshes.keep(wanted);
    }

    /// Stops reading a mesh, if one is being opened.
    pub(super) fn stop_opening(&mut self) -> bool {
        let Some(path) = self.meshes.cancel() else { return false };
        self.view.say(format!("Reading {} stopped. Nothing was changed.", file_name(&path)));
        true
    }
}
