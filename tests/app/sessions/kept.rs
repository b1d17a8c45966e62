//! Sessions saved beside other work, dropped on the window, and on disks that take nothing.

use std::process::Command as Process;
use std::sync::Arc;

use chromascope::command::TourMove;
use chromascope::view::tour::Tour;

use super::*;
use crate::own_data::Dropped;

/// The temperature in a session's file.
fn kelvin_in(path: &Path) -> f64 {
    json_of(path)["temperature_k"].as_f64().unwrap()
}

/// True if the document knows its file as it is.
fn knows_its_file(window: &Window, path: &Path) -> bool {
    document(window).session.is_some_and(|session| session.fingerprint == Fingerprint::of(&fs::read(path).unwrap()))
}

#[test]
fn what_is_written_during_the_tour_is_the_users_document() {
    let (_around, folder) = folder();
    let path = folder.join("a.chromascope");
    let mut window = window(&folder.join("profile"));
    save_as(&mut window, &path);
    saved(&mut window);
    push(&mut window, temperature(3000.0));
    // One write is under way, another is to follow it.
    window.state_mut().push(SessionCommand::Save);
    window.state_mut().push(temperature(3100.0));
    window.state_mut().push(SessionCommand::Save);
    push(&mut window, Command::Tour(TourMove::Begin(Tour::Paper)));
    until(&mut window, "the second write", |app| app.title() == "a – Chromascope");
    assert_eq!((window.state().view.tour, kelvin_in(&path)), (Some((Tour::Paper, 0)), 3100.0));
    push(&mut window, Command::Tour(TourMove::End));
    assert!(document(&window).temperature_k == 3100.0 && knows_its_file(&window, &path));
    // So is what is saved under a name that was asked for before it.
    let other = folder.join("b.chromascope");
    window.state_mut().push(SessionCommand::SaveAs);
    push(&mut window, Command::Tour(TourMove::Begin(Tour::Paper)));
    answer(&mut window, &other);
    saved(&mut window);
    assert_eq!(window.state().view.tour, Some((Tour::Paper, 0)));
    push(&mut window, Command::Tour(TourMove::End));
    assert_eq!((window.state().title(), kelvin_in(&other)), ("b – Chromascope", 3100.0));
}

#[test]
fn a_question_about_one_session_does_not_outlast_it() {
    let (_around, folder) = folder();
    let [path, other] = ["a.chromascope", "b.chromascope"].map(|name| folder.join(name));
    let text = |kelvin: f64| {
        let document = Document { temperature_k: kelvin, ..Document::paper() };
        session::to_session(&document, &SavedView::default()).unwrap()
    };
    fs::write(&path, text(3000.0)).unwrap();
    fs::write(&other, text(4000.0)).unwrap();
    let mut window = window(&folder.join("profile"));
    open(&mut window, &path);
    fs::write(&path, text(3500.0)).unwrap();
    push(&mut window, temperature(3100.0));
    push(&mut window, SessionCommand::Save);
    until_asked(&mut window);
    push(&mut window, Command::OpenPath(other.clone()));
    until(&mut window, "the other", |app| app.title() == "b – Chromascope");
    window.run_steps(2);
    assert!(!says(&window, "wrote to"));
    assert_eq!((kelvin_in(&path), kelvin_in(&other)), (3500.0, 4000.0));
}

#[test]
fn a_template_of_a_name_that_is_taken_asks() {
    let (_around, folder) = folder();
    let mut window = window(&folder.join("profile"));
    let mut save = |kelvin: f64, name: &str| {
        push(&mut window, temperature(kelvin));
        push(&mut window, SessionCommand::SaveTemplate);
        window.get_by_role_and_label(Role::TextInput, "Name of the template").type_text(name);
        window.run_steps(2);
        window.key_press(egui::Key::Enter);
        window.run_steps(3);
        let (_, path) = window.state().view.templates[0].clone();
        (says(&window, "A template has this name"), kelvin_in(&path))
    };
    assert_eq!(save(3000.0, "Lamps/LED"), (false, 3000.0));
    assert_eq!(save(3100.0, "Lamps-LED "), (true, 3000.0));
    window.get_by_label("Replace").click();
    window.run_steps(3);
    let templates = &window.state().view.templates;
    assert_eq!((templates.len(), kelvin_in(&templates[0].1)), (1, 3100.0));
}

#[test]
fn a_session_dropped_on_the_window_opens() {
    let (_around, folder) = folder();
    let path = folder.join("a.chromascope");
    let there = Document { temperature_k: 3456.0, ..with_leaf() };
    fs::write(&path, session::to_session(&there, &SavedView::default()).unwrap()).unwrap();
    let mut window = window(&folder.join("profile"));
    window.input_mut().dropped_files.push(Arc::new(Dropped(path, Vec::new())));
    until(&mut window, "the session", |app| app.title() == "a – Chromascope");
    assert_eq!(contents(&document(&window)).own, there.own);
    assert_eq!(document(&window).temperature_k, 3456.0);
}

/// Runs `mount` or `umount`.
fn run(program: &str, arguments: &[&str]) {
    let done = Process::new(program).args(arguments).status().unwrap();
    assert!(done.success(), "{program} {arguments:?}");
}

/// A small file system, until it is dropped.
struct SmallDisk(PathBuf);

impl SmallDisk {
    fn remount(&self, option: &str) {
        run("mount", &["-o", &format!("remount,{option}"), self.0.to_str().unwrap()]);
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        let _gone = Process::new("umount").arg(&self.0).status();
    }
}

#[test]
#[ignore = "mounts a file system, which only root may"]
fn a_full_or_read_only_disk_is_told_and_the_work_stays() {
    let (_around, folder) = folder();
    let disk = SmallDisk(folder.join("disk"));
    fs::create_dir(&disk.0).unwrap();
    run("mount", &["-t", "tmpfs", "-o", "size=128k", "tmpfs", disk.0.to_str().unwrap()]);
    let path = disk.0.join("a.chromascope");
    let mut window = window(&folder.join("profile"));
    push(&mut window, temperature(3000.0));
    save_as(&mut window, &path);
    saved(&mut window);
    let before = fs::read(&path).unwrap();
    let fails = |window: &mut Window, reason: &str| {
        push(window, SessionCommand::Save);
        until(window, "the failure", |app| app.view.status.weight == Weight::Error);
        let said = window.state().view.status.text.clone();
        assert!(said.contains(reason) && said.contains("Your work is safe in this window; File, Save as"), "{said}");
        assert_eq!((document(window).temperature_k, window.state().title()), (3100.0, "*a – Chromascope"));
        assert_eq!(fs::read(&path).unwrap(), before, "the file is as it was");
        assert_eq!(fs::read_dir(&disk.0).unwrap().flatten().count(), 2, "no half of a file");
    };
    let filling = disk.0.join("filling");
    let _full = fs::write(&filling, vec![0; 1 << 20]);
    push(&mut window, temperature(3100.0));
    fails(&mut window, "no space left");
    disk.remount("ro");
    fails(&mut window, "read-only file system");
    disk.remount("rw");
    fs::remove_file(&filling).unwrap();
    push(&mut window, SessionCommand::Save);
    saved(&mut window);
    assert_eq!(kelvin_in(&path), 3100.0);
}
