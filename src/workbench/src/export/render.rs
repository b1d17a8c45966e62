//! Rendered pictures out of the program: PNG for screens, OpenEXR with the numbers.

use std::io::{Cursor, Seek, Write};

use chromascope_core::camera::Rendering;
use chromascope_core::query::render::ShadingQuery;
use chromascope_core::reflectance::Normalization;
use chromascope_core::render::{LitSamples, Picture};
use chromascope_core::scene::lighting::Distance;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes,
    LineOrder, Text, WritableImage as _,
};
use image::codecs::png::CompressionType;

use crate::document::render::RenderSettings;

#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    #[error("the picture could not be encoded: {0}")]
    Png(#[from] image::ImageError),
    #[error("the picture could not be encoded: {0}")]
    Exr(#[from] exr::error::Error),
}

/// The bytes of a PNG file: eight bits, sRGB, with opacity.
pub fn png_bytes(picture: &Picture) -> Result<Vec<u8>, PictureError> {
    // Shaded surfaces are hardly smaller when packed slowly, and a first picture waits for it.
    let (width, height) = (picture.width as u32, picture.height as u32);
    Ok(super::encoded(&picture.rgba, width, height, CompressionType::Fast)?)
}

/// The bytes of an OpenEXR file: the balanced signals of Eq 12 as R G B (where the source has such), tristimulus values as
/// X Y Z, coverage as A; 32-bit floats, linear, before exposure.
///
/// A pixel is the mean over all its samples, those outside the mesh counted as 0: colors are premultiplied by A, as
/// usual in OpenEXR. The same picture gives the same bytes.
pub fn exr_bytes(
    placed: &LitSamples,
    signals: &[[f32; 3]],
    rendering: &Rendering,
    attributes: LayerAttributes,
) -> Result<Vec<u8>, PictureError> {
    let size = placed.size();
    let channels = planes(placed, signals, rendering)
        .into_iter()
        .map(|(name, values)| AnyChannel::new(name, FlatSamples::F32(values)));
    let channels = AnyChannels::sort(channels.collect());
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let dimensions = (size.width as usize, size.height as usize);
    let layer = Layer::new(dimensions, attributes, encoding, channels);
    let mut file = Cursor::new(Vec::new());
    write(&Image::from_layer(layer), &mut file)?;
    Ok(with_sorted_header(file.into_inner()))
}

fn write(
    image: &Image<Layer<AnyChannels<FlatSamples>>>,
    file: &mut (impl Write + Seek),
) -> Result<(), exr::error::Error> {
    image.write().non_parallel().to_buffered(file)
}

/// The channels, each row by row from the top left.
fn planes(geometry: &LitSamples, signals: &[[f32; 3]], rendering: &Rendering) -> Vec<(&'static str, Vec<f32>)> {
    let size = geometry.size();
    let (width, samples) = (size.width as usize, size.samples as usize);
    let pixel = |sample: u32| {
        let (row, column) = (sample as usize / size.columns(), sample as usize % size.columns());
        row / samples * width + column / samples
    };
    let count = width * size.height as usize;
    let mut sums = vec![[0.0_f64; 3]; count];
    for (&sample, signal) in geometry.samples().iter().zip(signals) {
        for (sum, value) in sums[pixel(sample)].iter_mut().zip(signal) {
            *sum += f64::from(*value);
        }
    }
    let share = 1.0 / (samples * samples) as f64;
    let mut coverage = vec![0.0_f32; count];
    geometry.seen().iter().for_each(|&sample| coverage[pixel(sample)] += share as f32);
    let mut planes = vec![("A", coverage)];
    let mut values = [const { Vec::new() }; 6];
    for sum in sums {
        let balanced = rendering.white * glam::DVec3::from_array(sum) * share;
        let xyz = rendering.xyz(balanced);
        let numbers = balanced.to_array().into_iter().chain([xyz.x, xyz.y, xyz.z]);
        values.iter_mut().zip(numbers).for_each(|(plane, number)| plane.push(number as f32));
    }
    let named = ["R", "G", "B", "X", "Y", "Z"].into_iter().zip(values);
    // Of a CIE observer the signals are tristimulus values: there is no red, green and blue.
    planes.extend(named.filter(|(name, _)| rendering.is_rgb || !["R", "G", "B"].contains(name)));
    planes
}

/// What every picture's header says: its sensor, the white if it is of RGB, the light, and `more`.
fn header<'a>(
    rendering: &Rendering,
    source: &str,
    [illuminant, white]: &[String; 2],
    comments: &str,
    more: impl IntoIterator<Item = (&'a str, AttributeValue)>,
) -> LayerAttributes {
    let own = [
        ("camera", text(source)),
        ("balance", text(if rendering.is_rgb { white } else { "none" })),
        ("balanceFactors", three(rendering.white.to_array())),
        ("illuminant", text(illuminant)),
    ];
    LayerAttributes {
        software_name: Some(utf8(concat!("chromascope ", env!("CARGO_PKG_VERSION")))),
        comments: Some(utf8(comments)),
        other: own.into_iter().chain(more).map(|(name, value)| (utf8(name), value)).collect(),
        ..LayerAttributes::default()
    }
}

/// The header of a spectral image's picture through a sensor, under these names of light and white.
pub fn image_header(rendering: &Rendering, source: &str, conditions: &[String; 2], image: &str) -> LayerAttributes {
    let comments = "R G B: the image's spectra through the camera, balanced, before exposure; X Y Z: tristimulus values by the color \
                    transform; A: 0 where the image has no value.";
    header(rendering, source, conditions, comments, [("image", text(image))])
}

/// The header of a mesh's picture through a sensor, under these names of light and white.
pub fn mesh_header(
    rendering: &Rendering,
    source: &str,
    conditions: &[String; 2],
    (settings, mesh): (&RenderSettings, &str),
    shading: &ShadingQuery,
) -> LayerAttributes {
    let (surface, lighting, viewpoint) =
        (shading.surface, shading.geometry.lighting, shading.geometry.visibility.viewpoint);
    let place = match lighting.distance() {
        Distance::Far => "lightDirection",
        Distance::Near => "lightPosition",
    };
    // From where the mesh fills the picture, the distance is not in radii.
    let distance = if viewpoint.zoom().is_some() { 0.0 } else { viewpoint.distance() };
    let orbit = [viewpoint.yaw().to_degrees(), viewpoint.pitch().to_degrees(), distance];
    let own = [
        ("material", text(&settings.material)),
        ("mesh", text(mesh)),
        ("quality", text(shading.quality.level().key())),
        ("reading", text(shading.reading.key())),
        (place, three(lighting.place().to_array())),
        ("sky", AttributeValue::F64(settings.sky)),
        ("leaf", text(if settings.thin { "true" } else { "false" })),
        ("lightAngularRadius", AttributeValue::F64(lighting.angular_radius())),
        ("sigma", AttributeValue::F64(surface.sigma_m())),
        ("tau", AttributeValue::F64(surface.tau_m())),
        ("halfSideX", AttributeValue::F64(surface.half_x_m())),
        ("halfSideY", AttributeValue::F64(surface.half_y_m())),
        ("illuminatedArea", AttributeValue::F64(surface.area_m2())),
        ("specular", text(surface.specular().key())),
        ("refractiveIndex", AttributeValue::F64(surface.index())),
        ("orbit", three(orbit)),
        ("fieldOfView", AttributeValue::F64(viewpoint.field_of_view().to_degrees())),
    ];
    let zoom = viewpoint.zoom().map(|zoom| ("framedDistance", AttributeValue::F64(zoom)));
    let garment = settings.worn().map(|garment| ("garment", text(garment)));
    let tolerance = shading.quality.given_tolerance();
    let tolerance = tolerance.map(|tolerance| ("tolerance", AttributeValue::F64(tolerance.max_relative_error())));
    let own = own.into_iter().chain(garment).chain(tolerance).chain(zoom);
    header(rendering, source, conditions, comments(shading.reading), own)
}

fn comments(reading: Normalization) -> &'static str {
    match reading {
        Normalization::Radiometric | Normalization::Microfacet => {
            "R G B: Eq 12 balanced, before exposure, with pi f in place of P; X Y Z: tristimulus values by the color \
             transform; A: coverage, premultiplied. Lengths in meters, angles in degrees except lightAngularRadius \
             (radians), the light in view axes, orbit = yaw, pitch, distance in scene radii (0: framedDistance times the one from which the mesh \
             fills the picture)."
        }
        Normalization::Paper | Normalization::Lambertian => {
            "R G B: Eq 12 balanced, before exposure; X Y Z: tristimulus values by the color transform; A: coverage, \
             premultiplied. Lengths in meters, angles in degrees except lightAngularRadius (radians), the light in \
             view axes, orbit = yaw, pitch, distance in scene radii (0: framedDistance times the one from which the mesh \
             fills the picture)."
        }
    }
}

