//! Arguments of `figure`.

use std::ffi::OsString;
use std::path::PathBuf;

use chromascope_figure::{AxisRanges, AxisTitles, LegendPlace, Numbers};
use clap::{Args, ValueEnum};

use crate::cli::arguments::{CommonArguments, PixelArguments};
use crate::cli::render::arguments::ViewpointArguments;
use crate::export::paper::{Paper, PaperStyle};
use crate::theme::SourceInks;
use crate::view::diagram::Ranges;
use crate::workspaces::PaneKind;

const EXAMPLES: &str = "Examples:
  chromascope figure chromaticity --preset paper --width 85mm --font-size 8 --out figure3.pdf
  chromascope figure spectra --camera \"Nikon D70\" --width 174mm --style print --out spectra.svg
  chromascope figure swatches --session work.chromascope --width 3.35in --dpi 600 --out swatches.png
  chromascope figure render --mesh fern --width 174mm --out figure8.pdf
  chromascope figure head-to-head --camera \"Nikon D70\" --camera \"Nikon D200\" --temperature 3200 --out pair.pdf
  chromascope figure chromaticity --range 0.3,0.5,0.3,0.42 --numbers visible --out points.csv

The ending of the file decides its form: .pdf, .svg, .png, .tif, or .csv and .json, the numbers behind the figure. Text
keeps its size whatever the width: the figure is laid out for it. In a PDF text can be searched, and its fonts are embedded.";

/// Figures for paper, laid out for a width: PDF, SVG, PNG, or the numbers behind them as CSV
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(in crate::cli) struct FigureArguments {
    /// The figure
    #[arg(value_enum)]
    pub(super) kind: FigureKind,
    /// A file with curves for `curves`, or with raw values of patches for `recorded`
    pub(super) file: Option<PathBuf>,
    #[command(flatten)]
    pub(super) common: CommonArguments,
    /// A saved document, in place of sensors, reference, illuminant and patches
    #[arg(long, value_name = "FILE", conflicts_with_all = ["observer", "camera", "per", "reference", "transform", "fit_to",
          "correction", "training", "illuminant", "filter", "white", "chart",
          "second_light"])]
    pub(super) session: Option<PathBuf>,
    /// A chart, a material, or a file with reflectances [default: the preset's]
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) chart: Option<OsString>,
    /// The second light of `correction`: a name or a file with one curve
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) second_light: Option<OsString>,
    /// Temperature in kelvins that marks the loci, and of the locus metrics [default: that of a blackbody or daylight as the
    /// illuminant, a session's own, otherwise as in `compare` 2856 for metrics, head-to-head and report-card, 5500 for others]
    #[arg(long, value_name = "K")]
    pub(super) temperature: Option<f64>,
    #[command(flatten)]
    pub(super) pixel: PixelArguments,
    /// What is rendered: head, fern, sphere, plane, or an OBJ, PLY or STL file [default: the head, or the session's]
    #[arg(long, value_name = "MESH")]
    pub(super) mesh: Option<OsString>,
    #[command(flatten)]
    pub(super) viewpoint: ViewpointArguments,
    #[command(flatten)]
    pub(super) paper: PaperArguments,
}

/// Figures: those of the window's panes, and parts of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum FigureKind {
    /// The chromaticity diagram with loci and patches
    Chromaticity,
    /// Distance of each locus to the reference's over temperature
    Strip,
    /// Light, patches and sensitivities over wavelength
    Spectra,
    /// Patches as each sensor renders them
    Swatches,
    /// Color rendering of the light
    Light,
    /// Pictures of a mesh or spectral image through each sensor
    Render,
    /// Maps of the pictures' differences from the reference
    Difference,
    /// Cameras ranked by their first figure of merit
    Metrics,
    /// All figures of merit of two cameras
    HeadToHead,
    /// All figures of merit of one camera
    ReportCard,
    /// Error of a correction between its two lights; needs a second light
    Correction,
    /// Curves of a file
    Curves,
    /// Residuals of the camera nearest to recorded raw values
    Recorded,
    /// Run time of each method against its error, measured now
    Methods,
    /// Skipped work is a table: `render --stats`
    #[value(hide = true)]
    WorkSaved,
}

