//! Keeping the document beside other windows, and after windows that ended.

use chromascope::atomic::write_atomically;

use super::*;

#[test]
fn two_windows_lose_nothing_in_any_order_of_closing() {
    for first_closes_first in [true, false] {
        let (_around, folder) = profile();
        let mut first = open(&folder);
        first.saved_document();
        let mut second = open(&folder);
        second.saved_document();
        let with_leaf = with_sets(vec![set("leaf")]);
        second.save_document(&with_leaf).unwrap();
        first.save_document(&of(3000.0)).unwrap();
        if first_closes_first {
            drop(first);
            // A third window takes the profile while the second one is open: its curves stay.
            assert_eq!(saved_document(&folder), of(3000.0));
            assert!(open(&folder).other_documents().is_empty(), "its window is open");
            drop(second);
        } else {
            drop(second);
            drop(first);
        }
        let mut next = open(&folder);
        assert_eq!(next.saved_document(), of(3000.0));
        let copies = next.other_documents();
        assert_eq!(copies.len(), 1);
        drop(next);
        let (executor, mut window) = window(&folder);
        assert!(says(&window, "A document of another window was recovered"));
        window.state_mut().push(Command::OpenDocument(copies[0].0.clone()));
        opens(&executor, &mut window, &with_leaf);
        // The document before it is kept as well, and undo brings it back.
        assert_eq!(window.state().view.other_documents.len(), 2);
        window.state_mut().push(Command::Undo);
        window.run_steps(2);
        assert_eq!(*window.state().history.document(), of(3000.0));
        window.state_mut().push(Command::Redo);
        window.run_steps(2);
        window.state_mut().push(Command::RemoveDocument(copies[0].0.clone()));
        window.run_steps(2);
        assert_eq!(window.state().view.other_documents.len(), 1);
        drop(window);
        assert_eq!(saved_document(&folder), with_leaf);
    }
}

#[test]
fn a_document_that_another_program_writes_is_not_overwritten() {
    let (_around, folder) = profile();
    let mut files = open(&folder);
    files.saved_document();
    files.save_document(&of(3000.0)).unwrap();
    // As on a folder without locks, from another machine.
    let theirs = session::to_json(&of(4000.0)).unwrap();
    fs::write(folder.join("document.json"), &theirs).unwrap();
    files.save_document(&of(5000.0)).unwrap();
    files.save_document(&of(6000.0)).unwrap();
    assert_eq!(fs::read_to_string(folder.join("document.json")).unwrap(), theirs);
    let moved = files.standing().into_iter().find(|standing| standing.kind == PersistentMessageKind::Moved).unwrap();
    assert_eq!(files.other_documents(), [], "it is this window's own");
    files.remove_document(&moved.file.clone().unwrap());
    assert!(moved.file.clone().unwrap().exists() && moved.file.unwrap().with_extension("lock").exists());
    drop(files);
    let mut next = open(&folder);
    assert_eq!(next.saved_document(), of(4000.0));
    let copies = next.other_documents();
    assert_eq!(copies.len(), 1);
    // And what it moved to is no copy while it is open.
    next.remove_document(&folder.join("document.json"));
    assert_eq!(fs::read_to_string(folder.join("document.json")).unwrap(), theirs);
    assert_eq!(session::from_json(&fs::read_to_string(&copies[0].0).unwrap()).unwrap(), of(6000.0));
}

// ---- Temporary files and the layout ----

#[test]
fn what_a_killed_process_was_writing_is_removed() {
    let (_around, folder) = profile();
    fs::create_dir(folder.join("curves")).unwrap();
    let others = [".chromascope-notes.txt", "unlike.chromascope-x"];
    for name in [".chromascope-a1B2c3", "curves/.chromascope-d4E5f6", others[0], others[1]] {
        disk::written_at(&folder.join(name), Duration::ZERO);
    }
    disk::written_at(&folder.join(".chromascope-n3w000"), Duration::from_hours(1_000_000));
    let held = disk::written_at(&folder.join(".chromascope-held00"), Duration::ZERO);
    held.try_lock().unwrap();
    let files = open(&folder);
    let left = [".chromascope-held00", others[0], "curves", others[1], "window.lock"];
    assert_eq!(names(&folder), left);
    // Where something is exported, nothing is removed.
    let (_elsewhere, exports) = profile();
    disk::written_at(&exports.join(".chromascope-a1B2c3"), Duration::ZERO);
    write_atomically(&exports.join("export.csv"), b"nm").unwrap();
    assert_eq!(names(&exports), [".chromascope-a1B2c3", "export.csv"]);
    assert!(names(&folder.join("curves")).is_empty());
    drop((files, held));
}

#[test]
fn the_layout_is_the_first_windows_and_written_whole() {
    struct Refuses;
    impl eframe::Storage for Refuses {
        fn get_string(&self, _: &str) -> Option<String> {
            None
        }
        fn set_string(&mut self, key: &str, _: String) {
            panic!("eframe would write {key} in place");
        }
        fn remove_string(&mut self, _: &str) {}
        fn flush(&mut self) {}
    }
    let (_around, folder) = profile();
    let layout = || fs::read_to_string(folder.join("app.ron"));
    let (_executor, mut first) = window(&folder);
    let (_also, mut second) = window(&folder);
    eframe::App::save(second.state_mut(), &mut Refuses);
    eframe::App::on_exit(second.state_mut(), None);
    assert!(layout().is_err(), "the layout is the first one's");
    eframe::App::save(first.state_mut(), &mut Refuses);
    assert!(!eframe::App::persist_egui_memory(first.state()));
    eframe::App::on_exit(first.state_mut(), None);
    // As eframe reads it.
    let values: std::collections::HashMap<String, String> = ron::from_str(&layout().unwrap()).unwrap();
    let saved: SavedView = serde_json::from_str(&values["layout"]).unwrap();
    assert_eq!(saved, first.state().saved_view());
    assert!(values.contains_key("egui"));
}

#[test]
fn the_lock_of_a_window_that_ended_is_taken_over() {
    let (_around, folder) = profile();
    let copy = |files: &Files| files.copy().map(|(_, file)| file);
    // Remains of a killed process: a file without a lock.
    fs::write(folder.join("window.lock"), "4711").unwrap();
    let first = open(&folder);
    assert_eq!(copy(&first), None);
    assert_eq!(fs::read_to_string(folder.join("window.lock")).unwrap(), std::process::id().to_string());
    let second = open(&folder);
    let (words, _) = second.copy().expect("another window has the folder");
    assert!(words.contains(&format!("(process {})", std::process::id())), "{words}");
    let third = open(&folder);
    assert!(copy(&third).is_some() && copy(&third) != copy(&second));
    assert_ne!(copy(&second), Some(folder.join("document.json")));
    drop(first);
    assert_eq!(copy(&open(&folder)), None);
}

#[test]
fn only_documents_of_windows_that_ended_are_copies() {
    let (_around, folder) = profile();
    let (first, second) = (open(&folder), open(&folder));
    let (_, copy) = second.copy().expect("it has a copy");
    fs::write(&copy, "{}").unwrap();
    assert_eq!(first.other_documents(), [], "its window is open");
    drop(second);
    assert_eq!(first.other_documents().into_iter().map(|(path, _)| path).collect::<Vec<_>>(), [copy]);
}
