//! Sensitivities from recorded patches of known reflectance.
//!
//! ```text
//! m_pc = g_c (b_p ∫ C_c S_p L (1 + Σ_k t_k D_k) dλ + f_c β ∫ C_c W dλ) + ε_pc
//! ```
//! m = recorded value, g = gain of a channel, b = brightness of a patch, f = veiling glare of a channel as a share of white, β = the shot's
//! mean brightness, W = radiance of the brightest patch, D = modes in which the light is uncertain, t ~ N(0, 1), ε = noise.
//! C has the library's prior, f ~ N(0.5 %, 1 %) within 0–3 %, ln b ~ N(·, τ²) with τ estimated from the same recording; C ≥ 0.
//! Gauss–Newton; the covariance is that of the linear model at the solution, without the bounds, so it is rather too wide near zero.

mod problem;

use super::curves::RecoveredCurves;
use super::prior::{Library, Prior};
use crate::camera::recorded::{Exclusion, RecordedPatch};
use crate::spectral::GridSpectrum;
use problem::{Problem, Solution};

/// Fewest patches with two usable channels.
const FEWEST: usize = 8;
/// Largest share of clipped values.
const CLIPPED: f64 = 0.25;
/// Largest residual in units of the noise.
const WORST: f64 = 2.0;
/// Least share of the curves that must be from the data.
const LEAST_SHARE: f64 = 0.1;

/// Logarithm of the odds by which something else contradicts what was named.
const CONTRADICTED: f64 = 15.0;

/// Patches of one exposure under one light.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// Patches with their radiance and recorded values.
    pub patches: Vec<RecordedPatch>,
    /// Standard deviation of each recorded value, in its unit.
    pub noise: Vec<[f64; 3]>,
    /// Relative changes of the light by one standard deviation of each way in which it is uncertain.
    pub drifts: Vec<GridSpectrum>,
}

/// Reason that no sensitivities are recovered.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum RecoveryError {
    #[error("{usable} patches with usable values; at least {FEWEST} are needed, better 24")]
    TooFew { usable: usize },
    #[error("{clipped} of {values} values are clipped; expose less")]
    Clipped { clipped: usize, values: usize },
    #[error(
        "the best curves miss the recorded values by {ratio:.1} times the noise; the light, the chart or the order of its patches is wrong, or the values are not linear"
    )]
    Fit { ratio: f64 },
    #[error("the recorded values contradict what was named: {what} is e^{by:.0} times as probable")]
    Contradicted { what: String, by: f64 },
    #[error(
        "the recorded values narrow the library's prior by {share:.0} % only: they say too little about this camera"
    )]
    Uninformative { share: f64 },
    #[error("the library has no table, or its tables do not make a covariance")]
    NoPrior,
}

/// Sensitivities recovered from charts.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartRecovery {
    /// The curves.
    pub curves: RecoveredCurves,
    /// Brightness of each patch of each shot, with a geometric mean of 1 in a shot.
    pub brightness: Vec<Vec<f64>>,
    /// Estimated spread τ of the logarithm of brightness.
    pub unevenness: f64,
    /// Veiling glare of each channel as a share of the brightest patch.
    pub glare: [f64; 3],
    /// Coefficients t of the lights' modes, with their standard deviations, shot after shot.
    pub light: Vec<[f64; 2]>,
    /// Recorded over modeled, less 1, of each shot, patch and channel; none for values that are not used.
    pub residuals: Vec<Vec<[Option<f64>; 3]>>,
    /// Root of χ² by the degrees of freedom: residuals in units of the noise.
    pub noise_ratio: f64,
    /// Logarithm of the posterior density at the solution, up to a constant of the recording.
    pub log_posterior: f64,
}

impl ChartRecovery {
    /// Recovers curves from shots of one camera, with the tables of a library as prior.
    ///
    /// Without the camera's maker in the library, with noise of 1 % and even light, a channel's median error is 7.3 % under D65 (4.5 % with
    /// other cameras of the maker); brightnesses that differ cost 1 %. See `tests/core/recovery.rs`.
    ///
    /// # Errors
    /// [`RecoveryError`] with the reason.
    pub fn new(library: &Library, shots: &[Shot]) -> Result<Self, RecoveryError> {
        let recovery = Self::unchecked(library, shots)?;
        if recovery.noise_ratio > WORST {
            return Err(RecoveryError::Fit { ratio: recovery.noise_ratio });
        }
        // The share of what matters to color: weighted by the curves themselves.
        let pairs = recovery.curves.values.iter().flatten().zip(recovery.curves.data_share.iter().flatten());
        let (sum, total) = pairs.fold((0.0, 0.0), |(sum, total), (value, share)| (sum + value * share, total + value));
        if sum < LEAST_SHARE * total {
            return Err(RecoveryError::Uninformative { share: 100.0 * sum / total });
        }
        Ok(recovery)
    }

