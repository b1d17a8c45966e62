//! Arguments of `render` and their parsers.

use std::ffi::OsString;
use std::path::PathBuf;

use chromascope_core::colorimetry::Metric;
use chromascope_core::render::visibility::MAX_SIDE;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use spectral_file::Values;
use spectral_image::ImageQuantity;

use crate::cli::arguments::SourceArguments;
use crate::document::render::model::{AreaChoice, SpecularChoice};
use crate::document::render::{ReadingChoice, TOLERANCES};
use chromascope_core::render::QualityLevel;

const EXAMPLES: &str = "Examples:
  chromascope render --out pictures
  chromascope render --mesh fern --normalization paper --samples 3
  chromascope render --mesh bust.obj --camera \"Nikon D70\" --light=-1,1,1 --orbit 30,10,4
  chromascope render --sigma 1e-6 --tau 5e-6 --quality fine --stats -
  chromascope render --mesh sphere --material mine.csv --illuminant A --white-balance A --format exr
  chromascope render --image cube.hdr --camera \"Nikon D70\" --illuminant D65 --difference delta-e2000

The light's direction is in view axes: x to the right, y up, z toward the viewer. Angles are in degrees, lengths in meters,
distances in radii of the mesh. A picture is named for mesh and sensor, as in head_nikon-d70.png; --force replaces existing ones.
OpenEXR holds Eq 12 before exposure, with \u{3c0}f in place of P for the radiometric and microfacet normalizations: R G B after white
balance, X Y Z, and the coverage A. Without any sensor: the preset's reference and cameras. A spectral image is read a few rows at a
time. Of reflectances, 1 is white at 0 EV; of radiances, the 99.5 % quantile of the reference's luminance is.";

