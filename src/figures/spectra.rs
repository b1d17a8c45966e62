//! Light, patches and sensitivities over wavelength.

use std::sync::Arc;

use chromascope_core::colorimetry::diagram::wavelength_color;
use chromascope_core::spectral::SpectralDistribution;
use chromascope_core::spectral::grid::{COUNT, FIRST_NM, LAST_NM, wavelength_nm};
use chromascope_figure::{
    Axis, Cell, Dash, Figure, Image, Ink, InkRole, LegendEntry, LegendPlace, Mark, Panel, Rect, Shape, Stroke, Table,
    Tag, TextSize, Ticks, text_width,
};

use super::chromaticity::{caption, id};
use crate::document::{FIT_TARGET, SetKind, Subset};
use crate::plot_item::{PickIndex, PlotItem};
use crate::scene::{ComparedSensor, Scene};
use crate::view::{SpectraLayout, View};

/// The panels with the items of their curves.
#[derive(Clone, Debug)]
pub struct Built {
    /// The panels, from the light down, the wavelengths written under the last.
    pub panels: Vec<Panel>,
    /// Items of the curves.
    pub things: PickIndex,
    /// Items that could not be drawn, with the reasons.
    pub refused: Vec<String>,
}

/// The height of the band of colors with its labels.
const FOOT: f64 = 28.0;

/// Builds the panels for an area of the given size.
pub fn build(scene: &Scene<'_>, view: &View, size: [f64; 2]) -> Built {
    let mut built = Built { panels: Vec::new(), things: PickIndex::default(), refused: Vec::new() };
    let sources: Vec<ComparedSensor> = scene.sources().into_iter().filter(|source| source.visible).collect();
    let each = view.saved.spectra_layout == SpectraLayout::Each;
    let mut contents: Vec<(String, Vec<Mark>, [f64; 2], f64)> = Vec::new();
    if let Some((note, marks)) = light(scene, &mut built) {
        contents.push((note, marks, [0.0, 1.45], 0.8));
    }
    if let Some((note, marks, top)) = patches(scene, &mut built) {
        contents.push((note, marks, [0.0, top], 1.3));
    }
    if each {
        for source in &sources {
            let (marks, low) = sensitivities(scene, std::slice::from_ref(source), &mut built);
            contents.push((source.label.clone(), marks, [low, 1.1], 1.0));
        }
    } else if !sources.is_empty() {
        let (marks, low) = sensitivities(scene, &sources, &mut built);
        contents.push(("sensitivities, scaled to peak 1".to_owned(), marks, [low, 1.1], 1.7));
    }
    let weights: f64 = contents.iter().map(|content| content.3).sum();
    let large = size[0] > 500.0;
    let mut y = 0.0;
    for (note, marks, range, weight) in contents {
        let height = ((size[1] - FOOT) * weight / weights.max(1e-9)).max(24.0);
        let area = Rect::from_min_size([0.0, y], [size[0], height - 4.0]);
        let range = with_room(&note, &marks, range, [size[0], height - 4.0]);
        let x = Axis::new("", [FIRST_NM, LAST_NM]).with_grid(true).with_ticks(Ticks::None);
        let ticks = if large { Ticks::Auto } else { Ticks::None };
        let axis = Axis::new("", range).with_ticks(ticks).with_grid(large);
        let mut panel = Panel::new(note.clone(), area, x, axis);
        panel.note = note;
        panel.marks = hundreds(range);
        panel.marks.extend(marks);
        built.panels.push(panel);
        y += height;
    }
    built.panels.push(foot(scene, Rect::from_min_size([0.0, y], [size[0], FOOT]), large));
    built
}

