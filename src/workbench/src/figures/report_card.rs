//! One camera on one page: sensitivities, differences of the patches, locus error, figures of merit.

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::metrics::MetricGroup;
use chromascope_core::query::{CameraMetric, CameraMetrics, MetricValue};
use chromascope_core::spectral::SpectralDistribution;
use chromascope_core::spectral::grid::{FIRST_NM, LAST_NM};
use chromascope_figure::{
    Anchor, Axis, Cell, Field, Figure, FigureRoom, Ink, InkRole, Label, Labels, Mark, Panel, Place, Projection, Rect,
    Shape, Table, Tag, TextSize, Ticks, text_width,
};

use super::chromaticity::{conditions, distance_symbol};
use super::kind::FigureKind;
use super::look::FigureLook;
use super::strip::{along, temperature_axis};
use crate::document::SetKind;
use crate::format::fixed;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::Scene;
use crate::scene::locus::distance;
use crate::scene::metrics::CameraFigures;
use crate::scene::uncertainty::{in_words, number, uncertainty, unit, with_nature};

/// Width of the saved page in points.
const WIDTH: f64 = 560.0;
/// Below this width, all is in one column.
const TWO_COLUMNS: f64 = 480.0;
/// From this width on the bars stand beside the plots, so that the page is low.
const ONE_ROW: f64 = 840.0;
/// Width of a column of figures of merit where there are more than two.
const LIST_COLUMN: f64 = 170.0;
const TITLE: f64 = 44.0;
const NAME_LINE: f64 = 20.0;
const PLOTS: f64 = 190.0;
const BARS: f64 = 200.0;
/// Heights of plots and bars in one column.
const LOW_PLOTS: f64 = 132.0;
const LOW_BARS: f64 = 150.0;
const LINE: f64 = 15.0;
/// Half of a number at the lower end of an axis.
const NUMBER: f64 = 6.0;
const FOOT_LINE: f64 = 14.0;

/// The camera of Rank's page: the selected one, else the first that is compared.
pub fn camera(scene: &Scene<'_>, selected: Option<&PlotItem>) -> Option<SensorId> {
    let is_camera = |id: &&SensorId| id.kind == SetKind::Camera && scene.entry(id.kind, &id.name).is_ok();
    selected.and_then(PlotItem::source).filter(is_camera).cloned().or_else(|| {
        let first = scene.document.compared.iter().find(|c| c.kind == SetKind::Camera)?;
        Some(SensorId { kind: first.kind, name: first.name.clone() })
    })
}

pub static KIND: FigureKind =
    FigureKind::new("report-card", "All figures of merit of one camera", figure).of_metrics().of_cameras(1);

/// The page of the camera of the card as it is saved; none without a camera that can be shown.
fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let id = camera(scene, look.selected.as_ref())?;
    let figures = scene.camera_figures(id.kind, &id.name).ok()?;
    let width = room.width.unwrap_or(WIDTH).max(2.0 * LIST_COLUMN);
    Some(page(scene, &id, &figures, width))
}

