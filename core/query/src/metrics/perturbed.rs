//! Metrics of a camera whose curves deviate a little: from its linear responses alone, which deviate as the curves do.

use super::differences::{DifferenceConditions, Seen};
use super::evidence::{
    Evidence, INDEX_METHODS, IndexSamplesQuery, MetamerismIndexQuery, ReferenceLocusQuery, channel_scale, gains, part,
    snr_db,
};
use super::table::CameraMetric;
use super::value::{CameraMetricsQuery, IndexConditions, WhyNot};
use crate::ask::{Ask, Query, Shared};
use crate::patches::{FitTargetsQuery, PatchColor, PatchColorsQuery};
use chromascope_color::camera::curve_spread::{Deviation, LANES, SITES, SiteResponses, site_curve, site_responses};
use chromascope_color::camera::quality::{IndexSamples, ObserverSpace, SpaceQuality, curves};
use chromascope_color::camera::rendering::balanced;
use chromascope_color::camera::{FitTargets, LocusDeviation, ReferenceLocus, Rendering, RenderingError};
use chromascope_color::correction::classes::ClassWeights;
use chromascope_color::correction::minimize::Refit;
use chromascope_color::correction::{Correction, CorrectionMethod, RgbTransform};
use chromascope_color::light::RadiationConstants;
use chromascope_color::light::planckian::black_body;
use chromascope_color::patch_set::PatchSet;
use chromascope_color::spectral::grid::COUNT;
use chromascope_color::spectral::{GridSpectrum, Sensor};
use chromascope_color::units::Kelvin;
use chromascope_math::dot::dot;
use chromascope_math::normal::{coordinates, orthonormal};
use glam::{DMat3, DVec3};
use std::cell::LazyCell;
use std::ops::Range;
use std::sync::Arc;

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
    fit: Option<(FitTargetsQuery, Correction)>,
    index: IndexConditions,
    temperature: Kelvin,
    observer: Shared<Sensor>,
}

/// Those spectra, with the response to each of a deviation of 1 at each site; and what the metrics of spaces need.
pub(super) struct Stimuli {
    spectra: Vec<[f64; COUNT]>,
    of_sites: SiteResponses,
    patches: Range<usize>,
    index: Range<usize>,
    /// Place of the training reflectances, or of their coordinates: the last.
    training: usize,
    targets: Option<Result<FitTargets, RenderingError>>,
    /// Orthonormal basis in which they have coordinates in place of themselves.
    fewer: Option<Vec<Vec<f64>>>,
    observer: Option<ObserverSpace>,
    /// Orthonormal basis of the curves of the sites and of the observer.
    basis: Vec<Vec<f64>>,
    /// Coordinates in it of the curve of each site.
    sites: SiteResponses,
    /// Coordinates in it of the observer's curves.
    seen: [Vec<f64>; 3],
}

impl StimuliQuery {
    pub(super) fn new(of: &CameraMetricsQuery) -> Self {
        Self {
            light: of.rendering.light.clone(),
            patches: of.patches.clone(),
            fit: of.rendering.transform.fit().map(|(reference, training, correction)| {
                let (reference, light) = (reference.clone(), of.rendering.light.clone());
                (FitTargetsQuery { reference, light, training: training.clone() }, correction)
            }),
            index: of.index.clone(),
            temperature: of.temperature,
            observer: of.reference.sensor.clone(),
        }
    }
}

impl Query for StimuliQuery {
    type Answer = Stimuli;
    const NAME: &'static str = "stimuli of metrics";

