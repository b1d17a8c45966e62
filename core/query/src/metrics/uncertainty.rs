//! Uncertainty of metrics: the spread of sensitivities between laboratories, propagated through the camera's own curves.

use super::evidence;
use super::perturbed::{Perturbed, StimuliQuery};
use super::stimulus::{LightUncertainty, bands};
use super::table::{CameraMetric, MetricGroup};
use super::value::{CameraMetricsQuery, Contributions, MetricUncertainty, UncertaintySource, WhyNot};
use crate::ask::{Ask, Query, Shared};
use crate::patches::RenderingQuery;
use chromascope_color::camera::curve_spread::{Deviation, at_sites};
use chromascope_color::camera::{ChannelRatio, CurveSpread};
use chromascope_color::spectral::grid::COUNT;
use chromascope_color::spectral::{Evidence, Primaries, Response, Sensor, SpectralDistribution, StatedUncertainty};

/// Student's t for 95 % and the 14 degrees of freedom of the spread.
const T_95: f64 = 2.144_787;
/// Factor by which the spread of a model that the prior has not seen exceeds what the prior predicts.
///
/// Each of the ten models left out in turn and predicted from the other nine: the spread seen is 1.01 (mean and 95 % of ΔE\*00), 1.08
/// (its maximum), 1.14 (Vora) and 1.20 (Luther) times that predicted, and 83 to 94 % of the pairs of tables lie within 1.96 standard
/// uncertainties of their difference. 1.96 / 1.15 = 1.70 covers 91 % of a normal distribution.
const WIDENED: f64 = 1.15;
const COVERAGE: f64 = WIDENED * T_95;
/// Quantile of the normal distribution for 95 %: of uncertainties that files state.
const NORMAL_95: f64 = 1.959_964;

/// Probability that a table is per photon although its use by the source's programs says per energy, or the reverse. An assumption:
/// in 12 of 18 pairs of tables of one model a factor of wavelength brings one nearer to the other.
const INFERRED_WRONG: f64 = 0.1;
/// The same where nothing says either.
const UNKNOWN_WRONG: f64 = 0.5;

/// Share of a channel's response outside 400–700 nm above which a metric is extrapolated.
const OUTSIDE: f64 = 0.01;

/// Relative standard uncertainty of the gains of red and of blue to green.
///
/// Plausible is within 15 % (0.15/√3). Of 50 tables against Adobe's matrices, the root mean square deviation is 0.13 in all and 0.5 in
/// those beyond 15 %.
const fn relative(ratio: ChannelRatio) -> f64 {
    match ratio {
        ChannelRatio::Plausible(_) => 0.087,
        ChannelRatio::Unchecked => 0.13,
        ChannelRatio::Implausible(_) | ChannelRatio::Lost(_) => 0.5,
    }
}

/// Uncertainties of all metrics of a camera, in the order of [`CameraMetric::ALL`]: none for an observer, or a metric without value.
///
/// The covariance of [`CurveSpread`] is drawn 202 times in pairs of opposite sign, always the same, relative to the camera's own peaks.
/// Draws keep the curves from being negative at the sites. Of each draw only the linear responses are computed: of the chart, the training
/// reflectances, the blackbody and the index's patches; then all metrics from those. A fit that minimizes a color difference follows by
/// reweighted least squares with L\*a\*b\* linearized at the unperturbed fit; all other fits are made anew.
///
/// A camera whose own file states uncertainties is drawn from these in place of the spread, at the wavelengths of its table: see
/// [`StatedUncertainty::draws`].
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MetricUncertaintiesQuery {
    /// Camera and conditions.
    pub metrics: CameraMetricsQuery,
    /// Spread of the curves.
    pub spread: Shared<CurveSpread>,
    /// Evidence for what the table's sensitivities are a response to.
    pub response: Evidence,
    /// Credibility of the ratio between its channels.
    pub ratio: ChannelRatio,
    /// Uncertainties that files state.
    pub own: OwnUncertainties,
}

