//! Files that are opened: folders, many at once, stopped, remembered by kind, changed on disk; and what is looked at of them.

use std::fs;
use std::path::Path;
use std::sync::mpsc;

use chromascope::app::ChromascopeApp;
use chromascope::catalog::import::{TAKEN_AT_FIRST, import};
use chromascope::catalog::likeness::Likeness;
use chromascope::catalog::opened::{Opened, OpenedEvent, Request};
use chromascope::command::Command;
use chromascope::document::imported::{Fingerprint, ImportOverrides};
use chromascope::document::{Document, session};
use chromascope::jobs::Executor;
use chromascope::view::Weight;
use chromascope::view::import::{ImportItem, ImportMemory};
use egui_kittest::Harness;
use spectral_file::{ReadOptions, Role, Values};

use crate::import_switches::{own, until};
use crate::screenshots::open;

type Window = Harness<'static, ChromascopeApp>;

const LEAF: &str = "nm;leaf (%)\n400;5,0\n500;10,0\n600;20,0\n700;50,0\n";
const BROKEN: &str = "nm,leaf\n400,0.1\n410,0.2\n420,oops\n430,0.2\n440,0.2\n";

fn window() -> Window {
    open([1280.0, 800.0], egui::Theme::Dark)
}

fn wish(window: &mut Window, name: &str, options: ReadOptions) {
    let overrides = ImportOverrides { options, ..ImportOverrides::default() };
    let item = ImportItem::Set(name.to_owned());
    window.state_mut().push(Command::SetOverrides(item, Box::new(overrides)));
    window.run_steps(2);
}

fn open_path(window: &mut Window, path: &Path) {
    window.state_mut().push(Command::OpenPath(path.to_owned()));
    window.run_steps(2);
}

#[test]
fn a_folder_is_one_step_and_what_fails_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let other = LEAF.replace("50,0", "60,0");
    for (name, text) in [("b.csv", other.as_str()), ("a.csv", LEAF), (".hidden", LEAF), ("c.csv", BROKEN)] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let deep = folder.path().join("within/and/within");
    fs::create_dir_all(&deep).unwrap();
    let further = [("d.csv", LEAF.replace("50,0", "70,0")), ("d.cov.csv", "1,0\n0,1\n".to_owned())];
    let words = [("README.md", "Measured with care.\n".to_owned()), ("notes.txt", "And again.\n".to_owned())];
    for (name, text) in further.into_iter().chain(words) {
        fs::write(deep.join(name), text).unwrap();
    }
    fs::write(deep.join("square.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").unwrap();
    let mut window = window();
    open_path(&mut window, folder.path());
    until(&mut window, "a folder", |app| !app.view.status.text.is_empty());
    let names: Vec<String> = own(&window).into_iter().map(|set| set.name).collect();
    assert_eq!(names, ["a", "b", "d"]);
    let said = window.state().view.status.text.clone();
    assert!(said.starts_with("1 of 4 files could not be read: c.csv, line 4: no number in column 2"), "{said}");
    assert!(
        said.contains("3 files read. Not opened: 1 meshes, images or sessions. Skipped: 1 hidden (.hidden)"),
        "{said}"
    );
    assert!(said.contains("1 beside their tables") && said.contains("2 without readable spectra ("), "{said}");
    assert_eq!(window.state().opened.failing().len(), 1, "texts are not listed as failures");
    window.state_mut().push(Command::Undo);
    window.run();
    assert_eq!(*window.state().history.document(), Document::paper());
}

#[test]
fn a_folder_without_spectra_says_what_is_in_it() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["README.md", "notes.txt", ".hidden"] {
        fs::write(folder.path().join(name), "Nothing but words.\n").unwrap();
    }
    let mut window = window();
    open_path(&mut window, folder.path());
    until(&mut window, "a folder", |app| !app.view.status.text.is_empty());
    let said = &window.state().view.status.text;
    let words = "1 hidden (.hidden), 2 without readable spectra (README.md, notes.txt)";
    assert_eq!(*said, format!("No spectra were found. Skipped: {words}. Nothing was changed."));
}

