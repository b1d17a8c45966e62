//! One pixel of a picture in numbers.

use chromascope_core::colorimetry::difference::delta_e_2000;
use chromascope_core::colorimetry::{Lab, Xy};
use chromascope_core::query::Ask as _;
use chromascope_core::query::render::Roughness;
use chromascope_core::reflectance::{Reading, Regime, beta, kappa};
use chromascope_core::render::diffuse::{DARK, DiffuseTable, ROUGH};
use chromascope_core::render::{CameraImage, ColorimetricScale, Development, Quality};

use super::RenderedFrame;
use crate::results::Results;

/// A pixel in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelReading {
    /// Right and down, in pixels.
    pub at: [usize; 2],
    /// What it shows.
    pub shows: PixelShows,
}

/// What a pixel shows.
#[derive(Clone, Debug, PartialEq)]
pub enum PixelShows {
    /// What is beside the mesh.
    Nothing,
    /// The mesh where no light reaches it.
    Unlit,
    /// The mesh, lit.
    Lit(LitPixel),
}

/// A lit pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct LitPixel {
    /// Linear sRGB at the picture's exposure, before clipping.
    pub linear: [f64; 3],
    /// Chromaticity; none where the signals sum to nothing.
    pub xy: Option<Xy>,
    /// L*a*b*, where a white of the same roughness that faces the light has Y = 1.
    pub lab: Option<Lab>,
    /// ΔE*00 to the reference.
    pub difference: Option<f64>,
    /// g at 550 nm, with its regime and how the integral was made.
    pub roughness: Option<(f64, String)>,
}

/// The lit signals of a pixel, and how many of its samples see the mesh.
struct Samples {
    signal: [f32; 3],
    seen: usize,
    middle: Option<usize>,
}

/// Reads the pixel at a place (right and down, from 0 to 1) of one of the pictures.
pub fn read(shot: &RenderedFrame, results: &Results, index: usize, place: [f64; 2]) -> Option<PixelReading> {
    let pictures = shot.made()?;
    let image = pictures.images.get(index)?.as_ref()?;
    let size = image.placed().size();
    let within = |place: f64, count: u32| ((place * f64::from(count)) as usize).min(count.saturating_sub(1) as usize);
    let at = [within(place[0], size.width), within(place[1], size.height)];
    let samples = samples(image, at);
    let shows = match samples.middle {
        None if samples.seen == 0 => PixelShows::Nothing,
        None => PixelShows::Unlit,
        Some(middle) => PixelShows::Lit(lit(shot, results, index, at, &samples, middle)?),
    };
    Some(PixelReading { at, shows })
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
    let of = &shot.query.sources.get(index)?.rendering;
    let rendering = results.ask(of);
    let rendering = (*rendering).as_ref().ok()?;
    let measurement = ColorimetricScale::new(rendering, pictures.facing.white);
    let factor = pictures.facing.factor(f64::from_bits(shot.query.ev));
    let development = Development::new(rendering, factor, None);
    let signal = glam::DVec3::from(samples.signal.map(f64::from));
    let lab = measurement.lab(samples.signal);
    let difference = (*of != shot.query.reference).then(|| reference_lab(shot, results, at)).flatten();
    Some(LitPixel {
        linear: (development.linear_from_signals * signal).to_array(),
        xy: measurement.xyz(samples.signal).chromaticity(),
        lab,
        difference: lab.zip(difference).map(|(lab, reference)| delta_e_2000(lab, reference)),
        roughness: roughness(shot, middle),
    })
}

/// L*a*b* of the same pixel through the reference, if that is among the pictures.
fn reference_lab(shot: &RenderedFrame, results: &Results, at: [usize; 2]) -> Option<Lab> {
    let index = shot.query.sources.iter().position(|source| source.rendering == shot.query.reference)?;
    let pictures = shot.made()?;
    let image = pictures.images.get(index)?.as_ref()?;
    let rendering = results.ask(&shot.query.reference);
    let rendering = (*rendering).as_ref().ok()?;
    ColorimetricScale::new(rendering, pictures.facing.white).lab(samples(image, at).signal)
}

/// The mean over those samples of a pixel that see the mesh.
fn samples(image: &CameraImage, [x, y]: [usize; 2]) -> Samples {
    let geometry = image.placed();
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
        for signal in &image.signals()[lit] {
            for (sum, part) in found.signal.iter_mut().zip(signal) {
                *sum += part;
            }
        }
    }
    let count = found.seen.max(1) as f32;
    found.signal = found.signal.map(|sum| sum / count);
    found
}

/// g at 550 nm with its regime and the way that its spectral integral was made.
fn roughness(shot: &RenderedFrame, middle: usize) -> Option<(f64, String)> {
    let shading = &shot.query.shading;
    // Between vertices of different roughness there is no one g.
    if shading.reading == Reading::Lambertian || shading.roughness == Roughness::Mesh {
        return None;
    }
    let geometry = shot.made()?.angles.angles().get(middle)?.geometry();
    let (kappa, beta) = (kappa(&shading.surface, &geometry), beta(&shading.surface, &geometry));
    let regime = match Regime::of(kappa) {
        Regime::Slight => "slight",
        Regime::Moderate => "moderate",
        Regime::Rough => "rough",
    };
    let transform = match shading.quality {
        Quality::Preview | Quality::Full if kappa >= ROUGH && beta > DARK => "below the threshold",
        Quality::Preview | Quality::Full if kappa >= ROUGH => "closed form",
        Quality::Preview | Quality::Full if DiffuseTable::holds(kappa, beta) => "table of 9 wavelengths",
        Quality::Preview | Quality::Full => "9 wavelengths",
        Quality::Fine => "15 wavelengths",
        Quality::Within(_) => "by the camera's plan",
        Quality::Exact => "401 wavelengths",
        Quality::Regimes => match Regime::of(kappa) {
            Regime::Slight => "first term of Eq 2",
            Regime::Moderate => "ten terms of Eq 2",
            Regime::Rough => "Eq 4",
        },
    };
    Some((kappa, format!("{regime}, {transform}")))
}
