//! Synthetic recordings of the chart with known cameras, and the library without them.

use chromascope_core::camera::recorded::{RecordedPatch, Signal};
use chromascope_core::math::random::SplitMix64;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::recovery::{Library, Shot};
use chromascope_core::spectral::{GridSpectrum, Sensor};

use crate::support::{patches, sensors};

pub(super) const D65: &str = "illuminants/d65.csv";
pub(super) const A: &str = "illuminants/a.csv";

/// 380, 390, …, 780 nm.
pub(super) fn sites() -> Vec<f64> {
    (0..41).map(|i| 380.0 + 10.0 * f64::from(i)).collect()
}

pub(super) fn chart() -> PatchSet {
    patches("charts/colorchecker_24_babelcolor_average.csv")
}

pub(super) fn cameras() -> Vec<(String, Sensor)> {
    sensors("cameras")
        .into_iter()
        .map(|(path, sensor)| (path.replace("cameras/", "").replace(".csv", ""), sensor))
        .collect()
}

/// The library without the tables that a name is not to have.
pub(super) fn library_without(cameras: &[(String, Sensor)], omitted: impl Fn(&str) -> bool) -> Library {
    Library::new(cameras.iter().filter(|(name, _)| !omitted(name)).cloned(), &sites())
}

pub(super) fn maker(name: &str) -> &str {
    name.split('_').next().unwrap()
}

/// The model without the laboratory.
pub(super) fn model(name: &str) -> String {
    ["_a_m_p_a_s", "_upenn_2011", "_2007_figure", "_npl"]
        .iter()
        .fold(name.to_owned(), |name, lab| name.replace(lab, ""))
}

/// Normal numbers by sums of twelve uniform ones.
pub(super) fn normal(random: &mut SplitMix64) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// Conditions of a synthetic recording.
#[derive(Clone, Copy)]
pub(super) struct Conditions {
    /// Standard deviation of a value relative to itself.
    pub(super) noise: f64,
    /// Standard deviation of the logarithm of brightness.
    pub(super) uneven: f64,
    pub(super) glare: [f64; 3],
    /// Standard deviation that is stated, relative to a value.
    pub(super) stated: f64,
    /// Chart that is recorded in place of the one that is named.
    pub(super) chart: Option<&'static str>,
    /// Light that is recorded under in place of the one that is named.
    pub(super) light: Option<&'static str>,
}

pub(super) const EVEN: Conditions =
    Conditions { noise: 0.01, uneven: 0.0, glare: [0.0; 3], stated: 0.01, chart: None, light: None };

pub(super) fn shot(sensor: &Sensor, light: &GridSpectrum, with: Conditions, random: &mut SplitMix64) -> Shot {
    let (chart, own_light) = (chart(), with.light.map_or_else(|| light.clone(), crate::support::light));
    let own_chart = with.chart.map_or_else(|| chart.clone(), crate::support::patches);
    let white = sensor.integrate(own_light.values());
    let (mut patches, mut noise) = (Vec::new(), Vec::new());
    for (patch, own) in chart.patches().iter().zip(own_chart.patches()) {
        let (radiance, own) = (patch.grid.times(light), own.grid.times(&own_light));
        let (raw, bright) = (sensor.integrate(own.values()), (with.uneven * normal(random)).exp());
        let value = |c: usize| [0.6, 1.0, 0.7][c] / white[1] * (bright * raw[c] + with.glare[c] * white[c]);
        let recorded = [0, 1, 2].map(|c| value(c) * (1.0 + with.noise * normal(random)));
        noise.push(recorded.map(|v| v * with.stated));
        let rgb = recorded.map(|v| Signal::new(v, f64::INFINITY));
        patches.push(RecordedPatch { name: patch.name.clone(), radiance, rgb });
    }
    Shot { patches, noise, light: light.clone(), columns: Some(6), drifts: Vec::new() }
}
