//! The switches of Import: each flips what is read, and Undo flips it back.

use std::sync::Arc;

use chromascope::app::ChromascopeApp;
use chromascope::catalog::import::import;
use chromascope::command::Command;
use chromascope::document::SetKind;
use chromascope::document::imported::{ImportedSet, WavelengthUnit};
use chromascope::view::Weight;
use chromascope::view::import::ImportItem;
use chromascope::workspaces::{PaneKind, Workspace};
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use spectral_file::{Role as Kinds, Values};

use crate::own_data::Dropped;
use crate::screenshots::open;
use crate::waiting;

pub(crate) type Window = Harness<'static, ChromascopeApp>;

const LEAF: &str = "# quantity: reflectance\nnm;leaf\n400;5,5\n500;10,5\n600;20,5\n700;50,5\n";
const ZOO: &str = "nm,red,green,blue,more\n400,0,1,5,2\n500,1,8,4,2\n600,9,5,1,2\n700,5,1,0,2\n";

/// The window with a file that was dropped on it, in Import.
fn window(name: &str, text: &str) -> Window {
    let mut window = open([1280.0, 1300.0], egui::Theme::Dark);
    drop_file(&mut window, name, text);
    window
}

pub(crate) fn drop_file(window: &mut Window, name: &str, text: &str) {
    let known = window.state().opened.files().len();
    let file = Dropped(name.into(), text.as_bytes().to_vec());
    window.input_mut().dropped_files.push(Arc::new(file));
    window.run_steps(1);
    until(window, "a file", |app| app.opened.files().len() > known && app.opened.progress().is_none());
    window.state_mut().view.show(PaneKind::IMPORT);
    settle(window);
}

/// Draws frames until something holds.
pub(crate) fn until(window: &mut Window, what: &str, holds: impl Fn(&ChromascopeApp) -> bool) {
    waiting::until(what, || {
        if holds(window.state()) {
            return Ok(());
        }
        window.run_steps(1);
        Err(window.state().view.status.text.clone())
    });
    window.run_steps(2);
}

/// Until all is looked at and done.
pub(crate) fn settle(window: &mut Window) {
    for _ in 0..3 {
        window.run_steps(2);
        window.state().opened.wait();
    }
    window.run_steps(2);
}

pub(crate) fn own(window: &Window) -> Vec<ImportedSet> {
    window.state().history.document().own.iter().map(|set| (**set).clone()).collect()
}

fn numbers(window: &Window) -> Vec<(Vec<f64>, Vec<f64>)> {
    let curves = own(window)[0].curves_in_nm().expect("curves");
    curves.into_iter().map(|(_, curve)| (curve.wavelengths_nm().to_vec(), curve.values().to_vec())).collect()
}

/// True if a control on screen contains these words.
pub(crate) fn says(window: &Window, words: &str) -> bool {
    let said = |text: Option<String>| text.is_some_and(|text| text.contains(words));
    window.query_all_by(|node| said(node.label()) || said(node.value())).next().is_some()
}

/// Opens the switches of the format, which are folded where none of them is in doubt.
fn unfold(window: &mut Window) {
    let is_open = window.query_by_label_contains("Read by: ").is_some();
    if let Some(head) = window.query_by_label("File format: all certain").filter(|_| !is_open) {
        head.click();
        settle(window);
    }
}

/// Text of a closed drop-down list after its caption.
pub(crate) fn closed(window: &Window, caption: &str) -> String {
    let head = format!("{caption}: ");
    let node =
        window.get_by(|node| node.role() == Role::ComboBox && node.label().is_some_and(|l| l.starts_with(&head)));
    node.accesskit_node().label().expect("a label")[head.len()..].to_owned()
}

/// Opens a list and takes an entry.
pub(crate) fn choose(window: &mut Window, caption: &str, entry: &str) {
    let head = format!("{caption}: ");
    unfold(window);
    window
        .get_by(|node| node.role() == Role::ComboBox && node.label().is_some_and(|label| label.starts_with(&head)))
        .click();
    window.run_steps(3);
    window.get_by_role_and_label(Role::Button, entry).click();
    settle(window);
}

pub(crate) fn undo(window: &mut Window) {
    window.state_mut().push(Command::Undo);
    settle(window);
}

