//! Uncertainties that files state, against plain sampling of whole tables.

use chromascope_core::camera::ChannelRatio;
use chromascope_core::camera::quality::Electrons;
use chromascope_core::correction::Correction;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::metrics::{LightUncertainty, MetricGroup, OwnUncertainties, UncertaintySource};
use chromascope_core::query::{
    Ask, CameraMetric, CameraMetricsQuery, ColorTransformSpec, Direct, MetricUncertaintiesQuery, MetricUncertainty,
    RenderingQuery, Shared,
};
use chromascope_core::spectral::{
    Correlation, Evidence, GridSpectrum, Primaries, Quantity, Response, Sensor, SpectralDistribution,
    StatedUncertainty, StatedUncertaintyError,
};

use super::{D70, Kept, Normal, camera, of, spread, under};
use crate::support::{assert_near, chart, light};

const COUNT: usize = 301;

/// A camera's table on 400, 401, …, 700 nm.
fn table(name: &str) -> [Vec<f64>; 3] {
    let sensor = camera(name);
    [0, 1, 2].map(|c: usize| (0..COUNT).map(|j| sensor.at_index(20 + j)[c]).collect())
}

fn nm() -> Vec<f64> {
    (0..COUNT).map(|j| 400.0 + j as f64).collect()
}

fn sensor(table: &[Vec<f64>; 3]) -> Sensor {
    let curves = table.each_ref().map(|values| SpectralDistribution::new(nm(), values.clone()).unwrap());
    Sensor::new(Primaries::Camera, curves, Response::PerEnergy).unwrap()
}

fn query(sensor: Sensor) -> CameraMetricsQuery {
    let electrons = Some(Electrons::new(40_000.0, 3.0).unwrap());
    CameraMetricsQuery { electrons, ..under(sensor, "illuminants/d55.csv", Correction::default()) }
}

fn ask(of: &CameraMetricsQuery, own: OwnUncertainties) -> Vec<MetricUncertainty> {
    let (metrics, spread, response, ratio) = (of.clone(), spread(), Evidence::Stated, ChannelRatio::Unchecked);
    let all = Direct.ask(&MetricUncertaintiesQuery { metrics, spread, response, ratio, own });
    all.iter().map(|one| one.unwrap()).collect()
}

fn by_camera(of: &CameraMetricsQuery, stated: StatedUncertainty) -> Vec<MetricUncertainty> {
    ask(of, OwnUncertainties { camera: Some(Shared::new(stated)), ..OwnUncertainties::default() })
}

/// 1 % of the sample and 0.2 % of the peak.
fn standard(table: &[Vec<f64>; 3]) -> Vec<Vec<f64>> {
    let of = |curve: &Vec<f64>| {
        let peak = curve.iter().copied().fold(0.0, f64::max);
        curve.iter().map(|v| (0.01 * v).hypot(0.002 * peak)).collect()
    };
    table.iter().map(of).collect()
}

fn stated(standard: Vec<Vec<f64>>) -> StatedUncertainty {
    StatedUncertainty::new(standard, 1.0).unwrap()
}

/// Standard deviations of all metrics over 300 tables with errors in units of the standard uncertainty: known to 4 %.
fn sampled(table: &[Vec<f64>; 3], u: &[Vec<f64>], mut errors: impl FnMut() -> [Vec<f64>; 3]) -> Vec<f64> {
    let ask = Kept::default();
    let of = query(sensor(table));
    let draw = |_| {
        let errors = errors();
        let moved = [0, 1, 2].map(|c: usize| {
            table[c].iter().zip(&u[c]).zip(&errors[c]).map(|((value, u), z)| value + u * z).collect::<Vec<_>>()
        });
        let rendering = RenderingQuery { sensor: Shared::new(sensor(&moved)), ..of.rendering.clone() };
        let metrics = ask.ask(&CameraMetricsQuery { rendering, ..of.clone() });
        metrics.values.iter().map(|value| value.unwrap()).collect()
    };
    deviations(&(0..300).map(draw).collect::<Vec<Vec<f64>>>())
}

