//! Built-in data sets by name (feature `data`).
//!
//! Names are the titles of the data files; case is ignored. [`names`] lists them.

use crate::patch_set::PatchSet;
use crate::spectral::{Dataset, DatasetError, GridSpectrum, Quantity, Sensor, SensorError};

/// Reason that a built-in data set cannot be had.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum DataError {
    #[error("no {folder} data set is named {name}")]
    Unknown { folder: &'static str, name: String },
    #[error(transparent)]
    File(#[from] DatasetError),
    #[error(transparent)]
    Sensor(#[from] SensorError),
}

/// Spectral sensitivities of a camera, per unit energy.
///
/// # Errors
/// [`DataError::Unknown`] where no camera has the name.
///
/// ```
/// use chromascope_core::prelude::*;
///
/// let camera = data::camera("Nikon D70 (2007 figure)")?;
/// let evaluator = LocusEvaluator::new(&camera, RadiationConstants::Paper);
/// let rendering = Rendering::under_equal_energy(&camera)?;
/// let xyz = rendering.blackbody(evaluator.raw(Kelvin::new(5500.0)?));
/// let xy = xyz.chromaticity().expect("a D70 responds to a blackbody");
/// assert!((xy.x - 0.3128).abs() < 1e-4 && (xy.y - 0.3333).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn camera(name: &str) -> Result<Sensor, DataError> {
    Ok(Sensor::from_dataset(&find("cameras", name)?.0)?)
}

/// Color matching functions or cone fundamentals of an observer.
///
/// # Errors
/// [`DataError::Unknown`] where no observer has the name.
pub fn observer(name: &str) -> Result<Sensor, DataError> {
    Ok(Sensor::from_dataset(&find("observers", name)?.0)?)
}

/// Reflectances of a chart or of materials.
///
/// # Errors
/// [`DataError::Unknown`] where no chart has the name.
pub fn chart(name: &str) -> Result<PatchSet, DataError> {
    Ok(PatchSet::from_dataset(&find("charts", name)?.0))
}

/// Relative spectral power of an illuminant on the 1 nm grid.
///
/// # Errors
/// [`DataError::Unknown`] where no illuminant has the name.
pub fn illuminant(name: &str) -> Result<GridSpectrum, DataError> {
    let (dataset, column) = find("illuminants", name)?;
    Ok(GridSpectrum::resample(&dataset.curves[column], Quantity::Light))
}

/// Names of the data sets of a folder: `cameras`, `observers`, `charts`, `illuminants` or `materials`.
pub fn names(folder: &str) -> Vec<String> {
    let headers = chromascope_data::files(folder).filter_map(|(_, text)| Dataset::read_header(text).ok());
    let several = |columns: &[String]| folder == "illuminants" && columns.len() > 1;
    headers.flat_map(|header| if several(&header.columns) { header.columns } else { vec![header.title] }).collect()
}

/// Data set with this title, and the column with this name where a file holds several illuminants (0 otherwise).
fn find(folder: &'static str, name: &str) -> Result<(Dataset, usize), DataError> {
    let wanted = name.to_lowercase();
    for (_, text) in chromascope_data::files(folder) {
        let header = Dataset::read_header(text)?;
        let column = match header.columns.as_slice() {
            columns @ [_, _, ..] if folder == "illuminants" => columns.iter().position(|c| c.to_lowercase() == wanted),
            _ => (header.title.to_lowercase() == wanted).then_some(0),
        };
        if let Some(column) = column {
            return Ok((Dataset::read(text)?, column));
        }
    }
    Err(DataError::Unknown { folder, name: name.to_owned() })
}
