//! Data sets of the library, and files.

use std::sync::LazyLock;

use chromascope_core::query::{Direct, Query as _, Shared};
use chromascope_core::spectral::{GridSpectrum, Sensor};
use chromascope_core::units::Kelvin;
use chromascope_figure::Cell;
use chromascope_workbench::catalog::load::{LightQuery, SensorQuery};
use chromascope_workbench::catalog::names::find;
use chromascope_workbench::catalog::{Catalog, Entry};
use chromascope_workbench::cli::by_formula;
use chromascope_workbench::document::SetKind;
use chromascope_workbench::export::spectra;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::arrays::{apart, array, refused};
use crate::commands::{Call, loads};

static CATALOG: LazyLock<Catalog> = LazyLock::new(Catalog::built_in);

/// The set of some kinds that a typed name matches.
fn entry(argument: &str, kinds: &[SetKind], name: &str) -> PyResult<&'static Entry> {
    let label = kinds.last().map_or("", |kind| kind.label());
    let found = find(kinds.iter().flat_map(|kind| CATALOG.of_kind(*kind)), label, name);
    Ok(found.map_err(|error| refused(argument, error))?.entry)
}

/// A sensor of the library.
pub(crate) fn sensor(argument: &str, kinds: &[SetKind], name: &str) -> PyResult<Shared<Sensor>> {
    let place = entry(argument, kinds, name)?.place.clone();
    SensorQuery(place).answer(&Direct).map_err(|error| refused(argument, error))
}

/// A light of the library, or one by formula, on the grid.
pub(crate) fn light(name: &str) -> PyResult<GridSpectrum> {
    let kelvin = |kelvin| Kelvin::new(kelvin).map_err(|error| refused("light", error));
    let query = match by_formula(name).map_err(|reason| refused("light", reason))? {
        Some(("daylight", given)) => LightQuery::Daylight(kelvin(given)?),
        Some((_, given)) => LightQuery::BlackBody(kelvin(given)?),
        None => LightQuery::Set(entry("light", &[SetKind::Illuminant], name)?.place.clone()),
    };
    let light = query.answer(&Direct).map_err(|error| refused("light", error))?;
    Ok((*light.grid).clone())
}

/// All sets of a kind, or the one of a name.
fn sets<'py>(py: Python<'py>, kind: SetKind, name: Option<&str>) -> PyResult<Bound<'py, PyAny>> {
    if let Some(name) = name {
        return Ok(set(py, entry("name", &[kind], name)?)?.into_any());
    }
    let all = CATALOG.of_kind(kind).map(|entry| set(py, entry)).collect::<PyResult<Vec<_>>>()?;
    Ok(PyList::new(py, all)?.into_any())
}

/// A set with its source and terms; one curve has values of shape (wavelengths,), several (wavelengths, curves).
fn set<'py>(py: Python<'py>, entry: &Entry) -> PyResult<Bound<'py, PyDict>> {
    let table = apart(py, || spectra::table(entry, &Direct))?.map_err(|error| refused(&entry.name, error))?;
    let columns: Vec<&str> = table.keys().skip(1).collect();
    let number = |cell: &Cell| cell.number().unwrap_or(f64::NAN);
    let wavelengths: Vec<f64> = table.rows.iter().filter_map(|row| row.first()).map(number).collect();
    let values: Vec<f64> = table.rows.iter().flat_map(|row| row.iter().skip(1)).map(number).collect();
    let rows = wavelengths.len();
    let shape = if columns.len() == 1 { vec![rows] } else { vec![rows, columns.len()] };
    let fields = PyDict::new(py);
    fields.set_item("name", &entry.name)?;
    fields.set_item("columns", columns)?;
    fields.set_item("wavelengths", array(py, wavelengths, vec![rows])?)?;
    fields.set_item("values", array(py, values, shape)?)?;
    if let Some(header) = &entry.header {
        fields.set_item("quantity", &header.quantity)?;
        fields.set_item("unit", &header.unit)?;
        fields.set_item("source", &header.source)?;
        fields.set_item("license", &header.license)?;
        fields.set_item("notes", &header.notes)?;
    }
    Ok(fields)
}

