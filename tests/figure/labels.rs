//! Texts of plots: each where it covers nothing, else by a leader, else away.

use chromascope_figure::{
    Anchor, Axis, Figure, Image, InkRole, Label, Labels, Mark, Marker, PageStyle, Palette, Panel, Place, Rect, Shape,
    Tag, svg,
};
use proptest::prelude::*;

use crate::faults::faults;

/// Ground, grid lines and all else told apart.
struct Colors;

impl Palette for Colors {
    fn rgb(&self, role: InkRole) -> [u8; 3] {
        match role {
            InkRole::Plot => [255; 3],
            InkRole::Grid => [200; 3],
            _ => [20; 3],
        }
    }
}

/// A panel of 0 to 1 on both axes.
fn panel(size: [f64; 2], marks: Vec<Mark>) -> Panel {
    let area = Rect::from_min_size([0.0; 2], size);
    Panel { marks, ..Panel::new("panel", area, Axis::new("x", [0.0, 1.0]), Axis::new("y", [0.0, 1.0])) }
}

fn faults_of(panel: &Panel) -> Vec<String> {
    let mut figure = Figure::new("figure", [panel.area.width(), panel.area.height()]);
    figure.panels.push(panel.clone());
    let none = |_: &Image| None;
    let style = svg::SvgStyle { font_family: "DejaVu Sans", mono_family: "DejaVu Sans Mono", encode: &none };
    faults(&svg::write(&figure, &Colors, &style, &PageStyle::default()), "#ffffff", "#c8c8c8")
}

fn marker(at: [f64; 2]) -> Mark {
    let shape = Shape::Points { points: vec![at], marker: Marker::Square, radius: 5.0 };
    Mark::new(Tag(1), "marker", shape).with_fill(InkRole::Text)
}

fn line(points: Vec<[f64; 2]>) -> Mark {
    Mark::new(Tag(2), "line", Shape::Line { points, closed: false }).with_stroke(InkRole::Text, 2.0)
}

fn bar(min: [f64; 2], max: [f64; 2]) -> Mark {
    Mark::new(Tag(3), "bar", Shape::Rect { min, max }).with_fill(InkRole::Weak)
}

/// Words and leaders of texts placed in a panel.
fn words(labels: Labels) -> Vec<String> {
    labels.into_marks().into_iter().map(|mark| mark.name).collect()
}

#[test]
fn a_text_stands_beside_its_point_else_at_a_leader_else_shortened_else_nowhere() {
    let at = [0.5, 0.5];
    let label = |text: &str| Label::new(text, InkRole::Text, Place::around(at, [1.0, -1.0], 9.0));
    let led = |text: &str| Label { starts: vec![at], ..label(text) };
    let free = panel([300.0, 200.0], vec![marker(at)]);
    let mut labels = Labels::new(&free);
    assert!(labels.place(&label("beside")));
    assert_eq!(words(labels), ["beside"]);
    // Lines all around the point leave no room beside it.
    let ring = |r: f64| line([[-r, -r], [r, -r], [r, r], [-r, r], [-r, -r]].map(|[x, y]| [0.5 + x, 0.5 + y]).to_vec());
    let crowded = panel([300.0, 200.0], vec![marker(at), ring(0.1), ring(0.07)]);
    let mut labels = Labels::new(&crowded);
    assert!(!labels.place(&label("away")) && labels.place(&led("led")));
    let marks = labels.into_marks();
    assert_eq!(marks.iter().map(|mark| mark.name.as_str()).collect::<Vec<_>>(), ["led, leader", "led"]);
    let stroke = marks[0].stroke.expect("a line");
    assert!(stroke.ink.role == InkRole::Weak && stroke.width < 1.0, "a gray hairline");
    let narrow = panel([110.0, 80.0], vec![marker(at)]);
    let mut labels = Labels::new(&narrow);
    let long = led("a name that is wider than the plot");
    assert!(!labels.place(&long) && labels.place(&Label { shorter: vec!["name".to_owned()], ..long.clone() }));
    assert_eq!(words(labels), ["name"]);
    let mut labels = Labels::new(&narrow);
    assert!(labels.place(&Label { always: true, ..long }), "what is pointed at is never left out");
}

