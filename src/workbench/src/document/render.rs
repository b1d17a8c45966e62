//! Settings of the Render pane: mesh, material, surface, direction of the light, quality. Part of the document.

pub mod model;

use std::ops::RangeInclusive;
use std::path::PathBuf;

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::query::render::Roughness;
use chromascope_core::reflectance::{Normalization, Surface, SurfaceError};
use chromascope_core::render::{Quality, QualityLevel};
use chromascope_core::scene::lighting::{Lighting, LightingError, SUN_RADIUS};
use model::{AreaChoice, SpecularChoice};
use serde::{Deserialize, Serialize};

/// The skin of the default head.
pub const SKIN: &str = "Skin Caucasian mean (Vrhel)";
/// The leaf of the default fern.
pub const LEAF: &str = "Fern-like bush leaf 024 (Vrhel)";
/// The garment that a head begins with, except in the paper's figures.
pub const GARMENT: &str = "Faded jeans 076 (Vrhel)";
/// The light of the paper's third experiment.
pub const SUN: &str = "Direct sun (ASTM G173)";
/// The balance of the paper's third experiment.
pub const BALANCE: &str = "D55";

/// The sky that a scene begins with, over direct sunlight: a clear day's share, in the light's own spectrum (a clear sky is blue).
pub const SKY: f64 = 0.15;

/// The distance that a near light begins with, in radii of the mesh.
pub const NEAR: f64 = 4.0;

/// Number of triangles the program's own meshes may have.
pub const TRIANGLES: RangeInclusive<usize> = 2_000..=2_000_000;

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

/// The settings of the rendered scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
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
    pub roughness: RoughnessChoice,
    /// Correlation length τ in micrometers.
    pub tau_um: f64,
    /// Half-widths X and Y of the coherently illuminated area in micrometers.
    pub half_sides_um: [f64; 2],
    /// The area A that follows from them.
    pub area: AreaChoice,
    /// Refractive index.
    pub index: f64,
    /// Normalization of the reflectance (Eq 1).
    pub reading: ReadingChoice,
    /// The reflectance factor of the coherent component.
    #[serde(default = "SpecularChoice::before")]
    pub specular: SpecularChoice,
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
    /// True if the light casts shadows.
    pub shadows: bool,
    /// Irradiance of a level surface by a uniform sky over that of a surface that faces the light; 0 without a sky.
    #[serde(default)]
    pub sky: f64,
    /// True if light passes through as through a leaf.
    #[serde(default)]
    pub thin: bool,
    /// Exposure in EV, the same for all cameras.
    pub exposure_ev: f64,
    /// True if the scene is under [`SUN`] and balanced to [`BALANCE`] until a light or a white is chosen.
    #[serde(default)]
    pub sunlight: bool,
    /// Quantity of a spectral image's samples.
    pub image_quantity: QuantityChoice,
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
            roughness: RoughnessChoice::Surface,
            tau_um: 10.0,
            half_sides_um: [50.0, 50.0],
            area: AreaChoice::FourXy,
            index: 1.40,
            reading: ReadingChoice::Radiometric,
            specular: SpecularChoice::Fresnel,
            quality: QualityLevel::Full,
            tolerance: TOLERANCE,
            light_up_deg: 25.0,
            light_right_deg: -25.0,
            light_distance: None,
            light_radius: SUN_RADIUS,
            shadows: true,
            sky: SKY,
            thin: false,
            exposure_ev: 0.0,
            sunlight: true,
            image_quantity: QuantityChoice::File,
            image_scale: 1.0,
        }
    }
}

