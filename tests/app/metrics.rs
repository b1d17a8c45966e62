//! Workspace Metrics: ranking in the background, links, side by side, report card, exports.

use chromascope::action::{Action, CompareAction, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::catalog::Catalog;
use chromascope::command::Command;
use chromascope::document::Pixel;
use chromascope::document::{Document, Light, SetKind, session};
use chromascope::export;
use chromascope::figures::look::FigureLook;
use chromascope::figures::{metrics, report_card};
use chromascope::jobs::Executor;
use chromascope::palette::Colors;
use chromascope::panes::{self, metamers::ClickedPair};
use chromascope::plot_item::PlotItem;
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::scene::metrics::{CatalogMetamersQuery, CatalogMetricsQuery, RankedCameras, Ranking};
use chromascope::view::View;
use chromascope::workspaces::{Layout, PaneKind, Workspace};
use chromascope_core::query::metrics::{Contributions, UncertaintySource};
use chromascope_core::query::{Ask, CameraMetric, MetricUncertainty, MetricValue, Query as _};
use chromascope_figure::{Figure, FigureRoom, Projection, Rect, Shape, text_width};
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable};

use crate::inspector::camera;
use crate::screenshots::driven_with;

type Window = Harness<'static, ChromascopeApp>;

/// The window with the Metrics workspace, nothing ranked yet.
fn open() -> (Executor, Window) {
    let (executor, mut window) = driven_with(Document::colorimetry(), [1600.0, 1400.0], egui::Theme::Dark);
    window.state_mut().view.show(PaneKind::METRICS);
    window.run_steps(3);
    (executor, window)
}

/// The window with the Metrics workspace, all cameras ranked.
fn ranked() -> (Executor, Window) {
    let (executor, mut window) = open();
    window.state().later.wait();
    window.run_steps(3);
    (executor, window)
}

/// Rows of the table of cameras in sight, from above, with their places.
fn rows(window: &Window) -> Vec<(String, egui::Rect)> {
    let rows = window.query_all_by_role(Role::Row);
    let mut rows: Vec<_> = rows
        .map(|row| (row.accesskit_node().label().unwrap_or_default(), row.rect()))
        .filter(|(label, _)| label.contains(": rank "))
        .collect();
    rows.sort_by(|a, b| a.1.top().total_cmp(&b.1.top()));
    rows
}

fn name(row: &str) -> &str {
    row.split(": rank ").next().unwrap_or_default()
}

/// A value that ends where its uncertainty of two significant digits ends, for uncertainties from 0.01 to 10.
fn written(value: f64, uncertainty: f64) -> String {
    let decimals = if uncertainty < 0.0995 { 3 } else { 2 - usize::from(uncertainty >= 0.995) };
    format!("{value:.decimals$} ± {uncertainty:.decimals$}").replace('-', "−")
}

/// Number under a column's head in a row as it is spoken.
fn number(row: &str, column: &str) -> Option<f64> {
    let words = row.split(&format!("{column} ")).nth(1)?;
    words.split([',', ' ']).next()?.replace('−', "-").parse().ok()
}

#[test]
fn the_library_is_ranked_beside_the_window_with_progress() {
    let (executor, mut window) = open();
    let all = Catalog::built_in().of_kind(SetKind::Camera).count();
    assert_eq!(Ranking::seen(&window.state().later).progress(), Some((0, all)));
    assert!(rows(&window).iter().all(|(row, _)| number(row, "ΔE*00 mean").is_none()), "{:?}", rows(&window));
    assert!(executor.run_one("ranking"));
    window.run_steps(3);
    let (done, of) = Ranking::seen(&window.state().later).progress().expect("not all");
    assert!(0 < done && done < of && of == all, "{done} of {of}");
    window.state().later.wait();
    window.run_steps(3);
    assert_eq!(Ranking::seen(&window.state().later).progress(), None);
    let shown = rows(&window);
    assert!(shown.len() > 30 && shown.iter().all(|(row, _)| number(row, "ΔE*00 mean").is_some()), "{shown:?}");
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let document = window.state().history.document().clone();
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let metric = CameraMetric::by_id("delta-e2000-mean").unwrap();
    let value = |row: &str| {
        results.ask(&scene.camera_metrics_query(SetKind::Camera, name(row)).unwrap()).of(metric).unwrap().unwrap()
    };
    let values: Vec<f64> = shown.iter().map(|(row, _)| value(row)).collect();
    assert!(values.is_sorted(), "sorted by the first metric: {values:?}");
}

