//! Colorimetry of arrays.

use std::sync::OnceLock;

use chromascope_core::camera::LocusEvaluator;
use chromascope_core::camera::batch::{Batch, Sample};
use chromascope_core::colorimetry::{Lab, Metric, Stimulus, Uv60, UvPrime, Xy, Xyz, delta_e_2000_into};
use chromascope_core::light::{CctError, PlanckianLocus, RadiationConstants};
use chromascope_core::spectral::grid::{COUNT, wavelength_nm};
use chromascope_core::spectral::{GridSpectrum, Primaries, Quantity, Sensor};
use chromascope_core::units::Kelvin;
use chromascope_workbench::document::{CIE_1931, SetKind};
use numpy::{Element, PyArrayMethods as _, PyUntypedArrayMethods as _};
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::arrays::{all_finite, apart, array, coordinates, empty, numbers, refused, shape_text, slice};
use crate::sets;
use crate::spectra::{Spectra, wavelengths_nm};

/// Difference of colors in CIE L*a*b*, `lab2` from `lab1`.
///
/// `lab1` and `lab2` have shapes (…, 3), equal ones, or one of them is (3,). `formula` is `delta-e2000` (CIE 142-2001; relative error
/// below 2e-15), `delta-e1976` or `delta-e1994` (graphic arts; `lab1` is the reference). Returns shape (…).
#[pyfunction]
#[pyo3(signature = (lab1, lab2, formula = "delta-e2000"))]
pub(crate) fn delta_e<'py>(
    py: Python<'py>,
    lab1: &Bound<'py, PyAny>,
    lab2: &Bound<'py, PyAny>,
    formula: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let metrics = || Metric::ALL.iter().filter(|metric| metric.needs_adopted_white());
    let metric = metrics().find(|metric| metric.id == formula).ok_or_else(|| {
        let names = metrics().map(|metric| metric.id).collect::<Vec<_>>().join(", ");
        refused("formula", format!("no formula is named \"{formula}\"; there are {names}"))
    })?;
    let (first, shape) = coordinates("lab1", lab1, 3)?;
    let (second, other) = coordinates("lab2", lab2, 3)?;
    let shape = match (shape.as_slice(), other.as_slice()) {
        (a, b) if a == b => shape,
        (_, []) => shape,
        ([], _) => other,
        (a, b) => {
            let reason = format!("the shapes before the last axis are {} and {}", shape_text(a), shape_text(b));
            return Err(refused("lab1, lab2", reason));
        }
    };
    let count = shape.iter().product();
    let (first, second) = (slice(&first), slice(&second));
    let found = apart(py, || {
        let mut found = vec![0.0; count];
        // In parts that stay in the cache.
        for (part, found) in found.chunks_mut(PART).enumerate() {
            let [firsts, seconds] = [first, second].map(|numbers| labs(numbers, part * PART, found.len()));
            if *metric == Metric::DELTA_E_2000 {
                delta_e_2000_into(&firsts, &seconds, found);
                continue;
            }
            let of = |lab| Stimulus { xyz: Xyz::new(0.0, 0.0, 0.0), lab: Some(lab) };
            for ((found, first), second) in found.iter_mut().zip(firsts).zip(seconds) {
                *found = metric.between(&of(first), &of(second)).unwrap_or(f64::NAN);
            }
        }
        found
    })?;
    array(py, found, shape)
}

/// Pairs of colors that are converted together.
const PART: usize = 1 << 15;

/// Colors of so many triples from a place on; one stands for all.
fn labs(numbers: &[f64], start: usize, count: usize) -> Vec<Lab> {
    let lab = |&[l, a, b]: &[f64; 3]| Lab { l, a, b };
    match numbers.as_chunks::<3>().0 {
        [only] => vec![lab(only); count],
        colors => colors[start..start + count].iter().map(lab).collect(),
    }
}

/// A chromaticity diagram's two coordinates.
#[derive(Clone, Copy)]
enum Diagram {
    Xy,
    UvPrime,
}

impl Diagram {
    fn named(name: &str) -> PyResult<Self> {
        match name {
            "xy" => Ok(Self::Xy),
            "uv-prime" => Ok(Self::UvPrime),
            _ => Err(refused("diagram", format!("no diagram is named \"{name}\"; there are xy, uv-prime"))),
        }
    }

