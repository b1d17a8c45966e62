//! Light, patches and sensitivities over wavelength.

mod content;

use std::sync::Arc;

use chromascope_core::colorimetry::diagram::wavelength_color;
use chromascope_core::spectral::SpectralDistribution;
use chromascope_core::spectral::grid::{COUNT, FIRST_NM, LAST_NM, wavelength_nm};
use chromascope_figure::{
    Axis, Cell, Column, Dash, Figure, FigureRoom, Image, InkRole, Labels, LegendPlace, Mark, Panel, Projection, Rect,
    Shape, Table, Ticks,
};

use self::content::Content;
use super::chromaticity::patches_words;
use super::data_set::Name;
use super::kind::FigureKind;
use super::look::{FigureLook, SpectraLayout};
use crate::document::{FIT_TARGET, SetKind};
use crate::format::capitalized;
use crate::plot_item::{PickIndex, PlotItem};
use crate::scene::{Scene, SceneError};

/// The panels with the items of their curves.
#[derive(Clone, Debug, Default)]
pub struct Built {
    /// The panels, from the light down, the wavelengths written under the last.
    pub panels: Vec<Panel>,
    pub things: PickIndex,
    /// Items that could not be drawn, with the reasons.
    pub refused: Vec<String>,
    /// Words for the bands that are drawn.
    pub bands: Vec<String>,
    /// Those of the panel that is being made.
    new_bands: Vec<String>,
}

impl Built {
    /// What is drawn; where there is nothing, the reason is noted.
    fn known<T>(&mut self, answer: Result<T, SceneError>) -> Option<T> {
        answer.map_err(|error| self.refused.push(error.to_string())).ok()
    }

    /// A panel whose note names the bands that are drawn in it.
    fn noted(&mut self, mut content: Content) -> Content {
        for words in self.new_bands.drain(..) {
            content.note = format!("{}; {words}", content.note);
            if !self.bands.contains(&words) {
                self.bands.push(words);
            }
        }
        content
    }
}

/// The height of the band of colors with its labels.
const FOOT: f64 = 4.0 + Projection::BOTTOM + Projection::TITLE;
/// Height below which the sensitivities that lie over each other stand alone.
const LOW: f64 = 180.0;
/// Width below which notes are shortest.
const NARROW: f64 = 300.0;

pub fn build(scene: &Scene<'_>, look: &FigureLook, size: [f64; 2]) -> Built {
    let mut built = Built::default();
    let sources = scene.visible_sources();
    let mut contents = Vec::new();
    let is_low = size[1] < LOW && look.spectra_layout == SpectraLayout::Overlay && !sources.is_empty();
    for make in [content::light, content::patches].into_iter().filter(|_| !is_low) {
        let made = make(scene, &mut built);
        contents.extend(made.map(|content| built.noted(content)));
    }
    if look.spectra_layout == SpectraLayout::Each {
        let reference = sources.iter().find(|source| source.is_reference);
        for source in &sources {
            let ghost = reference.filter(|_| !source.is_reference);
            let own = content::sensitivities(scene, std::slice::from_ref(source), ghost, &mut built);
            contents.push(built.noted(Content { note: source.label.clone(), ..own }));
        }
    } else if !sources.is_empty() {
        let all = content::sensitivities(scene, &sources, None, &mut built);
        // Beside the axis title in a narrow pane too: a second line would take the room of the letters.
        let note = if size[0] < NARROW { "peaks at 1" } else { "scaled to peak 1" };
        contents.push(built.noted(Content { note: note.to_owned(), weight: 1.7, ..all }));
    }
    let weights: f64 = contents.iter().map(|content| content.weight).sum();
    let large = size[0] > 500.0;
    let mut y = 0.0;
    for content in contents {
        let height = ((size[1] - FOOT) * content.weight / weights.max(1e-9)).max(24.0);
        built.panels.push(panel(content, Rect::from_min_size([0.0, y], [size[0], height - 4.0]), large));
        y += height;
    }
    built.panels.push(foot(scene, Rect::from_min_size([0.0, y], [size[0], FOOT]), large));
    built
}

