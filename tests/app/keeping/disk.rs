//! Keeping the document on disks that lose files, hold links, or refuse.

use std::os::unix::fs::symlink;
use std::time::SystemTime;

use chromascope::atomic::write_atomically_with;

use super::*;

/// Makes a file that was written so long after 1970.
pub(super) fn written_at(path: &Path, since: Duration) -> fs::File {
    fs::write(path, "half").unwrap();
    let file = fs::OpenOptions::new().read(true).write(true).open(path).unwrap();
    file.set_modified(SystemTime::UNIX_EPOCH + since).unwrap();
    file
}

#[test]
fn a_document_saved_in_part_is_not_as_the_one_before_it() {
    let (_around, folder) = profile();
    let executor = Executor::driven();
    let mut files = Files::on(&executor, Some(folder.clone()));
    let before = files.saved_document();
    files.save_document(&before).unwrap();
    fs::write(folder.join("curves"), "").unwrap();
    let mut document = Document { temperature_k: 4321.0, ..before.clone() };
    crate::import_sets(vec![set("leaf")]).apply(&mut document);
    files.save_document(&document).unwrap_err();
    // Undone, while the disk has the other temperature.
    files.autosave(&before, &egui::Context::default());
    assert!(!files.is_saved());
    files.save_document(&before).unwrap();
    drop(files);
    assert_eq!(saved_document(&folder), before);
}

#[test]
fn curves_that_vanished_are_written_again_from_memory() {
    let (_around, folder) = profile();
    let document = with_sets(vec![set("leaf")]);
    let mut files = open(&folder);
    files.saved_document();
    files.save_document(&document).unwrap();
    fs::remove_dir_all(folder.join("curves")).unwrap();
    let changed = Document { temperature_k: 4321.0, ..document };
    files.save_document(&changed).unwrap();
    drop(files);
    assert_eq!(saved_document(&folder), changed);
}

#[test]
fn a_copy_whose_lock_cannot_be_opened_is_left_alone() {
    let (_around, folder) = profile();
    let copy = folder.join("document-99.json");
    fs::write(&copy, session::to_json(&of(3000.0)).unwrap()).unwrap();
    let files = open(&folder);
    assert_eq!(files.other_documents().len(), 1);
    // A folder cannot be opened for writing.
    fs::create_dir(copy.with_extension("lock")).unwrap();
    assert_eq!(files.other_documents(), []);
    files.remove_document(&copy);
    assert!(copy.exists());
}

#[test]
fn what_a_link_leads_to_is_written_and_the_link_stays() {
    let (around, folder) = profile();
    let real = around.path().join("real.json");
    let link = folder.join("document.json");
    fs::write(&real, session::to_json(&of(3000.0)).unwrap()).unwrap();
    symlink(&real, &link).unwrap();
    let mut files = open(&folder);
    assert_eq!(files.saved_document(), of(3000.0));
    files.save_document(&of(4000.0)).unwrap();
    drop(files);
    assert_eq!(fs::read_link(&link).unwrap(), real);
    assert_eq!(session::from_json(&fs::read_to_string(&real).unwrap()).unwrap(), of(4000.0));
    // Where it leads nowhere, as while a disk is away, that is said and the link is kept.
    fs::remove_file(&real).unwrap();
    let mut files = open(&folder);
    assert_eq!(files.saved_document(), Document::default());
    assert!(words(&files, PersistentMessageKind::SetAside).is_some());
    assert_eq!(fs::read_link(folder.join("document-unreadable-1.json")).unwrap(), real);
}

#[test]
fn a_document_that_cannot_be_looked_at_is_not_overwritten() {
    let (_around, folder) = profile();
    let mut files = open(&folder);
    files.saved_document();
    // A link to itself is there, but cannot be read.
    symlink("document.json", folder.join("document.json")).unwrap();
    files.save_document(&of(4000.0)).unwrap_err();
    assert!(fs::read_link(folder.join("document.json")).is_ok());
}

