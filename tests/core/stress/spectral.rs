//! Stress tests of spectra, grid, sensors and renderings: wavelengths in any order, spikes, zeros, invisible light.

use std::sync::LazyLock;

use chromascope_core::camera::rendering::{raw, under_light, white_divisors};
use chromascope_core::camera::{ColorTransform, FitTargets, Rendering, WhiteBalanceTarget};
use chromascope_core::colorimetry::diagram::{spectral_locus, wavelength_color};
use chromascope_core::correction::Correction;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::spectral::grid::{COUNT, wavelength_nm};
use chromascope_core::spectral::{GridSpectrum, Primaries, Quantity, Response, Sensor, SpectralDistribution};
use chromascope_math::dot::dot;
use chromascope_math::double::Double;

use super::draw::{Case, Draw, case};
use super::walk::{Verdict, Walk};
use crate::support::{CANON_10D, CIE_1931, sensor, training};

pub(super) const WALKS: &[Walk] = &[
    Walk { name: "SpectralDistribution::new", promise: 0.0, share: 20.0, draw: draw_samples, check: samples },
    Walk { name: "GridSpectrum::resample", promise: 1e-13, share: 2.0, draw: draw_samples, check: resampled },
    Walk { name: "GridSpectrum::from_fn", promise: 0.0, share: 2.0, draw: |d| case([d.anything()]), check: constant },
    Walk { name: "Sensor::new", promise: 1.0, share: 0.5, draw: draw_scene, check: any_sensor },
    Walk { name: "Rendering::new", promise: 1e-15, share: 0.5, draw: draw_scene, check: rendering },
    Walk { name: "Rendering::by_targets", promise: 1e-12, share: 0.1, draw: draw_scene, check: fitted },
    Walk { name: "wavelength_color", promise: 0.0, share: 4.0, draw: |d| case([d.anything()]), check: wavelength },
];

static OBSERVER: LazyLock<Sensor> = LazyLock::new(|| sensor(CIE_1931));
static CAMERA: LazyLock<Sensor> = LazyLock::new(|| sensor(CANON_10D));
static TRAINING: LazyLock<PatchSet> = LazyLock::new(training);

fn draw_samples(d: &mut Draw) -> Case {
    case([d.key(), d.pick(8), d.pick(8), d.log(1e-320, 1e300), d.pick(50)])
}

/// Wavelengths in some order and values of some kind; both may be what no spectrum has.
fn table(key: f64, order: f64, kind: f64, size: f64, count: f64) -> (Vec<f64>, Vec<f64>) {
    let mut d = Draw::new(key as u64, "samples", 0);
    let n = count.clamp(0.0, 100.0) as usize;
    let (start, step) = (d.within(300.0, 500.0), d.log(0.01, 30.0));
    let mut nm: Vec<f64> = (0..n).map(|i| start + step * i as f64).collect();
    let place = d.pick(n.max(1) as u32) as usize;
    match order as u32 {
        0 => nm.reverse(),
        1 if n > 0 => nm[place] = d.anything(),
        2 if n > 1 => nm[place] = nm[n - 1 - place],
        3 => nm.iter_mut().for_each(|nm| *nm += step * d.unit()),
        4 => nm.truncate(1),
        _ => {}
    }
    let values = (0..nm.len()).map(|i| match kind as u32 {
        0 => 0.0,
        1 => f64::from(u8::from(i == place)) * size,
        2 => size,
        3 => d.anything(),
        4 => d.signed(1e-300, 1e300),
        5 => d.log(1e-323, 1e-300),
        _ => d.unit(),
    });
    let values = values.collect();
    (nm, values)
}

fn samples(&[key, order, kind, size, count, ..]: &Case, v: &mut Verdict) {
    let (nm, values) = table(key, order, kind, size, count);
    let ascending = nm.windows(2).all(|w| w[0] < w[1]) && nm.iter().all(|nm| nm.is_finite() && *nm > 0.0);
    let usable = values.iter().all(|v| v.abs() <= 1e100);
    let Ok(spectrum) = SpectralDistribution::new(nm.clone(), values) else {
        v.holds("refused without need", nm.is_empty() || !ascending || !usable);
        return v.refuse();
    };
    v.holds("taken though it is no spectrum", !nm.is_empty() && ascending && usable);
    v.holds("another range", spectrum.range_nm() == [nm[0], nm[nm.len() - 1]]);
    v.holds("another length", spectrum.values().len() == spectrum.wavelengths_nm().len());
    if let Some(step) = spectrum.uniform_step_nm() {
        v.finite(step);
        v.holds("a step that is not positive", step > 0.0);
    }
    let doubled = spectrum.map(|_, value| 2.0 * value);
    v.holds("no double of it", doubled.is_ok() || spectrum.values().iter().any(|v| v.abs() > 0.4e100));
    v.holds("no number taken", spectrum.map(|_, _| f64::NAN).is_err());
}

