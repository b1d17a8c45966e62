//! Only what changed is computed: runs counted per query, for what a user does.

use std::collections::BTreeMap;

use chromascope::action::{Action, CompareAction, SceneAction};
use chromascope::catalog::Catalog;
use chromascope::document::render::MeshChoice;
use chromascope::document::{Document, Light, SetKind, WhiteBalanceChoice};
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::scene::orbit::Orbit;
use chromascope::scene::render::Finish;
use chromascope_core::colorimetry::Metric;
use chromascope_core::query::Ask;
use chromascope_core::render::{RasterSize, Shadows};

/// A document with its answers, requested as the window does.
struct Fixture {
    document: Document,
    catalog: Catalog,
    results: Results,
}

impl Fixture {
    fn new() -> Self {
        let fixture = Self { document: Document::paper(), catalog: Catalog::built_in(), results: Results::default() };
        fixture.look();
        fixture
    }

    /// Requests everything that the first screen shows.
    fn look(&self) {
        let scene = Scene { document: &self.document, catalog: &self.catalog, results: &self.results };
        for source in scene.sources().iter().filter(|source| source.visible) {
            let _locus = scene.locus(source.kind, &source.name);
            let _mark = scene.locus_mark(source.kind, &source.name);
            let _colors = scene.patch_colors(source.kind, &source.name);
        }
        self.results.end_frame();
    }

    /// Counts of the queries that the action computes, by kind; kinds without computations are omitted.
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
    let mut fixture = Fixture::new();
    let action = CompareAction::Rename(SetKind::Camera, "Nikon D70 (2007 figure)".to_owned(), "my camera".to_owned());
    assert!(fixture.computed(&compare(action)).is_empty());
}

#[test]
fn hiding_and_taking_off_compute_nothing() {
    let mut fixture = Fixture::new();
    let hide = CompareAction::SetVisible(SetKind::Camera, "Nikon D70 (2007 figure)".to_owned(), false);
    assert!(fixture.computed(&compare(hide)).is_empty());
    let show = CompareAction::SetVisible(SetKind::Camera, "Nikon D70 (2007 figure)".to_owned(), true);
    assert!(fixture.computed(&compare(show)).is_empty(), "it was remembered");
    let remove = CompareAction::Remove(SetKind::Camera, "Kodak DCS200".to_owned());
    assert!(fixture.computed(&compare(remove)).is_empty());
}

#[test]
fn a_new_camera_computes_only_itself() {
    let mut fixture = Fixture::new();
    let runs = fixture.computed(&compare(CompareAction::Add(SetKind::Camera, "Nikon D850".to_owned())));
    assert_eq!(runs.get("sensor"), Some(&1));
    assert_eq!(runs.get("data file"), Some(&1));
    assert_eq!(runs.get("patch colors"), Some(&1));
    assert_eq!(runs.get("radiator signals"), Some(&2), "the locus and its mark");
    assert!(!runs.contains_key("patches") && !runs.contains_key("light"), "{runs:?}");
}

#[test]
fn a_temperature_that_only_marks_computes_only_marks() {
    let mut fixture = Fixture::new();
    let runs = fixture.computed(&Action::Scene(SceneAction::SetTemperature(4321.0)));
    assert_eq!(runs.get("radiator signals"), Some(&5), "a mark on each of five loci");
    assert_eq!(runs.get("locus"), Some(&5));
    assert_eq!(runs.len(), 2, "{runs:?}");
    let back = fixture.computed(&Action::Scene(SceneAction::SetTemperature(5500.0)));
    assert!(back.is_empty(), "it was remembered");
}

#[test]
fn a_temperature_of_the_light_leaves_the_loci_signals_alone() {
    let mut fixture = Fixture::new();
    fixture.computed(&Action::Scene(SceneAction::SetLight(Light::BlackBody)));
    let runs = fixture.computed(&Action::Scene(SceneAction::SetTemperature(3200.0)));
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
    let fixture = Fixture::new();
    let counts = fixture.results.counts();
    // Five sensors, the chart, the light.
    assert_eq!(counts["data file"].misses, 7, "{counts:?}");
}

/// The pictures of the Render pane, requested as its worker does.
struct Pictures {
    fixture: Fixture,
    worker: Results,
    orbit: Orbit,
}

impl Pictures {
    fn new() -> Self {
        let mut pictures = Self { fixture: Fixture::new(), worker: Results::default(), orbit: Orbit::default() };
        pictures.fixture.document.render.triangles = 2000;
        // Smoother than what the closed form holds for, so that tables are needed.
        pictures.fixture.document.render.sigma_um = 0.3;
        // Under the scene bar's light.
        pictures.fixture.document.render.sunlight = false;
        pictures.fixture.document.render.sky = 0.0;
        pictures.look();
        pictures
    }

    fn look(&self) {
        let fixture = &self.fixture;
        let scene = Scene { document: &fixture.document, catalog: &fixture.catalog, results: &fixture.results };
        let finish = Finish {
            size: RasterSize { width: 64, height: 48, samples: 1 },
            quality: fixture.document.render.quality(),
            shadows: Shadows::Full,
            compared_samples: Some(500),
            open_sky: false,
        };
        let viewpoint = self.orbit.viewpoint(4.0 / 3.0).unwrap();
        let mesh = scene.mesh_of(None).unwrap();
        let pictures = scene.pictures_of(&scene.rendered_sources(), mesh, viewpoint, finish, None).unwrap();
        assert!(matches!(&*self.worker.ask(&pictures), Ok(Some(_))));
    }

