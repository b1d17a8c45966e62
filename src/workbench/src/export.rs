//! Figures out of the program: SVG and PDF from the figure, PNG from that SVG, all in the bundled fonts.

pub mod card;
pub mod measured;
pub mod package;
pub mod page;
pub mod paper;
pub mod profile;
pub mod render;
pub mod spectra;

use std::io::Cursor;
use std::path::Path;
use std::sync::{Arc, LazyLock};

use base64::{Engine as _, prelude::BASE64_STANDARD};
use chromascope_figure::{CellValue, Figure, Image, Table, pdf, svg};
use chromascope_text::{Choice as _, choices};
use image::{
    ExtendedColorType, ImageEncoder as _, RgbaImage,
    codecs::png::{CompressionType, FilterType, PngEncoder},
};
use resvg::{tiny_skia, usvg};
use tiff::encoder::{Compression, DeflateLevel, Rational, TiffEncoder, colortype::RGB8};
use tiff::tags::ResolutionUnit;

use crate::palette::{Colors, FONT, FONT_FAMILY, MONO_FAMILY, MONO_FONT, SANS_FONT, SERIF_FONT};
pub use paper::Paper;

/// The longest side of a picture in pixels.
pub const MAX_SIDE: u32 = 16_384;

#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    #[error("the figure could not be drawn: {0}")]
    Svg(#[from] usvg::Error),
    #[error("a picture of {width} × {height} pixels cannot be made; the longest side is {MAX_SIDE}")]
    Size { width: u32, height: u32 },
    #[error("the picture could not be encoded: {0}")]
    Encode(#[from] image::ImageError),
    #[error("the picture could not be encoded: {0}")]
    Png(#[from] png::EncodingError),
    #[error("the picture could not be encoded: {0}")]
    Tiff(#[from] tiff::TiffError),
    #[error(transparent)]
    Pdf(#[from] pdf::PdfError),
}

/// A table as JSON: version, title, names of the columns, and rows of numbers, texts and null.
pub fn json(title: &str, table: &Table) -> String {
    let cell = |value: CellValue<'_>| match value {
        CellValue::Number(value) if value.is_finite() => serde_json::json!(value),
        CellValue::Text(text) => serde_json::json!(text),
        _ => serde_json::Value::Null,
    };
    let rows: Vec<Vec<_>> = (0..table.rows.len()).map(|row| table.values(row).map(cell).collect()).collect();
    let value = serde_json::json!({
        "format": "chromascope-table",
        "version": 1,
        "title": title,
        "columns": table.keys().collect::<Vec<_>>(),
        "rows": rows,
    });
    format!("{value:#}\n")
}

/// The figure as SVG. Figures for paper take [`Colors::LIGHT`].
pub fn svg(figure: &Figure, colors: &Colors, paper: Paper) -> String {
    let style = svg::SvgStyle { font_family: paper.typeface.families(), mono_family: MONO_FAMILY, encode: &data_uri };
    svg::write(figure, colors, &style, &paper.page_style())
}

pub fn pdf(figure: &Figure, colors: &Colors, paper: Paper) -> Result<Vec<u8>, ExportError> {
    let fonts = pdf::PdfFonts { text: paper.typeface.font(), mono: MONO_FONT, fallback: FONT };
    Ok(pdf::write(figure, colors, fonts, &paper.page_style())?)
}

/// The SVG as a picture with `scale` pixels per point (1/72 inch).
pub fn png(svg: &str, scale: f32) -> Result<RgbaImage, ExportError> {
    drawn(&usvg::Tree::from_str(svg, &options())?, scale)
}

/// The SVG as a picture that is as large as fits into a width and a height in pixels.
pub fn png_within(svg: &str, room: [f64; 2]) -> Result<RgbaImage, ExportError> {
    let tree = usvg::Tree::from_str(svg, &options())?;
    let own = [tree.size().width(), tree.size().height()];
    drawn(&tree, (room[0] as f32 / own[0]).min(room[1] as f32 / own[1]))
}

fn drawn(tree: &usvg::Tree, scale: f32) -> Result<RgbaImage, ExportError> {
    let size = tree.size();
    // The page fills whole pixels: one in part would be a gray line along an edge.
    let [width, height] = [size.width(), size.height()].map(|side| (side * scale).round().max(1.0) as u32);
    let too_large = || ExportError::Size { width, height };
    if width > MAX_SIDE || height > MAX_SIDE {
        return Err(too_large());
    }
    let mut pixels = tiny_skia::Pixmap::new(width, height).ok_or_else(too_large)?;
    let whole = tiny_skia::Transform::from_scale(width as f32 / size.width(), height as f32 / size.height());
    resvg::render(tree, whole, &mut pixels.as_mut());
    let straight = pixels.pixels().iter().flat_map(|pixel| {
        let color = pixel.demultiply();
        [color.red(), color.green(), color.blue(), color.alpha()]
    });
    RgbaImage::from_raw(width, height, straight.collect()).ok_or_else(too_large)
}

pub fn png_file(picture: &RgbaImage) -> Result<Vec<u8>, ExportError> {
    Ok(encoded(picture.as_raw(), picture.width(), picture.height(), CompressionType::Default)?)
}

/// The bytes of a PNG file that states its resolution in pixels per inch (pHYs).
pub fn png_file_at(picture: &RgbaImage, dpi: f64) -> Result<Vec<u8>, ExportError> {
    let per_meter = (dpi / 0.0254).round() as u32;
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: per_meter, yppu: per_meter, unit: png::Unit::Meter }));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(picture.as_raw())?;
    writer.finish()?;
    Ok(file)
}