#[test]
fn a_file_whose_name_is_removed_while_it_is_written_is_written_once_more() {
    let (_around, folder) = profile();
    let path = folder.join("export.csv");
    write_atomically_with(&path, |file| {
        for name in names(&folder) {
            fs::remove_file(folder.join(name))?;
        }
        file.write_all(b"nm,leaf\n")
    })
    .unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "nm,leaf\n");
    assert_eq!(names(&folder), ["export.csv"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_device_is_written_itself_and_stays() {
    let (_around, folder) = profile();
    let path = folder.join("figure.svg");
    symlink("/dev/full", &path).unwrap();
    let failure = write_atomically_with(&path, |file| file.write_all(b"<svg/>")).unwrap_err();
    assert_eq!(failure.kind(), std::io::ErrorKind::StorageFull);
    assert!(!fs::metadata("/dev/full").unwrap().is_file());
}

#[test]
fn where_the_document_moved_to_is_told_although_that_failed_at_first() {
    let (_around, folder) = profile();
    let mut files = open(&folder);
    files.saved_document();
    let mut document = with_sets(vec![set("leaf")]);
    // A document of an earlier form is not written while its curves cannot be.
    let mut json: serde_json::Value = serde_json::from_str(&session::to_json(&document).unwrap()).unwrap();
    json["version"] = 2.into();
    drop(files);
    fs::write(folder.join("document.json"), json.to_string()).unwrap();
    files = open(&folder);
    document = Document { temperature_k: 4321.0, ..files.saved_document() };
    fs::write(folder.join("curves"), "").unwrap();
    fs::write(folder.join("document.json"), session::to_json(&of(3000.0)).unwrap()).unwrap();
    files.save_document(&document).unwrap_err();
    fs::remove_file(folder.join("curves")).unwrap();
    files.save_document(&document).unwrap();
    assert!(words(&files, PersistentMessageKind::Moved).is_some());
}

#[test]
fn what_changes_while_a_document_is_saved_elsewhere_is_asked_about_again() {
    let (around, folder) = profile();
    let (_executor, mut window) = window(&folder);
    let away = vanish(&folder);
    change(&mut window, 3456.0);
    assert!(close(&mut window));
    window.run_steps(2);
    assert!(!click(&mut window, "Save elsewhere…"));
    until("the question where to", || {
        window.run_steps(1);
        if says(&window, "Save the document") { Ok(()) } else { Err("it is not asked".to_owned()) }
    });
    window.run_steps(2);
    change(&mut window, 4567.0);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(1);
    let path = around.path().join("saved.chromascope");
    window.get_by_role_and_label(Role::TextInput, "Path").type_text(path.to_str().unwrap());
    window.run_steps(1);
    window.key_press(egui::Key::Enter);
    until("the question", || {
        window.step();
        assert!(!sent(&window, &ViewportCommand::Close), "the change is not saved");
        if says(&window, QUESTION) { Ok(()) } else { Err("it is not asked".to_owned()) }
    });
    come_back(&folder, &away);
}

#[test]
fn a_document_that_the_system_does_not_give_is_set_aside_too() {
    let (_around, folder) = profile();
    // As without the permission, reading fails.
    fs::create_dir(folder.join("document.json")).unwrap();
    let mut files = open(&folder);
    assert_eq!(files.saved_document(), Document::default());
    assert!(words(&files, PersistentMessageKind::SetAside).is_some());
    assert!(folder.join("document-unreadable-1.json").is_dir());
    files.save_document(&of(3000.0)).unwrap();
    drop(files);
    assert_eq!(saved_document(&folder), of(3000.0));
}

#[test]
fn a_window_that_goes_without_closing_saves() {
    let (_around, folder) = profile();
    let (executor, mut window) = window(&folder);
    change(&mut window, 3456.0);
    assert!(executor.queued().contains(&"keep".to_owned()), "nothing is written yet");
    drop(window);
    assert_eq!(saved_document(&folder).temperature_k, 3456.0);
}