/// Pictures of a mesh under a light, through cameras and observers, as PNG or OpenEXR
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(in crate::cli) struct RenderArguments {
    #[command(flatten)]
    pub(in crate::cli) sources: SourceArguments,
    /// The mesh: `head`, `fern`, `sphere`, `plane`, or an OBJ, PLY or STL file
    #[arg(long, value_name = "NAME|FILE", default_value = "head", help_heading = SCENE)]
    pub(super) mesh: OsString,
    /// A spectral image in place of a mesh: an ENVI header (.hdr) or an OpenEXR file with spectral channels
    #[arg(long, value_name = "FILE", help_heading = SCENE, conflicts_with_all = ["mesh", "triangles", "material", "garment", "values", "light",
          "no_shadows", "sky", "leaf", "orbit", "fov", "sigma", "sigma_from_mesh", "tau", "patch", "ior", "area", "reading", "specular", "quality",
          "tolerance", "size", "samples", "stats"])]
    pub(super) image: Option<PathBuf>,
    /// Quantity of the image's samples, overriding the file
    #[arg(long, value_enum, value_name = "QUANTITY", requires = "image", help_heading = SCENE)]
    pub(super) image_quantity: Option<ImageQuantityName>,
    /// Sample that stands for 1, such as 10000, where the file does not state it
    #[arg(long, value_name = "VALUE", default_value_t = 1.0, value_parser = positive, requires = "image", help_heading = SCENE)]
    pub(super) image_scale: f64,
    /// Approximate number of triangles of head, fern and sphere
    #[arg(long, value_name = "N", default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(8..=5_000_000),
          help_heading = SCENE)]
    pub(super) triangles: u32,
    /// The reflectance: `skin`, `leaf`, a name, or a file [default: skin; leaf for the fern]
    #[arg(long, value_name = "NAME|FILE", help_heading = SCENE)]
    pub(super) material: Option<OsString>,
    /// The reflectance of the head's garment: `none` for bare shoulders, a name, or a file [default: Faded jeans 076 (Vrhel);
    /// none in the paper's start]
    #[arg(long, value_name = "NAME|FILE", help_heading = SCENE)]
    pub(super) garment: Option<OsString>,
    /// Scale of the values in a file of reflectances that does not state it
    #[arg(long, value_name = "VALUES", value_parser = crate::cli::arguments::values(), requires = "material",
          help_heading = SCENE)]
    pub(super) values: Option<Values>,
    /// The illuminant: a name, a file with one curve, `daylight:K` or `blackbody:K` [default: Direct sun (ASTM G173)]
    #[arg(long, value_name = "NAME|FILE", help_heading = SCENE)]
    pub(super) illuminant: Option<OsString>,
    /// A filter in front of the illuminant: a name of `chromascope list filters`, or a file with one transmittance; may be repeated,
    /// in any order
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) filter: Vec<OsString>,
    /// The white-balance target, the RGB a perfect diffuser is mapped to: `unity`, an illuminant, `daylight:K` or `blackbody:K`
    /// [default: D55]
    #[arg(long = "white-balance", alias = "white", value_name = "WHITE", help_heading = SCENE)]
    pub(super) white: Option<String>,
    /// Direction to the light in view axes: right, up, toward the viewer [default: 25° up, 25° left]
    #[arg(long, value_name = "x,y,z", value_parser = three, allow_hyphen_values = true, help_heading = SCENE)]
    pub(super) light: Option<[f64; 3]>,
    /// Uniform sky of the illuminant's spectrum: irradiance of a level surface over that of a surface that faces the light, from 0
    /// to 1 [default: 0.15; none in the paper's start, whose light is a point]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true, help_heading = SCENE)]
    pub(super) sky: Option<f64>,
    /// Lets light through as a leaf of the material's reflectance does [default: for the fern]
    #[arg(long, value_name = "BOOL", num_args = 0..=1, default_missing_value = "true", help_heading = SCENE)]
    pub(super) leaf: Option<bool>,
    /// Metric of the differences from the reference [default: delta-e2000, or xy with the paper's matrix]
    #[arg(long, value_name = "METRIC", value_parser = metrics(), help_heading = SCENE)]
    pub(super) difference: Option<String>,
    /// Disables shadows
    #[arg(long, help_heading = SCENE)]
    pub(super) no_shadows: bool,
    #[command(flatten)]
    pub(super) viewpoint: ViewpointArguments,
    /// RMS roughness in meters [default: 5e-6]
    #[arg(long, value_name = "METERS", value_parser = finite, allow_hyphen_values = true, help_heading = SURFACE)]
    pub(super) sigma: Option<f64>,
    /// Takes RMS roughness and correlation length from the mesh, vertex by vertex, as the paper does: heights about the tangent
    /// plane and radius of the neighborhood. Dark except for a narrow specular lobe
    #[arg(long, help_heading = SURFACE)]
    pub(super) sigma_from_mesh: bool,
    /// Correlation length in meters: lag at which the height autocorrelation falls to 1/e [default: 10e-6]
    #[arg(long, value_name = "METERS", value_parser = finite, allow_hyphen_values = true, help_heading = SURFACE)]
    pub(super) tau: Option<f64>,
    /// Half-widths of the coherently illuminated area in meters [default: 50e-6,50e-6]
    #[arg(long = "half-widths", alias = "patch", value_name = "X,Y", value_parser = two, allow_hyphen_values = true, help_heading = SURFACE)]
    pub(super) patch: Option<[f64; 2]>,
    /// The refractive index [default: 1.4; 1.45 for the fern]
    #[arg(long, value_name = "N", value_parser = finite, allow_hyphen_values = true, help_heading = SURFACE)]
    pub(super) ior: Option<f64>,
    /// Area A of the patch with those half-widths: 4xy normalizes the coherent lobe, so that a smooth surface returns what its
    /// boundary reflects; xy is what the paper prints [default: 4xy]
    #[arg(long, value_enum, hide_default_value = true, default_value_t = AreaName::FourXy, help_heading = SURFACE)]
    pub(super) area: AreaName,
    /// Normalization of P. Returned at normal incidence, and at 85°, by the default surface: 0.49 and 0.03 of the light
    /// (radiometric), 0.49 and 1.38 (microfacet: more than 1 from about 70°)
    #[arg(long = "normalization", alias = "reading", value_enum, default_value_t = ReadingName::Radiometric, help_heading = SURFACE)]
    pub(super) reading: ReadingName,
    /// Reflectance factor of the coherent (specular) component [default: fresnel; paper in the paper's start]
    #[arg(long, value_enum, help_heading = SURFACE)]
    pub(super) specular: Option<SpecularName>,
    /// Accuracy of the integrals over wavelength
    #[arg(long, value_parser = quality(), default_value = "full", help_heading = PICTURE)]
    pub(super) quality: QualityLevel,
    /// The largest error of a picture, relative to its brightest sample, from 1e-13 to 0.1: for each camera the fastest method
    /// within it is used, and stated with its estimated error bound
    #[arg(long, value_name = "ERROR", value_parser = tolerance, allow_hyphen_values = true, conflicts_with = "quality",
          help_heading = PICTURE)]
    pub(super) tolerance: Option<f64>,
    /// Pixels across and down
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = size, help_heading = PICTURE)]
    pub(super) size: [u32; 2],
    /// Samples along a pixel's side, for smooth edges
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=8),
          help_heading = PICTURE)]
    pub(super) samples: u32,
    /// Exposure in EV, the same for all sensors
    #[arg(long, value_name = "EV", default_value_t = 0.0, value_parser = ev, allow_hyphen_values = true,
          help_heading = PICTURE)]
    pub(super) exposure: f64,
    /// File format
    #[arg(long, value_enum, default_value_t = Format::Png, help_heading = PICTURE)]
    pub(super) format: Format,
    /// Folder for pictures, created if necessary
    #[arg(long, value_name = "DIR", default_value = ".", help_heading = PICTURE)]
    pub(super) out: PathBuf,
    /// Writes times, counts and errors as JSON; `-` for standard output
    #[arg(long, value_name = "FILE", help_heading = PICTURE)]
    pub(super) stats: Option<PathBuf>,
    /// Overwrites existing pictures and statistics
    #[arg(long, help_heading = PICTURE)]
    pub(super) force: bool,
}

