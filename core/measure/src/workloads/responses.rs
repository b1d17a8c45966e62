//! Responses of many reflectances through many sensitivities: a matrix product, if one calls it so.

use super::Numbers;
use super::timing::{Bench, Candidate, Case, Cost, Room};
use crate::data::cameras;
use crate::harness::timed;
use crate::workload::{BenchError, ErrorOf, ErrorScale, Errors, Workload};
use chromascope_core::camera::batch::{Batch, Sample};
use chromascope_core::spectral::Sensor;
use chromascope_math::dot::dot;
use chromascope_math::double::Double;
use ndarray::linalg::general_mat_mul;
use ndarray::{ArrayView2, ArrayViewMut2, LinalgScalar};
use rayon::prelude::*;
use std::hint::black_box;
use std::ops::{AddAssign, Mul};

/// Number of distinct reflectances, far larger than any cache; further ones repeat them.
const DIFFERENT: usize = 16_000_000;
/// Number of channels up to which memory is the limit, so that a round takes all distinct samples.
const FEW: usize = 12;

pub(super) fn run(bench: &mut Bench<'_>) -> Result<(), BenchError> {
    let sensors = cameras()?;
    for step in [5, 1] {
        for count in [1, 4, 60] {
            let channels: Vec<Vec<f64>> =
                sensors.iter().cycle().take(count).flat_map(|sensor| curves(sensor, step)).collect();
            let many: &[usize] = &[24, 10_000, 1_000_000];
            for &reflectances in bench.pick(&many[..1], &many[..if count == 4 { 3 } else { 2 }], many) {
                if bench.stop.is_set() {
                    return Ok(());
                }
                one(bench, &channels, reflectances);
            }
        }
    }
    Ok(())
}

/// The weighted curves of a sensor at the given wavelength step.
fn curves(sensor: &Sensor, step: usize) -> [Vec<f64>; 3] {
    [0, 1, 2].map(|c: usize| sensor.weighted(c).iter().step_by(step).map(|w| w * step as f64).collect())
}

/// A number type of both lengths.
trait Real: Sample + LinalgScalar + AddAssign + Mul<Output = Self> + Send + Sync + Into<f64> {
    const NAME: &'static str;
    fn of(value: f64) -> Self;
}

impl Real for f64 {
    const NAME: &'static str = "f64";

    fn of(value: f64) -> Self {
        value
    }
}

impl Real for f32 {
    const NAME: &'static str = "f32";

    fn of(value: f64) -> Self {
        value as Self
    }
}

/// Reflectances by rows, sensitivities by rows, and their exact products for the first reflectances.
struct Product<T> {
    spectra: Vec<T>,
    curves: Vec<T>,
    samples: usize,
    channels: usize,
    reflectances: usize,
}

/// One exact response and the sum of the magnitudes that it is made of.
type Exact = (Double, f64);

fn one(bench: &mut Bench<'_>, channels: &[Vec<f64>], reflectances: usize) {
    let samples = channels[0].len();
    let different = reflectances.min(DIFFERENT / samples);
    let mut numbers = Numbers::new(2);
    let spectra: Vec<f64> = (0..different)
        .flat_map(|_| {
            let (level, slope, phase) =
                (numbers.between(0.1, 0.5), numbers.between(-0.1, 0.1), numbers.between(0.0, 6.0));
            (0..samples).map(move |i| {
                let x = i as f64 / (samples - 1) as f64;
                level + slope * x + 0.1 * (5.0 * x + phase).sin()
            })
        })
        .collect();
    let checked = different.min(bench.pick(3, 24, 200));
    let exact: Vec<Exact> = spectra
        .chunks_exact(samples)
        .take(checked)
        .flat_map(|spectrum| channels.iter().map(|curve| product(spectrum, curve)))
        .collect();
    let name = format!("{reflectances} × {} channels, {samples} samples", channels.len());
    let case = Case { workload: Workload::Responses, name: &name, item: "reflectance" };
    let double = Product::<f64>::new(&spectra, channels, reflectances);
    let single = Product::<f32>::new(&spectra, channels, reflectances);
    let room = Room::new(different * channels.len(), &0.0_f64);
    let room_single = Room::new(different * channels.len(), &0.0_f32);
    let mut candidates = vec![double.candidate("plain loop", 1, &room, &exact, plain)];
    candidates.push(single.candidate("plain loop", 1, &room_single, &exact, plain));
    let most = if reflectances < 1000 { vec![1] } else { bench.pools.counts() };
    for threads in most {
        candidates.push(double.candidate("dot products", threads, &room, &exact, dots));
        candidates.push(double.candidate("matrixmultiply", threads, &room, &exact, tuned));
        candidates.push(single.candidate("matrixmultiply", threads, &room_single, &exact, tuned));
    }
    for threads in if reflectances < 1000 { vec![1] } else { bench.pools.counts() } {
        candidates.extend(double.batch(threads, &room, &exact));
        candidates.extend(single.batch(threads, &room_single, &exact));
    }
    bench.compare(case, candidates);
}

fn product(spectrum: &[f64], curve: &[f64]) -> Exact {
    let terms = || spectrum.iter().zip(curve);
    let sum = terms().map(|(a, b)| Double::new(*a) * Double::new(*b)).sum();
    (sum, terms().map(|(a, b)| (a * b).abs()).sum())
}

/// Matrix product: rows of spectra, rows of curves, and the responses as output, rows by spectrum.
type Kernel<T> = fn(&[T], &[T], usize, &mut [T]);

