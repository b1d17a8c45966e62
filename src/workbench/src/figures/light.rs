//! The light's rendition as a picture: rendering indices as bars, and the color vector graphic of TM-30.

use std::f64::consts::TAU;

use chromascope_core::colorimetry::Xyz;
use chromascope_core::colorimetry::rgb::{encode_srgb, srgb_from_xyz, srgb_white};
use chromascope_core::query::{Consistency, Rendition};
use chromascope_core::rendition::{ColorFidelity, HueBin};
use chromascope_figure::{
    Anchor, Axis, Cell, Dash, Figure, FigureRoom, Ink, InkRole, Label, Labels, Mark, Panel, Place, Projection, Rect,
    Shape, Table, Tag, TextSize, Ticks, text_width,
};

use super::kind::FigureKind;
use super::look::FigureLook;
use crate::document::SetKind;
use crate::format::fixed;
use crate::scene::Scene;

/// The size of the saved figure in points: bars left, vectors right.
const SIZE: [f64; 2] = [640.0, 300.0];
/// Width below which the vectors stand below the bars.
const NARROW: f64 = 450.0;
/// Largest radius of the vector graphic, the reference circle being 1.
const RADIUS: f64 = 1.55;

/// Bars of Ra and R1 to R14 for an area; none where they are undefined.
pub fn bars(rendition: &Rendition, area: Rect) -> Option<Panel> {
    let indices = rendition.rendering.as_ref().ok()?;
    let values: Vec<(String, f64)> = std::iter::once(("Ra".to_owned(), indices.general))
        .chain(indices.special.iter().enumerate().map(|(index, value)| ((index + 1).to_string(), *value)))
        .collect();
    let low = values.iter().map(|(_, value)| *value).fold(0.0, f64::min);
    let floor = if low < 0.0 { ((low - 20.0) / 50.0).floor() * 50.0 } else { 0.0 };
    let names = values.iter().enumerate().map(|(index, (name, _))| (index as f64 + 0.5, name.clone())).collect();
    // Numbers that are wider than a bar's place stand in two lines in turn. A full bar is read from the axis.
    let count = values.len() as f64;
    let numbers = || values.iter().enumerate().filter(|(index, (_, value))| *index == 0 || *value < 99.5);
    let above = numbers().filter(|(_, (_, value))| *value >= 0.0);
    let widest = above.map(|(_, (_, value))| text_width(&fixed(*value, 0), TextSize::Small)).fold(0.0, f64::max);
    let staggers = widest + NUMBER_GAP > (area.width() - Projection::LEFT) / count;
    // No more, or at one column the axis would lack numbers.
    let beyond = if staggers { 0.1 } else { 0.0 };
    let x = Axis::new("test color (Ra: mean of R1 to R8)", [-beyond, count + beyond])
        .with_ticks(Ticks::At(names))
        .with_grid(false);
    let y = Axis::new("color rendering index", [floor, if staggers { 170.0 } else { 140.0 }])
        .with_ticks(Ticks::At(
            [-100.0, -50.0, 0.0, 50.0, 100.0].map(|at| (at, format!("{at:.0}").replace('-', "−"))).into(),
        ))
        .with_grid(true);
    let mut panel = Panel::new("rendering indices", area, x, y);
    for (index, (name, value)) in values.iter().enumerate() {
        let middle = index as f64 + 0.5;
        let bar = Shape::Rect { min: [middle - 0.36, value.min(0.0)], max: [middle + 0.36, value.max(0.0)] };
        let role = if index == 0 { InkRole::Text } else { InkRole::Weak };
        panel.marks.push(Mark::new(Tag::default(), format!("{name} {value:.1}"), bar).with_fill(role));
    }
    let mut panel = panel.with_headroom(if staggers { 32.0 } else { 18.0 });
    let mut labels = Labels::new(&panel);
    for (index, (_, value)) in numbers() {
        let at = [index as f64 + 0.5, *value];
        let (anchor, up) = if *value < 0.0 { (Anchor::TOP, -1.0) } else { (Anchor::BOTTOM, 1.0) };
        let places = [1.0, 15.0].map(|lift| Place { at, anchor, offset: [0.0, -up * lift] });
        labels.place(&Label { starts: vec![at], ..Label::new(fixed(*value, 0), InkRole::Text, places.to_vec()) });
    }
    panel.marks.extend(labels.into_marks());
    Some(panel)
}

