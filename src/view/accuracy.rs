//! What is looked at in Accuracy.

use std::sync::Arc;

use crate::laboratory::{SceneRun, Subject};

/// What is looked at in Accuracy.
#[derive(Clone, Debug, Default)]
pub struct AccuracyView {
    /// The kind of work whose methods are on show.
    pub subject: Subject,
    /// The last run.
    pub run: Option<Arc<SceneRun>>,
    /// Whether it is of the scene as it is now.
    pub is_current: bool,
}
