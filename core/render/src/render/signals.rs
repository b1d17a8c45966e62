//! The pictures that cameras take: three numbers a sample, before white balance and exposure.

use super::coherent::CoherentIntegral;
use super::geometry::LitSamples;
use super::measure::SpectralWeights;
use super::plan::{Places, Plan, RUN};
use super::shading::{DiffuseKind, Shade, ShadingImage};
use super::sky::ground;
use super::stop::Stop;
use chromascope_math::array::each;
use chromascope_mesh::Part;
use rayon::prelude::*;
use std::sync::Arc;

/// One camera's picture: `cos θi cos⁴α ∫C_c P S L dλ / ∫C_c L dλ` at each lit sample (Eq 12 without its s), with the light of a
/// sky and what shines through a leaf, `ρd |cos θi| cos⁴α ∫C_c T L dλ / ∫C_c L dλ`, ρd being
/// [`crate::reflectance::leaf::ScatteredShare`].
#[derive(Clone, Debug)]
pub struct CameraImage {
    placed: Arc<LitSamples>,
    signals: Arc<Vec<[f32; 3]>>,
    plan: Arc<Plan>,
}

impl CameraImage {
    /// Integrates at every lit sample by the methods of a plan, [`ShadingImage::plan`] or another; none if stopped.
    pub fn new(shading: &ShadingImage, measure: &SpectralWeights, plan: Arc<Plan>, stop: &Stop) -> Option<Self> {
        Self::of_part(shading, measure, plan, None, stop)
    }

    /// [`Self::new`] for some of the lit samples; the signals of the others mean nothing.
    pub fn of_part(
        shading: &ShadingImage,
        measure: &SpectralWeights,
        plan: Arc<Plan>,
        part: Option<&[bool]>,
        stop: &Stop,
    ) -> Option<Self> {
        // Between vertices all of them are needed.
        let part = part.filter(|_| shading.vertices().is_none());
        let signals = Camera { measure, plan: &plan, part }.signals(shading, stop)?;
        Some(Self { placed: Arc::clone(shading.geometry().placed()), signals: Arc::new(signals), plan })
    }

    /// This image with the signals of another material's where `part` is true.
    #[must_use]
    pub fn with(&self, other: &Self, part: &[bool]) -> Self {
        let both = self.signals.iter().zip(&*other.signals).zip(part);
        let signals = both.map(|((&own, &other), &part)| if part { other } else { own }).collect();
        Self { signals: Arc::new(signals), ..self.clone() }
    }

    /// This image with the signals of matte parts, ascending by part; those of other parts stay.
    ///
    /// ```text
    /// T_c (cos θi cos⁴α + s W_d) + B_c E/ρ_g
    /// ```
    /// T = signal of a part that faces the light; B = that in the light that the ground sends up.
    #[must_use]
    pub fn with_matte(&self, shading: &ShadingImage, parts: &[MattePart]) -> Self {
        let mut signals = (*self.signals).clone();
        let (placed, sky, bounce) = (shading.geometry().placed(), shading.sky(), shading.bounce());
        let lit = signals.par_iter_mut().zip(placed.parts()).zip(shading.geometry().angles()).enumerate();
        lit.with_min_len(4096).for_each(|(index, ((signal, part), angles))| {
            if let Ok(at) = parts.binary_search_by_key(part, |matte| matte.part) {
                let above = sky.map_or(0.0, |sky| sky.share * f64::from(sky.image.samples()[index].diffuse));
                let below = bounce.map_or(0.0, |bounce| f64::from(ground::from_below(bounce[index], sky)));
                let MattePart { facing, from_ground, .. } = parts[at];
                let light = angles.light() + above;
                *signal = std::array::from_fn(|c| (facing[c] * light + from_ground[c] * below) as f32);
            }
        });
        Self { signals: Arc::new(signals), ..self.clone() }
    }

    /// The methods of integration of the diffuse component.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Positions of its samples.
    pub fn placed(&self) -> &LitSamples {
        &self.placed
    }

    /// The signals of the lit samples, in the order of [`LitSamples::samples`].
    pub fn signals(&self) -> &[[f32; 3]] {
        &self.signals
    }
}

/// Signals of a part that scatters evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MattePart {
    /// The part.
    pub part: Part,
    /// When it faces the light.
    pub facing: [f64; 3],
    /// Under as much light by way of the ground.
    pub from_ground: [f64; 3],
}

