//! Tests of the path prompt and of the dialogs it replaces: it opens whenever there is no dialog, it takes all keys,
//! paths are completed, and a rejected path stays to be corrected.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};

use chromascope::action::history::History;
use chromascope::app::ChromascopeApp;
use chromascope::command::Command;
use chromascope::document::Document;
use chromascope::export::FigureForm;
use chromascope::files::{Answer, Dialogs, FileEvent, FileForm, Files, Question, SaveRequest};
use chromascope::view::SavedView;
use chromascope::workspaces::PaneKind;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::cpu_renderer::Cpu;
use crate::import_switches::{Window, says, until};
use crate::waiting;

const LEAF: &str = "nm;leaf (%)\n400;5,0\n500;10,0\n600;20,0\n700;50,0\n";

/// Dialogs whose answers the test gives when it likes.
struct Scripted {
    answers: Mutex<Receiver<Answer>>,
    asked: Mutex<Vec<Question>>,
}

impl Dialogs for Scripted {
    fn ask(&self, question: &Question) -> Answer {
        self.asked.lock().unwrap().push(question.clone());
        self.answers.lock().unwrap().recv().unwrap_or(Answer::Cancelled)
    }
}

fn scripted() -> (Sender<Answer>, Arc<Scripted>) {
    let (sender, answers) = channel();
    (sender, Arc::new(Scripted { answers: Mutex::new(answers), asked: Mutex::default() }))
}

fn window(files: Files) -> Window {
    let mut window =
        Harness::builder().with_size([1280.0, 800.0]).with_pixels_per_point(1.0).renderer(Cpu::default()).build_eframe(
            |cc| ChromascopeApp::new(&cc.egui_ctx, History::new(Document::paper()), SavedView::default(), files),
        );
    window.run();
    window
}

fn has_box(window: &Window) -> bool {
    window.query_by_role_and_label(Role::TextInput, "Path").is_some()
}

fn text(window: &Window) -> String {
    window.get_by_role_and_label(Role::TextInput, "Path").value().unwrap_or_default()
}

/// Draws frames until the window shows something.
fn until_shown(window: &mut Window, what: &str, shown: impl Fn(&Window) -> bool) {
    waiting::until(what, || {
        if shown(window) {
            return Ok(());
        }
        window.run_steps(1);
        Err(window.state().view.status.text.clone())
    });
    window.run_steps(2);
}

fn until_box(window: &mut Window) {
    until_shown(window, "a path box", has_box);
}

fn open_box(window: &mut Window) {
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::O);
    window.run_steps(2);
    until_box(window);
}

fn export(window: &mut Window, form: FigureForm) {
    window.state_mut().push(Command::Export(PaneKind::SPECTRA, form));
    window.run_steps(2);
}

fn type_path(window: &mut Window, path: &str) {
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(1);
    window.get_by_role_and_label(Role::TextInput, "Path").type_text(path);
    window.run_steps(2);
    assert_eq!(text(window), path);
}

fn enter(window: &mut Window) {
    window.key_press(egui::Key::Enter);
    window.run_steps(3);
}

fn said(window: &mut Window, what: &str) {
    until(window, what, |app| app.view.status.text.starts_with(what));
}

/// The form of a file by its first bytes.
fn form_of(path: &std::path::Path) -> &'static str {
    let bytes = fs::read(path).unwrap();
    match bytes.as_slice() {
        [0x89, b'P', b'N', b'G', ..] => "png",
        [b'<', ..] => "svg",
        _ => "csv",
    }
}

#[test]
fn the_ending_that_is_typed_decides_the_form() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = window(Files::new(None).without_dialogs());
    for (name, form) in [("a.png", "png"), ("b.csv", "csv"), ("c.svg", "svg"), ("d.PNG", "png"), ("e", "svg")] {
        export(&mut window, FigureForm::Svg);
        until_box(&mut window);
        type_path(&mut window, folder.path().join(name).to_str().unwrap());
        enter(&mut window);
        let path = folder.path().join(if name == "e" { "e.svg" } else { name });
        said(&mut window, &format!("Saved {}.", path.display()));
        assert_eq!(form_of(&path), form, "{name}");
        assert!(!has_box(&window));
    }
    // Without an extension, the requested format's is added; an existing file of the whole name must be confirmed.
    fs::write(folder.path().join("f.csv"), "mine").unwrap();
    export(&mut window, FigureForm::Csv);
    until_box(&mut window);
    type_path(&mut window, folder.path().join("f").to_str().unwrap());
    enter(&mut window);
    assert!(says(&window, "That file exists: f.csv"));
    assert_eq!(fs::read_to_string(folder.path().join("f.csv")).unwrap(), "mine");
}