/// The bytes of a TIFF file, without opacity, that states its resolution in pixels per inch.
pub fn tiff_file_at(picture: &RgbaImage, dpi: f64) -> Result<Vec<u8>, ExportError> {
    let rgb: Vec<u8> = picture.pixels().flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    let mut file = Cursor::new(Vec::new());
    let compression = Compression::Deflate(DeflateLevel::Balanced);
    let mut encoder = TiffEncoder::new(&mut file)?.with_compression(compression);
    let mut image = encoder.new_image::<RGB8>(picture.width(), picture.height())?;
    let hundredths = Rational { n: (dpi * 100.0).round() as u32, d: 100 };
    image.resolution(ResolutionUnit::Inch, hundredths);
    image.write_data(&rgb)?;
    Ok(file.into_inner())
}

fn encoded(rgba: &[u8], width: u32, height: u32, compression: CompressionType) -> Result<Vec<u8>, image::ImageError> {
    let mut file = Vec::new();
    PngEncoder::new_with_quality(&mut file, compression, FilterType::Adaptive).write_image(
        rgba,
        width,
        height,
        ExtendedColorType::Rgba8,
    )?;
    Ok(file)
}

/// The bundled fonts and no others, one pixel per point, and nothing read from disk.
fn options() -> usvg::Options<'static> {
    static FONTS: LazyLock<Arc<usvg::fontdb::Database>> = LazyLock::new(|| {
        let mut fonts = usvg::fontdb::Database::new();
        for font in [FONT, MONO_FONT, SANS_FONT, SERIF_FONT] {
            fonts.load_font_data(font.to_vec());
        }
        Arc::new(fonts)
    });
    usvg::Options {
        dpi: 72.0,
        font_family: FONT_FAMILY.to_owned(),
        fontdb: Arc::clone(&FONTS),
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_string: Box::new(|_, _| None),
            ..usvg::ImageHrefResolver::default()
        },
        ..usvg::Options::default()
    }
}

fn data_uri(image: &Image) -> Option<String> {
    let (width, height) = (u32::try_from(image.width).ok()?, u32::try_from(image.height).ok()?);
    let file = encoded(&image.rgba, width, height, CompressionType::Default).ok()?;
    Some(format!("data:image/png;base64,{}", BASE64_STANDARD.encode(&file)))
}

choices! {
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum FigureForm {
        Pdf = "pdf", "PDF", "Vectors with embedded fonts";
        Svg = "svg", "SVG", "Vectors";
        Png = "png", "PNG", "Pixels";
        Tiff = "tif" | "tiff", "TIFF", "Pixels, as some journals want them";
        Csv = "csv", "CSV", "Numbers behind the figure";
        Json = "json", "JSON", "Numbers behind the figure, for programs";
        Tex = "tex", "LaTeX", "Numbers behind the figure as a table of the package booktabs";
    }
}

impl FigureForm {
    pub const fn is_numbers(self) -> bool {
        matches!(self, Self::Csv | Self::Json | Self::Tex)
    }

    /// Form that the ending of a path names.
    pub fn of(path: &Path) -> Option<Self> {
        Self::parse(&path.extension()?.to_str()?.to_ascii_lowercase())
    }

    /// Bytes of a figure's file, laid out for a paper; a table of numbers is written as it is.
    pub fn bytes(self, figure: &Figure, numbers: &Table, paper: &Paper) -> Result<Vec<u8>, ExportError> {
        let colors = paper.colors();
        match self {
            Self::Pdf => pdf(figure, &colors, *paper),
            Self::Svg => Ok(svg(figure, &colors, *paper).into_bytes()),
            Self::Png | Self::Tiff => {
                let picture = png(&svg(figure, &colors, *paper), paper.pixels_per_point())?;
                let file = if self == Self::Png { png_file_at } else { tiff_file_at };
                file(&picture, paper.dpi)
            }
            Self::Csv => Ok(numbers.to_csv().into_bytes()),
            Self::Tex => Ok(numbers.to_latex(&figure.title).into_bytes()),
            Self::Json => Ok(json(&figure.title, numbers).into_bytes()),
        }
    }
}