/// Gap between numbers above neighboring bars, in points.
const NUMBER_GAP: f64 = 3.0;

/// The color vector graphic: hue bins of the reference on a circle, those of the light around it; none where it is undefined.
pub fn vectors(rendition: &Rendition, area: Rect) -> Option<Panel> {
    let fidelity = rendition.fidelity.as_ref().ok()?;
    let axis = || Axis::hidden([-RADIUS, RADIUS]);
    let mut panel = Panel::new("color vectors", area, axis(), axis());
    (panel.equal_aspect, panel.framed) = (true, false);
    let circle = |radius: f64| {
        let points = (0..96).map(|i| TAU * f64::from(i) / 96.0).map(|t| [radius * t.cos(), radius * t.sin()]).collect();
        Shape::Line { points, closed: true }
    };
    for radius in [0.8, 1.2] {
        panel.marks.push(Mark::new(Tag::default(), "20 %", circle(radius)).with_stroke(InkRole::Grid, 0.8));
    }
    let reference = Mark::new(Tag::default(), "reference", circle(1.0)).with_stroke(InkRole::Weak, 1.2);
    panel.marks.push(reference.with_dash(Dash::Dashed));
    let ends = ends(fidelity);
    for (index, [from, to]) in ends.iter().enumerate() {
        let ink = Ink::rgb(hue(index));
        let line = Shape::Segments { segments: vec![[*from, *to]] };
        panel.marks.push(Mark::new(Tag::default(), format!("hue bin {}", index + 1), line).with_stroke(ink, 3.0));
    }
    let points = ends.iter().map(|[_, to]| *to).collect();
    let outline = Mark::new(Tag::default(), "light", Shape::Line { points, closed: true });
    panel.marks.push(outline.with_stroke(InkRole::Text, 1.6));
    let at = |x: f64, y: f64| [x * RADIUS, y * RADIUS];
    let [rf, rg] = [fidelity.fidelity, fidelity.gamut].map(|value| fixed(value, 1));
    let mut labels = Labels::new(&panel);
    for (text, x, anchor) in
        [(format!("Rf {rf}"), -0.97, Anchor::LEFT_TOP), (format!("Rg {rg}"), 0.97, Anchor::RIGHT_TOP)]
    {
        let place = Place { at: at(x, 0.95), anchor, offset: [0.0; 2] };
        labels.place(&Label { always: true, ..Label::new(text, InkRole::Text, vec![place]) });
    }
    for (index, [from, _]) in ends.iter().enumerate() {
        let beyond = [1.36, 1.42, 1.3].map(|far| Place::beside(from.map(|v| far * v), [0.0; 2], 0.0));
        labels.place(&Label::new((index + 1).to_string(), InkRole::Weak, beyond.to_vec()));
    }
    panel.marks.extend(labels.into_marks());
    Some(panel)
}

/// Place of each bin on the circle, and where the light moves it: the shift of its mean color by the reference's chroma.
fn ends(fidelity: &ColorFidelity) -> Vec<[[f64; 2]; 2]> {
    let end = |(index, bin): (usize, &HueBin)| {
        let (sin, cos) = (TAU * (index as f64 + 0.5) / 16.0).sin_cos();
        let chroma = bin.reference[0].hypot(bin.reference[1]);
        let shift = [0, 1].map(|axis: usize| (bin.test[axis] - bin.reference[axis]) / chroma);
        [[cos, sin], [cos + shift[0], sin + shift[1]]]
    };
    fidelity.bins.iter().enumerate().map(end).collect()
}

