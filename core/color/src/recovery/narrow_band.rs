//! Sensitivities from narrow bands of light.
//!
//! ```text
//! q_kc = (lit − dark) / (power · exposure)          y = A c + ε
//! min (A c − y)ᵀ V⁻¹ (A c − y) + μ |D² c / peak|²,   c ≥ 0
//! ```
//! c = samples of the three curves at the bands, A = each band's shape over the linear interpolant of c (the identity where its width is not
//! known), V = covariance of y by the scatter of the passes, which is in part common to the channels of a band (its power, the lamp), and by
//! that of the dark level. μ is the largest for which χ² does not exceed the degrees of freedom, cells less `tr (H⁻¹ Aᵀ V⁻¹ A)` (the
//! discrepancy principle of Morozov 1966 with equivalent degrees of freedom).

use super::curves::RecoveredCurves;
use super::prior::{Library, Prior};
use crate::math::dense::{Cholesky, Matrix, among, bounded_minimum, times};
use crate::spectral::{DistributionError, Sensor};
use crate::units::{bits, hash_by};

/// Relative standard deviation of the cells of one pass that nothing can be compared with.
const ONE_PASS: f64 = 0.02;
/// Fewest bands, and the most whose equations are solved: every nanometer.
const FEWEST: usize = 8;
const MOST: usize = 401;
/// Net signals below so many standard deviations of the dark level are dark.
const DARK: f64 = 3.0;

/// One band of one pass.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Band {
    /// Center in nanometers.
    pub wavelength_nm: f64,
    /// Full width at half maximum of its triangular shape in nanometers, if known.
    pub width_nm: Option<f64>,
    /// Radiance or irradiance within it, in any unit.
    pub power: f64,
    /// Exposure time in any unit.
    pub exposure: f64,
    /// Raw means with the light.
    pub lit: [f64; 3],
    /// Raw means without.
    pub dark: [f64; 3],
}

hash_by!(Band, |of| {
    let row = [of.wavelength_nm, of.width_nm.unwrap_or_default(), of.power, of.exposure].map(bits);
    (row, of.lit.map(bits), of.dark.map(bits))
});

/// Bands in ascending order, each measured once.
pub type Pass = Vec<Band>;

/// State of a band and channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cell {
    /// Used.
    Good,
    /// At the end of the scale in a pass: left out.
    Saturated,
    /// Not above the dark level: left out.
    Dark,
}

/// Passes over the same bands.
#[derive(Clone, Debug, PartialEq)]
pub struct NarrowBands {
    /// The passes.
    pub passes: Vec<Pass>,
    /// Raw value from which on a lit mean is saturated.
    pub clip: f64,
}

hash_by!(NarrowBands, |of| (&of.passes, bits(of.clip)));

/// Reason that no sensitivities are recovered from bands.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum NarrowBandError {
    #[error("{found} bands; at least {FEWEST} are needed")]
    TooFew { found: usize },
    #[error("{found} bands; at most {MOST} are computed with, so take the means of neighbors")]
    TooMany { found: usize },
    #[error("pass {pass} has other bands than the first")]
    Bands { pass: usize },
    #[error("the band at {nm} nm: power and exposure must be positive, all values finite")]
    Value { nm: f64 },
    #[error("channel {} has {usable} usable cells of {bands}", channel + 1)]
    Unusable { channel: usize, usable: usize, bands: usize },
    #[error(transparent)]
    Wavelengths(#[from] DistributionError),
    #[error("the equations have no solution: the bands do not determine the curves")]
    Singular,
}

/// Sensitivities recovered from bands.
#[derive(Clone, Debug, PartialEq)]
pub struct NarrowBandRecovery {
    /// The curves, with cells that were left out filled by the library's tables given the others.
    pub curves: RecoveredCurves,
    /// Mean quotient of the passes, in the unit of raw value by power and exposure; saturated cells are too small.
    pub quotient: [Vec<f64>; 3],
    /// Standard deviation of the mean quotient.
    pub deviation: [Vec<f64>; 3],
    /// State of each cell.
    pub cells: [Vec<Cell>; 3],
    /// Relative standard deviation of one pass by the scatter of the passes, of each channel; none for a single pass.
    pub scatter: Option<[f64; 3]>,
    /// Weight μ of the curvature.
    pub smoothing: f64,
    /// Exponent of the response less 1, with its standard deviation: regression of the quotients' log residuals on the log signal.
    pub nonlinearity: [f64; 2],
    /// Shift of the wavelengths from those of the nearest table in nanometers, with its standard deviation, and that table.
    pub shift_nm: Option<([f64; 2], String)>,
    /// Median response, relative to the peak, where no table of the library exceeds 1 %; none where there is no such cell.
    pub leak: [Option<f64>; 3],
}

