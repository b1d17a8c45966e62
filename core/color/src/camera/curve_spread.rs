//! Spread of published sensitivities of one camera model between laboratories: what a table of an unknown laboratory may be off by.

use crate::math::dot::dot;
use crate::math::interpolation::Sprague;
use crate::math::normal::CovarianceRoot;
use crate::spectral::grid::{COUNT, FIRST_NM};
use crate::spectral::{Dataset, Sensor};
use crate::units::{bits, hash_by};
use multiversion::multiversion;

/// Wavelengths that the spread is known at: 400, 410, …, 700 nm.
pub const SITES: usize = 31;
const FIRST_SITE_NM: f64 = 400.0;
const STEP_NM: f64 = 10.0;
/// Places of the first and the last of them on the grid.
pub const SITE_RANGE: [usize; 2] = [20, 320];

/// Modes of the covariance.
const MODES: usize = 8;
/// Distance from the mean of the models' curves beyond which a sensor is unlike them: one and a half times that of the farthest.
const UNLIKE: f64 = 1.5 * 0.071;

/// Deviations of the three channels at the sites, in units of the channel's peak.
pub type Deviation = [[f64; SITES]; 3];

/// Covariance of the tables of one model that different laboratories published, relative to each channel's peak.
///
/// ```text
/// Σ = Σ_k m_k m_kᵀ + s² I,   8 modes m_k over red, green and blue together, s = 0.0054
/// ```
/// From 24 tables of 10 models on 400–700 nm by 10 nm. The ratio of the channels is not in it.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveSpread {
    modes: Vec<Deviation>,
    rest: f64,
    mean: Deviation,
}

/// Reason that a data file is no [`CurveSpread`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected 8 modes of red, green and blue, the rest and the mean of each, at 400, 410, …, 700 nm")]
pub struct CurveSpreadError;

hash_by!(CurveSpread, |of| of.modes.iter().flatten().flatten().map(|&v| bits(v)).collect::<Vec<_>>());

impl CurveSpread {
    /// Degrees of freedom of the covariance: 24 tables less 10 means of models.
    pub const FREEDOM: f64 = 14.0;

    /// The spread of a data file with the columns `red_1` to `blue_8`, `rest`, `red_mean`, `green_mean` and `blue_mean`.
    ///
    /// # Errors
    /// [`CurveSpreadError`] for other columns or wavelengths.
    pub fn from_dataset(dataset: &Dataset) -> Result<Self, CurveSpreadError> {
        let columns: Vec<[f64; SITES]> = dataset
            .curves
            .iter()
            .filter(|curve| curve.range_nm()[0] == FIRST_SITE_NM && curve.uniform_step_nm() == Some(STEP_NM))
            .map(|curve| <[f64; SITES]>::try_from(curve.values()).map_err(|_| CurveSpreadError))
            .collect::<Result<_, _>>()?;
        let Some((modes, [rest, means @ ..])) = columns.split_at_checked(3 * MODES) else {
            return Err(CurveSpreadError);
        };
        let mean = Deviation::try_from(means).map_err(|_| CurveSpreadError)?;
        Ok(Self { modes: modes.as_chunks::<3>().0.to_vec(), rest: rest[0], mean })
    }

    /// True if a sensor resembles the ten models that the spread is of: the root mean square of its curves' distance from the models'
    /// mean, peaks at 1, is at most one and a half times that of the farthest model.
    pub fn is_of_kind(&self, curves: &Deviation) -> bool {
        let pairs = curves.iter().flatten().zip(self.mean.iter().flatten());
        let squares: f64 = pairs.map(|(own, mean)| (own - mean).powi(2)).sum();
        (squares / (3 * SITES) as f64).sqrt() <= UNLIKE
    }