    fn answer(&self, ask: &impl Ask) -> Stimuli {
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
        let index = add(index_light, &self.index.patches);
        let training = self.fit.as_ref().map_or(index.end, |(fit, _)| add(&self.light, &fit.training).start);
        let mut responses = site_responses(&spectra);
        let mut targets = self.fit.as_ref().map(|(fit, _)| (*ask.ask(fit)).clone());
        let mut fewer = None;
        if let (Some((_, correction)), Some(Ok(targets))) = (&self.fit, &mut targets)
            && correction.method == CorrectionMethod::LeastSquares
            && correction.weights == ClassWeights::default()
        {
            // A fit by least squares is the same in coordinates of any orthonormal basis that samples and targets lie in.
            let of_sites: Vec<Vec<f64>> =
                (0..SITES).map(|site| responses[training..].iter().map(|of| of[site]).collect()).collect();
            let wanted = channels(targets.targets());
            let basis = orthonormal(Vec::new(), of_sites.iter().chain(&wanted));
            let place = |at: usize| basis.get(at);
            responses.truncate(training);
            responses.extend(
                (0..basis.len() + 3)
                    .map(|at| std::array::from_fn(|site| place(at).map_or(0.0, |axis| dot(&of_sites[site], axis)))),
            );
            *targets = targets.with(along(&wanted, &basis, basis.len() + 3));
            fewer = Some(basis);
        }
        let observer = ObserverSpace::new(&self.observer);
        let sites: Vec<Vec<f64>> = (0..SITES).map(|site| site_curve(site).to_vec()).collect();
        let curves = curves(&self.observer);
        let basis = orthonormal(Vec::new(), sites.iter().chain(&curves));
        let along = |axis: &Vec<f64>| std::array::from_fn(|site| dot(&sites[site], axis));
        let sites = SiteResponses::new(&basis.iter().map(along).collect::<Vec<_>>());
        let seen = curves.map(|of| coordinates(&of, &basis));
        Stimuli {
            of_sites: SiteResponses::new(&responses),
            spectra,
            patches,
            index,
            training,
            targets,
            fewer,
            observer,
            basis,
            sites,
            seen,
        }
    }
}

/// Values of red, green and blue.
fn channels(of: &[DVec3]) -> [Vec<f64>; 3] {
    [0, 1, 2].map(|channel| of.iter().map(|value| value[channel]).collect())
}

/// So many coordinates of red, green and blue in an orthonormal basis, 0 where it has fewer.
fn along(of: &[Vec<f64>; 3], basis: &[Vec<f64>], count: usize) -> Vec<DVec3> {
    let axis = |at: usize| basis.get(at).map_or(DVec3::ZERO, |axis| of.each_ref().map(|of| dot(of, axis)).into());
    (0..count).map(axis).collect()
}

impl Stimuli {
    pub(super) fn blackbody(&self) -> &[f64; COUNT] {
        &self.spectra[BLACKBODY]
    }

    /// Responses of a sensor to all stimuli, given those to the training reflectances where they are known.
    fn raw(&self, sensor: &Sensor, training: Option<&[DVec3]>) -> Vec<DVec3> {
        let spectra = training.map_or(&self.spectra[..], |_| &self.spectra[..self.training]);
        let mut raw: Vec<DVec3> =
            spectra.iter().map(|spectrum| DVec3::from_array(sensor.integrate(spectrum))).collect();
        raw.extend(training.unwrap_or_default());
        if let Some(fewer) = &self.fewer {
            let own = channels(&raw.split_off(self.training));
            // What the sensor's own responses add to the basis has places of its own.
            let basis = orthonormal(fewer.clone(), &own);
            raw.extend(along(&own, &basis, fewer.len() + 3));
        }
        raw
    }

    /// The observer's space and a camera's curves in coordinates of one orthonormal basis.
    fn space(&self, curves: &[Vec<f64>; 3]) -> Option<(ObserverSpace, [Vec<f64>; 3])> {
        let basis = orthonormal(self.basis.clone(), curves);
        // Whole registers: sums of their rests would take as long.
        let size = basis.len().next_multiple_of(8);
        let filled = |mut of: Vec<f64>| {
            of.resize(size, 0.0);
            of
        };
        let seen = ObserverSpace::of(self.seen.clone().map(filled))?;
        Some((seen, curves.each_ref().map(|curve| filled(coordinates(curve, &basis)))))
    }
}

