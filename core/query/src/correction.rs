//! Queries about color corrections: their errors, what they do to white and to narrow blue lights, and their DNG matrices.

use super::ask::{Ask, Query, Shared};
use super::loci::CctQuery;
use super::patches::{FitTargetsQuery, RenderingQuery};
use chromascope_color::camera::rendering::check_lobes;
use chromascope_color::camera::{FitSamples, Rendering, RenderingError};
use chromascope_color::colorimetry::adaptation::bradford;
use chromascope_color::colorimetry::{Metric, Stimulus, UvPrime, Xy, Xyz};
use chromascope_color::correction::aces::{Idt, IdtError, IdtExposure, input_device_transform};
use chromascope_color::correction::classes::ColorClass;
use chromascope_color::correction::dng::{D50, DngMatrices, first_weight, mixed};
use chromascope_color::correction::neutral::Neutral;
use chromascope_color::correction::{Correction, CorrectionMethod, RgbTransform, Training};
use chromascope_color::light::RadiationConstants;
use chromascope_color::light::planckian::black_body;
use chromascope_color::patch_set::PatchSet;
use chromascope_color::spectral::{GridSpectrum, Sensor};
use chromascope_color::units::Kelvin;
use chromascope_math::quantile::quantile;
use glam::{DMat3, DVec3};

/// Mean, quantile and extreme of differences.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorSummary {
    /// Mean.
    pub mean: f64,
    /// 95th percentile, as [`quantile`] defines it.
    pub p95: f64,
    /// Maximum.
    pub max: f64,
    /// Place of the maximum among the training reflectances.
    pub worst: usize,
}

impl ErrorSummary {
    /// Summary of differences in the order of the training reflectances; none of nothing.
    pub fn new(differences: &[Option<f64>]) -> Option<Self> {
        let known = differences.iter().enumerate().filter_map(|(place, value)| value.map(|value| (value, place)));
        let mut known: Vec<(f64, usize)> = known.collect();
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
        let &(max, worst) = known.last()?;
        let mean = known.iter().map(|(value, _)| value).sum::<f64>() / known.len() as f64;
        let p95 = quantile(&mut known.iter().map(|(value, _)| *value).collect::<Vec<_>>(), 0.95)?;
        Some(Self { mean, p95, max, worst })
    }
}

/// Color of a stimulus through a correction beside the reference's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StimulusCheck {
    /// Peak wavelength in nanometers; none for white.
    pub peak_nm: Option<f64>,
    /// XYZ through the correction, the largest camera signal 1.
    pub xyz: Xyz,
    /// Chromaticity to the reference observer.
    pub reference: Option<Xy>,
    /// Linear sRGB, unclipped.
    pub linear: [f64; 3],
    /// Difference of white from the reference's; none for other stimuli.
    pub difference: Option<f64>,
}

impl StimulusCheck {
    /// True where a tristimulus value is negative: no light has this color.
    pub fn is_negative(&self) -> bool {
        self.xyz.to_vector().min_element() < -1e-9
    }

    /// True where sRGB clips a channel.
    pub fn clips(&self) -> bool {
        self.linear.iter().any(|v| !(-1e-9..=1.0 + 1e-9).contains(v))
    }
}

/// Color correction of a sensor with its errors.
#[derive(Clone, Debug, PartialEq)]
pub struct CorrectionReport {
    /// The transform from RGB balanced to unity.
    pub transform: RgbTransform,
    /// Adopted white: XYZ of a perfect diffuser to the reference.
    pub adopted_white: Xyz,
    /// Errors without correction.
    pub before: Option<ErrorSummary>,
    /// Errors over the training reflectances.
    pub training: Option<ErrorSummary>,
    /// Errors of each reflectance by a fit to the others; none where the others determine no fit.
    pub left_out: Option<ErrorSummary>,
    /// Number of training reflectances in each class, in the order of [`ColorClass::ALL`].
    pub classes: [usize; 4],
    /// Number of training reflectances.
    pub count: usize,
    /// Color of a perfect diffuser.
    pub white: StimulusCheck,
    /// Colors of narrow blue lights.
    pub blue: Vec<StimulusCheck>,
    /// DNG matrices; none for a root polynomial, or a matrix without inverse.
    pub dng: Option<DngMatrices>,
}

