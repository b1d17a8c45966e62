//! Words and numbers beside figures, on the terminal and in messages, and the part of a diagram that is shown.

use std::borrow::Cow;

use chromascope::catalog::Catalog;
use chromascope::document::{Diagram, Document, Light, SetKind};
use chromascope::export::Paper;
use chromascope::figures::chromaticity::shown::{DiagramFit, DiagramView, Fit, FitKey};
use chromascope::figures::kind::FigureKind;
use chromascope::figures::look::{FigureLook, Sorting};
use chromascope::figures::render::difference::{GROUND, Scale};
use chromascope::figures::render::headline::{Detail, Measure};
use chromascope::figures::render::returned::{self, Words};
use chromascope::figures::{chromaticity, differences, light, metrics, strip};
use chromascope::palette::difference_ramp;
use chromascope::plot_item::SensorId;
use chromascope::profiler::plans::ErrorBounds;
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::scene::metrics::RankedCameras;
use chromascope::terminal::shown;
use chromascope_core::colorimetry::Metric;
use chromascope_core::query::render::Roughness;
use chromascope_core::query::render::difference::{BrightSamples, Difference};
use chromascope_core::reflectance::Normalization;
use chromascope_figure::{Figure, Projection, Shape};
use chromascope_workbench::format::dropped_rows;
use chromascope_workbench::names::shortest;
use spectral_file::{Dropped, DroppedRow};

#[test]
fn a_picture_without_light_has_no_difference() {
    let measure = Measure { metric: Metric::DELTA_E_2000, by_eq_13: false, of_image: false };
    let bright = Some(BrightSamples { count: 2, median: 2.0, p95: 4.0 });
    let some =
        Difference { stride: 1, map: vec![1.0; 3], mean: 1.0, max: 5.0, facing: Some(3.12), garment: None, bright };
    let said = [Detail::Number, Detail::Metric, Detail::Quantiles, Detail::Largest];
    assert_eq!(
        said.map(|detail| measure.words(&some, detail)),
        [
            "ΔE 3.1",
            "ΔE*00 3.1",
            "ΔE*00 3.1 facing light, median 2.0, 95 % 4.0",
            "ΔE*00 3.1 facing light, median 2.0, 95 % 4.0, max 5.0"
        ]
    );
    let clothed = Difference { garment: Some(2.04), ..some.clone() };
    let words = "ΔE*00 3.1 (garment 2.0) facing light, median 2.0, 95 % 4.0";
    assert_eq!(measure.words(&clothed, Detail::Quantiles), words);
    let dark = Difference { bright: None, ..some.clone() };
    let unlit = Difference { map: Vec::new(), mean: 0.0, max: 0.0, ..dark.clone() };
    assert_eq!(measure.words(&dark, Detail::Number), "ΔE 3.1");
    let whole = measure.words(&dark, Detail::Quantiles);
    assert_eq!(whole, "ΔE*00 3.1 facing light, all other samples too dark");
    assert!(said.iter().all(|&detail| measure.words(&unlit, detail) == "no light"));
    let image = Measure { of_image: true, ..measure };
    let words = image.words(&Difference { facing: None, ..some }, Detail::Largest);
    assert_eq!(words, "ΔE*00 mean 1.0, median 2.0, 95 % 4.0, max 5.0");
}

#[test]
fn names_and_decimals_are_the_metrics() {
    let facing = Difference {
        stride: 1,
        map: vec![0.02],
        mean: 0.02,
        max: 0.02,
        facing: Some(0.0213),
        garment: None,
        bright: None,
    };
    let of = |metric, by_eq_13| Measure { metric, by_eq_13, of_image: false }.words(&facing, Detail::Metric);
    assert_eq!(of(Metric::DELTA_E_2000, true), "Δ of Eq 13 colors 0.0");
    assert_eq!(of(Metric::XY, true), "Δxy 0.021");
    let number = Measure { metric: Metric::UV_PRIME, by_eq_13: false, of_image: false }.words(&facing, Detail::Number);
    assert_eq!(number, "Δu′v′ 0.021");
}

fn said_of_light(change: impl FnOnce(&mut Document)) -> Option<Words> {
    let mut document = Document::colorimetry();
    change(&mut document);
    let (catalog, results) = (Catalog::built_in(), Results::default());
    returned::words(&Scene { document: &document, catalog: &catalog, results: &results })
}