#[test]
fn every_switch_flips_the_curves_and_undo_flips_them_back() {
    let mut window = window("leaf.csv", LEAF);
    let before = (own(&window), numbers(&window));
    assert_eq!(before.1[0].1, [0.055, 0.105, 0.205, 0.505]);
    assert_eq!(closed(&window, "Values are"), "Percent (guess)");
    assert!(window.query_by_label_contains("Wavelengths in").is_none(), "what is certain is folded");
    unfold(&mut window);
    assert_eq!(closed(&window, "Wavelengths in"), "nm (certain)");
    assert!(says(&window, "Columns split by: Semicolon"));
    let one = |window: &Window| (own(window)[0].clone(), numbers(window)[0].clone());
    for (caption, entry, holds) in [
        (
            "Values are",
            "Plain numbers",
            (|_, curve| curve.1[0] == 5.5) as fn(ImportedSet, (Vec<f64>, Vec<f64>)) -> bool,
        ),
        ("Values are", "Absorbance", |_, curve| (curve.1[0] - 10_f64.powf(-5.5)).abs() < 1e-18),
        ("Wavelengths in", "Å", |set, _| set.unit == WavelengthUnit::Angstrom),
        ("This is a", "Illuminant", |set, _| set.role == Kinds::Illuminant),
        ("This is a", "Transmittance", |set, _| set.role == Kinds::Transmittance),
        ("Decimal mark", "Comma", |set, _| set.overrides.options.decimal_mark.is_some()),
        ("Columns split by", "Semicolon", |set, _| set.overrides.options.delimiter.is_some()),
        ("Wavelengths run", "Down a column", |set, _| set.overrides.options.orientation.is_some()),
        ("Wavelength column", "1: nm", |set, _| set.overrides.options.wavelength_column == Some(1)),
        ("Read by", "Table of numbers", |set, _| set.overrides.options.reader.is_some()),
    ] {
        // In ångströms the leaf would be in the ultraviolet, where no instrument is: that is said, and nothing changes.
        choose(&mut window, caption, entry);
        if entry == "Å" {
            assert!(says(&window, "check the unit and the column"));
            assert_eq!(own(&window), before.0);
            window.get_by_role_and_label(Role::Button, "Back").click();
            settle(&mut window);
            continue;
        }
        let (set, curve) = one(&window);
        assert!(holds(set, curve), "{caption}: {entry}");
        assert!(closed(&window, caption).ends_with("(chosen)"), "{caption}: {}", closed(&window, caption));
        undo(&mut window);
        assert_eq!((own(&window), numbers(&window)), before, "{caption}: {entry}");
    }
}

#[test]
fn a_choice_is_given_back_to_the_content() {
    let mut window = window("leaf.csv", LEAF);
    choose(&mut window, "Values are", "Plain numbers");
    assert_eq!(own(&window)[0].overrides.options.values, Some(Values::Plain));
    choose(&mut window, "Values are", "Decided by content");
    assert_eq!((own(&window)[0].overrides.options.values, numbers(&window)[0].1[0]), (None, 0.055));
}

#[test]
fn two_wrong_choices_are_mended_one_by_one() {
    let mut window = window("leaf.csv", LEAF);
    let before = own(&window);
    choose(&mut window, "Columns split by", "Comma");
    choose(&mut window, "Decimal mark", "Point");
    assert_eq!(own(&window), before, "what cannot be read changes nothing");
    assert!(says(&window, "The data set is unchanged"));
    choose(&mut window, "Columns split by", "Semicolon");
    assert_eq!(own(&window), before);
    choose(&mut window, "Decimal mark", "Comma");
    let options = own(&window)[0].overrides.options.clone();
    assert!(options.delimiter.is_some() && options.decimal_mark.is_some());
    assert_eq!(numbers(&window)[0].1, [0.055, 0.105, 0.205, 0.505]);
    undo(&mut window);
    assert_eq!(own(&window), before);
}

#[test]
fn a_file_that_failed_is_used_once_it_reads() {
    let mut window = window("waves.csv", "x;a\n20000;1,5\n16000;2,5\n12500;3,5\n10000;4,5\n");
    assert!(own(&window).is_empty());
    let file = window.state().opened.files()[0].origin.fingerprint;
    window.state_mut().push(Command::ShowImport(ImportItem::File(file), None));
    settle(&mut window);
    assert!(says(&window, "ångströms, wave numbers"));
    choose(&mut window, "Wavelengths in", "1/cm");
    assert!(own(&window).is_empty(), "it is only used when that is asked for");
    window.get_by_role_and_label(Role::Button, "Use").click();
    until(&mut window, "use", |app| !app.history.document().own.is_empty());
    assert_eq!(numbers(&window)[0].0[0], 500.0);
    undo(&mut window);
    assert!(own(&window).is_empty());
}

