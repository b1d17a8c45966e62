//! A camera is one data file: a catalog with one more has it everywhere, without any other change.

use chromascope::catalog::{BuiltInFile, Catalog};
use chromascope::cli;
use chromascope::document::{Document, SetKind};
use chromascope::results::Results;
use chromascope::scene::Scene;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

use crate::screenshots::open;

const NAME: &str = "One More Camera";

/// The program's data sets with the file added to `assets/cameras`.
fn catalog() -> Catalog {
    let text = include_str!("data/one_more_camera.csv");
    Catalog::built_in_with(&[BuiltInFile { path: "cameras/one_more_camera.csv", text }])
}

#[test]
fn it_is_listed_compared_and_rendered() {
    let (catalog, results) = (catalog(), Results::default());
    let cameras = |catalog: &Catalog| catalog.of_kind(SetKind::Camera).count();
    assert_eq!(cameras(&catalog), cameras(&Catalog::built_in()) + 1);
    let listed = cli::list(&catalog, Some(SetKind::Camera));
    assert!(listed.lines().any(|line| line == NAME) && cli::list(&catalog, None).contains(NAME));

    let mut document = Document::colorimetry();
    document.compare(NAME, SetKind::Camera);
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let patches = scene.patch_colors(SetKind::Camera, NAME).unwrap();
    assert_eq!(patches.len(), scene.patches().unwrap().patches().len());
    let differences = scene.differences(SetKind::Camera, NAME).unwrap();
    assert!(differences.iter().all(|difference| difference.is_ok_and(|value| value > 0.0 && value < 50.0)));
    assert!(!scene.locus(SetKind::Camera, NAME).unwrap().points.is_empty());
    assert!(scene.rendered_sources().iter().any(|source| source.name == NAME));
}

#[test]
fn the_windows_library_has_it() {
    let mut window = open([1280.0, 800.0], egui::Theme::Dark);
    window.state_mut().catalog = catalog();
    window.state_mut().view.adding = true;
    window.state_mut().view.search = NAME.to_owned();
    window.run();
    window.get_by_role_and_label(Role::CheckBox, NAME).click();
    window.run();
    assert!(window.state().compares(SetKind::Camera, NAME));
    let computed = format!("4 of {} cameras computed", catalog().of_kind(SetKind::Camera).count());
    assert!(
        window
            .query_all_by(|node| node.label().or(node.value()).is_some_and(|text| text.contains(&computed)))
            .next()
            .is_some()
    );
}
