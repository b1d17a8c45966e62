//! Cards and rendered pictures out of the window.

use chromascope_core::query::Ask as _;
use chromascope_figure::{Figure, LegendPlace};

use super::ChromascopeApp;
use crate::export;
use crate::export::card::{self, Card};
use crate::export::render::{ImageProvenance, Provenance, exr_bytes, image_exr_bytes};
use crate::figures::render::index_of;
use crate::figures::{chromaticity, swatches};
use crate::files::{FileForm, SaveRequest};
use crate::panes;
use crate::plot_item::SensorId;
use crate::scene::Scene;
use crate::workspaces::PaneKind;

impl ChromascopeApp {
    /// A card of a pane's figure, or a message that it has none.
    fn card(&mut self, pane: PaneKind) -> Option<Card> {
        let shown = self.figure(pane)?;
        let scene = Scene { document: self.history.document(), catalog: &self.catalog, results: &self.results };
        let beside = pane != PaneKind::SWATCHES && pane != PaneKind::METRICS;
        let swatches = beside.then(|| swatches::figure_sized(&scene, &self.view, card::swatches_size()));
        let figure = if pane == PaneKind::CHROMATICITY {
            let [width, height] = card::figure_size();
            let figure = chromaticity::figure_sized(&scene, &self.view, [width, height - chromaticity::STRIP]);
            Figure { legend_place: LegendPlace::Inside, ..figure }
        } else {
            shown
        };
        Some(Card { figure, swatches })
    }

    /// Puts a card of a pane's figure on the clipboard.
    pub(super) fn copy_card(&mut self, ctx: &egui::Context, pane: PaneKind) {
        let Some(card) = self.card(pane) else { return };
        match card.picture() {
            Ok(picture) => {
                let size = [picture.width() as usize, picture.height() as usize];
                ctx.copy_image(egui::ColorImage::from_rgba_unmultiplied(size, picture.as_raw()));
                self.view.say(format!("{}: card copied, {} × {} pixels.", panes::title(pane), size[0], size[1]));
            }
            Err(error) => self.view.fail(error.to_string()),
        }
    }

    /// Asks where to save a card of a pane's figure.
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
        self.files.ask_to_save(SaveRequest { what, name, forms, note: String::new() });
    }

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
        let shot = self.render_service.frame()?;
        if !self.render_service.is_settled() {
            return Some(Err("The pictures are not finished yet; save again when rendering is complete.".to_owned()));
        }
        let index = index_of(shot, source)?;
        let rendering = self.results.ask(shot.query.rendering(index)?);
        let rendering = (*rendering).as_ref().ok()?;
        let document = self.history.document();
        let scene = Scene { document, catalog: &self.catalog, results: &self.results };
        let [light, white] = scene.rendered_conditions();
        let balance = if rendering.is_rgb { &white } else { "none" };
        if let Some(made) = shot.made()?.image() {
            let (image, illuminant) = (document.render.mesh.name(), light.clone());
            let provenance = ImageProvenance { source: &source.name, balance, illuminant: &illuminant, image: &image };
            let bytes = image_exr_bytes(made.placed(), made.signals(index)?, rendering, &provenance);
            return Some(bytes.map_err(|error| error.to_string()));
        }
        let image = shot.made()?.mesh()?.images.get(index)?.as_ref()?;
        let shading = &shot.query.mesh()?.shading;
        let provenance = Provenance {
            source: &source.name,
            balance,
            illuminant: &light,
            material: &document.render.material,
            garment: document.render.worn(),
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