fn text(value: &str) -> AttributeValue {
    AttributeValue::Text(utf8(value))
}

fn three([x, y, z]: [f64; 3]) -> AttributeValue {
    AttributeValue::FloatVec3((x as f32, y as f32, z as f32))
}

/// Text as it is: the crate's own conversion knows no letters beyond Latin.
fn utf8(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}

/// File with its header's attributes in the order of their names: the crate writes them in an order that changes from
/// run to run.
fn with_sorted_header(mut file: Vec<u8>) -> Vec<u8> {
    const START: usize = 8; // after the magic number and the version
    let end_of_text = |at: usize| Some(at + file.get(at..)?.iter().position(|&byte| byte == 0)? + 1);
    let end_of_attribute = |at: usize| -> Option<usize> {
        let length_at = end_of_text(end_of_text(at)?)?;
        let length = i32::from_le_bytes(file.get(length_at..length_at + 4)?.try_into().ok()?);
        (length_at + 4).checked_add(usize::try_from(length).ok()?)
    };
    let mut attributes: Vec<&[u8]> = Vec::new();
    let mut at = START;
    while file.get(at).is_some_and(|&byte| byte != 0) {
        let Some((end, attribute)) = end_of_attribute(at).and_then(|end| Some((end, file.get(at..end)?))) else {
            return file;
        };
        attributes.push(attribute);
        at = end;
    }
    attributes.sort_unstable();
    let sorted = attributes.concat();
    file[START..at].copy_from_slice(&sorted);
    file
}