impl NarrowBands {
    /// Recovers curves at the bands; `library` has to be at their wavelengths.
    ///
    /// # Errors
    /// [`NarrowBandError`] with the reason.
    pub fn recover(&self, library: &Library) -> Result<NarrowBandRecovery, NarrowBandError> {
        let nm = self.wavelengths_nm()?;
        let cells = self.cells();
        for (channel, cells) in cells.iter().enumerate() {
            let usable = cells.iter().filter(|cell| **cell == Cell::Good).count();
            if 2 * usable < FEWEST {
                return Err(NarrowBandError::Unusable { channel, usable, bands: cells.len() });
            }
        }
        let quotients: Vec<[Vec<f64>; 3]> = self.passes.iter().map(quotients).collect();
        let mean = |c: usize, k: usize| quotients.iter().map(|q| q[c][k]).sum::<f64>() / quotients.len() as f64;
        let quotient = [0, 1, 2].map(|c| (0..nm.len()).map(|k| mean(c, k)).collect::<Vec<f64>>());
        let relative = scatter(&quotients, &cells);
        let variance = self.covariance(&quotient, relative.unwrap_or_else(|| diagonal([ONE_PASS * ONE_PASS; 3])));
        let system = System::new(self, &nm, &quotient, &cells, &variance);
        let (values, inverse, smoothing) = system.solve().ok_or(NarrowBandError::Singular)?;
        let (filled, covariance, share) = filled(library, &values, &inverse, &cells);
        let curve = |c: usize| filled[c * nm.len()..(c + 1) * nm.len()].to_vec();
        let curves = RecoveredCurves::new(&nm, &[0, 1, 2].map(curve), &covariance, [1.0; 3], share);
        let own = [0, 1, 2].map(|c: usize| values[c * nm.len()..(c + 1) * nm.len()].to_vec());
        let size = 3 * nm.len();
        let deviation = |c: usize| (0..nm.len()).map(|k| variance[(c * nm.len() + k) * (size + 1)].sqrt()).collect();
        Ok(NarrowBandRecovery {
            nonlinearity: self.nonlinearity(&quotients, &own, &cells),
            shift_nm: shift(library, &curves.values, &cells),
            leak: [0, 1, 2].map(|c| leak(library, c, &quotient[c])),
            curves,
            quotient,
            deviation: [0, 1, 2].map(deviation),
            cells,
            scatter: relative.map(|r| [0, 1, 2].map(|c: usize| r[c][c].sqrt())),
            smoothing,
        })
    }

    /// Wavelengths of the bands in nanometers.
    ///
    /// # Errors
    /// [`NarrowBandError`] where passes are not over the same ascending bands, or a value cannot be computed with.
    pub fn wavelengths_nm(&self) -> Result<Vec<f64>, NarrowBandError> {
        let of = |pass: &Pass| pass.iter().map(|band| band.wavelength_nm).collect::<Vec<f64>>();
        let nm = self.passes.first().map(of).unwrap_or_default();
        if nm.len() < FEWEST {
            return Err(NarrowBandError::TooFew { found: nm.len() });
        }
        if nm.len() > MOST {
            return Err(NarrowBandError::TooMany { found: nm.len() });
        }
        if let Some(pass) = self.passes.iter().position(|pass| of(pass) != nm) {
            return Err(NarrowBandError::Bands { pass: pass + 1 });
        }
        let is_wrong = |band: &&Band| {
            let raw = band.lit.iter().chain(&band.dark).all(|v| v.is_finite());
            !raw || [Some(band.power), Some(band.exposure), band.width_nm]
                .iter()
                .flatten()
                .any(|v| !v.is_normal() || *v < 0.0)
        };
        if let Some(band) = self.passes.iter().flatten().find(is_wrong) {
            return Err(NarrowBandError::Value { nm: band.wavelength_nm });
        }
        crate::spectral::SpectralDistribution::new(nm.clone(), vec![0.0; nm.len()])?;
        Ok(nm)
    }

    /// Standard deviation of a channel's dark level over the bands of all passes.
    fn dark_deviation(&self, c: usize) -> f64 {
        let all: Vec<f64> = self.passes.iter().flatten().map(|band| band.dark[c]).collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        (all.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (all.len() as f64 - 1.0).max(1.0)).sqrt()
    }

