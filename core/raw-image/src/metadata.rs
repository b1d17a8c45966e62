//! Camera and exposure as the file states them.

use crate::directory::{Directories, tag};

/// Camera, exposure and color calibration as the file states them; without position and serial number.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RawMetadata {
    /// Maker of the camera (`Make`).
    pub make: Option<String>,
    /// Model of the camera (`Model`).
    pub model: Option<String>,
    /// Model in one name for all markets (`UniqueCameraModel`).
    pub unique_camera_model: Option<String>,
    /// ISO sensitivity.
    pub iso: Option<f64>,
    /// Exposure time in seconds.
    pub exposure_s: Option<f64>,
    /// F-number of the lens.
    pub f_number: Option<f64>,
    /// Camera RGB of the neutral chosen by the camera, the largest about 1 (`AsShotNeutral`).
    pub as_shot_neutral: Option<[f64; 3]>,
    /// Color matrices for up to three lights.
    pub color_matrices: Vec<DngColorMatrix>,
}

/// Matrices of a DNG for one light.
#[derive(Debug, Clone, PartialEq)]
pub struct DngColorMatrix {
    /// Light as in Exif's `LightSource` (17: illuminant A, 21: D65); 0 where the file does not say.
    pub illuminant: u16,
    /// From XYZ to camera RGB (`ColorMatrix`), row by row.
    pub color: [[f64; 3]; 3],
    /// From white-balanced camera RGB to XYZ under D50 (`ForwardMatrix`), row by row.
    pub forward: Option<[[f64; 3]; 3]>,
}

impl RawMetadata {
    pub(crate) fn read(tags: &mut Directories<'_>) -> Self {
        let exif = tags.exif();
        let matrix = |tags: &mut Directories<'_>, tag| {
            let numbers: [f64; 9] = numbers(tags, 0, tag)?;
            Some([0, 3, 6].map(|row| [numbers[row], numbers[row + 1], numbers[row + 2]]))
        };
        let color_matrices = tag::CALIBRATIONS.iter().filter_map(|&[illuminant, color, forward]| {
            let illuminant = numbers(tags, 0, illuminant).map_or(0, |[light]: [f64; 1]| light as u16);
            Some(DngColorMatrix { illuminant, color: matrix(tags, color)?, forward: matrix(tags, forward) })
        });
        let color_matrices = color_matrices.collect();
        let mut exposure = |tag| {
            let found = exif.into_iter().chain([0]).find_map(|directory| numbers(tags, directory, tag));
            found.map(|[number]: [f64; 1]| number).filter(|&number| number > 0.0)
        };
        // 65535 stands for a higher one, given in Exif 2.3's own tags.
        let iso = exposure(tag::ISO).filter(|&iso| iso < 65535.0);
        Self {
            iso: iso.or_else(|| exposure(tag::RECOMMENDED_EXPOSURE_INDEX)).or_else(|| exposure(tag::ISO_SPEED)),
            exposure_s: exposure(tag::EXPOSURE_TIME),
            f_number: exposure(tag::F_NUMBER),
            make: tags.text(0, tag::MAKE),
            model: tags.text(0, tag::MODEL),
            unique_camera_model: tags.text(0, tag::UNIQUE_CAMERA_MODEL),
            as_shot_neutral: numbers(tags, 0, tag::AS_SHOT_NEUTRAL),
            color_matrices,
        }
    }
}

/// The first `N` numbers of a tag, if it has so many and all are finite.
fn numbers<const N: usize>(tags: &mut Directories<'_>, directory: usize, tag: u16) -> Option<[f64; N]> {
    let numbers = tags.numbers(directory, tag).ok()??;
    numbers.first_chunk().copied().filter(|numbers: &[f64; N]| numbers.iter().all(|number| number.is_finite()))
}
