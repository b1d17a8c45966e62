//! Temperature error of a sensor along the reference's own Planckian locus.

use chromascope_core::query::{LocusPoint, Temperatures};
use chromascope_core::units::Kelvin;

use crate::document::SetKind;
use crate::scene::{Scene, SceneError};

/// Temperatures of the reference's locus, in kelvins: well beyond the range of tables.
const RANGE_K: [f64; 2] = [500.0, 100_000.0];
/// Points of the reference's locus, evenly in 1/T: 0.12 mired apart, so that a foot on a chord is within 0.02 K up to 20000 K.
const POINTS: usize = 16_384;
/// Every 64th point is tested first, then all around the nearest of them.
const STRIDE: usize = 64;
/// Farther from the locus, in the CIE 1960 diagram, a correlated color temperature says nothing (CIE 15).
const FARTHEST: f64 = 0.05;

/// The Planckian locus of the reference under the scene's color transform, in the CIE 1960 diagram.
pub(super) struct ReferenceLocus {
    /// Reciprocal temperature in mired, u, v.
    points: Vec<[f64; 3]>,
}

impl ReferenceLocus {
    /// Computes the locus.
    pub(super) fn new(scene: &Scene<'_>) -> Result<Self, SceneError> {
        let [from, to] = RANGE_K.map(Kelvin::new);
        let temperatures = Temperatures::Range { from: from?, to: to?, count: POINTS };
        let locus = scene.locus_at(SetKind::Observer, &scene.document.reference, temperatures)?;
        let place = |point: &LocusPoint| {
            let uv = point.uv?.uv60();
            Some([point.temperature.mired(), uv.u, uv.v])
        };
        Ok(Self { points: locus.points.iter().filter_map(place).collect() })
    }

    /// Correlated color temperature of a blackbody through a sensor, read on the reference's locus, minus its true temperature, in
    /// kelvins: 0 for the reference under any color transform. None beyond the ends of the locus and farther than 0.05 from it.
    pub(super) fn error_k(&self, point: &LocusPoint) -> Option<f64> {
        let uv = point.uv?.uv60();
        let from = |p: &[f64; 3]| (uv.u - p[1]).hypot(uv.v - p[2]);
        let coarse = (0..self.points.len()).step_by(STRIDE);
        let near = coarse.min_by(|&a, &b| from(&self.points[a]).total_cmp(&from(&self.points[b])))?;
        let around = near.saturating_sub(STRIDE)..(near + STRIDE + 1).min(self.points.len());
        let mut best: Option<(f64, f64)> = None;
        for pair in self.points[around].windows(2) {
            let [[m0, u0, v0], [m1, u1, v1]] = [pair[0], pair[1]];
            let (du, dv) = (u1 - u0, v1 - v0);
            let along = ((uv.u - u0) * du + (uv.v - v0) * dv) / (du * du + dv * dv);
            let along = along.clamp(0.0, 1.0);
            let distance = (uv.u - u0 - along * du).hypot(uv.v - v0 - along * dv);
            if best.is_none_or(|(least, _)| distance < least) {
                best = Some((distance, m0 + along * (m1 - m0)));
            }
        }
        let (distance, mired) = best?;
        let ends = [self.points.first()?[0], self.points.last()?[0]];
        let inside = distance <= FARTHEST && !ends.contains(&mired);
        inside.then(|| 1e6 / mired - point.temperature.get())
    }
}