    fn cells(&self) -> [Vec<Cell>; 3] {
        [0, 1, 2].map(|c: usize| {
            let least = DARK * self.dark_deviation(c);
            let state = |k: usize| {
                let bands = || self.passes.iter().map(move |pass| &pass[k]);
                if bands().any(|band| band.lit[c] >= self.clip) {
                    Cell::Saturated
                } else if bands().any(|band| band.lit[c] - band.dark[c] <= least) {
                    Cell::Dark
                } else {
                    Cell::Good
                }
            };
            (0..self.passes[0].len()).map(state).collect()
        })
    }

    /// Covariance of the mean quotients: relative between the channels of a band, and of the dark level.
    fn covariance(&self, quotient: &[Vec<f64>; 3], relative: [[f64; 3]; 3]) -> Matrix {
        let (count, passes) = (quotient[0].len(), self.passes.len() as f64);
        let mut all = vec![0.0; 9 * count * count];
        for k in 0..count {
            for (a, b) in (0..9).map(|at| (at / 3, at % 3)) {
                let light = self.passes.iter().map(|pass| pass[k].power * pass[k].exposure).sum::<f64>() / passes;
                let dark = if a == b { 2.0 * (self.dark_deviation(a) / light).powi(2) } else { 0.0 };
                let own = quotient[a][k] * quotient[b][k] * relative[a][b] + dark;
                all[(a * count + k) * 3 * count + b * count + k] = own / passes;
            }
        }
        all
    }

    fn nonlinearity(&self, quotients: &[[Vec<f64>; 3]], own: &[Vec<f64>; 3], cells: &[Vec<Cell>; 3]) -> [f64; 2] {
        let mut points = Vec::new();
        for (pass, quotient) in self.passes.iter().zip(quotients) {
            for c in 0..3 {
                for (k, band) in pass.iter().enumerate().filter(|(k, _)| cells[c][*k] == Cell::Good && own[c][*k] > 0.0)
                {
                    points.push(((band.lit[c] - band.dark[c]).ln(), (quotient[c][k] / own[c][k]).ln()));
                }
            }
        }
        slope(&points)
    }
}

/// Slope of a straight line with its standard deviation.
fn slope(points: &[(f64, f64)]) -> [f64; 2] {
    let count = points.len().max(1) as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x0, y0) = (mean(|p| p.0), mean(|p| p.1));
    let (xx, xy) = points.iter().fold((0.0, 0.0), |(xx, xy), (x, y)| (xx + (x - x0).powi(2), xy + (x - x0) * (y - y0)));
    let slope = if xx > 0.0 { xy / xx } else { 0.0 };
    let rest: f64 = points.iter().map(|(x, y)| (y - y0 - slope * (x - x0)).powi(2)).sum();
    [slope, (rest / (count - 2.0).max(1.0) / xx.max(f64::MIN_POSITIVE)).sqrt()]
}

fn diagonal(of: [f64; 3]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|a: usize| [0, 1, 2].map(|b: usize| if a == b { of[a] } else { 0.0 }))
}

fn quotients(pass: &Pass) -> [Vec<f64>; 3] {
    [0, 1, 2]
        .map(|c: usize| pass.iter().map(|band| (band.lit[c] - band.dark[c]) / (band.power * band.exposure)).collect())
}

/// Covariance of the channels' relative errors in a band of one pass, from the passes' logarithms about their mean.
fn scatter(quotients: &[[Vec<f64>; 3]], cells: &[Vec<Cell>; 3]) -> Option<[[f64; 3]; 3]> {
    let passes = quotients.len();
    let freedom = passes.checked_sub(1).filter(|freedom| *freedom > 0)? as f64;
    let off = |c: usize, k: usize, pass: usize| {
        let logs = || quotients.iter().map(|q| q[c][k].ln());
        quotients[pass][c][k].ln() - logs().sum::<f64>() / passes as f64
    };
    let pooled = |a: usize, b: usize| {
        let both: Vec<usize> =
            (0..cells[a].len()).filter(|k| cells[a][*k] == Cell::Good && cells[b][*k] == Cell::Good).collect();
        let products = both.iter().flat_map(|k| (0..passes).map(move |pass| off(a, *k, pass) * off(b, *k, pass)));
        products.sum::<f64>() / (freedom * both.len().max(1) as f64)
    };
    let mut all = [0, 1, 2].map(|a: usize| [0, 1, 2].map(|b: usize| pooled(a, b)));
    // Pairs are of different cells, so that a correlation may come out too large; what cells do not share is at least a twentieth.
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        let most = 0.95 * (all[a][a] * all[b][b]).sqrt();
        all[a][b] = all[a][b].clamp(-most * 0.5, most);
        all[b][a] = all[a][b];
    }
    Some(all)
}

