//! Uncertainty that a file states for the samples of its curves, and its propagation (JCGM 100:2008, 5.1 and 5.2).

use super::SpectralDistribution;
use super::grid::wavelength_nm;
use super::sensor::{Response, Sensor, per_energy};
use crate::math::normal::CovarianceRoot;
use crate::units::{bits, hash_by};

/// Largest number of samples that an uncertainty is propagated from.
pub const MOST_SAMPLES: usize = 12_000;

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
    root: Option<CovarianceRoot>,
    coverage: f64,
}

hash_by!(StatedUncertainty, |of| {
    (bits(of.coverage), of.root.is_some(), of.standard.iter().flatten().map(|&v| bits(v)).collect::<Vec<_>>())
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
        let root = Some(CovarianceRoot::of(covariance, samples).ok_or(StatedUncertaintyError::Indefinite)?);
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

    /// Uncertainty of a sensor's curves per unit energy, of one as the sensor's file states it; none of other curves.
    pub fn per_energy(&self, sensor: &Sensor) -> Option<Self> {
        self.is_of(sensor.curves()).then_some(())?;
        if sensor.response() != Response::PerPhoton {
            return Some(self.clone());
        }
        let factors =
            |curve: &SpectralDistribution| curve.wavelengths_nm().iter().map(|nm| per_energy(*nm, 1.0)).collect();
        let factors: [Vec<f64>; 3] = sensor.curves().each_ref().map(factors);
        let product = |(own, by): (&Vec<f64>, &Vec<f64>)| own.iter().zip(by).map(|(u, by)| u * by).collect();
        Some(Self {
            standard: self.standard.iter().zip(&factors).map(product).collect(),
            root: self.root.as_ref().map(|root| root.scaled(&factors.concat())),
            coverage: self.coverage,
        })
    }

    fn is_of<'a>(&self, curves: impl IntoIterator<Item = &'a SpectralDistribution>) -> bool {
        self.standard.iter().map(Vec::len).eq(curves.into_iter().map(|curve| curve.values().len()))
    }

    /// The curves with errors drawn under each correlation that is possible: the stated one; or none, full among all, and full within each
    /// curve. None unless the uncertainty is of these curves; no draw where an error is too large for a spectrum.
    ///
    /// What depends linearly on integrals of the curves with some spectra on the grid has exactly its linearized uncertainty; for curves of
    /// many samples at other wavelengths than the grid's all but exactly.
    pub fn draws<'a>(
        &self,
        curves: &'a [SpectralDistribution],
        spectra: &[Vec<f64>],
    ) -> Option<Vec<(Correlation, impl Iterator<Item = Option<Vec<SpectralDistribution>>> + use<'a>)>> {
        self.is_of(curves).then_some(())?;
        let kernels = kernels(curves, spectra);
        let draws = |(correlation, root): (_, CovarianceRoot)| {
            (correlation, root.draws(&kernels).map(|errors| shifted(curves, &errors)))
        };
        Some(self.roots().into_iter().map(draws).collect())
    }

    fn roots(&self) -> Vec<(Correlation, CovarianceRoot)> {
        if let Some(root) = &self.root {
            return vec![(Correlation::Stated, root.clone())];
        }
        let all = self.standard.concat();
        let of = |parts: &mut dyn Iterator<Item = &[f64]>| {
            let mut first = 0;
            let column = |part: &[f64]| {
                first += part.len();
                (first - part.len(), part.to_vec())
            };
            CovarianceRoot::new(all.len(), parts.map(column).collect())
        };
        let mut roots =
            vec![(Correlation::None, of(&mut all.chunks(1))), (Correlation::Full, of(&mut std::iter::once(&all[..])))];
        if self.standard.len() > 1 {
            roots.push((Correlation::Full, of(&mut self.standard.iter().map(Vec::as_slice))));
        }
        roots
    }
}

/// Derivatives of the integrals of each curve with some spectra by the samples of all curves: each wavelength counts for the nearest sample.
fn kernels(curves: &[SpectralDistribution], spectra: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let count = curves.iter().map(|curve| curve.values().len()).sum();
    let (mut kernels, mut first) = (Vec::new(), 0);
    for curve in curves {
        let nm = curve.wavelengths_nm();
        kernels.extend(spectra.iter().map(|spectrum| {
            let mut kernel = vec![0.0; count];
            for (at, value) in spectrum.iter().enumerate() {
                let x = wavelength_nm(at);
                let above = nm.partition_point(|own| *own < x);
                let is_above = above < nm.len() && (above == 0 || nm[above] - x <= x - nm[above - 1]);
                kernel[first + above - usize::from(!is_above)] += value;
            }
            kernel
        }));
        first += nm.len();
    }
    kernels
}

/// The curves with errors of their samples, curve after curve.
fn shifted(curves: &[SpectralDistribution], errors: &[f64]) -> Option<Vec<SpectralDistribution>> {
    let mut errors = errors.iter();
    let shifted = |curve: &SpectralDistribution| {
        let values = curve.values().iter().zip(&mut errors).map(|(value, by)| value + by).collect();
        SpectralDistribution::new(curve.wavelengths_nm().to_vec(), values).ok()
    };
    curves.iter().map(shifted).collect()
}