fn deviations(draws: &[Vec<f64>]) -> Vec<f64> {
    let of = |at: usize| {
        let mean = draws.iter().map(|draw| draw[at]).sum::<f64>() / draws.len() as f64;
        let squares = draws.iter().map(|draw| (draw[at] - mean).powi(2)).sum::<f64>();
        (squares / (draws.len() - 1) as f64).sqrt()
    };
    (0..CameraMetric::ALL.len()).map(of).collect()
}

#[test]
fn the_larger_of_both_correlations_is_that_of_tables_drawn_plainly() {
    let table = table(D70);
    let u = standard(&table);
    let mut normal = Normal(0x0B5E);
    let none = sampled(&table, &u, || [(); 3].map(|()| (0..COUNT).map(|_| normal.next()).collect()));
    let one = |z: f64| vec![z; COUNT];
    let mut normal = Normal(0x0FF1);
    let common = sampled(&table, &u, || [one(normal.next())].map(|z| [z.clone(), z.clone(), z])[0].clone());
    let mut normal = Normal(0x0AA3);
    let each = sampled(&table, &u, || [(); 3].map(|()| one(normal.next())));
    for (at, found) in by_camera(&query(sensor(&table)), stated(u)).into_iter().enumerate() {
        let id = CameraMetric::ALL[at].id;
        let full = common[at].max(each[at]);
        assert_near(id, found.contributions.curves / none[at].max(full), 1.0, 0.17);
        let expected = if none[at] > full { Correlation::None } else { Correlation::Full };
        if (none[at] / full).ln().abs() > 0.3 {
            assert_eq!(found.source, UncertaintySource::Own(expected), "{id}");
        }
        assert_eq!((found.freedom, found.coverage), (f64::INFINITY, 1.959_964));
        assert_eq!((found.contributions.channel_ratio, found.is_extrapolated), (0.0, false));
    }
}

/// Errors that are alike over 30 nm, and by a third alike in the three channels.
#[test]
fn a_covariance_decides() {
    let table = table(D70);
    let u = standard(&table);
    let flat: Vec<f64> = u.concat();
    let correlation = |a: usize, b: usize| {
        let apart = (a % COUNT).abs_diff(b % COUNT) as f64;
        (-apart / 30.0).exp() * if a / COUNT == b / COUNT { 1.0 } else { 1.0 / 3.0 }
    };
    let size = 3 * COUNT;
    let covariance: Vec<f64> =
        (0..size * size).map(|at| flat[at / size] * flat[at % size] * correlation(at / size, at % size)).collect();
    let stated = stated(u.clone()).with_covariance(&covariance).unwrap();
    let mut normal = Normal(0x0C0F);
    let share = (1.0_f64 / 3.0).sqrt();
    // An autoregressive series has this correlation.
    let mut series = move || {
        let (by, mut z) = ((-1.0_f64 / 30.0).exp(), normal.next());
        (0..COUNT)
            .map(|_| {
                let now = z;
                z = by * z + (1.0 - by * by).sqrt() * normal.next();
                now
            })
            .collect::<Vec<f64>>()
    };
    let expected = sampled(&table, &u, || {
        let common = series();
        [(); 3].map(|()| {
            series().iter().zip(&common).map(|(own, all)| share * all + (1.0 - share * share).sqrt() * own).collect()
        })
    });
    for (at, found) in by_camera(&query(sensor(&table)), stated).into_iter().enumerate() {
        assert_near(CameraMetric::ALL[at].id, found.contributions.curves / expected[at], 1.0, 0.17);
        assert_eq!(found.source, UncertaintySource::Own(Correlation::Stated));
    }
}