#[test]
fn values_do_not_wait_for_their_uncertainties() {
    let (executor, mut window) = open();
    while Ranking::seen(&window.state().later).progress().is_some() {
        assert!(executor.run_one("ranking"));
        window.run_steps(3);
    }
    let first = |window: &Window| rows(window)[0].0.clone();
    let row = first(&window);
    assert!(number(&row, "ΔE*00 mean").is_some() && !row.contains('±'), "{row}");
    assert!(!row.contains(": rank 1"), "no rank is claimed before: {row}");
    window.state().later.wait();
    window.run_steps(3);
    let row = first(&window);
    assert!(row.contains('±') && row.contains(": rank 1"), "{row}");
}

/// Data files that were parsed so far.
fn parsed(executor: &Executor) -> u64 {
    executor.results().counts().get("data file").map_or(0, |count| count.misses)
}

#[test]
fn the_library_is_parsed_beside_the_window() {
    let (executor, mut window) = driven_with(Document::colorimetry(), [1600.0, 1400.0], egui::Theme::Dark);
    let before = parsed(&executor);
    window.state_mut().view.show(PaneKind::METRICS);
    window.run_steps(3);
    let (shown, all) = (parsed(&executor), Catalog::built_in().of_kind(SetKind::Camera).count() as u64);
    assert!(shown - before < 8, "the window parsed {} files before it drew", shown - before);
    window.state().later.wait();
    let ranked = parsed(&executor);
    assert!(ranked - shown >= all - 8, "the worker parsed {} of {all} cameras", ranked - shown);
    window.state_mut().push(Command::Maximize(PaneKind::METAMERS));
    window.run_steps(3);
    assert_eq!(parsed(&executor), ranked, "no reflectances yet");
    window.state().later.wait();
    assert!(parsed(&executor) > ranked);
}

#[test]
fn values_are_those_that_the_scene_computes() {
    let (_executor, window) = ranked();
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let document = window.state().history.document().clone();
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let metric = CameraMetric::by_id("delta-e2000-mean").unwrap();
    for (row, _) in rows(&window).iter().take(3) {
        let value = scene.camera_figures(SetKind::Camera, name(row)).unwrap().of(metric).unwrap();
        let written = written(value.value.unwrap(), value.uncertainty.unwrap().standard);
        assert!(row.contains(&format!("ΔE*00 mean {written}")), "{written} is not in {row}");
    }
}

#[test]
fn the_latest_conditions_win_and_the_last_answer_stays_meanwhile() {
    let (executor, mut window) = ranked();
    let before = rows(&window);
    window.state_mut().push(Action::Scene(SceneAction::SetLight(Light::Set("A".to_owned()))));
    window.run_steps(3);
    assert!(executor.run_one("ranking"));
    window.run_steps(3);
    assert_eq!(rows(&window), before, "rows move only when all are done");
    window.state_mut().push(Action::Scene(SceneAction::SetLight(Light::Set("FL2".to_owned()))));
    window.run_steps(3);
    window.state().later.wait();
    window.run_steps(3);
    let after = rows(&window);
    assert_ne!(after, before);
    let results = &window.state().results;
    let scene = Scene { document: window.state().history.document(), catalog: &Catalog::built_in(), results };
    let query = scene.camera_metrics_query(SetKind::Camera, name(&after[0].0)).unwrap();
    let value = results.ask(&query).of(CameraMetric::by_id("delta-e2000-mean").unwrap()).unwrap().unwrap();
    assert!((number(&after[0].0, "ΔE*00 mean").unwrap() - value).abs() < 0.0051, "of the latest light");
}

#[test]
fn nothing_is_ranked_while_hidden() {
    let (executor, mut window) = driven_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark);
    window.run_steps(3);
    assert_eq!(Ranking::seen(&window.state().later).progress(), None);
    assert!(!executor.run_one("ranking"), "nobody looks");
    window.state_mut().view.show(PaneKind::METRICS);
    window.run_steps(3);
    assert!(Ranking::seen(&window.state().later).progress().is_some());
    window.state_mut().push(Command::Show(Workspace::Compare));
    window.run_steps(3);
    let computed =
        |window: &Window| window.state().results.counts().get("camera metrics").map_or(0, |count| count.misses);
    executor.run_all();
    let at_first = computed(&window);
    for light in ["A", "D65"] {
        window.state_mut().push(Action::Scene(SceneAction::SetLight(Light::Set(light.to_owned()))));
        window.run_steps(3);
        executor.run_all();
    }
    assert_eq!(computed(&window), at_first, "what is hidden computes nothing");
}

