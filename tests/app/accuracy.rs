//! Tests of the Numerics workspace: the visible scene is measured, and only on request.

use std::sync::Arc;

use chromascope::action::{Action, CompareAction, RenderAction};

use chromascope::command::Command;
use chromascope::document::SetKind;
use chromascope::document::render::RenderSettings;
use chromascope::panes;
use chromascope::profiler::{Profiler, SceneRun, Subject};
use chromascope::scene::Scene;
use chromascope::view::Shows;
use chromascope::workspaces::PaneKind;
use chromascope_core::accuracy::RelTolerance;
use chromascope_core::reflectance::Normalization;
use chromascope_core::render::QualityLevel;
use chromascope_figure::{FigureRoom, Ink, InkRole, Shape};
use chromascope_measure::Workload;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

use crate::screenshots::{accuracy, driven, open};

type Window = Harness<'static, chromascope::app::ChromascopeApp>;

/// The window in Numerics, with the scene as it starts measured.
fn measured() -> Window {
    let mut window = open([1280.0, 800.0], egui::Theme::Dark);
    window.state_mut().view.show(PaneKind::METHODS);
    window.run_steps(2);
    window.get_all_by_label("Run").last().expect("there is a way to measure").click();
    window.run_steps(2);
    take_in(&mut window);
    window
}

fn take_in(window: &mut Window) {
    window.state().later.wait();
    window.run_steps(3);
}

fn run(window: &Window) -> std::sync::Arc<SceneRun> {
    window.state().profiler.measured.run.clone().expect("something was measured")
}

#[test]
fn nothing_is_measured_unasked() {
    let mut window = open([1280.0, 800.0], egui::Theme::Light);
    window.state_mut().view.show(PaneKind::METHODS);
    window.run_steps(3);
    assert!(Profiler::busy(&window.state().later).is_none());
    assert!(window.state().profiler.measured.run.is_none());
    assert!(window.query_by_label("Nothing measured yet.").is_some());
}

#[test]
fn a_run_has_times_errors_and_figures() {
    let mut window = measured();
    let measured = run(&window);
    for subject in Subject::ALL {
        let trial = measured.trials.iter().find(|trial| trial.subject == subject).expect("both subjects");
        assert_eq!((trial.points[0].max, trial.points[0].rms), (0.0, 0.0), "the reference");
        assert!(trial.points.len() >= 6);
        for point in &trial.points {
            assert!(point.seconds >= 0.0 && point.seconds.is_finite(), "{point:?}");
            assert!(point.rms <= point.max && point.max.is_finite(), "{point:?}");
            assert!(point.error_bound.is_none_or(|error_bound| point.max <= error_bound.max(2e-14)), "{point:?}");
        }
    }
    assert!(window.query_by_label("Run again").is_some());
    assert!(window.state().profiler.measured.is_current);
    let (catalog, results) = (chromascope::catalog::Catalog::built_in(), chromascope::results::Results::default());
    let scene = Scene { document: window.state().history.document(), catalog: &catalog, results: &results };
    let figure = panes::figure(
        PaneKind::METHODS,
        &scene,
        &window.state().look(PaneKind::METHODS, &scene),
        FigureRoom::default(),
    )
    .expect("measured");
    let (conditions, csv) = (&measured.conditions, figure.table.to_csv());
    assert!(figure.table.rows.len() >= 6);
    let paper = chromascope::export::Paper::default();
    let svg = chromascope::export::svg(&figure, &chromascope::palette::Colors::LIGHT, paper);
    assert!(svg.contains("</svg>") && !svg.contains("NaN") && !csv.contains("NaN"));
    let scene = &conditions.scene;
    assert!(scene.starts_with("head, Skin Caucasian mean") && scene.contains("under Direct sun"), "{scene}");
    for part in [&conditions.scene, &conditions.machine, &conditions.program, &conditions.began] {
        assert!(!part.is_empty() && figure.caption.contains(part), "{}", figure.caption);
        assert!(csv.contains(part), "{part}");
    }
    assert!(csv.contains("largest error (of the peak J(κ, 0))") && csv.contains(" (reference)"), "{csv}");
    let to = RenderSettings { sky: 0.3, ..window.state().history.document().render.clone() };
    window.state_mut().push(Action::Render(RenderAction::Set { what: "Sky", to: Box::new(to) }));
    window.run_steps(3);
    assert!(!window.state().profiler.measured.is_current, "the scene has another sky than the run");
    let scene = Scene { document: window.state().history.document(), catalog: &catalog, results: &results };
    let figure = panes::figure(
        PaneKind::METHODS,
        &scene,
        &window.state().look(PaneKind::METHODS, &scene),
        FigureRoom::default(),
    )
    .expect("measured");
    assert!(!figure.title.contains("on show") && !figure.caption.contains("on show"), "{}", figure.caption);
    assert!(figure.caption.contains("under Direct sun"), "the light that it was measured under");
    assert!(window.state().profiler.measured.run.is_some());
}