    /// [`Self::new`], unless one of the others is more probable by e¹⁵: the same values under another light, or of another chart.
    ///
    /// # Errors
    /// [`RecoveryError`] with the reason.
    pub fn against<'a>(
        library: &Library,
        shots: &[Shot],
        others: impl IntoIterator<Item = (String, &'a [Shot])>,
    ) -> Result<Self, RecoveryError> {
        let own = Self::unchecked(library, shots)?.log_posterior;
        let density = |shots| Self::unchecked(library, shots).map_or(f64::NEG_INFINITY, |other| other.log_posterior);
        let others = others.into_iter().map(|(what, shots)| (what, density(shots) - own));
        match others.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, by)| *by > CONTRADICTED) {
            Some((what, by)) => Err(RecoveryError::Contradicted { what, by }),
            None => Self::new(library, shots),
        }
    }

    /// Recovers under daylight of unknown temperature: `at` gives the shots under daylight of a reciprocal temperature in mireds, with
    /// [`drifts`](Shot::drifts) of its uncertainty. The temperature with the largest posterior density is returned too.
    ///
    /// # Errors
    /// [`RecoveryError`] with the reason.
    pub fn under_daylight(library: &Library, at: impl Fn(f64) -> Vec<Shot>) -> Result<(Self, f64), RecoveryError> {
        let mut best: Option<(Self, f64)> = None;
        for mired in (0..8).map(|step| 90.0 + 20.0 * f64::from(step)) {
            let found = Self::unchecked(library, &at(mired))?;
            if best.as_ref().is_none_or(|(best, _)| found.log_posterior > best.log_posterior) {
                best = Some((found, mired));
            }
        }
        let (_, mired) = best.ok_or(RecoveryError::NoPrior)?;
        Ok((Self::new(library, &at(mired))?, mired))
    }

    fn unchecked(library: &Library, shots: &[Shot]) -> Result<Self, RecoveryError> {
        check(shots)?;
        let patches: Vec<_> = shots.iter().map(|shot| &*shot.patches).collect();
        let misfits = library.misfits(&patches);
        let prior = library.prior(&misfits);
        let problem = Problem::new(library.wavelengths_nm(), shots);
        let solution = problem.solve(&prior).ok_or(RecoveryError::NoPrior)?;
        Ok(finished(library, &prior, &problem, &solution))
    }

    /// Values that the recovered curves predict of a radiance, up to a common factor.
    pub fn signals(&self, radiance: &GridSpectrum) -> [f64; 3] {
        self.curves.sensor().map_or([0.0; 3], |sensor| sensor.integrate(radiance.values()))
    }
}

fn check(shots: &[Shot]) -> Result<(), RecoveryError> {
    let all = || shots.iter().flat_map(|shot| &shot.patches);
    let values = all().count() * 3;
    let clipped = all().flat_map(|patch| patch.rgb).filter(|v| v.value() == Err(Exclusion::Clipped)).count();
    if clipped as f64 > CLIPPED * values as f64 {
        return Err(RecoveryError::Clipped { clipped, values });
    }
    let usable = all().filter(|patch| patch.rgb.iter().filter(|v| v.value().is_ok()).count() > 1).count();
    if usable < FEWEST { Err(RecoveryError::TooFew { usable }) } else { Ok(()) }
}

fn finished(library: &Library, prior: &Prior, problem: &Problem, solution: &Solution) -> ChartRecovery {
    let (nm, size) = (library.wavelengths_nm(), prior.mean.len());
    let (unknowns, x) = (solution.x.len(), &solution.x);
    let curve = |c: usize| x[c * nm.len()..(c + 1) * nm.len()].to_vec();
    let covariance: Vec<f64> =
        solution.inverse.chunks(unknowns).take(size).flat_map(|row| row[..size].to_vec()).collect();
    let share = |at: usize| (1.0 - covariance[at * (size + 1)] / prior.covariance[at * (size + 1)]).clamp(0.0, 1.0);
    let share = [0, 1, 2].map(|c: usize| (c * nm.len()..(c + 1) * nm.len()).map(share).collect());
    let gains = problem.gains().map(|at| x[at].exp());
    let deviation = |at: usize| solution.inverse[at * (unknowns + 1)].max(0.0).sqrt();
    ChartRecovery {
        curves: RecoveredCurves::new(nm, &[0, 1, 2].map(curve), &covariance, gains, share),
        brightness: problem.brightness(x),
        unevenness: solution.unevenness,
        glare: problem.glare().map(|at| x[at]),
        light: problem.lights().map(|at| [x[at], deviation(at)]).collect(),
        residuals: problem.residuals(x),
        noise_ratio: solution.noise_ratio,
        log_posterior: solution.log_posterior,
    }
}
