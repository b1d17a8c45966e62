//! Data with its doubt: what a table does not hold is marked wherever its numbers are shown.

use chromascope::catalog::Catalog;
use chromascope::document::{Diagram, Document, Light, SetKind};
use chromascope::figures::look::FigureLook;
use chromascope::figures::{chromaticity, strip};
use chromascope::plot_item::{PlotItem, SensorId};
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope_figure::{Cell, Dash, FigureRoom, Mark, Marker, Shape};

const D70: &str = "Nikon D70 (2007 figure)";

fn with<R>(document: &Document, look: impl FnOnce(&Scene<'_>) -> R) -> R {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    look(&Scene { document, catalog: &catalog, results: &results })
}

/// Document of the paper with the measured D70 beside the digitized one.
fn both() -> Document {
    let mut document = Document::paper();
    document.compare("Nikon D70 (A.M.P.A.S.)", SetKind::Camera);
    document
}

fn points(mark: &Mark) -> &[[f64; 2]] {
    match &mark.shape {
        Shape::Line { points, .. } | Shape::Points { points, .. } => points,
        _ => &[],
    }
}

/// Dashes of the lines with this name, and the ranges of their finite first coordinates.
fn lines<'a>(marks: &'a [Mark], name: &str) -> Vec<(Dash, Vec<&'a [f64; 2]>)> {
    let own = marks.iter().filter(|mark| mark.name == name && matches!(mark.shape, Shape::Line { .. }));
    own.map(|mark| {
        let dash = mark.stroke.map_or(Dash::Solid, |stroke| stroke.dash);
        (dash, points(mark).iter().filter(|p| p[0].is_finite()).collect())
    })
    .collect()
}

#[test]
fn a_locus_is_dotted_where_its_table_ends_too_early() {
    with(&both(), |scene| {
        let built = chromaticity::build(scene, &FigureLook::default(), [800.0, 600.0]);
        let figure = lines(&built.panel.marks, "Nikon D70 (2007)");
        let [(Dash::Solid, solid), (Dash::Dotted, dotted)] = figure.as_slice() else { panic!("{figure:?}") };
        // 200 points evenly in mired from 1000 to 20000 K: 126 of them below 2500 K, and the one where the two meet.
        assert_eq!((solid.len(), dotted.len()), (74, 127));
        assert_eq!(solid[0], dotted[126], "the two meet");
        let measured = lines(&built.panel.marks, "Nikon D70 (A.M.P.A.S.)");
        assert!(matches!(measured.as_slice(), [(Dash::Solid, all)] if all.len() == 200), "{measured:?}");
        let loci = |name: &str| built.loci.iter().filter(|place| built.panel.marks[**place].name == name).count();
        assert_eq!(
            ["Nikon D70 (2007)", "Nikon D70 (A.M.P.A.S.)"].map(loci),
            [2, 1],
            "the lines under the pointer are known"
        );
        let strip = strip::build(scene, [800.0, 90.0]).expect("cameras compare");
        let figure = lines(&strip.panel.marks, "Nikon D70 (2007)");
        let [(Dash::Solid, solid), (Dash::Dotted, dotted)] = figure.as_slice() else { panic!("{figure:?}") };
        let mired = |p: &[f64; 2]| 1e6 / strip::kelvin(p[0]);
        assert!(solid.iter().all(|p| mired(p) <= 400.001) && dotted.iter().all(|p| mired(p) > 400.0 - 5.0));
        assert_eq!(lines(&strip.panel.marks, "Nikon D70 (A.M.P.A.S.)").len(), 1);
    });
}

#[test]
fn tooltip_caption_and_table_say_what_is_extrapolated() {
    with(&both(), |scene| {
        let told = |name: &str, kelvin| {
            let source = SensorId { kind: SetKind::Camera, name: name.to_owned() };
            chromaticity::describe(scene, &PlotItem::Radiator { source, kelvin }).join("\n")
        };
        let words = "extrapolated: below 2500 K, the missing data beyond 700 nm matter";
        assert!(told(D70, 1000.0).contains(words) && told(D70, 2499.0).contains(words));
        assert!(!told(D70, 2500.0).contains("extrapolated"));
        assert!(!told("Nikon D70 (A.M.P.A.S.)", 1000.0).contains("extrapolated"));
        let figure = chromaticity::KIND.figure(scene, &FigureLook::default(), FigureRoom::default()).unwrap();
        let cut =
            "Dotted below 2500 K, where the sensitivity table ends too early: Canon 10D (2007), Nikon D70 (2007).";
        assert!(figure.caption.contains(cut), "{}", figure.caption);
        let column = |name: &str| figure.table.columns.iter().position(|c| c == name).expect("a column");
        let [source, kelvin, extrapolated] = ["sensor", "temperature_k", "extrapolated"].map(column);
        for row in &figure.table.rows {
            let Some(Cell::Number(kelvin)) = row.get(kelvin) else {
                assert_eq!(row.get(extrapolated), Some(&Cell::Empty), "patches have none");
                continue;
            };
            let short = [Cell::from("Nikon D70 (2007)"), Cell::from("Canon 10D (2007)")].contains(&row[source]);
            let expected = if short && *kelvin < 2500.0 { "true" } else { "false" };
            assert_eq!(row[extrapolated], Cell::from(expected), "{row:?}");
        }
    });
}

/// Rings of the strip in kelvins, by the name of their marks.
fn minima(document: &Document) -> (String, Vec<f64>) {
    with(document, |scene| {
        let strip = strip::build(scene, [800.0, 90.0]).expect("cameras compare");
        let rings = strip.panel.marks.iter().filter(|mark| mark.name.contains("minimum"));
        let rings = rings.inspect(|mark| assert!(matches!(mark.shape, Shape::Points { marker: Marker::Circle, .. })));
        (strip.panel.note.clone(), rings.map(|mark| strip::kelvin(points(mark)[0][0])).collect())
    })
}

#[test]
fn the_strip_marks_minima_and_says_what_they_follow() {
    let (note, rings) = minima(&Document::paper());
    assert_eq!(note, "distance to reference (Δxy, square-root scale), normalized to equal energy (ring: minimum)");
    // By half kelvins on the command line.
    let expected = [6033.5, 5948.0, 5772.5];
    assert_eq!(rings.len(), expected.len());
    for (ring, expected) in rings.iter().zip(expected) {
        assert!((ring - expected).abs() < 1.0, "{rings:?}");
    }
    let mut document = Document { light: Light::Set("A".to_owned()), ..Document::default() };
    let (note, rings) = minima(&document);
    assert_eq!(note, "distance to reference (Δxy, square-root scale), normalized to A (ring: minimum)");
    assert!(rings.len() == 3 && rings.iter().all(|ring| (ring - 2856.0).abs() < 1.0), "{rings:?}");
    document.diagram = Diagram::UvPrime;
    assert!(minima(&document).1.iter().all(|ring| (ring - 2856.0).abs() < 1.0));
}
