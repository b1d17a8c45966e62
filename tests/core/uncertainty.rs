//! Uncertainties of metrics against simulations that perturb whole tables with an independent generator.

mod own;
mod sampling;

use std::any::{Any, TypeId};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use chromascope_core::camera::curve_spread::{Deviation, SITES, at_sites};
use chromascope_core::camera::{ChannelRatio, CurveSpread, WhiteBalanceTarget};
use chromascope_core::correction::minimize::Objective;
use chromascope_core::correction::{Correction, CorrectionMethod};
use chromascope_core::data;
use chromascope_core::patch_set::COLOR_CHECKER_CHROMATIC;
use chromascope_core::query::metrics::{MetricGroup, MetricSet, OwnUncertainties, UncertaintySource};
use chromascope_core::query::{
    Ask, CameraMetric, CameraMetricsQuery, ColorTransformSpec, Direct, IndexConditions, MetricUncertaintiesQuery,
    MetricUncertainty, Query, RenderingQuery, Shared,
};
use chromascope_core::spectral::{Evidence, Primaries, Response, Sensor, SpectralDistribution};

use crate::support::{CIE_1931, assert_near, chart, dataset, kelvin, light, sensor, training};

const D70: &str = "Nikon D70 (A.M.P.A.S.)";

/// An evaluator that keeps all answers.
#[derive(Default)]
struct Kept(RefCell<BTreeMap<TypeId, Box<dyn Any>>>);

impl Ask for Kept {
    fn ask<Q: Query>(&self, query: &Q) -> Arc<Q::Answer> {
        type Answers<Q> = Vec<(Q, Arc<<Q as Query>::Answer>)>;
        let id = TypeId::of::<Q>();
        let known = |kinds: &BTreeMap<TypeId, Box<dyn Any>>| {
            let answers = kinds.get(&id)?.downcast_ref::<Answers<Q>>()?;
            answers.iter().find(|(known, _)| known == query).map(|(_, answer)| Arc::clone(answer))
        };
        if let Some(found) = known(&self.0.borrow()) {
            return found;
        }
        let answer = Arc::new(query.answer(self));
        let mut kinds = self.0.borrow_mut();
        let kind = kinds.entry(id).or_insert_with(|| Box::new(Answers::<Q>::new()));
        kind.downcast_mut::<Answers<Q>>().unwrap().push((query.clone(), Arc::clone(&answer)));
        answer
    }
}

/// Normal numbers by Box and Muller's method from a xorshift generator.
struct Normal(u64);

