//! The lines along which parts grow, with a frame at each point, and natural variation without chance: numbers that only depend
//! on a seed and on what they are for.

use glam::{Quat, Vec3};

/// A place with three unit axes: `side = forward × up`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) origin: Vec3,
    pub(super) forward: Vec3,
    pub(super) side: Vec3,
    pub(super) up: Vec3,
}

impl Frame {
    /// The frame with this forward axis whose up axis is as near as can be to `up`.
    pub(super) fn new(origin: Vec3, forward: Vec3, up: Vec3) -> Self {
        let forward = forward.normalize_or(Vec3::X);
        let side = forward.cross(up).normalize_or(forward.any_orthonormal_vector());
        Self { origin, forward, side, up: side.cross(forward) }
    }

    /// Turned in radians: pitch raises the nose, yaw moves it to the side axis, roll lowers the side axis.
    pub(super) fn turned(self, pitch: f32, yaw: f32, roll: f32) -> Self {
        let turn = Quat::from_axis_angle(self.side, pitch)
            * Quat::from_axis_angle(self.up, -yaw)
            * Quat::from_axis_angle(self.forward, roll);
        Self::new(self.origin, turn * self.forward, turn * self.up)
    }

    pub(super) fn at(self, origin: Vec3) -> Self {
        Self { origin, ..self }
    }
}

/// A short parabola, for leaflets and the midribs of pinnae.
///
/// ```text
/// p(u) = origin + length (u forward + sweep u² side − droop u² up),  u = 0 ..= 1
/// ```
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    pub(super) base: Frame,
    pub(super) length: f32,
    pub(super) sweep: f32,
    pub(super) droop: f32,
    /// Angle by which the up axis has turned about the line at the tip, in radians.
    pub(super) twist: f32,
}

impl Arc {
    pub(super) fn frame(&self, u: f32) -> Frame {
        let Frame { origin, forward, side, up } = self.base;
        let bend = self.sweep * side - self.droop * up;
        let (sin, cos) = (self.twist * u).sin_cos();
        Frame::new(origin + self.length * u * (forward + u * bend), forward + 2.0 * u * bend, cos * up + sin * side)
    }
}

/// A long line that may coil, for stalks: frames at equal steps.
#[derive(Clone, Debug)]
pub(super) struct Spine {
    frames: Vec<Frame>,
}

impl Spine {
    /// Follows a line of a length from a frame; `turn` gives pitch, yaw and roll a unit share of the length, in radians.
    pub(super) fn grow(base: Frame, length: f32, steps: usize, turn: impl Fn(f32) -> [f32; 3]) -> Self {
        let step = 1.0 / steps.max(1) as f32;
        let mut frames = vec![base];
        let mut frame = base;
        for i in 0..steps.max(1) {
            let [pitch, yaw, roll] = turn((i as f32 + 0.5) * step).map(|rate| rate * step);
            let half = frame.turned(pitch / 2.0, yaw / 2.0, roll / 2.0);
            frame = frame.turned(pitch, yaw, roll).at(frame.origin + half.forward * (length * step));
            frames.push(frame);
        }
        Self { frames }
    }

    /// The frame at a share of the length.
    pub(super) fn frame(&self, s: f32) -> Frame {
        let last = self.frames.len() - 1;
        let place = s.clamp(0.0, 1.0) * last as f32;
        let i = (place as usize).min(last.saturating_sub(1));
        let (a, b) = (self.frames[i], self.frames[(i + 1).min(last)]);
        let t = place - i as f32;
        Frame::new(a.origin.lerp(b.origin, t), a.forward.lerp(b.forward, t), a.up.lerp(b.up, t))
    }
}

/// A source of numbers; each part of a plant takes its own by [`Chance::child`], so that no part's looks depend on how
/// many others there are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chance(u32);

impl Chance {
    pub(super) fn new(seed: u32) -> Self {
        Self(stir(seed ^ 0x3c6e_f35f))
    }

    pub(super) fn child(self, index: u32) -> Self {
        Self(stir(self.0.rotate_left(9) ^ index.wrapping_add(1).wrapping_mul(0x9e37_79b1)))
    }

    /// A number of [0, 1), the same for the same `which`.
    pub(super) fn unit(self, which: u32) -> f32 {
        (self.child(which).0 >> 8) as f32 / 16_777_216.0
    }

    pub(super) fn spread(self, which: u32) -> f32 {
        2.0 * self.unit(which) - 1.0
    }
}

/// Every bit of the result depends on every bit of the input: three rounds of shift and odd product.
fn stir(mut bits: u32) -> u32 {
    for odd in [0x85a3_08d3, 0x1319_8a2f, 0x0370_7345] {
        bits = (bits ^ (bits >> 15)).wrapping_mul(odd);
    }
    bits ^ (bits >> 16)
}
