//! The system's file dialogs, and telling one that was cancelled from one that was never there.

use std::cell::Cell;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::catalog::chart_picture::pictures;
use crate::catalog::meshes::ENDINGS as MESH_ENDINGS;
use crate::catalog::spectral_images::ENDINGS as IMAGE_ENDINGS;
use crate::document::session;

/// A dialog that closes within this time without an answer was never seen by the user.
const NO_DIALOG: Duration = Duration::from_millis(300);
const ENDINGS: [&str; 30] = [
    "csv", "txt", "tsv", "dat", "asc", "prn", "trm", "ssm", "abs", "irr", "spectrum", "ttt", "trt", "tat", "jaz",
    "dta", "dpt", "sp", "cmf", "ccss", "ti3", "cgats", "jdx", "dx", "jcm", "spdx", "cxf", "xml", "json", "xls",
];

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Question {
    Files,
    Folder {
        title: &'static str,
    },
    Save {
        title: String,
        name: String,
        /// The endings of the forms it can be saved in.
        endings: Vec<&'static str>,
    },
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    Chosen(Vec<PathBuf>),
    Cancelled,
    Missing,
}

/// File dialogs. They run on their own thread and may take any time.
pub trait Dialogs: Send + Sync {
    fn ask(&self, question: &Question) -> Answer;
}

pub(super) struct System;

impl Dialogs for System {
    fn ask(&self, question: &Question) -> Answer {
        let start = Instant::now();
        FAILED.set(false);
        let chosen = match question {
            Question::Files => rfd::FileDialog::new()
                .set_title("Open a session, spectra, camera sensitivities, a mesh or a spectral image")
                .add_filter(
                    "Sessions, spectra, meshes and images",
                    &[&[session::ENDING][..], &ENDINGS, &MESH_ENDINGS, &IMAGE_ENDINGS].concat(),
                )
                .add_filter("Chromascope sessions", &[session::ENDING])
                .add_filter("Text and CSV", &ENDINGS)
                .add_filter("Meshes", &MESH_ENDINGS)
                .add_filter("Spectral images", &IMAGE_ENDINGS)
                .add_filter("Pictures of charts", &pictures().collect::<Vec<_>>())
                .add_filter("All files", &["*"])
                .pick_files(),
            Question::Folder { title } => {
                rfd::FileDialog::new().set_title(*title).pick_folder().map(|folder| vec![folder])
            }
            Question::Save { title, name, endings } => {
                let dialog = rfd::FileDialog::new().set_title(title).set_file_name(name);
                let dialog = endings.iter().fold(dialog, |dialog, ending| dialog.add_filter(*ending, &[*ending]));
                dialog.save_file().map(|path| vec![path])
            }
        };
        match chosen {
            Some(paths) if !paths.is_empty() => Answer::Chosen(paths),
            _ if FAILED.get() || start.elapsed() < NO_DIALOG => Answer::Missing,
            _ => Answer::Cancelled,
        }
    }
}

thread_local! {
    /// True if this thread's dialog failed. The library says so in its log alone: to its caller a missing dialog looks
    /// like Cancel.
    static FAILED: Cell<bool> = const { Cell::new(false) };
}

/// A logger that hears of dialogs that fail, and passes everything on.
pub struct DialogLog<L>(L);

impl<L: log::Log> DialogLog<L> {
    pub fn new(logger: L) -> Self {
        Self(logger)
    }
}

impl<L: log::Log> log::Log for DialogLog<L> {
    fn enabled(&self, metadata: &log::Metadata<'_>) -> bool {
        is_of_dialogs(metadata) || self.0.enabled(metadata)
    }

    fn log(&self, record: &log::Record<'_>) {
        // A portal that fails is followed by zenity; only when that fails too there is no dialog.
        if is_of_dialogs(record.metadata()) && record.args().to_string().contains("with zenity") {
            FAILED.set(true);
        }
        if self.0.enabled(record.metadata()) {
            self.0.log(record);
        }
    }

    fn flush(&self) {
        self.0.flush();
    }
}

fn is_of_dialogs(metadata: &log::Metadata<'_>) -> bool {
    metadata.level() == log::Level::Error && metadata.target().starts_with("rfd")
}

#[cfg(test)]
mod tests {
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
}
