//! Uncertainties that files state: in ±, in words, in tables and as bands.

use std::fmt::Write as _;

use chromascope::catalog::Catalog;
use chromascope::catalog::import::import;
use chromascope::document::imported::{Covariance, ImportedSet, Role, Uncertainty};
use chromascope::document::{Document, Light, SetKind, Subset};
use chromascope::export;
use chromascope::figures::curves::{self, ImportItem, ImportSelection};
use chromascope::figures::look::FigureLook;
use chromascope::figures::{metrics, spectra};
use chromascope::palette::Colors;
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::scene::metrics::{CameraFigures, RankedCameras};
use chromascope::scene::uncertainty::{in_words, with_nature};
use chromascope_core::query::CameraMetric;
use chromascope_core::query::metrics::UncertaintySource;
use chromascope_core::spectral::Correlation;
use chromascope_figure::number::significant;
use chromascope_figure::{Figure, FigureRoom, Shape};

const SAMPLES: usize = 31;

/// Three bells over 400–700 nm, with standard uncertainties of 1 % of the peak, stated by k = 2.
fn camera(is_stated: bool) -> ImportedSet {
    let mut text = "wavelength,red,green,blue\n".to_owned();
    for j in 0..SAMPLES {
        let nm = 400.0 + 10.0 * j as f64;
        let bell = |at: f64| (-((nm - at) / 45.0).powi(2)).exp();
        writeln!(text, "{nm},{:.6},{:.6},{:.6}", bell(600.0), bell(540.0), bell(460.0)).unwrap();
    }
    let mut set = import("bells.csv", text.as_bytes(), Some(Role::Camera)).unwrap().set;
    for curve in set.curves.iter_mut().filter(|_| is_stated) {
        curve.uncertainty = Some(Uncertainty { standard: vec![0.01; SAMPLES], coverage: 2.0 });
    }
    set
}

fn with<T>(sets: Vec<ImportedSet>, of: impl FnOnce(&Scene<'_>) -> T) -> T {
    let mut document = Document::colorimetry();
    crate::import_sets(sets).apply(&mut document);
    within(&document, of)
}

fn within<T>(document: &Document, of: impl FnOnce(&Scene<'_>) -> T) -> T {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    of(&Scene { document, catalog: &catalog, results: &results })
}

fn figures(set: &ImportedSet) -> CameraFigures {
    with(vec![set.clone()], |scene| scene.camera_figures(SetKind::Camera, &set.name).unwrap())
}

fn u(of: &CameraFigures, id: &str) -> chromascope_core::query::MetricUncertainty {
    of.of(CameraMetric::by_id(id).unwrap()).unwrap().uncertainty.unwrap()
}

#[test]
fn a_camera_that_states_uncertainties_is_its_own() {
    let [own, prior] = [true, false].map(|is_stated| figures(&camera(is_stated)));
    let [a, b] = [&own, &prior].map(|of| u(of, "vora"));
    assert!(matches!(a.source, UncertaintySource::Own(Correlation::None | Correlation::Full)), "{a:?}");
    assert_eq!((a.freedom, a.coverage, a.is_extrapolated), (f64::INFINITY, 2.0, false));
    assert_eq!((b.source, b.freedom), (UncertaintySource::Prior, 14.0));
    assert_ne!(a.contributions.curves, b.contributions.curves);
    let words = in_words([a]);
    for part in ["own: as the camera's file states it", "whichever gives more", "± 2.00 u, ∞ degrees of freedom"] {
        assert!(words.contains(part), "{part} is not in {words}");
    }
    let both = in_words([a, b]);
    assert!(both.contains("∞") && both.contains("2.47 u, 14 degrees") && both.contains("prior"), "{both}");
    // One channel without: the prior.
    let mut set = camera(true);
    set.curves[1].uncertainty = None;
    assert_eq!(u(&figures(&set), "vora").source, UncertaintySource::Prior);
    with(vec![camera(true)], |scene| {
        let ranked = scene.ranked(RankedCameras::Yours);
        let csv =
            with_nature(metrics::table(&ranked), |camera| metrics::uncertainties(&ranked, [camera])).csv(significant);
        assert!(csv.lines().last().unwrap().ends_with(",own,2.00000000000000,inf,false"), "{csv}");
    });
}

#[test]
fn a_covariance_decides_and_an_impossible_one_is_refused_in_a_sentence() {
    let size = 3 * SAMPLES;
    let covariance = |off: f64| {
        let value = |at: usize| if at.is_multiple_of(size + 1) { 1e-4 } else { off };
        Some(Covariance { size, values: (0..size * size).map(value).collect() })
    };
    let with_covariance = |off: f64| ImportedSet { covariance: covariance(off), ..camera(true) };
    let source = |set: &ImportedSet| u(&figures(set), "vora").source;
    assert_eq!(source(&with_covariance(0.5e-4)), UncertaintySource::Own(Correlation::Stated));
    let refused = with_covariance(1.5e-4);
    assert_eq!(source(&refused), source(&camera(true)));
    let sentences = with(vec![refused.clone()], |scene| scene.refused_uncertainties([refused.name.as_str()]));
    let [sentence] = &sentences[..] else { panic!("{sentences:?}") };
    assert!(sentence.starts_with("bells: the covariance is not positive semidefinite"), "{sentence}");
    assert!(sentence.ends_with("Its uncertainties are used without."), "{sentence}");
}

fn marks<'a>(figure: &'a Figure, name: &str) -> Vec<&'a Shape> {
    let all = figure.panels.iter().flat_map(|panel| &panel.marks);
    all.filter(|mark| mark.name.ends_with(name)).map(|mark| &mark.shape).collect()
}

