//! Color rendering indices of CIE 13.3-1995.

use super::reference;
use super::standards::{RenditionError, Standards, Sums, held, smooth, wavelengths};
use crate::colorimetry::{Uv60, Xyz};
use crate::light::temperature::published::Robertson;
use crate::light::{Cct, CctError};
use crate::spectral::SpectralDistribution;

/// Number of test color samples of CIE 13.3.
pub const SAMPLES: usize = 14;
/// Distance from the reference illuminant in u, v beyond which CIE 13.3 calls its indices less accurate.
pub const NEAR: f64 = 5.4e-3;

/// Width in nanometers of a band that makes a light mainly monochromatic, and the least share of its luminance there.
const BAND_NM: usize = 20;
const BAND_SHARE: f64 = 0.8;

/// Band of a mainly monochromatic light, from its luminance at steps of 1 nm: index of the band's peak, and the share of the
/// luminance in it; none where no 20 nm hold four fifths.
pub fn monochromatic_band(luminance: &[f64]) -> Option<(usize, f64)> {
    let sum: f64 = luminance.iter().sum();
    let bands = luminance.windows(BAND_NM + 1).map(|band| band.iter().sum::<f64>() / sum);
    let (first, share) = bands.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let band = luminance.get(first..=first + BAND_NM)?;
    let peak = (0..band.len()).max_by(|&a, &b| band[a].total_cmp(&band[b]))?;
    (share >= BAND_SHARE).then_some((first + peak, share))
}

/// Color rendering indices of a light.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderingIndices {
    /// General color rendering index Ra: mean of R1 to R8. At most 100; may be negative.
    pub general: f64,
    /// Special color rendering indices R1 to R14.
    pub special: [f64; SAMPLES],
    /// Correlated color temperature (Robertson 1968) of the reference illuminant, and Duv.
    pub cct: Cct,
    /// Distance of the light from its reference illuminant in the 1960 diagram; indices are less accurate beyond [`NEAR`].
    pub distance: f64,
}

/// Computes the color rendering indices of a light.
///
/// ```text
/// Ri = 100 − 4.6 ΔEi,   ΔEi in CIE 1964 U* V* W*,   Ra = (R1 + … + R8) / 8
/// ```
/// The reference illuminant is a blackbody below 5000 K and CIE daylight from there on, at the correlated color temperature by
/// Robertson's table as he printed it; adaptation by von Kries as CIE 13.3 has it. Sums of 1 nm from 360 to 780 nm over the CIE 1931
/// observer. The same sums at 5 nm give Ra that are up to 0.1 lower for fluorescent lamps.
///
/// # Errors
/// [`RenditionError`] where the light has no visible power, is mainly monochromatic, which CIE 13.3 excludes, or has no temperature
/// from 1667 K to 25 000 K.
pub fn rendering_indices(
    light: &SpectralDistribution,
    standards: &Standards,
) -> Result<RenderingIndices, RenditionError> {
    let found = standards.test_colors.patches().len();
    if found != SAMPLES {
        return Err(RenditionError::Samples { found, expected: SAMPLES });
    }
    let sums = Sums::new(&standards.cie_1931, wavelengths(360, 780, 1))?;
    let (test, seen) = sums.unit(&held(light, &sums.nm))?;
    if let Some((index, _)) = monochromatic_band(&sums.luminance(&test)) {
        return Err(RenditionError::Monochromatic { nm: sums.nm[index] as u16 });
    }
    let color = uv(seen).ok_or(CctError::NoChromaticity)?;
    let cct = Robertson::as_printed(&standards.cie_1931)?.cct(color)?;
    let spectrum = if cct.temperature.get() < 5000.0 {
        reference::blackbody(cct.temperature, &sums.nm)
    } else {
        reference::daylight(&standards.daylight, cct.temperature, &sums.nm)?
    };
    let (ideal, white) = sums.unit(&spectrum)?;
    let white = uv(white).ok_or(CctError::NoChromaticity)?;
    let (from, to) = (Signals::of(color), Signals::of(white));
    let mut special = [0.0; SAMPLES];
    for (index, (patch, answer)) in standards.test_colors.patches().iter().zip(&mut special).enumerate() {
        let reflectance = smooth(&patch.measured, &sums.nm);
        let under = |light: &[f64]| sums.xyz(&reflectance.iter().zip(light).map(|(r, l)| r * l).collect::<Vec<_>>());
        let (seen, wanted) = (under(&test), under(&ideal));
        let undefined = RenditionError::Undefined { sample: index + 1 };
        let adapted = uv(seen).ok_or(undefined)?;
        let sample = uvw(Signals::of(adapted).adapted(from, to), seen.y, white);
        let reference = uvw(uv(wanted).ok_or(undefined)?, wanted.y, white);
        let [du, dv, dw] = [0, 1, 2].map(|i: usize| sample[i] - reference[i]);
        *answer = 100.0 - 4.6 * du.hypot(dv).hypot(dw);
        if !answer.is_finite() {
            return Err(undefined);
        }
    }
    let general = special[..8].iter().sum::<f64>() / 8.0;
    Ok(RenderingIndices { general, special, cct, distance: (color.u - white.u).hypot(color.v - white.v) })
}

fn uv(color: Xyz) -> Option<Uv60> {
    Some(color.uv_prime()?.uv60())
}

/// c and d of CIE 13.3, ratios of cone signals.
#[derive(Clone, Copy)]
struct Signals {
    c: f64,
    d: f64,
}

impl Signals {
    fn of(Uv60 { u, v }: Uv60) -> Self {
        Self { c: (4.0 - u - 10.0 * v) / v, d: (1.708 * v + 0.404 - 1.481 * u) / v }
    }

    /// Chromaticity after von Kries adaptation from one white to another.
    fn adapted(self, from: Self, to: Self) -> Uv60 {
        let (c, d) = (to.c / from.c * self.c, to.d / from.d * self.d);
        let divisor = 16.518 + 1.481 * c - d;
        Uv60 { u: (10.872 + 0.404 * c - 4.0 * d) / divisor, v: 5.52 / divisor }
    }
}

/// CIE 1964 U*, V*, W* of a chromaticity and Y (1 for a perfect diffuser).
fn uvw(Uv60 { u, v }: Uv60, y: f64, white: Uv60) -> [f64; 3] {
    let w = 25.0 * (100.0 * y).cbrt() - 17.0;
    [13.0 * w * (u - white.u), 13.0 * w * (v - white.v), w]
}