    /// Chromaticity of tristimulus values; NaN where it is undefined.
    fn of(self, xyz: Xyz) -> [f64; 2] {
        let found = match self {
            Self::Xy => xyz.chromaticity().map(|xy| [xy.x, xy.y]),
            Self::UvPrime => xyz.uv_prime().map(|uv| [uv.u, uv.v]),
        };
        found.unwrap_or([f64::NAN; 2])
    }

    /// Coordinates of 1960, in which blackbodies are nearest.
    fn uv60(self, [a, b]: [f64; 2]) -> Option<Uv60> {
        let uv = match self {
            Self::Xy => Xy { x: a, y: b }.uv_prime()?,
            Self::UvPrime => UvPrime { u: a, v: b },
        };
        Some(uv.uv60())
    }
}

/// Correlated color temperature in kelvins, and Duv, the distance from the Planckian locus in u, v (positive above it).
///
/// The nearest blackbody in the CIE 1960 diagram for the CIE 1931 2° observer (380 to 780 nm), from 1000 to 20000 K and up to
/// |Duv| = 0.05; error below 2e-9 K and 1e-15. `chromaticities` has shape (…, 2), in the `diagram` `xy` or `uv-prime`. Returns
/// (CCT, Duv), each of shape (…); NaN where there is none.
#[pyfunction]
#[pyo3(signature = (chromaticities, diagram = "xy"))]
pub(crate) fn cct_duv<'py>(
    py: Python<'py>,
    chromaticities: &Bound<'py, PyAny>,
    diagram: &str,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
    let diagram = Diagram::named(diagram)?;
    let (colors, shape) = coordinates("chromaticities", chromaticities, 2)?;
    let colors = slice(&colors);
    let locus = locus()?;
    let (cct, duv) = apart(py, || {
        // A color far beyond all blackbodies stands for one without a chromaticity.
        let uv = |&color: &[f64; 2]| diagram.uv60(color).unwrap_or(Uv60 { u: 100.0, v: 100.0 });
        let colors: Vec<Uv60> = colors.as_chunks::<2>().0.iter().map(uv).collect();
        let mut found = vec![Err(CctError::NoChromaticity); colors.len()];
        locus.ccts_into(&colors, &mut found);
        found.iter().map(|found| found.map_or((f64::NAN, f64::NAN), |cct| (cct.temperature.get(), cct.duv))).unzip()
    })?;
    Ok((array(py, cct, shape.clone())?, array(py, duv, shape)?))
}

/// Locus of the CIE 1931 observer.
fn locus() -> PyResult<&'static PlanckianLocus> {
    static LOCUS: OnceLock<PlanckianLocus> = OnceLock::new();
    if let Some(locus) = LOCUS.get() {
        return Ok(locus);
    }
    let observer = sets::sensor("observer", &[SetKind::Observer], CIE_1931)?;
    let locus = PlanckianLocus::new(&observer, RadiationConstants::Paper);
    let locus = locus.map_err(|error| refused("observer", error))?;
    Ok(LOCUS.get_or_init(|| locus))
}

/// Chromaticities of tristimulus values: x = X / (X + Y + Z), y = Y / (X + Y + Z), or u′ = 4X / (X + 15Y + 3Z), v′ = 9Y / (X + 15Y + 3Z).
///
/// `xyz` has shape (…, 3), `diagram` is `xy` or `uv-prime`. Returns shape (…, 2); NaN where they are undefined.
#[pyfunction]
#[pyo3(signature = (xyz, diagram = "xy"))]
pub(crate) fn chromaticities<'py>(
    py: Python<'py>,
    xyz: &Bound<'py, PyAny>,
    diagram: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let diagram = Diagram::named(diagram)?;
    let (colors, mut shape) = coordinates("xyz", xyz, 3)?;
    let colors = slice(&colors);
    let color = |&[x, y, z]: &[f64; 3]| diagram.of(Xyz::new(x, y, z));
    let found = apart(py, || colors.as_chunks::<3>().0.iter().flat_map(color).collect())?;
    shape.push(2);
    array(py, found, shape)
}

