//! A writer that breaks.

use super::*;

#[test]
fn a_panic_while_writing_is_told_and_writing_goes_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let executor = Executor::driven();
    let mut autosave = Autosave::new(&executor, Some(folder.path().to_owned()));
    let (document, _) = autosave.load();
    autosave.shared.lock().running = true;
    let broken = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        let _told = Breakdown(&autosave.shared);
        panic!("as an error in writing");
    }));
    assert!(broken.is_err() && autosave.failure().is_some());
    let changed = Document { temperature_k: 4321.0, ..document };
    executor.advance(RETRY);
    autosave.watch(&changed, &egui::Context::default());
    executor.run_all();
    assert!(autosave.is_saved() && autosave.failure().is_none());
}