/// The page of a camera with its figures of merit in a width; a narrow one has one column.
pub fn page(scene: &Scene<'_>, id: &SensorId, figures: &CameraFigures, width: f64) -> Figure {
    let mut top = 0.0;
    let mut place = |height: f64| {
        top += height;
        Rect::from_min_size([0.0, top - height], [width, height])
    };
    let name = chromascope_figure::wrapped(&id.name, TextSize::Heading, width - 16.0);
    let entry = scene.entry(id.kind, &id.name).ok();
    let source = entry.and_then(|entry| entry.header).map_or_else(|| "yours".to_owned(), |header| header.source);
    // The institution; the way to its file stands in the library.
    let source = source.split(';').next().unwrap_or_default();
    let source = chromascope_figure::wrapped(source, TextSize::Small, width - 24.0);
    let height = TITLE + NAME_LINE * (name.len() as f64 - 1.0) + LINE * (source.len() as f64 - 1.0);
    let mut panels = vec![title(&source, &name, place(height))];
    let beside = |row: Rect, [from, to]: [f64; 2]| {
        Rect::from_min_size([from * width, row.min[1]], [(to - from) * width, row.height()])
    };
    let areas = if width < TWO_COLUMNS {
        let row = place(LOW_PLOTS);
        [beside(row, [0.0, 0.5]), beside(row, [0.5, 1.0]), place(LOW_BARS)]
    } else if width < ONE_ROW {
        let row = place(PLOTS);
        [beside(row, [0.0, 0.5]), beside(row, [0.5, 1.0]), place(BARS)]
    } else {
        let row = place(BARS);
        [[0.0, 0.28], [0.28, 0.5], [0.5, 1.0]].map(|part| beside(row, part))
    };
    // Under the bars' lowest number, which stands half below its plot.
    place(NUMBER);
    panels.push(sensitivities(scene, id, areas[0]));
    panels.push(locus(scene, id, areas[1]));
    panels.push(patches(scene, &figures.metrics, areas[2]));
    let columns = list(((width / LIST_COLUMN) as usize).max(2));
    let rows = columns.iter().map(Vec::len).max().unwrap_or(0);
    let temperature_k = scene.document.temperature_k;
    panels.push(values(figures, place(LINE * (rows as f64 + 0.6)), &columns, temperature_k));
    let known: Vec<_> = figures.uncertainties.iter().flat_map(|all| all.iter().copied().flatten()).collect();
    let words = in_words(known).replacen("±:", "In brackets, of the last digits:", 1);
    let words = chromascope_figure::wrapped(&words, TextSize::Small, width - 16.0);
    let mut foot = Panel::board("uncertainty", place(FOOT_LINE * words.len() as f64), Ink::new(InkRole::Plot));
    for (row, words) in words.into_iter().enumerate() {
        let at = [8.0, FOOT_LINE * (row as f64 + 0.5)];
        foot.marks.push(Mark::text(words, at, Anchor::LEFT, TextSize::Small, InkRole::Weak));
    }
    panels.push(foot);
    let mut figure = Figure::new(format!("Report card: {}", id.name), [width, top]);
    figure.panels = panels;
    let words = scene.metrics_words(CameraMetric::ALL);
    figure.caption = format!("{words} {}", conditions(scene));
    figure.table = numbers(id, figures).with_constants(scene.metrics_constants(temperature_k));
    figure
}

fn line(name: &str, points: Vec<[f64; 2]>, ink: Ink, width: f64) -> Mark {
    Mark::new(Tag::default(), name, Shape::Line { points, closed: false }).with_stroke(ink, width)
}

fn title(source: &[String], name: &[String], area: Rect) -> Panel {
    let mut panel = Panel::board("title", area, Ink::new(InkRole::Plot));
    for (row, words) in name.iter().enumerate() {
        let at = [8.0, 13.0 + NAME_LINE * row as f64];
        panel.marks.push(Mark::text(words, at, Anchor::LEFT, TextSize::Heading, InkRole::Text));
    }
    for (row, words) in source.iter().rev().enumerate() {
        let at = [8.0, area.height() - 11.0 - LINE * row as f64];
        panel.marks.push(Mark::text(words, at, Anchor::LEFT, TextSize::Small, InkRole::Weak));
    }
    panel
}

/// Sensitivities over the wavelength, scaled to the largest.
fn sensitivities(scene: &Scene<'_>, id: &SensorId, area: Rect) -> Panel {
    let x = Axis::new("wavelength (nm)", [FIRST_NM, LAST_NM]);
    let note = "sensitivity".to_owned();
    let y = Axis::new("", [0.0, 1.1]).with_ticks(Ticks::At([0.0, 0.5, 1.0].map(|v| (v, format!("{v:.1}"))).into()));
    let mut panel = Panel { note, ..Panel::new("sensitivities", area, x, y) };
    let Ok(sensor) = scene.sensor(id.kind, &id.name) else { return panel };
    let peak = sensor.curves().iter().flat_map(SpectralDistribution::values).copied().fold(f64::MIN_POSITIVE, f64::max);
    let inks = [[0xC0, 0x30, 0x30], [0x30, 0x90, 0x30], [0x30, 0x50, 0xC0]].map(Ink::rgb);
    let mut names = Vec::new();
    for ((curve, ink), name) in sensor.curves().iter().zip(inks).zip(sensor.primaries().channels()) {
        let samples = curve.wavelengths_nm().iter().zip(curve.values());
        let points = samples.map(|(nm, value)| [*nm, value / peak]).filter(|p| (FIRST_NM..=LAST_NM).contains(&p[0]));
        let points: Vec<[f64; 2]> = points.collect();
        let top = points.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap_or_default();
        names.push(Label::new(name[..1].to_uppercase(), ink, Place::around(top, [0.0, -1.0], 3.0)));
        panel.marks.push(line(name, points, ink, 1.5));
    }
    named(&panel, &names)
}

