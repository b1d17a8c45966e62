//! Sensitivities from recorded patches of known reflectance.
//!
//! ```text
//! m_pc = g_c (b_p ∫ C_c S_p L (1 + Σ_k t_k D_k) dλ + f_c β ∫ C_c W dλ) + ε_pc
//! ```
//! m = recorded value, g = gain of a channel, b = brightness of a patch, f = veiling glare of a channel as a share of white, β = the shot's
//! mean brightness, W = radiance of the brightest patch, D = modes in which the light is uncertain, t ~ N(0, 1), ε = noise.
//! C has the library's prior, f ~ N(0.5 %, 1 %) within 0–3 %, ln b ~ N(a plane over the chart, τ²) with plane and τ estimated
//! from the same recording; C ≥ 0.
//! Gauss–Newton; the covariance is that of the linear model at the solution, without the bounds, so it is rather too wide near zero.

mod problem;

use rayon::prelude::*;

use super::curves::RecoveredCurves;
use super::prior::{Library, Prior};
use crate::camera::recorded::{Exclusion, RecordedPatch};
use crate::math::least_squares::FitError;
use crate::patch_set::PatchSet;
use crate::spectral::GridSpectrum;
use crate::units::{bits, hash_by};
use problem::{Problem, Solution};

/// Fewest patches with two usable channels.
const FEWEST: usize = 8;
/// Most patches of all shots: each is an unknown of equations that are solved as a whole.
const MOST: usize = 600;
/// Largest share of clipped values.
const CLIPPED: f64 = 0.25;
/// Largest residual in units of the noise.
const WORST: f64 = 2.0;
/// Least share of the curves that must be from the data.
const LEAST_SHARE: f64 = 0.1;

/// Least noise relative to what was stated: charts differ by parts that brightness and curves take up.
const LEAST_NOISE: f64 = 0.4;
/// Most adaptations of noise and prior.
const ADAPTATIONS: usize = 3;

/// Logarithm of the odds by which something else contradicts what was named.
const CONTRADICTED: f64 = 15.0;

/// Patches of one exposure under one light.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// Patches with their radiance and recorded values.
    pub patches: Vec<RecordedPatch>,
    /// Standard deviation of each recorded value, in its unit; a value with none that is positive is not used.
    pub noise: Vec<[f64; 3]>,
    /// Radiance L of a perfect diffuser.
    pub light: GridSpectrum,
    /// Patches in a row of the chart, where their places are known: the light may then have a slope over it.
    pub columns: Option<usize>,
    /// Relative changes of the light by one standard deviation of each way in which it is uncertain.
    pub drifts: Vec<GridSpectrum>,
}

hash_by!(Shot, |of| (
    &of.patches,
    of.noise.iter().map(|row| row.map(bits)).collect::<Vec<_>>(),
    &of.light,
    of.columns,
    &of.drifts
));

impl Shot {
    /// Patches under a light, in rows of so many columns, where known; the standard deviation of a value is that by the `pixels`, where
    /// known, and `relative` times the value, in quadrature.
    pub fn new(
        patches: Vec<RecordedPatch>,
        columns: Option<usize>,
        light: GridSpectrum,
        pixels: &[[f64; 3]],
        relative: f64,
    ) -> Self {
        let deviation = |patch: usize, c: usize| {
            let value = patches[patch].rgb[c].value().unwrap_or_default();
            (relative * value).hypot(pixels.get(patch).map_or(0.0, |row| row[c]))
        };
        let noise = (0..patches.len()).map(|patch| [0, 1, 2].map(|c| deviation(patch, c))).collect();
        Self { patches, noise, light, columns, drifts: Vec::new() }
    }

    /// Shot with these values, taken to be recorded under another light.
    #[must_use]
    pub fn under(&self, light: &GridSpectrum) -> Self {
        let pairs = || self.light.values().iter().zip(light.values());
        let mut ratios = pairs().map(|(own, other)| if *own > 0.0 { other / own } else { 0.0 });
        let ratio = GridSpectrum::from_fn(|_| ratios.next().unwrap_or_default());
        let mut shot = self.clone();
        shot.patches.iter_mut().for_each(|patch| patch.radiance = patch.radiance.times(&ratio));
        shot.light = light.clone();
        shot
    }

    /// Shot with these values, taken to be recorded of a chart with other reflectances, patch by patch; none with another number of patches.
    pub fn of_chart(&self, chart: &PatchSet) -> Option<Self> {
        let mut shot = self.clone();
        let patches = shot.patches.iter_mut().zip(chart.patches());
        patches.for_each(|(patch, other)| patch.radiance = other.grid.times(&self.light));
        (chart.patches().len() == self.patches.len()).then_some(shot)
    }

    /// The chart turned by 180°: the values in reverse.
    #[must_use]
    pub fn turned(&self) -> Self {
        let mut shot = self.clone();
        let values: Vec<_> = self.patches.iter().map(|patch| patch.rgb).zip(self.noise.iter().copied()).rev().collect();
        let places = shot.patches.iter_mut().zip(&mut shot.noise);
        places.zip(values).for_each(|((patch, noise), own)| (patch.rgb, *noise) = own);
        shot
    }
}

