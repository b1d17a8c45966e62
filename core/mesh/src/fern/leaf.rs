//! A leaflet: an upper and a lower surface that meet all around the edge.

use super::axis::{Arc, Frame};
use super::surface::Surface;
use glam::Vec3;

/// A leaflet along a line, folded at its midrib.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    pub(super) axis: Arc,
    /// Half the largest width, in meters.
    pub(super) half_width: f32,
    /// The width at the base as a share of the largest; 0: a point.
    pub(super) base: f32,
    /// Exponent of the outline's rounding: 1.4 a lance, 4 a tongue.
    pub(super) bluntness: f32,
    /// Concentration of cuts toward the tip, −1 .. 1.
    pub(super) crowding: f32,
    /// The slope with which each half rises from the midrib.
    pub(super) crease: f32,
    /// Strength by which each half bends down again toward the edge.
    pub(super) curl: f32,
    /// Depth of the edge's teeth, as a share of the width.
    pub(super) teeth: f32,
    /// Thickness over the midrib, in meters.
    pub(super) thickness: f32,
}

/// Into how many pieces a leaflet is cut along, and across each half.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cuts {
    pub(super) along: usize,
    pub(super) across: usize,
}

/// A cut across a leaflet: the share of the length, half the width, the midrib's frame.
struct Station {
    u: f32,
    reach: f32,
    frame: Frame,
}

impl Leaf {
    pub(super) fn triangles(&self, cuts: Cuts) -> usize {
        4 * cuts.across * (2 * cuts.along - 1 - usize::from(self.base == 0.0))
    }

    /// Half the width at station `i` of `cuts.along`, a share `u` of the length.
    fn reach(&self, cuts: Cuts, i: usize, u: f32) -> f32 {
        let opening = self.base + (1.0 - self.base) * (u * (2.0 - u)).max(0.0).powf(0.6);
        let closing = (1.0 - u.powf(self.bluntness)).max(0.0).powf(0.55);
        // Teeth stand on whole stations, else they would beat with them; too few stations show none.
        let period = (cuts.along / 12).max(2);
        let notch = if cuts.along < 8 { 0.0 } else { 1.0 - (i % period) as f32 / (period - 1) as f32 };
        self.half_width * opening * closing * (1.0 - self.teeth * notch)
    }

    /// The point `v` of the width away from the midrib, to the side of the sign `hand`, on the upper or lower surface by
    /// the sign `sheet`.
    fn point(&self, &Station { u, reach, frame }: &Station, v: f32, [hand, sheet]: [f32; 2]) -> Vec3 {
        let rise = reach * v * (self.crease - self.curl * v);
        // Exactly zero all around the edge: there both surfaces have the same points.
        let thick = sheet * self.thickness / 2.0 * (1.0 - v * v) * (6.0 * u * (1.0 - u)).min(1.0);
        frame.origin + frame.side * (hand * v * reach) + frame.up * (rise + thick)
    }

    /// Adds both surfaces; each half has its own normals, which shows the fold of the midrib.
    pub(super) fn build(&self, cuts: Cuts, surface: &mut Surface) {
        let station = |i: usize| {
            let x = i as f32 / cuts.along as f32;
            let u = x * (1.0 + self.crowding * (1.0 - x));
            Station { u, reach: self.reach(cuts, i, u), frame: self.axis.frame(u) }
        };
        let stations: Vec<Station> = (0..=cuts.along).map(station).collect();
        for sheet in [1.0, -1.0] {
            for hand in [1.0, -1.0] {
                self.patch(cuts.across, &stations, [hand, sheet], surface);
            }
        }
    }

    fn patch(&self, across: usize, stations: &[Station], [hand, sheet]: [f32; 2], surface: &mut Surface) {
        let first = surface.triangles.len();
        let flipped = hand * sheet < 0.0;
        let mut previous: Option<(u32, bool)> = None;
        for (i, station) in stations.iter().enumerate() {
            let single = i + 1 == stations.len() || (i == 0 && self.base == 0.0);
            let start = surface.next();
            for j in 0..=(if single { 0 } else { across }) {
                surface.vertex(self.point(station, j as f32 / across as f32, [hand, sheet]));
            }
            if let Some((below, was_single)) = previous {
                for j in 0..across as u32 {
                    let (a, b) = (below + j, below + j + 1);
                    let (d, c) = (start + j, start + j + 1);
                    match (was_single, single) {
                        (true, true) => {}
                        (true, false) => surface.triangle([below, c, d], flipped),
                        (false, true) => surface.triangle([a, b, start], flipped),
                        (false, false) => {
                            surface.triangle([a, b, c], flipped);
                            surface.triangle([a, c, d], flipped);
                        }
                    }
                }
            }
            previous = Some((start, single));
        }
        surface.shade(first);
    }
}
