//! The data sets that the workloads compute with.

use std::collections::BTreeMap;
use std::path::Path;
use std::{fs, io};

use chromascope_core::spectral::{Dataset, DatasetError, GridSpectrum, Primaries, Quantity, Sensor, SensorError};

/// Data files by their path below `assets`, such as `cameras/nikon_d70_2007_figure.csv`.
#[derive(Clone, Debug, Default)]
pub struct Data(BTreeMap<String, String>);

/// A data set that cannot be computed with.
#[derive(Debug, thiserror::Error)]
pub enum DataError {
    /// A file is missing.
    #[error("{0} is missing")]
    Missing(String),
    /// A file cannot be read.
    #[error("{path}: {error}")]
    Damaged {
        /// The file.
        path: String,
        /// The reason.
        error: DatasetError,
    },
    /// A file has too few or too many curves.
    #[error("{path}: {found} curves, {needed} needed")]
    Curves {
        /// The file.
        path: String,
        /// Number of its curves.
        found: usize,
        /// Number needed.
        needed: usize,
    },
    /// The curves make no sensor.
    #[error("{path}: {error}")]
    Sensor {
        /// The file.
        path: String,
        /// The reason.
        error: SensorError,
    },
}

impl Data {
    /// Data files as pairs of path and text.
    pub fn new<P: Into<String>, T: Into<String>>(files: impl IntoIterator<Item = (P, T)>) -> Self {
        Self(files.into_iter().map(|(path, text)| (path.into(), text.into())).collect())
    }

    /// The data files in the folders of a folder laid out as `assets`.
    ///
    /// # Errors
    /// Fails where the folder or a file in it cannot be read; what is no text is passed over.
    pub fn of_folder(assets: &Path) -> io::Result<Self> {
        let mut files = BTreeMap::new();
        for folder in ["cameras", "illuminants", "materials", "observers"] {
            for entry in fs::read_dir(assets.join(folder))? {
                let entry = entry?;
                if let Ok(text) = String::from_utf8(fs::read(entry.path())?) {
                    files.insert(format!("{folder}/{}", entry.file_name().to_string_lossy()), text);
                }
            }
        }
        Ok(Self(files))
    }

    fn read(&self, path: &str) -> Result<Dataset, DataError> {
        let text = self.0.get(path).ok_or_else(|| DataError::Missing(path.to_owned()))?;
        Dataset::read(text).map_err(|error| DataError::Damaged { path: path.to_owned(), error })
    }

    /// The first curve of a file on the grid.
    ///
    /// # Errors
    /// Fails where the file is missing, damaged or empty.
    pub fn curve(&self, path: &str, quantity: Quantity) -> Result<GridSpectrum, DataError> {
        let data = self.read(path)?;
        let none = || DataError::Curves { path: path.to_owned(), found: 0, needed: 1 };
        Ok(GridSpectrum::resample(data.curves.first().ok_or_else(none)?, quantity))
    }

    /// A camera or an observer.
    ///
    /// # Errors
    /// Fails where the file is missing or damaged, or where its curves make no sensor.
    pub fn sensor(&self, path: &str) -> Result<Sensor, DataError> {
        let data = self.read(path)?;
        let primaries = match data.header.columns.first().map(String::as_str) {
            Some("x_bar") => Primaries::Xyz,
            Some("r_bar") => Primaries::Rgb,
            Some("l_bar") => Primaries::Cones,
            _ => Primaries::Camera,
        };
        let (found, response) = (data.curves.len(), data.header.response());
        let three = data.curves.try_into();
        let three = three.map_err(|_| DataError::Curves { path: path.to_owned(), found, needed: 3 })?;
        Sensor::new(primaries, three, response).map_err(|error| DataError::Sensor { path: path.to_owned(), error })
    }

    /// All cameras, in the order of their files' names.
    ///
    /// # Errors
    /// Fails where one of them cannot be read.
    pub fn cameras(&self) -> Result<Vec<Sensor>, DataError> {
        let paths = self.0.keys().filter(|path| path.starts_with("cameras/"));
        paths.map(|path| self.sensor(path)).collect()
    }
}
