//! Figures and pictures.

use std::io::Cursor;
use std::sync::Arc;

use exr::prelude::{FlatSamples, ReadChannels as _, ReadLayers as _, read};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arrays::{apart, array, refused};
use crate::commands::Call;

/// A figure: `svg` is its drawing, which notebooks show.
#[pyclass(frozen, module = "chromascope")]
pub(crate) struct Figure {
    #[pyo3(get)]
    kind: String,
    #[pyo3(get)]
    svg: String,
}

#[pymethods]
impl Figure {
    fn _repr_svg_(&self) -> &str {
        &self.svg
    }

    fn __repr__(&self) -> String {
        format!("<chromascope.Figure {}>", self.kind)
    }
}

/// Figure of a kind, as `chromascope figure`: `chromaticity`, `spectra`, `swatches`, `metrics`, `light`, `render`, ….
///
/// `file` is, for `curves`, a file or an object with `wavelengths` and `values`, and for `recorded` a file or raw values (patches, 3). Options: `camera`, `observer`, `illuminant`, `preset`,
/// `width`, `font_size`, `style`, `range`, …. With `form` (`pdf`, `png`, `tif`, `csv`, `json`, `tex`) the bytes of such a file are
/// returned in place of a `Figure`.
#[pyfunction]
#[pyo3(signature = (kind, file = None, form = "svg", **options))]
pub(crate) fn figure<'py>(
    py: Python<'py>,
    kind: Bound<'py, PyAny>,
    file: Option<&Bound<'py, PyAny>>,
    form: &str,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let mut call = Call::new(&["figure"])?;
    call.keywords(options)?;
    let out = call.path(&format!("figure.{form}"));
    call.option("out", out);
    call.place(&kind, None)?;
    if let Some(file) = file {
        call.raw(file)?;
    }
    let files = call.run(py)?.files;
    let made = files.iter().find(|(name, _)| name.starts_with("figure."));
    let (_, bytes) = made.ok_or_else(|| refused("out", "the figure was written elsewhere"))?;
    if form != "svg" {
        return Ok(PyBytes::new(py, bytes).into_any());
    }
    let svg = String::from_utf8_lossy(bytes).into_owned();
    Ok(Bound::new(py, Figure { kind: kind.extract()?, svg })?.into_any())
}

/// Pictures of a mesh or a spectral image through cameras and observers, as `chromascope render`: a dict of arrays by the names that the
/// files would have.
///
/// With `form` `exr` an array is float32 of shape (height, width, channels), linear and before exposure; `channels` are `RGBXYZA` of a
/// camera, R, G, B after white balance, X, Y, Z, and the coverage A by which colors are multiplied; `XYZA` of an observer. With `png` it is
/// uint8 (height, width, 4): sRGB and opacity. Options: `camera`, `observer`, `mesh`, `image`, `material`, `illuminant`, `size`, `orbit`, ….
#[pyfunction]
#[pyo3(signature = (form = "exr", **options))]
pub(crate) fn render<'py>(
    py: Python<'py>,
    form: &str,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut call = Call::new(&["render"])?;
    call.keywords(options)?;
    call.option("format", form);
    let out = call.path("");
    call.option("out", out);
    let files = call.run(py)?.files;
    let pictures = PyDict::new(py);
    for (name, bytes) in files {
        let Some((stem, ending)) = name.rsplit_once('.') else { continue };
        let picture = match ending {
            "exr" => {
                let (numbers, shape) = apart(py, || linear(&bytes))?.map_err(|error| refused(&name, error))?;
                array(py, numbers, shape)?
            }
            "png" => {
                let picture = apart(py, || image::load_from_memory(&bytes))?.map_err(|error| refused(&name, error))?;
                let picture = picture.into_rgba8();
                let shape = vec![picture.height() as usize, picture.width() as usize, 4];
                array(py, picture.into_raw(), shape)?
            }
            _ => continue,
        };
        pictures.set_item(stem, picture)?;
    }
    Ok(pictures)
}

/// Channels of an OpenEXR picture side by side, in the order R G B X Y Z A.
fn linear(bytes: &Arc<[u8]>) -> exr::error::Result<(Vec<f32>, Vec<usize>)> {
    let image = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes();
    let layer = image.non_parallel().from_buffered(Cursor::new(bytes))?.layer_data;
    let mut planes = Vec::new();
    for name in ["R", "G", "B", "X", "Y", "Z", "A"] {
        let named = layer.channel_data.list.iter().find(|channel| channel.name.eq(name));
        if let Some(FlatSamples::F32(values)) = named.map(|channel| &channel.sample_data) {
            planes.push(values);
        }
    }
    let (width, height) = (layer.size.width(), layer.size.height());
    let numbers = (0..width * height).flat_map(|pixel| planes.iter().map(move |plane| plane[pixel])).collect();
    Ok((numbers, vec![height, width, planes.len()]))
}
