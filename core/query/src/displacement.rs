//! Displacements of colors from a reference's: vectors in a plane, just visible differences, deviations of loci.

use std::f64::consts::TAU;

use chromascope_color::camera::RenderingError;
use chromascope_color::camera::locus_deviation::LocusDeviation;
use chromascope_color::colorimetry::{Lab, Metric, Stimulus, Xyz};
use chromascope_color::units::Kelvin;
use chromascope_math::quantile::quantile;
use rayon::prelude::*;

use super::ask::{Ask, Query};
use super::loci::{LocusPoint, LocusQuery};
use super::metrics::ReferenceLocusQuery;
use super::patches::RenderingQuery;

/// Radius in u′v′ of the circle within which half of observers see no difference between two lights (CIE TN 001:2014,
/// *Chromaticity difference specification for light sources*: Δu′v′ of 0.0013 at 50 % probability).
pub const JUST_VISIBLE_UV_PRIME: f64 = 0.0013;

/// Vectors from the reference's colors to a sensor's in one plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Displacements {
    /// Of each color; none where one of the two is undefined.
    pub vectors: Vec<Option<[f64; 2]>>,
    /// Mean vector; zero of none.
    pub mean: [f64; 2],
    /// Mean of the lengths; zero of none.
    pub mean_length: f64,
    /// 95 % quantile of the lengths, linear between the order statistics; zero of none.
    pub p95: f64,
}

impl Displacements {
    /// Displacements of pairs of reference and sample.
    ///
    /// ```
    /// # use chromascope_core::query::Displacements;
    /// let pairs = [(Some([0.2, 0.5]), Some([0.2, 0.53])), (Some([0.3, 0.5]), Some([0.34, 0.5])), (None, Some([0.1, 0.1]))];
    /// let all = Displacements::new(pairs);
    /// assert!((all.mean[0] - 0.02).abs() < 1e-12 && (all.mean_length - 0.035).abs() < 1e-12);
    /// ```
    pub fn new(pairs: impl IntoIterator<Item = (Option<[f64; 2]>, Option<[f64; 2]>)>) -> Self {
        let between = |(reference, sample): (Option<[f64; 2]>, Option<[f64; 2]>)| {
            let ([a, b], [c, d]) = reference.zip(sample)?;
            Some([c - a, d - b])
        };
        let vectors: Vec<Option<[f64; 2]>> = pairs.into_iter().map(between).collect();
        let known = || vectors.iter().flatten();
        let count = known().count().max(1) as f64;
        let mean = known().fold([0.0; 2], |sum, [a, b]| [sum[0] + a / count, sum[1] + b / count]);
        let mut lengths: Vec<f64> = known().map(|[a, b]| a.hypot(*b)).collect();
        let mean_length = lengths.iter().sum::<f64>() / count;
        let p95 = quantile(&mut lengths, 0.95).unwrap_or(0.0);
        Self { vectors, mean, mean_length, p95 }
    }
}

/// Contour in the plane of a\* and b\*, relative to a color, of colors of equal L\* at a difference of 1 from it by a formula of
/// L\*a\*b\*, in so many directions; empty for other metrics. Accurate to 10⁻⁹ of the radius, which is found by bisection: the
/// formula grows along each ray up to 1.
pub fn unit_contour(metric: Metric, around: Lab, directions: u32) -> Vec<[f64; 2]> {
    /// No formula's unit is longer: ΔE*00 divides by at most 1 + 0.045 C* times the rotation term.
    const LONGEST: f64 = 50.0;
    let at = |radius: f64, (sin, cos): (f64, f64)| {
        let sample = Lab { a: around.a + radius * cos, b: around.b + radius * sin, ..around };
        let [around, sample] = [around, sample].map(|lab| Stimulus { xyz: Xyz::new(0.0, 0.0, 0.0), lab: Some(lab) });
        metric.between(&around, &sample).filter(|_| metric.needs_adopted_white())
    };
    let radius = |direction| {
        let (mut low, mut high) = (0.0, LONGEST);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if at(middle, direction)? < 1.0 { low = middle } else { high = middle }
        }
        Some(0.5 * (low + high))
    };
    let directions = (0..directions).map(|index| (TAU * f64::from(index) / f64::from(directions)).sin_cos());
    directions.filter_map(|(sin, cos)| radius((sin, cos)).map(|radius| [radius * cos, radius * sin])).collect()
}

/// Deviations of a sensor's Planckian locus from the reference's, at each of its temperatures.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LocusDeviationsQuery {
    /// The sensor's locus.
    pub locus: LocusQuery,
    /// The reference, under the same light and color transform.
    pub reference: RenderingQuery,
}

impl Query for LocusDeviationsQuery {
    type Answer = Result<Vec<(Kelvin, Option<LocusDeviation>)>, RenderingError>;
    const NAME: &'static str = "locus deviations";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let (locus, reference) = (ask.ask(&self.locus), ask.ask(&ReferenceLocusQuery(self.reference.clone())));
        let locus = (*locus).as_ref().map_err(|&e| e)?;
        let reference = (*reference).as_ref().map_err(|&e| e)?;
        let at = |point: &LocusPoint| {
            (point.temperature, point.uv.and_then(|uv| reference.deviation(point.temperature, uv)))
        };
        Ok(locus.points.par_iter().map(at).collect())
    }
}