#[test]
fn an_ending_that_cannot_be_written_is_refused_and_stays() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = window(Files::new(None).without_dialogs());
    export(&mut window, FigureForm::Svg);
    until_box(&mut window);
    for name in ["a.eps", "b.tiff", "c.xyz"] {
        let path = folder.path().join(name);
        type_path(&mut window, path.to_str().unwrap());
        enter(&mut window);
        assert!(says(&window, "this can be saved as .svg, .pdf, .png, .tif, .csv, .json or .tex"), "{name}");
        assert_eq!(text(&window), path.to_str().unwrap(), "to be mended");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    let path = folder.path().join("a.png");
    type_path(&mut window, path.to_str().unwrap());
    assert!(!says(&window, "this can be saved as"), "the reason goes with the path");
    enter(&mut window);
    said(&mut window, "Saved ");
    assert_eq!(form_of(&path), "png");
}

#[test]
fn the_systems_dialog_follows_the_ending_too() {
    let folder = tempfile::tempdir().unwrap();
    let (answer, dialogs) = scripted();
    let mut window = window(Files::new(None).with_dialogs(dialogs.clone()));
    for (name, written, form) in [("a.png", "a.png", "png"), ("b.csv", "b.csv", "csv"), ("c", "c.svg", "svg")] {
        export(&mut window, FigureForm::Svg);
        answer.send(Answer::Chosen(vec![folder.path().join(name)])).unwrap();
        let path = folder.path().join(written);
        said(&mut window, &format!("Saved {}.", path.display()));
        assert_eq!(form_of(&path), form);
    }
    let Question::Save { endings, .. } = dialogs.asked.lock().unwrap()[0].clone() else { panic!("not to save") };
    assert_eq!(endings, ["svg", "pdf", "png", "tif", "csv", "json", "tex"]);
    // The dialog has closed: the path goes on in the box, with the reason.
    export(&mut window, FigureForm::Svg);
    answer.send(Answer::Chosen(vec![folder.path().join("d.eps")])).unwrap();
    until_box(&mut window);
    assert!(says(&window, "Cannot write .eps files here") && !says(&window, "No file dialog here"));
    assert_eq!(text(&window), folder.path().join("d.eps").to_str().unwrap());
    // The dialog did not know the extension and could not ask about the existing file, so that the prompt does.
    fs::write(folder.path().join("e.svg"), "mine").unwrap();
    window.key_press(egui::Key::Escape);
    window.run_steps(2);
    export(&mut window, FigureForm::Svg);
    answer.send(Answer::Chosen(vec![folder.path().join("e")])).unwrap();
    until_box(&mut window);
    assert!(says(&window, "That file exists: e.svg"));
    assert_eq!(fs::read_to_string(folder.path().join("e.svg")).unwrap(), "mine");
}

#[test]
fn the_box_comes_for_a_missing_dialog_and_not_for_cancel() {
    let (answer, dialogs) = scripted();
    let mut window = window(Files::new(None).with_dialogs(dialogs));
    let ask = |window: &mut Window, save: bool| {
        if save {
            export(window, FigureForm::Svg);
        } else {
            window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::O);
            window.run_steps(2);
        }
    };
    for save in [false, true] {
        ask(&mut window, save);
        answer.send(Answer::Missing).unwrap();
        until_box(&mut window);
        assert!(says(&window, "No file dialog here"));
        window.key_press(egui::Key::Escape);
        window.run_steps(2);
        assert!(!has_box(&window));
        ask(&mut window, save);
        answer.send(Answer::Cancelled).unwrap();
        // Once Cancel has arrived keys are shortcuts again.
        until_shown(&mut window, "Cancel", |window| !window.state().is_asking());
        assert!(!has_box(&window));
    }
}

#[test]
fn keys_go_nowhere_while_the_box_is_on_its_way() {
    let (answer, dialogs) = scripted();
    let mut window = window(Files::new(None).with_dialogs(dialogs));
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::O);
    window.run_steps(2);
    let before = (window.state().history.document().clone(), window.state().view.saved.clone());
    let press_all = |window: &mut Window| {
        for key in [egui::Key::F, egui::Key::L, egui::Key::I, egui::Key::D, egui::Key::T, egui::Key::Num1] {
            window.key_press(key);
            window.run_steps(1);
        }
        window.event(egui::Event::Paste(LEAF.to_owned()));
        window.event(egui::Event::Text("flidt1".to_owned()));
        for key in [egui::Key::Z, egui::Key::Num2, egui::Key::K] {
            window.key_press_modifiers(egui::Modifiers::COMMAND, key);
        }
        window.run_steps(3);
    };
    press_all(&mut window);
    let now = |window: &Window| (window.state().history.document().clone(), window.state().view.saved.clone());
    assert_eq!(now(&window), before);
    let view = &window.state().view;
    assert!(view.maximized.is_none() && view.palette.is_none() && view.status.text.is_empty());
    answer.send(Answer::Missing).unwrap();
    until_box(&mut window);
    assert_eq!(text(&window), "", "what was typed before is not in it");
    // The box has the keyboard, and keeps shortcuts from the rest.
    press_all(&mut window);
    assert_eq!(now(&window), before);
    // Ctrl+Z was the field's own: it took back what was typed there.
    type_path(&mut window, "flidt1");
}