#[test]
fn the_default_skin_returns_half_of_the_light() {
    let words = said_of_light(|_| ()).expect("a sentence");
    assert_eq!(words.text, "Returns 0.49 of the light at normal incidence (0.03 at 85°)");
    assert!(!words.is_warning);
}

#[test]
fn more_light_than_comes_is_a_warning() {
    let words =
        said_of_light(|document| document.render.normalization = Normalization::Microfacet).expect("a sentence");
    assert!(words.is_warning && words.text.contains("; more than 1 from 7"), "{}", words.text);
    let words = said_of_light(|document| document.render.normalization = Normalization::Paper).expect("a sentence");
    assert!(!words.is_warning && words.text.contains("e-6 of the light") && words.text.ends_with("with P as π f"));
}

#[test]
fn without_one_surface_nothing_is_said_of_light() {
    assert_eq!(said_of_light(|document| document.render.normalization = Normalization::Lambertian), None);
    assert_eq!(said_of_light(|document| document.render.roughness = Roughness::Mesh), None);
}

#[test]
fn each_error_is_said_with_what_it_is_relative_to() {
    let words = |diffuse, coherent| ErrorBounds { diffuse, coherent }.words();
    assert_eq!(
        words(Some(3.4e-10), Some(1e-9)),
        "diffuse component: estimated error bound 3.4e-10 of the peak; specular lobes within 1e-9 of the brightest sample; \
         stored in single precision (6e-8)"
    );
    assert_eq!(
        words(Some(4.3e-8), None),
        "diffuse component: estimated error bound 4.3e-8 of the peak; stored in single precision (6e-8)"
    );
    assert_eq!(
        words(Some(4.3e-8), Some(1e-3)),
        "diffuse component: estimated error bound 4.3e-8 of the peak; specular lobes within 1e-3 of the brightest sample"
    );
    assert_eq!(words(None, None), "no sample takes a spectral integral");
    assert_eq!(
        words(None, Some(1e-5)),
        "no sample takes a spectral integral; specular lobes within 1e-5 of the brightest sample"
    );
}

fn key(names: &[&str]) -> FitKey {
    let sensors = names.iter().map(|name| SensorId { kind: SetKind::Camera, name: (*name).to_owned() }).collect();
    FitKey { diagram: Diagram::Xy, fit: DiagramFit::Data, sensors, patches: Default::default() }
}

const SMALL: Fit = Fit { shown: [[0.2, 0.4]; 2], data: [[0.2, 0.4]; 2] };
const LARGE: Fit = Fit { shown: [[0.0, 0.8]; 2], data: [[0.2, 0.4]; 2] };

#[test]
fn a_fit_is_held_until_the_sensors_change_or_home() {
    let mut view = DiagramView::default();
    assert!(!view.hold(key(&["a"]), false, 0.0, |_| SMALL), "the first fit does not move");
    assert!(!view.hold(key(&["a"]), false, 1.0, |_| panic!("the sensors are the same")));
    assert_eq!(view.fit(), Some(SMALL));
    assert!(view.hold(key(&["a", "b"]), false, 2.0, |_| LARGE));
    assert_eq!(view.fit(), Some(SMALL), "it starts where it was");
    assert!(view.hold(key(&["a", "b"]), false, 2.075, |_| panic!("it is on its way")));
    let [left, right] = view.fit().expect("a fit").shown[0];
    assert!((left - 0.025).abs() < 1e-9 && (right - 0.75).abs() < 1e-9, "{left} {right}");
    assert!(!view.hold(key(&["a", "b"]), false, 2.151, |_| panic!("it has arrived")));
    assert_eq!(view.fit(), Some(LARGE));
    assert!(view.hold(key(&["a", "b"]), true, 3.0, |_| SMALL), "Home");
}

