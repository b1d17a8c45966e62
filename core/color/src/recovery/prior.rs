//! The library's tables as a Gaussian prior of three curves together.

use crate::camera::recorded::{Freedom, RecordedFit, RecordedPatch};
use crate::math::dense::{Cholesky, Matrix, times};
use crate::spectral::Sensor;
use crate::spectral::grid::{COUNT, FIRST_NM, LAST_NM};
use crate::units::{bits, hash_by};

/// Shift of each table's wavelengths, either way, in nanometers: the error of a wavelength scale, and filters unlike any of the library.
const SHIFT_NM: f64 = 3.0;
/// Factor of the tables' covariance, by which intervals hold for cameras of other laboratories.
const WIDENED: f64 = 2.0;
/// Factor of it between channels: in so few tables, channels vary together by chance too, and by the habits of makers.
const BETWEEN: f64 = 0.5;
/// Standard deviation of the smooth term relative to the peak, and its correlation length in nanometers.
const SMOOTH: f64 = 0.03;
const SMOOTH_NM: f64 = 20.0;
/// Standard deviation of what neighbors do not share, relative to the peak.
const ROUGH: f64 = 1e-3;
/// Standard deviation of the sum of a curve, which is 1: its scale is the gain's.
const SUM: f64 = 1e-3;
/// Log error that a table of the right camera has of a recording.
const TABLE_ERROR: f64 = 0.01;

/// Tables of cameras, at the wavelengths that curves are recovered at.
#[derive(Clone, Debug, PartialEq)]
pub struct Library {
    wavelengths_nm: Vec<f64>,
    names: Vec<String>,
    sensors: Vec<Sensor>,
    /// Of each table as it is, shifted down and shifted up: red, green and blue in a row, each with the sum 1.
    shapes: Vec<[Vec<f64>; 3]>,
}

hash_by!(Library, |of| (of.wavelengths_nm.iter().map(|nm| bits(*nm)).collect::<Vec<_>>(), &of.names, &of.sensors));

/// Gaussian distribution of red, green and blue in a row, each with the sum 1.
#[derive(Clone, Debug)]
pub struct Prior {
    /// Mean.
    pub mean: Vec<f64>,
    /// Covariance by rows.
    pub covariance: Matrix,
}

impl Library {
    /// Tables with their names, for curves at some wavelengths within 380–780 nm.
    ///
    /// A table that ends within them goes on as the mean of the complete ones does.
    pub fn new(tables: impl IntoIterator<Item = (String, Sensor)>, wavelengths_nm: &[f64]) -> Self {
        let (names, sensors): (Vec<_>, Vec<_>) = tables.into_iter().unzip();
        let on_grid = |sensor: &Sensor| -> Vec<[f64; 3]> {
            let norm = sensor.integrals().map(|integral| if integral > 0.0 { integral } else { 1.0 });
            (0..COUNT).map(|i| [0, 1, 2].map(|c: usize| sensor.at_index(i)[c] / norm[c])).collect()
        };
        let mut grids: Vec<Vec<[f64; 3]>> = sensors.iter().map(on_grid).collect();
        let complete = |sensor: &Sensor| sensor.support_nm() == [FIRST_NM, LAST_NM];
        let whole: Vec<&Vec<[f64; 3]>> =
            sensors.iter().zip(&grids).filter(|(sensor, _)| complete(sensor)).map(|(_, grid)| grid).collect();
        let mean = |i: usize, c: usize| whole.iter().map(|grid| grid[i][c]).sum::<f64>().max(f64::MIN_POSITIVE);
        let mean: Vec<[f64; 3]> = (0..COUNT).map(|i| [0, 1, 2].map(|c| mean(i, c))).collect();
        for (sensor, grid) in sensors.iter().zip(&mut grids) {
            let [first, last] = sensor.support_nm().map(|nm| (nm - FIRST_NM) as usize);
            for (i, end) in (0..first).map(|i| (i, first)).chain((last + 1..COUNT).map(|i| (i, last))) {
                grid[i] = [0, 1, 2].map(|c: usize| grid[end][c] * mean[i][c] / mean[end][c]);
            }
        }
        let shape = |grid: &Vec<[f64; 3]>| {
            [0.0, -SHIFT_NM, SHIFT_NM].map(|shift| sampled(grid, &wavelengths_nm.iter().map(|nm| nm - shift)))
        };
        let shapes = grids.iter().map(shape).collect();
        Self { wavelengths_nm: wavelengths_nm.to_vec(), names, sensors, shapes }
    }