#[test]
fn uncertainties_of_curves_scale_and_diagonal_covariances_are_uncorrelated() {
    let table = table("Canon EOS 5D Mark III");
    let asked = query(sensor(&table));
    // So small that metrics are linear, on samples whose curves stay positive.
    let small = |factor: f64| -> Vec<Vec<f64>> {
        table.iter().map(|curve| curve.iter().map(|v| 1e-5 * factor * v.max(0.0)).collect()).collect()
    };
    let [zero, one, two] = [0.0, 1.0, 2.0].map(|factor| by_camera(&asked, stated(small(factor))));
    let variances = small(1.0).concat();
    let size = variances.len();
    let mut covariance = vec![0.0; size * size];
    variances.iter().enumerate().for_each(|(at, u)| covariance[at * (size + 1)] = u * u);
    let diagonal = by_camera(&asked, stated(small(1.0)).with_covariance(&covariance).unwrap());
    for (at, metric) in CameraMetric::ALL.iter().enumerate() {
        assert_eq!(zero[at].standard, 0.0, "{}", metric.id);
        // Two patches that are all but equal change places in a percentile, which then is not linear: its mean shifts.
        let is_linear = one[at].bias.abs() < 0.01 * one[at].contributions.curves;
        assert!(is_linear || metric.id == "uv-prime-p95", "{}", metric.id);
        if is_linear {
            assert_near(metric.id, two[at].contributions.curves / one[at].contributions.curves, 2.0, 1e-4);
        }
        let [diagonal, larger] = [diagonal[at], one[at]].map(|one| one.contributions.curves);
        let is_uncorrelated = one[at].source == UncertaintySource::Own(Correlation::None);
        // What stimuli beyond the leading ones add is drawn at random.
        assert!(diagonal <= larger * 1.005, "{}: {diagonal} {larger}", metric.id);
        assert!(!is_uncorrelated || diagonal >= larger * 0.995, "{}: {diagonal} {larger}", metric.id);
    }
}

#[test]
fn impossible_covariances_are_refused() {
    let two = || stated(vec![vec![1.0], vec![2.0]]);
    let of = |covariance: &[f64]| two().with_covariance(covariance).err();
    assert_eq!(of(&[1.0, 2.1, 2.1, 4.0]), Some(StatedUncertaintyError::Indefinite));
    assert_eq!(of(&[1.0, 0.5, 0.5, 0.0]), Some(StatedUncertaintyError::Indefinite));
    assert_eq!(of(&[-1.0, 0.0, 0.0, 4.0]), Some(StatedUncertaintyError::Indefinite));
    assert_eq!(of(&[1.0, 0.0]), Some(StatedUncertaintyError::Size { samples: 2, found: 2 }));
    assert_eq!(of(&[1.0, 2.0, 2.0, 4.0]), None, "fully correlated");
    let three = stated(vec![vec![1.0; 3]]);
    let apart = [1.0, 0.9, 0.0, 0.9, 1.0, 0.9, 0.0, 0.9, 1.0];
    assert_eq!(three.with_covariance(&apart).err(), Some(StatedUncertaintyError::Indefinite));
    assert_eq!(StatedUncertainty::new(vec![vec![0.0; 20_000]], 1.0).err(), Some(StatedUncertaintyError::Samples));
}

#[test]
fn uncertainties_per_photon_are_converted_with_their_curves() {
    let table = table(D70);
    let per_photon = [0, 1, 2].map(|c: usize| table[c].iter().zip(nm()).map(|(v, nm)| v * 550.0 / nm).collect());
    let curves =
        per_photon.each_ref().map(|values: &Vec<f64>| SpectralDistribution::new(nm(), values.clone()).unwrap());
    let photons = Sensor::new(Primaries::Camera, curves, Response::PerPhoton).unwrap();
    let u = standard(&table);
    let of_photons = u.iter().map(|u| u.iter().zip(nm()).map(|(u, nm)| u * 550.0 / nm).collect()).collect();
    let pairs = by_camera(&query(sensor(&table)), stated(u)).into_iter();
    for (a, b) in pairs.zip(by_camera(&query(photons), stated(of_photons))) {
        assert_near("u", a.contributions.curves / b.contributions.curves, 1.0, 1e-6);
    }
}