#[test]
fn a_row_selects_in_all_panes_and_enter_compares() {
    let (_executor, mut window) = ranked();
    let (row, at) = rows(&window).into_iter().find(|(row, _)| !row.contains("compared ✓")).expect("not compared");
    let id = camera(name(&row));
    window.hover_at(at.left_center() + egui::vec2(6.0, 0.0));
    window.run_steps(3);
    assert_eq!(window.state().view.hovered, Some(PlotItem::Sensor(id.clone())));
    window.query_all_by_role(Role::Row).find(|node| node.rect() == at).expect("row").click_accesskit();
    window.run_steps(3);
    assert_eq!(window.state().view.selected, Some(PlotItem::Sensor(id.clone())));
    window.state_mut().view.focused = Some(PaneKind::METRICS);
    window.run_steps(1);
    window.key_press(egui::Key::Enter);
    window.run_steps(3);
    assert!(window.state().compares(SetKind::Camera, &id.name), "ticked");
    window.get_by_role_and_label(Role::Button, "Remove").click();
    window.run_steps(3);
    assert!(!window.state().compares(SetKind::Camera, &id.name));
}

#[test]
fn the_compared_and_the_users_cameras_are_a_switch() {
    let (_executor, mut window) = ranked();
    let compared: Vec<String> = window
        .state()
        .history
        .document()
        .compared
        .iter()
        .filter(|c| c.kind == SetKind::Camera)
        .map(|c| c.name.clone())
        .collect();
    window.state_mut().view.saved.metrics.cameras = RankedCameras::Compared;
    window.run_steps(3);
    window.state().later.wait();
    window.run_steps(3);
    let mut shown: Vec<String> = rows(&window).iter().map(|(row, _)| name(row).to_owned()).collect();
    shown.sort();
    let mut expected = compared.clone();
    expected.sort();
    assert_eq!(shown, expected);
    window.state_mut().push(Action::Compare(CompareAction::Remove(SetKind::Camera, compared[0].clone())));
    window.run_steps(3);
    window.state().later.wait();
    window.run_steps(3);
    assert_eq!(rows(&window).len(), compared.len() - 1);
    window.state_mut().view.saved.metrics.cameras = RankedCameras::Yours;
    window.run_steps(3);
    assert!(Ranking::seen(&window.state().later).progress().is_none() && rows(&window).is_empty());
}

#[test]
fn two_cameras_stand_head_to_head() {
    let (_executor, mut window) = ranked();
    let pair = ["Nikon D70 (2007 figure)", "Kodak DCS200"].map(camera);
    window.state_mut().view.saved.metrics.pair = pair.clone().map(Some);
    window.state_mut().view.show(PaneKind::HEAD_TO_HEAD);
    window.run_steps(3);
    assert!(window.query_by_role_and_label(Role::ComboBox, "Camera A: Nikon D70 (2007 figure)").is_some());
    let said = window.query_all_by_role(Role::Row).filter_map(|row| row.accesskit_node().label());
    let row = said.into_iter().find(|row| row.starts_with("ΔE*00 mean: ")).expect("a row for each metric");
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let document = window.state().history.document().clone();
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let metric = CameraMetric::by_id("delta-e2000-mean").unwrap();
    let values = pair.map(|id| scene.camera_figures(id.kind, &id.name).unwrap().of(metric).unwrap());
    let [(a, u), (b, v)] = values.map(|value| (value.value.unwrap(), value.uncertainty.unwrap().standard));
    assert!(a < b, "{a} {b}");
    for words in [format!("A {a:.2}"), format!("B {b:.2}"), written(a - b, u.hypot(v))] {
        assert!(row.contains(&words), "{words} is not in {row}");
    }
    let better =
        if b - a > values[0].uncertainty.unwrap().coverage * u.hypot(v) { "better A," } else { "better neither," };
    assert!(row.contains(better), "{row}");
    let foot = "Locus metrics at 5500 K. ±: standard uncertainty u";
    assert!(window.query_all_by_label_contains(foot).count() > 1, "at the foot of Metrics and Head to head");
}