    /// Wavelengths of the curves in nanometers.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    pub(super) fn is_empty(&self) -> bool {
        self.sensors.is_empty()
    }

    /// The table with a name.
    pub(super) fn sensor(&self, name: &str) -> Option<&Sensor> {
        self.names.iter().position(|own| own == name).map(|at| &self.sensors[at])
    }

    /// Largest response of a channel over the tables, each relative to its peak.
    pub(super) fn largest(&self, channel: usize) -> Vec<f64> {
        let count = self.wavelengths_nm.len();
        let mut largest = vec![0.0; count];
        for [own, ..] in &self.shapes {
            let curve = &own[channel * count..(channel + 1) * count];
            let peak = curve.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
            largest.iter_mut().zip(curve).for_each(|(largest, v)| *largest = f64::max(*largest, v / peak));
        }
        largest
    }

    /// Log error by which each table fails to explain recordings, with free gains and brightnesses; none for one that cannot be fitted.
    pub fn misfits(&self, shots: &[&[RecordedPatch]]) -> Vec<Option<f64>> {
        let of = |sensor: &Sensor| {
            let fits = shots.iter().map(|patches| RecordedFit::new(patches, sensor, Freedom::default()).ok());
            let squares: Vec<f64> = fits.map(|fit| Some(fit?.deviation().powi(2))).collect::<Option<_>>()?;
            Some((squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
        };
        self.sensors.iter().map(of).collect()
    }

    /// Prior in which each table has the weight `(e² + 0.01²)^(−3/2)` by its log error e: tables that explain the recording count more.
    /// Without any errors all count alike.
    ///
    /// ```text
    /// Σ = 2 Σ_tables + (0.03 p)² exp(−Δλ² / 2 (20 nm)²) + (0.001 p)² I
    /// ```
    /// p = peak of the mean of a channel; each table as it is and shifted by ±3 nm; half of `Σ_tables` between channels; conditioned on
    /// a sum of 1.
    pub fn prior(&self, misfits: &[Option<f64>]) -> Prior {
        let weight = |misfit: &Option<f64>| misfit.map_or(0.0, |e| (e * e + TABLE_ERROR * TABLE_ERROR).powf(-1.5));
        let of = |table: usize| misfits.get(table).map_or(1.0, weight);
        let mut weights: Vec<f64> = (0..self.shapes.len()).map(of).collect();
        let total = 3.0 * weights.iter().sum::<f64>();
        let even = 1.0 / (3 * weights.len().max(1)) as f64;
        for w in &mut weights {
            *w = if total > 0.0 { *w / total } else { even };
        }
        let size = 3 * self.wavelengths_nm.len();
        let samples = || self.shapes.iter().zip(&weights).flat_map(|(shapes, w)| shapes.iter().map(move |s| (s, *w)));
        let mut mean = vec![0.0; size];
        for (shape, weight) in samples() {
            mean.iter_mut().zip(shape).for_each(|(mean, value)| *mean += weight * value);
        }
        let mut covariance = vec![0.0; size * size];
        for (shape, weight) in samples() {
            let off: Vec<f64> = shape.iter().zip(&mean).map(|(value, mean)| value - mean).collect();
            for (row, by) in covariance.chunks_mut(size).zip(&off) {
                row.iter_mut().zip(&off).for_each(|(value, other)| *value += WIDENED * weight * by * other);
            }
        }
        let count = self.wavelengths_nm.len();
        for (at, value) in covariance.iter_mut().enumerate() {
            if at / size / count != at % size / count {
                *value *= BETWEEN;
            }
        }
        self.add_smooth(&mean, &mut covariance);
        let mut prior = Prior { mean, covariance };
        for c in 0..3 {
            let sum: Vec<f64> = (0..size).map(|at| f64::from(u8::from(at / count == c))).collect();
            prior.condition(&sum, 1.0, SUM * SUM);
        }
        prior
    }

    fn add_smooth(&self, mean: &[f64], covariance: &mut [f64]) {
        let (count, size) = (self.wavelengths_nm.len(), mean.len());
        for (c, curve) in mean.chunks(count.max(1)).enumerate() {
            let peak = curve.iter().copied().fold(0.0, f64::max);
            for (i, x) in self.wavelengths_nm.iter().enumerate() {
                for (j, y) in self.wavelengths_nm.iter().enumerate() {
                    let rough = if i == j { ROUGH * ROUGH } else { 0.0 };
                    let smooth = SMOOTH * SMOOTH * (-0.5 * ((x - y) / SMOOTH_NM).powi(2)).exp();
                    covariance[(c * count + i) * size + c * count + j] += peak * peak * (smooth + rough);
                }
            }
        }
    }

    /// Tables by their distance from curves, nearest first: the root mean square over the samples of a channel, at the scale that fits best,
    /// relative to its own; of the three channels together.
    pub fn nearest(&self, curves: &[Vec<f64>; 3]) -> Vec<(&str, f64)> {
        let count = self.wavelengths_nm.len().max(1);
        let distance = |shape: &Vec<f64>| {
            let squares = shape.chunks(count).zip(curves).map(|(table, own)| relative_distance(own, table).powi(2));
            (squares.sum::<f64>() / 3.0).sqrt()
        };
        let mut all: Vec<(&str, f64)> =
            self.names.iter().zip(&self.shapes).map(|(name, shapes)| (name.as_str(), distance(&shapes[0]))).collect();
        all.sort_by(|a, b| a.1.total_cmp(&b.1));
        all
    }
}

impl Prior {
    /// Conditions on a linear function of the curves that was observed with a variance.
    pub(super) fn condition(&mut self, function: &[f64], observed: f64, variance: f64) {
        let size = self.mean.len();
        let gain = times(&self.covariance, function);
        let dot = |a: &[f64]| a.iter().zip(function).map(|(a, b)| a * b).sum::<f64>();
        let (total, off) = (dot(&gain) + variance, observed - dot(&self.mean));
        self.mean.iter_mut().zip(&gain).for_each(|(mean, by)| *mean += by * off / total);
        for (row, by) in self.covariance.chunks_mut(size).zip(&gain) {
            row.iter_mut().zip(&gain).for_each(|(value, other)| *value -= by * other / total);
        }
    }

    /// Multiplies all standard deviations.
    pub(super) fn widen(&mut self, by: f64) {
        self.covariance.iter_mut().for_each(|value| *value *= by * by);
    }

    /// Inverse of the covariance; none unless it is positive definite.
    pub(super) fn precision(&self) -> Option<Matrix> {
        Some(Cholesky::new(self.covariance.clone(), self.mean.len())?.inverse())
    }
}

/// Root mean square of a curve's difference from another, which is scaled to fit, relative to that of the curve.
pub(super) fn relative_distance(own: &[f64], other: &[f64]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let [square, across, theirs] = [dot(own, own), dot(own, other), dot(other, other)];
    if square > 0.0 && theirs > 0.0 { (1.0 - across * across / (square * theirs)).max(0.0).sqrt() } else { 1.0 }
}

/// Curves of the grid at some wavelengths, linear between its samples; red, green and blue in a row, each with the sum 1.
fn sampled(grid: &[[f64; 3]], wavelengths_nm: &(impl Iterator<Item = f64> + Clone)) -> Vec<f64> {
    let at = |nm: f64, c: usize| {
        let place = (nm - FIRST_NM).clamp(0.0, (COUNT - 1) as f64);
        let (low, part) = (place.floor() as usize, place.fract());
        grid[low][c] * (1.0 - part) + grid[(low + 1).min(COUNT - 1)][c] * part
    };
    let mut all = Vec::new();
    for c in 0..3 {
        let curve: Vec<f64> = wavelengths_nm.clone().map(|nm| at(nm, c)).collect();
        let sum = curve.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        all.extend(curve.iter().map(|value| value / sum));
    }
    all
}
