//! Names of methods beside their points.

use chromascope_figure::{Figure, Image, InkRole, Marker, PageStyle, Palette, Panel, Rect, Shape, Tag, svg};
use chromascope_measure::pareto::{self, Place, duration};

#[path = "../figure/faults.rs"]
mod faults;

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

fn places(count: u32) -> Vec<Place> {
    let place = |index: u32| Place {
        // Four clusters, and some at one place.
        name: format!("method number {index}"),
        tag: Tag(index + 1),
        error: 10_f64.powi(-3 * (index.cast_signed() % 4) - 2) * (1.0 + 0.1 * f64::from(index / 4)),
        seconds: 10_f64.powi(index.cast_signed() % 4 - 8) * (1.0 + 0.2 * f64::from(index / 8)),
        marker: Marker::Circle,
        role: InkRole::Text,
    };
    (0..count).map(place).collect()
}

fn panel(count: u32, size: [f64; 2]) -> Panel {
    let area = Rect::from_min_size([0.0, 0.0], size);
    pareto::panel("p", ["largest error", "time of one"], "note".to_owned(), &places(count), area)
}

fn texts(panel: &Panel) -> Vec<&str> {
    let texts = panel.marks.iter().filter(|mark| matches!(mark.shape, Shape::Text { .. }));
    texts.map(|mark| mark.name.as_str()).collect()
}

#[test]
fn every_method_is_named_and_no_name_covers_another() {
    for count in [1, 4, 9, 17, 24] {
        let panel = panel(count, [420.0, 320.0]);
        let texts = texts(&panel);
        for place in places(count) {
            let named = texts.iter().any(|text| *text == place.name || text.ends_with(&format!(": {}", place.name)));
            assert!(named || count > 20, "{} of {count} is not named: {texts:?}", place.name);
        }
        let mut figure = Figure::new("figure", [420.0, 320.0]);
        figure.panels.push(panel);
        let none = |_: &Image| None;
        let style = svg::SvgStyle { font_family: "DejaVu Sans", mono_family: "DejaVu Sans Mono", encode: &none };
        let svg = svg::write(&figure, &Colors, &style, &PageStyle::default());
        assert_eq!(faults::faults(&svg, "#ffffff", "#c8c8c8"), Vec::<String>::new(), "{count} methods");
    }
}

#[test]
fn what_has_no_room_is_left_out_whole() {
    let panel = panel(24, [110.0, 70.0]);
    let texts = texts(&panel);
    let numbers = texts.iter().filter(|text| text.parse::<u32>().is_ok()).count();
    let lines = texts.iter().filter(|text| text.contains(": ")).count();
    assert_eq!(numbers, lines, "a number without its name says nothing");
}

#[test]
fn what_has_no_error_has_a_place() {
    let place = |error, seconds| Place {
        name: "a method".to_owned(),
        tag: Tag(1),
        error,
        seconds,
        marker: Marker::Circle,
        role: InkRole::Text,
    };
    let area = Rect::from_min_size([0.0, 0.0], [400.0, 300.0]);
    let places = [place(0.0, 1e-6), place(1e-3, 0.0)];
    let panel = pareto::panel("p", ["error", "time"], String::new(), &places, area);
    let finite = |v: &[f64; 2]| v.iter().all(|v| v.is_finite());
    for mark in &panel.marks {
        if let Shape::Points { points, .. } | Shape::Line { points, .. } = &mark.shape {
            assert!(points.iter().all(finite));
        }
    }
    assert_eq!((panel.x.range, panel.y.range[0]), ([-19.0, -2.0], -16.0), "all is within the axes");
    assert!((-5.0..-3.0).contains(&panel.y.range[1]), "the title has room above: {:?}", panel.y.range);
}

#[test]
fn times_have_units_that_suit() {
    let all = [1e-9, 1.5e-8, 9.99e-7, 1e-6, 2.5e-6, 1.5e-3, 0.9999, 12.0].map(duration);
    assert_eq!(all, ["1 ns", "15 ns", "999 ns", "1 µs", "2.50 µs", "1.50 ms", "1.00 s", "12 s"]);
}
