//! Reports: a folder is chosen, the files are made in the background.

use std::path::PathBuf;
use std::sync::Arc;

use super::ChromascopeApp;
use crate::document::start::Start;
use crate::files::new_folder;
use crate::format::io_reason;
use crate::report::{PAGE, PIXELS, Report, ReportJob};
use crate::view::ReportOn;

/// Name of a report's own folder.
const FOLDER: &str = "Chromascope report";

impl ChromascopeApp {
    /// Begins a report in a folder of its own within the chosen one, so that nothing is overwritten.
    pub(super) fn begin_report(&mut self, chosen: &[PathBuf]) {
        let Some((on, parent)) = self.view.report_on.take().zip(chosen.first()) else { return };
        let folder = match new_folder(parent, FOLDER) {
            Ok(folder) => folder,
            Err(error) => {
                let why = io_reason(&error);
                return self.view.fail(format!("Cannot make a folder in {}: {why}.", parent.display()));
            }
        };
        let report = match on {
            ReportOn::Paper => Report::new(Start::Paper.document(), false, PIXELS),
            ReportOn::Document => Report::of_document(self.history.document()),
        };
        self.report.ask(ReportJob::all(&Arc::new(report), &folder));
    }

    /// Says when a report is finished, or why it is not.
    pub(super) fn take_report(&mut self) {
        let (steps, done) = self.report.progress();
        let Some(folder) = steps.first().map(|job| job.folder.clone()) else { return };
        let failure = self.report.failure().or_else(|| {
            let shown = self.report.shown().filter(|shown| shown.current)?;
            (*shown.answer).clone().err()
        });
        if let Some(why) = failure {
            self.report.rest();
            self.view.fail(format!("The report is not finished. {why}"));
        } else if done == steps.len() {
            self.report.rest();
            self.view.say(format!("Report saved: {}.", folder.join(PAGE).display()));
        }
    }

    /// Stops the report that is being made, if there is one.
    pub(super) fn stop_report(&mut self) -> bool {
        let (steps, done) = self.report.progress();
        let Some(job) = steps.first() else { return false };
        self.report.rest();
        self.view.say(format!(
            "Report stopped after {done} of {} steps; these are in {}.",
            steps.len(),
            job.folder.display()
        ));
        true
    }
}
