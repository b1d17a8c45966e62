//! Dialogs that fail.

use super::*;

struct Deaf;

impl log::Log for Deaf {
    fn enabled(&self, _: &log::Metadata<'_>) -> bool {
        false
    }

    fn log(&self, _: &log::Record<'_>) {
        panic!("nothing is meant for it");
    }

    fn flush(&self) {}
}

#[test]
fn a_dialog_that_fails_is_heard_of_in_the_log() {
    let logger = DialogLog::new(Deaf);
    let say = |level, target, words: &str| {
        let record = |args| log::Record::builder().level(level).target(target).args(args).build();
        log::Log::log(&logger, &record(format_args!("{words}")));
        FAILED.replace(false)
    };
    let zenity = "Failed to save file with zenity: No such file or directory (os error 2)";
    assert!(say(log::Level::Error, "rfd::backend::xdg_desktop_portal", zenity));
    assert!(!say(log::Level::Error, "rfd::backend::xdg_desktop_portal", "SaveFile failed: no portal"));
    assert!(!say(log::Level::Error, "elsewhere", zenity));
}