struct Camera<'a> {
    measure: &'a SpectralWeights,
    plan: &'a Plan,
    /// The samples whose signals are computed; none for all.
    part: Option<&'a [bool]>,
}

impl Camera<'_> {
    fn has(&self, index: usize) -> bool {
        self.part.is_none_or(|part| part[index])
    }

    fn signals(&self, shading: &ShadingImage, stop: &Stop) -> Option<Vec<[f32; 3]>> {
        let mut signals = vec![[0.0; 3]; shading.shades().len()];
        let chunk = self.plan.chunk();
        signals.par_chunks_mut(chunk).zip(shading.shades().par_chunks(chunk)).enumerate().for_each(
            |(index, (signals, shades))| {
                if !stop.is_set() {
                    self.diffuse(index * chunk, shades, signals);
                }
            },
        );
        let integral = CoherentIntegral::in_picture(shading, self.measure);
        let coherent_samples = shading.coherent_samples().par_iter().with_min_len(64).map(|coherent| {
            if stop.is_set() || !self.has(coherent.index as usize) {
                return [0.0; 3];
            }
            integral.at(coherent)
        });
        let coherent_samples: Vec<[f64; 3]> = coherent_samples.collect();
        for (coherent, sums) in shading.coherent_samples().iter().zip(coherent_samples) {
            for (signal, sum) in signals[coherent.index as usize].iter_mut().zip(sums) {
                *signal += sum as f32;
            }
        }
        let mut signals = match shading.vertices() {
            Some(vertices) => vertices.mixed(&signals),
            None => signals,
        };
        if let Some(transmitted) = self.measure.transmitted.as_ref().filter(|_| shading.geometry().reach().through) {
            let angles = shading.geometry().angles();
            signals.par_iter_mut().zip(angles).with_min_len(4096).filter(|(_, angles)| angles.cos_i < 0.0).for_each(
                |(signal, angles)| {
                    let share = transmitted.share.at(-f64::from(angles.cos_i));
                    let through = scaled(transmitted.signals, share * angles.light_behind());
                    signal.iter_mut().zip(through).for_each(|(signal, through)| *signal += through);
                },
            );
        }
        if let Some(sky) = shading.sky() {
            sky.add(self.measure, shading.geometry().angles(), &mut signals);
        }
        if let Some((changes, spread)) = shading.spread().zip(self.measure.spread) {
            signals.par_iter_mut().zip(changes).with_min_len(4096).for_each(|(signal, change)| {
                for (light, own) in change.iter().zip(spread) {
                    signal.iter_mut().zip(own).for_each(|(signal, own)| *signal += light * own as f32);
                }
            });
        }
        if let Some(bounce) = shading.bounce() {
            ground::add(bounce, shading.sky(), self.measure, &mut signals);
        }
        (!stop.is_set()).then_some(signals)
    }

    /// The diffuse component of some samples, from index `first`.
    fn diffuse(&self, first: usize, shades: &[Shade], signals: &mut [[f32; 3]]) {
        let (mut places, mut sums) = (Places::EMPTY, [[0.0; RUN]; 3]);
        for (run, (shades, signals)) in shades.chunks(RUN).zip(signals.chunks_mut(RUN)).enumerate() {
            places.count = shades.len();
            for (i, shade) in shades.iter().enumerate() {
                places.wanted[i] = shade.kind == DiffuseKind::Spectral && self.has(first + run * RUN + i);
                (places.kappa[i], places.beta[i]) =
                    if places.wanted[i] { (shade.kappa, shade.beta) } else { Places::UNWANTED };
            }
            if places.wanted[..shades.len()].contains(&true) {
                self.plan.run(&places, &mut sums);
            }
            for (i, (shade, signal)) in shades.iter().zip(signals).enumerate() {
                match shade.kind {
                    DiffuseKind::Dark => {}
                    DiffuseKind::Flat => *signal = scaled(self.measure.totals(), shade.front),
                    DiffuseKind::Spectral => *signal = scaled([sums[0][i], sums[1][i], sums[2][i]], shade.front),
                }
            }
        }
    }
}

fn scaled(sums: [f64; 3], front: f64) -> [f32; 3] {
    each(sums, |sum| (sum * front) as f32)
}