/// Arguments of the viewpoint on a mesh.
#[derive(Clone, Copy, Debug, Args)]
pub(in crate::cli) struct ViewpointArguments {
    /// Viewpoint: degrees around and above the mesh, and distance in radii of the mesh [default: -25,5; -25,15 for the
    /// fern, at the distance from which the mesh fills the picture]
    #[arg(long, value_name = "yaw,pitch,distance", value_parser = three, allow_hyphen_values = true, help_heading = SCENE)]
    pub(in crate::cli) orbit: Option<[f64; 3]>,
    /// The vertical field of view in degrees [default: 30, or 30 across in an upright picture]
    #[arg(long, value_name = "DEGREES", value_parser = finite, allow_hyphen_values = true, help_heading = SCENE)]
    pub(in crate::cli) fov: Option<f64>,
}

const SCENE: &str = "Scene";
const SURFACE: &str = "Surface";
const PICTURE: &str = "Picture";

/// Quantity of an image's samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ImageQuantityName {
    /// Reflectances, lit by the illuminant
    Reflectance,
    /// Radiances, taken as they are; the illuminant only balances white
    Radiance,
}

impl ImageQuantityName {
    pub(super) fn quantity(self) -> ImageQuantity {
        match self {
            Self::Reflectance => ImageQuantity::Reflectance,
            Self::Radiance => ImageQuantity::Radiance,
        }
    }
}

/// Reflectance factor of the coherent component.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum SpecularName {
    /// No Fresnel factor, tinted by the material: 36 times too bright for n = 1.4 at normal incidence
    Paper,
    /// Fresnel's reflectance, untinted
    Fresnel,
}

impl SpecularName {
    pub(super) fn choice(self) -> SpecularChoice {
        match self {
            Self::Paper => SpecularChoice::Paper,
            Self::Fresnel => SpecularChoice::Fresnel,
        }
    }
}

/// Area of the illuminated patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum AreaName {
    /// A = 4XY
    #[value(name = "4xy")]
    FourXy,
    /// A = XY, as printed
    Xy,
}

impl AreaName {
    pub(super) fn choice(self) -> AreaChoice {
        match self {
            Self::FourXy => AreaChoice::FourXy,
            Self::Xy => AreaChoice::Xy,
        }
    }
}