#[test]
fn a_file_that_fails_is_known_and_reads_once_it_is_mended() {
    let mut window = window();
    window.state_mut().push(Command::Paste("nm;a\n400;0,1\n500;0,2\n600;x\n700;0,4\n".to_owned()));
    window.run_steps(2);
    until(&mut window, "a failure", |app| !app.view.status.text.is_empty());
    assert_eq!(window.state().view.status.weight, Weight::Error);
    let files = window.state().opened.files();
    assert_eq!(files.len(), 1);
    assert!(files[0].failure.as_ref().is_some_and(|failure| failure.starts_with("clipboard, line 4")));
    let item = ImportItem::File(files[0].origin.fingerprint);
    assert_eq!(window.state().view.status.change, Some((item.clone(), None)));
    assert_eq!(window.state().view.import.selected, Some(item), "a pasted table is shown in Import");
    assert!(own(&window).is_empty());
}

#[test]
fn what_was_wished_is_done_as_one_step_and_remembered_for_the_kind() {
    let folder = tempfile::tempdir().unwrap();
    let text =
        |shift: u32| (0..40).map(|i| format!("{},{}\n", 400 + 5 * i, (i + shift) % 50)).collect::<Vec<_>>().concat();
    let head = "# instrument: Acme 3\n# operator: somebody\nwavelength,signal\n";
    for (name, shift) in [("one.csv", 0), ("two.csv", 7)] {
        fs::write(folder.path().join(name), format!("{head}{}", text(shift))).unwrap();
    }
    let mut window = window();
    open_path(&mut window, &folder.path().join("one.csv"));
    until(&mut window, "a file", |app| !app.history.document().own.is_empty());
    let before = own(&window);
    let options =
        ReadOptions { role: Some(Role::Reflectance), values: Some(Values::Percent), ..ReadOptions::default() };
    wish(&mut window, "one", options.clone());
    until(&mut window, "a wish", |app| app.history.document().own[0].overrides.options.role.is_some());
    assert_eq!(own(&window)[0].curves[0].values[1], 0.01);
    open_path(&mut window, &folder.path().join("two.csv"));
    until(&mut window, "another file", |app| app.history.document().own.len() == 2);
    let two = &own(&window)[1];
    assert_eq!((two.overrides.options.clone(), two.role, two.curves[0].values[0]), (options, Role::Reflectance, 0.07));
    for _ in 0..2 {
        window.state_mut().push(Command::Undo);
        window.run();
    }
    assert_eq!(own(&window), before);
}

#[test]
fn a_wish_that_cannot_be_met_changes_nothing() {
    let mut window = window();
    window.state_mut().push(Command::Paste(LEAF.to_owned()));
    until(&mut window, "a file", |app| !app.history.document().own.is_empty());
    let before = own(&window);
    let delimiter = Some(spectral_file::Delimiter::Tab);
    wish(&mut window, "clipboard", ReadOptions { delimiter, ..ReadOptions::default() });
    window.state().opened.wait();
    window.run_steps(3);
    assert_eq!(own(&window), before);
    assert!(!window.state().view.import.tried.is_empty());
    window.state_mut().push(Command::DiscardOverrides);
    window.run_steps(2);
    assert_eq!((own(&window), window.state().view.import.tried.len()), (before, 0));
}

#[test]
fn files_of_a_kind_are_read_alike_in_one_step() {
    let folder = tempfile::tempdir().unwrap();
    for i in 0..3 {
        let rows = (0..30).map(|n| format!("{} {}\n", 400 + 10 * n, 5 + (n + i) % 40)).collect::<Vec<_>>().concat();
        fs::write(folder.path().join(format!("{i}.txt")), rows).unwrap();
    }
    fs::write(folder.path().join("other.csv"), LEAF).unwrap();
    let mut window = window();
    open_path(&mut window, folder.path());
    until(&mut window, "a folder", |app| app.history.document().own.len() == 4);
    let before = own(&window);
    wish(&mut window, "0", ReadOptions { role: Some(Role::Illuminant), ..ReadOptions::default() });
    until(&mut window, "a wish", |app| app.history.document().own[0].role == Role::Illuminant);
    window.state_mut().push(Command::UseForAlike(ImportItem::Set("0".to_owned())));
    until(&mut window, "alike", |app| app.history.document().own[2].role == Role::Illuminant);
    let roles: Vec<Role> = own(&window).iter().map(|set| set.role).collect();
    assert_eq!(roles[..3], [Role::Illuminant; 3]);
    assert_eq!(roles[3], Role::Reflectance);
    window.state_mut().push(Command::Undo);
    window.run();
    assert_eq!(own(&window)[1..], before[1..]);
}