#[test]
fn escape_brings_the_box_where_a_dialog_hangs() {
    let folder = tempfile::tempdir().unwrap();
    let (answer, dialogs) = scripted();
    let mut window = window(Files::new(None).with_dialogs(dialogs));
    export(&mut window, FigureForm::Svg);
    window.key_press(egui::Key::Escape);
    window.run_steps(3);
    assert!(has_box(&window));
    type_path(&mut window, folder.path().join("x.png").to_str().unwrap());
    // The dialog fails at last: what is typed stays.
    answer.send(Answer::Missing).unwrap();
    window.run_steps(5);
    enter(&mut window);
    said(&mut window, "Saved ");
    assert_eq!(form_of(&folder.path().join("x.png")), "png");
    assert!(!has_box(&window));
}

#[test]
fn a_wrong_path_stays_to_be_mended_and_tilde_is_home() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("leaf.csv"), LEAF).unwrap();
    let mut window = window(Files::new(None).without_dialogs().with_home(Some(home.path().to_owned())));
    open_box(&mut window);
    enter(&mut window);
    assert!(says(&window, "Type a path."));
    type_path(&mut window, "~/lef.csv");
    enter(&mut window);
    assert!(says(&window, "lef.csv: no such file or directory."));
    assert_eq!(text(&window), "~/lef.csv");
    // The field still has the keyboard, at the end of the text.
    for _ in 0..6 {
        window.key_press(egui::Key::Backspace);
    }
    window.run_steps(2);
    window.event(egui::Event::Text("eaf.csv".to_owned()));
    window.run_steps(2);
    assert_eq!(text(&window), "~/leaf.csv");
    enter(&mut window);
    until(&mut window, "leaf", |app| app.history.document().own.iter().any(|set| set.name == "leaf"));
    assert!(!has_box(&window));
}

#[test]
fn tab_completes_a_path() {
    let home = tempfile::tempdir().unwrap();
    fs::create_dir(home.path().join("spectra")).unwrap();
    for name in ["leaf one.csv", "leaf two.csv"] {
        fs::write(home.path().join("spectra").join(name), LEAF).unwrap();
    }
    let mut window = window(Files::new(None).without_dialogs().with_home(Some(home.path().to_owned())));
    open_box(&mut window);
    let complete_to = |window: &mut Window, wanted: &str| {
        window.key_press(egui::Key::Tab);
        until_shown(window, wanted, |window| text(window) == wanted);
    };
    type_path(&mut window, "~/sp");
    complete_to(&mut window, "~/spectra/");
    window.event(egui::Event::Text("l".to_owned()));
    window.run_steps(2);
    assert_eq!(text(&window), "~/spectra/l", "typing goes on at the end");
    complete_to(&mut window, "~/spectra/leaf ");
    window.get_by_label("leaf one.csv");
    window.get_by_label("leaf two.csv").click();
    window.run_steps(3);
    assert_eq!(text(&window), "~/spectra/leaf two.csv");
    enter(&mut window);
    until(&mut window, "leaf two", |app| app.history.document().own.iter().any(|set| set.name == "leaf two"));
}

#[test]
fn what_fails_before_the_question_lets_keys_through_again() {
    let mut files = Files::new(None).without_dialogs();
    files.make_to_save(|| Err("It cannot be.".to_owned()));
    assert!(files.is_asking());
    let mut window = window(files);
    said(&mut window, "It cannot be.");
    assert!(!window.state().is_asking());
}

/// Files without a window, with the box open for reading.
fn asked(home: Option<&Path>) -> Files {
    let mut files = Files::new(None).without_dialogs().with_home(home.map(Path::to_owned));
    files.ask_to_open();
    files.poll();
    files
}

/// What comes of what was typed, once it is there.
fn outcome<T>(files: &mut Files, found: impl Fn(&mut Files, Vec<FileEvent>) -> Option<T>) -> T {
    waiting::until("what was typed", || {
        let events = files.poll();
        found(files, events).ok_or_else(|| "nothing".to_owned())
    })
}

