//! The scene as figures: the same value is drawn on screen, saved as SVG and PNG, and written as numbers.

pub mod accuracy;
pub mod chromaticity;
pub mod correction;
pub mod curves;
pub mod data_set;
pub mod head_to_head;
mod labels;
pub mod light;
pub mod metrics;
pub mod portrait;
pub mod recorded;
pub mod render;
pub mod report_card;
pub mod spectra;
pub mod strip;
pub mod swatches;
pub mod thumbnail;

use std::sync::Arc;

use crate::catalog::opened::{FilePreview, Opened};
use crate::profiler::{Measured, Profiler};
use crate::render_service::{RenderService, RenderedFrame};
use crate::scene::Scene;
use crate::view::View;

/// Input of an exported figure: the scene, the view and the latest background results.
#[derive(Clone)]
pub struct FigureInput<'a> {
    /// The scene.
    pub scene: &'a Scene<'a>,
    /// View settings.
    pub view: &'a View,
    /// The current pictures.
    pub pictures: Option<&'a RenderedFrame>,
    /// Latest measurements.
    pub measured: &'a Measured,
    /// Latest preview of the file selected in Import.
    pub preview: Option<Arc<FilePreview>>,
}

impl<'a> FigureInput<'a> {
    /// Input of a scene with its latest background results.
    pub fn of(
        (scene, view): (&'a Scene<'a>, &'a View),
        render_service: &'a RenderService,
        profiler: &'a Profiler,
        opened: &Opened,
    ) -> Self {
        let pictures = render_service.frame().map(AsRef::as_ref);
        Self { scene, view, pictures, measured: &profiler.measured, preview: opened.preview() }
    }

    /// A scene of which nothing was made in the background.
    pub fn new(scene: &'a Scene<'a>, view: &'a View) -> Self {
        static NOTHING: Measured = Measured::NOTHING;
        Self { scene, view, pictures: None, measured: &NOTHING, preview: None }
    }
}
