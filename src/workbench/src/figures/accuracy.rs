//! Run time against error for the visible scene, as measured.

use chromascope_figure::{
    Cell, Column, Figure, FigureRoom, InkRole, LegendEntry, LegendPlace, Marker, Panel, Rect, Table, Tag,
};
use chromascope_measure::Measurement;
use chromascope_measure::method::{Family, Point};
use chromascope_measure::pareto::{self, Place, duration};

use super::kind::{FigureKind, Need};
use super::look::{FigureLook, Shows};
use crate::format::number;
use crate::profiler::{Conditions, SceneRun, Subject, Trial};
use crate::scene::Scene;

const SIZE: [f64; 2] = [640.0, 420.0];

/// The methods of a run on one subject.
pub fn trial(run: &SceneRun, subject: Subject) -> Option<&Trial> {
    run.trials.iter().find(|trial| trial.subject == subject)
}

pub fn panel(trial: &Trial, is_current: bool, size: [f64; 2]) -> Panel {
    let place = |(index, point): (usize, &Point)| Place {
        name: trial.name(index),
        tag: Tag(u32::try_from(index + 1).unwrap_or(u32::MAX)),
        error: point.max,
        seconds: point.seconds,
        marker: marker(point.family),
        role: role(point.family),
    };
    let places: Vec<Place> = trial.points.iter().enumerate().map(place).collect();
    let error = format!("largest error, {}", trial.subject.error_of());
    let time = format!("time for {}", trial.subject.per());
    let area = Rect::from_min_size([0.0, 0.0], size);
    let when = if is_current { "" } else { ", of the scene as it was" };
    let note = format!("{}, one thread{when}", trial.inputs_in_words());
    pareto::panel("run time against error", [&error, &time], note, &places, area)
}

/// The method of a tag.
pub fn point(trial: &Trial, tag: Tag) -> Option<&Point> {
    trial.points.get((tag.0 as usize).checked_sub(1)?)
}

fn marker(family: Family) -> Marker {
    match family {
        Family::Sum => Marker::Hexagon,
        Family::Quality => Marker::Diamond,
        Family::Tolerance => Marker::TriangleDown,
    }
}

/// Not the cameras' inks: gray marks here are not cameras.
fn role(family: Family) -> InkRole {
    match family {
        Family::Sum => InkRole::Weak,
        Family::Quality | Family::Tolerance => InkRole::Text,
    }
}

/// Facts about a method, a line each.
pub fn describe(trial: &Trial, point: &Point) -> Vec<String> {
    let index = trial.points.iter().position(|other| other == point);
    let mut lines = vec![index.map_or_else(|| point.name.clone(), |index| trial.name(index))];
    lines.push(format!("{} for {}", duration(point.seconds), trial.subject.per()));
    if let Some(reference) = trial.points.first().filter(|reference| *reference != point) {
        lines.push(format!("{} times the speed of {}", ratio(reference.seconds / point.seconds), reference.name));
    }
    if index == Some(0) {
        lines.push("Reference method; all errors and bounds are relative to it".to_owned());
    } else {
        let (max, rms) = (number(point.max), number(point.rms));
        lines.push(format!("error: largest {max}, RMS {rms} {}", trial.subject.error_of()));
    }
    if let Some(error_bound) = point.error_bound {
        lines.push(format!("estimated error bound: {} {}", number(error_bound), trial.subject.error_of()));
    }
    if point.preparation > 0.0 {
        lines.push(format!("preparation per sensor: {}", duration(point.preparation)));
    }
    lines
}

fn ratio(value: f64) -> String {
    if value >= 10.0 { format!("{value:.0}") } else { format!("{value:.1}") }
}

pub static KIND: FigureKind =
    FigureKind::new("methods", "Run time of each method against its error, measured now", figure)
        .needing(Need::Measured);