#[test]
fn light_and_chart_have_parts_and_bands() {
    let stated = |file: &str, text: &str, role: Role| {
        let mut set = import(file, text.as_bytes(), Some(role)).unwrap().set;
        for curve in &mut set.curves {
            curve.uncertainty = Some(Uncertainty { standard: vec![0.02; curve.values.len()], coverage: 1.0 });
        }
        set
    };
    let lamp = stated("lamp.csv", "nm,lamp\n380,0.4\n450,0.9\n550,1\n650,0.8\n780,0.5\n", Role::Illuminant);
    let leaves = stated("leaves.csv", "nm,dry,wet\n380,0.1,0.1\n550,0.5,0.3\n780,0.8,0.4\n", Role::Reflectance);
    let mut document = Document::colorimetry();
    crate::import_sets(vec![lamp, leaves]).apply(&mut document);
    (document.light, document.chart, document.subset) =
        (Light::Set("lamp".to_owned()), "leaves".to_owned(), Subset::All);
    within(&document, |scene| {
        let found = u(&scene.camera_figures(SetKind::Camera, "Nikon D850").unwrap(), "delta-e2000-mean");
        assert_eq!(found.source, UncertaintySource::Prior);
        assert!(found.contributions.light > 0.0 && found.contributions.patches > 0.0, "{found:?}");
        let words = in_words([found]);
        assert!(words.contains("by the sensitivities and the light and the patches (prior"), "{words}");
        let figure = spectra::KIND.figure(scene, &FigureLook::default(), FigureRoom::default()).unwrap();
        assert_eq!(marks(&figure, "±U").len(), 3);
        assert!(figure.caption.contains("Band: ±U, k = 2. "), "{}", figure.caption);
        // The light and the patches have bands, the sensitivities have none.
        let named: Vec<bool> = figure.panels.iter().map(|panel| panel.note.contains("band: ±U, k = 2")).collect();
        assert_eq!(named[..3], [true, true, false], "{:?}", figure.panels.iter().map(|p| &p.note).collect::<Vec<_>>());
        let svg = export::svg(&figure, &Colors::LIGHT, export::Paper::default());
        assert!(svg.contains("dry ±U") && export::png(&svg, 1.0).is_ok());
    });
}

#[test]
fn curves_of_a_file_are_drawn_in_their_bands() {
    let set = camera(true);
    with(vec![set], |scene| {
        let item = ImportItem::Set(scene.document.own[0].name.clone());
        let shown = ImportSelection::of(scene, item, None, None).unwrap();
        let look = FigureLook { curves: Some(shown), ..FigureLook::default() };
        let figure = curves::KIND.figure(scene, &look, FigureRoom::default()).unwrap();
        let bands = marks(&figure, "±U");
        assert_eq!(bands.len(), 3);
        let Shape::Polygon { points } = bands[0] else { panic!("{bands:?}") };
        let [upper, lower] = [points[20], points[2 * SAMPLES - 1 - 20]];
        assert!((upper[1] - lower[1] - 0.04).abs() < 1e-12, "2 k u");
        assert!(figure.caption.ends_with("Band: ±U, k = 2."), "{}", figure.caption);
    });
}
