//! Arguments of `render` and their parsers.

use std::ffi::OsString;
use std::path::PathBuf;

use chromascope_core::colorimetry::Metric;
use chromascope_core::render::visibility::MAX_SIDE;
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, ValueEnum};
use spectral_file::Values;

use crate::cli::arguments::SourceArguments;
use crate::cli::settings::{Given, choice};
use crate::document::Exaggeration;
use crate::document::render::RenderSettings;

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
    #[arg(long, value_name = "FILE", help_heading = SCENE,
          conflicts_with_all = ["mesh", "material", "garment", "values", "light", "orbit", "fov", "size", "samples", "stats"])]
    pub(super) image: Option<PathBuf>,
    #[command(flatten)]
    pub(super) settings: Given<RenderSettings>,
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
    /// Direction to the light in view axes: right, up, toward the viewer [default: 35° up, 30° left; 25° up,
    /// 25° left in the paper's start]
    #[arg(long, value_name = "x,y,z", value_parser = three, allow_hyphen_values = true, help_heading = SCENE)]
    pub(super) light: Option<[f64; 3]>,
    /// Metric of the differences from the reference [default: delta-e2000, or xy with the paper's matrix]
    #[arg(long, value_name = "METRIC", value_parser = metrics(), help_heading = SCENE)]
    pub(super) difference: Option<String>,
    /// Factor on the pictures' differences from the reference; numbers stay
    #[arg(long, value_name = "K", value_parser = choice::<Exaggeration>(), default_value = Exaggeration::default().key(),
          help_heading = SCENE)]
    pub(super) exaggerate: Exaggeration,
    #[command(flatten)]
    pub(super) viewpoint: ViewpointArguments,
    /// Pixels across and down
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = size, help_heading = PICTURE)]
    pub(super) size: [u32; 2],
    /// Samples along a pixel's side, for smooth edges
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=8),
          help_heading = PICTURE)]
    pub(super) samples: u32,
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
const PICTURE: &str = "Picture";

/// A kind of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// Eight bits, sRGB, exposed, clear beside the mesh
    Png,
    /// OpenEXR: linear 32-bit floats before exposure
    Exr,
}

impl Format {
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

fn numbers<const N: usize>(text: &str, example: &str) -> Result<[f64; N], String> {
    let parts: Vec<f64> = text.split(',').map(finite).collect::<Result<_, _>>()?;
    let count = parts.len();
    parts.try_into().map_err(|_| format!("expected {N} numbers separated by commas, such as {example}; found {count}"))
}

fn three(text: &str) -> Result<[f64; 3], String> {
    numbers(text, "-0.4,0.5,1")
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let remedy = || format!("expected width and height in pixels, each from 1 to {MAX_SIDE}, such as 512x512");
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(remedy)?;
    let side = |text: &str| text.trim().parse::<u32>().ok().filter(|side| (1..=MAX_SIDE).contains(side));
    Ok([side(width).ok_or_else(remedy)?, side(height).ok_or_else(remedy)?])
}

fn metrics() -> PossibleValuesParser {
    PossibleValuesParser::new(Metric::ALL.iter().map(|metric| PossibleValue::new(metric.id).help(metric.label)))
}