/// Reason that no sensitivities are recovered.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum RecoveryError {
    #[error("{usable} patches with usable values; at least {FEWEST} are needed, better 24")]
    TooFew { usable: usize },
    #[error("{patches} patches; at most {MOST} are computed with, so use fewer pictures or patches")]
    TooMany { patches: usize },
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
    #[error("the library has no table")]
    NoPrior,
    #[error("no curves were found for the recorded values; check them, the stated noise and the chart")]
    Unsolved,
    #[error("no matrix can be fitted to the patches: {0}")]
    Correction(#[from] FitError),
    #[error("{reason} ({picture} by itself)")]
    Picture { picture: String, reason: Box<Self> },
}

/// Sensitivities recovered from charts.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartRecovery {
    /// The curves.
    pub curves: RecoveredCurves,
    /// Brightness of each patch of each shot, with a geometric mean of 1 in a shot.
    pub brightness: Vec<Vec<f64>>,
    /// Root mean square of the logarithm of brightness.
    pub unevenness: f64,
    /// Veiling glare of each channel as a share of the brightest patch.
    pub glare: [f64; 3],
    /// Coefficients t of the lights' modes, with their standard deviations, shot after shot.
    pub light: Vec<[f64; 2]>,
    /// Recorded over modeled, less 1, of each shot, patch and channel; none for values that are not used.
    pub residuals: Vec<Vec<[Option<f64>; 3]>>,
    /// Root of χ² by the degrees of freedom: residuals in units of the noise.
    pub noise_ratio: f64,
    /// Root mean square distance of the curves from the prior's mean in its standard deviations, by what the data determine: above 1 the
    /// camera is unlike those of the library, and the prior was widened by this factor.
    pub unlikeness: f64,
    /// Logarithm of the posterior density at the solution, up to a constant of the recording.
    pub log_posterior: f64,
}

impl ChartRecovery {
    /// Recovers curves from shots of one camera, with the tables of a library as prior.
    ///
    /// Without the camera's maker in the library, with noise of 1 % and even light, a channel's median error is 6.2 to 6.9 % under D65, by the draw
    /// of the noise (4.0 to 4.5 % with other cameras of the maker); brightnesses that differ cost 1 %. See `tests/core/recovery.rs`.
    ///
    /// # Errors
    /// [`RecoveryError`] with the reason.
    pub fn new(library: &Library, shots: &[Shot]) -> Result<Self, RecoveryError> {
        Self::unchecked(library, shots)?.judged()
    }

    /// Refuses a recovery that misses its values or owes too little to them.
    fn judged(self) -> Result<Self, RecoveryError> {
        if self.noise_ratio > WORST {
            return Err(RecoveryError::Fit { ratio: self.noise_ratio });
        }
        // The share of what matters to color: weighted by the curves themselves.
        let pairs = self.curves.values.iter().flatten().zip(self.curves.data_share.iter().flatten());
        let (sum, total) = pairs.fold((0.0, 0.0), |(sum, total), (value, share)| (sum + value * share, total + value));
        if sum < LEAST_SHARE * total {
            return Err(RecoveryError::Uninformative { share: 100.0 * sum / total });
        }
        Ok(self)
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
        let own = Self::unchecked(library, shots)?;
        match own.contradiction(library, others) {
            Some((what, by)) => Err(RecoveryError::Contradicted { what, by }),
            None => own.judged(),
        }
    }

    /// Most probable of the others, if by more than e¹⁵, with the logarithm of its odds.
    pub fn contradiction<'a>(
        &self,
        library: &Library,
        others: impl IntoIterator<Item = (String, &'a [Shot])>,
    ) -> Option<(String, f64)> {
        // Where charts differ by more than the stated noise, odds by that noise are too great.
        let odds = |other: Self| (other.log_posterior - self.log_posterior) / other.noise_ratio.max(1.0).powi(2);
        let others: Vec<(String, &[Shot])> = others.into_iter().collect();
        let odds_of = |(what, shots)| Some((what, odds(Self::unchecked(library, shots).ok()?)));
        let others: Vec<(String, f64)> = others.into_par_iter().filter_map(odds_of).collect();
        others.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, by)| *by > CONTRADICTED)
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
        let (best, mired) = best.ok_or(RecoveryError::Unsolved)?;
        Ok((best.judged()?, mired))
    }

    fn unchecked(library: &Library, shots: &[Shot]) -> Result<Self, RecoveryError> {
        Ok(Self::found(library, shots, None)?.0)
    }

    /// [`Self::new`] for shots that differ little from those of a former recovery, at whose unknowns the search begins.
    pub(super) fn near(library: &Library, shots: &[Shot], former: &Adapted) -> Result<Self, RecoveryError> {
        Self::found(library, shots, Some(former))?.0.judged()
    }

    /// The recovery, unjudged, with the unknowns that it ended at.
    pub(super) fn found(
        library: &Library,
        shots: &[Shot],
        former: Option<&Adapted>,
    ) -> Result<(Self, Adapted), RecoveryError> {
        check(shots)?;
        if library.is_empty() {
            return Err(RecoveryError::NoPrior);
        }
        let patches: Vec<_> = shots.iter().map(|shot| &*shot.patches).collect();
        let misfits = library.misfits(&patches);
        let (mut prior, mut problem) = (library.prior(&misfits), Problem::new(library.wavelengths_nm(), shots));
        let [noise, unlikeness] = former.map_or([1.0; 2], |former| [former.noise, former.unlikeness]);
        problem.scale_noise(noise);
        prior.widen(unlikeness);
        let solution = problem.solve(&prior, former.map(|former| &former.solution)).ok_or(RecoveryError::Unsolved)?;
        let log_posterior = solution.log_posterior;
        let first = Adapted { solution, noise, unlikeness };
        let adapted = first.adapt(&mut problem, &mut prior).ok_or(RecoveryError::Unsolved)?;
        Ok((Self { log_posterior, ..finished(library, &prior, &problem, &adapted) }, adapted))
    }

    /// Values that the recovered curves predict of a radiance, up to a common factor.
    pub fn signals(&self, radiance: &GridSpectrum) -> [f64; 3] {
        self.curves.sensor().map_or([0.0; 3], |sensor| sensor.integrate(radiance.values()))
    }
}

