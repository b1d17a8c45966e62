//! Sessions as files, templates, and undo across them.

mod kept;

use std::fs;
use std::path::{Path, PathBuf};

use chromascope::action::history::History;
use chromascope::action::{Action, CompareAction, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::catalog::Catalog;
use chromascope::catalog::import::import;
use chromascope::cli;
use chromascope::command::{Command, SessionCommand};
use chromascope::document::imported::Fingerprint;
use chromascope::document::{Document, SessionFile, SetKind, session};
use chromascope::files::Files;
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::view::import::ImportItem;
use chromascope::view::template::TEMPLATES;
use chromascope::view::{SavedView, Weight};
use chromascope::view::{Sorting, TableLook};
use chromascope::workspaces::{PaneKind, Workspace};
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use serde_json::{Value, json};

use crate::cpu_renderer::Cpu;
use crate::import_switches::{Window, says, until};

/// A window on a profile of its own, as in a home that the program was never run in.
fn window(profile: &Path) -> Window {
    let mut files = Files::new(Some(profile.to_owned())).without_dialogs();
    let document = files.saved_document();
    let mut window = Harness::builder()
        .with_size([1280.0, 800.0])
        .with_pixels_per_point(1.0)
        .renderer(Cpu::default())
        .build_eframe(|cc| ChromascopeApp::new(&cc.egui_ctx, History::new(document), SavedView::default(), files));
    window.run_steps(2);
    window
}

fn push(window: &mut Window, command: impl Into<Command>) {
    window.state_mut().push(command);
    window.run_steps(3);
}

fn temperature(kelvin: f64) -> Action {
    Action::Scene(SceneAction::SetTemperature(kelvin))
}

fn with_leaf() -> Document {
    let set = import(
        "leaf.csv",
        b"nm,leaf\n400,0.05\n500,0.1\n600,0.2\n700,0.5\n",
        Some(chromascope::document::imported::Role::Reflectance),
    )
    .unwrap()
    .set;
    let mut document = Document::paper();
    crate::import_sets(vec![set]).apply(&mut document);
    document
}

/// Saves the session of a window under a path, as typed.
fn save_as(window: &mut Window, path: &Path) {
    push(window, SessionCommand::SaveAs);
    until(window, "the prompt", ChromascopeApp::is_asking);
    answer(window, path);
}

/// Types a path into the prompt that is open.
fn answer(window: &mut Window, path: &Path) {
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(1);
    window.get_by_role_and_label(Role::TextInput, "Path").type_text(path.to_str().unwrap());
    window.run_steps(2);
    window.key_press(egui::Key::Enter);
    window.run_steps(2);
}

fn open(window: &mut Window, path: &Path) {
    push(window, Command::OpenPath(path.to_owned()));
    let path = path.to_owned();
    until(window, "the session", move |app| {
        let session = &app.history.document().session;
        session.as_ref().is_some_and(|session| session.path == path) || app.view.status.weight != Weight::Note
    });
    window.run_steps(2);
}

fn saved(window: &mut Window) {
    until(window, "the file", |app| app.view.status.text.starts_with("Saved "));
    window.run_steps(2);
}

fn document(window: &Window) -> Document {
    window.state().history.document().clone()
}

/// A document without the file that it is saved in.
fn contents(document: &Document) -> Document {
    Document { session: None, ..document.clone() }
}

fn folder() -> (tempfile::TempDir, PathBuf) {
    let around = tempfile::tempdir().unwrap();
    let folder = fs::canonicalize(around.path()).unwrap();
    (around, folder)
}

fn json_of(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn a_session_made_here_opens_in_a_fresh_home() {
    let (_around, folder) = folder();
    let leaf = folder.join("leaf.csv");
    fs::write(&leaf, "# quantity: reflectance\nnm,leaf\n400,0.05\n500,0.1\n600,0.2\n700,0.5\n").unwrap();
    let mut here = window(&folder.join("here"));
    assert_eq!(here.state().title(), "Chromascope");
    push(&mut here, Command::OpenPath(leaf.clone()));
    until(&mut here, "the leaf", |app| !app.history.document().own.is_empty());
    push(&mut here, temperature(3210.0));
    here.state_mut().view.show(PaneKind::SPECTRA);
    push(&mut here, Command::Look("spectra_layout", 1));
    assert_eq!(here.state().title(), "*Untitled – Chromascope");
    let path = folder.join("fig3.chromascope");
    save_as(&mut here, &folder.join("fig3"));
    saved(&mut here);
    assert_eq!(here.state().title(), "fig3 – Chromascope");
    push(&mut here, temperature(3220.0));
    assert_eq!(here.state().title(), "*fig3 – Chromascope");
    push(&mut here, Command::Undo);
    assert_eq!(here.state().title(), "fig3 – Chromascope", "as it is in its file");
    // Readable: few lines, curves on one each, and where they are from. Nothing of this computer's recent files.
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.starts_with("{\n  \"format\": \"chromascope\",\n  \"version\": 4,"), "{text}");
    assert!(text.contains("\"wavelengths\": [400.0,500.0,600.0,700.0]") && text.contains("decisions"), "{text}");
    assert!(!text.contains("recent") && !text.contains("failing"), "{text}");
    fs::remove_file(leaf).unwrap();

    let mut there = window(&folder.join("there"));
    open(&mut there, &path);
    assert!(document(&there).is_same_session(&document(&here)), "all but the folder of the leaf");
    assert_eq!(document(&there).own[0].path, None);
    let saved = &there.state().view.saved;
    assert_eq!(saved.layout.compare[0], Some(PaneKind::SPECTRA));
    assert_eq!(saved.spectra_layout, chromascope::view::SpectraLayout::Each);
    assert_eq!(saved.recent, [path]);
    assert_eq!(there.state().title(), "fig3 – Chromascope");
    let own = &document(&there).own[0];
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let opened = document(&there);
    let scene = Scene { document: &opened, catalog: &catalog, results: &results };
    assert!(scene.entry(SetKind::of_own(own), &own.name).is_ok());
}

#[test]
fn what_is_unknown_is_kept_through_a_save_wherever_it_stands() {
    let (_around, folder) = folder();
    let path = folder.join("a.chromascope");
    let mut value: Value =
        serde_json::from_str(&session::to_session(&with_leaf(), &SavedView::default()).unwrap()).unwrap();
    value["hologram"] = json!({ "mesh": "head" });
    value["render"]["fog"] = json!(0.5);
    value["own"][0]["doi"] = json!("10.1000/1");
    value["own"][0]["curves"][0]["deviation"] = json!([0.01, 0.02]);
    value["compared"][1]["weight"] = json!(2);
    value["view"]["lens"] = json!("round");
    fs::write(&path, value.to_string()).unwrap();
    let mut window = window(&folder.join("profile"));
    open(&mut window, &path);
    push(&mut window, temperature(4444.0));
    push(&mut window, SessionCommand::Save);
    saved(&mut window);
    let now = json_of(&path);
    assert_eq!(now["temperature_k"], json!(4444.0));
    for field in
        ["/hologram/mesh", "/render/fog", "/own/0/doi", "/own/0/curves/0/deviation", "/compared/1/weight", "/view/lens"]
    {
        assert_eq!(now.pointer(field), value.pointer(field), "{field}");
    }
    // Also through the document that is saved between runs.
    let mut files = Files::new(Some(folder.join("next")));
    files.saved_document();
    files.save_document(&document(&window)).unwrap();
    drop(files);
    let next = Files::new(Some(folder.join("next"))).saved_document();
    assert_eq!((&next.unknown, &next.own), (&document(&window).unknown, &document(&window).own));
}

#[test]
fn a_session_of_a_newer_version_opens_as_far_as_it_is_understood() {
    let (_around, folder) = folder();
    let path = folder.join("new.chromascope");
    let mut value: Value =
        serde_json::from_str(&session::to_session(&with_leaf(), &SavedView::default()).unwrap()).unwrap();
    value["version"] = json!(99);
    value["light"] = json!({ "laser": 532 });
    value["temperature_k"] = json!(4321.0);
    value["hologram"] = json!(true);
    value["compared"].as_array_mut().unwrap().push(json!({ "name": "Bee", "kind": "insect", "slot": 7 }));
    value["view"]["workspace"] = json!("Hologram");
    fs::write(&path, value.to_string()).unwrap();
    let mut window = window(&folder.join("profile"));
    open(&mut window, &path);
    let status = &window.state().view.status;
    for words in ["newer version", "format 99", "kept: hologram", "skipped: compared, light", "workspace"] {
        assert!(status.text.contains(words), "{words}: {}", status.text);
    }
    let document = document(&window);
    assert_eq!((document.temperature_k, document.compared.len(), document.own.len()), (4321.0, 5, 1));
    // It is not written over: saving asks for a name.
    assert_eq!(document.session, None);
    push(&mut window, SessionCommand::Save);
    until(&mut window, "the prompt", ChromascopeApp::is_asking);
    assert_eq!(json_of(&path), value);
}

#[test]
fn two_windows_never_overwrite_each_other() {
    let (_around, folder) = folder();
    let path = folder.join("shared.chromascope");
    fs::write(&path, session::to_session(&Document::paper(), &SavedView::default()).unwrap()).unwrap();
    let (mut one, mut two) = (window(&folder.join("profile")), window(&folder.join("profile")));
    open(&mut one, &path);
    open(&mut two, &path);
    push(&mut one, temperature(3000.0));
    push(&mut two, temperature(9000.0));
    push(&mut one, SessionCommand::Save);
    saved(&mut one);
    push(&mut two, SessionCommand::Save);
    until_asked(&mut two);
    assert_eq!(json_of(&path)["temperature_k"], json!(3000.0), "not overwritten");
    assert_eq!(two.state().title(), "*shared – Chromascope");
    two.get_by_label("Replace it").click();
    saved(&mut two);
    assert_eq!(json_of(&path)["temperature_k"], json!(9000.0));
    // Now the first window is asked, and takes the other's.
    push(&mut one, temperature(3100.0));
    push(&mut one, SessionCommand::Save);
    until_asked(&mut one);
    one.get_by_label("Open that version").click();
    until(&mut one, "the other's", |app| app.history.document().temperature_k == 9000.0);
    assert_eq!(one.state().title(), "shared – Chromascope");
    push(&mut one, Command::Undo);
    assert_eq!(document(&one).temperature_k, 3100.0);
}

/// Waits for the question about a file that another program wrote to.
fn until_asked(window: &mut Window) {
    crate::waiting::until("the question", || {
        window.run_steps(1);
        if says(window, "wrote to") { Ok(()) } else { Err(window.state().view.status.text.clone()) }
    });
}

#[test]
fn where_nothing_can_be_written_that_is_said_and_the_work_stays() {
    let (_around, folder) = folder();
    let drive = folder.join("drive");
    fs::create_dir(&drive).unwrap();
    let path = drive.join("a.chromascope");
    let mut window = window(&folder.join("profile"));
    push(&mut window, temperature(3000.0));
    save_as(&mut window, &path);
    saved(&mut window);
    push(&mut window, temperature(3100.0));
    // The drive is gone.
    fs::rename(&drive, folder.join("elsewhere")).unwrap();
    push(&mut window, SessionCommand::Save);
    until(&mut window, "the failure", |app| app.view.status.weight == Weight::Error);
    let said = window.state().view.status.text.clone();
    assert!(
        said.starts_with("Cannot write ") && said.contains("Your work is safe") && said.contains("Save as"),
        "{said}"
    );
    assert_eq!((document(&window).temperature_k, window.state().title()), (3100.0, "*a – Chromascope"));
    // It is back.
    fs::rename(folder.join("elsewhere"), &drive).unwrap();
    push(&mut window, SessionCommand::Save);
    saved(&mut window);
    assert_eq!(json_of(&path)["temperature_k"], json!(3100.0));
}

#[test]
fn undo_goes_back_across_sessions_by_the_names_of_its_steps() {
    let (_around, folder) = folder();
    let path = folder.join("a.chromascope");
    fs::write(&path, session::to_session(&Document::paper(), &SavedView::default()).unwrap()).unwrap();
    let mut window = window(&folder.join("profile"));
    push(&mut window, CompareActionOf("Kodak DCS200").remove());
    open(&mut window, &path);
    push(&mut window, temperature(3000.0));
    push(&mut window, SessionCommand::Save);
    saved(&mut window);
    push(&mut window, SessionCommand::New(None));
    until(&mut window, "a new session", |app| app.history.document().session.is_none());
    let undo = |window: &mut Window| {
        let name = window.state().history.undo_name().unwrap_or_default().to_owned();
        push(window, Command::Undo);
        (name, window.state().title().to_owned())
    };
    let is = |name: &str, title: &str| (name.to_owned(), title.to_owned());
    assert_eq!(undo(&mut window), is("New: New session", "a – Chromascope"));
    assert_eq!(undo(&mut window), is("Temperature: 3000 K", "*a – Chromascope"));
    assert_eq!(undo(&mut window), is("Open a.chromascope", "*Untitled – Chromascope"));
    assert_eq!(undo(&mut window), is("Remove Kodak DCS200 from comparison", "Chromascope"));
}

struct CompareActionOf(&'static str);

impl CompareActionOf {
    fn remove(&self) -> Action {
        Action::Compare(CompareAction::Remove(SetKind::Camera, self.0.to_owned()))
    }
}

#[test]
fn the_file_is_known_after_a_start_and_a_changed_one_is_asked_about() {
    let (_around, folder) = folder();
    let path = folder.join("a.chromascope");
    let profile = folder.join("profile");
    let mut first = window(&profile);
    push(&mut first, temperature(3000.0));
    save_as(&mut first, &path);
    saved(&mut first);
    first.state_mut().push(SessionCommand::Save);
    first.run_steps(2);
    let kept = document(&first);
    let mut files = Files::new(Some(folder.join("second")));
    files.saved_document();
    files.save_document(&kept).unwrap();
    drop(files);
    let mut next = window(&folder.join("second"));
    crate::waiting::until("the name", || {
        next.run_steps(1);
        let title = next.state().title();
        if title == "a – Chromascope" { Ok(()) } else { Err(title.to_owned()) }
    });
    // Another program writes while this one is closed.
    drop(next);
    fs::write(&path, session::to_session(&Document::paper(), &SavedView::default()).unwrap()).unwrap();
    let mut again = window(&folder.join("second"));
    assert_eq!(again.state().title(), "*a – Chromascope");
    push(&mut again, SessionCommand::Save);
    until_asked(&mut again);
}

#[test]
fn each_template_is_a_document_of_its_own_that_its_pane_shows() {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let documents: Vec<Document> = TEMPLATES.iter().map(chromascope::view::template::Template::document).collect();
    for (index, (template, document)) in TEMPLATES.iter().zip(&documents).enumerate() {
        assert!(!documents[..index].contains(document) || template.name.ends_with('2'), "{}", template.name);
        let scene = Scene { document, catalog: &catalog, results: &results };
        for source in scene.sources() {
            let colors = scene.patch_colors(source.kind, &source.name);
            assert!(colors.is_ok(), "{}: {}: {:?}", template.name, source.name, colors.err());
        }
    }
    let (_around, folder) = folder();
    let mut window = window(&folder.join("profile"));
    let sorting = Some(Sorting { column: "max".to_owned(), descending: true });
    let worst_first = TableLook { sorting, ..TableLook::default() };
    for template in &TEMPLATES {
        window.state_mut().view.saved.looks.insert("ranking".to_owned(), worst_first.clone());
        push(&mut window, SessionCommand::New(Some(template.name)));
        let wanted = template.document();
        until(&mut window, template.name, move |app| *app.history.document() == wanted);
        window.run_steps(2);
        let saved = &window.state().view.saved;
        assert!(saved.layout.shows(saved.workspace, template.pane), "{}", template.name);
        assert_eq!(saved.looks["ranking"].sorting, None, "{}: the order of the session before", template.name);
    }
}

#[test]
fn own_templates_are_kept_by_name_and_stay_as_they_are() {
    let (_around, folder) = folder();
    let profile = folder.join("profile");
    let mut one = window(&profile);
    push(&mut one, temperature(3456.0));
    one.state_mut().view.show(PaneKind::SPECTRA);
    push(&mut one, SessionCommand::SaveTemplate);
    one.get_by_role_and_label(Role::TextInput, "Name of the template").type_text("Lamps/LED");
    one.run_steps(2);
    one.key_press(egui::Key::Enter);
    one.run_steps(3);
    let templates = one.state().view.templates.clone();
    assert_eq!(templates.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["Lamps-LED"]);
    drop(one);
    let mut next = window(&profile);
    let (_, path) = next.state().view.templates[0].clone();
    push(&mut next, SessionCommand::NewFrom(path.clone()));
    until(&mut next, "the template", |app| app.history.document().temperature_k == 3456.0);
    next.run_steps(2);
    assert!(next.state().view.is_shown(PaneKind::SPECTRA));
    assert_eq!((next.state().title(), document(&next).session), ("*Untitled – Chromascope", None));
    push(&mut next, SessionCommand::RemoveTemplate(path.clone()));
    assert!(!path.exists() && next.state().view.templates.is_empty());
}

#[test]
fn a_session_is_named_on_the_command_line() {
    for arguments in [vec!["chromascope", "a.chromascope"], vec!["chromascope", "--session", "a.chromascope"]] {
        let outcome = cli::run(arguments.into_iter().map(Into::into));
        let cli::Outcome::Window(files) = outcome else { panic!("no window") };
        assert_eq!(files, [PathBuf::from("a.chromascope")]);
    }
}

#[test]
fn a_damaged_session_changes_nothing() {
    let (_around, folder) = folder();
    let path = folder.join("half.chromascope");
    let whole = session::to_session(&Document::paper(), &SavedView::default()).unwrap();
    fs::write(&path, &whole[..whole.len() / 2]).unwrap();
    let mut window = window(&folder.join("profile"));
    let before = document(&window);
    open(&mut window, &path);
    assert!(window.state().view.status.text.starts_with("half.chromascope could not be opened: EOF"));
    assert_eq!(document(&window), before);
}

#[test]
fn a_table_from_a_spreadsheet_opens_in_import_and_curves_are_copied_as_text() {
    let (_around, folder) = folder();
    let mut window = window(&folder.join("profile"));
    push(
        &mut window,
        Command::Paste("nm\tleaf\tbark\n400\t0.05\t0.1\n500\t0.1\t\n600\t0.2\t0.3\n700\t0.5\t0.4\n".to_owned()),
    );
    until(&mut window, "the set", |app| !app.history.document().own.is_empty());
    assert_eq!(window.state().view.saved.workspace, Workspace::Data);
    let set = document(&window).own[0].clone();
    assert_eq!(window.state().view.import.selected, Some(ImportItem::Set(set.name.clone())));
    window.state_mut().push(Command::CopySet(SetKind::of_own(&set), set.name.clone()));
    window.run_steps(1);
    let commands = &window.output().platform_output.commands;
    let copied = commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    let expected = "wavelength_nm\tleaf\tbark\n400\t0.05\t0.1\n500\t0.1\t\n600\t0.2\t0.3\n700\t0.5\t0.4\n";
    assert_eq!(copied.unwrap().replace("\r\n", "\n"), expected);
    // One that cannot be read is shown there too.
    let mut other = self::window(&folder.join("other"));
    push(&mut other, Command::Paste("no numbers at all".to_owned()));
    until(&mut other, "the failure", |app| app.view.saved.workspace == Workspace::Data);
}

#[test]
fn a_session_saved_at_the_moment_of_a_kill_is_not_asked_about() {
    let (_around, folder) = folder();
    let path = folder.join("a.chromascope");
    // The document notes the file as it was before it was written.
    let mut document = Document { temperature_k: 3000.0, ..Document::paper() };
    fs::write(&path, session::to_session(&document, &SavedView::default()).unwrap()).unwrap();
    document.session = Some(SessionFile { path: path.clone(), fingerprint: Fingerprint::of(b"before") });
    let profile = folder.join("profile");
    let mut files = Files::new(Some(profile.clone()));
    files.saved_document();
    files.save_document(&document).unwrap();
    drop(files);
    let mut window = window(&profile);
    crate::waiting::until("the name", || {
        window.run_steps(1);
        let title = window.state().title();
        if title == "a – Chromascope" { Ok(()) } else { Err(title.to_owned()) }
    });
    push(&mut window, temperature(3100.0));
    push(&mut window, SessionCommand::Save);
    saved(&mut window);
}
