//! Color fidelity and gamut of ANSI/IES TM-30-20, whose Rf is that of CIE 224:2017.

use super::reference;
use super::standards::{RenditionError, Standards, Sums, smooth, wavelengths, within};
use crate::colorimetry::ciecam02::{Cam02Ucs, Ciecam02};
use crate::light::Cct;
use crate::spectral::SpectralDistribution;

/// Number of color evaluation samples.
pub const SAMPLES: usize = 99;
/// Number of hue bins, each 22.5° wide.
pub const BINS: usize = 16;

/// Fidelity and gamut of a light.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorFidelity {
    /// Fidelity index Rf, above 0; the formula's 10 ln(1 + e¹⁰) = 100.0005 for no difference at all.
    pub fidelity: f64,
    /// Gamut index Rg: area of the mean colors of the hue bins, 100 for that of the reference.
    pub gamut: f64,
    /// Fidelity of each sample.
    pub samples: Vec<f64>,
    /// The hue bins, from 0°.
    pub bins: Vec<HueBin>,
    /// Correlated color temperature of the reference illuminant, and the light's Duv, over 360–780 nm.
    pub cct: Cct,
}

/// Mean color of the samples of one range of hues.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HueBin {
    /// Number of samples.
    pub count: usize,
    /// Mean a′, b′ under the light.
    pub test: [f64; 2],
    /// Mean a′, b′ under the reference illuminant.
    pub reference: [f64; 2],
    /// Local fidelity Rf,h.
    pub fidelity: f64,
    /// Local chroma shift Rcs,h as a fraction: positive for colors made more saturated.
    pub chroma_shift: f64,
    /// Local hue shift Rhs,h in radians.
    pub hue_shift: f64,
}

/// Computes fidelity and gamut of a light.
///
/// ```text
/// Rf = 10 ln(1 + exp((100 − 6.73 mean ΔE′) / 10)),   ΔE′ in CAM02-UCS
/// Rg = 100 A(test) / A(reference),   A the area of the 16 mean colors
/// ```
/// CIE 1964 observer, complete adaptation. The reference illuminant is that of [`super::reference::reference_illuminant`]. Sums from
/// 380 to 780 nm: at 5 nm where the light's table is at 5 nm, as the standards allow, else at 1 nm with the light linear between its
/// wavelengths. The two differ by up to 0.1 in Rf and Rg for fluorescent lamps.
///
/// # Errors
/// [`RenditionError`] where the light has no visible power or no temperature from 1000 K to 25 000 K.
pub fn color_fidelity(light: &SpectralDistribution, standards: &Standards) -> Result<ColorFidelity, RenditionError> {
    let found = standards.evaluation_colors.patches().len();
    if found != SAMPLES {
        return Err(RenditionError::Samples { found, expected: SAMPLES });
    }
    let nm = wavelengths(380, 780, step(light));
    let two = Sums::new(&standards.cie_1931, nm.clone())?;
    let ten = Sums::new(&standards.cie_1964, nm)?;
    let table = within(light, &two.nm);
    let cct = reference::nearest(standards, two.unit(&table)?.1)?;
    let ideal = reference::mixed(standards, cct.temperature, &two)?;
    let reflectances: Vec<Vec<f64>> =
        standards.evaluation_colors.patches().iter().map(|patch| smooth(&patch.measured, &two.nm)).collect();
    let tests = colors(&ten, &table, &reflectances)?;
    let references = colors(&ten, &ideal, &reflectances)?;
    let shifts: Vec<f64> = tests.iter().zip(&references).map(|(a, b)| a.distance(*b)).collect();
    let bins = (0..BINS).map(|bin| hue_bin(bin, &tests, &references, &shifts)).collect::<Result<Vec<_>, _>>()?;
    let mean = shifts.iter().sum::<f64>() / SAMPLES as f64;
    Ok(ColorFidelity {
        fidelity: fidelity(mean),
        gamut: 100.0 * area(&bins, |bin| bin.test) / area(&bins, |bin| bin.reference),
        samples: shifts.into_iter().map(fidelity).collect(),
        bins,
        cct,
    })
}

/// Step of the sums in nanometers.
fn step(light: &SpectralDistribution) -> u16 {
    let five = light.uniform_step_nm().is_some_and(|step| (step - 5.0).abs() < 1e-9);
    if five && light.range_nm()[0] % 5.0 == 0.0 { 5 } else { 1 }
}

fn fidelity(difference: f64) -> f64 {
    10.0 * ((100.0 - 6.73 * difference) / 10.0).exp().ln_1p()
}

fn colors(sums: &Sums, light: &[f64], reflectances: &[Vec<f64>]) -> Result<Vec<Cam02Ucs>, RenditionError> {
    let (light, white) = sums.unit(light)?;
    let model = Ciecam02::new(white).ok_or(RenditionError::Undefined { sample: 1 })?;
    let mut product = vec![0.0; light.len()];
    let color = |(index, reflectance): (usize, &Vec<f64>)| {
        product.iter_mut().zip(reflectance).zip(&light).for_each(|((p, r), l)| *p = r * l);
        model.ucs(sums.xyz(&product)).ok_or(RenditionError::Undefined { sample: index + 1 })
    };
    reflectances.iter().enumerate().map(color).collect()
}

fn hue_bin(bin: usize, tests: &[Cam02Ucs], references: &[Cam02Ucs], shifts: &[f64]) -> Result<HueBin, RenditionError> {
    let is_here = |color: &Cam02Ucs| (color.hue / 22.5) as usize % BINS == bin;
    let here: Vec<usize> = (0..references.len()).filter(|&i| is_here(&references[i])).collect();
    let mean = |of: &dyn Fn(usize) -> f64| here.iter().map(|&i| of(i)).sum::<f64>() / here.len() as f64;
    if here.is_empty() {
        return Err(RenditionError::EmptyBin { bin: bin + 1 });
    }
    let test = [mean(&|i| tests[i].a), mean(&|i| tests[i].b)];
    let reference = [mean(&|i| references[i].a), mean(&|i| references[i].b)];
    let (sin, cos) = (22.5 * bin as f64 + 11.25).to_radians().sin_cos();
    let chroma = reference[0].hypot(reference[1]);
    let [a, b] = [test[0] - reference[0], test[1] - reference[1]];
    Ok(HueBin {
        count: here.len(),
        test,
        reference,
        fidelity: fidelity(mean(&|i| shifts[i])),
        chroma_shift: (a * cos + b * sin) / chroma,
        hue_shift: (b * cos - a * sin) / chroma,
    })
}

/// Area of the polygon of the bins' mean colors.
fn area(bins: &[HueBin], color: impl Fn(&HueBin) -> [f64; 2]) -> f64 {
    let next = bins.iter().cycle().skip(1);
    let cross = |(a, b): (&HueBin, &HueBin)| {
        let ([x0, y0], [x1, y1]) = (color(a), color(b));
        0.5 * (x0 * y1 - y0 * x1)
    };
    bins.iter().zip(next).map(cross).sum()
}
