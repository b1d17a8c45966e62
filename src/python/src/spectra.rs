//! Spectra from Python: anything with `wavelengths` and `values`.

use chromascope_core::spectral::{Primaries, Response, Sensor, SpectralDistribution};
use numpy::PyUntypedArrayMethods as _;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyTuple};
use spectral_file::Uncertainty;
use spectral_file::write::{Content, Format, Grid, Sheet, Trace, write};

use crate::arrays::{all_finite, numbers, refused, shape_text, slice};

/// Curves at common wavelengths.
#[derive(Debug)]
pub(crate) struct Spectra {
    pub(crate) name: Option<String>,
    columns: Vec<String>,
    wavelengths: Vec<f64>,
    /// Values of each curve.
    curves: Vec<Vec<f64>>,
    /// Standard uncertainties of each curve.
    uncertainties: Option<Vec<Vec<f64>>>,
}

impl Spectra {
    /// Spectra of an object with `wavelengths` in nanometers and `values` of shape (wavelengths,) or (wavelengths, curves), or of a pair
    /// of such arrays; none for other objects.
    pub(crate) fn of(argument: &str, given: &Bound<'_, PyAny>) -> PyResult<Option<Self>> {
        let field = |name: &str| match given.cast::<PyDict>() {
            Ok(fields) => fields.get_item(name),
            Err(_) => given.getattr_opt(name),
        };
        if let (Some(wavelengths), Some(values)) = (field("wavelengths")?, field("values")?) {
            let mut spectra = Self::new(argument, &wavelengths, &values)?;
            spectra.name = field("name")?.and_then(|name| name.extract().ok());
            // The labels of `colour`'s sets of curves have the place of columns.
            for names in ["columns", "labels"] {
                let named: Option<Vec<String>> = field(names)?.and_then(|names| names.extract().ok());
                spectra.columns = named.filter(|all| all.len() == spectra.curves.len()).unwrap_or(spectra.columns);
            }
            if let Some(standard) = field("standard_uncertainty")?.filter(|standard| !standard.is_none()) {
                let argument = format!("{argument}: standard_uncertainty");
                spectra.uncertainties = Some(curves(&argument, spectra.wavelengths.len(), &standard)?);
            }
            return Ok(Some(spectra));
        }
        let Ok(pair) = given.cast::<PyTuple>() else { return Ok(None) };
        let is_array = |part: &Bound<'_, PyAny>| {
            let is_other = part.is_instance_of::<PyString>() || part.is_instance_of::<PyDict>();
            !is_other && part.len().is_ok() && part.getattr_opt("wavelengths").is_ok_and(|field| field.is_none())
        };
        let is_pair = pair.len() == 2 && pair.iter().all(|part| is_array(&part));
        if is_pair { Ok(Some(Self::new(argument, &pair.get_item(0)?, &pair.get_item(1)?)?)) } else { Ok(None) }
    }

    /// Spectra of two arrays.
    pub(crate) fn new(argument: &str, wavelengths: &Bound<'_, PyAny>, values: &Bound<'_, PyAny>) -> PyResult<Self> {
        let wavelengths = wavelengths_nm(&format!("{argument}: wavelengths"), wavelengths)?;
        let curves = curves(&format!("{argument}: values"), wavelengths.len(), values)?;
        Ok(Self { name: None, columns: Vec::new(), wavelengths, curves, uncertainties: None })
    }

    /// Sensors of each three channels, the last one repeated where their number is no multiple; and their number.
    pub(crate) fn sensors(self, argument: &str, primaries: Primaries) -> PyResult<(Vec<Sensor>, usize)> {
        let count = self.curves.len();
        let mut curves = Vec::with_capacity(count + 2);
        for values in self.curves {
            let curve = SpectralDistribution::new(self.wavelengths.clone(), values);
            curves.push(curve.map_err(|error| refused(argument, error))?);
        }
        while !curves.len().is_multiple_of(3) {
            curves.push(curves[count - 1].clone());
        }
        let sensor = |three: &[SpectralDistribution]| {
            let three = [three[0].clone(), three[1].clone(), three[2].clone()];
            Sensor::new(primaries, three, Response::PerEnergy).map_err(|error| refused(argument, error))
        };
        Ok((curves.chunks_exact(3).map(sensor).collect::<PyResult<_>>()?, count))
    }

    /// The only curve.
    pub(crate) fn only(mut self, argument: &str) -> PyResult<SpectralDistribution> {
        match (self.curves.pop(), self.curves.len()) {
            (Some(values), 0) => {
                SpectralDistribution::new(self.wavelengths, values).map_err(|error| refused(argument, error))
            }
            (_, more) => Err(refused(argument, format!("{} curves; expected exactly one", more + 1))),
        }
    }

    /// A table that states what it holds.
    pub(crate) fn csv(&self, argument: &str, content: Content<'_>) -> PyResult<String> {
        let name = |index: usize| match (self.columns.get(index), content) {
            (Some(name), _) => name.clone(),
            (None, Content::Camera { .. }) if index < 3 => Primaries::Camera.channels()[index].to_owned(),
            _ => format!("{}", index + 1),
        };
        let names: Vec<String> = (0..self.curves.len()).map(name).collect();
        let standard = self.uncertainties.iter().flatten();
        let standard: Vec<Uncertainty> =
            standard.map(|standard| Uncertainty { standard: standard.clone(), coverage: 2.0 }).collect();
        let traces = self.curves.iter().enumerate().map(|(index, values)| Trace {
            name: &names[index],
            wavelengths_nm: &self.wavelengths,
            values,
            uncertainty: standard.get(index),
        });
        let traces: Vec<Trace<'_>> = traces.collect();
        let title = self.name.as_deref().unwrap_or(argument);
        let sheet = Sheet { title, content, curves: &traces, ..Sheet::default() };
        let written = write(&sheet, Format::CommentedCsv, Grid::Native).map_err(|error| refused(argument, error))?;
        Ok(written.text)
    }
}

/// Ascending wavelengths.
pub(crate) fn wavelengths_nm(argument: &str, given: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let array = numbers::<f64>(argument, given)?;
    if array.ndim() != 1 {
        let found = shape_text(array.shape());
        return Err(refused(argument, format!("expected one axis of wavelengths in nanometers, found {found}")));
    }
    let wavelengths = slice(&array).to_vec();
    all_finite(argument, &wavelengths)?;
    if wavelengths.len() < 2 || wavelengths[0] <= 0.0 || wavelengths.windows(2).any(|pair| pair[0] >= pair[1]) {
        return Err(refused(argument, "expected at least two ascending wavelengths in nanometers"));
    }
    Ok(wavelengths)
}

/// Columns of an array with a row for each wavelength.
fn curves(argument: &str, rows: usize, given: &Bound<'_, PyAny>) -> PyResult<Vec<Vec<f64>>> {
    let array = numbers::<f64>(argument, given)?;
    let count = match *array.shape() {
        [length] if length == rows => 1,
        [length, count] if length == rows && count > 0 => count,
        _ => {
            let found = shape_text(array.shape());
            return Err(refused(argument, format!("expected shape ({rows},) or ({rows}, curves), found {found}")));
        }
    };
    let values = slice(&array);
    all_finite(argument, values)?;
    Ok((0..count).map(|curve| values.iter().skip(curve).step_by(count).copied().collect()).collect())
}