/// A camera with all that its metrics under deviations need.
pub(super) struct Perturbed<'a> {
    of: &'a CameraMetricsQuery,
    stimuli: &'a Stimuli,
    peaks: DVec3,
    raw: Vec<DVec3>,
    refit: Option<Refit>,
    conditioning: f64,
    index: Arc<Result<IndexSamples, RenderingError>>,
    index_refit: Option<Refit>,
    reference: Arc<Result<Vec<PatchColor>, RenderingError>>,
    way: DifferenceConditions,
    locus: Arc<Result<ReferenceLocus<Shared<Sensor>>, RenderingError>>,
    /// Curves, peaks at 1.
    curves: [Vec<f64>; 3],
    /// The observer and these curves in coordinates of the stimuli's basis and what the curves add to it: far fewer than wavelengths.
    space: Option<(ObserverSpace, [Vec<f64>; 3])>,
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
        let (reference, patches) = (of.reference.clone(), of.patches.clone());
        let rendering = ask.ask(&of.rendering);
        let rendering = (*rendering).as_ref().ok()?;
        let raw = stimuli.raw(sensor, rendering.training.as_deref());
        let index = ask.ask(&IndexSamplesQuery(of.index.clone()));
        let curves = [0, 1, 2].map(|c: usize| sensor.on_grid(c).iter().map(|value| value / peaks[c]).collect());
        let mut found = Self {
            refit: None,
            conditioning: rendering.conditioning,
            index_refit: None,
            index,
            reference: ask.ask(&PatchColorsQuery { rendering: reference.clone(), patches }),
            way: DifferenceConditions::new(&of.rendering, &reference),
            locus: ask.ask(&ReferenceLocusQuery(reference)),
            space: stimuli.space(&curves),
            curves,
            scale: channel_scale(sensor),
            peaks: DVec3::from_array(peaks),
            of,
            stimuli,
            raw,
        };
        found.refit = found.near(rendering);
        if CameraMetric::by_id("metamerism-index-min").is_some_and(|by| of.wanted.contains(by)) {
            let conditions = of.index.clone();
            let query = MetamerismIndexQuery { sensor: sensor.clone(), conditions, method: INDEX_METHODS[1] };
            let (samples, fitted) = (found.index_samples(&found.raw), ask.ask(&query));
            let index = (*found.index).as_ref().ok().zip((*fitted).as_ref().ok());
            found.index_refit = index.and_then(|(index, (_, fitted))| index.refit(&samples, fitted));
        }
        Some(found)
    }

    /// Fits near the camera's own, for those that are searched.
    fn near(&self, rendering: &Rendering) -> Option<Refit> {
        let (_, _, correction) = self.of.rendering.transform.fit()?;
        let targets = self.stimuli.targets.as_ref()?.as_ref().ok()?;
        let unity = rendering.xyz_from_signals * DMat3::from_diagonal(rendering.white);
        let samples = balanced(&self.raw[self.stimuli.training..], self.raw[LIGHT]);
        targets.refit(&samples, &correction, &RgbTransform::Matrix(unity))
    }

    fn index_samples(&self, raw: &[DVec3]) -> Vec<DVec3> {
        balanced(&raw[self.stimuli.index.clone()], raw[INDEX_LIGHT])
    }

    /// Metrics under a deviation; the list is memory for its responses.
    pub(super) fn values(&self, deviation: &Deviation, raw: &mut Vec<DVec3>) -> Vec<Result<f64, WhyNot>> {
        raw.clone_from(&self.raw);
        for (raw, [red, green, blue]) in raw.chunks_mut(LANES).zip(self.stimuli.of_sites.of(deviation)) {
            for (lane, raw) in raw.iter_mut().enumerate() {
                *raw += self.peaks * DVec3::new(red[lane], green[lane], blue[lane]);
            }
        }
        self.metrics(raw, || self.space(deviation))
    }

    /// Metrics through another table of the camera.
    pub(super) fn values_through(&self, sensor: &Sensor) -> Vec<Result<f64, WhyNot>> {
        self.metrics(&self.stimuli.raw(sensor, None), || self.stimuli.observer.as_ref()?.quality(&curves(sensor)))
    }

    /// Some spectra that the camera's responses to all but determine its metrics: its own curves, the observer's, single stimuli and some of
    /// the patches.
    pub(super) fn leading(&self) -> Vec<Vec<f64>> {
        let Stimuli { spectra, patches, index, training, .. } = self.stimuli;
        let single = &spectra[..SINGLE];
        let rest = [&spectra[patches.clone()], &spectra[*training..], &spectra[index.clone()]];
        let count = spectra.len() - SINGLE;
        let patches = rest.into_iter().flatten().step_by(count.div_ceil(PATCHES).max(1));
        let stimuli = single.iter().chain(patches).map(|spectrum| spectrum.to_vec());
        let observer = self.stimuli.observer.iter().flat_map(|observer| &observer.curves);
        self.curves.iter().chain(observer).cloned().chain(stimuli).collect()
    }

    fn metrics(&self, raw: &[DVec3], space: impl Fn() -> Option<SpaceQuality>) -> Vec<Result<f64, WhyNot>> {
        let rendering = LazyCell::new(|| self.rendering(raw));
        let rendering = || rendering.as_ref().map_err(|&e| WhyNot::from(e));
        let samples = LazyCell::new(|| self.index_samples(raw));
        let patches = &raw[self.stimuli.patches.clone()];
        let evidence = Evidence {
            colors: part(|| rendering().map(|shown| Seen::all(shown, patches))),
            locus: part(|| self.locus(rendering()?, raw[BLACKBODY])),
            space: part(|| space().ok_or(WhyNot::Dependent)),
            index: [0, 1].map(|by| {
                let samples = &samples;
                part(move || Ok(self.index(by, samples)?))
            }),
            noise: part(|| gains(rendering()?)),
            snr_db: part(|| snr_db(rendering()?, self.of.electrons, self.scale)),
            ..Evidence::none(self.way, self.reference.clone(), self.scale)
        };
        evidence.values(self.of.wanted)
    }

    fn rendering(&self, raw: &[DVec3]) -> Result<Rendering, RenderingError> {
        let white = DVec3::from_array(self.of.rendering.white.0);
        let integrals = raw[LIGHT];
        if !integrals.cmpgt(DVec3::ZERO).all() {
            return Err(RenderingError::NoWhite);
        }
        let (Some((_, _, correction)), Some(targets)) = (self.of.rendering.transform.fit(), &self.stimuli.targets)
        else {
            return Rendering::by_paper(white, integrals, raw[FLAT], self.conditioning);
        };
        let targets = targets.as_ref().map_err(|&e| e)?;
        let samples = balanced(&raw[self.stimuli.training..], integrals);
        let transform = match self.refit.as_ref().and_then(|refit| refit.matrix(&samples)) {
            Some(matrix) => RgbTransform::Matrix(matrix),
            None => targets.fit(&samples, &correction)?,
        };
        Rendering::by_fit(targets, transform, white, integrals, (self.conditioning, true))
    }

    fn locus(&self, rendering: &Rendering, raw: DVec3) -> Result<LocusDeviation, WhyNot> {
        self.way.comparable?;
        let locus = (*self.locus).as_ref().map_err(|&e| e)?;
        let color = rendering.blackbody(raw.to_array()).uv_prime().ok_or(WhyNot::NoLocus)?;
        locus.deviation_between(self.of.temperature, color).ok_or(WhyNot::NoLocus)
    }

    fn index(&self, by: usize, samples: &[DVec3]) -> Result<f64, RenderingError> {
        let index = (*self.index).as_ref().map_err(|&e| e)?;
        let transform = if by == 0 {
            index.fit(samples, INDEX_METHODS[0])?
        } else {
            let refit = self.index_refit.as_ref().and_then(|refit| refit.matrix(samples));
            RgbTransform::Matrix(refit.ok_or(RenderingError::NoWhite)?)
        };
        index.of(samples, &transform).ok_or(RenderingError::NoWhite)
    }

    fn space(&self, deviation: &Deviation) -> Option<SpaceQuality> {
        let (observer, mut curves) = self.space.as_ref().map(|(observer, curves)| (observer, curves.clone()))?;
        for (block, shifts) in self.stimuli.sites.of(deviation).enumerate() {
            for (curve, shift) in curves.iter_mut().zip(shifts) {
                curve.iter_mut().skip(block * LANES).zip(shift).for_each(|(value, by)| *value += by);
            }
        }
        observer.quality(&curves)
    }

    /// What each metric may be off by because of the ratio of the channels, its relative standard uncertainty being the same for red and
    /// blue against green; 0 where the balance divides it out.
    pub(super) fn ratio_parts(&self, relative: f64) -> Vec<f64> {
        let Ok(rendering) = self.rendering(&self.raw) else { return vec![0.0; CameraMetric::ALL.len()] };
        let values = |factor: DVec3| -> Vec<Result<f64, WhyNot>> {
            let scaled = Rendering { white_integrals: rendering.white_integrals * factor, ..rendering.clone() };
            let evidence = Evidence {
                noise: part(|| gains(&scaled)),
                snr_db: part(|| snr_db(&scaled, self.of.electrons, self.scale)),
                ..Evidence::none(self.way, self.reference.clone(), self.scale)
            };
            evidence.values(self.of.wanted)
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