#[test]
fn light_and_patches_have_parts_of_their_own() {
    let asked = query(camera(D70));
    let nm: Vec<f64> = (0..41).map(|j| 380.0 + 10.0 * f64::from(j)).collect();
    let d55 = light("illuminants/d55.csv");
    let measured = SpectralDistribution::new(nm, d55.values().iter().step_by(10).copied().collect()).unwrap();
    let on_grid = |of: &SpectralDistribution| Shared::new(GridSpectrum::resample(of, Quantity::Light));
    let under = |light: Shared<GridSpectrum>| {
        let [rendering, reference] =
            [&asked.rendering, &asked.reference].map(|of| RenderingQuery { light: light.clone(), ..of.clone() });
        CameraMetricsQuery { rendering, reference, ..asked.clone() }
    };
    let asked = under(on_grid(&measured));
    let chart = chart();
    let u: Vec<f64> = measured.values().iter().map(|v| 0.02 * v).collect();
    let light = LightUncertainty { measured: measured.clone(), stated: stated(vec![u.clone()]), transmittance: None };
    let of_patches: Vec<Vec<f64>> = chart.patches().iter().map(|p| vec![0.004; p.measured.values().len()]).collect();
    let own = OwnUncertainties {
        camera: None,
        light: Some(Shared::new(light)),
        patches: Some(Shared::new(stated(of_patches))),
    };
    let found = ask(&asked, own);
    let mut normal = Normal(0x11E7);
    let moved = |of: &SpectralDistribution, z: &mut dyn FnMut() -> f64, u: &dyn Fn(usize) -> f64| {
        let values = of.values().iter().enumerate().map(|(j, value)| value + u(j) * z()).collect();
        SpectralDistribution::new(of.wavelengths_nm().to_vec(), values).unwrap()
    };
    let values = |of: &CameraMetricsQuery| Direct.ask(of).values.iter().map(|value| value.unwrap()).collect::<Vec<_>>();
    let mut lights = |is_common: bool| {
        let draw = |_| {
            let z = normal.next();
            values(&under(on_grid(&moved(&measured, &mut || if is_common { z } else { normal.next() }, &|j| u[j]))))
        };
        deviations(&(0..200).map(draw).collect::<Vec<_>>())
    };
    let [none, full] = [lights(false), lights(true)];
    let mut normal = Normal(0x9A7C);
    let mut charts = |alike: &str| {
        let draw = |_| {
            let common = normal.next();
            let patches = chart.patches().iter().map(|patch| {
                let own = normal.next();
                let mut z = || match alike {
                    "all" => common,
                    "each" => own,
                    _ => normal.next(),
                };
                (patch.name.clone(), moved(&patch.measured, &mut z, &|_| 0.004))
            });
            let patches = Shared::new(PatchSet::new(patches.collect::<Vec<_>>()));
            values(&CameraMetricsQuery { patches, ..asked.clone() })
        };
        deviations(&(0..200).map(draw).collect::<Vec<_>>())
    };
    let [none_alike, each, all] = ["none", "each", "all"].map(&mut charts);
    for (at, metric) in CameraMetric::ALL.iter().enumerate() {
        let parts = found[at].contributions;
        let is_by_light = !matches!(metric.group, MetricGroup::Sensitivities);
        let expected = none[at].max(full[at]);
        if is_by_light {
            assert_near(&format!("{} light", metric.id), parts.light / expected, 1.0, 0.2);
        } else {
            assert_eq!(parts.light, 0.0, "{}", metric.id);
        }
        if metric.group == MetricGroup::Differences {
            let expected = none_alike[at].max(each[at]).max(all[at]);
            assert_near(&format!("{} patches", metric.id), parts.patches / expected, 1.0, 0.2);
        } else {
            assert_eq!(parts.patches, 0.0, "{}", metric.id);
        }
        assert_near(metric.id, found[at].standard, parts.combined(), 0.0);
        assert_eq!(found[at].source, UncertaintySource::Prior);
    }
    assert!(of(&found.iter().copied().map(Some).collect::<Vec<_>>(), "delta-e2000-mean").contributions.patches > 0.0);
}

/// Uncertainty of red alone, with the covariance of its samples in parts of the product of their standard uncertainties.
fn of_red(u: &[f64], correlation: impl Fn(usize, usize) -> f64) -> StatedUncertainty {
    let size = 3 * COUNT;
    let mut covariance = vec![0.0; size * size];
    for at in 0..COUNT * COUNT {
        let [a, b] = [at / COUNT, at % COUNT];
        covariance[a * size + b] = u[a] * u[b] * correlation(a, b);
    }
    stated(vec![u.to_vec(), vec![0.0; COUNT], vec![0.0; COUNT]]).with_covariance(&covariance).unwrap()
}

