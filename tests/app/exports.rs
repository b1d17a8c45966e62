//! Tests of exports: each pane's figure as SVG and PNG, and its numbers.

use chromascope::catalog::Catalog;
use chromascope::document::{Document, Subset, TransformChoice};
use chromascope::export::{Paper, pdf, png, png_file, png_file_at, svg};
use chromascope::figures::look::FigureLook;
use chromascope::palette::Colors;
use chromascope::panes;
use chromascope::results::Results;
use chromascope::scene::{LOCUS_POINTS, Scene};
use chromascope::workspaces::PaneKind;
use chromascope_figure::{FigureRoom, Mark, Page, Shape, TextSize};

const PICTURED: [PaneKind; 3] = [PaneKind::CHROMATICITY, PaneKind::SWATCHES, PaneKind::SPECTRA];

fn documents() -> [Document; 3] {
    let observer = TransformChoice::Observer("CIE 1931 2°".to_owned());
    [
        Document::paper(),
        Document { subset: Subset::All, ..Document::paper() },
        Document { subset: Subset::All, transform: observer, ..Document::paper() },
    ]
}

#[test]
fn every_figure_becomes_svg_png_and_numbers() {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    for (index, document) in documents().iter().enumerate() {
        let scene = Scene { document, catalog: &catalog, results: &results };
        for pane in PICTURED {
            let figure =
                panes::figure(pane, &scene, &FigureLook::default(), FigureRoom::default()).expect("it has a figure");
            let text = svg(&figure, &Colors::LIGHT, Paper::default());
            // Encoded pictures may hold any three letters.
            let attributes = text.split('"').filter(|part| !part.starts_with("data:"));
            assert!({ attributes }.all(|part| !part.contains("NaN") && !part.contains("inf")), "{pane:?}");
            let picture = png(&text, 2.003).expect("the SVG is well formed");
            assert!(picture.pixels().all(|pixel| pixel.0[3] == 255), "{pane:?}: pixels in part along an edge");
            let path =
                std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}_{index}.png", panes::title(pane)));
            std::fs::write(path, png_file(&picture).unwrap()).unwrap();
            let csv = figure.table.to_csv();
            assert!(!csv.contains("NaN") && !csv.contains("inf"), "{pane:?}");
            assert!(figure.table.rows.iter().all(|row| row.len() == figure.table.columns.len()));
        }
    }
}

#[test]
fn numbers_are_those_of_the_scene() {
    let (catalog, results, document) = (Catalog::built_in(), Results::default(), Document::paper());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let figure = |pane| panes::figure(pane, &scene, &FigureLook::default(), FigureRoom::default());
    let rows = |pane| figure(pane).unwrap().table.rows.len();
    assert_eq!(rows(PaneKind::CHROMATICITY), 5 * (LOCUS_POINTS + 5), "five sources, loci and patches");
    assert_eq!(rows(PaneKind::SWATCHES), 4 * 5, "CIE 1931 is left out by Paper");
    assert_eq!(rows(PaneKind::SPECTRA), 401);
}

#[test]
fn panes_without_a_figure_have_none() {
    let (catalog, results, document) = (Catalog::built_in(), Results::default(), Document::paper());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let look = FigureLook::default();
    assert!(panes::figure(PaneKind::INSPECTOR, &scene, &look, FigureRoom::default()).is_none());
}

#[test]
fn text_has_its_size_on_paper_whatever_the_width() {
    let (catalog, results, document) = (Catalog::built_in(), Results::default(), Document::paper());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    for pane in PICTURED {
        for (mm, font_pt) in [(Paper::ONE_COLUMN_MM, 8.0), (Paper::TWO_COLUMNS_MM, 8.0), (Paper::ONE_COLUMN_MM, 6.0)] {
            let paper = Paper { width_mm: Some(mm), font_pt, ..Paper::default() };
            let make = |room| panes::figure(pane, &scene, &FigureLook::default(), room);
            let figure = paper.laid_out(make).expect("it has a figure");
            let page = Page::new(&figure, &paper.page_style()).area;
            let text = f64::from(TextSize::Small.points()) * mm / 25.4 * 72.0 / page.width();
            assert!((text - font_pt).abs() < 0.01, "{pane:?} at {mm} mm: {text} pt instead of {font_pt} pt");
            let mut marks = figure.panels.iter().flat_map(|panel| &panel.marks);
            let is_larger = |mark: &Mark| matches!(mark.shape, Shape::Text { size: TextSize::Body, .. });
            assert!(!marks.any(is_larger), "{pane:?}: all text has one size");
            let file = pdf(&figure, &paper.colors(), paper).expect("a PDF");
            assert_eq!(file, pdf(&figure, &paper.colors(), paper).unwrap(), "the same bytes each time");
        }
    }
}

#[test]
fn a_png_states_its_resolution() {
    let file = png_file_at(&image::RgbaImage::new(4, 3), 300.0).expect("a PNG");
    let at = file.windows(4).position(|part| part == b"pHYs").expect("pHYs") + 4;
    assert_eq!(file[at..at + 9], [0, 0, 0x2E, 0x23, 0, 0, 0x2E, 0x23, 1], "11811 pixels per meter");
}