/// A solution with the factors by which the noise that was stated and the prior of the library are widened.
pub(super) struct Adapted {
    solution: Solution,
    noise: f64,
    unlikeness: f64,
}

impl Adapted {
    /// Noise and prior as wide as the recording says they are: squares by the number of parameters that are determined (`MacKay` 1992,
    /// Neural Computation 4, 415); noise at least [`LEAST_NOISE`] of what was stated, the prior at least that of the library.
    fn adapt(mut self, problem: &mut Problem, prior: &mut Prior) -> Option<Self> {
        for _ in 0..ADAPTATIONS {
            let next = |former: f64, by: f64, least: f64| f64::max(least, former * by) / former;
            let noisier = next(self.noise, self.solution.noise_ratio, LEAST_NOISE);
            let wider = next(self.unlikeness, self.solution.unlikeness, 1.0);
            if f64::max(wider.ln().abs(), noisier.ln().abs()) < 0.03 {
                break;
            }
            problem.scale_noise(noisier);
            prior.widen(wider);
            (self.noise, self.unlikeness) = (self.noise * noisier, self.unlikeness * wider);
            self.solution = problem.solve(prior, Some(&self.solution))?;
        }
        Some(self)
    }
}

fn check(shots: &[Shot]) -> Result<(), RecoveryError> {
    let all = || shots.iter().flat_map(|shot| &shot.patches);
    if all().count() > MOST {
        return Err(RecoveryError::TooMany { patches: all().count() });
    }
    let values = all().count() * 3;
    let clipped = all().flat_map(|patch| patch.rgb).filter(|v| v.value() == Err(Exclusion::Clipped)).count();
    if clipped as f64 > CLIPPED * values as f64 {
        return Err(RecoveryError::Clipped { clipped, values });
    }
    let usable = all().filter(|patch| patch.rgb.iter().filter(|v| v.value().is_ok()).count() > 1).count();
    if usable < FEWEST { Err(RecoveryError::TooFew { usable }) } else { Ok(()) }
}

fn finished(library: &Library, prior: &Prior, problem: &Problem, adapted: &Adapted) -> ChartRecovery {
    let solution = &adapted.solution;
    let (nm, size) = (library.wavelengths_nm(), prior.mean.len());
    let (unknowns, x) = (solution.x.len(), &solution.x);
    let curve = |c: usize| x[c * nm.len()..(c + 1) * nm.len()].to_vec();
    let covariance: Vec<f64> =
        solution.inverse.chunks(unknowns).take(size).flat_map(|row| row[..size].to_vec()).collect();
    let share = |at: usize| (1.0 - covariance[at * (size + 1)] / prior.covariance[at * (size + 1)]).clamp(0.0, 1.0);
    let share = [0, 1, 2].map(|c: usize| (c * nm.len()..(c + 1) * nm.len()).map(share).collect());
    let gains = problem.gains().map(|at| x[at].exp());
    let deviation = |at: usize| solution.inverse[at * (unknowns + 1)].max(0.0).sqrt();
    let brightness = problem.brightness(x);
    let logs = || brightness.iter().flatten().map(|b| b.ln());
    ChartRecovery {
        unevenness: (logs().map(|log| log * log).sum::<f64>() / logs().count().max(1) as f64).sqrt(),
        curves: RecoveredCurves::new(nm, &[0, 1, 2].map(curve), &covariance, gains, share),
        brightness,
        glare: problem.glare().map(|at| x[at]),
        light: problem.lights().map(|at| [x[at], deviation(at)]).collect(),
        residuals: problem.residuals(x),
        noise_ratio: adapted.noise * solution.noise_ratio,
        unlikeness: adapted.unlikeness * solution.unlikeness,
        log_posterior: solution.log_posterior,
    }
}
