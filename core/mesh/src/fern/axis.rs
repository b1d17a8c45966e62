//! The lines along which parts grow, with a frame at each point.

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
