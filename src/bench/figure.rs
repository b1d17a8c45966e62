//! Run time against error, a panel for each case: down and to the left is better.

use chromascope_core::figure::{
    Anchor, Axis, Figure, Ink, InkRole, LegendEntry, LegendPlace, Mark, Marker, Panel, Rect, Shape, TextSize, Ticks,
    text_width,
};

use super::report::table;
use super::{Measurement, Report, Workload};
use crate::thing::Things;

/// The size of a panel in points.
const PANEL: [f64; 2] = [420.0, 320.0];
/// Panels side by side.
const ACROSS: usize = 2;
/// An error of zero stands here: below anything a double can be off by.
const NOTHING: f64 = 1e-18;

/// The figure of a workload.
pub(super) fn figure(report: &Report, workload: Workload) -> Option<Figure> {
    let mut cases: Vec<Vec<&Measurement>> = Vec::new();
    // What gives none of the values has no error, and so no place.
    for measurement in report.of(workload).filter(|measurement| measurement.error.checked > 0) {
        match cases.iter_mut().find(|case| case[0].case == measurement.case) {
            Some(case) => case.push(measurement),
            None => cases.push(vec![measurement]),
        }
    }
    if cases.is_empty() {
        return None;
    }
    let (across, down) = (cases.len().min(ACROSS), cases.len().div_ceil(ACROSS));
    let mut figure = Figure::new(workload.title(), [PANEL[0] * across as f64, PANEL[1] * down as f64]);
    for (index, case) in cases.iter().enumerate() {
        let corner = [PANEL[0] * (index % ACROSS) as f64, PANEL[1] * (index / ACROSS) as f64];
        figure.panels.push(panel(case, Rect::from_min_size(corner, PANEL)));
    }
    let threads = report.of(workload).map(|m| m.threads).collect::<std::collections::BTreeSet<_>>();
    figure.legend = threads.iter().map(|&threads| entry(threads)).collect();
    figure.legend_place = LegendPlace::Outside;
    let machine = &report.machine;
    figure.caption = format!(
        "Median time per item against the largest error of {}; the line joins what nothing else beats in both. {}, {} cores, {}; {:.0} GB/s and {:.0} Gflop/s on all of them.",
        cases[0][0].error.what,
        machine.processor,
        machine.cores,
        machine.instruction_set,
        machine.memory_gb_per_s[1],
        machine.arithmetic_gflop_per_s[1]
    );
    figure.table = table(report.of(workload));
    Some(figure)
}

fn entry(threads: usize) -> LegendEntry {
    let (marker, ink) = look(threads);
    let name = if threads == 1 { "1 thread".to_owned() } else { format!("{threads} threads") };
    LegendEntry { name, stroke: None, marker: Some(marker), fill: Some(ink) }
}

/// Marker and color by the number of threads.
fn look(threads: usize) -> (Marker, Ink) {
    let slot = threads.max(1).ilog2() as usize;
    (Marker::source(slot), Ink::new(InkRole::Source((slot % 8) as u8)))
}

/// Where a measurement stands: logarithms of error and time.
fn place(measurement: &Measurement) -> [f64; 2] {
    [measurement.error.max().max(NOTHING).log10(), measurement.seconds_per_item.max(1e-15).log10()]
}

fn panel(case: &[&Measurement], area: Rect) -> Panel {
    let places: Vec<[f64; 2]> = case.iter().map(|measurement| place(measurement)).collect();
    let x = axis(format!("error of {}", short(&case[0].error.what)), places.iter().map(|p| p[0]), 1.0);
    let y = axis(format!("time per {} (s)", case[0].item), places.iter().map(|p| p[1]), 0.5);
    let ranges = [x.range, y.range];
    let mut panel = Panel::new(case[0].case.clone(), area, x, y);
    panel.note.clone_from(&case[0].case);
    let front = front(&places);
    panel.marks.push(
        Mark::new(Things::NONE, "what nothing beats", Shape::Line { points: front.clone(), closed: false })
            .with_stroke(InkRole::Weak, 1.5),
    );
    for (measurement, &at) in case.iter().zip(&places) {
        let (marker, ink) = look(measurement.threads);
        let shape = Shape::Points { points: vec![at], marker, radius: 4.0 };
        panel.marks.push(Mark::new(Things::NONE, &measurement.method, shape).with_fill(ink));
    }
    panel.marks.extend(labels(case, &places, ranges));
    panel
}

