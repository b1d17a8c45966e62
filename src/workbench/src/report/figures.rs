//! The paper's figures, made with the report's cameras, patches and light.

use std::sync::Arc;

use chromascope_core::mesh::Mesh;
use chromascope_core::query::{Ask as _, Shared};
use chromascope_figure::{Cell, Figure, FigureRoom, LegendPlace, Panel, Table};

use super::claim::Subject;
use super::geometry;
use crate::action::{Action, RenderAction};
use crate::document::render::{LEAF, MeshChoice, SKIN};
use crate::document::{Document, Overlays, SetKind};
use crate::export::Paper;
use crate::figures::look::{FigureLook, SpectraLayout};
use crate::figures::{chromaticity, render, spectra, swatches};
use crate::render_service::RenderedFrame;
use crate::scene::Scene;
use crate::scene::orbit::Orbit;
use chromascope_core::reflectance::Normalization;

pub(super) type Pixels = u32;

type Make = fn(&Subject<'_>, FigureRoom, Pixels) -> Option<Figure>;

pub struct PaperFigure {
    pub number: u8,
    pub title: &'static str,
    make: Make,
}

const fn figure(number: u8, title: &'static str, make: Make) -> PaperFigure {
    PaperFigure { number, title, make }
}

pub const FIGURES: [PaperFigure; 9] = [
    figure(1, "Geometry of the reflectance model", |_, room, _| Some(geometry::figure(room))),
    figure(2, "Sensitivities of the cameras and the reference", sensitivities),
    figure(3, "Planckian loci", loci),
    figure(4, "Chromaticities of the patches", points),
    figure(5, "Colors of the patches", patches),
    figure(6, "Light and reflectances of the rendered scenes", materials),
    figure(7, "Meshes of head and fern", meshes),
    figure(8, "Head in sunlight", |subject, room, pixels| scene(subject, &RenderAction::Figure8, room, pixels)),
    figure(9, "Fern in sunlight", |subject, room, pixels| scene(subject, &RenderAction::Figure9, room, pixels)),
];

impl PaperFigure {
    /// The figure laid out for a paper; none where nothing can be drawn.
    pub fn laid_out(&self, subject: &Subject<'_>, paper: &Paper, pixels: Pixels) -> Option<Figure> {
        let figure = paper.laid_out(|room| (self.make)(subject, room, pixels))?;
        Some(Figure { title: format!("Figure {}: {}", self.number, self.title), ..figure })
    }
}

fn sensitivities(subject: &Subject<'_>, room: FigureRoom, _: Pixels) -> Option<Figure> {
    let scene = subject.scene(subject.document);
    let look = FigureLook { spectra_layout: SpectraLayout::Each, ..FigureLook::default() };
    let figure = spectra::KIND.figure(&scene, &look, room)?;
    let table = without(&figure.table, &spectra_but_sensitivities(&scene));
    // The light and the patches come first.
    let panels = figure.panels.iter().skip(2).cloned().collect();
    let caption = "Relative sensitivities, each sensor scaled to peak 1. Dotted: beyond the data.".to_owned();
    Some(Figure { table, caption, legend: Vec::new(), ..stacked(figure, panels) })
}

/// Number of columns of a table of spectra before those of sensitivities, without the wavelengths.
fn spectra_but_sensitivities(scene: &Scene<'_>) -> std::ops::Range<usize> {
    1..2 + scene.patches().map_or(0, |patches| patches.patches().len())
}

fn without(table: &Table, left_out: &std::ops::Range<usize>) -> Table {
    let kept: Vec<usize> = (0..table.columns.len()).filter(|index| !left_out.contains(index)).collect();
    table.part(&kept, &(0..table.rows.len()).collect::<Vec<usize>>())
}

/// A figure with these panels, one below the other.
fn stacked(figure: Figure, panels: Vec<Panel>) -> Figure {
    let mut top = 0.0;
    let placed = panels.into_iter().map(|mut panel| {
        let height = panel.area.height();
        let shift = top - panel.area.min[1];
        (panel.area.min[1], panel.area.max[1]) = (top, panel.area.max[1] + shift);
        top += height + 4.0;
        panel
    });
    let panels: Vec<Panel> = placed.collect();
    Figure { size: [figure.size[0], top - 4.0], panels, ..figure }
}

fn diagram(subject: &Subject<'_>, room: FigureRoom, document: &Document) -> Option<Figure> {
    chromaticity::KIND.figure(&subject.scene(document), &FigureLook::default(), room)
}

fn of_kind(mut table: Table, kind: &str) -> Table {
    let at = table.place("kind");
    table.rows.retain(|row| at.and_then(|at| row.get(at)) == Some(&kind.into()));
    table
}

fn loci(subject: &Subject<'_>, room: FigureRoom, _: Pixels) -> Option<Figure> {
    let overlays = Overlays { patches: false, ..subject.document.overlays };
    let figure = diagram(subject, room, &Document { overlays, ..subject.document.clone() })?;
    Some(Figure { table: of_kind(figure.table.clone(), "locus"), ..figure })
}

fn points(subject: &Subject<'_>, room: FigureRoom, _: Pixels) -> Option<Figure> {
    let overlays = Overlays { loci: false, ..subject.document.overlays };
    let mut document = Document { overlays, ..subject.document.clone() };
    // By Eq 13 no CIE observer can be compared.
    document.compared.retain(|compared| compared.kind == SetKind::Camera || compared.name == document.reference);
    let figure = diagram(subject, FigureRoom { strip: false, ..room }, &document)?;
    let caption = chromaticity::conditions(&subject.scene(subject.document));
    Some(Figure { table: of_kind(figure.table.clone(), "patch"), caption, ..figure })
}

fn patches(subject: &Subject<'_>, room: FigureRoom, _: Pixels) -> Option<Figure> {
    swatches::KIND.figure(&subject.scene(subject.document), &FigureLook::default(), room)
}

fn materials(subject: &Subject<'_>, room: FigureRoom, _: Pixels) -> Option<Figure> {
    /// Height of light and one material over the width.
    const SHAPE: f64 = 0.5;
    let room = FigureRoom { height: room.width.map(|width| SHAPE * width), ..room };
    let [skin, leaf] = [SKIN, LEAF].map(|material| {
        let document = Document { compared: Vec::new(), ..subject.in_sun(material) };
        spectra::KIND.figure(&subject.scene(&document), &FigureLook::default(), room)
    });
    let (skin, leaf) = (skin?, leaf?);
    // Light, skin; leaf, wavelengths.
    let panels = skin.panels.iter().take(2).chain(leaf.panels.iter().skip(1)).cloned().collect();
    let mut table = skin.table.clone();
    let name = leaf.table.columns.last()?;
    table.insert(table.columns.len(), name, leaf.table.rows.iter().map(|row| row.last().cloned().unwrap_or_default()));
    let caption = "Spectral power of the light and reflectances of skin and leaf. Dotted: beyond the data.".to_owned();
    Some(Figure { table, caption, legend: Vec::new(), ..stacked(skin, panels) })
}

/// Pictures of the document's mesh, a file's mesh being `own`.
pub(super) fn frame(scene: &Scene<'_>, own: Option<&Shared<Mesh>>, pixels: Pixels) -> Result<RenderedFrame, String> {
    let viewpoint = Orbit::of(&scene.document.render).viewpoint(scene.document.render.aspect());
    let (mesh, viewpoint) = scene.mesh_of(own).zip(viewpoint).ok_or("its mesh is not read")?;
    RenderedFrame::of_mesh(scene, mesh, viewpoint, pixels).map_err(|error| error.to_string())
}

fn pictures(scene: &Scene<'_>, room: FigureRoom, pixels: Pixels) -> Option<Figure> {
    // Times of this run, which it has none of, are no part of a figure.
    let frame = frame(scene, None, pixels).ok()?;
    let look = FigureLook { pictures: Some(Arc::new(frame)), ..FigureLook::default() };
    let figure = render::KIND.figure(scene, &look, room)?;
    let time = figure.table.place("time_ms")?;
    Some(Figure { table: without(&figure.table, &(time..time + 1)), ..figure })
}

fn scene(subject: &Subject<'_>, action: &RenderAction, room: FigureRoom, pixels: Pixels) -> Option<Figure> {
    let mut document = subject.document.clone();
    Action::Render(action.clone()).apply(&mut document);
    if subject.has_own_light {
        document.light = subject.document.light.clone();
    }
    pictures(&subject.scene(&document), room, pixels)
}

/// Head and fern, equally bright in all directions, through the reference.
fn meshes(subject: &Subject<'_>, room: FigureRoom, pixels: Pixels) -> Option<Figure> {
    let shape = |action: RenderAction| {
        let mut document = subject.document.clone();
        Action::Render(action).apply(&mut document);
        document.render.normalization = Normalization::Lambertian;
        document.compared.retain(|compared| compared.name == document.reference);
        let room = FigureRoom { width: room.width.map(|width| width / 2.0), ..room };
        let name = if document.render.mesh == MeshChoice::Head { "Head" } else { "Fern" };
        let scene = subject.scene(&document);
        let mesh = subject.results.ask(&scene.mesh_of(None)?);
        Some((name, pictures(&scene, room, pixels)?, mesh))
    };
    let (head, fern) = (shape(RenderAction::Figure8)?, shape(RenderAction::Figure9)?);
    let width = head.1.size[0];
    let size = [width + fern.1.size[0], head.1.size[1].max(fern.1.size[1])];
    let mut figure = Figure { size, legend_place: LegendPlace::None, ..head.1 };
    for mut panel in fern.1.panels {
        (panel.area.min[0], panel.area.max[0]) = (panel.area.min[0] + width, panel.area.max[0] + width);
        figure.panels.push(Panel { name: fern.0.to_owned(), ..panel });
    }
    "The meshes, Lambertian, through the reference.".clone_into(&mut figure.caption);
    figure.table = Table::new(["mesh", "triangles", "vertices"]);
    for (name, mesh) in [(head.0, head.2), (fern.0, fern.2)] {
        let counts = [mesh.triangles().len(), mesh.positions().len()].map(|count| Cell::from(count as f64));
        figure.table.push(std::iter::once(Cell::from(name)).chain(counts));
    }
    Some(figure)
}
