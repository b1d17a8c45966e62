//! Uncertainty that a file states for the samples of its curves, and its propagation (JCGM 100:2008, 5.1 and 5.2).

use super::sensor::{Response, Sensor, per_energy};
use crate::math::dot::dot;
use crate::units::{bits, hash_by};

/// Largest number of samples that an uncertainty is propagated from.
pub const MOST_SAMPLES: usize = 12_000;
/// Part of a sample's variance below which what the others leave of it counts as rounding of the file.
const ROUNDING: f64 = 1e-5;
/// Correlation beyond the possible that rounding of the file explains.
const IMPOSSIBLE: f64 = 1e-3;

/// Correlation of the errors of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Correlation {
    /// Errors of all samples are uncorrelated.
    None,
    /// Errors within a curve have a correlation of +1: one number times the uncertainty of each sample. Curves share it or have one each,
    /// whichever gives more.
    Full,
    /// A covariance that the file states.
    Stated,
}

impl Correlation {
    /// Word in tables.
    pub const fn word(self) -> &'static str {
        match self {
            Self::None => "uncorrelated",
            Self::Full => "fully correlated",
            Self::Stated => "covariance",
        }
    }
}

/// Reason that an uncertainty cannot be propagated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum StatedUncertaintyError {
    #[error("the covariance has {found} numbers for {samples} samples")]
    Size { samples: usize, found: usize },
    #[error(
        "the covariance is not positive semidefinite: some errors would be correlated beyond ±1; correct it, or state more digits"
    )]
    Indefinite,
    #[error("more than {MOST_SAMPLES} samples with an uncertainty; resample the curves to fewer")]
    Samples,
}

/// Standard uncertainties of the samples of some curves, as their file states them, with the correlation if it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedUncertainty {
    standard: Vec<Vec<f64>>,
    root: Option<Vec<Vec<f64>>>,
    coverage: f64,
}

hash_by!(StatedUncertainty, |of| {
    let numbers = of.standard.iter().chain(of.root.iter().flatten()).flatten();
    (bits(of.coverage), numbers.map(|&v| bits(v)).collect::<Vec<_>>())
});

impl StatedUncertainty {
    /// Standard uncertainties of each curve's samples, finite and not negative, and the coverage factor that the file states them with.
    ///
    /// # Errors
    /// [`StatedUncertaintyError::Samples`] beyond [`MOST_SAMPLES`].
    pub fn new(standard: Vec<Vec<f64>>, coverage: f64) -> Result<Self, StatedUncertaintyError> {
        let samples: usize = standard.iter().map(Vec::len).sum();
        if samples > MOST_SAMPLES {
            return Err(StatedUncertaintyError::Samples);
        }
        Ok(Self { standard, root: None, coverage })
    }

    /// The same with the covariance of all samples, curve after curve, by rows; the uncertainties are then those of its diagonal.
    ///
    /// # Errors
    /// [`StatedUncertaintyError`] for another size, or a matrix with a negative eigenvalue beyond the rounding of its numbers.
    pub fn with_covariance(self, covariance: &[f64]) -> Result<Self, StatedUncertaintyError> {
        let samples = self.standard.iter().map(Vec::len).sum();
        if covariance.len() != samples * samples {
            return Err(StatedUncertaintyError::Size { samples, found: covariance.len() });
        }
        let root = Some(root(covariance, samples).ok_or(StatedUncertaintyError::Indefinite)?);
        let mut diagonal = (0..samples).map(|at| covariance[at * samples + at].max(0.0).sqrt());
        let standard = self.standard.iter().map(|curve| diagonal.by_ref().take(curve.len()).collect()).collect();
        Ok(Self { standard, root, ..self })
    }

    /// Standard uncertainties of each curve's samples.
    pub fn standard(&self) -> &[Vec<f64>] {
        &self.standard
    }

    /// Coverage factor that the file states its uncertainties with.
    pub fn coverage(&self) -> f64 {
        self.coverage
    }

    /// True if it is of curves with these numbers of samples.
    pub fn is_of(&self, lengths: impl IntoIterator<Item = usize>) -> bool {
        self.standard.iter().map(Vec::len).eq(lengths)
    }

    /// Uncertainty of the curves with each sample multiplied by a factor, by curve and sample.
    #[must_use]
    pub fn scaled(&self, factor: impl Fn(usize, usize) -> f64) -> Self {
        let curve = |c: usize| self.standard[c].iter().enumerate().map(|(j, _)| factor(c, j)).collect();
        let factors: Vec<Vec<f64>> = (0..self.standard.len()).map(curve).collect();
        let product = |a: &Vec<f64>, b: &Vec<f64>| a.iter().zip(b).map(|(a, b)| a * b.abs()).collect();
        let column = |column: &Vec<f64>| column.iter().zip(factors.iter().flatten()).map(|(a, b)| a * b).collect();
        Self {
            standard: self.standard.iter().zip(&factors).map(|(own, by)| product(own, by)).collect(),
            root: self.root.as_ref().map(|root| root.iter().map(column).collect()),
            coverage: self.coverage,
        }
    }

