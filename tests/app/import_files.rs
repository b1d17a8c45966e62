//! Tests of Import's list of files: names, several files together, files that fail and are corrected, settings tried
//! and applied.

use std::fs;
use std::path::Path;

use chromascope::action::history::History;
use chromascope::app::ChromascopeApp;
use chromascope::command::Command;
use chromascope::document::imported::ImportOverrides;
use chromascope::document::{Document, Light, SetKind};
use chromascope::files::Files;
use chromascope::view::import::ImportItem;
use chromascope::view::{SavedView, Weight};
use chromascope::workspaces::{PaneKind, Workspace};
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use spectral_file::{Delimiter, ReadOptions, Role as Kinds};

use crate::cpu_renderer::Cpu;
use crate::import_switches::{Window, choose, closed, drop_file, own, says, settle, undo, until};
use crate::screenshots::open;

const CAMERA: &str = "nm,red,green,blue\n400,0,1,5\n500,1,8,4\n600,9,5,1\n700,5,1,0\n";
const LAMP: &str = "# title: Lamp\nnm,spectral power distribution (W)\n400,1\n500,2\n600,3\n700,2\n";
const LEAF: &str = "nm;leaf (%)\n400;5,0\n500;10,0\n600;20,0\n700;50,0\n";
const BROKEN: &str = "nm;leaf (%)\n400;5,0\n500;10,0\n600;oops\n700;50,0\n";

fn window() -> Window {
    let mut window = open([1280.0, 1000.0], egui::Theme::Dark);
    window.state_mut().view.show(PaneKind::IMPORT);
    window.run();
    window
}

fn open_path(window: &mut Window, path: &Path) {
    window.state_mut().view.status = chromascope::view::Status::default();
    window.state_mut().push(Command::OpenPath(path.to_owned()));
    window.run_steps(2);
    // In Import the list says what failed, elsewhere the status line.
    let failed = |app: &ChromascopeApp| {
        app.opened.files().iter().any(|file| file.failure.is_some() && file.origin.path.as_deref() == Some(path))
    };
    until(window, "a file", |app| (!app.view.status.text.is_empty() || failed(app)) && app.opened.progress().is_none());
    settle(window);
}

fn status(window: &Window) -> (String, Weight) {
    let status = &window.state().view.status;
    (status.text.clone(), status.weight)
}

fn selected(window: &Window) -> Option<ImportItem> {
    window.state().view.import.selected.clone()
}

fn set(name: &str) -> ImportItem {
    ImportItem::Set(name.to_owned())
}

/// Types into the field of the name.
fn type_name(window: &mut Window, name: &str) {
    const FIELD: (Role, &str) = (Role::TextInput, "Name of the set");
    window.get_by_role_and_label(FIELD.0, FIELD.1).focus();
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(1);
    window.get_by_role_and_label(FIELD.0, FIELD.1).type_text(name);
    window.run_steps(2);
}

/// Types into the field of the name and leaves it with Enter.
fn rename(window: &mut Window, name: &str) {
    type_name(window, name);
    window.key_press(egui::Key::Enter);
    window.run_steps(4);
}

#[test]
fn a_camera_called_as_a_built_in_one_is_another() {
    let mut window = window();
    drop_file(&mut window, "Nikon D70 (A.M.P.A.S.).csv", CAMERA);
    let (said, _) = status(&window);
    assert!(
        said.contains(
            "A data set named Nikon D70 (A.M.P.A.S.) already exists; imported as Nikon D70 (A.M.P.A.S.) (own)"
        ),
        "{said}"
    );
    assert!(window.state().compares(SetKind::Camera, "Nikon D70 (2007 figure)"));
    assert!(window.state().compares(SetKind::Camera, "Nikon D70 (A.M.P.A.S.) (own)"));
    // A name that is taken is refused, and said why, while it is typed and after.
    for (name, why) in [("Canon EOS 10D (2007 figure)", "A built-in data set has this name"), ("mine", "")] {
        type_name(&mut window, name);
        assert!(why.is_empty() || says(&window, why), "{name}");
        window.key_press(egui::Key::Enter);
        window.run_steps(4);
        if !why.is_empty() {
            assert_eq!(own(&window)[0].name, "Nikon D70 (A.M.P.A.S.) (own)");
            assert!(status(&window).0.contains(why), "{}", status(&window).0);
        }
    }
    assert_eq!(own(&window)[0].name, "mine");
}