#[test]
fn better_is_claimed_at_95_percent() {
    let uncertainty = MetricUncertainty {
        standard: 0.1,
        contributions: Contributions::default(),
        freedom: 14.0,
        coverage: 2.5,
        source: UncertaintySource::Prior,
        is_extrapolated: true,
        bias: 0.0,
    };
    let value = |value: f64| MetricValue { value: Ok(value), uncertainty: Some(uncertainty) };
    // k u of the difference is 2.5 · 0.1 · √2 = 0.354.
    assert_eq!(metrics::differ(value(1.0), value(1.35)), Some(false));
    assert_eq!(metrics::differ(value(1.0), value(1.36)), Some(true));
    let difference = metrics::difference(value(1.0), value(1.36)).unwrap();
    assert!((difference.uncertainty.unwrap().standard - 0.02_f64.sqrt()).abs() < 1e-15);
    assert!(difference.uncertainty.unwrap().is_extrapolated);
}

#[test]
fn a_report_card_is_a_figure_like_others() {
    let (catalog, results, document) = (Catalog::built_in(), Results::default(), Document::colorimetry());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let mut view = View { selected: Some(PlotItem::Sensor(camera("Kodak DCS200"))), ..View::default() };
    let figure = panes::figure(PaneKind::REPORT_CARD, &scene, &view.look(PaneKind::REPORT_CARD), FigureRoom::default())
        .expect("a page");
    assert_eq!(figure.title, "Report card: Kodak DCS200");
    assert_eq!(figure.table.rows.len(), CameraMetric::ALL.len());
    let svg = export::svg(&figure, &Colors::LIGHT, export::Paper::default());
    let query = scene.camera_metrics_query(SetKind::Camera, "Kodak DCS200").unwrap();
    let metrics = results.ask(&query);
    let at = chromascope_core::colorimetry::Metric::ALL.iter().position(|m| *m == document.difference).unwrap();
    let patches = scene.patches().unwrap();
    for (rank, &worst) in metrics.worst[at].iter().enumerate() {
        let words = format!("{}  {}", rank + 1, patches.patches()[worst].name);
        assert!(svg.contains(&words), "{words}");
    }
    assert!(svg.contains("wavelength (nm)"), "the axis is named");
    assert!(svg.contains("ΔE*00 mean") && export::png(&svg, 1.0).is_ok());
    view.selected = Some(PlotItem::Sensor(camera("Canon EOS 5D")));
    let figure = panes::figure(PaneKind::REPORT_CARD, &scene, &view.look(PaneKind::REPORT_CARD), FigureRoom::default())
        .expect("a page");
    assert_eq!(figure.title, "Report card: Canon EOS 5D", "follows the selection");
}

/// Rectangles of the names over the bars in points, as they are drawn.
fn bar_names(page: &Figure) -> Vec<Rect> {
    let panel = page.panels.iter().find(|panel| panel.name == "patches").expect("bars");
    let scale = [0, 1].map(|axis| {
        let range = [panel.x.range, panel.y.range][axis];
        let room = if axis == 0 { panel.area.width() - Projection::LEFT } else { panel.area.height() };
        room / (range[1] - range[0])
    });
    let names = panel.marks.iter().filter_map(|mark| {
        let Shape::Text { at, text, anchor, offset, size, .. } = &mark.shape else { return None };
        let [width, height] = [text_width(text, *size), f64::from(size.points())];
        let x = at[0] * scale[0] + offset[0] - anchor.0 * width;
        let y = -at[1] * scale[1] + offset[1] - anchor.1 * height;
        Some(Rect::from_min_size([x, y], [width, height]))
    });
    names.collect()
}

