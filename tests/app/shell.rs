//! The frame around the panes: the two places at the foot, previews of the library's sets, pinned items as columns, the tour,
//! cards, the first start.

use chromascope::action::history::History;
use chromascope::action::{Action, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::command::{Command, TourMove};
use chromascope::document::start::Start;
use chromascope::document::{Document, SetKind};
use chromascope::files::Files;
use chromascope::plot_item::PlotItem;
use chromascope::view::SavedView;
use chromascope::view::tour::Tour;
use chromascope::workspaces::PaneKind;
use eframe::App as _;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::import_switches::says;
use crate::inspector::patch;
use crate::screenshots::{open, open_with};

type Window = Harness<'static, ChromascopeApp>;

const SIZE: [f32; 2] = [1280.0, 800.0];
/// Camera of the library that neither start compares.
const OTHER: &str = "Canon EOS 5D";

/// Steps until egui's time has gone on by so many seconds.
fn wait(window: &mut Window, seconds: f64) {
    let end = window.ctx.input(|input| input.time) + seconds;
    while window.ctx.input(|input| input.time) < end {
        window.step();
    }
}

fn row(window: &mut Window, name: &str) -> egui::Rect {
    window.state_mut().view.adding = true;
    name.clone_into(&mut window.state_mut().view.search);
    window.run();
    window.get_by_role_and_label(Role::CheckBox, name).rect()
}

#[test]
fn a_message_fades_after_six_seconds_and_an_error_stays() {
    let mut window = open(SIZE, egui::Theme::Dark);
    window.state_mut().view.say("Something was done.");
    window.step();
    wait(&mut window, 5.0);
    assert!(says(&window, "Something was done."));
    wait(&mut window, 1.5);
    assert!(!says(&window, "Something was done.") && window.state().view.status.text.is_empty());
    assert!(says(&window, "cameras computed"), "facts return to their place");
    window.state_mut().view.fail("Something failed.");
    wait(&mut window, 20.0);
    assert!(says(&window, "Something failed."));
}

#[test]
fn the_reading_under_the_pointer_is_never_covered_by_a_message() {
    let mut window = open(SIZE, egui::Theme::Dark);
    window.state_mut().view.say("Undone: Difference.");
    let at = row(&mut window, OTHER).center();
    window.hover_at(at);
    window.run();
    let both = ["Undone: Difference.", &format!("camera {OTHER}")].map(|words| {
        let said = |text: Option<String>| text.is_some_and(|text| text.contains(words));
        let foot = |node: &egui_kittest::Node<'_>| node.rect().top() > SIZE[1] - 30.0;
        window.query_all_by(|node| said(node.label()) || said(node.value())).find(foot).map(|node| node.rect())
    });
    let [Some(message), Some(reading)] = both else { panic!("{both:?}") };
    assert!(!message.intersects(reading), "{message:?} {reading:?}");
}

#[test]
fn a_set_of_the_library_is_seen_before_it_is_ticked() {
    let mut window = open_with(Document::colorimetry(), SIZE, egui::Theme::Dark);
    let ghost = |window: &Window| {
        let app = window.state();
        let (catalog, results) = (chromascope::catalog::Catalog::built_in(), chromascope::results::Results::default());
        let document = app.history.document();
        let scene = chromascope::scene::Scene { document, catalog: &catalog, results: &results };
        let built =
            chromascope::figures::chromaticity::build(&scene, &app.view.look(PaneKind::CHROMATICITY), [640.0, 480.0]);
        (built.panel.marks.iter().any(|mark| mark.name.contains("(not compared)")), built.panel.x.range)
    };
    let before = ghost(&window);
    let at = row(&mut window, OTHER).center();
    window.hover_at(at);
    window.run();
    assert!(says(&window, &format!("Curves of {OTHER}")) && says(&window, "Terms"));
    let (shown, range) = ghost(&window);
    assert!(!before.0 && shown, "its locus is in the diagram");
    assert_eq!(before.1, range, "the diagram stands still");
    assert!(!window.state().compares(SetKind::Camera, OTHER));
    window.drag_at(at);
    window.drop_at(at);
    window.run();
    assert!(window.state().compares(SetKind::Camera, OTHER) && !ghost(&window).0);
}

#[test]
fn every_kind_of_set_shows_its_curves_source_and_terms() {
    let mut window = open(SIZE, egui::Theme::Light);
    let catalog = chromascope::catalog::Catalog::built_in();
    for kind in
        [SetKind::Camera, SetKind::Observer, SetKind::Chart, SetKind::Illuminant, SetKind::Filter, SetKind::Material]
    {
        let entry = catalog.of_kind(kind).last().expect("there are such sets");
        window.state_mut().view.selected = Some(PlotItem::of_set(kind, &entry.name));
        window.run();
        for words in [&format!("Curves of {}", entry.name), "Source", "Terms"] {
            assert!(says(&window, words), "{kind:?}: {words}");
        }
        assert!(window.state().view.selected_elsewhere || window.state().compares(kind, &entry.name));
    }
}

#[test]
fn pinned_items_are_columns_of_the_selected_items_table() {
    let mut window = open([1280.0, 1000.0], egui::Theme::Dark);
    let view = &mut window.state_mut().view;
    view.pinned = vec![patch("Kodak DCS200", "blue"), patch("Nikon D70 (2007 figure)", "blue")];
    view.selected = Some(patch("Canon EOS 10D (2007 figure)", "blue"));
    window.run();
    assert!(says(&window, "x: reference 0.2020, camera 0."));
    let said: Vec<String> = window.query_all_by(|_| true).filter_map(|node| node.accesskit_node().label()).collect();
    let row = said.iter().find(|words| words.starts_with("Δxy: ")).expect("differences are a row");
    for head in ["camera 0.", "A 0.", "B 0."] {
        assert!(row.contains(head), "{row}");
    }
    assert_eq!(said.iter().filter(|words| words.starts_with("x: ")).count(), 1, "one table");
}

fn press(window: &mut Window, label: &str) {
    window.get_by_role_and_label(Role::Button, label).click();
    window.run_steps(3);
}

#[test]
fn the_tour_plays_five_scenes_on_live_data_and_leaves_the_document_as_it_was() {
    let mut window = open_with(Document::colorimetry(), SIZE, egui::Theme::Dark);
    window.state_mut().push(Action::Scene(SceneAction::SetTemperature(3210.0)));
    window.run();
    let selected = Some(patch("Kodak DCS200", "red"));
    let view = &mut window.state_mut().view;
    view.selected.clone_from(&selected);
    view.show(PaneKind::METRICS);
    window.run_steps(2);
    let before = window.state().history.document().clone();
    let saved = window.state().saved_view();
    window.state_mut().push(Command::Tour(TourMove::Begin(Tour::Paper)));
    window.run_steps(3);
    // The numbers of the paper's help page, computed here anew.
    for (title, numbers) in [
        ("1 of 5", "Kodak DCS200 0.124"),
        ("2 of 5", "Nikon D70 (2007) 5948 K"),
        ("3 of 5", "Δxy:"),
        ("4 of 5", "Kodak DCS200: "),
        ("5 of 5", "The pictures are being rendered."),
    ] {
        assert!(says(&window, title) && says(&window, numbers), "{title}: {numbers}");
        assert_ne!(*window.state().history.document(), before);
        assert_eq!(window.state().saved_view(), saved, "what is kept is the user's");
        if title == "4 of 5" {
            assert!(says(&window, "red 3.04, green 1.11, blue 0.92, orange yellow 0.90"));
        }
        if title != "5 of 5" {
            press(&mut window, "Next");
        }
    }
    window.state().render_service.wait();
    window.run_steps(2);
    assert!(says(&window, "Facing the light:"));
    press(&mut window, "Back");
    assert!(says(&window, "4 of 5"));
    press(&mut window, "End");
    assert_eq!(*window.state().history.document(), before);
    assert_eq!((&window.state().view.selected, window.state().saved_view()), (&selected, saved));
    assert!(!says(&window, "of 5  "));
    window.state_mut().push(Command::Undo);
    window.run_steps(2);
    assert_eq!(*window.state().history.document(), Document::colorimetry(), "its steps are there too");
}

#[test]
fn the_tour_of_the_program_shows_its_places_as_its_words_say() {
    let mut window = open_with(Document::colorimetry(), SIZE, egui::Theme::Light);
    window.state_mut().push(Command::Tour(TourMove::Begin(Tour::Program)));
    window.run_steps(3);
    for (step, of) in Tour::Program.steps().iter().enumerate() {
        let view = &window.state().view;
        assert!(says(&window, &format!("{} of 5  {}", step + 1, of.title)), "{}", of.title);
        let place = view.saved.workspace.label();
        assert!(of.is_printed || of.title.starts_with(place), "{}: {place}", of.title);
        assert_eq!(view.page, of.is_printed.then_some(of.pane));
        assert!(of.is_printed || view.saved.layout.shows(view.saved.workspace, of.pane), "{}", of.title);
        let compared = &window.state().history.document().compared;
        assert_eq!(compared.iter().any(|sensor| sensor.name == "Nikon D3300"), step > 0, "as the text says");
        press(&mut window, if step < 4 { "Next" } else { "End" });
    }
    assert_eq!((window.state().view.tour, window.state().view.page), (None, None));
    assert_eq!(*window.state().history.document(), Document::colorimetry());
}

#[test]
fn during_the_tour_the_users_document_is_the_one_that_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let document = Document { temperature_k: 3210.0, ..Document::colorimetry() };
    let open = |document| {
        let mut files = Files::new(Some(folder.path().to_owned()));
        let kept = files.saved_document();
        let window = Harness::builder()
            .with_size(SIZE)
            .build_eframe(|cc| ChromascopeApp::new(&cc.egui_ctx, History::new(document), SavedView::default(), files));
        (window, kept)
    };
    let (mut window, _) = open(document.clone());
    window.run();
    window.state_mut().push(Command::Tour(TourMove::Begin(Tour::Paper)));
    window.run_steps(3);
    window.state_mut().push(Action::Scene(SceneAction::SetTemperature(9000.0)));
    window.run_steps(3);
    window.state_mut().on_exit(None);
    drop(window);
    let (_, kept) = open(Document::paper());
    assert_eq!(kept, document);
}