    /// Draws of the deviation: in pairs of opposite sign, with mean zero and exactly the covariance of the spread, the same at each call.
    /// What depends linearly on the curves thus has exactly its linearized uncertainty.
    pub fn draws(&self) -> Vec<Deviation> {
        let modes = self.modes.iter().map(|mode| (0, mode.concat()));
        let rest = (0..3 * SITES).map(|sample| (sample, vec![self.rest]));
        let root = CovarianceRoot::new(3 * SITES, modes.chain(rest).collect());
        let deviation = |draw: Vec<f64>| [0, 1, 2].map(|c: usize| std::array::from_fn(|site| draw[c * SITES + site]));
        root.draws(&[]).map(deviation).collect()
    }
}

/// The deviation of 1 at one site and 0 at all others on the grid, brought there as tables at 10 nm are (CIE 167).
pub fn site_curve(site: usize) -> [f64; COUNT] {
    let mut samples = [0.0; SITES];
    samples[site] = 1.0;
    let mut values = [0.0; COUNT];
    if let Some(sprague) = Sprague::new(FIRST_SITE_NM, STEP_NM, &samples) {
        for (index, value) in values.iter_mut().enumerate().take(SITE_RANGE[1] + 1).skip(SITE_RANGE[0]) {
            *value = sprague.at(FIRST_NM + index as f64);
        }
    }
    values
}

/// Spectra side by side: two registers of any width, because the sums of one wait for each other.
pub const LANES: usize = 16;

/// Responses to spectra of a deviation of 1 at each site, from which those of any deviation follow.
#[derive(Clone, Debug, PartialEq)]
pub struct SiteResponses(Vec<[[f64; LANES]; SITES]>);

/// Responses to spectra of a deviation of 1 at each site, integrated over 400–700 nm as tables are, with half weights at the ends.
pub fn site_responses(spectra: &[[f64; COUNT]]) -> Vec<[f64; SITES]> {
    let sites: [[f64; COUNT]; SITES] = std::array::from_fn(|site| {
        let mut weighted = site_curve(site);
        for end in SITE_RANGE {
            weighted[end] *= 0.5;
        }
        weighted
    });
    spectra.iter().map(|spectrum| sites.each_ref().map(|site| dot(site, spectrum))).collect()
}

impl SiteResponses {
    /// These responses to each spectrum.
    pub fn new(responses: &[[f64; SITES]]) -> Self {
        let block = |responses: &[[f64; SITES]]| {
            std::array::from_fn(|site| std::array::from_fn(|lane| responses.get(lane).map_or(0.0, |of| of[site])))
        };
        Self(responses.chunks(LANES).map(block).collect())
    }

    /// Responses of each of the three channels' deviations to [`LANES`] spectra after the other; beyond the last, zeros.
    pub fn of(&self, deviation: &Deviation) -> impl Iterator<Item = [[f64; LANES]; 3]> {
        self.0.iter().map(|block| response(block, deviation))
    }
}

/// No operation is fused, so that all instruction sets give the same bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn response(block: &[[f64; LANES]; SITES], deviation: &Deviation) -> [[f64; LANES]; 3] {
    let mut sums = [[0.0; LANES]; 3];
    for (site, row) in block.iter().enumerate() {
        let [red, green, blue] = [deviation[0][site], deviation[1][site], deviation[2][site]];
        for lane in 0..LANES {
            sums[0][lane] += red * row[lane];
            sums[1][lane] += green * row[lane];
            sums[2][lane] += blue * row[lane];
        }
    }
    sums
}

/// A sensor's curves at the sites with each channel's peak between them at 1, and these peaks.
pub fn at_sites(sensor: &Sensor) -> (Deviation, [f64; 3]) {
    let [first, last] = SITE_RANGE;
    let curves = [0, 1, 2].map(|channel| sensor.on_grid(channel));
    let peaks = curves.each_ref().map(|curve| curve[first..=last].iter().copied().fold(f64::MIN_POSITIVE, f64::max));
    let step = STEP_NM as usize;
    let at = |c: usize| std::array::from_fn(|site| curves[c][first + step * site] / peaks[c]);
    ([at(0), at(1), at(2)], peaks)
}
