//! The pictures that cameras take: three numbers a sample, before white balance and exposure.

use super::Stop;
use super::diffuse::{DiffuseTable, by_moments, by_nodes, by_regimes, rough_basis};
use super::geometry::LitSamples;
use super::measure::{MOMENTS, SpectralWeights};
use super::mirror::{Nodes, Reach, mirror_sum};
use super::plan::{Places, Plan, RUN as PLANNED_RUN};
use super::shading::{Quality, Shade, ShadingImage, Way};
use crate::reflectance::Precision;
use multiversion::multiversion;
use rayon::prelude::*;
use std::sync::Arc;

/// One camera's picture: `cos θi cos⁴α ∫C_c P S L dλ / ∫C_c L dλ` at each lit sample (Eq 12 without its s).
#[derive(Clone, Debug)]
pub struct CameraImage {
    placed: Arc<LitSamples>,
    signals: Arc<Vec<[f32; 3]>>,
}

impl CameraImage {
    /// Integrates at every lit sample; none if stopped. `table` may be left out where no sample needs it; where one does and
    /// there is none, sums over wavelengths take its place.
    pub fn new(
        shading: &ShadingImage,
        measure: &SpectralWeights,
        table: Option<&DiffuseTable>,
        stop: &Stop,
    ) -> Option<Self> {
        Self::with_reach(shading, measure, table, Reach::in_picture(shading, measure), stop)
    }

    /// The same where it is known how the mirror's lobe is made: what [`Reach::in_picture`] says of this shading or of one like
    /// it. Finding that may take milliseconds, whatever the number of samples.
    pub fn with_reach(
        shading: &ShadingImage,
        measure: &SpectralWeights,
        table: Option<&DiffuseTable>,
        reach: Reach,
        stop: &Stop,
    ) -> Option<Self> {
        Camera { measure, table, quality: shading.quality(), plan: None, reach }.image(shading, stop)
    }

    /// The same by a plan, for a shading at [`Quality::Within`]; `reach` says how the mirror's lobe is made. What the plan was not
    /// made for is summed over all wavelengths.
    pub fn by_plan(
        shading: &ShadingImage,
        measure: &SpectralWeights,
        plan: Option<&Plan>,
        reach: Reach,
        stop: &Stop,
    ) -> Option<Self> {
        Camera { measure, table: None, quality: shading.quality(), plan, reach }.image(shading, stop)
    }

    /// Where its samples are.
    pub fn placed(&self) -> &LitSamples {
        &self.placed
    }

    /// The signals of the lit samples, in the order of [`LitSamples::samples`].
    pub fn signals(&self) -> &[[f32; 3]] {
        &self.signals
    }
}

struct Camera<'a> {
    measure: &'a SpectralWeights,
    table: Option<&'a DiffuseTable>,
    quality: Quality,
    plan: Option<&'a Plan>,
    reach: Reach,
}

impl Camera<'_> {
    fn image(&self, shading: &ShadingImage, stop: &Stop) -> Option<CameraImage> {
        let geometry = shading.geometry();
        let placed = Arc::clone(geometry.placed());
        let mut signals = vec![[0.0; 3]; shading.shades().len()];
        let chunk = self.chunk();
        signals.par_chunks_mut(chunk).zip(shading.shades().par_chunks(chunk)).for_each(|(signals, shades)| {
            if !stop.is_set() {
                self.diffuse(shades, signals);
            }
        });
        let mirrors = shading.mirrors().par_iter().with_min_len(64).map(|mirror| {
            if stop.is_set() {
                return [0.0; 3];
            }
            mirror_sum(mirror, shading.surface(), self.mirror_nodes(), geometry.angular_radius())
        });
        let mirrors: Vec<[f64; 3]> = mirrors.collect();
        for (mirror, sums) in shading.mirrors().iter().zip(mirrors) {
            for (signal, sum) in signals[mirror.index as usize].iter_mut().zip(sums) {
                *signal += sum as f32;
            }
        }
        let signals = match shading.vertices() {
            Some(vertices) => vertices.mixed(&signals),
            None => signals,
        };
        (!stop.is_set()).then(|| CameraImage { placed, signals: Arc::new(signals) })
    }

    /// Samples between two looks at the stop signal: about a millisecond's work.
    fn chunk(&self) -> usize {
        match self.quality {
            Quality::Preview | Quality::Full => 4096,
            Quality::Within(_) => {
                if self.plan.is_some() {
                    1024
                } else {
                    64
                }
            }
            Quality::Fine => 512,
            Quality::Exact | Quality::Regimes => 64,
        }
    }

    fn diffuse(&self, shades: &[Shade], signals: &mut [[f32; 3]]) {
        for (shade, signal) in shades.iter().zip(signals.iter_mut()) {
            match shade.way {
                Way::Flat => *signal = scaled(self.measure.totals(), shade.front),
                Way::Sum => *signal = scaled(self.sum(shade), shade.front),
                Way::Table if self.table.is_none() => *signal = scaled(self.sum(shade), shade.front),
                Way::Planned if self.plan.is_none() => *signal = scaled(self.sum(shade), shade.front),
                Way::Table | Way::Moments | Way::Planned | Way::Dark => {}
            }
        }
        match self.plan {
            Some(plan) => planned(plan, shades, signals),
            None => quick(shades, self.measure.moments(), self.table, signals),
        }
    }

    fn sum(&self, shade: &Shade) -> [f64; 3] {
        let (kappa, beta) = (shade.kappa, shade.beta);
        match self.quality {
            Quality::Preview | Quality::Full => by_nodes(self.measure.coarse(), kappa, beta, Precision::Fine),
            Quality::Fine => by_nodes(self.measure.fine(), kappa, beta, Precision::Full),
            Quality::Exact | Quality::Within(_) => by_nodes(self.measure.dense(), kappa, beta, Precision::Full),
            Quality::Regimes => by_regimes(self.measure.dense(), kappa, beta),
        }
    }

    fn mirror_nodes(&self) -> Nodes<'_> {
        let Reach { still_m, settled_m, quick } = self.reach;
        let measure = self.measure.coherent();
        Nodes { smooth: measure.fine(), every: measure.dense(), still_m, settled_m, quick }
    }
}