/// Peak wavelengths of the narrow blue lights that a correction is checked with, in nanometers.
pub const BLUE_LEDS_NM: [f64; 4] = [440.0, 450.0, 460.0, 470.0];
/// Full width at half maximum of those lights, in nanometers, as of common blue LEDs.
pub const LED_WIDTH_NM: f64 = 20.0;

/// Color correction of a sensor under a light, with its errors.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CorrectionReportQuery {
    /// The sensor with its fitted color transform.
    pub rendering: RenderingQuery,
    /// Metric of the errors.
    pub metric: Metric,
}

impl Query for CorrectionReportQuery {
    type Answer = Result<CorrectionReport, RenderingError>;
    const NAME: &'static str = "color correction";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let (set, correction) = samples(&self.rendering, ask)?;
        check_lobes(&self.rendering.sensor, correction.method)?;
        let weights = correction.weights.for_targets(&set.targets, set.white);
        let training = Training { samples: &set.samples, targets: &set.targets, weights: &weights };
        let (transform, stop) = (training.fit(&correction, set.white)?, ask.stop());
        let uncorrected = Correction { method: CorrectionMethod::None, ..correction };
        let before = training.fit(&uncorrected, set.white).ok();
        let through = |transform: &RgbTransform| -> Vec<Option<DVec3>> {
            set.samples.iter().map(|rgb| Some(transform.xyz(*rgb))).collect()
        };
        let summary = |colors: &[Option<DVec3>]| ErrorSummary::new(&differences(&set, colors, self.metric));
        let left_out = training.leave_one_out(&correction, set.white, &transform, || stop.is_set())?;
        let classes = ColorClass::of_targets(&set.targets, set.white);
        let count = |class: ColorClass| classes.iter().filter(|found| **found == Some(class)).count();
        let dng = match &transform {
            RgbTransform::Matrix(matrix) => DngMatrices::new(*matrix, set.white_integrals, set.white),
            RgbTransform::RootPolynomial(_) => None,
        };
        let difference = |xyz: DVec3| {
            let stimulus = |xyz: Xyz| Stimulus::new(xyz, set.white);
            self.metric.between(&stimulus(set.white), &stimulus(Xyz::from_vector(xyz)))
        };
        let white = transform.xyz(DVec3::ONE);
        Ok(CorrectionReport {
            adopted_white: set.white,
            before: before.and_then(|before| summary(&through(&before))),
            training: summary(&through(&transform)),
            left_out: summary(&left_out),
            classes: ColorClass::ALL.map(count),
            count: set.samples.len(),
            white: StimulusCheck {
                peak_nm: None,
                xyz: Xyz::from_vector(white),
                reference: set.white.chromaticity(),
                linear: (set.srgb_from_xyz * white).to_array(),
                difference: difference(white),
            },
            blue: BLUE_LEDS_NM.iter().filter_map(|&peak| self.led(peak, &set, &transform)).collect(),
            transform,
            dng,
        })
    }
}

impl CorrectionReportQuery {
    /// Color of a Gaussian light at a peak; none where the camera does not respond to it.
    fn led(&self, peak: f64, set: &FitSamples, transform: &RgbTransform) -> Option<StimulusCheck> {
        let (reference, ..) = self.rendering.transform.fit()?;
        let light = led(peak);
        let raw = DVec3::from_array(self.rendering.sensor.integrate(light.values())) / set.white_integrals;
        let largest = raw.max_element();
        if largest <= 0.0 || !largest.is_finite() {
            return None;
        }
        let xyz = transform.xyz(raw / largest);
        Some(StimulusCheck {
            peak_nm: Some(peak),
            xyz: Xyz::from_vector(xyz),
            reference: Xyz::from_vector(DVec3::from_array(reference.integrate(light.values()))).chromaticity(),
            linear: (set.srgb_from_xyz * xyz).to_array(),
            difference: None,
        })
    }
}

/// Gaussian spectrum of [`LED_WIDTH_NM`] at a peak.
pub fn led(peak_nm: f64) -> GridSpectrum {
    let width = LED_WIDTH_NM / (8.0 * std::f64::consts::LN_2).sqrt();
    GridSpectrum::from_fn(|nm| (-0.5 * ((nm - peak_nm) / width).powi(2)).exp())
}

