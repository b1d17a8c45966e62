//! Forms of a figure's file.

use std::path::Path;

use chromascope_figure::{Figure, Table};

use super::{ExportError, Paper, json, pdf, png, png_file_at, svg, tiff_file_at};

/// Form of a figure's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureForm {
    /// Vectors with embedded fonts.
    Pdf,
    /// Vectors.
    Svg,
    /// Pixels.
    Png,
    /// Pixels, as some journals want them.
    Tiff,
    /// Numbers behind the figure.
    Csv,
    /// Numbers behind the figure, for programs.
    Json,
}

impl FigureForm {
    /// All forms.
    pub const ALL: [Self; 6] = [Self::Pdf, Self::Svg, Self::Png, Self::Tiff, Self::Csv, Self::Json];

    /// Ending of its files.
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Pdf => "pdf",
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Tiff => "tif",
            Self::Csv => "csv",
            Self::Json => "json",
        }
    }

    /// Name on screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pdf => "PDF",
            Self::Svg => "SVG",
            Self::Png => "PNG",
            Self::Tiff => "TIFF",
            Self::Csv => "CSV",
            Self::Json => "JSON",
        }
    }

    /// True if its files hold numbers, not the figure.
    pub const fn is_numbers(self) -> bool {
        matches!(self, Self::Csv | Self::Json)
    }

    /// Form that the ending of a path names.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?;
        let ending = if ending.eq_ignore_ascii_case("tiff") { Self::Tiff.ending() } else { ending };
        Self::ALL.into_iter().find(|form| form.ending().eq_ignore_ascii_case(ending))
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
