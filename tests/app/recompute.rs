//! Only what changed is computed: runs counted per question, for what a user does.

use std::collections::BTreeMap;

use chromascope::action::{Action, CompareAction, SceneAction};
use chromascope::catalog::{Catalog, Kind};
use chromascope::document::{Document, Light};
use chromascope::results::Results;
use chromascope::scene::Scene;

/// A document with its answers, asked for as the window does.
struct Desk {
    document: Document,
    catalog: Catalog,
    results: Results,
}

impl Desk {
    fn new() -> Self {
        let desk = Self { document: Document::default(), catalog: Catalog::built_in(), results: Results::default() };
        desk.look();
        desk
    }

    /// Asks for all that the first screen shows.
    fn look(&self) {
        let scene = Scene { document: &self.document, catalog: &self.catalog, results: &self.results };
        for source in scene.sources().iter().filter(|source| source.visible) {
            let _locus = scene.locus(source.kind, &source.name);
            let _mark = scene.locus_mark(source.kind, &source.name);
            let _colors = scene.patch_colors(source.kind, &source.name);
        }
        self.results.end_frame();
    }

    /// What is computed when this is done, by kind of question; what is not computed is not named.
    fn computed(&mut self, action: &Action) -> BTreeMap<&'static str, u64> {
        let before = self.results.counts();
        action.apply(&mut self.document);
        self.look();
        let misses = |name: &str| before.get(name).map_or(0, |count| count.misses);
        let after = self.results.counts();
        after.iter().map(|(name, count)| (*name, count.misses - misses(name))).filter(|(_, runs)| *runs > 0).collect()
    }
}

fn compare(action: CompareAction) -> Action {
    Action::Compare(action)
}

#[test]
fn a_name_computes_nothing() {
    let mut desk = Desk::new();
    let action = CompareAction::Rename(Kind::Camera, "Nikon D70".to_owned(), "my camera".to_owned());
    assert!(desk.computed(&compare(action)).is_empty());
}

#[test]
fn hiding_and_taking_off_compute_nothing() {
    let mut desk = Desk::new();
    let hide = CompareAction::SetVisible(Kind::Camera, "Nikon D70".to_owned(), false);
    assert!(desk.computed(&compare(hide)).is_empty());
    let show = CompareAction::SetVisible(Kind::Camera, "Nikon D70".to_owned(), true);
    assert!(desk.computed(&compare(show)).is_empty(), "it was remembered");
    let remove = CompareAction::Remove(Kind::Camera, "Kodak DCS200".to_owned());
    assert!(desk.computed(&compare(remove)).is_empty());
}

#[test]
fn a_new_camera_computes_only_itself() {
    let mut desk = Desk::new();
    let runs = desk.computed(&compare(CompareAction::Add(Kind::Camera, "Nikon D850".to_owned())));
    assert_eq!(runs.get("sensor"), Some(&1));
    assert_eq!(runs.get("data file"), Some(&1));
    assert_eq!(runs.get("patch colors"), Some(&1));
    assert_eq!(runs.get("radiator signals"), Some(&2), "the locus and its mark");
    assert!(!runs.contains_key("patches") && !runs.contains_key("light"), "{runs:?}");
}

#[test]
fn a_temperature_that_only_marks_computes_only_marks() {
    let mut desk = Desk::new();
    let runs = desk.computed(&Action::Scene(SceneAction::SetTemperature(4321.0)));
    assert_eq!(runs.get("radiator signals"), Some(&5), "a mark on each of five loci");
    assert_eq!(runs.get("locus"), Some(&5));
    assert_eq!(runs.len(), 2, "{runs:?}");
    let back = desk.computed(&Action::Scene(SceneAction::SetTemperature(5500.0)));
    assert!(back.is_empty(), "it was remembered");
}

#[test]
fn a_temperature_of_the_light_leaves_the_loci_signals_alone() {
    let mut desk = Desk::new();
    desk.computed(&Action::Scene(SceneAction::SetLight(Light::BlackBody)));
    let runs = desk.computed(&Action::Scene(SceneAction::SetTemperature(3200.0)));
    assert_eq!(runs.get("light"), Some(&1));
    assert_eq!(runs.get("rendering"), Some(&5));
    assert_eq!(runs.get("patch colors"), Some(&5));
    assert_eq!(runs.get("radiator signals"), Some(&5), "the marks, not the loci: {runs:?}");
    assert!(
        !runs.contains_key("sensor") && !runs.contains_key("data file") && !runs.contains_key("patches"),
        "{runs:?}"
    );
}

#[test]
fn nothing_asked_is_nothing_computed_and_nothing_read() {
    let results = Results::default();
    let _catalog = Catalog::built_in();
    results.end_frame();
    assert!(results.counts().is_empty());
}

#[test]
fn the_first_screen_reads_only_what_it_shows() {
    let desk = Desk::new();
    let counts = desk.results.counts();
    // Five sensors, the chart, the light.
    assert_eq!(counts["data file"].misses, 7, "{counts:?}");
}