impl FigureKind {
    /// True if it shows what `compare` computes.
    pub(super) const fn is_of_metrics(self) -> bool {
        matches!(self, Self::Metrics | Self::HeadToHead | Self::ReportCard)
    }

    /// The pane whose figure it is; none for a part of one.
    pub(super) const fn pane(self) -> Option<PaneKind> {
        Some(match self {
            Self::Chromaticity => PaneKind::CHROMATICITY,
            Self::Strip | Self::WorkSaved => return None,
            Self::Spectra => PaneKind::SPECTRA,
            Self::Swatches => PaneKind::SWATCHES,
            Self::Light => PaneKind::LIGHT,
            Self::Render | Self::Difference => PaneKind::RENDER,
            Self::Metrics => PaneKind::METRICS,
            Self::HeadToHead => PaneKind::HEAD_TO_HEAD,
            Self::ReportCard => PaneKind::REPORT_CARD,
            Self::Correction => PaneKind::CORRECTION,
            Self::Curves => PaneKind::CURVES,
            Self::Recorded => PaneKind::RECORDED,
            Self::Methods => PaneKind::METHODS,
        })
    }
}

const PAPER: &str = "Paper";

/// Arguments that lay a figure out.
#[derive(Debug, Args)]
pub(super) struct PaperArguments {
    /// Width of the page, in mm, cm, in or pt [default: 85mm, one column]
    #[arg(long, value_name = "LENGTH", default_value = "85mm", value_parser = millimeters, help_heading = PAPER)]
    width: f64,
    /// Height of the page [default: the figure's own proportions]
    #[arg(long, value_name = "LENGTH", value_parser = millimeters, help_heading = PAPER)]
    height: Option<f64>,
    /// Size of text in points
    #[arg(long, value_name = "POINTS", default_value_t = 8.0, value_parser = points, help_heading = PAPER)]
    font_size: f64,
    /// Factor on the widths of lines and on markers
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = factor, help_heading = PAPER)]
    line_width: f64,
    /// Resolution of PNG and TIFF, in pixels per inch
    #[arg(long, value_name = "DPI", default_value_t = 300.0, value_parser = dpi, help_heading = PAPER)]
    dpi: f64,
    /// Colors of ground, text and frames
    #[arg(long, value_enum, default_value_t = StyleName::Light, help_heading = PAPER)]
    style: StyleName,
    /// Colors of sources: `safe` for all kinds of color vision, as on screen, or grays
    #[arg(long, value_enum, default_value_t = InksName::Safe, help_heading = PAPER)]
    inks: InksName,
    /// Place of the legend [default: below where the page is narrower than 120 mm, else beside]
    #[arg(long, value_enum, help_heading = PAPER)]
    legend: Option<LegendName>,
    /// Place of the titles of the axes
    #[arg(long, value_enum, default_value_t = TitlesName::Inside, help_heading = PAPER)]
    axis_titles: TitlesName,
    /// Ranges of the chromaticity diagram: `data`, `full`, or X0,X1,Y0,Y1
    #[arg(long, value_name = "RANGE", default_value = "data", value_parser = range, help_heading = PAPER)]
    pub(super) range: Range,
    /// Numbers of a CSV: all, or those of what the figure shows
    #[arg(long, value_enum, default_value_t = NumbersName::All, help_heading = PAPER)]
    numbers: NumbersName,
    /// Leaves the caption with the conditions out
    #[arg(long, help_heading = PAPER)]
    no_caption: bool,
    /// Leaves the strip below the chromaticity diagram out
    #[arg(long, help_heading = PAPER)]
    no_strip: bool,
}

