//! The model of recorded patches with its unknowns, and their most probable values.
//!
//! Unknowns in a row: curves | ln b of each patch | ln g of each channel | f of each channel | t of each mode.

use std::ops::Range;

use super::Shot;
use crate::math::dense::{Cholesky, Matrix, bounded_minimum, times};
use crate::recovery::prior::Prior;
use crate::spectral::grid::{COUNT, STEP_NM};
use crate::spectral::{GridSpectrum, Quantity, SpectralDistribution};

/// Bounds of glare.
const GLARE: [f64; 2] = [0.0, 0.03];
/// Mean and standard deviation of glare.
const GLARE_PRIOR: [f64; 2] = [0.005, 0.01];
/// Standard deviation of logarithms that nothing is known about.
const FREE: f64 = 10.0;
/// Smallest and first spread of the logarithm of brightness.
const EVENNESS: [f64; 2] = [1e-3, 0.1];
/// Standard deviation of a slope of the logarithm of the light over the chart, as the root of the sum of its squares over 24 patches.
const SLOPE: f64 = 0.2;
const ROUNDS: usize = 30;

#[derive(Default)]
pub(super) struct Problem {
    sites: usize,
    patches: Vec<PatchKernels>,
    values: Vec<Value>,
    /// Patches of each shot.
    shots: Vec<Range<usize>>,
    /// Unit vectors of what the light of each shot does by itself, with their deviations.
    fields: Vec<Vec<(Vec<f64>, f64)>>,
    modes: usize,
}

/// Derivatives of a patch's integrals by the samples of a curve.
struct PatchKernels {
    own: Vec<f64>,
    white: Vec<f64>,
    /// Place of a mode among all, and its derivatives.
    modes: Vec<(usize, Vec<f64>)>,
}

struct Value {
    patch: usize,
    channel: usize,
    recorded: f64,
    deviation: f64,
}

pub(super) struct Solution {
    pub(super) x: Vec<f64>,
    /// Inverse of the Hessian.
    pub(super) inverse: Matrix,
    pub(super) unevenness: f64,
    pub(super) noise_ratio: f64,
    /// Root of the curves' distance from the prior's mean, `(c − μ)ᵀ Σ⁻¹ (c − μ)`, by the number of parameters that the data determine.
    pub(super) unlikeness: f64,
    pub(super) log_posterior: f64,
}

/// One value's model and its derivatives.
struct Modeled {
    value: f64,
    /// By the samples of its channel's curve.
    by_curve: Vec<f64>,
    /// By other unknowns.
    by_others: Vec<(usize, f64)>,
    /// By the logarithm of brightness of each patch of its shot, through their mean.
    by_each: f64,
}

/// What the values of a shot have in common with all its brightnesses, through their mean.
#[derive(Clone)]
struct OfMean {
    /// Sum of weight times slope times residual.
    right: f64,
    /// Sum of weight times slope times the slopes by single unknowns.
    mixed: Vec<f64>,
    /// Sum of weight times the slope's square.
    square: f64,
}

impl Problem {
    pub(super) fn new(wavelengths_nm: &[f64], shots: &[Shot]) -> Self {
        let basis = basis(wavelengths_nm);
        let kernel = |radiance: &[f64; COUNT], by: f64| -> Vec<f64> {
            basis.iter().map(|site| site.iter().zip(radiance).map(|(a, b)| a * b).sum::<f64>() * by).collect()
        };
        let fields = shots.iter().map(|shot| fields(shot.patches.len(), shot.columns)).collect();
        let mut problem = Self { sites: wavelengths_nm.len(), fields, ..Self::default() };
        for shot in shots {
            let first = problem.patches.len();
            let brightest =
                |patch: &&crate::camera::recorded::RecordedPatch| patch.radiance.values().iter().sum::<f64>();
            let white = shot.patches.iter().max_by(|a, b| brightest(a).total_cmp(&brightest(b)));
            let scale = white.map_or(1.0, |white| 1.0 / brightest(&white).max(f64::MIN_POSITIVE));
            let white = white.map_or_else(Vec::new, |white| kernel(white.radiance.values(), scale));
            for (patch, noise) in shot.patches.iter().zip(&shot.noise) {
                let drifted = |drift: &GridSpectrum| kernel(patch.radiance.times(drift).values(), scale);
                let modes = shot.drifts.iter().enumerate().map(|(k, drift)| (problem.modes + k, drifted(drift)));
                let kernels = PatchKernels {
                    own: kernel(patch.radiance.values(), scale),
                    white: white.clone(),
                    modes: modes.collect(),
                };
                for (channel, (signal, deviation)) in patch.rgb.iter().zip(noise).enumerate() {
                    if let (Ok(recorded), true) = (signal.value(), *deviation > 0.0) {
                        let patch = problem.patches.len();
                        problem.values.push(Value { patch, channel, recorded, deviation: *deviation });
                    }
                }
                problem.patches.push(kernels);
            }
            problem.shots.push(first..problem.patches.len());
            problem.modes += shot.drifts.len();
        }
        problem
    }

