//! Commands whose answers are objects.

use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList, PyTuple};

use crate::commands::{Call, loads};
use crate::sets::curves;

/// Runs a command of the program, `run("compare", camera="Nikon D70", format="csv")`, and returns what it would print.
///
/// `arguments` stand by their place, keywords are options. Files that the command writes (`out=…`) are written.
#[pyfunction]
#[pyo3(signature = (command, *arguments, **options))]
pub(crate) fn run(
    py: Python<'_>,
    command: &str,
    arguments: &Bound<'_, PyTuple>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<String> {
    let mut call = Call::new(&command.split(' ').collect::<Vec<_>>())?;
    call.keywords(options)?;
    for argument in arguments {
        call.place(&argument, None)?;
    }
    call.run(py)?.text()
}

/// Figures of merit of cameras, as `chromascope compare --format json`: a dict with `conditions`, `metrics`, and `cameras`, each with
/// `values` by the metric's id: `value`, its standard `uncertainty`, `budget` and `rank`, or the `reason` for none.
///
/// `cameras` are names, files or objects with `wavelengths` (n,) and `values` (n, 3); without any, all of the library. Options:
/// `metrics`, `sort`, `illuminant`, `filter`, `chart`, `reference`, `correction`, `training`, `temperature`, `full_well`, ….
#[pyfunction]
#[pyo3(signature = (*cameras, **options))]
pub(crate) fn metrics<'py>(
    py: Python<'py>,
    cameras: &Bound<'py, PyTuple>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let mut call = Call::new(&["compare"])?;
    call.keywords(options)?;
    for camera in cameras {
        call.named("camera", &camera)?;
    }
    call.option("format", "json");
    loads(py, &call.run(py)?.text()?)
}

/// Color correction of a camera: XYZ = M · RGB of balanced signals, fitted under a light, as `chromascope matrix --format json`.
///
/// `camera` and `illuminant` are names, files or objects with `wavelengths` and `values`. Returns a dict with `lights`, each with
/// `xyz_from_rgb` (3, 3), `errors`, `dng` (`forward_matrix`, `color_matrix`, `neutral`), and `idt` (`aces_from_rgb`, `balance`). Options:
/// `fit`, `training`, `weights`, `second_illuminant`, `filter`, `fit_to`, `neutral`, ….
#[pyfunction]
#[pyo3(signature = (camera, illuminant, **options))]
pub(crate) fn matrix<'py>(
    py: Python<'py>,
    camera: &Bound<'py, PyAny>,
    illuminant: &Bound<'py, PyAny>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let text = fitted(py, (camera, illuminant), "json", options)?.text()?;
    let found = loads(py, &text)?;
    let numpy = py.import("numpy")?;
    let as_array = |of: &Bound<'py, PyAny>, key: &str| -> PyResult<()> {
        let Ok(of) = of.cast::<PyDict>() else { return Ok(()) };
        match of.get_item(key)?.filter(|numbers| !numbers.is_none()) {
            Some(numbers) => of.set_item(key, numpy.call_method1("asarray", (numbers, "float64"))?),
            None => Ok(()),
        }
    };
    for light in found.get_item("lights")?.try_iter()? {
        let light = light?;
        as_array(&light, "xyz_from_rgb")?;
        as_array(&light, "adopted_white")?;
        for key in ["forward_matrix", "color_matrix", "neutral"] {
            as_array(&light.get_item("dng")?, key)?;
        }
    }
    for key in ["aces_from_rgb", "balance"] {
        as_array(&found.get_item("idt")?, key)?;
    }
    Ok(found)
}

/// Profile of a camera as bytes: `form` is `dcp`, `icc`, `clf`, or `dng` and `text` for text. Arguments and options as of `matrix`; `icc_version`.
#[pyfunction]
#[pyo3(signature = (camera, illuminant, form = "dcp", **options))]
pub(crate) fn profile<'py>(
    py: Python<'py>,
    camera: &Bound<'py, PyAny>,
    illuminant: &Bound<'py, PyAny>,
    form: &str,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyBytes>> {
    Ok(PyBytes::new(py, &fitted(py, (camera, illuminant), form, options)?.bytes()))
}

fn fitted(
    py: Python<'_>,
    (camera, illuminant): (&Bound<'_, PyAny>, &Bound<'_, PyAny>),
    form: &str,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<crate::commands::Answer> {
    let mut call = Call::new(&["matrix"])?;
    call.keywords(options)?;
    call.named("illuminant", illuminant)?;
    call.option("format", form);
    call.place(camera, Some("camera"))?;
    call.run(py)
}

/// Indices of lights, as `chromascope light --format json`: a list of dicts with `light`, `indices` (`cct_k`, `duv`, `ra`, `r1` to `r14`, `rf`,
/// `rg`, `ssi`, …), `hue_bins`, `consistency` of the cameras, `cautions`, and `undefined`, the reasons for None.
///
/// `lights` are names, files, `daylight:K`, `blackbody:K` or objects with `wavelengths` and `values`. Options: `filter`, `ssi_reference`,
/// `camera`, `chart`, ….
#[pyfunction]
#[pyo3(signature = (*lights, **options))]
pub(crate) fn light<'py>(
    py: Python<'py>,
    lights: &Bound<'py, PyTuple>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let mut call = Call::new(&["light"])?;
    call.keywords(options)?;
    for light in lights {
        call.place(&light, Some("illuminant"))?;
    }
    call.option("format", "json");
    loads(py, &call.run(py)?.text()?)
}