/// Functions that list the sets of a kind.
macro_rules! lists {
    ($($(#[$doc:meta])* $name:ident = $kind:ident;)*) => {$(
        $(#[$doc])*
        ///
        /// Without `name`, all of them as a list; with it, the one that the name matches, as on the command line. A set is a dict with
        /// `name`, `wavelengths` in nanometers (n,), `values` (n,) or (n, curves), `columns` (names of the curves), `quantity`, `unit`,
        /// `source`, `license` and `notes`. Where a curve has no sample its value is NaN.
        #[pyfunction]
        #[pyo3(signature = (name = None))]
        pub(crate) fn $name<'py>(py: Python<'py>, name: Option<&str>) -> PyResult<Bound<'py, PyAny>> {
            sets(py, SetKind::$kind, name)
        }
    )*};
}

lists! {
    /// Spectral sensitivities of cameras: red, green, blue.
    cameras = Camera;
    /// Color matching functions and cone fundamentals of observers.
    observers = Observer;
    /// Reflectances of charts' patches.
    charts = Chart;
    /// Spectral power of lights.
    illuminants = Illuminant;
    /// Transmittances of filters.
    filters = Filter;
    /// Single reflectances.
    materials = Material;
}

/// Curves of a file of any format that the program reads, or of all files of a folder.
///
/// A curve is a dict with `name`, `file`, `kind`, `quantity`, `unit`, `wavelengths` in nanometers (n,), `values` (n,),
/// `standard_uncertainty` (n,) or None, `coverage_factor`, `missing` (blank cells), and what was decided for the whole file: `decisions`
/// (dicts with `what`, `value`, `certainty`, `why`), `warnings` (dicts with `line`, `text`) and `reading`. `channels` are the places of
/// a camera's red, green and blue. Keywords override decisions: `role`, `values`, `unit`, `delimiter`, `decimal_mark`, `orientation`,
/// `wavelength_column`, `part`, `per`, `reader`, `raw`; and `step` resamples, with `average`. Raises `ValueError` for what cannot be read.
#[pyfunction]
#[pyo3(signature = (path, **options))]
pub(crate) fn open<'py>(
    py: Python<'py>,
    path: &Bound<'py, PyAny>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyList>> {
    let mut call = Call::new(&["inspect"])?;
    call.keywords(options)?;
    call.switch("json");
    call.place(path, None)?;
    curves(py, &call.run(py)?.text()?)
}

/// Curves of a report in JSON.
pub(crate) fn curves<'py>(py: Python<'py>, json: &str) -> PyResult<Bound<'py, PyList>> {
    let report = loads(py, json)?;
    let files = if report.is_instance_of::<PyList>() { report } else { PyList::new(py, [report])?.into_any() };
    let all = PyList::empty(py);
    let numpy = py.import("numpy")?;
    for file in files.try_iter()? {
        let file = file?.cast_into::<PyDict>()?;
        let curves = file.get_item("curves")?.ok_or_else(|| PyValueError::new_err("no curves"))?;
        file.del_item("curves")?;
        for curve in curves.try_iter()? {
            let curve = curve?.cast_into::<PyDict>()?;
            for (key, name) in [
                ("wavelengths_nm", "wavelengths"),
                ("values", "values"),
                ("standard_uncertainty", "standard_uncertainty"),
            ] {
                let Some(numbers) = curve.get_item(key)?.filter(|numbers| !numbers.is_none()) else { continue };
                curve.del_item(key)?;
                curve.set_item(name, numpy.call_method1("asarray", (numbers, "float64"))?)?;
            }
            curve.update(file.as_mapping())?;
            all.append(curve)?;
        }
    }
    Ok(all)
}