#[test]
fn work_on_the_users_document_ends_the_tour() {
    let mut window = open(SIZE, egui::Theme::Light);
    window.state_mut().push(Command::Tour(TourMove::Begin(Tour::Paper)));
    window.run_steps(2);
    window.state_mut().push(Action::Start(Start::Colorimetry));
    window.run_steps(2);
    assert_eq!(window.state().view.tour, None);
    assert_eq!(window.state().history.document().start, Start::Colorimetry);
    window.state_mut().push(Command::Tour(TourMove::Begin(Tour::Paper)));
    window.run_steps(2);
    for _ in 0..3 {
        window.state_mut().push(Command::Escape);
        window.run_steps(2);
    }
    assert_eq!(window.state().view.tour, None);
    assert_eq!(window.state().history.document().start, Start::Colorimetry);
}

#[test]
fn loci_draw_in_once_on_the_first_start_and_never_with_reduced_motion() {
    let start = |saved: SavedView| {
        let mut window = Harness::builder().with_size(SIZE).with_step_dt(0.1).build_eframe(|cc| {
            let history = History::new(Document::paper());
            ChromascopeApp::new(&cc.egui_ctx, history, saved, Files::new(None))
        });
        let mut shares = Vec::new();
        for _ in 0..20 {
            shares.push(window.state().view.locus_share);
            window.step();
        }
        (shares, window)
    };
    let (shares, window) = start(SavedView::first(false));
    let drawn: Vec<f64> = shares.iter().flatten().copied().collect();
    assert!(drawn.len() > 5 && drawn.is_sorted() && shares.last() == Some(&None), "{shares:?}");
    let (again, _) = start(window.state().saved_view());
    assert!(again.iter().all(Option::is_none), "only once");
    for saved in
        [SavedView::first(true), SavedView { reduced_motion: true, ..SavedView::first(false) }, SavedView::default()]
    {
        assert!(start(saved).0.iter().all(Option::is_none));
    }
}

