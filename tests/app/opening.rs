//! What opening and reloading change: nothing that the user did not ask for.

use std::fs;
use std::path::{Path, PathBuf};

use chromascope::action::history::History;
use chromascope::action::{Action, ImportedAction, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::catalog::import::import;
use chromascope::catalog::opened::{Opened, Request};
use chromascope::command::{Command, SessionCommand};
use chromascope::document::imported::{Fingerprint, ImportOverrides, ImportedSet};
use chromascope::document::render::MeshChoice;
use chromascope::document::{Document, Light, SetKind, session};
use chromascope::files::Files;
use chromascope::jobs::Executor;
use chromascope::plot_item::PlotItem;
use chromascope::view::RankedCameras;
use chromascope::view::{DiagramFit, Offer, SavedView, Weight};
use chromascope::workspaces::{PaneKind, Workspace};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::cpu_renderer::Cpu;
use crate::import_switches::{Window, drop_file, own, says, settle, until};
use crate::screenshots::open;

const CAMERA: &str = "nm,red,green,blue\n400,0,1,5\n500,1,8,4\n600,9,5,1\n700,5,1,0\n";
const LAMP: &str = "# title: Lamp\nnm,spectral power distribution (W)\n400,1\n500,2\n600,3\n700,2\n";
const LEAF: &str = "# quantity: reflectance\nnm,leaf\n400,0.05\n500,0.1\n600,0.2\n700,0.5\n";
const GLASS: &str = "# quantity: transmittance\nnm,glass\n400,0.2\n500,0.4\n600,0.9\n700,0.9\n";

fn window() -> Window {
    open([1280.0, 800.0], egui::Theme::Dark)
}

fn document(window: &Window) -> Document {
    window.state().history.document().clone()
}

/// The conditions, without the library.
fn conditions(document: &Document) -> Document {
    Document { own: Vec::new(), ..document.clone() }
}

fn press(window: &mut Window, key: Key) {
    window.key_press(key);
    settle(window);
}

fn has_keyboard(window: &Window, label: &str) -> bool {
    // In Data the library offers the same.
    let mut buttons = window.query_all_by_role_and_label(Role::Button, label);
    buttons.any(|button| button.is_focused())
}

fn open_path(window: &mut Window, path: &Path) {
    window.state_mut().push(Command::OpenPath(path.to_owned()));
    settle(window);
}

/// Writes a file and has its set read again.
fn rewrite(window: &mut Window, path: &Path, text: &str, set: &str) {
    fs::write(path, text).unwrap();
    window.state_mut().push(Command::ReadAgain(set.to_owned()));
    settle(window);
}

fn undo(window: &mut Window) -> String {
    let name = window.state().history.undo_name().unwrap_or_default().to_owned();
    window.state_mut().push(Command::Undo);
    settle(window);
    name
}

#[test]
fn a_light_a_chart_and_a_filter_wait_for_one_enter() {
    for (file, text, button, step) in [
        ("lamp.csv", LAMP, "Use as light", "Use Lamp as light"),
        ("leaf.csv", LEAF, "Use as chart", "Use leaf as chart"),
        ("glass.csv", GLASS, "Use as filter", "Use glass as filter"),
    ] {
        let mut window = window();
        let before = document(&window);
        drop_file(&mut window, file, text);
        assert_eq!((conditions(&document(&window)), own(&window).len()), (before.clone(), 1), "{file}");
        assert!(says(&window, "the conditions are unchanged") && has_keyboard(&window, button), "{file}");
        press(&mut window, Key::Enter);
        let set = own(&window)[0].clone();
        assert!(document(&window).uses(SetKind::of_own(&set), &set.name), "{file}");
        assert!(window.state().view.status.offers.is_empty());
        assert_eq!(undo(&mut window), step);
        assert_eq!(conditions(&document(&window)), before);
        // Opened again it is offered again; Esc leaves it in the library.
        drop_file(&mut window, &format!("again {file}"), &format!("{text}\n"));
        assert!(has_keyboard(&window, button), "{file}");
        press(&mut window, Key::Escape);
        press(&mut window, Key::Enter);
        assert_eq!(conditions(&document(&window)), before, "{file}");
        assert!(window.state().view.status.offers.is_empty() && window.state().view.status.text.is_empty());
    }
}

#[test]
fn a_file_shown_in_data_can_be_used_there() {
    let mut window = window();
    window.state_mut().view.show(PaneKind::IMPORT);
    window.state_mut().view.selected = Some(PlotItem::of_set(SetKind::Camera, "Nikon D70 (2007 figure)"));
    for (file, text, kind, name, button) in [
        ("leaf.csv", LEAF, SetKind::Chart, "leaf", "Use as chart"),
        ("glass.csv", GLASS, SetKind::Filter, "glass", "Use as filter"),
        ("lamp.csv", LAMP, SetKind::Illuminant, "Lamp", "Use as light"),
    ] {
        drop_file(&mut window, file, text);
        press(&mut window, Key::Escape);
        window.get_by_role_and_label(Role::Button, button).click();
        settle(&mut window);
        assert!(document(&window).uses(kind, name), "{file}");
    }
    let row = |window: &Window| {
        window
            .query_all_by_role(Role::ListItem)
            .find(|row| row.accesskit_node().label().is_some_and(|label| label.starts_with("glass: ")))
            .map(|row| row.click())
    };
    row(&window).expect("a row of Import");
    settle(&mut window);
    window.get_by_role_and_label(Role::Button, "Remove filter");
}

#[test]
fn an_offer_stays_until_it_is_taken_and_a_field_that_is_typed_into_keeps_the_keyboard() {
    let mut window = window();
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    window.event(egui::Event::Text("cano".to_owned()));
    window.run_steps(2);
    let before = document(&window);
    drop_file(&mut window, "lamp.csv", LAMP);
    let end = window.ctx.input(|input| input.time) + 20.0;
    while window.ctx.input(|input| input.time) < end {
        window.step();
    }
    assert!(!has_keyboard(&window, "Use as light"), "the search has it");
    window.get_all_by_role_and_label(Role::Button, "Use as light").last().expect("an offer").click();
    settle(&mut window);
    assert_eq!(document(&window).light, Light::Set("Lamp".to_owned()));
    assert_eq!(before.chart, document(&window).chart);
    // Letters are shortcuts, also while the offer has the keyboard.
    drop_file(&mut window, "leaf.csv", LEAF);
    assert!(has_keyboard(&window, "Use as chart"));
    press(&mut window, Key::F);
    assert!(window.state().view.maximized.is_some());
    assert_eq!(window.state().view.status.offers.len(), 1);
}

#[test]
fn pasted_tables_and_several_files_wait_too() {
    let mut window = window();
    let before = document(&window);
    window.event(egui::Event::Paste(LEAF.to_owned()));
    until(&mut window, "the table", |app| !app.history.document().own.is_empty());
    settle(&mut window);
    assert!(conditions(&document(&window)) == before && has_keyboard(&window, "Use as chart"));
    press(&mut window, Key::Enter);
    assert_eq!(document(&window).chart, own(&window)[0].name);
    undo(&mut window);
    undo(&mut window);
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("a.csv", LAMP), ("b.csv", LEAF), ("c.csv", GLASS), ("d.csv", CAMERA)] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    open_path(&mut window, folder.path());
    let opened = document(&window);
    assert!(opened.compared(SetKind::Camera, "d").is_some(), "a camera is compared at once");
    let compared = before.compared.clone();
    assert_eq!(Document { compared, ..conditions(&opened) }, before);
    assert_eq!(window.state().view.status.offers.len(), 3);
    assert!(has_keyboard(&window, "Use as…"));
    press(&mut window, Key::Enter);
    window.get_by_label("Use c as filter").click();
    settle(&mut window);
    assert_eq!(document(&window).filters, ["c"]);
    assert_eq!(window.state().view.status.offers.len(), 2, "the others still wait");
}

