//! The Figure page: a pane as it is printed, its settings, and the way back.

use chromascope::action::{Action, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::command::Command;
use chromascope::document::{Diagram, WhiteBalanceChoice};
use chromascope::export::page::PageJob;
use chromascope::export::{self, Paper};
use chromascope::jobs::{Executor, Job as _};
use chromascope::theme::SourceInks;
use chromascope::view::SavedView;
use chromascope::view::{LengthUnit, PageLook, PageZoom};
use chromascope::workspaces::PaneKind;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::screenshots::driven;

type Window = Harness<'static, ChromascopeApp>;

fn settle(executor: &Executor, window: &mut Window) {
    for _ in 0..4 {
        window.run_steps(2);
        executor.run_all();
    }
    window.run_steps(2);
}

/// A window with the page of a pane.
fn page_of(pane: PaneKind) -> (Executor, Window) {
    let (executor, mut window) = driven([1280.0, 800.0], egui::Theme::Dark);
    window.state_mut().view.show(pane);
    window.state_mut().view.focused = Some(pane);
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    settle(&executor, &mut window);
    (executor, window)
}

fn open(window: &Window) -> Option<PaneKind> {
    window.state().view.page
}

#[test]
fn the_page_shows_the_picture_that_is_saved() {
    let (_executor, window) = page_of(PaneKind::CHROMATICITY);
    let app = window.state();
    assert_eq!(open(&window), Some(PaneKind::CHROMATICITY));
    let shown = app.later.seen::<PageJob>(PageJob::NAME).shown.expect("a page");
    let job = &shown.job;
    assert!(shown.current && job.paper == app.view.saved.page.paper);
    let svg = export::svg(&job.figure, &job.paper.colors(), job.paper);
    assert!(svg.contains("width=\"85mm\""), "one column");
    let picture = export::png(&svg, job.scale).expect("a picture");
    let image = shown.answer.as_ref().as_ref().expect("pixels");
    assert_eq!(
        ([image.width, image.height], &*image.rgba),
        ([picture.width(), picture.height()].map(|side| side as usize), &**picture.as_raw())
    );
    assert!(window.query_by_label("Maximize Chromaticity (F)").is_none(), "panes are out of sight");
}

#[test]
fn escape_and_ctrl_e_go_back_to_where_one_was() {
    let (executor, mut window) = page_of(PaneKind::SPECTRA);
    window.key_press(Key::Escape);
    settle(&executor, &mut window);
    assert_eq!((open(&window), window.state().view.focused), (None, Some(PaneKind::SPECTRA)));
    window.state_mut().view.maximized = Some(PaneKind::SPECTRA);
    for expected in [Some(PaneKind::SPECTRA), None] {
        window.key_press_modifiers(Modifiers::COMMAND, Key::E);
        settle(&executor, &mut window);
        assert_eq!(open(&window), expected);
        assert_eq!(window.state().view.maximized, Some(PaneKind::SPECTRA));
    }
    window.get_by_label("Restore Spectra (F)");
    window.state_mut().push(Command::FigurePage(PaneKind::SPECTRA));
    window.state_mut().push(Command::GoTo(PaneKind::CHROMATICITY));
    settle(&executor, &mut window);
    assert_eq!(open(&window), None, "another pane was asked for");
}

#[test]
fn a_figure_that_cannot_be_made_now_leaves_the_page_to_another() {
    let (executor, mut window) = page_of(PaneKind::CHROMATICITY);
    window.key_press(Key::Escape);
    window.state_mut().push(Command::GoTo(PaneKind::RECORDED));
    settle(&executor, &mut window);
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    settle(&executor, &mut window);
    let page = open(&window).expect("a page");
    assert_ne!(page, PaneKind::RECORDED);
    assert!(window.state().view.status.text.contains("as it is printed"), "it is named");
}

#[test]
fn settings_change_the_page_and_are_remembered() {
    let (executor, mut window) = page_of(PaneKind::CHROMATICITY);
    let first = window.state().later.seen::<PageJob>(PageJob::NAME).shown.expect("a page").job;
    for switch in ["Gray", "200 %", "in", "Caption with the conditions"] {
        window.get_by_label(switch).click();
        settle(&executor, &mut window);
    }
    let job = window.state().later.seen::<PageJob>(PageJob::NAME).shown.expect("a page").job;
    assert_eq!((job.paper.inks, job.paper.caption), (SourceInks::Gray, false));
    assert!(!first.figure.caption.is_empty() && job.figure.caption.is_empty());
    let saved = window.state().saved_view();
    assert_eq!((saved.page.zoom, saved.page.unit), (PageZoom::Double, LengthUnit::Inch));
    let text = ron::to_string(&saved).expect("text");
    assert_eq!(ron::from_str::<SavedView>(&text).expect("a view").page, saved.page);
    let earlier: SavedView = ron::from_str("(surround: Dark)").expect("a view of an earlier version");
    assert_eq!(earlier.page, PageLook::default());
    assert_eq!(earlier.page.paper.width_mm, Some(Paper::ONE_COLUMN_MM));
}

#[test]
fn an_idle_page_draws_nothing_and_the_document_changes_it() {
    let (executor, mut window) = page_of(PaneKind::CHROMATICITY);
    let serial = |window: &Window| window.state().later.seen::<PageJob>(PageJob::NAME).shown.expect("a page").serial;
    let before = serial(&window);
    for step in 0..8 {
        window.hover_at(egui::pos2(300.0 + 10.0 * step as f32, 300.0));
        settle(&executor, &mut window);
    }
    assert_eq!(serial(&window), before, "the pointer changes no page");
    window.state_mut().push(Command::ToggleSource(1));
    settle(&executor, &mut window);
    assert_eq!(serial(&window), before + 1);
}

#[test]
fn the_keyboard_reaches_the_settings_and_escape_leaves_a_field_first() {
    let (executor, mut window) = page_of(PaneKind::CHROMATICITY);
    window.state_mut().push(Command::NextPane);
    settle(&executor, &mut window);
    while window.state().view.focused != Some(PaneKind::CHROMATICITY) {
        window.key_press(Key::F6);
        settle(&executor, &mut window);
    }
    assert_eq!(open(&window), Some(PaneKind::CHROMATICITY), "the page is one of the panes to go to");
    window.key_press(Key::Tab);
    settle(&executor, &mut window);
    assert!(window.get_by_label("Size: One column, 85 mm").is_focused());
    window.key_press(Key::Tab);
    settle(&executor, &mut window);
    window.event(egui::Event::Text("120".to_owned()));
    window.key_press(Key::Enter);
    settle(&executor, &mut window);
    let paper = window.state().view.saved.page.paper;
    assert_eq!(paper.width_mm, Some(120.0));
    window.get_by_label("Width").focus();
    settle(&executor, &mut window);
    for expected in [Some(PaneKind::CHROMATICITY), None] {
        window.key_press(Key::Escape);
        settle(&executor, &mut window);
        assert_eq!(open(&window), expected);
    }
}

/// The figure of the page that is shown.
fn figure(window: &Window) -> std::sync::Arc<chromascope_figure::Figure> {
    std::sync::Arc::clone(&window.state().later.seen::<PageJob>(PageJob::NAME).shown.expect("a page").job.figure)
}

/// Turns the wheel over a plot.
fn wheel(window: &mut Window, plot: &str, points: f32) {
    let middle = window.get_by_role_and_label(Role::Canvas, plot).rect().center();
    window.hover_at(middle);
    window.run_steps(2);
    window.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: egui::Vec2::new(0.0, points),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    window.run_steps(30);
}

/// Asserts that a range on paper has one on screen in its middle, and all of it.
fn holds(paper: [f64; 2], screen: [f64; 2]) {
    let slack = 1e-6 * (paper[1] - paper[0]);
    assert!(paper[0] <= screen[0] + slack && paper[1] >= screen[1] - slack, "{paper:?} does not hold {screen:?}");
    assert!((paper[0] + paper[1] - screen[0] - screen[1]).abs() < 2.0 * slack, "{paper:?} is not around {screen:?}");
}

#[test]
fn the_page_has_the_ranges_of_the_diagram_on_screen() {
    let (executor, mut window) = driven([1280.0, 800.0], egui::Theme::Dark);
    let page = |window: &mut Window| {
        window.state_mut().push(Command::FigurePage(PaneKind::CHROMATICITY));
        settle(&executor, window);
        let figure = figure(window);
        let panel = figure.panels[0].clone();
        window.state_mut().push(Command::FigurePage(PaneKind::CHROMATICITY));
        settle(&executor, window);
        [panel.x.range, panel.y.range]
    };
    settle(&executor, &mut window);
    // The fit is held while the data move.
    let held = window.state().view.diagram.fit().expect("a fit").shown;
    window.state_mut().push(Action::Scene(SceneAction::SetWhite(WhiteBalanceChoice::BlackBody(2856.0))));
    settle(&executor, &mut window);
    assert_eq!(window.state().view.diagram.fit().expect("a fit").shown, held);
    for (paper, screen) in page(&mut window).into_iter().zip(held) {
        assert!(paper[0] <= screen[0] + 1e-9 && paper[1] >= screen[1] - 1e-9, "{paper:?} does not hold {screen:?}");
        let is_least = (paper[0] + 0.02).abs() < 1e-9;
        assert!(is_least || (paper[0] + paper[1] - screen[0] - screen[1]).abs() < 1e-9, "{paper:?}, {screen:?}");
    }
    // Farther out than any color is, and nearer.
    for points in [-200.0, 400.0] {
        wheel(&mut window, "Chromaticity", points);
        let zoomed = window.state().view.diagram.zoomed.expect("zoomed");
        assert!((zoomed[0][0] < -0.02) == (points < 0.0), "{zoomed:?}");
        page(&mut window).into_iter().zip(zoomed).for_each(|(paper, screen)| holds(paper, screen));
    }
    // Other coordinates are another place.
    window.state_mut().push(Command::FigurePage(PaneKind::CHROMATICITY));
    window.state_mut().push(Action::Scene(SceneAction::SetDiagram(Diagram::UvPrime)));
    settle(&executor, &mut window);
    let y = figure(&window).panels[0].y.range;
    assert!(y[0] < 0.45 && y[1] > 0.55, "{y:?}");
}

#[test]
fn the_page_has_the_ranges_of_curves_on_screen_or_its_own() {
    let (executor, mut window) = driven([1280.0, 800.0], egui::Theme::Dark);
    let table = "nm\tleaf\tbark\n400\t0.05\t0.1\n500\t0.1\t0.2\n600\t0.2\t0.3\n700\t0.5\t0.4\n";
    window.state_mut().push(Command::Paste(table.to_owned()));
    crate::waiting::until("the curves", || {
        settle(&executor, &mut window);
        let there = window.query_by_label("curves of the file").is_some();
        if there { Ok(()) } else { Err("no curves".to_owned()) }
    });
    wheel(&mut window, "curves of the file", 200.0);
    let (_, [x, y]) = window.state().view.zoomed[&PaneKind::CURVES].clone();
    assert!(x[0] > 400.0 && x[1] < 700.0, "{x:?}");
    window.state_mut().push(Command::FigurePage(PaneKind::CURVES));
    settle(&executor, &mut window);
    let panel = figure(&window).panels[0].clone();
    assert_eq!([panel.x.range, panel.y.range], [x, y]);
    window.get_by_label("Full").click();
    settle(&executor, &mut window);
    assert!(figure(&window).panels[0].x.range[0] <= 400.0);
}
