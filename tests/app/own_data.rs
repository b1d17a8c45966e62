//! The user's own files in the window: dropped, pasted, opened; kept, undone, refused.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use chromascope::app::ChromascopeApp;
use chromascope::atomic::write_atomically;
use chromascope::command::Command;
use chromascope::document::Document;
use chromascope::files::{FileEvent, Files};
use chromascope::view::Weight;
use egui_kittest::Harness;

use crate::screenshots::open;
use crate::waiting::until;

/// A file that is dropped on the window, with its bytes.
#[derive(Debug)]
pub(crate) struct Dropped(pub(crate) PathBuf, pub(crate) Vec<u8>);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Ok(self.1.clone())
    }
}

const LEAF: &str = "nm;leaf (%)\n400;5,0\n500;10,0\n600;20,0\n700;50,0\n";

/// Draws frames until something is said at the foot of the window.
fn until_said(harness: &mut Harness<'static, ChromascopeApp>) -> (String, Weight) {
    until("a word at the foot of the window", || {
        harness.run_steps(1);
        if harness.state().view.status.text.is_empty() { Err("nothing was said".to_owned()) } else { Ok(()) }
    });
    harness.run_steps(2);
    let status = &harness.state().view.status;
    (status.text.clone(), status.weight)
}

fn window() -> Harness<'static, ChromascopeApp> {
    open([1280.0, 800.0], egui::Theme::Dark)
}

#[test]
fn a_dropped_file_is_shown_and_undone() {
    let mut harness = window();
    let file = Dropped(PathBuf::from("leaf.csv"), LEAF.as_bytes().to_vec());
    harness.input_mut().dropped_files.push(Arc::new(file));
    harness.run_steps(1);
    let (text, weight) = until_said(&mut harness);
    assert!(text.starts_with("leaf.csv: 1 curve") && weight == Weight::Note, "{text}");
    assert_eq!(harness.state().history.document().own[0].name, "leaf");
    harness.state_mut().push(Command::Undo);
    harness.run();
    assert_eq!(*harness.state().history.document(), Document::paper());
}

#[test]
fn pasted_numbers_are_read_as_a_file() {
    let mut harness = window();
    harness.event(egui::Event::Paste(LEAF.to_owned()));
    harness.run_steps(1);
    until_said(&mut harness);
    let document = harness.state().history.document();
    assert_eq!(document.own.len(), 1);
    assert_eq!(document.own[0].curves_in_nm().unwrap()[0].1.values(), [0.05, 0.1, 0.2, 0.5]);
}

#[test]
fn a_file_that_cannot_be_read_changes_nothing() {
    let mut harness = window();
    let broken = "nm,leaf\n400,0.1\n410,0.2\n420,oops\n430,0.2\n440,0.2\n";
    harness.input_mut().dropped_files.push(Arc::new(Dropped(PathBuf::from("broken.csv"), broken.into())));
    harness.run_steps(1);
    let (text, weight) = until_said(&mut harness);
    assert!(text.starts_with("broken.csv, line 4") && text.ends_with("Nothing was changed."), "{text}");
    assert_eq!(weight, Weight::Error);
    assert_eq!(*harness.state().history.document(), Document::paper());
}

#[test]
fn a_missing_file_is_named() {
    let mut harness = window();
    harness.state_mut().push(Command::OpenPath(PathBuf::from("/no/such/file.csv")));
    harness.run_steps(2);
    let (text, _) = until_said(&mut harness);
    assert!(text.contains("file.csv") && text.contains("Nothing was changed."), "{text}");
}

#[test]
fn the_document_is_kept_between_runs() {
    let folder = tempfile::tempdir().unwrap();
    let document = Document { temperature_k: 3210.0, ..Document::paper() };
    let mut files = Files::new(Some(folder.path().to_owned()));
    assert_eq!(files.saved_document(), Document::default(), "there is none yet");
    files.save_document(&document).unwrap();
    assert_eq!(Files::new(Some(folder.path().to_owned())).saved_document(), document);
}

#[test]
fn what_cannot_be_read_is_set_aside_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("document.json"), "{ broken").unwrap();
    let mut files = Files::new(Some(folder.path().to_owned()));
    assert_eq!(files.saved_document(), Document::default());
    files.save_document(&Document { temperature_k: 3000.0, ..Document::paper() }).unwrap();
    assert_eq!(std::fs::read_to_string(folder.path().join("document-unreadable-1.json")).unwrap(), "{ broken");
}

#[test]
fn files_are_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("figure.svg");
    for contents in ["first", "second"] {
        write_atomically(&path, contents.as_bytes()).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), contents);
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing is left beside it");
    assert!(write_atomically(&folder.path().join("no/such/folder/x"), b"x").is_err());
}

#[test]
fn what_was_opened_before_the_first_frame_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let mut files = Files::new(Some(folder.path().to_owned()));
    let mut document = files.saved_document();
    // As a file named on the command line that is read at once.
    document.temperature_k = 4000.0;
    files.autosave(&document, &egui::Context::default());
    files.save_document(&document).unwrap();
    assert_eq!(Files::new(Some(folder.path().to_owned())).saved_document(), document);
}