/// Equations of the usable cells.
struct System {
    /// `Aᵀ V⁻¹ A`, `Aᵀ V⁻¹ y`, `yᵀ V⁻¹ y`.
    normal: Matrix,
    right: Vec<f64>,
    square: f64,
    cells: usize,
    curvature: Matrix,
}

impl System {
    fn new(
        bands: &NarrowBands,
        nm: &[f64],
        quotient: &[Vec<f64>; 3],
        cells: &[Vec<Cell>; 3],
        variance: &[f64],
    ) -> Self {
        let (count, size) = (nm.len(), 3 * nm.len());
        let used: Vec<usize> = (0..size).filter(|at| cells[at / count][at % count] == Cell::Good).collect();
        let y: Vec<f64> = used.iter().map(|at| quotient[at / count][at % count]).collect();
        let weight = Cholesky::new(among(variance, size, &used, &used), used.len());
        let weight = weight.map_or_else(|| vec![0.0; used.len() * used.len()], |root| root.inverse());
        let shape = |at: &usize| {
            let mut row = vec![0.0; size];
            row[at / count * count..][..count].copy_from_slice(&response(&bands.passes[0][at % count], nm));
            row
        };
        let a: Vec<Vec<f64>> = used.iter().map(shape).collect();
        let (mut normal, mut right) = (vec![0.0; size * size], vec![0.0; size]);
        let weighted = times(&weight, &y);
        for (i, row) in a.iter().enumerate() {
            right.iter_mut().zip(row).for_each(|(right, a)| *right += a * weighted[i]);
            for (j, other) in a.iter().enumerate().filter(|(j, _)| weight[i * used.len() + j] != 0.0) {
                let by = weight[i * used.len() + j];
                for (p, value) in row.iter().enumerate().filter(|(_, v)| **v != 0.0) {
                    let to = normal[p * size..][..size].iter_mut().zip(other);
                    to.for_each(|(to, b)| *to += by * value * b);
                }
            }
        }
        let square = y.iter().zip(&weighted).map(|(a, b)| a * b).sum();
        let mut curvature = vec![0.0; size * size];
        for (c, curve) in quotient.iter().enumerate() {
            let peak = curve.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
            for k in 1..count - 1 {
                let term = [(k - 1, 1.0), (k, -2.0), (k + 1, 1.0)];
                for ((i, a), (j, b)) in term.iter().flat_map(|a| term.iter().map(move |b| (*a, *b))) {
                    curvature[(c * count + i) * size + c * count + j] += a * b / (peak * peak);
                }
            }
        }
        Self { normal, right, square, cells: used.len(), curvature }
    }

    fn hessian(&self, smoothing: f64) -> Matrix {
        self.normal.iter().zip(&self.curvature).map(|(a, b)| a + smoothing * b).collect()
    }

    /// Curves, inverse of the Hessian, and μ.
    fn solve(&self) -> Option<(Vec<f64>, Matrix, f64)> {
        let size = self.right.len();
        let excess = |log: f64| {
            let root = Cholesky::new(self.hessian(log.exp()), size)?;
            let c = root.solve(self.right.clone());
            let dot = |a: &[f64]| a.iter().zip(&c).map(|(a, b)| a * b).sum::<f64>();
            let squares = self.square - 2.0 * dot(&self.right) + dot(&times(&self.normal, &c));
            let parameters: f64 = root.inverse().iter().zip(&self.normal).map(|(a, b)| a * b).sum();
            Some(squares - (self.cells as f64 - parameters))
        };
        let (mut low, mut high) = (1e-3_f64.ln(), 1e9_f64.ln());
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if excess(middle)? > 0.0 { high = middle } else { low = middle }
        }
        let smoothing = low.exp();
        let hessian = self.hessian(smoothing);
        let values = bounded_minimum(&hessian, &self.right, &vec![[0.0, f64::INFINITY]; size], None)?;
        Some((values, Cholesky::new(hessian, size)?.inverse(), smoothing))
    }
}

