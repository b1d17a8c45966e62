//! The built-in data sets that the workloads compute with.

#[cfg(feature = "workloads")]
use chromascope_core::spectral::{Dataset, GridSpectrum, Quantity, Sensor};
use chromascope_core::spectral::{DatasetError, SensorError};

/// A built-in data set that cannot be computed with.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum DataError {
    #[error("{0} is missing from this build")]
    Missing(&'static str),
    #[error("{path}: {error}")]
    File { path: &'static str, error: DatasetError },
    #[error("{path}: {error}")]
    Sensor { path: &'static str, error: SensorError },
}

#[cfg(feature = "workloads")]
fn read(path: &'static str) -> Result<Dataset, DataError> {
    let text = chromascope_data::text(path).ok_or(DataError::Missing(path))?;
    Dataset::read(text).map_err(|error| DataError::File { path, error })
}

#[cfg(feature = "workloads")]
pub(crate) fn curve(path: &'static str, quantity: Quantity) -> Result<GridSpectrum, DataError> {
    let data = read(path)?;
    Ok(GridSpectrum::resample(data.curves.first().ok_or(DataError::Missing(path))?, quantity))
}

#[cfg(feature = "workloads")]
pub(crate) fn sensor(path: &'static str) -> Result<Sensor, DataError> {
    Sensor::from_dataset(&read(path)?).map_err(|error| DataError::Sensor { path, error })
}

/// All cameras, in the order of their files' names.
#[cfg(feature = "workloads")]
pub(crate) fn cameras() -> Result<Vec<Sensor>, DataError> {
    chromascope_data::files("cameras").map(|(path, _)| sensor(path)).collect()
}