    /// Uncertainty of a sensor's curves per unit energy, of one as the sensor's file states it; none of other curves.
    pub fn per_energy(&self, sensor: &Sensor) -> Option<Self> {
        let curves = sensor.curves();
        self.is_of(curves.iter().map(|curve| curve.values().len())).then_some(())?;
        let is_per_photon = sensor.response() == Response::PerPhoton;
        let factor =
            |c: usize, j: usize| if is_per_photon { per_energy(curves[c].wavelengths_nm()[j], 1.0) } else { 1.0 };
        Some(self.scaled(factor))
    }

    /// Errors of the samples under each correlation that is possible: the stated one; or none, full among all, and full within each curve.
    pub fn errors(&self) -> impl Iterator<Item = Errors<'_>> {
        let kinds: &[_] = match &self.root {
            Some(_) => &[(Correlation::Stated, false)],
            None => &[(Correlation::None, false), (Correlation::Full, false), (Correlation::Full, true)],
        };
        kinds.iter().map(|&(correlation, by_curve)| Errors { of: self, correlation, by_curve })
    }
}

/// Errors of samples as a linear map of independent standard normal numbers: `A z` with the covariance `A Aᵀ`.
#[derive(Clone, Copy, Debug)]
pub struct Errors<'a> {
    of: &'a StatedUncertainty,
    /// Their correlation.
    pub correlation: Correlation,
    by_curve: bool,
}

impl Errors<'_> {
    /// Number of independent numbers.
    pub fn dimensions(&self) -> usize {
        match (self.correlation, &self.of.root) {
            (Correlation::Stated, Some(root)) => root.len(),
            (Correlation::Full, _) if self.by_curve => self.of.standard.len(),
            (Correlation::Full, _) => 1,
            _ => self.of.standard.iter().map(Vec::len).sum(),
        }
    }

    /// Place of each sample's number, with its uncertainty; not for a stated covariance.
    fn places(&self) -> impl Iterator<Item = (usize, f64)> {
        let each = self.of.standard.iter().enumerate().flat_map(|(curve, own)| own.iter().map(move |u| (curve, *u)));
        each.enumerate().map(|(sample, (curve, u))| match self.correlation {
            Correlation::Full if self.by_curve => (curve, u),
            Correlation::Full => (0, u),
            _ => (sample, u),
        })
    }

    /// Errors of all samples, curve after curve: `A z`.
    pub fn of(&self, numbers: &[f64]) -> Vec<f64> {
        let Some(root) = &self.of.root else {
            return self.places().map(|(place, u)| u * numbers[place]).collect();
        };
        let mut all = vec![0.0; self.of.standard.iter().map(Vec::len).sum()];
        for (column, by) in root.iter().zip(numbers) {
            all.iter_mut().zip(column).for_each(|(value, part)| *value += by * part);
        }
        all
    }

    /// Derivatives by the numbers from those by the samples: `Aᵀ g`.
    pub fn transposed(&self, derivatives: &[f64]) -> Vec<f64> {
        if let Some(root) = &self.of.root {
            return root.iter().map(|column| dot(column, derivatives)).collect();
        }
        let mut all = vec![0.0; self.dimensions()];
        self.places().zip(derivatives).for_each(|((place, u), by)| all[place] += u * by);
        all
    }
}

/// Columns of `A` with `A Aᵀ` the covariance, by Cholesky's method with complete pivoting on the correlations; none for a matrix that has a
/// negative eigenvalue beyond rounding.
fn root(covariance: &[f64], count: usize) -> Option<Vec<Vec<f64>>> {
    let scale: Vec<f64> = (0..count).map(|i| covariance[i * count + i].max(0.0).sqrt()).collect();
    let correlation = |i: usize, j: usize| match (covariance[i * count + j], scale[i] * scale[j]) {
        (value, product) if product > 0.0 => value / product,
        // A sample without variance has no covariance either.
        (value, _) => {
            if value == 0.0 {
                0.0
            } else {
                f64::INFINITY
            }
        }
    };
    let mut rest: Vec<Vec<f64>> = (0..count).map(|i| (0..count).map(|j| correlation(i, j)).collect()).collect();
    if !rest.iter().flatten().all(|value| value.abs() <= 1.0 + IMPOSSIBLE) {
        return None;
    }
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for _ in 0..count {
        let pivot = (0..count).max_by(|&a, &b| rest[a][a].total_cmp(&rest[b][b])).filter(|&at| rest[at][at] > ROUNDING);
        let Some(pivot) = pivot else { break };
        let length = rest[pivot][pivot].sqrt();
        let column: Vec<f64> = rest[pivot].iter().map(|v| v / length).collect();
        for (row, by) in rest.iter_mut().zip(&column) {
            row.iter_mut().zip(&column).for_each(|(value, part)| *value -= by * part);
        }
        columns.push(column.iter().zip(&scale).map(|(v, by)| v * by).collect());
    }
    rest.iter().flatten().all(|v| v.abs() <= IMPOSSIBLE).then_some(columns)
}
