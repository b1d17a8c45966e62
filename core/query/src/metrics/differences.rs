//! Differences of patches from the reference, with their statistics.

use super::value::WhyNot;
use crate::compare::{comparable_by_paper, difference};
use crate::patches::{ColorTransformSpec, PatchColor, RenderingQuery};
use chromascope_color::camera::Rendering;
use chromascope_color::colorimetry::{Coordinates, Lab, Metric, Stimulus, UvPrime, Xy, Xyz, lab::lab_from_each};
use chromascope_color::spectral::Primaries;
use chromascope_math::quantile::quantile;
use glam::DVec3;

/// Number of patches that are named as the worst.
pub const WORST: usize = 5;

/// A statistic over patches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Statistic {
    /// Arithmetic mean.
    Mean,
    /// Median; the mean of the two middle values of an even number.
    Median,
    /// 95th percentile, linear between the order statistics (Hyndman and Fan's type 7).
    Percentile95,
    /// Largest value.
    Maximum,
}

/// Differences of one patch from the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchDifferences {
    /// By each metric of `Metric::ALL`, in its order.
    pub by_metric: Vec<Result<f64, WhyNot>>,
    /// Lightness difference ΔL*, chroma difference ΔC*ab and hue difference ΔH*ab, sample minus reference (CIE 15:2004, 8.2.1.3);
    /// none where L*a*b* is undefined.
    ///
    /// ```text
    /// ΔH*ab = 2 √(C₁C₂) sin(Δh/2),   ΔE*ab² = ΔL*² + ΔC*ab² + ΔH*ab²
    /// ```
    pub lch: Option<[f64; 3]>,
    /// Angle between the linear sRGB vectors of sample and reference, in degrees; none for a vector of length zero.
    pub angle_deg: Option<f64>,
}

/// A patch through a sensor as differences need it. Chromaticities follow when they are asked for: draws are many, and mostly nothing asks.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    stimulus: Stimulus,
    linear: [f64; 3],
}

impl Seen {
    /// Of raw responses.
    pub(super) fn all(rendering: &Rendering, raw: &[DVec3]) -> Vec<Self> {
        let xyz = |raw: &DVec3| rendering.xyz(rendering.patch_signals(raw.to_array()));
        let colors: Vec<Xyz> = raw.iter().map(xyz).collect();
        let labs = lab_from_each(&colors, rendering.lab_white);
        let seen = |(at, &xyz): (usize, &Xyz)| {
            // Where one has no L*a*b*, others may.
            let lab = labs.as_ref().map_or_else(|| rendering.lab(xyz), |labs| Some(labs[at]));
            Self { stimulus: Stimulus { xyz, lab }, linear: rendering.linear_srgb(xyz) }
        };
        colors.iter().enumerate().map(seen).collect()
    }
}

impl From<&PatchColor> for Seen {
    fn from(color: &PatchColor) -> Self {
        Self { stimulus: Stimulus { xyz: color.xyz, lab: color.lab }, linear: color.linear }
    }
}

impl Coordinates for Seen {
    fn xy(&self) -> Option<Xy> {
        self.stimulus.xy()
    }

    fn uv_prime(&self) -> Option<UvPrime> {
        self.stimulus.uv_prime()
    }

    fn lab(&self) -> Option<Lab> {
        self.stimulus.lab
    }
}

/// Conditions under which differences have a meaning.
#[derive(Clone, Copy)]
pub(super) struct DifferenceConditions {
    pub(super) comparable: Result<(), WhyNot>,
    by_eq_13: bool,
}

impl DifferenceConditions {
    pub(super) fn new(sample: &RenderingQuery, reference: &RenderingQuery) -> Self {
        let [of_reference, of_sample] = [reference, sample].map(|rendering| rendering.sensor.primaries());
        let paper = sample.transform == ColorTransformSpec::Paper;
        let comparable =
            if paper { comparable_by_paper(of_reference, of_sample).map_err(WhyNot::from) } else { Ok(()) };
        Self { comparable, by_eq_13: paper && of_sample != Primaries::Xyz }
    }