#[test]
fn names_of_the_worst_patches_stand_apart_at_any_width() {
    let (catalog, results, document) = (Catalog::built_in(), Results::default(), Document::colorimetry());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    for name in ["Canon EOS 5D Mark II", "Nikon D70 (A.M.P.A.S.)", "Kodak DCS200"] {
        let id = camera(name);
        let figures = scene.camera_figures(id.kind, &id.name).expect("figures");
        for width in [300.0, 560.0, 884.0, 1264.0] {
            let page = report_card::page(&scene, &id, &figures, width);
            let names = bar_names(&page);
            // In one column labels of five bars would cross.
            assert_eq!(names.len(), if width < 480.0 { 3 } else { 5 });
            for (index, a) in names.iter().enumerate() {
                for b in &names[..index] {
                    let apart = (0..2).any(|axis| a.max[axis] <= b.min[axis] || b.max[axis] <= a.min[axis]);
                    assert!(apart, "{name}, {width}: {a:?} {b:?}");
                }
            }
            assert!(width < 884.0 || page.size[1] < 460.0, "a maximized card fits a window of 600 points");
        }
    }
}

#[test]
fn a_report_card_is_made_beside_the_window() {
    let (executor, mut window) = driven_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark);
    let made = || executor.results().counts().get("camera metrics").map_or(0, |count| count.misses);
    window.state_mut().view.selected = Some(PlotItem::Sensor(camera("Kodak DCS200")));
    window.state_mut().push(Command::Maximize(PaneKind::REPORT_CARD));
    window.run_steps(3);
    let page = "Report card: Kodak DCS200: patches";
    assert_eq!((made(), window.query_by_label(page).is_some()), (0, false));
    assert!(executor.run_one(CatalogMetricsQuery::NAME));
    window.run_steps(3);
    assert_eq!((made(), window.query_by_label(page).is_some()), (1, true));
    window.state_mut().push(Action::Scene(SceneAction::SetLight(Light::Set("A".to_owned()))));
    window.run_steps(3);
    assert_eq!((made(), window.query_by_label(page).is_some()), (1, true), "the last page stays meanwhile");
}

#[test]
fn all_numbers_go_out_as_csv_and_json() {
    let (catalog, results, document) = (Catalog::built_in(), Results::default(), Document::colorimetry());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let figure =
        panes::figure(PaneKind::METRICS, &scene, &FigureLook::default(), FigureRoom::default()).expect("a figure");
    let cameras = catalog.of_kind(SetKind::Camera).count();
    assert_eq!(figure.table.rows.len(), cameras);
    let (conditions, metrics) = (2, CameraMetric::ALL.len());
    let of_uncertainty = 4;
    let keys: Vec<&str> = figure.table.keys().collect();
    let worst = 2;
    assert_eq!(keys.len(), 1 + 2 * metrics + worst + of_uncertainty + conditions);
    assert!(keys.ends_with(&["chart", "temperature_k"]));
    let json: serde_json::Value = serde_json::from_str(&export::json(&figure.title, &figure.table)).unwrap();
    assert_eq!((json["version"].as_u64(), json["rows"].as_array().map(Vec::len)), (Some(1), Some(cameras)));
    let column = json["columns"].as_array().unwrap().iter().position(|c| c == "delta_e_2000_mean").unwrap();
    assert!(json["rows"][0][column].as_f64().is_some_and(|value| value > 0.0), "{}", json["rows"][0]);
    assert!(figure.table.to_csv().starts_with("camera,delta_e_2000_mean,delta_e_2000_mean_uncertainty,"));
}

#[test]
fn a_metric_is_one_entry_for_every_table() {
    let (catalog, results, document) = (Catalog::built_in(), Results::default(), Document::colorimetry());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let figure = panes::figure(PaneKind::METRICS, &scene, &FigureLook::default(), FigureRoom::default());
    let table = figure.expect("a figure").table;
    for metric in CameraMetric::ALL {
        let column = &table.columns[table.place(metric.column).expect(metric.column)];
        assert_eq!((column.name.as_str(), column.decimals), (metric.symbol, Some(metric.decimals)));
        assert_eq!(column.uncertainty, format!("{}_uncertainty", metric.column));
        assert!(column.hint.starts_with(metric.label) && column.group == metric.group.label());
    }
}

