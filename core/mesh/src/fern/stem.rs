//! Stalks and ribs: round tubes that taper to a point.

use super::axis::{Arc, Frame, Spine};
use super::surface::Surface;
use std::f32::consts::TAU;

#[derive(Clone, Debug)]
pub(super) enum Line {
    Rib(Arc),
    Stalk(Spine),
}

impl Line {
    fn frame(&self, s: f32) -> Frame {
        match self {
            Self::Rib(arc) => arc.frame(s),
            Self::Stalk(spine) => spine.frame(s),
        }
    }
}

/// A tube along a line, its radius falling from base to tip.
#[derive(Clone, Debug)]
pub(super) struct Stem {
    pub(super) line: Line,
    pub(super) radius: f32,
    /// The radius before the tip as a share of the base's.
    pub(super) taper: f32,
    pub(super) sides: usize,
    pub(super) pieces: usize,
}

impl Stem {
    /// Number of triangles [`Stem::build`] makes: the mantle, the point, the base.
    pub(super) fn triangles(&self) -> usize {
        self.sides * (2 * self.pieces - 1) + self.sides - 2
    }

    /// Adds the tube, closed at both ends.
    pub(super) fn build(&self, surface: &mut Surface) {
        let (first, start, sides) = (surface.triangles.len(), surface.next(), self.sides as u32);
        for i in 0..self.pieces {
            let s = i as f32 / self.pieces as f32;
            let frame = self.line.frame(s);
            let radius = self.radius * (1.0 + (self.taper - 1.0) * s);
            for k in 0..sides {
                let (sin, cos) = (k as f32 / sides as f32 * TAU).sin_cos();
                surface.vertex(frame.origin + radius * (sin * frame.side + cos * frame.up));
            }
        }
        surface.vertex(self.line.frame(1.0).origin);
        let tip = surface.next() - 1;
        for i in 0..self.pieces as u32 {
            let (row, next) = (start + i * sides, start + (i + 1) * sides);
            for k in 0..sides {
                let l = (k + 1) % sides;
                if next == tip {
                    surface.triangle([row + k, row + l, tip], false);
                } else {
                    surface.triangle([row + k, row + l, next + l], false);
                    surface.triangle([row + k, next + l, next + k], false);
                }
            }
        }
        surface.shade(first);
        self.close_base(start, surface);
    }

    /// The base has vertices of its own: its normals would spoil the mantle's.
    fn close_base(&self, ring: u32, surface: &mut Surface) {
        let (first, start, sides) = (surface.triangles.len(), surface.next(), self.sides as u32);
        for k in 0..sides {
            surface.vertex(surface.positions[(ring + k) as usize]);
        }
        for k in 1..sides - 1 {
            surface.triangle([start, start + k, start + k + 1], true);
        }
        surface.shade(first);
    }
}
