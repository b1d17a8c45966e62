//! Raw RGB that a real camera recorded of known spectra, against a table of sensitivities.
//!
//! ```text
//! m_pc = g_c b_p ∫ C_c S_p L dλ        ln m_pc − ln ∫ C_c S_p L dλ = ln g_c + ln b_p + r_pc
//! ```
//! p = patch, c = channel, g = gain of a channel (relative scale of the table, white balance, exposure), b = brightness of a patch
//! (uneven illumination, shading, angle), r = residual. With the logarithm the model is linear: two-way and additive, so least squares
//! have a closed form in one 3×3 system, whatever values are omitted.

mod links;
mod two_way;

use crate::spectral::{GridSpectrum, Sensor};
pub use links::{Link, LinkKind};
pub use two_way::{Freedom, RESAMPLES, RankRange};
use two_way::{Grid, rms};

/// Reason that a value takes no part in a fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum Exclusion {
    #[error("missing")]
    Missing,
    #[error("zero or negative")]
    NotPositive,
    #[error("clipped")]
    Clipped,
    #[error("no response predicted")]
    NotPredicted,
}

/// One recorded value: a positive finite number, or the reason that it is not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Signal(Result<u64, Exclusion>);

impl Signal {
    /// Signal of a channel in any unit that is linear in light, with black at 0; values from `clip` on are [`Exclusion::Clipped`].
    pub fn new(value: f64, clip: f64) -> Self {
        Self(match value {
            v if v.is_nan() => Err(Exclusion::Missing),
            v if v >= clip => Err(Exclusion::Clipped),
            v if v < f64::MIN_POSITIVE => Err(Exclusion::NotPositive),
            v => Ok(v.to_bits()),
        })
    }

    /// The value.
    ///
    /// # Errors
    /// [`Exclusion`] where it takes no part in a fit.
    pub fn value(self) -> Result<f64, Exclusion> {
        self.0.map(f64::from_bits)
    }
}

/// One patch: its spectrum and the raw RGB that was recorded of it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RecordedPatch {
    /// Its name.
    pub name: String,
    /// Radiance `S_p L` on the grid, in any unit.
    pub radiance: GridSpectrum,
    /// Recorded red, green and blue.
    pub rgb: [Signal; 3],
}

/// Reason that a camera cannot be fitted to recorded values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum RecordedError {
    #[error(
        "{values} usable values for {parameters} fitted parameters; record more patches, or hold the gains or the brightness"
    )]
    TooFew { values: usize, parameters: usize },
}

/// Fit of one camera's sensitivities to recorded values.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedFit {
    /// Gain of each channel, with a geometric mean of 1 for the brightnesses; none for a channel without a usable value.
    pub gains: [Option<f64>; 3],
    /// Brightness of each patch; none for a patch without a usable value.
    pub brightness: Vec<Option<f64>>,
    /// `r_pc`: logarithm of recorded over modeled, or the reason that there is none.
    pub residuals: Vec<[Result<f64, Exclusion>; 3]>,
    /// Number of usable values.
    pub values: usize,
    /// Number of independent fitted parameters.
    pub parameters: usize,
    /// Single causes that would explain part of the residuals, largest share first.
    pub links: Vec<Link>,
}

impl RecordedFit {
    /// Fits the free parameters by least squares of the logarithm over all usable values, each with weight 1 (the others with 0).
    ///
    /// # Errors
    /// [`RecordedError::TooFew`] where values do not outnumber parameters.
    pub fn new(patches: &[RecordedPatch], sensor: &Sensor, freedom: Freedom) -> Result<Self, RecordedError> {
        let logs: Vec<[Result<f64, Exclusion>; 3]> = patches.iter().map(|patch| log_ratios(patch, sensor)).collect();
        let grid = Grid::new(logs.iter().map(|row| row.map(Result::ok)).collect(), freedom);
        let (values, parameters) = (grid.values(), grid.parameters());
        if values <= parameters {
            return Err(RecordedError::TooFew { values, parameters });
        }
        let fit = grid.fit();
        let residual = |(row, left): (&[Result<f64, Exclusion>; 3], &[Option<f64>; 3])| {
            [0, 1, 2].map(|c: usize| row[c].map(|_| left[c].unwrap_or(0.0)))
        };
        Ok(Self {
            gains: fit.channels.map(|log| log.map(f64::exp)),
            brightness: fit.patches.iter().map(|log| log.map(f64::exp)).collect(),
            residuals: logs.iter().zip(&fit.residuals).map(residual).collect(),
            values,
            parameters,
            links: links::links(patches, sensor, &grid, &fit.residuals),
        })
    }

    /// Root mean square of the residuals; times 100, the log error in percent.
    pub fn rms(&self) -> f64 {
        rms(self.residuals.iter().flatten().flatten().copied()).unwrap_or(0.0)
    }

    /// Estimated standard deviation of one value's logarithm: `√(Σr² / (values − parameters))`.
    pub fn deviation(&self) -> f64 {
        let freedom = (self.values - self.parameters).max(1) as f64;
        self.rms() * (self.values as f64 / freedom).sqrt()
    }

    /// Root mean square of each channel's residuals.
    pub fn channel_rms(&self) -> [Option<f64>; 3] {
        [0, 1, 2].map(|c: usize| rms(self.residuals.iter().filter_map(|row| row[c].ok())))
    }

    /// Root mean square of a patch's residuals.
    pub fn patch_rms(&self, patch: usize) -> Option<f64> {
        rms(self.residuals.get(patch)?.iter().flatten().copied())
    }

    /// Patches by the root mean square of their residuals, largest first; those without a usable value are omitted.
    pub fn worst_patches(&self) -> Vec<(usize, f64)> {
        let mut patches: Vec<_> =
            (0..self.residuals.len()).filter_map(|patch| Some((patch, self.patch_rms(patch)?))).collect();
        patches.sort_by(|a, b| b.1.total_cmp(&a.1));
        patches
    }
}

/// Rank range of each of several fits to the same patches, with the parameters of the fits.
///
/// Each resample draws as many patches as there are, with replacement, the same ones for all fits; gains and brightnesses are fitted
/// again, and the fits are ranked by RMS. Fits that tie share the better rank. One patch tells nothing: all ranks are then possible.
pub fn rank_ranges(fits: &[&RecordedFit], freedom: Freedom) -> Vec<RankRange> {
    let residuals = |fit: &&RecordedFit| fit.residuals.iter().map(|row| row.map(Result::ok)).collect();
    two_way::rank_ranges(&fits.iter().map(residuals).collect::<Vec<_>>(), freedom)
}

/// `ln m_pc − ln ∫ C_c S_p L dλ`.
fn log_ratios(patch: &RecordedPatch, sensor: &Sensor) -> [Result<f64, Exclusion>; 3] {
    let predicted = sensor.integrate(patch.radiance.values());
    [0, 1, 2].map(|c: usize| {
        let recorded = patch.rgb[c].value()?;
        if predicted[c].is_normal() && predicted[c] > 0.0 {
            Ok(recorded.ln() - predicted[c].ln())
        } else {
            Err(Exclusion::NotPredicted)
        }
    })
}