#[test]
fn a_file_that_changes_on_disk_is_read_again_and_a_broken_one_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("leaf.csv");
    fs::write(&path, LEAF).unwrap();
    let mut window = window();
    open_path(&mut window, &path);
    until(&mut window, "a file", |app| !app.history.document().own.is_empty());
    fs::write(&path, LEAF.replace("5,0", "7,0")).unwrap();
    until(&mut window, "a change", |app| app.history.document().own[0].curves[0].values[0] == 0.07);
    assert!(window.state().view.status.text.contains("changed on disk"), "{}", window.state().view.status.text);
    let before = own(&window);
    fs::write(&path, LEAF.replace("20,0", "oops")).unwrap();
    until(&mut window, "a failure", |app| app.view.status.weight == Weight::Error);
    assert!(window.state().view.status.text.contains("line 4"), "{}", window.state().view.status.text);
    assert_eq!(own(&window), before);
    window.state_mut().push(Command::Undo);
    window.run();
    assert_eq!(own(&window)[0].curves[0].values[0], 0.05);
}

#[test]
fn a_session_opens_without_its_files() {
    let imported = import("leaf.csv", LEAF.as_bytes(), None).unwrap();
    let mut document = Document::paper();
    crate::import_sets(vec![imported.set.clone()]).apply(&mut document);
    let again = session::from_json(&session::to_json(&document).unwrap()).unwrap();
    assert_eq!(again, document);
    assert_eq!(again.own[0].fingerprint, Some(Fingerprint::of(LEAF.as_bytes())));
    assert!(!again.own[0].decisions.is_empty());
}

#[test]
fn of_very_many_curves_the_first_are_taken() {
    let count = TAKEN_AT_FIRST + 50;
    let row = |nm: u32| format!("{nm}{}\n", ",0.5".repeat(count));
    let text = [400, 500, 600].map(row).concat();
    let imported = import("many.csv", text.as_bytes(), Some(Role::Reflectance)).unwrap();
    assert_eq!(imported.set.curves.len(), TAKEN_AT_FIRST);
    assert!(
        imported.message.contains("250 curves") && imported.message.contains("200 of them"),
        "{}",
        imported.message
    );
}

#[test]
fn reading_a_large_file_can_be_stopped() {
    let row = |nm: usize| format!("{nm}{}\n", ",0.123456".repeat(3000));
    let text = (380..1380).map(row).collect::<Vec<_>>().concat();
    let opened = Opened::on(&Executor::default(), || {});
    // The reading waits at its beginning until it was stopped.
    let ((at_it, begun), (go_on, told)) = (mpsc::channel(), mpsc::channel::<()>());
    opened.open(vec![Request::Bytes { name: "large.csv".to_owned(), bytes: text.into_bytes().into() }], move |_| {
        at_it.send(()).unwrap();
        told.recv().unwrap();
        ImportOverrides::default()
    });
    begun.recv().unwrap();
    assert_eq!(opened.stop(), Some("large.csv".to_owned()));
    go_on.send(()).unwrap();
    opened.wait();
    let events: Vec<OpenedEvent> = opened.poll();
    assert!(events.is_empty() && opened.files().is_empty(), "who stopped it wants none of it: {events:?}");
}