#[test]
fn the_selection_follows_a_set_to_its_new_name_and_back() {
    let mut window = window();
    for name in ["a.csv", "b.csv", "c.csv"] {
        drop_file(
            &mut window,
            name,
            &CAMERA.replace("9,5", &format!("9,{}", name.len() + usize::from(name.as_bytes()[0]))),
        );
    }
    window.state_mut().push(Command::ShowImport(set("b"), None));
    settle(&mut window);
    rename(&mut window, "zoo");
    assert_eq!(selected(&window), Some(set("zoo")));
    assert_eq!(own(&window)[1].name, "zoo");
    undo(&mut window);
    assert_eq!((selected(&window), own(&window)[1].name.as_str()), (Some(set("b")), "b"));
    window.state_mut().push(Command::Redo);
    settle(&mut window);
    assert_eq!(selected(&window), Some(set("zoo")));
    // A role under which the name is taken gives the set another one.
    rename(&mut window, "D65");
    choose(&mut window, "This is a", "Illuminant");
    until(&mut window, "a role", |app| app.history.document().own[1].role == Kinds::Illuminant);
    assert_eq!(selected(&window), Some(set("D65 (own)")));
}

#[test]
fn what_is_on_show_stays_when_a_set_comes_and_goes() {
    let mut window = window();
    drop_file(&mut window, "a.csv", CAMERA);
    drop_file(&mut window, "b.csv", LEAF);
    let file = own(&window)[1].fingerprint.map(ImportItem::File);
    assert_eq!(selected(&window), Some(set("b")));
    undo(&mut window);
    assert_eq!(selected(&window), file);
    window.state_mut().push(Command::Redo);
    settle(&mut window);
    assert_eq!(selected(&window), Some(set("b")));
}

#[test]
fn several_files_at_once_leave_light_and_patches() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("a.csv", CAMERA), ("b.csv", LAMP), ("c.csv", LEAF), ("d.csv", BROKEN), ("e.csv", "")] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let mut window = window();
    open_path(&mut window, folder.path());
    let document = window.state().history.document().clone();
    assert_eq!(document.own.len(), 3);
    assert_eq!((&document.light, &document.chart), (&Document::paper().light, &Document::paper().chart));
    assert!(window.state().compares(SetKind::Camera, "a"));
    let (said, weight) = status(&window);
    let skipped = "3 files read. Skipped: 1 without readable spectra (e.csv).";
    assert!(said.contains(skipped), "{said}");
    assert!(said.contains("1 added to the comparison; illuminant and patches are unchanged."), "{said}");
    assert!(said.starts_with("1 of 4 files could not be read: d.csv, line 4") && weight == Weight::Warning, "{said}");
    undo(&mut window);
    assert_eq!(*window.state().history.document(), Document::paper());
    assert_eq!(status(&window).0, "Undone: Open 3 sets.", "what was taken back is no longer said");
    // One alone waits for the user's word.
    open_path(&mut window, &folder.path().join("b.csv"));
    assert_eq!(window.state().history.document().light, Document::paper().light);
    window.key_press(egui::Key::Enter);
    settle(&mut window);
    assert_eq!(window.state().history.document().light, Light::Set("Lamp".to_owned()));
}

#[test]
fn what_is_tried_on_a_file_stays_with_it() {
    let mut window = window();
    drop_file(&mut window, "broken.csv", BROKEN);
    drop_file(&mut window, "leaf.csv", LEAF);
    let broken = window.state().opened.files()[0].origin.fingerprint;
    let broken = ImportItem::File(broken);
    let tried = ImportOverrides {
        options: ReadOptions { delimiter: Some(Delimiter::Tab), ..ReadOptions::default() },
        ..ImportOverrides::default()
    };
    for item in [broken.clone(), set("leaf")] {
        window.state_mut().push(Command::ShowImport(item.clone(), None));
        settle(&mut window);
        choose(&mut window, "Columns split by", "Tab");
        assert_eq!(window.state().view.import.pending(&item), Some(&tried));
    }
    window.state_mut().push(Command::ShowImport(broken.clone(), None));
    settle(&mut window);
    assert_eq!(closed(&window, "Columns split by"), "Tab (chosen)");
    // A set that undo takes away and redo brings back is still tried so.
    undo(&mut window);
    assert!(own(&window).is_empty());
    window.state_mut().push(Command::Redo);
    window.state_mut().push(Command::ShowImport(set("leaf"), None));
    settle(&mut window);
    assert_eq!(closed(&window, "Columns split by"), "Tab (chosen)");
    window.get_by_role_and_label(Role::Button, "Forget choices").click();
    settle(&mut window);
    assert_eq!(window.state().view.import.pending(&set("leaf")), None);
    assert_eq!(window.state().view.import.pending(&broken), Some(&tried));
    // Choices that hold are taken back as one step.
    choose(&mut window, "This is a", "Illuminant");
    until(&mut window, "a role", |app| app.history.document().own[0].role == Kinds::Illuminant);
    window.get_by_role_and_label(Role::Button, "Forget choices").click();
    settle(&mut window);
    assert_eq!(own(&window)[0].overrides, ImportOverrides::default());
    assert!(window.state().view.saved.import.remembered.is_empty());
    undo(&mut window);
    assert_eq!(own(&window)[0].role, Kinds::Illuminant);
}

