//! Meshes through cameras, wavelength by wavelength, split where the inputs split.
//!
//! ```text
//! visibility   mesh × viewpoint              which triangle each sample sees
//! geometry     visibility × light's place    angles of light and view where it is lit: no spectrum, roughness or camera
//! shading      geometry × surface            κ, β and factors: the same for every camera
//! sky          visibility × surface          visible shares of a uniform sky: no light, no camera
//! diffusion    shading × visibility          light spread within skin by a few radii: no wavelength, no camera
//! signals      shading × camera              three numbers a sample: no mesh
//! develop      signals × balance, matrix, exposure    pixels
//! ```
//! Ten cameras share the first three; a new balance needs the last alone.

pub mod coherent;
pub mod develop;
pub mod diffuse;
pub mod diffusion;
pub mod exaggerate;
pub mod geometry;
pub mod measure;
pub mod plan;
pub mod quality;
pub mod shading;
pub mod signals;
pub mod sky;
pub mod spectral_image;
mod stop;
pub mod vertices;
pub mod visibility;

pub use coherent::CoherentIntegral;
pub use develop::{ColorimetricScale, Development, Picture, develop};
pub use geometry::{Angles, GeometryCounts, GeometryImage, LitSamples, Reach, Shadows};
pub use measure::{LAMBDA_0_NM, SpectralWeights, Transmitted};
pub use plan::{Demand, IntegrationMethod, Plan};
pub use quality::{Quality, QualityLevel};
pub use shading::{ShadingCounts, ShadingImage};
pub use signals::{CameraImage, MattePart};
pub use sky::{Sky, SkyImage, SkyReflectance, SkyVisibility};
pub use spectral_image::{BandWeights, ImageSensor, SampleQuantity, SpectralImageError, SpectralImageSignals};
pub use stop::Stop;
pub use vertices::VertexImage;
pub use visibility::{RasterSize, Visibility};