#[test]
fn methods_say_what_was_measured_and_what_marks_stand_for() {
    for size in [[900.0, 600.0], [1280.0, 800.0]] {
        let window = accuracy(size, egui::Theme::Light);
        for words in ["sum over the grid", "a quality of the program", "fastest for a tolerance", "What is this?"] {
            let rect = window.get_by_label(words).rect();
            assert!(rect.left() >= 0.0 && rect.right() <= size[0], "{words} at {size:?}: {rect:?}");
        }
        assert!(window.query_by_label(&run(&window).conditions.scene).is_some());
        let trial = run(&window).trials[0].clone();
        assert_eq!(trial.name(0), "401 wavelengths, S to 1e-13 (reference)");
        assert_eq!(trial.set.map(|set| trial.name(set)).as_deref(), Some("Full: moments, table (set)"));
        let panel = chromascope::figures::accuracy::panel(&trial, true, [600.0, 400.0]);
        assert!(panel.marks.iter().any(|mark| mark.name.ends_with(" (set)")));
        let of_a_camera = |ink: Ink| matches!(ink.role, InkRole::Sensor(_) | InkRole::Reference | InkRole::Observer);
        let inks =
            panel.marks.iter().flat_map(|mark| mark.stroke.map(|stroke| stroke.ink).into_iter().chain(mark.fill));
        assert!(inks.into_iter().all(|ink| !of_a_camera(ink)), "no method looks like a camera");
    }
}

#[test]
fn a_hidden_camera_is_told_of() {
    let mut window = open([1280.0, 800.0], egui::Theme::Dark);
    let mut settings = window.state().history.document().render.clone();
    (settings.quality, settings.tolerance) = (QualityLevel::Tolerance, 5e-10);
    window.state_mut().push(Action::Render(RenderAction::Set { what: "Quality", to: Box::new(settings) }));
    let hide = CompareAction::SetVisible(SetKind::Camera, "Nikon D70 (2007 figure)".to_owned(), false);
    window.state_mut().push(Action::Compare(hide));
    window.run_steps(2);
    window.state_mut().push(Command::MeasureScene);
    window.run_steps(2);
    assert!(window.state().view.numerics, "what is measured is shown");
    take_in(&mut window);
    let run = run(&window);
    let trial = &run.trials[0];
    let set = trial.name(trial.set.expect("the tolerance that is set is tried too"));
    assert!(set.starts_with("within ") && set.ends_with("5e-10 (set)"), "{set}");
}

#[test]
fn a_tolerance_is_kept_by_pictures_and_each_source_says_how() {
    let mut window = open([1280.0, 800.0], egui::Theme::Light);
    window.state_mut().view.show(PaneKind::METHODS);
    window.run_steps(2);
    let render = |window: &Window| window.state().history.document().render.clone();
    assert_eq!(render(&window).quality, QualityLevel::Full);
    window.get_by_label("Apply to renders").click();
    window.run_steps(2);
    assert_eq!((render(&window).quality, render(&window).tolerance), (QualityLevel::Tolerance, 1e-6));
    take_in(&mut window);
    assert_eq!(
        window.query_all_by_label_contains("Diffuse component: estimated error bound").count(),
        4,
        "one for each source"
    );
    window.state_mut().view.show(PaneKind::RENDER);
    window.run_steps(2);
    window.state().render_service.wait();
    window.run_steps(3);
    let shot = window.state().render_service.frame().cloned().expect("pictures");
    assert_eq!(
        shot.query.mesh().unwrap().shading.quality.given_tolerance().map(RelTolerance::max_relative_error),
        Some(1e-6)
    );
    assert!(shot.made().is_some_and(|made| made.mesh().unwrap().shading.spectral > 1000));
    window.state_mut().push(Command::Undo);
    window.run_steps(2);
    assert_eq!(render(&window).quality, QualityLevel::Full);
    assert!(window.state().view.status.text.starts_with("Undone: "), "{}", window.state().view.status.text);
}