#[test]
fn a_failing_file_is_one_entry_and_is_read_once_it_is_mended() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("leaf.csv");
    fs::write(&path, BROKEN).unwrap();
    let mut window = window();
    open_path(&mut window, &path);
    assert!(says(&window, "Reload when the file changes"));
    let first = window.state().opened.files()[0].origin.fingerprint;
    assert_eq!(selected(&window), Some(ImportItem::File(first)));
    fs::write(&path, BROKEN.replace("oops", "oops;oops")).unwrap();
    until(&mut window, "another failure", |app| {
        app.opened.files().first().is_some_and(|file| file.origin.fingerprint != first)
    });
    settle(&mut window);
    let files = window.state().opened.files();
    assert_eq!(files.len(), 1);
    assert_eq!(selected(&window), Some(ImportItem::File(files[0].origin.fingerprint)));
    fs::write(&path, LEAF).unwrap();
    until(&mut window, "the file mended", |app| !app.history.document().own.is_empty());
    settle(&mut window);
    assert_eq!((window.state().opened.files().len(), selected(&window)), (1, Some(set("leaf"))));
    // A set whose file fails and is then corrected has one entry.
    fs::write(&path, BROKEN).unwrap();
    until(&mut window, "a failure", |app| app.view.status.weight == Weight::Error);
    fs::write(&path, LEAF.replace("5,0", "6,0")).unwrap();
    until(&mut window, "mended", |app| app.history.document().own[0].curves[0].values[0] == 0.06);
    settle(&mut window);
    assert!(window.state().opened.failing().is_empty());
    assert_eq!(window.query_all_by(|node| node.role() == Role::ListItem).count(), 1);
}

#[test]
fn a_folder_that_is_made_again_is_watched_again() {
    let folder = tempfile::tempdir().unwrap();
    let within = folder.path().join("within");
    let path = within.join("leaf.csv");
    fs::create_dir(&within).unwrap();
    fs::write(&path, LEAF).unwrap();
    let mut window = window();
    open_path(&mut window, &path);
    for value in ["7,0", "8,0"] {
        fs::remove_dir_all(&within).unwrap();
        // Whether it is noticed that it was gone or not.
        window.run_steps(2);
        fs::create_dir(&within).unwrap();
        fs::write(&path, LEAF.replace("5,0", value)).unwrap();
        let wanted = value[..1].parse::<f64>().unwrap() / 100.0;
        until(&mut window, value, |app| app.history.document().own[0].curves[0].values[0] == wanted);
    }
    fs::write(&path, LEAF.replace("5,0", "9,0")).unwrap();
    until(&mut window, "9,0", |app| app.history.document().own[0].curves[0].values[0] == 0.09);
}