    fn bright(&self) -> usize {
        3 * self.sites
    }

    pub(super) fn gains(&self) -> [usize; 3] {
        [0, 1, 2].map(|c| self.bright() + self.patches.len() + c)
    }

    pub(super) fn glare(&self) -> [usize; 3] {
        self.gains().map(|at| at + 3)
    }

    pub(super) fn lights(&self) -> Range<usize> {
        let first = self.glare()[2] + 1;
        first..first + self.modes
    }

    fn logs(&self, x: &[f64], shot: &Range<usize>) -> Vec<f64> {
        x[self.bright() + shot.start..self.bright() + shot.end].to_vec()
    }

    pub(super) fn brightness(&self, x: &[f64]) -> Vec<Vec<f64>> {
        let of = |shot: &Range<usize>| {
            let logs = self.logs(x, shot);
            let mean = logs.iter().sum::<f64>() / logs.len().max(1) as f64;
            logs.iter().map(|log| (log - mean).exp()).collect()
        };
        self.shots.iter().map(of).collect()
    }

    /// Recorded over modeled, less 1.
    pub(super) fn residuals(&self, x: &[f64]) -> Vec<Vec<[Option<f64>; 3]>> {
        let mut all = vec![[None; 3]; self.patches.len()];
        for value in &self.values {
            all[value.patch][value.channel] = Some(value.recorded / self.modeled(x, value).value - 1.0);
        }
        self.shots.iter().map(|shot| all[shot.clone()].to_vec()).collect()
    }

    fn modeled(&self, x: &[f64], value: &Value) -> Modeled {
        let kernels = &self.patches[value.patch];
        let first = value.channel * self.sites;
        let curve = &x[first..first + self.sites];
        let dot = |kernel: &[f64]| kernel.iter().zip(curve).map(|(a, c)| a * c).sum::<f64>();
        let (gain_at, glare_at) = (self.gains()[value.channel], self.glare()[value.channel]);
        let [gain, bright] = [gain_at, self.bright() + value.patch].map(|at| x[at].exp());
        let shot = self.shots.iter().find(|shot| shot.contains(&value.patch)).cloned().unwrap_or_default();
        let share = 1.0 / shot.len().max(1) as f64;
        let mean = (self.logs(x, &shot).iter().sum::<f64>() * share).exp();
        let t = |mode: usize| x[self.lights().start + mode];
        let mut kernel = kernels.own.clone();
        for (mode, drift) in &kernels.modes {
            kernel.iter_mut().zip(drift).for_each(|(own, drift)| *own += t(*mode) * drift);
        }
        let (own, white) = (gain * bright * dot(&kernel), gain * mean * dot(&kernels.white));
        let glare = x[glare_at] * gain * mean;
        let by_curve = kernel.iter().zip(&kernels.white).map(|(own, white)| gain * bright * own + glare * white);
        let modeled = own + x[glare_at] * white;
        let mut by_others = vec![(self.bright() + value.patch, own), (gain_at, modeled), (glare_at, white)];
        let modes = kernels.modes.iter();
        by_others.extend(modes.map(|(mode, drift)| (self.lights().start + mode, gain * bright * dot(drift))));
        Modeled { value: modeled, by_curve: by_curve.collect(), by_others, by_each: share * x[glare_at] * white }
    }