#[test]
fn a_source_without_a_plan_says_why() {
    let mut window = open([1280.0, 1000.0], egui::Theme::Light);
    window.state_mut().view.show(PaneKind::METHODS);
    let flat =
        RenderSettings { normalization: Normalization::Lambertian, ..window.state().history.document().render.clone() };
    window.state_mut().push(Action::Render(RenderAction::Set { what: "Normalization", to: Box::new(flat) }));
    window.run_steps(2);
    take_in(&mut window);
    assert_eq!(window.query_all_by_label_contains("No sample takes a spectral integral.").count(), 4);
    window
        .state_mut()
        .push(Action::Compare(CompareAction::SetReference { name: "CIE 1931 2°".to_owned(), counts_in_xyz: true }));
    window.run_steps(3);
    take_in(&mut window);
    assert!(window.query_all_by_label_contains("No picture beside this reference: a CIE observer").count() >= 3);
}

#[test]
fn a_typed_tolerance_is_taken_as_it_is_and_ticks_nothing() {
    let mut window = open([1280.0, 1000.0], egui::Theme::Light);
    window.state_mut().view.show(PaneKind::METHODS);
    window.run_steps(3);
    let render = |window: &Window| window.state().history.document().render.clone();
    for (typed, taken, shown) in [
        ("5e-10", 5e-10, "5e−10"),
        ("2.5e−4", 2.5e-4, "2.5e−4"),
        ("0.1", 0.1, "1e−1"),
        ("1.5E-4", 1.5e-4, "1.5e−4"),
        (" 1e−6 ", 1e-6, "1e−6"),
    ] {
        type_tolerance(&mut window, typed, egui::Key::Enter);
        assert_eq!((render(&window).tolerance, render(&window).quality), (taken, QualityLevel::Full));
        let text = window.get_by_role_and_label(Role::TextInput, "Tolerance").value();
        assert_eq!(text.as_deref(), Some(shown));
    }
}

/// Types into a field and leaves it with a key.
fn type_tolerance(window: &mut Window, text: &str, key: egui::Key) {
    const FIELD: (Role, &str) = (Role::TextInput, "Tolerance");
    window.get_by_role_and_label(FIELD.0, FIELD.1).focus();
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(1);
    window.get_by_role_and_label(FIELD.0, FIELD.1).type_text(text);
    window.run_steps(2);
    window.key_press(key);
    window.run_steps(2);
}

#[test]
fn a_tolerance_is_refused_with_a_reason() {
    let mut window = open([1280.0, 1000.0], egui::Theme::Light);
    window.state_mut().view.show(PaneKind::METHODS);
    window.run_steps(3);
    for (typed, words) in [
        (" ", "Enter a number"),
        ("10 %", "“10 %” is not a number"),
        ("nan", "is not a number"),
        ("inf", "too large"),
        ("0.5", "too large: range 1e−13 to 0.1"),
        ("7", "too large: range 1e−13 to 0.1"),
        ("1e-14", "too small: range 1e−13 to 0.1; S itself is accurate to 1e−13"),
        ("1,5e-4", "“1,5e-4” is not a number"),
        ("0.1%", "“0.1%” is not a number"),
        ("abc", "“abc” is not a number"),
        ("-1", "above 0; range 1e−13 to 0.1"),
        ("0", "above 0"),
        ("−3", "above 0"),
    ] {
        type_tolerance(&mut window, typed, egui::Key::Enter);
        assert_eq!(window.state().history.document().render.tolerance, 1e-6, "{typed}");
        assert!(window.query_by_label_contains(words).is_some(), "nothing is said of {typed}");
    }
}