impl Normal {
    fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        let length = (-2.0 * self.uniform().ln()).sqrt();
        length * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

fn spread() -> Shared<CurveSpread> {
    Shared::new(CurveSpread::from_dataset(&dataset("uncertainty/curve_spread.csv")).unwrap())
}

fn camera(name: &str) -> Sensor {
    data::camera(name).unwrap()
}

/// A camera's table at 10 nm with its deviation.
fn deviated(camera: &Sensor, deviation: &Deviation) -> Sensor {
    let (own, peaks) = at_sites(camera);
    let nm: Vec<f64> = (0..SITES).map(|site| 400.0 + 10.0 * site as f64).collect();
    let curve = |c: usize| {
        let values = own[c].iter().zip(&deviation[c]).map(|(own, by)| (own + by).max(0.0) * peaks[c]);
        SpectralDistribution::new(nm.clone(), values.collect()).unwrap()
    };
    Sensor::new(Primaries::Camera, [curve(0), curve(1), curve(2)], Response::PerEnergy).unwrap()
}

fn at_10_nm(name: &str) -> Sensor {
    deviated(&camera(name), &[[0.0; SITES]; 3])
}

fn under(camera: Sensor, illuminant: &str, correction: Correction) -> CameraMetricsQuery {
    let observer = Shared::new(sensor(CIE_1931));
    let light_of = |path| Shared::new(light(path));
    let transform =
        ColorTransformSpec::Observer { reference: observer.clone(), training: Shared::new(training()), correction };
    let rendering = |sensor| RenderingQuery {
        sensor,
        light: light_of(illuminant),
        white: WhiteBalanceTarget::UNITY,
        transform: transform.clone(),
    };
    CameraMetricsQuery {
        rendering: rendering(Shared::new(camera)),
        reference: rendering(observer.clone()),
        patches: Shared::new(chart()),
        temperature: kelvin(2856.0),
        index: IndexConditions {
            observer,
            light: light_of("illuminants/d55.csv"),
            patches: Shared::new(chart().subset(&COLOR_CHECKER_CHROMATIC)),
        },
        electrons: None,
        wanted: MetricSet::ALL,
    }
}

fn query(camera: Sensor) -> CameraMetricsQuery {
    under(camera, "illuminants/d55.csv", Correction::default())
}

fn ask_all(of: &CameraMetricsQuery, response: Evidence, ask: &impl Ask) -> Vec<Option<MetricUncertainty>> {
    let (metrics, spread, ratio) = (of.clone(), spread(), ChannelRatio::Unchecked);
    let own = OwnUncertainties::default();
    (*ask.ask(&MetricUncertaintiesQuery { metrics, spread, response, ratio, own })).clone()
}

fn of(all: &[Option<MetricUncertainty>], id: &str) -> MetricUncertainty {
    all[CameraMetric::ALL.iter().position(|metric| metric.id == id).unwrap()].unwrap()
}

/// A deviation from 101 independent standard normal numbers, by the columns of the spread's file.
fn deviation(mut normal: impl FnMut() -> f64) -> Deviation {
    let columns = dataset("uncertainty/curve_spread.csv").curves;
    let mut deviation = [[0.0; SITES]; 3];
    for mode in columns[..24].chunks(3) {
        let by = normal();
        for (channel, mode) in deviation.iter_mut().zip(mode) {
            channel.iter_mut().zip(mode.values()).for_each(|(value, part)| *value += by * part);
        }
    }
    deviation.as_flattened_mut().iter_mut().for_each(|value| *value += columns[24].values()[0] * normal());
    deviation
}

/// The same conditions with a table that deviates.
fn with_deviation(of: &CameraMetricsQuery, normal: &mut Normal) -> CameraMetricsQuery {
    let deviation = deviation(|| normal.next());
    let sensor = Shared::new(deviated(&of.rendering.sensor, &deviation));
    CameraMetricsQuery { rendering: RenderingQuery { sensor, ..of.rendering.clone() }, ..of.clone() }
}

#[test]
fn draws_have_the_covariance_of_the_spread() {
    let (spread, draws) = (spread(), spread().draws());
    assert_eq!(draws, spread.draws(), "the same each time");
    // A unit normal number at one place gives one mode, or the rest of one sample.
    let root = |place: usize| {
        let mut at = 0..;
        deviation(|| if at.next() == Some(place) { 1.0 } else { 0.0 })
    };
    let roots: Vec<Deviation> = (0..8 + 3 * SITES).map(root).collect();
    let value = |of: &Deviation, at: [usize; 2]| of[at[0]][at[1]];
    for (a, b) in [([0, 5], [0, 5]), ([0, 20], [1, 12]), ([2, 3], [2, 2]), ([1, 14], [2, 9])] {
        let mean: f64 = draws.iter().map(|draw| value(draw, a)).sum();
        let found = draws.iter().map(|draw| value(draw, a) * value(draw, b)).sum::<f64>() / draws.len() as f64;
        let expected: f64 = roots.iter().map(|root| value(root, a) * value(root, b)).sum();
        assert_near("mean", mean, 0.0, 1e-12);
        assert_near("covariance", found, expected, 1e-15);
    }
}

/// What the source of the prior states for the D70, drawn from it (D55, 24 patches, 400–700 nm), to what another interpolation between the
/// samples makes.
#[test]
fn the_prior_gives_what_its_source_states() {
    let all = ask_all(&query(at_10_nm(D70)), Evidence::Stated, &Direct);
    for (id, stated, digits) in [
        ("vora", 0.0065, 0.0008),
        ("luther", 0.016, 0.0015),
        ("delta-e2000-mean", 0.10, 0.01),
        ("delta-e2000-max", 0.31, 0.03),
    ] {
        assert_near(id, of(&all, id).contributions.curves, stated, digits);
    }
}

/// Linear responses and fits near the first against whole tables and fits from the beginning: 240 draws know a spread to 5 %.
#[test]
fn uncertainties_are_those_of_whole_tables_drawn_independently() {
    for name in [D70, "Canon EOS 5D Mark III"] {
        let (ask, mut normal) = (Kept::default(), Normal(0x5EED));
        let asked = query(at_10_nm(name));
        let drawn: Vec<_> = (0..240).map(|_| ask.ask(&with_deviation(&asked, &mut normal))).collect();
        for (at, found) in ask_all(&asked, Evidence::Stated, &ask).into_iter().enumerate() {
            let values: Vec<f64> = drawn.iter().filter_map(|metrics| metrics.values[at].ok()).collect();
            let Some(found) = found else { continue };
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let spread = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (values.len() - 1) as f64).sqrt();
            let id = CameraMetric::ALL[at].id;
            assert_near(&format!("{name} {id}"), found.contributions.curves / spread, 1.0, 0.17);
            let bias = mean - ask.ask(&asked).values[at].unwrap();
            assert_near(&format!("{name} bias of {id}"), found.bias / spread, bias / spread, 0.25);
        }
    }
}

