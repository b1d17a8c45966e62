//! Color differences of patches that took no part in a recovery.

use rayon::prelude::*;

use super::chart::{ChartRecovery, RecoveryError, Shot};
use super::prior::Library;
use super::profile::{difference, fitted, samples};
use crate::camera::recorded::Signal;
use crate::correction::Correction;
use crate::spectral::Sensor;

/// Name and ΔE\*00 of each patch of the first shot, left out of all shots in turn and everything recovered again: between its recorded
/// values and those that the curves predict, both through the matrix that is fitted to these curves' values of the other patches. None
/// where a value of it is not used.
///
/// Its brightness is that which makes the sums of its channels equal; it thus is a difference of chromaticity first of all.
///
/// # Errors
/// [`RecoveryError`] of a recovery without a patch.
pub fn left_out(
    library: &Library,
    shots: &[Shot],
    observer: &Sensor,
) -> Result<Vec<(String, Option<f64>)>, RecoveryError> {
    let Some(first) = shots.first() else { return Ok(Vec::new()) };
    let one = |omitted: usize| {
        let name = &first.patches[omitted].name;
        let without = |shot: &Shot| {
            let mut shot = shot.clone();
            let own = shot.patches.iter_mut().filter(|patch| patch.name == *name);
            own.for_each(|patch| patch.rgb = [Signal::new(f64::NAN, f64::INFINITY); 3]);
            shot
        };
        let recovery = ChartRecovery::new(library, &shots.iter().map(without).collect::<Vec<_>>())?;
        let sensor = recovery.curves.sensor().map_err(|_| RecoveryError::NoPrior)?;
        let (white, all) = samples(&sensor, observer, first, &vec![1.0; first.patches.len()]);
        let others = all.iter().filter(|s| s.name != name).map(|s| (s.predicted, s.target));
        let matrix = fitted(others, &Correction::default(), white)?;
        let own = &all[omitted];
        let leveled = own.recorded.map(|rgb| rgb * (own.predicted.element_sum() / rgb.element_sum()));
        let error = leveled.and_then(|rgb| difference(matrix.xyz(own.predicted), matrix.xyz(rgb), white));
        Ok((name.clone(), error))
    };
    (0..first.patches.len()).into_par_iter().map(one).collect()
}
