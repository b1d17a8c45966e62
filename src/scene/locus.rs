//! Queries on loci relative to the reference's: nearest points, white balance, extrapolation.

use chromascope_core::query::{LocusPoint, Temperatures};
use chromascope_core::units::Kelvin;

use super::Scene;
use crate::document::{Diagram, SetKind, TransformChoice};

/// The smallest distance between a locus and the reference's at equal temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    pub kelvin: f64,
    pub distance: f64,
    /// True if it lies at an end of the temperatures, where it is no minimum of the curve.
    pub at_end: bool,
}

/// Temperatures between two neighbors of the locus at which the minimum is looked for.
const FINE: usize = 41;

/// Abscissa of the lowest point of the parabola through three evenly spaced points; none where it has none between the outer two.
/// Squared distances are nearly a parabola even where a distance falls to almost zero.
fn vertex([[x0, y0], [x1, y1], [x2, y2]]: [[f64; 2]; 3]) -> Option<f64> {
    let (bend, slope) = (y0 - 2.0 * y1 + y2, (y2 - y0) / 2.0);
    let steps = -slope / bend;
    (bend > 0.0 && steps.abs() <= 1.0).then(|| x1 + steps * (x2 - x0) / 2.0)
}

impl Scene<'_> {
    /// The smallest distance of a sensor's locus from the reference's in a diagram, its temperature within 1 K near 6000 K.
    pub fn nearest_to_reference(&self, kind: SetKind, name: &str, diagram: Diagram) -> Option<Nearest> {
        let coarse = self.locus_distances(kind, name, Self::locus_temperatures().ok()?, diagram)?;
        let at = smallest(&coarse)?;
        let (first, last) = (at.saturating_sub(1), (at + 1).min(coarse.len() - 1));
        let fine = Temperatures::Range { from: coarse[first].0, to: coarse[last].0, count: FINE };
        let fine = self.locus_distances(kind, name, fine, diagram)?;
        let at = smallest(&fine)?;
        let (kelvin, distance) = fine[at];
        let at_end = [coarse[0].0, coarse[coarse.len() - 1].0].contains(&kelvin);
        let neighbors = at.checked_sub(1).map(|before| [before, at, at + 1]).filter(|three| three[2] < fine.len());
        let mired = neighbors.and_then(|three| vertex(three.map(|i| [fine[i].0.mired(), fine[i].1.powi(2)])));
        Some(Nearest { kelvin: mired.map_or(kelvin.get(), |mired| 1e6 / mired), distance, at_end })
    }

    /// Temperatures with the distances of a sensor's locus from the reference's; NaN where there is no chromaticity.
    fn locus_distances(
        &self,
        kind: SetKind,
        name: &str,
        temperatures: Temperatures,
        diagram: Diagram,
    ) -> Option<Vec<(Kelvin, f64)>> {
        let reference = self.locus_at(SetKind::Observer, &self.document.reference, temperatures.clone()).ok()?;
        let own = self.locus_at(kind, name, temperatures).ok()?;
        let pairs = own.points.iter().zip(&reference.points);
        Some(pairs.map(|(a, b)| (a.temperature, distance(a, b, diagram).unwrap_or(f64::NAN))).collect())
    }

    /// The light along which balanced signals are 1 : 1 : 1, so that all loci meet the reference's near its temperature.
    ///
    /// Eq 15 balances loci to equal energy, a fitted transform to the light on the scene. The white-balance target moves neither.
    pub fn locus_balance(&self) -> String {
        match self.document.transform {
            TransformChoice::Paper => "equal energy".to_owned(),
            TransformChoice::Observer(_) => self.light_name(),
        }
    }

    /// Temperature in kelvins below which a sensor's locus is extrapolated, with the wavelength in nanometers where its table ends.
    pub fn extrapolated_below(&self, kind: SetKind, name: &str) -> Option<(f64, f64)> {
        let sensor = self.sensor(kind, name).ok()?;
        Some((sensor.extrapolated_below_k()?, sensor.support_nm()[1]))
    }
}

pub fn distance(a: &LocusPoint, b: &LocusPoint, diagram: Diagram) -> Option<f64> {
    match diagram {
        Diagram::Xy => a.xy.zip(b.xy).map(|(a, b)| a.distance(b)),
        Diagram::UvPrime => a.uv.zip(b.uv).map(|(a, b)| a.distance(b)),
    }
}

fn smallest(distances: &[(Kelvin, f64)]) -> Option<usize> {
    let known = distances.iter().enumerate().filter(|(_, (_, distance))| distance.is_finite());
    known.min_by(|a, b| a.1.1.total_cmp(&b.1.1)).map(|(index, _)| index)
}

/// A line split where a condition on the temperature changes: full length each, NaN where the other one is drawn; the point at the
/// change belongs to both.
pub fn split(points: &[[f64; 2]], kelvin: impl Fn(usize) -> f64, below: Option<f64>) -> [Vec<[f64; 2]>; 2] {
    const GAP: [f64; 2] = [f64::NAN; 2];
    let Some(below) = below else { return [points.to_vec(), Vec::new()] };
    let beyond = |index: usize| kelvin(index) < below;
    // A segment is extrapolated where one of its ends is.
    let dotted = |index: usize| {
        beyond(index) || (index > 0 && beyond(index - 1)) || (index + 1 < points.len() && beyond(index + 1))
    };
    let take = |keep: &dyn Fn(usize) -> bool| {
        points.iter().enumerate().map(|(index, point)| if keep(index) { *point } else { GAP }).collect()
    };
    [take(&|index| !beyond(index)), take(&dotted)]
}