#[test]
fn failing_files_and_marks_outlive_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let (path, gone) = (folder.path().join("broken.csv"), folder.path().join("gone.csv"));
    fs::write(&path, BROKEN).unwrap();
    fs::write(&gone, format!("{BROKEN}\n")).unwrap();
    let mut first = window();
    first.state_mut().view.saved.workspace = Workspace::Compare;
    open_path(&mut first, &gone);
    open_path(&mut first, &path);
    let saved = first.state().saved_view();
    assert_eq!((saved.import.failing.len(), saved.import.unseen.len()), (2, 2));
    let saved: SavedView = serde_json::from_str(&serde_json::to_string(&saved).unwrap()).unwrap();
    fs::remove_file(&gone).unwrap();
    let mut second = egui_kittest::Harness::builder()
        .with_size([1280.0, 800.0])
        .renderer(Cpu::default())
        .build_eframe(|cc| ChromascopeApp::new(&cc.egui_ctx, History::new(Document::paper()), saved, Files::new(None)));
    until(&mut second, "recalled", |app| app.opened.failing().len() == 1);
    assert_eq!(second.state().view.status.text, "");
    let known = second.state().opened.failing();
    assert!(known[0].why.starts_with("broken.csv, line 4"), "{}", known[0].why);
    let item = ImportItem::File(known[0].fingerprint);
    assert!(second.state().view.import.unseen.contains(&item));
    // It is watched as before.
    fs::write(&path, LEAF).unwrap();
    until(&mut second, "mended", |app| !app.history.document().own.is_empty());
    assert!(!second.state().view.import.unseen.contains(&item));
}

#[test]
fn none_of_the_curves_means_none() {
    let mut window = window();
    drop_file(&mut window, "zoo.csv", &CAMERA.replace("nm,", "# comment\nnm,"));
    let before = own(&window);
    assert_eq!(before[0].curves.len(), 3);
    window.get_by_role_and_label(Role::Button, "None").click();
    settle(&mut window);
    assert!(says(&window, "0 of 3 imported") && says(&window, "No curve is selected. The data set is unchanged"));
    assert_eq!(own(&window), before);
    for color in ["red", "blue"] {
        window.get_by_role_and_label(Role::CheckBox, color).click();
        settle(&mut window);
    }
    let names: Vec<String> = own(&window)[0].curves.iter().map(|curve| curve.name.clone()).collect();
    assert_eq!(names, ["red", "blue"]);
    // A file that is no set yet cannot be made one of nothing.
    let file = window.state().opened.files()[0].origin.fingerprint;
    window
        .state_mut()
        .push(chromascope::action::Action::Imported(chromascope::action::ImportedAction::Remove("zoo".to_owned())));
    window.state_mut().push(Command::ShowImport(ImportItem::File(file), None));
    settle(&mut window);
    let disabled = |window: &Window| window.get_by_role_and_label(Role::Button, "Use").accesskit_node().is_disabled();
    assert!(!disabled(&window));
    window.get_by_role_and_label(Role::Button, "None").click();
    settle(&mut window);
    assert!(disabled(&window));
    window.get_by_role_and_label(Role::Button, "All").click();
    settle(&mut window);
    window.get_by_role_and_label(Role::Button, "Use").click();
    until(&mut window, "a set", |app| !app.history.document().own.is_empty());
    assert_eq!(own(&window)[0].curves.len(), 3);
}

#[test]
fn parts_of_a_file_are_taken_side_by_side() {
    let table = |name: &str, first: u32| {
        let rows = (0..8).map(|i| format!("{},0.{}\n", 400 + 20 * i, first + i)).collect::<Vec<_>>().concat();
        format!("{name}\nwavelength (nm),reflectance\n{rows}\n")
    };
    let mut window = window();
    let text = [table("oak", 10), table("elm", 20), table("ash", 30)].concat();
    drop_file(&mut window, "trees.csv", &text);
    let before = own(&window);
    let boxes = |window: &Window| {
        let parts = window.query_all_by(|node| node.role() == Role::CheckBox);
        parts
            .filter_map(|node| node.accesskit_node().label())
            .filter(|label| label.starts_with(|c: char| c.is_ascii_digit()))
            .collect::<Vec<_>>()
    };
    let parts = boxes(&window);
    assert_eq!(parts.len(), 3, "{parts:?}");
    for part in &parts[1..] {
        window.get_by_role_and_label(Role::CheckBox, part).click();
        settle(&mut window);
    }
    window.get_by_role_and_label(Role::Button, "Import 2 parts").click();
    until(&mut window, "parts", |app| app.history.document().own.len() == 3);
    let sets = own(&window);
    assert_eq!(sets[0], before[0]);
    let firsts: Vec<f64> = sets[1..].iter().map(|set| set.curves[0].values[0]).collect();
    assert_eq!(firsts, [0.20, 0.30]);
    assert!(sets[1].name.starts_with("trees, ") && sets[1].name != sets[2].name, "{} {}", sets[1].name, sets[2].name);
    assert!(status(&window).0.starts_with("2 sets read."), "{}", status(&window).0);
    undo(&mut window);
    assert_eq!(own(&window), before);
}
