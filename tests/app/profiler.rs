//! Tests of measurements: their scene, their results and their descriptions.

use chromascope::action::{Action, RenderAction};
use chromascope::catalog::Catalog;
use chromascope::command::Command;
use chromascope::document::Document;
use chromascope::document::render::{MeshChoice, RenderSettings};
use chromascope::jobs::{Executor, Job as _, Later};
use chromascope::profiler::plans::PlansQuery;
use chromascope::profiler::{Profiler, SceneRunJob};
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::workspaces::PaneKind;
use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::reflectance::Normalization;
use chromascope_core::render::QualityLevel;
use chromascope_core::render::RasterSize;
use egui_kittest::kittest::Queryable;

use crate::screenshots::{accuracy, driven, open};

/// Measurement job of the default cameras on a small picture of a sphere.
fn small(change: impl FnOnce(&mut Document)) -> SceneRunJob {
    let mut document = Document::paper();
    (document.render.mesh, document.render.triangles) = (MeshChoice::Sphere, 2000);
    change(&mut document);
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let mut run = SceneRunJob::of(&Scene { document: &document, catalog: &catalog, results: &results }, None, None);
    let pictures = run.pictures.as_mut().expect("there is a mesh");
    pictures.shading.geometry.visibility.size = RasterSize { width: 64, height: 48, samples: 1 };
    run
}

#[test]
fn a_second_run_measures_computing_and_not_remembering() {
    let scene = small(|document| document.render.normalization = Normalization::Lambertian);
    let results = Results::default();
    let runs = [1, 2].map(|_| scene.run(&results));
    assert!(runs.iter().all(|run| !run.trials.is_empty()));
    assert!(results.counts().is_empty(), "nothing is remembered: {:?}", results.counts());
}

#[test]
fn plans_are_of_the_sources_that_are_asked_for() {
    let with = |sources: &[usize]| {
        let run =
            small(|document| (document.render.quality, document.render.tolerance) = (QualityLevel::Tolerance, 1e-3));
        let mut pictures = run.pictures.expect("there is a mesh");
        pictures.sources = sources.iter().map(|&source| pictures.sources[source].clone()).collect();
        pictures
    };
    let (all, fewer, more) = (with(&[0, 1, 2]), with(&[2, 1]), with(&[2, 3]));
    let later = Later::on(&Executor::driven(), || ());
    let planned = |pictures: &PicturesQuery| PlansQuery::ask(&later, pictures, true);
    assert!(planned(&all).is_none());
    later.wait();
    let plans = planned(&all).expect("made");
    assert!(plans.iter().all(|plan| matches!(plan, Ok(Some(_)))), "{plans:?}");
    let two = planned(&fewer).expect("known from before");
    assert_eq!(two, [plans[2].clone(), plans[1].clone()]);
    later.wait();
    assert!(planned(&more).is_none_or(|plans| plans.len() == 2), "none under a wrong name");
    later.wait();
    assert_eq!(planned(&more).expect("made")[0], plans[2]);
}

#[test]
fn what_is_measured_is_of_the_scene_that_it_was_measured_on() {
    let (executor, mut window) = driven([1280.0, 800.0], egui::Theme::Dark);
    // Without spectral integrals there is little to measure.
    let flat =
        |settings: &RenderSettings| RenderSettings { normalization: Normalization::Lambertian, ..settings.clone() };
    let to = Box::new(flat(&window.state().history.document().render));
    window.state_mut().push(Action::Render(RenderAction::Set { what: "Normalization", to }));
    window.state_mut().push(Command::MeasureScene);
    window.run_steps(2);
    window.state().later.wait();
    window.run_steps(3);
    let is_current = |window: &egui_kittest::Harness<'static, chromascope::app::ChromascopeApp>| {
        assert!(window.state().profiler.measured.run.is_some());
        window.state().profiler.measured.is_current
    };
    assert!(is_current(&window));
    let to = RenderSettings { sky: 0.3, ..window.state().history.document().render.clone() };
    window.state_mut().push(Action::Render(RenderAction::Set { what: "Sky", to: Box::new(to) }));
    window.run_steps(2);
    window.state_mut().push(Command::MeasureScene);
    window.run_steps(1);
    assert!(Profiler::busy(&window.state().later).is_some());
    window.state_mut().push(Command::StopMeasuring);
    window.run_steps(1);
    executor.run_all();
    window.run_steps(2);
    assert!(!is_current(&window), "of another sky than the one on show, though that was asked for");
    window.state_mut().push(Command::Undo);
    window.run_steps(3);
    assert!(is_current(&window), "the scene is again the one that was measured");
}

#[test]
fn one_button_measures() {
    let window = accuracy([1280.0, 800.0], egui::Theme::Light);
    assert_eq!(window.query_all_by_label("Run again").count(), 1, "one Run");
    let mut window = open([1280.0, 800.0], egui::Theme::Light);
    window.state_mut().view.show(PaneKind::METHODS);
    window.run_steps(3);
    assert_eq!(window.query_all_by_label("Run").count(), 1, "one Run before anything is measured");
}