#[test]
fn a_file_named_at_the_start_is_the_users_word() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lamp.csv");
    fs::write(&path, LAMP).unwrap();
    let mut window = window();
    window.state_mut().open_at_start(vec![path.clone()]);
    until(&mut window, "the lamp", |app| app.history.document().light == Light::Set("Lamp".to_owned()));
    assert_eq!(undo(&mut window), "Use Lamp as light");
    open_path(&mut window, &path);
    assert_ne!(document(&window).light, Light::Set("Lamp".to_owned()), "opened later it waits");
}

#[test]
fn a_file_that_comes_back_as_something_else_is_offered_and_the_last_reading_stays() {
    let folder = tempfile::tempdir().unwrap();
    for (first, second, used, offered) in [
        (LAMP, LEAF, "Lamp", "Use as chart"),
        (CAMERA, LEAF, "measured", "Use as chart"),
        (LEAF, CAMERA, "measured", "Compare camera"),
    ] {
        let path = folder.path().join("measured.csv");
        fs::write(&path, first).unwrap();
        let mut window = window();
        window.state_mut().open_at_start(vec![path.clone()]);
        until(&mut window, "the file", |app| {
            app.history
                .document()
                .own
                .first()
                .is_some_and(|set| app.history.document().uses(SetKind::of_own(set), &set.name))
        });
        let before = document(&window);
        rewrite(&mut window, &path, second, used);
        let after = document(&window);
        assert_eq!((conditions(&after), &after.own[0]), (conditions(&before), &before.own[0]));
        assert_eq!(after.own.len(), 2, "the other reading is in the library");
        assert!(says(&window, "now holds") && says(&window, "is unchanged"));
        // A reload takes no keyboard: one may be typing elsewhere.
        assert!(!has_keyboard(&window, offered));
        rewrite(&mut window, &path, &format!("{second}\n"), used);
        assert_eq!(document(&window).own.len(), 2, "there is one reading in each role");
        rewrite(&mut window, &path, &format!("{first}\n"), used);
        let again = document(&window);
        assert_eq!((conditions(&again), again.own.len()), (conditions(&before), 2));
        assert_eq!(again.own[0].fingerprint, Some(Fingerprint::of(format!("{first}\n").as_bytes())));
    }
}

