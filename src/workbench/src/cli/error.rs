//! Failures of commands.

use std::io;
use std::path::PathBuf;

use chromascope_core::camera::RenderingError;
use spectral_file::ReadError;

use crate::scene::SceneError;

pub(super) type Result<T, E = CliError> = std::result::Result<T, E>;

#[derive(Debug, thiserror::Error)]
pub(super) enum CliError {
    #[error(transparent)]
    Name(#[from] crate::catalog::names::NameError),
    #[error("{}", .0)]
    File(String),
    /// A file of another kind than spectra.
    #[error("{}", .0)]
    NoSpectra(String),
    #[error("{failed} of {count} files failed")]
    Failed { failed: usize, count: usize },
    #[error(transparent)]
    Scene(SceneError),
    /// Cone fundamentals with the paper's matrix.
    #[error("{0}: Eq 13 takes RGB, not cone signals; add --transform fitted")]
    Cones(String),
    #[error("{argument}: {reason}")]
    Argument { argument: &'static str, reason: String },
    #[error(transparent)]
    Correction(#[from] crate::export::profile::CorrectionFileError),
    #[error("{}: {error}", path.display())]
    Picture { path: PathBuf, error: crate::export::render::PictureError },
    #[error(transparent)]
    Bench(#[from] chromascope_measure::BenchError),
    #[error("this build has no benchmark; build it with it: {} -- bench …", crate::profiler::BUILD)]
    NoBench,
    #[error(transparent)]
    Report(#[from] chromascope_measure::ReportError),
    #[error(transparent)]
    Figure(#[from] crate::export::ExportError),
    #[error("{}: not overwritten because this command reads it; name another file", .0.display())]
    Input(PathBuf),
    #[error("{}: the file exists; name another, or add --force to replace it", .0.display())]
    Exists(PathBuf),
    #[error("{}: two outputs cannot go to one file; name another", .0.display())]
    Twice(PathBuf),
    #[error("cannot write {}: {}", path.display(), crate::format::io_reason(error))]
    Output { path: PathBuf, error: io::Error },
}

impl CliError {
    /// 2 where the arguments themselves are wrong, as for those that clap refuses; 1 where data, names or disk say no.
    pub(super) fn code(&self) -> u8 {
        if matches!(self, Self::Argument { .. }) { 2 } else { 1 }
    }

    /// Refusal of a file that could not be read, as a sentence with its name.
    pub(super) fn unread(sentence: String, error: &ReadError) -> Self {
        if error.is_of_no_spectra() { Self::NoSpectra(sentence) } else { Self::File(sentence) }
    }
}

/// Refuses an argument.
pub(super) fn refused<T>(argument: &'static str, reason: impl Into<String>) -> Result<T> {
    Err(CliError::Argument { argument, reason: reason.into() })
}

impl From<SceneError> for CliError {
    /// The scene's remedies are the window's; the one that is called otherwise here is put in this one's words.
    fn from(error: SceneError) -> Self {
        match error {
            SceneError::Rendering { name, error: RenderingError::ConesNeedObserver } => Self::Cones(name),
            other => Self::Scene(other),
        }
    }
}
