//! One pixel of a picture in numbers.

use chromascope_core::colorimetry::{Lab, Stimulus, Xy};
use chromascope_core::query::Ask as _;
use chromascope_core::query::render::Roughness;
use chromascope_core::reflectance::{Normalization, Regime, beta, kappa};
use chromascope_core::render::{ColorimetricScale, Development, LitSamples};
use chromascope_mesh::Part;

use super::RenderedFrame;
use crate::results::Results;

#[derive(Clone, Debug, PartialEq)]
pub struct PixelReading {
    /// Right and down, in pixels.
    pub at: [usize; 2],
    pub shows: PixelShows,
}

#[derive(Clone, Debug, PartialEq)]
pub enum PixelShows {
    /// Background, outside the mesh.
    Nothing,
    /// A pixel of an image without a value in every band.
    NoValue,
    /// The mesh where no light reaches it.
    Unlit,
    /// The mesh, lit.
    Lit(LitPixel),
}

#[derive(Clone, Debug, PartialEq)]
pub struct LitPixel {
    /// Linear sRGB at the picture's exposure, before clipping.
    pub linear: [f64; 3],
    /// Chromaticity; none where the signals sum to nothing.
    pub xy: Option<Xy>,
    /// L*a*b*, where a white of the same roughness that faces the light has Y = 1.
    pub lab: Option<Lab>,
    /// Difference from the reference, by the pictures' metric.
    pub difference: Option<f64>,
    /// Part of the mesh.
    pub part: Part,
    /// g at 550 nm, with its regime and how the integral was made.
    pub roughness: Option<(f64, String)>,
}

/// The lit signals of a pixel, and the number of its samples on the mesh.
struct Samples {
    signal: [f32; 3],
    seen: usize,
    middle: Option<usize>,
}

/// Reads the pixel at a place (right and down, from 0 to 1) of one of the pictures.
pub fn read(shot: &RenderedFrame, results: &Results, index: usize, place: [f64; 2]) -> Option<PixelReading> {
    let pictures = shot.made()?;
    let (placed, signals) = pictures.signals(index)?;
    let size = placed.size();
    let within = |place: f64, count: u32| ((place * f64::from(count)) as usize).min(count.saturating_sub(1) as usize);
    let at = [within(place[0], size.width), within(place[1], size.height)];
    let samples = samples((placed, signals), at);
    let shows = match samples.middle {
        None if pictures.image().is_some() => PixelShows::NoValue,
        None if samples.seen == 0 => PixelShows::Nothing,
        None => PixelShows::Unlit,
        Some(middle) => PixelShows::Lit(lit(shot, results, index, at, &samples, middle)?),
    };
    // An image's pixels are counted as in the file.
    let step = shot.query.image().map_or(1, |image| image.signals.step);
    Some(PixelReading { at: at.map(|at| at * step), shows })
}

fn lit(
    shot: &RenderedFrame,
    results: &Results,
    index: usize,
    at: [usize; 2],
    samples: &Samples,
    middle: usize,
) -> Option<LitPixel> {
    let pictures = shot.made()?;
    let of = shot.query.rendering(index)?;
    let rendering = results.ask(of);
    let rendering = (*rendering).as_ref().ok()?;
    let measurement = ColorimetricScale::new(rendering, pictures.white());
    let factor = pictures.factor(shot.query.ev());
    let development = Development::new(rendering, factor, None);
    let signal = glam::DVec3::from(samples.signal.map(f64::from));
    let signal = development.root_polynomial.as_ref().map_or(signal, |polynomial| polynomial.xyz(signal));
    let color = measurement.color(samples.signal);
    let reference = (of != shot.query.reference()).then(|| reference_color(shot, results, at)).flatten();
    Some(LitPixel {
        linear: (development.linear_from_signals * signal).to_array(),
        xy: color.xyz.chromaticity(),
        lab: color.lab,
        difference: reference.and_then(|reference| shot.query.metric().between(&reference, &color)),
        part: pictures.mesh().map_or(Part::Body, |made| made.angles.placed().part(middle)),
        roughness: roughness(shot, index, middle),
    })
}

/// Color of the same pixel through the reference, if that is among the pictures.
fn reference_color(shot: &RenderedFrame, results: &Results, at: [usize; 2]) -> Option<Stimulus> {
    let index = shot.query.reference_index()?;
    let pictures = shot.made()?;
    let rendering = results.ask(shot.query.reference());
    let rendering = (*rendering).as_ref().ok()?;
    Some(ColorimetricScale::new(rendering, pictures.white()).color(samples(pictures.signals(index)?, at).signal))
}

/// The mean over those samples of a pixel that see the mesh.
fn samples((geometry, signals): (&LitSamples, &[[f32; 3]]), [x, y]: [usize; 2]) -> Samples {
    let (columns, each) = (geometry.size().columns(), geometry.size().samples as usize);
    let mut found = Samples { signal: [0.0; 3], seen: 0, middle: None };
    for row in y * each..(y + 1) * each {
        let first = row * columns + x * each;
        let within = |list: &[u32]| {
            let start = list.partition_point(|&s| (s as usize) < first);
            start..start + list[start..].partition_point(|&s| (s as usize) < first + each)
        };
        found.seen += within(geometry.seen()).len();
        let lit = within(geometry.samples());
        if found.middle.is_none() || row <= y * each + each / 2 {
            found.middle = lit.clone().nth(lit.len() / 2).or(found.middle);
        }
        for signal in &signals[lit] {
            for (sum, part) in found.signal.iter_mut().zip(signal) {
                *sum += part;
            }
        }
    }
    let count = found.seen.max(1) as f32;
    found.signal = found.signal.map(|sum| sum / count);
    found
}

/// g at 550 nm with its regime and the method of its spectral integral.
fn roughness(shot: &RenderedFrame, index: usize, middle: usize) -> Option<(f64, String)> {
    let shading = &shot.query.mesh()?.shading;
    // Between vertices of different roughness there is no one g.
    if shading.reading == Normalization::Lambertian || shading.roughness == Roughness::Mesh {
        return None;
    }
    let pictures = shot.made()?.mesh()?;
    if pictures.angles.placed().part(middle).is_matte() {
        return None;
    }
    let geometry = pictures.angles.angles().get(middle)?.geometry();
    let (kappa, beta) = (kappa(&shading.surface, &geometry), beta(&shading.surface, &geometry));
    let regime = match Regime::of(kappa) {
        Regime::Slight => "slight",
        Regime::Moderate => "moderate",
        Regime::Rough => "rough",
    };
    let method = pictures.images.get(index)?.as_ref()?.plan().method(kappa, beta);
    Some((kappa, format!("{regime}, {}", method.name())))
}