#[test]
fn a_file_that_failed_is_looked_at_and_left_out() {
    let mut window = window("broken.csv", "nm;a\n400;1,5\n500;2,5\n600;3,5\n700;x\n");
    assert_eq!(window.state().view.status.weight, Weight::Error);
    window.state_mut().view.saved.workspace = Workspace::Compare;
    window.run_steps(2);
    window.get_by_role_and_label(Role::Button, "Show line").click();
    settle(&mut window);
    assert!(matches!(window.state().view.import.selected, Some(ImportItem::File(_))));
    assert!(window.state().view.import.unseen.is_empty(), "it was looked at");
    assert!(says(&window, "Line 5: no number in column 2"));
    window.get_by_role_and_label(Role::Button, "Do not import").click();
    settle(&mut window);
    assert!(window.state().opened.files().is_empty());
}

#[test]
fn the_numbers_of_the_result_are_those_that_are_read() {
    let mut window = window("leaf.csv", LEAF);
    window.state_mut().push(Command::CopyNumbers(PaneKind::CURVES));
    settle(&mut window);
    assert_eq!(window.state().view.status.text, "Curves: 4 rows of numbers copied.");
}

#[test]
fn the_channels_of_a_camera_and_its_response_are_chosen() {
    let mut window = window("zoo.csv", ZOO);
    assert_eq!((own(&window)[0].role, own(&window)[0].channels), (Kinds::Camera, [0, 1, 2]));
    let before = own(&window);
    choose(&mut window, "Red", "more");
    assert_eq!(own(&window)[0].channels, [3, 1, 2]);
    undo(&mut window);
    assert_eq!(own(&window), before);
    window.get_by_role_and_label(Role::Button, "per photon").click();
    settle(&mut window);
    assert!(own(&window)[0].per_photon);
}

#[test]
fn curves_are_picked() {
    let head = (0..30).map(|i| format!(",leaf {i}")).collect::<Vec<_>>().concat();
    let row = |nm: u32| format!("{nm}{}\n", ",0.5".repeat(30));
    let mut window = window("many.csv", &format!("nm{head}\n{}", [400, 500, 600].map(row).concat()));
    assert!(says(&window, "30 of 30 imported"));
    window.state_mut().view.import.search = "leaf 2".to_owned();
    settle(&mut window);
    window.get_by_role_and_label(Role::CheckBox, "leaf 21").click();
    settle(&mut window);
    assert!(says(&window, "29 of 30 imported"));
    window.state_mut().view.import.search.clear();
    settle(&mut window);
    window.get_by_role_and_label(Role::Button, "None").click();
    settle(&mut window);
    assert!(says(&window, "0 of 30 imported"));
    assert_eq!(own(&window)[0].curves.len(), 29, "a set of nothing is none");
    window.get_by_role_and_label(Role::CheckBox, "leaf 1").click();
    settle(&mut window);
    assert_eq!(own(&window)[0].overrides.taken, Some(vec![1]));
    assert_eq!(own(&window)[0].curves.len(), 1);
    window.get_by_role_and_label(Role::Button, "All").click();
    settle(&mut window);
    assert_eq!(own(&window)[0].curves.len(), 30);
}

#[test]
fn others_like_it_follow() {
    let rows =
        |n: u32| (0..30).map(|i| format!("{} {}\n", 400 + 10 * i, 5 + (i + n) % 40)).collect::<Vec<_>>().concat();
    let mut window = window("one.txt", &rows(0));
    drop_file(&mut window, "two.txt", &rows(3));
    choose(&mut window, "This is a", "Illuminant");
    window.get_by_role_and_label(Role::Button, "Use for all like it").click();
    settle(&mut window);
    until(&mut window, "alike", |app| app.history.document().own.iter().all(|set| set.role == Kinds::Illuminant));
    assert_eq!(own(&window).len(), 2);
}

#[test]
fn a_set_is_renamed_and_stays_in_sight() {
    let mut window = window("zoo.csv", ZOO);
    window.get_by_role_and_label(Role::TextInput, "Name of the set").focus();
    window.run_steps(2);
    window.key_combination_modifiers(egui::Modifiers::COMMAND, &[egui::Key::A]);
    window.get_by_role_and_label(Role::TextInput, "Name of the set").type_text("Park");
    window.run_steps(2);
    window.key_press(egui::Key::Enter);
    settle(&mut window);
    assert_eq!(window.state().view.import.selected, Some(ImportItem::Set("Park".to_owned())));
    assert!(window.state().compares(SetKind::Camera, "Park"));
}

