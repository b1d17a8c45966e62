//! Growth of a frond: a stalk, pinnae on both sides of it, leaflets on both sides of each pinna.

use super::axis::{Arc, Chance, Frame, Spine};
use super::surface::{Cuts, Leaf, Line, Stem};
use glam::Vec3;
use std::f32::consts::TAU;

/// Fineness of a plant's division, whatever its size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Detail {
    /// Pairs of pinnae on a full frond.
    pub(super) pairs: usize,
    /// Pairs of leaflets on the longest pinna; none: each pinna is one leaf.
    pub(super) pinnules: usize,
    /// The width of a pinna's foot where it is one leaf, as a share of its width.
    pub(super) base: f32,
    /// Chaffy scales at the foot of each stalk.
    pub(super) scales: usize,
    /// Sides and pieces of the stalk.
    pub(super) stalk: (usize, usize),
    /// Sides and pieces of the midribs of pinnae.
    pub(super) rib: (usize, usize),
}

#[derive(Clone, Debug)]
pub(super) enum Organ {
    Leaf {
        leaf: Leaf,
        /// The size among its kind, 0 ..= 1, by which it gets more or fewer triangles.
        share: f32,
        /// Decides in [0, 1) about fractions of cuts, so that the sum is right.
        dither: f32,
    },
    Stem(Stem),
}

impl Organ {
    pub(super) fn triangles(&self, fineness: f32) -> usize {
        match self {
            Self::Leaf { leaf, share, dither } => leaf.triangles(cuts(fineness, leaf, *share, *dither)),
            Self::Stem(stem) => stem.triangles(),
        }
    }

    pub(super) fn build(&self, fineness: f32, surface: &mut super::surface::Surface) {
        match self {
            Self::Leaf { leaf, share, dither } => leaf.build(cuts(fineness, leaf, *share, *dither), surface),
            Self::Stem(stem) => stem.build(surface),
        }
    }
}

