//! Metrics of a camera whose curves deviate a little: from its linear responses alone, which deviate as the curves do.

use super::differences::{DifferenceConditions, PatchDifferences};
use super::evidence::{Evidence, IndexSamplesQuery, ReferenceLocusQuery, channel_scale, noise_of};
use super::table::CameraMetric;
use super::value::{CameraMetricsQuery, IndexConditions, WhyNot};
use crate::ask::{Ask, Query, Shared};
use crate::patches::{FitTargetsQuery, PatchColor, PatchColorsQuery, color};
use chromascope_color::camera::curve_spread::{Deviation, SITE_RANGE, SITES, site_curve};
use chromascope_color::camera::quality::{IndexSamples, MetamerismIndex, SpaceQuality, curves};
use chromascope_color::camera::{FitTargets, LocusDeviation, ReferenceLocus, Rendering, RenderingError};
use chromascope_color::correction::minimize::Refit;
use chromascope_color::correction::{CorrectionMethod, RgbTransform};
use chromascope_color::light::RadiationConstants;
use chromascope_color::light::planckian::black_body;
use chromascope_color::patch_set::PatchSet;
use chromascope_color::spectral::grid::COUNT;
use chromascope_color::spectral::{GridSpectrum, Sensor};
use chromascope_color::units::Kelvin;
use chromascope_math::dot::{dot, dot_each};
use glam::{DMat3, DVec3};
use std::ops::Range;
use std::sync::Arc;

/// Sites of a deviation, filled up so that dot products have no rest.
const PADDED: usize = 32;
/// Places of single stimuli: the light, equal energy, the blackbody, the light of the index. Then come patches under their lights.
const LIGHT: usize = 0;
const FLAT: usize = 1;
const BLACKBODY: usize = 2;
const INDEX_LIGHT: usize = 3;
const SINGLE: usize = 4;
/// Patches under their lights that tables are drawn with their exact covariance to.
const PATCHES: usize = 24;

/// Spectra that a camera's responses to determine its metrics.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct StimuliQuery {
    light: Shared<GridSpectrum>,
    patches: Shared<PatchSet>,
    training: Option<Shared<PatchSet>>,
    index: IndexConditions,
    temperature: Kelvin,
    observer: Shared<Sensor>,
}

/// Those spectra, with the response to each of a deviation of 1 at each site; and what the metrics of spaces need.
pub(super) struct Stimuli {
    spectra: Vec<[f64; COUNT]>,
    of_sites: Vec<[f64; PADDED]>,
    patches: Range<usize>,
    training: Range<usize>,
    index: Range<usize>,
    sites: Vec<[f64; COUNT]>,
    matching: [Vec<f64>; 3],
}

impl StimuliQuery {
    pub(super) fn new(of: &CameraMetricsQuery) -> Self {
        Self {
            light: of.rendering.light.clone(),
            patches: of.patches.clone(),
            training: of.rendering.transform.fit().map(|(_, training, _)| training.clone()),
            index: of.index.clone(),
            temperature: of.temperature,
            observer: of.reference.sensor.clone(),
        }
    }
}

impl Query for StimuliQuery {
    type Answer = Stimuli;
    const NAME: &'static str = "stimuli of metrics";

    fn answer(&self, _: &impl Ask) -> Stimuli {
        let index_light = &self.index.light;
        let equal = GridSpectrum::constant(1.0);
        let blackbody = black_body(self.temperature, RadiationConstants::Paper);
        let single = [&*self.light, &equal, &blackbody, &**index_light];
        let mut spectra: Vec<[f64; COUNT]> = single.map(|light| *light.values()).into();
        let mut add = |light: &GridSpectrum, patches: &PatchSet| {
            let first = spectra.len();
            spectra.extend(patches.patches().iter().map(|patch| *light.times(&patch.grid).values()));
            first..spectra.len()
        };
        let patches = add(&self.light, &self.patches);
        let training = self.training.as_ref().map_or(SINGLE..SINGLE, |training| add(&self.light, training));
        let index = add(index_light, &self.index.patches);
        let sites: Vec<[f64; COUNT]> = (0..SITES).map(site_curve).collect();
        let weighted: Vec<[f64; COUNT]> = sites.iter().map(trapezoid).collect();
        let of_sites = |spectrum: &[f64]| padded(weighted.iter().map(|curve| dot(curve, spectrum)));
        let matching = curves(&self.observer);
        let of_sites = spectra.iter().map(|spectrum| of_sites(spectrum)).collect();
        Stimuli { spectra, of_sites, patches, training, index, sites, matching }
    }
}

/// Half weights at the ends of 400–700 nm, as integrals of tables have them.
fn trapezoid(curve: &[f64; COUNT]) -> [f64; COUNT] {
    let mut weighted = *curve;
    for end in SITE_RANGE {
        weighted[end] *= 0.5;
    }
    weighted
}

fn padded(values: impl Iterator<Item = f64>) -> [f64; PADDED] {
    let mut filled = [0.0; PADDED];
    filled.iter_mut().zip(values).for_each(|(place, value)| *place = value);
    filled
}

