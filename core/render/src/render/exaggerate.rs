//! Pictures whose differences from the reference's are multiplied, so that they can be seen.

use super::develop::{ColorimetricScale, Development, Picture, develop_signals};
use super::geometry::LitSamples;
use super::stop::Stop;
use chromascope_color::colorimetry::lab::xyz_from_lab;
use glam::{DMat3, Vec3};
use rayon::prelude::*;

/// Distance in pixels of the diagonal lines over colors that a screen cannot show, and their width.
const HATCH: [usize; 2] = [6, 2];
/// A channel may lie this far outside 0 to 1 before that can be seen, as in the development.
const SLACK: f32 = 2e-3;

/// How a picture's differences are multiplied.
#[derive(Clone, Debug)]
pub struct Exaggeration<'a> {
    /// Scales of the sensor's and of the reference's colors, relative to the same white.
    pub scales: [&'a ColorimetricScale; 2],
    /// Linear sRGB from XYZ.
    pub srgb_from_xyz: DMat3,
    /// Linear value of that white on the screen: factor of the exposure times the white's Y.
    pub brightness: f64,
    /// k of `L*a*b* = reference + k (sensor − reference)`; L* is not below 0.
    pub factor: f64,
    /// Background in linear sRGB; none leaves it transparent.
    pub background: Option<[f32; 3]>,
}

/// Develops signals of a sensor with their differences from the reference's multiplied in L\*a\*b\*, sample by sample. Colors
/// outside sRGB are clipped in linear sRGB and hatched. None if stopped.
pub fn develop_exaggerated(
    placed: &LitSamples,
    [signals, reference]: [&[[f32; 3]]; 2],
    how: &Exaggeration<'_>,
    stop: &Stop,
) -> Option<Picture> {
    let size = placed.size();
    let samples = (size.samples as usize).max(1);
    let [own, of_reference] = how.scales;
    let color = |index: usize| {
        if index.is_multiple_of(1024) && stop.is_set() {
            return [0.0; 3];
        }
        let (sample, reference) = (own.color(signals[index]), of_reference.color(reference[index]));
        let xyz = match sample.lab.zip(reference.lab) {
            Some((sample, reference)) => xyz_from_lab(sample.exaggerated(reference, how.factor), own.lab_white),
            None => sample.xyz,
        };
        let linear = (how.srgb_from_xyz * xyz.to_vector() * how.brightness).as_vec3();
        let is_clipped = linear.min_element() < -SLACK || linear.max_element() > 1.0 + SLACK;
        let shown = linear.clamp(Vec3::ZERO, Vec3::ONE);
        let at = placed.samples()[index] as usize;
        let diagonal = at / size.columns() / samples + at % size.columns() / samples;
        if is_clipped && diagonal % HATCH[0] < HATCH[1] {
            // Dark lines on what is bright, bright ones on what is dark.
            return if shown.dot(Vec3::new(0.21, 0.72, 0.07)) > 0.2 { [0.0; 3] } else { [1.0; 3] };
        }
        shown.to_array()
    };
    let count = signals.len().min(reference.len());
    let linear: Vec<[f32; 3]> = (0..count).into_par_iter().with_min_len(512).map(color).collect();
    let identity =
        Development { linear_from_signals: DMat3::IDENTITY, root_polynomial: None, background: how.background };
    develop_signals(placed, &linear, &identity, stop)
}