/// A panel of curves with their names.
fn panel(content: Content, area: Rect, large: bool) -> Panel {
    let x = Axis::new("", [FIRST_NM, LAST_NM]).with_grid(true).with_ticks(Ticks::None);
    let ticks = [-0.5, 0.0, 0.5, 1.0].map(|value| (value, format!("{value:.1}").replace('-', "−"))).into();
    let axis = Axis::new(content.quantity, content.range).with_ticks(Ticks::At(ticks)).with_grid(large);
    let name = format!("{}, {}", content.quantity, content.note);
    let panel = Panel { note: content.note, marks: content.marks, ..Panel::new(name, area, x, axis) };
    // Names stand above curves, below the title and the note.
    let mut panel = panel.with_headroom(if content.names.is_empty() { 3.0 } else { 17.0 });
    panel.marks.splice(..0, hundreds(panel.y.range));
    let written = |names: &[Name]| {
        let mut labels = Labels::new(&panel);
        let count = names.iter().filter(|name| name.place(&mut labels)).count();
        (count == names.len(), labels.into_marks())
    };
    let (is_complete, mut names) = written(&content.names);
    if !is_complete && !content.common.is_empty() {
        (_, names) = written(&content.common);
    }
    panel.marks.extend(names);
    panel
}

/// Faint lines at the hundreds of nanometers, since the axis is written only once, and at zero.
fn hundreds(range: [f64; 2]) -> Vec<Mark> {
    let line = |a: [f64; 2], b: [f64; 2]| {
        Mark::new(PickIndex::NONE, "grid", Shape::Line { points: vec![a, b], closed: false })
            .with_stroke(InkRole::Grid, 1.0)
    };
    let mut marks: Vec<Mark> = [400.0, 500.0, 600.0, 700.0].map(|nm| line([nm, range[0]], [nm, range[1]])).into();
    marks.push(line([FIRST_NM, 0.0], [LAST_NM, 0.0]));
    marks
}

/// The wavelengths, written under a band of their colors.
fn foot(scene: &Scene<'_>, area: Rect, large: bool) -> Panel {
    let ticks = [400.0_f64, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0, 750.0];
    let shown = ticks.iter().filter(|nm| large || (**nm / 100.0).fract() == 0.0);
    let labels = shown.map(|nm| (*nm, format!("{nm:.0}"))).collect();
    let x = Axis::new("wavelength (nm)", [FIRST_NM, LAST_NM]).with_ticks(Ticks::At(labels));
    // An axis without labels, but as wide as those above.
    let y = Axis::new("", [0.0, 1.0]).with_ticks(Ticks::At(Vec::new()));
    let mut panel = Panel::new("wavelength", area, x, y);
    panel.framed = false;
    if let Ok(observer) = scene.sensor(SetKind::Observer, FIT_TARGET) {
        let colors = (0..COUNT).map(wavelength_nm).map(|nm| wavelength_color(&observer, nm));
        let rgba: Vec<u8> = colors.flat_map(|[r, g, b]| [r, g, b, 255]).collect();
        let image = Image { width: COUNT, height: 1, rgba: Arc::from(rgba) };
        let shape = Shape::Image { min: [FIRST_NM, 0.0], max: [LAST_NM, 1.0], image };
        panel.marks.push(Mark::new(PickIndex::NONE, "colors of the wavelengths", shape));
    }
    panel
}

const SIZE: [f64; 2] = [640.0, 560.0];

pub static KIND: FigureKind =
    FigureKind::new("spectra", "Light, patches and sensitivities over wavelength", figure).in_report();