    /// First values: the prior's mean, with the gains and brightnesses of two-way means of the logarithms.
    fn start(&self, prior: &Prior) -> Vec<f64> {
        let mut x = prior.mean.clone();
        x.resize(self.lights().end, 0.0);
        for at in self.glare() {
            x[at] = GLARE_PRIOR[0];
        }
        let logs: Vec<f64> = self.values.iter().map(|v| (v.recorded / self.modeled(&x, v).value).ln()).collect();
        let mean = |select: &dyn Fn(&Value) -> bool, less: &dyn Fn(&Value) -> f64| {
            let own = self.values.iter().zip(&logs).filter(|(v, log)| select(v) && log.is_finite());
            let (sum, count) = own.fold((0.0, 0.0), |(sum, n), (v, log)| (sum + log - less(v), n + 1.0));
            if count > 0.0 { sum / count } else { 0.0 }
        };
        let gains = [0, 1, 2].map(|c: usize| mean(&|v| v.channel == c, &|_| 0.0));
        let bright: Vec<f64> =
            (0..self.patches.len()).map(|p| mean(&|v| v.patch == p, &|v| gains[v.channel])).collect();
        self.gains().into_iter().zip(gains).for_each(|(at, log)| x[at] = log);
        x[self.bright()..self.bright() + bright.len()].copy_from_slice(&bright);
        x
    }

    /// Precision of the prior of all unknowns but the brightnesses, whose spread is estimated.
    fn precision(&self, prior: &Prior) -> Option<Matrix> {
        let (size, curves) = (self.lights().end, prior.mean.len());
        let mut precision = vec![0.0; size * size];
        let of_curves = prior.precision()?;
        let rows = precision.chunks_mut(size).zip(of_curves.chunks(curves));
        rows.for_each(|(row, own)| row[..curves].copy_from_slice(own));
        let mut hold = |at: usize, deviation: f64| precision[at * (size + 1)] = deviation.powi(-2);
        self.gains().into_iter().for_each(|at| hold(at, FREE));
        self.glare().into_iter().for_each(|at| hold(at, GLARE_PRIOR[1]));
        self.lights().for_each(|at| hold(at, 1.0));
        Some(precision)
    }

    /// `I/τ² + Σ u uᵀ (1/s² − 1/τ²)` for the brightnesses of each shot, with the [`fields`] u of its light and their deviations s.
    fn set_evenness(&self, precision: &mut [f64], spread: f64) {
        let size = self.lights().end;
        for (shot, fields) in self.shots.iter().zip(&self.fields) {
            for (i, j) in shot.clone().flat_map(|i| shot.clone().map(move |j| (i, j))) {
                let own = if i == j { spread.powi(-2) } else { 0.0 };
                let of_field =
                    |(u, s): &(Vec<f64>, f64)| u[i - shot.start] * u[j - shot.start] * (s.powi(-2) - spread.powi(-2));
                precision[(self.bright() + i) * size + self.bright() + j] =
                    own + fields.iter().map(of_field).sum::<f64>();
            }
        }
    }

    /// Spread of ln b about the fields of the shots, by the squares over the number of brightnesses that the data determine (`MacKay` 1992).
    fn spread(&self, x: &[f64], hessian: &Cholesky, former: f64) -> f64 {
        let count = self.patches.len();
        let mut columns = vec![0.0; (x.len() - self.bright()) * count];
        columns.iter_mut().step_by(count + 1).take(count).for_each(|one| *one = 1.0);
        let half = hessian.half_solve(self.bright(), columns);
        let (mut squares, mut determined) = (0.0, 0.0);
        for (shot, fields) in self.shots.iter().zip(&self.fields) {
            let logs = self.logs(x, shot);
            let rows = || half.chunks(count.max(1)).map(|row| &row[shot.clone()]);
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let mut variance = rows().map(|row| dot(row, row)).sum::<f64>();
            squares += dot(&logs, &logs);
            for (u, _) in fields {
                squares -= dot(u, &logs).powi(2);
                variance -= rows().map(|row| dot(row, u).powi(2)).sum::<f64>();
            }
            determined += (shot.len() - fields.len()) as f64 - variance / former.powi(2);
        }
        let next = (squares / f64::max(determined, 1e-3)).sqrt();
        next.clamp(former / 10.0, former * 10.0).max(EVENNESS[0])
    }