#[test]
fn home_starts_from_what_was_zoomed_to_and_other_coordinates_at_once() {
    let mut view = DiagramView::default();
    view.hold(key(&["a"]), false, 0.0, |_| SMALL);
    view.zoomed = Some(LARGE.shown);
    assert!(view.hold(key(&["a"]), true, 1.0, |_| SMALL));
    assert_eq!((view.fit(), view.zoomed), (Some(LARGE), None), "it starts where it was");
    let other = FitKey { diagram: Diagram::UvPrime, ..key(&["a"]) };
    assert!(!view.hold(other, false, 1.05, |_| SMALL));
    assert_eq!(view.fit(), Some(SMALL));
}

#[test]
fn merged_rows_are_not_left_out() {
    let row = |line, why| DroppedRow { line, why };
    let rows = [row(4, Dropped::Averaged), row(5, Dropped::NoWavelength), row(7, Dropped::Averaged)];
    let merged = "2 rows merged with others of the same wavelength (mean): lines 4, 7";
    assert_eq!(dropped_rows(&rows, 5), [merged, "1 row skipped: line 5 (no wavelength)"]);
    let many: Vec<DroppedRow> = (1..=82).map(|line| row(line, Dropped::Repeated)).collect();
    assert_eq!(dropped_rows(&many, 1), ["82 rows skipped: line 1 (the same as an earlier row) and 81 more"]);
    assert!(dropped_rows(&[], 5).is_empty());
}

#[test]
fn nothing_is_an_order_to_the_terminal() {
    assert_eq!(shown("a\u{1b}[31mb\u{7}"), "a\\u{1b}[31mb\\u{7}");
    assert_eq!(shown("a\u{9b}2Jb\rc\u{7f}"), "a\\u{9b}2Jb\\u{d}c\\u{7f}");
    assert_eq!(shown("\u{202e}gpj.exe\u{2066}"), "\\u{202e}gpj.exe\\u{2066}");
    assert!(matches!(shown("two lines\n\twith \u{394}E\u{2a}\n"), Cow::Borrowed(_)));
}