/// Uncertainties that files state for what metrics are computed from; none where a file states none.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct OwnUncertainties {
    /// The camera's three curves, in place of the prior and of the channel ratio's part.
    pub camera: Option<Shared<StatedUncertainty>>,
    /// The light, for camera and reference.
    pub light: Option<Shared<LightUncertainty>>,
    /// The chart's patches, in the order of the chart, for camera and reference.
    pub patches: Option<Shared<StatedUncertainty>>,
}

/// Draws of a spread, shared by all cameras.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct DrawsQuery(Shared<CurveSpread>);

impl Query for DrawsQuery {
    type Answer = Vec<Deviation>;
    const NAME: &'static str = "draws of curves";
    const ALWAYS_COMPLETE: bool = true;

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        self.0.draws()
    }
}

impl Query for MetricUncertaintiesQuery {
    type Answer = Vec<Option<MetricUncertainty>>;
    const NAME: &'static str = "uncertainties of metrics";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let of = &self.metrics;
        let sensor = &of.rendering.sensor;
        let nothing = vec![None; CameraMetric::ALL.len()];
        if sensor.primaries() != Primaries::Camera || ask.stop().is_set() {
            return nothing;
        }
        let nominal = ask.ask(of);
        let stimuli = ask.ask(&StimuliQuery::new(of));
        let (own, peaks) = at_sites(sensor);
        let Some(perturbed) = Perturbed::new(of, &stimuli, peaks, ask) else { return nothing };
        let of_camera = self.own.camera.as_ref().and_then(|stated| {
            let values = |curves: Vec<SpectralDistribution>| {
                let camera = Sensor::new(Primaries::Camera, curves.try_into().ok()?, Response::PerEnergy).ok()?;
                Some(perturbed.values_through(&camera))
            };
            let (stated, spectra) = (stated.per_energy(sensor)?, perturbed.leading());
            largest_spreads((sensor.curves(), &stated), &spectra, values, &nominal.values, ask)
        });
        let is_own = of_camera.is_some();
        let of_prior = || {
            let draws = ask.ask(&DrawsQuery(self.spread.clone()));
            let mut raw = Vec::new();
            let values = draws.iter().map(|draw| perturbed.values(&clipped(draw, &own), &mut raw));
            let of_prior = |spread: Option<_>| spread.map(|spread| (spread, UncertaintySource::Prior));
            Some(spreads(values.map(Some), &nominal.values, ask)?.into_iter().map(of_prior).collect())
        };
        let Some(found) = of_camera.or_else(of_prior) else { return nothing };
        let response = self.response_parts(&nominal.values, ask);
        let ratio = if is_own { vec![0.0; nominal.values.len()] } else { perturbed.ratio_parts(relative(self.ratio)) };
        let light = self.light_parts(&nominal.values, ask);
        let patches = self.patches_parts(&nominal.values, ask);
        if ask.stop().is_set() {
            return nothing;
        }
        let part = |of: &Option<Vec<Found>>, at: usize| of.as_ref().and_then(|of| of[at]).map_or(0.0, |((u, _), _)| u);
        let [first, last] = sensor.support_nm();
        let is_unlike = if is_own { first > 400.0 || last < 700.0 } else { !self.spread.is_of_kind(&own) };
        let outside = if is_own { [0.0; 4] } else { outside(of, stimuli.blackbody()) };
        let (camera, of_light) = (self.own.camera.as_deref(), self.own.light.as_ref().map(|of| &of.stated));
        let stated = [camera, self.own.patches.as_deref(), of_light].into_iter().flatten();
        let stated = stated.map(StatedUncertainty::coverage).fold(NORMAL_95, f64::max);
        let (freedom, coverage) =
            if is_own { (f64::INFINITY, stated) } else { (CurveSpread::FREEDOM, COVERAGE.max(stated)) };
        let uncertainty = |(at, found): (usize, Found)| {
            let ((curves, bias), source) = found?;
            let contributions = Contributions {
                curves,
                response: response[at],
                channel_ratio: ratio[at],
                light: part(&light, at),
                patches: part(&patches, at),
            };
            let standard = contributions.combined();
            let group = CameraMetric::ALL[at].group;
            let place = MetricGroup::ALL.iter().position(|other| *other == group).unwrap_or(0);
            let is_extrapolated = is_unlike || outside[place] > OUTSIDE;
            Some(MetricUncertainty { standard, contributions, freedom, coverage, source, is_extrapolated, bias })
        };
        found.into_iter().enumerate().map(uncertainty).collect()
    }
}