/// All files of a folder with their contents, but for locks.
fn contents(folder: &Path) -> Vec<(String, String)> {
    let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
    let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    let mut files: Vec<_> = files
        .map(|path| (name(&path), std::fs::read_to_string(&path).unwrap()))
        .filter(|f| Path::new(&f.0).extension().is_none_or(|ending| ending != "lock"))
        .collect();
    files.sort();
    files
}

#[test]
fn a_second_window_keeps_a_document_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let of = |kelvin| Document { temperature_k: kelvin, ..Document::paper() };
    let open = || Files::new(Some(folder.path().to_owned()));
    let mut first = open();
    assert!(first.copy().is_none());
    first.saved_document();
    first.save_document(&of(3000.0)).unwrap();
    let kept = contents(folder.path());
    let mut second = open();
    let (words, copy) = second.copy().expect("it is the second");
    let process = std::process::id();
    let wanted = format!(
        "Another Chromascope window (process {process}) is open: changes here are saved in a copy, not in its \
         document."
    );
    assert_eq!(words, wanted);
    assert_eq!(second.saved_document(), of(3000.0), "it begins with what the first one kept");
    second.save_document(&of(3000.0)).unwrap();
    assert_eq!(contents(folder.path()), kept, "nothing was changed");
    second.save_document(&of(4000.0)).unwrap();
    first.save_document(&of(5000.0)).unwrap();
    second.save_document(&of(6000.0)).unwrap();
    assert_eq!(contents(folder.path()).len(), 2);
    drop(second);
    drop(first);
    // The copy stays where it was said to be; the next window has the first one's document and says that there is a copy.
    let mut next = open();
    assert!(next.copy().is_none());
    assert_eq!(next.saved_document(), of(5000.0));
    assert!(copy.exists());
    let said = |files: &Files| files.standing().into_iter().map(|standing| standing.words).collect::<Vec<_>>();
    assert_eq!(said(&next), ["A document of another window was recovered: File, Recovered documents."]);
    assert_eq!(
        next.other_documents().into_iter().map(|(path, _)| path).collect::<Vec<_>>(),
        std::slice::from_ref(&copy)
    );
    next.save_document(&of(7000.0)).unwrap();
    drop(next);
    let mut after = open();
    assert_eq!(after.saved_document(), of(7000.0));
    assert_eq!(said(&after).len(), 1, "said until the copy is taken away");
    let text = std::fs::read_to_string(&copy).unwrap();
    assert_eq!(chromascope::document::session::from_json(&text).unwrap(), of(6000.0));
}

#[test]
fn a_second_window_does_not_set_the_first_ones_document_aside() {
    let folder = tempfile::tempdir().unwrap();
    let mut first = Files::new(Some(folder.path().to_owned()));
    first.saved_document();
    std::fs::write(folder.path().join("document.json"), "{ broken").unwrap();
    let mut second = Files::new(Some(folder.path().to_owned()));
    assert_eq!(second.saved_document(), Document::default());
    assert_eq!(contents(folder.path()), [("document.json".to_owned(), "{ broken".to_owned())]);
}

#[test]
fn the_second_window_says_so_as_long_as_it_is_open() {
    let folder = tempfile::tempdir().unwrap();
    let _first = Files::new(Some(folder.path().to_owned()));
    let second = Files::new(Some(folder.path().to_owned()));
    for size in [[1280.0, 800.0], [900.0, 600.0]] {
        let files = Files::new(Some(folder.path().to_owned()));
        assert!(files.copy().is_some() && second.copy().is_some());
        let mut window =
            Harness::builder().with_size(size).renderer(crate::cpu_renderer::Cpu::default()).build_eframe(|cc| {
                let history = chromascope::action::history::History::new(Document::paper());
                ChromascopeApp::new(&cc.egui_ctx, history, chromascope::view::SavedView::default(), files)
            });
        window.run();
        window.state_mut().view.say("Something else.");
        window.run();
        assert!(crate::import_switches::says(&window, "is open: changes here are saved in a copy"));
    }
}

#[test]
fn the_first_run_names_its_start_and_where_the_other_is() {
    let folder = tempfile::tempdir().unwrap();
    let said = || {
        let mut files = Files::new(Some(folder.path().to_owned()));
        files.save_document(&Document::paper()).unwrap();
        files.poll()
    };
    let first = {
        let mut files = Files::new(Some(folder.path().to_owned()));
        files.saved_document();
        files.poll()
    };
    assert!(
        matches!(first.as_slice(), [FileEvent::Said(words)] if words.starts_with("Start: Colorimetry.")),
        "{first:?}"
    );
    assert!(said().is_empty());
    let mut files = Files::new(Some(folder.path().to_owned()));
    assert_eq!(files.saved_document(), Document::paper(), "the start is kept");
    assert!(files.poll().is_empty());
}