/// Weights of the samples in a band's mean: its triangular shape over their linear interpolant.
fn response(band: &Band, nm: &[f64]) -> Vec<f64> {
    let mut weights = vec![0.0; nm.len()];
    let steps = band.width_nm.map_or(0, |_| 20);
    let mut total = 0.0;
    for step in -steps..=steps {
        let part = f64::from(step) / f64::from(steps.max(1));
        let x = (band.wavelength_nm + part * band.width_nm.unwrap_or(0.0)).clamp(nm[0], nm[nm.len() - 1]);
        let above = nm.partition_point(|own| *own < x).clamp(1, nm.len() - 1);
        let (share, by) = ((x - nm[above - 1]) / (nm[above] - nm[above - 1]), 1.0 - part.abs());
        let by = if steps == 0 { 1.0 } else { by };
        weights[above - 1] += by * (1.0 - share);
        weights[above] += by * share;
        total += by;
    }
    weights.iter().map(|weight| weight / total).collect()
}

/// Curves with the cells that were left out taken from the library's prior, conditioned on the others; with covariance and shares of data.
fn filled(
    library: &Library,
    values: &[f64],
    inverse: &[f64],
    cells: &[Vec<Cell>; 3],
) -> (Vec<f64>, Matrix, [Vec<f64>; 3]) {
    let (size, count) = (values.len(), values.len() / 3);
    let is_used = |at: usize| cells[at / count][at % count] == Cell::Good;
    let plain = library.prior(&[]);
    let scale = [0, 1, 2].map(|c: usize| {
        let used = || (c * count..(c + 1) * count).filter(|at| is_used(*at));
        let sum = |of: &[f64]| used().map(|at| of[at]).sum::<f64>();
        sum(values) / sum(&plain.mean).max(f64::MIN_POSITIVE)
    });
    let mut prior = Prior { mean: plain.mean.clone(), covariance: plain.covariance.clone() };
    let mut function = vec![0.0; size];
    for at in (0..size).filter(|at| is_used(*at)) {
        let by = scale[at / count].max(f64::MIN_POSITIVE);
        function[at] = 1.0;
        prior.condition(&function, values[at] / by, inverse[at * (size + 1)] / (by * by));
        function[at] = 0.0;
    }
    let value = |at: usize| if is_used(at) { values[at] } else { (prior.mean[at] * scale[at / count]).max(0.0) };
    let covariance = (0..size * size).map(|at| match (at / size, at % size) {
        (a, b) if is_used(a) && is_used(b) => inverse[at],
        (a, b) if is_used(a) != is_used(b) => 0.0,
        (a, b) => prior.covariance[at] * scale[a / count] * scale[b / count],
    });
    let share = |at: usize| {
        let ratio = prior.covariance[at * (size + 1)] / plain.covariance[at * (size + 1)];
        if is_used(at) { 1.0 } else { (1.0 - ratio).clamp(0.0, 1.0) }
    };
    let shares = [0, 1, 2].map(|c: usize| (c * count..(c + 1) * count).map(share).collect());
    ((0..size).map(value).collect(), covariance.collect(), shares)
}

/// Regression of the curves' difference from the nearest table on the table's slope, over used cells.
fn shift(library: &Library, curves: &[Vec<f64>; 3], cells: &[Vec<Cell>; 3]) -> Option<([f64; 2], String)> {
    let nm = library.wavelengths_nm();
    let (name, _) = *library.nearest(curves).first()?;
    let table = library.sensor(name)?;
    let mut points = Vec::new();
    for c in 0..3 {
        let at = |x: f64| value(table, x, c);
        let own: Vec<f64> = nm.iter().map(|x| at(*x)).collect();
        let dot = |a: &[f64]| a.iter().zip(&own).map(|(a, b)| a * b).sum::<f64>();
        let scale = dot(&curves[c]) / dot(&own).max(f64::MIN_POSITIVE);
        let peak = curves[c].iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        for (k, x) in nm.iter().enumerate().filter(|(k, _)| cells[c][*k] == Cell::Good) {
            // A shift to longer wavelengths by δ is −δ times the slope.
            points.push((scale * (at(x - 2.0) - at(x + 2.0)) / 4.0 / peak, (curves[c][k] - scale * own[k]) / peak));
        }
    }
    Some((slope(&points), name.to_owned()))
}

fn value(sensor: &Sensor, nm: f64, c: usize) -> f64 {
    let last = crate::spectral::grid::COUNT - 1;
    sensor.at_index(((nm - crate::spectral::grid::FIRST_NM).max(0.0).round() as usize).min(last))[c]
}

fn leak(library: &Library, c: usize, quotient: &[f64]) -> Option<f64> {
    let nm = library.wavelengths_nm();
    let largest = library.largest(c);
    let peak = quotient.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let mut far: Vec<f64> = (0..nm.len()).filter(|k| largest[*k] < 0.01).map(|k| quotient[k] / peak).collect();
    far.sort_by(f64::total_cmp);
    far.get(far.len() / 2).copied()
}
