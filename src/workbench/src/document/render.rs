//! Settings of the Render pane: mesh, material, surface, direction of the light, quality. Part of the document.

pub mod settings;

use std::ops::RangeInclusive;
use std::path::PathBuf;

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::query::render::Roughness;
use chromascope_core::reflectance::{IlluminatedArea, Normalization, Specular, Surface, SurfaceError};
use chromascope_core::render::{Quality, QualityLevel};
use chromascope_core::scene::lighting::{Lighting, LightingError, SUN_RADIUS};
use chromascope_text::Settings;
use serde::{Deserialize, Serialize};
use spectral_image::ImageQuantity;

/// The skin of the default head.
pub const SKIN: &str = "Skin Caucasian mean (Vrhel)";
/// The leaf of the default fern.
pub const LEAF: &str = "Fern-like bush leaf 024 (Vrhel)";
/// The garment that a head begins with, except in the paper's figures.
pub const GARMENT: &str = "Faded jeans 076 (Vrhel)";
/// The hair and brows of the head.
pub const HAIR: &str = "Brown hair 097 (Vrhel)";
/// The light of the paper's third experiment.
pub const SUN: &str = "Direct sun (ASTM G173)";
/// The balance of the paper's third experiment.
pub const BALANCE: &str = "D55";

/// The sky that a scene begins with, over direct sunlight: a clear day's share, in the light's own spectrum (a clear sky is blue).
pub const SKY: f64 = 0.15;

/// The distance that a near light begins with, in radii of the mesh.
pub const NEAR: f64 = 4.0;

/// The tolerances that can be chosen; beyond, S itself is not exact enough.
pub const TOLERANCES: RangeInclusive<f64> = 1e-13..=1e-1;
/// The tolerance before one was chosen.
pub const TOLERANCE: f64 = 1e-6;

