//! The nearest point of the whole locus, found without haste: for refusals, and for the table that fast searches start from.

use super::exact::ExactLocus;
use super::pieces::{FIRST_MIRED, LAST_MIRED, Pieces, UNIT};
use crate::colorimetry::Uv60;

/// Reciprocal temperatures beyond the pieces, at which the locus is stored, on the hot and the cold side, in mired.
const HOTTER: [f64; 5] = [0.0, 5.0, 10.0, 15.0, 20.0];
const COLDER: [f64; 18] = [
    1044.0, 1080.0, 1150.0, 1250.0, 1400.0, 1600.0, 1800.0, 2000.0, 2300.0, 2700.0, 3200.0, 4000.0, 5000.0, 7000.0,
    1e4, 2e4, 1e5, 1e6,
];
/// Steps of a search that has its answer between two bounds; halving them alone would take about fifty.
const STEPS: usize = 60;

/// The point of the locus that is nearest to a color.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Nearest {
    /// Its reciprocal temperature in mired; beyond the pieces only the side is determined.
    pub(super) mired: f64,
    pub(super) distance: f64,
}

/// Vertices of the locus from infinitely hot to 1 K.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Vertices(Vec<(f64, Uv60)>);

impl Vertices {
    pub(super) fn new(locus: &ExactLocus, pieces: &Pieces) -> Option<Self> {
        let exact = |&mired: &f64| Some((mired, locus.motion(mired)?.at));
        let hotter: Option<Vec<_>> = HOTTER.iter().map(exact).collect();
        let colder: Option<Vec<_>> = COLDER.iter().map(exact).collect();
        let mut vertices = hotter?;
        vertices.extend(pieces.iter().map(|piece| (piece.mired, piece.motion(0.0).at)));
        vertices.extend(colder?);
        Some(Self(vertices))
    }

    /// The nearest point. The color has finite coordinates, none beyond 1e100.
    pub(super) fn nearest(&self, pieces: &Pieces, color: Uv60) -> Nearest {
        let squared = |at: Uv60| (at.u - color.u) * (at.u - color.u) + (at.v - color.v) * (at.v - color.v);
        let (mut best, mut least) = (0, f64::INFINITY);
        for (index, &(_, at)) in self.0.iter().enumerate() {
            let distance = squared(at);
            if distance < least {
                (best, least) = (index, distance);
            }
        }
        let last = self.0.len() - 1;
        let (below, above) = (best.saturating_sub(1), (best + 1).min(last));
        let low = self.0[below].0.max(FIRST_MIRED);
        let high = self.0[above].0.min(LAST_MIRED);
        if low < high
            && let Some(mired) = root(pieces, color, low, high)
        {
            let piece = pieces.at(mired);
            let at = piece.motion(piece.t(mired)).at;
            return Nearest { mired, distance: squared(at).sqrt() };
        }
        let ends = [(below, best), (best, above)];
        let on_edges = ends.map(|(a, b)| on_edge(self.0[a], self.0[b], color));
        if on_edges[0].distance < on_edges[1].distance { on_edges[0] } else { on_edges[1] }
    }
}

/// Reciprocal temperature of least distance between two others, if the minimum lies inside.
pub(super) fn root(pieces: &Pieces, color: Uv60, mut low: f64, mut high: f64) -> Option<f64> {
    let at = |mired: f64| {
        let piece = pieces.at(mired);
        let (value, slope) = piece.seen(color).at(piece.t(mired));
        (value, mired - value / slope * UNIT)
    };
    if !(at(low).0 <= 0.0 && at(high).0 >= 0.0) {
        return None;
    }
    let mut mired = 0.5 * (low + high);
    for _ in 0..STEPS {
        let (value, newton) = at(mired);
        *(if value < 0.0 { &mut low } else { &mut high }) = mired;
        let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
        let step = (next - mired).abs();
        mired = next;
        if step <= 1e-13 * mired {
            break;
        }
    }
    Some(mired)
}

/// The nearest point of the straight line between two vertices.
fn on_edge(a: (f64, Uv60), b: (f64, Uv60), color: Uv60) -> Nearest {
    let (edge, from) = ([b.1.u - a.1.u, b.1.v - a.1.v], [color.u - a.1.u, color.v - a.1.v]);
    let squared = edge[0] * edge[0] + edge[1] * edge[1];
    let along = edge[0] * from[0] + edge[1] * from[1];
    let share = if squared > 0.0 { (along / squared).clamp(0.0, 1.0) } else { 0.0 };
    let distance = (from[0] - share * edge[0]).hypot(from[1] - share * edge[1]);
    Nearest { mired: a.0 + share * (b.0 - a.0), distance }
}