#[test]
fn ends_of_axes_are_numbers_written_there_and_short_names_are_told() {
    let (document, catalog, results) = (Document::colorimetry(), Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let printed = |kind: &FigureKind, x_range, y_range| {
        let paper = Paper { width_mm: Some(85.0), x_range, y_range, ..Paper::default() };
        kind.on_paper(&paper, &scene, &FigureLook::default()).unwrap()
    };
    for kelvin in [[2000.0, 20_000.0], [2.0, 20.0]] {
        let strip = printed(&strip::KIND, kelvin, [0.0, 0.04]);
        let plot = strip.panels.iter().find(|panel| panel.framed).unwrap();
        assert_eq!([plot.x.range, plot.y.range], [[2000.0, 20_000.0].map(strip::along), [0.0, 0.2]]);
    }
    let strip = printed(&strip::KIND, [0.0; 2], [0.0; 2]);
    let plot = strip.panels.iter().find(|panel| panel.framed).unwrap();
    let ticks = Projection::new(plot, 1.0).x_ticks.into_iter().map(|tick| tick.label).collect::<Vec<_>>();
    assert_eq!(ticks.join(" "), "1 1.5 2 3 4 5 7 10 15 20", "numbers from 5000 to 20000 K too");
    let differences = printed(&differences::KIND, [0.0; 2], [0.0; 2]);
    assert!(differences.caption.contains(" 5D II: Canon EOS 5D Mark II; D70: Nikon D70"), "{}", differences.caption);
}

#[test]
fn differences_reach_near_the_end_of_their_scale() {
    let ratio = |largest: f32| largest / Scale::holding(largest, largest, Metric::DELTA_E_2000).end;
    assert!((200..3000).all(|hundredths| (0.6..=1.0).contains(&ratio(hundredths as f32 / 100.0))));
}

#[test]
fn the_ground_is_no_color_of_the_scale() {
    let far = |a: [u8; 4], b: [u8; 3]| (0..3).any(|i| a[i].abs_diff(b[i]) > 40);
    let colors = || (0..=100).map(|share| difference_ramp(share as f32 / 100.0));
    assert!(colors().all(|color| far(GROUND, color)));
}

#[test]
fn ticks_are_round_in_the_metrics_units() {
    let ticks =
        |largest, metric| Scale::holding(largest, largest, metric).ticks().map(|(_, words)| words).collect::<Vec<_>>();
    assert_eq!(ticks(12.1, Metric::DELTA_E_2000), ["0", "5", "10", "15"]);
    assert_eq!(ticks(0.9, Metric::DELTA_E_2000), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
    assert_eq!(ticks(0.14, Metric::XY), ["0", "0.05", "0.1", "0.15"]);
    assert_eq!(ticks(10.6, Metric::DELTA_E_2000), ["0", "3", "6", "9", "12"]);
    assert_eq!(ticks(7e9, Metric::UV_PRIME).last().map(String::as_str), Some("≥ 1"));
    let few_are_larger = Scale::holding(0.05, 0.12, Metric::XY).ticks().last();
    assert_eq!(few_are_larger, Some((1.0, "≥ 0.05".to_owned())));
}

#[test]
fn names_keep_what_distinguishes_them() {
    let all = [
        "Canon EOS 5D Mark III",
        "Canon EOS 5D Mark IV",
        "Nikon D70 (2007 figure)",
        "Nikon D70 (UPenn 2011)",
        "Nikon D700",
    ];
    let expected = ["5D III", "5D IV", "D70 (2007 figure)", "D70 (UPenn 2011)", "D700"];
    assert_eq!(shortest(all.into_iter()), expected);
    assert_eq!(shortest(["D70 (2007)"].into_iter()), ["D70"]);
    assert_eq!(
        shortest(["TEST (measured)", "TEST (measured 2)"].into_iter()),
        ["TEST (measured)", "TEST (measured 2)"]
    );
}

/// A figure in one column of a journal.
fn in_one_column(kind: &FigureKind, document: &Document, look: &FigureLook) -> Figure {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let scene = Scene { document, catalog: &catalog, results: &results };
    kind.on_paper(&Paper { width_mm: Some(85.0), ..Paper::default() }, &scene, look).unwrap()
}

#[test]
fn no_mark_of_a_patch_is_cut_and_marks_on_loci_are_explained() {
    let figure = in_one_column(&chromaticity::KIND, &Document::paper(), &FigureLook::default());
    let panel = &figure.panels[0];
    let (projection, mut cut) = (Projection::new(panel, 1.0), Vec::new());
    for mark in &panel.marks {
        let Shape::Points { points, radius, .. } = &mark.shape else { continue };
        let [x, y] = projection.at(points[0]);
        let plot = projection.plot;
        let inside = (x - plot.min[0]).min(plot.max[0] - x).min(y - plot.min[1]).min(plot.max[1] - y);
        cut.extend(Some(&mark.name).filter(|_| inside > -radius && inside < radius - 1.0));
    }
    assert!(cut.is_empty(), "{cut:?}");
    assert!(figure.caption.contains(" Large markers on loci tell them apart"), "{}", figure.caption);
}

#[test]
fn every_test_color_has_its_number() {
    let document = Document { light: Light::Set("FL2".to_owned()), ..Document::colorimetry() };
    let figure = in_one_column(&light::KIND, &document, &FigureLook::default());
    let ticks = Projection::new(&figure.panels[0], 1.0).x_ticks.into_iter().map(|tick| tick.label).collect::<Vec<_>>();
    assert_eq!(ticks.join(" "), "Ra 1 2 3 4 5 6 7 8 9 10 11 12 13 14");
}

#[test]
fn the_figure_of_rank_has_the_order_of_the_list() {
    let names = |sorting: Option<(&str, bool)>| {
        let sorting = sorting.map(|(column, descending)| Sorting { column: column.to_owned(), descending });
        let look = FigureLook { sorting, cameras: RankedCameras::Compared, ..FigureLook::default() };
        let figure = in_one_column(&metrics::KIND, &Document::colorimetry(), &look);
        let texts = figure.panels[0].marks.iter().filter_map(|mark| match &mark.shape {
            Shape::Text { text, .. } => Some(text.clone()),
            _ => None,
        });
        texts.filter(|text| ["5D II", "D70", "DCS200"].contains(&text.as_str())).collect::<Vec<_>>()
    };
    assert_eq!(names(None), ["5D II", "D70", "DCS200"]);
    assert_eq!(names(Some(("ΔE*00 mean", true))), ["DCS200", "D70", "5D II"]);
    assert_eq!(names(Some(("camera", false))), ["5D II", "DCS200", "D70"], "by full name");
}