#[test]
fn a_reload_out_of_range_is_refused_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("leaf.csv");
    fs::write(&path, LEAF).unwrap();
    let mut window = window();
    window.state_mut().open_at_start(vec![path.clone()]);
    until(&mut window, "the leaf", |app| app.history.document().chart == "leaf");
    let before = document(&window);
    for value in ["-7.2", "1e9"] {
        rewrite(&mut window, &path, &LEAF.replace("0.1\n", &format!("{value}\n")), "leaf");
        assert_eq!(document(&window), before, "{value}");
        assert!(says(&window, "The earlier data are unchanged"), "{:?}", window.state().view.status);
        assert_eq!(window.state().view.status.weight, Weight::Error);
    }
    rewrite(&mut window, &path, &LEAF.replace("0.1\n", "0.3\n"), "leaf");
    assert_eq!(document(&window).own[0].curves[0].values[1], 0.3);
}

fn set(text: &str) -> ImportedSet {
    import("leaf.csv", text.as_bytes(), None).unwrap().set
}

/// Another reading of the leaf.
fn reload(history: &mut History, index: usize) {
    let name = "leaf".to_owned();
    let with = vec![(name.clone(), set(&LEAF.replace("0.05", &format!("0.0{}", 1000 + index))))];
    let (what, built_in) = (format!("Reload {name}"), crate::built_in_names());
    history.reload(&Action::Imported(ImportedAction::ReplaceAll { what, with, beside: Vec::new(), built_in }));
    history.end_gesture();
}

#[test]
fn reloads_are_one_step_and_between_other_steps_a_bounded_number_of_readings() {
    let mut history = History::new(Document::paper());
    history.apply(&crate::import_sets(vec![set(LEAF)]));
    history.end_gesture();
    let opened = history.document().clone();
    (0..50).for_each(|index| reload(&mut history, index));
    history.undo();
    assert_eq!(*history.document(), opened);
    for index in 0..100 {
        reload(&mut history, index);
        history.apply(&Action::Scene(SceneAction::SetTemperature(3000.0 + index as f64)));
        history.end_gesture();
    }
    let mut readings = std::collections::BTreeSet::new();
    let mut kelvins = Vec::new();
    while history.undo_name().is_some_and(|name| !name.starts_with("Open")) {
        readings.insert(history.document().own[0].fingerprint);
        kelvins.push(history.document().temperature_k);
        history.undo();
    }
    kelvins.dedup();
    assert_eq!(kelvins.len(), 101, "each step of the user's is there");
    assert!(readings.len() <= 21, "{}", readings.len());
    assert_eq!(*history.document(), opened);
}