/// The range with room above what lies under the note at the upper right.
fn with_room(note: &str, marks: &[Mark], [low, high]: [f64; 2], [width, height]: [f64; 2]) -> [f64; 2] {
    /// The height of the note with its margins.
    const TEXT: f64 = 20.0;
    let share = ((text_width(note, TextSize::Small) + 12.0) / width.max(1.0)).min(1.0);
    let from = LAST_NM - share * (LAST_NM - FIRST_NM);
    let lines =
        marks.iter().filter_map(|mark| if let Shape::Line { points, .. } = &mark.shape { Some(points) } else { None });
    let top = lines.flat_map(|points| {
        let under = |pair: &[[f64; 2]]| if pair[1][0] >= from { pair[0][1].max(pair[1][1]) } else { low };
        points.windows(2).map(under).collect::<Vec<_>>()
    });
    let top = top.filter(|value| value.is_finite()).fold(low, f64::max);
    let free = 1.0 - (TEXT / height.max(1.0)).min(0.5);
    [low, high.max(low + (top - low) / free)]
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
    let unit = |nm: f64| if nm == 400.0 { " nm" } else { "" };
    let labels = shown.map(|nm| (*nm, format!("{nm:.0}{}", unit(*nm)))).collect();
    let x = Axis::new("", [FIRST_NM, LAST_NM]).with_ticks(Ticks::At(labels));
    // An axis without labels, but as wide as those above.
    let y = Axis::new("", [0.0, 1.0]).with_ticks(if large { Ticks::At(Vec::new()) } else { Ticks::None });
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

/// The light, to its largest value.
fn light(scene: &Scene<'_>, built: &mut Built) -> Option<(String, Vec<Mark>)> {
    let light = match scene.light() {
        Ok(light) => light,
        Err(error) => {
            built.refused.push(error.to_string());
            return None;
        }
    };
    let tag = built.things.tag(PlotItem::Light);
    let within = |nm: f64| (FIRST_NM..=LAST_NM).contains(&nm);
    let samples = light.measured.wavelengths_nm().iter().zip(light.measured.values());
    let peak = samples.filter(|(nm, _)| within(**nm)).map(|(_, v)| v.abs()).fold(0.0, f64::max);
    let marks = curve(tag, "light", &light.measured, peak, InkRole::Text.into(), 2.0, true);
    let name = if scene.light_name() == "E" { "E, equal energy".to_owned() } else { scene.light_name() };
    Some((format!("light: {name}"), marks))
}

/// The patches, each in the color that the reference sees.
fn patches(scene: &Scene<'_>, built: &mut Built) -> Option<(String, Vec<Mark>, f64)> {
    let patches = match scene.patches() {
        Ok(patches) => patches,
        Err(error) => {
            built.refused.push(error.to_string());
            return None;
        }
    };
    let colors = scene.patch_colors(SetKind::Observer, &scene.document.reference).unwrap_or_default();
    let mut top = 1.0_f64;
    let mut marks = Vec::new();
    for (index, patch) in patches.patches().iter().enumerate() {
        let tag = built.things.tag(PlotItem::Patch { source: None, patch: patch.name.clone() });
        let ink = colors.get(index).map_or(Ink::new(InkRole::Text), |color| Ink::rgb(color.srgb.bytes));
        top = patch.grid.values().iter().copied().fold(top, f64::max);
        // A casing separates a black patch from a black background, and a white one from a white one.
        let cased = curve(tag, &patch.name, &patch.measured, 1.0, ink, 1.5, true);
        let casing = |mark: Mark| match mark.stroke {
            Some(stroke) if stroke.dash == Dash::Solid => mark.with_halo(Ink::new(InkRole::Weak).faded(0.35)),
            _ => mark,
        };
        marks.extend(cased.into_iter().map(casing));
    }
    let five = scene.document.subset == Subset::Five && scene.has_five();
    let note = if five { "patches: the paper's five".to_owned() } else { format!("patches: {}", scene.document.chart) };
    Some((note, marks, top * 1.08))
}

/// Sensitivities of sensors, each curve scaled to peak 1, and the minimum where negative.
fn sensitivities(scene: &Scene<'_>, sources: &[ComparedSensor], built: &mut Built) -> (Vec<Mark>, f64) {
    let mut marks = Vec::new();
    let mut low = -0.04_f64;
    for source in sources.iter().rev() {
        let sensor = match scene.sensor(source.kind, &source.name) {
            Ok(sensor) => sensor,
            Err(error) => {
                built.refused.push(error.to_string());
                continue;
            }
        };
        let tag = built.things.tag(PlotItem::Sensor(id(source)));
        for (channel, spectrum) in sensor.primaries().channels().iter().zip(sensor.curves()) {
            let peak = spectrum.values().iter().copied().fold(0.0, f64::max);
            let least = spectrum.values().iter().copied().fold(0.0, f64::min);
            low = low.min(1.1 * least / peak.max(f64::MIN_POSITIVE));
            let name = format!("{} {channel}", source.label);
            let width = if source.is_reference { 3.0 } else { source.width };
            marks.extend(curve(tag, &name, spectrum, peak, source.role.into(), width, false));
        }
    }
    (marks, low.max(-1.0))
}

/// A curve as measured, divided by its peak; where its end values are held beyond it, dotted.
fn curve(
    tag: Tag,
    name: &str,
    spectrum: &SpectralDistribution,
    peak: f64,
    ink: Ink,
    width: f64,
    held: bool,
) -> Vec<Mark> {
    let scale = if peak > 0.0 { peak } else { 1.0 };
    let samples = spectrum.wavelengths_nm().iter().zip(spectrum.values());
    let points: Vec<[f64; 2]> = samples
        .filter(|(nm, _)| (FIRST_NM - 20.0..=LAST_NM + 20.0).contains(*nm))
        .map(|(nm, value)| [*nm, value / scale])
        .collect();
    let ends = points.first().copied().zip(points.last().copied());
    let line = |points: Vec<[f64; 2]>, dash: Dash| {
        Mark::new(tag, name, Shape::Line { points, closed: false }).with_stroke(ink, width).with_dash(dash)
    };
    let mut marks = vec![line(points, Dash::Solid)];
    if let Some((first, last)) = ends.filter(|_| held) {
        if first[0] > FIRST_NM {
            marks.push(line(vec![[FIRST_NM, first[1]], first], Dash::Dotted));
        }
        if last[0] < LAST_NM {
            marks.push(line(vec![last, [LAST_NM, last[1]]], Dash::Dotted));
        }
    }
    marks
}

/// The size of a saved figure in points.
const SIZE: [f64; 2] = [640.0, 560.0];

/// The figure as it is saved, with all values on the 1 nm grid.
pub fn figure(scene: &Scene<'_>, view: &View) -> Figure {
    let built = build(scene, view, SIZE);
    let mut figure = Figure::new("Spectra", SIZE);
    figure.panels = built.panels;
    figure.legend = scene
        .sources()
        .iter()
        .filter(|source| source.visible)
        .map(|source| LegendEntry {
            name: source.label.clone(),
            stroke: Some(Stroke::solid(source.role, source.width)),
            marker: None,
            fill: None,
        })
        .collect();
    figure.legend_place = LegendPlace::Outside;
    figure.caption = format!("Dotted: beyond the data, the end value is held. {}", caption(scene));
    figure.table = table(scene);
    figure
}

/// Everything on the grid, as it is integrated.
fn table(scene: &Scene<'_>) -> Table {
    let mut names = vec!["wavelength_nm".to_owned()];
    let mut columns: Vec<Vec<f64>> = vec![(0..COUNT).map(wavelength_nm).collect()];
    if let Ok(light) = scene.light() {
        names.push(format!("light {}", scene.light_name()));
        columns.push(light.grid.values().to_vec());
    }
    if let Ok(patches) = scene.patches() {
        for patch in patches.patches() {
            names.push(patch.name.clone());
            columns.push(patch.grid.values().to_vec());
        }
    }
    for source in scene.sources().iter().filter(|source| source.visible) {
        let Ok(sensor) = scene.sensor(source.kind, &source.name) else { continue };
        for (channel, letter) in sensor.primaries().channels().iter().enumerate() {
            names.push(format!("{} {letter}", source.label));
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
