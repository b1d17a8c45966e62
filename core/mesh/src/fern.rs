//! A fern from parameters.
//!
//! A crown of arching fronds, each a stalk with pinnae on both sides, each pinna a midrib with leaflets on both sides,
//! and young fronds that are still rolled up in the middle. Each part is a closed surface of its own, its base inside the
//! part that bears it.

mod axis;
mod frond;
mod surface;

use super::mesh::Mesh;
use axis::{Chance, Frame};
use frond::{Detail, Frond, Organ};
use glam::Vec3;
use rayon::prelude::*;
use std::f32::consts::TAU;
use surface::Surface;

/// Appearance of a fern.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fern {
    /// Number of grown fronds, 1 ..= 24.
    pub fronds: u32,
    /// Number of young fronds still rolled up, 0 ..= 6.
    pub fiddleheads: u32,
    /// The length of the longest fronds along the stalk, in millimeters, 10 ..= 5000.
    pub frond_mm: u32,
    /// Seed of all natural variation.
    pub seed: u32,
}

impl Default for Fern {
    fn default() -> Self {
        Self { fronds: 12, fiddleheads: 2, frond_mm: 650, seed: 7 }
    }
}

/// The default fern with about this many triangles: see [`Fern::mesh`].
pub fn fern(triangles: usize) -> Mesh {
    Fern::default().mesh(triangles)
}

impl Fern {
    /// The fern as closed parts with about `triangles` triangles (2 000 ..= 2 000 000, within a quarter).
    pub fn mesh(&self, triangles: usize) -> Mesh {
        let this = Self { fronds: self.fronds.clamp(1, 24), fiddleheads: self.fiddleheads.min(6), ..*self };
        let this = Self { frond_mm: this.frond_mm.clamp(10, 5000), ..this };
        let triangles = triangles.clamp(2_000, 2_000_000);
        let detail = detail(triangles / (this.fronds as usize));
        let mut parts: Vec<Vec<Organ>> = this.plan().par_iter().map(|frond| frond.grow(&detail)).collect();
        parts.push(vec![frond::stock(this.frond_mm as f32 / 1000.0, &detail)]);
        let fineness = fineness(&parts, triangles);
        let surfaces: Vec<Surface> = parts
            .par_iter()
            .map(|organs| {
                let mut surface = Surface::default();
                for organ in organs {
                    organ.build(fineness, &mut surface);
                }
                surface
            })
            .collect();
        let mut all = Surface::default();
        for surface in &surfaces {
            all.append(surface);
        }
        all.centered()
    }

    /// The fronds, the young ones last.
    fn plan(&self) -> Vec<Frond> {
        let chance = Chance::new(self.seed);
        let grown = (0..self.fronds).map(|k| self.grown(k, chance.child(k)));
        let young = (0..self.fiddleheads).map(|k| self.young(k, chance.child(1000 + k)));
        grown.chain(young).collect()
    }

    /// A grown frond: old ones stand lower than young ones, and take turns with them around the crown.
    fn grown(&self, k: u32, chance: Chance) -> Frond {
        let azimuth = TAU * (k as f32 + 0.30 * chance.spread(0)) / self.fronds as f32;
        let youth = [0.0, 0.62, 0.33][(k % 3) as usize] + 0.36 * chance.unit(1);
        let length = self.frond_mm as f32 / 1000.0 * (0.87 + 0.10 * youth + 0.05 * chance.spread(2));
        let rise = (55.0 + 31.0 * youth + 4.0 * chance.spread(3)).to_radians();
        Frond {
            base: rooted(azimuth, rise, length * (0.035 - 0.015 * youth)),
            length,
            arch: (108.0 + 10.0 * youth + 12.0 * chance.spread(4)).to_radians(),
            bend: 0.35 * chance.spread(5),
            twist: 0.75 * chance.spread(6),
            coil: None,
            chance: chance.child(7),
        }
    }

    fn young(&self, k: u32, chance: Chance) -> Frond {
        let azimuth = TAU * (k as f32 / self.fiddleheads.max(1) as f32 + 0.13 + 0.1 * chance.spread(0));
        let length = self.frond_mm as f32 / 1000.0 * (0.58 + 0.16 * chance.unit(1));
        Frond {
            base: rooted(azimuth, 1.45, length * 0.03),
            length,
            arch: 0.35,
            bend: 0.3 * chance.spread(2),
            twist: 0.5 * chance.spread(3),
            coil: Some(15.0 + 1.5 * chance.spread(4)),
            chance: chance.child(5),
        }
    }
}

/// The frame of a frond that leaves the crown in this direction, its upper surface towards the middle.
fn rooted(azimuth: f32, rise: f32, radius: f32) -> Frame {
    let (sin, cos) = azimuth.sin_cos();
    let out = Vec3::new(cos, 0.0, sin);
    let forward = rise.cos() * out + rise.sin() * Vec3::Y;
    Frame::new(radius * out, forward, Vec3::Y - out)
}

/// Into what a frond of about this many triangles is divided.
fn detail(triangles: usize) -> Detail {
    let level = (triangles as f32 / 1000.0).max(0.1).log2();
    let between = |low: f32, high: f32, [a, b]: [f32; 2]| {
        let t = ((level - low) / (high - low)).clamp(0.0, 1.0);
        (a + (b - a) * t).round() as usize
    };
    if level < 2.8 {
        return Detail {
            pairs: between(-2.4, 0.0, [8.0, 22.0]),
            base: if level < 0.5 { 0.0 } else { 0.6 },
            pinnules: 0,
            scales: between(0.0, 2.0, [0.0, 10.0]),
            stalk: (between(-2.0, 1.0, [3.0, 5.0]), between(-2.4, 1.0, [4.0, 12.0])),
            rib: (3, 1),
        };
    }
    Detail {
        pairs: between(2.8, 5.0, [19.0, 23.0]),
        base: 0.6,
        pinnules: between(2.8, 5.2, [8.0, 14.0]),
        scales: between(2.0, 4.0, [10.0, 24.0]),
        stalk: (between(1.0, 7.0, [5.0, 12.0]), between(1.0, 7.0, [12.0, 60.0])),
        rib: (between(3.0, 7.0, [3.0, 8.0]), between(1.2, 7.0, [2.0, 16.0])),
    }
}

/// The fineness of leaves at which all parts have as nearly as can be this many triangles.
fn fineness(parts: &[Vec<Organ>], triangles: usize) -> f32 {
    let (mut low, mut high) = (1.0, 256.0);
    for _ in 0..18 {
        let middle: f32 = f32::midpoint(low, high);
        let count: usize =
            parts.par_iter().map(|organs| organs.iter().map(|o| o.triangles(middle)).sum::<usize>()).sum();
        if count < triangles {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}