/// The figure as it is saved, with all values on the 1 nm grid.
#[allow(clippy::unnecessary_wraps, reason = "other kinds of figures can have nothing to draw")]
fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let size = room.size(SIZE, 0.0);
    let built = build(scene, look, size);
    let mut figure = Figure::new("Spectra", size);
    figure.panels = built.panels;
    figure.legend = scene.visible_sources().iter().map(content::key).collect();
    figure.legend_place = LegendPlace::Outside;
    let bands: String = built.bands.iter().flat_map(|words| [capitalized(words), ". ".to_owned()]).collect();
    let mut strokes = figure.panels.iter().flat_map(|panel| &panel.marks).filter_map(|mark| mark.stroke);
    let is_held = strokes.any(|stroke| stroke.dash == Dash::Dotted);
    let held = if is_held { "Dotted: beyond the data, the end value is held. " } else { "" };
    let light = scene.light_name();
    figure.caption = format!("{held}{bands}Light: {light}. {}", patches_words(scene));
    figure.table = table(scene);
    Some(figure)
}

/// Everything on the grid, as it is integrated.
fn table(scene: &Scene<'_>) -> Table {
    let mut names = vec![Column::quantity("wavelength_nm", "wavelength", "nm")];
    let mut columns: Vec<Vec<f64>> = vec![(0..COUNT).map(wavelength_nm).collect()];
    if let Ok(light) = scene.light() {
        names.push(format!("light {}", scene.light_name()).into());
        columns.push(light.grid.values().to_vec());
    }
    if let Ok(patches) = scene.patches() {
        for patch in patches.patches() {
            names.push(patch.name.clone().into());
            columns.push(patch.grid.values().to_vec());
        }
    }
    for source in &scene.visible_sources() {
        let Ok(sensor) = scene.sensor(source.kind, &source.name) else { continue };
        for (channel, letter) in sensor.primaries().channels().iter().enumerate() {
            names.push(format!("{} {letter}", source.label).into());
            columns.push((0..COUNT).map(|index| sensor.at_index(index)[channel]).collect());
        }
    }
    let mut table = Table::new(names);
    for index in 0..COUNT {
        table.push(columns.iter().map(|column| Cell::from(column[index])).collect::<Vec<Cell>>());
    }
    table
}

/// Values of an item's curves at a wavelength: lines of text.
pub fn describe(scene: &Scene<'_>, thing: &PlotItem, nm: f64) -> Vec<String> {
    let index = ((nm - FIRST_NM).round().max(0.0) as usize).min(COUNT - 1);
    let at = format!("{:.0} nm", wavelength_nm(index));
    let measured = |curve: &SpectralDistribution| {
        let [first, last] = curve.range_nm();
        format!("measured {first}–{last} nm")
    };
    match thing {
        PlotItem::Light => match scene.light() {
            Ok(light) => vec![
                format!("light {}", scene.light_name()),
                format!("{at}: {:.4} (relative)", light.grid.values()[index]),
                measured(&light.measured),
            ],
            Err(error) => vec![error.to_string()],
        },
        PlotItem::Patch { patch, .. } => {
            let set = scene.patches().ok();
            let found = set.as_ref().and_then(|set| set.patches().iter().find(|p| p.name == *patch));
            found.map_or_else(Vec::new, |found| {
                let held = if found.grid.assumed().nothing() { "" } else { "; beyond, its end value is held (dotted)" };
                let value = found.grid.values()[index];
                vec![patch.clone(), format!("{at}: {value:.4}"), format!("{}{held}", measured(&found.measured))]
            })
        }
        PlotItem::Sensor(source) | PlotItem::Radiator { source, .. } => match scene.sensor(source.kind, &source.name) {
            Ok(sensor) => {
                let values = sensor.at_index(index);
                let mut lines = vec![source.name.clone()];
                for (channel, (letter, value)) in sensor.primaries().channels().iter().zip(values).enumerate() {
                    let peak = sensor.curves()[channel].values().iter().copied().fold(0.0, f64::max);
                    lines.push(format!("{letter} at {at}: {:.4} of its peak", value / peak).replace('-', "−"));
                }
                lines.push(format!("{}; zero outside", measured(&sensor.curves()[0])));
                lines
            }
            Err(error) => vec![error.to_string()],
        },
        PlotItem::DataSet { name, .. } => vec![name.clone()],
    }
}