/// Representative color of a hue bin: L* 60, C*ab 45 under D65. For orientation only: hues of CAM02-UCS differ a
/// little.
fn hue(bin: usize) -> [u8; 3] {
    let (sin, cos) = (TAU * (bin as f64 + 0.5) / 16.0).sin_cos();
    let middle = 76.0 / 116.0;
    let white = srgb_white();
    let cube = |value: f64, white: f64| white * value.powi(3);
    let [x, y, z] =
        [cube(middle + 45.0 * cos / 500.0, white.x), cube(middle, white.y), cube(middle - 45.0 * sin / 200.0, white.z)];
    let linear = srgb_from_xyz() * Xyz { x, y, z }.to_vector();
    encode_srgb(linear.to_array()).bytes
}

pub static KIND: FigureKind = FigureKind::new("light", "Color rendering of the light", figure);

fn figure(scene: &Scene<'_>, _: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let rendition = scene.rendition().ok()?;
    let [width, mut height] = room.size(SIZE, 0.0);
    let is_narrow = width < NARROW;
    if is_narrow && room.height.is_none() {
        height = 1.25 * width;
    }
    // Bars beside the vectors, or above them.
    let (first, second) = if is_narrow {
        let side = (0.6 * height).min(width);
        let low = Rect::from_min_size([0.5 * (width - side), height - side], [side, side]);
        (Rect::from_min_size([0.0, 0.0], [width, height - side - 8.0]), low)
    } else {
        let side = height.min(0.5 * width);
        let right = Rect::from_min_size([width - side, 0.0], [side, height]);
        (Rect::from_min_size([0.0, 0.0], [width - side, height]), right)
    };
    let mut figure = Figure::new(format!("Rendition of {}", scene.light_name()), [width, height]);
    figure.panels.extend(bars(&rendition, first).into_iter().chain(vectors(&rendition, second)));
    let [one, other] = if is_narrow { ["Above", "Below"] } else { ["Left", "Right"] };
    figure.caption = format!(
        "{}. {one}: color rendering indices, CIE 13.3. {other}: color vectors of ANSI/IES TM-30, the reference dashed; \
         thin circles: chroma ±20 %.",
        scene.light_name()
    );
    figure.table = table(scene, &rendition);
    (!figure.panels.is_empty()).then_some(figure)
}

/// All numbers: quantity, value.
pub fn table(scene: &Scene<'_>, rendition: &Rendition) -> Table {
    let mut table = Table::new(["quantity", "of", "value"]);
    let light = scene.light_name();
    let mut push = |quantity: &str, of: &str, value: Option<f64>| {
        table.push([Cell::from(quantity), Cell::from(of), Cell::from(value)]);
    };
    let temperature = scene.light_temperature().ok().and_then(Result::ok);
    push("CCT (K)", &light, temperature.map(|cct| cct.temperature.get()));
    push("Duv", &light, temperature.map(|cct| cct.duv));
    let rendering = rendition.rendering.as_ref().ok();
    push("Ra", &light, rendering.map(|indices| indices.general));
    for index in 0..14 {
        push(&format!("R{}", index + 1), &light, rendering.map(|indices| indices.special[index]));
    }
    let fidelity = rendition.fidelity.as_ref().ok();
    push("Rf", &light, fidelity.map(|fidelity| fidelity.fidelity));
    push("Rg", &light, fidelity.map(|fidelity| fidelity.gamut));
    for (index, bin) in fidelity.iter().flat_map(|fidelity| &fidelity.bins).enumerate() {
        let of = format!("hue bin {}", index + 1);
        push("Rf,h", &of, Some(bin.fidelity));
        push("Rcs,h", &of, Some(bin.chroma_shift));
        push("Rhs,h (rad)", &of, Some(bin.hue_shift));
    }
    push("SSI", &light, rendition.similarity.as_ref().ok().copied());
    for caution in scene.rendition_cautions(rendition).unwrap_or_default() {
        push(&format!("caution: {caution}"), &light, None);
    }
    for source in scene.sources().iter().filter(|source| source.kind == SetKind::Camera) {
        let consistency = scene.consistency(&source.name).ok();
        let value = |take: fn(&Consistency) -> f64| consistency.as_ref().map(take);
        push("consistency, mean \u{394}E*00", &source.label, value(|c| c.mean));
        push("consistency, 95 % \u{394}E*00", &source.label, value(|c| c.percentile_95));
        push("consistency, max \u{394}E*00", &source.label, value(|c| c.max));
    }
    table
}