/// Values of all metrics, or reasons for none.
type Values = Vec<Result<f64, WhyNot>>;
/// Spread and bias of a metric with their origin.
type Found = Option<((f64, f64), UncertaintySource)>;

/// Spread and bias of each metric over draws, some of which have no values; none of all when stopped.
fn spreads(
    draws: impl Iterator<Item = Option<Values>>,
    nominal: &[Result<f64, WhyNot>],
    ask: &impl Ask,
) -> Option<Vec<Option<(f64, f64)>>> {
    let mut moments = vec![Moments::default(); nominal.len()];
    for values in draws {
        for (at, (moments, nominal)) in moments.iter_mut().zip(nominal).enumerate() {
            moments.add(values.as_ref().and_then(|values| values[at].ok()), *nominal);
        }
        if ask.stop().is_set() {
            return None;
        }
    }
    Some(moments.into_iter().map(Moments::spread).collect())
}

/// The same with curves drawn from an uncertainty in place of theirs, of each metric under the correlation that gives most; none unless the
/// uncertainty is of these curves.
fn largest_spreads(
    (curves, stated): (&[SpectralDistribution], &StatedUncertainty),
    spectra: &[Vec<f64>],
    values: impl Fn(Vec<SpectralDistribution>) -> Option<Values>,
    nominal: &[Result<f64, WhyNot>],
    ask: &impl Ask,
) -> Option<Vec<Found>> {
    let mut most: Vec<Found> = vec![None; nominal.len()];
    for (correlation, draws) in stated.draws(curves, spectra)? {
        let found = spreads(draws.map(|curves| values(curves?)), nominal, ask)?;
        for (most, found) in most.iter_mut().zip(found) {
            let is_more = |found: &(f64, f64)| most.is_none_or(|((spread, _), _)| found.0 > spread);
            *most = found.filter(is_more).map(|found| (found, UncertaintySource::Own(correlation))).or(*most);
        }
    }
    Some(most)
}

impl MetricUncertaintiesQuery {
    fn light_parts(&self, nominal: &[Result<f64, WhyNot>], ask: &impl Ask) -> Option<Vec<Found>> {
        let light = self.own.light.as_ref()?;
        let curves = std::slice::from_ref(&light.measured);
        let values = |measured: Vec<_>| {
            let under = self.metrics.under(measured.first()?, light.transmittance.as_ref());
            Some(under.answer(ask).values)
        };
        largest_spreads((curves, &light.stated), &bands(), values, nominal, ask)
    }

    fn patches_parts(&self, nominal: &[Result<f64, WhyNot>], ask: &impl Ask) -> Option<Vec<Found>> {
        let curves: Vec<_> = self.metrics.patches.patches().iter().map(|patch| patch.measured.clone()).collect();
        let values = |measured| Some(self.metrics.of_patches(measured).answer(ask).values);
        largest_spreads((&curves, self.own.patches.as_ref()?), &[], values, nominal, ask)
    }