    /// Multiplies the standard deviation of all values.
    pub(super) fn scale_noise(&mut self, by: f64) {
        self.values.iter_mut().for_each(|value| value.deviation *= by);
    }

    /// Most probable unknowns; the search begins at those of a former solution, if any.
    pub(super) fn solve(&self, prior: &Prior, former: Option<&Solution>) -> Option<Solution> {
        let mut x = self.start(prior);
        let (size, curves) = (x.len(), prior.mean.len());
        let center =
            x.iter().enumerate().map(|(at, v)| if at >= self.bright() && at < self.gains()[0] { 0.0 } else { *v });
        let center: Vec<f64> = center.collect();
        let mut bounds = vec![[f64::NEG_INFINITY, f64::INFINITY]; size];
        bounds[..curves].fill([0.0, f64::INFINITY]);
        self.glare().into_iter().for_each(|at| bounds[at] = GLARE);
        let mut precision = self.precision(prior)?;
        let peak = prior.mean.iter().copied().fold(0.0, f64::max);
        let mut spread = EVENNESS[1];
        if let Some(former) = former {
            (x, spread) = (former.x.clone(), former.unevenness);
        }
        for round in 0..ROUNDS {
            self.set_evenness(&mut precision, spread);
            let (hessian, mut right) = self.normal_equations(&x, &precision, &center);
            right.iter_mut().zip(times(&hessian, &x)).for_each(|(g, hx)| *g += hx);
            let next = bounded_minimum(&hessian, &right, &bounds, Some(&x))?;
            let step = |range: Range<usize>| range.map(|at| (next[at] - x[at]).abs()).fold(0.0, f64::max);
            let (change, logs) = (step(0..curves), step(self.bright()..self.glare()[0]));
            // Exponentials are followed in steps in which they are nearly linear.
            let part = f64::min(1.0, 1.5 / logs.max(1e-9));
            x.iter_mut().zip(&next).for_each(|(x, next)| *x += part * (next - *x));
            let (root, former) = (Cholesky::new(hessian, size)?, spread);
            spread = self.spread(&x, &root, former);
            let settled = change < 1e-4 * peak && logs < 1e-3 && (spread / former).ln().abs() < 0.03;
            if settled || round + 1 == ROUNDS {
                return Some(self.solution(x, root.inverse(), &precision, &center, (former, curves)));
            }
        }
        None
    }

    /// Hessian of half the squares, and the negative gradient.
    fn normal_equations(&self, x: &[f64], precision: &[f64], center: &[f64]) -> (Matrix, Vec<f64>) {
        let size = x.len();
        let mut hessian = precision.to_vec();
        let off: Vec<f64> = center.iter().zip(x).map(|(center, x)| center - x).collect();
        let mut right = times(precision, &off);
        let mut of_means = vec![OfMean { right: 0.0, mixed: vec![0.0; size], square: 0.0 }; self.shots.len()];
        for value in &self.values {
            let Modeled { value: modeled, by_curve, by_others, by_each } = self.modeled(x, value);
            let weight = value.deviation.powi(-2);
            let residual = (value.recorded - modeled) * weight;
            let first = value.channel * self.sites;
            let curve = first..first + self.sites;
            let slopes = || curve.clone().zip(by_curve.iter().copied()).chain(by_others.iter().copied());
            for (at, slope) in slopes() {
                right[at] += slope * residual;
                let row = &mut hessian[at * size..][..size];
                let by = weight * slope;
                row[curve.clone()].iter_mut().zip(&by_curve).for_each(|(sum, other)| *sum += by * other);
                for (other, slope) in &by_others {
                    row[*other] += by * slope;
                }
            }
            let shot = self.shots.iter().position(|shot| shot.contains(&value.patch));
            let Some(mean) = shot.and_then(|shot| of_means.get_mut(shot)) else { continue };
            mean.right += by_each * residual;
            mean.square += weight * by_each * by_each;
            slopes().for_each(|(at, slope)| mean.mixed[at] += weight * by_each * slope);
        }
        for (shot, mean) in self.shots.iter().zip(&of_means) {
            for patch in shot.clone().map(|patch| self.bright() + patch) {
                right[patch] += mean.right;
                let row = &mut hessian[patch * size..][..size];
                row.iter_mut().zip(&mean.mixed).for_each(|(sum, mixed)| *sum += mixed);
                row[self.bright() + shot.start..self.bright() + shot.end]
                    .iter_mut()
                    .for_each(|sum| *sum += mean.square);
                mean.mixed.iter().enumerate().for_each(|(at, mixed)| hessian[at * size + patch] += mixed);
            }
        }
        (hessian, right)
    }

