//! From a camera's signals to pixels: white balance, matrix, exposure, and the screen's encoding.

use super::geometry::LitSamples;
use super::signals::CameraImage;
use super::stop::Stop;
use super::visibility::RasterSize;
use chromascope_color::camera::Rendering;
use chromascope_color::colorimetry::rgb::srgb_transfer;
use chromascope_color::colorimetry::{Metric, Stimulus, Xyz};
use chromascope_color::correction::root_polynomial::RootPolynomial;
use chromascope_math::array::array;
use glam::{DMat3, DVec3, Mat3, Vec3};
use multiversion::multiversion;
use rayon::prelude::*;
use std::sync::{Arc, LazyLock};

/// Development from signals to light on a screen.
#[derive(Clone, Debug, PartialEq)]
pub struct Development {
    /// Linear sRGB from signals: matrix × balance × exposure; with a root polynomial, from its XYZ.
    pub linear_from_signals: DMat3,
    /// Root polynomial that takes signals to XYZ first.
    pub root_polynomial: Option<Arc<RootPolynomial>>,
    /// Background in linear sRGB; none leaves it transparent.
    pub background: Option<[f32; 3]>,
}

impl Development {
    /// Balances by the rendering's white, applies its color transform to XYZ, and multiplies by one factor that all cameras
    /// share.
    pub fn new(rendering: &Rendering, exposure: f64, background: Option<[f32; 3]>) -> Self {
        let (linear, root_polynomial) = linear_part(rendering, exposure);
        Self { linear_from_signals: rendering.srgb_from_xyz * linear, root_polynomial, background }
    }
}

/// XYZ from signals by a matrix, times a factor; or the factor alone, with the root polynomial that gives XYZ before it.
fn linear_part(rendering: &Rendering, factor: f64) -> (DMat3, Option<Arc<RootPolynomial>>) {
    match &rendering.root_polynomial {
        None => (rendering.xyz_from_signals * DMat3::from_diagonal(rendering.white * factor), None),
        Some(polynomial) => (DMat3::from_diagonal(DVec3::splat(factor)), Some(Arc::clone(polynomial))),
    }
}

/// XYZ of signals, before the matrix.
fn straightened(polynomial: &RootPolynomial, signal: [f32; 3]) -> [f32; 3] {
    polynomial.xyz(DVec3::from_array(signal.map(f64::from))).as_vec3().to_array()
}

/// Pixels for a screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Red, green, blue and opacity (not multiplied in), row by row from the top left.
    pub rgba: Vec<u8>,
    /// Samples with a channel below 0 or above 1.
    pub clipped: u64,
}

/// Number of steps of the encoding's table: an eighth of the least step of eight bits.
const STEPS: usize = 1 << 15;

/// Eight bits by linear value, in steps of 2⁻¹⁵.
static ENCODED: LazyLock<Vec<u8>> =
    LazyLock::new(|| (0..=STEPS).map(|i| (255.0 * srgb_transfer(i as f64 / STEPS as f64)).round() as u8).collect());

/// Samples that are encoded together.
const RUN: usize = 64;

/// A color may lie this far beyond what the screen shows before that can be seen.
const SLACK: f32 = 2e-3;

/// The encoding's step of a linear value, in a vectorizable form; NaN is black.
#[inline]
#[allow(clippy::manual_clamp, reason = "clamp keeps what is not a number")]
fn step(linear: f32) -> u32 {
    // Adding 2²³ rounds to an integer, in the low bits.
    (linear.max(0.0).min(1.0) * STEPS as f32 + 8_388_608.0).to_bits() & 0xffff
}

/// The encoding's steps of signals, channel by channel, and how many are clipped. No operation is fused, so all instruction
/// sets give the same.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
fn steps_of(matrix: &Mat3, signals: &[[f32; 3]], steps: &mut [[u32; RUN]; 3]) -> u64 {
    let mut planes = [[0.0_f32; RUN]; 3];
    for (i, signal) in signals.iter().enumerate().take(RUN) {
        for c in 0..3 {
            planes[c][i] = signal[c];
        }
    }
    let [red, green, blue] = planes;
    let mut beyond = [0_u32; RUN];
    for (channel, steps) in steps.iter_mut().enumerate() {
        let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis[channel]);
        for i in 0..RUN {
            let color = x * red[i] + y * green[i] + z * blue[i];
            beyond[i] |= u32::from(color < -SLACK) | u32::from(color > 1.0 + SLACK);
            steps[i] = step(color);
        }
    }
    beyond.iter().take(signals.len()).map(|&b| u64::from(b)).sum()
}