/// The last picture that was put on the clipboard.
fn copied(window: &Window) -> Option<egui::ColorImage> {
    window.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyImage(image) => Some(image.clone()),
        _ => None,
    })
}

#[test]
fn a_card_has_figure_swatches_and_caption_in_1600_by_900_pixels() {
    let mut window = open_with(Document::colorimetry(), SIZE, egui::Theme::Dark);
    for pane in [PaneKind::CHROMATICITY, PaneKind::SWATCHES, PaneKind::SPECTRA] {
        window.state_mut().push(Command::CopyCard(pane));
        window.step();
        let image = copied(&window).expect("a picture was copied");
        assert_eq!(image.size, [1600, 900]);
        let ink = |x: std::ops::Range<usize>, y: std::ops::Range<usize>| {
            let dark = |x: usize, y: usize| u32::from(image.pixels[y * 1600 + x].r() < 128);
            y.map(|y| x.clone().map(|x| dark(x, y)).sum::<u32>()).sum::<u32>()
        };
        assert!(ink(32..500, 20..80) > 100, "{pane:?}: title");
        assert!(ink(32..800, 100..700) > 1000, "{pane:?}: figure");
        assert!(ink(32..1500, 780..890) > 1000, "{pane:?}: caption");
        if pane != PaneKind::SWATCHES {
            assert!(ink(1000..1560, 100..500) > 1000, "{pane:?}: swatches");
        }
        assert_eq!(ink(0..20, 0..900) + ink(1580..1600, 0..900), 0, "{pane:?}: nothing is cut at the sides");
    }
    window.state_mut().push(Command::CopyCard(PaneKind::LIBRARY));
    window.run_steps(2);
    assert!(says(&window, "has no figure now"));
}

#[test]
fn about_shows_a_head_and_leads_on() {
    let mut window = open_with(Document::colorimetry(), SIZE, egui::Theme::Dark);
    window.state_mut().push(Command::ToggleAbout);
    window.run_steps(3);
    assert!(says(&window, "A head: left through the reference") && says(&window, "MIT OR Apache-2.0"));
    press(&mut window, "Data and sources");
    assert!(!window.state().view.about && window.state().view.help.page == Some("data"));
    window.state_mut().push(Command::Escape);
    window.state_mut().push(Command::ToggleAbout);
    window.run_steps(3);
    window.state_mut().push(Command::Escape);
    window.run_steps(2);
    assert!(!window.state().view.about);
}
