//! Spectral images on disk: a header and its data file, or one OpenEXR file.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use spectral_image::{EnviHeader, EnviImage, ExrImage, ImageError, ImageQuantity, SpectralImage};

/// Largest header that is read.
const MAX_HEADER: u64 = 16 << 20;
/// Extensions of a header's data file.
const DATA: [&str; 9] = ["img", "dat", "raw", "bil", "bip", "bsq", "bin", "cube", "sli"];

/// Reason that a spectral image cannot be opened, with its file.
#[derive(Debug, thiserror::Error)]
pub enum OpenImageError {
    /// The file cannot be read.
    #[error("{}: {}", path.display(), crate::format::io_reason(error))]
    Io {
        /// The file.
        path: PathBuf,
        /// Reason.
        error: io::Error,
    },
    /// A header without its data file.
    #[error("{}: no data beside this header; expected {} or that name with .img, .dat, .bil, .bip or .bsq", header.display(), data.display())]
    NoData {
        /// The header.
        header: PathBuf,
        /// The data's name.
        data: PathBuf,
    },
    /// Data without its header file.
    #[error("{}: no header beside these data; expected {}", data.display(), header.display())]
    NoHeader {
        /// The data.
        data: PathBuf,
        /// The header's name.
        header: PathBuf,
    },
    /// The file is no spectral image.
    #[error("{}: {error}", path.display())]
    Image {
        /// The file.
        path: PathBuf,
        /// Reason.
        error: ImageError,
    },
}

/// A spectral image whose rows are read from disk when requested.
pub type ImageOnDisk = SpectralImage<File>;

/// Opens an ENVI header (or its data) or an OpenEXR file. `wanted` chooses where an OpenEXR has both radiance and reflectance.
///
/// # Errors
///
/// [`OpenImageError`] with the file and a remedy.
pub fn open(path: &Path, wanted: Option<ImageQuantity>) -> Result<ImageOnDisk, OpenImageError> {
    if has_ending(path, "exr") {
        let image = ExrImage::new(opened(path)?, wanted);
        return image.map(SpectralImage::Exr).map_err(|error| OpenImageError::Image { path: path.to_owned(), error });
    }
    let header = if has_ending(path, "hdr") { path.to_owned() } else { header_of(path)? };
    let length = fs::metadata(&header).map_err(|error| OpenImageError::Io { path: header.clone(), error })?.len();
    if length > MAX_HEADER {
        return Err(OpenImageError::Image { path: header, error: ImageError::NotEnvi });
    }
    let bytes = fs::read(&header).map_err(|error| OpenImageError::Io { path: header.clone(), error })?;
    let parsed = EnviHeader::parse(&bytes).map_err(|error| OpenImageError::Image { path: header.clone(), error })?;
    let data = if has_ending(path, "hdr") { data_of(&header)? } else { path.to_owned() };
    let image = EnviImage::new(parsed, opened(&data)?);
    image.map(SpectralImage::Envi).map_err(|error| OpenImageError::Image { path: data, error })
}

/// True if a path names a spectral image by its ending.
pub fn is_spectral_image(path: &Path) -> bool {
    has_ending(path, "hdr") || has_ending(path, "exr") || (has_ending(path, "img") && header_of(path).is_ok())
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

fn opened(path: &Path) -> Result<File, OpenImageError> {
    File::open(path).map_err(|error| OpenImageError::Io { path: path.to_owned(), error })
}

/// Header of some data: `cube.img.hdr` or `cube.hdr`.
fn header_of(data: &Path) -> Result<PathBuf, OpenImageError> {
    let mut appended = data.as_os_str().to_owned();
    appended.push(".hdr");
    let names = [data.with_extension("hdr"), PathBuf::from(appended)];
    let found = names.iter().find(|name| name.is_file());
    let [header, _] = &names;
    found.cloned().ok_or_else(|| OpenImageError::NoHeader { data: data.to_owned(), header: header.clone() })
}

/// Data of a header: its name without `.hdr`, as it is or with a usual ending, small or capital.
fn data_of(header: &Path) -> Result<PathBuf, OpenImageError> {
    let stem = header.with_extension("");
    let mut names = vec![stem.clone()];
    for ending in DATA {
        names.extend([header.with_extension(ending), header.with_extension(ending.to_uppercase())]);
    }
    let found = names.into_iter().find(|name| name.is_file());
    found.ok_or(OpenImageError::NoData { header: header.to_owned(), data: stem })
}