fn figure(_: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let subject = match look.shows {
        Shows::Scene(subject) => subject,
        Shows::Bench(workload) => {
            let report = look.measured.reports.get(&workload)?.as_ref().as_ref().ok()?;
            return match room.width {
                Some(width) => report.figure_within(workload, width),
                None => report.figure(workload),
            };
        }
    };
    let run = look.measured.run.as_ref()?;
    let trial = trial(run, subject)?;
    let size = room.size(SIZE, 0.0);
    let mut figure = Figure::new(title(subject), size);
    figure.panels.push(panel(trial, look.measured.is_current, size));
    figure.legend = legend(trial);
    figure.legend_place = LegendPlace::Outside;
    figure.caption = format!(
        "{}: {}. {} Times are medians over rounds in which the methods take turns, for {}, on one thread; errors are \
         against {}, {}. Filled and joined: methods that no other surpasses in both.",
        run.conditions.of(trial),
        trial.inputs_in_words(),
        run.conditions.on(),
        subject.per(),
        trial.points.first().map_or("the reference", |point| &point.name),
        subject.error_of(),
    );
    figure.table = with_conditions(table(trial), trial, &run.conditions);
    Some(figure)
}

pub fn title(subject: Subject) -> String {
    format!("Run time against error: {}", subject.what())
}

/// Each row with what, on what and when it was measured.
fn with_conditions(table: Table, trial: &Trial, conditions: &Conditions) -> Table {
    let of = format!("{}: {}", conditions.of(trial), trial.inputs_in_words());
    let Conditions { machine, program, began, .. } = conditions;
    let all = [("measured on", of.as_str()), ("machine", machine), ("program", program), ("began", began)];
    table.with_constants(all.map(|(column, text)| (column, text.to_owned())))
}

pub fn legend(trial: &Trial) -> Vec<LegendEntry> {
    let families: std::collections::BTreeSet<Family> = trial.points.iter().map(|point| point.family).collect();
    let entry = |family: Family| LegendEntry {
        name: family.title().to_owned(),
        stroke: None,
        marker: Some(marker(family)),
        fill: Some(role(family).into()),
    };
    families.into_iter().map(entry).collect()
}

pub fn table(trial: &Trial) -> Table {
    let error = trial.subject.error_of();
    let mut table = Table::new([
        "method".into(),
        Column::in_unit(&format!("time for {}", trial.subject.per()), "µs"),
        "ratio to the reference".into(),
        Column::in_unit("largest error", error),
        Column::in_unit("RMS error", error),
        Column::in_unit("estimated error bound", error),
        Column::in_unit("preparation", "ms"),
    ]);
    let reference = trial.points.first().map_or(1.0, |point| point.seconds);
    for (index, point) in trial.points.iter().enumerate() {
        table.push([
            trial.name(index).into(),
            (point.seconds * 1e6).into(),
            (point.seconds / reference).into(),
            point.max.into(),
            point.rms.into(),
            point.error_bound.into(),
            Cell::Number(point.preparation * 1e3),
        ]);
    }
    table
}

/// Facts about a benchmarked method, a line each.
pub fn describe_measurement(m: &Measurement) -> Vec<String> {
    let threads = if m.threads == 1 { "one thread".to_owned() } else { format!("{} threads", m.threads) };
    let mut lines = vec![
        m.method.clone(),
        format!("{} a {}, {threads}, median of {} rounds", duration(m.seconds_per_item), m.item, m.rounds),
        format!("{} times the time of {}", number(m.ratio), m.baseline),
        format!("error: largest {}, RMS {}, of {}", number(m.error.max()), number(m.error.rms()), m.error.what),
    ];
    if m.build_seconds > 0.0 {
        lines.push(format!("preparation: {}", duration(m.build_seconds)));
    }
    if let Some(roof) = m.roof {
        let [memory, arithmetic] = [roof.memory, roof.arithmetic].map(|share| format!("{:.0} %", 100.0 * share));
        lines.push(format!("{memory} of memory bandwidth, {arithmetic} of peak arithmetic"));
    }
    lines
}
