//! The pictures that cameras take: three numbers a sample, before white balance and exposure.

use super::Stop;
use super::diffuse::{DiffuseTable, by_moments, by_nodes, by_regimes, rough_basis};
use super::geometry::GeometryImage;
use super::measure::Measure;
use super::mirror::{Nodes, mirror_sum};
use super::shading::{Quality, Shade, ShadingImage, Way};
use crate::reflectance::Precision;
use multiversion::multiversion;
use rayon::prelude::*;
use std::sync::Arc;

/// One camera's picture: `cos θi cos⁴α ∫C_c P S L dλ / ∫C_c L dλ` at each lit sample (Eq 12 without its s).
#[derive(Clone, Debug)]
pub struct CameraImage {
    geometry: Arc<GeometryImage>,
    signals: Arc<[[f32; 3]]>,
}

impl CameraImage {
    /// Integrates at every lit sample; none if stopped. `table` may be left out where no sample needs it; where one does and
    /// there is none, sums over wavelengths take its place.
    pub fn new(shading: &ShadingImage, measure: &Measure, table: Option<&DiffuseTable>, stop: &Stop) -> Option<Self> {
        let geometry = Arc::clone(shading.geometry());
        let mut signals = vec![[0.0; 3]; shading.shades().len()];
        let camera = Camera { measure, table, quality: shading.quality() };
        let chunk = camera.chunk();
        signals.par_chunks_mut(chunk).zip(shading.shades().par_chunks(chunk)).for_each(|(signals, shades)| {
            if !stop.is_set() {
                camera.diffuse(shades, signals);
            }
        });
        let mirrors = shading.mirrors().par_iter().with_min_len(64).map(|mirror| {
            if stop.is_set() {
                return [0.0; 3];
            }
            mirror_sum(mirror, shading.surface(), camera.mirror_nodes(), geometry.angular_radius())
        });
        let mirrors: Vec<[f64; 3]> = mirrors.collect();
        for (mirror, sums) in shading.mirrors().iter().zip(mirrors) {
            for (signal, sum) in signals[mirror.index as usize].iter_mut().zip(sums) {
                *signal += sum as f32;
            }
        }
        (!stop.is_set()).then(|| Self { geometry, signals: signals.into() })
    }

    /// The angles it is made of, with the places of the lit samples.
    pub fn geometry(&self) -> &Arc<GeometryImage> {
        &self.geometry
    }

    /// The signals of the lit samples, in the order of [`GeometryImage::samples`].
    pub fn signals(&self) -> &[[f32; 3]] {
        &self.signals
    }
}

struct Camera<'a> {
    measure: &'a Measure,
    table: Option<&'a DiffuseTable>,
    quality: Quality,
}

impl Camera<'_> {
    /// Samples between two looks at the stop signal: about a millisecond's work.
    fn chunk(&self) -> usize {
        match self.quality {
            Quality::Preview | Quality::Full => 4096,
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
                Way::Table | Way::Moments | Way::Dark => {}
            }
        }
        quick(shades, self.measure.moments(), self.table, signals);
    }

    fn sum(&self, shade: &Shade) -> [f64; 3] {
        let (kappa, beta) = (shade.kappa, shade.beta);
        match self.quality {
            Quality::Preview | Quality::Full => by_nodes(self.measure.coarse(), kappa, beta, Precision::Fine),
            Quality::Fine => by_nodes(self.measure.fine(), kappa, beta, Precision::Full),
            Quality::Exact => by_nodes(self.measure.dense(), kappa, beta, Precision::Full),
            Quality::Regimes => by_regimes(self.measure.dense(), kappa, beta),
        }
    }

    fn mirror_nodes(&self) -> Nodes<'_> {
        Nodes {
            smooth: self.measure.fine(),
            every: self.measure.dense(),
            stride: if self.quality == Quality::Preview { 10 } else { 1 },
            exact: matches!(self.quality, Quality::Exact | Quality::Regimes),
        }
    }
}

fn scaled(sums: [f64; 3], front: f64) -> [f32; 3] {
    sums.map(|sum| (sum * front) as f32)
}

/// The samples that take no sum over wavelengths. Compiled for several instruction sets, the best chosen at run time; no
/// operation is fused, so all of them give the same bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn quick(shades: &[Shade], moments: &[[f64; 4]; 3], table: Option<&DiffuseTable>, signals: &mut [[f32; 3]]) {
    quick_portable(shades, moments, table, signals);
}

/// The same for any processor.
#[inline(always)]
fn quick_portable(
    shades: &[Shade],
    moments: &[[f64; 4]; 3],
    table: Option<&DiffuseTable>,
    signals: &mut [[f32; 3]],
) {
    for (shade, signal) in shades.iter().zip(signals.iter_mut()) {
        match (shade.way, table) {
            (Way::Moments, _) => {
                let sums = by_moments(moments, &rough_basis(shade.kappa, shade.beta));
                *signal = scaled(sums, shade.front);
            }
            (Way::Table, Some(table)) => *signal = scaled(table.at(shade.kappa, shade.beta), shade.front),
            _ => {}
        }
    }
}