/// Distance from the reference's Planckian locus at equal temperature, over the temperature.
fn locus(scene: &Scene<'_>, id: &SensorId, area: Rect) -> Panel {
    let diagram = scene.document.diagram;
    let mut x = temperature_axis();
    if text_width(&x.label, TextSize::Small) > area.width() - Projection::LEFT - 8.0 {
        "T (1000 K)".clone_into(&mut x.label);
    }
    let pair = scene
        .locus(id.kind, &id.name)
        .and_then(|own| Ok((own, scene.locus(SetKind::Observer, &scene.document.reference)?)));
    let comparable = scene.is_comparable(id.kind, &id.name);
    let points: Vec<[f64; 2]> = pair.ok().filter(|_| comparable).map_or_else(Vec::new, |(own, reference)| {
        let pairs = own.points.iter().zip(&reference.points);
        pairs.filter_map(|(a, b)| Some([along(a.temperature.get()), distance(a, b, diagram)?])).collect()
    });
    let top = points.iter().map(|point| point[1]).fold(1e-6, f64::max).min(0.6);
    let mut panel = Panel::new("locus error", area, x, Axis::new("", [0.0, 1.2 * top]));
    panel.note = format!("locus error {}", distance_symbol(diagram));
    panel.marks.push(line("locus error", points, InkRole::Text.into(), 1.5));
    panel.with_headroom(2.0)
}

/// A bar for each patch by the document's metric, the worst ones named.
fn patches(scene: &Scene<'_>, metrics: &CameraMetrics, area: Rect) -> Panel {
    let at = Metric::ALL.iter().position(|metric| *metric == scene.document.difference).unwrap_or(0);
    let value = |patch: usize| metrics.patches.get(patch)?.by_metric.get(at)?.ok();
    let values: Vec<Option<f64>> = (0..metrics.patches.len()).map(value).collect();
    let top = values.iter().flatten().copied().fold(1e-6, f64::max);
    let count = values.len().max(1) as f64;
    let x = Axis::new("", [-0.5, count - 0.5]).with_ticks(Ticks::None).with_grid(false);
    let mut panel = Panel::new("patches", area, x, Axis::new("", [0.0, 1.3 * top]));
    let reason = metrics.patches.first().and_then(|patch| patch.by_metric.get(at)?.err());
    panel.note = match reason {
        Some(why) => why.to_string(),
        None => format!("{} of the patches", scene.difference_name()),
    };
    let set = scene.patches().ok();
    let name = |patch: usize| set.as_ref().and_then(|set| set.patches().get(patch)).map_or("", |patch| &patch.name);
    let colors = scene.patch_colors(SetKind::Observer, &scene.document.reference).unwrap_or_default();
    for (patch, value) in values.iter().enumerate() {
        let Some(value) = value else { continue };
        let ink = colors.get(patch).map_or(Ink::new(InkRole::Weak), |color| Ink::rgb(color.srgb.bytes));
        let shape = Shape::Rect { min: [patch as f64 - 0.4, 0.0], max: [patch as f64 + 0.4, *value] };
        panel.marks.push(Mark::new(Tag::default(), name(patch), shape).with_fill(ink).with_stroke(InkRole::Weak, 0.5));
    }
    let worst = metrics.worst.get(at).map_or(&[][..], Vec::as_slice);
    // In the low bars of one column leaders of more would cross.
    let is_low = area.height() < BARS - 1.0;
    let named_worst = if is_low { 3 } else { worst.len() };
    let labels = worst.iter().take(named_worst).enumerate().filter_map(|(rank, &patch)| {
        let value = values.get(patch).copied().flatten()?;
        let number = fixed(value, scene.document.difference.decimals.saturating_sub(1));
        let words = format!("{}  {} {number}", rank + 1, name(patch));
        let at = [patch as f64, value];
        let place = |(anchor, shift)| Place { at, anchor, offset: [shift, -2.0] };
        let places = [(Anchor::BOTTOM, 0.0), (Anchor::LEFT_BOTTOM, -4.0), (Anchor::RIGHT_BOTTOM, 4.0)].map(place);
        Some(Label { starts: vec![at], ..Label::new(words, InkRole::Text, places.to_vec()) })
    });
    named(&panel, &labels.collect::<Vec<_>>())
}

/// A panel with labels above its bars: beside the bar's end or at a leader, else higher above it.
fn named(panel: &Panel, labels: &[Label]) -> Panel {
    let raised = |label: &Label, lift: f64| {
        label.places.iter().map(move |place| Place { offset: [place.offset[0], -lift], ..*place }).collect::<Vec<_>>()
    };
    let named = |room: f64| {
        let mut panel = panel.clone().with_headroom(room);
        let mut texts = Labels::new(&panel);
        let all = labels.iter().filter(|label| {
            let lifts = (1..16).map(|line| 2.0 + 14.0 * f64::from(line));
            let places = lifts.flat_map(|lift| raised(label, lift)).collect();
            texts.place(label) || texts.place(&Label { places, starts: Vec::new(), ..(*label).clone() })
        });
        let all = all.count() == labels.len();
        panel.marks.extend(texts.into_marks());
        (panel, all)
    };
    [14.0, 30.0].into_iter().map(named).find(|(_, all)| *all).unwrap_or_else(|| named(58.0)).0
}