/// The power of ten nearest to a tolerance: where a slider stops.
pub fn decade(tolerance: f64) -> f64 {
    let power = tolerance.max(*TOLERANCES.start()).min(*TOLERANCES.end()).log10().round() as i32;
    // Through its text: `powi` is not exact for negative powers.
    format!("1e{power}").parse().unwrap_or(TOLERANCE)
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
#[allow(clippy::struct_excessive_bools, reason = "switches that do not depend on each other")]
pub struct RenderSettings {
    pub mesh: MeshChoice,
    /// Approximate number of triangles of the program's own meshes.
    pub triangles: usize,
    /// The name of a reflectance.
    pub material: String,
    /// The name of the reflectance of the head's garment; none for bare shoulders, as in the paper.
    #[serde(default)]
    pub garment: Option<String>,
    /// Height deviation σ in micrometers.
    pub sigma_um: f64,
    /// Origin of σ and τ.
    pub roughness: Roughness,
    /// Correlation length τ in micrometers.
    pub tau_um: f64,
    /// Half-widths X and Y of the coherently illuminated area in micrometers.
    pub half_sides_um: [f64; 2],
    /// The area A that follows from them.
    pub area: IlluminatedArea,
    pub index: f64,
    #[serde(rename = "reading")]
    pub normalization: Normalization,
    /// The reflectance factor of the coherent component.
    // Sessions saved before there was a choice are as in the paper.
    #[serde(default)]
    pub specular: Specular,
    /// Exactness of the integrals once nothing moves.
    pub quality: QualityLevel,
    /// The error that [`QualityLevel::Tolerance`] allows, relative to the peak.
    pub tolerance: f64,
    /// The light above the view axis, in degrees.
    pub light_up_deg: f64,
    /// The light to the right of the view axis (negative: left), in degrees.
    pub light_right_deg: f64,
    /// The light's distance from the center in scene radii; none for parallel rays.
    pub light_distance: Option<f64>,
    /// The light's angular radius in radians.
    pub light_radius: f64,
    pub shadows: bool,
    /// Irradiance of a level surface by a uniform sky over that of a surface that faces the light; 0 without a sky.
    #[serde(default)]
    pub sky: f64,
    /// True if the chart's patches stand beside the mesh.
    #[serde(default)]
    pub chart: bool,
    /// True if the mesh stands on a gray ground.
    #[serde(default)]
    pub ground: bool,
    /// True if the head has hair and brows.
    #[serde(default)]
    pub hair: bool,
    /// True if light spreads within the head's skin.
    #[serde(default)]
    pub diffusion: bool,
    /// True if a head is cropped at the chest and the fern is turned.
    #[serde(default)]
    pub composed: bool,
    /// True if light passes through as through a leaf.
    #[serde(default)]
    pub thin: bool,
    /// Exposure in EV, the same for all cameras.
    pub exposure_ev: f64,
    /// True if the scene is under [`SUN`] and balanced to [`BALANCE`] until a light or a white is chosen.
    #[serde(default)]
    pub sunlight: bool,
    /// Quantity of a spectral image's samples; none takes the file's statement.
    #[serde(with = "image_quantity")]
    pub image_quantity: Option<ImageQuantity>,
    /// Sample of a spectral image that stands for 1, beyond the file's own scale.
    pub image_scale: f64,
}

impl Default for RenderSettings {
    /// The paper's head under sunlight.
    fn default() -> Self {
        Self {
            mesh: MeshChoice::Head,
            triangles: 100_000,
            material: SKIN.to_owned(),
            garment: None,
            sigma_um: 5.0,
            roughness: Roughness::Surface,
            tau_um: 10.0,
            half_sides_um: [50.0, 50.0],
            area: IlluminatedArea::FourXy,
            index: 1.40,
            normalization: Normalization::Radiometric,
            specular: Specular::Fresnel,
            quality: QualityLevel::Full,
            tolerance: TOLERANCE,
            light_up_deg: 25.0,
            light_right_deg: -25.0,
            light_distance: None,
            light_radius: SUN_RADIUS,
            shadows: true,
            sky: SKY,
            chart: false,
            ground: false,
            hair: false,
            diffusion: false,
            composed: false,
            thin: false,
            exposure_ev: 0.0,
            sunlight: true,
            image_quantity: None,
            image_scale: 1.0,
        }
    }
}

impl RenderSettings {
    /// Brings what a spoiled session says within its range.
    pub fn mend(&mut self) {
        Settings::mend(self);
        if self.lighting().is_err() {
            self.light_radius = SUN_RADIUS;
        }
    }

    /// The paper's fern under sunlight.
    pub fn fern() -> Self {
        Self { mesh: MeshChoice::Fern, material: LEAF.to_owned(), index: 1.45, thin: true, ..Self::default() }
    }

    /// Takes a mesh, with the material of the paper's where it was that of the other one.
    pub fn take(&mut self, mesh: MeshChoice) {
        let of = |mesh: &MeshChoice| if *mesh == MeshChoice::Fern { Self::fern() } else { Self::default() };
        let (before, after) = (of(&self.mesh), of(&mesh));
        if self.material == before.material && (self.index, self.thin) == (before.index, before.thin) {
            (self.material, self.index, self.thin) = (after.material, after.index, after.thin);
        }
        self.mesh = mesh;
    }

    /// The paper's own setup of the same mesh: a point light, and Eq 1–12 as printed. σ and τ are not given in the paper.
    #[must_use]
    pub fn as_in_the_paper(self) -> Self {
        Self {
            normalization: Normalization::Paper,
            specular: Specular::Paper,
            area: IlluminatedArea::Xy,
            garment: None,
            light_distance: Some(NEAR),
            light_radius: 0.0,
            sky: 0.0,
            chart: false,
            ground: false,
            hair: false,
            diffusion: false,
            composed: false,
            thin: false,
            ..self
        }
    }

    /// The same mesh as in a photograph: with chart and ground, the sun 45° beside the view axis, exposed for a white before
    /// the viewer.
    #[must_use]
    pub fn as_photographed(self) -> Self {
        Self {
            chart: true,
            ground: true,
            hair: true,
            diffusion: true,
            composed: true,
            light_up_deg: 35.0,
            light_right_deg: -30.0,
            exposure_ev: 0.4,
            ..self
        }
    }

    /// The garment that is seen: only the head wears one.
    pub fn worn(&self) -> Option<&str> {
        self.garment.as_deref().filter(|_| self.mesh == MeshChoice::Head)
    }

    /// The material, and the garment's.
    pub fn materials(&self) -> String {
        self.worn().map_or_else(|| self.material.clone(), |garment| format!("{}, garment: {garment}", self.material))
    }

    /// Width over height of a picture on a page: a head with its chart, and the fern, are wider than high.
    pub fn aspect(&self) -> f64 {
        let is_wide = self.composed && matches!(self.mesh, MeshChoice::Head | MeshChoice::Fern);
        if is_wide { 4.0 / 3.0 } else { 1.0 }
    }

    pub fn quality(&self) -> Quality {
        // Outside the range only until the session is validated.
        RelTolerance::new(self.tolerance).map_or(Quality::Reference, |tolerance| self.quality.quality(tolerance))
    }

    /// The surface in meters.
    pub fn surface(&self) -> Result<Surface, SurfaceError> {
        let [x, y] = self.half_sides_um;
        let surface = Surface::new(self.sigma_um * 1e-6, self.tau_um * 1e-6, x * 1e-6, y * 1e-6, self.index)?;
        Ok(surface.with_area(self.area).with_specular(self.specular))
    }

    /// The light's place in view axes.
    pub fn lighting(&self) -> Result<Lighting, LightingError> {
        let (up, right) = (self.light_up_deg.to_radians(), self.light_right_deg.to_radians());
        let far = Lighting::from_angles(up, right, self.light_radius)?;
        match self.light_distance {
            None => Ok(far),
            Some(distance) => Lighting::near(far.place() * distance, self.light_radius),
        }
    }
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MeshChoice {
    #[default]
    Head,
    Fern,
    Sphere,
    /// A square.
    Plane,
    File(#[serde(with = "super::paths")] PathBuf),
    /// A spectral image in place of a mesh.
    Image(#[serde(with = "super::paths")] PathBuf),
}

impl MeshChoice {
    /// The mesh's name; of a file, its file name.
    pub fn name(&self) -> String {
        match self {
            Self::Head => "head".to_owned(),
            Self::Fern => "fern".to_owned(),
            Self::Sphere => "sphere".to_owned(),
            Self::Plane => "plane".to_owned(),
            Self::File(path) | Self::Image(path) => crate::format::file_name(path),
        }
    }

    pub fn file_mut(&mut self) -> Option<&mut PathBuf> {
        match self {
            Self::File(path) | Self::Image(path) => Some(path),
            Self::Head | Self::Fern | Self::Sphere | Self::Plane => None,
        }
    }

    /// The same by its file's name alone.
    #[must_use]
    pub fn without_folder(&self) -> Self {
        let mut named = self.clone();
        if let Some(path) = named.file_mut()
            && let Some(name) = path.file_name().map(PathBuf::from)
        {
            *path = name;
        }
        named
    }

    /// True for a spectral image: no surface, light direction or viewpoint matters to it.
    pub const fn is_image(&self) -> bool {
        matches!(self, Self::Image(_))
    }
}

/// Quantity of a spectral image's samples by its key, or `file` for the file's statement.
mod image_quantity {
    use serde::{Deserialize as _, Deserializer, Serializer, de::Error as _};

    use super::ImageQuantity;
    use chromascope_text::Choice as _;

    const FILE: &str = "file";

    #[expect(clippy::ref_option, clippy::trivially_copy_pass_by_ref, reason = "the signature that serde calls")]
    pub(super) fn serialize<S: Serializer>(quantity: &Option<ImageQuantity>, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(quantity.map_or(FILE, ImageQuantity::key))
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<ImageQuantity>, D::Error> {
        let word = String::deserialize(from)?;
        let unknown = || D::Error::custom(format!("no quantity is named {word}"));
        if word == FILE { Ok(None) } else { ImageQuantity::parse(&word).map(Some).ok_or_else(unknown) }
    }
}
