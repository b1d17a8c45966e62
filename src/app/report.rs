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
        let Some((on, parent)) = self.report_on.take().zip(chosen.first()) else { return };
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
        self.later.begin(Report::NAME, ReportJob::all(&Arc::new(report), &folder));
    }

    /// Says when a report is finished, or why it is not.
    pub(super) fn take_report(&mut self) {
        let report = self.later.seen::<ReportJob>(Report::NAME);
        let Some(folder) = report.stages.first().map(|job| job.folder.clone()) else { return };
        let is_finished = report.done == report.stages.len();
        if let Err(why) = report.current().and_then(|made| made.map_or(Ok(()), |made| (*made).clone())) {
            self.later.stop::<ReportJob>(Report::NAME);
            self.view.fail(format!("The report is not finished. {why}"));
        } else if is_finished {
            self.later.stop::<ReportJob>(Report::NAME);
            self.view.say(format!("Report saved: {}.", folder.join(PAGE).display()));
        }
    }

    /// Stops the report that is being made, if there is one.
    pub(super) fn stop_report(&mut self) -> bool {
        let report = self.later.seen::<ReportJob>(Report::NAME);
        let Some(job) = report.stages.first() else { return false };
        self.later.stop::<ReportJob>(Report::NAME);
        let (done, all, folder) = (report.done, report.stages.len(), job.folder.display());
        self.view.say(format!("Report stopped after {done} of {all} steps; these are in {folder}."));
        true
    }
}