/// Training samples of a rendering, with its correction.
fn samples(rendering: &RenderingQuery, ask: &impl Ask) -> Result<(FitSamples, Correction), RenderingError> {
    let Some((reference, training, correction)) = rendering.transform.fit() else {
        return Err(RenderingError::NotFitted);
    };
    let (reference, light) = (reference.clone(), rendering.light.clone());
    let targets = ask.ask(&FitTargetsQuery { reference, light, training: training.clone() });
    let targets = (*targets).as_ref().map_err(|&e| e);
    Ok((FitSamples::new(&rendering.sensor, &rendering.light, training, targets)?, correction))
}

fn differences(set: &FitSamples, colors: &[Option<DVec3>], metric: Metric) -> Vec<Option<f64>> {
    let stimulus = |xyz: DVec3| Stimulus::new(Xyz::from_vector(xyz), set.white);
    let pairs = set.targets.iter().zip(colors);
    pairs.map(|(target, color)| metric.between(&stimulus(*target), &stimulus((*color)?))).collect()
}

/// Mean differences of a sensor under blackbodies between two lights, by the `ForwardMatrix` of one, of both, and of its own.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct TwoLightQuery {
    /// The sensor under the first light.
    pub first: RenderingQuery,
    /// The sensor under the second.
    pub second: RenderingQuery,
    /// Correlated color temperatures of the two lights.
    pub temperatures: [Kelvin; 2],
    /// Number of blackbodies between them, evenly in mired, ends included.
    pub count: usize,
}

/// Mean CIEDE2000 at one temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoLightPoint {
    /// Temperature of the blackbody.
    pub temperature: Kelvin,
    /// With the matrices mixed as DNG readers do.
    pub mixed: f64,
    /// With the first light's alone.
    pub first: f64,
    /// With the second light's alone.
    pub second: f64,
    /// With a matrix fitted under this blackbody.
    pub own: f64,
}

impl Query for TwoLightQuery {
    type Answer = Result<Vec<TwoLightPoint>, RenderingError>;
    const NAME: &'static str = "two lights";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let forward = |of: &RenderingQuery| -> Result<DMat3, RenderingError> {
            let rendering = ask.ask(of);
            let rendering = (*rendering).as_ref().map_err(|&e| e)?;
            dng_matrices(rendering).map(|dng| dng.forward).ok_or(RenderingError::NoMatrix)
        };
        let (first, second) = (forward(&self.first)?, forward(&self.second)?);
        let [from, to] = self.temperatures.map(Kelvin::mired);
        let steps = (0..self.count).map(|i| from + (to - from) * i as f64 / (self.count.max(2) - 1) as f64);
        let temperatures = steps.map_while(|mired| Kelvin::from_mired(mired).ok().filter(|_| !ask.stop().is_set()));
        let point = |temperature: Kelvin| {
            let light = Shared::new(black_body(temperature, RadiationConstants::Paper));
            let rendering = RenderingQuery { light, ..self.first.clone() };
            let (set, _) = samples(&rendering, ask)?;
            let own = forward(&rendering)?;
            let share = first_weight(temperature, self.temperatures[0], self.temperatures[1]);
            let mean = |matrix: DMat3| mean_by_forward(&set, matrix).ok_or(RenderingError::NoMatrix);
            Ok(TwoLightPoint {
                temperature,
                mixed: mean(mixed(first, second, share))?,
                first: mean(first)?,
                second: mean(second)?,
                own: mean(own)?,
            })
        };
        temperatures.map(point).collect()
    }
}

/// Color correction under one light or two, with what lies between them.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CorrectionSheetQuery {
    /// The sensor under the first light.
    pub first: CorrectionReportQuery,
    /// The sensor under the second light.
    pub second: Option<CorrectionReportQuery>,
    /// XYZ observer by whose locus color temperatures are read.
    pub observer: Shared<Sensor>,
}

/// Color correction under one light, and that light's color.
#[derive(Clone, Debug, PartialEq)]
pub struct CorrectionUnder {
    /// The correction with its errors.
    pub report: CorrectionReport,
    /// Chromaticity of the light.
    pub xy: Option<Xy>,
    /// Correlated color temperature of the light; none where it is too far from the locus.
    pub temperature: Option<Kelvin>,
}