#[test]
fn what_is_placed_first_keeps_its_place() {
    let free = panel([200.0, 100.0], Vec::new());
    let label = |text: &str| Label::new(text, InkRole::Text, vec![Place::beside([0.5, 0.5], [0.0, 0.0], 0.0)]);
    let mut labels = Labels::new(&free);
    assert!(labels.place(&label("first")) && !labels.place(&label("second")));
}

#[test]
fn grounds_bear_text_and_bars_do_not() {
    let label = Label::new("text", InkRole::Text, vec![Place::beside([0.5, 0.5], [0.0, 0.0], 0.0)]);
    let full = || bar([0.0, 0.0], [1.0, 1.0]);
    let pale = Mark { fill: Some(chromascope_figure::Ink::new(InkRole::Text).faded(0.1)), ..full() };
    let grid = line(vec![[0.0, 0.5], [1.0, 0.5]]).with_stroke(InkRole::Grid, 1.0);
    assert!(Labels::new(&panel([200.0, 100.0], vec![pale, grid])).place(&label));
    assert!(!Labels::new(&panel([200.0, 100.0], vec![full()])).place(&label));
    assert!(!Labels::new(&panel([200.0, 100.0], vec![line(vec![[0.0, 0.5], [1.0, 0.5]])])).place(&label));
}

#[test]
fn nothing_lies_under_the_texts_in_the_upper_corners() {
    let high = || panel([300.0, 200.0], vec![line(vec![[0.0, 1.0], [1.0, 0.9]]), bar([0.8, 0.0], [0.9, 0.95])]);
    let mut titled = Panel { note: "a note".to_owned(), ..high() };
    titled.y.label = "a title of this axis".to_owned();
    assert!(!faults_of(&titled).is_empty());
    let raised = titled.with_headroom(2.0);
    assert_eq!(faults_of(&raised), Vec::<String>::new());
    assert!(raised.y.range[0] == 0.0 && raised.y.range[1] < 1.3, "no higher than needed: {:?}", raised.y.range);
    let again = raised.clone().with_headroom(2.0);
    assert!((again.y.range[1] - raised.y.range[1]).abs() < 1e-3, "raised once");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn texts_meet_nothing(
        points in proptest::collection::vec([0.0..1.0_f64, 0.0..1.0_f64], 1..30),
        curve in proptest::collection::vec(0.1..0.9_f64, 2..12),
        size in [120.0..500.0_f64, 90.0..400.0_f64],
    ) {
        let mut marks: Vec<Mark> = points.iter().map(|at| marker(*at)).collect();
        let step = 1.0 / (curve.len() - 1) as f64;
        marks.push(line(curve.iter().enumerate().map(|(i, y)| [i as f64 * step, *y]).collect()));
        marks.push(bar([0.4, 0.0], [0.5, 0.3]));
        let mut panel = panel(size, marks);
        let mut labels = Labels::new(&panel);
        for (index, at) in points.iter().enumerate() {
            let label = Label::new(format!("point number {index}"), InkRole::Text, Place::around(*at, [1.0, 0.0], 9.0));
            labels.place(&Label { starts: vec![*at], ..label });
        }
        panel.marks.extend(labels.into_marks());
        let found: Vec<String> = faults_of(&panel).into_iter().filter(|fault| {
            // The symbols of the axes stand in corners, whatever lies there.
            !fault.starts_with("“x”") && !fault.starts_with("“y”")
        }).collect();
        prop_assert_eq!(found, Vec::<String>::new());
    }
}

#[test]
fn a_label_may_lie_anywhere_of_its_anchor() {
    let place = Place { at: [0.5, 0.5], anchor: Anchor::LEFT_TOP, offset: [3.0, 4.0] };
    let free = panel([200.0, 100.0], Vec::new());
    let mut labels = Labels::new(&free);
    assert!(labels.place(&Label::new("text", InkRole::Text, vec![place])));
    let marks = labels.into_marks();
    assert!(matches!(&marks[0].shape, Shape::Text { anchor: Anchor::LEFT_TOP, offset: [3.0, 4.0], .. }));
    assert_eq!(marks[0].halo, Some(free.background), "over grid lines");
}
