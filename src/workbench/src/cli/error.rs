//! Failures of commands.

use std::io;
use std::path::PathBuf;

use chromascope_core::camera::RenderingError;

use crate::scene::SceneError;

#[derive(Debug, thiserror::Error)]
pub(super) enum CliError {
    /// A name means no set.
    #[error(transparent)]
    Name(#[from] crate::catalog::names::NameError),
    /// A file could not be read.
    #[error("{}", .0)]
    File(String),
    /// Some of several files failed; each was reported.
    #[error("{failed} of {count} files failed")]
    Failed {
        /// Number.
        failed: usize,
        /// Of how many.
        count: usize,
    },
    /// The scene cannot be computed.
    #[error(transparent)]
    Scene(SceneError),
    /// Cone fundamentals with the paper's matrix.
    #[error("{0}: Eq 13 takes RGB, not cone signals; add --transform fitted")]
    Cones(String),
    /// An argument that means nothing.
    #[error("{argument}: {reason}")]
    Argument {
        /// Name of the argument.
        argument: &'static str,
        /// Reason, with the remedy.
        reason: String,
    },
    /// A color correction has no file of the kind.
    #[error(transparent)]
    Correction(#[from] crate::export::profile::CorrectionFileError),
    /// A picture could not be made into a file.
    #[error("{}: {error}", path.display())]
    Picture {
        /// Path of the file.
        path: PathBuf,
        /// Reason.
        error: crate::export::render::PictureError,
    },
    /// Nothing can be measured.
    #[error(transparent)]
    Bench(#[from] chromascope_measure::BenchError),
    /// This build has no benchmark.
    #[error("this build has no benchmark; build it with it: {} -- bench …", crate::profiler::bench::BUILD)]
    NoBench,
    /// The measurements cannot be written.
    #[error(transparent)]
    Report(#[from] chromascope_measure::ReportError),
    /// A figure cannot be drawn.
    #[error(transparent)]
    Figure(#[from] crate::export::ExportError),
    /// An output that is an input.
    #[error("{}: not overwritten because this command reads it; name another file", .0.display())]
    Input(PathBuf),
    /// An output that exists.
    #[error("{}: the file exists; name another, or add --force to replace it", .0.display())]
    Exists(PathBuf),
    /// One file for two outputs.
    #[error("{}: two outputs cannot go to one file; name another", .0.display())]
    Twice(PathBuf),
    /// The output could not be written.
    #[error("cannot write {}: {}", path.display(), crate::format::io_reason(error))]
    Output {
        /// Path of the file.
        path: PathBuf,
        /// Reason.
        error: io::Error,
    },
}

impl CliError {
    /// 2 where the arguments themselves are wrong, as for those that clap refuses; 1 where data, names or disk say no.
    pub(super) fn code(&self) -> u8 {
        if matches!(self, Self::Argument { .. }) { 2 } else { 1 }
    }
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
