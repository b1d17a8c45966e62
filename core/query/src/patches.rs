//! Queries about reflectances under a light, radiances, and raw RGB that a real camera recorded of them, through a sensor.

use super::ask::{Ask, Query, Shared};
use chromascope_color::camera::recorded::{Freedom, RecordedError, RecordedFit, RecordedPatch};
use chromascope_color::camera::rendering::{raw, under_light};
use chromascope_color::camera::{ColorTransform, FitTargets, Rendering, RenderingError, WhiteBalanceTarget};
use chromascope_color::colorimetry::rgb::{EncodedSrgb, encode_srgb};
use chromascope_color::colorimetry::{Lab, UvPrime, Xy, Xyz};
use chromascope_color::correction::Correction;
use chromascope_color::patch_set::PatchSet;
use chromascope_color::spectral::{GridSpectrum, Sensor};
use glam::DVec3;

/// The color transform, with its data.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum ColorTransformSpec {
    /// Eq 13.
    Paper,
    /// Fitted to a reference observer.
    Observer {
        /// The observer.
        reference: Shared<Sensor>,
        /// The training reflectances.
        training: Shared<PatchSet>,
        /// The color correction.
        correction: Correction,
    },
}

impl ColorTransformSpec {
    /// Observer, training reflectances and correction; none for Eq 13.
    pub fn fit(&self) -> Option<(&Shared<Sensor>, &Shared<PatchSet>, Correction)> {
        match self {
            Self::Paper => None,
            Self::Observer { reference, training, correction } => Some((reference, training, *correction)),
        }
    }
}

/// Color transform of a sensor under a light.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RenderingQuery {
    /// The camera or observer.
    pub sensor: Shared<Sensor>,
    /// The light on the scene.
    pub light: Shared<GridSpectrum>,
    /// The color a perfect white is to take.
    pub white: WhiteBalanceTarget,
    /// The color transform.
    pub transform: ColorTransformSpec,
}

impl Query for RenderingQuery {
    type Answer = Result<Rendering, RenderingError>;
    const NAME: &'static str = "rendering";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let Some((reference, training, correction)) = self.transform.fit() else {
            return Rendering::new(&self.sensor, &self.light, self.white, ColorTransform::Paper);
        };
        let (reference, light) = (reference.clone(), self.light.clone());
        let targets = ask.ask(&FitTargetsQuery { reference, light, training: training.clone() });
        let targets = (*targets).as_ref().map_err(|&e| e);
        Rendering::by_targets(&self.sensor, &self.light, self.white, training, targets, &correction)
    }
}

/// XYZ of the training reflectances through a reference observer, shared by all sensors fitted to it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct FitTargetsQuery {
    /// The observer.
    pub reference: Shared<Sensor>,
    /// The light on the scene.
    pub light: Shared<GridSpectrum>,
    /// The training reflectances.
    pub training: Shared<PatchSet>,
}

impl Query for FitTargetsQuery {
    type Answer = Result<FitTargets, RenderingError>;
    const NAME: &'static str = "fit targets";

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        FitTargets::new(&self.reference, &self.light, &self.training)
    }
}

/// One patch through one sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchColor {
    /// Balanced RGB (Eq 16 with Eq 11); none for observers that count in XYZ or cones.
    pub rgb: Option<[f64; 3]>,
    /// Tristimulus values, Y = 1 for a perfect white.
    pub xyz: Xyz,
    /// Chromaticity, or none for a signal that sums to nothing.
    pub xy: Option<Xy>,
    /// Chromaticity in the 1976 diagram.
    pub uv: Option<UvPrime>,
    /// L*a*b* relative to the rendering's white.
    pub lab: Option<Lab>,
    /// Linear sRGB, unclipped.
    pub linear: [f64; 3],
    /// The color on a screen.
    pub srgb: EncodedSrgb,
}

/// Colors of patches through a sensor (Eq 16).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PatchColorsQuery {
    /// The sensor and its color transform.
    pub rendering: RenderingQuery,
    /// The patches.
    pub patches: Shared<PatchSet>,
}

impl Query for PatchColorsQuery {
    type Answer = Result<Vec<PatchColor>, RenderingError>;
    const NAME: &'static str = "patch colors";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let rendering = ask.ask(&self.rendering);
        let rendering = (*rendering).as_ref().map_err(|&e| e)?;
        let reflectances = self.patches.patches().iter().map(|patch| &patch.grid);
        Ok(patch_colors(&self.rendering, rendering, reflectances))
    }
}

pub(super) fn color(rendering: &Rendering, raw: DVec3) -> PatchColor {
    let signals = rendering.patch_signals(raw.to_array());
    let xyz = rendering.xyz(signals);
    let linear = rendering.linear_srgb(xyz);
    PatchColor {
        rgb: rendering.is_rgb.then(|| signals.to_array()),
        xyz,
        xy: xyz.chromaticity(),
        uv: xyz.uv_prime(),
        lab: rendering.lab(xyz),
        linear,
        srgb: encode_srgb(linear),
    }
}

/// Colors of flat reflectances through a sensor whose rendering is `rendering`.
pub fn patch_colors<'a>(
    of: &RenderingQuery,
    rendering: &Rendering,
    reflectances: impl Iterator<Item = &'a GridSpectrum>,
) -> Vec<PatchColor> {
    let product = under_light(&of.sensor, &of.light);
    reflectances.map(|reflectance| color(rendering, raw(&product, reflectance.values()))).collect()
}

/// Colors of radiances L through a sensor: `I_c = s_c ∫C_c L dλ / ∫C_c W dλ`.
///
/// W, the radiance of white, takes the place of the rendering's light: a radiance equal to W takes the white-balance target, and
/// Y = 1.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RadianceColorsQuery {
    /// The sensor and its color transform, with W for its light.
    pub rendering: RenderingQuery,
    /// The radiances.
    pub radiances: Vec<Shared<GridSpectrum>>,
}

impl Query for RadianceColorsQuery {
    type Answer = Result<Vec<PatchColor>, RenderingError>;
    const NAME: &'static str = "radiance colors";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let rendering = ask.ask(&self.rendering);
        let rendering = (*rendering).as_ref().map_err(|&e| e)?;
        let product = under_light(&self.rendering.sensor, &GridSpectrum::constant(1.0));
        Ok(self.radiances.iter().map(|radiance| color(rendering, raw(&product, radiance.values()))).collect())
    }
}

/// Patches with their spectra and recorded RGB.
pub type RecordedSet = Shared<Vec<RecordedPatch>>;

/// Fit of a camera's sensitivities to recorded values.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RecordedFitQuery {
    /// The patches.
    pub recorded: RecordedSet,
    /// The camera.
    pub sensor: Shared<Sensor>,
    /// Parameters that are fitted.
    pub freedom: Freedom,
}

impl Query for RecordedFitQuery {
    type Answer = Result<RecordedFit, RecordedError>;
    const NAME: &'static str = "recorded fit";
    const ALWAYS_COMPLETE: bool = true;

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        RecordedFit::new(&self.recorded, &self.sensor, self.freedom)
    }
}