fn encode(linear: f32) -> u8 {
    ENCODED[step(linear) as usize]
}

/// Shows a camera's picture on a screen; none if stopped. A pixel is the mean of its samples in linear light.
pub fn develop(image: &CameraImage, development: &Development, stop: &Stop) -> Option<Picture> {
    develop_signals(image.placed(), image.signals(), development, stop)
}

/// [`develop`] of signals at the places of `geometry`, one for each of its lit samples.
pub fn develop_signals(
    geometry: &LitSamples,
    signals: &[[f32; 3]],
    development: &Development,
    stop: &Stop,
) -> Option<Picture> {
    let size = geometry.size();
    let (width, height) = (size.width as usize, size.height as usize);
    let background = development.background.map(|color| Vec3::from_array(color).clamp(Vec3::ZERO, Vec3::ONE));
    let empty = background.map_or([0, 0, 0, 0], opaque);
    let mut rgba = vec![0; width * height * 4];
    let matrix = development.linear_from_signals.as_mat3();
    let rows_of_task = (4096 / width.max(1)).max(1);
    let xyz: Option<Vec<[f32; 3]>> = development.root_polynomial.as_ref().map(|polynomial| {
        let xyz = |signal: &[f32; 3]| if stop.is_set() { [0.0; 3] } else { straightened(polynomial, *signal) };
        signals.par_iter().with_min_len(512).map(xyz).collect()
    });
    let signals = xyz.as_deref().unwrap_or(signals);
    let task = Task { size, geometry, signals, matrix, background, empty, encoded: &ENCODED };
    let clipped = rgba
        .par_chunks_mut(rows_of_task * width * 4)
        .enumerate()
        .map(|(index, pixels)| if stop.is_set() { 0 } else { task.rows(index * rows_of_task, pixels) })
        .sum();
    (!stop.is_set()).then_some(Picture { width, height, rgba, clipped })
}

fn opaque(linear: Vec3) -> [u8; 4] {
    [encode(linear.x), encode(linear.y), encode(linear.z), 255]
}

struct Task<'a> {
    size: RasterSize,
    geometry: &'a LitSamples,
    signals: &'a [[f32; 3]],
    matrix: Mat3,
    background: Option<Vec3>,
    empty: [u8; 4],
    encoded: &'static [u8],
}

impl Task<'_> {
    /// Fills rows of pixels from row `first`; returns how many samples were clipped.
    fn rows(&self, first: usize, pixels: &mut [u8]) -> u64 {
        let width = self.size.width as usize;
        let samples = self.size.samples as usize;
        let columns = self.size.columns();
        let rows = pixels.len() / (width * 4);
        let within = first * samples * columns..(first + rows) * samples * columns;
        let lit = range(self.geometry.samples(), &within);
        let seen = range(self.geometry.seen(), &within);
        let signals = &self.signals[lit.clone()];
        let (lit, seen) = (&self.geometry.samples()[lit], &self.geometry.seen()[seen]);
        if samples == 1 {
            let (pixels, _) = pixels.as_chunks_mut::<4>();
            pixels.fill(self.empty);
            let place = |sample: u32| sample as usize - within.start;
            for &sample in seen {
                pixels[place(sample)] = [0, 0, 0, 255];
            }
            let mut clipped = 0;
            let mut steps = [[0; RUN]; 3];
            for (places, signals) in lit.chunks(RUN).zip(signals.chunks(RUN)) {
                clipped += steps_of(&self.matrix, signals, &mut steps);
                for (i, &sample) in places.iter().enumerate() {
                    let [r, g, b] = array(|c| self.encoded[steps[c][i] as usize]);
                    pixels[place(sample)] = [r, g, b, 255];
                }
            }
            return clipped;
        }
        let mut clipped = 0;
        let mut linear = |signal: &[f32; 3]| {
            let color = self.matrix * Vec3::from_array(*signal);
            clipped += u64::from(color.min_element() < -SLACK || color.max_element() > 1.0 + SLACK);
            color.clamp(Vec3::ZERO, Vec3::ONE)
        };
        let pixel = |sample: u32| {
            let (row, column) = (sample as usize / columns, sample as usize % columns);
            (row / samples - first) * width + column / samples
        };
        let mut sums = vec![(Vec3::ZERO, 0_u32); rows * width];
        for &sample in seen {
            sums[pixel(sample)].1 += 1;
        }
        for (&sample, signal) in lit.iter().zip(signals) {
            sums[pixel(sample)].0 += linear(signal);
        }
        self.mix(&sums, pixels);
        clipped
    }

    fn mix(&self, sums: &[(Vec3, u32)], pixels: &mut [u8]) {
        let all = (self.size.samples * self.size.samples) as f32;
        let (pixels, _) = pixels.as_chunks_mut::<4>();
        for (pixel, &(sum, seen)) in pixels.iter_mut().zip(sums) {
            *pixel = match self.background {
                _ if seen == 0 => self.empty,
                Some(behind) => opaque((sum + behind * (all - seen as f32)) / all),
                None => {
                    let [r, g, b, _] = opaque(sum / seen as f32);
                    [r, g, b, (255.0 * seen as f32 / all).round() as u8]
                }
            };
        }
    }
}