/// The samples that go as a plan says.
fn planned(plan: &Plan, shades: &[Shade], signals: &mut [[f32; 3]]) {
    let (mut places, mut sums) = (Places::EMPTY, [[0.0; PLANNED_RUN]; 3]);
    for (shades, signals) in shades.chunks(PLANNED_RUN).zip(signals.chunks_mut(PLANNED_RUN)) {
        if shades.iter().all(|shade| shade.way != Way::Planned) {
            continue;
        }
        places.count = shades.len();
        for (i, shade) in shades.iter().enumerate() {
            (places.kappa[i], places.beta[i]) = (shade.kappa, shade.beta);
            places.wanted[i] = shade.way == Way::Planned;
        }
        plan.run(&places, &mut sums);
        for (i, (shade, signal)) in shades.iter().zip(signals).enumerate() {
            if shade.way == Way::Planned {
                *signal = scaled([sums[0][i], sums[1][i], sums[2][i]], shade.front);
            }
        }
    }
}

fn scaled(sums: [f64; 3], front: f64) -> [f32; 3] {
    sums.map(|sum| (sum * front) as f32)
}

/// Samples whose moments are summed together, channel by channel, so that the loops vectorize.
const RUN: usize = 64;

/// The samples that take no sum over wavelengths. Compiled for several instruction sets, the best chosen at run time; no
/// operation is fused, so all of them give the same bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn quick(shades: &[Shade], moments: &[[f64; MOMENTS]; 3], table: Option<&DiffuseTable>, signals: &mut [[f32; 3]]) {
    quick_portable(shades, moments, table, signals);
}

/// The same for any processor.
#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
fn quick_portable(
    shades: &[Shade],
    moments: &[[f64; MOMENTS]; 3],
    table: Option<&DiffuseTable>,
    signals: &mut [[f32; 3]],
) {
    for (shades, signals) in shades.chunks(RUN).zip(signals.chunks_mut(RUN)) {
        if shades.iter().any(|shade| shade.way == Way::Moments) {
            let sums = moments_of(shades, moments);
            for (i, (shade, signal)) in shades.iter().zip(signals.iter_mut()).enumerate() {
                if shade.way == Way::Moments {
                    *signal = [sums[0][i], sums[1][i], sums[2][i]];
                }
            }
        }
        if let Some(table) = table {
            for (shade, signal) in shades.iter().zip(signals) {
                if shade.way == Way::Table {
                    *signal = scaled(table.read(shade.position), shade.front);
                }
            }
        }
    }
}

/// Three channels of each sample by moments; what belongs to samples that go another way means nothing.
#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
fn moments_of(shades: &[Shade], moments: &[[f64; MOMENTS]; 3]) -> [[f32; RUN]; 3] {
    let (mut fronts, mut kappas, mut betas) = ([0.0; RUN], [1.0; RUN], [0.0; RUN]);
    for (i, shade) in shades.iter().enumerate().take(RUN) {
        (fronts[i], kappas[i], betas[i]) = (shade.front, shade.kappa, shade.beta);
    }
    let mut channels = [[0.0; RUN]; 3];
    for i in 0..RUN {
        let sums = by_moments(moments, &rough_basis(kappas[i], betas[i]));
        for c in 0..3 {
            channels[c][i] = (sums[c] * fronts[i]) as f32;
        }
    }
    channels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let shade = |i: u32| Shade {
            front: 0.1 + f64::from(i % 17),
            kappa: 130.0 * 1.01_f64.powi((i % 900).cast_signed()),
            beta: f64::from(i % 301) / 10.0,
            position: [0.0; 2],
            way: if i % 5 == 4 { Way::Dark } else { Way::Moments },
        };
        let shades: Vec<Shade> = (0..1000).map(shade).collect();
        let moments = [[1.0, 1.1, 1.3, 1.7], [0.4, 0.5, 0.7, 0.9], [-0.1, -0.2, -0.3, -0.4]];
        let (mut chosen, mut portable) = (vec![[0.0; 3]; 1000], vec![[0.0; 3]; 1000]);
        quick(&shades, &moments, None, &mut chosen);
        quick_portable(&shades, &moments, None, &mut portable);
        assert_eq!(chosen, portable);
        let plain: Vec<[f32; 3]> = shades
            .iter()
            .map(|shade| match shade.way {
                Way::Moments => scaled(by_moments(&moments, &rough_basis(shade.kappa, shade.beta)), shade.front),
                _ => [0.0; 3],
            })
            .collect();
        assert_eq!(chosen, plain);
    }
}