/// Signals of blackbodies: `C_c(T) = ∫ S_c(λ) M(λ, T) dλ` over 380 to 780 nm, up to a factor common to the three channels of a
/// temperature.
///
/// `temperatures` in kelvins, 1 to 1e15, of shape (…); `sensitivities` a name of the library, an object with `wavelengths` and `values`, or
/// values of shape (wavelengths, 3) with `wavelengths_nm`. Matching functions keep their negative lobes, `quantity` is `camera` (negative
/// values count as zero) or `matching-functions`; a name has its own. Returns shape (…, 3): `chromaticities` makes a locus of it. Error
/// below 1e-11 of the largest signal.
#[pyfunction]
#[pyo3(signature = (sensitivities, wavelengths_nm, temperatures, quantity = "camera"))]
pub(crate) fn planckian_locus<'py>(
    py: Python<'py>,
    sensitivities: &Bound<'py, PyAny>,
    wavelengths_nm: Option<&Bound<'py, PyAny>>,
    temperatures: &Bound<'py, PyAny>,
    quantity: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let (sensors, count) = sensors(sensitivities, wavelengths_nm, quantity)?;
    let [sensor] = sensors.as_slice() else {
        return Err(refused("sensitivities", format!("{count} curves; expected three")));
    };
    if count != 3 {
        return Err(refused("sensitivities", format!("{count} curves; expected three")));
    }
    let given = numbers::<f64>("temperatures", temperatures)?;
    let mut shape = given.shape().to_vec();
    let kelvin = |&value: &f64| {
        let usable = Kelvin::new(value).ok().filter(|kelvin| (1.0..=1e15).contains(&kelvin.get()));
        let reason = || format!("{value} is not a temperature; use kelvins from 1 to 1e15");
        usable.ok_or_else(|| refused("temperatures", reason()))
    };
    let temperatures: Vec<Kelvin> = slice(&given).iter().map(kelvin).collect::<PyResult<_>>()?;
    let found = apart(py, || {
        let evaluator = LocusEvaluator::new(sensor, RadiationConstants::Paper);
        temperatures.iter().flat_map(|temperature| evaluator.raw(*temperature)).collect()
    })?;
    shape.push(3);
    array(py, found, shape)
}

/// Sensors of a name or of curves.
fn sensors(
    given: &Bound<'_, PyAny>,
    wavelengths: Option<&Bound<'_, PyAny>>,
    quantity: &str,
) -> PyResult<(Vec<Sensor>, usize)> {
    const ARGUMENT: &str = "sensitivities";
    let primaries = match quantity {
        "camera" => Primaries::Camera,
        "matching-functions" => Primaries::Xyz,
        _ => {
            let reason = format!("\"{quantity}\" is no quantity; there are camera, matching-functions");
            return Err(refused("quantity", reason));
        }
    };
    if let Ok(name) = given.cast::<PyString>() {
        let sensor = sets::sensor(ARGUMENT, &[SetKind::Observer, SetKind::Camera], name.to_str()?)?;
        return Ok((vec![(*sensor).clone()], 3));
    }
    let spectra = match wavelengths {
        Some(wavelengths) => Some(Spectra::new(ARGUMENT, wavelengths, given)?),
        None => Spectra::of(ARGUMENT, given)?,
    };
    let expected = "expected a name, an object with wavelengths and values, or values with their wavelengths";
    spectra.ok_or_else(|| refused(ARGUMENT, expected))?.sensors(ARGUMENT, primaries)
}

/// Responses to many spectra: `I_c = ∫ S(λ) L(λ) C_c(λ) dλ` over 380 to 780 nm, by the 1 nm sum of the program.
///
/// `spectra` has shape (…, wavelengths), `wavelengths_nm` shape (wavelengths,): they count as linear between their samples and constant
/// beyond. `sensitivities` is a name of the library or an object with `wavelengths` and `values` (wavelengths, channels) at
/// wavelengths of its own. `light`, if any, is the name of a set, `daylight:K`, `blackbody:K` or such an object. Returns shape
/// (…, channels). Arrays of `float32` are computed in, and give, `float32`.
#[pyfunction]
#[pyo3(signature = (spectra, wavelengths_nm, sensitivities, light = None, quantity = "camera"))]
pub(crate) fn responses<'py>(
    spectra: &Bound<'py, PyAny>,
    wavelengths_nm: &Bound<'py, PyAny>,
    sensitivities: &Bound<'py, PyAny>,
    light: Option<&Bound<'py, PyAny>>,
    quantity: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let wavelengths = self::wavelengths_nm("wavelengths_nm", wavelengths_nm)?;
    let (sensors, channels) = sensors(sensitivities, None, quantity)?;
    let light = light.map(grid_light).transpose()?;
    let curves = curves(&wavelengths, &sensors, channels, light.as_ref());
    let is_single = spectra.getattr_opt("dtype")?.is_some_and(|kind| kind.eq("float32").unwrap_or(false));
    if is_single {
        let curves: Vec<f32> = curves.iter().map(|value| *value as f32).collect();
        product::<f32>(spectra, wavelengths.len(), &curves)
    } else {
        product::<f64>(spectra, wavelengths.len(), &curves)
    }
}