impl<T: Real> Product<T> {
    fn new(spectra: &[f64], channels: &[Vec<f64>], reflectances: usize) -> Self {
        Self {
            spectra: spectra.iter().map(|&value| T::of(value)).collect(),
            curves: channels.iter().flatten().map(|&value| T::of(value)).collect(),
            samples: channels[0].len(),
            channels: channels.len(),
            reflectances,
        }
    }

    fn candidate<'a>(
        &'a self,
        method: &str,
        threads: usize,
        room: &'a Room<T>,
        exact: &[Exact],
        kernel: Kernel<T>,
    ) -> Candidate<'a> {
        let Self { spectra, curves, samples, channels, reflectances } = self;
        let (samples, channels) = (*samples, *channels);
        let different = spectra.len() / samples;
        let checked = exact.len() / channels;
        let mut first = vec![T::of(0.0); checked * channels];
        kernel(&spectra[..checked * samples], curves, samples, &mut first);
        let work = move |items: usize| {
            room.lend(|responses| {
                for start in (0..items).step_by(different) {
                    let count = different.min(items - start);
                    let (spectra, responses) = (&spectra[..count * samples], &mut responses[..count * channels]);
                    if threads == 1 {
                        kernel(spectra, curves, samples, responses);
                    } else {
                        let rows = count.div_ceil(8 * threads).max(16);
                        let parts = responses.par_chunks_mut(rows * channels).zip(spectra.par_chunks(rows * samples));
                        parts.for_each(|(responses, spectra)| kernel(spectra, curves, samples, responses));
                    }
                }
                black_box(responses);
            });
        };
        let method = format!("{method}, {}", T::NAME);
        self.priced(Candidate::new(method, *reflectances, error(&first, exact), work).on(threads))
    }

    /// The program's own product of many, which takes the threads that there are.
    fn batch<'a>(&'a self, threads: usize, room: &'a Room<T>, exact: &[Exact]) -> Option<Candidate<'a>> {
        let Self { spectra, curves, samples, channels, reflectances } = self;
        let (samples, channels) = (*samples, *channels);
        let (batch, seconds) = timed(|| Batch::new(curves, samples));
        let batch = batch.ok()?;
        let different = spectra.len() / samples;
        let first = batch.responses(&spectra[..exact.len() / channels * samples]).ok()?;
        let work = move |items: usize| {
            room.lend(|responses| {
                for start in (0..items).step_by(different) {
                    let count = different.min(items - start);
                    let done = batch.responses_into(&spectra[..count * samples], &mut responses[..count * channels]);
                    debug_assert!(done.is_ok(), "as many answers as the spectra have");
                }
                black_box(responses);
            });
        };
        let method = format!("batch, {}", T::NAME);
        let candidate = Candidate::new(method, *reflectances, error(&first, exact), work);
        Some(self.priced(candidate.on(threads).built_in(seconds)))
    }

    fn priced<'a>(&self, candidate: Candidate<'a>) -> Candidate<'a> {
        let Self { samples, channels, reflectances, .. } = *self;
        let different = self.spectra.len() / samples;
        let size = size_of::<T>() as f64;
        // Twice as many singles as doubles fit a register.
        let registers = size / size_of::<f64>() as f64;
        let cost =
            Cost { bytes: size * (samples + channels) as f64, flops: 2.0 * registers * (samples * channels) as f64 };
        let all = if reflectances > different && channels <= FEW { different } else { 1 };
        candidate.at_least(all).costing(cost)
    }
}

fn plain<T: Real>(spectra: &[T], curves: &[T], samples: usize, responses: &mut [T]) {
    let channels = curves.len() / samples;
    for (spectrum, responses) in spectra.chunks_exact(samples).zip(responses.chunks_exact_mut(channels)) {
        for (curve, response) in curves.chunks_exact(samples).zip(responses) {
            let mut sum = T::of(0.0);
            for (a, b) in spectrum.iter().zip(curve) {
                sum += *a * *b;
            }
            *response = sum;
        }
    }
}

/// The program's dot product for each response.
fn dots(spectra: &[f64], curves: &[f64], samples: usize, responses: &mut [f64]) {
    let channels = curves.len() / samples;
    for (spectrum, responses) in spectra.chunks_exact(samples).zip(responses.chunks_exact_mut(channels)) {
        for (curve, response) in curves.chunks_exact(samples).zip(responses) {
            *response = dot(spectrum, curve);
        }
    }
}

fn tuned<T: Real>(spectra: &[T], curves: &[T], samples: usize, responses: &mut [T]) {
    let (rows, channels) = (spectra.len() / samples, curves.len() / samples);
    let spectra = ArrayView2::from_shape((rows, samples), spectra);
    let curves = ArrayView2::from_shape((channels, samples), curves);
    let responses = ArrayViewMut2::from_shape((rows, channels), responses);
    if let (Ok(spectra), Ok(curves), Ok(mut responses)) = (spectra, curves, responses) {
        general_mat_mul(T::of(1.0), &spectra, &curves.t(), T::of(0.0), &mut responses);
    }
}

fn error<T: Real>(found: &[T], exact: &[Exact]) -> ErrorOf {
    let mut errors = Errors::default();
    for (&found, (exact, scale)) in found.iter().zip(exact) {
        errors.add(exact.error_of(found.into()), *scale);
    }
    errors.sum_up("responses, relative to the sum of magnitudes, against 106 bits", ErrorScale::Relative)
}
