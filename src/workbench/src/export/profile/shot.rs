//! Profiles of a camera by the patches that it recorded.

use chromascope_core::colorimetry::{Xy, Xyz};
use chromascope_core::correction::RgbTransform;
use chromascope_core::correction::aces::Idt;
use chromascope_core::correction::dng::{DngMatrices, ProfileMatrix};
use chromascope_core::glam::{DMat3, DVec3};
use chromascope_core::recovery::ShotProfile;
use chromascope_profile::dcp::Dcp;
use chromascope_profile::icc::{D50, IccProfile, IccVersion};

use super::{CorrectionFileError, CorrectionForm, calibration, clf, rows, unique_camera_model};

/// Matrices that are fitted to recorded patches, under one light or two.
#[derive(Clone, Copy, Debug)]
pub struct ShotCorrection<'a> {
    pub camera: &'a str,
    /// Camera model as raw files call it; by [`unique_camera_model`] where none is given.
    pub model: Option<&'a str>,
    pub terms: &'a str,
    /// Names of the lights, with the correction under each.
    pub profiles: &'a [(String, ShotProfile)],
}

impl ShotCorrection<'_> {
    /// Forms that it can be written in.
    pub const FORMS: [CorrectionForm; 3] =
        [CorrectionForm::Dcp, CorrectionForm::Icc(IccVersion::V4), CorrectionForm::Clf];

    /// The files that can be written: a DCP of all lights, and of each light, by its number, ICC and CLF.
    pub fn files(&self) -> impl Iterator<Item = (CorrectionForm, usize)> {
        let of_light = (0..self.profiles.len()).flat_map(|at| Self::FORMS[1..].iter().map(move |form| (*form, at)));
        std::iter::once((CorrectionForm::Dcp, 0)).chain(of_light)
    }

    /// Camera model that a DCP is for, in a sentence.
    pub fn model_in_words(&self) -> String {
        let why = "no picture states it, and if theirs is another, raw converters do not offer it";
        let why = self.model.map_or(format!("by the camera's name: {why}"), |_| "as the picture states it".to_owned());
        format!("The DCP is for raw files of the model \"{}\", {why}.", self.dcp_model())
    }

    fn dcp_model(&self) -> String {
        self.model.map_or_else(|| unique_camera_model(self.camera), str::to_owned)
    }

    /// DCP of all lights; ICC and CLF of the one of this number.
    pub fn written(&self, (form, light): (CorrectionForm, usize)) -> Result<Vec<u8>, CorrectionFileError> {
        let name = match form {
            CorrectionForm::Dcp => return self.dcp(),
            CorrectionForm::Icc(_) => "ICC",
            _ => "CLF",
        };
        let (light, profile) = self.profiles.get(light).ok_or(CorrectionFileError::NoMatrix(name))?;
        let matrix = matrix(profile).ok_or(CorrectionFileError::NoMatrix(name))?;
        if let CorrectionForm::Icc(version) = form {
            let icc = ProfileMatrix::new(matrix, profile.white, Xyz::from_vector(DVec3::from_array(D50)));
            let icc = icc.ok_or(CorrectionFileError::NoMatrix(name))?;
            let icc = IccProfile {
                description: format!("{}, {}", self.camera, self.name()),
                copyright: self.terms.to_owned(),
                xyz_from_rgb: rows(icc.xyz_from_rgb),
                adaptation: rows(icc.adaptation),
            };
            return Ok(icc.to_bytes(version)?);
        }
        let errors = profile.fits[0][0].measured.iter().flatten().copied().collect();
        let idt = Idt::from_matrix(matrix, profile.neutral, profile.white, errors)?;
        Ok(clf(self.camera, light, &idt, "fitted to recorded patches by least squares in XYZ, CAT02")?.into_bytes())
    }

    fn name(&self) -> String {
        let lights: Vec<&str> = self.profiles.iter().map(|(light, _)| light.as_str()).collect();
        format!("Chromascope shot {}", lights.join(" + "))
    }

    fn dcp(&self) -> Result<Vec<u8>, CorrectionFileError> {
        let mut lights: Vec<(&String, Option<Xy>, &ShotProfile)> =
            self.profiles.iter().map(|(light, profile)| (light, profile.white.chromaticity(), profile)).collect();
        // The warmer first, as DNG numbers them: along daylights and blackbodies x falls with the temperature.
        lights.sort_by(|a, b| b.1.map_or(0.0, |xy| xy.x).total_cmp(&a.1.map_or(0.0, |xy| xy.x)));
        let calibration = |(light, xy, profile): &(&String, Option<Xy>, &ShotProfile)| {
            calibration(light, *xy, DngMatrices::new(matrix(profile)?, profile.neutral, profile.white)?)
        };
        let calibrations: Option<Vec<_>> = lights.iter().map(calibration).collect();
        let dcp = Dcp {
            camera: self.dcp_model(),
            name: self.name(),
            copyright: self.terms.to_owned(),
            calibrations: calibrations.ok_or(CorrectionFileError::NoMatrix("DCP"))?,
        };
        Ok(dcp.to_bytes()?)
    }
}

/// The 3×3 that is fitted to the recorded patches, from balanced RGB to XYZ.
pub fn matrix(profile: &ShotProfile) -> Option<DMat3> {
    let mut fits = profile.fits.iter().map(|[patches, _]| &patches.transform);
    fits.find_map(|transform| if let RgbTransform::Matrix(matrix) = transform { Some(*matrix) } else { None })
}