#[test]
fn a_tolerance_that_cannot_be_is_refused_beside_its_field() {
    for pane in [PaneKind::METHODS, PaneKind::RENDER] {
        let mut window = open([1280.0, 1000.0], egui::Theme::Light);
        let mut settings = window.state().history.document().render.clone();
        settings.quality = QualityLevel::Tolerance;
        window.state_mut().push(Action::Render(RenderAction::Set { what: "Quality", to: Box::new(settings) }));
        window.state_mut().view.show(pane);
        window.run_steps(3);
        let tolerance = |window: &Window| window.state().history.document().render.tolerance;
        let text = |window: &Window| window.get_by_role_and_label(Role::TextInput, "Tolerance").value();
        for (typed, words) in [
            ("a bit", "“a bit” is not a number"),
            ("1e-14", "too small: range 1e−13 to 0.1"),
            ("7", "too large: range 1e−13 to 0.1"),
        ] {
            type_tolerance(&mut window, typed, egui::Key::Enter);
            assert_eq!(tolerance(&window), 1e-6);
            assert!(window.query_by_label_contains(words).is_some(), "{pane:?} says nothing of {typed}");
            assert_eq!(text(&window).as_deref(), Some(typed), "what was typed stays");
        }
        type_tolerance(&mut window, "x", egui::Key::Escape);
        assert!(window.query_by_label_contains("too large").is_none());
        assert_eq!((tolerance(&window), text(&window).as_deref()), (1e-6, Some("1e−6")));
        type_tolerance(&mut window, "1e-9", egui::Key::Enter);
        assert_eq!((tolerance(&window), text(&window).as_deref()), (1e-9, Some("1e−9")));
    }
}

#[test]
fn escape_stops_measuring() {
    let (executor, mut window) = driven([1280.0, 800.0], egui::Theme::Dark);
    window.state_mut().push(Command::MeasureScene);
    window.run_steps(1);
    assert!(Profiler::busy(&window.state().later).is_some());
    window.key_press(egui::Key::Escape);
    window.run_steps(2);
    assert!(Profiler::busy(&window.state().later).is_none());
    executor.run_all();
    window.run_steps(2);
    assert!(window.state().profiler.measured.run.is_none());
}

#[test]
fn a_report_of_the_bench_is_shown_and_exported() {
    let report = crate::bench::report();
    let mut window = open([1280.0, 800.0], egui::Theme::Light);
    let view = &mut window.state_mut().view;
    view.show(PaneKind::METHODS);
    view.shows = Shows::Bench(Workload::DiffuseSum);
    let measured = &mut window.state_mut().profiler.measured;
    measured.reports.insert(Workload::DiffuseSum, Arc::new(Ok(report.clone())));
    window.run_steps(3);
    assert!(window.query_by_label("Nothing measured yet. A quick run takes a few seconds.").is_none());
    assert_eq!(window.query_by_label("Run again").is_some(), cfg!(feature = "bench"));
    let (catalog, results) = (chromascope::catalog::Catalog::built_in(), chromascope::results::Results::default());
    let scene = Scene { document: window.state().history.document(), catalog: &catalog, results: &results };
    let figure = panes::figure(
        PaneKind::METHODS,
        &scene,
        &window.state().look(PaneKind::METHODS, &scene),
        FigureRoom::default(),
    )
    .expect("measured");
    assert_eq!(figure.table.rows.len(), report.measurements.len());
    // Each method's mark says which measurement it is.
    for panel in &figure.panels {
        for mark in panel.marks.iter().filter(|mark| matches!(mark.shape, Shape::Points { .. })) {
            let measurement = &report.measurements[mark.tag.0 as usize - 1];
            assert_eq!((&mark.name, &panel.name), (&measurement.method, &measurement.case));
        }
    }
}

#[test]
fn without_the_benchmark_its_place_says_how_to_get_it() {
    let mut window = open([900.0, 600.0], egui::Theme::Light);
    window.state_mut().view.show(PaneKind::METHODS);
    window.state_mut().view.shows = Shows::Bench(Workload::DiffuseSum);
    window.run_steps(3);
    let offered = window.query_by_label("Nothing measured yet. A quick run takes some seconds.").is_some();
    let told = window.query_by_label(chromascope::profiler::BUILD).is_some();
    assert_eq!((offered, told), (cfg!(feature = "bench"), cfg!(not(feature = "bench"))));
    // The scene can be measured in either build.
    window.state_mut().view.shows = Shows::Scene(Subject::Loci);
    window.run_steps(3);
    assert!(window.query_all_by_label("Run").next().is_some());
}