    pub(super) fn differences(&self, reference: &PatchColor, sample: &Seen) -> PatchDifferences {
        PatchDifferences {
            by_metric: Metric::ALL.iter().map(|&metric| self.difference(metric, reference, sample)).collect(),
            lch: self.lch(reference, sample),
            angle_deg: self.angle_deg(reference, sample),
        }
    }

    pub(super) fn difference(&self, metric: Metric, reference: &PatchColor, sample: &Seen) -> Result<f64, WhyNot> {
        self.defines(metric)?;
        Ok(difference(metric, reference, sample)?)
    }

    /// Differences of pairs.
    pub(super) fn each(&self, metric: Metric, references: &[PatchColor], samples: &[Seen]) -> Result<Vec<f64>, WhyNot> {
        self.defines(metric)?;
        let pairs = || references.iter().zip(samples);
        metric
            .between_each(pairs())
            .map_or_else(|| pairs().map(|(reference, sample)| Ok(difference(metric, reference, sample)?)).collect(), Ok)
    }

    fn defines(&self, metric: Metric) -> Result<(), WhyNot> {
        self.comparable?;
        if self.by_eq_13 && metric.needs_adopted_white() { Err(WhyNot::Eq13) } else { Ok(()) }
    }

    pub(super) fn lch(&self, reference: &PatchColor, sample: &Seen) -> Option<[f64; 3]> {
        let labs = reference.lab.zip(sample.lab()).filter(|_| self.comparable.is_ok() && !self.by_eq_13);
        labs.map(|(reference, sample)| lightness_chroma_hue(reference, sample))
    }

    pub(super) fn angle_deg(&self, reference: &PatchColor, sample: &Seen) -> Option<f64> {
        angle_deg(reference.linear, sample.linear).filter(|_| self.comparable.is_ok())
    }
}

fn lightness_chroma_hue(reference: Lab, sample: Lab) -> [f64; 3] {
    let [c1, c2] = [reference, sample].map(|lab| lab.a.hypot(lab.b));
    let cross = reference.a * sample.b - reference.b * sample.a;
    let dot = reference.a * sample.a + reference.b * sample.b;
    let hue = cross.atan2(dot);
    [sample.l - reference.l, c2 - c1, 2.0 * (c1 * c2).sqrt() * (hue / 2.0).sin()]
}

/// Angle between two vectors in degrees, exact for small ones too.
fn angle_deg(a: [f64; 3], b: [f64; 3]) -> Option<f64> {
    let [a, b] = [a, b].map(DVec3::from_array).map(DVec3::try_normalize);
    let (a, b) = (a?, b?);
    // Kahan's form: the arc cosine loses half the digits of a small angle.
    Some(2.0 * (a - b).length().atan2((a + b).length()).to_degrees())
}

impl Statistic {
    /// The statistic of some values, in any order; none of nothing.
    pub fn over(self, values: &[f64]) -> Option<f64> {
        match self {
            Self::Mean => (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64),
            Self::Median => quantile(&mut values.to_vec(), 0.5),
            Self::Percentile95 => quantile(&mut values.to_vec(), 0.95),
            Self::Maximum => values.iter().copied().max_by(f64::total_cmp),
        }
    }
}

/// For each metric the patches with the largest differences, largest first.
pub(super) fn worst(patches: &[PatchDifferences]) -> Vec<Vec<usize>> {
    let of_metric = |metric: usize| {
        let value = |patch: &PatchDifferences| patch.by_metric.get(metric).and_then(|value| value.ok());
        let mut found: Vec<(usize, f64)> =
            patches.iter().enumerate().filter_map(|(at, patch)| Some((at, value(patch)?))).collect();
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        found.into_iter().take(WORST).map(|(at, _)| at).collect()
    };
    (0..Metric::ALL.len()).map(of_metric).collect()
}