impl RenderSettings {
    /// Brings what a spoiled session says within its range: numbers clamped, what is no surface or light replaced.
    pub fn mend(&mut self) {
        let usual = Self::default();
        self.triangles = self.triangles.clamp(*TRIANGLES.start(), *TRIANGLES.end());
        self.exposure_ev = if self.exposure_ev.is_finite() { self.exposure_ev.clamp(-20.0, 20.0) } else { 0.0 };
        self.sky = if self.sky.is_finite() { self.sky.clamp(0.0, 1.0) } else { 0.0 };
        if !(self.image_scale > 0.0 && self.image_scale.is_finite()) {
            self.image_scale = usual.image_scale;
        }
        if !TOLERANCES.contains(&self.tolerance) {
            self.tolerance = usual.tolerance;
        }
        if self.surface().is_err() {
            let Self { sigma_um, tau_um, half_sides_um, index, .. } = usual;
            *self = Self { sigma_um, tau_um, half_sides_um, index, ..self.clone() };
        }
        if self.lighting().is_err() {
            let Self { light_up_deg, light_right_deg, light_distance, light_radius, .. } = usual;
            *self = Self { light_up_deg, light_right_deg, light_distance, light_radius, ..self.clone() };
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
            reading: ReadingChoice::Paper,
            specular: SpecularChoice::Paper,
            area: AreaChoice::Xy,
            garment: None,
            light_distance: Some(NEAR),
            light_radius: 0.0,
            sky: 0.0,
            thin: false,
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

    /// Exactness of the integrals once nothing moves.
    pub fn quality(&self) -> Quality {
        // Outside the range only until the session is validated.
        RelTolerance::new(self.tolerance).map_or(Quality::Reference, |tolerance| self.quality.quality(tolerance))
    }

    /// The surface in meters.
    pub fn surface(&self) -> Result<Surface, SurfaceError> {
        let [x, y] = self.half_sides_um;
        let surface = Surface::new(self.sigma_um * 1e-6, self.tau_um * 1e-6, x * 1e-6, y * 1e-6, self.index)?;
        Ok(surface.with_area(self.area.area()).with_specular(self.specular.specular()))
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

/// Mesh to render.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MeshChoice {
    /// The program's head.
    #[default]
    Head,
    /// The program's fern.
    Fern,
    Sphere,
    /// A square.
    Plane,
    /// A file of the user's.
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

    /// The file that it names, if it names one.
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

/// Quantity of a spectral image's samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum QuantityChoice {
    /// The file's statement.
    #[default]
    File,
    /// Reflectance, lit by the scene's light.
    Reflectance,
    /// Radiance, taken as it is.
    Radiance,
}

/// Origin of σ and τ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RoughnessChoice {
    /// The numbers that are set.
    #[default]
    Surface,
    /// Heights and radius of each vertex's neighborhood, as in the paper.
    Mesh,
}

impl RoughnessChoice {
    /// Reason that one would not choose the mesh.
    pub const WHY_NOT: &'static str = "As in the paper: at each vertex σ from the heights of its neighbors about the \
                                       tangent plane, τ from the radius of that neighborhood; P at the vertices, \
                                       interpolated. These are lengths of the mesh, not of the material: tenths of \
                                       millimeters and millimeters, so g is tens of millions, and the width of the \
                                       specular lobe, 2σ/τ, is the angle between neighboring triangles. It narrows \
                                       with more triangles.";

    /// The core's.
    pub const fn roughness(self) -> Roughness {
        match self {
            Self::Surface => Roughness::Surface,
            Self::Mesh => Roughness::Mesh,
        }
    }
}

/// Normalization of the reflectance (Eq 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ReadingChoice {
    /// Radiance per irradiance.
    #[default]
    Radiometric,
    /// Eq 1 to 12 as printed.
    Paper,
    /// Beckmann's own geometric factor: its diffuse component is reciprocal.
    Microfacet,
    /// No model: all directions alike.
    Lambertian,
}

impl ReadingChoice {
    /// All of them, in the order they are listed.
    pub const ALL: [Self; 4] = [Self::Radiometric, Self::Paper, Self::Microfacet, Self::Lambertian];

    /// The core's reading.
    pub const fn reading(self) -> Normalization {
        match self {
            Self::Radiometric => Normalization::Radiometric,
            Self::Paper => Normalization::Paper,
            Self::Microfacet => Normalization::Microfacet,
            Self::Lambertian => Normalization::Lambertian,
        }
    }

    /// Label in the window.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Radiometric => "Radiometric",
            Self::Paper => "Paper, Eq 1–12",
            Self::Microfacet => "Microfacet",
            Self::Lambertian => "Lambertian",
        }
    }

    /// Reason that one would choose it.
    pub const fn why(self) -> &'static str {
        match self {
            Self::Radiometric => {
                "Scattered radiance per incident irradiance: Eq 1 times A / (λ² cos θs). A rough white surface \
                 remains white."
            }
            Self::Paper => {
                "Eq 1 to 12 as printed, except for A, which is set with X and Y. Eq 4 is proportional to λ² without \
                 a compensating λ⁻², so rough surfaces turn yellow: a white surface under D55 moves from xy \
                 (0.332, 0.347) to (0.373, 0.379)."
            }
            Self::Microfacet => {
                "Beckmann's own geometric factor in place of the cos θi of Eq 3. Only the diffuse component is reciprocal (Helmholtz)."
            }
            Self::Lambertian => "No model: equal in all directions. The fastest, as a baseline.",
        }
    }

    /// Consequence in a few words.
    pub const fn consequence(self) -> &'static str {
        match self {
            Self::Radiometric => "A rough white surface remains white",
            Self::Paper => "Eq 4 is proportional to λ² without a compensating λ⁻², so rough surfaces turn yellow",
            Self::Microfacet => "Only the diffuse component is reciprocal (Helmholtz)",
            Self::Lambertian => "The fastest, as a baseline",
        }
    }
}