/// Planckian loci of sensors, as `chromascope locus`: a dict of columns (`sensor`, `temperature_k`, `x`, `y`, `u_prime`, `v_prime`, `distance_xy`,
/// `cct_error_k`, …), arrays with NaN for undefined values, or lists of text.
///
/// Options: `camera`, `observer`, `temperatures` in kelvins, or `from_`, `to`, `count`; `reference`, `illuminant`, `transform`, ….
#[pyfunction]
#[pyo3(signature = (**options))]
pub(crate) fn locus<'py>(py: Python<'py>, options: Option<&Bound<'py, PyDict>>) -> PyResult<Bound<'py, PyDict>> {
    columns_of(py, "locus", options)
}

/// Colors of a chart's patches through sensors, as `chromascope patches`: a dict of columns (`sensor`, `patch`, `r`, `g`, `b`, `x_tristimulus`,
/// `x`, `y`, `lab_l`, `delta_e_2000`, …), arrays with NaN for undefined values, or lists of text.
///
/// Options: `camera`, `observer`, `chart`, `illuminant`, `white_balance`, `reference`, `transform`, `radiance`, ….
#[pyfunction]
#[pyo3(signature = (**options))]
pub(crate) fn patches<'py>(py: Python<'py>, options: Option<&Bound<'py, PyDict>>) -> PyResult<Bound<'py, PyDict>> {
    columns_of(py, "patches", options)
}

fn columns_of<'py>(
    py: Python<'py>,
    command: &'static str,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut call = Call::new(&[command])?;
    call.keywords(options)?;
    columns(py, &call.run(py)?.text()?)
}

/// Columns of a table in CSV. One of numbers alone is an array.
fn columns<'py>(py: Python<'py>, csv: &str) -> PyResult<Bound<'py, PyDict>> {
    let text = py.import("io")?.call_method1("StringIO", (csv, ""))?;
    let mut rows = py.import("csv")?.call_method1("reader", (text,))?.try_iter()?;
    let heads: Vec<String> = rows.next().ok_or_else(|| PyValueError::new_err("no table"))??.extract()?;
    let rows: Vec<Vec<String>> = rows.map(|row| row?.extract()).collect::<PyResult<_>>()?;
    let columns = PyDict::new(py);
    for (at, head) in heads.iter().enumerate() {
        let cells = || rows.iter().filter_map(|row| row.get(at));
        let is_name = ["sensor", "patch"].contains(&head.as_str());
        let number = |cell: &String| if cell.is_empty() { Some(f64::NAN) } else { cell.parse().ok() };
        match cells().map(number).collect::<Option<Vec<f64>>>().filter(|_| !is_name) {
            Some(numbers) => columns.set_item(head, PyArray1::from_vec(py, numbers))?,
            None => columns.set_item(head, cells().collect::<Vec<_>>())?,
        }
    }
    Ok(columns)
}

/// Cameras ranked by how well they explain recorded raw values of patches, as `chromascope identify --format json`.
///
/// `recorded` is a file, a picture, or an array (patches, 3) of linear raw red, green, blue in the order of the `chart`. Options: `chart`,
/// `illuminant`, `camera`, `clip`, `black`, `hold`, ….
#[pyfunction]
#[pyo3(signature = (recorded, **options))]
pub(crate) fn identify<'py>(
    py: Python<'py>,
    recorded: &Bound<'py, PyAny>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let mut call = Call::new(&["identify"])?;
    call.keywords(options)?;
    call.option("format", "json");
    call.raw(recorded)?;
    loads(py, &call.run(py)?.text()?)
}

/// Sensitivities of a camera from what it recorded of a chart, with uncertainties, as `chromascope recover chart`.
///
/// `recorded` is an array (patches, 3) of linear raw red, green, blue in the order of the `chart`, a file, a picture of a chart, or a list
/// of such, one for each light. Returns a dict with `name`, `wavelengths` in nanometers (n,), `values` (n, 3) per energy, `standard_uncertainty` (n, 3) and `report`,
/// the command's text; it is taken as a camera by the other functions, whose ± is then its own. Options: `chart`, `illuminant`, `title`,
/// `black`, `clip`, `noise`, `accept_warnings`, ….
#[pyfunction]
#[pyo3(signature = (recorded, **options))]
pub(crate) fn recover<'py>(
    py: Python<'py>,
    recorded: &Bound<'py, PyAny>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    const FILE: &str = "camera.csv";
    let mut call = Call::new(&["recover", "chart"])?;
    call.keywords(options)?;
    let out = call.path(FILE);
    call.option("out", out);
    match recorded.cast::<PyList>() {
        Ok(all) => all.iter().try_for_each(|recorded| call.raw(&recorded))?,
        Err(_) => call.raw(recorded)?,
    }
    let recovered = call.run(py)?;
    let mut read = Call::new(&["inspect"])?;
    read.switch("json");
    let path = recovered.folder.path().join(FILE);
    read.place(path.into_pyobject(py)?.as_any(), None)?;
    let curves = curves(py, &read.run(py)?.text()?)?;
    let name = options.map(|options| options.get_item("title")).transpose()?.flatten();
    let numpy = py.import("numpy")?;
    let stacked = |key: &str| -> PyResult<Bound<'py, PyAny>> {
        let parts = curves.iter().map(|curve| curve.get_item(key)).collect::<PyResult<Vec<_>>>()?;
        numpy.call_method1("column_stack", (parts,))
    };
    let found = PyDict::new(py);
    found.set_item("name", name.unwrap_or("Recovered camera".into_pyobject(py)?.into_any()))?;
    found.set_item("columns", curves.iter().map(|curve| curve.get_item("name")).collect::<PyResult<Vec<_>>>()?)?;
    found.set_item("wavelengths", curves.get_item(0)?.get_item("wavelengths")?)?;
    found.set_item("values", stacked("values")?)?;
    found.set_item("standard_uncertainty", stacked("standard_uncertainty")?)?;
    found.set_item("report", recovered.text()?)?;
    Ok(found)
}
