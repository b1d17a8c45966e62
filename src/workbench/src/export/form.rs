//! Forms of a figure's file.

use chromascope_text::{Choice as _, choices};
use std::path::Path;

use chromascope_figure::{Figure, Table};

use super::{ExportError, Paper, json, pdf, png, png_file_at, svg, tiff_file_at};

choices! {
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum FigureForm {
        Pdf = "pdf", "PDF", "Vectors with embedded fonts";
        Svg = "svg", "SVG", "Vectors";
        Png = "png", "PNG", "Pixels";
        Tiff = "tif" | "tiff", "TIFF", "Pixels, as some journals want them";
        Csv = "csv", "CSV", "Numbers behind the figure";
        Json = "json", "JSON", "Numbers behind the figure, for programs";
    }
}

impl FigureForm {
    pub const fn ending(self) -> &'static str {
        self.key()
    }

    pub const fn name(self) -> &'static str {
        self.label()
    }

    pub const fn is_numbers(self) -> bool {
        matches!(self, Self::Csv | Self::Json)
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
            Self::Json => Ok(json(&figure.title, numbers).into_bytes()),
        }
    }
}