    fn solution(
        &self,
        x: Vec<f64>,
        inverse: Matrix,
        precision: &[f64],
        center: &[f64],
        (spread, curves): (f64, usize),
    ) -> Solution {
        let size = x.len();
        let residual = |value: &Value| (value.recorded - self.modeled(&x, value).value) / value.deviation;
        let squares: f64 = self.values.iter().map(|value| residual(value).powi(2)).sum();
        let held: f64 = precision.iter().zip(&inverse).map(|(a, b)| a * b).sum();
        let freedom = (self.values.len() as f64 - (size as f64 - held)).max(1.0);
        let off: Vec<f64> = x.iter().zip(center).map(|(x, center)| x - center).collect();
        let pull: Vec<f64> = times(precision, &off).iter().zip(&off).map(|(a, b)| a * b).collect();
        // The curves' share of the precision is a block of its own.
        let of_curves =
            |of: &[f64]| -> Vec<f64> { of.chunks(size).take(curves).flat_map(|row| row[..curves].to_vec()).collect() };
        let undetermined: f64 = of_curves(precision).iter().zip(of_curves(&inverse)).map(|(a, b)| a * b).sum();
        let parameters = (curves as f64 - undetermined).max(1.0);
        let unlikeness = (pull[..curves].iter().sum::<f64>().max(0.0) / parameters).sqrt();
        let prior: f64 = pull.iter().sum();
        let log_posterior = -0.5 * (squares + prior);
        let noise_ratio = (squares / freedom).sqrt();
        Solution { x, inverse, unevenness: spread, noise_ratio, unlikeness, log_posterior }
    }
}

/// What the light on some patches does by itself, as unit vectors with the deviations of their amounts: its exposure, and a slope either
/// way where the places of the patches are known.
fn fields(count: usize, columns: Option<usize>) -> Vec<(Vec<f64>, f64)> {
    let unit = |deviation: f64, of: &dyn Fn(usize) -> f64| {
        let all: Vec<f64> = (0..count).map(of).collect();
        let norm = all.iter().map(|v| v * v).sum::<f64>().sqrt();
        (all.iter().map(|v| v / norm).collect(), deviation)
    };
    let mut fields = vec![unit(FREE, &|_| 1.0)];
    if let Some(columns) = columns.filter(|n| *n > 1 && count > *n && count.is_multiple_of(*n)) {
        let middle = |steps: usize| (steps - 1) as f64 / 2.0;
        let slope = SLOPE * (count as f64 / 24.0).sqrt();
        fields.push(unit(slope, &|at| (at % columns) as f64 - middle(columns)));
        fields.push(unit(slope, &|at| (at / columns) as f64 - middle(count / columns)));
    }
    fields
}

/// Curves on the grid that are 1 at one wavelength of a table and 0 at its others, times the weights of the trapezoid rule.
fn basis(wavelengths_nm: &[f64]) -> Vec<Vec<f64>> {
    let one = |site: usize| {
        let values = (0..wavelengths_nm.len()).map(|at| f64::from(u8::from(at == site))).collect();
        let curve = SpectralDistribution::new(wavelengths_nm.to_vec(), values).ok();
        // Sprague's interpolation without a bound at zero, which the sum of all has to have.
        let grid = curve.map(|curve| GridSpectrum::resample(&curve, Quantity::MatchingFunction));
        let mut grid = grid.map_or_else(|| vec![0.0; COUNT], |grid| grid.values().to_vec());
        for value in &mut grid {
            *value *= STEP_NM;
        }
        for end in [0, COUNT - 1] {
            grid[end] *= 0.5;
        }
        grid
    };
    (0..wavelengths_nm.len()).map(one).collect()
}