/// Normalization of P.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ReadingName {
    /// Radiance per irradiance
    Radiometric,
    /// Eq 1 to 12 as printed, except for A
    Paper,
    /// Beckmann's own geometric factor; reciprocal: diffuse component only
    Microfacet,
    /// No model: equal in all directions
    Lambertian,
}

impl ReadingName {
    pub(super) fn choice(self) -> ReadingChoice {
        match self {
            Self::Radiometric => ReadingChoice::Radiometric,
            Self::Paper => ReadingChoice::Paper,
            Self::Microfacet => ReadingChoice::Microfacet,
            Self::Lambertian => ReadingChoice::Lambertian,
        }
    }
}

/// The levels of exactness by name; a tolerance has an option of its own.
fn quality() -> impl TypedValueParser<Value = QualityLevel> {
    let levels = || QualityLevel::ALL.into_iter().filter(|level| *level != QualityLevel::Tolerance);
    let value = |level: QualityLevel| {
        let value = PossibleValue::new(level.key()).help(level.description());
        // Its name up to version 0.1.
        if level == QualityLevel::Reference { value.alias("exact") } else { value }
    };
    PossibleValuesParser::new(levels().map(value))
        .map(move |name| levels().find(|level| level.key() == name).unwrap_or(QualityLevel::Reference))
}

/// A kind of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// Eight bits, sRGB, exposed, clear beside the mesh
    Png,
    /// OpenEXR: linear 32-bit floats before exposure
    Exr,
}

impl Format {
    /// The ending of such files.
    pub(super) fn ending(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
        }
    }
}

fn finite(text: &str) -> Result<f64, String> {
    // The window and papers write a minus sign of their own.
    let number = text.trim().replace('\u{2212}', "-").parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("\"{text}\" is not a number; write one like 0.5 or 5e-6"))
}

fn positive(text: &str) -> Result<f64, String> {
    let number = finite(text)?;
    (number > 0.0 && number.recip().is_finite()).then_some(number).ok_or_else(|| format!("\"{text}\" is not above 0"))
}

fn share(text: &str) -> Result<f64, String> {
    let number = finite(text)?;
    (0.0..=1.0).contains(&number).then_some(number).ok_or_else(|| format!("sky {text} out of range (0 to 1)"))
}

fn tolerance(text: &str) -> Result<f64, String> {
    let number = finite(text)?;
    let (least, largest) = (TOLERANCES.start(), TOLERANCES.end());
    let within = TOLERANCES.contains(&number);
    within.then_some(number).ok_or_else(|| format!("tolerance {text} out of range ({least:e} to {largest:e})"))
}

fn ev(text: &str) -> Result<f64, String> {
    const LARGEST: f64 = 64.0;
    let number = finite(text)?;
    let within = number.abs() <= LARGEST;
    within.then_some(number).ok_or_else(|| format!("exposure out of range: {number} EV (-{LARGEST} to {LARGEST} EV)"))
}

fn numbers<const N: usize>(text: &str, example: &str) -> Result<[f64; N], String> {
    let parts: Vec<f64> = text.split(',').map(finite).collect::<Result<_, _>>()?;
    let count = parts.len();
    parts.try_into().map_err(|_| format!("expected {N} numbers separated by commas, such as {example}; found {count}"))
}

fn three(text: &str) -> Result<[f64; 3], String> {
    numbers(text, "-0.4,0.5,1")
}

fn two(text: &str) -> Result<[f64; 2], String> {
    numbers(text, "50e-6,50e-6")
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let remedy = || format!("expected width and height in pixels, each from 1 to {MAX_SIDE}, such as 512x512");
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(remedy)?;
    let side = |text: &str| text.trim().parse::<u32>().ok().filter(|side| (1..=MAX_SIDE).contains(side));
    Ok([side(width).ok_or_else(remedy)?, side(height).ok_or_else(remedy)?])
}

/// Ids of the metrics.
fn metrics() -> PossibleValuesParser {
    PossibleValuesParser::new(Metric::ALL.iter().map(|metric| PossibleValue::new(metric.id).help(metric.label)))
}
