//! Curves of the panels: light, patches, sensitivities, with the labels that name them.

use chromascope_core::spectral::grid::{FIRST_NM, LAST_NM};
use chromascope_core::spectral::{SpectralDistribution, StatedUncertainty};
use chromascope_figure::{Dash, Ink, InkRole, LegendEntry, Mark, Shape, Stroke, Tag};

use super::Built;
use crate::document::SetKind;
use crate::figures::band;
use crate::figures::chromaticity::{self, id};
use crate::figures::data_set::{Name, channel_symbol};
use crate::plot_item::PlotItem;
use crate::scene::{ComparedSensor, Scene};

/// Largest number of patches whose curves are named in the plot.
const NAMED: usize = 8;

pub(super) struct Content {
    /// Quantity of the vertical axis.
    pub(super) quantity: &'static str,
    /// Subject, at the upper right.
    pub(super) note: String,
    pub(super) marks: Vec<Mark>,
    pub(super) names: Vec<Name>,
    /// Names that stand for several curves each, where those have no room.
    pub(super) common: Vec<Name>,
    pub(super) range: [f64; 2],
    /// Height relative to other panels.
    pub(super) weight: f64,
}

/// The light, to its largest value.
pub(super) fn light(scene: &Scene<'_>, built: &mut Built) -> Option<Content> {
    let light = built.known(scene.light())?;
    let tag = built.things.tag(PlotItem::Light);
    let within = |nm: f64| (FIRST_NM..=LAST_NM).contains(&nm);
    let samples = light.measured.wavelengths_nm().iter().zip(light.measured.values());
    let peak = samples.filter(|(nm, _)| within(**nm)).map(|(_, v)| v.abs()).fold(0.0, f64::max);
    let mut marks = curve(tag, "light", &light.measured, peak, InkRole::Text.into(), 2.0, true);
    let stated = light.stated.as_ref().filter(|of| of.transmittance.is_none());
    marks.splice(
        0..0,
        stated.and_then(|of| banded(built, "light", &light.measured, (peak, InkRole::Text.into()), (&of.stated, 0))),
    );
    let name = if scene.light_name() == "E" { "E, equal energy".to_owned() } else { scene.light_name() };
    Some(Content {
        quantity: "relative power",
        note: format!("light: {name}"),
        marks,
        names: Vec::new(),
        common: Vec::new(),
        range: [0.0, 1.3],
        weight: 0.8,
    })
}

/// The patches, each in the color that the reference sees.
pub(super) fn patches(scene: &Scene<'_>, built: &mut Built) -> Option<Content> {
    let patches = built.known(scene.patches())?;
    let colors = scene.patch_colors(SetKind::Observer, &scene.document.reference).unwrap_or_default();
    let mut top = 1.0_f64;
    let (mut marks, mut names) = (Vec::new(), Vec::new());
    let stated = scene.stated_of_chart();
    for (index, patch) in patches.patches().iter().enumerate() {
        let tag = built.things.tag(PlotItem::Patch { source: None, patch: patch.name.clone() });
        let color = colors.get(index).map(|color| color.srgb.bytes);
        let ink = color.map_or(Ink::new(InkRole::Text), Ink::rgb);
        top = patch.grid.values().iter().copied().fold(top, f64::max);
        let casing = color.and_then(casing).map(|alpha| Ink::new(InkRole::Weak).faded(alpha));
        let cased = |mark: Mark| match (mark.stroke, casing) {
            (Some(stroke), Some(casing)) if stroke.dash == Dash::Solid => mark.with_halo(casing),
            _ => mark,
        };
        let width = if patches.patches().len() <= NAMED { 1.5 } else { 1.0 };
        let band = stated.as_ref().and_then(|of| banded(built, &patch.name, &patch.measured, (1.0, ink), (of, index)));
        marks.splice(0..0, band);
        marks.extend(curve(tag, &patch.name, &patch.measured, 1.0, ink, width, true).into_iter().map(cased));
        if patches.patches().len() <= NAMED {
            let points = along(&patch.measured, 1.0);
            names.push(Name { text: patch.name.clone(), ink: InkRole::Text.into(), points });
        }
    }
    // Without the chart's edition, which the caption of a figure has: a small pane holds it in one line.
    let chart = scene.document.chart.split(" (").next().unwrap_or_default();
    let note =
        if scene.subset().is_some() { "patches: the paper's five".to_owned() } else { format!("patches: {chart}") };
    let range = [0.0, top * 1.08];
    Some(Content { quantity: "reflectance", note, marks, names, common: Vec::new(), range, weight: 1.3 })
}

