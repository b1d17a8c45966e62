//! Queries about raw RGB that a real camera recorded.

use super::ask::{Ask, Query};
use super::shared::Shared;
use crate::camera::recorded::{Freedom, RecordedError, RecordedFit, RecordedPatch};
use crate::spectral::Sensor;

/// Patches with their spectra and recorded RGB.
pub type RecordedSet = Shared<Vec<RecordedPatch>>;

/// Fit of a camera's sensitivities to recorded values.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RecordedFitQuery {
    /// The patches.
    pub recorded: RecordedSet,
    /// The camera.
    pub sensor: Shared<Sensor>,
    /// Parameters that are fitted.
    pub freedom: Freedom,
}

impl Query for RecordedFitQuery {
    type Answer = Result<RecordedFit, RecordedError>;
    const NAME: &'static str = "recorded fit";
    const ALWAYS_COMPLETE: bool = true;

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        RecordedFit::new(&self.recorded, &self.sensor, self.freedom)
    }
}
