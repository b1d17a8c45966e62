//! Errors of a two-light correction between its lights.

use chromascope_figure::{
    Axis, Dash, Field, Figure, FigureRoom, InkRole, LegendEntry, LegendPlace, Mark, Panel, Rect, Shape, Stroke, Table,
    Tag, Ticks,
};

use chromascope_core::query::TwoLightPoint;

use super::kind::{FigureKind, Need, kelvins};
use super::look::FigureLook;
use super::report_card;
use crate::export::profile::CorrectionFile;
use crate::scene::Scene;

const SIZE: [f64; 2] = [460.0, 240.0];

/// Temperatures that are written below, in kelvins.
const ROUND_K: [f64; 12] =
    [1500.0, 2000.0, 2500.0, 3000.0, 3500.0, 4000.0, 5000.0, 6000.0, 7000.0, 8000.0, 10_000.0, 15_000.0];

/// A curve: its name, its values, its looks, by which it is told apart also in gray.
type Curve = (fn(&CorrectionFile) -> String, fn(&TwoLightPoint) -> f64, InkRole, (f64, Dash));

const CURVES: [Curve; 4] = [
    (|file| format!("matrix of {}", file.of.lights[0]), |point| point.first, InkRole::Sensor(0), (1.5, Dash::Dashed)),
    (
        |file| format!("matrix of {}", file.of.lights.last().map_or("", String::as_str)),
        |point| point.second,
        InkRole::Sensor(1),
        (1.5, Dash::Solid),
    ),
    // Beneath what it approaches.
    (|_| "mixed as DNG readers do".to_owned(), |point| point.mixed, InkRole::Sensor(2), (4.0, Dash::Solid)),
    (|_| "fitted at each temperature".to_owned(), |point| point.own, InkRole::Text, (1.5, Dash::Dotted)),
];

pub static KIND: FigureKind =
    FigureKind::new("correction", "Error of a correction between its two lights; needs a second light", figure)
        .with_scales([|number| 1e6 / kelvins(number), |number| number])
        .needing(Need::Correction)
        .of_cameras(1);

fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let camera = report_card::camera(scene, look.selected.as_ref())?.name;
    let file = look.correction.as_ref().filter(|file| file.of.camera == camera)?;
    let mut figure = Figure::new(title(file), room.size(SIZE, 0.0));
    figure.panels.push(panel(file, figure.size)?);
    figure.legend = CURVES
        .map(|(name, _, role, (width, dash))| LegendEntry {
            name: name(file),
            stroke: Some(Stroke { dash, ..Stroke::solid(role, width) }),
            marker: None,
            fill: None,
        })
        .to_vec();
    figure.legend_place = LegendPlace::Inside;
    let [first, last] = [file.of.lights.first(), file.of.lights.last()].map(|light| light.map_or("", String::as_str));
    figure.caption = format!(
        "{}: mean ΔE*00 of the training reflectances under blackbodies between {first} and {last}, by the \
         matrix of either light, by both mixed, and by one fitted at each temperature.",
        file.of.camera
    );
    figure.table = Table::of(&COLUMNS, file.sheet.between.iter().flatten());
    Some(figure)
}

fn title(file: &CorrectionFile) -> String {
    format!("{}: mean ΔE*00 between {}", file.of.camera, file.of.lights.join(" and "))
}

const COLUMNS: [Field<TwoLightPoint>; 5] = [
    Field::quantity(["temperature_k", "temperature", "K"], |point| point.temperature.get().into()),
    Field::new("first", |point| point.first.into()),
    Field::new("second", |point| point.second.into()),
    Field::new("own", |point| point.own.into()),
    Field::new("mixed", |point| point.mixed.into()),
];

/// The panel of a size; none without two lights.
pub fn panel(file: &CorrectionFile, size: [f64; 2]) -> Option<Panel> {
    let points = file.sheet.between.as_ref()?;
    let (first, last) = (points.first()?, points.last()?);
    let values = |of: fn(&TwoLightPoint) -> f64| points.iter().map(of);
    let top = CURVES.iter().flat_map(|(_, of, ..)| values(*of)).fold(0.0, f64::max);
    let mired = |point: &TwoLightPoint| point.temperature.mired();
    let cold_to_hot = [mired(first).max(mired(last)), mired(first).min(mired(last))];
    let ticks = ROUND_K.map(|kelvin| (1e6 / kelvin, format!("{kelvin:.0}"))).into();
    let x = Axis::new("color temperature (K)", cold_to_hot).with_ticks(Ticks::At(ticks)).with_grid(true);
    let y = Axis::new("mean ΔE*00", [0.0, (top * 1.1).max(1e-6)]).with_grid(true);
    let mut panel = Panel::new(title(file), Rect::from_min_size([0.0, 0.0], size), x, y);
    panel.marks = CURVES
        .iter()
        .enumerate()
        .map(|(index, (name, of, role, (width, dash)))| {
            let line =
                Shape::Line { points: points.iter().map(|point| [mired(point), of(point)]).collect(), closed: false };
            Mark::new(Tag(index as u32), name(file), line).with_stroke(*role, *width).with_dash(*dash)
        })
        .collect();
    Some(panel)
}

/// Names of the curves at a temperature, for the pointer.
pub fn at(file: &CorrectionFile, mired: f64) -> Option<Vec<String>> {
    let points = file.sheet.between.as_ref()?;
    let distance = |point: &TwoLightPoint| (point.temperature.mired() - mired).abs();
    let nearest = points.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let lines = CURVES.iter().map(|(name, of, ..)| format!("{}: {:.3}", name(file), of(nearest)));
    Some(std::iter::once(format!("{:.0} K, mean ΔE*00", nearest.temperature.get())).chain(lines).collect())
}

/// The curves' names with their inks, for a key.
pub fn key(file: &CorrectionFile) -> impl Iterator<Item = (String, InkRole)> {
    CURVES.iter().map(|(name, _, role, _)| (name(file), *role))
}