/// A light on the grid.
fn grid_light(given: &Bound<'_, PyAny>) -> PyResult<GridSpectrum> {
    if let Ok(name) = given.cast::<PyString>() {
        return sets::light(name.to_str()?);
    }
    let spectra = Spectra::of("light", given)?;
    let spectra =
        spectra.ok_or_else(|| refused("light", "expected a name or an object with wavelengths and values"))?;
    Ok(GridSpectrum::resample(&spectra.only("light")?, Quantity::Light))
}

/// Curves whose sums of products with samples are the integrals of the sensors over what the samples are linear between: one for each
/// channel, one after the other.
fn curves(wavelengths: &[f64], sensors: &[Sensor], channels: usize, light: Option<&GridSpectrum>) -> Vec<f64> {
    let count = wavelengths.len();
    let mut curves = vec![0.0; channels * count];
    let mut above = 1;
    for index in 0..COUNT {
        let nm = wavelength_nm(index).clamp(wavelengths[0], wavelengths[count - 1]);
        above += wavelengths[above..].iter().take_while(|known| **known < nm).count();
        let share = (nm - wavelengths[above - 1]) / (wavelengths[above] - wavelengths[above - 1]);
        let power = light.map_or(1.0, |light| light.values()[index]);
        for (channel, curve) in curves.chunks_exact_mut(count).enumerate() {
            let weight = sensors[channel / 3].weighted(channel % 3)[index] * power;
            curve[above - 1] += (1.0 - share) * weight;
            curve[above] += share * weight;
        }
    }
    curves
}

/// Numbers of a batch, which holds sums that are not finite as zero.
trait Number: Sample + Element + Send + Sync {
    fn number(self) -> f64;
}

impl Number for f32 {
    fn number(self) -> f64 {
        self.into()
    }
}

impl Number for f64 {
    fn number(self) -> f64 {
        self
    }
}

/// Spectra by curves, refusing samples that are not finite.
fn product<'py, T: Number>(given: &Bound<'py, PyAny>, length: usize, curves: &[T]) -> PyResult<Bound<'py, PyAny>> {
    const ARGUMENT: &str = "spectra";
    let spectra = numbers::<T>(ARGUMENT, given)?;
    let Some((_, before)) = spectra.shape().split_last().filter(|(last, _)| **last == length) else {
        let found = shape_text(spectra.shape());
        return Err(refused(
            ARGUMENT,
            format!("expected shape (…, {length}), as there are wavelengths; found {found}"),
        ));
    };
    let mut shape = before.to_vec();
    let batch = Batch::new(curves, length).map_err(|error| refused("sensitivities", error))?;
    shape.push(batch.channels());
    let found = empty::<T>(given.py(), shape)?;
    {
        let mut places = found.readwrite();
        let (samples, found) = (slice(&spectra), places.as_slice_mut()?);
        apart(given.py(), || {
            batch.responses_into(samples, found).map_err(|error| refused(ARGUMENT, error))?;
            // A response of zero may stand for one that is not finite: only then are samples looked at.
            let channels = batch.channels();
            for (samples, answers) in samples.chunks_exact(length).zip(found.chunks_exact(channels)) {
                if answers.iter().any(|answer| answer.number() == 0.0) {
                    all_finite(ARGUMENT, &samples.iter().map(|sample| sample.number()).collect::<Vec<_>>())?;
                }
            }
            Ok::<_, PyErr>(())
        })??;
    }
    Ok(found.into_any())
}
