//! Pictures of charts and tables of narrow bands that are opened: a camera is measured from them.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::ChromascopeApp;
use crate::action::Action;
use crate::catalog::chart_picture::is_picture;
use crate::catalog::opened::Request;
use crate::catalog::spectral_images::is_spectral_exr;
use crate::document::measurement::{MY_CAMERA, MeasuredPass, Measurement};
use crate::workspaces::{PaneKind, Workspace};

impl ChromascopeApp {
    /// Takes the pictures out of what is opened, and leads to where a camera is measured from them.
    pub(super) fn take_pictures(&mut self, requests: &mut Vec<Request>) {
        let mut pictures = Vec::new();
        requests.retain(|request| match request {
            Request::Path(path) if is_picture(path) && !is_spectral_exr(path) => {
                pictures.push(path.clone());
                false
            }
            _ => true,
        });
        // The first is shown; the others follow as soon as it is taken.
        pictures.into_iter().rev().for_each(|path| self.measure_from(path));
    }

    /// Shows a picture of a chart where a camera is measured from it.
    pub(super) fn measure_from(&mut self, path: PathBuf) {
        self.end_tour();
        self.recorded.read_again(&path);
        self.view.recorded.failed.clear();
        self.view.recorded.photos.insert(path.clone(), None);
        self.view.recorded.photo = Some(path);
        let measurement = &self.history.document().measurement;
        if !measurement.passes.is_empty() {
            let to = Measurement { camera: measurement.camera.clone(), ..Measurement::default() };
            self.set_measurement("Measure from pictures, not bands", to);
        }
        self.show_workspace(Workspace::Data);
        self.view.show(PaneKind::MEASURE);
    }

    /// Measures a camera from passes over narrow bands, beside those that there are, in place of pictures.
    pub(super) fn measure_from_bands(&mut self, passes: Vec<MeasuredPass>) {
        self.end_tour();
        (self.view.recorded.photo, self.view.recorded.photos) = (None, BTreeMap::new());
        let mut to = Measurement { shots: Vec::new(), ..self.history.document().measurement.clone() };
        for pass in passes {
            match to.passes.iter_mut().find(|known| known.is_again(&pass)) {
                Some(known) => *known = pass,
                None => to.passes.push(pass),
            }
        }
        let stated = to.passes.iter().filter_map(|pass| Some(pass.pictures?.clip)).filter(|clip| clip.is_finite());
        to.clip = to.clip.or_else(|| stated.reduce(f64::min));
        if to.camera.is_empty() {
            MY_CAMERA.clone_into(&mut to.camera);
        }
        self.set_measurement("Bands of a camera", to);
        self.show_workspace(Workspace::Data);
        self.view.show(PaneKind::MEASURE);
    }

    fn set_measurement(&mut self, what: &'static str, to: Measurement) {
        self.change(&Action::Measure(what, Box::new(to)));
        self.history.end_gesture();
    }
}