/// Opacity of the casing that separates a patch's line from a ground of nearly its own color.
fn casing(rgb: [u8; 3]) -> Option<f32> {
    let lightest = rgb.into_iter().min().unwrap_or(0);
    let darkest = rgb.into_iter().max().unwrap_or(0);
    (lightest > 170 || darkest < 70).then_some(0.4)
}

/// Points of a curve at which a name may stand: near its peak first.
fn along(spectrum: &SpectralDistribution, scale: f64) -> Vec<[f64; 2]> {
    let samples = spectrum.wavelengths_nm().iter().zip(spectrum.values());
    let inside: Vec<[f64; 2]> = samples
        .filter(|(nm, _)| (FIRST_NM + 10.0..=LAST_NM - 10.0).contains(*nm))
        .map(|(nm, value)| [*nm, value / scale])
        .collect();
    let peak = inside.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap_or_default();
    let high = inside.iter().copied().filter(|point| point[1] > 0.6 * peak[1]);
    let mut points: Vec<[f64; 2]> = high.step_by((inside.len() / 60).max(1)).collect();
    points.sort_by(|a, b| (a[0] - peak[0]).abs().total_cmp(&(b[0] - peak[0]).abs()));
    points
}

/// Sensitivities of sensors, each curve scaled to peak 1; behind them those of `ghost` in gray.
pub(super) fn sensitivities(
    scene: &Scene<'_>,
    sources: &[ComparedSensor],
    ghost: Option<&ComparedSensor>,
    built: &mut Built,
) -> Content {
    let (mut marks, mut signs, mut names) = (Vec::new(), Vec::new(), Vec::new());
    let mut low = -0.04_f64;
    // The reference's thick lines lie below the others.
    let (references, others): (Vec<_>, Vec<_>) = sources.iter().rev().partition(|source| source.is_reference);
    let drawn = references.into_iter().chain(others).map(|source| (source, false));
    for (source, is_ghost) in ghost.map(|ghost| (ghost, true)).into_iter().chain(drawn) {
        let Some(sensor) = built.known(scene.sensor(source.kind, &source.name)) else { continue };
        let tag = built.things.tag(PlotItem::Sensor(id(source)));
        let stated = scene.stated_of_sensor(source.kind, &source.name, &sensor);
        for (c, (channel, spectrum)) in sensor.primaries().channels().iter().zip(sensor.curves()).enumerate() {
            let peak = spectrum.values().iter().copied().fold(0.0, f64::max).max(f64::MIN_POSITIVE);
            let name = format!("{} {channel}", source.label);
            if is_ghost {
                let gray = Ink::new(InkRole::Weak).faded(0.45);
                marks.extend(curve(tag, &name, spectrum, peak, gray, 2.5, false));
                continue;
            }
            let least = spectrum.values().iter().copied().fold(0.0, f64::min);
            low = low.min(1.1 * least / peak - 0.03);
            let width = if source.is_reference { 3.0 } else { source.width };
            let band = |of| banded(built, &name, spectrum, (peak, source.role.into()), (of, c));
            marks.splice(0..0, stated.as_ref().and_then(band));
            let lines = curve(tag, &name, spectrum, peak, source.role.into(), width, false);
            marks.extend(lines.into_iter().map(|line| line.with_dash(dash(source))));
            names.push(Name {
                text: channel_symbol(channel),
                ink: source.role.into(),
                points: at_peak(spectrum, peak),
            });
            if sources.len() > 1 && !source.is_reference {
                signs.extend(sign(tag, source, spectrum, peak, signs.len() / 3));
            }
        }
    }
    names.sort_by_key(|name| name.ink.role != InkRole::Reference);
    let common = common(&names);
    marks.extend(signs);
    Content {
        quantity: "relative sensitivity",
        note: String::new(),
        marks,
        names,
        common,
        range: [low.max(-1.0), 1.1],
        weight: 1.0,
    }
}

