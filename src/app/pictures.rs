//! Rendered pictures as files.

use chromascope_core::query::Ask as _;

use super::ChromascopeApp;
use crate::export::render::{Provenance, exr_bytes};
use crate::figures::render::index_of;
use crate::files::{FileForm, SaveRequest};
use crate::plot_item::SensorId;
use crate::scene::Scene;

impl ChromascopeApp {
    /// Saves a source's picture with its numbers.
    pub(super) fn export_exr(&mut self, source: &SensorId) {
        match self.exr(source) {
            Some(Ok(bytes)) => {
                let name: String = source.name.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
                let name = format!("{name}.exr");
                let what = format!("the picture of {}", source.name);
                let forms = vec![FileForm::of_bytes("exr", bytes)];
                self.files.ask_to_save(SaveRequest { what, name, forms, note: String::new() });
            }
            Some(Err(why)) => self.view.fail(why),
            None => self.view.fail(format!("{}: no picture yet.", source.name)),
        }
    }

    fn exr(&self, source: &SensorId) -> Option<Result<Vec<u8>, String>> {
        let shot = self.studio.frame()?;
        if !self.studio.is_settled() {
            return Some(Err("The pictures are not finished yet; save again when rendering is complete.".to_owned()));
        }
        let index = index_of(shot, source)?;
        let image = shot.made()?.images.get(index)?.as_ref()?;
        let rendering = self.results.ask(&shot.query.sources.get(index)?.rendering);
        let rendering = (*rendering).as_ref().ok()?;
        let document = self.history.document();
        let scene = Scene { document, catalog: &self.catalog, results: &self.results };
        let [light, white] = scene.rendered_conditions();
        let shading = &shot.query.shading;
        let provenance = Provenance {
            source: &source.name,
            balance: if rendering.is_rgb { &white } else { "none" },
            illuminant: &light,
            material: &document.render.material,
            mesh: &document.render.mesh.name(),
            quality: shading.quality,
            lighting: shading.geometry.lighting,
            viewpoint: shading.geometry.visibility.viewpoint,
            surface: shading.surface,
            reading: shading.reading,
            sky: document.render.sky,
            thin: document.render.thin,
        };
        Some(exr_bytes(image, rendering, &provenance).map_err(|error| error.to_string()))
    }
}