/// The cuts of a leaf: longer leaves get more.
fn cuts(fineness: f32, leaf: &Leaf, share: f32, dither: f32) -> Cuts {
    let slender = leaf.axis.length / leaf.half_width * 1.5;
    let along = ((fineness * share.sqrt() + dither) as usize).max(2);
    Cuts { along, across: ((along as f32 / slender + dither) as usize).max(1) }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Frond {
    /// Base at the ground; its up axis is where the upper surface looks.
    pub(super) base: Frame,
    /// The stalk's length from the ground to the tip, in meters.
    pub(super) length: f32,
    /// Angle by which the tip bends down from the base's direction, in radians.
    pub(super) arch: f32,
    /// Angles by which it bends aside, and turns about itself.
    pub(super) bend: f32,
    pub(super) twist: f32,
    /// Angle by which the tip is still rolled up, in radians; none: a grown frond.
    pub(super) coil: Option<f32>,
    pub(super) chance: Chance,
}

/// The share of the frond's length below the first pinna.
const STALK: f32 = 0.12;

/// The longest pinna as a share of the frond's length.
const LONGEST: f32 = 0.185;

impl Frond {
    /// All its parts.
    pub(super) fn grow(&self, detail: &Detail) -> Vec<Organ> {
        let coil = self.coil.unwrap_or(0.0);
        let spine = Spine::grow(self.base, self.length, 96, |s| {
            [coil * rolling(s) - self.arch * 2.4 * s.powf(1.4), self.bend * 2.0 * s, self.twist]
        });
        let (sides, pieces) = detail.stalk;
        let (thick, taper) = if self.coil.is_some() { (0.0085, 0.40) } else { (0.0052, 0.16) };
        // A coil needs pieces by its turns.
        let pieces = pieces + (coil * 0.16 * pieces as f32).min(60.0) as usize;
        let radius = self.length * thick;
        let mut organs = vec![Organ::Stem(Stem { line: Line::Stalk(spine.clone()), radius, taper, sides, pieces })];
        for k in 0..detail.pairs {
            for hand in [1.0, -1.0] {
                match self.coil {
                    Some(_) => organs.push(self.bud(&spine, detail, k, hand)),
                    None => self.pinna(&spine, detail, k, hand, &mut organs),
                }
            }
        }
        organs.extend((0..detail.scales as u32).map(|k| self.scale(&spine, k)));
        if self.coil.is_none() {
            organs.push(self.tip(&spine));
        }
        organs
    }

    /// A pinna of a young frond: a small leaf rolled inwards, on the coil's inner side.
    fn bud(&self, spine: &Spine, detail: &Detail, k: usize, hand: f32) -> Organ {
        let chance = self.chance.child(2 * k as u32 + u32::from(hand > 0.0));
        let y = (k as f32 + 0.5 + 0.2 * hand + 0.1 * chance.spread(0)) / detail.pairs as f32;
        let s = 0.35 + 0.64 * y;
        let at = spine.frame(s);
        let forward = 0.75 * at.forward + 0.75 * hand * at.side + 0.45 * at.up;
        let length = self.length * (0.055 - 0.035 * y) * (1.0 + 0.15 * chance.spread(1));
        let axis =
            Arc { base: Frame::new(at.origin, forward, at.up), length, sweep: -hand * 0.35, droop: -0.55, twist: 0.0 };
        let leaf = Leaf { thickness: 0.12 * length, curl: -0.3, ..blade(axis, 0.30 * length) };
        Organ::Leaf { leaf, share: 0.4, dither: chance.unit(2) }
    }

    /// The pinna of the pair `k` on one side.
    fn pinna(&self, spine: &Spine, detail: &Detail, k: usize, hand: f32, organs: &mut Vec<Organ>) {
        let pairs = detail.pairs as f32;
        let chance = self.chance.child(2 * k as u32 + u32::from(hand > 0.0));
        // Pairs are never quite opposite, and stand closer towards the tip.
        let y = (k as f32 + 0.5 + 0.17 * hand + 0.07 * chance.spread(0)) / pairs;
        let x = 1.0 - (1.0 - y).max(0.0).powf(1.3);
        let spacing = self.length * (1.0 - STALK) * 1.3 * (1.0 - y).max(0.0).powf(0.3) / pairs;
        let relative = outline(x) * (1.0 + 0.06 * chance.spread(1));
        let length = self.length * LONGEST * relative;
        let at = spine.frame(STALK + (1.0 - STALK) * x);
        let angle = (84.0 - 36.0 * x + 4.0 * chance.spread(2)).to_radians();
        let forward = angle.cos() * at.forward + hand * angle.sin() * at.side + 0.24 * at.up;
        let base = Frame::new(at.origin, forward, at.up).turned(0.0, 0.0, 0.24 * chance.spread(3) + 0.12 * hand);
        let axis = Arc {
            base,
            length,
            sweep: -hand * (0.16 + 0.06 * chance.spread(4)),
            droop: 0.34 + 0.10 * chance.spread(5),
            twist: 0.25 * chance.spread(6),
        };
        let width = (0.57 * spacing).min(0.36 * length);
        let count = (detail.pinnules as f32 * relative.powf(0.8)).round() as usize;
        if count < 3 {
            organs.push(Organ::Leaf {
                leaf: Leaf { base: detail.base, ..blade(axis, width * 0.78) },
                share: if detail.pinnules == 0 { relative.min(1.0) } else { (0.9 * relative).min(1.0) },
                dither: chance.unit(7),
            });
            return;
        }
        let (sides, pieces) = detail.rib;
        let rib = Stem { line: Line::Rib(axis), radius: self.length * 0.0014, taper: 0.3, sides, pieces };
        organs.push(Organ::Stem(rib));
        Pinna { axis, width, count, chance }.leaflets(organs);
    }

    /// One of the scales at the foot of the stalk.
    fn scale(&self, spine: &Spine, k: u32) -> Organ {
        let chance = self.chance.child(10_000 + k);
        let at = spine.frame(0.10 * chance.unit(0) * chance.unit(1));
        let (sin, cos) = (TAU * chance.unit(2)).sin_cos();
        let out = sin * at.side + cos * at.up;
        let base = Frame::new(at.origin, at.forward + (0.45 + 0.5 * chance.unit(3)) * out, out);
        let length = self.length * (0.030 + 0.025 * chance.unit(4));
        let axis = Arc { base, length, sweep: 0.4 * chance.spread(5), droop: 0.5 * chance.spread(6), twist: 0.0 };
        let leaf = Leaf { teeth: 0.0, ..blade(axis, 0.11 * length) };
        Organ::Leaf { leaf, share: 0.3, dither: chance.unit(7) }
    }

    fn tip(&self, spine: &Spine) -> Organ {
        let base = spine.frame(0.985);
        let axis = Arc { base, length: self.length * 0.03, sweep: 0.0, droop: 0.1, twist: 0.0 };
        Organ::Leaf { leaf: blade(axis, self.length * 0.005), share: 0.3, dither: self.chance.unit(99) }
    }
}

struct Pinna {
    axis: Arc,
    /// The length of the longest leaflet, in meters.
    width: f32,
    count: usize,
    chance: Chance,
}

impl Pinna {
    fn leaflets(&self, organs: &mut Vec<Organ>) {
        let count = self.count as f32;
        for k in 0..self.count {
            for hand in [1.0, -1.0] {
                let chance = self.chance.child(100 + 2 * k as u32 + u32::from(hand > 0.0));
                let y = (k as f32 + 0.5 + 0.2 * hand) / count;
                let t = 0.02 + 0.95 * (1.0 - (1.0 - y).powf(1.2));
                let spacing = self.axis.length * 0.95 * 1.2 * (1.0 - y).powf(0.2) / count;
                let size = (1.0 - 0.86 * t.powf(1.35)) * (1.0 + 0.06 * chance.spread(0));
                organs.push(self.leaflet(t, hand, self.width * size, spacing, chance));
            }
        }
        let end = Arc { base: self.axis.frame(0.96), length: self.axis.length * 0.13, ..self.axis };
        let end = Arc { sweep: 0.0, twist: 0.0, ..end };
        let leaf = blade(end, self.width * 0.13);
        organs.push(Organ::Leaf { leaf, share: 0.35, dither: self.chance.unit(9) });
    }

    /// The leaflet at a share `t` of the pinna's length.
    fn leaflet(&self, t: f32, hand: f32, length: f32, spacing: f32, chance: Chance) -> Organ {
        let at = self.axis.frame(t);
        let angle = (66.0 - 22.0 * t + 5.0 * chance.spread(1)).to_radians();
        let forward = angle.cos() * at.forward + hand * angle.sin() * at.side + 0.10 * at.up;
        let base = Frame::new(at.origin, forward, at.up).turned(0.0, 0.0, 0.15 * chance.spread(2));
        let axis = Arc {
            base,
            length,
            sweep: -hand * 0.17,
            droop: 0.16 + 0.10 * chance.spread(3),
            twist: 0.15 * chance.spread(4),
        };
        let leaf = Leaf {
            axis,
            half_width: (0.56 * spacing).min(0.5 * length),
            base: 0.92,
            bluntness: 2.6,
            crowding: 0.1,
            crease: 0.50,
            curl: 0.62,
            teeth: 0.10,
            thickness: 0.035 * length,
        };
        Organ::Leaf { leaf, share: (length / self.width).min(1.0), dither: chance.unit(5) }
    }
}

/// The stump that bears all fronds of this length.
pub(super) fn stock(length: f32, detail: &Detail) -> Organ {
    let base = Frame::new(-0.01 * length * Vec3::Y, Vec3::Y, Vec3::X);
    let line = Line::Stalk(Spine::grow(base, 0.065 * length, 8, |_| [0.0; 3]));
    let (sides, pieces) = detail.stalk;
    Organ::Stem(Stem { line, radius: 0.030 * length, taper: 0.75, sides: 2 * sides, pieces: pieces / 3 + 1 })
}

/// A leaf that is a whole pinna.
fn blade(axis: Arc, half_width: f32) -> Leaf {
    Leaf {
        axis,
        half_width,
        base: 0.0,
        bluntness: 1.5,
        crowding: -0.5,
        crease: 0.35,
        curl: 0.30,
        teeth: 0.45,
        thickness: 0.05 * half_width,
    }
}

/// The length of pinnae along the frond, as a share of the longest, which stands at a third.
fn outline(x: f32) -> f32 {
    if x < 1.0 / 3.0 {
        let rise = (3.0 * x).clamp(0.0, 1.0);
        return 0.48 + 0.52 * rise * (2.0 - rise);
    }
    let t = ((x - 1.0 / 3.0) * 1.5).min(1.0);
    0.05 + 0.95 * (1.0 - t) * (1.0 + 0.75 * t)
}

/// The share of its coil that a young frond turns per unit of its length: from 0.68 on, ever tighter towards the tip.
fn rolling(s: f32) -> f32 {
    let (start, end) = (0.68, 1.03);
    // ∫ ds / (end − s) from start to 1 is the logarithm, so that the whole is 1.
    let whole = ((end - start) / (end - 1.0_f32)).ln();
    if s < start { 0.0 } else { 1.0 / (whole * (end - s)) }
}