/// A camera with all that its metrics under deviations need.
pub(super) struct Perturbed<'a> {
    of: &'a CameraMetricsQuery,
    stimuli: &'a Stimuli,
    peaks: DVec3,
    raw: Vec<DVec3>,
    targets: Option<Arc<Result<FitTargets, RenderingError>>>,
    refit: Option<Refit>,
    conditioning: f64,
    index: Arc<Result<IndexSamples, RenderingError>>,
    index_refit: Option<Refit>,
    reference: Arc<Result<Vec<PatchColor>, RenderingError>>,
    way: DifferenceConditions,
    locus: Arc<Result<ReferenceLocus<Shared<Sensor>>, RenderingError>>,
    /// Curves, peaks at 1.
    curves: [Vec<f64>; 3],
    scale: Result<(), WhyNot>,
}

impl<'a> Perturbed<'a> {
    /// Prepares a camera; none that cannot be shown under these conditions.
    pub(super) fn new(
        of: &'a CameraMetricsQuery,
        stimuli: &'a Stimuli,
        peaks: [f64; 3],
        ask: &impl Ask,
    ) -> Option<Self> {
        let sensor = &of.rendering.sensor;
        let raw: Vec<DVec3> = stimuli.spectra.iter().map(|s| DVec3::from_array(sensor.integrate(s))).collect();
        let (reference, patches) = (of.reference.clone(), of.patches.clone());
        let rendering = ask.ask(&of.rendering);
        let rendering = (*rendering).as_ref().ok()?;
        let index = ask.ask(&IndexSamplesQuery(of.index.clone()));
        let mut found = Self {
            targets: of.rendering.transform.fit().map(|(reference, training, _)| {
                let (reference, light) = (reference.clone(), of.rendering.light.clone());
                ask.ask(&FitTargetsQuery { reference, light, training: training.clone() })
            }),
            refit: None,
            conditioning: rendering.conditioning,
            index_refit: None,
            index,
            reference: ask.ask(&PatchColorsQuery { rendering: reference.clone(), patches }),
            way: DifferenceConditions::new(&of.rendering, &reference),
            locus: ask.ask(&ReferenceLocusQuery(reference)),
            curves: [0, 1, 2].map(|c: usize| (0..COUNT).map(|i| sensor.at_index(i)[c] / peaks[c]).collect()),
            scale: channel_scale(sensor),
            peaks: DVec3::from_array(peaks),
            of,
            stimuli,
            raw,
        };
        found.refit = found.near(rendering);
        let samples = found.index_samples(&found.raw);
        found.index_refit = (*found.index).as_ref().ok().and_then(|index| index.refit(&samples));
        Some(found)
    }

    /// Fits near the camera's own, for those that are searched.
    fn near(&self, rendering: &Rendering) -> Option<Refit> {
        let (_, _, correction) = self.of.rendering.transform.fit()?;
        let targets = self.targets.as_ref()?;
        let unity = rendering.xyz_from_signals * DMat3::from_diagonal(rendering.white);
        let samples = balanced(&self.raw[self.stimuli.training.clone()], self.raw[LIGHT]);
        (**targets).as_ref().ok()?.refit(&samples, &correction, &RgbTransform::Matrix(unity))
    }

    fn index_samples(&self, raw: &[DVec3]) -> Vec<DVec3> {
        balanced(&raw[self.stimuli.index.clone()], raw[INDEX_LIGHT])
    }

    pub(super) fn values(&self, deviation: &Deviation) -> Vec<Result<f64, WhyNot>> {
        let moved = deviation.map(|channel| padded(channel.into_iter()));
        let shift = |of_sites: &[f64; PADDED]| {
            self.peaks * DVec3::from_array(dot_each([&moved[0], &moved[1], &moved[2]], of_sites))
        };
        let raw: Vec<DVec3> =
            self.raw.iter().zip(&self.stimuli.of_sites).map(|(own, sites)| *own + shift(sites)).collect();
        self.evidence(&raw, self.space(deviation)).values()
    }

    /// Metrics through another table of the camera.
    pub(super) fn values_through(&self, sensor: &Sensor) -> Vec<Result<f64, WhyNot>> {
        let raw: Vec<DVec3> =
            self.stimuli.spectra.iter().map(|spectrum| DVec3::from_array(sensor.integrate(spectrum))).collect();
        self.evidence(&raw, SpaceQuality::of(&curves(sensor), &self.stimuli.matching)).values()
    }

    /// Some spectra that the camera's responses to all but determine its metrics: its own curves, the observer's, single stimuli and some of
    /// the patches.
    pub(super) fn leading(&self) -> Vec<Vec<f64>> {
        let (single, patches) = self.stimuli.spectra.split_at(SINGLE);
        let patches = patches.iter().step_by(patches.len().div_ceil(PATCHES).max(1));
        let stimuli = single.iter().chain(patches).map(|spectrum| spectrum.to_vec());
        self.curves.iter().chain(&self.stimuli.matching).cloned().chain(stimuli).collect()
    }