const QUANTITIES: [Quantity; 4] =
    [Quantity::Light, Quantity::Reflectance, Quantity::CameraSensitivity, Quantity::MatchingFunction];

fn resampled(&[key, order, kind, size, count, ..]: &Case, v: &mut Verdict) {
    let (nm, values) = table(key, order, kind, size, count);
    let Ok(spectrum) = SpectralDistribution::new(nm, values) else { return v.refuse() };
    let largest = spectrum.values().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let [first, last] = spectrum.range_nm();
    for quantity in QUANTITIES {
        let grid = GridSpectrum::resample(&spectrum, quantity);
        v.all_finite(grid.values().iter().copied());
        // The extension at the ends and a spike raise Sprague's polynomial; by how much is bounded by its coefficients.
        v.holds("far beyond the data", grid.values().iter().all(|x| x.abs() <= 60.0 * largest));
        let clamps = matches!(quantity, Quantity::Reflectance | Quantity::CameraSensitivity);
        v.holds("below 0", !clamps || grid.values().iter().all(|x| *x >= 0.0));
        let assumed = grid.assumed();
        v.holds("measured and not", assumed.nothing() == (first <= 380.0 && last >= 780.0));
        if kind == 2.0 {
            let inside = (0..COUNT).filter(|&i| (first..=last).contains(&wavelength_nm(i)));
            let size = spectrum.values()[0];
            inside.for_each(|i| v.relative(grid.values()[i], size, if size < 1e-300 { 1.0 } else { 0.0 }));
        }
    }
}

fn constant(&[x, ..]: &Case, v: &mut Verdict) {
    let value = if x.is_finite() { x } else { 0.0 };
    v.holds("not constant", GridSpectrum::constant(x).values().iter().all(|y| *y == value));
    let bent = GridSpectrum::from_fn(|nm| x * nm);
    v.all_finite(bent.values().iter().copied());
    v.holds("something assumed", bent.assumed().nothing());
}

fn draw_scene(d: &mut Draw) -> Case {
    case([d.key(), d.pick(4), if d.pick(2) == 0.0 { 1.0 } else { d.log(1e-100, 1e99) }, d.pick(6), d.number()])
}

/// A sensor of three curves of any kind that a spectrum can have, if it is one.
pub(super) fn drawn_sensor(key: f64, primaries: Primaries, size: f64) -> Option<Sensor> {
    let mut d = Draw::new(key as u64, "sensor", 0);
    let response = if d.pick(2) == 0.0 { Response::PerEnergy } else { Response::PerPhoton };
    let plain = d.pick(2) == 0.0;
    let mut curve = || {
        let (nm, values) = if plain {
            // Bells with side lobes, as a sensor may be.
            let (center, width) = (d.within(400.0, 700.0), d.log(5.0, 100.0));
            let nm: Vec<f64> = (0..81).map(|i| 380.0 + 5.0 * f64::from(i)).collect();
            let lobe = d.within(-0.2, 0.2);
            let bell = |x: f64| (-x * x).exp() + lobe * (-(x - 2.0).powi(2)).exp();
            let values = nm.iter().map(|nm| size * bell((nm - center) / width)).collect();
            (nm, values)
        } else {
            table(d.key(), 5.0, d.pick(8), size, 1.0 + d.pick(50))
        };
        SpectralDistribution::new(nm, values).ok()
    };
    let curves = [curve()?, curve()?, curve()?];
    Sensor::new(primaries, curves, response).ok()
}

fn primaries(kind: f64) -> Primaries {
    [Primaries::Camera, Primaries::Rgb, Primaries::Xyz, Primaries::Cones][kind.max(0.0) as usize % 4]
}

/// Lights: even, a line, nothing, where the sensor sees nothing, far out, negative.
pub(super) fn drawn_light(key: f64, kind: f64, sensor: &Sensor) -> GridSpectrum {
    let line = Draw::new(key as u64, "line", 0).within(380.0, 780.0).round();
    let index = |nm: f64| (nm - 380.0) as usize;
    let seen = |nm: f64| (0..3).any(|c| sensor.weighted(c)[index(nm)] != 0.0);
    GridSpectrum::from_fn(|nm| match kind as u32 {
        0 => 1.0,
        1 => f64::from(u8::from(nm == line)),
        2 => 0.0,
        3 => f64::from(u8::from(!seen(nm))),
        4 => 1e100 * (nm / 780.0).powi(40),
        _ => 1.0 - 2.0 * nm / 780.0,
    })
}

