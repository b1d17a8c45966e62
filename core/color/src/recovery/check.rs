//! Color differences of patches that took no part in a recovery.

use rayon::prelude::*;

use super::chart::{ChartRecovery, RecoveryError, Shot};
use super::prior::Library;
use super::profile::{difference, fitted, samples};
use crate::camera::recorded::Signal;
use crate::correction::Correction;
use crate::spectral::Sensor;

/// Most recoveries: of a chart with more patches, several are left out at a time.
const MOST: usize = 24;

/// Name and ΔE\*00 of each patch of the first shot, left out of all shots in turn, of more than 24 patches with every 24th after it, and
/// everything recovered again: between its recorded values and those that the curves predict, both through the matrix that is fitted to
/// these curves' values of the other patches. None where a value of it is not used.
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
    let count = first.patches.len();
    let (_, whole) = ChartRecovery::found(library, shots, None)?;
    let some = |start: usize| {
        let omitted: Vec<usize> = (start..count).step_by(MOST).collect();
        let is_omitted = |name: &str| omitted.iter().any(|at| first.patches[*at].name == *name);
        let without = |shot: &Shot| {
            let mut shot = shot.clone();
            let own = shot.patches.iter_mut().filter(|patch| is_omitted(&patch.name));
            own.for_each(|patch| patch.rgb = [Signal::new(f64::NAN, f64::INFINITY); 3]);
            shot
        };
        let recovery = ChartRecovery::near(library, &shots.iter().map(without).collect::<Vec<_>>(), &whole)?;
        let sensor = recovery.curves.sensor().map_err(|_| RecoveryError::Unsolved)?;
        let (white, all) = samples(&sensor, observer, first, &vec![1.0; first.patches.len()]);
        let others = all.iter().filter(|s| !is_omitted(s.name)).map(|s| (s.predicted, s.target));
        let matrix = fitted(others, &Correction::default(), white)?;
        let error = |at: usize| {
            let own = &all[at];
            let leveled = own.recorded.map(|rgb| rgb * (own.predicted.element_sum() / rgb.element_sum()));
            let error = leveled.and_then(|rgb| difference(matrix.xyz(own.predicted), matrix.xyz(rgb), white));
            (first.patches[at].name.clone(), error)
        };
        Ok(omitted.iter().map(|at| error(*at)).collect::<Vec<_>>())
    };
    let groups: Vec<_> = (0..count.min(MOST)).into_par_iter().map(some).collect::<Result<_, RecoveryError>>()?;
    Ok((0..count).map(|at| groups[at % MOST][at / MOST].clone()).collect())
}