    fn evidence(&self, raw: &[DVec3], space: Option<SpaceQuality>) -> Evidence {
        let (patches, locus, (noise, snr_db)) = match self.rendering(raw) {
            Ok(rendering) => (
                self.patches(&rendering, raw),
                self.locus(&rendering, raw[BLACKBODY]),
                noise_of(&rendering, self.of.electrons, self.scale),
            ),
            Err(error) => (Err(error.into()), Err(error.into()), (Err(error.into()), Err(error.into()))),
        };
        let index = self.index(raw).map_err(WhyNot::from);
        let space = space.ok_or(WhyNot::Dependent);
        Evidence { patches, locus, space, index, noise, scale: self.scale, snr_db }
    }

    fn rendering(&self, raw: &[DVec3]) -> Result<Rendering, RenderingError> {
        let white = DVec3::from_array(self.of.rendering.white.0);
        let integrals = raw[LIGHT];
        if !integrals.cmpgt(DVec3::ZERO).all() {
            return Err(RenderingError::NoWhite);
        }
        let (Some((_, _, correction)), Some(targets)) = (self.of.rendering.transform.fit(), &self.targets) else {
            return Rendering::by_paper(white, integrals, raw[FLAT], self.conditioning);
        };
        let targets = (**targets).as_ref().map_err(|&e| e)?;
        let samples = balanced(&raw[self.stimuli.training.clone()], integrals);
        let transform = match self.refit.as_ref().and_then(|refit| refit.matrix(&samples)) {
            Some(matrix) => RgbTransform::Matrix(matrix),
            None => targets.fit(&samples, &correction)?,
        };
        Rendering::by_fit(targets, transform, white, integrals, (self.conditioning, true))
    }

    fn patches(&self, rendering: &Rendering, raw: &[DVec3]) -> Result<Vec<PatchDifferences>, WhyNot> {
        let reference = (*self.reference).as_ref().map_err(|&e| e)?;
        let pairs = reference.iter().zip(&raw[self.stimuli.patches.clone()]);
        Ok(pairs.map(|(reference, raw)| self.way.differences(reference, &color(rendering, *raw))).collect())
    }

    fn locus(&self, rendering: &Rendering, raw: DVec3) -> Result<LocusDeviation, WhyNot> {
        self.way.comparable?;
        let locus = (*self.locus).as_ref().map_err(|&e| e)?;
        let color = rendering.blackbody(raw.to_array()).uv_prime().ok_or(WhyNot::NoLocus)?;
        locus.deviation(self.of.temperature, color).ok_or(WhyNot::NoLocus)
    }

    fn index(&self, raw: &[DVec3]) -> Result<MetamerismIndex, RenderingError> {
        let index = (*self.index).as_ref().map_err(|&e| e)?;
        let samples = self.index_samples(raw);
        let of = |transform: &RgbTransform| index.of(&samples, transform).ok_or(RenderingError::NoWhite);
        let refit = self.index_refit.as_ref().and_then(|refit| refit.matrix(&samples));
        Ok(MetamerismIndex {
            least_squares: of(&index.fit(&samples, CorrectionMethod::LeastSquares)?)?,
            min_delta_e: of(&RgbTransform::Matrix(refit.ok_or(RenderingError::NoWhite)?))?,
        })
    }

    fn space(&self, deviation: &Deviation) -> Option<SpaceQuality> {
        let mut curves = self.curves.clone();
        for (curve, deviation) in curves.iter_mut().zip(deviation) {
            for (site, by) in self.stimuli.sites.iter().zip(deviation) {
                curve.iter_mut().zip(site).for_each(|(value, site)| *value += by * site);
            }
        }
        SpaceQuality::of(&curves, &self.stimuli.matching)
    }

    /// What each metric may be off by because of the ratio of the channels, its relative standard uncertainty being the same for red and
    /// blue against green; 0 where the balance divides it out.
    pub(super) fn ratio_parts(&self, relative: f64) -> Vec<f64> {
        let Ok(rendering) = self.rendering(&self.raw) else { return vec![0.0; CameraMetric::ALL.len()] };
        let values = |factor: DVec3| -> Vec<Result<f64, WhyNot>> {
            let scaled = Rendering { white_integrals: rendering.white_integrals * factor, ..rendering.clone() };
            let (noise, snr_db) = noise_of(&scaled, self.of.electrons, self.scale);
            let none = WhyNot::NoPatches;
            let (patches, locus, space, index) = (Err(none), Err(none), Err(none), Err(none));
            Evidence { patches, locus, space, index, noise, scale: self.scale, snr_db }.values()
        };
        let ends = [DVec3::X, DVec3::Z].map(|channel| [relative, -relative].map(|step| values((channel * step).exp())));
        let part = |at: usize| {
            let half = |[up, down]: &[Vec<Result<f64, WhyNot>>; 2]| match (up[at], down[at]) {
                (Ok(up), Ok(down)) => (up - down) / 2.0,
                _ => 0.0,
            };
            half(&ends[0]).hypot(half(&ends[1]))
        };
        (0..CameraMetric::ALL.len()).map(part).collect()
    }
}

/// Responses over those to white.
fn balanced(raw: &[DVec3], white: DVec3) -> Vec<DVec3> {
    raw.iter().map(|raw| *raw / white).collect()
}