/// Part of an ascending list that lies within a range.
fn range(list: &[u32], within: &std::ops::Range<usize>) -> std::ops::Range<usize> {
    list.partition_point(|&s| (s as usize) < within.start)..list.partition_point(|&s| (s as usize) < within.end)
}

/// Scale of a render's colors: XYZ over the luminance of a white of the same roughness that faces the light.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorimetricScale {
    /// XYZ from signals, Y = 1 for that white; with a root polynomial, from its XYZ.
    pub xyz_from_signals: DMat3,
    /// Root polynomial that takes signals to XYZ first.
    pub root_polynomial: Option<Arc<RootPolynomial>>,
    /// Adopted white of L*a*b*.
    pub lab_white: Xyz,
}

impl ColorimetricScale {
    /// Scale of one sensor; `white_luminance` is the reference's Y of that white, the same for all sensors.
    pub fn new(rendering: &Rendering, white_luminance: f64) -> Self {
        let scale = if white_luminance > 0.0 { 1.0 / white_luminance } else { 0.0 };
        let (xyz_from_signals, root_polynomial) = linear_part(rendering, scale);
        Self { xyz_from_signals, root_polynomial, lab_white: rendering.lab_white }
    }

    /// Color of a signal.
    pub fn color(&self, signal: [f32; 3]) -> Stimulus {
        let signal = Vec3::from_array(signal).as_dvec3();
        let signal = self.root_polynomial.as_ref().map_or(signal, |polynomial| polynomial.xyz(signal));
        Stimulus::new(Xyz::from_vector(self.xyz_from_signals * signal), self.lab_white)
    }
}

/// Differences of a picture from the reference's of the same geometry, and the reference's L*, at every `stride`-th lit sample, from
/// the signals of a sensor and of the reference, with their scales; 0 where the coordinates are undefined; none if stopped.
pub fn signal_differences(
    metric: Metric,
    [image, reference]: [&[[f32; 3]]; 2],
    [measured, measured_reference]: [&ColorimetricScale; 2],
    stride: usize,
    stop: &Stop,
) -> Option<(Vec<f32>, Vec<f32>)> {
    let stride = stride.max(1);
    let count = image.len().min(reference.len()).div_ceil(stride);
    let at = |index: usize| {
        if index.is_multiple_of(1024) && stop.is_set() {
            return (0.0, 0.0);
        }
        let (a, b) = (image[index * stride], reference[index * stride]);
        let (sample, reference) = (measured.color(a), measured_reference.color(b));
        let lightness = reference.lab.map_or(0.0, |lab| lab.l as f32);
        (metric.between(&reference, &sample).unwrap_or(0.0) as f32, lightness)
    };
    let (mut map, mut lightness) = (Vec::new(), Vec::new());
    (0..count).into_par_iter().with_min_len(512).map(at).unzip_into_vecs(&mut map, &mut lightness);
    (!stop.is_set()).then_some((map, lightness))
}