#[test]
fn a_file_rewritten_again_and_again_fills_neither_disk_nor_memory() {
    let folder = tempfile::tempdir().unwrap();
    let mut files = Files::new(Some(folder.path().to_owned()));
    files.saved_document();
    let mut history = History::new(Document::paper());
    history.apply(&crate::import_sets(vec![set(LEAF)]));
    for index in 0..100 {
        reload(&mut history, index);
        files.save_document(history.document()).unwrap();
    }
    let curves: Vec<PathBuf> =
        fs::read_dir(folder.path().join("curves")).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(curves.len() <= 17, "{} files", curves.len());
    // The first reading is in memory: undo has it written again.
    history.undo();
    files.save_document(history.document()).unwrap();
    let kept = history.document().clone();
    drop(files);
    assert_eq!(Files::new(Some(folder.path().to_owned())).saved_document(), kept);

    let path = folder.path().join("leaf.csv");
    let opened = Opened::on(&Executor::default(), || {});
    let mut last = None;
    for index in 0..40 {
        let text = LEAF.replace("0.05", &format!("0.0{}", 1000 + index));
        fs::write(&path, &text).unwrap();
        opened.open(vec![Request::Path(path.clone())], |_| ImportOverrides::default());
        opened.wait();
        last = Some(Fingerprint::of(text.as_bytes()));
        opened.keep(&[last.unwrap()]);
    }
    let files = opened.files();
    let bytes: usize = files.iter().map(|file| file.bytes.len()).sum();
    assert!(files.len() <= 4 && bytes < 5 * (LEAF.len() + 8), "{} files, {bytes} bytes", files.len());
    assert!(last.is_some_and(|last| opened.file(last).is_some()));
}

#[test]
fn a_failed_file_is_selected_at_once_with_its_reason() {
    let folder = tempfile::tempdir().unwrap();
    let (good, bad) = (folder.path().join("good.csv"), folder.path().join("bad.csv"));
    fs::write(&good, LEAF).unwrap();
    fs::write(&bad, LEAF.replace("0.2", "oops")).unwrap();
    let mut window = window();
    window.state_mut().view.show(PaneKind::IMPORT);
    open_path(&mut window, &good);
    assert!(says(&window, "good.csv: 1 curve"));
    open_path(&mut window, &bad);
    let selected = window.state().view.import.selected.clone();
    assert_eq!(
        selected,
        Some(chromascope::view::import::ImportItem::File(window.state().opened.failing()[0].fingerprint))
    );
    assert!(!says(&window, "good.csv: 1 curve"), "an older success goes");
    let row = window.get_by(|node| {
        node.role() == Role::ListItem && node.label().is_some_and(|label| label.starts_with("bad.csv: line"))
    });
    assert!(row.rect().height() > 45.0, "two lines for the reason");
    // Elsewhere it is said, in place of the success.
    window.state_mut().view.saved.workspace = Workspace::Compare;
    open_path(&mut window, &good);
    open_path(&mut window, &bad);
    let status = &window.state().view.status;
    assert!(status.weight == Weight::Error && status.text.starts_with("bad.csv, line"), "{status:?}");
}

#[test]
fn a_filter_stands_in_the_lights_control_with_a_way_to_take_it_off() {
    for (size, theme) in [([1280.0, 800.0], egui::Theme::Dark), ([900.0, 600.0], egui::Theme::Light)] {
        let mut window = open(size, theme);
        let before = document(&window).light;
        window.state_mut().push(Action::Scene(SceneAction::SetLight(Light::Set("A".to_owned()))));
        drop_file(&mut window, "glass.csv", GLASS);
        press(&mut window, Key::Enter);
        window.state_mut().view.saved.workspace = Workspace::Compare;
        window.run_steps(2);
        assert!(says(&window, "Light: A × glass"), "{before:?}");
        window.get_by_role_and_label(Role::Button, "Remove glass").click();
        window.run_steps(3);
        assert!(document(&window).filters.is_empty() && window.query_by_label("Remove glass").is_none());
        assert_eq!(window.state().history.undo_name(), Some("Remove all filters"));
    }
}

#[test]
fn a_light_chosen_in_compare_leaves_renders_own() {
    let mut window = open([1280.0, 800.0], egui::Theme::Dark);
    window.state_mut().push(Command::Do(Action::Start(chromascope::document::start::Start::Colorimetry)));
    window.run_steps(2);
    assert!(document(&window).render.sunlight);
    let light = |name: &str| Action::Scene(SceneAction::SetLight(Light::Set(name.to_owned())));
    window.state_mut().push(light("A"));
    window.run_steps(2);
    assert!(document(&window).render.sunlight, "the pictures keep their sun");
    window.state_mut().view.show(PaneKind::RENDER);
    window.run_steps(3);
    assert!(says(&window, "pictures: sun"));
    window.state_mut().push(light("D50"));
    window.run_steps(2);
    assert_eq!((document(&window).render.sunlight, document(&window).light), (false, Light::Set("D50".to_owned())));
    assert_eq!(undo(&mut window), "Illuminant: D50");
    assert_eq!((document(&window).render.sunlight, document(&window).light), (true, Light::Set("A".to_owned())));
}