/// Relative uncertainty of the noise gain of red by Eq 13: RGB are those of sRGB, so it is `∫g L dλ / ∫r L dλ`.
fn of_gain(of: &CameraMetricsQuery, stated: StatedUncertainty) -> f64 {
    let [rendering, reference] =
        [&of.rendering, &of.reference].map(|of| RenderingQuery { transform: ColorTransformSpec::Paper, ..of.clone() });
    let metrics = CameraMetricsQuery { rendering, reference, ..of.clone() };
    let own = OwnUncertainties { camera: Some(Shared::new(stated)), ..OwnUncertainties::default() };
    let value = Direct.ask(&metrics).of(CameraMetric::by_id("noise-red").unwrap()).unwrap().unwrap();
    let (spread, response, ratio) = (spread(), Evidence::Stated, ChannelRatio::Unchecked);
    let all = Direct.ask(&MetricUncertaintiesQuery { metrics, spread, response, ratio, own });
    super::of(&all, "noise-red").contributions.curves / value
}

/// A factor that red is known to: white balance divides it out, and the gain of red has all of it.
#[test]
fn a_factor_of_one_channel_moves_gains_alone() {
    let table = table(D70);
    let asked = query(sensor(&table));
    let u: Vec<f64> = table[0].iter().map(|value| 1e-3 * value).collect();
    let decided = by_camera(&asked, of_red(&u, |_, _| 1.0));
    let either = by_camera(&asked, stated(vec![u.clone(), vec![0.0; COUNT], vec![0.0; COUNT]]));
    for (at, metric) in CameraMetric::ALL.iter().enumerate() {
        let [found, larger] = [decided[at], either[at]].map(|of| of.contributions.curves);
        let by_gain = ["noise-red", "noise-green", "noise-blue", "condition", "gray-snr"].contains(&metric.id);
        if by_gain {
            assert!(found > 0.0 && larger >= 0.999 * found, "{}: {found} {larger}", metric.id);
        } else {
            assert!(found < 1e-9 * larger, "{}: {found} {larger}", metric.id);
            assert_eq!(either[at].source, UncertaintySource::Own(Correlation::None), "{}", metric.id);
        }
    }
    assert_near("gain", of_gain(&asked, of_red(&u, |_, _| 1.0)), 1e-3, 1e-8);
}

/// Of uncorrelated errors a sum has the root of the sum of squares, of partly correlated ones that with the products of two.
#[test]
fn a_gain_has_the_uncertainty_of_a_weighted_sum() {
    let table = table(D70);
    let asked = query(sensor(&table));
    let u: Vec<f64> = (0..COUNT).map(|j| 1e-3 * table[0][j] + 1e-5 * (j % 7) as f64).collect();
    let light = &asked.rendering.light.values()[20..20 + COUNT];
    let weighted = |of: &[f64], j: usize| light[j] * of[j] * if j.is_multiple_of(COUNT - 1) { 0.5 } else { 1.0 };
    let sum: f64 = (0..COUNT).map(|j| weighted(&table[0], j)).sum();
    let uncorrelated = |a: usize, b: usize| f64::from(u8::from(a == b));
    let alike = |a: usize, b: usize| (-((a as f64 - b as f64) / 25.0).powi(2)).exp() * 0.7 + 0.3 * uncorrelated(a, b);
    for correlation in [&uncorrelated as &dyn Fn(usize, usize) -> f64, &alike] {
        let terms = (0..COUNT * COUNT).map(|at| {
            let [a, b] = [at / COUNT, at % COUNT];
            weighted(&u, a) * weighted(&u, b) * correlation(a, b)
        });
        let expected = terms.sum::<f64>().sqrt() / sum;
        assert_near("gain", of_gain(&asked, of_red(&u, correlation)) / expected, 1.0, 1e-3);
    }
}