/// What stands before a comma, a parenthesis: the rest is in the table.
fn short(what: &str) -> &str {
    what.split([',', '(', ';']).next().unwrap_or(what).trim_end()
}

/// An axis of logarithms, with a tick at each power of ten.
fn axis(label: String, values: impl Iterator<Item = f64>, room: f64) -> Axis {
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    let (low, high) = ((low - room).floor(), (high + room).ceil());
    let nothing = NOTHING.log10();
    let tick = |power: i32| {
        let value = f64::from(power);
        (value, if value <= nothing { "0".to_owned() } else { format!("1e{power}") })
    };
    let ticks = (low as i32..=high as i32).filter(|&power| f64::from(power) >= nothing).map(tick).collect();
    Axis::new(label, [low, high]).with_ticks(Ticks::At(ticks))
}

/// The points that no other is both faster and more exact than, by error, as steps' corners.
fn front(places: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = places.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut front: Vec<[f64; 2]> = Vec::new();
    for place in sorted {
        if front.last().is_none_or(|last| place[1] < last[1]) {
            front.push(place);
        }
    }
    front
}

/// Names beside their points where there is room; of methods on several threads only the first.
fn labels(case: &[&Measurement], places: &[[f64; 2]], ranges: [[f64; 2]; 2]) -> Vec<Mark> {
    const HEIGHT: f64 = 11.0;
    let size = TextSize::Small;
    // About where the plot lies within its panel; close enough to keep labels apart.
    let (width, height) = (PANEL[0] - 60.0, PANEL[1] - 30.0);
    let point = |p: [f64; 2]| {
        let share = |k: usize| (p[k] - ranges[k][0]) / (ranges[k][1] - ranges[k][0]);
        [share(0) * width, (1.0 - share(1)) * height]
    };
    let mut taken: Vec<[f64; 4]> =
        places.iter().map(|&p| point(p)).map(|[x, y]| [x - 4.0, y - 4.0, x + 4.0, y + 4.0]).collect();
    let corners = [(0.0, 0.0, width, 30.0), (0.6 * width, height - 18.0, width, height)];
    taken.extend(corners.map(|(x0, y0, x1, y1)| [x0, y0, x1, y1]));
    let mut named: Vec<&str> = Vec::new();
    let mut marks = Vec::new();
    // What is on the front is named first: it is what one looks for.
    let front = front(places);
    let mut order: Vec<(&&Measurement, &[f64; 2])> = case.iter().zip(places).collect();
    order.sort_by_key(|(_, place)| !front.contains(place));
    for (measurement, &at) in order {
        if named.contains(&measurement.method.as_str()) {
            continue;
        }
        let [x, y] = point(at);
        let long = text_width(&measurement.method, size);
        let sides = [
            (Anchor::LEFT, [7.0, 0.0], [x + 7.0, y - HEIGHT / 2.0]),
            (Anchor::RIGHT, [-7.0, 0.0], [x - 7.0 - long, y - HEIGHT / 2.0]),
            (Anchor::LEFT_BOTTOM, [5.0, -5.0], [x + 5.0, y - 5.0 - HEIGHT]),
            (Anchor::LEFT_TOP, [5.0, 5.0], [x + 5.0, y + 5.0]),
            (Anchor::RIGHT_BOTTOM, [-5.0, -5.0], [x - 5.0 - long, y - 5.0 - HEIGHT]),
            (Anchor::RIGHT_TOP, [-5.0, 5.0], [x - 5.0 - long, y + 5.0]),
        ];
        let free = sides.into_iter().find_map(|(anchor, offset, [left, top])| {
            let box_of = [left, top, left + long, top + HEIGHT];
            let inside = left >= 0.0 && top >= 0.0 && box_of[2] <= width && box_of[3] <= height;
            (inside && !taken.iter().any(|other| overlap(&box_of, other))).then_some((anchor, offset, box_of))
        });
        let Some((anchor, offset, box_of)) = free else { continue };
        taken.push(box_of);
        named.push(&measurement.method);
        let ink = Ink::new(InkRole::Text);
        let shape = Shape::Text { at, text: measurement.method.clone(), anchor, offset, size, ink };
        marks.push(Mark::new(Things::NONE, &measurement.method, shape));
    }
    marks
}

fn overlap(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}