#[test]
fn kinds_of_files_are_told_apart() {
    let ocean = |date: &str, value: &str| {
        format!(
            "SpectraSuite Data File\n++++++++\nDate: {date}\nUser: me\nSpectrometer Serial Number: Q{value}\n\
             >>>>>Begin Processed Spectral Data<<<<<\n339.09\t{value}\n339.43\t-0.{value}\n"
        )
    };
    let one = Likeness::of(ocean("Mon Sep 21", "12.5").as_bytes());
    assert!(one.is_like(&Likeness::of(ocean("Tue Oct 3, 12:00", "7.125").as_bytes())));
    for other in [LEAF, BROKEN, "400 0.1\n500 0.2\n", ""] {
        assert!(!one.is_like(&Likeness::of(other.as_bytes())), "{other:?}");
    }
    let numbers = |text: &str| Likeness::of(text.as_bytes());
    assert!(numbers("400 0.1\n500 0.2\n").is_like(&numbers("380.5 -1.5\n381 20\n")));
    assert!(!numbers("400 0.1\n500 0.2\n").is_like(&numbers("400,0.1\n500,0.2\n")));
    let mut memory = ImportMemory::default();
    let overrides = ImportOverrides { taken: Some(vec![1]), ..ImportOverrides::for_role(Some(Role::Camera)) };
    memory.remember(one.clone(), &overrides);
    assert_eq!(memory.overrides(&one), ImportOverrides::for_role(Some(Role::Camera)));
    memory.remember(one.clone(), &ImportOverrides::default());
    assert_eq!(memory.remembered, []);
    memory.remember(numbers("400 0.1\n500 0.2\n"), &ImportOverrides::for_role(Some(Role::Illuminant)));
    assert_eq!(memory.remembered, [], "numbers alone are no kind of file");
}

#[test]
fn what_was_remembered_is_told_and_given_up_where_it_does_not_fit() {
    let folder = tempfile::tempdir().unwrap();
    let rows = |from: u32| (0..30).map(|i| format!("{};{}\n", 400 + 5 * i, from + i)).collect::<Vec<_>>().concat();
    let head = "Instrument: Acme\nOperator: me\nwavelength;signal\n";
    fs::write(folder.path().join("one.csv"), format!("{head}{}", rows(1))).unwrap();
    fs::write(folder.path().join("two.csv"), format!("{head}{}", rows(9))).unwrap();
    let commas = format!("{head}{}", rows(5)).replace(';', ",");
    fs::write(folder.path().join("three.csv"), commas).unwrap();
    let mut window = window();
    open_path(&mut window, &folder.path().join("one.csv"));
    until(&mut window, "a file", |app| !app.history.document().own.is_empty());
    let delimiter = Some(spectral_file::Delimiter::Semicolon);
    let options = ReadOptions { role: Some(Role::Illuminant), delimiter, ..ReadOptions::default() };
    wish(&mut window, "one", options);
    until(&mut window, "a wish", |app| app.history.document().own[0].role == Role::Illuminant);
    open_path(&mut window, &folder.path().join("two.csv"));
    until(&mut window, "another", |app| app.history.document().own.len() == 2);
    assert_eq!(own(&window)[1].role, Role::Illuminant);
    let status = &window.state().view.status;
    assert!(status.text.contains("with your settings") && status.change.is_some(), "{}", status.text);
    open_path(&mut window, &folder.path().join("three.csv"));
    until(&mut window, "a third", |app| app.history.document().own.len() == 3);
    assert_eq!(own(&window)[2].overrides, ImportOverrides::default());
}

#[test]
fn a_file_that_changes_again_and_again_is_one_step() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("leaf.csv");
    fs::write(&path, LEAF).unwrap();
    let mut window = window();
    open_path(&mut window, &path);
    until(&mut window, "a file", |app| !app.history.document().own.is_empty());
    for value in ["7,0", "8,0", "9,0"] {
        fs::write(&path, LEAF.replace("5,0", value)).unwrap();
        let wanted: f64 = value[..1].parse().unwrap();
        until(&mut window, value, |app| app.history.document().own[0].curves[0].values[0] == wanted / 100.0);
    }
    window.state_mut().push(Command::Undo);
    window.run();
    assert_eq!(own(&window)[0].curves[0].values[0], 0.05);
}