fn any_sensor(&[key, kind, size, light, ..]: &Case, v: &mut Verdict) {
    let Some(sensor) = drawn_sensor(key, primaries(kind), size) else { return v.refuse() };
    v.all_finite(sensor.integrals());
    v.holds("blind", (0..3).all(|c| sensor.weighted(c).iter().any(|v| *v != 0.0)));
    v.all_finite((0..COUNT).flat_map(|i| sensor.at_index(i)));
    v.all_finite(sensor.support_nm());
    let spectrum = drawn_light(key, light, &sensor);
    let signals = sensor.integrate(spectrum.values());
    v.all_finite(signals);
    for (c, signal) in signals.into_iter().enumerate() {
        let (mut exact, mut unsigned) = (Double::from(0.0), 0.0);
        for (a, b) in sensor.weighted(c).iter().zip(spectrum.values()) {
            exact = exact + Double::from(*a) * (*b).into();
            unsigned += (a * b).abs();
        }
        let off = (signal - exact.value()).abs();
        let bound = (COUNT as f64 / 8.0 + 3.0) * f64::EPSILON * unsigned;
        v.error(if off == 0.0 || unsigned < 1e-290 { 0.0 } else { off / bound });
        v.holds("not as dot", signal == dot(sensor.weighted(c), spectrum.values()));
    }
    let locus = spectral_locus(&sensor);
    v.all_finite(locus.iter().flat_map(|p| [p.xy.x, p.xy.y, p.wavelength_nm]));
}

fn rendering(&[key, kind, size, light, white, ..]: &Case, v: &mut Verdict) {
    let Some(sensor) = drawn_sensor(key, primaries(kind), size) else { return v.refuse() };
    let light = drawn_light(key + 1.0, light, &sensor);
    // A white's numbers are open to all; within what a spectrum's may be.
    let white = WhiteBalanceTarget([1.0, if white.is_finite() { white.clamp(-1e100, 1e100) } else { 1.0 }, 0.5]);
    let own = light_samples(&light).and_then(|light| WhiteBalanceTarget::from_light(&light, &OBSERVER));
    v.holds("a white that is no number", own.is_none_or(|white| white.0.iter().all(|s| s.is_finite())));
    let Ok(rendering) = Rendering::new(&sensor, &light, white, ColorTransform::Paper) else { return v.refuse() };
    let divisors = white_divisors(&sensor, &light);
    v.holds("other divisors", divisors.is_ok_and(|d| d == rendering.white_integrals));
    v.all_finite([rendering.conditioning]);
    v.all_finite(rendering.white_integrals.to_array().into_iter().chain(rendering.locus_gain.to_array()));
    let product = under_light(&sensor, &light);
    let perfect = raw(&product, GridSpectrum::constant(1.0).values());
    let signals = rendering.patch_signals(perfect.to_array());
    v.all_finite(signals.to_array());
    if rendering.is_rgb {
        v.holds("a perfect white is another", signals == rendering.white);
    }
    let xyz = rendering.xyz(signals);
    v.all_finite([xyz.x, xyz.y, xyz.z].into_iter().chain(rendering.linear_srgb(xyz)));
    if let Some(lab) = rendering.lab(xyz) {
        v.all_finite([lab.l, lab.a, lab.b]);
    }
    if !rendering.is_rgb {
        v.relative(xyz.y, 1.0, 0.0);
    }
}

fn light_samples(light: &GridSpectrum) -> Option<SpectralDistribution> {
    SpectralDistribution::new((0..COUNT).map(wavelength_nm).collect(), light.values().to_vec()).ok()
}

/// By an observer: white stays, whatever the sensor.
fn fitted(&[key, kind, size, light, ..]: &Case, v: &mut Verdict) {
    let Some(sensor) = drawn_sensor(key, primaries(kind), size) else { return v.refuse() };
    let light = drawn_light(key + 1.0, light, &CAMERA);
    let targets = FitTargets::new(&OBSERVER, &light, &TRAINING);
    let answer = Rendering::by_targets(
        &sensor,
        &light,
        WhiteBalanceTarget::UNITY,
        &TRAINING,
        targets.as_ref().map_err(|&e| e),
        &Correction::default(),
    );
    let transform =
        ColorTransform::Observer { reference: &OBSERVER, training: &TRAINING, correction: Correction::default() };
    v.holds("two ways differ", Rendering::new(&sensor, &light, WhiteBalanceTarget::UNITY, transform) == answer);
    let Ok(rendering) = answer else { return v.refuse() };
    v.holds("not finite", rendering.xyz_from_signals.is_finite() && rendering.srgb_from_xyz.is_finite());
    if sensor.primaries() != Primaries::Xyz {
        let white = rendering.xyz(rendering.white).to_vector() - rendering.lab_white.to_vector();
        let size = rendering.xyz_from_signals.to_cols_array().iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        v.error(white.abs().max_element() / size);
    }
}

fn wavelength(&[nm, ..]: &Case, v: &mut Verdict) {
    let color = wavelength_color(&OBSERVER, nm);
    v.holds("no color for a wavelength", color != [0; 3] || !(400.0..700.0).contains(&nm));
}