/// Dashes of every second camera, so that neighbors in the list are told apart without color.
fn dash(source: &ComparedSensor) -> Dash {
    match source.role {
        InkRole::Sensor(slot) if slot % 2 == 1 => Dash::Dashed,
        _ => Dash::Solid,
    }
}

/// A sensor's entry of the legend.
pub(super) fn key(source: &ComparedSensor) -> LegendEntry {
    let reference = if source.is_reference { " (reference)" } else { "" };
    let key = chromaticity::key(source, format!("{}{reference}", source.label));
    LegendEntry { stroke: key.stroke.map(|stroke| Stroke { dash: dash(source), ..stroke }), ..key }
}

/// A name for all of one text, at their points from the median outward; the reference's keep their ink.
fn common(names: &[Name]) -> Vec<Name> {
    let mut groups: Vec<Name> = Vec::new();
    for name in names {
        match groups.iter_mut().find(|group| group.text == name.text) {
            Some(group) => {
                group.points.extend(&name.points);
                group.ink = InkRole::Text.into();
            }
            None => groups.push(name.clone()),
        }
    }
    for group in &mut groups {
        group.points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let median = group.points.get(group.points.len() / 2).map_or(0.0, |point| point[0]);
        group.points.sort_by(|a, b| (a[0] - median).abs().total_cmp(&(b[0] - median).abs()));
    }
    groups
}

/// The peak of a curve, between the first and the last sample that reaches it.
fn at_peak(spectrum: &SpectralDistribution, peak: f64) -> Vec<[f64; 2]> {
    let samples = spectrum.wavelengths_nm().iter().zip(spectrum.values());
    let highest: Vec<f64> = samples.filter(|(_, value)| **value >= 0.995 * peak).map(|(nm, _)| *nm).collect();
    let middle = highest.first().zip(highest.last()).map(|(first, last)| 0.5 * (first + last));
    middle.into_iter().map(|nm| [nm, 1.0]).collect()
}

/// The sensor's marker on the long-wave flank of a curve, at a height of its own: prints in gray tell curves apart by it.
fn sign(tag: Tag, source: &ComparedSensor, spectrum: &SpectralDistribution, peak: f64, place: usize) -> Option<Mark> {
    let height = peak * [0.5, 0.65, 0.35, 0.8, 0.25][place % 5];
    let (nm, values) = (spectrum.wavelengths_nm(), spectrum.values());
    let last = values.windows(2).rposition(|ends| ends[0] >= height && ends[1] < height)?;
    let share = (values[last] - height) / (values[last] - values[last + 1]);
    let at = [nm[last] + share * (nm[last + 1] - nm[last]), height / peak];
    Some(chromaticity::sign(tag, source, at, 3.5, source.role))
}

/// Band of the uncertainty of one of the curves that a file states it for, divided by the curve's peak.
fn banded(
    built: &mut Built,
    name: &str,
    spectrum: &SpectralDistribution,
    (peak, ink): (f64, Ink),
    (stated, place): (&StatedUncertainty, usize),
) -> Option<Mark> {
    let scale = if peak > 0.0 { peak } else { 1.0 };
    let factor = band::coverage(stated.coverage());
    let samples = spectrum.wavelengths_nm().iter().zip(spectrum.values()).zip(stated.standard().get(place)?);
    let samples = samples.filter(|((nm, _), _)| (FIRST_NM - 20.0..=LAST_NM + 20.0).contains(*nm));
    let points: Vec<_> = samples.map(|((nm, value), u)| ([*nm, value / scale], factor * u / scale)).collect();
    let mark = band::mark(name, &points, ink)?;
    let words = band::words(factor);
    if !built.new_bands.contains(&words) {
        built.new_bands.push(words);
    }
    Some(mark)
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