#[test]
fn data_fits_the_data_again() {
    let mut window = window();
    let fit = |window: &Window| window.state().view.diagram.fit().unwrap().shown;
    let whole = fit(&window);
    let seconds = |window: &mut Window| (0..30).for_each(|_| window.step());
    window.state_mut().push(Action::Scene(SceneAction::SetChart("Training reflectances (190)".to_owned())));
    window.state_mut().push(Action::Scene(SceneAction::SetSubset(chromascope::document::Subset::All)));
    seconds(&mut window);
    let other = document(&window).chart;
    assert!(fit(&window) != whole, "{other}: other patches are other data");
    window.state_mut().push(Action::Scene(SceneAction::SetLight(Light::Set("A".to_owned()))));
    seconds(&mut window);
    let held = fit(&window);
    assert_eq!(window.state().view.saved.diagram_fit, DiagramFit::Data);
    let buttons = window.query_all_by_role_and_label(Role::Button, "Data").collect::<Vec<_>>();
    // The first is the workspace.
    buttons[1].click();
    seconds(&mut window);
    assert!(fit(&window) != held, "pressed again it fits again");
}

#[test]
fn a_template_sets_the_views_that_its_question_needs() {
    let mut window = window();
    window.state_mut().view.saved.metrics.cameras = RankedCameras::Compared;
    window.state_mut().push(SessionCommand::New(Some("Best camera for skin")));
    until(&mut window, "the template", |app| app.history.document().chart.starts_with("Skin"));
    window.run_steps(2);
    assert_eq!(window.state().view.saved.metrics.cameras, RankedCameras::Library);
    assert_eq!(document(&window).subset, chromascope::document::Subset::All);
}

/// A window on a profile of its own.
fn at_home(profile: &Path) -> Window {
    let mut files = Files::new(Some(profile.to_owned())).without_dialogs();
    let document = files.saved_document();
    let mut window: Window = Harness::builder()
        .with_size([1280.0, 800.0])
        .renderer(Cpu::default())
        .build_eframe(|cc| ChromascopeApp::new(&cc.egui_ctx, History::new(document), SavedView::default(), files));
    window.run_steps(2);
    window
}

#[test]
fn a_session_carries_no_folders_and_keeps_its_curves() {
    let around = tempfile::tempdir().unwrap();
    let folder = fs::canonicalize(around.path()).unwrap();
    let leaf = folder.join("leaf.csv");
    fs::write(&leaf, LEAF).unwrap();
    let mut document = Document::paper();
    let path = Some(leaf.clone());
    crate::import_sets(vec![ImportedSet { path, ..set(LEAF) }]).apply(&mut document);
    document.render.mesh = MeshChoice::File(folder.join("statue.obj"));
    let text = session::to_session(&document, &SavedView::default()).unwrap();
    assert!(!text.contains(folder.to_str().unwrap()) && text.contains("leaf.csv") && text.contains("statue.obj"));
    let again = session::from_json(&text).unwrap();
    assert!(again.own[0].path.is_none() && again.is_same_session(&document));
    assert_eq!(again.render.mesh, MeshChoice::File("statue.obj".into()));

    // An earlier version wrote folders. The local file of that path has other contents: it is offered, not taken.
    let old = folder.join("old.chromascope");
    fs::write(&old, session::to_json(&document).unwrap()).unwrap();
    fs::write(&leaf, LEAF.replace("0.05", "0.07")).unwrap();
    let mut window = at_home(&folder.join("profile"));
    open_path(&mut window, &old);
    until(&mut window, "the session", |app| app.history.document().session.is_some());
    settle(&mut window);
    let opened = self::document(&window);
    assert_eq!((opened.own[0].path.as_ref(), &opened.own[0].curves), (None, &document.own[0].curves));
    assert!(says(&window, "leaf.csv differs here: the session's own curves are used."));
    assert_eq!(window.state().view.status.offers, [Offer::Open(leaf.clone())]);
    press(&mut window, Key::Enter);
    let sets = own(&window);
    assert_eq!(sets.iter().map(|set| set.curves[0].values[0]).collect::<Vec<_>>(), [0.05, 0.07]);

    // Beside a session, the file that its set was made of is followed.
    fs::write(&leaf, LEAF).unwrap();
    let new = folder.join("new.chromascope");
    fs::write(&new, &text).unwrap();
    let mut window = at_home(&folder.join("other profile"));
    open_path(&mut window, &new);
    until(&mut window, "the session", |app| app.history.document().session.is_some());
    settle(&mut window);
    assert_eq!(self::document(&window).own[0].path, Some(leaf));
    assert_eq!(window.state().title(), "new – Chromascope");
}