#[test]
fn paths_are_completed_as_far_as_names_agree() {
    let home = tempfile::tempdir().unwrap();
    let path = home.path();
    for folder in ["spectra", "spectra/deep"] {
        fs::create_dir(path.join(folder)).unwrap();
    }
    for file in ["leaf one.csv", "leaf two.csv", ".hidden", "spectra/Älg.csv"] {
        fs::write(path.join(file), "x").unwrap();
    }
    let mut files = asked(Some(path));
    let mut complete = |text: &str| {
        let prompt = files.prompt_mut().as_mut().unwrap();
        (prompt.text, prompt.to_end) = (text.to_owned(), false);
        files.complete_prompt();
        outcome(&mut files, |files, _| {
            let prompt = files.prompt_mut().as_ref().filter(|prompt| prompt.to_end)?;
            Some((prompt.text.clone(), prompt.candidates.join("|")))
        })
    };
    let is = |text: &str, candidates: &str| (text.to_owned(), candidates.to_owned());
    assert_eq!(complete("~"), is("~/", ""));
    assert_eq!(complete("~/l"), is("~/leaf ", "leaf one.csv|leaf two.csv"));
    assert_eq!(complete("~/leaf t"), is("~/leaf two.csv", ""));
    assert_eq!(complete("~/s"), is("~/spectra/", ""));
    assert_eq!(complete("~/spectra/Ä"), is("~/spectra/Älg.csv", ""));
    assert_eq!(complete("~/spectra/"), is("~/spectra/", "deep/|Älg.csv"));
    assert_eq!(complete("~/."), is("~/.hidden", ""));
    assert_eq!(complete("~/none"), is("~/none", ""));
    let full = format!("{}/sp", path.display());
    assert_eq!(complete(&full), is(&format!("{}/spectra/", path.display()), ""));
}

#[test]
fn the_home_folder_is_written_as_a_tilde() {
    let home = Some(Path::new("/no home/me"));
    for (text, home, path) in [
        ("~", home, "/no home/me"),
        ("~/x y", home, "/no home/me/x y"),
        ("~you/x", home, "~you/x"),
        ("/a/~", home, "/a/~"),
        ("no b", home, "no b"),
        ("~/x", None, "~/x"),
    ] {
        let mut files = asked(home);
        files.prompt_mut().as_mut().unwrap().text = text.to_owned();
        files.take_prompt();
        let failure = files.prompt_mut().as_ref().unwrap().failure.clone().unwrap();
        let (of, _) = failure.split_once(": no such file").expect("it is not there");
        assert_eq!(Path::new(of), Path::new(path), "{text}");
    }
}

#[test]
fn the_ending_decides_and_its_lack_takes_the_offered_one() {
    let folder = tempfile::tempdir().unwrap();
    for inner in ["b", "in.folder"] {
        fs::create_dir(folder.path().join(inner)).unwrap();
    }
    let save = |typed: &str| {
        let mut files = Files::new(None).without_dialogs();
        let forms = ["svg", "png", "csv"].map(|ending| FileForm::of_bytes(ending, ending.into())).to_vec();
        files.ask_to_save(SaveRequest::new("", "x.svg", forms));
        files.poll();
        files.prompt_mut().as_mut().unwrap().text = folder.path().join(typed).display().to_string();
        files.take_prompt();
        outcome(&mut files, |files, events| match events.into_iter().next() {
            Some(FileEvent::Saved(saved)) => Some(Ok(saved.file.path)),
            _ => files.prompt_mut().as_ref()?.failure.clone().map(Err),
        })
    };
    for (typed, path, ending) in [
        ("a.png", "a.png", "png"),
        ("b/c.CSV", "b/c.CSV", "csv"),
        ("plain", "plain.svg", "svg"),
        ("figure 2.1", "figure 2.1.svg", "svg"),
        ("Dr. Smith", "Dr. Smith.svg", "svg"),
        ("in.folder/x", "in.folder/x.svg", "svg"),
        ("two.pdf.png", "two.pdf.png", "png"),
    ] {
        let to: PathBuf = save(typed).expect("it can be written");
        assert_eq!(to, folder.path().join(path));
        assert_eq!(fs::read_to_string(to).unwrap(), ending, "{typed}");
    }
    for typed in ["a.pdf", "b.TIFF", "c.xyz"] {
        let refused = save(typed).expect_err("it cannot be written");
        assert!(refused.contains(".svg, .png or .csv") && refused.contains(&typed[1..]), "{refused}");
    }
}