    /// Counts of the queries computed after a change, in alphabetical order.
    fn computed(&mut self, change: impl FnOnce(&mut Self)) -> Vec<(&'static str, u64)> {
        let before = self.worker.counts();
        change(self);
        self.look();
        let misses = |name: &str| before.get(name).map_or(0, |count| count.misses);
        let after = self.worker.counts();
        after.iter().map(|(name, count)| (*name, count.misses - misses(name))).filter(|(_, runs)| *runs > 0).collect()
    }

    fn done(&mut self, action: &Action) -> Vec<(&'static str, u64)> {
        self.computed(|pictures| {
            action.apply(&mut pictures.fixture.document);
        })
    }
}

/// Name, user action, and the queries it computes.
type Case = (&'static str, Action, &'static [(&'static str, u64)]);

#[test]
fn a_picture_computes_only_what_an_action_changes() {
    // The reference and three cameras; CIE 1931 has no picture beside a truth of other primaries.
    let cases: [Case; 7] = [
        (
            "a name",
            compare(CompareAction::Rename(SetKind::Camera, "Nikon D70 (2007 figure)".to_owned(), "mine".to_owned())),
            // Nothing: the query is the same.
            &[],
        ),
        ("a measure of difference", Action::Scene(SceneAction::SetDifference(Metric::XY)), &[]),
        ("a temperature that only marks", Action::Scene(SceneAction::SetTemperature(4000.0)), &[]),
        (
            "a camera ticked off",
            compare(CompareAction::SetVisible(SetKind::Camera, "Nikon D70 (2007 figure)".to_owned(), false)),
            // The others are put side by side, no more.
            &[("pictures", 1)],
        ),
        (
            "ticked on again",
            compare(CompareAction::SetVisible(SetKind::Camera, "Nikon D70 (2007 figure)".to_owned(), true)),
            &[],
        ),
        (
            "another camera",
            compare(CompareAction::Add(SetKind::Camera, "Nikon D850".to_owned())),
            &[
                ("camera image", 1),
                ("difference", 1),
                ("measure", 1),
                ("picture", 1),
                ("pictures", 1),
                ("rendering", 1),
            ],
        ),
        (
            "a white",
            Action::Scene(SceneAction::SetWhite(WhiteBalanceChoice::Light("D55".to_owned()))),
            // Signals are before the balance.
            &[("difference", 4), ("exposure", 1), ("picture", 5), ("pictures", 1), ("rendering", 5)],
        ),
    ];
    let mut pictures = Pictures::new();
    for (what, action, expected) in cases {
        assert_eq!(pictures.done(&action), expected, "{what}");
    }
}

#[test]
fn a_surface_a_light_and_a_view_compute_only_what_follows_them() {
    let mut pictures = Pictures::new();
    let mut set = |change: fn(&mut Pictures)| pictures.computed(change);
    let developed = [("picture", 4), ("pictures", 1)];
    assert_eq!(set(|p| p.fixture.document.render.exposure_ev = 1.0), developed, "exposure: the last stage alone");
    let signals = [("camera image", 4), ("difference", 3), ("exposure", 1), ("picture", 4), ("pictures", 1)];
    let with = |more: &[(&'static str, u64)]| {
        let mut all: Vec<(&str, u64)> = signals.iter().chain(more).copied().collect();
        all.sort_unstable();
        all
    };
    assert_eq!(set(|p| p.fixture.document.render.sigma_um = 0.2), with(&[("shading", 1)]), "roughness: no plan anew");
    let material = set(|p| p.fixture.document.render.material = "Fern-like bush leaf 024 (Vrhel)".to_owned());
    // Exposure weighs wavelengths again for the material, and for a white.
    assert_eq!(material, with(&[("measure", 5)]), "a material: no angles");
    let light = set(|p| p.fixture.document.light = Light::Set("A".to_owned()));
    assert_eq!(light, with(&[("measure", 6), ("rendering", 4)]), "a spectrum: no angles");
    let without_exposure = |more: &[(&'static str, u64)]| -> Vec<(&str, u64)> {
        with(more).into_iter().filter(|(name, _)| *name != "exposure").collect()
    };
    let place = set(|p| p.fixture.document.render.light_up_deg += 10.0);
    assert_eq!(place, without_exposure(&[("geometry", 1), ("shading", 1)]), "the light's place: nothing seen anew");
    let orbit = set(|p| p.orbit = p.orbit.turned(10.0, 0.0));
    let seen = [("geometry", 1), ("shading", 1), ("visibility", 1)];
    assert_eq!(orbit, without_exposure(&seen), "a view: no mesh, no tree, no plan");
    let mesh = set(|p| p.fixture.document.render.mesh = MeshChoice::Sphere);
    let made = [("geometry", 1), ("mesh", 1), ("shading", 1), ("shadow tree", 1), ("visibility", 1)];
    assert_eq!(mesh, without_exposure(&made), "a mesh: no table");
}