    /// What each metric may be off by because the table's stimulus is not stated: the root of the probability of the other one, times the
    /// change that it makes.
    fn response_parts(&self, nominal: &[Result<f64, WhyNot>], ask: &impl Ask) -> Vec<f64> {
        let wrong = match self.response {
            Evidence::Stated => 0.0,
            Evidence::Inferred => INFERRED_WRONG,
            Evidence::Unknown => UNKNOWN_WRONG,
        };
        let other = Some(()).filter(|()| wrong > 0.0).and_then(|()| other_response(&self.metrics.rendering.sensor));
        let Some(sensor) = other else { return vec![0.0; nominal.len()] };
        let rendering = RenderingQuery { sensor: Shared::new(sensor), ..self.metrics.rendering.clone() };
        let other = CameraMetricsQuery { rendering, ..self.metrics.clone() };
        // Values alone: nothing shows the patches through it.
        let other = evidence::Evidence::new(&other, ask).values(other.wanted);
        let part = |(a, b): (&Result<f64, WhyNot>, &Result<f64, WhyNot>)| match (a, b) {
            (Ok(a), Ok(b)) => wrong.sqrt() * (a - b).abs(),
            _ => 0.0,
        };
        nominal.iter().zip(&other).map(part).collect()
    }
}

/// The sensor if its table were per photon instead of per energy, or the reverse.
fn other_response(sensor: &Sensor) -> Option<Sensor> {
    let to_energy = |curve: &chromascope_color::spectral::SpectralDistribution| match sensor.response() {
        Response::PerPhoton => curve.map(|nm, v| v * 550.0 / nm),
        Response::PerEnergy | Response::Unknown => curve.map(|nm, v| v * nm / 550.0),
    };
    let [red, green, blue] = sensor.curves();
    let curves = [to_energy(red).ok()?, to_energy(green).ok()?, to_energy(blue).ok()?];
    Sensor::new(Primaries::Camera, curves, Response::PerEnergy).ok()
}

/// A deviation that leaves no curve negative.
fn clipped(draw: &Deviation, own: &Deviation) -> Deviation {
    let mut kept = *draw;
    kept.as_flattened_mut().iter_mut().zip(own.as_flattened()).for_each(|(value, own)| *value = value.max(-own));
    kept
}

/// Largest share of a channel's response outside 400–700 nm in what the metrics of each group use.
fn outside(of: &CameraMetricsQuery, blackbody: &[f64; COUNT]) -> [f64; 4] {
    let [light, blackbody, equal] = [of.rendering.light.values(), blackbody, &[1.0; COUNT]].map(|light| {
        let share = |channel: usize| {
            let weighted = of.rendering.sensor.weighted(channel);
            let power = |range: std::ops::Range<usize>| -> f64 { range.map(|i| (weighted[i] * light[i]).abs()).sum() };
            let [first, last] = chromascope_color::camera::curve_spread::SITE_RANGE;
            1.0 - power(first..last + 1) / power(0..COUNT).max(f64::MIN_POSITIVE)
        };
        [0, 1, 2].map(share).into_iter().fold(0.0, f64::max)
    });
    MetricGroup::ALL.map(|group| match group {
        MetricGroup::Differences | MetricGroup::Noise => light,
        MetricGroup::Locus => blackbody,
        MetricGroup::Sensitivities => equal,
    })
}

/// Mean and spread of a metric over draws, about its nominal value.
#[derive(Clone, Copy, Debug, Default)]
struct Moments {
    draws: u32,
    known: f64,
    sum: f64,
    squares: f64,
}

impl Moments {
    fn add(&mut self, value: Option<f64>, nominal: Result<f64, WhyNot>) {
        self.draws += 1;
        if let (Some(value), Ok(nominal)) = (value, nominal) {
            let off = value - nominal;
            self.known += 1.0;
            self.sum += off;
            self.squares += off * off;
        }
    }

    /// Standard deviation and mean shift; none where the metric has no value, or most draws have none.
    fn spread(self) -> Option<(f64, f64)> {
        let mean = self.sum / self.known;
        // The draws have exactly the covariance of the prior: by their number, not one less.
        let spread = (self.squares / self.known - mean * mean).max(0.0).sqrt();
        (self.known > f64::from(self.draws) / 2.0 && spread.is_finite()).then_some((spread, mean))
    }
}