#[test]
fn fits_of_least_color_difference_are_followed() {
    let correction = Correction { method: CorrectionMethod::Minimize(Objective::DeltaE2000), ..Correction::default() };
    let (ask, mut normal) = (Kept::default(), Normal(77));
    let asked = under(at_10_nm(D70), "illuminants/d65.csv", correction);
    let found = ask_all(&asked, Evidence::Stated, &ask);
    let drawn: Vec<_> = (0..60).map(|_| ask.ask(&with_deviation(&asked, &mut normal))).collect();
    for (at, id) in ["delta-e2000-mean", "delta-e2000-median", "delta-e2000-p95"].into_iter().enumerate() {
        let values: Vec<f64> = drawn.iter().map(|metrics| metrics.values[at].unwrap()).collect();
        let mean = values.iter().sum::<f64>() / 60.0;
        let spread = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / 59.0).sqrt();
        assert_near(id, of(&found, id).contributions.curves / spread, 1.0, 0.3);
    }
}

#[test]
fn the_95_percent_interval_of_a_table_holds_the_true_value() {
    let count = CameraMetric::ALL.len();
    let (mut inside, mut all) = (vec![0_usize; count], vec![0_usize; count]);
    for (name, seed) in [(D70, 1), ("Sony ILCE-7M3", 2), ("Canon EOS 5D Mark II", 3)] {
        let (ask, mut normal) = (Kept::default(), Normal(0xC0FE + seed));
        let truth = query(at_10_nm(name));
        let truths = ask.ask(&truth);
        for _ in 0..40 {
            let table = with_deviation(&truth, &mut normal);
            let values = ask.ask(&table);
            for (at, found) in ask_all(&table, Evidence::Stated, &ask).into_iter().enumerate() {
                let (Ok(value), Ok(truth), Some(found)) = (values.values[at], truths.values[at], found) else {
                    continue;
                };
                all[at] += 1;
                inside[at] += usize::from((value - truth).abs() <= found.coverage * found.contributions.curves);
            }
        }
    }
    for ((metric, inside), all) in CameraMetric::ALL.iter().zip(inside).zip(all).filter(|(_, all)| *all > 0) {
        assert!(all == 120 && inside as f64 >= 0.93 * all as f64, "{}: {inside} of {all}", metric.id);
    }
}

#[test]
fn parts_apply_to_what_depends_on_them() {
    let asked = query(camera("Canon EOS 5D Mark II"));
    let [stated, inferred, unknown] =
        [Evidence::Stated, Evidence::Inferred, Evidence::Unknown].map(|evidence| ask_all(&asked, evidence, &Direct));
    assert_eq!(stated, ask_all(&asked, Evidence::Stated, &Direct), "the same digits each time");
    for (at, metric) in CameraMetric::ALL.iter().enumerate() {
        let (Some(a), Some(b), Some(c)) = (stated[at], inferred[at], unknown[at]) else { continue };
        assert_eq!(a.contributions.response, 0.0);
        assert_near(metric.id, c.contributions.response, 5.0_f64.sqrt() * b.contributions.response, 1e-12);
        let parts = b.contributions;
        let sum = parts.curves.hypot(parts.response).hypot(parts.channel_ratio);
        assert_near(metric.id, b.standard, sum, 1e-15);
        let by_ratio = ["noise-red", "noise-green", "noise-blue", "condition", "gray-snr"].contains(&metric.id);
        assert_eq!(b.contributions.channel_ratio > 0.0, by_ratio, "{}", metric.id);
        assert_eq!((b.source, b.freedom), (UncertaintySource::Prior, 14.0));
        assert_near("k", b.coverage, 2.466, 1e-3);
    }
    assert!(of(&inferred, "delta-e2000-mean").contributions.response > 0.01);
    assert_eq!(ask_all(&query(sensor(CIE_1931)), Evidence::Stated, &Direct), vec![None; CameraMetric::ALL.len()]);
}

#[test]
fn the_prior_is_stretched_for_sensors_unlike_its_models_and_beyond_its_wavelengths() {
    let is_unlike = |name: &String| !spread().is_of_kind(&at_sites(&camera(name)).0);
    let unlike: Vec<String> = data::names("cameras").into_iter().filter(is_unlike).collect();
    assert_eq!(unlike, ["ARRI D21", "Canon PowerShot S90", "Kodak DCS200", "Sigma SD1 Merrill (NPL)"]);
    let marked = |camera: Sensor| {
        let all = ask_all(&query(camera), Evidence::Stated, &Direct);
        MetricGroup::ALL.map(|group| {
            let of_group = CameraMetric::ALL.iter().zip(&all).filter(|(metric, _)| metric.group == group);
            of_group.filter_map(|(_, found)| *found).any(|found| found.is_extrapolated)
        })
    };
    assert_eq!(marked(camera("Kodak DCS200")), [true; 4]);
    assert!(!marked(camera("Nikon D850"))[0]);
    // Two percent of its blue are below 400 nm.
    assert!(marked(camera(D70))[2]);
    assert_eq!(marked(at_10_nm(D70)), [false; 4]);
}