#[test]
fn full_well_and_read_noise_are_settings_that_give_the_snr() {
    let (_executor, mut window) = ranked();
    let snr = |window: &Window| rows(window).iter().filter_map(|(row, _)| number(row, "SNR")).count();
    assert_eq!(snr(&window), 0, "no electrons are given");
    window.get_by_role_and_label(Role::Button, "Pixel").click();
    window.run_steps(3);
    let type_in = |window: &mut Window, name: &str, text: &str| {
        window.get_by_label(name).click();
        window.run_steps(2);
        window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
        window.event(egui::Event::Text(text.to_owned()));
        window.run_steps(1);
        window.key_press(egui::Key::Enter);
        window.run_steps(3);
    };
    type_in(&mut window, "Full-well capacity", "40000");
    type_in(&mut window, "Read noise (RMS)", "3");
    let pixel = Pixel { full_well: 40_000.0, read_noise: 3.0 };
    assert_eq!(window.state().history.document().pixel, Some(pixel));
    window.state().later.wait();
    window.run_steps(3);
    assert!(snr(&window) > 30, "{:?}", rows(&window).first());
    let action = Action::Scene(SceneAction::SetPixel(Some(pixel)));
    assert_eq!(action.name(), "Pixel: full well 40000 electrons, read noise 3 electrons");
    // A session keeps them; numbers that describe no pixel are refused by actions and sessions.
    let document = window.state().history.document().clone();
    let text = session::to_json(&document).unwrap();
    assert_eq!(session::from_json(&text).unwrap().pixel, Some(pixel));
    let spoiled = text.replace("\"read-noise\": 3.0", "\"read-noise\": -3.0");
    assert!(spoiled != text && session::from_json(&spoiled).unwrap().pixel.is_none(), "{text}");
    let wrong = Pixel { full_well: 10.0, read_noise: 11.0 };
    window.state_mut().push(Action::Scene(SceneAction::SetPixel(Some(wrong))));
    window.run_steps(2);
    assert_eq!(window.state().history.document().pixel, None);
}

#[test]
fn layouts_from_before_the_workspace_open_with_it() {
    let saved = "(compare: (Some(Chromaticity), None, None, Some(Spectra)), render: (Some(Render), None, None, None))";
    let layout: Layout = ron::from_str(saved).unwrap();
    assert_eq!(layout.rank, Layout::default().rank);
    assert_eq!(layout.rank[0], Some(PaneKind::METRICS));
}

#[test]
fn metamers_are_found_marked_and_put_on_the_mesh() {
    let (executor, mut window) = open();
    assert!(!executor.run_one(CatalogMetamersQuery::NAME), "nobody looks");
    window.state_mut().view.selected = Some(PlotItem::Sensor(camera("Kodak DCS200")));
    window.state_mut().push(Command::Maximize(PaneKind::METAMERS));
    window.run_steps(3);
    assert!(window.query_by_label("Searching…").is_some());
    window.state().later.wait();
    window.run_steps(3);
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let document = window.state().history.document().clone();
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let confusion = chromascope_core::metamers::Confusion::Camera;
    let query = scene.metamers_query(SetKind::Camera, "Kodak DCS200", confusion).unwrap();
    let sets: Vec<String> = query.sets.iter().map(|set| set.name.clone()).collect();
    let query = query.loaded(&results).unwrap();
    let found = (*results.ask(&query)).clone().expect("searched");
    let [set, patch] = query.at(found.pairs[0].places[0]).unwrap();
    let first = query.sets[set].patches()[patch].name.clone();
    let row = window.query_all_by_role(Role::Row).find(|row| row.rect().top() < 400.0).expect("the worst pair");
    assert!(row.accesskit_node().label().unwrap_or_default().starts_with(&first), "{first}");
    row.click();
    window.run_steps(3);
    let clicked = window.state_mut().states.of::<ClickedPair>().0;
    let view = &window.state().view;
    assert_eq!((clicked, view.pinned.len()), (Some(0), 2), "both are marked");
    assert_eq!(view.selected.as_ref().and_then(PlotItem::patch), Some(first.as_str()));
    let is_material = |place: usize| {
        let set = query.at(place).unwrap()[0];
        scene.entry(SetKind::Chart, &sets[set]).is_err().then(|| sets[set].clone())
    };
    let names = found.pairs[0].places.map(is_material);
    if let Some(name) = names.into_iter().flatten().next() {
        window.get_by_role_and_label(Role::Button, &format!("{name} on the mesh")).click();
        window.run_steps(3);
        assert_eq!(window.state().history.document().render.material, name);
    } else {
        window
            .query_all_by_role(Role::Button)
            .find(|b| b.accesskit_node().label().unwrap_or_default().starts_with("Show "))
            .expect("a chart")
            .click();
        window.run_steps(3);
        assert!(sets.contains(&window.state().history.document().chart));
    }
}
