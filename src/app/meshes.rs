//! Opening of the user's meshes and spectral images: read first, then shown.

use std::path::{Path, PathBuf};

use super::ChromascopeApp;
use crate::action::{Action, RenderAction};
use crate::document::render::MeshChoice;
use crate::format::file_name;
use crate::workspaces::Workspace;

impl ChromascopeApp {
    pub(super) fn open_image(&mut self, path: &Path) {
        self.meshes.cancel();
        self.images.open(path);
        self.view.say(format!("Reading {}…", file_name(path)));
    }

    pub(super) fn take_images(&mut self) {
        for opened in self.images.poll() {
            match opened.result {
                Ok(image) => {
                    let message = image.message();
                    self.show_scene(RenderAction::OpenImage(opened.path.clone()), opened.path, message);
                }
                Err(sentence) => self.view.fail(sentence),
            }
        }
        let wanted = match &self.history.document().render.mesh {
            MeshChoice::Image(path) => Some(path.as_path()),
            _ => None,
        };
        self.images.keep(wanted);
    }

    fn show_scene(&mut self, action: RenderAction, path: PathBuf, message: String) {
        self.view.remember_file(path);
        self.history.apply(&Action::Render(action));
        self.history.end_gesture();
        self.view.saved.workspace = Workspace::Render;
        self.view.maximized = None;
        self.view.say(message);
    }

    pub(super) fn open_mesh(&mut self, path: &Path) {
        let before = self.meshes.opening().filter(|before| before != path);
        self.images.cancel();
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
                    self.show_scene(RenderAction::Open(opened.path.clone()), opened.path, mesh.message.clone());
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

    pub(super) fn stop_opening(&mut self) -> bool {
        let Some(path) = self.meshes.cancel().or_else(|| self.images.cancel()) else { return false };
        self.view.say(format!("Reading {} stopped. Nothing was changed.", file_name(&path)));
        true
    }
}