#[derive(Clone, Copy)]
enum Line {
    Group(MetricGroup),
    Metric(usize),
}

/// Lines of the figures of merit in columns of about one height; no heading stands at the foot of one.
fn list(columns: usize) -> Vec<Vec<Line>> {
    let lines = MetricGroup::ALL.iter().flat_map(|group| {
        let of_group = (0..CameraMetric::ALL.len()).filter(|&at| CameraMetric::ALL[at].group == *group);
        std::iter::once(Line::Group(*group)).chain(of_group.map(Line::Metric))
    });
    let rows = (CameraMetric::ALL.len() + MetricGroup::ALL.len() + columns - 1).div_ceil(columns);
    let mut made = vec![Vec::new()];
    for line in lines {
        let room = if matches!(line, Line::Group(_)) { rows - 1 } else { rows };
        match made.last_mut() {
            Some(column) if column.len() < room => column.push(line),
            _ => made.push(vec![line]),
        }
    }
    made
}

/// A standard uncertainty in the last digits of its number, in brackets (JCGM 100, 7.2.2): `± 0.12†` as `(12)†`.
fn concise(behind: &str) -> String {
    let dagger = if behind.ends_with('†') { "†" } else { "" };
    let digits = behind.trim_start_matches("± ").trim_end_matches('†');
    let digits = digits.strip_prefix("0.").map_or(digits, |after| after.trim_start_matches('0'));
    format!("({digits}){dagger}")
}

fn values(figures: &CameraFigures, area: Rect, columns: &[Vec<Line>], temperature_k: f64) -> Panel {
    let mut panel = Panel::board("figures of merit", area, Ink::new(InkRole::Plot));
    let places = columns.iter().enumerate().flat_map(|(column, lines)| {
        let left = 8.0 + column as f64 * area.width() / columns.len() as f64;
        lines.iter().enumerate().map(move |(row, line)| (left, LINE * (row as f64 + 0.9), *line))
    });
    for (left, y, line) in places {
        let at = match line {
            Line::Group(group) => {
                let at = if group == MetricGroup::Locus { format!(" at {temperature_k} K") } else { String::new() };
                let words = format!("{}{at}", group.label());
                panel.marks.push(Mark::text(words, [left, y], Anchor::LEFT, TextSize::Small, InkRole::Weak));
                continue;
            }
            Line::Metric(at) => at,
        };
        let metric = &CameraMetric::ALL[at];
        let Some(value) = figures.of(*metric) else { continue };
        panel.marks.push(Mark::text(metric.symbol, [left + 2.0, y], Anchor::LEFT, TextSize::Small, InkRole::Text));
        let unit = if value.value.is_ok() { unit(metric) } else { "" };
        let behind = uncertainty(value).as_deref().map_or_else(String::new, concise);
        let number = format!("{}{behind} {unit}", number(*metric, value));
        let end = left + (area.width() / columns.len() as f64).min(LIST_COLUMN) - 8.0;
        panel.marks.push(Mark::text(number.trim_end(), [end, y], Anchor::RIGHT, TextSize::Small, InkRole::Text));
    }
    panel
}

/// Columns of the numbers, of a metric with its value.
const COLUMNS: [Field<(String, CameraMetric, MetricValue)>; 7] = [
    Field::new("camera", |(camera, ..)| Cell::from(camera.as_str())),
    Field::new("metric", |(_, metric, _)| Cell::from(metric.column)),
    Field::new("name", |(_, metric, _)| Cell::from(metric.label)),
    Field::new("unit", |(_, metric, _)| Cell::from(metric.unit)),
    Field::new("value", |(.., value)| Cell::from(value.value.ok())),
    Field::new("uncertainty", |(.., value)| Cell::from(value.uncertainty.map(|by| by.standard))),
    Field::new("reason", |(.., value)| Cell::from(value.value.err().map_or_else(String::new, |why| why.to_string()))),
];

fn numbers(id: &SensorId, figures: &CameraFigures) -> Table {
    let values = CameraMetric::ALL.iter().filter_map(|metric| Some((id.name.clone(), *metric, figures.of(*metric)?)));
    let values: Vec<_> = values.collect();
    with_nature(Table::of(&COLUMNS, &values), |row| values[row].2.uncertainty)
}