impl PaperArguments {
    /// The paper.
    pub(super) fn paper(&self) -> Paper {
        Paper {
            width_mm: Some(self.width),
            height_mm: self.height,
            font_pt: self.font_size,
            line_scale: self.line_width,
            style: match self.style {
                StyleName::Light => PaperStyle::Light,
                StyleName::Print => PaperStyle::Print,
                StyleName::Dark => PaperStyle::Dark,
            },
            inks: match self.inks {
                InksName::Safe => SourceInks::Screen,
                InksName::Gray => SourceInks::Gray,
            },
            legend: self.legend.map(LegendName::place),
            axis_titles: match self.axis_titles {
                TitlesName::Inside => AxisTitles::Inside,
                TitlesName::Outside => AxisTitles::Outside,
                TitlesName::None => AxisTitles::None,
            },
            caption: !self.no_caption,
            strip: !self.no_strip,
            ranges: if self.range == Range::Full { AxisRanges::Full } else { AxisRanges::Screen },
            numbers: match self.numbers {
                NumbersName::All => Numbers::All,
                NumbersName::Visible => Numbers::Visible,
            },
            dpi: self.dpi,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum StyleName {
    /// As on a light screen
    Light,
    /// Black on white
    Print,
    /// Light on dark
    Dark,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum InksName {
    /// Colors told apart in all kinds of color vision
    Safe,
    /// Grays told apart in print without color
    Gray,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum LegendName {
    /// Inside, in a corner where it covers no point; below where there is none
    Inside,
    /// Inside, at the upper right
    UpperRight,
    /// Inside, at the upper left
    UpperLeft,
    /// Inside, at the lower right
    LowerRight,
    /// Inside, at the lower left
    LowerLeft,
    /// Right of the figure; below where that would take half of the width
    Beside,
    /// Below the figure
    Below,
    /// No legend
    None,
}

impl LegendName {
    fn place(self) -> LegendPlace {
        match self {
            Self::Inside => LegendPlace::Inside,
            Self::UpperRight => LegendPlace::UpperRight,
            Self::UpperLeft => LegendPlace::UpperLeft,
            Self::LowerRight => LegendPlace::LowerRight,
            Self::LowerLeft => LegendPlace::LowerLeft,
            Self::Beside => LegendPlace::Outside,
            Self::Below => LegendPlace::Below,
            Self::None => LegendPlace::None,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum TitlesName {
    /// In the corners of the plot
    Inside,
    /// Along the axes
    Outside,
    /// Nowhere
    None,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum NumbersName {
    /// Everything that the figure is made from
    All,
    /// Only points within the axes, and curves that are drawn
    Visible,
}

/// Ranges of the chromaticity diagram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Range {
    /// Those of the data.
    Data,
    /// The whole diagram.
    Full,
    /// These.
    Of(Ranges),
}

fn range(text: &str) -> Result<Range, String> {
    match text.trim() {
        "data" => return Ok(Range::Data),
        "full" => return Ok(Range::Full),
        _ => {}
    }
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse::<f64>()).collect();
    match numbers.as_deref() {
        Ok(&[x0, x1, y0, y1]) if x1 - x0 > 1e-6 && y1 - y0 > 1e-6 && x1 - x0 < 10.0 && y1 - y0 < 10.0 => {
            Ok(Range::Of([[x0, x1], [y0, y1]]))
        }
        _ => Err("expected data, full, or the ends of x and y in ascending order, such as 0.3,0.5,0.3,0.4".to_owned()),
    }
}

/// A length in millimeters; the unit is required.
fn millimeters(text: &str) -> Result<f64, String> {
    let units = [("mm", 1.0), ("cm", 10.0), ("in", 25.4), ("pt", 25.4 / 72.0)];
    let found = units.iter().find_map(|(unit, mm)| Some((text.trim().strip_suffix(unit)?, mm)));
    let (number, mm) = found.ok_or("a length needs a unit, such as 85mm or 3.35in")?;
    let length = number.trim().parse::<f64>().map_err(|error| error.to_string())? * mm;
    within(length, Paper::SIDE_MM, "mm")
}

fn points(text: &str) -> Result<f64, String> {
    within(text.parse().map_err(|_| "not a number".to_owned())?, Paper::FONT_PT, "points")
}

fn factor(text: &str) -> Result<f64, String> {
    within(text.parse().map_err(|_| "not a number".to_owned())?, Paper::LINE_SCALE, "")
}

fn dpi(text: &str) -> Result<f64, String> {
    within(text.parse().map_err(|_| "not a number".to_owned())?, Paper::DPI, "pixels per inch")
}

fn within(value: f64, [low, high]: [f64; 2], unit: &str) -> Result<f64, String> {
    if (low..=high).contains(&value) {
        Ok(value)
    } else {
        Err(format!("must be from {low} to {high} {unit}").trim_end().to_owned())
    }
}