/// Answer of [`CorrectionSheetQuery`].
#[derive(Clone, Debug, PartialEq)]
pub struct CorrectionSheet {
    /// Under the first light.
    pub first: CorrectionUnder,
    /// Under the second.
    pub second: Option<Result<CorrectionUnder, RenderingError>>,
    /// Errors between the two lights; none without two color temperatures that differ, or for a root polynomial.
    pub between: Option<Vec<TwoLightPoint>>,
}

/// Blackbodies between two lights.
const BETWEEN: usize = 17;

impl Query for CorrectionSheetQuery {
    type Answer = Result<CorrectionSheet, RenderingError>;
    const NAME: &'static str = "correction sheet";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let first = self.under(&self.first, ask)?;
        let second = self.second.as_ref().map(|second| self.under(second, ask));
        let between = match (&self.second, &second) {
            (Some(query), Some(Ok(under))) => {
                let temperatures = first.temperature.zip(under.temperature).filter(|(a, b)| a != b);
                temperatures.and_then(|(a, b)| {
                    let (first, second) = (self.first.rendering.clone(), query.rendering.clone());
                    let points = ask.ask(&TwoLightQuery { first, second, temperatures: [a, b], count: BETWEEN });
                    (*points).clone().ok()
                })
            }
            _ => None,
        };
        Ok(CorrectionSheet { first, second, between })
    }
}

impl CorrectionSheetQuery {
    fn under(&self, query: &CorrectionReportQuery, ask: &impl Ask) -> Result<CorrectionUnder, RenderingError> {
        let report = ask.ask(query);
        let report = (*report).clone()?;
        let light = DVec3::from_array(self.observer.integrate(query.rendering.light.values()));
        let xy = Xyz::from_vector(light).chromaticity();
        let nearest = |uv: UvPrime| *ask.ask(&CctQuery::new(self.observer.clone(), uv.uv60()));
        let cct = xy.and_then(Xy::uv_prime).and_then(|uv| nearest(uv).ok());
        Ok(CorrectionUnder { report, xy, temperature: cct.map(|cct| cct.temperature) })
    }
}

/// ACES input device transform of a camera under a light.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct IdtQuery {
    /// The camera.
    pub camera: Shared<Sensor>,
    /// The light.
    pub light: Shared<GridSpectrum>,
    /// CIE 1931 2°, as rawtoaces has it.
    pub observer: Shared<Sensor>,
    /// The 190 training reflectances of rawtoaces.
    pub training: Shared<PatchSet>,
    /// Brightness of the samples.
    pub exposure: IdtExposure,
    /// Camera RGB of a neutral under the light, in place of the table's own.
    pub neutral: Option<Neutral>,
}

impl Query for IdtQuery {
    type Answer = Result<Idt, IdtError>;
    const NAME: &'static str = "input device transform";

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        let Self { camera, light, observer, training, exposure, neutral } = self;
        input_device_transform(camera, light, observer, training, *exposure, *neutral)
    }
}

/// DNG matrices of a rendering; none for a root polynomial.
pub fn dng_matrices(rendering: &Rendering) -> Option<DngMatrices> {
    let matrix = rendering.xyz_from_signals * DMat3::from_diagonal(rendering.white);
    let linear = rendering.root_polynomial.is_none();
    linear.then(|| DngMatrices::new(matrix, rendering.white_integrals, rendering.lab_white)).flatten()
}

/// Mean CIEDE2000 of training samples through a `ForwardMatrix`, relative to D50.
fn mean_by_forward(set: &FitSamples, forward: DMat3) -> Option<f64> {
    let d50 = D50.with_unit_luminance()?;
    let adapted = bradford(set.white, d50)?;
    let stimulus = |xyz: DVec3| Stimulus::new(Xyz::from_vector(xyz), d50);
    let pairs = set.samples.iter().zip(&set.targets);
    let differences: Option<Vec<f64>> = pairs
        .map(|(rgb, target)| Metric::DELTA_E_2000.between(&stimulus(adapted * *target), &stimulus(forward * *rgb)))
        .collect();
    let differences = differences.filter(|differences| !differences.is_empty())?;
    Some(differences.iter().sum::<f64>() / differences.len() as f64)
}