#[test]
fn a_set_without_its_file_is_changed_by_value() {
    let mut window = open([1280.0, 1300.0], egui::Theme::Dark);
    let text = "# quantity: reflectance\nnm,leaf a,leaf b\n400,4,5\n500,9,10\n600,22,30\n700,45,50\n";
    let mut imported = import("leaves.csv", text.as_bytes(), Some(Kinds::Reflectance)).expect("a table of two curves");
    imported.set.name = "Leaves".to_owned();
    assert!(imported.set.percent, "values to 50 are percent");
    window.state_mut().push(crate::import_sets(vec![imported.set]));
    window.state_mut().push(Command::ShowImport(ImportItem::Set("Leaves".to_owned()), None));
    settle(&mut window);
    assert!(says(&window, "leaves.csv is not available. Its 2 curves are stored in the session."));
    window.get_by_role_and_label(Role::CheckBox, "Values are percent").click();
    settle(&mut window);
    assert!(!own(&window)[0].percent);
    undo(&mut window);
    assert!(own(&window)[0].percent);
    choose(&mut window, "This is a", "Illuminant");
    assert_eq!(own(&window)[0].role, Kinds::Illuminant);
    window.get_by_role_and_label(Role::Button, "Remove").click();
    settle(&mut window);
    assert!(own(&window).is_empty());
}

/// Numbers that can be a light, or reflectances in percent.
const NAMELESS: &str = "400,12.3\n450,23.4\n500,34.5\n550,45.6\n600,56.7\n650,67.8\n700,78.9\n";

#[test]
fn what_numbers_alone_do_not_say_is_asked() {
    for (answer, role, first) in [
        ("Reflectances in percent", Kinds::Reflectance, 0.123),
        ("Light", Kinds::Illuminant, 12.3),
        ("As written", Kinds::Unknown, 12.3),
    ] {
        let mut window = window("numbers.csv", NAMELESS);
        let [set] = own(&window).try_into().expect("one set");
        assert_eq!((set.role, set.percent), (Kinds::Unknown, false));
        assert_eq!(set.curves[0].values[0], 12.3, "nothing is divided before somebody says so");
        assert!(says(&window, "Values reach 78.9, and nothing says whether they are reflectances in percent"));
        window.get_by_role_and_label(Role::Button, answer).click();
        settle(&mut window);
        assert_eq!(own(&window)[0].role, role, "{answer}");
        assert!((own(&window)[0].curves[0].values[0] - first).abs() < 1e-12, "{answer}");
        assert!(!says(&window, "As written"), "{answer}: nothing is asked any more");
        undo(&mut window);
        assert_eq!(own(&window)[0].role, Kinds::Unknown);
    }
}

#[test]
fn numbers_below_one_are_asked_about_too() {
    for (answer, role) in [("Reflectances", Kinds::Reflectance), ("Light", Kinds::Illuminant)] {
        let mut window = window("numbers.csv", "400,0.12\n500,0.55\n600,0.91\n700,0.3\n");
        assert_eq!(own(&window)[0].role, Kinds::Unknown);
        assert!(says(&window, "nothing says whether they are reflectances, a light or something else"));
        window.get_by_role_and_label(Role::Button, answer).click();
        settle(&mut window);
        assert_eq!((own(&window)[0].role, own(&window)[0].curves[0].values[0]), (role, 0.12), "{answer}");
    }
}

#[test]
fn reflectances_by_choice_are_asked_for_their_scale() {
    let mut window = window("numbers.csv", NAMELESS);
    choose(&mut window, "This is a", "Reflectance");
    assert_eq!((own(&window)[0].role, own(&window)[0].curves[0].values[0]), (Kinds::Reflectance, 12.3));
    window.get_by_role_and_label(Role::Button, "In percent").click();
    settle(&mut window);
    assert!(own(&window)[0].percent);
    assert!((own(&window)[0].curves[0].values[0] - 0.123).abs() < 1e-12);
}

#[test]
fn the_foot_leads_to_what_was_guessed() {
    let mut window = window("leaf.csv", LEAF);
    window.state_mut().view.saved.workspace = Workspace::Compare;
    let item = ImportItem::Set("leaf".to_owned());
    window.state_mut().view.import.unseen.insert(item.clone());
    window.state_mut().view.say("Values reach 98: read as percent.");
    window.state_mut().view.status.change = Some((item, None));
    window.run_steps(2);
    assert!(says(&window, "Data: 1 file to check"));
    window.get_by_role_and_label(Role::Button, "Change").click();
    settle(&mut window);
    assert_eq!(window.state().view.saved.workspace, Workspace::Data);
    assert!(!says(&window, "to check"));
}
